#include <fstream>
#include <iterator>

#include <QCheckBox>
#include <QComboBox>
#include <QDockWidget>
#include <QDoubleSpinBox>
#include <QFileDialog>
#include <QLabel>
#include <QPushButton>
#include <QSlider>
#include <QTreeWidget>

#include "GuiTest.h"
#include "ReplayController.h"
#include "ReplayPanel.h"
#include "SceneDisplay.h"

using namespace petrous;
using namespace petrous::workstation;

namespace
{

class Replay : public GuiTest
{
protected:
  ReplayController& replay() { return *window().findChild<ReplayController*>(); }
  template <class T>
  T& child(const char* name)
  {
    return *window().findChild<T*>(name);
  }
  const std::optional<rendering::ToolPose>& ghost() { return view().display().ghost(); }
  QAction& play() { return *action("Play the recording"); }

  bool isRead()
  {
    return waitFor([this] { return replay().review().has_value(); });
  }

  // A case with one recorded stroke and the tool put away.
  std::filesystem::path recordStroke()
  {
    const auto file = record();
    drill(600, 30);
    action("Drill")->trigger();
    EXPECT_TRUE(waitFor([this] { return !window().model().lastRecording().empty(); }));
    return file;
  }
};

} // namespace

TEST_F(Replay, ARecordedSessionIsPlayedAsAGhostAndLeavesTheCaseAsItIs)
{
  saveBall("ball");
  openWindow("ball");
  const auto file = recordStroke();
  const std::size_t strokes = window().model().value().applied();
  const bool unsaved = window().model().unsaved();
  EXPECT_FALSE(ghost());
  auto& recordings = child<QComboBox>("replayChoice");
  ASSERT_EQ(recordings.count(), 1);
  EXPECT_EQ(recordings.itemText(0).toStdString(), file.filename().string());
  EXPECT_EQ(recordings.currentIndex(), -1);
  EXPECT_EQ(recordings.placeholderText(), "Choose a recording");
  emit recordings.activated(0);
  ASSERT_TRUE(isRead()) << child<QLabel>("replaySaid").text().toStdString();
  EXPECT_TRUE(child<QDockWidget>("replayDock").isVisible());
  EXPECT_EQ(window().model().value().applied(), strokes);
  EXPECT_EQ(window().model().unsaved(), unsaved);

  ASSERT_TRUE(ghost());
  const Eigen::Vector3d before = ghost()->center;
  auto& place = child<QSlider>("replayPlace");
  ASSERT_GT(place.maximum(), 0);
  place.setValue(place.maximum());
  EXPECT_DOUBLE_EQ(ghost()->radius, 0.5 * replay().review()->burr.diameter);
  EXPECT_NE(ghost()->center, before);
  child<QCheckBox>("replayGhost").setChecked(false);
  EXPECT_FALSE(ghost());
  child<QCheckBox>("replayGhost").setChecked(true);

  play().trigger(); // from the end: anew
  EXPECT_TRUE(replay().playing());
  EXPECT_TRUE(waitFor([this] { return replay().time() > 0.0 && replay().playing(); }));
  EXPECT_TRUE(waitFor([this] { return !replay().playing(); }));
  EXPECT_DOUBLE_EQ(replay().time(), replay().review()->metrics.duration);
  action("Close the case")->trigger();
  EXPECT_TRUE(settled());
  EXPECT_FALSE(ghost());
}

TEST_F(Replay, MetricsAreShownWithTheirUnitsAndExported)
{
  saveBall("ball");
  openWindow("ball");
  replay().open(recordStroke());
  ASSERT_TRUE(isRead());
  const auto& review = *replay().review();
  EXPECT_EQ(review.whyUnmeasured, "");
  ASSERT_TRUE(review.removed);
  EXPECT_DOUBLE_EQ(*review.removed, window().model().value().dissection.strokes()[0]->info.removed);
  EXPECT_GT(review.metrics.drilling, 0.0);
  EXPECT_GT(review.metrics.maxForce, 0.0);
  auto& metrics = child<QTreeWidget>("replayMetrics");
  QStringList texts;
  for (int n = 0; n < metrics.topLevelItemCount(); ++n)
    texts += metrics.topLevelItem(n)->text(0) + ": " + metrics.topLevelItem(n)->text(1);
  const QString shown = texts.join('\n');
  for (const char* part : {"Time: ", " mm", " N", " mm³"})
    EXPECT_TRUE(shown.contains(QString::fromUtf8(part))) << part << "\n" << shown.toStdString();
  auto& structures = child<QTreeWidget>("replayStructures");
  ASSERT_EQ(structures.topLevelItemCount(), 1);
  EXPECT_EQ(structures.topLevelItem(0)->text(0), "nerve");
  EXPECT_TRUE(structures.topLevelItem(0)->text(1).endsWith("mm"));

  for (const int kind : {0, 1})
  {
    const auto file = folder() / (kind == 0 ? "metrics.csv" : "course.csv");
    onDialog(
        [&](QDialog& dialog)
        {
          auto* ask = qobject_cast<QFileDialog*>(&dialog);
          if (!ask)
            return false;
          ask->selectNameFilter(ask->nameFilters()[kind]);
          ask->selectFile(QString::fromStdString(file.string()));
          static_cast<QDialog*>(ask)->accept();
          return true;
        });
    child<QPushButton>("replayExport").click();
    std::ifstream in(file);
    const std::string text{std::istreambuf_iterator<char>(in), {}};
    EXPECT_EQ(text.rfind(kind == 0 ? "quantity,structure,value,unit" : "t_s,x_mm", 0), 0u) << text;
  }
}

// Each burr begins a file; together they are one entry.
TEST_F(Replay, AnOperationWithTwoBurrsIsOneEntryWithAPartPerBurr)
{
  saveBall("ball");
  openWindow("ball");
  const auto first = record();
  drill(600, 30);
  window().findChild<QDoubleSpinBox*>("burrDiameter")->setValue(6.0);
  drill(600, -30);
  action("Drill")->trigger();
  ASSERT_TRUE(waitFor([&] { return window().model().lastRecording() != first; }));
  const auto& strokes = window().model().value().dissection.strokes();
  ASSERT_EQ(strokes.size(), 2U);
  auto& recordings = child<QComboBox>("replayChoice");
  ASSERT_EQ(recordings.count(), 1);
  EXPECT_EQ(recordings.itemText(0).toStdString(), first.filename().string() + " and 1 more");
  emit recordings.activated(0);
  ASSERT_TRUE(isRead()) << child<QLabel>("replaySaid").text().toStdString();
  EXPECT_EQ(recordings.currentIndex(), 0);
  const auto& review = *replay().review();
  ASSERT_EQ(review.parts.size(), 2U);
  ASSERT_TRUE(review.removed) << review.whyUnmeasured;
  EXPECT_NEAR(*review.removed, strokes[0]->info.removed + strokes[1]->info.removed, 1e-9);
  EXPECT_EQ(review.strokes, 2U);
  EXPECT_DOUBLE_EQ(review.metrics.duration, review.parts[0].review.metrics.duration +
                                                review.parts[1].review.metrics.duration);

  auto& parts = child<QTreeWidget>("replayParts");
  EXPECT_TRUE(parts.isVisible());
  ASSERT_EQ(parts.topLevelItemCount(), 3);
  EXPECT_EQ(parts.topLevelItem(0)->text(0), "Together");
  EXPECT_TRUE(parts.topLevelItem(2)->text(0).contains("6"));
  const auto firstMetric = [this]
  { return child<QTreeWidget>("replayMetrics").topLevelItem(0)->text(0); };
  EXPECT_EQ(firstMetric(), "Time");
  parts.setCurrentItem(parts.topLevelItem(2));
  EXPECT_EQ(firstMetric(), "Tool");
  EXPECT_NEAR(replay().time(), review.parts[1].begin, 0.001);
  auto& place = child<QSlider>("replayPlace");
  ASSERT_TRUE(ghost());
  place.setValue(place.maximum());
  EXPECT_DOUBLE_EQ(ghost()->radius, 3.0);
  place.setValue(0);
  EXPECT_DOUBLE_EQ(ghost()->radius, 2.0);
}

// The copy has neither its strokes nor its name.
TEST_F(Replay, OpensOnAColleaguesCopyOfTheCase)
{
  saveBall("copy");
  saveBall("ball");
  openWindow("ball");
  const auto file = recordStroke();
  const double removed = window().model().value().dissection.strokes()[0]->info.removed;
  closeWindow();
  openWindow("copy");
  EXPECT_EQ(child<QComboBox>("replayChoice").count(), 0);
  replay().open(file);
  ASSERT_TRUE(isRead()) << child<QLabel>("replaySaid").text().toStdString();
  ASSERT_TRUE(replay().review()->removed);
  EXPECT_DOUBLE_EQ(*replay().review()->removed, removed);
  EXPECT_EQ(window().model().value().applied(), 0u);
  EXPECT_EQ(child<QComboBox>("replayChoice").count(), 1);
}

TEST_F(Replay, StandsBesideTheToolInUseAndStartsWithItsDrill)
{
  saveBall("ball");
  openWindow("ball");
  replay().open(recordStroke());
  ASSERT_TRUE(isRead());
  child<QCheckBox>("replayWithDrill").setChecked(true);
  EXPECT_FALSE(replay().playing());
  bool played = false;
  QTimer watch;
  QObject::connect(&watch, &QTimer::timeout, &watch,
                   [&] { played = played || replay().playing(); });
  watch.start(5);
  drill(600, -30);
  EXPECT_TRUE(played);
  EXPECT_TRUE(ghost());
  EXPECT_TRUE(view().display().tool());
  EXPECT_EQ(window().model().value().applied(), 2u);
}

TEST_F(Replay, SaysWhyAFileIsNoRecordingOfTheCase)
{
  saveBall("ball");
  openWindow("ball");
  play().trigger();
  EXPECT_FALSE(replay().playing());
  EXPECT_TRUE(child<QDockWidget>("replayDock").isVisible());
  const auto file = folder() / "notes.ticks";
  std::ofstream(file) << "these are notes, and no recording of a session";
  replay().open(file);
  auto& said = child<QLabel>("replaySaid");
  ASSERT_TRUE(waitFor([&] { return said.text().contains("is not a recording"); }))
      << said.text().toStdString();
  EXPECT_FALSE(replay().review());
  EXPECT_FALSE(child<QPushButton>("replayExport").isEnabled());
}
