#include "petrous/Presenters/ApproachComparison.h"

#include <cmath>

#include <gtest/gtest.h>

#include "petrous/Scene/Branches.h"

using namespace petrous;
using namespace petrous::presenters;
using Eigen::Vector3d;

namespace
{

constexpr double kPi = 3.14159265358979323846;
constexpr double kSpacing = 0.25; // mm
constexpr double kRadius = 3.0;   // mm, of both burrs
const Vector3d kFirst(6.1, 8.0, 8.0);
const Vector3d kSecond(9.6, 8.05, 8.0);
const Vector3d kNerve(8.0, 8.0, 2.0);
constexpr double kNerveRadius = 1.5;

// A block of bone, 16 mm wide, with a ball-shaped nerve; two approaches, each of one ball.
scene::Case twoApproaches()
{
  const core::GridGeometry grid({65, 65, 65}, Vector3d::Constant(kSpacing), Vector3d::Zero());
  auto labels = std::make_shared<volume::Volume<std::uint16_t>>(grid, std::uint16_t{0});
  for (int k = 0; k < 65; ++k)
    for (int j = 0; j < 65; ++j)
      for (int i = 0; i < 65; ++i)
        labels->at(i, j, k) =
            (grid.patientFromVoxel({1.0 * i, 1.0 * j, 1.0 * k}) - kNerve).norm() < kNerveRadius;
  scene::Case value;
  value.ct.geometry = grid;
  value.ct.volume = std::make_shared<const volume::IntensityVolume>(
      std::make_shared<const volume::Volume<std::int16_t>>(grid, std::int16_t{1200}));
  scene::LabelPart part;
  part.labels = std::make_shared<const volume::LabelMap>(volume::makeLabelMap(labels, {}));
  scene::StructurePart nerve;
  nerve.name = "nerve";
  nerve.index = 1;
  part.structures = {nerve};
  value.labels = {part};
  value.dissection = dissection::Dissection(grid);
  const auto drill = [&value](const Vector3d& at, double seconds)
  {
    dissection::StrokeInfo info;
    info.duration = seconds;
    value.dissection.beginStroke(info);
    value.dissection.cut({at, at, kRadius});
    value.dissection.endStroke();
  };
  drill(kFirst, 12.0);
  scene::startBranch(value, "second", 0);
  drill(kSecond, 7.0);
  return value;
}

double ball(double radius)
{
  return 4.0 / 3.0 * kPi * radius * radius * radius;
}

// Of two balls of one radius whose centres are `d` apart.
double lens(double radius, double d)
{
  return kPi / 12.0 * (4.0 * radius + d) * (2.0 * radius - d) * (2.0 * radius - d);
}

} // namespace

TEST(ApproachComparison, VolumesAreThoseOfTwoBallsAndTheirLens)
{
  const scene::Case value = twoApproaches();
  const auto comparison = compareApproaches(value, "main", "second");
  const auto& [a, b] = comparison.sides;
  const double common = lens(kRadius, (kFirst - kSecond).norm());
  EXPECT_NEAR(a.removed / ball(kRadius), 1.0, 0.01);
  EXPECT_NEAR(b.removed / ball(kRadius), 1.0, 0.01);
  EXPECT_NEAR(comparison.both / common, 1.0, 0.03);
  EXPECT_NEAR(a.only / (ball(kRadius) - common), 1.0, 0.02);
  EXPECT_NEAR(b.only / (ball(kRadius) - common), 1.0, 0.02);
  EXPECT_EQ(a.name, "main");
  EXPECT_EQ(a.strokes, 1u);
  EXPECT_EQ(b.strokes, 1u);
  EXPECT_EQ(comparison.commonStrokes, 0u);
  EXPECT_DOUBLE_EQ(a.drilling, 12.0);
  EXPECT_DOUBLE_EQ(b.drilling, 7.0);
  // The surfaces enclose the same volumes.
  const auto enclosed = [&comparison](Difference difference)
  {
    const auto& surface = comparison.surfaces[static_cast<std::size_t>(difference) - 1];
    return surface ? surface->signedVolume() : 0.0;
  };
  EXPECT_NEAR(enclosed(Difference::OnlyFirst) / (ball(kRadius) - common), 1.0, 0.05);
  EXPECT_NEAR(enclosed(Difference::OnlySecond) / (ball(kRadius) - common), 1.0, 0.05);
  EXPECT_NEAR(enclosed(Difference::Both) / common, 1.0, 0.05);
}

TEST(ApproachComparison, VoxelsAreColouredByTheBallsTheyAreIn)
{
  const scene::Case value = twoApproaches();
  const auto comparison =
      std::make_shared<const ApproachComparison>(compareApproaches(value, "main", "second"));
  const auto layer = differenceLayer(comparison);
  ASSERT_EQ(layer->colors.size(), 4u);
  const core::GridGeometry& grid = value.ct.geometry;
  std::array<int, 4> wanted{}, found{};
  for (int k = 0; k < 65; ++k)
    for (int j = 0; j < 65; ++j)
      for (int i = 0; i < 65; ++i)
      {
        const Vector3d at = grid.patientFromVoxel({1.0 * i, 1.0 * j, 1.0 * k});
        const double first = (at - kFirst).norm() - kRadius;
        const double second = (at - kSecond).norm() - kRadius;
        if (std::min(std::abs(first), std::abs(second)) < 0.6 * kSpacing)
          continue; // the mask is rounded to voxels there
        const int index = (first < 0.0 ? 1 : 0) + (second < 0.0 ? 2 : 0);
        ++wanted[static_cast<std::size_t>(index)];
        const std::uint16_t shown = layer->indexAt({i, j, k});
        EXPECT_EQ(shown, index) << at.transpose();
        ++found[shown];
      }
  EXPECT_EQ(found, wanted);
  EXPECT_GT(wanted[1], 1000);
  EXPECT_GT(wanted[2], 1000);
  EXPECT_GT(wanted[3], 200);
}

TEST(ApproachComparison, DistancesAreFromTheWallsToTheSurface)
{
  scene::Case value = twoApproaches();
  const auto apart = [](const Vector3d& burr)
  { return (burr - kNerve).norm() - kRadius - kNerveRadius; };
  const auto comparison = compareApproaches(value, "main", "second");
  constexpr double kWithin = 0.2 * kSpacing + 0.03; // of the voxels' surface, and of the walls
  EXPECT_NEAR(comparison.sides[0].distances.at("nerve"), apart(kFirst), kWithin);
  EXPECT_NEAR(comparison.sides[1].distances.at("nerve"), apart(kSecond), kWithin);
  // Half a voxel of the structure and half a voxel of the wall.
  ASSERT_TRUE(comparison.uncertainties.at("nerve"));
  EXPECT_NEAR(*comparison.uncertainties.at("nerve"), std::sqrt(0.5) * kSpacing, 1e-12);
  EXPECT_TRUE(comparison.sides[0].exposed.empty());

  // Drawn on an MR of which nobody knows how far off it is.
  scene::Case onMr = value;
  onMr.mr.emplace_back();
  onMr.mr.back().name = "T2";
  onMr.mr.back().registered = true;
  onMr.mr.back().registration.emplace();
  onMr.labels.front().drawnOn = "T2";
  const auto unknown = compareApproaches(onMr, "main", "second");
  EXPECT_EQ(unknown.sides[0].distances.count("nerve"), 1U);
  EXPECT_FALSE(unknown.uncertainties.at("nerve"));

  // A third one goes through the nerve; the first is undone.
  value.dissection.beginStroke({});
  value.dissection.cut({{8.0, 8.0, 4.0}, {8.0, 8.0, 4.0}, 1.5});
  value.dissection.endStroke();
  scene::goToState(value, "main", dissection::History::kStart);
  const auto after = compareApproaches(value, "main", "second");
  EXPECT_TRUE(after.sides[0].distances.empty()) << "nothing was removed";
  EXPECT_EQ(after.sides[0].strokes, 0u);
  EXPECT_EQ(after.sides[1].distances.at("nerve"), 0.0);
  EXPECT_GT(after.sides[1].exposed.at("nerve"), 0.5);
  EXPECT_EQ(after.both, 0.0);
  EXPECT_EQ(after.surfaces[0], nullptr);
  EXPECT_NE(after.surfaces[1], nullptr);
  EXPECT_THROW(compareApproaches(value, "main", "third"), core::InvalidParameter);
}
