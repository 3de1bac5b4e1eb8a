#include <gtest/gtest.h>

#include <cmath>

#include "petrous/Appearance/AppearanceMaterial.h"
#include "petrous/Appearance/StructurePresets.h"
#include "petrous/Core/Error.h"

using namespace petrous::appearance;
using petrous::volume::IntensityScale;

namespace
{

std::vector<double> valuesOf(const TransferFunction& transfer)
{
  std::vector<double> values;
  for (const ControlPoint& point : transfer.points())
    values.push_back(point.value);
  return values;
}

TransferFunction twoPoints()
{
  return TransferFunction(
      {{300.0, {0.8F, 0.6F, 0.4F}, 0.2F, 0.3F}, {1800.0, {1.0F, 0.9F, 0.8F}, 0.8F, 1.0F}});
}

} // namespace

TEST(AppearanceMaterial, PresetsHaveIsoAtIsoAndDenseBoneAtDenseBone)
{
  const IntensityScale microCt{9000.0, 21000.0, false};
  EXPECT_DOUBLE_EQ(onScale(300.0, microCt), 9000.0);
  EXPECT_DOUBLE_EQ(onScale(1800.0, microCt), 21000.0);
  EXPECT_DOUBLE_EQ(onScale(1050.0, microCt), 15000.0);
  EXPECT_DOUBLE_EQ(onScale(-77.0, IntensityScale{}), -77.0);
}

TEST(AppearanceMaterial, PresetsKeepTheirOrderWhereDenseBoneIsBelowTheSurface)
{
  const IntensityScale odd{2000.0, 1800.0};
  EXPECT_DOUBLE_EQ(onScale(300.0, odd), 2000.0);
  EXPECT_DOUBLE_EQ(onScale(1800.0, odd), 3500.0);
}

TEST(AppearanceMaterial, StretchesPresetsAndLeavesAbsoluteValuesAlone)
{
  StructureAppearance look;
  look.transfer = twoPoints();
  const IntensityScale scale{10.0, 40.0};
  EXPECT_EQ(valuesOf(materialOf(look, scale).transfer), (std::vector<double>{300.0, 1800.0}));
  look.relative = true;
  EXPECT_EQ(valuesOf(materialOf(look, scale).transfer), (std::vector<double>{10.0, 40.0}));
}

TEST(AppearanceMaterial, IsOneColourWithoutATransferFunction)
{
  StructureAppearance look;
  look.color = {0.1F, 0.2F, 0.3F};
  look.shininess = 33.0F;
  Material material = materialOf(look);
  for (const double value : {-1000.0, 0.0, 3000.0})
  {
    EXPECT_FLOAT_EQ(float(material.transfer.at(value).color[2]), 0.3F);
    EXPECT_NEAR(std::exp(-material.transfer.at(value).extinction), 0.05, 1e-6) << "nearly opaque";
  }
  EXPECT_EQ(material.surfaceOpacity, 1.0F);
  EXPECT_EQ(material.shininess, 33.0F);
  EXPECT_FALSE(material.lumen);
  look.opacity = 0.5F;
  material = materialOf(look);
  EXPECT_EQ(material.surfaceOpacity, 0.5F);
  EXPECT_NEAR(std::exp(-material.transfer.at(0.0).extinction), 1.0 - 0.475, 1e-6);
}

TEST(AppearanceMaterial, ReadsAnMrOnlyByValuesMadeForIt)
{
  StructureAppearance look;
  look.transfer = twoPoints();
  look.sourceImage = "t2";
  EXPECT_EQ(materialOf(look).source, IntensitySource::Second);
  EXPECT_EQ(materialOf(look).transfer, twoPoints());
  look.relative = true; // made for CT
  EXPECT_EQ(materialOf(look).transfer.points().size(), 1u);
  EXPECT_EQ(materialOf(look).source, IntensitySource::Ct);
}

TEST(AppearanceMaterial, ALumenTintsItsWallAndLeavesItAsOpaqueAsBone)
{
  StructureAppearance bone;
  bone.transfer = twoPoints();
  bone.opacity = 0.9F;
  StructureAppearance lumen;
  lumen.solid = false;
  lumen.color = {0.0F, 0.0F, 1.0F};
  lumen.opacity = 0.25F;
  const Material wall = materialOf(bone);
  const Material material = lumenMaterial(lumen, wall);
  EXPECT_TRUE(material.lumen);
  EXPECT_EQ(material.surfaceOpacity, 0.9F);
  for (const double value : {300.0, 1000.0, 1800.0})
  {
    EXPECT_NEAR(material.transfer.at(value).color[0], 0.75 * wall.transfer.at(value).color[0],
                1e-6);
    EXPECT_NEAR(material.transfer.at(value).color[2],
                0.75 * wall.transfer.at(value).color[2] + 0.25, 1e-6);
    EXPECT_NEAR(material.transfer.at(value).extinction, wall.transfer.at(value).extinction, 1e-5);
  }
}

namespace
{

// Of 1 mm, as TransferFunction has it.
double transmittance(const TransferFunction& transfer, double value, double millimetres)
{
  return std::exp(-transfer.at(value).extinction * millimetres);
}

} // namespace

// ADR 38: what must be looked through, and that of the border of skin and air is seen.
TEST(SoftTissueMaterial, LetsTheSkullBeSeenThroughScalpAndMuscle)
{
  const StructureAppearance look = softTissueLook();
  EXPECT_FALSE(look.shown);
  EXPECT_FALSE(look.touchable || look.drillable);
  EXPECT_EQ(look.tissue, "");
  const auto material = softTissueMaterial(look);
  ASSERT_TRUE(material);
  const TransferFunction& transfer = material->transfer;
  EXPECT_EQ(transfer.at(-1000.0).extinction, 0.0) << "air";
  EXPECT_EQ(transfer.at(-700.0).extinction, 0.0);
  EXPECT_NEAR(transmittance(transfer, 40.0, 1.0), 1.0 - 0.045, 1e-6);
  EXPECT_NEAR(transmittance(transfer, 40.0, 15.0), 0.5, 0.02) << "muscle";
  EXPECT_GT(transmittance(transfer, -100.0, 20.0), 0.6) << "fat";
  EXPECT_LT(transmittance(transfer, 40.0, 100.0), 0.05) << "brain hides the other side";
}

TEST(SoftTissueMaterial, FollowsTheScaleOfAConeBeam)
{
  const StructureAppearance look = softTissueLook();
  const IntensityScale scale{4000.0 + 8.0 * 300.0, 4000.0 + 8.0 * 1800.0, false}; // 4000 + 8 HU
  const auto values = valuesOf(softTissueMaterial(look, scale)->transfer);
  const auto& points = look.transfer->points();
  ASSERT_EQ(values.size(), points.size());
  for (std::size_t n = 0; n < values.size(); ++n)
    EXPECT_NEAR(values[n], 4000.0 + 8.0 * points[n].value, 1e-6);
}

TEST(SoftTissueMaterial, ScalesTheOpacityOfItsFunction)
{
  StructureAppearance look = softTissueLook();
  look.opacity = 0.5F;
  EXPECT_NEAR(transmittance(softTissueMaterial(look)->transfer, 40.0, 1.0), 1.0 - 0.0225, 1e-6);
  look.opacity = 0.0F;
  EXPECT_FALSE(softTissueMaterial(look)) << "nothing to draw";
}

TEST(SoftTissueMaterial, DrawsNoAir)
{
  StructureAppearance look = softTissueLook();
  look.relative = false;
  look.transfer = TransferFunction(
      {{-100.0, {1.0F, 0.0F, 0.0F}, 0.4F, 0.2F}, {100.0, {1.0F, 0.0F, 0.0F}, 0.6F, 0.2F}});
  const auto material = softTissueMaterial(look);
  ASSERT_TRUE(material);
  EXPECT_EQ(material->transfer.at(-110.0).extinction, 0.0) << "a twentieth of 200 HU below";
  EXPECT_EQ(material->transfer.at(-1000.0).extinction, 0.0);
  EXPECT_EQ(material->transfer.at(-100.0).extinction, look.transfer->at(-100.0).extinction);
  EXPECT_EQ(material->transfer.at(50.0).extinction, look.transfer->at(50.0).extinction);
  look.transfer = TransferFunction::constant({1.0F, 0.0F, 0.0F}, 0.1F);
  EXPECT_FALSE(softTissueMaterial(look));
  look.transfer.reset();
  EXPECT_FALSE(softTissueMaterial(look));
}

TEST(SoftTissueMaterial, OfAnMrHasAFunctionOfItsValues)
{
  StructureAppearance look = softTissueLook();
  look.sourceImage = "t2";
  EXPECT_FALSE(softTissueMaterial(look)) << "of a preset that is made for CT";
  look.transfer = softTissueOfMr({100.0, 900.0, false});
  look.relative = false;
  const auto material = softTissueMaterial(look);
  ASSERT_TRUE(material);
  EXPECT_EQ(material->source, IntensitySource::Second);
  EXPECT_EQ(material->transfer.at(100.0).extinction, 0.0) << "below the patient's surface";
  EXPECT_NEAR(transmittance(material->transfer, 900.0, 1.0), 0.9, 1e-6);
  const auto dark = material->transfer.at(200.0).color, bright = material->transfer.at(800.0).color;
  EXPECT_EQ(dark[0], dark[2]) << "grey";
  EXPECT_LT(dark[0], bright[0]);
  applySoftTissuePreset(look, StructurePresets::builtIn().preset("skin"));
  EXPECT_EQ(look.sourceImage, "") << "made for CT";
  EXPECT_EQ(look.tissue, "");
  EXPECT_FALSE(look.touchable || look.drillable);
  look.sourceImage = "t2";
  readPrimaryImage(look);
  EXPECT_EQ(look.sourceImage, "");
  EXPECT_EQ(look.transfer, softTissueLook().transfer);
  EXPECT_TRUE(look.relative);
}

TEST(StructureAppearance, AnotherColourKeepsTheShadesOfItsTransferFunction)
{
  StructureAppearance look;
  look.color = {0.5F, 0.5F, 0.5F};
  look.transfer = TransferFunction({{0.0, {0.25F, 0.25F, 0.25F}, 0.1F, 0.2F},
                                    {100.0, {0.5F, 0.5F, 0.5F}, 0.3F, 0.4F},
                                    {200.0, {1.0F, 1.0F, 1.0F}, 0.5F, 0.6F}});
  setColor(look, {0.8F, 0.4F, 0.0F});
  const auto& points = look.transfer->points();
  EXPECT_NEAR(points[0].color[0], 0.4F, 1e-6F);
  EXPECT_NEAR(points[1].color[1], 0.4F, 1e-6F);
  EXPECT_EQ(points[2].color[0], 1.0F) << "held at white";
  EXPECT_EQ(points[2].opacity, 0.5F);
  EXPECT_THROW(setColor(look, {0.0F, 1.5F, 0.0F}), petrous::core::InvalidParameter);
}

TEST(StructureAppearance, TheColourThatItHasChangesNothing)
{
  StructureAppearance look;
  look.color = {0.97F, 0.87F, 0.45F};
  look.transfer = TransferFunction(
      {{0.0, {0.31F, 0.29F, 0.17F}, 0.1F, 0.2F}, {100.0, {0.7F, 0.63F, 0.33F}, 0.3F, 0.4F}});
  setColor(look, {0.2F, 0.9F, 0.6F});
  const StructureAppearance once = look;
  setColor(look, {0.2F, 0.9F, 0.6F});
  EXPECT_TRUE(look.color == once.color && look.transfer == once.transfer);
}

TEST(StructureAppearance, APresetChangesTheLookAndNotWhatTheHandMayDo)
{
  StructureAppearance look;
  setFlags(look, "touchable");
  look.sourceImage = "t2";
  applyPreset(look, StructurePresets::builtIn().preset("nerve"));
  EXPECT_EQ(look.preset, "nerve");
  EXPECT_TRUE(look.transfer.has_value());
  EXPECT_EQ(flagsOf(look), "touchable");
  EXPECT_EQ(look.sourceImage, "t2");
}
