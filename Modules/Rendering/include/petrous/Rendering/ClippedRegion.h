#pragma once

#include <optional>
#include <vector>

#include "petrous/Core/GridGeometry.h"
#include "petrous/Rendering/PixelRays.h"
#include "petrous/Rendering/SceneContents.h"

namespace petrous::rendering
{

/// Where a ray may meet tissue: [first, last], mm along the ray.
struct RaySpan
{
  double first = 0.0;
  double last = -1.0; ///< < first: nowhere
  /// Unit normal of the entry face; none: starts at the camera.
  std::optional<Eigen::Vector3d> face;
  bool isCut = false; ///< the face is of the crop box or of a clipping plane, not of the hull
};

/// The faces at which crop box and clipping planes cut what is drawn, normals towards what is kept:
/// the sides of the box that lie within the image, and the planes. `contents` as checked.
std::vector<ClippingPlane> cutsOf(const SceneContents& contents);

/// The drawn part of the CT: the hull of its voxel centres (of those in the crop box, if any) on
/// the positive side of every clipping plane. A convex polyhedron.
class ClippedRegion
{
public:
  /// Throws RenderingError BadContents for a plane without a normal.
  ClippedRegion(const core::GridGeometry& grid, const std::optional<core::IndexBox>& crop,
                const std::vector<ClippingPlane>& planes);

  /// All on the positive side of some planes, as far as a ray goes.
  explicit ClippedRegion(const std::vector<ClippingPlane>& planes);

  RaySpan clip(const PixelRay& ray) const;
  bool contains(const Eigen::Vector3d& patient) const; ///< with its faces

private:
  struct HalfSpace
  {
    Eigen::Vector3d inwards; // unit
    double offset;           // inside where inwards . x + offset >= 0
    bool isCut;              // not of the hull
  };
  void keep(const std::vector<ClippingPlane>& planes);
  void keep(const ClippingPlane& plane, bool isCut);

  std::vector<HalfSpace> m_sides;
  bool m_empty = false;
};

} // namespace petrous::rendering
