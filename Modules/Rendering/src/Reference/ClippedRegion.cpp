#include "petrous/Rendering/ClippedRegion.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "petrous/Rendering/RenderingError.h"

namespace petrous::rendering
{

namespace
{
constexpr double kParallel = 1e-14; // cosine below which a ray is parallel to a face
constexpr double kInset = 1e-9; // relative to the distance: keeps the ends inside despite rounding
struct Side
{
  ClippingPlane plane;
  bool isCut; // not of the hull
};

std::vector<Side> sidesOf(const core::GridGeometry& grid, const core::IndexBox& box)
{
  const Eigen::Vector3d lower(box.lower[0], box.lower[1], box.lower[2]);
  const Eigen::Vector3d upper(box.upper[0] - 1.0, box.upper[1] - 1.0, box.upper[2] - 1.0);
  std::vector<Side> sides;
  for (int axis = 0; axis < 3; ++axis)
  {
    const Eigen::Vector3d rising = grid.voxelFromPatientLinear().row(axis).transpose().normalized();
    sides.push_back({{grid.patientFromVoxel(lower), rising}, lower[axis] > 0.0});
    sides.push_back({{grid.patientFromVoxel(upper), -rising},
                     upper[axis] < grid.dims()[static_cast<std::size_t>(axis)] - 1.0});
  }
  return sides;
}

} // namespace

std::vector<ClippingPlane> cutsOf(const SceneContents& contents)
{
  std::vector<ClippingPlane> cuts;
  if (contents.ct && contents.crop)
  {
    const core::GridGeometry& grid = contents.ct->geometry();
    for (const Side& side : sidesOf(grid, contents.crop->intersected(grid.fullBox())))
      if (side.isCut)
        cuts.push_back(side.plane);
  }
  for (const ClippingPlane& plane : contents.clipping)
    cuts.push_back({plane.point, plane.normal.normalized()});
  return cuts;
}

ClippedRegion::ClippedRegion(const core::GridGeometry& grid,
                             const std::optional<core::IndexBox>& crop,
                             const std::vector<ClippingPlane>& planes)
{
  const core::IndexBox box = crop ? crop->intersected(grid.fullBox()) : grid.fullBox();
  for (std::size_t a = 0; a < 3; ++a)
    m_empty = m_empty || box.upper[a] - box.lower[a] < 2;
  for (const Side& side : sidesOf(grid, box))
    keep(side.plane, side.isCut);
  keep(planes);
}

ClippedRegion::ClippedRegion(const std::vector<ClippingPlane>& planes)
{
  keep(planes);
}

void ClippedRegion::keep(const std::vector<ClippingPlane>& planes)
{
  for (const ClippingPlane& plane : planes)
  {
    if (!plane.point.allFinite() || !(plane.normal.norm() > 0.0) || !plane.normal.allFinite())
      throw RenderingError(RenderingError::Reason::BadContents,
                           "picture: a clipping plane needs a point and a normal");
    keep(plane, true);
  }
}

void ClippedRegion::keep(const ClippingPlane& plane, bool isCut)
{
  const Eigen::Vector3d unit = plane.normal.normalized();
  m_sides.push_back({unit, -unit.dot(plane.point), isCut});
}

bool ClippedRegion::contains(const Eigen::Vector3d& patient) const
{
  return !m_empty && std::all_of(m_sides.begin(), m_sides.end(),
                                 [&patient](const HalfSpace& side)
                                 { return side.inwards.dot(patient) + side.offset >= 0.0; });
}

RaySpan ClippedRegion::clip(const PixelRay& ray) const
{
  RaySpan span;
  if (m_empty)
    return span;
  span.last = std::numeric_limits<double>::infinity();
  for (const HalfSpace& side : m_sides)
  {
    const double height = side.inwards.dot(ray.origin) + side.offset;
    const double slope = side.inwards.dot(ray.direction);
    if (std::abs(slope) < kParallel)
    {
      if (height < 0.0)
        return {};
      continue;
    }
    const double t = -height / slope;
    if (slope < 0.0)
      span.last = std::min(span.last, t);
    else if (t > span.first)
    {
      span.first = t;
      span.face = -side.inwards;
      span.isCut = side.isCut;
    }
  }
  // Spans thinner than rounding are empty; the inset would reverse their ends.
  const double inset = kInset * (1.0 + (std::isfinite(span.last) ? span.last : span.first));
  if (!(span.last - span.first > 2.0 * inset))
    return {};
  span.first += inset;
  span.last -= inset;
  return span;
}

} // namespace petrous::rendering
