#include "OpticalModel.h"

#include <gtest/gtest.h>

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

TEST(OpticalModel, HighlightIsOfTheTransferFunctionTimesTheLamps)
{
  LightSettings light;
  light.specular = 0.3;
  const double cosine = 0.95;
  const Eigen::Vector3d added = lit(light, cosine, 0.0, 0.5) - lit(light, cosine, 0.0, 0.0);
  const double expected = 0.5 * 0.3 * std::exp(kShininess * std::log(cosine));
  EXPECT_TRUE(added.isApprox(Eigen::Vector3d::Constant(expected), 1e-12));
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

TEST(OpticalModel, NoColorLeavesZeroToOne)
{
  LightSettings light;
  light.intensity = 5.0;
  light.wetness = 1.0;
  EXPECT_LE(lit(light, 1.0, 0.0, 1.0).maxCoeff(), 1.0);
  EXPECT_LE(optics::interiorColor(Eigen::Vector3d::Ones(), light, 0.0).maxCoeff(), 1.0);
  light.intensity = -1.0;
  EXPECT_GE(lit(light, 1.0).minCoeff(), 0.0);
}
