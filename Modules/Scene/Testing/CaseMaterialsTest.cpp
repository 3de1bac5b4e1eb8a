#include "petrous/Scene/CaseMaterials.h"

#include <gtest/gtest.h>

using namespace petrous;
using Eigen::Vector3d;
using Kind = dissection::Burr::Kind;

namespace
{

// Intensity 300 at x = 0, 100 more for each voxel of 1 mm; a structure of bone at y = 2.
scene::Case rampCase(scene::Modality modality)
{
  scene::Case value;
  value.ct.modality = modality;
  value.iso = 300.0;
  value.denseBone = 1000.0;
  value.ct.geometry = core::GridGeometry({8, 4, 4}, Vector3d::Ones(), Vector3d::Zero());
  auto voxels = std::make_shared<volume::Volume<std::int16_t>>(value.ct.geometry);
  auto labels = std::make_shared<volume::Volume<std::uint16_t>>(value.ct.geometry);
  for (int k = 0; k < 4; ++k)
    for (int j = 0; j < 4; ++j)
      for (int i = 0; i < 8; ++i)
      {
        voxels->at(i, j, k) = static_cast<std::int16_t>(300 + 100 * i);
        labels->at(i, j, k) = j == 2 ? 1 : 0;
      }
  value.ct.volume = std::make_shared<const volume::IntensityVolume>(
      std::shared_ptr<const volume::Volume<std::int16_t>>(voxels));
  scene::LabelPart part;
  scene::StructurePart bone;
  bone.name = "petrous apex";
  bone.index = 1;
  bone.look.tissue = "cortical-bone";
  part.structures = {bone};
  part.labels = std::make_shared<const volume::LabelMap>(
      volume::makeLabelMap(labels, {{"petrous apex", 1, {}, 0}}));
  value.labels = {part};
  return value;
}

} // namespace

TEST(CaseMaterials, OfAnMrAreSoftTissueWhateverItsBrightnessExceptInStructures)
{
  const auto catalogues = dissection::Catalogues::builtIn();
  for (const Kind kind : {Kind::Cutting, Kind::Diamond})
  {
    dissection::Burr used;
    used.kind = kind;
    const auto& burr = catalogues.burrs.model(kind);
    const auto of = [&](const char* material)
    { return dissection::resistanceOf(catalogues.materials.material(material), burr); };
    const auto mr = scene::tissueResistance(rampCase(scene::Modality::Mr), catalogues, used);
    for (const double x : {0.0, 3.0, 7.0})
      EXPECT_EQ(mr.at({x, 0.0, 0.0}), of("soft-tissue")) << x;
    EXPECT_EQ(mr.at({7.0, 2.0, 0.0}), of("cortical-bone"));
    const auto ct = scene::tissueResistance(rampCase(scene::Modality::Ct), catalogues, used);
    EXPECT_NEAR(ct.at({0.0, 0.0, 0.0}), of("cellular-bone"), 1e-9);
    EXPECT_NEAR(ct.at({7.0, 0.0, 0.0}), of("cortical-bone"), 1e-9);
  }
}

TEST(CaseMaterials, AreAsHardAsTheConstantsOfTheNamedBurrSay)
{
  dissection::Catalogues catalogues = dissection::Catalogues::builtIn();
  catalogues.burrs = dissection::BurrCatalogue(R"({"burrs": [
    {"kind": "cutting", "rake_deg": -10, "diameters_mm": [4]},
    {"kind": "diamond", "wear_coefficient": 0.1, "diameters_mm": [4]},
    {"name": "coarse", "kind": "diamond", "wear_coefficient": 0.2, "diameters_mm": [4]}]})",
                                               "burrs.json");
  const scene::Case value = rampCase(scene::Modality::Ct);
  dissection::Burr burr;
  burr.kind = Kind::Diamond;
  const double usual = scene::tissueResistance(value, catalogues, burr).at({7.0, 0.0, 0.0});
  burr.name = "coarse";
  // w = 3 H / k: twice the wear coefficient, half the energy.
  EXPECT_NEAR(scene::tissueResistance(value, catalogues, burr).at({7.0, 0.0, 0.0}), 0.5 * usual,
              1e-9 * usual);
  burr.name = "polishing";
  EXPECT_THROW(scene::tissueResistance(value, catalogues, burr), core::InvalidParameter);
}
