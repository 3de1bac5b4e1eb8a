#include "petrous/Haptics/HapticField.h"

#include <random>

#include <Eigen/Geometry>

#include <gtest/gtest.h>

#include "AnalyticFields.h"

using namespace petrous;
using namespace petrous::haptics;
using namespace petrous::haptics::testing;

namespace
{

using Random = std::mt19937;

double between(Random& random, double low, double high)
{
  return std::uniform_real_distribution<double>(low, high)(random);
}

// A grid rotated in the patient, with noise for bone, a union on a grid of its own and a mask with
// some bricks cut.
struct Mixed
{
  std::shared_ptr<volume::IntensityVolume> ct;
  volume::TissueField::SolidUnion occupancy;
  std::shared_ptr<volume::CutMask> mask;
  std::shared_ptr<volume::PublishedMask> published;
  std::shared_ptr<volume::TissueField> tissue;
};

Mixed mixed(Random& random)
{
  const Eigen::Matrix3d turn =
      Eigen::AngleAxisd(0.6, Eigen::Vector3d(1, 2, -1).normalized()).toRotationMatrix();
  const core::GridGeometry grid({45, 38, 30}, {0.3, 0.4, 0.7}, {12, -40, 7}, turn);
  auto voxels = std::make_shared<volume::Volume<std::int16_t>>(grid, std::int16_t{-1000});
  for (int n = 0; n < 6000; ++n)
  {
    const auto at = [&](int dim) { return static_cast<int>(between(random, 0.0, dim - 0.01)); };
    voxels->at(at(45), at(38), at(30)) = static_cast<std::int16_t>(between(random, -900, 2500));
  }
  Mixed scene;
  scene.ct = std::make_shared<volume::IntensityVolume>(
      std::shared_ptr<const volume::Volume<std::int16_t>>(voxels));
  const core::GridGeometry own({20, 22, 18}, {0.5, 0.35, 0.4}, grid.center());
  auto occupancy = std::make_shared<volume::Volume<float>>(own);
  // Zero on its border, as label fields have a margin.
  std::fill_n(occupancy->data(), occupancy->size(), 0.0F);
  for (int k = 1; k < own.dims()[2] - 1; ++k)
    for (int j = 1; j < own.dims()[1] - 1; ++j)
      for (int i = 1; i < own.dims()[0] - 1; ++i)
        occupancy->at(i, j, k) = static_cast<float>(between(random, 0.0, 1.0));
  scene.occupancy = occupancy;
  scene.mask = std::make_shared<volume::CutMask>(grid);
  // Some balls are removed, with the ramp of a cut: 1/2 over a voxel diagonal.
  std::vector<std::pair<Eigen::Vector3d, double>> balls;
  for (int n = 0; n < 8; ++n)
    balls.emplace_back(grid.patientFromVoxel({between(random, 0, 44), between(random, 0, 37),
                                              between(random, 0, 29)}),
                       between(random, 1.0, 4.0));
  for (std::size_t n = 0; n < scene.mask->brickCount(); ++n)
  {
    auto brick = std::make_shared<volume::CutMask::Brick>();
    brick->fill(volume::CutMask::kUntouched);
    const core::IndexBox box = scene.mask->brickBox(n);
    for (int k = box.lower[2]; k < box.upper[2]; ++k)
      for (int j = box.lower[1]; j < box.upper[1]; ++j)
        for (int i = box.lower[0]; i < box.upper[0]; ++i)
        {
          double left = 1.0;
          for (const auto& [center, radius] : balls)
          {
            const double d =
                (grid.patientFromVoxel({double(i), double(j), double(k)}) - center).norm() - radius;
            left = std::min(left, std::clamp(0.5 + 0.5 * d / grid.spacing().norm(), 0.0, 1.0));
          }
          (*brick)[static_cast<std::size_t>(i % 16 + 16 * (j % 16 + 16 * (k % 16)))] =
              static_cast<std::uint16_t>(std::lround(65535.0 * left));
        }
    scene.mask->setBrick(n, brick);
  }
  scene.published = std::make_shared<volume::PublishedMask>(*scene.mask);
  scene.tissue = std::make_shared<volume::TissueField>(
      scene.ct, std::vector<volume::TissueField::SolidUnion>{occupancy}, scene.mask,
      volume::TissueField::Parameters{kIso, 1000.0});
  return scene;
}

Eigen::Vector3d randomVoxel(Random& random, const core::GridGeometry& grid, double beyond)
{
  Eigen::Vector3d voxel;
  for (int a = 0; a < 3; ++a)
    voxel[a] = between(random, -beyond, grid.dims()[static_cast<std::size_t>(a)] - 1.0 + beyond);
  return voxel;
}

} // namespace

// The servo's f equals the f of renderer and drill.
TEST(HapticField, IsTheTissueFieldAwayFromTheGridsBorder)
{
  Random random(3);
  const Mixed scene = mixed(random);
  const HapticField field(*scene.tissue, scene.published);
  const volume::MaskState& state = *scene.published->acquire();
  int deciders[5] = {};
  for (int n = 0; n < 20000; ++n)
  {
    const Eigen::Vector3d voxel = randomVoxel(random, field.geometry(), 2.0);
    const Eigen::Vector3d patient = field.geometry().patientFromVoxel(voxel);
    const FieldSample sample = field.sample(voxel, state);
    const double truth = scene.tissue->value(patient);
    ++deciders[static_cast<int>(sample.decider)];
    if (sample.decider == Decider::Hull)
    {
      EXPECT_GE(truth, sample.value);
      EXPECT_GE(sample.value, 0.0);
      continue;
    }
    ASSERT_NEAR(sample.value, truth, 1e-9) << voxel.transpose();
    if (sample.decider == Decider::Outside)
      continue;
    const Eigen::Vector3d gradient = field.gradient(voxel, sample, state);
    if (gradient.norm() > 1e-6)
    {
      ASSERT_LT((-gradient.normalized() - scene.tissue->normal(patient)).norm(), 1e-6);
    }
  }
  for (const int count : deciders)
    EXPECT_GT(count, 5) << "the scene must bring every operand to decide";
}

TEST(HapticField, NeverHasTissueWithinItsClearance)
{
  Random random(8);
  const Mixed scene = mixed(random);
  const HapticField field(*scene.tissue, scene.published);
  const volume::MaskState& state = *scene.published->acquire();
  int clear = 0;
  for (int n = 0; n < 3000; ++n)
  {
    const Eigen::Vector3d voxel = randomVoxel(random, field.geometry(), 8.0);
    const double clearance =
        std::max(field.clearance(voxel), field.freeRadius(voxel, field.sample(voxel, state)));
    const Eigen::Vector3d patient = field.geometry().patientFromVoxel(voxel);
    clear += clearance > 0.0;
    for (int m = 0; m < 20 && clearance > 0.0; ++m)
    {
      Eigen::Vector3d way(between(random, -1, 1), between(random, -1, 1), between(random, -1, 1));
      way *= between(random, 0.0, 0.999) * clearance / std::max(way.norm(), 1e-3);
      ASSERT_LE(scene.tissue->value(patient + way), 0.0) << voxel.transpose() << ' ' << clearance;
    }
  }
  EXPECT_GT(clear, 100);
}

TEST(HapticField, RisesNoFasterThanItsSteepness)
{
  Random random(5);
  const Mixed scene = mixed(random);
  const HapticField field(*scene.tissue, scene.published);
  const volume::MaskState& state = *scene.published->acquire();
  for (int n = 0; n < 20000; ++n)
  {
    const Eigen::Vector3d a = randomVoxel(random, field.geometry(), 0.0);
    Eigen::Vector3d b = a;
    for (int axis = 0; axis < 3; ++axis)
      b[axis] += between(random, -0.25, 0.25);
    const FieldSample from = field.sample(a, state);
    const FieldSample to = field.sample(b, state);
    if (from.decider == Decider::Outside || to.decider == Decider::Outside)
      continue;
    const double way = (field.geometry().patientFromVoxelLinear() * (b - a)).norm();
    ASSERT_LE(std::abs(to.uncut - from.uncut), field.steepness(0.5 * (a + b)) * way * 1.0001);
    ASSERT_LE(std::abs(to.left - from.left), field.leftSteepness() * way * 1.0001);
  }
}

TEST(HapticField, TakesNoTissueFromVoxelsWithoutANumber)
{
  const core::GridGeometry grid({20, 20, 20}, Eigen::Vector3d::Ones(), Eigen::Vector3d::Zero());
  auto voxels =
      std::make_shared<volume::Volume<float>>(grid, std::numeric_limits<float>::quiet_NaN());
  const Scene scene = sceneOf(std::make_shared<volume::IntensityVolume>(
      std::shared_ptr<const volume::Volume<float>>(voxels)));
  const auto& state = *scene.published->acquire();
  EXPECT_LT(scene.field->sample({10, 10, 10}, state).value, 0.0);
  EXPECT_GT(scene.field->clearance({10, 10, 10}), 0.0);
}
