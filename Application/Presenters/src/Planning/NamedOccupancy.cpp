#include "NamedOccupancy.h"

#include "petrous/Presenters/IntensityDisplay.h"
#include "petrous/Scene/CaseField.h"
#include "petrous/Scene/Placement.h"

namespace petrous::presenters
{

scene::StructureOccupancy namedOccupancy(const scene::Case& value, const std::string& structure,
                                         const std::string& what, const core::Progress& progress)
{
  if (const std::string missing = scene::missingPlace(value, structure); !missing.empty())
    throw core::InvalidParameter(what + ": '" + structure + "' is nowhere on the " +
                                 primaryName(value) + ": " + missing);
  std::string there;
  for (const scene::LabelPart& part : value.labels)
    for (const scene::StructurePart& known : part.structures)
      there += (there.empty() ? "" : ", ") + known.name;
  for (const scene::MeshPart& mesh : value.meshes)
  {
    if (!scene::findStructure(value, mesh.name))
      there += (there.empty() ? "" : ", ") + mesh.name;
    if (mesh.name == structure && !mesh.touch.resident())
      mesh.touch.solid(scene::meshOnCt(value, mesh), value.ct.geometry, progress);
  }
  for (scene::StructureOccupancy& occupancy : scene::structureOccupancies(value))
    if (occupancy.name == structure)
      return std::move(occupancy);
  if (there.empty())
    throw core::InvalidParameter(what + ": case '" + value.name + "' has no structures");
  throw core::InvalidParameter(what + ": case '" + value.name + "' has no structure '" + structure +
                               "' with voxels; it has " + there);
}

} // namespace petrous::presenters
