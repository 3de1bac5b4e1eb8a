#include "GuiTest.h"

#include <fstream>

#include <QComboBox>
#include <QDoubleSpinBox>
#include <QLabel>
#include <QPushButton>

#include "Banner.h"

using namespace petrous;
using namespace petrous::workstation;

namespace
{

namespace fs = std::filesystem;

class Damage : public GuiTest
{
protected:
  // Flips one bit of a library object.
  void flipBit(const std::string& object) const
  {
    const fs::path file = folder() / "library/objects" / object;
    const auto at = static_cast<std::streamoff>(fs::file_size(file) * 2 / 3);
    std::fstream stream(file, std::ios::binary | std::ios::in | std::ios::out);
    stream.seekg(at);
    const char byte = static_cast<char>(stream.get() ^ 4);
    stream.seekp(at);
    stream.put(byte);
  }

  // Three strokes through the middle of the ball, the second of which is then damaged; `applied` of
  // them are.
  void saveDamagedStroke(std::size_t applied)
  {
    saveBall("ball");
    library::Library store = library();
    scene::Case value = store.open("ball");
    store.loadDissection(value);
    const Eigen::Vector3d middle = value.ct.geometry.center();
    for (int n = 0; n < 3; ++n)
    {
      value.dissection.beginStroke({});
      value.dissection.cut({middle, middle + Eigen::Vector3d(n, 0, 0), 1.0});
      value.dissection.endStroke();
    }
    value.dissection.undo(3 - applied);
    store.save(value);
    flipBit(value.dissection.strokes()[1]->object);
  }

  // Of a registered MR "T2" the library has lost the file.
  void saveLostMr() const
  {
    scene::Case value = ballCase("ball");
    scene::ImagePart mr = value.ct;
    auto voxels = std::make_shared<volume::Volume<std::int16_t>>(mr.geometry, std::int16_t{40});
    voxels->at(1, 2, 3) = 90;
    mr.name = "T2";
    mr.object.clear();
    mr.volume = std::make_shared<const volume::IntensityVolume>(
        std::shared_ptr<const volume::Volume<std::int16_t>>(voxels));
    mr.range = mr.volume.get()->range();
    mr.registered = true;
    value.mr.push_back(mr);
    library().save(value);
    fs::remove(folder() / "library/objects" / library().open("ball").mr[0].object);
  }

  Banner& banner() { return *window().findChild<Banner*>("damageBanner"); }
};

} // namespace

TEST_F(Damage, OfTheCtIsToldAndNothingIsDrilled)
{
  saveBall("ball");
  flipBit(library().open("ball").ct.object);
  openWindow();
  ASSERT_TRUE(waitFor([this] { return banner().isVisible(); }));
  EXPECT_TRUE(banner().text().contains("the CT of case 'ball'")) << banner().text().toStdString();
  QTest::keyClick(&view(), Qt::Key_D);
  QTest::mouseMove(&view(), view().rect().center());
  QTest::mousePress(&view(), Qt::LeftButton, Qt::NoModifier, view().rect().center());
  QTest::qWait(300);
  EXPECT_FALSE(window().model().touching());
  QTest::mouseRelease(&view(), Qt::LeftButton, Qt::NoModifier, view().rect().center());
  EXPECT_TRUE(settled());
  EXPECT_TRUE(window().model().value().dissection.strokes().empty());
}

TEST_F(Damage, OfAnMrWhoseFileIsGoneIsToldBeforeItIsShown)
{
  saveLostMr();
  openWindow();
  ASSERT_TRUE(waitFor([this] { return banner().isVisible(); }));
  EXPECT_TRUE(banner().text().contains("MR 'T2' of case 'ball'")) << banner().text().toStdString();
  EXPECT_TRUE(banner().text().contains("is missing")) << banner().text().toStdString();
  drill(300); // the CT is whole
}

// The panel says why, each time, and the tools go on working on the CT.
TEST_F(Damage, OfAnMrWhoseFileIsGoneIsToldByTheSegmentTools)
{
  saveLostMr();
  openWindow();
  ASSERT_TRUE(waitFor([this] { return banner().isVisible(); }));
  QTest::keyClick(&window(), Qt::Key_T, Qt::ShiftModifier);
  auto& source = *window().findChild<QComboBox*>("segmentSource");
  auto& lower = *window().findChild<QDoubleSpinBox*>("segmentLower");
  const auto& remark = *window().findChild<QLabel*>("segmentRemark");
  const auto isTold = [&remark]
  { return remark.text().contains("T2") && remark.text().contains("is missing"); };
  ASSERT_GE(source.findData("T2"), 0);
  source.setCurrentIndex(source.findData("T2"));
  EXPECT_TRUE(waitFor(isTold)) << remark.text().toStdString();
  lower.setValue(lower.value() + 1.0);
  EXPECT_TRUE(settled());
  EXPECT_TRUE(waitFor(isTold)) << remark.text().toStdString();
  source.setCurrentIndex(source.findData("ct"));
  EXPECT_TRUE(waitFor([&] { return !isTold(); })) << remark.text().toStdString();
  EXPECT_FALSE(window().findChild<Banner*>("faultBanner")->isVisible());
}

TEST_F(Damage, OfAStructureIsToldAndTheOthersAreDrilled)
{
  saveBall("ball");
  flipBit(library().open("ball").labels[0].object);
  openWindow();
  ASSERT_TRUE(waitFor([this] { return banner().isVisible(); }));
  EXPECT_TRUE(banner().text().contains("'nerve' of case 'ball'")) << banner().text().toStdString();
  EXPECT_TRUE(window().model().ready());
  drill(600);
  EXPECT_EQ(library().open("ball").dissection.strokes().size(), 1u);
  // Nothing is reported for another case.
  auto* close = banner().findChild<QPushButton*>("dismissDamage");
  ASSERT_TRUE(close);
  close->click();
  EXPECT_FALSE(banner().isVisible());
}

TEST_F(Damage, OfAStrokeIsToldAndTheCaseOpensWithWhatIsSound)
{
  saveDamagedStroke(3);
  openWindow();
  ASSERT_TRUE(waitFor([this] { return banner().isVisible(); }));
  EXPECT_TRUE(banner().text().contains("stroke 2 of case 'ball'")) << banner().text().toStdString();
  EXPECT_TRUE(banner().text().contains("without its last 2 strokes"));
  EXPECT_EQ(window().model().value().applied(), 1u);
  EXPECT_TRUE(window().model().ready());
  action("Redo")->trigger();
  EXPECT_TRUE(settled());
  EXPECT_EQ(window().model().value().applied(), 1u);
  drill(600);
  const scene::Case saved = library().open("ball");
  EXPECT_EQ(saved.applied(), 2u);
  EXPECT_EQ(saved.dissection.strokes().size(), 4u) << "nothing is lost";
  EXPECT_TRUE(saved.dissection.history().find("main~1"));
}

TEST_F(Damage, OfAStrokeThatIsUndoneHindersNothing)
{
  saveDamagedStroke(1);
  openWindow();
  ASSERT_TRUE(waitFor([this] { return banner().isVisible(); }));
  EXPECT_TRUE(banner().text().contains("stroke 2 of case 'ball'")) << banner().text().toStdString();
  EXPECT_FALSE(banner().text().contains("without its last"));
  EXPECT_EQ(window().model().value().applied(), 1u);
  drill(600);
  EXPECT_EQ(library().open("ball").applied(), 2u);
}

// Taking up a tool after stopping the preparation resumes it.
TEST_F(Damage, APreparationThatWasStoppedIsDoneForATool)
{
  saveBall("ball");
  openWindow();
  auto* loading = window().findChild<Banner*>("loadingBanner");
  auto* cancel = loading->findChild<QPushButton*>("cancelLoading");
  ASSERT_TRUE(cancel);
  QTimer stop;
  QObject::connect(&stop, &QTimer::timeout, cancel,
                   [&]
                   {
                     if (!window().model().ready())
                       cancel->click();
                   });
  stop.start(0);
  for (int n = 0; n < 10 && window().model().ready(); ++n) // it may finish before it is stopped
  {
    window().begin("ball");
    EXPECT_TRUE(settled());
  }
  stop.stop();
  QApplication::setActiveWindow(&window()); // after the progress dialogs
  QTest::mouseMove(&view(), view().rect().center() + QPoint(1, 0));
  QTest::mouseMove(&view(), view().rect().center());
  QTest::keyClick(&view(), Qt::Key_D);
  ASSERT_TRUE(waitFor([this] { return window().model().touching(); })); // as soon as prepared
  drill(600);
  EXPECT_EQ(library().open("ball").dissection.strokes().size(), 1u);
}
