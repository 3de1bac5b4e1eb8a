#include "GuiTest.h"

#include <fstream>

#include <QInputDialog>
#include <QMimeData>
#include <QProgressDialog>
#include <QPushButton>

#include "petrous/Imaging/SamplePatient.h"
#include "petrous/Imaging/VolumeFile.h"

using namespace petrous;
using namespace petrous::workstation;

namespace fs = std::filesystem;
using Import = GuiTest;

TEST_F(Import, ADroppedFileIsOnTheScreenAndInTheLibrary)
{
  const fs::path file = folder() / "Left ear: 2.nrrd";
  imaging::writeVolume(file, *ballCase("x").ct.volume.get());
  openWindow();
  dropPath(file);
  ASSERT_TRUE(waitFor([this] { return window().model().hasCase() && !window().importing(); }));
  EXPECT_EQ(window().model().value().name, "Left ear  2");
  EXPECT_TRUE(library().contains("Left ear  2"));
  EXPECT_FALSE(window().model().unsaved());
  const QImage image = picture();
  EXPECT_GT(pixelsUnlikeTheCorner(image), image.width() * image.height() / 20);

  dropPath(file); // once more: a case of its own
  ASSERT_TRUE(waitFor([this] { return library().contains("Left ear  2 2"); }));
}

TEST_F(Import, ADroppedDicomFolderCanBeDrilledAtOnce)
{
  imaging::SampleOptions options;
  options.spacing = 1.0;
  imaging::writeSamplePatient(folder() / "sample", options);
  openWindow();
  dropPath(folder() / "sample" / "ct");
  ASSERT_TRUE(waitFor([this] { return window().model().hasCase(); }));
  QTest::qWait(100);
  drill(600);
  ASSERT_TRUE(waitFor([this] { return !window().importing(); }));
  QTest::qWait(50);
  EXPECT_EQ(library().open("ct").strokes.size(), 1u);
}

TEST_F(Import, AFolderOfSeveralSeriesAsksWhichOne)
{
  imaging::SampleOptions options;
  options.spacing = 1.5;
  imaging::writeSamplePatient(folder() / "visit", options);
  fs::remove_all(folder() / "visit" / "labels");
  openWindow();
  QStringList offered;
  QTimer answer;
  QObject::connect(&answer, &QTimer::timeout, &answer,
                   [&]
                   {
                     auto* ask = qobject_cast<QInputDialog*>(QApplication::activeModalWidget());
                     if (!ask)
                       return;
                     answer.stop();
                     offered = ask->comboBoxItems();
                     for (const QString& item : offered)
                       if (item.contains("CT"))
                         ask->setTextValue(item);
                     ask->accept();
                   });
  answer.start(20);
  dropPath(folder() / "visit");
  ASSERT_TRUE(waitFor([this] { return window().model().hasCase() && !window().importing(); }));
  EXPECT_EQ(offered.size(), 2);
  EXPECT_EQ(window().model().value().name, "visit");
  EXPECT_GT(window().model().value().ct.range.max, 1000.0); // HU: the CT, not the MR
}

TEST_F(Import, ADroppedWordOpensTheCaseOfThatName)
{
  saveBall("ball");
  QTest::qWait(1100);
  saveBall("second");
  openWindow();
  ASSERT_EQ(window().model().value().name, "second");
  QMimeData data;
  data.setText("ball");
  drop(data);
  ASSERT_TRUE(waitFor([this] { return window().model().value().name == "ball"; }));
}

TEST_F(Import, AFolderWithoutImagesIsRefusedInOneLine)
{
  fs::create_directory(folder() / "holiday");
  std::ofstream(folder() / "holiday" / "beach.jpg") << "no image";
  openWindow();
  QString text;
  onMessage(
      [&text](QMessageBox& box)
      {
        text = box.text();
        box.accept();
      });
  dropPath(folder() / "holiday");
  ASSERT_TRUE(waitFor([&text] { return !text.isEmpty(); }));
  EXPECT_TRUE(text.contains("holiday")) << text.toStdString();
  EXPECT_FALSE(text.contains('\n'));
  ASSERT_TRUE(waitFor([this] { return !window().importing(); }));
  EXPECT_FALSE(window().model().hasCase());
  EXPECT_TRUE(library().list().empty());
}

TEST_F(Import, CancelLeavesNoCase)
{
  openWindow();
  window().findChild<QPushButton*>("primary")->click(); // the sample patient takes seconds
  QProgressDialog* progress = nullptr;
  ASSERT_TRUE(waitFor(
      [&]
      {
        progress = window().findChild<QProgressDialog*>("importProgress");
        return progress && progress->isVisible() && progress->value() > 0;
      }));
  QElapsedTimer clock;
  clock.start();
  progress->findChild<QPushButton*>()->click();
  ASSERT_TRUE(waitFor([this] { return !window().importing(); }));
  EXPECT_LT(clock.elapsed(), 10000); // it stops, it does not just go on unseen
  EXPECT_FALSE(window().model().hasCase());
  EXPECT_TRUE(library().list().empty());
}

TEST_F(Import, QuittingWhileTheCaseIsBeingSavedKeepsIt)
{
  const fs::path file = folder() / "ear.nrrd";
  imaging::writeVolume(file, *ballCase("x").ct.volume.get());
  openWindow();
  dropPath(file);
  ASSERT_TRUE(waitFor([this] { return window().model().hasCase(); }));
  closeWindow();
  EXPECT_TRUE(library().contains("ear"));
}
