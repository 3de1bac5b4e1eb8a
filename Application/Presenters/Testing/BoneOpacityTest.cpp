#include "petrous/Presenters/BoneOpacity.h"

#include <cmath>

#include <gtest/gtest.h>

#include "petrous/Appearance/StructurePresets.h"

using namespace petrous;
using appearance::StructureAppearance;

namespace
{
StructureAppearance preset(const char* name)
{
  return appearance::StructurePresets::builtIn().preset(name);
}
} // namespace

TEST(BoneOpacity, MeetsThePresetsOnItsWay)
{
  const StructureAppearance start = appearance::boneLook();
  const StructureAppearance translucent = preset("bone-translucent");
  const StructureAppearance there =
      presenters::withOpacity(start, static_cast<double>(translucent.opacity));
  ASSERT_EQ(there.transfer->points().size(), translucent.transfer->points().size());
  for (std::size_t i = 0; i < there.transfer->points().size(); ++i)
    EXPECT_NEAR(there.transfer->points()[i].opacity, translucent.transfer->points()[i].opacity,
                1e-6F);
  const StructureAppearance back = presenters::withOpacity(there, 1.0);
  EXPECT_TRUE(*back.transfer == *start.transfer);
  EXPECT_EQ(back.opacity, 1.0F);
}

TEST(BoneOpacity, TwiceAsOpaqueIsTwiceTheExtinction)
{
  const StructureAppearance translucent = preset("bone-translucent");
  const StructureAppearance look = presenters::withOpacity(
      appearance::boneLook(), 2.0 * static_cast<double>(translucent.opacity));
  const double once = -std::log(1.0 - translucent.transfer->points().back().opacity);
  EXPECT_NEAR(-std::log(1.0 - look.transfer->points().back().opacity), 2.0 * once, 1e-6);
}

TEST(BoneOpacity, LeavesOwnValuesColourAndFlags)
{
  StructureAppearance own = appearance::boneLook();
  own.transfer = appearance::TransferFunction::constant({0.2F, 0.3F, 0.4F}, 0.3F);
  own.relative = false;
  own.drillable = false;
  const StructureAppearance half = presenters::withOpacity(own, 0.5);
  EXPECT_TRUE(*half.transfer == *own.transfer);
  EXPECT_EQ(half.opacity, 0.5F);
  EXPECT_FALSE(half.drillable);

  StructureAppearance green = appearance::boneLook();
  setColor(green, {0.1F, 0.9F, 0.1F});
  EXPECT_EQ(presenters::withOpacity(green, 0.3).color, green.color);
}
