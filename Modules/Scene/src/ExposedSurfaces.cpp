#include "petrous/Scene/ExposedSurfaces.h"

#include <algorithm>
#include <utility>

#include "petrous/Scene/CaseField.h"
#include "petrous/Scene/StructureOccupancy.h"

namespace petrous::scene
{

std::vector<std::vector<ExposedSurface>>
exposedSurfaces(const Case& value, const std::vector<const volume::CutMask*>& masks,
                const core::Progress& progress)
{
  std::vector<std::vector<ExposedSurface>> exposed(masks.size());
  if (std::all_of(masks.begin(), masks.end(),
                  [](const volume::CutMask* mask) { return mask->untouched(); }))
    return exposed;
  const volume::TissueField field = tissueField(value, progress.part(0.0, 0.3));
  const auto occupancies = structureOccupancies(value); // after the field, which voxelizes meshes
  for (std::size_t n = 0; n < occupancies.size(); ++n)
  {
    const double done =
        0.3 + 0.7 * static_cast<double>(n) / static_cast<double>(occupancies.size());
    progress.report(done, "measuring what was laid open");
    const auto occupancy = occupancies[n].make();
    for (std::size_t m = 0; m < masks.size(); ++m)
      if (const double area =
              dissection::exposedArea(field, *masks[m], *occupancy, progress.part(done, done));
          area > 0.0)
        exposed[m].push_back({occupancies[n].name, area});
  }
  return exposed;
}

std::vector<ExposedSurface> exposedSurfaces(const Case& value, const core::Progress& progress)
{
  if (!value.dissection.loaded())
    throw core::InvalidParameter("what was laid open: the case's dissection is not loaded");
  return exposedSurfaces(value, {&value.dissection.mask()}, progress).front();
}

} // namespace petrous::scene
