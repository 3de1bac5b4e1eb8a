#include <cmath>

#include <QComboBox>
#include <QMenuBar>
#include <QStatusBar>
#include <QWheelEvent>

#include "DrillController.h"
#include "GuiTest.h"
#include "SceneDisplay.h"

using namespace petrous;
using namespace petrous::workstation;

namespace
{

class Handpiece : public GuiTest
{
protected:
  // Takes the burr up in front of the ball.
  void takeBurr()
  {
    saveBall("ball");
    openWindow("ball");
    QTest::mouseMove(&view(), view().rect().center());
    QTest::keyClick(&view(), Qt::Key_D);
    ASSERT_TRUE(waitFor([this] { return view().display().tool().has_value(); }));
  }

  // The shaft in the view's axes: right, up, towards the camera.
  Eigen::Vector3d shaft()
  {
    const auto camera = view().picture().camera();
    const Eigen::Vector3d back = (camera.position - camera.focalPoint).normalized();
    const Eigen::Vector3d right = camera.viewUp.cross(back).normalized();
    const Eigen::Vector3d up = back.cross(right);
    const Eigen::Vector3d axis = view().display().tool()->axisToHand.normalized();
    return {right.dot(axis), up.dot(axis), back.dot(axis)};
  }

  bool shaftComesTo(const std::function<bool(const Eigen::Vector3d&)>& place)
  {
    return waitFor([&] { return view().display().tool() && place(shaft()); });
  }
};

} // namespace

TEST_F(Handpiece, TurnsAndTiltsByKey)
{
  takeBurr();
  ASSERT_TRUE(shaftComesTo([](const auto& at) { return at.x() > 0.1 && at.y() < -0.1; }))
      << "a right hand, from below: " << shaft().transpose();
  for (int n = 0; n < 18; ++n) // 90 degrees
    action("Turn counterclockwise")->trigger();
  EXPECT_TRUE(shaftComesTo([](const auto& at) { return at.x() > 0.1 && at.y() > 0.1; }))
      << shaft().transpose();
  for (int n = 0; n < 8; ++n)
    action("Tilt to the line of sight")->trigger();
  EXPECT_TRUE(shaftComesTo([](const auto& at) { return at.z() > 0.995; })) << shaft().transpose();
  action("As at first")->trigger();
  EXPECT_TRUE(shaftComesTo([](const auto& at) { return at.x() > 0.1 && at.y() < -0.1; }))
      << shaft().transpose();
}

TEST_F(Handpiece, TurnsByAltAndTheWheel)
{
  takeBurr();
  ASSERT_TRUE(shaftComesTo([](const auto& at) { return at.y() < -0.1; }));
  const QPointF at = view().rect().center();
  for (int n = 0; n < 18; ++n)
  {
    QWheelEvent turn(at, view().mapToGlobal(at.toPoint()), {}, {0, 120}, Qt::NoButton,
                     Qt::AltModifier, Qt::NoScrollPhase, false);
    QApplication::sendEvent(&view(), &turn);
  }
  EXPECT_TRUE(shaftComesTo([](const auto& to) { return to.x() > 0.1 && to.y() > 0.1; }))
      << shaft().transpose();
}

TEST_F(Handpiece, AltWithTheWheelLeavesTheMenuBarAlone)
{
  takeBurr();
  const QPointF at = view().rect().center();
  const auto opens = [&](bool turns)
  {
    QTest::keyPress(&view(), Qt::Key_Alt, Qt::AltModifier);
    QWheelEvent turn(at, view().mapToGlobal(at.toPoint()), {}, {0, 120}, Qt::NoButton,
                     Qt::AltModifier, Qt::NoScrollPhase, false);
    if (turns)
      QApplication::sendEvent(&view(), &turn);
    QTest::keyRelease(&view(), Qt::Key_Alt);
    return window().menuBar()->activeAction() != nullptr;
  };
  EXPECT_FALSE(opens(true));
  if (!opens(false))
    GTEST_SKIP() << "the style's menu bar knows no Alt";
  QTest::keyClick(window().menuBar(), Qt::Key_Escape);
  EXPECT_FALSE(opens(true));
}

TEST_F(Handpiece, ChangesTheHandAndRemembersIt)
{
  takeBurr();
  ASSERT_TRUE(shaftComesTo([](const auto& at) { return at.x() > 0.1; }));
  action("In the left hand")->trigger();
  EXPECT_TRUE(shaftComesTo([](const auto& at) { return at.x() < -0.1 && at.y() < -0.1; }))
      << shaft().transpose();
  closeWindow();
  openWindow("ball");
  EXPECT_TRUE(action("In the left hand")->isChecked());
  EXPECT_TRUE(window().findChild<DrillController*>()->leftHand());
}

TEST_F(Handpiece, IsHeldForAnApproachToTheCasesEarAndKeptWithTheCase)
{
  using presenters::SurgicalApproach;
  takeBurr();
  action("Surgical position, right ear")->trigger();
  QTest::mouseMove(&view(), view().rect().center() + QPoint(2, 2)); // the ray of this view
  action("Handpiece: retrosigmoid")->trigger();
  const Eigen::Vector3d shaft =
      presenters::shaftOf(SurgicalApproach::Retrosigmoid, scene::Side::Right, false);
  EXPECT_TRUE(waitFor(
      [&]
      {
        const auto tool = view().display().tool();
        return tool && tool->axisToHand.normalized().dot(shaft) > std::cos(0.05);
      }));
  auto* drill = window().findChild<DrillController*>();
  const auto held = drill->handpiece();
  ASSERT_TRUE(held);

  // From the other side of the head the hand would be behind the picture.
  action("Surgical position, left ear")->trigger();
  action("Handpiece: retrosigmoid")->trigger();
  EXPECT_TRUE(window().statusBar()->currentMessage().contains("look at the right ear first"))
      << window().statusBar()->currentMessage().toStdString();
  EXPECT_TRUE(drill->handpiece() == held) << "it stays";

  action("Save")->trigger();
  ASSERT_TRUE(settled());
  EXPECT_TRUE(library().open("ball").view.handpiece == held);
  closeWindow();
  openWindow("ball");
  EXPECT_TRUE(window().findChild<DrillController*>()->handpiece() == held);
  action("As at first")->trigger();
  EXPECT_FALSE(window().findChild<DrillController*>()->handpiece());
}

TEST_F(Handpiece, ThatWasKeptInTheOtherHandIsMirrored)
{
  scene::Case value = ballCase("ball");
  value.view.handpiece = scene::ViewState::Handpiece{-140.0, 30.0, true};
  library().save(value);
  openWindow("ball");
  const auto held = window().findChild<DrillController*>()->handpiece();
  ASSERT_TRUE(held);
  EXPECT_FALSE(held->isLeft) << "the hand is that of who drills";
  EXPECT_NEAR(held->turn, -40.0, 1e-9);
  EXPECT_EQ(held->tilt, 30.0);
  action("Surgical position, right ear")->trigger();
  action("Save")->trigger();
  ASSERT_TRUE(settled());
  EXPECT_TRUE(library().open("ball").view.handpiece == value.view.handpiece)
      << "what the user did not change stays";
}

TEST_F(Handpiece, DrillsWithTheBurrAloneToo)
{
  saveBall("ball");
  openWindow("ball");
  action("Only the burr is felt")->trigger();
  EXPECT_TRUE(window().findChild<DrillController*>()->burrAlone());
  drill(600, 20);
  EXPECT_GT(window().model().value().removedVolume(), 0.0);
}

TEST_F(Handpiece, AKeyChangesTheKindOfTheBurr)
{
  saveBall("ball");
  openWindow("ball");
  auto& kind = *window().findChild<QComboBox*>("burrKind");
  const int before = kind.currentIndex();
  const int count = kind.count();
  QTest::keyClick(&view(), Qt::Key_L);
  EXPECT_EQ(kind.currentIndex(), (before + 1) % count);
  for (int n = 1; n < count; ++n)
    QTest::keyClick(&view(), Qt::Key_L);
  EXPECT_EQ(kind.currentIndex(), before);
}
