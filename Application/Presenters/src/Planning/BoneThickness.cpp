#include "petrous/Presenters/BoneThickness.h"

#include "NamedOccupancy.h"
#include "petrous/Volume/DistanceField.h"

namespace petrous::presenters
{

std::shared_ptr<const volume::Volume<float>> boneThickness(const scene::Case& value,
                                                           const std::string& structure,
                                                           const core::Progress& progress)
{
  const auto occupancy =
      namedOccupancy(value, structure, "thickness", progress.part(0.0, 0.3)).make();
  if (auto field = occupancy ? volume::makeDistanceField(*occupancy, kFarthestThickness,
                                                         progress.part(0.3, 1.0))
                             : nullptr)
    return field;
  throw core::InvalidParameter("thickness: '" + structure + "' encloses nothing");
}

} // namespace petrous::presenters
