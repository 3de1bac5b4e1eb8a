#include "OccupancyGrid.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "RandomScenes.h"
#include "petrous/Volume/TissueField.h"

using namespace petrous;
using namespace petrous::rendering::testing;
using core::Index3;
using core::IndexBox;
using Eigen::Vector3d;
using rendering::OccupancyGrid;
using Texel = OccupancyGrid::Texel;

namespace
{

constexpr double kIso = 300.0;
constexpr int kAirSeen = OccupancyGrid::Inside | OccupancyGrid::Border;

const Texel& texelAt(const OccupancyGrid& grid, int i, int j, int k)
{
  const Index3& d = grid.dims();
  return grid.texels()[static_cast<std::size_t>(i + d[0] * (j + d[1] * k))];
}

const Texel& texelOf(const OccupancyGrid& grid, const Vector3d& voxel)
{
  Index3 brick;
  for (std::size_t a = 0; a < 3; ++a)
    brick[a] = std::min(static_cast<int>(voxel[static_cast<Eigen::Index>(a)]) / grid.edge(),
                        grid.dims()[a] - 1);
  return texelAt(grid, brick[0], brick[1], brick[2]);
}

bool same(const std::vector<Texel>& a, const std::vector<Texel>& b)
{
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](const Texel& x, const Texel& y)
                    {
                      return x.toTissue == y.toTissue && x.toInside == y.toInside &&
                             x.toSoft == y.toSoft && x.flags == y.flags;
                    });
}

// Everything found by sampling at random points must be flagged by its brick.
void expectNothingMissed(const OccupancyGrid& grid, const OccupancyGrid::Rules& rules,
                         const std::shared_ptr<const volume::IntensityVolume>& ct,
                         const volume::LabelField* labels,
                         const std::shared_ptr<const volume::CutMask>& mask, Random& random)
{
  // If bone is not part of f, an image without tissue replaces it.
  const auto bone = rules.bone ? ct
                               : image(std::make_shared<volume::Volume<float>>(
                                     ct->geometry(), static_cast<float>(rules.iso - 1e6)));
  std::vector<volume::TissueField::SolidUnion> solids;
  if (labels)
    solids.push_back(labels->occupancy);
  const volume::TissueField field(bone, solids, mask, {rules.iso, 1000.0});
  const core::GridGeometry& geometry = ct->geometry();
  int missed = 0;
  const auto check = [&](const Vector3d& voxel)
  {
    const Vector3d patient = geometry.patientFromVoxel(voxel);
    const Texel& texel = texelOf(grid, voxel);
    const double f = field.value(patient);
    const auto announced = [&](bool met, OccupancyGrid::Flag flag)
    { missed += met && !(texel.flags & flag); };
    announced(f > 0.0, OccupancyGrid::Tissue);
    announced(f <= 0.0, OccupancyGrid::Inside);
    announced(f <= 0.0, OccupancyGrid::Border);
    announced(mask && mask->sample(voxel) < 1.0, OccupancyGrid::Mixed);
    const double value = ct->sample(voxel);
    for (const volume::ValueRange& range : rules.opaque)
      announced(value >= range.min && value <= range.max, OccupancyGrid::Inside);
    for (const volume::ValueRange& range : rules.softOpaque)
      announced(value >= range.min && value <= range.max, OccupancyGrid::Soft);
    announced(rules.soft && (f > 0.0 || (mask && mask->sample(voxel) <= 0.5)), OccupancyGrid::Soft);
    if (!labels)
      return;
    const Vector3d there = labels->occupancy->geometry().voxelFromPatient(patient);
    if (!labels->occupancy->geometry().hullContains(there))
      return;
    const double occupancy = volume::sampleTrilinear(*labels->occupancy, there);
    announced(occupancy > 0.5 - 1e-3, OccupancyGrid::Labels);
    announced(occupancy > 0.5, OccupancyGrid::Inside);
    announced(occupancy > 0.5, OccupancyGrid::Border);
  };
  const auto anywhere = [&]
  {
    Vector3d voxel;
    for (int a = 0; a < 3; ++a)
      voxel[a] = between(random, 0.0, geometry.dims()[static_cast<std::size_t>(a)] - 1.0);
    return voxel;
  };
  for (int n = 0; n < 20000; ++n)
    check(anywhere());
  for (int n = 0; n < 200; ++n)
  {
    const Vector3d from = anywhere();
    const Vector3d step = (anywhere() - from) / 100.0;
    for (int s = 0; s <= 100; ++s)
      check(from + s * step);
  }
  EXPECT_EQ(missed, 0) << "at random places";
  if (!labels)
    return;
  // Labels are few and small: sample around each of their voxels too.
  const core::GridGeometry& labelGrid = labels->occupancy->geometry();
  forEach(labelGrid.fullBox(),
          [&](int i, int j, int k)
          {
            if (labels->occupancy->at(i, j, k) > 0.0F)
              for (int n = 0; n < 200; ++n)
              {
                const Vector3d there(i + between(random, -1.0, 1.0), j + between(random, -1.0, 1.0),
                                     k + between(random, -1.0, 1.0));
                const Vector3d voxel = geometry.voxelFromPatient(labelGrid.patientFromVoxel(there));
                if (geometry.hullContains(voxel))
                  check(voxel);
              }
          });
  EXPECT_EQ(missed, 0) << "around labels";
}

struct Shape
{
  Index3 dims;
  int edge;
};

} // namespace

class OccupancyGridShapes : public ::testing::TestWithParam<Shape>
{
};

TEST_P(OccupancyGridShapes, MissesNothingThatARayCanMeet)
{
  Random random(7);
  const auto [dims, edge] = GetParam();
  const core::GridGeometry grid = obliqueGrid(dims);
  auto voxels = blobs<float>(grid, random, 12);
  for (int n = 0; n < 4; ++n)
    voxels->data()[below(random, static_cast<int>(voxels->size()))] =
        n % 2 ? std::numeric_limits<float>::quiet_NaN() : std::numeric_limits<float>::infinity();
  const auto ct = image(voxels);
  auto mask = std::make_shared<volume::CutMask>(grid);
  for (int n = 0; n < 6; ++n)
    brush(*mask, {below(random, dims[0]), below(random, dims[1]), below(random, dims[2])},
          between(random, 1.0, 8.0), false);

  const Vector3d half = 0.5 * Vector3d(dims[0], dims[1], dims[2]).cwiseProduct(grid.spacing());
  const Eigen::Matrix3d turn =
      Eigen::AngleAxisd(1.1, Vector3d(3, 1, 1).normalized()).toRotationMatrix();
  const std::vector<core::GridGeometry> labelGrids = {
      grid,
      {{40, 30, 20}, {0.11, 0.17, 0.1}, grid.center() - 0.3 * half, grid.direction()},
      {{25, 25, 25}, {0.2, 0.7, 0.3}, grid.center() - Vector3d(2, 3, 4), turn},
      {{9, 1, 8}, {2.0, 1.0, 3.0}, grid.origin() - Vector3d(3, 0, 2), turn}};
  for (const core::GridGeometry& labelGrid : labelGrids)
    for (const bool bone : {true, false})
    {
      const volume::LabelField labels = sparseLabels(labelGrid, random);
      OccupancyGrid::Rules rules;
      rules.bone = bone;
      rules.opaque = {{-50.0, -20.0}, {1500.0, 1700.0}};
      rules.soft = bone;
      if (rules.soft)
        rules.softOpaque = {{-200.0, -180.0}, {100.0, 110.0}};
      OccupancyGrid occupancy(*ct, edge);
      occupancy.rebuild(rules, &labels, mask.get());
      expectNothingMissed(occupancy, rules, ct, &labels, mask, random);
    }
  OccupancyGrid occupancy(*ct, edge);
  expectNothingMissed(occupancy, {}, ct, nullptr, nullptr, random);
}

TEST_P(OccupancyGridShapes, FlagsNoBrickThatHoldsNothing)
{
  Random random(11);
  const auto [dims, edge] = GetParam();
  const core::GridGeometry grid({dims}, {0.4, 0.4, 1.0}, {1, 2, 3});
  const auto ct = image(blobs<std::int16_t>(grid, random, 10));
  volume::CutMask mask(grid);
  for (int n = 0; n < 5; ++n)
    brush(mask, {below(random, dims[0]), below(random, dims[1]), below(random, dims[2])},
          between(random, 1.0, 12.0), false);
  const volume::LabelField labels = sparseLabels(grid, random);
  OccupancyGrid occupancy(*ct, edge);
  OccupancyGrid::Rules rules;
  rules.opaque = {{1500.0, 1700.0}};
  rules.soft = true;
  rules.softOpaque = {{-200.0, -100.0}};
  occupancy.rebuild(rules, &labels, &mask);

  int wrong = 0;
  forEach({{0, 0, 0}, occupancy.dims()},
          [&](int i, int j, int k)
          {
            const int e = occupancy.edge();
            const IndexBox reach = IndexBox{
                {i * e, j * e, k * e},
                {i * e + e + 1, j * e + e + 1,
                 k * e + e + 1}}.intersected(grid.fullBox());
            double low = 1e9, high = -1e9;
            int least = 65535, most = 0;
            bool solid = false;
            forEach(reach,
                    [&](int x, int y, int z)
                    {
                      low = std::min(low, ct->at(x, y, z));
                      high = std::max(high, ct->at(x, y, z));
                      least = std::min<int>(least, mask.at(x, y, z));
                      most = std::max<int>(most, mask.at(x, y, z));
                      solid = solid || labels.occupancy->at(x, y, z) > 0.5F - 1e-3F;
                    });
            unsigned expected = least < 65535 ? OccupancyGrid::Mixed : 0;
            expected |= solid ? OccupancyGrid::Labels : 0;
            expected |= (high > kIso || solid) && most >= 32768 ? OccupancyGrid::Tissue : 0;
            if (low <= kIso || least < 32768 || solid)
              expected |= OccupancyGrid::Border | OccupancyGrid::Inside;
            if (low <= 1700.0 && high >= 1500.0)
              expected |= OccupancyGrid::Inside;
            if ((expected & (OccupancyGrid::Tissue | OccupancyGrid::Mixed)) != 0 ||
                (low <= -100.0 && high >= -200.0))
              expected |= OccupancyGrid::Soft;
            wrong += texelAt(occupancy, i, j, k).flags != expected;
          });
  EXPECT_EQ(wrong, 0);
}

TEST_P(OccupancyGridShapes, IsAfterEveryCutAndUndoAsAfterARebuild)
{
  Random random(5);
  const auto [dims, edge] = GetParam();
  const core::GridGeometry grid(dims, {0.4, 0.4, 1.0}, {1, 2, 3});
  const auto ct = image(blobs<std::int16_t>(grid, random, 5));
  const volume::LabelField labels = sparseLabels(grid, random);
  OccupancyGrid::Rules rules;
  rules.soft = true;
  rules.softOpaque = {{-200.0, -100.0}};
  OccupancyGrid updated(*ct, edge);
  OccupancyGrid rebuilt(*ct, edge);
  volume::CutMask mask(grid);
  std::vector<volume::CutMask> history{mask};
  updated.rebuild(rules, &labels, &mask);
  const std::vector<Texel> untouched = updated.texels();
  for (int n = 0; n < 60; ++n)
  {
    const auto before = updated.texels();
    IndexBox touched;
    if (n % 10 == 9)
    {
      mask = history.front(); // changes bricks anywhere
      history = {mask};
      touched = grid.fullBox();
    }
    else
      touched =
          brush(mask, {below(random, dims[0]), below(random, dims[1]), below(random, dims[2])},
                between(random, 0.5, 14.0), n % 4 == 3);
    const IndexBox changed = updated.maskChanged(&mask, touched);
    rebuilt.rebuild(rules, &labels, &mask);
    ASSERT_TRUE(same(updated.texels(), rebuilt.texels())) << n;

    IndexBox differing;
    forEach({{0, 0, 0}, updated.dims()},
            [&](int i, int j, int k)
            {
              const auto at =
                  static_cast<std::size_t>(&texelAt(updated, i, j, k) - updated.texels().data());
              if (!same({before[at]}, {updated.texels()[at]}))
                differing = differing.united({{i, j, k}, {i + 1, j + 1, k + 1}});
            });
    ASSERT_TRUE(changed == differing || (changed.empty() && differing.empty())) << n;
  }
  EXPECT_TRUE(same(updated.texels(), untouched));
}

INSTANTIATE_TEST_SUITE_P(Any, OccupancyGridShapes,
                         ::testing::Values(Shape{{70, 50, 41}, 4}, Shape{{65, 49, 33}, 8},
                                           Shape{{130, 97, 150}, 8}, Shape{{90, 33, 47}, 16},
                                           Shape{{1, 60, 40}, 4}, Shape{{50, 2, 33}, 8},
                                           Shape{{120, 61, 1}, 4}, Shape{{1, 1, 1}, 8}));

TEST(OccupancyGrid, AnUndoBringsTissueNearAgain)
{
  const core::GridGeometry grid({161, 9, 9}, Vector3d::Ones(), Vector3d::Zero());
  auto voxels = std::make_shared<volume::Volume<std::int16_t>>(grid, std::int16_t{-1000});
  voxels->at(4, 4, 4) = 2000;
  const auto ct = image(voxels);
  OccupancyGrid occupancy(*ct, 8);
  volume::CutMask mask(grid);
  EXPECT_EQ(texelAt(occupancy, 0, 0, 0).toTissue, 0);
  EXPECT_EQ(texelAt(occupancy, 7, 0, 0).toTissue, 7);
  EXPECT_EQ(texelAt(occupancy, 19, 0, 0).toTissue, OccupancyGrid::kLargestDistance);

  const IndexBox cut = brush(mask, {4, 4, 4}, 8.0, false);
  occupancy.maskChanged(&mask, cut);
  EXPECT_EQ(texelAt(occupancy, 0, 0, 0).toTissue, OccupancyGrid::kLargestDistance);
  EXPECT_EQ(texelAt(occupancy, 7, 0, 0).toTissue, OccupancyGrid::kLargestDistance);

  const IndexBox changed = occupancy.maskChanged(nullptr, cut);
  EXPECT_EQ(texelAt(occupancy, 0, 0, 0).toTissue, 0);
  EXPECT_EQ(texelAt(occupancy, 7, 0, 0).toTissue, 7);
  EXPECT_EQ(changed, (IndexBox{{0, 0, 0}, {15, 1, 1}}));
}

TEST(OccupancyGrid, TellsUniformBoneFromWhatIsWorthALook)
{
  const core::GridGeometry grid({33, 33, 33}, Vector3d::Ones(), Vector3d::Zero());
  const auto ct = image(std::make_shared<volume::Volume<std::int16_t>>(grid, std::int16_t{1000}));
  OccupancyGrid occupancy(*ct, 8);
  const auto flags = [&](const OccupancyGrid::Rules& wanted)
  {
    occupancy.rebuild(wanted, nullptr, nullptr);
    return int{texelAt(occupancy, 2, 2, 2).flags};
  };
  OccupancyGrid::Rules rules;
  EXPECT_EQ(flags(rules), OccupancyGrid::Tissue);
  rules.opaque = {{0.0, 999.5}, {1000.5, 4000.0}};
  EXPECT_EQ(flags(rules), OccupancyGrid::Tissue);
  rules.opaque.push_back({1000.0, 1000.0});
  EXPECT_EQ(flags(rules), OccupancyGrid::Tissue | OccupancyGrid::Inside);
  rules = {};
  rules.interiorEverywhere = true;
  EXPECT_EQ(flags(rules), OccupancyGrid::Tissue | OccupancyGrid::Inside);
  rules = {};
  rules.iso = 1000.0; // f is 0, which is air
  EXPECT_EQ(flags(rules), kAirSeen);
  rules = {};
  rules.bone = false;
  EXPECT_EQ(flags(rules), kAirSeen);
}

TEST(OccupancyGrid, TakesTheMasksHalfValueForTissue)
{
  const core::GridGeometry grid({9, 9, 9}, Vector3d::Ones(), Vector3d::Zero());
  const auto ct = image(std::make_shared<volume::Volume<std::int16_t>>(grid, std::int16_t{1000}));
  OccupancyGrid occupancy(*ct, 8);
  volume::CutMask mask(grid);
  for (const int left : {32768, 32767})
  {
    auto brick = std::make_shared<volume::CutMask::Brick>();
    brick->fill(static_cast<std::uint16_t>(left));
    mask.setBrick(0, brick);
    occupancy.rebuild({}, nullptr, &mask);
    EXPECT_EQ(occupancy.texels()[0].flags,
              OccupancyGrid::Mixed | (left == 32768 ? int{OccupancyGrid::Tissue} : kAirSeen));
  }
}

TEST(OccupancyGrid, SeesAShareThatCarriesIntoTheNextBrick)
{
  // Between 0.48 at 7.85 and 1 at 8.85 the occupancy exceeds 0.5 from 7.89 on, inside brick 0.
  const core::GridGeometry grid({17, 17, 17}, Vector3d::Ones(), Vector3d::Zero());
  const auto ct = image(std::make_shared<volume::Volume<std::int16_t>>(grid, std::int16_t{0}));
  for (int axis = 0; axis < 3; ++axis)
  {
    Vector3d origin(12.0, 12.0, 12.0);
    origin[axis] = 7.85;
    Index3 dims{1, 1, 1};
    dims[static_cast<std::size_t>(axis)] = 2;
    auto inside = std::make_shared<volume::Volume<float>>(
        core::GridGeometry(dims, Vector3d::Ones(), origin), 1.0F);
    inside->data()[0] = 0.48F;
    volume::LabelField labels;
    labels.occupancy = inside;
    OccupancyGrid occupancy(*ct, 8);
    occupancy.rebuild({}, &labels, nullptr);
    Vector3d point(12.0, 12.0, 12.0);
    point[axis] = 7.95;
    EXPECT_TRUE(texelOf(occupancy, point).flags & OccupancyGrid::Tissue) << axis;
  }
}

TEST(OccupancyGrid, ReadsNewLabelsAndKeepsKnownOnes)
{
  const core::GridGeometry grid({65, 65, 65}, Vector3d::Ones(), Vector3d::Zero());
  const auto ct = image(std::make_shared<volume::Volume<std::int16_t>>(grid, std::int16_t{0}));
  OccupancyGrid occupancy(*ct, 8);
  const auto oneVoxel = [&](int at)
  {
    auto inside = std::make_shared<volume::Volume<float>>(grid, 0.0F);
    inside->at(at, at, at) = 0.8F;
    volume::LabelField labels;
    labels.occupancy = inside;
    return labels;
  };
  const auto flagged = [&](int brick)
  { return (texelAt(occupancy, brick, brick, brick).flags & OccupancyGrid::Tissue) != 0; };
  const auto first = oneVoxel(4);
  const auto second = oneVoxel(20);
  occupancy.rebuild({}, &first, nullptr);
  EXPECT_TRUE(flagged(0) && !flagged(2));
  occupancy.rebuild({}, &second, nullptr);
  EXPECT_TRUE(!flagged(0) && flagged(2));
  occupancy.rebuild({}, &second, nullptr);
  EXPECT_TRUE(!flagged(0) && flagged(2));
  occupancy.rebuild({}, nullptr, nullptr);
  EXPECT_TRUE(!flagged(0) && !flagged(2));
}

TEST(OccupancyGrid, RefusesABrickThatIsNoPowerOfTwo)
{
  const auto ct =
      image(std::make_shared<volume::Volume<std::int16_t>>(core::GridGeometry(), std::int16_t{0}));
  EXPECT_THROW(OccupancyGrid(*ct, 5), core::InvalidParameter);
}
