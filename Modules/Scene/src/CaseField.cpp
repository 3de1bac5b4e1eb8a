#include "petrous/Scene/CaseField.h"

#include <algorithm>
#include <utility>

#include "petrous/Volume/SmoothedUnion.h"

namespace petrous::scene
{

namespace
{

template <class Wanted>
std::vector<volume::TissueField::SolidUnion> unionsOf(const Case& value, const Wanted& wanted)
{
  std::vector<volume::TissueField::SolidUnion> unions;
  for (const LabelPart& part : value.labels)
  {
    std::vector<std::uint16_t> indices;
    for (const StructurePart& structure : part.structures)
      if (wanted(structure.look))
        indices.push_back(structure.index);
    if (indices.empty())
      continue;
    auto field = volume::makeSmoothedUnion(
        *part.labels.get(), [&indices](std::uint16_t index)
        { return std::find(indices.begin(), indices.end(), index) != indices.end(); });
    if (field)
      unions.push_back(std::move(field));
  }
  return unions;
}

} // namespace

volume::TissueField tissueField(const Case& value)
{
  std::shared_ptr<const volume::CutMask> mask;
  if (value.dissection)
    mask = {value.dissection, &std::as_const(*value.dissection).mask()};
  return {value.ct.volume.get(),
          unionsOf(value, [](const auto& look) { return look.solid && look.touchable; }),
          std::move(mask), volume::TissueField::Parameters{value.iso, kFieldScale}};
}

dissection::ProtectedTissue protectedTissue(const Case& value)
{
  return unionsOf(value, [](const auto& look) { return !look.drillable; });
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
