#pragma once

#include "petrous/Volume/IntensityVolume.h"

namespace petrous::volume
{

/// A ball round the tissue, for framing a picture. Patient LPS mm.
struct TissueExtent
{
  Eigen::Vector3d center{0.0, 0.0, 0.0};
  double radius = 0.0;
};

/// The ball round the box that holds the voxels above `iso` but for the outermost hundredth along
/// each axis, so that a table's edge or a few noisy voxels do not shrink the patient in the
/// picture. The hull's own ball where nothing lies above `iso`. Looks at every second voxel.
TissueExtent tissueExtent(const IntensityVolume& image, double iso);

} // namespace petrous::volume
