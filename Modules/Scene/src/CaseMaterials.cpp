#include "petrous/Scene/CaseMaterials.h"

#include <algorithm>

#include "petrous/Scene/CaseField.h"

namespace petrous::scene
{

namespace
{

constexpr char kMrTissue[] = "soft-tissue"; // in Resources/materials.json

const appearance::StructureAppearance* lookOf(const Case& value, const std::string& name)
{
  if (const StructurePart* structure = findStructure(value, name))
    return &structure->look;
  const auto mesh = std::find_if(value.meshes.begin(), value.meshes.end(),
                                 [&name](const MeshPart& part) { return part.name == name; });
  return mesh == value.meshes.end() ? nullptr : &mesh->look;
}

} // namespace

dissection::TissueResistance tissueResistance(const Case& value,
                                              const dissection::Catalogues& catalogues,
                                              const dissection::Burr& used)
{
  const auto& materials = catalogues.materials;
  const dissection::BurrModel& burr = catalogues.burrs.model(used);
  struct Ranked
  {
    int priority;
    dissection::TissueResistance::Structure structure;
  };
  std::vector<Ranked> ranked;
  for (const dissection::NamedStructure& structure : drillableStructures(value))
  {
    const appearance::StructureAppearance* look = lookOf(value, structure.name);
    if (!look || look->tissue.empty())
      continue;
    if (!materials.contains(look->tissue))
      throw core::InvalidParameter("structure '" + structure.name + "': there is no material '" +
                                   look->tissue + "'; give it another one (appearance --tissue)");
    ranked.push_back({look->priority,
                      {structure.labels, structure.index,
                       resistanceOf(materials.material(look->tissue), burr)}});
  }
  std::stable_sort(ranked.begin(), ranked.end(),
                   [](const Ranked& a, const Ranked& b) { return a.priority < b.priority; });
  std::vector<dissection::TissueResistance::Structure> structures;
  structures.reserve(ranked.size());
  for (Ranked& entry : ranked)
    structures.push_back(std::move(entry.structure));

  if (value.ct.modality == Modality::Mr && materials.contains(kMrTissue))
  {
    // Brightness tells no density, and bone is as dark as air: what the surface encloses is soft.
    const auto soft = resistanceOf(materials.material(kMrTissue), burr);
    return {value.ct.volume.get(), {value.iso, value.iso + 1.0, soft, soft}, std::move(structures)};
  }
  const dissection::BoneRamp& bone = materials.bone();
  const volume::IntensityScale usual;
  const double stretch = (value.denseBone - value.iso) / (usual.dense - usual.iso);
  const auto here = [&](double hounsfield)
  { return value.iso + (hounsfield - usual.iso) * stretch; };
  // A threshold above dense bone leaves no range to stretch to.
  const bool stretches = stretch > 0.0;
  return {value.ct.volume.get(),
          {stretches ? here(bone.low) : bone.low, stretches ? here(bone.high) : bone.high,
           resistanceOf(materials.material(bone.cellular), burr),
           resistanceOf(materials.material(bone.cortical), burr)},
          std::move(structures)};
}

} // namespace petrous::scene
