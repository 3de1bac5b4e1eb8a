#include "GuiTest.h"

#include <cmath>
#include <fstream>

#include <QApplication>
#include <QClipboard>
#include <QComboBox>
#include <QDockWidget>
#include <QFileDialog>
#include <QLabel>
#include <QLineEdit>
#include <QPushButton>
#include <QSignalSpy>
#include <QStatusBar>
#include <QTreeWidget>

#include <vtkActor2D.h>
#include <vtkCamera.h>
#include <vtkNew.h>
#include <vtkPropCollection.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkTextActor.h>
#include <vtkTextProperty.h>
#include <vtkUnsignedCharArray.h>

#include "MeasureController.h"
#include "MeasureOverlay.h"
#include "PixelsPerPoint.h"
#include "SliceColumn.h"
#include "SliceMarks.h"
#include "SliceView.h"
#include "petrous/Core/CsvTable.h"

using namespace petrous;
using namespace petrous::workstation;
using Eigen::Vector3d;
using Kind = scene::Measurement::Kind;

namespace
{

class MeasureWindow : public GuiTest
{
protected:
  template <class Widget>
  Widget& find(const char* name)
  {
    auto* found = window().findChild<Widget*>(name);
    EXPECT_TRUE(found) << name;
    return *found;
  }
  SliceView& axial() { return find<SliceView>("axialView"); }
  QTreeWidget& list() { return find<QTreeWidget>("measurements"); }
  presenters::WorkstationModel& model()
  {
    return const_cast<presenters::WorkstationModel&>(window().model());
  }
  const std::vector<scene::Measurement>& all() { return window().model().value().measurements; }
  double value(std::size_t n) { return *scene::valueOf(all()[n].kind, all()[n].points); }
  std::vector<scene::Measurement> saved()
  {
    EXPECT_TRUE(settled());
    return library().open("ball").measurements;
  }
  QPoint pixelOf(const Vector3d& patient)
  {
    const Eigen::Vector2d at =
        axial().slice().pixelFromPatient(patient) + Eigen::Vector2d(0.5, 0.5);
    return {static_cast<int>(std::floor(at[0])), static_cast<int>(std::floor(at[1]))};
  }
  Vector3d patientOf(const QPoint& pixel)
  {
    return axial().slice().patientFromPixel(pixel.x() - 0.5, pixel.y() - 0.5);
  }
  // Each is one event of the user's.
  void key(int code, Qt::KeyboardModifiers modifiers = Qt::ShiftModifier)
  {
    QTest::keyClick(&window(), static_cast<Qt::Key>(code), modifiers);
    ++m_events;
  }
  void click(const Vector3d& patient)
  {
    QTest::mouseClick(&axial(), Qt::LeftButton, Qt::NoModifier, pixelOf(patient));
    ++m_events;
  }
  void measureDistance(const Vector3d& from, const Vector3d& to)
  {
    key(Qt::Key_D);
    click(from);
    click(to);
  }
  void clickView(const QPoint& at)
  {
    QTest::mouseMove(&view(), at);
    QTest::mouseClick(&view(), Qt::LeftButton, Qt::NoModifier, at);
    ++m_events;
  }
  /// The pointer, with the left button held.
  static void pull(QWidget& widget, const QPoint& to)
  {
    QMouseEvent move(QEvent::MouseMove, to, Qt::LeftButton, Qt::LeftButton, Qt::NoModifier);
    QApplication::sendEvent(&widget, &move);
  }
  void openBall()
  {
    saveBall("ball");
    openWindow("ball");
    EXPECT_TRUE(waitFor([this] { return model().ready(); }));
    model().setCrosshair(kBallCenter);
  }
  int m_events = 0;
};

/// 10 pixels a mm, seen along z: right is x, up is y.
struct FlatView
{
  explicit FlatView(int width = 600, int height = 400)
  {
    target->SetOffScreenRendering(1);
    target->SetMultiSamples(0);
    target->SetSize(width, height);
    target->AddRenderer(renderer);
    vtkCamera* camera = renderer->GetActiveCamera();
    camera->ParallelProjectionOn();
    camera->SetPosition(0.0, 0.0, 100.0);
    camera->SetFocalPoint(0.0, 0.0, 0.0);
    camera->SetViewUp(0.0, 1.0, 0.0);
    camera->SetParallelScale(0.05 * height);
    camera->SetClippingRange(1.0, 200.0);
  }

  vtkNew<vtkRenderWindow> target;
  vtkNew<vtkRenderer> renderer;
};

} // namespace

TEST(MeasureOverlay, ALabelIsFaintWhereTheToolIs)
{
  FlatView flat;
  MeasureOverlay overlay(*flat.renderer);
  DrawnMeasure one;
  one.points = {{-6.0, 0.0, 0.0}, {0.0, 0.0, 0.0}};
  one.handles = {0, 1};
  one.label = "distance 1: 6.00 mm"; // from about 1 to 16 mm at the right of the handle
  one.color = Qt::cyan;
  one.chosen = true;
  overlay.set({one});
  vtkTextProperty* look = nullptr;
  vtkPropCollection* props = flat.renderer->GetViewProps();
  vtkCollectionSimpleIterator at;
  props->InitTraversal(at);
  while (vtkProp* prop = props->GetNextProp(at))
    if (auto* label = vtkTextActor::SafeDownCast(prop))
      look = label->GetTextProperty();
  ASSERT_TRUE(look);
  overlay.place();
  EXPECT_EQ(look->GetOpacity(), 1.0);
  EXPECT_EQ(look->GetFrame(), 1);
  const double plate = look->GetBackgroundOpacity();

  rendering::ToolPose tool;
  tool.center = {8.0, -15.0, 30.0};
  tool.axisToHand = {0.0, 1.0, 0.0}; // the shaft crosses the label
  overlay.place(tool);
  EXPECT_LT(look->GetOpacity(), 0.5);
  EXPECT_LT(look->GetBackgroundOpacity(), 0.5 * plate);
  EXPECT_EQ(look->GetFrame(), 0);
  tool.axisToHand = {0.0, -1.0, 0.0}; // away from it
  overlay.place(tool);
  EXPECT_EQ(look->GetOpacity(), 1.0);
  EXPECT_EQ(look->GetBackgroundOpacity(), plate);
  tool.center = {8.0, -32.0, 30.0};
  tool.axisToHand = {0.0, 1.0, 0.0}; // its handpiece, 30 mm from the burr
  overlay.place(tool);
  EXPECT_LT(look->GetOpacity(), 0.5);
  overlay.place(std::nullopt);
  EXPECT_EQ(look->GetOpacity(), 1.0);
}

// A handle of the second lies where the first one's label would be, and a line crosses it.
TEST(MeasureOverlay, LabelsLieOnNoHandleAndOverAllLines)
{
  FlatView flat;
  vtkRenderer* const renderer = flat.renderer;
  MeasureOverlay overlay(*renderer);
  DrawnMeasure first;
  first.points = {{-1.0, 0.0, 0.0}, {0.0, 0.0, 0.0}};
  first.handles = {0, 1};
  first.label = "distance 1: 4.97 mm";
  first.color = Qt::cyan;
  DrawnMeasure second = first;
  second.points = {{4.0, 1.8, 0.0}, {14.0, -3.0, 0.0}};
  second.label = "distance 2: 15.26 mm";
  overlay.set({first, second});
  overlay.place();
  flat.target->Render();

  std::vector<vtkTextActor*> labels;
  vtkPropCollection* props = renderer->GetViewProps();
  vtkCollectionSimpleIterator at;
  props->InitTraversal(at);
  while (vtkProp* prop = props->GetNextProp(at))
    if (auto* label = vtkTextActor::SafeDownCast(prop))
      labels.push_back(label);
    else
      EXPECT_TRUE(labels.empty()) << "drawn over a label";
  ASSERT_EQ(labels.size(), 2U);
  for (vtkTextActor* label : labels)
  {
    const int* const low = label->GetPositionCoordinate()->GetComputedDisplayValue(renderer);
    const double left = low[0], bottom = low[1];
    double size[2] = {0.0, 0.0};
    label->GetSize(renderer, size);
    EXPECT_GT(size[0], 50.0);
    for (const DrawnMeasure& measure : overlay.measures())
      for (const Vector3d& handle : measure.points)
      {
        const double x = 300.0 + 10.0 * handle.x();
        const double y = 200.0 + 10.0 * handle.y();
        EXPECT_FALSE(x > left && x < left + size[0] && y > bottom && y < bottom + size[1])
            << label->GetInput() << " on " << handle.transpose();
      }
  }
}

// Points of measurements, faces of a box and its middle differ: by their area, for a radius of
// 4.5 px.
TEST(MeasureOverlay, HandlesHaveFormsOfTheirOwn)
{
  FlatView flat(200, 200);
  MeasureOverlay overlay(*flat.renderer);
  DrawnMeasure measure;
  measure.points = {{0.0, 0.0, 0.0}};
  measure.handles = {0};
  measure.color = QColor(0, 255, 255);
  measure.chosen = true;
  const auto area = [&](DrawnMeasure::Form form)
  {
    measure.form = form;
    overlay.set({measure});
    overlay.place();
    flat.target->Render();
    vtkNew<vtkUnsignedCharArray> pixels;
    flat.target->GetRGBACharPixelData(0, 0, 199, 199, 0, pixels);
    int count = 0;
    for (vtkIdType n = 0; n < pixels->GetNumberOfTuples(); ++n)
      count += pixels->GetValue(4 * n) < 100 && pixels->GetValue(4 * n + 1) > 150;
    return count;
  };
  const double scale = pixelsPerPoint(*flat.renderer);
  const double squared = scale * scale * 4.5 * 4.5;
  EXPECT_NEAR(area(DrawnMeasure::Form::Square), 4.0 * squared, 0.2 * squared);
  EXPECT_NEAR(area(DrawnMeasure::Form::Dot), 3.06 * squared, 0.3 * squared);
  EXPECT_NEAR(area(DrawnMeasure::Form::Diamond), 2.0 * 1.8 * 1.8 * squared, 0.9 * squared);
}

// Compared with 3D Slicer and ITK-SNAP: at most three events for a distance.
TEST_F(MeasureWindow, ADistanceTakesThreeEvents)
{
  openBall();
  const Vector3d from = kBallCenter + Vector3d(-8, 0, 0);
  const Vector3d to = kBallCenter + Vector3d(6, 5, 0);
  m_events = 0;
  measureDistance(from, to);
  EXPECT_LE(m_events, 3);
  ASSERT_EQ(all().size(), 1U);
  const double expected = (patientOf(pixelOf(to)) - patientOf(pixelOf(from))).norm();
  EXPECT_NEAR(value(0), expected, 1.5 * axial().slice().mmPerPixel());
  EXPECT_NEAR(value(0), (to - from).norm(), 3.0 * axial().slice().mmPerPixel());
  EXPECT_EQ(all()[0].points[0].z(), kBallCenter.z()) << "in the slice";
  EXPECT_TRUE(find<QDockWidget>("measureDock").isVisible());
  ASSERT_EQ(list().topLevelItemCount(), 1);
  EXPECT_TRUE(list().topLevelItem(0)->text(1).contains(" mm ± "))
      << list().topLevelItem(0)->text(1).toStdString();
  ASSERT_EQ(saved().size(), 1U);
  EXPECT_EQ(saved()[0], all()[0]);
}

TEST_F(MeasureWindow, ADistanceCanBePulledAndItsEndsCanBe)
{
  openBall();
  key(Qt::Key_D);
  const auto drag = [&](const Vector3d& from, const Vector3d& to)
  {
    QTest::mousePress(&axial(), Qt::LeftButton, Qt::NoModifier, pixelOf(from));
    pull(axial(), (pixelOf(from) + pixelOf(to)) / 2);
    pull(axial(), pixelOf(to));
    QTest::mouseRelease(&axial(), Qt::LeftButton, Qt::NoModifier, pixelOf(to));
  };
  const Vector3d a = kBallCenter + Vector3d(-8, 0, 0);
  const Vector3d b = kBallCenter + Vector3d(2, 0, 0);
  const Vector3d c = kBallCenter + Vector3d(10, -6, 0);
  const double pixel = axial().slice().mmPerPixel();
  drag(a, b);
  ASSERT_EQ(all().size(), 1U);
  EXPECT_NEAR(value(0), 10.0, 3.0 * pixel);
  key(Qt::Key_Escape, Qt::NoModifier);
  QTest::keyClick(&axial(), Qt::Key_Escape);
  drag(b, c); // without a tool
  ASSERT_EQ(all().size(), 1U);
  EXPECT_NEAR(value(0), (c - a).norm(), 3.0 * pixel);
  EXPECT_EQ(model().crosshair(), kBallCenter) << "the handle took the button";
  ASSERT_EQ(saved().size(), 1U);
  EXPECT_EQ(saved()[0], all()[0]);
}

TEST_F(MeasureWindow, UndoAndRedoAreTheToolsWhileItIsInUse)
{
  openBall();
  key(Qt::Key_D);
  click(kBallCenter);
  EXPECT_EQ(action("Undo the last point")->isEnabled(), true);
  key(Qt::Key_Z, Qt::ControlModifier);
  click(kBallCenter);
  click(kBallCenter + Vector3d(5, 0, 0));
  ASSERT_EQ(all().size(), 1U);
  key(Qt::Key_Z, Qt::ControlModifier);
  EXPECT_TRUE(all().empty());
  EXPECT_TRUE(saved().empty());
  key(Qt::Key_Z, Qt::ControlModifier | Qt::ShiftModifier);
  ASSERT_EQ(all().size(), 1U);
  EXPECT_EQ(saved().size(), 1U);
  QTest::keyClick(&axial(), Qt::Key_Escape);
  EXPECT_TRUE(action("Undo")->isEnabled()) << "whatever tool is in use";
  action("Undo")->trigger();
  EXPECT_TRUE(all().empty());
  action("Redo")->trigger();
  EXPECT_EQ(all().size(), 1U);
}

TEST_F(MeasureWindow, AnAngleAndAPolygonInASlice)
{
  openBall();
  const double pixel = axial().slice().mmPerPixel();
  key(Qt::Key_A);
  click(kBallCenter + Vector3d(9, 0, 0));
  click(kBallCenter);
  click(kBallCenter + Vector3d(0, 9, 0));
  ASSERT_EQ(all().size(), 1U);
  EXPECT_NEAR(value(0), 90.0, 57.3 * 3.0 * pixel / 9.0);
  key(Qt::Key_R);
  click(kBallCenter + Vector3d(-8, -8, 0));
  click(kBallCenter + Vector3d(8, -8, 0));
  click(kBallCenter + Vector3d(8, 8, 0));
  const QPoint last = pixelOf(kBallCenter + Vector3d(-8, 8, 0));
  QTest::mouseClick(&axial(), Qt::LeftButton, Qt::NoModifier, last);
  QTest::mouseDClick(&axial(), Qt::LeftButton, Qt::NoModifier, last);
  ASSERT_EQ(all().size(), 2U);
  EXPECT_EQ(all()[1].points.size(), 4U);
  EXPECT_NEAR(value(1), 256.0, 4.0 * 16.0 * pixel);
}

TEST_F(MeasureWindow, PointsOfAToolThatIsPutAwayAreMeasuredOrToldOf)
{
  openBall();
  key(Qt::Key_R);
  click(kBallCenter + Vector3d(-8, -8, 0));
  click(kBallCenter + Vector3d(8, -8, 0));
  click(kBallCenter + Vector3d(8, 8, 0));
  ASSERT_TRUE(all().empty());
  key(Qt::Key_D);
  ASSERT_EQ(all().size(), 1U);
  EXPECT_EQ(all()[0].kind, Kind::Area);
  EXPECT_EQ(all()[0].points.size(), 3U);
  action("Undo")->trigger();
  EXPECT_TRUE(all().empty()) << "as any other";
  click(kBallCenter);
  key(Qt::Key_R);
  EXPECT_TRUE(all().empty());
  EXPECT_TRUE(window().statusBar()->currentMessage().contains("dropped"))
      << window().statusBar()->currentMessage().toStdString();
}

// At the place of the plane's name, where a label would lie by itself.
TEST_F(MeasureWindow, ALabelLiesOnNoTextOfTheSlice)
{
  openBall();
  ASSERT_TRUE(settled());
  const QRect name(0, 0, 60, 20); // px
  DrawnMeasure mark;
  mark.points = {patientOf(QPoint(12, 28))};
  mark.handles = {0};
  mark.label = "Distance 1: 12.3 mm";
  mark.color = Qt::yellow;
  const auto drawn = [this]
  { return axial().grab().toImage().convertToFormat(QImage::Format_RGB32); };
  ASSERT_TRUE(waitFor([this] { return axial().isFine(); }));
  const QImage before = steady(drawn);
  axial().setMeasures({mark});
  const QImage after = steady(drawn);
  EXPECT_EQ(differentPixels(before.copy(name), after.copy(name), kSmoothing), 0);
  // About 100 px of letters on a ground of their own.
  EXPECT_GT(differentPixels(before, after, kSmoothing), 500);
}

// The ball's surface is under the view's middle; the patient turns when the button is dragged.
TEST_F(MeasureWindow, ClicksInTheViewSetPointsOnTheSurface)
{
  openBall();
  picture();
  key(Qt::Key_K);
  const QPoint middle = view().rect().center();
  clickView(middle);
  ASSERT_EQ(all().size(), 1U);
  EXPECT_NEAR((all()[0].points[0] - kBallCenter).norm(), kBallRadius, 0.6);
  const core::CameraPose before = view().picture().camera();
  QTest::mousePress(&view(), Qt::LeftButton, Qt::NoModifier, middle + QPoint(60, 0));
  pull(view(), middle + QPoint(80, 10));
  pull(view(), middle + QPoint(100, 30));
  QTest::mouseRelease(&view(), Qt::LeftButton, Qt::NoModifier, middle + QPoint(100, 30));
  EXPECT_EQ(all().size(), 1U);
  EXPECT_GT((view().picture().camera().position - before.position).norm(), 1.0);
  clickView(QPoint(3, 3)); // air
  EXPECT_EQ(all().size(), 1U);
  EXPECT_FALSE(find<QLabel>("measureHint").text().isEmpty());
}

TEST_F(MeasureWindow, AHandleIsDraggedAlongTheSurfaceInTheView)
{
  openBall();
  picture();
  key(Qt::Key_K);
  const QPoint middle = view().rect().center();
  clickView(middle);
  ASSERT_EQ(all().size(), 1U);
  const Vector3d before = all()[0].points[0];
  picture();
  const core::CameraPose camera = view().picture().camera();
  QTest::mousePress(&view(), Qt::LeftButton, Qt::NoModifier, middle);
  pull(view(), middle + QPoint(20, 0));
  pull(view(), middle + QPoint(40, 10));
  QTest::mouseRelease(&view(), Qt::LeftButton, Qt::NoModifier, middle + QPoint(40, 10));
  EXPECT_GT((all()[0].points[0] - before).norm(), 1.0);
  EXPECT_NEAR((all()[0].points[0] - kBallCenter).norm(), kBallRadius, 0.6);
  EXPECT_EQ(view().picture().camera().position, camera.position) << "the patient stays";
}

// Through the ball along the normal: its diameter less the nerve's place.
TEST_F(MeasureWindow, AWallIsMeasuredByOneClick)
{
  openBall();
  picture();
  key(Qt::Key_W);
  clickView(view().rect().center());
  EXPECT_TRUE(all().empty()) << "the window's thread does not wait for it";
  ASSERT_TRUE(waitFor([this] { return all().size() == 1U; }))
      << find<QLabel>("measureHint").text().toStdString();
  EXPECT_EQ(all()[0].kind, Kind::Thickness);
  EXPECT_EQ(all()[0].points.size(), 3U);
  EXPECT_GT(value(0), 1.0);
  EXPECT_LE(value(0), 2.0 * kBallRadius + 1.0);
  EXPECT_NEAR((all()[0].points[0] - kBallCenter).norm(), kBallRadius, 0.6);
}

TEST_F(MeasureWindow, TheListRenamesHidesGoesToAndDeletes)
{
  openBall();
  const QImage empty = picture();
  measureDistance(kBallCenter + Vector3d(-8, 0, 0), kBallCenter + Vector3d(8, 0, 0));
  QTest::keyClick(&axial(), Qt::Key_Escape);
  ASSERT_EQ(list().topLevelItemCount(), 1);
  EXPECT_GT(differentPixels(picture(), empty, 40), 100) << "drawn in the view";
  QTreeWidgetItem* item = list().topLevelItem(0);
  item->setText(0, "Bulb to canal");
  EXPECT_EQ(all()[0].name, "Bulb to canal");
  item->setText(0, "zero\u200bwidth");
  EXPECT_EQ(all()[0].name, "Bulb to canal");
  EXPECT_EQ(list().topLevelItem(0)->text(0), "Bulb to canal") << "as it is";
  model().setCrosshair(kBallCenter + Vector3d(3, 3, 3));
  list().setCurrentItem(item);
  find<QPushButton>("goToMeasurement").click();
  EXPECT_NEAR((model().crosshair() - kBallCenter).norm(), 0.0, 1.0);
  find<QPushButton>("copyMeasurements").click();
  EXPECT_TRUE(QApplication::clipboard()->text().startsWith("Bulb to canal\t1"))
      << QApplication::clipboard()->text().toStdString();
  item->setCheckState(0, Qt::Unchecked);
  EXPECT_FALSE(all()[0].shown);
  EXPECT_LT(differentPixels(picture(), empty, 40), 20);
  find<QPushButton>("removeMeasurement").click();
  EXPECT_TRUE(all().empty());
  EXPECT_EQ(list().topLevelItemCount(), 0);
  EXPECT_TRUE(saved().empty());
}

TEST_F(MeasureWindow, ExportsATable)
{
  openBall();
  measureDistance(kBallCenter, kBallCenter + Vector3d(0, 7, 0));
  const auto file = folder() / "table.csv";
  onDialog(
      [&](QDialog& dialog)
      {
        auto* files = qobject_cast<QFileDialog*>(&dialog);
        if (!files)
          return false;
        files->selectFile(QString::fromStdString(file.string()));
        dialog.done(QDialog::Accepted);
        return true;
      });
  find<QPushButton>("exportMeasurements").click();
  std::ifstream in(file, std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(in), {}};
  const auto rows = core::csvRows(text, "table", ',');
  ASSERT_GE(rows.size(), 2U);
  EXPECT_EQ(rows[1].cells[0], "distance 1");
  EXPECT_EQ(rows[1].cells[4], "mm");
  EXPECT_NE(text.find("nerve,structure,volume"), std::string::npos);
}

// Also where the ending is added to what was typed, which is not yet the name of a file.
TEST_F(MeasureWindow, AsksBeforeATableReplacesAFile)
{
  openBall();
  measureDistance(kBallCenter, kBallCenter + Vector3d(0, 7, 0));
  const auto file = folder() / "table.csv";
  std::ofstream(file) << "mine";
  int asked = 0;
  onDialog(
      [&](QDialog& dialog)
      {
        if (auto* files = qobject_cast<QFileDialog*>(&dialog))
        {
          if (asked > 0) // again after "Cancel": given up
          {
            dialog.reject();
            return true;
          }
          files->findChild<QLineEdit*>("fileNameEdit")
              ->setText(QString::fromStdString((folder() / "table").string()));
          dialog.done(QDialog::Accepted);
          return false;
        }
        if (dialog.objectName() != "askReplace")
          return false;
        ++asked;
        dialog.reject();
        return false;
      });
  find<QPushButton>("exportMeasurements").click();
  EXPECT_EQ(asked, 1);
  std::ifstream in(file, std::ios::binary);
  EXPECT_EQ(std::string(std::istreambuf_iterator<char>(in), {}), "mine");
}

TEST_F(MeasureWindow, OffersNoTableThatWouldBeEmpty)
{
  scene::Case value = ballCase("bare");
  value.labels.clear();
  library().save(value);
  openWindow("bare");
  QAction* table = action(QString::fromUtf8("Export as a table…"));
  EXPECT_FALSE(table->isEnabled());
  EXPECT_FALSE(find<QPushButton>("exportMeasurements").isEnabled());
  drill(600);
  ASSERT_TRUE(strokeEnds());
  EXPECT_TRUE(table->isEnabled()) << "the volume that was drilled";
  EXPECT_TRUE(find<QPushButton>("exportMeasurements").isEnabled());
}

TEST_F(MeasureWindow, StatesTheDimensionsOfAStructure)
{
  openBall();
  key(Qt::Key_M, Qt::ControlModifier);
  EXPECT_TRUE(find<QDockWidget>("measureDock").isVisible());
  auto& quantities = find<QTreeWidget>("measureQuantities");
  find<QPushButton>("measureStructureNow").click();
  ASSERT_TRUE(waitFor([&] { return quantities.topLevelItemCount() >= 5; }));
  EXPECT_EQ(quantities.topLevelItem(0)->text(0), "volume");
  EXPECT_TRUE(quantities.topLevelItem(0)->text(1).contains("mm³ ± "));
}

// Enter ends the name and nothing else.
TEST_F(MeasureWindow, ANameIsTypedAndTheCrosshairStays)
{
  openBall();
  measureDistance(kBallCenter + Vector3d(-8, 0, 0), kBallCenter + Vector3d(8, 6, 0));
  QTest::keyClick(&axial(), Qt::Key_Escape);
  model().setCrosshair(kBallCenter + Vector3d(3, 3, 3));
  const Vector3d before = model().crosshair();
  list().setFocus();
  list().setCurrentItem(list().topLevelItem(0));
  find<QPushButton>("renameMeasurement").click();
  auto* line = list().viewport()->findChild<QLineEdit*>();
  ASSERT_TRUE(line);
  line->selectAll();
  QTest::keyClicks(line, "Bulb to canal");
  QTest::keyClick(line, Qt::Key_Return);
  EXPECT_TRUE(waitFor([this] { return all()[0].name == "Bulb to canal"; }));
  EXPECT_EQ(model().crosshair(), before);
  QTest::keyClick(&list(), Qt::Key_Return); // now it is the list's
  EXPECT_GT((model().crosshair() - before).norm(), 1.0);
}

// Each move of the pointer once: labels, list and picture are drawn anew for it.
TEST_F(MeasureWindow, ADraggedHandleRefreshesOnceForEachMove)
{
  openBall();
  key(Qt::Key_D);
  const Vector3d end = kBallCenter + Vector3d(8, 0, 0);
  click(kBallCenter + Vector3d(-8, 0, 0));
  click(end);
  QTest::keyClick(&axial(), Qt::Key_Escape);
  QSignalSpy refreshed(window().findChild<MeasureController*>(), &MeasureController::stateChanged);
  QTest::mousePress(&axial(), Qt::LeftButton, Qt::NoModifier, pixelOf(end));
  const int before = refreshed.count();
  pull(axial(), pixelOf(end) + QPoint(10, 0));
  EXPECT_EQ(refreshed.count(), before + 1);
  pull(axial(), pixelOf(end) + QPoint(20, 5));
  EXPECT_EQ(refreshed.count(), before + 2);
  QTest::mouseRelease(&axial(), Qt::LeftButton, Qt::NoModifier, pixelOf(end) + QPoint(20, 5));
  EXPECT_GT((all()[0].points[1] - end).norm(), 1.0);
}

// The slice lies above the ball, of which a slab shows the top.
TEST_F(MeasureWindow, InASlabOfTheBrightestAPointLiesWhereWhatIsSeenLies)
{
  openBall();
  model().setCrosshair(kBallCenter + Vector3d(0, 0, 14));
  const double slice = model().crosshair().z();
  ASSERT_LT(*model().hounsfieldAt(model().crosshair()), 0.0) << "air";
  auto& slices = find<SliceColumn>("slices");
  slices.setSlab({10.0, presenters::Projection::Maximum});
  key(Qt::Key_D);
  const Vector3d off = kBallCenter + Vector3d(4, 0, 14);
  click(model().crosshair());
  click(off);
  ASSERT_EQ(all().size(), 1U);
  for (const Vector3d& point : all()[0].points)
  {
    EXPECT_GT(*model().hounsfieldAt(point), 500.0) << point.transpose();
    EXPECT_LE(std::abs(point.z() - slice), 5.0 + 1e-9);
    EXPECT_LT((point - kBallCenter).norm(), kBallRadius + 0.6);
  }
  // It is seen there, too: its handle can be taken, and stays on what is seen.
  QTest::keyClick(&axial(), Qt::Key_Escape);
  QTest::mousePress(&axial(), Qt::LeftButton, Qt::NoModifier, pixelOf(off));
  pull(axial(), pixelOf(kBallCenter + Vector3d(4, 2, 0)));
  pull(axial(), pixelOf(kBallCenter + Vector3d(4, 3, 0)));
  QTest::mouseRelease(&axial(), Qt::LeftButton, Qt::NoModifier,
                      pixelOf(kBallCenter + Vector3d(4, 3, 0)));
  EXPECT_NEAR(all()[0].points[1].y(), kBallCenter.y() + 3.0, 1.0);
  EXPECT_GT(*model().hounsfieldAt(all()[0].points[1]), 500.0);
  // The darkest of a slab that reaches out of the ball is the air above it.
  model().setCrosshair(kBallCenter + Vector3d(0, 0, 10));
  slices.setSlab({10.0, presenters::Projection::Minimum});
  key(Qt::Key_K);
  click(kBallCenter + Vector3d(-5, -5, 10)); // away from the handles
  ASSERT_EQ(all().size(), 2U);
  EXPECT_LT(*model().hounsfieldAt(all()[1].points[0]), 0.0);
  // The mean has no depth of its own.
  slices.setSlab({10.0, presenters::Projection::Mean});
  click(kBallCenter + Vector3d(-5, 5, 10));
  ASSERT_EQ(all().size(), 3U);
  EXPECT_NEAR(all()[2].points[0].z(), model().crosshair().z(), 1e-9);
}

TEST_F(MeasureWindow, MeasuresAlikeInZoomedAndInTurnedSlices)
{
  openBall();
  const Vector3d from = kBallCenter + Vector3d(-3, 1, 0);
  const Vector3d to = kBallCenter + Vector3d(2, 3, 0);
  for (int n = 0; n < 8; ++n)
    QTest::keyClick(&axial(), Qt::Key_Plus);
  ASSERT_GT(axial().plane().zoom, 4.0);
  measureDistance(from, to);
  ASSERT_EQ(all().size(), 1U);
  EXPECT_NEAR(value(0), (to - from).norm(), 3.0 * axial().slice().mmPerPixel());
  EXPECT_LT((all()[0].points[0] - from).norm(), 2.0 * axial().slice().mmPerPixel());
  // In a plane that was turned and tilted about the crosshair.
  for (int n = 0; n < 25; ++n)
    QTest::keyClick(&axial(), Qt::Key_Down, Qt::ControlModifier);
  const presenters::SliceAxes axes = axial().slice().axes();
  ASSERT_LT(axes.next.z(), 0.95);
  const Vector3d a = kBallCenter - 2.0 * axes.right - 3.0 * axes.down; // away from the handles
  const Vector3d b = kBallCenter + 3.0 * axes.right - axes.down;
  click(a);
  click(b);
  ASSERT_EQ(all().size(), 2U);
  EXPECT_NEAR(value(1), std::sqrt(29.0), 3.0 * axial().slice().mmPerPixel());
  for (const Vector3d& point : all()[1].points)
    EXPECT_NEAR(axes.next.dot(point - kBallCenter), 0.0, 1e-6) << "in the plane";
  EXPECT_LT((all()[1].points[1] - b).norm(), 2.0 * axial().slice().mmPerPixel());
}

TEST_F(MeasureWindow, OneToolAtATime)
{
  openBall();
  key(Qt::Key_D);
  EXPECT_TRUE(action("Distance")->isChecked());
  key(Qt::Key_P); // paint
  EXPECT_FALSE(action("Distance")->isChecked());
  key(Qt::Key_D);
  EXPECT_TRUE(action("Distance")->isChecked());
  EXPECT_FALSE(action("Paint")->isChecked());
  action("Drill")->trigger();
  EXPECT_FALSE(action("Distance")->isChecked());
  key(Qt::Key_D);
  EXPECT_TRUE(action("Distance")->isChecked());
  EXPECT_FALSE(view().tool().GetDrillMode());
}
