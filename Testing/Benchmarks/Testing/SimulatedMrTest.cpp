#include "SimulatedMr.h"

#include <cmath>
#include <cstring>

#include <gtest/gtest.h>

using namespace petrous;
using namespace petrous::registration;

namespace
{

// A ball of Gaussian profile with maximum 1: its integrals are known.
constexpr double kSigma = 6.0; // mm
const Vector3d kMiddle(3.0, -4.0, 12.0);

volume::Volume<float> blob(double sigma = kSigma)
{
  volume::Volume<float> image({{80, 80, 80}, Vector3d::Constant(1.0), Vector3d(-37, -44, -28)});
  const core::GridGeometry& grid = image.geometry();
  for (int k = 0; k < 80; ++k)
    for (int j = 0; j < 80; ++j)
      for (int i = 0; i < 80; ++i)
        image.at(i, j, k) = static_cast<float>(
            std::exp(-0.5 * (grid.patientFromVoxel(Vector3d(i, j, k)) - kMiddle).squaredNorm() /
                     (sigma * sigma)));
  return image;
}

MrAcquisition quiet()
{
  MrAcquisition a;
  a.extent = {64.0, 64.0, 64.0};
  a.center = kMiddle + Vector3d(2.0, 1.0, -3.0);
  a.noise = 0.0;
  a.bias = 0.0;
  return a;
}

Vector3d centroid(const volume::IntensityVolume& image)
{
  const core::GridGeometry& grid = image.geometry();
  Vector3d sum = Vector3d::Zero();
  double mass = 0.0;
  for (int k = 0; k < grid.dims()[2]; ++k)
    for (int j = 0; j < grid.dims()[1]; ++j)
      for (int i = 0; i < grid.dims()[0]; ++i)
      {
        const double value = image.at(i, j, k);
        sum += value * grid.patientFromVoxel(Vector3d(i, j, k));
        mass += value;
      }
  return sum / mass;
}

volume::IntensityVolume uniformCt(float value)
{
  return volume::IntensityVolume(std::make_shared<const volume::Volume<float>>(
      core::GridGeometry({24, 24, 24}, Vector3d::Constant(1.0), Vector3d::Zero()), value));
}

double mean(const volume::Volume<float>& image)
{
  double sum = 0.0;
  for (std::size_t n = 0; n < image.size(); ++n)
    sum += image.data()[n];
  return sum / static_cast<double>(image.size());
}

} // namespace

TEST(SimulatedMr, LiesWhereTheMotionTookIt)
{
  const auto image = blob();
  MrAcquisition a = quiet();
  for (const double thickness : {1.0, 3.0, 6.0})
    for (std::uint64_t seed = 1; seed <= 3; ++seed)
    {
      a.spacing = {1.25, 1.0, thickness};
      a.mrFromCt = randomMotion(kMiddle, 30.0, 25.0, seed);
      a.axes = Eigen::AngleAxisd(0.1 * static_cast<double>(seed), Vector3d::UnitX()).matrix();
      const SimulatedMr mr = acquireMr(image, a);
      const Vector3d truth = a.mrFromCt * kMiddle;
      EXPECT_LT((mr.truth(kMiddle) - truth).norm(), 1e-9);
      EXPECT_LT((centroid(*mr.volume) - truth).norm(), 0.01) << thickness;
    }
}

// The mean of a Gaussian over a box is a difference of error functions.
TEST(SimulatedMr, AveragesOverTheSlice)
{
  const auto image = blob();
  MrAcquisition a = quiet();
  a.center = kMiddle;
  a.spacing = {1.0, 1.0, 6.0};
  a.extent = {33.0, 33.0, 30.0}; // odd counts: a voxel at the centre
  const SimulatedMr mr = acquireMr(image, a);
  const auto mean = [](double from, double to)
  {
    const auto whole = [](double x) { return 0.5 * std::erf(x / (kSigma * std::sqrt(2.0))); };
    return kSigma * std::sqrt(2.0 * 3.14159265358979323846) * (whole(to) - whole(from)) /
           (to - from);
  };
  const double inPlane = mean(-0.5, 0.5) * mean(-0.5, 0.5);
  for (const int slice : {0, 1})
    EXPECT_NEAR(mr.volume->at(16, 16, 2 + slice),
                1000.0 * inPlane * mean(6.0 * slice - 3.0, 6.0 * slice + 3.0), 2.0);
}

TEST(SimulatedMr, HasRicianNoiseInAir)
{
  const volume::Volume<float> air({{20, 20, 20}, Vector3d::Constant(2.0), Vector3d::Zero()}, 0.0F);
  MrAcquisition a = quiet();
  a.center = {20.0, 20.0, 20.0};
  a.extent = {30.0, 30.0, 30.0};
  a.noise = 0.05;
  const SimulatedMr mr = acquireMr(air, a);
  double sum = 0.0;
  const auto voxels = std::get<std::shared_ptr<const volume::Volume<float>>>(mr.volume->voxels());
  // Rayleigh: sigma sqrt(pi / 2), of 27,000 voxels.
  EXPECT_NEAR(mean(*voxels), 50.0 * std::sqrt(0.5 * 3.14159265358979323846), 0.8);
  for (std::size_t n = 0; n < voxels->size(); ++n)
    sum += std::pow(voxels->data()[n], 2);
  EXPECT_NEAR(sum / static_cast<double>(voxels->size()), 2.0 * 50.0 * 50.0, 120.0);
}

TEST(SimulatedMr, IsTheSameForASeedAndAnotherForAnother)
{
  const auto image = blob();
  MrAcquisition a = quiet();
  a.spacing = {2.0, 2.0, 3.0};
  a.noise = 0.03;
  const auto bytes = [&]
  {
    const SimulatedMr mr = acquireMr(image, a);
    const auto voxels = std::get<std::shared_ptr<const volume::Volume<float>>>(mr.volume->voxels());
    return std::string(reinterpret_cast<const char*>(voxels->data()), voxels->bytes());
  };
  const std::string first = bytes();
  EXPECT_TRUE(bytes() == first);
  a.seed = 2;
  EXPECT_FALSE(bytes() == first);
}

TEST(SimulatedMr, TellsWhereADistortedPointLands)
{
  const auto image = blob(1.5); // small compared with the field's variations
  MrAcquisition a = quiet();
  a.distortion = 8.0;
  double farthest = 0.0;
  for (a.seed = 1; a.seed <= 6; ++a.seed)
  {
    const SimulatedMr mr = acquireMr(image, a);
    farthest = std::max(farthest, (mr.truth(kMiddle) - kMiddle).norm());
    EXPECT_LT((centroid(*mr.volume) - mr.truth(kMiddle)).norm(), 0.15) << a.seed;
  }
  EXPECT_GT(farthest, 2.0);
}

TEST(SimulatedMr, ShowsTissueAsItsWeightingDoes)
{
  const auto level = [](float hounsfield, MrContrast contrast)
  { return mean(mrContrastOf(uniformCt(hounsfield), contrast, 1)); };
  for (const MrContrast c : {MrContrast::T1, MrContrast::T2, MrContrast::Diffusion})
  {
    EXPECT_LT(level(-1000.0F, c), 0.05) << "air";
    EXPECT_LT(level(1500.0F, c), 0.05) << "cortical bone";
    EXPECT_LT(level(std::nanf(""), c), 0.05) << "no value";
  }
  EXPECT_GT(level(-90.0F, MrContrast::T1), 2.0 * level(0.0F, MrContrast::T1)) << "fat over fluid";
  EXPECT_GT(level(0.0F, MrContrast::T2), 1.4 * level(35.0F, MrContrast::T2)) << "fluid over brain";
  EXPECT_GT(level(35.0F, MrContrast::Diffusion), 2.0 * level(0.0F, MrContrast::Diffusion));
}

// Half a voxel of bone next to half a voxel of air is not soft tissue.
TEST(SimulatedMr, KeepsTheRimBetweenAirAndBoneDark)
{
  volume::Volume<float> ct({{24, 24, 24}, Vector3d::Constant(1.0), Vector3d::Zero()}, -1000.0F);
  for (int k = 0; k < 24; ++k)
    for (int j = 0; j < 24; ++j)
      for (int i = 12; i < 24; ++i)
        ct.at(i, j, k) = i == 12 ? 40.0F : 1500.0F;
  const auto contrast =
      mrContrastOf(volume::IntensityVolume(std::make_shared<const volume::Volume<float>>(ct)),
                   MrContrast::T1, 1);
  EXPECT_LT(contrast.at(12, 12, 12), 0.05F);
}

// The CT's noise must not reappear in the MR: that would help registration.
TEST(SimulatedMr, DoesNotInheritTheNoiseOfTheCt)
{
  volume::Volume<float> ct({{24, 24, 24}, Vector3d::Constant(1.0), Vector3d::Zero()});
  for (std::size_t n = 0; n < ct.size(); ++n)
    ct.data()[n] = 40.0F + 20.0F * ((n * 2654435761U >> 13 & 1U) != 0 ? 1.0F : -1.0F);
  const auto contrastOf = [](const volume::Volume<float>& image)
  {
    return mrContrastOf(
        volume::IntensityVolume(std::make_shared<const volume::Volume<float>>(image)),
        MrContrast::T1, 7);
  };
  const auto noisy = contrastOf(ct);
  const auto clean = contrastOf(volume::Volume<float>(ct.geometry(), 40.0F));
  double most = 0.0, apart = 0.0;
  for (int n = 4; n < 20; ++n)
    most = std::max(most, static_cast<double>(std::abs(noisy.at(n, 12, 9) - clean.at(n, 12, 9))));
  // The contrast of 20 HU according to the curve.
  apart = 20.0 * (0.60 - 0.55) / 18.0;
  EXPECT_LT(most, 0.6 * apart);
}

// A small blob in a ball that is displaced as a whole appears displaced by the same amount.
TEST(SimulatedMr, DisplacesAPartOfThePatient)
{
  MrAcquisition a = quiet();
  const Vector3d still = centroid(*acquireMr(blob(2.0), a).volume);
  a.local = LocalShift{kMiddle, 18.0, Vector3d(2.0, -1.5, 3.0), 2.0};
  const SimulatedMr moved = acquireMr(blob(2.0), a);
  EXPECT_LT((centroid(*moved.volume) - still - a.local->shift).norm(), 0.02);
  EXPECT_LT((moved.truth(kMiddle) - kMiddle - a.local->shift).norm(), 1e-9);
  const Vector3d outside = kMiddle + Vector3d(25.0, 0.0, 0.0);
  EXPECT_LT((moved.truth(outside) - outside).norm(), 1e-9);
}
