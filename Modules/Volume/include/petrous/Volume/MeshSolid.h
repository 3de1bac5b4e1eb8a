#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <string>

#include "petrous/Core/PatientBox.h"
#include "petrous/Core/Progress.h"
#include "petrous/Core/TriangleMesh.h"
#include "petrous/Volume/Volume.h"

namespace petrous::volume
{

/// Maximum memory for the voxels of one mesh.
constexpr std::size_t kMaxMeshBytes = std::size_t{64} << 20;

/// Maximum distance that a mesh may reach beyond a region, mm: the diagonal of the region, and at
/// least 500, since a mesh may cover the whole head with a CT of one ear. Beyond that, a coordinate
/// lacks its decimal point or is in another unit.
double maxReach(const core::PatientBox& region);

/// Distance of the mesh's farthest vertex beyond the region, mm; 0 if all are inside.
double reachBeyond(const core::TriangleMesh& mesh, const core::PatientBox& region);

struct MeshSolidLimits
{
  double spacing = 0.0; ///< mm, > 0; maximum voxel edge if memory permits: the CT's minimum spacing
  /// Region in which the solid is needed; everywhere if absent.
  std::optional<core::PatientBox> region;
  std::size_t maxBytes = kMaxMeshBytes;
};

/// Whether a mesh can be voxelised, and how finely.
struct MeshSolidPlan
{
  std::string refusal;     ///< reason if it cannot, worded to follow the mesh's name; else empty
  core::GridGeometry grid; ///< along the patient axes, around the mesh or its part in the region
  double thickness = 0.0;  ///< mm; a five-hundredth of the surface bounds thinner parts

  explicit operator bool() const noexcept { return refusal.empty(); }
};

/// Plans the voxelisation of a closed mesh.
///
/// The voxel edge e is the minimum of
///   h                the requested spacing
///   t / 3            t the thickness: distance between the surface and the opposite wall, where
///                    the two are parallel within 20 degrees, so that an edge of something thick
///                    does not count
///   sqrt(0.08 t h)   so that trilinear interpolation of the distance to a surface of radius t/2
///                    has an error of at most about e^2/8 (2/t + 2/t) = 0.04 h
/// If memory does not permit this, voxels are larger, up to half the thickness that bounds a
/// fiftieth of the surface. A mesh that needs more memory even so is refused, as is one that is not
/// closed, encloses nothing, lies outside the region, or reaches farther beyond it than maxReach.
/// Only the part within the region, and within its diagonal around it, costs time.
///
/// A mesh is closed if an even number of triangles meets at each edge: shells may be separate,
/// touch, overlap or be nested. Vertices closer than 1e-7 of the mesh's size are merged.
///
/// Throws InvalidParameter for limits out of range and for a mesh with vertex indices out of range;
/// CancelledError.
MeshSolidPlan planMeshSolid(const core::TriangleMesh& mesh, const MeshSolidLimits& limits,
                            const core::Progress& progress = {});

/// Occupancy of the interior on the plan's grid, as TissueField takes it: 0.5 + d / 6e, clamped to
/// 0 to 1, d the exact signed distance to the surface in mm, positive inside, so that value and
/// central differences over +-e are those of the distance itself at a plane surface. Its 0.5 level
/// is the mesh's surface.
///
/// A point is inside if its winding number is not 0, whatever the orientation of the triangles; if
/// they are not consistently oriented, if a ray to it crosses the surface an odd number of times.
/// So overlapping shells are united, and of nested ones the inner is a cavity if it is oriented the
/// other way. Parts of the mesh inside the union are not surface.
///
/// Throws InvalidParameter for a plan that refuses; CancelledError.
std::shared_ptr<const Volume<float>> solidOf(const core::TriangleMesh& mesh,
                                             const MeshSolidPlan& plan,
                                             const core::Progress& progress = {});

/// Whether a point (patient LPS mm) lies inside a solid.
bool isInside(const Volume<float>& solid, const Eigen::Vector3d& patient) noexcept;

/// Protection mask of a structure that must not be drilled: an occupancy on the voxels of `grid`
/// (cropped to a box around the solid) whose interpolated value is at least 0.5 everywhere in the
/// solid, even where it is thinner than a voxel. Neighbours differ by at most 1/2, as in a smoothed
/// union, so that the mask has no steeper walls than a cut. Returns nullptr if the solid reaches no
/// voxel of the grid.
std::shared_ptr<const Volume<float>> protectionMaskOf(const Volume<float>& solid,
                                                      const core::GridGeometry& grid);

} // namespace petrous::volume
