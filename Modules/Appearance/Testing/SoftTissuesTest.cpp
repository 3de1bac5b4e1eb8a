#include "petrous/Appearance/SoftTissues.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "petrous/Appearance/StructurePresets.h"
#include "petrous/Core/Error.h"
#include "petrous/Core/NumberText.h"

using namespace petrous;
using namespace petrous::appearance;

namespace
{

constexpr double kPi = 3.14159265358979323846;

// Of a ball on an incompressible half-space, from the pressure that Hertz gives: the contact has
// the radius c, c^2 = R d, and carries p0 sqrt(1 - r^2/c^2), p0 = 2 E* c / (pi R). Integrated here.
double hertzForce(double modulus, double radius, double depth)
{
  const double c = std::sqrt(radius * depth);
  const double effective = modulus / 0.75;
  const double peak = 2.0 * effective * c / (kPi * radius);
  constexpr int kRings = 20000;
  double force = 0.0;
  for (int n = 0; n < kRings; ++n)
  {
    const double r = c * (n + 0.5) / kRings;
    force += peak * std::sqrt(1.0 - r * r / (c * c)) * 2.0 * kPi * r * c / kRings;
  }
  return force;
}

// Deflection under the load of the clamped plate, from its equation D (r ((r w')' / r)')' / r = 0
// off the middle with the shear force F / (2 pi r): two integrations of (1/r (r w')')' = F / (2 pi
// r D), w'(a) = w(a) = 0, w' -> 0 at the middle. The slope w' = F r / (4 pi D) ln(r / a),
// integrated here.
double plateDeflection(double force, double modulus, double thickness, double radius)
{
  const double rigidity = modulus * std::pow(thickness, 3) / 9.0;
  constexpr int kSteps = 20000;
  double deflection = 0.0;
  for (int n = 0; n < kSteps; ++n)
  {
    const double r = radius * (n + 0.5) / kSteps;
    deflection -= force * r / (4.0 * kPi * rigidity) * std::log(r / radius) * radius / kSteps;
  }
  return deflection;
}

} // namespace

TEST(SoftTissues, IndentationIsThatOfHertzPressure)
{
  for (const double modulus : {0.001, 0.04, 2.0})
    for (const double radius : {0.5, 2.0, 3.5})
      for (const double depth : {0.1, 0.5})
      {
        const double force = hertzForce(modulus, radius, depth);
        EXPECT_NEAR(indentationStiffness(modulus, radius, depth), force / depth,
                    1e-4 * force / depth);
      }
}

TEST(SoftTissues, AMembraneYieldsAsAClampedPlate)
{
  for (const double modulus : {0.5, 68.1})
    for (const double thickness : {0.36, 1.0})
      for (const double radius : {2.5, 5.0})
        EXPECT_NEAR(plateStiffness(modulus, thickness, radius) *
                        plateDeflection(1.0, modulus, thickness, radius),
                    1.0, 1e-4);
}

TEST(SoftTissues, WhatIsNoContactIsRefused)
{
  for (const double wrong : {0.0, -1.0, std::nan(""), HUGE_VAL})
  {
    EXPECT_THROW(indentationStiffness(wrong, 2.0, 0.5), core::InvalidParameter) << wrong;
    EXPECT_THROW(indentationStiffness(1.0, wrong, 0.5), core::InvalidParameter) << wrong;
    EXPECT_THROW(indentationStiffness(1.0, 2.0, wrong), core::InvalidParameter) << wrong;
    EXPECT_THROW(plateStiffness(wrong, 1.0, 2.5), core::InvalidParameter) << wrong;
    EXPECT_THROW(plateStiffness(1.0, wrong, 2.5), core::InvalidParameter) << wrong;
    EXPECT_THROW(plateStiffness(1.0, 1.0, wrong), core::InvalidParameter) << wrong;
  }
}

// No value is passed as measured, and a stated factor covers the range of what was published.
TEST(SoftTissues, EachSaysWithinWhichFactorItIsKnown)
{
  ASSERT_GE(softTissues().size(), 5u);
  const std::string derived = "derived, within a factor of ";
  for (const SoftTissue& one : softTissues())
  {
    EXPECT_GE(one.lowest, 0.001) << one.name;
    EXPECT_LE(one.lowest, one.stiffness) << one.name;
    EXPECT_LE(one.stiffness, one.highest) << one.name;
    EXPECT_LE(one.highest, 100.0) << one.name;
    EXPECT_FALSE(one.status.empty()) << one.name;
    EXPECT_EQ(findSoftTissue(one.name), &one);
    if (one.certainty == "assumption")
      continue;
    ASSERT_EQ(one.certainty.find(derived), 0u) << one.name;
    const auto factor = core::parseDouble(one.certainty.substr(derived.size()));
    ASSERT_TRUE(factor) << one.certainty;
    const double spread = std::max(one.stiffness / one.lowest, one.highest / one.stiffness);
    EXPECT_LE(spread, *factor) << one.name;
    EXPECT_GT(spread, 0.5 * *factor) << one.name << ": the factor is not overstated either";
  }
  EXPECT_EQ(findSoftTissue("cartilage"), nullptr);
}

// The middle values, from the numbers that their rows name, in MPa, mm, m/s and kg/m^3.
TEST(SoftTissues, MiddleValuesFollowFromTheSourcesThatAreNamed)
{
  const auto expectSolid = [](const char* name, double modulus)
  {
    const double stiffness = hertzForce(modulus, 2.0, 0.5) / 0.5;
    EXPECT_NEAR(findSoftTissue(name)->stiffness, stiffness, 0.05 * stiffness) << name;
  };
  expectSolid("nerve", 3.0 * 12.9e-3);
  expectSolid("brain", 3.0 * 1.54e-3);
  expectSolid("muscle", 3.0 * 1050.0 * std::pow(0.5 * (1.0 + 4.1), 2) * 1e-6);
  expectSolid("fat", std::sqrt(3.0 * 0.53e-3 * 26.1e-3));
  const double artery = 1.0 / plateDeflection(1.0, std::sqrt(0.40 * 1.50), 1.0, 2.5);
  EXPECT_NEAR(findSoftTissue("artery")->stiffness, artery, 0.05 * artery);
  const double dura = 1.0 / plateDeflection(1.0, 68.1, std::sqrt(0.36 * 0.68), 5.0);
  EXPECT_NEAR(findSoftTissue("dura")->stiffness, dura, 0.05 * dura);
}

// Whoever wants a structure to yield says so.
TEST(SoftTissues, NoPresetYieldsByItself)
{
  const auto presets = StructurePresets::builtIn();
  for (const auto& look : presets.all())
    EXPECT_EQ(look.stiffness, 0.0) << look.preset;
}

TEST(SoftTissues, AWrongTableIsRefusedByItsName)
{
  const auto refusal = [](const std::string& text)
  {
    try
    {
      parseSoftTissues(text, "T");
    }
    catch (const core::InvalidParameter& error)
    {
      return std::string(error.what());
    }
    return std::string("taken");
  };
  const auto row = [](const std::string& modulus, const std::string& contact)
  {
    return R"({"soft_tissues": [{"name": "x", "title": "X", "certainty": "assumption", "status": "s",
      "contact": ")" +
           contact + R"(", "modulus_kpa": )" + modulus + "}]}";
  };
  EXPECT_EQ(refusal(row("[1, 2, 3]", "solid")), "taken");
  EXPECT_NE(refusal(row("[2, 1, 3]", "solid")).find("T: 'modulus_kpa'"), std::string::npos);
  EXPECT_NE(refusal(row("[0, 1, 3]", "solid")).find("T: 'modulus_kpa'"), std::string::npos);
  EXPECT_EQ(refusal(row("[1, 2, 3]", "fluid")),
            "T: there is no contact 'fluid'; there are solid and membrane");
  EXPECT_EQ(refusal(row("[1, 2, 3]", "membrane")), "T: not a table of soft tissues")
      << "without its thickness";
  EXPECT_EQ(refusal("{"), "T: not a table of soft tissues");
}
