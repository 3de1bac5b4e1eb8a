#include <random>

#include <gtest/gtest.h>

#include "LabelPainting.h"
#include "petrous/Volume/SmoothedUnion.h"

using namespace petrous;
using namespace petrous::testing;
using Eigen::Matrix3d;
using Eigen::Vector3d;

namespace
{
constexpr double kThreshold = 0.5 - 1e-3;
} // namespace

TEST(LabelField, GivesAnOverlapToTheFirstSource)
{
  const auto grid = cube(20, 0.5);
  const Labels a = paintBox(grid, {{4, 4, 4}, {12, 12, 12}});
  const Labels b = paintBox(grid, {{8, 8, 8}, {16, 16, 16}});
  const Vector3d both = grid.patientFromVoxel({10, 10, 10});
  const Vector3d onlyB = grid.patientFromVoxel({14, 14, 14});
  const auto ab = volume::makeLabelField({{a, 1, 1, true}, {b, 1, 2, true}});
  const auto ba = volume::makeLabelField({{b, 1, 2, true}, {a, 1, 1, true}});
  EXPECT_EQ(indexAt(*ab, both), 1);
  EXPECT_EQ(indexAt(*ab, onlyB), 2);
  EXPECT_EQ(indexAt(*ba, both), 2);
  EXPECT_DOUBLE_EQ(occupancyAt(*ab, both), 1.0);
}

TEST(LabelField, NeverLetsALumenTakeAVoxelFromASolid)
{
  const auto grid = cube(24, 0.5);
  const Labels solid = paintBox(grid, {{4, 4, 4}, {12, 12, 12}});
  const Labels lumen = paintBox(grid, {{8, 4, 4}, {20, 12, 12}});
  const auto field = volume::makeLabelField({{lumen, 1, 7, false}, {solid, 1, 3, true}});
  EXPECT_TRUE(field->hasSolid);
  EXPECT_TRUE(field->hasLumen);
  EXPECT_EQ(indexAt(*field, grid.patientFromVoxel({11, 8, 8})), 3);
  EXPECT_EQ(indexAt(*field, grid.patientFromVoxel({15, 8, 8})), 7);
  EXPECT_DOUBLE_EQ(occupancyAt(*field, grid.patientFromVoxel({15, 8, 8})), 0.0) << "no tissue";
}

TEST(LabelField, GrowsSolidsByTwoVoxelsAndLumensByOne)
{
  const auto grid = cube(20, 0.5);
  const Labels box = paintBox(grid, {{8, 8, 8}, {12, 12, 12}});
  const auto along = [&](bool solid, double i)
  {
    return indexAt(*volume::makeLabelField({{box, 1, 9, solid}}),
                   grid.patientFromVoxel({i, 10, 10}));
  };
  EXPECT_EQ(along(true, 13), 9);
  EXPECT_EQ(along(true, 14), 0) << "12 and 13 are two beyond 11";
  EXPECT_EQ(along(false, 12), 9);
  EXPECT_EQ(along(false, 13), 0);
}

TEST(LabelField, HasTheSmoothedUnionOfASingleMap)
{
  std::mt19937 random(5);
  const auto grid = cube(40, 0.3, {1, 2, 3}, turned());
  // Blobs and single voxels, some at the border.
  const Labels map = paint(grid,
                           [&](const Vector3d& p) -> std::uint16_t
                           {
                             const double wave =
                                 std::sin(2 * p[0]) + std::sin(3 * p[1]) + std::sin(2.5 * p[2]);
                             return wave > 1.0 ? 2 : random() % 97 == 0 ? 1 : 0;
                           });
  const auto field = volume::makeLabelField({{map, 1, 1, true}, {map, 2, 2, true}});
  const auto expected = volume::makeSmoothedUnion(*map, [](std::uint16_t) { return true; });
  ASSERT_TRUE(core::sameGrid(field->occupancy->geometry(), expected->geometry()));
  for (std::size_t i = 0; i < expected->size(); ++i)
  {
    const float occupancy = field->occupancy->data()[i];
    ASSERT_NEAR(occupancy, expected->data()[i], 0.5 / 65535 + 1e-7);
    ASSERT_NEAR(occupancy * 65535.0, std::round(occupancy * 65535.0), 0.01);
  }
}

TEST(LabelField, HasASolidsIndexWhereverItsOccupancyIsInside)
{
  std::mt19937 random(11);
  const auto blobs = [](double phase, double level)
  {
    return [phase, level](const Vector3d& p) -> std::uint16_t
    {
      const double wave =
          std::sin(1.9 * p[0] + phase) + std::sin(2.3 * p[1]) + std::sin(1.7 * p[2]);
      return wave > level ? 1 : wave < -level ? 2 : 0;
    };
  };
  const Labels one = paint(cube(30, 0.3), blobs(0.0, 0.2));
  const Labels two = paint(cube(24, 0.4, {0.1, 0.3, -0.2}, turned()), blobs(1.0, 0.9));
  const Labels noise = paint(cube(30, 0.3), [&](const Vector3d&) { return random() % 9 == 0; });
  const volume::LabelSource solid{one, 1, 1, true};
  const volume::LabelSource lumen{one, 2, 128, false};
  const volume::LabelSource solidTwo{two, 1, 2, true};
  const volume::LabelSource lumenTwo{two, 2, 129, false};
  const volume::LabelSource dust{noise, 1, 3, true};
  for (const auto& sources : {std::vector<volume::LabelSource>{solid, lumen},
                              std::vector<volume::LabelSource>{lumen, dust},
                              std::vector<volume::LabelSource>{lumenTwo, solid, lumen, solidTwo}})
  {
    const auto field = volume::makeLabelField(sources);
    const core::Index3 dims = field->occupancy->geometry().dims();
    std::uniform_real_distribution<double> uniform(0.0, 1.0);
    for (int n = 0; n < 400000; ++n)
    {
      const Vector3d voxel(uniform(random) * (dims[0] - 1), uniform(random) * (dims[1] - 1),
                           uniform(random) * (dims[2] - 1));
      const Vector3d p = field->occupancy->geometry().patientFromVoxel(voxel);
      if (occupancyAt(*field, p) <= kThreshold)
        continue;
      const int index = indexAt(*field, p);
      ASSERT_GT(index, 0);
      ASSERT_LT(index, 128) << "a lumen where there is tissue";
    }
  }
}

TEST(LabelField, Holds255Materials)
{
  const auto grid = cube(64, 0.5);
  auto voxels = std::make_shared<volume::Volume<std::uint16_t>>(grid, std::uint16_t{0});
  const auto place = [](int n) {
    return core::Index3{4 + 8 * (n % 7), 4 + 8 * (n / 7 % 7), 4 + 8 * (n / 49)};
  };
  for (int n = 0; n < 255; ++n)
    voxels->at(place(n)[0], place(n)[1], place(n)[2]) = static_cast<std::uint16_t>(1000 + n);
  const auto map = std::make_shared<volume::LabelMap>(volume::makeLabelMap(std::move(voxels), {}));
  std::vector<volume::LabelSource> sources;
  for (int n = 0; n < 255; ++n)
    sources.push_back(
        {map, static_cast<std::uint16_t>(1000 + n), static_cast<std::uint8_t>(n + 1), n % 2 == 0});
  const auto field = volume::makeLabelField(sources);
  for (int n = 0; n < 255; ++n)
  {
    const core::Index3 at = place(n);
    EXPECT_EQ(indexAt(*field, grid.patientFromVoxel({1.0 * at[0], 1.0 * at[1], 1.0 * at[2]})),
              n + 1);
  }
}

TEST(LabelField, IsNothingWithoutAVoxel)
{
  EXPECT_EQ(volume::makeLabelField({}), nullptr);
  const Labels map = paintBox(cube(8, 1.0), {{2, 2, 2}, {4, 4, 4}});
  EXPECT_EQ(volume::makeLabelField({{map, 77, 1, true}}), nullptr);
}

TEST(LabelField, NamesTheSourceThatIsWrong)
{
  const Labels map = paintBox(cube(8, 1.0), {{2, 2, 2}, {4, 4, 4}});
  const auto refused = [&](const volume::LabelSource& source)
  {
    try
    {
      volume::makeLabelField({{map, 1, 1, true}, source});
    }
    catch (const core::InvalidParameter& error)
    {
      return std::string(error.what()).find("source 2") != std::string::npos;
    }
    return false;
  };
  EXPECT_TRUE(refused({nullptr, 1, 1, true}));
  EXPECT_TRUE(refused({std::make_shared<volume::LabelMap>(), 1, 1, true}));
  EXPECT_TRUE(refused({map, 1, 0, true}));
  EXPECT_TRUE(refused({map, 0, 1, true}));
}

TEST(LabelField, StopsWhenItIsCancelled)
{
  const Labels map = paintBox(cube(40, 1.0), {{2, 2, 2}, {34, 34, 34}});
  const Labels other = paintBox(cube(40, 0.7), {{2, 2, 2}, {34, 34, 34}});
  for (const double when : {0.0, 0.3, 0.5, 0.8})
  {
    const auto token = std::make_shared<core::CancelToken>();
    const core::Progress progress(
        [&](double fraction, const std::string&)
        {
          if (fraction >= when)
            token->cancel();
        },
        token);
    EXPECT_THROW(volume::makeLabelField({{map, 1, 1, true}, {other, 1, 2, true}}, progress),
                 core::CancelledError)
        << when;
  }
}
