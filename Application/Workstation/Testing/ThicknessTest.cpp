#include "GuiTest.h"

#include <QStatusBar>
#include <QTreeView>

#include "StructuresPanel.h"
#include "ThicknessLegend.h"
#include "petrous/Rendering/ThicknessColor.h"

using namespace petrous;
using namespace petrous::workstation;

namespace
{

class Thickness : public GuiTest
{
protected:
  // The nerve is a sphere of 9.5 mm in one of bone of 12 mm.
  void saveThinBall()
  {
    scene::Case value = ballCase("ball");
    auto voxels =
        std::make_shared<volume::Volume<std::uint16_t>>(value.ct.geometry, std::uint16_t{0});
    const core::Index3& dims = value.ct.geometry.dims();
    for (int k = 0; k < dims[2]; ++k)
      for (int j = 0; j < dims[1]; ++j)
        for (int i = 0; i < dims[0]; ++i)
          if ((value.ct.geometry.patientFromVoxel({1.0 * i, 1.0 * j, 1.0 * k}) - kBallCenter)
                  .norm() < 9.5)
            voxels->at(i, j, k) = 1;
    value.labels[0].labels =
        std::make_shared<const volume::LabelMap>(volume::makeLabelMap(voxels, {}));
    library().save(value);
  }
  ThicknessLegend& legend() { return *window().findChild<ThicknessLegend*>("thicknessLegend"); }
  void choose(const std::string& structure)
  {
    structureList().setCurrentIndex(structureCell(structure));
  }
  bool measured(const std::string& structure)
  {
    return waitFor([&] { return window().model().thicknessOver() == structure; });
  }
};

} // namespace

TEST_F(Thickness, ColorsBoneOverTheChosenStructureUntilAskedAgain)
{
  saveThinBall();
  openWindow();
  const QImage before = picture();
  QTest::keyClick(&window(), Qt::Key_F6);
  EXPECT_FALSE(legend().isVisible()) << "nothing is chosen";
  EXPECT_TRUE(window().statusBar()->currentMessage().contains("Choose a structure"));
  EXPECT_EQ(differentPixels(before, picture()), 0);

  choose("nerve");
  QTest::keyClick(&window(), Qt::Key_F6);
  EXPECT_TRUE(waitFor([this] { return legend().isVisible(); }));
  EXPECT_EQ(legend().structure(), "nerve");
  ASSERT_TRUE(measured("nerve"));
  const QImage colored = picture();
  EXPECT_GT(differentPixels(before, colored, 20), 5000);
  // 2.5 mm, half of the scale: red, with shading; beside the highlight at the ball's centre.
  const QPoint center = colored.rect().center();
  int radius = 0;
  while (center.x() + radius < colored.width() &&
         colored.pixelColor(center.x() + radius, center.y()) != colored.pixelColor(0, 0))
    ++radius;
  ASSERT_GT(radius, 50);
  const QColor red = colored.pixelColor(center.x() + radius * 2 / 3, center.y());
  const auto wanted = rendering::thicknessColor(0.5);
  EXPECT_NEAR(red.greenF() / red.redF(), wanted[1] / wanted[0], 0.12);
  EXPECT_NEAR(red.blueF() / red.redF(), wanted[2] / wanted[0], 0.12);

  QTest::keyClick(&window(), Qt::Key_F6);
  EXPECT_FALSE(legend().isVisible());
  EXPECT_EQ(differentPixels(before, picture()), 0);
}

TEST_F(Thickness, FollowsTheSelectionWhileItIsOn)
{
  saveThinBall();
  scene::Case value = library().open("ball");
  scene::LabelPart second = ballCase("other").labels[0]; // a sphere of 4 mm: 8 mm below the surface
  second.structures[0].name = "cyst";
  value.labels.push_back(second);
  library().save(value);
  openWindow();
  choose("cyst");
  QTest::qWait(400);
  EXPECT_FALSE(legend().isVisible()) << "it is off";
  choose("nerve");
  QTest::keyClick(&window(), Qt::Key_F6);
  ASSERT_EQ(legend().structure(), "nerve");
  ASSERT_TRUE(measured("nerve"));
  choose("cyst");
  EXPECT_TRUE(measured("cyst"));
  EXPECT_EQ(legend().structure(), "cyst");
  structureList().setCurrentIndex(structureCell("ct"));
  QTest::qWait(400);
  EXPECT_EQ(legend().structure(), "cyst") << "bone has no thickness over itself";
  QTest::keyClick(&window(), Qt::Key_F6);
  EXPECT_FALSE(legend().isVisible());
}

TEST_F(Thickness, IsNotShownOnceItWasStoppedWhileBeingMeasured)
{
  saveThinBall();
  openWindow();
  choose("nerve");
  QTest::keyClick(&window(), Qt::Key_F6);
  EXPECT_TRUE(action("Bone thickness over the structure")->isChecked()) << "it is being measured";
  QTest::keyClick(&window(), Qt::Key_F6);
  EXPECT_FALSE(action("Bone thickness over the structure")->isChecked());
  QTest::qWait(300);
  EXPECT_FALSE(legend().isVisible());
  EXPECT_TRUE(window().model().thicknessOver().empty());
}

TEST_F(Thickness, IsOfTheCaseThatIsOpen)
{
  saveThinBall();
  saveBall("other");
  openWindow("ball");
  choose("nerve");
  QTest::keyClick(&window(), Qt::Key_F6);
  ASSERT_TRUE(legend().isVisible());
  ASSERT_TRUE(measured("nerve"));
  const_cast<presenters::WorkstationModel&>(window().model()).open("other");
  EXPECT_FALSE(legend().isVisible());
  EXPECT_TRUE(window().model().thicknessOver().empty());
}

// Not one after the other: what is not wanted any more is not shown, however late it comes.
TEST_F(Thickness, TheLatestOneAskedForIsShownAndAskingAgainStopsIt)
{
  saveThinBall();
  scene::Case value = library().open("ball");
  scene::LabelPart second = ballCase("other").labels[0];
  second.structures[0].name = "cyst";
  value.labels.push_back(second);
  library().save(value);
  openWindow();
  std::vector<std::string> shown;
  auto& model = const_cast<presenters::WorkstationModel&>(window().model());
  const auto before = model.events.appearanceChanged;
  model.events.appearanceChanged = [&]
  {
    before();
    shown.push_back(model.thicknessOver());
  };
  auto* panel = window().findChild<StructuresPanel*>();
  emit panel->thicknessAsked("nerve");
  emit panel->thicknessAsked("cyst");
  EXPECT_EQ(legend().structure(), "cyst");
  ASSERT_TRUE(measured("cyst"));
  EXPECT_EQ(shown, std::vector<std::string>{"cyst"});

  emit panel->thicknessAsked("nerve");
  EXPECT_EQ(legend().structure(), "nerve");
  emit panel->thicknessAsked("nerve");
  QTest::qWait(300);
  EXPECT_EQ(model.thicknessOver(), "cyst") << "the one before stays";
  EXPECT_EQ(legend().structure(), "cyst");
  model.events.appearanceChanged = before;
}

TEST_F(Thickness, StaysWhenItsStructureIsRenamed)
{
  saveThinBall();
  openWindow();
  choose("nerve");
  QTest::keyClick(&window(), Qt::Key_F6);
  ASSERT_TRUE(measured("nerve"));
  auto& model = const_cast<presenters::WorkstationModel&>(window().model());
  const auto distances = model.sceneContents().thickness.distance;
  model.renamePart("nerve", "facial nerve");
  EXPECT_EQ(model.thicknessOver(), "facial nerve");
  EXPECT_EQ(model.sceneContents().thickness.distance, distances) << "it is not measured again";
  EXPECT_TRUE(legend().isVisible());
  EXPECT_EQ(legend().structure(), "facial nerve");
  EXPECT_TRUE(action("Bone thickness over the structure")->isChecked());
  EXPECT_TRUE(waitFor([&] { return model.drawable() && !window().busy(); }));
  EXPECT_EQ(model.sceneContents().thickness.distance, distances);
  action("Undo")->trigger();
  EXPECT_EQ(model.thicknessOver(), "nerve");
  EXPECT_EQ(legend().structure(), "nerve");
}

TEST_F(Thickness, IsMeasuredUnderTheNewNameOfAStructureThatIsRenamedMeanwhile)
{
  saveThinBall();
  openWindow();
  emit window().findChild<StructuresPanel*>()->thicknessAsked("nerve");
  auto& model = const_cast<presenters::WorkstationModel&>(window().model());
  ASSERT_TRUE(model.thicknessOver().empty()) << "it is being measured";
  model.renamePart("nerve", "facial nerve");
  EXPECT_EQ(legend().structure(), "facial nerve");
  EXPECT_TRUE(measured("facial nerve"));
}
