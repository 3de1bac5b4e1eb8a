#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "petrous/Phantom/Phantom.h"
#include "petrous/Presenters/PlaneSamples.h"
#include "petrous/Presenters/SliceOverlay.h"

using namespace petrous;
using namespace petrous::presenters;
using Eigen::Vector3d;
using phantom::Phantom;

namespace
{

core::GridGeometry centred(const core::Index3& dims, double spacing, const Vector3d& center)
{
  const Vector3d extent(dims[0] - 1.0, dims[1] - 1.0, dims[2] - 1.0);
  return {dims, Vector3d::Constant(spacing), center - 0.5 * spacing * extent};
}

// The phantom's ear as CT and, moved, as MR.
struct EarPair
{
  Phantom phantom;
  std::unique_ptr<const volume::IntensityVolume> ct, mr;

  EarPair()
  {
    const auto scan = [this](const core::GridGeometry& grid, const phantom::ScanSettings& settings)
    {
      return std::make_unique<const volume::IntensityVolume>(
          std::make_shared<const volume::Volume<std::int16_t>>(
              phantom::samplePhantom(phantom, grid, settings)));
    };
    phantom::ScanSettings settings;
    ct = scan(centred({130, 130, 5}, 0.35, Phantom::center()), settings);
    settings.modality = Phantom::Modality::Mr;
    settings.noise = 12.0;
    settings.patientFromScan = phantom.mrFromCt().inverse();
    mr = scan(centred({90, 90, 30}, 0.6, phantom.mrFromCt() * Phantom::center()), settings);
  }

  // Median distance, mm, from the CT's bone contours to the maximum MR gradient across them (within
  // 2 mm, and where there is a gradient).
  double misfit(const core::RigidTransform& mrFromCt) const
  {
    const SliceGeometry slice(SliceOrientation::Axial, Phantom::center(), 0.15, 280, 280);
    const EdgeLevels levels = edgeLevels({});
    const PlaneSamples bone = samplePlane(*ct, slice);
    std::vector<double> offsets;
    for (const auto& segment : contours(bone, levels.bone, levels.slope * 0.15F))
    {
      const Eigen::Vector2f along = segment.b - segment.a;
      if (along.norm() < 0.02F)
        continue;
      const Eigen::Vector2d middle = (0.5F * (segment.a + segment.b)).cast<double>();
      const Eigen::Vector2d normal =
          Eigen::Vector2f(-along[1], along[0]).normalized().cast<double>();
      const auto value = [&](double mm)
      {
        const Eigen::Vector2d pixel = middle + mm / 0.15 * normal;
        return mr->sample(
            mr->geometry().voxelFromPatient(mrFromCt * slice.patientFromPixel(pixel[0], pixel[1])));
      };
      double steepest = 0.0;
      double offset = 0.0;
      for (double mm = -2.0; mm <= 2.0; mm += 0.05)
      {
        const double change = std::abs(value(mm + 0.3) - value(mm - 0.3));
        if (change > steepest)
        {
          steepest = change;
          offset = std::abs(mm);
        }
      }
      if (steepest > 250.0)
        offsets.push_back(offset);
    }
    EXPECT_GT(offsets.size(), 100U);
    std::nth_element(offsets.begin(), offsets.begin() + static_cast<long>(offsets.size() / 2),
                     offsets.end());
    return offsets[offsets.size() / 2];
  }
};

} // namespace

// The ground truth is the motion with which the phantom was scanned.
TEST(SliceOverlay, PutsTheMrsBordersOnTheCtsContoursWithTheKnownMotionOnly)
{
  const EarPair pair;
  const core::RigidTransform motion = pair.phantom.mrFromCt();
  const double best = pair.misfit(motion);
  EXPECT_LT(best, 0.4); // two thirds of an MR voxel; other edges lie within 2 mm as well
  EXPECT_GT(pair.misfit({}), 2.0 * best);
  EXPECT_GT(pair.misfit(motion.inverse()), 2.0 * best);
  for (int side = 0; side < 4; ++side)
  {
    Vector3d shift = Vector3d::Zero();
    shift[side / 2] = side % 2 == 0 ? 0.8 : -0.8;
    EXPECT_GT(pair.misfit(motion * core::RigidTransform({}, shift)), 1.3 * best) << side;
  }
}
