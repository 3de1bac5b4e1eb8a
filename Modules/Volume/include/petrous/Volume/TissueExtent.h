#pragma once

#include "petrous/Volume/IntensityVolume.h"

namespace petrous::volume
{

/// A bounding sphere of the tissue, for framing a view. Patient LPS mm.
struct TissueExtent
{
  Eigen::Vector3d center{0.0, 0.0, 0.0};
  double radius = 0.0;
};

/// Bounding sphere of the box that contains the voxels above `iso` except for the outermost
/// hundredth along each axis, so that a table's edge or a few noisy voxels do not shrink the
/// patient in the view. The sphere around the hull if nothing is above `iso`. Reads every second
/// voxel per axis.
TissueExtent tissueExtent(const IntensityVolume& image, double iso);

/// The box that contains the voxels above `iso` except for the outermost `outliers` of them at each
/// end of each axis of the grid; of all of the image if there are none. Patient LPS mm. Reads every
/// second voxel per axis.
core::PatientBox tissueBox(const IntensityVolume& image, double iso, double outliers);

/// The patient's side on which an image of one ear opens into the air around the head: 1 left, -1
/// right. The one of the outer sixths along the left-right axis of which more lies below `air`, if
/// that is a tenth of it or more; 0: neither. Reads every second voxel per axis.
int openSide(const IntensityVolume& image, double air);

} // namespace petrous::volume
