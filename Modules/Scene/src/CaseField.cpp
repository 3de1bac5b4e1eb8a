#include "petrous/Scene/CaseField.h"

#include <algorithm>
#include <limits>
#include <string>
#include <tuple>
#include <utility>

namespace petrous::scene
{

namespace
{

using Wanted = std::function<bool(const appearance::StructureLook&)>;

constexpr std::size_t kMostMaterials = std::numeric_limits<std::uint8_t>::max();

struct Wish
{
  const LabelPart* part;
  const StructurePart* structure;
};

std::vector<Wish> wishes(const Case& value, const Wanted& wanted)
{
  std::vector<Wish> result;
  for (const LabelPart& part : value.labels)
    for (const StructurePart& structure : part.structures)
      if (wanted(structure.look))
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
    sources.push_back({wish.part->labels.get(), wish.structure->index, 1, true});
  const auto field = volume::makeLabelField(sources, progress);
  if (!field)
    return {};
  return {field->share};
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
    result.sources.push_back({wish.part->labels.get(), wish.structure->index,
                              static_cast<std::uint8_t>(result.structures.size()),
                              wish.structure->look.solid});
  }
  return result;
}

volume::TissueField tissueField(const Case& value, const core::Progress& progress)
{
  std::shared_ptr<const volume::CutMask> mask;
  if (value.dissection)
    mask = {value.dissection, &std::as_const(*value.dissection).mask()};
  return {value.ct.volume.get(),
          unionOf(
              value, [](const auto& look) { return look.solid && look.touchable; }, progress),
          std::move(mask), volume::TissueField::Parameters{value.iso, kFieldScale}};
}

dissection::ProtectedTissue protectedTissue(const Case& value, const core::Progress& progress)
{
  return unionOf(
      value, [](const auto& look) { return !look.drillable; }, progress);
}

std::vector<dissection::NamedStructure> drillableStructures(const Case& value)
{
  std::vector<dissection::NamedStructure> structures;
  for (const LabelPart& part : value.labels)
    for (const StructurePart& structure : part.structures)
      if (structure.look.drillable)
        structures.push_back({structure.name, part.labels.get(), structure.index});
  return structures;
}

} // namespace petrous::scene
