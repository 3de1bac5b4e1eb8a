#include "petrous/Volume/DistanceField.h"

#include <cmath>
#include <functional>
#include <random>

#include <Eigen/Geometry>

#include <gtest/gtest.h>

#include "petrous/Volume/Sampling.h"

using namespace petrous;
using namespace petrous::volume;
using Eigen::Vector3d;

namespace
{

using Distance = std::function<double(const Vector3d&)>; // mm, negative inside

// Occupancy linear across the surface, on a rotated anisotropic grid.
std::shared_ptr<const Volume<float>> occupancyOf(const Distance& distance)
{
  const Eigen::Matrix3d turn =
      Eigen::AngleAxisd(0.7, Vector3d(1.0, -0.4, 0.5).normalized()).toRotationMatrix();
  const Vector3d spacing(0.3, 0.3, 0.5);
  const core::Index3 dims{61, 61, 41};
  auto occupancy = std::make_shared<Volume<float>>(
      core::GridGeometry(dims, spacing, -(turn * Vector3d(9.0, 9.0, 10.0)), turn));
  for (int k = 0; k < dims[2]; ++k)
    for (int j = 0; j < dims[1]; ++j)
      for (int i = 0; i < dims[0]; ++i)
        occupancy->at(i, j, k) = static_cast<float>(std::clamp(
            0.5 -
                distance(occupancy->geometry().patientFromVoxel({1.0 * i, 1.0 * j, 1.0 * k})) / 2.0,
            0.0, 1.0));
  return occupancy;
}

} // namespace

TEST(DistanceField, IsTheDistanceUpToItsReach)
{
  constexpr double reach = 5.0;
  const Distance shapes[] = {[](const Vector3d& p) { return p.norm() - 4.0; }, [](const Vector3d& p)
                             { return std::hypot(std::hypot(p.x(), p.y()) - 5.0, p.z()) - 1.0; }};
  for (const Distance& shape : shapes)
    for (const std::size_t most : {kMaxFieldVoxels, std::size_t{200'000}})
    {
      const auto field = makeDistanceField(*occupancyOf(shape), reach, {}, most);
      ASSERT_TRUE(field);
      EXPECT_LE(field->size(), most);
      std::mt19937 random(3);
      std::uniform_real_distribution<double> uniform(-12.0, 12.0);
      int seen = 0;
      for (int n = 0; n < 20000; ++n)
      {
        const double x = uniform(random);
        const double y = uniform(random);
        const Vector3d p(x, y, uniform(random));
        const double truth = shape(p);
        const Vector3d voxel = field->geometry().voxelFromPatient(p);
        if (!field->geometry().hullContains(voxel))
        {
          EXPECT_GT(truth, reach) << p.transpose();
          continue;
        }
        const double found = sampleTrilinear(*field, voxel);
        if (truth > reach)
          ASSERT_GT(found, reach - 0.05) << p.transpose();
        else if (truth > 0.0)
        {
          // Above the ring's centre the distance has a crease, which one voxel edge rounds.
          const double edge = field->geometry().minSpacing();
          ASSERT_NEAR(found, truth, p.head<2>().norm() < edge ? edge : 0.1) << p.transpose();
          ++seen;
        }
        else
          ASSERT_LT(found, 0.05) << p.transpose();
      }
      EXPECT_GT(seen, 2000);
    }
}

TEST(DistanceField, IsNothingWithoutAStructure)
{
  EXPECT_FALSE(makeDistanceField(*occupancyOf([](const Vector3d&) { return 3.0; }), 5.0));
  EXPECT_THROW(makeDistanceField(*occupancyOf([](const Vector3d&) { return 3.0; }), 0.0),
               core::InvalidParameter);
}
