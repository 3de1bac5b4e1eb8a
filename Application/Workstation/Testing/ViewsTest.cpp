#include "GuiTest.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <QAction>
#include <QComboBox>
#include <QDialogButtonBox>
#include <QDockWidget>
#include <QDoubleSpinBox>
#include <QLabel>
#include <QLineEdit>
#include <QMenu>
#include <QPushButton>
#include <QStatusBar>

#include "SliceColumn.h"
#include "SliceController.h"
#include "SliceView.h"
#include "SlicesPanel.h"
#include "ViewArea.h"
#include "petrous/Interaction/OrbitCamera.h"

using namespace petrous;
using namespace petrous::workstation;
using presenters::SliceOrientation;
using presenters::ViewLayout;
using presenters::ViewPane;

namespace
{

class Views : public GuiTest
{
protected:
  void SetUp() override
  {
    saveBall("ball");
    openWindow();
  }
  template <class Widget>
  Widget& widget(const char* name)
  {
    return *window().findChild<Widget*>(name);
  }
  SliceView& axial() { return widget<SliceView>("axialView"); }
  SliceView& coronal() { return widget<SliceView>("coronalView"); }
  SliceView& sagittal() { return widget<SliceView>("sagittalView"); }
  SliceColumn& slices() { return widget<SliceColumn>("slices"); }
  ViewArea& area() { return widget<ViewArea>("viewArea"); }
  void key(int key, Qt::KeyboardModifiers modifiers = Qt::NoModifier)
  {
    ++m_events;
    QTest::keyClick(&window(), Qt::Key(key), modifiers);
  }
  void raise(const char* dock)
  {
    widget<QDockWidget>(dock).show();
    widget<QDockWidget>(dock).raise();
    EXPECT_TRUE(waitFor([&] { return !widget<QDockWidget>(dock).visibleRegion().isEmpty(); }));
  }
  void doubleClick(QWidget& on)
  {
    ++m_events;
    const QPoint at = on.rect().center();
    QTest::mouseDClick(&on, Qt::LeftButton, Qt::NoModifier, at);
    QTest::mouseRelease(&on, Qt::LeftButton, Qt::NoModifier, at);
  }

  int m_events = 0; ///< keys and double clicks of the user so far
};

} // namespace

TEST_F(Views, ADoubleClickEnlargesASliceAndBringsTheLayoutBack)
{
  const QRect before = coronal().geometry();
  const int events = m_events;
  doubleClick(coronal());
  EXPECT_EQ(m_events - events, 1);
  EXPECT_EQ(coronal().size(), area().size());
  EXPECT_FALSE(axial().isVisible());
  EXPECT_FALSE(view().isVisible());
  EXPECT_TRUE(coronal().hasFocus());
  EXPECT_TRUE(action("Enlarge the view")->isChecked());
  doubleClick(coronal());
  EXPECT_EQ(coronal().geometry(), before);
  EXPECT_TRUE(axial().isVisible());
  EXPECT_TRUE(view().isVisible());
}

TEST_F(Views, ADoubleClickEnlargesThe3DViewAndItIsDrawnThere)
{
  const QImage before = picture();
  const int events = m_events;
  doubleClick(view());
  EXPECT_EQ(m_events - events, 1);
  EXPECT_EQ(view().size(), area().size());
  EXPECT_FALSE(axial().isVisible());
  const QImage large = picture();
  EXPECT_GT(large.width(), before.width());
  // The angle of view is that of the height, which is the same.
  EXPECT_GE(pixelsUnlikeTheCorner(large), pixelsUnlikeTheCorner(before));
  EXPECT_GT(pixelsUnlikeTheCorner(large), 1000);
  doubleClick(view());
  EXPECT_TRUE(axial().isVisible());
  EXPECT_EQ(picture().size(), before.size());
}

TEST_F(Views, EscLeavesAnEnlargedView)
{
  const QRect before = coronal().geometry();
  doubleClick(coronal());
  ASSERT_EQ(coronal().size(), area().size());
  QTest::keyClick(&coronal(), Qt::Key_Escape);
  EXPECT_EQ(coronal().geometry(), before);
  EXPECT_TRUE(view().isVisible());
  doubleClick(view());
  ASSERT_FALSE(axial().isVisible());
  QTest::keyClick(&view(), Qt::Key_Escape);
  EXPECT_TRUE(axial().isVisible());
  EXPECT_FALSE(action("Enlarge the view")->isChecked());
  QTest::keyClick(&view(), Qt::Key_Escape); // there is nothing to leave
  EXPECT_FALSE(area().arrangement().enlarged());
}

TEST_F(Views, EscPutsAToolAwayBeforeItLeavesAnEnlargedView)
{
  doubleClick(axial());
  action("Distance")->trigger();
  ASSERT_TRUE(action("Distance")->isChecked());
  QTest::keyClick(&axial(), Qt::Key_Escape);
  EXPECT_FALSE(action("Distance")->isChecked());
  EXPECT_EQ(area().arrangement().enlarged(), ViewPane::Axial);
  QTest::keyClick(&axial(), Qt::Key_Escape);
  EXPECT_FALSE(area().arrangement().enlarged());
}

TEST_F(Views, ANumberGivesTheKeysToAViewThatIsShown)
{
  key(Qt::Key_5, Qt::ControlModifier); // slices alone
  ASSERT_FALSE(view().isVisible());
  auto& exposure = widget<QDoubleSpinBox>("exposure");
  raise("pictureDock");
  QApplication::setActiveWindow(&window());
  exposure.setFocus();
  ASSERT_TRUE(exposure.hasFocus());
  QTest::keyClick(&exposure, Qt::Key_Return);
  EXPECT_TRUE(axial().hasFocus());
  exposure.setFocus();
  QTest::keyClick(&exposure, Qt::Key_Escape);
  EXPECT_TRUE(axial().hasFocus());
}

TEST_F(Views, AChoiceThatIsSteppedThroughByKeysKeepsThem)
{
  raise("pictureDock");
  QApplication::setActiveWindow(&window());
  auto& stereo = widget<QComboBox>("stereoMode");
  stereo.setCurrentIndex(0);
  stereo.setFocus();
  ASSERT_TRUE(stereo.hasFocus());
  QTest::keyClick(&stereo, Qt::Key_Down);
  EXPECT_EQ(stereo.currentIndex(), 1);
  EXPECT_TRUE(stereo.hasFocus());
  QTest::keyClick(&stereo, Qt::Key_Up);
  EXPECT_EQ(stereo.currentIndex(), 0);
  EXPECT_TRUE(stereo.hasFocus());
  QTest::keyClick(&stereo, Qt::Key_Escape);
  EXPECT_TRUE(view().hasFocus());
}

TEST_F(Views, AClickPutsTheCrosshairOnTheSurfaceAndADragDoesNot)
{
  const Eigen::Vector3d before = window().model().crosshair();
  const QPoint middle = view().rect().center();
  QTest::mousePress(&view(), Qt::LeftButton, Qt::NoModifier, middle);
  QTest::mouseMove(&view(), middle + QPoint(12, 0));
  QTest::mouseMove(&view(), middle + QPoint(40, 0));
  QTest::mouseRelease(&view(), Qt::LeftButton, Qt::NoModifier, middle + QPoint(40, 0));
  EXPECT_EQ(window().model().crosshair(), before);
  QTest::mouseClick(&view(), Qt::LeftButton, Qt::NoModifier, middle);
  EXPECT_NEAR((window().model().crosshair() - kBallCenter).norm(), kBallRadius, 0.1);
}

TEST_F(Views, LayoutsHaveKeysAndComeBackInTheNextWindow)
{
  key(Qt::Key_2, Qt::ControlModifier);
  EXPECT_EQ(area().arrangement().layout(), ViewLayout::FourUp);
  EXPECT_NEAR(axial().width(), area().width() / 2, 3);
  EXPECT_NEAR(view().height(), area().height() / 2, 3);
  key(Qt::Key_3, Qt::ControlModifier);
  EXPECT_EQ(view().size(), area().size());
  key(Qt::Key_5, Qt::ControlModifier);
  EXPECT_FALSE(view().isVisible());
  EXPECT_TRUE(sagittal().isVisible());
  sagittal().setFocus();
  key(Qt::Key_4, Qt::ControlModifier);
  EXPECT_GT(sagittal().width() * sagittal().height(), area().width() * area().height() / 2);
  EXPECT_TRUE(view().isVisible());
  key(Qt::Key_E);
  EXPECT_EQ(sagittal().size(), area().size());
  key(Qt::Key_E);
  key(Qt::Key_2, Qt::ControlModifier);
  closeWindow();
  openWindow();
  EXPECT_EQ(area().arrangement().layout(), ViewLayout::FourUp);
  EXPECT_TRUE(action("Four up")->isChecked());
}

TEST_F(Views, ADividerIsDraggedAndPutBack)
{
  const int before = view().width();
  auto& divider = widget<QWidget>("viewDivider0");
  const QPoint middle = divider.rect().center();
  QTest::mousePress(&divider, Qt::LeftButton, Qt::NoModifier, middle);
  QMouseEvent move(QEvent::MouseMove, middle - QPoint(100, 0), Qt::NoButton, Qt::LeftButton,
                   Qt::NoModifier);
  QApplication::sendEvent(&divider, &move);
  QTest::mouseRelease(&divider, Qt::LeftButton, Qt::NoModifier, middle);
  EXPECT_NEAR(view().width(), before - 100, 3);
  QTest::mouseDClick(&divider, Qt::LeftButton, Qt::NoModifier, divider.rect().center());
  EXPECT_EQ(view().width(), before);
}

TEST_F(Views, PetrousPlanesAreAtHalfARightAngleToTheSide)
{
  key(Qt::Key_7, Qt::ControlModifier);
  const Eigen::Vector3d normal = coronal().slice().axes().next;
  EXPECT_NEAR(std::abs(normal.y()), std::sqrt(0.5), 1e-12);
  // The ball lies right of the midline: the pyramid runs along (1, -1, 0).
  EXPECT_NEAR(normal.dot(Eigen::Vector3d(1, -1, 0)), 0.0, 1e-12);
  EXPECT_EQ(widget<QComboBox>("slicePlanes").currentIndex(), 2);
  // A click there moves the crosshair within the plane, and through what the picture shows.
  const auto slice = coronal().slice();
  const Eigen::Vector3d before = window().model().crosshair();
  const QPoint at = coronal().rect().center() + QPoint(15, -12); // within the image
  const Eigen::Vector3d wanted = slice.patientFromPixel(at.x() - 0.5, at.y() - 0.5);
  EXPECT_NEAR((wanted - before).dot(normal), 0.0, 1e-9);
  QTest::mouseClick(&coronal(), Qt::LeftButton, Qt::NoModifier, at);
  EXPECT_LT((window().model().crosshair() - wanted).norm(), 0.6);
  key(Qt::Key_6, Qt::ControlModifier);
  EXPECT_EQ(coronal().slice().axes().next, Eigen::Vector3d(0, 1, 0));
}

// What is seen is the plane through the crosshair, and the crosshair stays where it was.
TEST_F(Views, AZoomedSliceThatIsTurnedShowsThePlaneOfTheCrosshair)
{
  auto& model = const_cast<presenters::WorkstationModel&>(window().model());
  model.setCrosshair(model.crosshair() + Eigen::Vector3d(6, 5, -4));
  for (SliceView* slice : {&axial(), &coronal(), &sagittal()})
    for (int n = 0; n < 6; ++n)
      QTest::keyClick(slice, Qt::Key_Plus);
  const Eigen::Vector3d crosshair = model.crosshair();
  const Eigen::Vector2d before = coronal().slice().pixelFromPatient(crosshair);
  for (const int planes : {Qt::Key_7, Qt::Key_6})
  {
    key(planes, Qt::ControlModifier);
    for (SliceView* one : {&axial(), &coronal(), &sagittal()})
    {
      const auto slice = one->slice();
      const Eigen::Vector2d pixel = slice.pixelFromPatient(crosshair);
      EXPECT_LT((slice.patientFromPixel(pixel[0], pixel[1]) - crosshair).norm(), 1e-6) << planes;
    }
    EXPECT_LT((coronal().slice().pixelFromPatient(crosshair) - before).norm(), 1e-6) << planes;
  }
}

TEST_F(Views, ControlDragAndControlKeysTurnPlanes)
{
  axial().setFocus();
  QTest::keyClick(&axial(), Qt::Key_Right, Qt::ControlModifier);
  QTest::keyClick(&axial(), Qt::Key_Right, Qt::ControlModifier);
  const double degree = std::acos(-1.0) / 180.0;
  EXPECT_NEAR(coronal().slice().axes().right.y(), std::sin(2.0 * degree), 1e-9);
  EXPECT_EQ(axial().slice().axes().right, Eigen::Vector3d(1, 0, 0));
  key(Qt::Key_6, Qt::ControlModifier);
  // From the crosshair's right a quarter turn down, in the axial slice.
  const Eigen::Vector2d middle = axial().slice().pixelFromPatient(window().model().crosshair());
  const auto at = [&](double x, double y)
  { return QPoint(int(std::lround(middle[0] + x)), int(std::lround(middle[1] + y))); };
  const Eigen::Vector3d crosshair = window().model().crosshair();
  QTest::mousePress(&axial(), Qt::LeftButton, Qt::ControlModifier, at(60, 0));
  for (const QPoint& to : {at(42, 42), at(0, 60)})
  {
    QMouseEvent move(QEvent::MouseMove, to, Qt::NoButton, Qt::LeftButton, Qt::ControlModifier);
    QApplication::sendEvent(&axial(), &move);
  }
  QTest::mouseRelease(&axial(), Qt::LeftButton, Qt::ControlModifier, at(0, 60));
  EXPECT_EQ(window().model().crosshair(), crosshair);
  EXPECT_GT(coronal().slice().axes().right.y(), std::cos(3.0 * degree)); // was along x
  QTest::keyClick(&axial(), Qt::Key_Down, Qt::ControlModifier);
  EXPECT_NEAR(axial().slice().axes().down.z(), -std::sin(degree), 1e-9);
}

TEST_F(Views, ASlabIsFineAfterAWhileAndSavedWithTheCase)
{
  key(Qt::Key_J, Qt::ControlModifier);
  EXPECT_EQ(slices().slab().thickness, 5.0);
  EXPECT_EQ(slices().slab().projection, presenters::Projection::Maximum);
  key(Qt::Key_BracketRight, Qt::ControlModifier);
  EXPECT_EQ(slices().slab().thickness, 8.0);
  key(Qt::Key_J, Qt::ShiftModifier);
  EXPECT_EQ(slices().slab().thickness, 12.0);
  key(Qt::Key_J, Qt::ControlModifier | Qt::ShiftModifier);
  EXPECT_EQ(slices().slab().thickness, 8.0);
  widget<QDoubleSpinBox>("slabThickness").setValue(90.0);
  doubleClick(axial());
  EXPECT_TRUE(waitFor([this] { return axial().isFine(); }));
  doubleClick(axial());
  key(Qt::Key_7, Qt::ControlModifier);
  action("Save")->trigger();
  ASSERT_TRUE(settled());
  closeWindow();
  openWindow("ball");
  EXPECT_EQ(slices().slab().thickness, 90.0);
  EXPECT_EQ(slices().planes().kind(), presenters::SlicePlanes::Kind::Petrous);
  const auto saved = library().open("ball");
  EXPECT_EQ(saved.view.slices->slab->projection, "mip");
  key(Qt::Key_J, Qt::ControlModifier); // MinIP
  key(Qt::Key_J, Qt::ControlModifier); // mean
  key(Qt::Key_J, Qt::ControlModifier);
  EXPECT_EQ(slices().slab().thickness, 0.0);
}

TEST_F(Views, GreyWindowsByNumberByNameAndOnesOwn)
{
  key(Qt::Key_B, Qt::ShiftModifier);
  EXPECT_EQ(slices().seenWindow().width, 2800.0);
  EXPECT_EQ(widget<QComboBox>("greyWindow").currentText(), "Temporal bone");
  widget<QDoubleSpinBox>("windowWidth").setValue(1234.0);
  widget<QDoubleSpinBox>("windowLevel").setValue(321.0);
  EXPECT_EQ(slices().seenWindow().width, 1234.0);
  EXPECT_EQ(slices().seenWindow().level, 321.0);
  EXPECT_EQ(widget<QComboBox>("greyWindow").currentIndex(), -1);
  onDialog(
      [](QDialog& dialog)
      {
        auto* line = dialog.findChild<QLineEdit*>();
        if (!line)
          return false;
        line->setText("Cholesteatoma");
        dialog.accept();
        return true;
      });
  widget<QAbstractButton>("keepWindow").click();
  EXPECT_EQ(widget<QComboBox>("greyWindow").currentText(), "Cholesteatoma");
  key(Qt::Key_T);
  EXPECT_EQ(slices().seenWindow().width, 400.0);
  closeWindow();
  openWindow();
  auto& list = widget<QComboBox>("greyWindow");
  const int row = list.findText("Cholesteatoma");
  ASSERT_GE(row, 0);
  list.setCurrentIndex(row);
  EXPECT_EQ(slices().seenWindow().level, 321.0);
  widget<QAbstractButton>("forgetWindow").click();
  EXPECT_LT(list.findText("Cholesteatoma"), 0);
}

TEST_F(Views, ARightClickOffersTheMenuAndARightDragDoesNot)
{
  auto* menu = window().findChild<SliceController*>()->menu();
  QTest::mousePress(&axial(), Qt::RightButton, Qt::NoModifier, {50, 50});
  QMouseEvent move(QEvent::MouseMove, QPointF(80, 50), Qt::NoButton, Qt::RightButton,
                   Qt::NoModifier);
  QApplication::sendEvent(&axial(), &move);
  QTest::mouseRelease(&axial(), Qt::RightButton, Qt::NoModifier, {80, 50});
  EXPECT_FALSE(menu->isVisible());
  QTest::mouseClick(&axial(), Qt::RightButton, Qt::NoModifier, {50, 50});
  EXPECT_TRUE(menu->isVisible());
  menu->close();
}

TEST_F(Views, SlicesZoomTogetherToOneScale)
{
  axial().setFocus();
  const double before = coronal().slice().mmPerPixel();
  for (int n = 0; n < 8; ++n)
    QTest::keyClick(&axial(), Qt::Key_Plus);
  EXPECT_EQ(coronal().slice().mmPerPixel(), before);
  action("Zoom slices together")->trigger();
  EXPECT_NEAR(coronal().slice().mmPerPixel(), axial().slice().mmPerPixel(), 1e-9) << "at once";
  EXPECT_NEAR(sagittal().slice().mmPerPixel(), axial().slice().mmPerPixel(), 1e-9);
  QTest::keyClick(&axial(), Qt::Key_Plus);
  EXPECT_NEAR(coronal().slice().mmPerPixel(), axial().slice().mmPerPixel(), 1e-9);
  EXPECT_NEAR(sagittal().slice().mmPerPixel(), axial().slice().mmPerPixel(), 1e-9);
}

// A view pans by no more than it takes to show the crosshair, and not at all where it is seen.
TEST_F(Views, ZoomedSlicesShowTheCrosshairThatIsSetElsewhere)
{
  auto& model = const_cast<presenters::WorkstationModel&>(window().model());
  const auto at = [&](SliceView& slice)
  { return Eigen::Vector2d(slice.slice().pixelFromPatient(model.crosshair())); };
  const auto isSeen = [&](SliceView& slice)
  {
    const Eigen::Vector2d pixel = at(slice);
    return pixel.x() > 0.0 && pixel.y() > 0.0 && pixel.x() < slice.width() - 1.0 &&
           pixel.y() < slice.height() - 1.0;
  };
  const std::array<SliceView*, 3> all{&axial(), &coronal(), &sagittal()};
  model.setCrosshair(kBallCenter);
  for (SliceView* slice : all)
  {
    slice->setFocus();
    const auto half = [slice]
    { return 0.5 * std::max(slice->width(), slice->height()) * slice->slice().mmPerPixel(); };
    for (int n = 0; n < 30 && half() > 0.5 * kBallRadius; ++n)
      QTest::keyClick(slice, Qt::Key_Plus);
    slice->grab();
    ASSERT_LE(half(), 0.5 * kBallRadius);
    ASSERT_TRUE(isSeen(*slice));
  }

  // Within what is seen, by the slices' keys or wheel.
  const double step = 2.0 * axial().slice().mmPerPixel();
  const Eigen::Vector3d offset = axial().plane().offset;
  model.setCrosshair(kBallCenter + Eigen::Vector3d(step, step, 0));
  axial().grab();
  EXPECT_EQ(axial().plane().offset, offset);

  // Beyond it, to the patient's left, which is on the right.
  model.setCrosshair(kBallCenter);
  axial().grab();
  const Eigen::Vector2d before = at(axial());
  model.setCrosshair(kBallCenter + Eigen::Vector3d(kBallRadius, 0, 0));
  EXPECT_FALSE(isSeen(axial()));
  axial().grab();
  EXPECT_NEAR(at(axial()).x(), axial().width() - std::min(40.0, axial().width() / 4.0), 1e-6);
  EXPECT_NEAR(at(axial()).y(), before.y(), 1e-6) << "by the least";

  // A click in the 3D view.
  QTest::mouseClick(&view(), Qt::LeftButton, Qt::NoModifier, view().rect().center());
  ASSERT_NEAR((model.crosshair() - kBallCenter).norm(), kBallRadius, 0.1);
  for (SliceView* slice : all)
  {
    slice->grab();
    EXPECT_TRUE(isSeen(*slice)) << slice->objectName().toStdString();
  }

  // A kept view, whose crosshair was out of sight.
  scene::ViewState::Slices kept = slices().shown();
  (*kept.planes)[0].offset += Eigen::Vector3d(2.0 * kBallRadius, 0, 0);
  slices().setShown(kept);
  axial().grab();
  EXPECT_TRUE(isSeen(axial()));

  // Panned away by hand, it is not brought back by scrolling.
  auto plane = axial().plane();
  plane.offset += Eigen::Vector3d(2.0 * kBallRadius, 0, 0);
  axial().setPlane(plane);
  model.setCrosshair(model.crosshair() + Eigen::Vector3d(0, 0, 1));
  axial().grab();
  EXPECT_EQ(axial().plane().offset, plane.offset);
}

// Events as Qt sends them when another window, a menu or a context menu comes and goes.
TEST_F(Views, TheFrameOfTheKeyboardFocusComesBackWithTheFocus)
{
  auto* frame = view().findChild<QWidget*>("focusFrame");
  ASSERT_TRUE(frame);
  const auto send = [this](QEvent::Type type, Qt::FocusReason reason)
  {
    QFocusEvent event(type, reason);
    QApplication::sendEvent(&view(), &event);
  };
  const auto isFramed = [frame] { return !frame->isHidden(); };
  const auto in = QEvent::FocusIn, out = QEvent::FocusOut;
  for (const auto reason :
       {Qt::ActiveWindowFocusReason, Qt::PopupFocusReason, Qt::MenuBarFocusReason})
  {
    send(in, Qt::TabFocusReason);
    EXPECT_TRUE(isFramed());
    send(out, reason);
    EXPECT_FALSE(isFramed());
    send(in, reason);
    EXPECT_TRUE(isFramed()) << reason;
    send(out, Qt::TabFocusReason);
    send(in, reason);
    EXPECT_FALSE(isFramed()) << "the focus was elsewhere";
    send(in, Qt::MouseFocusReason);
    send(out, reason);
    send(in, reason);
    EXPECT_FALSE(isFramed()) << "it had none";
  }
  // In stereo it would float.
  send(in, Qt::TabFocusReason);
  ASSERT_TRUE(isFramed());
  view().display().setStereo(rendering::StereoMode::Anaglyph, {});
  picture();
  EXPECT_FALSE(isFramed());
  send(out, Qt::PopupFocusReason);
  send(in, Qt::PopupFocusReason);
  EXPECT_FALSE(isFramed());
}

TEST_F(Views, SlicesHaveTheScaleOfThe3DView)
{
  action("Zoom with the 3D view")->trigger();
  core::CameraPose camera = view().picture().camera();
  camera.position = camera.focalPoint + 40.0 * (camera.position - camera.focalPoint).normalized();
  view().setCamera(camera);
  // A millimetre at the focal point, seen under the view angle over the view's height.
  const double height = 2.0 * 40.0 * std::tan(0.5 * camera.viewAngle * std::acos(-1.0) / 180.0);
  EXPECT_NEAR(axial().slice().mmPerPixel(), height / view().height(), 1e-9);
}

TEST_F(Views, SurgicalPositionIsOneKeyAndRollsByKeys)
{
  const auto edges = [this] { return interaction::edgeDirections(view().picture().camera()); };
  const int events = m_events;
  key(Qt::Key_9);
  EXPECT_EQ(m_events - events, 1);
  EXPECT_EQ(edges().top, "A");
  EXPECT_EQ(edges().left, "S"); // right ear
  key(Qt::Key_8);
  EXPECT_EQ(edges().top, "A");
  EXPECT_EQ(edges().right, "S");
  window().findChild<QPushButton*>("sideRight")->click();
  key(Qt::Key_8);
  EXPECT_TRUE(window().statusBar()->currentMessage().contains("left ear"))
      << window().statusBar()->currentMessage().toStdString();
  key(Qt::Key_9);
  EXPECT_FALSE(window().statusBar()->currentMessage().contains("left ear")) << "it is the right";
  key(Qt::Key_8);
  for (int n = 0; n < 18; ++n)
    key(Qt::Key_Period);
  EXPECT_EQ(edges().right, "A");
  for (int n = 0; n < 18; ++n)
    key(Qt::Key_Comma);
  EXPECT_EQ(edges().top, "A");
}

TEST_F(Views, AViewIsKeptByNameAndComesBackWithTheCase)
{
  key(Qt::Key_3);
  key(Qt::Key_7, Qt::ControlModifier);
  QTest::mouseClick(&axial(), Qt::LeftButton, Qt::NoModifier, {60, 70});
  const core::CameraPose camera = view().picture().camera();
  const Eigen::Vector3d crosshair = window().model().crosshair();
  onDialog(
      [](QDialog& dialog)
      {
        auto* line = dialog.findChild<QLineEdit*>();
        if (!line)
          return false;
        line->setText("Facial recess");
        dialog.accept();
        return true;
      });
  key(Qt::Key_K, Qt::ControlModifier);
  EXPECT_TRUE(window().model().unsaved());
  action("Save")->trigger();
  ASSERT_TRUE(settled());
  key(Qt::Key_1);
  key(Qt::Key_6, Qt::ControlModifier);
  QTest::mouseClick(&axial(), Qt::LeftButton, Qt::NoModifier, {90, 90});
  key(Qt::Key_1, Qt::AltModifier);
  EXPECT_LT((view().picture().camera().position - camera.position).norm(), 1e-6);
  EXPECT_LT((window().model().crosshair() - crosshair).norm(), 1e-9);
  EXPECT_EQ(slices().planes().kind(), presenters::SlicePlanes::Kind::Petrous);
  closeWindow();
  openWindow("ball");
  EXPECT_EQ(window().model().value().view.saved.count("Facial recess"), 1u);
  EXPECT_NE(action("Facial recess"), nullptr);
}

// As it was kept: zoomed, off the middle, and turned.
TEST_F(Views, AKeptViewHasZoomOffsetAndTurnedPlanes)
{
  const auto keep = [this](const char* name)
  {
    onDialog(
        [name](QDialog& dialog)
        {
          auto* line = dialog.findChild<QLineEdit*>();
          if (!line)
            return false;
          line->setText(name);
          dialog.accept();
          return true;
        });
    key(Qt::Key_K, Qt::ControlModifier);
  };
  const auto isListed = [this]
  {
    const auto actions = window().findChildren<QAction*>();
    return std::any_of(actions.begin(), actions.end(),
                       [](const QAction* candidate)
                       { return candidate->text().remove('&') == "Turned"; });
  };
  for (int n = 0; n < 6; ++n)
    QTest::keyClick(&coronal(), Qt::Key_Plus);
  for (int n = 0; n < 20; ++n)
    QTest::keyClick(&coronal(), Qt::Key_Down, Qt::ControlModifier);
  const presenters::SliceGeometry before = coronal().slice();
  const auto plane = coronal().plane();
  ASSERT_GT(plane.zoom, 2.5);
  ASSERT_LT(before.axes().next.y(), 0.96);
  keep("Turned");
  key(Qt::Key_6, Qt::ControlModifier);
  coronal().fit();
  ASSERT_NE(coronal().slice().mmPerPixel(), before.mmPerPixel());
  ASSERT_TRUE(waitFor(isListed));
  key(Qt::Key_1, Qt::AltModifier);
  const presenters::SliceGeometry after = coronal().slice();
  EXPECT_NEAR(coronal().plane().zoom, plane.zoom, 1e-9); // its size in pixels may have changed
  EXPECT_LT((after.center() - before.center()).norm(), 1e-6);
  EXPECT_LT((after.axes().next - before.axes().next).norm(), 1e-9);
  EXPECT_LT((after.axes().right - before.axes().right).norm(), 1e-9);

  // Replaced and removed by mistake.
  key(Qt::Key_6, Qt::ControlModifier);
  keep("Turned");
  const auto& saved = window().model().value().view.saved;
  EXPECT_FALSE(saved.at("Turned").slices->turned);
  key(Qt::Key_Z, Qt::ControlModifier);
  EXPECT_TRUE(saved.at("Turned").slices->turned);
  auto& views = const_cast<presenters::WorkstationModel&>(window().model());
  views.removeView("Turned");
  EXPECT_TRUE(waitFor([&] { return !isListed(); }));
  key(Qt::Key_Z, Qt::ControlModifier);
  EXPECT_TRUE(waitFor(isListed));
}

TEST_F(Views, TheLimitOfKeptViewsIsSaidBeforeItIsReached)
{
  auto& model = const_cast<presenters::WorkstationModel&>(window().model());
  const auto slices = this->slices().shown();
  for (std::size_t n = 0; n < scene::ViewState::kMaxSaved; ++n)
    model.saveView("v" + std::to_string(n), view().picture().camera(), slices);
  QString words;
  bool canKeep = true, canReplace = false;
  onDialog(
      [&](QDialog& dialog)
      {
        auto* line = dialog.findChild<QLineEdit*>();
        if (!line)
          return false;
        auto* ok = dialog.findChild<QDialogButtonBox*>()->button(QDialogButtonBox::Ok);
        line->setText("one more");
        words = dialog.findChild<QLabel*>()->text();
        canKeep = ok->isEnabled();
        line->setText("v7");
        canReplace = ok->isEnabled();
        dialog.reject();
        return true;
      });
  key(Qt::Key_K, Qt::ControlModifier);
  EXPECT_TRUE(words.contains("100")) << words.toStdString();
  EXPECT_FALSE(canKeep);
  EXPECT_TRUE(canReplace);
}
