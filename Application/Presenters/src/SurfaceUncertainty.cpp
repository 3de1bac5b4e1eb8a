#include "petrous/Presenters/SurfaceUncertainty.h"

#include <cmath>
#include <cstdio>

namespace petrous::presenters
{

double SurfaceUncertainty::millimetres() const
{
  return std::hypot(0.5 * sliceSpacing(), registration.value_or(0.0));
}

SurfaceUncertainty uncertaintyOf(const scene::Case& value, const scene::StructureShare& structure)
{
  SurfaceUncertainty result;
  result.voxel = structure.grid.spacing();
  result.drawnOn = structure.mr;
  const scene::ImagePart* mr = scene::findMr(value, structure.mr);
  if (mr && mr->registration && mr->registration->error)
  {
    const scene::RegistrationError& error = *mr->registration->error;
    result.registration = error.p95;
    result.place = error.place;
    result.away = (structure.around.center() - error.point).norm();
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
  if (!uncertainty.registration)
    return words + "registered, its error unknown";
  std::snprintf(text, sizeof text, "registered to %.2f mm (p95) at ", *uncertainty.registration);
  words += text + uncertainty.place;
  std::snprintf(text, sizeof text, ", %.0f mm from here", uncertainty.away);
  return words + text;
}

} // namespace petrous::presenters
