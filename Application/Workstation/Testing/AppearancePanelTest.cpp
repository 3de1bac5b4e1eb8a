#include "AppearancePanel.h"

#include <QApplication>
#include <QClipboard>
#include <QColorDialog>
#include <QComboBox>
#include <QDockWidget>
#include <QDoubleSpinBox>
#include <QInputDialog>
#include <QLabel>
#include <QMenu>
#include <QSlider>
#include <QTreeView>

#include "GuiTest.h"
#include "TransferPlot.h"
#include "petrous/Appearance/OwnPresets.h"

using namespace petrous;
using namespace petrous::workstation;

namespace
{

class AppearancePanelTest : public GuiTest
{
protected:
  void openPanel(const QString& what = {})
  {
    openWindow(what);
    ASSERT_TRUE(waitFor([&] { return window().model().ready() && window().model().drawable(); }));
    QTest::keyClick(&window(), Qt::Key_F10);
    QTest::qWait(100);
    ASSERT_TRUE(plot().isVisible());
    plot().setFocus();
  }
  AppearancePanel& panel() { return *window().findChild<AppearancePanel*>(); }
  TransferPlot& plot() { return *window().findChild<TransferPlot*>("transferPlot"); }
  const std::vector<appearance::ControlPoint>& points()
  {
    return panel().editor().selected()->points;
  }
  const appearance::StructureAppearance& bone() { return window().model().value().boneLook; }
  void paste(const QString& points)
  {
    QApplication::clipboard()->setText("{\"points\": [" + points + "]}");
    plot().setFocus();
    QTest::keyClick(&plot(), Qt::Key_V, Qt::ControlModifier);
  }
  QPoint at(double value, double opacity) { return plot().positionOf(value, opacity).toPoint(); }
  void drag(const QPoint& from, const QPoint& to, Qt::KeyboardModifiers keys = {})
  {
    QTest::mousePress(&plot(), Qt::LeftButton, keys, from);
    for (int n = 1; n <= 4; ++n)
    {
      QMouseEvent move(QEvent::MouseMove, from + (to - from) * n / 4, Qt::NoButton, Qt::LeftButton,
                       keys);
      QApplication::sendEvent(&plot(), &move);
    }
    QTest::mouseRelease(&plot(), Qt::LeftButton, keys, to);
  }
  void type(const char* box, const char* text)
  {
    auto* number = panel().findChild<QDoubleSpinBox*>(box);
    number->setFocus();
    enterNumber(*number, text);
  }
  void choose(const char* menu, const QString& entry)
  {
    auto* found = panel().findChild<QMenu*>(menu);
    emit found->aboutToShow();
    for (QAction* action : found->actions())
      if (action->objectName() == entry || action->text().remove('&') == entry)
        return action->trigger();
    ADD_FAILURE() << "no entry " << entry.toStdString();
  }
  QStringList entries(const char* menu)
  {
    auto* found = panel().findChild<QMenu*>(menu);
    emit found->aboutToShow();
    QStringList texts;
    for (QAction* action : found->actions())
      texts += action->text().remove('&');
    return texts;
  }
  QString note() { return panel().findChild<QLabel*>("appearanceNote")->text(); }
};

} // namespace

// A structure shines through bone until the point's opacity is dragged up.
TEST_F(AppearancePanelTest, APointThatIsDraggedUpHidesWhatLiesInTheBone)
{
  saveBall("ball");
  openPanel("ball");
  auto* surface = panel().findChild<QSlider*>("surfaceOpacity");
  surface->setValue(20);
  EXPECT_TRUE(waitFor([&] { return bone().opacity < 0.3F; }));
  paste(R"({"value": 500, "color": [1, 0, 0], "opacity": 0.01})");
  ASSERT_EQ(points().size(), 1u);
  const QImage through = picture();
  drag(at(500, 0.01), at(500, 0.5));
  EXPECT_NEAR(points()[0].opacity, 0.5, 0.05);
  EXPECT_NEAR(points()[0].value, 500.0, 15.0);
  EXPECT_TRUE(bone().transfer && *bone().transfer == appearance::TransferFunction(points()));
  const QImage opaque = picture();
  // The nerve in the middle is green, bone red.
  const QColor before = through.pixelColor(through.rect().center());
  const QColor after = opaque.pixelColor(opaque.rect().center());
  EXPECT_GT(before.greenF(), 0.15);
  EXPECT_LT(after.greenF() / after.redF(), 0.5 * before.greenF() / before.redF());
  EXPECT_GT(after.redF(), 0.3);
}

TEST_F(AppearancePanelTest, PointsAreAddedMovedAndRemovedByMouseAndKeys)
{
  saveBall("ball");
  openPanel("ball");
  paste(R"({"value": 300, "color": [1, 1, 1], "opacity": 0.1},
           {"value": 1500, "color": [1, 1, 1], "opacity": 0.1})");
  QTest::mouseDClick(&plot(), Qt::LeftButton, {}, at(900, 0.5));
  QTest::mouseRelease(&plot(), Qt::LeftButton, {}, at(900, 0.5));
  ASSERT_EQ(points().size(), 3u);
  EXPECT_NEAR(points()[1].value, 900.0, 15.0);
  EXPECT_NEAR(points()[1].opacity, 0.5, 0.05);
  EXPECT_EQ(panel().editor().point(), 1u);

  // By keys: 10 HU each, and finer.
  const double value = points()[1].value;
  QTest::keyClick(&plot(), Qt::Key_Right);
  EXPECT_EQ(points()[1].value, value + 10.0);
  QTest::keyClick(&plot(), Qt::Key_Left, Qt::ShiftModifier);
  EXPECT_EQ(points()[1].value, value + 9.0);
  const float opacity = points()[1].opacity;
  QTest::keyClick(&plot(), Qt::Key_Up);
  EXPECT_GT(points()[1].opacity, opacity);
  QTest::keyClick(&plot(), Qt::Key_Left, Qt::ControlModifier);
  EXPECT_EQ(panel().editor().point(), 0u);
  EXPECT_TRUE(plot().accessibleDescription().startsWith("Point 1 of 3: 300 HU, opacity 0.1"))
      << plot().accessibleDescription().toStdString();
  QTest::keyClick(&plot(), Qt::Key_Delete);
  ASSERT_EQ(points().size(), 2u);
  EXPECT_EQ(points()[0].value, value + 9.0);

  // With Shift along one axis; no further than the neighbour.
  const float before = points()[1].opacity;
  drag(at(1500, 0.1), at(200, 0.12), Qt::ShiftModifier);
  EXPECT_EQ(points()[1].value, value + 10.0);
  EXPECT_EQ(points()[1].opacity, before);
  // A click on nothing.
  QTest::mouseClick(&plot(), Qt::LeftButton, {}, at(-500, 0.9));
  EXPECT_FALSE(panel().editor().point());
}

// Run once more under a locale with a decimal comma.
TEST_F(AppearancePanelTest, NumbersAreTyped)
{
  saveBall("ball");
  openPanel("ball");
  paste(R"({"value": 300, "color": [1, 1, 1], "opacity": 0.1})");
  QTest::mouseClick(&plot(), Qt::LeftButton, {}, at(300, 0.1));
  ASSERT_EQ(panel().editor().point(), 0u);
  auto* value = panel().findChild<QDoubleSpinBox*>("pointValue");
  EXPECT_EQ(value->text().toStdString(), "300 HU");
  type("pointValue", "812");
  EXPECT_EQ(points()[0].value, 812.0);
  type("pointOpacity", "0,25");
  EXPECT_EQ(points()[0].opacity, 0.25F);
  type("pointSpecular", "0.5");
  EXPECT_EQ(points()[0].specular, 0.5F);
  EXPECT_EQ(panel().findChild<QDoubleSpinBox*>("pointOpacity")->text().toStdString(), "0.2500");
  QTest::keyClick(&plot(), Qt::Key_C, Qt::ControlModifier);
  EXPECT_EQ(QApplication::clipboard()->text().toStdString(),
            R"({"points":[{"color":[1.0,1.0,1.0],"opacity":0.25,"specular":0.5,"value":812.0}]})");
}

TEST_F(AppearancePanelTest, FollowsTheListOfStructures)
{
  saveBall("ball");
  openWindow("ball");
  ASSERT_TRUE(waitFor([&] { return window().model().ready() && window().model().drawable(); }));
  structureList().setCurrentIndex(structureCell("nerve"));
  QTest::keyClick(&window(), Qt::Key_F10);
  ASSERT_TRUE(waitFor([this] { return plot().isVisible(); }));
  EXPECT_EQ(panel().editor().selected()->name, "nerve");
  structureList().setCurrentIndex(structureCell("ct"));
  EXPECT_EQ(panel().editor().selected()->name, "ct");
  // A choice in the panel stays, also when the panel is opened again or a look changes.
  auto* part = panel().findChild<QComboBox*>("appearancePart");
  const int nerve = part->findText("nerve");
  part->setCurrentIndex(nerve);
  EXPECT_EQ(panel().editor().selected()->name, "nerve");
  QTest::keyClick(&window(), Qt::Key_F10);
  QTest::keyClick(&window(), Qt::Key_F10);
  ASSERT_TRUE(waitFor([this] { return plot().isVisible(); }));
  EXPECT_EQ(panel().editor().selected()->name, "nerve");
}

TEST_F(AppearancePanelTest, AClickChoosesTheCurve)
{
  saveBall("ball");
  openPanel("ball");
  paste(R"({"value": 300, "color": [1, 1, 1], "opacity": 0.01})");
  auto* part = panel().findChild<QComboBox*>("appearancePart");
  ASSERT_EQ(part->count(), 3);
  EXPECT_EQ(part->itemText(0), "Bone");
  EXPECT_EQ(part->itemText(1), "Soft tissue");
  EXPECT_EQ(part->itemText(2), "nerve");
  QTest::keyClick(&plot(), Qt::Key_PageDown);
  EXPECT_EQ(part->currentText(), "nerve");
  paste(R"({"value": 300, "color": [0, 1, 0], "opacity": 0.5})");
  EXPECT_EQ(panel().editor().selected()->name, "nerve");
  QTest::mouseClick(&plot(), Qt::LeftButton, {}, at(900, 0.01));
  EXPECT_EQ(panel().editor().selected()->name, "ct");
  EXPECT_EQ(part->currentIndex(), 0);
  QTest::mouseClick(&plot(), Qt::LeftButton, {}, at(900, 0.5));
  EXPECT_EQ(part->currentText(), "nerve");
}

TEST_F(AppearancePanelTest, SoftTissueHasAFunctionOfItsOwn)
{
  saveBall("ball");
  openPanel("ball");
  auto* part = panel().findChild<QComboBox*>("appearancePart");
  part->setCurrentIndex(1);
  emit part->activated(1);
  ASSERT_EQ(panel().editor().selected()->name, scene::kSoftTissue);
  EXPECT_GT(points().size(), 1u);
  const auto& soft = window().model().value().softTissue;
  EXPECT_TRUE(note().contains("no surface")) << note().toStdString();
  panel().findChild<QSlider*>("surfaceOpacity")->setValue(20);
  EXPECT_TRUE(waitFor([&] { return soft.opacity < 0.3F; }));
  EXPECT_EQ(bone().opacity, 1.0F);
  choose("presetMenu", "skin");
  EXPECT_EQ(soft.preset, "skin");
  EXPECT_FALSE(soft.touchable || soft.drillable);
  paste(R"({"value": 40, "color": [1, 0, 0], "opacity": 0.1})");
  EXPECT_TRUE(note().contains("not drawn")) << "one colour would fill air";
  paste(R"({"value": 0, "color": [1, 0, 0], "opacity": 0},
           {"value": 90, "color": [1, 0, 0], "opacity": 0.1})");
  EXPECT_EQ(soft.transfer->points().size(), 2u);
  EXPECT_FALSE(note().contains("not drawn"));
}

TEST_F(AppearancePanelTest, CountsHistogramsOnlyWhileItIsOpen)
{
  saveBall("ball");
  openWindow("ball");
  ASSERT_TRUE(waitFor([&] { return window().model().ready() && window().model().drawable(); }));
  EXPECT_EQ(panel().editor().imageHistogram(), nullptr);
  QTest::keyClick(&window(), Qt::Key_F10);
  ASSERT_TRUE(waitFor([&] { return panel().editor().imageHistogram() != nullptr; }));
  EXPECT_EQ(panel().editor().imageHistogram()->count(), 64u * 64u * 64u);
  QTest::keyClick(&plot(), Qt::Key_PageDown);
  ASSERT_TRUE(panel().editor().insideHistogram());
  const auto& nerve = window().model().value().labels.front().structures.front();
  EXPECT_EQ(panel().editor().insideHistogram()->count(), nerve.voxels);
  action("Close the case")->trigger();
  EXPECT_TRUE(waitFor([&] { return !window().model().hasCase(); }));
  EXPECT_EQ(panel().editor().imageHistogram(), nullptr);
}

TEST_F(AppearancePanelTest, AColourIsSeenWhileItIsChosen)
{
  saveBall("ball");
  openPanel("ball");
  paste(R"({"value": 300, "color": [1, 1, 1], "opacity": 0.1})");
  QTest::keyClick(&plot(), Qt::Key_Home);
  ASSERT_EQ(panel().editor().point(), 0u);
  const auto chooses = [&](bool accept)
  {
    onDialog(
        [&, accept](QDialog& dialog)
        {
          auto* colors = qobject_cast<QColorDialog*>(&dialog);
          if (!colors)
            return false;
          colors->setCurrentColor(QColor(0, 0, 255));
          EXPECT_EQ(points()[0].color, (std::array<float, 3>{0.0F, 0.0F, 1.0F}));
          accept ? colors->accept() : colors->reject();
          return true;
        });
    QTest::keyClick(&plot(), Qt::Key_Return);
  };
  chooses(false);
  EXPECT_EQ(points()[0].color, (std::array<float, 3>{1.0F, 1.0F, 1.0F}));
  chooses(true);
  EXPECT_EQ(points()[0].color, (std::array<float, 3>{0.0F, 0.0F, 1.0F}));
}

TEST_F(AppearancePanelTest, PresetsAreSavedInTheLibraryAppliedAndDeleted)
{
  saveBall("ball");
  openPanel("ball");
  paste(R"({"value": 300, "color": [1, 0, 1], "opacity": 0.1})");
  onDialog(
      [&](QDialog& dialog)
      {
        auto* ask = qobject_cast<QInputDialog*>(&dialog);
        if (!ask)
          return false;
        ask->setTextValue("ours");
        ask->accept();
        return true;
      });
  choose("presetMenu", "savePreset");
  const appearance::OwnPresets own(library().folder());
  ASSERT_EQ(own.all().size(), 1u);
  EXPECT_EQ(own.all().front().preset, "ours");
  choose("presetMenu", "bone-translucent");
  EXPECT_EQ(bone().preset, "bone-translucent");
  choose("presetMenu", "ours");
  EXPECT_EQ(bone().preset, "ours");
  EXPECT_EQ(points().size(), 1u);
  EXPECT_TRUE(entries("presetMenu").contains("ours"));
  EXPECT_FALSE(entries("presetMenu").contains("ear-canal")) << "bone is no lumen";
  auto* part = panel().findChild<QComboBox*>("appearancePart");
  const int ofBone = part->currentIndex();
  part->setCurrentIndex(part->findText("nerve"));
  EXPECT_EQ(panel().editor().selected()->name, "nerve");
  EXPECT_TRUE(entries("presetMenu").contains("ear-canal"));
  part->setCurrentIndex(ofBone);
  choose("functionMenu", "clearFunction");
  EXPECT_TRUE(points().empty());
  choose("functionMenu", "resetFunction");
  EXPECT_EQ(points().size(), 1u);
  QApplication::clipboard()->setText("no function");
  QTest::keyClick(&plot(), Qt::Key_V, Qt::ControlModifier);
  EXPECT_EQ(points().size(), 1u);
  EXPECT_TRUE(note().contains("JSON")) << note().toStdString();
}
