#include "petrous/Dissection/RemovalLaw.h"

#include <cmath>
#include <functional>
#include <random>
#include <string>

#include <gtest/gtest.h>

#include "petrous/Core/Error.h"
#include "petrous/Core/NumberText.h"
#include "petrous/Dissection/BurrCatalogue.h"
#include "petrous/Dissection/BurrName.h"

using namespace petrous;
using dissection::AbrasiveWear;
using dissection::Burr;
using dissection::BurrCatalogue;
using dissection::BurrModel;
using dissection::MaterialCatalogue;
using dissection::OrthogonalCutting;
using dissection::TissueMaterial;
using dissection::wearOfGrit;

namespace
{

constexpr double kPi = 3.14159265358979323846;
constexpr double kDegree = kPi / 180.0;
constexpr double kMm3 = 1e9; // of a m^3

double turns(double rpm)
{
  return rpm * 2.0 * kPi / 60.0;
}

std::string materials(const std::string& energy, const std::string& friction,
                      const std::string& hardness)
{
  return R"({"materials":[{"name":"x","specific_cutting_energy_gpa":)" + energy +
         R"(,"friction":)" + friction + R"(,"vickers_hardness_hv":)" + hardness +
         R"(}],"bone":{"cellular":"x","cortical":"x","from_hu":300,"to_hu":1800}})";
}

std::string burrs(double rake)
{
  return R"({"burrs":[{"kind":"cutting","rake_deg":)" + core::fixedText(rake, 6) +
         R"(,"diameters_mm":[4]},{"kind":"diamond","wear_coefficient":0.1,"diameters_mm":[4]}]})";
}

std::string thrown(const std::function<void()>& call)
{
  try
  {
    call();
  }
  catch (const core::InvalidParameter& error)
  {
    return error.what();
  }
  return {};
}

} // namespace

// The force triangle: thrust and cutting force are the sum of the normal and friction forces on the
// tool face, with friction = mu normal. W_c dV = F_c dx [Chan2016, Eq. 6, 7] and w dV = F_t dx, so
// F_c = F_t W_c / w.
TEST(RemovalLaw, CuttingForceClosesTheForceTriangle)
{
  std::mt19937 random(3);
  std::uniform_real_distribution<double> share(0.0, 1.0);
  int checked = 0;
  for (int n = 0; n < 100000; ++n)
  {
    const double rake = (60.0 * share(random) - 45.0) * kDegree;
    const double friction = 1.5 * share(random);
    const double thrust = 0.1 + 10.0 * share(random);
    if (friction - std::tan(rake) < OrthogonalCutting::kMinDifference ||
        1.0 + friction * std::tan(rake) <= 0.0)
      continue;
    const double cutting = thrust * 3e9 / OrthogonalCutting(3e9, friction, rake).resistance();
    // Merchant: friction force F = Fc sin a + Ft cos a, normal force N = Fc cos a - Ft sin a.
    const double along = cutting * std::sin(rake) + thrust * std::cos(rake);
    const double normal = cutting * std::cos(rake) - thrust * std::sin(rake);
    EXPECT_NEAR(along, friction * normal, 1e-9 * (std::abs(along) + std::abs(normal)));
    ++checked;
  }
  EXPECT_GT(checked, 50000);
}

TEST(RemovalLaw, RatesAreThoseOfTheTable)
{
  // 5 mm burr, 70,000 rpm, 1 N, friction 0.5, rake -10 degrees.
  const auto cutting = [](double energy)
  {
    return kMm3 * 2.5e-3 * turns(70000) /
           OrthogonalCutting(energy, 0.5, -10 * kDegree).resistance();
  };
  EXPECT_NEAR(cutting(150e6), 165.0, 1.0);
  EXPECT_NEAR(cutting(2e9), 12.0, 0.5);
  EXPECT_NEAR(cutting(5e9), 5.0, 0.1);
  // Diamond, 4 mm, 60,000 rpm, 417 MPa, 1 N.
  const auto diamond = [](double k)
  { return kMm3 * 2e-3 * turns(60000) / AbrasiveWear(417e6, k).resistance(); };
  EXPECT_NEAR(diamond(0.05), 0.50, 0.005);
  EXPECT_NEAR(diamond(0.1), 1.00, 0.01);
  EXPECT_NEAR(diamond(0.2), 2.01, 0.01);
}

TEST(RemovalLaw, OutOfItsDomainIsRefused)
{
  EXPECT_THROW(OrthogonalCutting(0.0, 0.5, 0.0), core::InvalidParameter);
  EXPECT_THROW(OrthogonalCutting(-1e9, 0.5, 0.0), core::InvalidParameter);
  EXPECT_THROW(OrthogonalCutting(std::nan(""), 0.5, 0.0), core::InvalidParameter);
  EXPECT_THROW(OrthogonalCutting(3e9, 0.09, 0.0), core::InvalidParameter); // difference 0.09
  EXPECT_NO_THROW(OrthogonalCutting(3e9, 0.1, 0.0));
  EXPECT_THROW(OrthogonalCutting(3e9, 0.5, 25.0 * kDegree), core::InvalidParameter);
  EXPECT_THROW(OrthogonalCutting(3e9, 2.0, -30.0 * kDegree), core::InvalidParameter); // 1 + mu tan
  EXPECT_THROW(OrthogonalCutting(3e9, 0.5, -80.0 * kDegree), core::InvalidParameter);
  EXPECT_THROW(AbrasiveWear(0.0, 0.1), core::InvalidParameter);
  EXPECT_THROW(AbrasiveWear(4e8, 0.0), core::InvalidParameter);
  EXPECT_THROW(AbrasiveWear(4e8, 1.5), core::InvalidParameter);
}

TEST(MaterialCatalogue, EveryPairThatComesWithTheProgramIsInTheDomain)
{
  EXPECT_NO_THROW(checkPairs(MaterialCatalogue::builtIn(), BurrCatalogue::builtIn()));
  for (const char* name :
       {"cortical-bone", "cellular-bone", "ossicle", "nerve", "vessel", "soft-tissue", "implant"})
  {
    ASSERT_TRUE(MaterialCatalogue::builtIn().contains(name)) << name;
  }
}

// By the words that materials.json and burrs.json explain.
TEST(BurrCatalogue, EachBurrSaysHowCertainItsNumbersAreAndNoneIsCalledMeasured)
{
  const MaterialCatalogue materials = MaterialCatalogue::builtIn();
  const BurrCatalogue burrs = BurrCatalogue::builtIn();
  const auto check = [](const auto& one)
  {
    EXPECT_TRUE(one.certainty.find("published range") != std::string::npos ||
                one.certainty.find("derived, within a factor of ") == 0 ||
                one.certainty == "assumption")
        << one.name << ": " << one.certainty;
    EXPECT_FALSE(one.status.empty()) << one.name;
  };
  for (const TissueMaterial& material : materials.all())
    check(material);
  for (const BurrModel& burr : burrs.all())
    check(burr);
}

// Each diamond burr of stated grit has the coefficient that its grit gives, from that of the usual
// one; the finer the slower, in proportion below the end of the size effect.
TEST(BurrCatalogue, TheWearOfAGritFollowsFromItsSize)
{
  EXPECT_DOUBLE_EQ(wearOfGrit(100.0, 0.1), 0.1);
  EXPECT_DOUBLE_EQ(wearOfGrit(1000.0, 0.1), 0.1);
  EXPECT_DOUBLE_EQ(wearOfGrit(50.0, 0.2), 0.1);
  EXPECT_THROW(wearOfGrit(0.0, 0.1), core::InvalidParameter);
  EXPECT_THROW(wearOfGrit(50.0, std::nan("")), core::InvalidParameter);
  const BurrCatalogue burrs = BurrCatalogue::builtIn();
  const double usual = burrs.model(Burr::Kind::Diamond).wearCoefficient;
  int grits = 0;
  for (const BurrModel& burr : burrs.all())
    if (burr.grit > 0.0)
    {
      ++grits;
      EXPECT_EQ(burr.kind, Burr::Kind::Diamond) << burr.name;
      EXPECT_NEAR(burr.wearCoefficient, wearOfGrit(burr.grit, usual), 1e-12) << burr.name;
    }
  EXPECT_GE(grits, 4);
  const TissueMaterial bone = MaterialCatalogue::builtIn().material("cortical-bone");
  EXPECT_NEAR(resistanceOf(bone, burrs.model("diamond-extra-fine")),
              4.0 * resistanceOf(bone, burrs.model("diamond-coarse")), 1e-6);
  for (const char* alike : {"diamond-coarse", "diamond-medium"}) // as the guide says
    EXPECT_EQ(resistanceOf(bone, burrs.model(alike)), resistanceOf(bone, burrs.model("diamond")));
}

// A library's table of materials that went with the usual burrs goes with all that come with the
// program: none has a rake that a friction of 0 to 2 forbids.
TEST(BurrCatalogue, ComesWithNoBurrThatRefusesATableOfMaterials)
{
  for (const char* friction : {"1e-9", "0.05", "0.5", "2"})
    EXPECT_EQ(thrown(
                  [friction] {
                    checkPairs(MaterialCatalogue(materials("3", friction, "40"), "F"),
                               BurrCatalogue::builtIn());
                  }),
              "")
        << friction;
}

TEST(BurrCatalogue, RefusesAGritThatNoBurrHas)
{
  const auto load = [](const std::string& grit)
  {
    return thrown(
        [&grit]
        {
          BurrCatalogue(R"({"burrs":[{"kind":"cutting","rake_deg":-5,"diameters_mm":[2]},
            {"kind":"diamond","wear_coefficient":0.1,"diameters_mm":[2],"grit_um":)" +
                            grit + "}]}",
                        "B");
        });
  };
  EXPECT_EQ(load("64"), "");
  EXPECT_EQ(load("-1"), "B: burr 'diamond': 'grit_um' must be 0 to 1000 um");
  EXPECT_EQ(load("1001"), "B: burr 'diamond': 'grit_um' must be 0 to 1000 um");
}

// By a word that materials.json explains.
TEST(MaterialCatalogue, EachMaterialSaysHowCertainItsNumbersAre)
{
  const MaterialCatalogue catalogue = MaterialCatalogue::builtIn();
  for (const auto& material : catalogue.all())
    EXPECT_TRUE(material.status.find("unsure") != std::string::npos ||
                material.status.find("calibrated") != std::string::npos)
        << material.name << ": " << material.status;
}

TEST(MaterialCatalogue, ResistanceIsThatOfTheLawInNewtonsAndMillimetres)
{
  const auto catalogue = MaterialCatalogue::builtIn();
  const auto& bone = catalogue.material("cortical-bone");
  const auto burrs = BurrCatalogue::builtIn();
  EXPECT_DOUBLE_EQ(resistanceOf(bone, burrs.model(Burr::Kind::Cutting)),
                   1e-6 * OrthogonalCutting(3e9, 0.5, -10.0 * kDegree).resistance());
  EXPECT_DOUBLE_EQ(resistanceOf(bone, burrs.model(Burr::Kind::Diamond)),
                   1e-6 * 3.0 * 42.5 * 9.807e6 / 0.1);
}

TEST(MaterialCatalogue, WhatIsWrongIsNamed)
{
  const auto load = [](const std::string& text)
  { return [text] { MaterialCatalogue(text, "F"); }; };
  EXPECT_EQ(thrown(load(materials("3", "0.5", "40"))), "");
  EXPECT_EQ(thrown(load(materials("0", "0.5", "40"))),
            "F: material 'x': 'specific_cutting_energy_gpa' must be above 0, it is 0");
  EXPECT_EQ(thrown(load(materials("3", "0.5", "-2"))),
            "F: material 'x': 'vickers_hardness_hv' must be above 0, it is -2");
  EXPECT_EQ(thrown(load("{\n\"a\": Doe^John")), "F: not JSON; look at line 2");
  EXPECT_EQ(thrown(load("{}")).find("json.exception"), std::string::npos);
  const auto good = MaterialCatalogue(materials("3", "0.5", "40"), "F");
  EXPECT_EQ(thrown([&] { good.material("y"); }), "there is no material 'y'; there are x");
  const std::string pair = thrown([&] { checkPairs(good, BurrCatalogue(burrs(25.0), "B")); });
  EXPECT_NE(pair.find("material 'x' with the cutting burr: friction less the rake's tangent"),
            std::string::npos)
      << pair;
  EXPECT_EQ(thrown([] { BurrCatalogue(R"({"burrs":[]})", "B"); }),
            "B: there must be a burr 'cutting', the usual one of its kind");
}

TEST(BurrCatalogue, HasSeveralBurrsOfOneKindByTheirNames)
{
  const BurrCatalogue catalogue(R"({"burrs": [
    {"name": "coarse", "kind": "diamond", "wear_coefficient": 0.2, "diameters_mm": [2, 3]},
    {"kind": "diamond", "wear_coefficient": 0.1, "diameters_mm": [4]},
    {"name": "fluted-8", "kind": "cutting", "rake_deg": -5, "diameters_mm": [5]},
    {"kind": "cutting", "rake_deg": -10, "diameters_mm": [4]}]})",
                                "B");
  std::vector<std::string> names;
  for (const auto& one : catalogue.all())
    names.push_back(one.name);
  EXPECT_EQ(names, (std::vector<std::string>{"cutting", "diamond", "coarse", "fluted-8"}));
  EXPECT_DOUBLE_EQ(catalogue.model(Burr::Kind::Diamond).wearCoefficient, 0.1);
  EXPECT_DOUBLE_EQ(catalogue.model("coarse").wearCoefficient, 0.2);
  Burr burr;
  setModel(burr, catalogue.model("coarse"));
  EXPECT_EQ(burr.kind, Burr::Kind::Diamond);
  EXPECT_EQ(nameOf(burr), "coarse");
  EXPECT_EQ(catalogue.model(burr).diameters, (std::vector<double>{2.0, 3.0}));
  setModel(burr, catalogue.model("cutting"));
  EXPECT_TRUE(burr.name.empty()) << "as cases of earlier programs have it";
  EXPECT_EQ(thrown([&] { catalogue.model("fine"); }),
            "there is no burr 'fine'; there are cutting, diamond, coarse, fluted-8");
  burr.name = "coarse"; // and of the kind cutting
  EXPECT_EQ(thrown([&] { catalogue.model(burr); }),
            "the burr 'coarse' is a diamond one in this catalogue, not a cutting one");

  // Twice the wear coefficient takes half the energy: w = 3 H / k.
  const auto known = MaterialCatalogue::builtIn();
  const auto& bone = known.material("cortical-bone");
  EXPECT_DOUBLE_EQ(resistanceOf(bone, catalogue.model("coarse")),
                   0.5 * resistanceOf(bone, catalogue.model("diamond")));
}

TEST(BurrCatalogue, RefusesNamesThatWouldMislead)
{
  const auto refusal = [](const std::string& more)
  {
    const std::string text = burrs(-10.0);
    return thrown([&] { BurrCatalogue(text.substr(0, text.size() - 2) + "," + more + "]}", "B"); });
  };
  const std::string rest = R"("wear_coefficient":0.1,"diameters_mm":[4]})";
  EXPECT_EQ(refusal(R"({"name":"fine","kind":"diamond",)" + rest), "");
  EXPECT_EQ(refusal(R"({"name":"Fine grit","kind":"diamond",)" + rest),
            "B: 'Fine grit' cannot be a burr's name: it has a to z, 0 to 9 and hyphens, at most "
            "40");
  EXPECT_EQ(refusal(R"({"kind":"diamond",)" + rest),
            "B: there are two burrs 'diamond'; each needs a name of its own");
  EXPECT_EQ(refusal(R"({"name":"cutting","kind":"diamond",)" + rest),
            "B: burr 'cutting' must be of the kind of that name");
  // The law's domain holds for each of them.
  const BurrCatalogue steep(R"({"burrs": [
    {"kind": "cutting", "rake_deg": -10, "diameters_mm": [4]},
    {"kind": "diamond", "wear_coefficient": 0.1, "diameters_mm": [4]},
    {"name": "steep", "kind": "cutting", "rake_deg": 25, "diameters_mm": [4]}]})",
                            "B");
  EXPECT_NE(thrown([&] { checkPairs(MaterialCatalogue::builtIn(), steep); })
                .find("with the steep burr: friction less the rake's tangent"),
            std::string::npos);
}
