#pragma once

#include <optional>
#include <string>

#include "petrous/Core/GridGeometry.h"
#include "petrous/Interaction/PickRay.h"
#include "petrous/Presenters/SliceGeometry.h"
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

/// Where a plane cuts a slice: across its picture, in pixels.
struct CutLine
{
  Eigen::Vector2d from, to;
  Eigen::Vector2d kept; ///< unit, to the side that stays
};
/// nullopt: outside of the picture, or within about 0.1 degrees of parallel to the slice.
std::optional<CutLine> lineInSlice(const scene::ViewState::Clipping::Plane& plane,
                                   const SliceGeometry& slice);

/// How far along its normal a plane lies behind the first tissue that the line through
/// planeCenter meets there, mm; negative before it, nullopt where there is none.
std::optional<double> depthOf(const scene::ViewState::Clipping::Plane& plane,
                              const core::GridGeometry& grid,
                              const interaction::TissueQuery& tissue);

/// Where the handle of a plane stands, patient LPS mm: at its point, or where that is outside of
/// the hull, at the foot of the perpendicular from the middle of the image.
Eigen::Vector3d planeCenter(const scene::ViewState::Clipping::Plane& plane,
                            const core::GridGeometry& grid);

} // namespace petrous::presenters
