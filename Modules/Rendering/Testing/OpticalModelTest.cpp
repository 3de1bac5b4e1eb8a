#include "OpticalModel.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include <gtest/gtest.h>

#include "petrous/Core/SplitMix64.h"

using namespace petrous;
using namespace petrous::rendering;

namespace
{

const Eigen::Vector3d kColor(0.5, 0.25, 0.1);
constexpr double kShininess = 18.0;

appearance::TransferFunction::Optics tissue(double specular = 0.0)
{
  return {{kColor[0], kColor[1], kColor[2]}, 1.0, specular};
}

Eigen::Vector3d lit(const LightSettings& light, double cosine, double distance = 0.0,
                    double specular = 0.0)
{
  return optics::surfaceColor(tissue(specular), kShininess, cosine, light, distance);
}

} // namespace

TEST(OpticalModel, LightIsTheSameEverywhereWithoutFalloff)
{
  LightSettings light;
  light.intensity = 0.7;
  EXPECT_DOUBLE_EQ(optics::lightAt(light, 0.0), 0.7);
  EXPECT_DOUBLE_EQ(optics::lightAt(light, 1e4), 0.7);
}

TEST(OpticalModel, LightIsHalvedAtTheFalloffAndFadesWithTheSquareFarAway)
{
  LightSettings light;
  light.intensity = 0.8;
  light.falloff = 50.0;
  EXPECT_DOUBLE_EQ(optics::lightAt(light, 0.0), 0.8);
  EXPECT_DOUBLE_EQ(optics::lightAt(light, 50.0), 0.4);
  EXPECT_NEAR(optics::lightAt(light, 1e5) / optics::lightAt(light, 2e5), 4.0, 1e-5);
}

TEST(OpticalModel, FalloffLeavesTheFocalPointAsBrightWhereverTheCameraIs)
{
  LightSettings light;
  light.intensity = 0.8;
  light.falloff = 50.0;
  for (const double focus : {1.0, 50.0, 400.0})
    EXPECT_NEAR(optics::lightAt(light, focus, focus), 0.8, 1e-12);
  EXPECT_NEAR(optics::lightAt(light, 100.0, 50.0), 0.8 * 2.0 / 5.0, 1e-12);
  core::CameraPose camera;
  camera.position = {0.0, 0.0, 30.0};
  camera.focalPoint = {0.0, 40.0, 0.0};
  EXPECT_DOUBLE_EQ(optics::lampOf(camera).focus, 50.0);
  camera.head = core::CameraPose::Head{{0.0, 0.0, 5.0}, {0.0, 0.0, 0.0}};
  EXPECT_DOUBLE_EQ(optics::lampOf(camera).focus, 5.0); // of both eyes
}

TEST(OpticalModel, AStopDoublesTheLuminanceOfADisplayOfGamma22)
{
  LightSettings light;
  const Eigen::Vector3d usual = lit(light, 0.7);
  EXPECT_EQ(optics::lightAt(light, 0.0), 1.0); // nothing is rounded at 0 EV
  for (const double stops : {-1.0, 0.5, 1.0})
  {
    light.exposure = stops;
    const Eigen::Vector3d exposed = lit(light, 0.7);
    for (int c = 0; c < 3; ++c)
      EXPECT_NEAR(std::log2(std::pow(exposed[c], 2.2) / std::pow(usual[c], 2.2)), stops, 1e-9);
  }
}

// Values of the Khronos PBR Neutral specification without its toe: 1 - 0.04 / (p - 0.6) of a peak
// p, and 1 / (0.15 (p - p') + 1) of its saturation.
TEST(OpticalModel, ToneCurveIsThatOfItsSpecification)
{
  using Color = Eigen::Vector3d;
  EXPECT_TRUE(optics::toneCurve({1.0, 1.0, 1.0}).isApprox(Color::Constant(0.9), 1e-12));
  EXPECT_TRUE(optics::toneCurve({1.6, 1.6, 1.6}).isApprox(Color::Constant(0.96), 1e-12));
  EXPECT_TRUE(
      optics::toneCurve({1.0, 0.0, 0.0}).isApprox(Color(0.9, 0.0133004926, 0.0133004926), 1e-9));
}

TEST(OpticalModel, ToneCurveLeavesMidTonesAndIsMonotoneAndSmooth)
{
  EXPECT_EQ(optics::toneCurve(Eigen::Vector3d::Zero()), Eigen::Vector3d::Zero());
  EXPECT_EQ(optics::toneCurve({-1.0, 0.5, 0.8}), Eigen::Vector3d(0.0, 0.5, 0.8));
  const Eigen::Vector3d hue(1.0, 0.6, 0.1);
  constexpr double kStep = 1e-3;
  Eigen::Vector3d last = Eigen::Vector3d::Zero();
  Eigen::Vector3d slope = hue;
  for (double light = kStep; light < 8.0; light += kStep)
  {
    const Eigen::Vector3d shown = optics::toneCurve(light * hue);
    const Eigen::Vector3d rise = (shown - last) / kStep;
    EXPECT_GT(rise.minCoeff(), 0.0) << light;
    EXPECT_LT((rise - slope).cwiseAbs().maxCoeff(), 0.02) << light; // no bend
    EXPECT_LT(shown.maxCoeff(), 1.0) << light;
    EXPECT_NEAR((shown[0] - shown[1]) / (shown[0] - shown[2]), 0.4 / 0.9, 1e-9) << light; // hue
    last = shown;
    slope = rise;
  }
  EXPECT_GT(last[0], 0.99);
}

TEST(OpticalModel, SurfaceIsAmbientPlusLambert)
{
  LightSettings light;
  light.ambient = 0.2;
  light.specular = 0.0;
  EXPECT_TRUE(lit(light, 1.0).isApprox(kColor, 1e-12));
  EXPECT_TRUE(lit(light, 0.0).isApprox(0.2 * kColor, 1e-12));
  EXPECT_TRUE(lit(light, 0.5).isApprox(0.6 * kColor, 1e-12));
  EXPECT_TRUE(lit(light, -0.5).isApprox(0.6 * kColor, 1e-12)); // seen from the back
}

TEST(OpticalModel, HighlightIsOfTheTransferFunctionTimesTheLampsAndTakesDiffuseLight)
{
  LightSettings light;
  light.specular = 0.3;
  const double cosine = 0.95;
  const Eigen::Vector3d added = lit(light, cosine, 0.0, 0.5) - lit(light, cosine, 0.0, 0.0);
  const double highlight = 0.5 * 0.3 * std::exp(kShininess * std::log(cosine));
  const double taken = 0.5 * 0.3 * std::pow(cosine, 3.0);
  EXPECT_TRUE(added.isApprox(Eigen::Vector3d::Constant(highlight) - taken * kColor, 1e-12));
}

// What faces the lamp is c (1 - g) + g.
TEST(OpticalModel, NoDrySurfaceIsBrighterThanWhite)
{
  for (const bool shadows : {false, true})
  {
    LightSettings light;
    light.setShadows(shadows);
    const double gloss = light.specular;
    const auto shade = [&light](double grey, double cosine) {
      return optics::surfaceColor({{grey, grey, grey}, 1.0, 1.0}, kShininess, cosine, light,
                                  0.0)[0];
    };
    for (const double grey : {0.0, 0.5, 0.91, 1.0})
    {
      EXPECT_NEAR(shade(grey, 1.0), grey * (1.0 - gloss) + gloss, 1e-12);
      double before = 0.0;
      for (double cosine = 0.0; cosine < 1.0; cosine += 1e-3)
      {
        const double now = shade(grey, cosine);
        EXPECT_LT(now, 1.0);
        EXPECT_GE(now, before); // shape
        before = now;
      }
    }
  }
}

TEST(OpticalModel, GlossDarkensNeitherShadowsNorWhatIsSeenFromTheSide)
{
  LightSettings light;
  light.setShadows(true);
  LightSettings matt = light;
  matt.specular = 0.0;
  const auto shade = [](const LightSettings& by, double cosine, const optics::Seen& seen)
  { return optics::surfaceColor(tissue(1.0), kShininess, cosine, by, 0.0, seen)[0]; };
  EXPECT_EQ(shade(light, 0.9, {0.7, 0.0}), shade(matt, 0.9, {0.7, 0.0}));
  EXPECT_EQ(shade(light, 0.0, {}), shade(matt, 0.0, {}));
  EXPECT_GT(shade(light, 0.3, {}), 0.99 * shade(matt, 0.3, {}));
}

TEST(OpticalModel, GlossTakesNothingOfAColourThatIsComparedWithALegend)
{
  const LightSettings light;
  const double cosine = 0.8;
  const double lambert = light.ambient + (1.0 - light.ambient) * cosine;
  const double highlight = light.specular * std::pow(cosine, kShininess);
  const Eigen::Vector3d color =
      optics::surfaceColor(tissue(1.0), kShininess, cosine, light, 0.0, {}, 0.0, true);
  EXPECT_TRUE(color.isApprox(lambert * kColor + Eigen::Vector3d::Constant(highlight), 1e-12));
}

TEST(OpticalModel, WetnessAddsANarrowWhiteHighlight)
{
  LightSettings dry;
  LightSettings wet;
  wet.wetness = 0.4;
  const double tenDegrees = std::cos(10.0 * M_PI / 180.0);
  EXPECT_NEAR((lit(wet, 1.0) - lit(dry, 1.0))[2], 0.4, 1e-12);
  EXPECT_NEAR((lit(wet, tenDegrees) - lit(dry, tenDegrees))[2],
              0.4 * std::exp(optics::kWetShininess * std::log(tenDegrees)), 1e-12);
  EXPECT_LT((lit(wet, 0.8) - lit(dry, 0.8)).norm(), 1e-10);
}

TEST(OpticalModel, BelowAFilmOfWaterASurfaceLosesItsOwnGloss)
{
  const auto gloss = [](double wetness)
  {
    LightSettings light;
    light.wetness = wetness;
    const double taken =
        0.5 * light.specular * std::pow(0.9, 3.0); // of diffuse light, also below it
    return (lit(light, 0.9, 0.0, 0.5) - lit(light, 0.9, 0.0, 0.0))[2] + taken * kColor[2];
  };
  EXPECT_GT(gloss(0.0), 0.01);
  EXPECT_NEAR(gloss(0.4), 0.6 * gloss(0.0), 1e-12);
  EXPECT_NEAR(gloss(1.0), 0.0, 1e-12);
}

TEST(OpticalModel, FalloffDimsAllThatALampLights)
{
  LightSettings light;
  light.wetness = 0.1;
  light.specular = 0.1;
  light.falloff = 30.0;
  EXPECT_TRUE(lit(light, 0.9, 30.0, 1.0).isApprox(0.5 * lit(light, 0.9, 0.0, 1.0), 1e-12));
  EXPECT_TRUE(optics::interiorColor(kColor, light, 30.0)
                  .isApprox(0.5 * optics::interiorColor(kColor, light, 0.0), 1e-12));
}

TEST(OpticalModel, InsideATissueLightComesAtTheMeanCosine)
{
  LightSettings light;
  light.ambient = 0.25;
  // The mean cosine of a Lambertian exit, 2 pi integral cos^2 sin / pi, is 2/3.
  EXPECT_TRUE(optics::interiorColor(kColor, light, 7.0)
                  .isApprox((0.25 + 0.75 * 2.0 / 3.0) * kColor, 1e-12));
}

TEST(OpticalModel, OnlyWhatIsDisplayedLiesBetweenZeroAndOne)
{
  LightSettings light;
  light.intensity = 5.0;
  light.wetness = 1.0;
  const Eigen::Vector3d bright = lit(light, 1.0, 0.0, 1.0);
  const Eigen::Vector3d diffuse = (1.0 - light.specular) * kColor;
  EXPECT_TRUE(bright.isApprox(5.0 * (diffuse + Eigen::Vector3d::Ones()), 1e-12));
  EXPECT_EQ(optics::displayed(bright, light), Eigen::Vector3d::Ones());
  light.toneCurve = true;
  EXPECT_LT(optics::displayed(bright, light).maxCoeff(), 1.0);
  light.intensity = -1.0;
  EXPECT_EQ(optics::displayed(lit(light, 1.0), light), Eigen::Vector3d::Zero());
}

// Of a quarter of a pixel no more than a quarter is added, whatever its light.
TEST(OpticalModel, APartOfAPixelIsDisplayedAsItsMeanColour)
{
  LightSettings light;
  using Color = Eigen::Vector3d;
  EXPECT_TRUE(optics::displayed({0.1, 0.2, 3.0}, 0.25, light).isApprox(Color(0.1, 0.2, 0.25)));
  EXPECT_EQ(optics::displayed({0.1, 0.2, 3.0}, 1.0, light), Color(0.1, 0.2, 1.0));
  EXPECT_EQ(optics::displayed(Color::Zero(), 0.0, light), Color::Zero());
  light.toneCurve = true; // white of twice that light: 1 - 0.04 / (2 - 0.6)
  EXPECT_TRUE(optics::displayed(Color::Constant(0.5), 0.25, light)
                  .isApprox(Color::Constant(0.25 * (1.0 - 0.04 / 1.4)), 1e-12));
}

// Noise says nothing of the side that a surface is seen from, a border says it all.
TEST(OpticalModel, EdgesCountAsFarAsTheImageChanges)
{
  EXPECT_EQ(optics::edgeFacing(0.1, 0.0), 1.0);
  EXPECT_NEAR(optics::edgeFacing(-0.2, optics::kEdgeSlope), 0.6, 1e-12);
  EXPECT_NEAR(optics::edgeFacing(0.2, 3.0 * optics::kEdgeSlope), 1.0 - 0.9 * 0.8, 1e-12);
  EXPECT_EQ(optics::edgeFacing(1.0, 400.0), 1.0);
  EXPECT_NEAR(optics::edgeFacing(0.0, 1e5), 0.0, 1e-5);
}

TEST(OpticalModel, ASampleOfACoarseCtIsLitFromAside)
{
  const auto aside = [](double spacing, int sample)
  {
    const core::GridGeometry grid({8, 8, 8}, {spacing, spacing, 2.0}, {0.0, 0.0, 0.0},
                                  Eigen::Matrix3d::Identity());
    return optics::asideOf(grid, sample);
  };
  EXPECT_TRUE(aside(1.0, -1).isZero());
  EXPECT_TRUE(aside(0.15, 3).isZero());
  EXPECT_TRUE(aside(0.3, 3).isZero());
  EXPECT_TRUE(aside(1.0, 3).isApprox(Eigen::Vector3d::Constant(0.75)));
  EXPECT_TRUE(aside(0.5, 3).isApprox(Eigen::Vector3d::Constant(0.375)));
}

TEST(OpticalModel, WhatIsAsideLightsASurfaceOnlyIfItIsAlike)
{
  const Eigen::Vector3d ray(0.0, 0.0, 1.0);
  const auto tilted = [](double degrees) -> Eigen::Vector3d
  {
    const double angle = degrees * 3.14159265358979323846 / 180.0;
    return 200.0 * Eigen::Vector3d(std::sin(angle), 0.0, std::cos(angle));
  };
  const double here = std::cos(3.14159265358979323846 / 6.0);
  const Eigen::Vector3d usual = optics::kAsideSlope * tilted(10.0);
  EXPECT_NEAR(optics::asideFacing(tilted(30.0), usual, ray), 0.98480775, 1e-8);
  EXPECT_NEAR(optics::asideFacing(tilted(30.0), 0.5 * usual, ray), 0.5 * (here + 0.98480775), 1e-8)
      << "what is small is less certain";
  EXPECT_EQ(optics::asideFacing(tilted(30.0), 9.0 * usual, ray), 1.0);
  EXPECT_NEAR(optics::asideFacing(tilted(30.0), tilted(-60.0), ray), here, 1e-12) << "an edge";
  EXPECT_NEAR(optics::asideFacing(tilted(30.0), tilted(170.0), ray), here, 1e-12)
      << "the other side of a plate";
  EXPECT_NEAR(optics::asideFacing(tilted(30.0), Eigen::Vector3d::Zero(), ray), here, 1e-12);
  EXPECT_EQ(optics::asideFacing(Eigen::Vector3d::Zero(), tilted(0.0), ray), 1.0);
  // Half-way between kUnlike and kAlike.
  const double apart = std::acos(0.75);
  const Eigen::Vector3d half(std::sin(apart), 0.0, std::cos(apart));
  EXPECT_NEAR(optics::asideFacing(ray, optics::kAsideSlope * half, ray), 0.5 * (1.0 + 0.75), 1e-12);
}

// Values of its equation in another program (Python, with whole numbers of any length).
TEST(OpticalModel, GrainIsThatOfItsEquation)
{
  EXPECT_EQ(optics::grainNoise({0.0, 0.0, 0.0}), -1.0);
  EXPECT_EQ(optics::grainNoise({1.0, 0.0, 0.0}), 0.2902712821960449);
  EXPECT_EQ(optics::grainNoise({17.0, 201.0, 5.0}), -0.43672049045562744);
  EXPECT_EQ(optics::grainNoise({2000.0, 3.0, 999.0}), -0.16250836849212646);
  // Half way between two corners, and by the smoothstep of a quarter.
  const double first = optics::grainNoise({0.0, 0.0, 0.0});
  const double next = optics::grainNoise({1.0, 0.0, 0.0});
  EXPECT_NEAR(optics::grainNoise({0.5, 0.0, 0.0}), 0.5 * (first + next), 1e-12);
  EXPECT_NEAR(optics::grainNoise({0.25, 0.0, 0.0}), first + 0.15625 * (next - first), 1e-12);
}

// Uniform numbers from -1 to 1 have the mean 0 and the variance 1/3; those of neighbours along an
// axis or a diagonal are independent. 32^3 of them: bounds of four standard errors and more.
TEST(OpticalModel, GrainHasNeitherABiasNorAPattern)
{
  constexpr int kSide = 32;
  double sum = 0.0;
  double squares = 0.0;
  const Eigen::Vector3d steps[] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 0}, {1, -1, 1}};
  std::array<double, 5> products{};
  for (int n = 0; n < kSide * kSide * kSide; ++n)
  {
    const Eigen::Vector3d at(100 + n % kSide, 50 + n / kSide % kSide, 10 + n / kSide / kSide);
    const double value = optics::grainNoise(at);
    EXPECT_LE(std::abs(value), 1.0);
    sum += value;
    squares += value * value;
    for (std::size_t s = 0; s < products.size(); ++s)
      products[s] += value * optics::grainNoise(at + steps[s]);
  }
  const double count = kSide * kSide * kSide;
  EXPECT_NEAR(sum / count, 0.0, 0.015);
  EXPECT_NEAR(squares / count, 1.0 / 3.0, 0.01);
  for (const double product : products)
    EXPECT_NEAR(product / count, 0.0, 0.01);
}

// A pixel has nearly the mean of what it covers, whatever its size: then the picture does not
// flicker when it moves by a part of a pixel.
TEST(OpticalModel, GrainIsNoFinerThanAPixelShows)
{
  const core::GridGeometry grid({400, 400, 400}, {0.25, 0.25, 0.25}, {0.0, 0.0, 0.0});
  const auto factor = [&](double x, double y, double pixel) {
    return optics::grainFactor(grid, {x, y, 10.3}, 1.0, pixel, 1.0);
  }; // a voxel is a cell
  for (const double cells : {0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 1.0, 3.0})
  {
    const double pixel = cells * 0.25;
    double squares = 0.0;
    constexpr int kPixels = 40;
    for (int n = 0; n < kPixels * kPixels; ++n)
    {
      const double x = 20.0 + 1.37 * (n % kPixels);
      const double y = 20.0 + 1.71 * (n / kPixels);
      double mean = 0.0;
      constexpr int kParts = 8;
      for (int part = 0; part < kParts * kParts; ++part)
        mean += factor(x + cells * ((part % kParts + 0.5) / kParts - 0.5),
                       y + cells * ((part / kParts + 0.5) / kParts - 0.5), pixel) /
                (kParts * kParts);
      squares += std::pow(factor(x, y, pixel) - mean, 2.0);
    }
    EXPECT_LE(std::sqrt(squares / (kPixels * kPixels)), 0.008) << cells << " cells in a pixel";
  }
}

// Values of its equation in another program (numpy).
TEST(OpticalModel, GrainFadesWithThePixelsItCovers)
{
  const core::GridGeometry grid({64, 64, 64}, {0.5, 0.5, 0.5}, {0.0, 0.0, 0.0});
  const Eigen::Vector3d voxel(8.5, 3.0, 4.0);
  const auto at = [&](double cosine, double pixel, double grain)
  { return optics::grainFactor(grid, voxel, cosine, pixel, grain); };
  EXPECT_NEAR(at(1.0, 0.05, 1.0), 1.0449674222181133, 1e-12);
  EXPECT_NEAR(at(-1.0, 0.05, 0.5), 1.0224837111090566, 1e-12);
  EXPECT_NEAR(at(1.0, 0.1, 1.0), 1.0279675516543698, 1e-12) << "half a cell of the fine octave";
  EXPECT_EQ(at(1.0, 0.24, 1.0), 1.0);
  EXPECT_EQ(at(0.2, 0.05, 1.0), 1.0) << "a pixel covers five times as much from the side";
  EXPECT_EQ(at(0.5, 0.05, 0.0), 1.0);
  const core::GridGeometry other({200, 64, 64}, {0.3, 0.3, 0.6}, {-20.0, 7.0, 3.0});
  const Eigen::Vector3d there(100.25, 7.5, 41.0);
  EXPECT_NEAR(optics::grainFactor(other, there, 0.5, 0.04, 1.0), 1.0164772102828374, 1e-12);
  EXPECT_NEAR(optics::grainFactor(other, there, 1.0, 0.16, 1.0), 0.9942824424420056, 1e-12)
      << "the coarse octave alone";
}

// Seen along an axis of the CT, as in anatomical views, a lattice along the axes shows as squares:
// half way between its planes the noise varies half as much as on them.
TEST(OpticalModel, GrainShowsNoLatticeAlongTheAxesOfTheCt)
{
  const core::GridGeometry grid({400, 400, 400}, {0.25, 0.25, 0.25}, {0.0, 0.0, 0.0});
  constexpr int kPoints = 60000;
  constexpr std::size_t kBins = 8;
  std::vector<Eigen::Vector3d> points;
  std::vector<double> noise;
  std::uint64_t state = 11;
  const auto uniform = [&state]
  { return static_cast<double>(core::splitMix64(state++) >> 11) / 9007199254740992.0; };
  for (int n = 0; n < kPoints; ++n)
  {
    points.emplace_back(20.0 + 40.0 * uniform(), 20.0 + 40.0 * uniform(), 20.0 + 40.0 * uniform());
    noise.push_back(optics::grainFactor(grid, points.back() / 0.25, 1.0, 0.01, 1.0) - 1.0);
  }
  const auto spread = [&](const std::vector<double>& values, double cell, int axis)
  {
    std::array<double, kBins> squares{};
    std::array<double, kBins> counts{};
    for (std::size_t n = 0; n < values.size(); ++n)
    {
      const double within = points[n][axis] / cell - std::floor(points[n][axis] / cell);
      const auto bin = std::min(static_cast<std::size_t>(kBins * within), kBins - 1);
      squares[bin] += values[n] * values[n];
      counts[bin] += 1.0;
    }
    for (std::size_t bin = 0; bin < kBins; ++bin)
      squares[bin] /= counts[bin];
    return *std::max_element(squares.begin(), squares.end()) /
           *std::min_element(squares.begin(), squares.end());
  };
  std::vector<double> straight; // the lattice of an octave without its turn
  for (const Eigen::Vector3d& point : points)
    straight.push_back(optics::grainNoise(point / optics::kGrainCells[1]));
  for (int axis = 0; axis < 3; ++axis)
  {
    for (const double cell : optics::kGrainCells)
      EXPECT_LT(spread(noise, cell, axis), 1.15) << cell << " mm, axis " << axis;
    EXPECT_GT(spread(straight, optics::kGrainCells[1], axis), 1.6) << "what the bound is for";
  }
}

// A shell of opacity 0.12 is passed twice as long at 60 degrees.
TEST(OpticalModel, ATranslucentSurfaceIsAsOpaqueFromTheSideAsAShell)
{
  EXPECT_NEAR(optics::edgeOpacity(0.12, 0.5, 1.0), 1.0 - 0.88 * 0.88, 1e-12);
  EXPECT_NEAR(optics::edgeOpacity(0.12, -0.25, 1.0), 1.0 - std::pow(0.88, 4.0), 1e-12);
  EXPECT_NEAR(optics::edgeOpacity(0.12, 0.5, 0.5), 1.0 - std::pow(0.88, 1.5), 1e-12);
  EXPECT_NEAR(optics::edgeOpacity(0.12, 1.0, 1.0), 0.12, 1e-12);
  EXPECT_EQ(optics::edgeOpacity(0.12, 0.1, 0.0), 0.12); // to the bit
  EXPECT_EQ(optics::edgeOpacity(1.0, 0.1, 1.0), 1.0);
  EXPECT_EQ(optics::edgeOpacity(0.0, 0.0, 1.0), 0.0);
  double before = 0.0;
  for (const double cosine : {1.0, 0.7, 0.3, 0.1, 0.02, 0.0})
  {
    const double opacity = optics::edgeOpacity(0.12, cosine, 1.0);
    EXPECT_GE(opacity, before);
    EXPECT_LE(opacity, 1.0 - std::pow(0.88, 8.0) + 1e-12); // that of 83 degrees
    before = opacity;
  }
}
