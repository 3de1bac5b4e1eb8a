#include "petrous/Presenters/SurfaceUncertainty.h"

#include <cmath>

#include "petrous/Core/NumberText.h"

namespace petrous::presenters
{

double SurfaceUncertainty::millimetres() const
{
  return std::hypot(0.5 * sliceSpacing(), registration.value_or(0.0));
}

SurfaceUncertainty uncertaintyOf(const scene::Case& value,
                                 const scene::StructureOccupancy& structure)
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

std::string toString(const SurfaceUncertainty& uncertainty)
{
  using core::fixedText;
  std::string words = "voxels " + fixedText(uncertainty.voxel[0], 2) + " x " +
                      fixedText(uncertainty.voxel[1], 2) + " x " +
                      fixedText(uncertainty.voxel[2], 2) + " mm, slices " +
                      fixedText(uncertainty.sliceSpacing(), 2) + " mm apart";
  if (uncertainty.drawnOn.empty())
    return words;
  words += "; drawn on the MR '" + uncertainty.drawnOn + "', ";
  if (!uncertainty.registration)
    return words + "registered, its error unknown";
  return words + "registered to " + fixedText(*uncertainty.registration, 2) + " mm (p95) at " +
         uncertainty.place + ", " + fixedText(uncertainty.away, 0) + " mm from here";
}

} // namespace petrous::presenters
