// The crop box and the clipping plane of the open case, moved by mouse, numbers and keys.
#include "GuiTest.h"

#include <algorithm>
#include <cmath>

#include <QApplication>
#include <QDockWidget>
#include <QDoubleSpinBox>
#include <QLabel>
#include <QLineF>
#include <QMouseEvent>
#include <QPainter>
#include <QPushButton>
#include <QSignalSpy>
#include <QStatusBar>

#include <vtkPropCollection.h>
#include <vtkRenderer.h>
#include <vtkTextActor.h>

#include "MeasureController.h"
#include "SceneDisplay.h"
#include "SliceMarks.h"
#include "SliceView.h"
#include "Theme.h"
#include "ThreeDView.h"
#include "petrous/Presenters/BoxHandles.h"
#include "petrous/Presenters/ClippingHandles.h"
#include "petrous/Scene/Branches.h"

using namespace petrous;
using namespace petrous::workstation;
using Eigen::Vector3d;

namespace
{

// The ball's image: 64 voxels of 0.5 mm along each axis.
class ClippingBox : public GuiTest
{
protected:
  SliceView& axial() { return *window().findChild<SliceView*>("axialView"); }
  const scene::ViewState::Clipping& clipping() { return window().model().value().view.clipping; }
  void undo() { QTest::keyClick(&window(), Qt::Key_Z, Qt::ControlModifier); }
  void redo() { QTest::keyClick(&window(), Qt::Key_Z, Qt::ControlModifier | Qt::ShiftModifier); }

  static void moveTo(QWidget& widget, const QPoint& at)
  {
    QMouseEvent move(QEvent::MouseMove, at, Qt::LeftButton, Qt::LeftButton, Qt::NoModifier);
    QApplication::sendEvent(&widget, &move);
  }

  static void drag(QWidget& widget, const QPoint& from, const QPoint& to)
  {
    QTest::mousePress(&widget, Qt::LeftButton, Qt::NoModifier, from);
    moveTo(widget, (from + to) / 2);
    moveTo(widget, to);
    QTest::mouseRelease(&widget, Qt::LeftButton, Qt::NoModifier, to);
  }

  /// The ball, cut away to the crosshair.
  void openCut()
  {
    saveBall("ball");
    openWindow("ball");
    ASSERT_TRUE(waitFor([this] { return window().model().ready(); }));
    action("Cut away to the crosshair")->trigger();
    ASSERT_EQ(clipping().planes.size(), 1U);
  }

  /// Where the axial view shows the left face of the box, in the middle of the edge.
  QPoint leftEdge(const std::optional<core::IndexBox>& crop)
  {
    const presenters::CropFrame frame(window().model().value().ct.geometry);
    Vector3d at = frame.box(crop).box.center();
    at[0] = frame.box(crop).box.max()[0];
    const Eigen::Vector2d pixel = axial().slice().pixelFromPatient(at);
    return {static_cast<int>(std::lround(pixel[0])), static_cast<int>(std::lround(pixel[1]))};
  }

  /// The cut of a ball, seen from the patient's right: a vertical line in the axial view, in which
  /// it is dragged.
  void openUpright()
  {
    saveBall("ball");
    openWindow("ball");
    ASSERT_TRUE(waitFor([this] { return window().model().ready(); }));
    action("Right")->trigger();
    picture();
    action("Cut away to the crosshair")->trigger();
    ASSERT_EQ(clipping().planes.size(), 1U);
    ASSERT_GT(std::abs(clipping().planes.front().normal.x()), 0.99);
    ASSERT_TRUE(cutLine());
  }

  std::optional<presenters::CutLine> cutLine()
  {
    return presenters::lineInSlice(clipping().planes.front(), axial().slice());
  }

  static QPoint atPixel(const Eigen::Vector2d& pixel)
  {
    return {static_cast<int>(std::lround(pixel[0])), static_cast<int>(std::lround(pixel[1]))};
  }

  /// Texts over the 3D view, as drawn last.
  QStringList textsInView()
  {
    QStringList texts;
    vtkPropCollection* props = view().picture().renderer()->GetViewProps();
    vtkCollectionSimpleIterator at;
    props->InitTraversal(at);
    while (vtkProp* prop = props->GetNextProp(at))
      if (auto* text = vtkTextActor::SafeDownCast(prop); text && text->GetInput())
        texts += QString::fromUtf8(text->GetInput());
    return texts;
  }

  QPoint inView(const Vector3d& patient)
  {
    const auto at = view().display().pixelOf(patient);
    if (!at)
      return {};
    const double ratio = view().devicePixelRatioF();
    return {static_cast<int>(std::lround((*at)[0] / ratio)),
            static_cast<int>(std::lround((*at)[1] / ratio))};
  }
};

} // namespace

TEST_F(ClippingBox, IsDraggedByAnEdgeInASliceUndoneAndSaved)
{
  saveBall("ball");
  openWindow("ball");
  const QImage whole = picture();
  action("Crop box")->trigger();
  EXPECT_TRUE(action("Crop box")->isChecked());
  EXPECT_FALSE(clipping().crop) << "nothing is cropped before an edge is dragged";
  const QPoint from = leftEdge(std::nullopt);
  const int pixels = 60;
  const double voxels = pixels * axial().slice().mmPerPixel() / 0.5;
  const core::IndexBox expected{{0, 0, 0}, {64 - static_cast<int>(std::lround(voxels)), 64, 64}};
  ASSERT_GT(voxels, 1.0);
  ASSERT_LT(voxels, 50.0);
  const Vector3d crosshair = window().model().crosshair();
  QTest::mousePress(&axial(), Qt::LeftButton, Qt::NoModifier, from);
  moveTo(axial(), from - QPoint(pixels / 2, 0));
  EXPECT_TRUE(clipping().crop) << "the picture follows the pointer";
  moveTo(axial(), from - QPoint(pixels, 0));
  QTest::mouseRelease(&axial(), Qt::LeftButton, Qt::NoModifier, from - QPoint(pixels, 0));
  EXPECT_EQ(clipping().crop, expected);
  EXPECT_EQ(window().model().crosshair(), crosshair);
  EXPECT_EQ(window().model().undoText(), "crop box");

  undo(); // one step, however often the pointer moved
  EXPECT_FALSE(clipping().crop);
  redo();
  EXPECT_EQ(clipping().crop, expected);
  ASSERT_TRUE(settled());
  const auto revision = window().model().value().revision;
  action("Save")->trigger();
  ASSERT_TRUE(
      waitFor([&] { return window().model().value().revision > revision && !window().busy(); }));
  EXPECT_EQ(library().open("ball").view.clipping.crop, expected);

  // A double click on the edge shows all of it again.
  const QPoint edge = leftEdge(expected);
  QTest::mouseDClick(&axial(), Qt::LeftButton, Qt::NoModifier, edge);
  EXPECT_FALSE(clipping().crop);
  action("Crop box")->trigger();
  EXPECT_LT(differentPixels(picture(), whole), 50);
  // Without its handles the edge is no edge.
  QTest::mouseClick(&axial(), Qt::LeftButton, Qt::NoModifier, from - QPoint(20, 0));
  EXPECT_FALSE(clipping().crop);
  EXPECT_NE(window().model().crosshair(), crosshair);
}

TEST_F(ClippingBox, HidingItBringsBackTheZoomOfTheSlices)
{
  saveBall("ball");
  openWindow("ball");
  const auto views = window().findChildren<SliceView*>();
  ASSERT_EQ(views.size(), 3);
  const Vector3d aside(1.5, 1.5, 1.5);
  for (SliceView* slice : views)
    slice->setPlane({3.0, aside});
  action("Crop box")->trigger();
  for (SliceView* slice : views)
    EXPECT_EQ(slice->plane().zoom, 1.0) << "the edges are those of the image";
  views[1]->setPlane({2.0, Vector3d::Zero()}); // meanwhile
  action("Crop box")->trigger();
  EXPECT_FALSE(action("Crop box")->isChecked());
  EXPECT_EQ(views[0]->plane().zoom, 3.0);
  EXPECT_EQ(views[0]->plane().offset, aside);
  EXPECT_EQ(views[1]->plane().zoom, 2.0) << "was zoomed since";
  EXPECT_EQ(views[2]->plane().zoom, 3.0);

  action("Fit slices")->trigger();
  action("Crop box")->trigger();
  action("Crop box")->trigger();
  EXPECT_EQ(views[0]->plane().zoom, 1.0) << "what was whole stays so";
}

TEST_F(ClippingBox, ZoomsBeneathItAreThoseOfTheirApproachAndSaved)
{
  scene::Case value = ballCase("ball");
  value.dissection = dissection::Dissection(value.ct.geometry);
  scene::startBranch(value, "other");
  library().save(value);
  openWindow("ball");
  ASSERT_TRUE(settled());
  const auto views = window().findChildren<SliceView*>();
  ASSERT_EQ(views.size(), 3);
  const auto zoomAll = [&](double zoom)
  {
    for (SliceView* slice : views)
      slice->setPlane({zoom, Vector3d::Zero()});
  };
  const auto change = [this] { QTest::keyClick(&window(), Qt::Key_PageDown, Qt::ControlModifier); };
  const auto branch = [this]
  { return window().model().value().dissection.history().branch().name; };
  ASSERT_EQ(branch(), "other");
  action("Fit slices")->trigger();
  change();
  ASSERT_EQ(branch(), "main");
  zoomAll(3.0);
  action("Crop box")->trigger();
  ASSERT_EQ(views[0]->plane().zoom, 1.0);
  change();
  ASSERT_EQ(branch(), "other");
  EXPECT_EQ(views[0]->plane().zoom, 1.0);
  action("Crop box")->trigger(); // hidden
  EXPECT_EQ(views[0]->plane().zoom, 1.0) << "the other one's is not its";
  ASSERT_TRUE(settled());
  const scene::Case saved = library().open("ball");
  ASSERT_EQ(saved.view.branches.count("main"), 1U);
  const auto& left = saved.view.branches.at("main").slices;
  ASSERT_TRUE(left && left->planes);
  EXPECT_EQ((*left->planes)[0].zoom, 3.0);
  change();
  ASSERT_EQ(branch(), "main");
  EXPECT_EQ(views[0]->plane().zoom, 3.0);

  // Nor does a save while it is shown know of the whole slices.
  action("Crop box")->trigger();
  ASSERT_EQ(views[0]->plane().zoom, 1.0);
  action("Save")->trigger();
  ASSERT_TRUE(settled());
  const auto shown = library().open("ball").view.slices;
  ASSERT_TRUE(shown && shown->planes);
  EXPECT_EQ((*shown->planes)[0].zoom, 3.0);
}

TEST_F(ClippingBox, SlicesThatAreFittedWhileItIsShownStaySo)
{
  saveBall("ball");
  openWindow("ball");
  const auto views = window().findChildren<SliceView*>();
  ASSERT_EQ(views.size(), 3);
  for (SliceView* slice : views)
    slice->setPlane({3.0, Vector3d::Zero()});
  action("Crop box")->trigger();
  action("Fit slices")->trigger();
  action("Crop box")->trigger();
  for (SliceView* slice : views)
    EXPECT_EQ(slice->plane().zoom, 1.0);
}

TEST_F(ClippingBox, IsDraggedByAFaceInTheThreeDView)
{
  scene::ViewState::Clipping some;
  some.crop = core::IndexBox{{16, 16, 16}, {48, 48, 48}};
  scene::Case ball = ballCase("ball");
  ball.view.clipping = some;
  library().save(ball);
  openWindow("ball");
  action("Crop box")->trigger();
  picture();
  const auto headFace = [this]
  {
    const presenters::CropFrame frame(window().model().value().ct.geometry);
    const Eigen::AlignedBox3d box = frame.box(clipping().crop).box;
    return Vector3d(box.center()[0], box.center()[1], box.max()[2]);
  };
  // From the side of the ear the head is up.
  const QPoint from = inView(headFace());
  const double pixelsPerMm =
      inView(headFace() - Vector3d(0.0, 0.0, 4.0)).y() / 4.0 - from.y() / 4.0;
  ASSERT_GT(pixelsPerMm, 1.0);
  const QPoint to = from + QPoint(0, static_cast<int>(std::lround(3.0 * pixelsPerMm)));
  const core::CameraPose camera = view().picture().camera();
  drag(view(), from, to);
  picture();
  ASSERT_TRUE(clipping().crop);
  EXPECT_EQ(clipping().crop->lower, some.crop->lower);
  EXPECT_EQ(clipping().crop->upper[0], 48);
  EXPECT_EQ(clipping().crop->upper[1], 48);
  EXPECT_LT(clipping().crop->upper[2], 48);
  // The face is under the pointer, but for half a voxel.
  EXPECT_NEAR(inView(headFace()).y(), to.y(), 0.25 * pixelsPerMm + 2.0);
  EXPECT_EQ(view().picture().camera().position, camera.position) << "the patient does not turn";
  undo();
  EXPECT_EQ(clipping(), some);
}

TEST_F(ClippingBox, IsEnteredInMillimetres)
{
  saveBall("ball");
  openWindow("ball");
  action("Crop box in numbers…")->trigger();
  auto* dialog = window().findChild<QDialog*>("cropBoxDialog");
  ASSERT_TRUE(dialog);
  ASSERT_TRUE(dialog->isVisible());
  auto* x0 = dialog->findChild<QDoubleSpinBox*>("x0");
  x0->setValue(kBallCenter[0] - 15.75 + 4.0);
  EXPECT_EQ(clipping().crop, (core::IndexBox{{8, 0, 0}, {64, 64, 64}}));
  // No less than 5 mm, from the 1st to the 11th voxel.
  auto* y1 = dialog->findChild<QDoubleSpinBox*>("y1");
  y1->setValue(kBallCenter[1] - 15.75 + 1.0);
  EXPECT_EQ(clipping().crop, (core::IndexBox{{8, 0, 0}, {64, 11, 64}}));
  EXPECT_NEAR(y1->value(), kBallCenter[1] - 15.75 + 5.0, 0.051);
  undo();
  EXPECT_EQ(clipping().crop, (core::IndexBox{{8, 0, 0}, {64, 64, 64}}));
  EXPECT_NEAR(y1->value(), kBallCenter[1] + 15.75, 0.051) << "the dialog follows";
  dialog->findChild<QPushButton*>("wholeImage")->click();
  EXPECT_FALSE(clipping().crop);
  dialog->close();
}

// Their range begins far from 0, so that the first digit alone is none of it.
TEST_F(ClippingBox, NumbersAreTypedAndJudgedWhenTheyAreEnded)
{
  saveBall("ball");
  openWindow("ball");
  action("Crop box in numbers…")->trigger();
  auto* dialog = window().findChild<QDialog*>("cropBoxDialog");
  ASSERT_TRUE(dialog);
  auto* x0 = dialog->findChild<QDoubleSpinBox*>("x0");
  ASSERT_TRUE(x0);
  EXPECT_EQ(dialog->focusWidget(), x0) << "the first number is to be typed over";
  enterNumber(*x0, "-39.8"); // of -45.75 to -14.25
  EXPECT_NEAR(x0->value(), -39.75, 0.051);
  ASSERT_TRUE(clipping().crop);
  EXPECT_EQ(clipping().crop->lower[0], 12); // 6 mm, at 0.5 mm
  EXPECT_FALSE(x0->property("refused").toBool());

  const double before = x0->value();
  enterNumber(*x0, "7"); // on the wrong side of 0
  EXPECT_EQ(x0->value(), before);
  EXPECT_TRUE(x0->property("refused").toBool());
  EXPECT_TRUE(window().statusBar()->currentMessage().contains("is not possible here"))
      << window().statusBar()->currentMessage().toStdString();
  enterNumber(*x0, "-38");
  EXPECT_NEAR(x0->value(), -38.0, 0.3);
  EXPECT_FALSE(x0->property("refused").toBool());
  EXPECT_FALSE(window().statusBar()->currentMessage().contains("above the most"))
      << "it was mended";
  // Of z, from 29.25 to 60.75 mm, 5 is none.
  auto* z1 = dialog->findChild<QDoubleSpinBox*>("z1");
  ASSERT_TRUE(z1);
  enterNumber(*z1, "50");
  EXPECT_NEAR(z1->value(), 50.0, 0.3);
  enterNumber(*z1, "50.123"); // more decimals than it has
  EXPECT_TRUE(z1->property("refused").toBool());
  EXPECT_NEAR(z1->value(), 50.0, 0.3);
  dialog->close();
}

TEST_F(ClippingBox, GivesWayToATool)
{
  saveBall("ball");
  openWindow("ball");
  action("Crop box")->trigger();
  QTest::keyClick(&view(), Qt::Key_D);
  ASSERT_TRUE(waitFor([this] { return view().tool().GetDrillMode() != 0; }));
  const QPoint from = leftEdge(std::nullopt);
  QTest::mousePress(&axial(), Qt::LeftButton, Qt::NoModifier, from);
  moveTo(axial(), from - QPoint(60, 0));
  QTest::mouseRelease(&axial(), Qt::LeftButton, Qt::NoModifier, from - QPoint(60, 0));
  EXPECT_FALSE(clipping().crop);
  EXPECT_TRUE(action("Crop box")->isChecked()) << "it comes back when the tool is put away";
}

TEST_F(ClippingBox, APlaneIsMovedByKeysAndUndone)
{
  saveBall("ball");
  openWindow("ball");
  EXPECT_FALSE(action("Cut deeper")->isEnabled());
  action("Cut away to the crosshair")->trigger();
  ASSERT_EQ(clipping().planes.size(), 1U);
  const scene::ViewState::Clipping::Plane plane = clipping().planes.front();
  action("Cut deeper")->trigger();
  action("Cut deeper")->trigger();
  EXPECT_LT((clipping().planes.front().point - plane.point - 1.0 * plane.normal).norm(), 1e-9);
  action("Cut less deep")->trigger();
  EXPECT_LT((clipping().planes.front().point - plane.point - 0.5 * plane.normal).norm(), 1e-9);
  while (!clipping().planes.empty() && window().model().canUndo())
    undo();
  EXPECT_TRUE(clipping().empty());
  redo();
  ASSERT_EQ(clipping().planes.size(), 1U);
  EXPECT_EQ(clipping().planes.front().point, plane.point);
}

TEST_F(ClippingBox, AKeyThatIsHeldDownMovesThePlaneInOneStepOfUndo)
{
  ASSERT_NO_FATAL_FAILURE(openCut());
  const scene::ViewState::Clipping::Plane plane = clipping().planes.front();
  const auto edits = [this]() -> presenters::EditHistory&
  { return const_cast<presenters::WorkstationModel&>(window().model()).edits(); };
  {
    const presenters::EditHistory::Hold hold(edits()); // as fast as the keyboard repeats
    for (int n = 0; n < 4; ++n)
      action("Cut deeper")->trigger();
  }
  EXPECT_LT((clipping().planes.front().point - plane.point - 2.0 * plane.normal).norm(), 1e-9);
  undo();
  ASSERT_EQ(clipping().planes.size(), 1U);
  EXPECT_EQ(clipping().planes.front().point, plane.point);
  redo();
  EXPECT_LT((clipping().planes.front().point - plane.point - 2.0 * plane.normal).norm(), 1e-9);
  undo();
  undo();
  EXPECT_TRUE(clipping().empty());
}

TEST_F(ClippingBox, KeysOfThePlaneAreThoseOfTheViewsOnly)
{
  ASSERT_NO_FATAL_FAILURE(openCut());
  ASSERT_TRUE(settled());
  const scene::ViewState::Clipping::Plane plane = clipping().planes.front();
  QApplication::setActiveWindow(&window());
  for (const char* name : {"structures", "axialView"})
  {
    auto* widget = window().findChild<QWidget*>(name);
    ASSERT_TRUE(widget) << name;
    for (QWidget* one = widget; one; one = one->parentWidget())
      if (auto* dock = qobject_cast<QDockWidget*>(one))
      {
        dock->show();
        dock->raise();
      }
    ASSERT_TRUE(waitFor([widget] { return widget->isVisible(); })) << name;
    widget->setFocus();
    ASSERT_TRUE(widget->hasFocus()) << name;
    const Vector3d before = clipping().planes.front().point;
    QTest::keyClick(widget, Qt::Key_PageDown, Qt::ShiftModifier);
    const bool isView = widget == &axial();
    EXPECT_EQ(clipping().planes.front().point != before, isView) << name;
    QTest::keyClick(widget, Qt::Key_PageUp, Qt::ShiftModifier);
    EXPECT_LT((clipping().planes.front().point - plane.point).norm(), 1e-9) << name;
  }
}

TEST_F(ClippingBox, HandlesGiveWayToAMeasuringTool)
{
  ASSERT_NO_FATAL_FAILURE(openCut());
  const scene::ViewState::Clipping before = clipping();
  action("Anterior")->trigger();
  picture();
  const Vector3d normal = before.planes.front().normal;
  const Vector3d tip = before.planes.front().point + 8.0 * normal; // the ball is behind it
  const QPoint from = inView(tip);
  const QPoint to = inView(tip + 3.0 * normal);
  action("Distance")->trigger();
  auto* measure = window().findChild<MeasureController*>();
  ASSERT_TRUE(measure && measure->active());
  QTest::mouseMove(&view(), from);
  QTest::mouseClick(&view(), Qt::LeftButton, Qt::NoModifier, from);
  EXPECT_TRUE(measure->hasPoints()) << "the click is the tool's";
  drag(view(), from, to);
  EXPECT_EQ(clipping(), before);

  measure->leaveTool();
  action("Anterior")->trigger();
  picture();
  drag(view(), from, to);
  EXPECT_FALSE(clipping() == before) << "they come back";
}

TEST_F(ClippingBox, ADoubleClickOnAHandleEnlargesNothing)
{
  ASSERT_NO_FATAL_FAILURE(openCut());
  const scene::ViewState::Clipping before = clipping();
  action("Anterior")->trigger();
  picture();
  const Vector3d normal = before.planes.front().normal;
  const QPoint tip = inView(before.planes.front().point + 8.0 * normal);
  QSignalSpy enlarged(&view(), &ThreeDView::enlargeAsked);
  QTest::mouseDClick(&view(), Qt::LeftButton, Qt::NoModifier, tip);
  QTest::mouseRelease(&view(), Qt::LeftButton, Qt::NoModifier, tip);
  EXPECT_EQ(enlarged.count(), 0);
  EXPECT_EQ(clipping(), before);
  // Elsewhere it does.
  QTest::mouseDClick(&view(), Qt::LeftButton, Qt::NoModifier, tip + QPoint(0, 40));
  EXPECT_EQ(enlarged.count(), 1);
}

TEST_F(ClippingBox, NumbersStepByAVoxelWhereThatIsMoreThanAMillimetre)
{
  scene::Case thick = ballCase("thick");
  thick.labels.clear();
  // Every fifth slice: 13 of 2.5 mm.
  const core::GridGeometry& fine = thick.ct.geometry;
  const core::GridGeometry coarse({64, 64, 13}, {0.5, 0.5, 2.5}, fine.origin());
  auto ct = std::make_shared<volume::Volume<std::int16_t>>(coarse);
  for (int k = 0; k < 13; ++k)
    for (int j = 0; j < 64; ++j)
      for (int i = 0; i < 64; ++i)
      {
        const Vector3d at = coarse.patientFromVoxel(Vector3d(i, j, k));
        const double depth = kBallRadius - (at - kBallCenter).norm(); // mm
        ct->at(i, j, k) =
            static_cast<std::int16_t>(std::clamp(300.0 + 1000.0 * depth, -1000.0, 1600.0));
      }
  thick.ct.geometry = coarse;
  thick.ct.volume = std::make_shared<const volume::IntensityVolume>(
      std::shared_ptr<const volume::Volume<std::int16_t>>(ct));
  library().save(thick);
  openWindow("thick");
  action("Crop box in numbers…")->trigger();
  auto* dialog = window().findChild<QDialog*>("cropBoxDialog");
  ASSERT_TRUE(dialog);
  auto* z0 = dialog->findChild<QDoubleSpinBox*>("z0");
  ASSERT_TRUE(z0);
  z0->stepUp();
  EXPECT_EQ(clipping().crop, (core::IndexBox{{0, 0, 1}, {64, 64, 13}}));
  z0->stepUp();
  EXPECT_EQ(clipping().crop, (core::IndexBox{{0, 0, 2}, {64, 64, 13}}));
  z0->stepDown();
  EXPECT_EQ(clipping().crop, (core::IndexBox{{0, 0, 1}, {64, 64, 13}}));
  auto* x0 = dialog->findChild<QDoubleSpinBox*>("x0");
  ASSERT_TRUE(x0);
  x0->stepUp(); // two voxels of 0.5 mm
  EXPECT_EQ(clipping().crop, (core::IndexBox{{2, 0, 1}, {64, 64, 13}}));
  dialog->close();
}

TEST_F(ClippingBox, APlaneIsDraggedByItsArrow)
{
  saveBall("ball");
  openWindow("ball");
  action("Cut away to the crosshair")->trigger(); // seen from the side of the ear
  ASSERT_EQ(clipping().planes.size(), 1U);
  const scene::ViewState::Clipping before = clipping();
  const scene::ViewState::Clipping::Plane plane = before.planes.front();
  action("Anterior")->trigger();
  picture();
  const Vector3d tip = plane.point + 8.0 * plane.normal;
  const QPoint from = inView(tip);
  const QPoint to = inView(tip + 3.0 * plane.normal);
  const double pixelsPerMm = QLineF(from, to).length() / 3.0;
  ASSERT_GT(pixelsPerMm, 2.0);
  QTest::mousePress(&view(), Qt::LeftButton, Qt::NoModifier, from);
  moveTo(view(), (from + to) / 2);
  moveTo(view(), to);
  QTest::mouseRelease(&view(), Qt::LeftButton, Qt::NoModifier, to);
  ASSERT_EQ(clipping().planes.size(), 1U);
  const Vector3d moved = clipping().planes.front().point - plane.point;
  EXPECT_NEAR(moved.dot(plane.normal), 3.0, 2.0 / pixelsPerMm);
  EXPECT_LT((moved - moved.dot(plane.normal) * plane.normal).norm(), 1e-9);
  EXPECT_EQ(clipping().planes.front().normal, plane.normal);
  undo();
  EXPECT_EQ(clipping(), before);
}

// The lower part of the ball is drawn: above its face, 6.25 mm below the middle, there is nothing.
TEST_F(ClippingBox, AClickMeansWhatIsDrawn)
{
  scene::Case ball = ballCase("ball");
  ball.view.clipping.crop = core::IndexBox{{0, 0, 0}, {64, 64, 20}};
  library().save(ball);
  openWindow("ball");
  ASSERT_TRUE(waitFor([this] { return window().model().ready(); }));
  picture();
  const QPoint hidden = inView(kBallCenter + Vector3d(0.0, 0.0, 6.0));
  const QPoint drawn = inView(kBallCenter - Vector3d(0.0, 0.0, 9.0));
  const auto click = [this](const QPoint& at)
  {
    QTest::mouseMove(&view(), at);
    QTest::mouseClick(&view(), Qt::LeftButton, Qt::NoModifier, at);
  };
  const Vector3d before = window().model().crosshair();
  click(hidden);
  EXPECT_EQ(window().model().crosshair(), before);
  EXPECT_TRUE(window().statusBar()->currentMessage().contains("cut away"))
      << window().statusBar()->currentMessage().toStdString();
  click(drawn);
  const Vector3d after = window().model().crosshair();
  EXPECT_NE(after, before);
  EXPECT_NEAR((after - kBallCenter).norm(), kBallRadius, 0.1);
  EXPECT_LT(after.z(), kBallCenter.z() - 6.2);

  action("Distance")->trigger();
  auto* measure = window().findChild<MeasureController*>();
  ASSERT_TRUE(measure && measure->active());
  click(hidden);
  EXPECT_FALSE(measure->hasPoints());
  click(drawn);
  EXPECT_TRUE(measure->hasPoints());
  measure->leaveTool();

  // The pointer feels all of it, and the window shows all.
  QTest::keyClick(&view(), Qt::Key_P);
  ASSERT_TRUE(waitFor([this] { return view().tool().GetProbeMode() != 0; }));
  picture();
  click(hidden);
  EXPECT_GT(window().model().crosshair().z(), kBallCenter.z());
}

TEST_F(ClippingBox, IsMovedAsAWholeByItsMiddleAndByShift)
{
  scene::Case ball = ballCase("ball");
  const core::IndexBox box{{16, 16, 16}, {48, 48, 48}};
  ball.view.clipping.crop = box;
  library().save(ball);
  openWindow("ball");
  action("Crop box")->trigger();
  picture();
  const auto middle = [this]
  {
    const presenters::CropFrame frame(window().model().value().ct.geometry);
    return Vector3d(frame.box(clipping().crop).box.center());
  };
  // From the side of the ear the head is up; the middle is one of the faces' handles, too, but
  // those would be dragged along the line of sight.
  const Vector3d before = middle();
  const QPoint from = inView(before);
  const double pixelsPerMm = (from.y() - inView(before + Vector3d(0.0, 0.0, 4.0)).y()) / 4.0;
  ASSERT_GT(pixelsPerMm, 1.0);
  drag(view(), from, from - QPoint(0, static_cast<int>(std::lround(3.0 * pixelsPerMm))));
  ASSERT_TRUE(clipping().crop);
  EXPECT_EQ(clipping().crop->size(), box.size());
  EXPECT_NEAR((middle() - before - Vector3d(0.0, 0.0, 3.0)).norm(), 0.0, 0.5);
  undo(); // one step
  EXPECT_EQ(clipping().crop, box);

  // In a slice, by an edge with Shift; within the slice only.
  const QPoint edge = leftEdge(box);
  const double mmPerPixel = axial().slice().mmPerPixel();
  const int pixels = static_cast<int>(std::lround(4.0 / mmPerPixel)); // 8 voxels
  const auto shifted = [this](QEvent::Type type, const QPoint& at)
  {
    QMouseEvent event(type, at, type == QEvent::MouseMove ? Qt::NoButton : Qt::LeftButton,
                      type == QEvent::MouseButtonRelease ? Qt::NoButton : Qt::LeftButton,
                      Qt::ShiftModifier);
    QApplication::sendEvent(&axial(), &event);
  };
  shifted(QEvent::MouseButtonPress, edge);
  shifted(QEvent::MouseMove, edge - QPoint(pixels / 2, 0));
  shifted(QEvent::MouseMove, edge - QPoint(pixels, 0));
  shifted(QEvent::MouseButtonRelease, edge - QPoint(pixels, 0));
  ASSERT_TRUE(clipping().crop);
  EXPECT_EQ(clipping().crop->size(), box.size());
  EXPECT_NEAR((middle() - before - Vector3d(-4.0, 0.0, 0.0)).norm(), 0.0, 0.5 + mmPerPixel);
  undo();
  EXPECT_EQ(clipping().crop, box);
}

TEST_F(ClippingBox, APlaneThatIsDraggedTellsHowDeepItIs)
{
  ASSERT_NO_FATAL_FAILURE(openCut());
  const scene::ViewState::Clipping::Plane plane = clipping().planes.front();
  action("Anterior")->trigger();
  picture();
  const Vector3d tip = plane.point + 8.0 * plane.normal;
  const QPoint from = inView(tip);
  const QPoint to = inView(tip + 3.0 * plane.normal);
  const auto isRead = [](const QString& text)
  { return text.contains("mm behind the bone's surface"); };
  QTest::mousePress(&view(), Qt::LeftButton, Qt::NoModifier, from);
  moveTo(view(), (from + to) / 2);
  moveTo(view(), to);
  QStringList texts = textsInView();
  EXPECT_TRUE(std::any_of(texts.begin(), texts.end(), isRead)) << texts.join("; ").toStdString();
  QTest::mouseRelease(&view(), Qt::LeftButton, Qt::NoModifier, to);
  texts = textsInView();
  EXPECT_FALSE(std::any_of(texts.begin(), texts.end(), isRead));
  // The line through the plane's point along its normal enters the ball at the square root.
  const Vector3d at = clipping().planes.front().point - kBallCenter;
  const double along = at.dot(plane.normal);
  const double half = std::sqrt(kBallRadius * kBallRadius - (at.squaredNorm() - along * along));
  action("Cut deeper")->trigger();
  const QString said = window().statusBar()->currentMessage();
  EXPECT_TRUE(said.contains(QString::number(along + half + 0.5, 'f', 1) + " mm behind") ||
              said.contains(QString::number(along + half + 0.6, 'f', 1) + " mm behind") ||
              said.contains(QString::number(along + half + 0.4, 'f', 1) + " mm behind"))
      << said.toStdString() << ", expected " << along + half + 0.5;
  EXPECT_TRUE(said.contains("moved by 0.5 mm")) << said.toStdString();
}

TEST_F(ClippingBox, ThePlaneIsALineInTheSlices)
{
  ASSERT_NO_FATAL_FAILURE(openCut());
  action("Anterior")->trigger();
  ASSERT_TRUE(waitFor([this] { return axial().isFine(); }));
  const auto violet = [this] // smoothed, it is darker
  {
    const QImage image = axial().grab().toImage();
    int count = 0;
    for (int y = 0; y < image.height(); ++y)
      for (int x = 0; x < image.width(); ++x)
      {
        const QColor one = image.pixelColor(x, y);
        count += one.blue() > 130 && one.red() > one.green() + 20 && one.blue() > one.red() + 20;
      }
    return count;
  };
  EXPECT_GT(violet(), 30);
  action("Show what was cut away")->trigger();
  EXPECT_LT(violet(), 5);
}

TEST_F(ClippingBox, ItsSizeInASliceLiesOnNoOtherText)
{
  saveBall("ball");
  openWindow("ball");
  const presenters::CropFrame frame(window().model().value().ct.geometry);
  const presenters::HandledBox box = frame.box(core::IndexBox{{4, 4, 4}, {60, 60, 60}});
  const presenters::SliceGeometry slice = axial().slice();
  QImage image(slice.width(), slice.height(), QImage::Format_RGB32);
  QPainter painter(&image);
  const QRectF first = paintBox(painter, box, false, slice, {});
  ASSERT_FALSE(first.isEmpty());
  const QRectF second = paintBox(painter, box, false, slice, {first});
  EXPECT_FALSE(second.isEmpty());
  EXPECT_FALSE(second.intersects(first));
  EXPECT_TRUE(QRectF(image.rect()).contains(second));
}

// Of the widths that slices have, from the narrowest on.
TEST_F(ClippingBox, AReadingIsWholeInEverySlice)
{
  const QString text = "25.1 mm before the bone's surface, moved by -7.1 mm";
  for (const QSize& size : {QSize(140, 120), QSize(200, 150), QSize(268, 220), QSize(600, 500)})
  {
    QImage image(size, QImage::Format_RGB32);
    image.fill(Qt::black);
    QPainter painter(&image);
    const QRectF picture(image.rect());
    const QRectF badge(size.width() - 90.0, size.height() - 62.0, 85.0, 22.0);
    for (const QPointF& pointer :
         {QPointF(0.0, 0.0), QPointF(size.width() - 1.0, 0.5 * size.height()),
          QPointF(0.5 * size.width(), size.height() - 1.0), badge.center()})
    {
      const QRectF box = paintReading(painter, text, pointer, cutColor(), {badge});
      EXPECT_TRUE(picture.contains(box)) << size.width() << " at " << pointer.x();
      EXPECT_FALSE(size.width() > 140 && box.intersects(badge))
          << size.width() << " at " << pointer.x();
      QFont font = painter.font();
      font.setPixelSize(12);
      const QFontMetricsF metrics(font);
      EXPECT_GE(box.width() * box.height(),
                metrics.horizontalAdvance(text) * metrics.ascent()) // all of the lines
          << size.width();
    }
    EXPECT_TRUE(
        picture.contains(paintReading(painter, QString(60, 'm'), {5.0, 60.0}, cutColor(), {})))
        << "a word that is wider than the slice";
  }
}

// Zoomed, so that no edge of the box is seen, but its size in the corner of the badge.
TEST_F(ClippingBox, ItsSizeLiesBesideTheBadgeOfTheSide)
{
  saveBall("ball");
  openWindow("ball");
  const presenters::CropFrame frame(window().model().value().ct.geometry);
  SliceBox box;
  box.handled = frame.box(core::IndexBox{{4, 4, 4}, {60, 60, 60}});
  SliceView& view = axial();
  view.setBox(box);
  scene::ViewState::Slices::Plane near;
  near.zoom = 20.0;
  view.setPlane(near);
  const auto* badge = view.findChild<QLabel*>("caseStamp");
  ASSERT_TRUE(badge && badge->isVisible());
  const auto blue = [&](const QRect& part)
  {
    QImage image(view.size(), QImage::Format_RGB32);
    view.render(&image, QPoint(), QRegion(), QWidget::RenderFlags()); // without the badge itself
    int count = 0;
    for (int y = std::max(part.top(), 0); y <= std::min(part.bottom(), image.height() - 1); ++y)
      for (int x = std::max(part.left(), 0); x <= std::min(part.right(), image.width() - 1); ++x)
      {
        const QColor pixel(image.pixel(x, y));
        count += pixel.blue() > pixel.red() + 60 && pixel.green() > pixel.red() + 30;
      }
    return count;
  };
  EXPECT_GT(blue(view.rect()), 20) << "the size is there";
  EXPECT_EQ(blue(badge->geometry()), 0);
}

TEST_F(ClippingBox, APlaneIsDraggedByItsLineInASlice)
{
  ASSERT_NO_FATAL_FAILURE(openUpright());
  const scene::ViewState::Clipping before = clipping();
  const scene::ViewState::Clipping::Plane plane = before.planes.front();
  const presenters::CutLine line = *cutLine();
  const Vector3d crosshair = window().model().crosshair();
  const Eigen::Vector2d upper = line.from + 0.35 * (line.to - line.from);
  const QPoint from = atPixel(upper);
  const QPoint to = from + QPoint(30, 0);
  drag(axial(), from, to);
  const double mm = 30.0 * axial().slice().mmPerPixel();
  ASSERT_EQ(clipping().planes.size(), 1U);
  const Vector3d moved = clipping().planes.front().point - plane.point;
  // To the left of the picture's right, the patient's left (+x).
  EXPECT_NEAR(moved.dot(plane.normal), mm * plane.normal.x(), 1e-6);
  EXPECT_LT((moved - moved.dot(plane.normal) * plane.normal).norm(), 1e-9);
  EXPECT_EQ(clipping().planes.front().normal, plane.normal);
  EXPECT_EQ(window().model().crosshair(), crosshair);
  EXPECT_EQ(window().model().undoText(), "clipping plane");
  undo(); // one step, however often the pointer moved
  EXPECT_EQ(clipping(), before);

  // A click on it is one beside it.
  QTest::mouseClick(&axial(), Qt::LeftButton, Qt::NoModifier, from);
  EXPECT_EQ(clipping(), before);
  EXPECT_NE(window().model().crosshair(), crosshair);
}

TEST_F(ClippingBox, APlaneIsTurnedByAnEndOfItsLine)
{
  ASSERT_NO_FATAL_FAILURE(openUpright());
  const scene::ViewState::Clipping before = clipping();
  const auto ends = presenters::endsOf(*cutLine());
  ASSERT_EQ(ends.size(), 2U);
  const Eigen::Vector2d pivot = axial().slice().pixelFromPatient(presenters::pivotInSlice(
      before.planes.front(), window().model().value().ct.geometry, axial().slice()));
  const QPoint from = atPixel(ends[0]);
  const QPoint to = from + QPoint(40, 0);
  const auto angle = [&](const QPoint& at)
  { return std::atan2(at.y() - pivot[1] - 0.5, at.x() - pivot[0] - 0.5); };
  const double expected = std::abs(angle(to) - angle(from));
  ASSERT_GT(expected, 0.05);
  QTest::mousePress(&axial(), Qt::LeftButton, Qt::NoModifier, from);
  moveTo(axial(), (from + to) / 2);
  moveTo(axial(), to);
  const QImage held = axial().grab().toImage();
  QTest::mouseRelease(&axial(), Qt::LeftButton, Qt::NoModifier, to);
  const QImage after = axial().grab().toImage();
  EXPECT_GT(differentPixels(held, after), 100) << "the angle stands beside the pointer";
  const scene::ViewState::Clipping::Plane turned = clipping().planes.front();
  EXPECT_NEAR(std::acos(std::clamp(turned.normal.dot(before.planes.front().normal), -1.0, 1.0)),
              expected, 1e-6);
  EXPECT_NEAR(turned.normal.z(), before.planes.front().normal.z(), 1e-9) << "in the slice's plane";
  undo();
  EXPECT_EQ(clipping(), before);

  // By keys, a degree each, held down one step.
  QApplication::setActiveWindow(&window());
  axial().setFocus();
  action("Turn the cut clockwise")->trigger();
  EXPECT_TRUE(window().statusBar()->currentMessage().contains("turned by 1.0"))
      << window().statusBar()->currentMessage().toStdString();
  const Vector3d clockwise = clipping().planes.front().normal;
  EXPECT_NEAR(clockwise.dot(before.planes.front().normal), std::cos(0.0174532925), 1e-9);
  // What points to the picture's right points down by then.
  const presenters::SliceGeometry slice = axial().slice();
  const Vector3d normal = before.planes.front().normal;
  const double cross = normal.dot(slice.axes().right) * clockwise.dot(slice.axes().down) -
                       normal.dot(slice.axes().down) * clockwise.dot(slice.axes().right);
  EXPECT_NEAR(cross, std::sin(0.0174532925), 1e-6);
  action("Turn the cut counterclockwise")->trigger();
  EXPECT_LT((clipping().planes.front().normal - normal).norm(), 1e-9);
}

// Seen from above, what points forward in the picture goes to its right when it is turned
// clockwise.
TEST_F(ClippingBox, ThePlaneIsTurnedFromTheThreeDViewAsSeenFromAbove)
{
  ASSERT_NO_FATAL_FAILURE(openCut());
  ASSERT_TRUE(settled());
  const core::CameraPose camera = view().picture().camera();
  const Vector3d forward = (camera.focalPoint - camera.position).normalized();
  const Vector3d right = forward.cross(camera.viewUp).normalized();
  const Vector3d before = clipping().planes.front().normal;
  const double towards = before.dot(forward) > 0.0 ? 1.0 : -1.0; // where it points, of the depth
  view().setFocus();
  action("Turn the cut clockwise")->trigger();
  const Vector3d clockwise = clipping().planes.front().normal;
  ASSERT_GT(std::abs(before.dot(forward)), 0.99) << "it was cut as it is looked at";
  EXPECT_NEAR(towards * (clockwise - before).dot(right), std::sin(0.0174532925), 1e-4);
  action("Turn the cut counterclockwise")->trigger();
  action("Turn the cut counterclockwise")->trigger();
  EXPECT_NEAR(towards * (clipping().planes.front().normal - before).dot(right),
              -std::sin(0.0174532925), 1e-4);
}

TEST_F(ClippingBox, TheLineOfAPlaneGivesWayToATool)
{
  ASSERT_NO_FATAL_FAILURE(openUpright());
  const scene::ViewState::Clipping before = clipping();
  const presenters::CutLine line = *cutLine();
  const QPoint from = atPixel(line.from + 0.35 * (line.to - line.from));
  action("Distance")->trigger();
  auto* measure = window().findChild<MeasureController*>();
  ASSERT_TRUE(measure && measure->active());
  drag(axial(), from, from + QPoint(30, 0));
  EXPECT_EQ(clipping(), before);
  EXPECT_TRUE(measure->hasPoints() || !window().model().value().measurements.empty())
      << "the drag is the tool's, from its first point to its second";
  measure->leaveTool();
}
