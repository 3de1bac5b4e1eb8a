#include "petrous/Presenters/SurfaceUncertainty.h"

#include <cmath>

#include "petrous/Core/NumberText.h"

namespace petrous::presenters
{

using core::fixedText;

std::optional<RegistrationErrorHere>
registrationErrorIn(const scene::Case& value, const std::string& mr, const core::PatientBox& box)
{
  const scene::ImagePart* image = scene::findMr(value, mr);
  if (!image || !image->registration || !image->registration->error)
    return std::nullopt;
  const scene::RegistrationError& error = *image->registration->error;
  if (error.spread)
    return RegistrationErrorHere{core::largestP95(*error.spread, box), {}, 0.0};
  return RegistrationErrorHere{error.p95, error.place, (box.center() - error.point).norm()};
}

std::string toString(const RegistrationErrorHere& error)
{
  if (error.place.empty())
    return "registered to " + fixedText(error.p95, 2) + " mm (p95) here";
  return "registered to " + fixedText(error.p95, 2) + " mm (p95) at " + error.place + ", " +
         fixedText(error.away, 0) + " mm from here, where it may be more";
}

double SurfaceUncertainty::millimetres() const
{
  return std::hypot(0.5 * sliceSpacing(), registration ? registration->p95 : 0.0);
}

SurfaceUncertainty uncertaintyOf(const scene::Case& value,
                                 const scene::StructureOccupancy& structure)
{
  SurfaceUncertainty result;
  result.voxel = structure.grid.spacing();
  result.drawnOn = structure.mr;
  result.madeFrom = scene::namesOf(structure.readings);
  result.outdated = scene::outdatedReading(value, structure.readings);
  std::vector<std::string> images;
  if (!structure.mr.empty())
    images.push_back(structure.mr);
  for (const scene::MrReading& reading : structure.readings)
    images.push_back(reading.mr);
  for (const std::string& image : images)
  {
    const auto error = registrationErrorIn(value, image, structure.around.patientBounds());
    if (!error || !result.outdated.empty())
    {
      result.registration.reset();
      break;
    }
    if (!result.registration || error->p95 > result.registration->p95)
      result.registration = error;
  }
  return result;
}

std::string toString(const SurfaceUncertainty& uncertainty)
{
  std::string words = "voxels " + fixedText(uncertainty.voxel[0], 2) + " x " +
                      fixedText(uncertainty.voxel[1], 2) + " x " +
                      fixedText(uncertainty.voxel[2], 2) + " mm, slices " +
                      fixedText(uncertainty.sliceSpacing(), 2) + " mm apart";
  if (!uncertainty.isOfMr())
    return words;
  if (!uncertainty.drawnOn.empty())
    words += "; drawn on the MR '" + uncertainty.drawnOn + "'";
  if (!uncertainty.madeFrom.empty())
    words += "; made from the MR " + uncertainty.madeFrom;
  if (!uncertainty.outdated.empty())
    return words + "; " + uncertainty.outdated;
  if (!uncertainty.registration)
    return words + ", registered, its error unknown";
  return words + "; " + toString(*uncertainty.registration);
}

} // namespace petrous::presenters
