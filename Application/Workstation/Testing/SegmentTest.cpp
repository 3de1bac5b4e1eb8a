#include "GuiTest.h"

#include <QComboBox>
#include <QDockWidget>
#include <QDoubleSpinBox>
#include <QLabel>
#include <QLineEdit>
#include <QPushButton>
#include <QScrollArea>
#include <QStatusBar>
#include <QTreeWidget>

#include "SliceView.h"
#include "petrous/Phantom/Phantom.h"
#include "petrous/Presenters/SegmentEditor.h"
#include "petrous/Segmentation/MaskOperations.h"

using namespace petrous;
using namespace petrous::workstation;
using Eigen::Vector3d;

namespace
{

class Segment : public GuiTest
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
  presenters::WorkstationModel& model()
  {
    return const_cast<presenters::WorkstationModel&>(window().model());
  }
  void choose(int key) { QTest::keyClick(&window(), static_cast<Qt::Key>(key), Qt::ShiftModifier); }
  QString volume() { return find<QLabel>("segmentVolume").text(); }
  void setNumber(const char* name, double value) { find<QDoubleSpinBox>(name).setValue(value); }
  /// Set once the numbers have rested for a while; the brush has the same range.
  void setRange(double lower, double upper)
  {
    setNumber("segmentLower", lower);
    setNumber("segmentUpper", upper);
    EXPECT_TRUE(waitFor(
        [&]
        {
          return find<QDoubleSpinBox>("paintLower").value() == lower &&
                 find<QDoubleSpinBox>("paintUpper").value() == upper;
        }));
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
  void click(const Vector3d& patient)
  {
    model().setCrosshair(patient);
    QTest::mouseClick(&axial(), Qt::LeftButton, Qt::NoModifier, pixelOf(patient));
  }
  void name(const QString& text)
  {
    auto& line = find<QLineEdit>("segmentName");
    line.clear();
    QTest::keyClicks(&line, text);
  }
  /// Waits until nothing is computed, and creates the structure.
  void create(const QString& as)
  {
    name(as);
    EXPECT_TRUE(waitFor([this] { return find<QPushButton>("segmentCreate").isEnabled(); }))
        << find<QPushButton>("segmentCreate").toolTip().toStdString();
    find<QPushButton>("segmentCreate").click();
    EXPECT_TRUE(waitFor([this] { return !isDraft(); })); // made in another thread
    EXPECT_TRUE(settled());
  }
  const volume::Volume<std::uint16_t>* voxelsOf(const std::string& structure)
  {
    for (const auto& part : window().model().value().labels)
      if (part.structures.front().name == structure)
        return part.labels.get()->voxels.get();
    return nullptr;
  }
  static void answer(QMessageBox& box, const QString& text)
  {
    for (QAbstractButton* button : box.buttons())
      if (button->text().remove('&') == text)
        return button->click();
    ADD_FAILURE() << "no button " << text.toStdString();
    box.reject();
  }
  void trigger(const QString& text) { action(text)->trigger(); }
  bool isDraft() { return find<QPushButton>("segmentDiscard").isEnabled(); }
};

} // namespace

TEST_F(Segment, AThresholdFromAClickMakesTheStructureThatTheEngineFinds)
{
  saveBall("ball");
  openWindow("ball");
  choose(Qt::Key_T);
  EXPECT_TRUE(find<QDockWidget>("segmentDock").isVisible());
  ASSERT_TRUE(waitFor([this] { return volume().contains("mm"); })) << "a range is proposed";
  setRange(1000.0, 1600.0);
  const Vector3d seed = kBallCenter + Vector3d(6, 0, 0);
  click(seed);
  picture();
  create("tumour");
  const auto& value = window().model().value();
  const auto mask =
      segmentation::connectedThreshold(*value.ct.volume.get(), {1000.0, 1600.0}, {kBallCenter});
  const auto* made = scene::findStructure(value, "tumour");
  ASSERT_TRUE(made);
  EXPECT_EQ(made->voxels, mask.count);
  EXPECT_EQ(made->look.preset, "tumour");
  const auto* voxels = voxelsOf("tumour");
  for (std::size_t n = 0; n < voxels->size(); ++n)
    ASSERT_EQ(voxels->data()[n] != 0, mask.voxels->data()[n] != 0) << n;
  EXPECT_FALSE(isDraft());
  EXPECT_TRUE(scene::findStructure(library().open("ball"), "tumour")) << "saved";
}

TEST_F(Segment, ThePanelIsNeverCutOff)
{
  saveBall("ball");
  openWindow("ball");
  choose(Qt::Key_T);
  auto& dock = find<QDockWidget>("segmentDock");
  for (const int width : {200, 395, 600})
  {
    window().resizeDocks({&dock}, {width}, Qt::Horizontal);
    QCoreApplication::processEvents();
    auto* area = dock.findChild<QScrollArea*>();
    ASSERT_TRUE(area);
    EXPECT_LE(area->widget()->width(), area->viewport()->width()) << width;
    EXPECT_GE(area->widget()->width(), area->widget()->minimumSizeHint().width()) << width;
  }
}

TEST_F(Segment, LabelsOfTheThresholdAreSeenWhole)
{
  saveBall("ball");
  LongTexts longer;
  for (const bool isLong : {false, true})
  {
    if (isLong)
      QApplication::installTranslator(&longer);
    openWindow("ball");
    QApplication::removeTranslator(&longer);
    choose(Qt::Key_T);
    QTest::qWait(100);
    const auto& dock = find<QDockWidget>("segmentDock");
    const QString pictures = qEnvironmentVariable("PETROUS_GUI_PICTURES");
    if (!pictures.isEmpty())
      window().grab().save(pictures + (isLong ? "/threshold-long.png" : "/threshold.png"));
    const auto* viewport = dock.findChild<QScrollArea*>()->viewport();
    for (const char* box : {"segmentLower", "segmentUpper"})
    {
      const auto& number = find<QDoubleSpinBox>(box);
      EXPECT_TRUE(viewport->rect().contains(QRect(number.mapTo(viewport, QPoint()), number.size())))
          << box;
      EXPECT_GE(number.width(), number.minimumSizeHint().width()) << box;
    }
    int seen = 0;
    for (const auto* label : dock.findChildren<QLabel*>())
      if (label->isVisible() && label->buddy())
      {
        ++seen;
        EXPECT_GE(label->width(), label->sizeHint().width()) << label->text().toStdString();
        EXPECT_GE(label->height(), label->sizeHint().height()) << label->text().toStdString();
        const QRect at(label->mapTo(viewport, QPoint()), label->size());
        EXPECT_TRUE(at.left() >= 0 && at.right() <= viewport->width())
            << label->text().toStdString();
      }
    EXPECT_GE(seen, 4) << "structure, image, range, result";
    onMessage([](QMessageBox& box) { answer(box, "Discard"); });
    closeWindow();
  }
}

TEST_F(Segment, AStrokePaintsTheBallThatIsSeenAndUndoTakesItBack)
{
  saveBall("ball");
  openWindow("ball");
  choose(Qt::Key_P);
  setNumber("paintRadius", 2.0);
  const QImage before = axial().grab().toImage();
  const QPoint at = pixelOf(kBallCenter + Vector3d(3, 4, 0));
  const Vector3d center = patientOf(at);
  QTest::mousePress(&axial(), Qt::LeftButton, Qt::NoModifier, at);
  EXPECT_TRUE(volume().contains("mm")) << "live";
  picture();
  QTest::mouseRelease(&axial(), Qt::LeftButton, Qt::NoModifier, at);
  EXPECT_GT(differentPixels(before, axial().grab().toImage(), 10), 50);
  const Vector3d crosshair = window().model().crosshair();
  EXPECT_LT((crosshair - center).norm(), 10.0);
  EXPECT_NE(crosshair, center) << "the left button paints";
  QTest::keyClick(&window(), Qt::Key_Z, Qt::ControlModifier);
  EXPECT_EQ(volume(), "Nothing yet");
  EXPECT_FALSE(isDraft());
  QTest::keyClick(&window(), Qt::Key_Z, Qt::ControlModifier | Qt::ShiftModifier);
  create("glomus");
  const auto* voxels = voxelsOf("glomus");
  ASSERT_TRUE(voxels);
  const auto& grid = window().model().value().ct.geometry;
  for (int k = 0; k < 64; ++k)
    for (int j = 0; j < 64; ++j)
      for (int i = 0; i < 64; ++i)
        ASSERT_EQ(voxels->at(i, j, k) != 0,
                  (grid.patientFromVoxel(Vector3d(i, j, k)) - center).norm() <= 2.0)
            << i << ' ' << j << ' ' << k;
}

TEST_F(Segment, StrokesToGrowFromAreSeenAndTold)
{
  saveBall("ball");
  openWindow("ball");
  choose(Qt::Key_G);
  setNumber("growRadius", 1.0);
  EXPECT_EQ(volume(), "Nothing yet");
  const auto pixelsOf = [this](const std::array<float, 3>& color)
  {
    const QImage image = axial().grab().toImage();
    int count = 0;
    for (int y = 0; y < image.height(); ++y)
      for (int x = 0; x < image.width(); ++x)
      {
        const QColor at = image.pixelColor(x, y);
        const auto isNear = [](int channel, float wanted)
        { return std::abs(static_cast<float>(channel) - wanted) < 20.0F; };
        count += isNear(at.red(), color[0]) && isNear(at.green(), color[1]) &&
                 isNear(at.blue(), color[2]);
      }
    return count;
  };
  click(kBallCenter + Vector3d(2, 2, 0));
  EXPECT_EQ(volume(), "Strokes; nothing grown yet");
  EXPECT_GT(pixelsOf(presenters::SegmentEditor::kInsideStroke), 4);
  EXPECT_EQ(pixelsOf(presenters::SegmentEditor::kBesideStroke), 0);
  find<QComboBox>("growSide").setCurrentIndex(1);
  click(kBallCenter + Vector3d(2, -13, 0));
  EXPECT_GT(pixelsOf(presenters::SegmentEditor::kBesideStroke), 4);
  EXPECT_TRUE(find<QPushButton>("segmentKeepLargest").isHidden());
  find<QPushButton>("segmentUndo").click();
  find<QPushButton>("segmentUndo").click();
  EXPECT_EQ(volume(), "Nothing yet");
  EXPECT_FALSE(isDraft());
}

TEST_F(Segment, TheDraftIsSeenInThePictureAndGoesWithIt)
{
  saveBall("ball");
  openWindow("ball");
  const QImage before = picture();
  choose(Qt::Key_P);
  setNumber("paintRadius", 3.0);
  click(kBallCenter + Vector3d(0, -12, 0)); // half of it stands out of the bone
  EXPECT_TRUE(waitFor([&] { return differentPixels(before, picture(), 20) > 300; }));
  QTest::keyClick(&window(), Qt::Key_Z, Qt::ControlModifier);
  EXPECT_TRUE(waitFor([&] { return differentPixels(before, picture()) == 0; }));
}

TEST_F(Segment, BracketsChangeTheBrushAndTheWheelScrollsStill)
{
  saveBall("ball");
  openWindow("ball");
  auto& radius = find<QDoubleSpinBox>("paintRadius");
  auto& burr = find<QDoubleSpinBox>("burrDiameter");
  const double diameter = burr.value();
  choose(Qt::Key_P);
  const double first = radius.value();
  QTest::keyClick(&window(), Qt::Key_BracketRight);
  EXPECT_GT(radius.value(), first);
  QTest::keyClick(&window(), Qt::Key_BracketLeft);
  QTest::keyClick(&window(), Qt::Key_BracketLeft);
  EXPECT_LT(radius.value(), first);
  EXPECT_EQ(burr.value(), diameter);
  const Vector3d before = window().model().crosshair();
  QWheelEvent wheel(QPointF(50, 50), axial().mapToGlobal(QPoint(50, 50)), {}, {0, 120},
                    Qt::NoButton, Qt::NoModifier, Qt::NoScrollPhase, false);
  QApplication::sendEvent(&axial(), &wheel);
  EXPECT_NE(window().model().crosshair(), before);
  QTest::keyClick(&axial(), Qt::Key_Escape);
  QTest::keyClick(&window(), Qt::Key_BracketRight);
  EXPECT_NE(burr.value(), diameter) << "without a tool they are the burr's";
}

TEST_F(Segment, OneToolAtATimeAndTheDraftStays)
{
  saveBall("ball");
  openWindow("ball");
  QTest::keyClick(&view(), Qt::Key_D);
  ASSERT_TRUE(action("Drill")->isChecked());
  choose(Qt::Key_P);
  EXPECT_FALSE(action("Drill")->isChecked());
  EXPECT_TRUE(window().statusBar()->currentMessage().contains("drill is off"));
  click(kBallCenter);
  EXPECT_TRUE(isDraft());
  QTest::keyClick(&window(), Qt::Key_D);
  EXPECT_TRUE(action("Drill")->isChecked());
  EXPECT_FALSE(action("Paint")->isChecked());
  EXPECT_TRUE(isDraft());
  const Vector3d aside = kBallCenter + Vector3d(3, 3, 0);
  QTest::mouseClick(&axial(), Qt::LeftButton, Qt::NoModifier, pixelOf(aside));
  EXPECT_LT((window().model().crosshair() - aside).norm(), 1.0) << "the left button as ever";
  onMessage([](QMessageBox& box) { answer(box, "Discard"); });
  closeWindow();
}

TEST_F(Segment, ADraftIsNotLostWithoutAQuestion)
{
  saveBall("ball");
  saveBall("other");
  openWindow("ball");
  choose(Qt::Key_P);
  click(kBallCenter);
  name("tumour");
  onMessage([](QMessageBox& box) { answer(box, "Cancel"); });
  window().close();
  EXPECT_TRUE(window().isVisible());
  EXPECT_TRUE(isDraft());
  onMessage([](QMessageBox& box) { answer(box, "Cancel"); });
  window().begin("other");
  EXPECT_TRUE(settled());
  EXPECT_EQ(window().model().value().name, "ball");
  EXPECT_TRUE(isDraft());
  onMessage([](QMessageBox& box) { answer(box, "Create"); });
  window().begin("other");
  EXPECT_TRUE(waitFor([this] { return window().model().value().name == "other"; }));
  EXPECT_TRUE(settled());
  EXPECT_TRUE(scene::findStructure(library().open("ball"), "tumour"));
  EXPECT_FALSE(isDraft());

  choose(Qt::Key_P);
  click(kBallCenter);
  onMessage(
      [](QMessageBox& box)
      {
        for (QAbstractButton* button : box.buttons())
          if (button->text().remove('&') == "Create")
          {
            EXPECT_FALSE(button->isEnabled()) << "it has no name";
          }
        answer(box, "Discard");
      });
  window().close();
  EXPECT_FALSE(window().isVisible());
  EXPECT_EQ(library().open("other").labels.size(), 1U);
}

// Return counts though the preview is still being computed, and the next key is not typed into the
// name.
TEST_F(Segment, ReturnInTheNameCreatesWhenThePreviewIsDoneAndGivesTheKeysBack)
{
  saveBall("ball");
  openWindow("ball");
  choose(Qt::Key_T);
  ASSERT_TRUE(waitFor([this] { return volume().contains("mm"); }));
  setRange(1000.0, 1600.0);
  auto& line = find<QLineEdit>("segmentName");
  line.setFocus();
  name("tumour");
  click(kBallCenter + Vector3d(6, 0, 0));
  line.setFocus();
  QTest::keyClick(&line, Qt::Key_Return); // before the preview is back
  EXPECT_TRUE(isDraft());
  EXPECT_TRUE(waitFor([this] { return !isDraft(); }));
  EXPECT_TRUE(settled());
  const auto mask = segmentation::connectedThreshold(*window().model().value().ct.volume.get(),
                                                     {1000.0, 1600.0}, {kBallCenter});
  const auto* made = scene::findStructure(window().model().value(), "tumour");
  ASSERT_TRUE(made);
  EXPECT_EQ(made->voxels, mask.count);
  ASSERT_TRUE(QApplication::focusWidget());
  QTest::keyClick(QApplication::focusWidget(), Qt::Key_N, Qt::ShiftModifier);
  EXPECT_EQ(line.text(), "");
  EXPECT_TRUE(action("Nerve")->isChecked());
}

TEST_F(Segment, ARefusalStandsOnceAndGoesWithItsCause)
{
  saveBall("ball");
  openWindow("ball");
  choose(Qt::Key_T);
  ASSERT_TRUE(waitFor([this] { return volume().contains("mm"); }));
  auto& remark = find<QLabel>("segmentRemark");
  auto& line = find<QLabel>("segmentLine");
  setRange(1000.0, 1100.0); // its middle has 1600
  click(kBallCenter);
  ASSERT_TRUE(waitFor([&] { return remark.text().contains("at the seed"); }));
  trigger("Apply the tool");
  QTest::qWait(300);
  EXPECT_TRUE(remark.isVisible() && line.isHidden()) << line.text().toStdString();
  setRange(1000.0, 1600.0);
  ASSERT_TRUE(waitFor([this] { return volume().contains("voxels"); }));
  EXPECT_TRUE(waitFor([&] { return remark.isHidden(); })) << remark.text().toStdString();
  EXPECT_TRUE(line.isHidden()) << line.text().toStdString();
}

TEST_F(Segment, WhatWasCreatedIsUndoneFromThePanel)
{
  saveBall("ball");
  openWindow("ball");
  choose(Qt::Key_P);
  click(kBallCenter);
  const QString painted = volume();
  create("tumour");
  EXPECT_EQ(volume(), "Nothing yet");
  find<QPushButton>("segmentUndo").click();
  EXPECT_TRUE(settled());
  EXPECT_FALSE(scene::findStructure(window().model().value(), "tumour"));
  EXPECT_FALSE(scene::findStructure(library().open("ball"), "tumour"));
  EXPECT_EQ(volume(), painted);
  onMessage([](QMessageBox& box) { answer(box, "Discard"); });
  closeWindow();
}

TEST_F(Segment, OddOrdersOfClicksChangeNothing)
{
  openWindow();
  for (const int key : {Qt::Key_T, Qt::Key_P, Qt::Key_N, Qt::Key_G})
    choose(key); // no case
  for (const char* text : {"Apply the tool", "Create the structure"})
    action(text)->trigger();
  EXPECT_FALSE(action("Paint")->isChecked());
  saveBall("ball");
  saveBall("other");
  window().begin("ball");
  ASSERT_TRUE(waitFor([this] { return window().model().hasCase(); }));
  EXPECT_TRUE(settled());
  choose(Qt::Key_N);
  action("Apply the tool")->trigger(); // no points
  action("Create the structure")->trigger();
  EXPECT_FALSE(isDraft());
  choose(Qt::Key_P);
  QTest::mousePress(&axial(), Qt::LeftButton, Qt::NoModifier, axial().rect().center());
  choose(Qt::Key_E); // the stroke ends with its tool
  QTest::mouseRelease(&axial(), Qt::LeftButton, Qt::NoModifier, axial().rect().center());
  EXPECT_TRUE(isDraft());
  QTest::keyClick(&axial(), Qt::Key_Escape);
  EXPECT_TRUE(isDraft());
  onMessage([](QMessageBox& box) { answer(box, "Discard"); });
  QTest::keyClick(&axial(), Qt::Key_Escape);
  EXPECT_FALSE(isDraft());

  choose(Qt::Key_T); // another case while the preview is computed
  setNumber("segmentLower", 0.0);
  model().open("other");
  EXPECT_FALSE(isDraft());
  EXPECT_FALSE(action("Threshold")->isChecked());
  choose(Qt::Key_P);
  QTest::mousePress(&axial(), Qt::LeftButton, Qt::NoModifier, axial().rect().center());
  model().close(); // in the middle of a stroke
  QTest::mouseMove(&axial(), QPoint(10, 10));
  QTest::mouseRelease(&axial(), Qt::LeftButton, Qt::NoModifier, QPoint(10, 10));
  EXPECT_FALSE(isDraft());
}

TEST_F(Segment, TheFacialNerveOfThePhantomIsFoundFromClicks)
{
  // Tympanic and mastoid segment at 0.3 mm; the points are knots of the axis (PhantomEar.cpp).
  const std::vector<Vector3d> points{{-41.8, -2.1, 4.1},
                                     {-44.8, 3.2, 2.1},
                                     {-45.5, 4.7, 0.2},
                                     {-46.0, 5.4, -4.0},
                                     {-46.6, 6.0, -10.0}};
  const core::GridGeometry grid({60, 70, 90}, Vector3d::Constant(0.3), Vector3d(-54, -10, -16));
  scene::Case value;
  value.name = "ear";
  value.ct.name = "ct";
  value.ct.geometry = grid;
  value.ct.volume = std::make_shared<const volume::IntensityVolume>(
      std::make_shared<const volume::Volume<std::int16_t>>(
          phantom::samplePhantom(phantom::Phantom(), grid, {})));
  value.ct.range = value.ct.volume.get()->range();
  library().save(value);
  openWindow("ear");
  choose(Qt::Key_N);
  for (const Vector3d& point : points)
    click(point);
  auto& table = find<QTreeWidget>("nervePoints");
  EXPECT_EQ(table.topLevelItemCount(), static_cast<int>(points.size()));
  ASSERT_TRUE(waitFor([&] { return table.topLevelItem(0)->text(1).contains("mm"); }));
  for (int row = 0; row < table.topLevelItemCount(); ++row)
    EXPECT_LT(table.topLevelItem(row)->text(1).remove(" mm").toDouble(), 0.8);
  // In the order of the clicks; six rows are seen without scrolling.
  EXPECT_GE(table.viewport()->height(), 6 * table.visualItemRect(table.topLevelItem(0)).height());
  table.setFocus();
  for (std::size_t n = points.size(); n-- > 0;)
  {
    table.setCurrentItem(table.topLevelItem(static_cast<int>(n)));
    EXPECT_LT((window().model().crosshair() - points[n]).norm(), 0.5) << n;
  }
  // Moved to the crosshair, out of the nerve, a point is marked; undo takes it back.
  table.setCurrentItem(table.topLevelItem(3));
  model().setCrosshair(points[3] + Vector3d(1.2, 0, 0));
  find<QPushButton>("moveNervePoint").click();
  EXPECT_TRUE(waitFor([&] { return table.topLevelItem(3)->text(0) == "4!"; }));
  EXPECT_NE(table.topLevelItem(3)->text(2), "");
  QTest::keyClick(&window(), Qt::Key_Z, Qt::ControlModifier);
  EXPECT_TRUE(waitFor([&] { return table.topLevelItem(3)->text(1).contains("mm"); }));
  EXPECT_EQ(table.topLevelItem(3)->text(0), "4");
  table.setFocus();
  QTest::keyClick(&table, Qt::Key_Delete);
  EXPECT_EQ(table.topLevelItemCount(), 4);
  QTest::keyClick(&window(), Qt::Key_Z, Qt::ControlModifier);
  EXPECT_EQ(table.topLevelItemCount(), 5);
  picture();
  create("facial nerve");
  const auto* voxels = voxelsOf("facial nerve");
  ASSERT_TRUE(voxels);
  // Where the nerve runs across the axial slice, the middle of the tube lies on its axis.
  const int k = static_cast<int>(std::lround(grid.voxelFromPatient(points[3])[2]));
  Vector3d sum = Vector3d::Zero();
  int count = 0;
  for (int j = 0; j < grid.dims()[1]; ++j)
    for (int i = 0; i < grid.dims()[0]; ++i)
      if (voxels->at(i, j, k) != 0)
      {
        sum += grid.patientFromVoxel(Vector3d(i, j, k));
        ++count;
      }
  ASSERT_GT(count, 3);
  EXPECT_LT((sum / count - points[3]).head<2>().norm(), 0.25);
}
