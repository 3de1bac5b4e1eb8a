#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include <Eigen/Geometry>

#include "petrous/Presenters/PlaneSamples.h"
#include "petrous/Presenters/SlicePlanes.h"

using namespace petrous;
using namespace petrous::presenters;
using Eigen::Vector3d;

namespace
{

using Noise = volume::Volume<float>;

std::shared_ptr<const Noise> noise(const core::GridGeometry& grid)
{
  auto image = std::make_shared<Noise>(grid);
  std::mt19937 random(11);
  std::uniform_real_distribution<float> values(-1000.0F, 3000.0F);
  for (int k = 0; k < grid.dims()[2]; ++k)
    for (int j = 0; j < grid.dims()[1]; ++j)
      for (int i = 0; i < grid.dims()[0]; ++i)
        image->at(i, j, k) = values(random);
  return image;
}

// Trilinear, written out; NaN outside the hull of the voxel centres.
double trilinear(const Noise& image, const Vector3d& voxel)
{
  constexpr double kEdge = 1e-9;
  double sum = 0.0;
  const auto& dims = image.geometry().dims();
  for (Eigen::Index a = 0; a < 3; ++a)
    if (voxel[a] < -kEdge || voxel[a] > dims[static_cast<std::size_t>(a)] - 1 + kEdge)
      return std::numeric_limits<double>::quiet_NaN();
  const auto low = [&](Eigen::Index a)
  { return std::max(0, static_cast<int>(std::floor(voxel[a]))); };
  const auto high = [&](Eigen::Index a)
  { return std::min(dims[static_cast<std::size_t>(a)] - 1, low(a) + 1); };
  for (int k = low(2); k <= high(2); ++k)
    for (int j = low(1); j <= high(1); ++j)
      for (int i = low(0); i <= high(0); ++i)
        sum += std::max(0.0, 1.0 - std::abs(voxel[0] - i)) *
               std::max(0.0, 1.0 - std::abs(voxel[1] - j)) *
               std::max(0.0, 1.0 - std::abs(voxel[2] - k)) * double(image.at(i, j, k));
  return sum;
}

struct Projections
{
  double most = -std::numeric_limits<double>::infinity();
  double least = std::numeric_limits<double>::infinity();
  double mean = 0.0;
  bool isWhole = true; // no part of the ray outside
};

// Along a ray of `parts` steps; the mean by the trapezoidal rule.
Projections bruteForce(const Noise& image, const Vector3d& patient, const Vector3d& normal,
                       double thickness, int parts)
{
  Projections result;
  for (int n = 0; n <= parts; ++n)
  {
    const double offset = thickness * (double(n) / parts - 0.5);
    const double value =
        trilinear(image, image.geometry().voxelFromPatient(patient + offset * normal));
    if (std::isnan(value))
    {
      result.isWhole = false;
      continue;
    }
    result.most = std::max(result.most, value);
    result.least = std::min(result.least, value);
    result.mean += value * (n == 0 || n == parts ? 0.5 : 1.0) / parts;
  }
  return result;
}

PlaneSamples drawn(const std::shared_ptr<const Noise>& image, const SliceGeometry& slice,
                   Projection projection, double thickness)
{
  return sampleSlab(volume::IntensityVolume(image), slice, {thickness, projection});
}

Eigen::Matrix3d flipped() // left-handed, axes exchanged
{
  Eigen::Matrix3d direction;
  direction << 0, -1, 0, -1, 0, 0, 0, 0, -1;
  return direction;
}

void expectExact(const core::GridGeometry& grid, SliceOrientation orientation, double thickness)
{
  const auto image = noise(grid);
  const auto slice = SliceGeometry::fitting(orientation, grid,
                                            grid.center() + Vector3d(0.13, -0.21, 0.17), 15, 13);
  const PlaneSamples most = drawn(image, slice, Projection::Maximum, thickness);
  const PlaneSamples least = drawn(image, slice, Projection::Minimum, thickness);
  const PlaneSamples mean = drawn(image, slice, Projection::Mean, thickness);
  int whole = 0;
  for (int row = 0; row < 13; ++row)
    for (int column = 0; column < 15; ++column)
    {
      const Projections expected = bruteForce(*image, slice.patientFromPixel(column, row),
                                              slice.axes().next, thickness, 1500);
      if (!expected.isWhole)
        continue;
      ++whole;
      // The ray's steps are a 1500th of the slab: a peak between two of them is missed by that.
      EXPECT_NEAR(most.at(column, row), expected.most, 7.0) << column << ' ' << row;
      EXPECT_GE(most.at(column, row), expected.most - 1e-2);
      EXPECT_NEAR(least.at(column, row), expected.least, 7.0);
      EXPECT_LE(least.at(column, row), expected.least + 1e-2);
      EXPECT_NEAR(mean.at(column, row), expected.mean, 0.1);
    }
  EXPECT_GT(whole, 50);
}

} // namespace

TEST(Slab, AlongTheGridIsThatOfTheTrilinearField)
{
  const core::GridGeometry straight({12, 11, 13}, Vector3d(0.5, 0.6, 0.7), Vector3d(-3, 2, 7));
  const core::GridGeometry exchanged({12, 11, 13}, Vector3d(0.5, 0.6, 0.7), Vector3d(-3, 2, 7),
                                     flipped());
  for (const auto& grid : {straight, exchanged})
    for (const SliceOrientation slice :
         {SliceOrientation::Axial, SliceOrientation::Coronal, SliceOrientation::Sagittal})
    {
      SCOPED_TRACE(nameOf(slice));
      expectExact(grid, slice, 2.3);
      expectExact(grid, slice, 0.2); // between two voxels
    }
}

// What is seen at a pixel is the image at that depth.
TEST(Slab, ShowsWhatLiesAtTheDepthThatItStates)
{
  const core::GridGeometry grid({12, 11, 13}, Vector3d(0.5, 0.6, 0.7), Vector3d(-3, 2, 7));
  const auto image = noise(grid);
  constexpr double kThickness = 2.3;
  const auto expectShown = [&](const SliceGeometry& slice)
  {
    for (const Projection projection : {Projection::Maximum, Projection::Minimum})
    {
      const PlaneSamples shown = drawn(image, slice, projection, kThickness);
      int seen = 0;
      double farthest = 0.0;
      for (int row = 0; row < slice.height(); ++row)
        for (int column = 0; column < slice.width(); ++column)
        {
          if (std::isnan(shown.at(column, row)))
            continue;
          const double depth = shownDepth(volume::IntensityVolume(image), slice,
                                          {kThickness, projection}, {column, row});
          const Vector3d at = slice.patientFromPixel(column, row) + depth * slice.axes().next;
          EXPECT_NEAR(trilinear(*image, grid.voxelFromPatient(at)), shown.at(column, row), 0.02);
          EXPECT_LE(std::abs(depth), 0.5 * kThickness + 1e-9);
          farthest = std::max(farthest, std::abs(depth));
          ++seen;
        }
      EXPECT_GT(seen, 50);
      EXPECT_GT(farthest, 0.5);
    }
  };
  expectShown(SliceGeometry::fitting(SliceOrientation::Coronal, grid, grid.center(), 15, 13));
  const ObliquePlane plane = planeWithNormal({0.3, 0.7, -0.5});
  expectShown(SliceGeometry::fitting(plane.orientation, plane.axes, grid, grid.center(), 21, 17));
  const auto slice = SliceGeometry::fitting(SliceOrientation::Axial, grid, grid.center(), 9, 9);
  EXPECT_EQ(shownDepth(volume::IntensityVolume(image), slice, {2.3, Projection::Mean}, {4, 4}),
            0.0);
  EXPECT_EQ(shownDepth(volume::IntensityVolume(image), slice, {}, {4, 4}), 0.0);
  // Where all is alike, in the middle.
  auto flat = std::make_shared<Noise>(grid);
  std::fill_n(flat->data(), flat->size(), 100.0F);
  EXPECT_EQ(shownDepth(volume::IntensityVolume(std::shared_ptr<const Noise>(flat)), slice,
                       {2.3, Projection::Maximum}, {4, 4}),
            0.0);
}

// At its own nodes, another trilinear function gives the same; the nodes are close enough.
TEST(Slab, ObliqueIsTheProjectionOfItsNodes)
{
  const core::GridGeometry grid({12, 11, 13}, Vector3d(0.5, 0.6, 0.7), Vector3d(-3, 2, 7));
  const auto image = noise(grid);
  const ObliquePlane plane = planeWithNormal({0.3, 0.7, -0.5});
  const auto slice =
      SliceGeometry::fitting(plane.orientation, plane.axes, grid, grid.center(), 21, 17);
  constexpr double kThickness = 2.3;
  const auto nodes = slabNodes(grid, slice, {}, kThickness);
  double weights = 0.0;
  for (std::size_t n = 0; n < nodes.size(); ++n)
  {
    weights += nodes[n].weight;
    if (n > 0) // in voxels, along a ray
    {
      EXPECT_LE((grid.voxelFromPatientLinear() *
                 ((nodes[n].offset - nodes[n - 1].offset) * plane.axes.next))
                    .norm(),
                0.5 + 1e-9);
    }
  }
  EXPECT_NEAR(weights, 1.0, 1e-12);
  EXPECT_DOUBLE_EQ(nodes.front().offset, -0.5 * kThickness);
  EXPECT_DOUBLE_EQ(nodes.back().offset, 0.5 * kThickness);
  const PlaneSamples most = drawn(image, slice, Projection::Maximum, kThickness);
  const PlaneSamples least = drawn(image, slice, Projection::Minimum, kThickness);
  const PlaneSamples mean = drawn(image, slice, Projection::Mean, kThickness);
  int seen = 0;
  for (int row = 0; row < 17; ++row)
    for (int column = 0; column < 21; ++column)
    {
      double high = -std::numeric_limits<double>::infinity();
      double low = std::numeric_limits<double>::infinity();
      double sum = 0.0;
      double weight = 0.0;
      for (const SlabNode& node : nodes)
      {
        const double value =
            trilinear(*image, grid.voxelFromPatient(slice.patientFromPixel(column, row) +
                                                    node.offset * slice.axes().next));
        if (std::isnan(value))
          continue; // what is outside does not count
        high = std::max(high, value);
        low = std::min(low, value);
        sum += node.weight * value;
        weight += node.weight;
      }
      if (weight == 0.0)
      {
        EXPECT_TRUE(std::isnan(most.at(column, row)));
        continue;
      }
      ++seen;
      EXPECT_NEAR(most.at(column, row), high, 1e-2);
      EXPECT_NEAR(least.at(column, row), low, 1e-2);
      EXPECT_NEAR(mean.at(column, row), sum / weight, 1e-2);
    }
  EXPECT_GT(seen, 100);
}

TEST(Slab, IsTheSameInParts)
{
  const core::GridGeometry grid({12, 11, 13}, Vector3d(0.5, 0.6, 0.7), Vector3d(-3, 2, 7));
  const auto image = std::make_shared<const volume::IntensityVolume>(noise(grid));
  const auto slice = SliceGeometry::fitting(SliceOrientation::Coronal, grid, grid.center(), 33, 29);
  const Slab slab{1.7, Projection::Maximum};
  const PlaneSamples whole = sampleSlab(*image, slice, slab);
  SlabSampling parts(image, slice, slab);
  while (!parts.isDone())
    parts.advance(4);
  ASSERT_EQ(parts.samples().values.size(), whole.values.size());
  for (std::size_t n = 0; n < whole.values.size(); ++n)
    EXPECT_TRUE(parts.samples().values[n] == whole.values[n] ||
                (std::isnan(parts.samples().values[n]) && std::isnan(whole.values[n])));
}

TEST(Slab, OfNoThicknessIsTheSlice)
{
  const core::GridGeometry grid({12, 11, 13}, Vector3d(0.5, 0.6, 0.7), Vector3d(-3, 2, 7));
  const auto image = noise(grid);
  const auto slice =
      SliceGeometry::fitting(SliceOrientation::Sagittal, grid, grid.center(), 33, 29);
  const PlaneSamples plain = samplePlane(volume::IntensityVolume(image), slice);
  const PlaneSamples slab = drawn(image, slice, Projection::Mean, 0.0);
  for (std::size_t n = 0; n < plain.values.size(); ++n)
    EXPECT_TRUE(slab.values[n] == plain.values[n] ||
                (std::isnan(slab.values[n]) && std::isnan(plain.values[n])));
}

TEST(Slab, LeavesOutVoxelsWithoutAValue)
{
  const core::GridGeometry grid({5, 5, 5}, Vector3d::Ones(), Vector3d::Zero());
  auto image = std::make_shared<Noise>(grid, 100.0F);
  const float nothing = std::numeric_limits<float>::quiet_NaN();
  image->at(2, 2, 2) = nothing;
  for (int k = 0; k < 5; ++k)
    image->at(3, 3, k) = nothing;
  const SliceGeometry slice(SliceOrientation::Axial, {2, 2, 2}, 1.0, 5, 5); // on the voxels
  const PlaneSamples mean = drawn(image, slice, Projection::Mean, 2.0);
  EXPECT_FLOAT_EQ(mean.at(2, 2), 100.0F);
  EXPECT_EQ(mean.at(3, 3), -std::numeric_limits<float>::infinity());
}

TEST(Slab, ProjectionsHaveNames)
{
  for (const Projection projection : {Projection::Maximum, Projection::Minimum, Projection::Mean})
    EXPECT_EQ(parseProjection(nameOf(projection)), projection);
  EXPECT_FALSE(parseProjection("sum"));
}
