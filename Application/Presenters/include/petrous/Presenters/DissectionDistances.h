#pragma once

#include <optional>
#include <string>
#include <vector>

#include "petrous/Core/Progress.h"
#include "petrous/Presenters/Measuring.h"
#include "petrous/Scene/Case.h"
#include "petrous/Volume/CutMask.h"

namespace petrous::presenters
{

/// How near what was drilled came to a structure.
struct DissectionDistance
{
  std::string name;
  Quantity distance;                    ///< mm; 0: reached
  double injured = 0.0;                 ///< mm^3 removed from it; of a lumen, which is opened, 0
  Eigen::Vector3d place{0.0, 0.0, 0.0}; ///< of the cavity's wall, patient LPS mm
};

/// Points of the cavity's wall: where edges between voxel centres cross one half of the remaining
/// fraction, linearly; patient LPS mm.
std::vector<Eigen::Vector3d> cavityWall(const volume::CutMask& mask);

/// The distance of the cavity's wall from each structure that is drawn or touchable as a volume,
/// nearest first. The wall is where a burr was, in bone or in air.
///
/// The uncertainty is that of the structure's surface (SurfaceUncertainty) and half the longest
/// edge of the CT's voxels for the wall, independently; none where the structure was drawn on an MR
/// whose error is unknown. Loads labels; needs the dissection loaded, else throws InvalidParameter.
/// Empty where nothing was drilled. Throws CancelledError.
std::vector<DissectionDistance> dissectionDistances(const scene::Case& value,
                                                    const core::Progress& progress = {});

} // namespace petrous::presenters
