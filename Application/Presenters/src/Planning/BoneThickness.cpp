#include "petrous/Presenters/BoneThickness.h"

#include "petrous/Presenters/IntensityDisplay.h"
#include "petrous/Scene/CaseField.h"
#include "petrous/Scene/Placement.h"
#include "petrous/Scene/StructureOccupancy.h"
#include "petrous/Volume/DistanceField.h"

namespace petrous::presenters
{

std::shared_ptr<const volume::Volume<float>> boneThickness(const scene::Case& value,
                                                           const std::string& structure,
                                                           const core::Progress& progress)
{
  if (const std::string missing = scene::missingPlace(value, structure); !missing.empty())
    throw core::InvalidParameter("thickness: '" + structure + "' is nowhere on the " +
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
      mesh.touch.solid(scene::meshOnCt(value, mesh), value.ct.geometry, progress.part(0.0, 0.3));
  }
  for (const scene::StructureOccupancy& occupancy : scene::structureOccupancies(value))
    if (occupancy.name == structure)
      if (auto field = volume::makeDistanceField(*occupancy.make(), kFarthestThickness,
                                                 progress.part(0.3, 1.0)))
        return field;
  if (there.empty())
    throw core::InvalidParameter("thickness: case '" + value.name + "' has no structures");
  throw core::InvalidParameter("thickness: case '" + value.name + "' has no structure '" +
                               structure + "' with voxels; it has " + there);
}

} // namespace petrous::presenters
