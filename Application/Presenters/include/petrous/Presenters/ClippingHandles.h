#pragma once

#include <optional>
#include <string>
#include <vector>

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

/// By which a cut line is dragged: all of it moves the plane along its normal, and one of its ends
/// turns it.
enum class CutPart
{
  Line,
  End
};
/// Where the ends are taken, pixels: on the line, away from the picture's edge and its letters.
/// None on a line that is too short for both.
std::vector<Eigen::Vector2d> endsOf(const CutLine& line);
/// What lies within `reach` of a place, pixels; of an end and the line the end.
std::optional<CutPart> partAt(const CutLine& line, const Eigen::Vector2d& pixel, double reach);

/// About which a plane turns in a slice, patient LPS mm: that point of its line that is nearest to
/// its handle (planeCenter), within the middle half of the line. Requires that it has a line there.
Eigen::Vector3d pivotInSlice(const scene::ViewState::Clipping::Plane& plane,
                             const core::GridGeometry& grid, const SliceGeometry& slice);

/// The plane turned about an axis, unit, through a point, patient LPS mm, right-handed; then moved
/// along its normal by the least, if at all, with which it cuts the hull as movedPlane does.
scene::ViewState::Clipping::Plane turnedPlane(const scene::ViewState::Clipping::Plane& plane,
                                              const Eigen::Vector3d& axis,
                                              const Eigen::Vector3d& through, double radians,
                                              const core::GridGeometry& grid);

/// By which a drag from one point to another turns about an axis, unit, through a point; radians,
/// right-handed, -pi to pi.
double draggedAngle(const Eigen::Vector3d& axis, const Eigen::Vector3d& through,
                    const Eigen::Vector3d& from, const Eigen::Vector3d& to);

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
