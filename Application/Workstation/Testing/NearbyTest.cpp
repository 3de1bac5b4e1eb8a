#include "DeviceTest.h"

#include <QDockWidget>
#include <QLabel>
#include <QTreeView>

#include "NearbyModel.h"
#include "StructuresModel.h"
#include "ToolDistances.h"
#include "ToolWarnings.h"

using namespace petrous;
using namespace petrous::workstation;

namespace
{

class Nearby : public DeviceTest
{
protected:
  QDockWidget& dock() { return *window().findChild<QDockWidget*>("nearbyDock"); }
  QAbstractItemModel& rows() { return *window().findChild<QTreeView*>("nearby")->model(); }
  QString cell(int column) { return rows().index(0, column).data().toString(); }
  bool listed()
  {
    return waitFor([this] { return rows().rowCount() > 0; });
  }
  void takeUpBurr()
  {
    QTest::keyClick(&view(), Qt::Key_D);
    QTest::mouseMove(&view(), view().rect().center() + QPoint(3, 0));
    QTest::mouseMove(&view(), view().rect().center());
    ASSERT_TRUE(hasTool());
  }
  void warnAt(double millimetres)
  {
    auto& structures = *window().findChild<QTreeView*>("structures")->model();
    EXPECT_TRUE(structures.setData(structureCell("nerve", StructuresModel::columnOf("warn_mm")),
                                   millimetres, Qt::EditRole));
  }
};

} // namespace

TEST_F(Nearby, AsksNothingWhileItIsHiddenAndNoBurrIsInTheHand)
{
  saveBall("ball");
  openWindow();
  EXPECT_FALSE(dock().isVisible());
  QTest::mouseMove(&view(), view().rect().center());
  QTest::qWait(200);
  EXPECT_FALSE(window().model().measuresNearby());
  QTest::keyClick(&window(), Qt::Key_F7);
  takeUpBurr();
  ASSERT_TRUE(listed());
  EXPECT_TRUE(window().model().measuresNearby());
  QTest::keyClick(&view(), Qt::Key_D);
  QTest::keyClick(&window(), Qt::Key_F7);
  EXPECT_FALSE(dock().isVisible());
  EXPECT_FALSE(window().model().measuresNearby()) << "the memory is given back";
}

TEST_F(Nearby, TellsHowFarTheBurrIs)
{
  saveBall("ball");
  openWindow();
  QTest::keyClick(&window(), Qt::Key_F7);
  takeUpBurr();
  ASSERT_TRUE(listed());
  QTest::qWait(500); // until it is at rest
  EXPECT_EQ(cell(NearbyModel::Name), "nerve");
  const QStringList distance = cell(NearbyModel::Distance).split(' ');
  ASSERT_EQ(distance.size(), 4) << cell(NearbyModel::Distance).toStdString();
  // The nerve is a sphere of 4 mm about the centre, the burr one of 2 mm.
  EXPECT_NEAR(distance[0].toDouble(), (tool() - kBallCenter).norm() - 4.0 - 2.0, 0.3);
  EXPECT_EQ(cell(NearbyModel::Note), "clear");
  QTest::keyClick(&view(), Qt::Key_D);
  EXPECT_EQ(rows().rowCount(), 0) << "no burr, no distance";
}

TEST_F(Nearby, WarnsInWordsAndBySignWithinTheDistanceOfTheCase)
{
  saveBall("ball");
  openWindow();
  QTest::keyClick(&window(), Qt::Key_F7);
  takeUpBurr();
  ASSERT_TRUE(listed());
  const auto sign = [this] {
    return rows().index(0, NearbyModel::Name).data(Qt::DecorationRole).value<QPixmap>().toImage();
  };
  const QImage clear = sign();
  warnAt(12.0);
  ASSERT_TRUE(waitFor([this] { return cell(NearbyModel::Note) == "within 12.0 mm"; }))
      << cell(NearbyModel::Note).toStdString();
  EXPECT_NE(sign(), clear);
  picture();
  QTest::keyClick(&view(), Qt::Key_D);
  QTest::keyClick(&window(), Qt::Key_S, Qt::ControlModifier);
  EXPECT_TRUE(settled());
  EXPECT_EQ(library().open("ball").labels[0].structures[0].look.warning, 12.0);
}

TEST_F(Nearby, ListsWhatIsInjuredAndWhatWasRemoved)
{
  saveBall("ball");
  openWindow();
  QTest::keyClick(&window(), Qt::Key_F7);
  auto* removed = window().findChild<QLabel*>("removed");
  EXPECT_EQ(removed->text(), QString::fromUtf8("Removed: 0.0 mm³ in 0 strokes"));
  drill(800, 30);
  EXPECT_TRUE(removed->text().endsWith(" in 1 stroke")) << removed->text().toStdString();
  EXPECT_FALSE(removed->text().startsWith("Removed: 0.0 "));
}

// While drilling: volumes change within the stroke, and the warning is shown in the view.
TEST_F(Nearby, FollowsAStrokeThatIsStillDrilled)
{
  saveBall("ball");
  openWindow();
  QTest::keyClick(&window(), Qt::Key_F7);
  takeUpBurr();
  ASSERT_TRUE(listed());
  EXPECT_TRUE(waitFor([this] { return view().display().warning().isEmpty(); }));
  warnAt(12.0);
  ASSERT_TRUE(waitFor([this] { return view().display().warning().startsWith("nerve "); }));
  auto* removed = window().findChild<QLabel*>("removed");
  QTest::keyPress(&view(), Qt::Key_Space);
  EXPECT_TRUE(waitFor([removed] { return !removed->text().startsWith("Removed: 0.0 "); }))
      << removed->text().toStdString();
  EXPECT_TRUE(window().model().drilling());
  EXPECT_EQ(window().model().value().applied(), 0u) << "the stroke is still open";
  EXPECT_TRUE(removed->text().endsWith(" in 1 stroke")) << removed->text().toStdString();
  QTest::keyRelease(&view(), Qt::Key_Space);
  QTest::keyClick(&window(), Qt::Key_F7); // hidden: what must be seen at once stays
  QTest::qWait(200);
  EXPECT_TRUE(view().display().warning().startsWith("nerve "));
  QTest::keyClick(&view(), Qt::Key_D);
  EXPECT_EQ(view().display().warning(), QString());
}

// The panel was never opened.
TEST_F(Nearby, WarnsInThePictureWhileTheBurrIsInTheHandWhateverPanelsAreOpen)
{
  saveBall("ball");
  openWindow();
  EXPECT_FALSE(dock().isVisible());
  warnAt(25.0);
  takeUpBurr();
  EXPECT_TRUE(waitFor([this] { return view().display().warning().startsWith("nerve "); }))
      << view().display().warning().toStdString();
  EXPECT_FALSE(dock().isVisible());
  QTest::keyClick(&view(), Qt::Key_D);
  EXPECT_EQ(view().display().warning(), QString());
}

TEST_F(Nearby, NamesWhatIsStillBeingMeasured)
{
  saveBall("ball");
  openWindow();
  auto& model = const_cast<presenters::WorkstationModel&>(window().model());
  const auto change = [&model](double warning)
  {
    auto look = *model.lookOf("nerve");
    look.shown = false;
    look.warning = warning;
    model.setLook("nerve", look);
  };
  change(0.0);
  ToolDistances distances(model);
  bool isPanelOpen = true; // so that structures are measured of which nobody is warned
  distances.isWideWanted = [&isPanelOpen] { return isPanelOpen; };
  ToolWarnings warnings;
  QObject::connect(&distances, &ToolDistances::measured, &warnings, &ToolWarnings::show);
  QString text;
  bool isAlarmed = false;
  QObject::connect(&warnings, &ToolWarnings::warned, [&](const QString& lines) { text = lines; });
  QObject::connect(&warnings, &ToolWarnings::alarmed, [&](bool near) { isAlarmed = near; });
  const auto ask = [&]
  {
    QTest::qWait(100); // it answers a few times a second
    distances.toolMoved(
        presenters::MeasuredTool(1.0),
        {kBallCenter + Eigen::Vector3d(0.0, 0.0, 9.0), Eigen::Quaterniond::Identity()});
  };
  ASSERT_TRUE(waitFor(
      [&]
      {
        ask();
        return model.measuresNearby() && text.isEmpty();
      }));
  isPanelOpen = false;
  change(20.0);
  ask();
  EXPECT_EQ(text, "no warnings of nerve yet: still being measured");
  EXPECT_FALSE(isAlarmed);
  EXPECT_TRUE(waitFor(
      [&]
      {
        ask();
        return text.startsWith("nerve ");
      }))
      << text.toStdString();
  EXPECT_FALSE(text.contains("measured")) << text.toStdString();
  EXPECT_TRUE(isAlarmed);
}

// The tool moves many times a frame; all who show its distances are told of one measurement.
TEST_F(Nearby, IsMeasuredOnceForAllWhoShowIt)
{
  saveBall("ball");
  openWindow();
  auto& model = const_cast<presenters::WorkstationModel&>(window().model());
  ToolDistances distances(model);
  bool isPanelOpen = true;
  distances.isWideWanted = [&isPanelOpen] { return isPanelOpen; };
  std::vector<presenters::ToolSurroundings> heard;
  QObject::connect(&distances, &ToolDistances::measured,
                   [&heard](const presenters::ToolSurroundings& near) { heard.push_back(near); });
  const auto ask = [&](double away)
  {
    distances.toolGone(); // the next one is measured at once
    distances.toolMoved(
        presenters::MeasuredTool(1.0),
        {kBallCenter + Eigen::Vector3d(0.0, 0.0, away), Eigen::Quaterniond::Identity()});
    return heard.back();
  };
  ASSERT_TRUE(waitFor([&] { return ask(9.0).isMeasured; }));
  const std::size_t before = heard.size();
  const presenters::ToolSurroundings wide = ask(9.0);
  EXPECT_EQ(heard.size(), before + 1);
  ASSERT_EQ(wide.structures.size(), 1U);
  EXPECT_NEAR(wide.structures[0].distance, 9.0 - 4.0 - 1.0, 0.3); // the nerve's radius is 4 mm
  isPanelOpen = false;
  EXPECT_TRUE(ask(9.0).structures.empty()) << "too far for a warning";
  EXPECT_FALSE(ask(9.0).isWide);
  ASSERT_EQ(ask(4.5).structures.size(), 1U);
  EXPECT_EQ(ask(4.5).structures[0].state, presenters::NearbyStructure::State::Touched);

  // Nobody measures what is neither shown nor warned of.
  auto look = *model.lookOf("nerve");
  look.shown = false;
  look.warning = 0.0;
  model.setLook("nerve", look);
  model.forgetNearby();
  EXPECT_TRUE(ask(4.5).isMeasured);
  EXPECT_FALSE(model.measuresNearby());
}
