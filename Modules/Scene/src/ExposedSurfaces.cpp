#include "petrous/Scene/ExposedSurfaces.h"

#include <utility>

#include "petrous/Scene/CaseField.h"
#include "petrous/Scene/StructureShares.h"

namespace petrous::scene
{

std::vector<ExposedSurface> exposedSurfaces(const Case& value, const volume::CutMask& mask,
                                            const core::Progress& progress)
{
  if (mask.untouched())
    return {};
  const volume::TissueField field = tissueField(value, progress.part(0.0, 0.3));
  const auto shares = structureShares(value); // after the field, which makes those of meshes
  std::vector<ExposedSurface> exposed;
  for (std::size_t n = 0; n < shares.size(); ++n)
  {
    const double done = 0.3 + 0.7 * static_cast<double>(n) / static_cast<double>(shares.size());
    progress.report(done, "measuring what was laid open");
    const auto share = shares[n].make();
    const double area = dissection::exposedArea(field, mask, *share, progress.part(done, done));
    if (area > 0.0)
      exposed.push_back({shares[n].name, area});
  }
  return exposed;
}

std::vector<ExposedSurface> exposedSurfaces(const Case& value, const core::Progress& progress)
{
  if (!value.dissection)
    throw core::InvalidParameter("what was laid open: the case's dissection is not loaded");
  return exposedSurfaces(value, std::as_const(*value.dissection).mask(), progress);
}

} // namespace petrous::scene
