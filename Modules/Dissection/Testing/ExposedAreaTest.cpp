#include "petrous/Dissection/ExposedArea.h"

#include <optional>

#include <gtest/gtest.h>

#include "petrous/Dissection/SweptSphereCut.h"
#include "petrous/Volume/SmoothedUnion.h"

using namespace petrous;
using namespace petrous::dissection;
using Eigen::Vector3d;

namespace
{

constexpr double kPi = 3.14159265358979323846;
constexpr double kVoxel = 0.25; // mm
constexpr double kBall = 4.0;   // mm, radius of the structure, centred at 0
const core::GridGeometry kGrid({81, 81, 81}, Vector3d::Constant(kVoxel),
                               Vector3d::Constant(-40 * kVoxel));

// The structure (index 2) is soft: tissue by its label only. Bone around it where `isBone`.
struct Scene
{
  template <class IsBone>
  explicit Scene(const IsBone& isBone, std::int16_t elsewhere = -1000)
  {
    auto ct = std::make_shared<volume::Volume<std::int16_t>>(kGrid);
    auto voxels = std::make_shared<volume::Volume<std::uint16_t>>(kGrid, std::uint16_t{0});
    for (int k = 0; k < 81; ++k)
      for (int j = 0; j < 81; ++j)
        for (int i = 0; i < 81; ++i)
        {
          const Vector3d p = kGrid.patientFromVoxel({1.0 * i, 1.0 * j, 1.0 * k});
          const bool inside = p.norm() < kBall;
          voxels->at(i, j, k) = inside ? 2 : 0;
          ct->at(i, j, k) = inside ? std::int16_t{50} : isBone(p) ? std::int16_t{1500} : elsewhere;
        }
    occupancy = volume::makeSmoothedUnion(volume::makeLabelMap(voxels, {}),
                                          [](std::uint16_t) { return true; });
    field.emplace(std::make_shared<const volume::IntensityVolume>(
                      std::shared_ptr<const volume::Volume<std::int16_t>>(ct)),
                  std::vector<volume::TissueField::SolidUnion>{occupancy}, nullptr,
                  volume::TissueField::Parameters{});
  }

  double exposed(const volume::CutMask& mask) const
  {
    return exposedArea(*field, mask, *occupancy);
  }

  std::shared_ptr<const volume::Volume<float>> occupancy;
  std::optional<volume::TissueField> field;
};

bool everywhere(const Vector3d&)
{
  return true;
}

// Removes everything above z = height.
volume::CutMask flatCut(double height)
{
  volume::CutMask mask(kGrid);
  for (std::size_t n = 0; n < mask.brickCount(); ++n)
  {
    const core::IndexBox box = mask.brickBox(n);
    auto brick = std::make_shared<volume::CutMask::Brick>();
    brick->fill(volume::CutMask::kUntouched);
    for (int k = box.lower[2]; k < box.upper[2]; ++k)
      for (int j = box.lower[1]; j < box.upper[1]; ++j)
        for (int i = box.lower[0]; i < box.upper[0]; ++i)
        {
          const double z = kGrid.patientFromVoxel({1.0 * i, 1.0 * j, 1.0 * k}).z();
          const double left = std::clamp(0.5 + (height - z) / (4.0 * kVoxel), 0.0, 1.0);
          (*brick)[static_cast<std::size_t>((i - box.lower[0]) +
                                            16 * ((j - box.lower[1]) + 16 * (k - box.lower[2])))] =
              static_cast<std::uint16_t>(std::lround(65535.0 * left));
        }
    mask.setBrick(n, brick);
  }
  return mask;
}

double capAbove(double height)
{
  return 2.0 * kPi * kBall * (kBall - height);
}

} // namespace

TEST(ExposedArea, IsTheCapThatAFlatCutLaysOpen)
{
  const Scene scene(everywhere);
  for (const double height : {0.1, 1.3, 2.6})
    EXPECT_NEAR(scene.exposed(flatCut(height)) / capAbove(height), 1.0, 0.03) << height;
}

// A burr outside the structure except for a cap: where spheres of radii R and r, d apart,
// intersect, the plane of their circle is (d^2 + R^2 - r^2) / 2d from R's centre. All of the
// surface inside the burr is cut; beyond it a rim is exposed without being cut, where the burr has
// removed the 0.5 mm in front of it.
TEST(ExposedArea, IsTheCapThatABurrReaches)
{
  const Scene scene(everywhere);
  const Vector3d center(0.0, 0.0, 5.0);
  const double radius = 3.0;
  volume::CutMask mask(kGrid);
  cut(mask, {center, center, radius});
  const auto circle = [&](double ball)
  { return (25.0 + ball * ball - radius * radius) / (2.0 * 5.0) / ball; }; // cosine
  const double cutItself = 2.0 * kPi * kBall * kBall * (1.0 - circle(kBall));
  EXPECT_NEAR(scene.exposed(mask) / cutItself, 1.0, 0.03);
}

TEST(ExposedArea, LeavesOutWhatAShellOfBoneStillCovers)
{
  const Scene scene(everywhere);
  EXPECT_EQ(scene.exposed(flatCut(kBall + 0.3)), 0.0) << "0.3 mm of bone are left at its thinnest";
  EXPECT_EQ(scene.exposed(volume::CutMask(kGrid)), 0.0);
}

TEST(ExposedArea, LeavesOutWhatLayOpenBefore)
{
  // Bone below z = 1 only: above it the ball was bare. Between the voxels at 0.75 and 1 the CT
  // crosses the threshold at 0.87.
  const Scene scene([](const Vector3d& p) { return p.z() < 0.9; });
  // Below the equator the normal points down: with the bone cut at -1, the 0.5 mm in front of the
  // surface are free above z + 0.5 z / R = -1.
  const double lower = -1.0 / (1.0 + kCover / kBall);
  EXPECT_NEAR(scene.exposed(flatCut(-1.0)) / (capAbove(lower) - capAbove(0.87)), 1.0, 0.03);
  EXPECT_LT(scene.exposed(flatCut(2.0)), 0.5) << "no bone was there";
}

// A layer of 1.2 mm of unlabelled soft tissue on the ball, then bone. A flat cut removes the bone
// in the directions whose ray meets the bone's surface above it.
TEST(ExposedArea, SeesThroughAThinLayerOfSoftTissue)
{
  constexpr double inner = 5.2; // mm, of the bone's voxels
  // Between voxels of 40 HU and 1500 HU the CT crosses the threshold a third of a voxel early.
  constexpr double surface = inner - (0.5 - 260.0 / 1460.0) * kVoxel;
  const auto bone = [](double from)
  { return [from](const Vector3d& p) { return p.norm() > from; }; };
  const Scene scene(bone(inner), 40);
  for (const double height : {1.3, 2.6, 4.0})
  {
    const double cap = 2.0 * kPi * kBall * kBall * (1.0 - height / surface);
    EXPECT_NEAR(scene.exposed(flatCut(height)) / cap, 1.0, 0.05) << height;
  }
  EXPECT_EQ(scene.exposed(flatCut(inner + 0.3)), 0.0) << "bone is left over it";
  EXPECT_EQ(Scene(bone(kBall + 3.0), 40).exposed(flatCut(1.0)), 0.0) << "not its cover";
  EXPECT_EQ(Scene(bone(inner), -1000).exposed(flatCut(1.0)), 0.0) << "it lay in an air cell";
}
