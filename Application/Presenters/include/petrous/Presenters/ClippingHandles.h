#pragma once

#include <string>

#include "petrous/Core/GridGeometry.h"
#include "petrous/Scene/ViewState.h"

namespace petrous::presenters
{

/// As undo calls a change of what is cut away from the picture.
std::string clippingChange(const scene::ViewState::Clipping& before,
                           const scene::ViewState::Clipping& after);

/// The plane moved along its normal, mm; at most to where it still cuts the hull of the image's
/// voxel centres.
scene::ViewState::Clipping::Plane movedPlane(const scene::ViewState::Clipping::Plane& plane,
                                             double step, const core::GridGeometry& grid);

/// Where the handle of a plane stands, patient LPS mm: at its point, or where that is outside of
/// the hull, at the foot of the perpendicular from the middle of the image.
Eigen::Vector3d planeCenter(const scene::ViewState::Clipping::Plane& plane,
                            const core::GridGeometry& grid);

} // namespace petrous::presenters
