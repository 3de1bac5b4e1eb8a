#include "GuiTest.h"

#include <algorithm>
#include <fstream>

#include <QInputDialog>
#include <QMimeData>
#include <QProgressDialog>
#include <QPushButton>

#include "Banner.h"
#include "petrous/Imaging/LabelFile.h"
#include "petrous/Imaging/VolumeFile.h"
#include "petrous/Phantom/SamplePatient.h"

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
  ASSERT_TRUE(waitFor([this] { return window().model().hasCase() && !window().busy(); }));
  EXPECT_EQ(window().model().value().name, "Left ear  2");
  EXPECT_TRUE(library().contains("Left ear  2"));
  EXPECT_FALSE(window().model().unsaved());
  const QImage image = picture();
  EXPECT_GT(pixelsUnlikeTheCorner(image), image.width() * image.height() / 20);

  dropPath(file); // again: a case of its own
  ASSERT_TRUE(waitFor([this] { return library().contains("Left ear  2 2"); }));
}

TEST_F(Import, ADroppedDicomFolderCanBeDrilledAtOnce)
{
  phantom::SampleOptions options;
  options.spacing = 1.0;
  phantom::writeSamplePatient(folder() / "sample", options);
  openWindow();
  dropPath(folder() / "sample" / "ct");
  ASSERT_TRUE(waitFor([this] { return window().model().hasCase(); }));
  QTest::qWait(100);
  drill(600);
  ASSERT_TRUE(waitFor([this] { return !window().busy(); }));
  QTest::qWait(50);
  EXPECT_EQ(library().open("ct").dissection.strokes().size(), 1u);
}

TEST_F(Import, AFolderOfSeveralSeriesAsksWhichOne)
{
  phantom::SampleOptions options;
  options.spacing = 1.5;
  phantom::writeSamplePatient(folder() / "visit", options);
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
  ASSERT_TRUE(waitFor([this] { return window().model().hasCase() && !window().busy(); }));
  ASSERT_EQ(offered.size(), 2);
  for (const char* told : {" images, ", "2020-01-01 12:00", "HFS", "in “ct”"})
    EXPECT_TRUE(offered[0].contains(QString::fromUtf8(told))) << offered[0].toStdString();
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
  ASSERT_TRUE(waitFor([this] { return !window().busy(); }));
  EXPECT_FALSE(window().model().hasCase());
  EXPECT_TRUE(library().list().empty());
}

TEST_F(Import, CancelLeavesNoCase)
{
  openWindow();
  window().findChild<QPushButton*>("primary")->click(); // making the sample patient takes seconds
  QProgressDialog* progress = nullptr;
  ASSERT_TRUE(waitFor(
      [&]
      {
        progress = window().findChild<QProgressDialog*>("importProgress");
        return progress && progress->isVisible() && progress->value() > 0;
      }));
  progress->findChild<QPushButton*>()->click();
  ASSERT_TRUE(waitFor([this] { return !window().busy(); }));
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

namespace
{

// The patient at 1.5 mm, in `folder`.
void writePatient(const fs::path& folder)
{
  phantom::SampleOptions options;
  options.spacing = 1.5;
  phantom::writeSamplePatient(folder, options);
}

// Clicks the button of the next message box whose text contains `button`; returns the box's text.
QString answered(const std::function<void(const std::function<void(QMessageBox&)>&)>& onMessage,
                 const QString& button, const std::function<void()>& act)
{
  QString text;
  onMessage(
      [&text, button](QMessageBox& box)
      {
        text = box.text();
        for (QAbstractButton* candidate : box.buttons())
          if (candidate->text().contains(button))
            return candidate->click();
        box.reject();
      });
  act();
  EXPECT_TRUE(QTest::qWaitFor([&text] { return !text.isEmpty(); }, 60000));
  return text;
}

} // namespace

TEST_F(Import, AnMrComesToTheOpenCase)
{
  writePatient(folder() / "sample");
  openWindow();
  dropPath(folder() / "sample" / "ct");
  ASSERT_TRUE(waitFor([this] { return window().model().hasCase() && !window().busy(); }));
  const QString asked = answered([this](const auto& react) { onMessage(react); }, "Add to",
                                 [this] { dropPath(folder() / "sample" / "mr"); });
  EXPECT_TRUE(asked.contains("MR") && asked.contains("ct")) << asked.toStdString();
  ASSERT_TRUE(waitFor([this] { return window().model().value().mr.size() == 1; }));
  EXPECT_TRUE(settled());
  EXPECT_EQ(window().model().value().name, "ct");
  EXPECT_EQ(library().list().size(), 1u);
  EXPECT_EQ(library().open("ct").mr.size(), 1u);
  EXPECT_EQ(window().model().value().iso, 300.0);
}

TEST_F(Import, LabelsAndMeshesComeToTheOpenCaseAndCanBeDropped)
{
  writePatient(folder() / "sample");
  openWindow();
  dropPath(folder() / "sample" / "ct");
  ASSERT_TRUE(waitFor([this] { return window().model().hasCase() && !window().busy(); }));
  const auto camera = view().picture().camera();
  answered([this](const auto& react) { onMessage(react); }, "Add to",
           [this] { dropPath(folder() / "sample" / "labels.seg.nrrd"); });
  ASSERT_TRUE(waitFor([this] { return !window().model().value().labels.empty(); }));
  EXPECT_TRUE(settled());
  EXPECT_TRUE(window().model().ready());
  EXPECT_EQ(view().picture().camera().position, camera.position);
  EXPECT_FALSE(library().open("ct").labels.empty());
  // Cancelling has no effect.
  const auto parts = window().model().value().meshes.size();
  answered([this](const auto& react) { onMessage(react); }, "Cancel",
           [this] { dropPath(folder() / "sample" / "meshes" / "facial_nerve.obj"); });
  EXPECT_TRUE(settled());
  EXPECT_EQ(window().model().value().meshes.size(), parts);
}

TEST_F(Import, LabelsThatLieOutsideTheCtAreToldInALine)
{
  saveBall("ball");
  const core::GridGeometry away({8, 8, 8}, Eigen::Vector3d::Ones(), {500.0, 500.0, 500.0});
  auto voxels = std::make_shared<volume::Volume<std::uint16_t>>(away, std::uint16_t{1});
  volume::Segment vein;
  vein.name = "vein";
  vein.index = 1;
  imaging::writeLabelFile(folder() / "other.seg.nrrd", volume::makeLabelMap(voxels, {vein}));
  openWindow();
  answered([this](const auto& react) { onMessage(react); }, "Add to",
           [this] { dropPath(folder() / "other.seg.nrrd"); });
  ASSERT_TRUE(waitFor([this] { return window().model().value().labels.size() == 2; }));
  EXPECT_TRUE(settled());
  QTest::qWait(100);
  auto* banner = window().findChild<Banner*>("notesBanner");
  EXPECT_TRUE(banner->isVisible());
  EXPECT_TRUE(banner->text().contains("'vein' lies wholly outside the CT"))
      << banner->text().toStdString();
}

TEST_F(Import, WithoutACaseAnMrAndLabelsSayWhatIsNeeded)
{
  writePatient(folder() / "sample");
  openWindow();
  for (const char* what : {"mr", "labels.seg.nrrd"})
  {
    const QString told = answered([this](const auto& react) { onMessage(react); }, "OK",
                                  [&] { dropPath(folder() / "sample" / what); });
    EXPECT_TRUE(told.contains("CT") && told.contains(what)) << told.toStdString();
    EXPECT_TRUE(settled());
  }
  EXPECT_FALSE(window().model().hasCase());
  EXPECT_TRUE(library().list().empty());
}

// An MR or a cone beam as a plain file: undetermined.
TEST_F(Import, InDoubtTheUserIsAsked)
{
  saveBall("ball");
  const auto plain = [this](const std::string& name)
  {
    const auto ball = ballCase("x");
    auto image = std::make_shared<volume::Volume<std::int16_t>>(ball.ct.geometry);
    std::uint32_t state = 1;
    for (std::size_t n = 0; n < image->size(); ++n)
    {
      state = state * 1664525U + 1013904223U;
      image->data()[n] = static_cast<std::int16_t>(200 + (state >> 24));
    }
    imaging::writeVolume(folder() / name, *image);
    return folder() / name;
  };
  const fs::path file = plain("t2.nrrd");
  openWindow();
  QString text;
  onMessage( // what it is, and then whether to add it
      [this, &text](QMessageBox& box)
      {
        text = box.text();
        onMessage(
            [](QMessageBox& add)
            {
              for (QAbstractButton* button : add.buttons())
                if (button->text().contains("Add to"))
                  return button->click();
            });
        for (QAbstractButton* button : box.buttons())
          if (button->text().contains("MR of"))
            return button->click();
      });
  dropPath(file);
  ASSERT_TRUE(waitFor([this] { return !window().model().value().mr.empty(); }));
  EXPECT_TRUE(text.contains("t2.nrrd")) << text.toStdString();
  EXPECT_EQ(window().model().value().name, "ball");
  EXPECT_TRUE(settled());
  // As a CT it is a case of its own.
  answered([this](const auto& react) { onMessage(react); }, "CT",
           [&] { dropPath(plain("beam.nrrd")); });
  ASSERT_TRUE(waitFor([this] { return window().model().value().name == "beam"; }));
}

TEST_F(Import, ACtBeginsACaseAndTheOpenOneIsSafe)
{
  saveBall("ball");
  const fs::path file = folder() / "ear.nrrd";
  imaging::writeVolume(file, *ballCase("x").ct.volume.get());
  openWindow();
  drill(400);
  QTest::keyClick(&window(), Qt::Key_Z, Qt::ControlModifier); // unsaved
  EXPECT_TRUE(waitFor([this] { return window().model().value().applied() == 0; }));
  EXPECT_TRUE(window().model().unsaved());
  dropPath(file);
  dropPath(file); // while it is being examined
  ASSERT_TRUE(waitFor([this] { return window().model().value().name == "ear"; }));
  EXPECT_TRUE(settled());
  const auto ball = library().open("ball");
  EXPECT_EQ(ball.dissection.strokes().size(), 1u);
  EXPECT_EQ(ball.applied(), 0u);
  EXPECT_EQ(library().list().size(), 2u) << "the second drop came while the first was read";
}

TEST_F(Import, FilesThatAreDroppedTogetherMakeOneCase)
{
  writePatient(folder() / "sample");
  openWindow();
  QMimeData data;
  const auto url = [this](const char* name)
  { return QUrl::fromLocalFile(QString::fromStdString((folder() / "sample" / name).string())); };
  data.setUrls({url("labels.seg.nrrd"), url("ct"), url("mr"), url("meshes/incus.obj")});
  drop(data);
  ASSERT_TRUE(waitFor([this] { return window().model().hasCase() && !window().busy(); }));
  const auto saved = library().open("ct");
  EXPECT_FALSE(saved.labels.empty());
  EXPECT_EQ(saved.mr.size(), 1u);
  EXPECT_EQ(saved.meshes.size(), 1u);
}

// A file name may be a patient's; only the user knows what the structure is.
TEST_F(Import, AStructureWithoutANameIsAskedForOne)
{
  saveBall("ball");
  writePatient(folder() / "sample");
  fs::copy(folder() / "sample/meshes/incus.obj", folder() / "Doe John.obj");
  openWindow();
  QString asked;
  QTimer answer;
  QObject::connect(&answer, &QTimer::timeout, &answer,
                   [&]
                   {
                     auto* ask = qobject_cast<QInputDialog*>(QApplication::activeModalWidget());
                     if (!ask)
                       return;
                     answer.stop();
                     asked = ask->labelText();
                     ask->setTextValue("tumour");
                     ask->accept();
                   });
  answer.start(20);
  answered([this](const auto& react) { onMessage(react); }, "Add to",
           [this] { dropPath(folder() / "Doe John.obj"); });
  ASSERT_TRUE(waitFor([this] { return !window().model().value().meshes.empty(); }));
  EXPECT_TRUE(asked.contains("Doe John.obj")) << asked.toStdString();
  EXPECT_EQ(window().model().value().meshes[0].name, "tumour");
  EXPECT_TRUE(settled());
}

// What was assumed about a file stays visible until acknowledged.
TEST_F(Import, WhatWasAssumedIsToldUntilSomebodyHasReadIt)
{
  const fs::path file = folder() / "beam.nrrd";
  auto image = std::make_shared<volume::Volume<std::int16_t>>(ballCase("x").ct.geometry);
  for (std::size_t n = 0; n < image->size(); ++n) // starts at 0: no Hounsfield units
    image->data()[n] = static_cast<std::int16_t>(n % 64 < 32 ? n % 97 : 2000 + n * 7919 % 3001);
  imaging::writeVolume(file, *image);
  openWindow();
  answered([this](const auto& react) { onMessage(react); }, "CT", [&] { dropPath(file); });
  ASSERT_TRUE(waitFor([this] { return window().model().hasCase() && !window().busy(); }));
  auto* banner = window().findChild<Banner*>("notesBanner");
  ASSERT_TRUE(banner);
  EXPECT_TRUE(banner->isVisible());
  EXPECT_TRUE(banner->text().contains("not Hounsfield units")) << banner->text().toStdString();
  banner->findChild<QPushButton*>("dismissNotes")->click();
  EXPECT_FALSE(banner->isVisible());
}

TEST_F(Import, ATiltedScanIsStraightenedOnlyWithConsent)
{
  phantom::SampleOptions options;
  options.spacing = 1.5;
  options.tilt = 12.0;
  phantom::writeSamplePatient(folder() / "tilted", options);
  openWindow();
  const auto drop = [this](const QString& button)
  {
    const QString asked = answered([this](const auto& react) { onMessage(react); }, button,
                                   [this] { dropPath(folder() / "tilted" / "ct"); });
    EXPECT_TRUE(asked.contains("12.0 degrees")) << asked.toStdString();
    EXPECT_FALSE(asked.contains("--repair")) << asked.toStdString();
    ASSERT_TRUE(waitFor([this] { return !window().busy(); }));
  };
  drop("Cancel");
  EXPECT_FALSE(window().model().hasCase());
  EXPECT_TRUE(library().list().empty());
  drop("Straighten");
  ASSERT_TRUE(waitFor([this] { return window().model().hasCase() && !window().busy(); }));
  const auto& notes = window().model().value().ct.notes;
  EXPECT_TRUE(std::any_of(notes.begin(), notes.end(),
                          [](const std::string& note)
                          { return note.find("tilt of 12.0 degrees") != std::string::npos; }));
}
