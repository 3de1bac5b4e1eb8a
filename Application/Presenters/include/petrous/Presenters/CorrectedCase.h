#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "petrous/Core/AxesCorrection.h"
#include "petrous/Core/Progress.h"
#include "petrous/Scene/Case.h"

namespace petrous::presenters
{

/// What of a case does not come along where the axes of its primary image are corrected, as it lies
/// by another image, by a registration to it as it was, or in it.
struct LeftBehind
{
  std::vector<std::string> mr;        ///< names
  std::vector<std::string> drawnOnMr; ///< names of structures and meshes
  std::size_t strokes = 0;            ///< of all approaches
  std::size_t measurements = 0;
  std::size_t attachments = 0;
  std::size_t savedViews = 0;
};
LeftBehind leftBehind(const scene::Case& value);

/// A new case, not saved, of a case's primary image with its axes corrected, after any correction
/// that it has: its voxels are not copied. What lies in its patient space, label maps and meshes,
/// comes along; which ear it is is open again. The given case stays. Throws InvalidParameter for
/// the identity; what reading voxels throws; CancelledError.
scene::Case correctedCase(const scene::Case& value, const core::AxesCorrection& axes,
                          const std::string& name, const core::Progress& progress = {});

} // namespace petrous::presenters
