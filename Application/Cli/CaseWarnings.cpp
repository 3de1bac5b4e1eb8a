#include "CaseWarnings.h"

namespace petrous::cli
{

std::string placeText(const scene::Placement& placement)
{
  if (!placement.missing.empty())
    return ", nowhere on the CT: " + placement.missing;
  return placement.drawnOn.empty() ? "" : ", drawn on the MR '" + placement.drawnOn + "'";
}

void warnMissingPlaces(const Context& context, const scene::Case& value)
{
  const auto remark = [&context](const std::string& name, const scene::Placement& placement)
  {
    if (!placement.missing.empty())
      context.warn("'" + name + "' is left out, as it is nowhere on the CT: " + placement.missing);
  };
  for (const scene::LabelPart& part : value.labels)
  {
    const scene::Placement placement = scene::placementOf(value, part);
    for (const scene::StructurePart& structure : part.structures)
      remark(structure.name, placement);
  }
  for (const scene::MeshPart& mesh : value.meshes)
    remark(mesh.name, scene::placementOf(value, mesh));
}

} // namespace petrous::cli
