#include <gtest/gtest.h>

#include "DrilledCase.h"
#include "MaskComparison.h"
#include "petrous/Scene/Branches.h"
#include "petrous/Scene/Manifest.h"

using namespace petrous;
using scene::test::drill;
using scene::test::drilledCase;

namespace
{

void expectTogether(const scene::Case& value)
{
  const dissection::Dissection& work = value.dissection;
  ASSERT_TRUE(work.loaded());
  ASSERT_EQ(work.history().size(), work.strokes().size());
  const dissection::Dissection again(value.ct.geometry, work.strokes(), work.history());
  EXPECT_EQ(volume::differentVoxels(work.mask(), again.mask()), 0u);
}

} // namespace

TEST(Branches, ANewStrokeKeepsTheUndoneInTheList)
{
  scene::Case value = drilledCase(3);
  value.dissection.undo(2);
  drill(value, {4, 4, 8}, 5.0);
  expectTogether(value);
  EXPECT_EQ(value.dissection.strokes().size(), 4u);
  EXPECT_DOUBLE_EQ(value.removedVolume(), 15.0);
  scene::goToBranch(value, "main~1");
  expectTogether(value);
  EXPECT_DOUBLE_EQ(value.removedVolume(), 33.0);
}

TEST(Branches, BeginWhereOneIsOrAfterSoManyStrokes)
{
  scene::Case value = drilledCase(3);
  value.dissection.undo();
  scene::startBranch(value, "here");
  EXPECT_EQ(value.applied(), 2u);
  EXPECT_EQ(value.dissection.history().ahead(), 0u);
  scene::goToBranch(value, "main");
  EXPECT_EQ(value.dissection.history().ahead(), 1u);
  scene::startBranch(value, "all", 3);
  EXPECT_EQ(value.applied(), 3u);
  scene::startBranch(value, "none", 0);
  EXPECT_TRUE(value.dissection.mask().untouched());
  expectTogether(value);
  EXPECT_THROW(scene::startBranch(value, "x", 1), core::InvalidParameter);
  EXPECT_THROW(scene::startBranch(value, "all"), core::InvalidParameter);
  EXPECT_THROW(scene::startBranch(value, "-x"), core::InvalidParameter);
  EXPECT_THROW(scene::startBranch(value, "\xff"), core::InvalidParameter);
  expectTogether(value);
}

TEST(Branches, GoToAnyStateOfAnyBranch)
{
  scene::Case value = drilledCase(3); // 10, 11, 12 mm3
  scene::startBranch(value, "other", 1);
  drill(value, {4, 4, 8}, 5.0);
  scene::goToState(value, "main", 1);
  EXPECT_EQ(value.dissection.history().branch().name, "main");
  EXPECT_DOUBLE_EQ(value.removedVolume(), 21.0);
  EXPECT_EQ(value.dissection.history().ahead(), 1u);
  expectTogether(value);
  scene::goToState(value, "main", dissection::History::kStart);
  EXPECT_TRUE(value.dissection.mask().untouched());
  scene::goToState(value, "other", 3);
  EXPECT_DOUBLE_EQ(value.removedVolume(), 15.0);
  expectTogether(value);
  EXPECT_THROW(scene::goToState(value, "other", 2), core::InvalidParameter) << "it is not on it";
  EXPECT_THROW(scene::goToState(value, "none", 0), core::InvalidParameter);
  EXPECT_DOUBLE_EQ(value.removedVolume(), 15.0);
  const dissection::Dissection there = scene::dissectionAt(value, 2);
  scene::goToState(value, "main", 2);
  EXPECT_EQ(volume::differentVoxels(value.dissection.mask(), there.mask()), 0u);
}

TEST(Branches, ThatWereTakenOutComeBackToTheirPlace)
{
  scene::Case value = drilledCase(2);
  scene::startBranch(value, "other", 1);
  drill(value, {4, 4, 8}, 5.0);
  scene::goToBranch(value, "main");
  value.view.branches["other"].camera.emplace();
  value.view.branches["other"].camera->position = {1, 2, 3};
  EXPECT_THROW(scene::takeBranch(value, "main"), core::InvalidParameter) << "the present one";
  scene::TakenBranch taken = scene::takeBranch(value, "other");
  EXPECT_FALSE(value.dissection.history().find("other"));
  EXPECT_EQ(value.dissection.strokes().size(), 3u);
  EXPECT_EQ(value.view.branches.count("other"), 0u);
  drill(value, {4, 8, 4}, 7.0);
  // Stored and read, what no branch leads to is still there.
  const scene::Case read = scene::fromManifest(scene::toManifest(value), "m");
  EXPECT_EQ(read.dissection.strokes().size(), 4u);
  EXPECT_EQ(scene::putBranch(value, taken), "other");
  EXPECT_EQ(value.view.branches.at("other").camera->position, Eigen::Vector3d(1, 2, 3));
  EXPECT_EQ(value.dissection.history().branch().name, "main");
  EXPECT_DOUBLE_EQ(value.removedVolume(), 28.0);
  scene::goToBranch(value, "other");
  EXPECT_DOUBLE_EQ(value.removedVolume(), 15.0);
  expectTogether(value);
  scene::goToBranch(value, "main");
  taken = scene::takeBranch(value, "other");
  scene::startBranch(value, "other");
  EXPECT_EQ(scene::putBranch(value, taken), "other 2") << "its name was given away";
}

TEST(Branches, NeedNoVoxels)
{
  scene::Case value = drilledCase(3);
  value.dissection.unload();
  scene::startBranch(value, "other", 1);
  EXPECT_DOUBLE_EQ(value.removedVolume(), 10.0);
  scene::renameBranch(value, "other", "antrum first");
  EXPECT_EQ(value.dissection.history().branch().name, "antrum first");
}

TEST(Branches, RemovalTakesWhatNothingElseLeadsTo)
{
  scene::Case value = drilledCase(2);
  scene::startBranch(value, "other", 1);
  drill(value, {4, 4, 8}, 7.0);
  scene::goToBranch(value, "main");
  drill(value, {7, 4, 8}, 3.0);
  EXPECT_EQ(scene::removeBranch(value, "other"), 1u);
  expectTogether(value);
  EXPECT_DOUBLE_EQ(value.removedVolume(), 24.0);
  EXPECT_EQ(value.dissection.undo(9), 3u);
  EXPECT_TRUE(value.dissection.mask().untouched());
}

TEST(Branches, TellWhatEachTook)
{
  scene::Case value = drilledCase(2);
  dissection::Dissection& work = value.dissection;
  dissection::Stroke a = *work.strokes()[0];
  dissection::Stroke b = *work.strokes()[1];
  a.info.structures = {{"nerve", 0.25}, {"sinus", 1.0}};
  b.info.structures = {{"nerve", 0.5}};
  work = dissection::Dissection({std::make_shared<const dissection::Stroke>(a),
                                 std::make_shared<const dissection::Stroke>(b)},
                                work.history());
  const auto both = scene::summaryOf(value, 1);
  EXPECT_EQ(both.strokes, 2u);
  EXPECT_DOUBLE_EQ(both.removed, 21.0);
  ASSERT_EQ(both.structures.size(), 2u);
  EXPECT_EQ(both.structures[0].name, "nerve");
  EXPECT_DOUBLE_EQ(both.structures[0].volume, 0.75);
  EXPECT_TRUE(scene::summaryOf(value, dissection::History::kStart).structures.empty());
}

TEST(Branches, AreShownAsTheyWereLeft)
{
  const auto from = [](double x)
  {
    core::CameraPose camera;
    camera.position = {x, 1.0 / 3.0, -7.0};
    return camera;
  };
  const auto x = [](const scene::Case& value) { return value.camera->position.x(); };
  scene::Case value = drilledCase(2);
  value.camera = from(1.0);
  scene::startBranch(value, "second", 1);
  EXPECT_EQ(x(value), 1.0) << "the view stays";
  value.camera = from(2.0);
  scene::goToBranch(value, "second");
  EXPECT_EQ(x(value), 2.0) << "it is there already";
  scene::goToBranch(value, "main");
  EXPECT_EQ(x(value), 1.0);
  value.camera = from(3.0);

  // Also after a save, and under another name.
  value.dissection.unload();
  scene::Case back = scene::fromManifest(scene::toManifest(value), "m.json");
  EXPECT_EQ(scene::toManifest(back), scene::toManifest(value));
  scene::renameBranch(back, "second", "zweiter Zugang ü");
  scene::goToBranch(back, "zweiter Zugang ü");
  EXPECT_EQ(x(back), 2.0);
  EXPECT_EQ(back.camera->position.y(), 1.0 / 3.0);
  scene::goToBranch(back, "main");
  EXPECT_EQ(x(back), 3.0);

  scene::removeBranch(back, "zweiter Zugang ü");
  EXPECT_TRUE(back.view.branches.empty());
}

TEST(Branches, KeepTheirSlicesAndWhatIsCutAway)
{
  using Slices = scene::ViewState::Slices;
  scene::Case value = drilledCase(2);
  scene::startBranch(value, "second", 1);
  value.view.slices = Slices{{1.0, 2.0, 3.0}, 400.0, 40.0};
  value.view.slices->planes.emplace();
  value.view.slices->planes->front().zoom = 7.0 / 3.0;
  value.view.slices->overlay = Slices::Overlay{"T2", "blend", 0.5};
  value.view.clipping.crop = core::IndexBox{{1, 1, 1}, {5, 6, 7}};
  value.view.clipping.planes = {{{1.0, 2.0, 3.0}, {0.0, 0.6, 0.8}}};
  const scene::ViewState second = value.view;

  // main was left with nothing cut away, without slices: those stay.
  scene::goToBranch(value, "main");
  EXPECT_TRUE(value.view.clipping.empty());
  EXPECT_TRUE(*value.view.slices == *second.slices);
  value.view.slices->crosshair = {9.0, 9.0, 9.0};
  value.view.slices->overlay->opacity = 0.25;
  value.view.clipping.crop = core::IndexBox{{0, 0, 0}, {2, 2, 2}};

  // Also after a save, and under another name. The MR over the slices is the case's.
  value.dissection.unload();
  scene::Case back = scene::fromManifest(scene::toManifest(value), "m.json");
  scene::renameBranch(back, "second", "deep");
  scene::goToBranch(back, "deep");
  EXPECT_TRUE(back.view.clipping == second.clipping);
  EXPECT_EQ(back.view.slices->crosshair, second.slices->crosshair);
  EXPECT_EQ(back.view.slices->planes->front().zoom, 7.0 / 3.0);
  ASSERT_TRUE(back.view.slices->overlay);
  EXPECT_EQ(back.view.slices->overlay->opacity, 0.25);
  EXPECT_EQ(back.view.branches.count("deep"), 0u) << "it is the present one";
  scene::goToBranch(back, "main");
  EXPECT_EQ(back.view.slices->crosshair, Eigen::Vector3d(9.0, 9.0, 9.0));
  EXPECT_EQ(back.view.clipping.crop, (core::IndexBox{{0, 0, 0}, {2, 2, 2}}));
  EXPECT_TRUE(back.view.clipping.planes.empty());
}

// As older programs left it: what else is seen stays.
TEST(Branches, OfWhichTheCameraAloneIsKnownChangeNothingElse)
{
  scene::Case value = drilledCase(2);
  scene::startBranch(value, "second", 1);
  value.view.branches["main"] = {core::CameraPose{}, std::nullopt, std::nullopt};
  value.view.branches["main"].camera->viewAngle = 17.0;
  value.view.clipping.crop = core::IndexBox{{1, 1, 1}, {5, 6, 7}};
  scene::Case back = scene::fromManifest(scene::toManifest(value), "m.json");
  EXPECT_FALSE(back.view.branches.at("main").clipping);
  scene::goToBranch(back, "main");
  EXPECT_EQ(back.camera->viewAngle, 17.0);
  EXPECT_EQ(back.view.clipping.crop, (core::IndexBox{{1, 1, 1}, {5, 6, 7}}));
}

// A branch that nobody left: as its last stroke was drilled.
TEST(Branches, WithoutAViewAreShownFromThatOfTheirLastStroke)
{
  scene::Case value = drilledCase(2);
  std::vector<std::shared_ptr<const dissection::Stroke>> strokes;
  for (const auto& stroke : value.dissection.strokes())
  {
    dissection::Stroke seen = *stroke;
    seen.info.camera = core::CameraPose{};
    seen.info.camera->viewAngle = 20.0 + static_cast<double>(strokes.size());
    strokes.push_back(std::make_shared<const dissection::Stroke>(seen));
  }
  dissection::History history = value.dissection.history();
  history.start("first", 0);
  value.dissection = dissection::Dissection(strokes, history);
  scene::goToBranch(value, "main");
  ASSERT_TRUE(value.camera);
  EXPECT_EQ(value.camera->viewAngle, 21.0);
  scene::goToBranch(value, "first");
  EXPECT_EQ(value.camera->viewAngle, 20.0);
}
