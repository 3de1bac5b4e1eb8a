#include "petrous/Scene/CaseField.h"

#include <algorithm>
#include <limits>
#include <string>
#include <tuple>
#include <utility>

#include "petrous/Scene/Placement.h"

namespace petrous::scene
{

namespace
{

using Wanted = std::function<bool(const appearance::StructureLook&)>;

bool felt(const appearance::StructureLook& look)
{
  return look.solid && look.touchable;
}

bool yields(const appearance::StructureLook& look)
{
  return felt(look) && look.stiffness > 0.0;
}

constexpr std::size_t kMostMaterials = std::numeric_limits<std::uint8_t>::max();

struct Wish
{
  const LabelPart* part;
  const StructurePart* structure;

  std::shared_ptr<const volume::LabelMap> labels(const Case& value) const
  {
    return labelsOnCt(value, *part);
  }
};

std::vector<Wish> wishes(const Case& value, const Wanted& wanted)
{
  std::vector<Wish> result;
  for (const LabelPart& part : value.labels)
    for (const StructurePart& structure : part.structures)
      if (wanted(structure.look) && placementOf(value, part).missing.empty())
        result.push_back({&part, &structure});
  const auto place = [](const Wish& wish)
  {
    const StructurePart& s = *wish.structure;
    return std::make_tuple(!s.look.solid, s.look.priority, s.volume);
  };
  std::stable_sort(result.begin(), result.end(),
                   [&place](const Wish& a, const Wish& b) { return place(a) < place(b); });
  return result;
}

// One union of all wanted structures; lumens count as if they were tissue.
std::vector<volume::TissueField::SolidUnion> unionOf(const Case& value, const Wanted& wanted,
                                                     const core::Progress& progress)
{
  std::vector<volume::LabelSource> sources;
  for (const Wish& wish : wishes(value, wanted))
    sources.push_back({wish.labels(value), wish.structure->index, 1, true});
  const auto field = volume::makeLabelField(sources, progress);
  if (!field)
    return {};
  return {field->share};
}

// What is solid in f: one union of the structures, and each mesh for itself.
std::vector<volume::TissueField::SolidUnion> solidsOf(const Case& value, const Wanted& wanted,
                                                      const core::Progress& progress)
{
  auto solids = unionOf(value, wanted, progress.part(0.0, 0.5));
  for (MeshSolid& mesh : meshSolids(value, wanted, progress.part(0.5, 1.0)))
    solids.push_back(std::move(mesh.share));
  return solids;
}

// The voxels whose centres lie in a solid, as a label map with the one index 1.
std::shared_ptr<const volume::LabelMap> insideOf(const volume::Volume<float>& share)
{
  auto voxels = std::make_shared<volume::Volume<std::uint16_t>>(share.geometry());
  std::transform(share.data(), share.data() + share.size(), voxels->data(),
                 [](float inside) { return static_cast<std::uint16_t>(inside > 0.5F); });
  volume::LabelMap map;
  map.voxels = std::move(voxels);
  return std::make_shared<const volume::LabelMap>(std::move(map));
}

} // namespace

LabelSources labelSources(const Case& value, const Wanted& wanted)
{
  LabelSources result;
  const std::vector<Wish> all = wishes(value, wanted);
  if (all.size() > kMostMaterials)
    throw core::InvalidParameter("case '" + value.name + "': " + std::to_string(all.size()) +
                                 " structures are to be drawn; at most " +
                                 std::to_string(kMostMaterials) + " can be, hide the others");
  for (const Wish& wish : all)
  {
    result.structures.push_back(wish.structure);
    result.sources.push_back({wish.labels(value), wish.structure->index,
                              static_cast<std::uint8_t>(result.structures.size()),
                              wish.structure->look.solid});
  }
  return result;
}

std::vector<MeshSolid> meshSolids(const Case& value, const Wanted& wanted,
                                  const core::Progress& progress)
{
  std::vector<MeshSolid> solids;
  for (const MeshPart& part : value.meshes)
    if (wanted(part.look) && !findStructure(value, part.name) &&
        placementOf(value, part).missing.empty())
      solids.push_back({&part, nullptr});
  const auto count = static_cast<double>(solids.size());
  for (std::size_t n = 0; n < solids.size(); ++n)
  {
    const MeshPart& part = *solids[n].part;
    solids[n].share = part.touch.solid(
        meshOnCt(value, part), value.ct.geometry,
        progress.part(static_cast<double>(n) / count, static_cast<double>(n + 1) / count));
  }
  const auto refused = [](const MeshSolid& solid) { return !solid.share; };
  solids.erase(std::remove_if(solids.begin(), solids.end(), refused), solids.end());
  return solids;
}

std::string untouchable(const Case& value, const MeshPart& mesh)
{
  const StructurePart* structure = findStructure(value, mesh.name);
  const appearance::StructureLook& look = structure ? structure->look : mesh.look;
  if (!look.solid)
    return "it is a space without tissue";
  if (!look.touchable)
    return "its flag 'touchable' is off";
  if (const std::string missing = missingPlace(value, mesh.name); !missing.empty())
    return missing;
  return structure ? "" : mesh.touch.refusal(meshOnCt(value, mesh), value.ct.geometry);
}

volume::TissueField tissueField(const Case& value, const core::Progress& progress)
{
  std::shared_ptr<const volume::CutMask> mask;
  if (value.dissection)
    mask = {value.dissection, &std::as_const(*value.dissection).mask()};
  return {value.ct.volume.get(), solidsOf(value, felt, progress), std::move(mask),
          volume::TissueField::Parameters{value.iso, kFieldScale}};
}

TouchTissue touchTissue(const Case& value, const volume::TissueField& whole,
                        const core::Progress& progress)
{
  const auto soft = wishes(value, yields);
  const auto meshes = meshSolids(value, yields, progress.part(0.0, 0.1));
  if (soft.empty() && meshes.empty())
    return {whole, {}};
  const auto rigid = [](const auto& look) { return felt(look) && !yields(look); };
  TouchTissue result{
      {whole.ct(), solidsOf(value, rigid, progress.part(0.1, 0.3)), nullptr, whole.parameters()},
      {}};
  const auto count = static_cast<double>(soft.size() + meshes.size());
  std::size_t done = 0;
  const auto add =
      [&](const std::string& name, const volume::Volume<float>& share, double stiffness)
  {
    const double begin = 0.3 + 0.7 * static_cast<double>(done++) / count;
    if (auto depth = volume::makeDistanceMap(share, value.ct.geometry,
                                             progress.part(begin, begin + 0.7 / count)))
      result.soft.push_back({name, std::move(depth), stiffness});
  };
  for (const Wish& wish : soft)
  {
    const auto field = volume::makeLabelField(
        {{wish.labels(value), wish.structure->index, 1, true}}, progress.part(0.3, 0.3));
    if (field)
      add(wish.structure->name, *field->share, wish.structure->look.stiffness);
  }
  for (const MeshSolid& mesh : meshes)
    add(mesh.part->name, *mesh.share, mesh.part->look.stiffness);
  return result;
}

dissection::ProtectedTissue protectedTissue(const Case& value, const core::Progress& progress)
{
  const auto kept = [](const auto& look) { return !look.drillable; };
  auto tissue = unionOf(value, kept, progress.part(0.0, 0.5));
  // The mask, on the CT's voxels, is what keeps them: it must hold what is thinner than a voxel.
  for (const MeshSolid& mesh : meshSolids(value, kept, progress.part(0.5, 1.0)))
    if (auto guard = volume::guardOf(*mesh.share, value.ct.geometry))
      tissue.push_back(std::move(guard));
  return tissue;
}

std::vector<dissection::NamedStructure> drillableStructures(const Case& value)
{
  std::vector<dissection::NamedStructure> structures;
  const auto drilled = [](const auto& look) { return look.drillable; };
  for (const LabelPart& part : value.labels)
    for (const StructurePart& structure : part.structures)
      if (drilled(structure.look) && placementOf(value, part).missing.empty())
        structures.push_back({structure.name, labelsOnCt(value, part), structure.index});
  for (const MeshSolid& mesh : meshSolids(value, drilled))
    structures.push_back({mesh.part->name, insideOf(*mesh.share), 1});
  return structures;
}

} // namespace petrous::scene
