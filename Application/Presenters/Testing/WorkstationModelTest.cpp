#include <gtest/gtest.h>

#include <csignal>
#include <filesystem>
#include <fstream>
#include <map>
#include <optional>
#include <set>
#include <thread>

#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "HeldTool.h"
#include "petrous/Appearance/StructureProperties.h"
#include "petrous/Library/FrameSalt.h"
#include "petrous/Library/LibraryError.h"
#include "petrous/Library/OpenMark.h"
#include "petrous/Presenters/CaseNaming.h"
#include "petrous/Presenters/RecordingPlayer.h"
#include "petrous/Presenters/WorkstationModel.h"
#include "petrous/Scene/ApplyRegistration.h"

using namespace petrous;
using namespace petrous::presenters;
using Eigen::Vector3d;
using petrous::presenters::testing::HeldTool;
using petrous::presenters::testing::until;

namespace
{

class WorkstationModelTest : public ::testing::Test
{
protected:
  WorkstationModelTest()
  {
    const auto* test = ::testing::UnitTest::GetInstance()->current_test_info();
    folder = std::filesystem::temp_directory_path() /
             ("petrous-model-" + std::to_string(::getpid()) + "-" + test->name());
    std::filesystem::remove_all(folder);
  }
  ~WorkstationModelTest() override { std::filesystem::remove_all(folder); }

  static scene::Case block(const std::string& name) // bone where z < 6 mm
  {
    scene::Case value;
    value.name = name;
    value.ct.name = "ct";
    value.ct.geometry = core::GridGeometry({40, 40, 40}, Vector3d::Constant(0.3), Vector3d::Zero());
    auto ct = std::make_shared<volume::Volume<std::int16_t>>(value.ct.geometry);
    for (int k = 0; k < 40; ++k)
      for (int j = 0; j < 40; ++j)
        for (int i = 0; i < 40; ++i)
          ct->at(i, j, k) = k < 20 ? std::int16_t{1500} : std::int16_t{-900};
    value.ct.volume = std::make_shared<const volume::IntensityVolume>(
        std::shared_ptr<const volume::Volume<std::int16_t>>(ct));
    return value;
  }

  static void stroke(WorkstationModel& model)
  {
    HeldTool held({6, 6, 8.5});
    model.startTouch(held.device, held.setup);
    const auto whole = model.surfaceAt(line());
    held.drill(true);
    EXPECT_TRUE(until(
        [&]
        {
          model.advanceTouch();
          const auto cut = model.surfaceAt(line());
          return whole && cut && cut->z() < whole->z() - 0.1;
        }));
    EXPECT_TRUE(model.drilling());
    held.drill(false);
    EXPECT_TRUE(until([&model] { return model.advanceTouch().strokes.size() == 1; }));
    model.stopTouch();
    EXPECT_FALSE(model.touching());
  }
  static interaction::PickRay line() { return {{6, 6, 30}, {0, 0, -1}}; }

  std::filesystem::path folder;
};

} // namespace

// Told by who comes second; a look at the case stays possible.
TEST_F(WorkstationModelTest, ACaseThatIsOpenElsewhereIsToldOf)
{
  library::Library library(folder);
  scene::Case value = block("block");
  library.save(value);
  const auto marks = [this]
  {
    std::error_code error;
    return std::distance(std::filesystem::directory_iterator(folder / "open", error), {});
  };
  std::vector<std::string> noticed;
  WorkstationModel model(library);
  model.events.noticed = [&noticed](const std::string& words) { noticed.push_back(words); };
  model.open("block");
  EXPECT_TRUE(noticed.empty());
  EXPECT_EQ(marks(), 1);
  model.open("block"); // again
  EXPECT_TRUE(noticed.empty());
  EXPECT_EQ(marks(), 1);
  model.close();
  EXPECT_EQ(marks(), 0);

  int ready[2];
  ASSERT_EQ(::pipe(ready), 0);
  const pid_t other = ::fork();
  if (other == 0)
  {
    const library::OpenMark mark(folder, value.id);
    [[maybe_unused]] const ssize_t told = ::write(ready[1], "x", 1);
    for (;;)
      ::pause();
  }
  char byte = 0;
  EXPECT_EQ(::read(ready[0], &byte, 1), 1);
  model.open("block");
  ASSERT_EQ(noticed.size(), 1U);
  EXPECT_NE(noticed[0].find("is open in another window of Petrous, too (process " +
                            std::to_string(other) + " on "),
            std::string::npos)
      << noticed[0];
  model.setIso(400.0);
  EXPECT_NO_THROW(model.save());
  EXPECT_EQ(noticed.size(), 1U) << "once";
  ::kill(other, SIGKILL);
  ::waitpid(other, nullptr, 0);
  model.close();
  model.open("block");
  EXPECT_EQ(noticed.size(), 1U);
  ::close(ready[0]);
  ::close(ready[1]);
}

TEST_F(WorkstationModelTest, OpensSavesAndFindsTheStrokeAgain)
{
  library::Library library(folder);
  scene::Case value = block("block");
  library.save(value);
  WorkstationModel model{library};
  EXPECT_EQ(model.latestCase(), "block");
  model.open("block");
  int cuts = 0;
  model.events.maskChanged = [&cuts](const core::IndexBox& box)
  {
    EXPECT_FALSE(box.empty());
    ++cuts;
  };
  stroke(model);
  EXPECT_GT(cuts, 0);
  EXPECT_TRUE(model.unsaved());
  model.save();
  EXPECT_FALSE(model.unsaved());
  EXPECT_EQ(library.open("block").dissection.strokes().size(), 1u);
}

// What was felt of a copy before the stroke does not bring the bone back that the stroke removed.
TEST_F(WorkstationModelTest, AToolThatIsPreparedApartFeelsWhatWasDrilledMeanwhile)
{
  WorkstationModel model{library::Library(folder)};
  model.adopt(block("block"));
  model.prepareNow();
  session::TouchTool tool;
  EXPECT_FALSE(model.toolReady(tool));
  const auto preparation = model.toolPreparation(tool);
  const auto whole = model.surfaceAt(line());
  stroke(model);
  tool.mode = session::TouchTool::Mode::ThreeDof;
  EXPECT_TRUE(model.toolReady(tool)) << "felt by the stroke itself";
  model.undo();
  model.redo();
  const auto before = model.surfaceAt(line());
  ASSERT_TRUE(before);
  ASSERT_LT(before->z(), whole->z() - 0.05) << "nothing was removed";

  PreparedTool done = preparation({});
  ASSERT_TRUE(done.felt);
  ASSERT_TRUE(done.shell);
  scene::Case value = model.value();
  session::DrillSession drill(value);
  const session::TouchScene stale(value, drill, std::move(*done.felt));
  const session::TouchScene fresh(value, drill);
  const volume::MaskState* a = stale.mask()->acquire();
  const volume::MaskState* b = fresh.mask()->acquire();
  EXPECT_EQ(stale.mask()->number(), 1U) << "one state more: what was drilled since";
  for (std::size_t n = 0; n < value.dissection.mask().brickCount(); ++n)
    EXPECT_EQ(stale.mask()->brick(n), fresh.mask()->brick(n));
  EXPECT_NE(a, nullptr);
  EXPECT_NE(b, nullptr);
  stale.mask()->release();
  fresh.mask()->release();
}

TEST_F(WorkstationModelTest, ATissueThatHasChangedIsNotTakenFromAnEarlierPreparation)
{
  WorkstationModel model{library::Library(folder)};
  model.adopt(block("block"));
  model.prepareNow();
  const session::TouchTool tool;
  const auto preparation = model.toolPreparation(tool);
  model.setIso(700.0);
  model.prepareNow();
  model.toolPrepared(preparation({}));
  EXPECT_FALSE(model.toolReady(tool));
  model.toolPrepared(model.toolPreparation(tool)({}));
  EXPECT_TRUE(model.toolReady(tool));
  session::TouchTool wider = tool;
  wider.burr.diameter = tool.burr.diameter + 1.0;
  EXPECT_FALSE(model.toolReady(wider)) << "its points are not made";
  const PreparedTool other = model.toolPreparation(wider)({});
  EXPECT_FALSE(other.felt) << "felt once";
  EXPECT_TRUE(other.shell);
  wider.mode = session::TouchTool::Mode::ThreeDof;
  EXPECT_TRUE(model.toolReady(wider)) << "needs no points";
}

// One after another they lead a copy of the case to the same dissection.
TEST_F(WorkstationModelTest, RecordsEachSessionToAFileOfItsOwnUntilAnotherCaseIsOpen)
{
  WorkstationModel model{library::Library(folder)};
  scene::Case copy = block("copy");
  model.library().loadDissection(copy);
  model.adopt(block("block"));
  model.prepareNow();
  std::vector<std::filesystem::path> files;
  model.events.recordingChanged = [&](const std::string& fault)
  {
    EXPECT_EQ(fault, "");
    if (files.empty() || files.back() != model.recording())
      files.push_back(model.recording());
  };
  std::filesystem::create_directories(folder);
  const auto first = folder / "ear.ticks", second = folder / "ear (2).ticks";
  model.record(first);
  EXPECT_FALSE(std::filesystem::exists(first)) << "it begins with the tool";
  stroke(model);
  stroke(model);
  EXPECT_EQ(files, (std::vector{first, second}));
  for (const auto& file : files)
  {
    session::RecordingReader reader(file);
    session::TouchScene scene(copy, {}, reader.setup().scene.firstState);
    RecordingPlayer player(copy, scene, reader, "ear.ticks");
    while (player.next())
      player.feel();
    EXPECT_TRUE(player.outcome().equal()) << player.outcome().difference;
    EXPECT_TRUE(reader.complete());
  }
  ASSERT_EQ(copy.dissection.strokes().size(), 2u);
  ASSERT_EQ(model.value().dissection.strokes().size(), 2u);
  EXPECT_EQ(copy.dissection.strokes()[0]->info.removed,
            model.value().dissection.strokes()[0]->info.removed);
  EXPECT_EQ(copy.dissection.strokes()[1]->info.removed,
            model.value().dissection.strokes()[1]->info.removed);
  model.adopt(block("other"));
  EXPECT_TRUE(model.recording().empty());
  EXPECT_EQ(files.size(), 3u);
  model.prepareNow();
  stroke(model);
  EXPECT_FALSE(std::filesystem::exists(folder / "ear (3).ticks"));
}

TEST_F(WorkstationModelTest, DrillsOnWhereItCannotBeRecorded)
{
  WorkstationModel model{library::Library(folder)};
  model.adopt(block("block"));
  model.prepareNow();
  std::filesystem::create_directories(folder);
  std::string fault;
  model.events.recordingChanged = [&fault](const std::string& why) { fault = why; };
  model.record(folder / "missing" / "ear.ticks");
  EXPECT_EQ(fault, "");
  stroke(model);
  EXPECT_NE(fault.find("ear.ticks: could not be written"), std::string::npos) << fault;
  EXPECT_TRUE(model.recording().empty());
  EXPECT_EQ(model.value().dissection.strokes().size(), 1u);

  // The disk is full once the recording has begun.
  fault.clear();
  model.record(folder / "ear.ticks");
  HeldTool hand({6, 6, 8.5});
  model.startTouch(hand.device, hand.setup);
  rlimit before{};
  ASSERT_EQ(::getrlimit(RLIMIT_FSIZE, &before), 0);
  const auto old = std::signal(SIGXFSZ, SIG_IGN);
  rlimit small = before;
  small.rlim_cur = 4;
  ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &small), 0);
  EXPECT_TRUE(until(
      [&]
      {
        model.advanceTouch();
        return !fault.empty();
      }));
  ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &before), 0);
  std::signal(SIGXFSZ, old);
  EXPECT_NE(fault.find("ear.ticks: could not be written"), std::string::npos) << fault;
  EXPECT_TRUE(model.recording().empty());
  EXPECT_TRUE(model.touching());
  hand.drill(true);
  EXPECT_TRUE(until([&model] { return !model.advanceTouch().bricks.empty(); }));
  model.stopTouch();
  EXPECT_EQ(model.value().dissection.strokes().size(), 2u);
}

TEST_F(WorkstationModelTest, UndoAndRedoTellWhereTheMaskChanged)
{
  WorkstationModel model{library::Library(folder)};
  model.adopt(block("block"));
  model.prepareNow();
  EXPECT_FALSE(model.canUndo());
  stroke(model);
  core::IndexBox box;
  model.events.maskChanged = [&box](const core::IndexBox& changed) { box = changed; };
  ASSERT_TRUE(model.canUndo());
  model.undo();
  EXPECT_TRUE(box.contains({20, 20, 19}));
  EXPECT_TRUE(model.value().dissection.mask().untouched());
  EXPECT_FALSE(model.canUndo());
  box = {};
  model.redo();
  EXPECT_TRUE(box.contains({20, 20, 19}));
  EXPECT_FALSE(model.canRedo());
}

TEST_F(WorkstationModelTest, UndoesTheOpenStrokeWhileTheToolIsActive)
{
  WorkstationModel model{library::Library(folder)};
  model.adopt(block("block"));
  model.prepareNow();
  HeldTool held({6, 6, 8.5});
  model.startTouch(held.device, held.setup);
  held.drill(true);
  ASSERT_TRUE(until([&model] { return !model.advanceTouch().bricks.empty(); }));
  EXPECT_TRUE(model.canUndo());
  held.drill(false);
  bool back = false;
  model.events.stepped = [&back](bool undone) { back = undone; };
  model.undo();
  EXPECT_TRUE(until(
      [&]
      {
        model.advanceTouch();
        return back;
      }));
  EXPECT_TRUE(model.touching());
  EXPECT_FALSE(model.drilling());
  EXPECT_TRUE(model.unsaved());
  EXPECT_EQ(model.value().applied(), 0u);
  EXPECT_TRUE(model.value().dissection.mask().untouched());
  EXPECT_TRUE(model.canRedo());
}

TEST_F(WorkstationModelTest, AnotherThresholdPutsTheToolAway)
{
  WorkstationModel model{library::Library(folder)};
  model.adopt(block("block"));
  model.prepareNow();
  HeldTool held({6, 6, 8.5});
  model.startTouch(held.device, held.setup);
  EXPECT_TRUE(model.touching());
  model.setIso(700.0);
  EXPECT_FALSE(model.touching());
  EXPECT_FALSE(model.advanceTouch().record.has_value());
  model.adopt(block("other"));
  model.prepareNow();
  model.startTouch(held.device, held.setup);
  model.adopt(block("block"));
  model.prepareNow();
  EXPECT_FALSE(model.touching());
}

TEST_F(WorkstationModelTest, AnMrThatMovesPutsTheToolAwayOnlyWhereSomethingWasDrawnOnIt)
{
  WorkstationModel model{library::Library(folder)};
  scene::Case value = block("block");
  for (const char* name : {"T2", "DWI"})
  {
    scene::ImagePart mr = value.ct;
    mr.name = name;
    value.mr.push_back(mr);
  }
  auto voxels = std::make_shared<volume::Volume<std::uint16_t>>(value.ct.geometry);
  voxels->at(20, 20, 22) = 1;
  volume::LabelMap map;
  map.voxels = voxels;
  scene::LabelPart part;
  scene::StructurePart structure;
  structure.name = "tumour";
  structure.index = 1;
  structure.look.solid = structure.look.touchable = true;
  part.structures = {structure};
  part.drawnOn = "T2";
  part.labels = std::make_shared<const volume::LabelMap>(std::move(map));
  value.labels = {part};
  scene::applyRegistration(value, "T2", {}, {});
  model.adopt(std::move(value));
  model.prepareNow();
  int notified = 0;
  model.events.toolPutAway = [&notified] { ++notified; };
  const auto lay = [&model](const std::string& mr, double shift)
  {
    model.changeMr(
        [&](scene::Case& c) {
          scene::applyRegistration(c, mr, {Eigen::Quaterniond::Identity(), {shift, 0.0, 0.0}}, {});
        });
  };
  HeldTool held({6, 6, 8.5});
  model.startTouch(held.device, held.setup);
  lay("DWI", 1.0);
  EXPECT_TRUE(model.touching()) << "nothing was drawn on that";
  model.changeMr([](scene::Case& c) { scene::signOff(c, "T2", "A. Surgeon", "2026-01-31"); });
  EXPECT_TRUE(model.touching()) << "a signature moves nothing";
  EXPECT_EQ(notified, 0);
  lay("T2", 1.0);
  EXPECT_FALSE(model.touching());
  EXPECT_EQ(notified, 1);
  lay("T2", 2.0);
  EXPECT_EQ(notified, 1) << "nothing was in the hand";
  EXPECT_EQ(model.readPlace({6.0 - 2.0, 6.0, 6.6}).structure, "tumour") << "read where it lies now";

  model.startTouch(held.device, held.setup);
  held.drill(true);
  ASSERT_TRUE(until([&model] { return !model.advanceTouch().bricks.empty(); }));
  lay("T2", 3.0);
  EXPECT_EQ(model.value().mr[0].mrFromCt.translation()[0], 2.0) << "it stays while the drill runs";
  EXPECT_TRUE(model.touching());
  held.drill(false);
  EXPECT_TRUE(until([&model] { return model.advanceTouch().strokes.size() == 1; }));
}

TEST_F(WorkstationModelTest, WorkGoesOnWhileSomebodyElseStoresTheCase)
{
  library::Library library(folder);
  WorkstationModel model{library};
  model.adopt(block("block"));
  model.prepareNow();
  EXPECT_TRUE(model.unsaved());
  presenters::StoreTask task = model.beginStore();
  EXPECT_TRUE(model.beingStored());
  stroke(model);
  task.run();
  model.stored(task);
  EXPECT_FALSE(model.beingStored());
  EXPECT_TRUE(model.unsaved()); // the stroke
  model.save();
  EXPECT_EQ(library.open("block").dissection.strokes().size(), 1u);
}

TEST_F(WorkstationModelTest, ARefusedSaveChangesNothingAndAnotherNameHelps)
{
  library::Library library(folder);
  scene::Case value = block("block");
  library.save(value);
  WorkstationModel model{library};
  model.open("block");
  library.save(value); // by someone else
  stroke(model);
  EXPECT_THROW(model.save(), library::LibraryError);
  EXPECT_TRUE(model.unsaved());
  EXPECT_EQ(model.value().dissection.strokes().size(), 1u);
  EXPECT_THROW(model.saveAs("block"), library::LibraryError);
  EXPECT_EQ(freeCaseName(library, "block"), "block 2");
  model.saveAs("block 2");
  EXPECT_FALSE(model.unsaved());
  EXPECT_EQ(library.open("block 2").dissection.strokes().size(), 1u);
  EXPECT_TRUE(library.open("block").dissection.strokes().empty());
}

TEST_F(WorkstationModelTest, SavesWithAllVoxelsIntoAnotherLibrary)
{
  library::Library library(folder / "one");
  scene::Case value = block("block");
  auto pick = std::make_shared<core::TriangleMesh>();
  pick->vertices = {{0, 0, 0}, {1, 0, 40}, {0, 1, 40}, {-1, -1, 40}};
  pick->triangles = {{0, 2, 1}, {0, 3, 2}, {0, 1, 3}, {1, 2, 3}};
  value.view.instrument.emplace();
  value.view.instrument->mesh = std::shared_ptr<const core::TriangleMesh>(pick);
  library.save(value);
  WorkstationModel model{library};
  model.open("block");
  stroke(model);
  model.saveElsewhere(folder / "two", "block");
  EXPECT_EQ(model.value().view.instrument->object, value.view.instrument->object);
  EXPECT_TRUE(until([this] { return !exists(folder / "one" / "cases" / "block.journal"); }))
      << "the journal's thread removes it";
  std::filesystem::remove_all(folder / "one");
  library::Library two(folder / "two");
  auto opened = two.open("block");
  two.loadDissection(opened);
  EXPECT_EQ(opened.applied(), 1u);
  EXPECT_EQ(opened.ct.volume.get()->at(1, 1, 1), 1500.0);
  ASSERT_TRUE(opened.view.instrument);
  EXPECT_EQ(opened.view.instrument->mesh.get()->triangles.size(), 4u);
  EXPECT_EQ(model.library().folder(), folder / "two");
}

// Their salt is another: nothing of the same patient would be taken for the same.
TEST_F(WorkstationModelTest, ForgetsIdentityMarksOfTheLibraryThatACaseLeaves)
{
  const std::string frame(64, 'a'), name(64, 'b');
  const auto marked = [&]
  {
    scene::Case value = block("block");
    value.ct.frameOfReference = frame;
    value.ct.patient.name = name;
    return value;
  };
  library::Library library(folder / "one");
  scene::Case value = marked();
  library.save(value);
  WorkstationModel model{library};
  model.open("block");
  ASSERT_EQ(model.value().ct.frameOfReference, library::saltedFrame(library, frame));
  model.saveElsewhere(folder / "two", "block");
  EXPECT_EQ(model.value().ct.frameOfReference, "");
  EXPECT_TRUE(model.value().ct.patient.empty());
  EXPECT_TRUE(model.library().open("block").ct.patient.empty());

  // Not yet salted, they are salted there.
  WorkstationModel fresh{library};
  fresh.adopt(marked());
  fresh.saveElsewhere(folder / "two", "block 2");
  EXPECT_EQ(fresh.value().ct.frameOfReference, library::saltedFrame(fresh.library(), frame));
  EXPECT_EQ(fresh.value().ct.patient.name, library::saltedFrame(fresh.library(), name));
}

TEST_F(WorkstationModelTest, HoldsTheCrosshairInTheCt)
{
  WorkstationModel model{library::Library(folder)};
  model.adopt(block("block"));
  model.prepareNow();
  model.setCrosshair({-100, 3, 100});
  EXPECT_LT((model.crosshair() - Vector3d(0, 3, 11.7)).norm(), 1e-9);
  EXPECT_EQ(model.hounsfieldAt({3, 3, 3}), 1500.0);
  EXPECT_FALSE(model.hounsfieldAt({-3, 3, 3}).has_value());
}

TEST_F(WorkstationModelTest, AnotherThresholdMovesTheSurface)
{
  WorkstationModel model{library::Library(folder)};
  model.adopt(block("block"));
  model.prepareNow();
  const auto low = model.surfaceAt(line());
  ASSERT_TRUE(low);
  model.setIso(1400.0);
  const auto high = model.surfaceAt(line());
  ASSERT_TRUE(high);
  EXPECT_LT(high->z(), low->z());
  model.setIso(1501.0);
  EXPECT_FALSE(model.surfaceAt(line()).has_value());
}

TEST_F(WorkstationModelTest, BoneCanBeHiddenAndMadeTranslucent)
{
  library::Library library(folder);
  scene::Case value = block("block");
  library.save(value);
  WorkstationModel model{library};
  model.open("block");
  int changes = 0;
  model.events.appearanceChanged = [&changes] { ++changes; };
  appearance::StructureAppearance look = model.value().boneLook;
  look.opacity = 0.4F;
  model.setBoneLook(look);
  EXPECT_EQ(changes, 1);
  EXPECT_TRUE(model.unsaved());
  const auto contents = model.sceneContents();
  EXPECT_EQ(contents.materials.at(0).surfaceOpacity, 0.4F);
  EXPECT_EQ(contents.labels, nullptr);
  model.save();
  EXPECT_EQ(library.open("block").boneLook.opacity, 0.4F);
}

namespace
{

// A sphere of "tumour" above the block.
scene::LabelPart ballOf(const core::GridGeometry& grid, const std::string& name)
{
  auto voxels = std::make_shared<volume::Volume<std::uint16_t>>(grid, std::uint16_t{0});
  for (int k = 0; k < 40; ++k)
    for (int j = 0; j < 40; ++j)
      for (int i = 0; i < 40; ++i)
        if ((Vector3d(i, j, k) - Vector3d(20, 20, 28)).norm() < 6.0)
          voxels->at(i, j, k) = 1;
  scene::LabelPart part;
  part.labels = std::make_shared<const volume::LabelMap>(volume::makeLabelMap(voxels, {}));
  scene::StructurePart structure;
  structure.name = name;
  structure.index = 1;
  structure.voxels = part.labels.get()->segments.front().voxels;
  structure.volume = 1.0;
  part.structures.push_back(structure);
  return part;
}

} // namespace

TEST_F(WorkstationModelTest, ShowsTheCtUntilItsStructuresAreLoaded)
{
  WorkstationModel model{library::Library(folder)};
  scene::Case value = block("block");
  value.labels.push_back(ballOf(value.ct.geometry, "tumour"));
  model.adopt(value);
  EXPECT_FALSE(model.ready());
  EXPECT_TRUE(model.sceneContents().ct);
  EXPECT_FALSE(model.sceneContents().labels);
  EXPECT_TRUE(model.presentable().labels.empty());
  EXPECT_FALSE(model.surfaceAt(line()));
  HeldTool held({6, 6, 11.5});
  EXPECT_THROW(model.startTouch(held.device, held.setup), core::InvalidParameter);

  int shown = 0;
  model.events.appearanceChanged = [&shown] { ++shown; };
  const auto prepare = model.preparation();
  std::unique_ptr<presenters::PreparedCase> done;
  std::thread([&] { done = std::make_unique<presenters::PreparedCase>(prepare({})); }).join();
  EXPECT_TRUE(model.prepared(std::move(*done)));
  EXPECT_TRUE(model.ready());
  EXPECT_EQ(shown, 1);
  EXPECT_TRUE(model.sceneContents().labels);
  ASSERT_TRUE(model.surfaceAt(line()));
  EXPECT_NEAR(model.surfaceAt(line())->z(), 0.3 * 34, 0.3); // of the sphere
  model.startTouch(held.device, held.setup);
  EXPECT_TRUE(model.touching());
}

TEST_F(WorkstationModelTest, DrawsTheOtherMeshesOnWhenOneIsRemovedAndComesBack)
{
  WorkstationModel model{library::Library(folder)};
  scene::Case value = block("block");
  for (const char* name : {"incus", "sinus"})
  {
    auto solid = std::make_shared<core::TriangleMesh>();
    solid->vertices = {{3, 3, 7}, {5, 3, 7}, {3, 5, 7}, {3, 3, 9}};
    solid->triangles = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
    scene::MeshPart mesh;
    mesh.name = name;
    mesh.triangles = 4;
    mesh.mesh = std::shared_ptr<const core::TriangleMesh>(solid);
    value.meshes.push_back(mesh);
  }
  model.adopt(value);
  model.prepareNow();
  const auto before = model.sceneContents();
  ASSERT_EQ(before.meshes.size(), 2U);
  model.removePart("incus");
  EXPECT_FALSE(model.ready()) << "the tissue is another";
  EXPECT_TRUE(model.drawable());
  ASSERT_EQ(model.sceneContents().meshes.size(), 1U);
  EXPECT_EQ(model.sceneContents().meshes[0].mesh, before.meshes[1].mesh);
  EXPECT_EQ(model.presentable().meshes.size(), 1U);
  model.restorePart();
  EXPECT_TRUE(model.drawable());
  EXPECT_EQ(model.sceneContents().meshes.size(), 2U);
  EXPECT_FALSE(model.ready());
  model.prepareNow();
  EXPECT_TRUE(model.ready());
}

TEST_F(WorkstationModelTest, WhatWasPreparedForAnotherCaseIsDropped)
{
  WorkstationModel model{library::Library(folder)};
  scene::Case value = block("block");
  value.labels.push_back(ballOf(value.ct.geometry, "tumour"));
  model.adopt(value);
  auto late = model.preparation()({});
  model.adopt(value);
  EXPECT_FALSE(model.prepared(std::move(late)));
  EXPECT_FALSE(model.ready());
  core::Progress stop(nullptr,
                      []
                      {
                        auto token = std::make_shared<core::CancelToken>();
                        token->cancel();
                        return token;
                      }());
  EXPECT_THROW(model.preparation()(stop), core::CancelledError);
}

TEST_F(WorkstationModelTest, PartsComeToTheOpenCaseAndItsStrokesStay)
{
  library::Library library(folder);
  WorkstationModel model{library};
  model.adopt(block("block"));
  model.save();
  const scene::Case before = model.value();
  scene::Case with = before; // for another thread that reads files
  with.labels.push_back(ballOf(with.ct.geometry, "tumour"));
  stroke(model);
  model.takeParts(before, std::move(with));
  model.prepareNow();
  EXPECT_TRUE(model.unsaved());
  EXPECT_EQ(model.value().dissection.strokes().size(), 1u);
  model.save();
  const auto saved = library.open("block");
  EXPECT_EQ(saved.dissection.strokes().size(), 1u);
  ASSERT_EQ(saved.labels.size(), 1u);
  EXPECT_EQ(saved.labels[0].structures[0].name, "tumour");
}

TEST_F(WorkstationModelTest, AClosedCaseIsGoneFromTheWindowOnly)
{
  library::Library library(folder);
  WorkstationModel model{library};
  model.adopt(block("block"));
  model.save();
  int closed = 0;
  model.events.caseClosed = [&closed] { ++closed; };
  model.close();
  EXPECT_EQ(closed, 1);
  EXPECT_FALSE(model.hasCase());
  EXPECT_FALSE(model.unsaved());
  EXPECT_FALSE(model.canUndo());
  EXPECT_FALSE(model.surfaceAt(line()));
  EXPECT_TRUE(library.contains("block"));
  model.open("block");
  stroke(model);
}

namespace
{

void flipBit(const std::filesystem::path& file)
{
  std::fstream stream(file, std::ios::binary | std::ios::in | std::ios::out);
  stream.seekg(-1000, std::ios::end);
  const char byte = static_cast<char>(stream.get() ^ 4);
  stream.seekp(-1000, std::ios::end);
  stream.put(byte);
}

} // namespace

TEST_F(WorkstationModelTest, NothingIsDrilledInADamagedCtAndNothingIsStoredOfIt)
{
  library::Library library(folder / "library");
  scene::Case value = block("block");
  library.save(value);
  flipBit(folder / "library/objects" / value.ct.object);
  {
    WorkstationModel model{library::Library(folder / "library")};
    model.open("block");
    ASSERT_EQ(model.damage().size(), 1u);
    EXPECT_NE(model.damage()[0].find("the CT of case 'block'"), std::string::npos);
    HeldTool held({6, 6, 8.5});
    EXPECT_THROW(model.startTouch(held.device, held.setup), library::LibraryError);
  }
  // Stored elsewhere it would be valid by the hash of its current content.
  WorkstationModel model{library::Library(folder / "library")};
  model.opened(ReadCase::from(model.library(), "block"));
  EXPECT_THROW(model.saveElsewhere(folder / "other", "block"), library::LibraryError);
  EXPECT_TRUE(library::Library(folder / "other").list().empty());
  EXPECT_EQ(model.library().folder(), folder / "library");
}

TEST_F(WorkstationModelTest, ACaseWhoseCtIsLostOpensWithWhatIsLeft)
{
  library::Library library(folder / "library");
  scene::Case value = block("block");
  value.description.note = "of the left ear";
  value.attachments.emplace_back();
  value.attachments.back().name = "tool.ticks";
  value.attachments.back().kind = scene::Attachment::Kind::Recording;
  value.attachments.back().content =
      std::make_shared<std::vector<std::uint8_t>>(std::vector<std::uint8_t>(16, 'x'));
  library.save(value);
  library.loadDissection(value);
  const Eigen::Vector3d p = value.ct.geometry.center();
  value.dissection.beginStroke({});
  value.dissection.cut({p, p + Eigen::Vector3d(0.5, 0, 0), 1.0});
  value.dissection.endStroke();
  library.save(value);
  const std::filesystem::path object = folder / "library/objects" / value.ct.object;
  const auto objects = [this]
  {
    std::set<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(folder / "library/objects"))
      names.insert(entry.path().filename().string());
    return names;
  };
  for (const bool isCut : {false, true}) // cut short: it cannot be mapped
  {
    std::filesystem::remove(object);
    if (isCut)
      std::ofstream(object) << "NRRD";
    const auto before = objects();
    WorkstationModel model{library::Library(folder / "library")};
    model.open("block");
    ASSERT_TRUE(model.hasCase());
    EXPECT_TRUE(model.library().isStandIn(model.value().ct));
    EXPECT_EQ(model.value().description.note, "of the left ear");
    EXPECT_EQ(model.value().attachments.size(), 1u);
    EXPECT_EQ(model.value().applied(), 1u);
    EXPECT_EQ(model.value().labels.size(), value.labels.size());
    ASSERT_EQ(model.damage().size(), 1u);
    EXPECT_NE(model.damage()[0].find("the CT of case 'block'"), std::string::npos);
    EXPECT_NO_THROW(model.sceneContents());
    HeldTool held({6, 6, 8.5});
    EXPECT_THROW(model.startTouch(held.device, held.setup), library::LibraryError);
    EXPECT_THROW(model.saveElsewhere(folder / "other", "block"), library::LibraryError);
    model.setAttachmentNote("tool.ticks", isCut ? "cut" : "gone");
    model.save();
    EXPECT_EQ(objects(), before) << "nothing that stands in is stored";
    const scene::Case saved = library.open("block");
    EXPECT_EQ(saved.ct.object, value.ct.object) << "the reference stays";
    EXPECT_EQ(saved.attachments[0].note, isCut ? "cut" : "gone");
  }
  // The same image again puts it back.
  scene::Case again = block("again");
  library.save(again);
  ASSERT_EQ(again.ct.object, value.ct.object);
  WorkstationModel model{library::Library(folder / "library")};
  model.open("block");
  EXPECT_FALSE(model.library().isStandIn(model.value().ct));
  EXPECT_TRUE(model.damage().empty());
  EXPECT_EQ(model.value().ct.volume.get()->at(6, 6, 6), again.ct.volume.get()->at(6, 6, 6));
}

TEST_F(WorkstationModelTest, ARecordingReplacesNothingThatALibraryKeeps)
{
  library::Library library(folder / "library");
  scene::Case value = block("block");
  library.save(value);
  WorkstationModel model{library};
  model.opened(ReadCase::from(library, "block"));
  model.prepareNow();
  const std::filesystem::path manifest = folder / "library/cases/block.json";
  const auto size = std::filesystem::file_size(manifest);
  model.record(manifest);
  std::string fault;
  model.events.recordingChanged = [&fault](const std::string& words) { fault = words; };
  HeldTool held({6, 6, 8.5});
  held.setup.cuts = true;
  model.startTouch(held.device, held.setup);
  model.stopTouch();
  EXPECT_NE(fault.find("Nothing is recorded"), std::string::npos) << fault;
  EXPECT_EQ(std::filesystem::file_size(manifest), size);
  EXPECT_NO_THROW(library.open("block"));
}

TEST_F(WorkstationModelTest, ACaseWhoseFileWasChangedOutsideOpensWithANotice)
{
  library::Library library(folder);
  scene::Case value = block("block");
  value.iso = 400.0;
  library.save(value);
  const std::filesystem::path manifest = folder / "cases/block.json";
  std::string text;
  {
    std::ifstream file(manifest, std::ios::binary);
    text.assign(std::istreambuf_iterator<char>(file), {});
  }
  const std::size_t at = text.find("\"iso_hu\": 400.0");
  ASSERT_NE(at, text.npos);
  text[at + 10] = '5';
  std::ofstream(manifest, std::ios::binary) << text;
  WorkstationModel model{library};
  std::vector<std::string> notices;
  model.events.noticed = [&notices](const std::string& words) { notices.push_back(words); };
  model.opened(ReadCase::from(library, "block"));
  ASSERT_EQ(notices.size(), 1U);
  EXPECT_NE(notices[0].find("changed outside of Petrous"), std::string::npos) << notices[0];
  EXPECT_EQ(model.value().iso, 500.0);
}

TEST_F(WorkstationModelTest, ACtOfTheLibraryIsCheckedBeforeAToolIsTakenUp)
{
  library::Library library(folder);
  scene::Case value = block("block");
  library.save(value);
  WorkstationModel model{library};
  model.opened(ReadCase::from(library, "block"));
  EXPECT_FALSE(model.ready());
  EXPECT_TRUE(model.preparationHelps());
  model.prepareNow();
  EXPECT_TRUE(model.ready());
  EXPECT_FALSE(model.preparationHelps());
  EXPECT_TRUE(model.damage().empty());
  stroke(model);
}

TEST_F(WorkstationModelTest, AStructureThatCannotBeReadIsLeftOutAndStaysAsItIs)
{
  library::Library library(folder / "library");
  scene::Case value = block("block");
  value.labels.push_back(ballOf(value.ct.geometry, "tumour"));
  value.labels.push_back(ballOf(value.ct.geometry, "nerve"));
  auto drawn = std::make_shared<volume::Volume<std::uint16_t>>(value.ct.geometry, std::uint16_t{0});
  drawn->at(20, 20, 24) = 1;
  value.labels[1].labels =
      std::make_shared<const volume::LabelMap>(volume::makeLabelMap(drawn, {}));
  auto solid = std::make_shared<core::TriangleMesh>();
  solid->vertices = {{3, 3, 7}, {5, 3, 7}, {3, 5, 7}, {3, 3, 9}};
  solid->triangles = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
  scene::MeshPart mesh;
  mesh.name = "incus";
  mesh.triangles = 4;
  mesh.mesh = std::shared_ptr<const core::TriangleMesh>(solid);
  value.meshes.push_back(mesh);
  library.save(value);
  const auto objects = folder / "library/objects";
  std::filesystem::rename(objects / value.labels[0].object, folder / "tumour");
  std::filesystem::rename(objects / value.meshes[0].object, folder / "incus");

  WorkstationModel model{library};
  model.open("block");
  ASSERT_EQ(model.leftOut().size(), 2u);
  EXPECT_TRUE(model.ready()) << "the others are there";
  ASSERT_TRUE(model.surfaceAt(line()));
  EXPECT_LT(model.surfaceAt(line())->z(), 0.3 * 27) << "the nerve, and nothing of the tumour";
  EXPECT_TRUE(model.sceneContents().labels);
  model.readPlace({6, 6, 5});
  stroke(model);
  model.undo(); // the stroke was at the tumour's position
  model.setIso(500.0);
  EXPECT_TRUE(model.surfaceAt(line()));
  EXPECT_THROW(model.saveElsewhere(folder / "other", "block"), core::Error) << "not without it";

  model.save();
  std::filesystem::rename(folder / "tumour", objects / value.labels[0].object);
  std::filesystem::rename(folder / "incus", objects / value.meshes[0].object);
  const auto saved = library.open("block");
  EXPECT_EQ(saved.labels.at(0).object, value.labels[0].object);
  EXPECT_EQ(saved.meshes.at(0).object, value.meshes[0].object);
  EXPECT_EQ(saved.labels[0].labels.get()->segments.size(), 1u);
  model.open("block");
  EXPECT_TRUE(model.leftOut().empty());
  EXPECT_GT(model.surfaceAt(line())->z(), 0.3 * 33)
      << "nothing was kept of the case without what was left out";
}

TEST_F(WorkstationModelTest, AStructureThatWasLeftOutIsWholeWhenItIsTakenOutAndPutBack)
{
  library::Library library(folder / "library");
  scene::Case value = block("block");
  value.labels.push_back(ballOf(value.ct.geometry, "tumour"));
  library.save(value);
  const auto object = folder / "library/objects" / value.labels[0].object;
  std::filesystem::rename(object, folder / "tumour");
  WorkstationModel model{library};
  model.open("block");
  ASSERT_EQ(model.leftOut().size(), 1U);
  const auto taken = model.takeStructure("tumour");
  ASSERT_TRUE(taken);
  model.putStructure(*taken);
  model.prepareNow();
  model.save();
  std::filesystem::rename(folder / "tumour", object);
  const auto saved = library.open("block");
  EXPECT_EQ(saved.labels.at(0).object, value.labels[0].object);
  EXPECT_EQ(saved.labels[0].labels.get()->segments.size(), 1U);
}

TEST_F(WorkstationModelTest, NoToolIsTakenUpInACaseThatIsLeft)
{
  WorkstationModel model{library::Library(folder)};
  model.adopt(block("block"));
  model.prepareNow();
  HeldTool held({6, 6, 8.5});
  model.startTouch(held.device, held.setup);
  model.beginLeave();
  EXPECT_FALSE(model.touching());
  EXPECT_THROW(model.startTouch(held.device, held.setup), core::InvalidParameter);
  model.notOpened(); // the case stays
  stroke(model);
  model.beginLeave();
  model.close();
  model.adopt(block("other"));
  stroke(model);
}

// Two that are compared must both be salted, or neither.
// While files are read for the case, structures are made in it and replaced.
TEST_F(WorkstationModelTest, PartsComeBesideWhatWasMadeMeanwhile)
{
  library::Library library(folder);
  WorkstationModel model{library};
  scene::Case value = block("block");
  value.labels.push_back(ballOf(value.ct.geometry, "first"));
  value.labels.push_back(ballOf(value.ct.geometry, "second"));
  value.labels[0].provenance.isFrameAssumed = true;
  model.adopt(std::move(value));
  const auto mapOf = [](const std::string& name, const core::GridGeometry& grid)
  {
    volume::LabelMap map = *ballOf(grid, name).labels.get();
    map.segments.front().name = name;
    return map;
  };
  const core::GridGeometry grid = model.value().ct.geometry;

  const scene::Case before = model.value();
  scene::Case with = before;
  with.mr.push_back(block("mr").ct);
  with.mr[0].name = "t2";
  with.labels[1].drawnOn = "";
  with.labels[1].notes.push_back("moved");
  with.labels.push_back(ballOf(grid, "tumour"));
  with.labels.back().drawnOn = "t2";
  with.labels.push_back(ballOf(grid, "nerve"));
  model.addStructure(mapOf("first", grid), "first"); // now behind "second"
  model.addStructure(mapOf("tumour", grid));
  model.addStructure(mapOf("t2", grid));
  model.takeParts(before, std::move(with));

  std::map<std::string, std::optional<std::string>> drawnOn;
  for (const scene::LabelPart& part : model.value().labels)
    for (const scene::StructurePart& structure : part.structures)
      drawnOn[structure.name] = part.drawnOn;
  ASSERT_EQ(model.value().mr.size(), 1U);
  EXPECT_EQ(model.value().mr[0].name, "t2 2");
  ASSERT_EQ(drawnOn.size(), 6U);
  EXPECT_EQ(drawnOn.count("tumour"), 1U);
  EXPECT_EQ(drawnOn.count("nerve"), 1U);
  EXPECT_EQ(drawnOn.at("tumour 2"), "t2 2");
  EXPECT_EQ(drawnOn.at("second"), "") << "settled to the CT";
  for (const scene::LabelPart& part : model.value().labels)
    EXPECT_EQ(part.notes, part.structures[0].name == "second" ? std::vector<std::string>{"moved"}
                                                              : std::vector<std::string>{});
  EXPECT_NE(drawnOn.at("first"), "t2 2");
  for (const scene::LabelPart& part : model.value().labels)
    EXPECT_EQ(part.provenance.isFrameAssumed, part.structures[0].name == "first")
        << "also of the one that replaced it";
}

TEST_F(WorkstationModelTest, TheOpenCaseHasTheFramesOfReferenceThatWereSaved)
{
  library::Library library(folder);
  WorkstationModel model{library};
  scene::Case value = block("block");
  value.ct.frameOfReference = std::string(64, 'a');
  model.adopt(value);
  model.save();
  EXPECT_TRUE(model.value().ct.isFrameSalted);
  EXPECT_EQ(model.value().ct.frameOfReference, library.open("block").ct.frameOfReference);
  const scene::Case before = model.value();
  scene::Case with = before;
  with.mr.push_back(block("mr").ct);
  with.mr[0].name = "mr";
  with.mr[0].frameOfReference = std::string(64, 'a');
  model.takeParts(before, with);
  model.save();
  EXPECT_EQ(model.value().mr[0].frameOfReference, model.value().ct.frameOfReference);
}

TEST_F(WorkstationModelTest, EachCaseThatIsShownIsAnotherOne)
{
  WorkstationModel model{library::Library(folder)};
  model.adopt(block("block"));
  const auto first = model.shownAs();
  model.save();
  model.saveAs("another name");
  EXPECT_EQ(model.shownAs(), first);
  model.open("block");
  EXPECT_NE(model.shownAs(), first);
}

TEST_F(WorkstationModelTest, ThicknessThatIsShownMeanwhileStays)
{
  WorkstationModel model{library::Library(folder)};
  scene::Case value = block("block");
  value.labels.push_back(ballOf(value.ct.geometry, "tumour"));
  model.adopt(value);
  model.prepareNow();
  auto late = model.preparation()({});
  model.showThickness("tumour");
  EXPECT_TRUE(model.prepared(std::move(late)));
  EXPECT_EQ(model.thicknessOver(), "tumour");
  EXPECT_TRUE(model.sceneContents().thickness.distance);
}

TEST_F(WorkstationModelTest, AnMrThatMovedAStructureHasThatPreparedAgain)
{
  WorkstationModel model{library::Library(folder)};
  scene::Case value = block("block");
  value.mr.push_back(block("mr").ct);
  value.mr[0].name = "mr";
  value.mr[0].registered = true;
  value.labels.push_back(ballOf(value.ct.geometry, "tumour"));
  value.labels[0].drawnOn = "mr";
  model.adopt(value);
  model.prepareNow();
  int wanted = 0;
  model.events.preparationWanted = [&wanted] { ++wanted; };
  const core::RigidTransform moved(Eigen::Quaterniond::Identity(), {1, 0, 0});
  model.changeMr([&](scene::Case& open) { scene::applyRegistration(open, "mr", moved, {}); });
  EXPECT_EQ(wanted, 1);
  EXPECT_TRUE(model.preparationHelps());
  EXPECT_TRUE(model.ready()) << "whoever asks waits for it";
  model.prepareNow();
  EXPECT_FALSE(model.preparationHelps());
}

namespace
{

// A box of voxels [first, last] on the block's grid.
volume::LabelMap boxLabels(const std::string& name, int first, int last)
{
  const core::GridGeometry grid({40, 40, 40}, Vector3d::Constant(0.3), Vector3d::Zero());
  auto voxels = std::make_shared<volume::Volume<std::uint16_t>>(grid, std::uint16_t{0});
  for (int k = first; k <= last; ++k)
    for (int j = first; j <= last; ++j)
      for (int i = first; i <= last; ++i)
        voxels->at(i, j, k) = 1;
  return volume::makeLabelMap(voxels, {{name, 1, {}, 0}});
}

} // namespace

TEST_F(WorkstationModelTest, AStructureMadeHereIsOneOfTheCaseAndComesBackFromTheDisk)
{
  const library::Library library(folder);
  WorkstationModel model{library};
  model.adopt(block("block"));
  int parts = 0;
  model.events.partsChanged = [&parts] { ++parts; };
  model.addStructure(boxLabels("facial nerve", 4, 7));
  EXPECT_EQ(parts, 1);
  EXPECT_TRUE(model.unsaved());
  const auto* made = scene::findStructure(model.value(), "facial nerve");
  ASSERT_TRUE(made);
  EXPECT_EQ(made->voxels, 64U);
  EXPECT_NEAR(made->volume, 64 * 0.027, 1e-9);
  EXPECT_EQ(made->look.preset, "nerve");
  EXPECT_THROW(model.addStructure(boxLabels("facial nerve", 9, 9)), core::InvalidParameter);
  EXPECT_THROW(model.addStructure(boxLabels("", 9, 9)), core::InvalidParameter);
  EXPECT_THROW(model.addStructure(boxLabels("nothing", 1, 0)), core::InvalidParameter);
  EXPECT_EQ(parts, 1) << "what is refused changes nothing";
  EXPECT_EQ(model.value().labels.size(), 1U);
  model.save();
  const scene::Case saved = library.open("block");
  ASSERT_EQ(saved.labels.size(), 1U);
  EXPECT_EQ(saved.labels.front().labels.get()->voxels->at(7, 4, 5), 1);
  EXPECT_EQ(saved.labels.front().labels.get()->voxels->at(8, 4, 5), 0);
}

TEST_F(WorkstationModelTest, AStructureIsReplacedTakenOutAndPutBackAsItWas)
{
  WorkstationModel model{library::Library(folder)};
  model.adopt(block("block"));
  model.addStructure(boxLabels("dura", 4, 7));
  model.addStructure(boxLabels("tumour", 20, 22));
  auto look = scene::findStructure(model.value(), "dura")->look;
  look.opacity = 0.25F;
  model.setLook("dura", look);
  const auto before = model.addStructure(boxLabels("dura", 4, 8), "dura");
  ASSERT_TRUE(before);
  EXPECT_EQ(scene::findStructure(model.value(), "dura")->voxels, 125U);
  EXPECT_EQ(scene::findStructure(model.value(), "dura")->look.opacity, 0.25F);
  EXPECT_TRUE(scene::findStructure(model.value(), "tumour"));
  EXPECT_THROW(model.putStructure(*before), core::InvalidParameter);
  ASSERT_TRUE(model.takeStructure("dura"));
  EXPECT_FALSE(scene::findStructure(model.value(), "dura"));
  EXPECT_FALSE(model.takeStructure("dura"));
  model.putStructure(*before);
  EXPECT_EQ(scene::findStructure(model.value(), "dura")->voxels, 64U);
  EXPECT_THROW(model.addStructure(boxLabels("tumour", 1, 2), "dura"), core::InvalidParameter);
  EXPECT_TRUE(scene::findStructure(model.value(), "dura")) << "refused: nothing is removed either";
}

TEST_F(WorkstationModelTest, AStructureReplacedDuringASaveIsStoredByTheNextOne)
{
  const library::Library library(folder);
  WorkstationModel model{library};
  model.adopt(block("block"));
  model.addStructure(boxLabels("incus", 2, 3));
  model.addStructure(boxLabels("dura", 4, 7));
  StoreTask task = model.beginStore();
  model.takeStructure("incus");
  model.addStructure(boxLabels("dura", 4, 8), "dura");
  task.run();
  model.stored(task);
  EXPECT_TRUE(model.unsaved());
  model.save();
  const scene::Case saved = library.open("block");
  EXPECT_FALSE(scene::findStructure(saved, "incus"));
  ASSERT_EQ(saved.labels.size(), 1U);
  EXPECT_EQ(saved.labels.front().labels.get()->voxels->at(8, 8, 8), 1);
}

namespace
{

// A map with structures 1 to 3, each a voxel more than the one before, at `place`.
scene::LabelPart threeStructures(const core::GridGeometry& grid, const std::string& prefix,
                                 int place)
{
  auto voxels = std::make_shared<volume::Volume<std::uint16_t>>(grid, std::uint16_t{0});
  for (int n = 1; n <= 3; ++n)
    for (int i = 0; i < n; ++i)
      voxels->at(i, n, place) = static_cast<std::uint16_t>(n);
  auto map = std::make_shared<const volume::LabelMap>(volume::makeLabelMap(voxels, {}));
  scene::LabelPart part;
  for (std::uint16_t n = 1; n <= 3; ++n)
  {
    scene::StructurePart structure;
    structure.name = prefix + std::to_string(n);
    structure.index = n;
    structure.voxels = n;
    part.structures.push_back(structure);
  }
  part.drawnOn = "";
  part.labels = map;
  return part;
}

std::vector<std::string> namesIn(const scene::Case& value)
{
  return scene::partNames(value);
}

} // namespace

TEST_F(WorkstationModelTest, WhatIsRemovedComesBackToItsPlace)
{
  library::Library library(folder);
  scene::Case value = block("block");
  for (const char* prefix : {"a", "b"})
    value.labels.push_back(
        threeStructures(value.ct.geometry, prefix, 30 + static_cast<int>(value.labels.size())));
  scene::ImagePart mr = value.ct;
  mr.name = "T2";
  value.mr = {mr, mr};
  value.mr[1].name = "T1";
  value.labels[1].structures[0].look.sourceImage = "T2";
  WorkstationModel model{library};
  model.adopt(std::move(value));
  model.prepareNow();
  model.save();
  const auto before = namesIn(model.value());
  const std::vector<std::string> steps{"a2", "T2", "b1", "a1", "a3"}; // the last empties its map
  for (const std::string& name : steps)
  {
    model.removePart(name);
    EXPECT_EQ(model.removedPart(), name);
    model.prepareNow();
  }
  EXPECT_EQ(namesIn(model.value()), (std::vector<std::string>{"ct", "T1", "b2", "b3"}));
  model.save();
  EXPECT_EQ(namesIn(library.open("block")), namesIn(model.value()));
  EXPECT_THROW(model.removePart("nothing"), core::InvalidParameter);
  EXPECT_EQ(model.removedPart(), "a3");
  for (std::size_t n = 0; n < steps.size(); ++n)
    model.restorePart();
  EXPECT_EQ(model.removedPart(), "");
  EXPECT_EQ(namesIn(model.value()), before);
  EXPECT_EQ(model.value().labels.size(), 2u);
  EXPECT_EQ(model.value().labels[1].structures[0].look.sourceImage, "T2");
  model.prepareNow();
  model.save();
  const auto again = library.open("block");
  EXPECT_EQ(namesIn(again), before);
  for (const auto& part : again.labels)
    for (std::size_t n = 0; n < 3; ++n)
      EXPECT_EQ(part.labels.get()->segments[n].voxels, n + 1);
  // Each in its own map: voxels are not exchanged.
  EXPECT_EQ(again.labels[0].labels.get()->voxels->at(0, 1, 30), 1);
  EXPECT_EQ(again.labels[1].labels.get()->voxels->at(0, 1, 31), 1);
  model.close();
  EXPECT_EQ(model.removedPart(), "");
}

// As older cases may have it.
TEST_F(WorkstationModelTest, AStructureWithTheNameOfAnMrComesBackWithoutASecondMr)
{
  scene::Case value = block("block");
  value.labels.push_back(threeStructures(value.ct.geometry, "a", 30));
  value.labels[0].drawnOn = "";
  scene::ImagePart mr = value.ct;
  mr.name = "a2";
  value.mr = {mr};
  library::Library library(folder);
  WorkstationModel model{library};
  model.adopt(std::move(value));
  model.prepareNow();
  model.removePart("a2");
  EXPECT_EQ(namesIn(model.value()), (std::vector<std::string>{"ct", "a2", "a1", "a3"}));
  EXPECT_THROW(model.restorePart(), core::InvalidParameter) << "the MR has its name";
  model.renamePart("a2", "T2");
  model.restorePart();
  EXPECT_EQ(namesIn(model.value()), (std::vector<std::string>{"ct", "T2", "a1", "a2", "a3"}));
}

// The task knows the parts by their order.
TEST_F(WorkstationModelTest, AStructureRemovedDuringASaveExchangesNothing)
{
  library::Library library(folder);
  scene::Case value = block("block");
  for (const char* prefix : {"a", "b"})
  {
    value.labels.push_back(
        threeStructures(value.ct.geometry, prefix, 30 + static_cast<int>(value.labels.size())));
    value.labels.back().structures.resize(1);
  }
  WorkstationModel model{library};
  model.adopt(std::move(value));
  model.prepareNow();
  presenters::StoreTask task = model.beginStore();
  model.removePart("a1");
  task.run();
  model.stored(task);
  EXPECT_TRUE(model.unsaved());
  model.save();
  const auto one = library.open("block");
  ASSERT_EQ(one.labels.size(), 1u);
  EXPECT_EQ(one.labels[0].structures[0].name, "b1");
  EXPECT_EQ(one.labels[0].labels.get()->voxels->at(0, 1, 31), 1);
  task = model.beginStore();
  model.restorePart();
  task.run();
  model.stored(task);
  model.save();
  const auto both = library.open("block");
  ASSERT_EQ(both.labels.size(), 2u);
  EXPECT_EQ(both.labels[0].labels.get()->voxels->at(0, 1, 30), 1);
  EXPECT_EQ(both.labels[1].labels.get()->voxels->at(0, 1, 31), 1);
}

TEST_F(WorkstationModelTest, ANewNameHoldsWhereverThePartIsNamed)
{
  library::Library library(folder);
  scene::Case value = block("block");
  value.labels.push_back(threeStructures(value.ct.geometry, "a", 30));
  value.labels[0].drawnOn = "T2";
  scene::ImagePart mr = value.ct;
  mr.name = "T2";
  value.mr = {mr};
  value.boneLook.sourceImage = "T2";
  value.softTissue.sourceImage = "T2";
  WorkstationModel model{library};
  model.adopt(std::move(value));
  model.prepareNow();
  model.renamePart("T2", "T2 CISS");
  EXPECT_EQ(model.value().mr[0].name, "T2 CISS");
  EXPECT_EQ(model.value().labels[0].drawnOn, "T2 CISS");
  EXPECT_EQ(model.value().boneLook.sourceImage, "T2 CISS");
  EXPECT_EQ(model.value().softTissue.sourceImage, "T2 CISS");
  EXPECT_THROW(model.renamePart("a1", "a2"), core::InvalidParameter);
  EXPECT_THROW(model.renamePart("a1", "ct"), core::InvalidParameter);
  EXPECT_THROW(model.renamePart("ct", "scan"), core::InvalidParameter);
  EXPECT_THROW(model.removePart("T2 CISS"), core::Error) << "structures hang on it";
  EXPECT_EQ(namesIn(model.value()), (std::vector<std::string>{"ct", "T2 CISS", "a1", "a2", "a3"}));
  model.removePart("a1");
  model.renamePart("a2", "a1");
  EXPECT_THROW(model.restorePart(), core::InvalidParameter) << "its name is taken";
  model.renamePart("a1", "a4");
  model.restorePart();
  EXPECT_EQ(namesIn(model.value()), (std::vector<std::string>{"ct", "T2 CISS", "a1", "a4", "a3"}));
}

TEST_F(WorkstationModelTest, ANewNameOfAnMrHoldsForWhatWasTakenOut)
{
  library::Library library(folder);
  scene::Case value = block("block");
  value.labels.push_back(threeStructures(value.ct.geometry, "a", 30));
  value.labels[0].structures[1].look.sourceImage = "T2";
  scene::ImagePart mr = value.ct;
  mr.name = "T2";
  mr.registered = true;
  value.mr = {mr};
  mr.name = "DWI";
  mr.registration = scene::Registration();
  mr.registration->through = "T2";
  value.mr.push_back(mr);
  WorkstationModel model{library};
  model.adopt(std::move(value));
  model.prepareNow();
  model.removePart("a2");
  model.removePart("DWI");
  model.renamePart("T2", "T2 CISS");
  model.restorePart();
  model.restorePart();
  EXPECT_EQ(scene::findMr(model.value(), "DWI")->registration->through, "T2 CISS");
  EXPECT_EQ(scene::findStructure(model.value(), "a2")->look.sourceImage, "T2 CISS");
}

TEST_F(WorkstationModelTest, AnMrThatComesBackColorsWhatItColored)
{
  library::Library library(folder);
  scene::Case value = block("block");
  value.labels.push_back(threeStructures(value.ct.geometry, "a", 30));
  value.labels[0].structures[1].look.sourceImage = "T2";
  scene::ImagePart mr = value.ct;
  mr.name = "T2";
  value.mr = {mr};
  value.boneLook.sourceImage = "T2";
  value.softTissue.sourceImage = "T2";
  value.softTissue.relative = false;
  value.softTissue.transfer = appearance::TransferFunction(
      {{100.0, {0.2F, 0.2F, 0.2F}, 0.0F}, {900.0, {0.9F, 0.9F, 0.9F}, 0.1F}});
  const auto ofMr = value.softTissue;
  WorkstationModel model{library};
  model.adopt(std::move(value));
  model.prepareNow();
  model.removePart("T2");
  EXPECT_EQ(model.value().boneLook.sourceImage, "");
  EXPECT_TRUE(model.value().softTissue == appearance::softTissueLook());
  EXPECT_EQ(model.value().labels[0].structures[1].look.sourceImage, "");
  model.renamePart("a2", "facial nerve");
  model.restorePart();
  EXPECT_EQ(model.value().boneLook.sourceImage, "T2");
  EXPECT_TRUE(model.value().softTissue == ofMr);
  EXPECT_EQ(model.value().labels[0].structures[1].look.sourceImage, "T2");
  EXPECT_EQ(model.value().labels[0].structures[0].look.sourceImage, "");
}

// Its values are not those of what was edited since.
TEST_F(WorkstationModelTest, AnMrThatComesBackLeavesWhatWasEditedSince)
{
  const appearance::TransferFunction ofMr(
      {{100.0, {0.2F, 0.2F, 0.2F}, 0.0F}, {900.0, {0.9F, 0.9F, 0.9F}, 0.1F}});
  const appearance::TransferFunction ofCt(
      {{-150.0, {0.9F, 0.8F, 0.5F}, 0.0F}, {60.0, {0.6F, 0.2F, 0.2F}, 0.2F}});
  library::Library library(folder);
  scene::Case value = block("block");
  value.labels.push_back(threeStructures(value.ct.geometry, "a", 30));
  for (auto* look : {&value.softTissue, &value.labels[0].structures[0].look,
                     &value.labels[0].structures[1].look})
  {
    look->sourceImage = "T2";
    look->relative = false;
    look->transfer = ofMr;
  }
  scene::ImagePart mr = value.ct;
  mr.name = "T2";
  value.mr = {mr};
  WorkstationModel model{library};
  model.adopt(std::move(value));
  model.prepareNow();
  const auto lookOf = [&model](const std::string& part) { return *model.lookOf(part); };
  const auto edit = [&](const std::string& part, const auto& change)
  {
    auto look = lookOf(part);
    change(look);
    model.setLook(part, look);
  };
  const auto drawsCt = [&ofCt](appearance::StructureAppearance& look)
  {
    look.transfer = ofCt;
    look.relative = false;
  };
  model.removePart("T2");
  edit(scene::kSoftTissue, drawsCt);
  edit("a1", drawsCt);
  edit("a2", [](auto& look) { appearance::setColor(look, {0.1F, 0.9F, 0.1F}); });
  const auto softTissue = lookOf(scene::kSoftTissue);
  model.restorePart();
  ASSERT_TRUE(scene::findMr(model.value(), "T2"));
  EXPECT_TRUE(lookOf(scene::kSoftTissue) == softTissue);
  EXPECT_EQ(lookOf("a1").sourceImage, "");
  EXPECT_TRUE(lookOf("a1").transfer == ofCt);
  EXPECT_EQ(lookOf("a2").sourceImage, "T2") << "a colour has no values";
  EXPECT_EQ(lookOf("a2").color[1], 0.9F);
  model.undo();
  EXPECT_FALSE(scene::findMr(model.value(), "T2"));
  EXPECT_TRUE(lookOf(scene::kSoftTissue) == softTissue);
  EXPECT_EQ(lookOf("a2").sourceImage, "");

  // What is no function of values stays as edited, and the function comes back.
  for (int n = 0; n < 3; ++n)
    model.undo();
  edit(scene::kSoftTissue,
       [](auto& look)
       {
         look.shown = true;
         look.opacity = 0.5F;
       });
  model.restorePart();
  EXPECT_EQ(lookOf(scene::kSoftTissue).sourceImage, "T2");
  EXPECT_TRUE(lookOf(scene::kSoftTissue).transfer == ofMr);
  EXPECT_EQ(lookOf(scene::kSoftTissue).opacity, 0.5F);
  EXPECT_TRUE(lookOf(scene::kSoftTissue).shown);
  EXPECT_EQ(lookOf("a1").sourceImage, "T2");
  // Back to what was at first.
  for (int n = 0; n < 3; ++n)
    model.undo();
  EXPECT_FALSE(model.canUndo());
  for (const char* part : {scene::kSoftTissue, "a1", "a2"})
  {
    EXPECT_EQ(lookOf(part).sourceImage, "T2") << part;
    EXPECT_TRUE(lookOf(part).transfer == ofMr) << part;
  }
}

TEST_F(WorkstationModelTest, WhatWasDrilledKeepsItsName)
{
  library::Library library(folder);
  scene::Case value = block("block");
  auto part = threeStructures(value.ct.geometry, "a", 30);
  auto voxels =
      std::make_shared<volume::Volume<std::uint16_t>>(value.ct.geometry, std::uint16_t{1});
  part.labels = std::make_shared<const volume::LabelMap>(volume::makeLabelMap(voxels, {}));
  part.structures.resize(1);
  part.structures[0].look.drillable = true;
  value.labels.push_back(part);
  WorkstationModel model{library};
  model.adopt(std::move(value));
  model.prepareNow();
  stroke(model);
  ASSERT_FALSE(model.value().dissection.strokes()[0]->info.structures.empty());
  try
  {
    model.renamePart("a1", "nerve");
    FAIL() << "the record of what was removed would be lost";
  }
  catch (const core::Error& error)
  {
    EXPECT_EQ(error.fault(), core::Fault::Refused);
  }
  EXPECT_EQ(namesIn(model.value()), (std::vector<std::string>{"ct", "a1"}));
}

namespace
{

scene::ViewState::Clipping cutBy(const Vector3d& point, const Vector3d& normal)
{
  scene::ViewState::Clipping clipping;
  clipping.planes.push_back({point, normal.normalized()});
  return clipping;
}

scene::ViewState::Clipping boxed(const core::IndexBox& box)
{
  scene::ViewState::Clipping clipping;
  clipping.crop = box;
  return clipping;
}

interaction::PickRay downAt(double x)
{
  return {{x, 6.0, 30.0}, {0.0, 0.0, -1.0}};
}

} // namespace

// The bone's surface is the plane z = 5.85 mm: between 1500 HU at 5.7 and -900 HU at 6.0 mm it
// passes 300 HU there.
TEST_F(WorkstationModelTest, AClickMeansWhatTheCutLeaves)
{
  constexpr double kSurface = 5.85;
  WorkstationModel model{library::Library(folder)};
  model.adopt(block("block"));
  model.prepareNow();
  const auto heightAt = [&model](double x) -> std::optional<double>
  {
    const auto hit = model.surfaceAt(downAt(x));
    return hit ? std::optional(hit->z()) : std::nullopt;
  };
  ASSERT_TRUE(heightAt(6.0));
  EXPECT_NEAR(*heightAt(6.0), kSurface, 1e-3);
  EXPECT_FALSE(model.isCutAway(downAt(6.0)));
  EXPECT_FALSE(model.isCutAway(downAt(50.0))) << "nothing is there, cut or not";

  model.setClipping(cutBy({6.0, 6.0, 3.0}, {1.0, 0.0, -1.0})); // what lies below z = x - 3 stays
  ASSERT_TRUE(heightAt(6.0) && heightAt(7.0) && heightAt(11.0));
  EXPECT_NEAR(*heightAt(6.0), 3.0, 1e-6) << "the cut face";
  EXPECT_NEAR(*heightAt(7.0), 4.0, 1e-6);
  EXPECT_NEAR(*heightAt(11.0), kSurface, 1e-3) << "the plane passes above the bone";
  EXPECT_FALSE(heightAt(2.0)) << "the bone is above it, all of it";
  EXPECT_TRUE(model.isCutAway(downAt(2.0)));
  EXPECT_FALSE(model.isCutAway(downAt(6.0)));
  // A tool meets what is there, cut away or not.
  ASSERT_TRUE(model.tissueAlong(downAt(2.0)));
  EXPECT_NEAR(*model.tissueAlong(downAt(2.0)), 30.0 - kSurface, 1e-3);
  EXPECT_NEAR(*model.tissueAlong(downAt(6.0)), 30.0 - kSurface, 1e-3);

  model.setClipping(cutBy({0.0, 0.0, 7.0}, Vector3d::UnitZ())); // only air stays
  EXPECT_FALSE(heightAt(6.0));
  EXPECT_TRUE(model.isCutAway(downAt(6.0)));
  model.setClipping(cutBy({0.0, 0.0, 2.0}, Vector3d::UnitZ()));
  const auto below = model.surfaceAt({{6.0, 6.0, -20.0}, Vector3d::UnitZ()});
  ASSERT_TRUE(below);
  EXPECT_NEAR(below->z(), 2.0, 1e-6) << "the face from the other side";

  // Faces of a box lie at voxel centres, every 0.3 mm.
  model.setClipping(boxed({{0, 0, 0}, {40, 40, 11}}));
  ASSERT_TRUE(heightAt(6.0));
  EXPECT_NEAR(*heightAt(6.0), 3.0, 1e-6);
  model.setClipping(boxed({{10, 0, 0}, {30, 40, 40}})); // x from 3.0 to 8.7 mm
  ASSERT_TRUE(heightAt(6.0));
  EXPECT_NEAR(*heightAt(6.0), kSurface, 1e-3);
  EXPECT_FALSE(heightAt(2.9));
  EXPECT_TRUE(heightAt(3.1));
  EXPECT_TRUE(heightAt(8.6));
  EXPECT_FALSE(heightAt(8.8));
  EXPECT_TRUE(model.isCutAway(downAt(2.9)));

  model.setClipping({});
  ASSERT_TRUE(heightAt(2.9));
  EXPECT_NEAR(*heightAt(2.9), kSurface, 1e-3);
}

// What was drilled below a cut face is a hole in it.
TEST_F(WorkstationModelTest, AClickIntoWhatWasDrilledMeansItsFloor)
{
  WorkstationModel model{library::Library(folder)};
  model.adopt(block("block"));
  model.prepareNow();
  stroke(model);
  const auto floor = model.surfaceAt(line());
  ASSERT_TRUE(floor);
  ASSERT_LT(floor->z(), 5.78);
  const double face = 0.5 * (floor->z() + 5.85); // across the hole
  model.setClipping(cutBy({0.0, 0.0, face}, -Vector3d::UnitZ()));
  ASSERT_TRUE(model.surfaceAt(line()));
  EXPECT_NEAR(model.surfaceAt(line())->z(), floor->z(), 1e-3);
  ASSERT_TRUE(model.surfaceAt(downAt(1.0)));
  EXPECT_NEAR(model.surfaceAt(downAt(1.0))->z(), face, 1e-6) << "beside the hole the face is bone";
}

// A section shows soft tissue opaque, where that is drawn: what is behind it is not seen.
TEST_F(WorkstationModelTest, AClickOnACutThroughSoftTissueMeansTheFace)
{
  scene::Case value = block("block");
  auto ct = std::make_shared<volume::Volume<std::int16_t>>(value.ct.geometry);
  for (int k = 0; k < 40; ++k)
    for (int j = 0; j < 40; ++j)
      for (int i = 0; i < 40; ++i)
        ct->at(i, j, k) = k < 20   ? std::int16_t{1500}
                          : i < 20 ? std::int16_t{50}
                                   : std::int16_t{-900};
  value.ct.volume = std::make_shared<const volume::IntensityVolume>(
      std::shared_ptr<const volume::Volume<std::int16_t>>(ct));
  value.softTissue.relative = false;
  value.softTissue.transfer = appearance::TransferFunction(
      {{-200.0, {0.8F, 0.5F, 0.4F}, 0.3F}, {250.0, {0.8F, 0.5F, 0.4F}, 0.3F}});
  value.softTissue.opacity = 1.0F;
  value.softTissue.shown = true;
  WorkstationModel model{library::Library(folder)};
  model.adopt(value);
  model.prepareNow();
  const auto heightAt = [&model](double x)
  {
    const auto hit = model.surfaceAt(downAt(x));
    return hit ? hit->z() : -1.0;
  };
  EXPECT_LT(heightAt(2.0), 6.0) << "uncut it is translucent, and the bone in it counts";
  model.setClipping(cutBy({0.0, 0.0, 9.0}, -Vector3d::UnitZ()));
  EXPECT_NEAR(heightAt(2.0), 9.0, 1e-6);
  EXPECT_LT(heightAt(10.0), 6.0) << "of air there is no face";
  model.setClipping(cutBy({0.0, 0.0, 3.0}, -Vector3d::UnitZ()));
  EXPECT_NEAR(heightAt(2.0), 3.0, 1e-6) << "of bone";
  model.setClipping(cutBy({0.0, 0.0, 20.0}, -Vector3d::UnitZ()));
  EXPECT_LT(heightAt(2.0), 6.0) << "the image's own face is none";

  value.softTissue.shown = false;
  model.adopt(value);
  model.prepareNow();
  model.setClipping(cutBy({0.0, 0.0, 9.0}, -Vector3d::UnitZ()));
  EXPECT_LT(heightAt(2.0), 6.0);
}
