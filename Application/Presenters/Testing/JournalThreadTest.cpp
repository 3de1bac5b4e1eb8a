#include <chrono>
#include <filesystem>
#include <fstream>
#include <thread>

#include <gtest/gtest.h>

#include <unistd.h>

#include "BoneCase.h"
#include "HeldTool.h"
#include "petrous/Presenters/WorkstationModel.h"

using namespace petrous;
using namespace petrous::presenters;
using Eigen::Vector3d;
using namespace petrous::presenters::testing;

namespace
{

class JournalThreadTest : public ::testing::Test
{
protected:
  void SetUp() override
  {
    std::filesystem::create_directories(folder);
    scene::Case value = block();
    library::Library(folder).save(value);
  }
  void TearDown() override
  {
    std::filesystem::remove_all(folder);
    std::filesystem::remove_all(killed);
  }

  // The library as left by a program that is killed now.
  std::string reopened(scene::Case& value) const
  {
    std::filesystem::remove_all(killed);
    std::filesystem::copy(folder, killed, std::filesystem::copy_options::recursive);
    library::Library library(killed);
    std::string notice;
    library.onNotice([&notice](const std::string& words) { notice = words; });
    value = library.open("block");
    library.loadDissection(value);
    return notice;
  }
  static std::vector<std::uint16_t> voxels(const scene::Case& value)
  {
    const auto dense = value.dissection.mask().dense();
    return {dense.data(), dense.data() + dense.size()};
  }
  bool journalled() const
  {
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder))
      if (entry.path().filename().string().find("journal") != std::string::npos &&
          entry.is_regular_file())
        return true;
    return false;
  }
  static void stroke(WorkstationModel& model, HeldTool& held)
  {
    held.drill(true);
    ASSERT_TRUE(until([&model] { return !model.advanceTouch().bricks.empty(); }));
    held.drill(false);
    ASSERT_TRUE(until([&model] { return !model.advanceTouch().strokes.empty(); }));
  }

  std::filesystem::path folder =
      std::filesystem::temp_directory_path() / ("petrous-journal-" + std::to_string(::getpid()));
  std::filesystem::path killed = folder.string() + "-killed";
};

} // namespace

TEST_F(JournalThreadTest, BringsBackTheStrokesOfAProgramThatWasKilled)
{
  WorkstationModel model{library::Library(folder)};
  model.open("block");
  HeldTool held(Vector3d(6.0, 6.0, kTop + 2.5));
  model.startTouch(held.device, held.setup);
  ASSERT_NO_FATAL_FAILURE(stroke(model, held));
  EXPECT_TRUE(model.unsaved());
  scene::Case again;
  ASSERT_TRUE(
      until([&] { return reopened(again).size() > 10 && again.dissection.strokes().size() == 1; }));
  EXPECT_EQ(voxels(again), voxels(model.value()));
  EXPECT_EQ(again.dissection.strokes()[0]->info.removed,
            model.value().dissection.strokes()[0]->info.removed);

  model.save();
  ASSERT_TRUE(until([this] { return !journalled(); }));
  EXPECT_EQ(reopened(again), "");
  EXPECT_EQ(voxels(again), voxels(model.value()));

  // An undo without a tool, and one with the tool.
  model.stopTouch();
  model.undo();
  ASSERT_TRUE(until([&] { return !reopened(again).empty() && again.applied() == 0; }));
  EXPECT_EQ(again.dissection.strokes().size(), 1u);
  model.startTouch(held.device, held.setup);
  model.redo();
  ASSERT_TRUE(until(
      [&]
      {
        model.advanceTouch();
        reopened(again);
        return model.value().applied() == 1 && again.applied() == 1;
      }));
}

TEST_F(JournalThreadTest, HasAPartOfAStrokeThatIsOpenForLong)
{
  WorkstationModel model{library::Library(folder)};
  model.open("block");
  HeldTool held(Vector3d(6.0, 6.0, kTop + 2.5));
  model.startTouch(held.device, held.setup);
  held.drill(true);
  const auto start = std::chrono::steady_clock::now();
  ASSERT_TRUE(until(
      [&]
      {
        const auto news = model.advanceTouch();
        if (news.record)
          held.device.see(*news.record);
        return std::chrono::steady_clock::now() - start > std::chrono::milliseconds(4000) &&
               journalled();
      }));
  EXPECT_TRUE(model.drilling());
  scene::Case again; // the file may still be partly written
  ASSERT_TRUE(
      until([&] { return !reopened(again).empty() && again.dissection.strokes().size() == 1; }));
  EXPECT_GT(again.dissection.strokes()[0]->info.removed, 0.0);
  EXPECT_FALSE(again.dissection.mask().untouched());
}

TEST_F(JournalThreadTest, TellsThatTheDiskRefusesAndWritesItLater)
{
  scene::Case value = library::Library(folder).open("block");
  library::Library library(folder);
  library.loadDissection(value);
  JournalThread journal;
  journal.begin(library, value);
  EXPECT_EQ(journal.takeFailure(), "");
  value.dissection.beginStroke({});
  value.dissection.cut({{6.0, 6.0, kTop}, {6.0, 6.0, kTop}, 1.0});
  const auto stroke = value.dissection.endStroke();
  // Nothing can be created at the library's path.
  const std::filesystem::path away = folder.string() + "-away";
  std::filesystem::rename(folder, away);
  journal.follow(value.dissection);
  std::string why;
  EXPECT_TRUE(until(
      [&]
      {
        why = journal.takeFailure();
        return !why.empty();
      }));
  std::this_thread::sleep_for(std::chrono::milliseconds(1500));
  EXPECT_EQ(journal.takeFailure(), "") << "told once";
  std::filesystem::rename(away, folder);
  scene::Case again;
  EXPECT_TRUE(
      until([&] { return !reopened(again).empty() && again.dissection.strokes().size() == 1; }));
  EXPECT_EQ(voxels(again), voxels(value));
}

TEST_F(JournalThreadTest, GoesOnInTheLibraryThatTheCaseWasSavedTo)
{
  WorkstationModel model{library::Library(folder)};
  model.open("block");
  HeldTool held(Vector3d(6.0, 6.0, kTop + 2.5));
  model.startTouch(held.device, held.setup);
  ASSERT_NO_FATAL_FAILURE(stroke(model, held));
  const std::filesystem::path elsewhere = folder.string() + "-elsewhere";
  std::filesystem::remove_all(elsewhere);
  model.saveElsewhere(elsewhere, "block");
  ASSERT_TRUE(model.touching());
  EXPECT_TRUE(until([this] { return !journalled(); })) << "the old journal is of no more use";
  ASSERT_NO_FATAL_FAILURE(stroke(model, held));
  ASSERT_TRUE(until([&] { return std::filesystem::exists(elsewhere / "cases/block.journal"); }));
  std::filesystem::remove_all(folder);
  std::filesystem::rename(elsewhere, folder); // open files stay open
  scene::Case again;
  ASSERT_TRUE(
      until([&] { return !reopened(again).empty() && again.dissection.strokes().size() == 2; }));
  EXPECT_EQ(voxels(again), voxels(model.value()));
}

TEST_F(JournalThreadTest, HasWhatWasDrilledWhileTheImportWasStored)
{
  library::Library library(folder);
  library.remove("block");
  WorkstationModel model{library};
  model.adopt(block());
  StoreTask task = model.beginStore();
  HeldTool held(Vector3d(6.0, 6.0, kTop + 2.5));
  model.startTouch(held.device, held.setup);
  ASSERT_NO_FATAL_FAILURE(stroke(model, held));
  task.run();
  model.stored(task);
  scene::Case again;
  ASSERT_TRUE(
      until([&] { return !reopened(again).empty() && again.dissection.strokes().size() == 1; }));
  EXPECT_EQ(voxels(again), voxels(model.value()));
  ASSERT_NO_FATAL_FAILURE(stroke(model, held));
  ASSERT_TRUE(
      until([&] { return !reopened(again).empty() && again.dissection.strokes().size() == 2; }));
  EXPECT_EQ(voxels(again), voxels(model.value()));
}

// The journal is fed by the removal thread, then by the window: the states belong to two
// dissections, whose change counters are unrelated.
TEST_F(JournalThreadTest, HasAnUndoThatFollowsManyStepsOfTheTool)
{
  WorkstationModel model{library::Library(folder)};
  model.open("block");
  HeldTool held(Vector3d(6.0, 6.0, kTop + 2.5));
  model.startTouch(held.device, held.setup);
  ASSERT_NO_FATAL_FAILURE(stroke(model, held));
  ASSERT_NO_FATAL_FAILURE(stroke(model, held));
  model.stopTouch();
  for (const std::size_t done : {1U, 0U, 1U, 2U, 1U})
  {
    done < model.value().applied() ? model.undo() : model.redo();
    ASSERT_EQ(model.value().applied(), done);
    scene::Case again;
    EXPECT_TRUE(until([&] { return !reopened(again).empty() && again.applied() == done; })) << done;
  }
}
