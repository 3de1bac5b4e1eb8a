#include "petrous/Scene/CaseField.h"

#include <algorithm>
#include <limits>
#include <optional>
#include <string>
#include <tuple>
#include <utility>

#include "DerivedKey.h"
#include "petrous/Scene/Placement.h"
#include "petrous/Volume/RegionalUnion.h"
#include "petrous/Volume/VolumeBytes.h"

namespace petrous::scene
{

namespace
{

using Wanted = std::function<bool(const appearance::StructureAppearance&)>;

bool felt(const appearance::StructureAppearance& look)
{
  return look.solid && look.touchable;
}

bool yields(const appearance::StructureAppearance& look)
{
  return felt(look) && look.stiffness > 0.0;
}

constexpr std::size_t kMaxMaterials = std::numeric_limits<std::uint8_t>::max();

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

// Derived-data key of the union of these structures; loads no labels.
std::optional<std::string> unionKey(const Case& value, const std::vector<Wish>& wished)
{
  DerivedKey key(value, "solid share", volume::kLabelFieldVersion);
  for (const Wish& wish : wished)
  {
    key.add(*wish.part);
    key.add(wish.structure->index);
  }
  return key.text();
}

std::shared_ptr<const volume::Volume<float>> cachedOccupancy(const Case& value,
                                                             const std::optional<std::string>& key)
{
  const auto bytes = key ? value.derived->find(*key) : std::nullopt;
  return bytes ? volume::occupancyFrom(*bytes) : nullptr;
}

// An occupancy, and what computes it in these boxes if done region by region.
struct UnionOccupancy
{
  volume::TissueField::SolidUnion occupancy;
  std::function<void(const std::vector<core::PatientBox>&)> prepare;
};

void keep(core::DerivedStore* derived, const std::optional<std::string>& key,
          const volume::Volume<float>& occupancy)
{
  if (const auto bytes = key ? volume::bytesOf(occupancy) : std::nullopt)
    derived->put(*key, *bytes);
}

UnionOccupancy regionalOccupancy(const std::vector<volume::LabelSource>& sources,
                                 const std::shared_ptr<core::DerivedStore>& derived,
                                 const std::optional<std::string>& key,
                                 const core::Progress& progress)
{
  auto united = volume::RegionalUnion::make(sources, progress);
  if (!united)
    return {};
  auto occupancy = united->occupancy();
  if (united->isWhole())
  {
    keep(derived.get(), key, *occupancy);
    return {std::move(occupancy), {}};
  }
  const auto prepare = [united, derived, key, progress](const std::vector<core::PatientBox>& boxes)
  {
    if (united->isWhole())
      return;
    united->prepare(boxes, progress);
    if (united->isWhole())
      keep(derived.get(), key, *united->occupancy());
  };
  return {std::move(occupancy), prepare};
}

std::vector<const LabelPart*> partsOf(const std::vector<Wish>& wished)
{
  std::vector<const LabelPart*> parts;
  for (const Wish& wish : wished)
    if (std::find(parts.begin(), parts.end(), wish.part) == parts.end())
      parts.push_back(wish.part);
  return parts;
}

// Union of all wanted structures; lumens count as solid.
UnionOccupancy unionOccupancy(const Case& value, const Wanted& wanted,
                              const core::Progress& progress, bool regional)
{
  const std::vector<Wish> wished = wishes(value, wanted);
  if (wished.empty())
    return {};
  const auto key = unionKey(value, wished);
  if (auto kept = cachedOccupancy(value, key))
    return {std::move(kept), {}};
  readLabels(partsOf(wished));
  std::vector<volume::LabelSource> sources;
  for (const Wish& wish : wished)
    sources.push_back({wish.labels(value), wish.structure->index, 1, true});
  if (regional)
    return regionalOccupancy(sources, value.derived, key, progress);
  const auto occupancy = volume::makeSolidOccupancy(sources, progress);
  if (occupancy)
    keep(value.derived.get(), key, *occupancy);
  return {occupancy, {}};
}

// The solids of f: the union of the structures, and each mesh separately.
std::vector<volume::TissueField::SolidUnion> solidsOf(const Case& value, const Wanted& wanted,
                                                      const core::Progress& progress)
{
  std::vector<volume::TissueField::SolidUnion> solids;
  if (UnionOccupancy united = unionOccupancy(value, wanted, progress.part(0.0, 0.5), false);
      united.occupancy)
    solids.push_back(std::move(united.occupancy));
  for (MeshSolid& mesh : meshSolids(value, wanted, progress.part(0.5, 1.0)))
    solids.push_back(std::move(mesh.occupancy));
  return solids;
}

// The voxels whose centres are inside a solid, as a label map with the single index 1.
std::shared_ptr<const volume::LabelMap> insideOf(const volume::Volume<float>& occupancy)
{
  auto voxels = std::make_shared<volume::Volume<std::uint16_t>>(occupancy.geometry());
  std::transform(occupancy.data(), occupancy.data() + occupancy.size(), voxels->data(),
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
  if (all.size() > kMaxMaterials)
    throw core::InvalidParameter("case '" + value.name + "': " + std::to_string(all.size()) +
                                 " structures are to be drawn; at most " +
                                 std::to_string(kMaxMaterials) + " can be, hide the others");
  readLabels(partsOf(all));
  for (const Wish& wish : all)
  {
    result.structures.push_back(wish.structure);
    result.parts.push_back(wish.part);
    result.sources.push_back({wish.labels(value), wish.structure->index,
                              static_cast<std::uint8_t>(result.structures.size()),
                              wish.structure->look.solid});
  }
  return result;
}

std::shared_ptr<const volume::LabelField> labelField(const Case& value, const LabelSources& sources,
                                                     const core::Progress& progress)
{
  if (sources.sources.empty())
    return nullptr;
  DerivedKey key(value, "label field", volume::kLabelFieldVersion);
  for (std::size_t n = 0; n < sources.sources.size(); ++n)
  {
    const volume::LabelSource& source = sources.sources[n];
    key.add(*sources.parts[n]);
    key.add(source.segment);
    key.add(source.material);
    key.add(source.solid ? 1 : 0);
  }
  if (const auto bytes = key.text() ? value.derived->find(*key.text()) : std::nullopt)
    if (auto field = volume::labelFieldFrom(*bytes))
      return field;
  auto field = volume::makeLabelField(sources.sources, progress);
  if (field && key.text())
    if (const auto bytes = volume::bytesOf(*field))
      value.derived->put(*key.text(), *bytes);
  return field;
}

namespace
{

std::vector<MeshSolid> solidsOfMeshes(const Case& value,
                                      const std::function<bool(const MeshPart&)>& wanted,
                                      const core::Progress& progress)
{
  std::vector<MeshSolid> solids;
  for (const MeshPart& part : value.meshes)
    if (!findStructure(value, part.name) && placementOf(value, part).missing.empty() &&
        wanted(part))
      solids.push_back({&part, nullptr});
  const auto count = static_cast<double>(solids.size());
  for (std::size_t n = 0; n < solids.size(); ++n)
  {
    const MeshPart& part = *solids[n].part;
    solids[n].occupancy = part.touch.solid(
        meshOnCt(value, part), value.ct.geometry,
        progress.part(static_cast<double>(n) / count, static_cast<double>(n + 1) / count));
  }
  const auto refused = [](const MeshSolid& solid) { return !solid.occupancy; };
  solids.erase(std::remove_if(solids.begin(), solids.end(), refused), solids.end());
  return solids;
}

} // namespace

std::vector<MeshSolid> meshSolids(const Case& value, const Wanted& wanted,
                                  const core::Progress& progress)
{
  return solidsOfMeshes(
      value, [&wanted](const MeshPart& part) { return wanted(part.look); }, progress);
}

std::vector<MeshSolid> meshSolidsAt(const Case& value, const std::vector<Eigen::Vector3d>& points,
                                    const core::Progress& progress)
{
  const auto near = [&](const MeshPart& part)
  {
    const auto bounds = meshOnCt(value, part)->bounds();
    const core::PatientBox box(bounds[0].cast<double>(), bounds[1].cast<double>());
    // The voxels are no larger than the CT's if memory permits, and interpolation between two of
    // them counts.
    const Eigen::Vector3d margin = Eigen::Vector3d::Constant(2.0 * value.ct.geometry.minSpacing() +
                                                             0.02 * box.diagonal().norm());
    const core::PatientBox around(box.min() - margin, box.max() + margin);
    return std::any_of(points.begin(), points.end(),
                       [&around](const Eigen::Vector3d& p) { return around.contains(p); });
  };
  return solidsOfMeshes(value, near, progress);
}

std::string untouchable(const Case& value, const MeshPart& mesh)
{
  const StructurePart* structure = findStructure(value, mesh.name);
  const appearance::StructureAppearance& look = structure ? structure->look : mesh.look;
  if (!look.solid)
    return "it is a space without tissue";
  if (!look.touchable)
    return "its flag 'touchable' is off";
  if (const std::string missing = missingPlace(value, mesh.name); !missing.empty())
    return missing;
  return structure ? "" : mesh.touch.refusal(meshOnCt(value, mesh), value.ct.geometry);
}

namespace
{

volume::TissueField fieldOf(const Case& value, std::vector<volume::TissueField::SolidUnion> solids)
{
  return {value.ct.volume.get(), std::move(solids), value.dissection.sharedMask(),
          volume::TissueField::Parameters{value.iso, kFieldScale}};
}

} // namespace

volume::TissueField tissueField(const Case& value, const core::Progress& progress)
{
  return fieldOf(value, solidsOf(value, felt, progress));
}

volume::TissueField regionalTissueField(const Case& value, const core::Progress& progress)
{
  const UnionOccupancy united = unionOccupancy(value, felt, progress.part(0.0, 0.5), true);
  std::vector<volume::TissueField::SolidUnion> solids;
  if (united.occupancy)
    solids.push_back(united.occupancy);
  for (MeshSolid& mesh : meshSolids(value, felt, progress.part(0.5, 1.0)))
    solids.push_back(std::move(mesh.occupancy));
  volume::TissueField field = fieldOf(value, std::move(solids));
  field.onPrepare(united.prepare);
  return field;
}

namespace
{

constexpr int kMeshVoxelsVersion = 2; // of volume::planMeshSolid and solidOf

std::optional<std::string> rigidKey(const Case& value, const Wanted& wanted)
{
  DerivedKey key(value, "rigid tissue", volume::kLabelFieldVersion);
  key.add(kMeshVoxelsVersion);
  key.add(*value.ct.volume.get());
  key.add(value.iso);
  key.add(kFieldScale);
  for (const Wish& wish : wishes(value, wanted))
  {
    key.add(*wish.part);
    key.add(wish.structure->index);
  }
  for (const MeshPart& part : value.meshes)
    if (wanted(part.look) && !findStructure(value, part.name) &&
        placementOf(value, part).missing.empty())
      key.add(part);
  return key.text();
}

} // namespace

TouchTissue touchTissue(const Case& value, const volume::TissueField& whole,
                        const core::Progress& progress)
{
  const auto soft = wishes(value, yields);
  const auto meshes = meshSolids(value, yields, progress.part(0.0, 0.1));
  const auto rigid = [](const auto& look) { return felt(look) && !yields(look); };
  const auto key = rigidKey(value, rigid);
  if (soft.empty() && meshes.empty())
    return {whole, {}, key};
  TouchTissue result{
      {whole.ct(), solidsOf(value, rigid, progress.part(0.1, 0.3)), nullptr, whole.parameters()},
      {},
      key};
  const auto count = static_cast<double>(soft.size() + meshes.size());
  std::size_t done = 0;
  const auto add =
      [&](const std::string& name, const volume::Volume<float>& occupancy, double stiffness)
  {
    const double begin = 0.3 + 0.7 * static_cast<double>(done++) / count;
    if (auto depth = volume::makeDistanceMap(occupancy, value.ct.geometry,
                                             progress.part(begin, begin + 0.7 / count)))
      result.soft.push_back({name, std::move(depth), stiffness});
  };
  for (const Wish& wish : soft)
  {
    const auto occupancy = volume::makeSolidOccupancy(
        {{wish.labels(value), wish.structure->index, 1, true}}, progress.part(0.3, 0.3));
    if (occupancy)
      add(wish.structure->name, *occupancy, wish.structure->look.stiffness);
  }
  for (const MeshSolid& mesh : meshes)
    add(mesh.part->name, *mesh.occupancy, mesh.part->look.stiffness);
  return result;
}

dissection::ProtectedTissue protectedTissue(const Case& value, const core::Progress& progress,
                                            bool regional)
{
  const auto kept = [](const auto& look) { return !look.drillable; };
  UnionOccupancy united = unionOccupancy(value, kept, progress.part(0.0, 0.5), regional);
  std::vector<dissection::ProtectedTissue::Occupancy> occupancies;
  if (united.occupancy)
    occupancies.push_back(std::move(united.occupancy));
  // The mask, on the CT grid, protects them: it must represent structures thinner than a voxel.
  for (const MeshSolid& mesh : meshSolids(value, kept, progress.part(0.5, 1.0)))
    if (auto guard = volume::protectionMaskOf(*mesh.occupancy, value.ct.geometry))
      occupancies.push_back(std::move(guard));
  return dissection::ProtectedTissue(std::move(occupancies), united.prepare);
}

std::vector<dissection::NamedStructure> drillableStructures(const Case& value)
{
  std::vector<dissection::NamedStructure> structures;
  const auto drilled = [](const auto& look) { return look.drillable; };
  readLabels(partsOf(wishes(value, drilled)));
  for (const LabelPart& part : value.labels)
    for (const StructurePart& structure : part.structures)
      if (drilled(structure.look) && placementOf(value, part).missing.empty())
        structures.push_back({structure.name, labelsOnCt(value, part), structure.index});
  for (const MeshSolid& mesh : meshSolids(value, drilled))
    structures.push_back({mesh.part->name, insideOf(*mesh.occupancy), 1});
  return structures;
}

} // namespace petrous::scene
