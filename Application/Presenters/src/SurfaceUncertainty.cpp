#include "petrous/Presenters/SurfaceUncertainty.h"

#include <cmath>
#include <cstdio>

namespace petrous::presenters
{

double SurfaceUncertainty::millimetres() const
{
  return std::hypot(0.5 * sliceSpacing(), registration.value_or(0.0));
}

SurfaceUncertainty uncertaintyOf(const scene::Case& value, const core::GridGeometry& grid)
{
  SurfaceUncertainty result;
  result.voxel = grid.spacing();
  if (core::sameGrid(grid, value.ct.geometry))
    return result;
  for (const scene::ImagePart& mr : value.mr)
    if (core::sameGrid(grid, mr.geometry))
    {
      result.drawnOn = mr.name;
      result.registered = mr.registered;
      break;
    }
  return result;
}

std::string inWords(const SurfaceUncertainty& uncertainty)
{
  char text[96];
  std::snprintf(text, sizeof text, "voxels %.2f x %.2f x %.2f mm, slices %.2f mm apart",
                uncertainty.voxel[0], uncertainty.voxel[1], uncertainty.voxel[2],
                uncertainty.sliceSpacing());
  std::string words = text;
  if (uncertainty.drawnOn.empty())
    return words;
  words += "; drawn on the MR '" + uncertainty.drawnOn + "', ";
  if (!uncertainty.registered)
    return words + "registration unknown";
  if (!uncertainty.registration)
    return words + "registered, its error unknown";
  std::snprintf(text, sizeof text, "registered to %.2f mm (p95)", *uncertainty.registration);
  return words + text;
}

} // namespace petrous::presenters
