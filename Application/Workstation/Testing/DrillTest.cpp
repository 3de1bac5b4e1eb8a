#include "GuiTest.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <dlfcn.h>
#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <QComboBox>
#include <QDockWidget>
#include <QDoubleSpinBox>
#include <QLabel>
#include <QLineEdit>
#include <QPushButton>
#include <QStatusBar>
#include <QWheelEvent>

#include <vtkCallbackCommand.h>

#include "Banner.h"
#include "Bind.h"
#include "DrillController.h"

using namespace petrous;
using namespace petrous::workstation;

class Drill : public GuiTest
{
protected:
  /// A stroke of the open case, which another program has deleted.
  void drillAndBringBack()
  {
    auto* banner = window().findChild<Banner*>("unsavedBanner");
    drill(500);
    ASSERT_TRUE(banner->isVisible());
    ASSERT_TRUE(banner->findChild<QPushButton*>("bringBack")->isVisible())
        << banner->text().toStdString();
    banner->findChild<QPushButton*>("bringBack")->click();
    EXPECT_TRUE(waitFor([&] { return !banner->isVisible() && settled(); }))
        << banner->text().toStdString();
  }
};

TEST_F(Drill, AStrokeRemovesBoneAndIsSavedAtOnce)
{
  saveBall("ball");
  openWindow();
  const QImage before = picture();
  drill(800, 30);
  const QImage after = picture();
  EXPECT_GT(differentPixels(before, after, 12), 200);
  const auto saved = library().open("ball");
  ASSERT_EQ(saved.dissection.strokes().size(), 1u);
  EXPECT_EQ(saved.applied(), 1u);
  EXPECT_GT(saved.dissection.strokes().front()->info.removed, 0.5);
  EXPECT_TRUE(saved.dissection.strokes().front()->info.camera.has_value());
  EXPECT_GT(saved.dissection.strokes().front()->info.duration, 0.5);
  EXPECT_FALSE(window().model().unsaved());
}

TEST_F(Drill, ADragWithoutDrillModeCutsNothing)
{
  saveBall("ball");
  openWindow();
  const QPoint middle = view().rect().center();
  QTest::mousePress(&view(), Qt::LeftButton, Qt::NoModifier, middle);
  QTest::qWait(200);
  QTest::mouseRelease(&view(), Qt::LeftButton, Qt::NoModifier, middle);
  EXPECT_TRUE(window().model().value().dissection.strokes().empty());
}

TEST_F(Drill, UndoBringsThePictureBackAndRedoTheHole)
{
  saveBall("ball");
  openWindow();
  const QImage whole = picture();
  drill(700, 20);
  QTest::keyClick(&view(), Qt::Key_D); // hides the tool
  const QImage drilled = picture();
  ASSERT_GT(differentPixels(whole, drilled, 12), 100);
  ASSERT_TRUE(action("Undo")->isEnabled());
  QTest::keyClick(&window(), Qt::Key_Z, Qt::ControlModifier);
  EXPECT_EQ(differentPixels(whole, picture()), 0);
  EXPECT_EQ(window().model().value().applied(), 0u);
  ASSERT_TRUE(action("Redo")->isEnabled());
  QTest::keyClick(&window(), Qt::Key_Z, Qt::ControlModifier | Qt::ShiftModifier);
  EXPECT_EQ(differentPixels(drilled, picture()), 0);
}

TEST_F(Drill, StrokesAreNumberedAsTheHistoryHasThem)
{
  saveBall("ball");
  openWindow();
  drill(600);
  ASSERT_TRUE(strokeEnds());
  action("Undo")->trigger();
  EXPECT_TRUE(
      waitFor([this] { return window().statusBar()->currentMessage() == "Stroke 1 undone"; }));
  drill(600);
  ASSERT_TRUE(strokeEnds());
  ASSERT_EQ(window().model().value().dissection.strokes().size(), 2u) << "the first is set aside";
  ASSERT_EQ(window().model().value().applied(), 1u);
  action("Undo")->trigger();
  EXPECT_TRUE(
      waitFor([this] { return window().statusBar()->currentMessage() == "Stroke 2 undone"; }));
  action("Redo")->trigger();
  EXPECT_TRUE(waitFor(
      [this] { return window().statusBar()->currentMessage() == "Stroke 2 drilled again"; }));
}

TEST_F(Drill, AFreshWindowShowsTheSameHole)
{
  saveBall("ball");
  openWindow();
  drill(700, 20);
  QTest::keyClick(&view(), Qt::Key_D);
  const QImage before = picture();
  closeWindow();
  openWindow("ball");
  ASSERT_EQ(window().model().value().applied(), 1u);
  EXPECT_EQ(differentPixels(before, picture()), 0);
}

TEST_F(Drill, IsHeardWhereTheUserWantsItAndOnlyWhileItRuns)
{
  void* library = ::dlopen(PETROUS_STANDIN_PORTAUDIO, RTLD_NOW | RTLD_LOCAL);
  ASSERT_NE(library, nullptr);
  qputenv("PETROUS_PORTAUDIO", PETROUS_STANDIN_PORTAUDIO);
  const auto next = reinterpret_cast<unsigned long (*)(float*)>(::dlsym(library, "standin_play"));
  float loudest = 0.0F;
  const auto plays = [&](int blocks) // some of the card's
  {
    std::vector<float> samples(4096);
    loudest = 0.0F;
    unsigned long count = 0;
    for (int n = 0; n < blocks; ++n)
    {
      count = next(samples.data());
      for (unsigned long i = 0; i < count; ++i)
        loudest = std::max(loudest, std::abs(samples[i]));
    }
    return count > 0;
  };
  saveBall("ball");
  openWindow();
  EXPECT_FALSE(action("Sound of the drill")->isChecked());
  EXPECT_FALSE(plays(1)) << "nothing is loaded before it is wanted";
  action("Sound of the drill")->trigger();
  ASSERT_TRUE(waitFor([&] { return plays(1); }));
  EXPECT_EQ(loudest, 0.0F);
  leave();
  QTest::keyClick(&view(), Qt::Key_D);
  QTest::keyPress(&view(), Qt::Key_Space);
  EXPECT_TRUE(waitFor([this] { return window().model().drilling(); }));
  EXPECT_TRUE(waitFor([&] { return plays(20) && loudest > 0.1F; }));
  QTest::keyRelease(&view(), Qt::Key_Space);
  EXPECT_TRUE(strokeEnds());
  EXPECT_TRUE(waitFor([&] { return plays(400) && loudest == 0.0F; })) << "it runs down";
  closeWindow();
  EXPECT_FALSE(plays(1));
  openWindow();
  EXPECT_TRUE(action("Sound of the drill")->isChecked()) << "as the user left it";
  EXPECT_TRUE(waitFor([&] { return plays(1); }));
  action("Sound of the drill")->trigger();
  EXPECT_FALSE(plays(1));
  qputenv("PETROUS_PORTAUDIO", "/nowhere/libportaudio.so");
  action("Sound of the drill")->trigger();
  EXPECT_TRUE(waitFor([this] { return !action("Sound of the drill")->isChecked(); }));
  EXPECT_TRUE(window().statusBar()->currentMessage().contains("libportaudio2"));
  qunsetenv("PETROUS_PORTAUDIO");
  ::dlclose(library);
}

TEST_F(Drill, TheSpaceBarDrillsWithoutAMouse)
{
  saveBall("ball");
  openWindow();
  leave();
  QTest::keyClick(&view(), Qt::Key_D);
  QTest::keyPress(&view(), Qt::Key_Space);
  EXPECT_TRUE(cuts());
  QTest::qWait(500);
  QTest::keyRelease(&view(), Qt::Key_Space);
  EXPECT_TRUE(strokeEnds());
  ASSERT_EQ(window().model().value().dissection.strokes().size(), 1u);
  EXPECT_GT(window().model().value().removedVolume(), 0.0);
}

// The burr is made in another thread; who presses before it comes need not press again.
TEST_F(Drill, ABurrThatComesUnderTheHeldButtonDrills)
{
  saveBall("ball");
  openWindow();
  const QPoint middle = view().rect().center();
  auto* size = window().findChild<QDoubleSpinBox*>("burrDiameter");
  ASSERT_NE(size, nullptr);
  size->setValue(3.5); // its points are not made yet
  QTest::mouseMove(&view(), middle);
  QTest::keyClick(&view(), Qt::Key_D);
  QTest::mousePress(&view(), Qt::LeftButton, Qt::NoModifier, middle);
  EXPECT_TRUE(cuts());
  QTest::qWait(300);
  QTest::mouseRelease(&view(), Qt::LeftButton, Qt::NoModifier, middle);
  EXPECT_TRUE(strokeEnds());
  EXPECT_EQ(window().model().value().dissection.strokes().size(), 1U);

  // Released before it came: it comes and does not drill.
  size->setValue(5.5);
  ASSERT_TRUE(waitFor([this] { return !window().model().touching(); }));
  QTest::mousePress(&view(), Qt::LeftButton, Qt::NoModifier, middle);
  QTest::mouseRelease(&view(), Qt::LeftButton, Qt::NoModifier, middle);
  QTest::mouseMove(&view(), middle + QPoint(1, 0));
  EXPECT_TRUE(waitFor([this] { return window().model().touching(); }));
  QTest::qWait(200);
  EXPECT_FALSE(window().model().drilling());
  EXPECT_EQ(window().model().value().dissection.strokes().size(), 1U);
}

TEST_F(Drill, TheStatusBarKnowsOfAStrokeThatIsOpen)
{
  saveBall("ball");
  openWindow();
  const auto sum = [this]
  {
    for (const QLabel* label : window().statusBar()->findChildren<QLabel*>())
      if (label->toolTip() == "What was drilled so far")
        return label->text();
    return QString();
  };
  EXPECT_EQ(sum(), "nothing drilled");
  leave();
  QTest::keyClick(&view(), Qt::Key_D);
  for (const QString open : {"drilling the first stroke", "removed, drilling"})
  {
    QTest::keyPress(&view(), Qt::Key_Space);
    EXPECT_TRUE(waitFor([this] { return window().model().drilling(); }));
    EXPECT_TRUE(sum().endsWith(open)) << sum().toStdString();
    EXPECT_TRUE(cuts());
    QTest::keyRelease(&view(), Qt::Key_Space);
    EXPECT_TRUE(strokeEnds());
    EXPECT_TRUE(sum().endsWith("removed")) << sum().toStdString();
  }
}

TEST_F(Drill, AnotherBurrIsTakenUpAndDrillsAWiderHole)
{
  saveBall("ball");
  openWindow();
  drill(500);
  leave(); // to the field of the diameter
  window().findChild<QDoubleSpinBox*>("burrDiameter")->setValue(6.0);
  EXPECT_FALSE(window().model().touching());
  EXPECT_TRUE(waitFor([this] { return window().model().touching(); })) << "by itself";
  EXPECT_FALSE(window().model().drilling());
  drill(500);
  const auto& strokes = window().model().value().dissection.strokes();
  ASSERT_EQ(strokes.size(), 2u);
  EXPECT_EQ(strokes.back()->info.burr.diameter, 6.0);
  EXPECT_GT(strokes.back()->info.removed, 0.1);
}

TEST_F(Drill, TheWheelPressesTheBurrIntoTheBone)
{
  saveBall("ball");
  openWindow();
  QTest::keyClick(&view(), Qt::Key_D);
  QTest::keyClick(&view(), Qt::Key_M);
  const QPoint middle = view().rect().center();
  QTest::mouseMove(&view(), middle + QPoint(3, 0)); // the pointer may be there from the last test
  QTest::mouseMove(&view(), middle);
  ASSERT_TRUE(waitFor([this] { return window().model().touching(); }));
  const auto before = view().picture().camera();
  const auto turn = [&](int notches)
  {
    QWheelEvent wheel(middle, view().mapToGlobal(middle), {}, {0, 120 * notches}, Qt::NoButton,
                      Qt::NoModifier, Qt::NoScrollPhase, false);
    QApplication::sendEvent(&view(), &wheel);
  };
  turn(12); // 3 mm: through the air in front of the bone, and below its surface
  EXPECT_EQ(view().picture().camera().position, before.position);
  EXPECT_TRUE(window().model().value().dissection.mask().untouched());
  QTest::keyPress(&view(), Qt::Key_Space);
  EXPECT_TRUE(waitFor(
      [&]
      {
        turn(1); // if it was taken up later than it was pressed
        return !window().model().value().dissection.mask().untouched();
      }));
  QTest::keyRelease(&view(), Qt::Key_Space);
  EXPECT_TRUE(strokeEnds());
  EXPECT_EQ(window().model().value().dissection.strokes().size(), 1u);
  QTest::keyClick(&view(), Qt::Key_M);
  turn(1); // zooms again
  EXPECT_NE(view().picture().camera().position, before.position);
}

// Without putting the burr away: the stroke goes on.
TEST_F(Drill, TheWheelSetsTheThrustWhileTheBurrDrills)
{
  saveBall("ball");
  openWindow();
  auto* thrust = window().findChild<QDoubleSpinBox*>("thrust");
  thrust->setValue(1.0);
  QTest::keyClick(&view(), Qt::Key_D);
  const QPoint middle = view().rect().center();
  QTest::mouseMove(&view(), middle + QPoint(3, 0));
  QTest::mouseMove(&view(), middle);
  ASSERT_TRUE(waitFor([this] { return window().model().touching(); }));
  const auto turn = [&](int notches, Qt::KeyboardModifiers keys = {})
  {
    QWheelEvent wheel(middle, view().mapToGlobal(middle), {}, {0, 120 * notches}, Qt::NoButton,
                      keys, Qt::NoScrollPhase, false);
    QApplication::sendEvent(&view(), &wheel);
  };
  const auto before = view().picture().camera();
  QTest::keyPress(&view(), Qt::Key_Space);
  ASSERT_TRUE(waitFor([this] { return window().model().drilling(); }));
  turn(3);
  EXPECT_DOUBLE_EQ(thrust->value(), 2.5);
  turn(-1, Qt::ShiftModifier);
  EXPECT_DOUBLE_EQ(thrust->value(), 2.4);
  EXPECT_EQ(view().picture().camera().position, before.position) << "it does not zoom";
  EXPECT_TRUE(window().model().drilling());
  EXPECT_TRUE(waitFor([this] { return !window().model().value().dissection.mask().untouched(); }));
  QTest::keyRelease(&view(), Qt::Key_Space);
  EXPECT_TRUE(strokeEnds());
  EXPECT_EQ(window().model().value().dissection.strokes().size(), 1u);
  turn(1); // zooms again
  EXPECT_NE(view().picture().camera().position, before.position);
}

// The coupling differs between a set thrust and the wheel, and with the thrust below 0.4 N, from
// which on it is the stiffest.
TEST_F(Drill, ABurrThatNeedsAnotherCouplingIsTakenUpAgainWhereItIs)
{
  saveBall("ball");
  openWindow();
  auto* thrust = window().findChild<QDoubleSpinBox*>("thrust");
  thrust->setValue(1.0);
  QTest::keyClick(&view(), Qt::Key_D);
  QTest::mouseMove(&view(), view().rect().center());
  const auto center = [this] { return view().display().tool()->center; };
  const auto comes = [this]
  { return waitFor([this] { return view().display().tool().has_value(); }); };
  const auto height = [&] { return (center() - kBallCenter).norm() - kBallRadius; };
  constexpr double kHover = 2.0 + 1.0; // mm, radius and lift
  ASSERT_TRUE(comes());
  ASSERT_TRUE(waitFor([&] { return std::abs(height() - kHover) < 0.3; }));
  QTest::qWait(300); // it arrives
  leave();           // to the tool bar
  const Eigen::Vector3d before = center();
  QSignalSpy gone(window().findChild<DrillController*>(), &DrillController::toolGone);
  for (const double newtons : {0.2, 0.1})
  {
    SCOPED_TRACE(newtons);
    gone.clear();
    thrust->setValue(newtons + 0.1);
    thrust->setValue(newtons);
    EXPECT_TRUE(window().model().touching());
    EXPECT_EQ(gone.size(), 0) << "not at each step";
    EXPECT_TRUE(waitFor([&] { return !gone.isEmpty() && window().model().touching(); }));
    EXPECT_TRUE(comes());
    EXPECT_LT((center() - before).norm(), 0.1);
    EXPECT_FALSE(window().model().drilling());
  }
  QTest::keyClick(&view(), Qt::Key_M);
  EXPECT_TRUE(window().model().touching());
  EXPECT_TRUE(comes());
  EXPECT_LT((center() - before).norm(), 0.1);
  gone.clear();
  thrust->setValue(2.0); // which does not press there
  QTest::qWait(600);
  EXPECT_EQ(gone.size(), 0);
  EXPECT_TRUE(window().model().value().dissection.strokes().empty());
}

// With the wheel the burr lies on the bone; a larger one there would be in it.
TEST_F(Drill, ALargerBurrIsDrawnBackFromTheBoneThatASmallerOneTouches)
{
  saveBall("ball");
  openWindow();
  auto* diameter = window().findChild<QDoubleSpinBox*>("burrDiameter");
  diameter->setValue(3.0);
  QTest::keyClick(&view(), Qt::Key_D);
  QTest::keyClick(&view(), Qt::Key_M);
  const QPoint middle = view().rect().center();
  QTest::mouseMove(&view(), middle + QPoint(3, 0));
  QTest::mouseMove(&view(), middle);
  const auto comes = [this]
  { return waitFor([this] { return view().display().tool().has_value(); }); };
  const auto height = [&]
  { return (view().display().tool()->center - kBallCenter).norm() - kBallRadius; };
  ASSERT_TRUE(comes());
  QWheelEvent wheel(middle, view().mapToGlobal(middle), {}, {0, 120 * 8}, Qt::NoButton,
                    Qt::NoModifier, Qt::NoScrollPhase, false);
  QApplication::sendEvent(&view(), &wheel); // 2 mm
  ASSERT_TRUE(waitFor([&] { return std::abs(height() - 1.5) < 0.3; })) << height();
  const auto line = view().sightLine(middle);
  leave();
  diameter->setValue(6.0);
  EXPECT_FALSE(window().model().touching());
  ASSERT_TRUE(waitFor([this] { return window().model().touching(); }));
  ASSERT_TRUE(comes());
  QTest::qWait(300);
  EXPECT_GT(height(), 3.0 - 0.3);
  EXPECT_LT(height(), 1.5 + 2.0 + 0.3) << "two steps back";
  const Eigen::Vector3d offset = view().display().tool()->center - line.origin;
  EXPECT_LT(offset.cross(line.direction).norm(), 0.3);
  EXPECT_TRUE(window().model().value().dissection.mask().untouched());
}

// The thrust changes in a stroke, and the coupling after it.
TEST_F(Drill, AStrokeWithAnotherThrustIsOneAndTheDrillIsReadyAfterIt)
{
  saveBall("ball");
  openWindow();
  auto* thrust = window().findChild<QDoubleSpinBox*>("thrust");
  thrust->setValue(0.3);
  QTest::keyClick(&view(), Qt::Key_D);
  const QPoint middle = view().rect().center();
  QTest::mouseMove(&view(), middle);
  ASSERT_TRUE(waitFor([this] { return window().model().touching(); }));
  QTest::mousePress(&view(), Qt::LeftButton, Qt::NoModifier, middle);
  ASSERT_TRUE(cuts());
  QSignalSpy gone(window().findChild<DrillController*>(), &DrillController::toolGone);
  thrust->setValue(1.0);
  QTest::qWait(700); // longer than a change of the thrust waits
  EXPECT_TRUE(window().model().drilling());
  EXPECT_EQ(gone.size(), 0);
  QTest::mouseRelease(&view(), Qt::LeftButton, Qt::NoModifier, middle);
  ASSERT_TRUE(strokeEnds());
  ASSERT_TRUE(waitFor([&] { return !gone.isEmpty() && window().model().touching(); }));
  EXPECT_FALSE(window().model().drilling());
  EXPECT_EQ(window().model().value().dissection.strokes().size(), 1U);
  QTest::mousePress(&view(), Qt::LeftButton, Qt::NoModifier, middle); // without a move
  EXPECT_TRUE(cuts());
  QTest::mouseRelease(&view(), Qt::LeftButton, Qt::NoModifier, middle);
  EXPECT_TRUE(strokeEnds());
  EXPECT_EQ(window().model().value().dissection.strokes().size(), 2U);
}

TEST_F(Drill, ReturnAndEscapeInANumberGiveTheKeysBackToTheView)
{
  saveBall("ball");
  openWindow();
  int visible = 0;
  for (auto* box : window().findChildren<QAbstractSpinBox*>())
  {
    if (!box->isVisible() || !box->isEnabled())
      continue;
    SCOPED_TRACE(box->objectName().toStdString());
    ++visible;
    for (const Qt::Key key : {Qt::Key_Return, Qt::Key_Enter, Qt::Key_Escape})
    {
      box->setFocus();
      ASSERT_EQ(QApplication::focusWidget(), box);
      QTest::keyClick(box, key);
      ASSERT_EQ(QApplication::focusWidget(), &view());
      QTest::keyClick(QApplication::focusWidget(), Qt::Key_D);
      EXPECT_TRUE(action("Drill")->isChecked());
      QTest::keyClick(QApplication::focusWidget(), Qt::Key_D);
    }
    const QString before = box->text();
    box->setFocus();
    box->selectAll();
    QTest::keyClicks(box, "7");
    QTest::keyClick(box, Qt::Key_Escape);
    EXPECT_EQ(box->text().toStdString(), before.toStdString()) << "what was typed is dropped";
  }
  EXPECT_GE(visible, 4); // burr, speed, thrust, threshold
}

TEST_F(Drill, AChoiceGivesTheKeysBackToTheView)
{
  saveBall("ball");
  openWindow();
  int visible = 0;
  for (auto* box : window().findChildren<QComboBox*>())
  {
    if (!box->isVisible() || !box->isEnabled())
      continue;
    SCOPED_TRACE(box->objectName().toStdString());
    ++visible;
    box->setFocus();
    emit box->activated(box->currentIndex()); // as a click in its list does
    EXPECT_EQ(QApplication::focusWidget(), &view());
  }
  EXPECT_GE(visible, 1); // the burr's kind
}

// 3 is a standard view's key.
TEST_F(Drill, AKeyForAViewAfterTheThresholdChangesNoThreshold)
{
  saveBall("ball");
  openWindow();
  auto* box = window().findChild<QDoubleSpinBox*>("isoBox");
  box->setFocus();
  box->selectAll();
  QTest::keyClicks(box, "300");
  QTest::keyClick(box, Qt::Key_Return);
  ASSERT_TRUE(waitFor([this] { return window().model().value().iso == 300.0; }));
  QTest::keyClick(QApplication::focusWidget(), Qt::Key_3);
  QTest::mouseClick(&view(), Qt::LeftButton, Qt::NoModifier, view().rect().center());
  QTest::qWait(3 * Bindings::kSettle);
  EXPECT_EQ(box->text().toStdString().substr(0, 3), "300");
  EXPECT_EQ(window().model().value().iso, 300.0);

  box->setFocus();
  box->selectAll();
  QTest::keyClicks(box, "7");
  QTest::keyClick(box, Qt::Key_Escape);
  QWheelEvent wheel(QPointF(5, 5), box->mapToGlobal(QPoint(5, 5)), {}, {0, 120}, Qt::NoButton,
                    Qt::NoModifier, Qt::NoScrollPhase, false);
  QApplication::sendEvent(box, &wheel);
  QTest::qWait(3 * Bindings::kSettle);
  EXPECT_EQ(window().model().value().iso, 300.0);
  EXPECT_EQ(QApplication::focusWidget(), &view());
  // Nor does it move a slider that was not clicked.
  int sliders = 0;
  for (auto* dock : window().findChildren<QDockWidget*>())
    for (auto* slider : dock->findChildren<QSlider*>())
    {
      const int before = slider->value();
      QWheelEvent turn(QPointF(5, 5), slider->mapToGlobal(QPoint(5, 5)), {}, {0, 120}, Qt::NoButton,
                       Qt::NoModifier, Qt::NoScrollPhase, false);
      QApplication::sendEvent(slider, &turn);
      EXPECT_EQ(slider->value(), before) << slider->objectName().toStdString();
      ++sliders;
    }
  EXPECT_GT(sliders, 2);
  QTest::qWait(3 * Bindings::kSettle);
  EXPECT_EQ(window().model().value().iso, 300.0);
}

TEST_F(Drill, AnUndoUnderTheHeldButtonLiftsTheDrillUntilItIsPressedAnew)
{
  saveBall("ball");
  openWindow();
  QTest::keyClick(&view(), Qt::Key_D);
  const QPoint middle = view().rect().center();
  QTest::mouseMove(&view(), middle);
  const auto press = [&]
  {
    QTest::mousePress(&view(), Qt::LeftButton, Qt::NoModifier, middle);
    return cuts();
  };
  ASSERT_TRUE(press());
  QTest::keyClick(&window(), Qt::Key_Z, Qt::ControlModifier);
  ASSERT_TRUE(
      waitFor([this] { return window().model().value().dissection.history().ahead() > 0; }));
  for (int n = 0; n < 20; ++n) // under the held button
  {
    const QMouseEvent move(QEvent::MouseMove, middle + QPoint(n % 2, 0), Qt::LeftButton,
                           Qt::LeftButton, Qt::NoModifier);
    QMouseEvent sent = move;
    QApplication::sendEvent(&view(), &sent);
    QTest::qWait(20);
    EXPECT_FALSE(window().model().drilling());
  }
  EXPECT_EQ(window().model().value().dissection.strokes().size(), 1u);
  QTest::mouseRelease(&view(), Qt::LeftButton, Qt::NoModifier, middle);
  EXPECT_TRUE(settled());
  EXPECT_EQ(window().model().value().applied(), 0u);
  EXPECT_TRUE(press());
  QTest::mouseRelease(&view(), Qt::LeftButton, Qt::NoModifier, middle);
  EXPECT_TRUE(strokeEnds());
}

// As when a dialog closes over it.
TEST_F(Drill, ThePointerThatEntersTheViewTakesTheToolUpWithoutAMove)
{
  saveBall("ball");
  openWindow();
  QTest::keyClick(&view(), Qt::Key_D);
  window().findChild<QDoubleSpinBox*>("isoBox")->setValue(320.0);
  ASSERT_TRUE(waitFor([this] { return window().model().value().iso == 320.0; }));
  ASSERT_TRUE(waitFor([this] { return !window().model().touching(); }));
  const QPointF middle = view().rect().center();
  QEnterEvent enter(middle, middle, view().mapToGlobal(middle.toPoint()));
  QApplication::sendEvent(&view(), &enter);
  EXPECT_TRUE(waitFor([this] { return window().model().touching(); }));
}

TEST_F(Drill, TheBurrComesWhereThePointerRestsWhenTheDrillIsTurnedOn)
{
  saveBall("ball");
  openWindow();
  QTest::mouseMove(&view(), view().rect().center());
  QTest::qWait(100);
  EXPECT_FALSE(view().display().tool());
  QTest::keyClick(&view(), Qt::Key_D);
  ASSERT_TRUE(waitFor([this] { return view().display().tool().has_value(); }));
  EXPECT_NEAR((view().display().tool()->center - kBallCenter).norm(), kBallRadius + 2.0 + 1.0, 0.3);
}

// Nothing can be seen of a burr that has no place.
TEST_F(Drill, SaysWhereTheBurrIsAwaitedIfThePointerIsElsewhere)
{
  saveBall("ball");
  openWindow();
  QTest::keyClick(&view(), Qt::Key_D);
  EXPECT_TRUE(
      waitFor([this] { return window().statusBar()->currentMessage().contains("3D view"); }))
      << window().statusBar()->currentMessage().toStdString();
  EXPECT_FALSE(view().display().tool());
  QTest::keyClick(&view(), Qt::Key_D);
  EXPECT_EQ(window().statusBar()->currentMessage(), "") << "the tool is put away";
}

TEST_F(Drill, TheButtonShowsWhetherTheWheelLeads)
{
  saveBall("ball");
  openWindow();
  auto* button = window().findChild<QWidget*>("wheelButton");
  const QImage off = button->grab().toImage();
  QTest::keyClick(&view(), Qt::Key_M);
  EXPECT_GT(differentPixels(off, button->grab().toImage(), 20), off.width() * off.height() / 3);
}

// The burr is in a hole of its own size, and the pointer moves on over untouched bone and away.
TEST_F(Drill, ThePointerTakesTheBurrOutOfItsHole)
{
  saveBall("ball");
  openWindow();
  drill(3000);
  auto* controller = window().findChild<DrillController*>();
  ASSERT_NE(controller, nullptr);
  Eigen::Vector3d burr(0.0, 0.0, 0.0);
  QStringList faults;
  QObject::connect(controller, &DrillController::toolMoved, &window(),
                   [&](const presenters::MeasuredTool&, const haptics::Pose& pose)
                   { burr = pose.position; });
  QObject::connect(controller, &DrillController::faulted, &window(),
                   [&](const QString& fault) { faults += fault; });
  const QPoint middle = view().rect().center();
  const auto beside = [&](const QPoint& at)
  {
    const auto line = view().sightLine(at);
    return (burr - line.origin).cross(line.direction).norm();
  };
  for (const QPoint aside : {QPoint(60, 0), QPoint(0, 0), QPoint(-50, 30), QPoint(10, -60)})
  {
    const QPoint at = middle + aside;
    QTest::mouseMove(&view(), at);
    EXPECT_TRUE(waitFor([&] { return beside(at) < 0.5; }))
        << aside.x() << ' ' << aside.y() << ": " << beside(at) << " mm";
  }
  EXPECT_TRUE(faults.filter("inside tissue").isEmpty()) << faults.join('/').toStdString();
}

// Beyond the edge the burr's target is invisible: it lifts there, at all four edges alike.
TEST_F(Drill, ABurrThatIsDraggedOutOfTheViewLiftsAtTheEdge)
{
  saveBall("ball");
  openWindow();
  QTest::keyClick(&view(), Qt::Key_D);
  const auto move = [this](const QPoint& at)
  {
    QMouseEvent event(QEvent::MouseMove, at, Qt::LeftButton, Qt::LeftButton, Qt::NoModifier);
    QApplication::sendEvent(&view(), &event);
    QTest::qWait(60);
  };
  const QRect all = view().rect();
  const QPoint middle = all.center();
  const auto middleLine = view().sightLine(std::nullopt);
  int pressed = 0;
  int atMiddle = 0;
  QObject::connect(&view(), &ThreeDView::drillPressed, &window(), [&] { ++pressed; });
  const auto look = [&](const interaction::PickRay& line)
  { atMiddle += (line.direction - middleLine.direction).norm() < 0.01; };
  QObject::connect(&view(), &ThreeDView::pointed, &window(), look);
  vtkNew<vtkCallbackCommand> aimed;
  std::function<void()> lookAgain = [&] { look(view().tool().GetPickRay()); };
  aimed->SetClientData(&lookAgain);
  aimed->SetCallback([](vtkObject*, unsigned long, void* then, void*)
                     { (*static_cast<std::function<void()>*>(then))(); });
  view().tool().AddObserver(vtkCommand::InteractionEvent, aimed);
  struct Way
  {
    QPoint inside, outside;
  };
  const Way ways[] = {{{2, middle.y()}, {-1, middle.y()}},
                      {{middle.x(), 2}, {middle.x(), -1}},
                      {{all.right() - 2, middle.y()}, {all.right() + 1, middle.y()}},
                      {{middle.x(), all.bottom() - 2}, {middle.x(), all.bottom() + 1}}};
  for (const auto& [inside, outside] : ways)
  {
    SCOPED_TRACE(outside.x());
    SCOPED_TRACE(outside.y());
    QTest::mouseMove(&view(), inside);
    QTest::mousePress(&view(), Qt::LeftButton, Qt::NoModifier, inside);
    EXPECT_TRUE(view().tool().GetDrilling());
    pressed = atMiddle = 0;
    move(outside);
    EXPECT_FALSE(view().tool().GetDrilling());
    EXPECT_TRUE(strokeEnds());
    move(inside); // with the button still held
    EXPECT_FALSE(view().tool().GetDrilling());
    EXPECT_EQ(pressed, 0);
    EXPECT_EQ(atMiddle, 0) << "the burr leapt to the middle";
    QTest::mouseRelease(&view(), Qt::LeftButton, Qt::NoModifier, inside);
  }
  EXPECT_TRUE(window().model().value().dissection.mask().untouched());
  view().tool().RemoveObserver(aimed);
}

TEST_F(Drill, ASaveThatIsRefusedKeepsTheWorkOpenAndCanGoElsewhere)
{
  saveBall("ball");
  openWindow();
  auto other = library().open("ball");
  library().save(other); // by another program
  auto* banner = window().findChild<Banner*>("unsavedBanner");
  EXPECT_FALSE(banner->isVisible());
  drill(500);
  EXPECT_TRUE(banner->isVisible());
  EXPECT_TRUE(banner->text().contains("ball")) << banner->text().toStdString();
  EXPECT_TRUE(window().model().unsaved());
  EXPECT_TRUE(window().windowTitle().startsWith(QString::fromUtf8("•")));
  EXPECT_EQ(window().model().value().dissection.strokes().size(), 1u);
  EXPECT_TRUE(library().open("ball").dissection.strokes().empty());

  // No modal dialog blocks the window; the next stroke cannot be saved either.
  EXPECT_EQ(QApplication::activeModalWidget(), nullptr);
  drill(300, 40);
  EXPECT_EQ(QApplication::activeModalWidget(), nullptr);
  EXPECT_EQ(window().findChildren<Banner*>("unsavedBanner").size(), 1);

  // Quitting does not lose it, and shows no dialog either.
  auto* quit = banner->findChild<QPushButton*>("quitUnsaved");
  EXPECT_FALSE(quit->isVisible());
  EXPECT_FALSE(window().close());
  EXPECT_TRUE(quit->isVisible());

  // Saves under another name.
  QTimer answer;
  QObject::connect(&answer, &QTimer::timeout, &answer,
                   [&answer]
                   {
                     auto* ask = qobject_cast<QDialog*>(QApplication::activeModalWidget());
                     if (!ask)
                       return;
                     answer.stop();
                     ask->accept(); // with the name offered
                   });
  answer.start(20);
  banner->findChild<QPushButton*>("saveAsOther")->click();
  EXPECT_TRUE(settled());
  EXPECT_FALSE(banner->isVisible());
  EXPECT_EQ(window().model().value().dissection.strokes().size(),
            library().open("ball 2").dissection.strokes().size());
  EXPECT_TRUE(window().close());
}

// The case comes back as it was deleted, and then gets what was drilled since.
TEST_F(Drill, ACaseThatAnotherProgramDeletedIsBroughtBackAndSaved)
{
  saveBall("ball");
  openWindow();
  library::Library other = library();
  other.remove("ball");
  auto* banner = window().findChild<Banner*>("unsavedBanner");
  const auto isOffered = [banner](const char* button)
  { return banner->findChild<QPushButton*>(button)->isVisible(); };
  drill(500);
  ASSERT_TRUE(banner->isVisible());
  EXPECT_TRUE(banner->text().contains(QString::fromUtf8("deleted the case “ball”")))
      << banner->text().toStdString();
  EXPECT_FALSE(banner->text().contains("repeat")) << banner->text().toStdString();
  EXPECT_TRUE(isOffered("bringBack"));
  EXPECT_TRUE(isOffered("saveAsOther"));
  EXPECT_FALSE(isOffered("retrySave")) << "it would fail again";
  EXPECT_FALSE(other.contains("ball"));
  banner->findChild<QPushButton*>("bringBack")->click();
  EXPECT_TRUE(waitFor([&] { return !banner->isVisible() && settled(); }))
      << banner->text().toStdString();
  EXPECT_TRUE(other.deleted().empty());
  EXPECT_EQ(other.open("ball").dissection.strokes().size(), 1u);
  drill(300, 40); // and goes on
  EXPECT_FALSE(banner->isVisible()) << banner->text().toStdString();
  EXPECT_EQ(other.open("ball").dissection.strokes().size(), 2u);

  // A save that fails for another reason can be tried again.
  auto changed = other.open("ball");
  other.save(changed);
  drill(300, -40);
  EXPECT_TRUE(isOffered("retrySave"));
  EXPECT_FALSE(isOffered("bringBack"));
}

// A later case of its name was deleted after it; that one stays deleted.
TEST_F(Drill, OfTwoDeletedCasesOfOneNameTheOpenOneIsBroughtBack)
{
  saveBall("ball");
  openWindow();
  library::Library other = library();
  const std::string id = other.open("ball").id;
  other.remove("ball");
  saveBall("ball");
  const std::string later = other.open("ball").id;
  ASSERT_NE(later, id);
  other.remove("ball");
  ASSERT_NO_FATAL_FAILURE(drillAndBringBack());
  const scene::Case back = other.open("ball");
  EXPECT_EQ(back.id, id);
  EXPECT_EQ(back.dissection.strokes().size(), 1u);
  EXPECT_EQ(other.deletedName(later), "ball");
}

// Its journal, which this window writes under the old name, is not another program's.
TEST_F(Drill, ACaseThatWasRenamedAndDeletedIsBroughtBackUnderItsNewName)
{
  saveBall("ball");
  openWindow();
  library::Library other = library();
  const std::string id = other.open("ball").id;
  other.rename("ball", "sphere");
  other.remove("sphere");
  ASSERT_NO_FATAL_FAILURE(drillAndBringBack());
  ASSERT_TRUE(other.contains("sphere"));
  const scene::Case back = other.open("sphere");
  EXPECT_EQ(back.id, id);
  EXPECT_EQ(back.dissection.strokes().size(), 1u);
  EXPECT_FALSE(other.contains("ball"));
}

// It ends when it is chosen again and with the program; another burr begins another file.
TEST_F(Drill, ASessionIsRecordedAndTheCommandRepeatsItToTheBit)
{
  saveBall("copy");
  saveBall("ball");
  openWindow("ball");
  auto* label = window().findChild<QLabel*>("recording");
  EXPECT_FALSE(label->isVisible());
  const auto first = record();
  EXPECT_EQ(first.parent_path(), folder() / "library" / "recordings");
  EXPECT_EQ(first.extension(), ".ticks");
  EXPECT_TRUE(label->isVisible());
  EXPECT_TRUE(label->text().contains("ball")) << label->text().toStdString();
  drill(600, 30);
  auto* chosen = action(QString::fromUtf8("Record session…"));
  EXPECT_TRUE(chosen->isChecked());
  chosen->trigger();
  EXPECT_FALSE(chosen->isChecked());
  EXPECT_FALSE(label->isVisible());
  EXPECT_TRUE(window().model().recording().empty());

  const auto second = record(); // with the burr in use
  EXPECT_NE(second, first);
  EXPECT_TRUE(waitFor([this] { return window().model().touching(); }));
  drill(600, -30);
  EXPECT_EQ(window().model().recording(), second);
  window().findChild<QDoubleSpinBox*>("burrDiameter")->setValue(6.0);
  drill(600, 40);
  const auto third = window().model().recording();
  EXPECT_EQ(third.stem(), second.stem().string() + " (2)");
  closeWindow();

  for (const auto& file : {first, second, third})
  {
    const QJsonObject replay = replayed(file, "copy");
    EXPECT_TRUE(replay["equal"].toBool()) << file;
    EXPECT_TRUE(replay["complete"].toBool()) << file;
  }
  const auto ball = library().open("ball");
  const auto copy = library().open("copy");
  ASSERT_EQ(ball.dissection.strokes().size(), 3u);
  ASSERT_EQ(copy.dissection.strokes().size(), 3u);
  for (std::size_t n = 0; n < 3; ++n)
  {
    EXPECT_GT(ball.dissection.strokes()[n]->info.removed, 0.0);
    EXPECT_EQ(copy.dissection.strokes()[n]->info.removed,
              ball.dissection.strokes()[n]->info.removed);
    EXPECT_EQ(copy.dissection.strokes()[n]->info.duration,
              ball.dissection.strokes()[n]->info.duration);
    EXPECT_EQ(copy.dissection.strokes()[n]->info.burr.diameter,
              ball.dissection.strokes()[n]->info.burr.diameter);
  }
}

TEST_F(Drill, ARecordingThatCannotBeWrittenIsToldAndTheDrillGoesOn)
{
  saveBall("ball");
  openWindow();
  auto* banner = window().findChild<Banner*>("recordingBanner");
  const auto file = record();
  EXPECT_FALSE(banner->isVisible());
  std::filesystem::remove_all(file.parent_path());
  drill(500, 20);
  EXPECT_TRUE(banner->isVisible());
  EXPECT_TRUE(banner->text().contains(".ticks: could not be written"))
      << banner->text().toStdString();
  EXPECT_FALSE(window().findChild<QLabel*>("recording")->isVisible());
  EXPECT_FALSE(action(QString::fromUtf8("Record session…"))->isChecked());
  EXPECT_EQ(library().open("ball").dissection.strokes().size(), 1u);
  banner->findChild<QPushButton*>("dismissRecording")->click();
  EXPECT_FALSE(banner->isVisible());
}

// A view that is pushed down would move under a resting mouse, and the burr with it.
TEST_F(Drill, ABannerMovesNoPictureWhileTheToolIsInTheHandAndWidensNoWindow)
{
  saveBall("ball");
  openWindow();
  auto* banner = window().findChild<Banner*>("unsavedBanner");
  const QSize whole = window().size();
  const QRect before = view().geometry();
  const QPoint corner = view().mapTo(&window(), QPoint());
  QTest::keyClick(&view(), Qt::Key_D);
  const QString name(64, 'a');
  banner->setText("Not saved: /home/" + name + "/objects/" + name + ".nrrd is gone.");
  banner->show();
  QTest::qWait(100);
  EXPECT_TRUE(banner->isVisible());
  EXPECT_EQ(view().geometry(), before);
  EXPECT_EQ(view().mapTo(&window(), QPoint()), corner);
  EXPECT_EQ(window().size(), whole);
  EXPECT_LE(window().minimumSizeHint().width(), whole.width());
  EXPECT_TRUE(banner->text().contains(name));
  EXPECT_FALSE(banner->shownText().contains(name));
  EXPECT_TRUE(banner->shownText().endsWith(".nrrd is gone."));
  EXPECT_EQ(banner->childAt(20, banner->height() / 2)->toolTip(), banner->text());
  picture();
  QTest::keyClick(&view(), Qt::Key_D);
  EXPECT_TRUE(waitFor([&] { return view().mapTo(&window(), QPoint()).y() > corner.y(); }))
      << "it has room of its own once the tool is down";
  banner->hide();
  EXPECT_TRUE(waitFor([&] { return view().geometry() == before; }));
}

// Another program holding the library's lock, or a slow disk.
TEST_F(Drill, NoStrokeWaitsForTheDisk)
{
  saveBall("ball");
  openWindow();
  const std::string path = (folder() / "library" / ".lock").string();
  const int lock = ::open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0600);
  ASSERT_GE(lock, 0);
  ASSERT_EQ(::flock(lock, LOCK_EX), 0);
  const auto end = [this] { return waitFor([this] { return !window().model().drilling(); }); };
  for (const int at : {0, 25})
  {
    if (!action("Drill")->isChecked())
      QTest::keyClick(&view(), Qt::Key_D);
    const QPoint place = view().rect().center() + QPoint(at, 0);
    QTest::mouseMove(&view(), place);
    QTest::mousePress(&view(), Qt::LeftButton, Qt::NoModifier, place);
    EXPECT_TRUE(cuts());
    QTest::mouseRelease(&view(), Qt::LeftButton, Qt::NoModifier, place);
    EXPECT_TRUE(end());
    QTest::qWait(50);
  }
  EXPECT_EQ(window().model().value().dissection.strokes().size(), 2u);
  EXPECT_TRUE(window().model().unsaved());
  EXPECT_TRUE(window().busy());
  action("Undo")->trigger(); // while it is being saved
  EXPECT_TRUE(waitFor([this] { return window().model().value().applied() == 1; }));
  EXPECT_TRUE(library().open("ball").dissection.strokes().empty());
  ASSERT_EQ(::flock(lock, LOCK_UN), 0);
  EXPECT_TRUE(settled());
  EXPECT_EQ(library().open("ball").dissection.strokes().size(), 2u);
  // Later changes are saved when the window closes, which waits for it.
  closeWindow();
  EXPECT_EQ(library().open("ball").applied(), 1u);
  ::close(lock);
}
