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

/// Most memory that the voxels of one mesh may take.
constexpr std::size_t kMaxMeshBytes = std::size_t{64} << 20;

/// How far a mesh may reach beyond a region, mm: as far as that is large, and 500, as whole heads
/// lie beside the CT of one ear. Beyond, a coordinate lost its point or is in another unit.
double maxReach(const core::PatientBox& region);

/// How far beyond the region the farthest of the mesh's vertices is, mm; 0 where none is.
double reachBeyond(const core::TriangleMesh& mesh, const core::PatientBox& region);

struct MeshSolidLimits
{
  double spacing = 0.0; ///< mm, > 0; voxels are never larger where memory permits: the CT's finest
  /// Where the solid is needed; everywhere when absent.
  std::optional<core::PatientBox> region;
  std::size_t maxBytes = kMaxMeshBytes;
};

/// Whether and how finely a mesh becomes voxels.
struct MeshSolidPlan
{
  std::string refusal;     ///< why it cannot be, in words that follow the mesh's name; else empty
  core::GridGeometry grid; ///< along the patient axes, round the mesh or its part in the region
  double thickness = 0.0;  ///< mm; a five-hundredth of the surface bounds thinner parts

  explicit operator bool() const noexcept { return refusal.empty(); }
};

/// Plans the voxels of a closed mesh.
///
/// The voxel edge e is the smallest of
///   h                the spacing asked for
///   t / 3            t the thickness: what lies between the surface and the wall across from it,
///                    where the two face one another within 20 degrees, so that an
///                    edge of something thick does not count
///   sqrt(0.08 t h)   so that trilinear interpolation of the distance to a surface of radius t/2
///                    errs by at most about e^2/8 (2/t + 2/t) = 0.04 h
/// Where memory does not permit it, voxels are larger, up to half the thickness that a fiftieth of
/// the surface falls below. A mesh that needs more memory even so is refused, and so is one that is
/// not closed, encloses nothing, lies outside the region, or reaches beyond it farther than
/// mostReach. Only what lies within the region, and as far beyond as that is large, costs time.
///
/// A mesh is closed when an even number of triangles meets at each edge: shells may lie apart,
/// touch, overlap or be nested. Corners closer than 1e-7 of the mesh's size count as one.
///
/// Throws InvalidParameter for limits out of range and a mesh that names vertices it does not have;
/// CancelledError.
MeshSolidPlan planMeshSolid(const core::TriangleMesh& mesh, const MeshSolidLimits& limits,
                            const core::Progress& progress = {});

/// Occupancy of "inside" on the plan's grid, as TissueField takes it: 0.5 + d / 6e within 0 to 1, d the
/// exact distance to the surface in mm, positive inside, so that value and central differences over
/// +-e are those of the distance itself at a plane surface. Its 0.5 level is the mesh's surface.
///
/// Inside is where the mesh winds round a point at all, whichever way its triangles face; where
/// they do not all face alike, where a ray to it crosses the surface an odd number of times. So
/// shells that overlap are united, and of nested ones the inner is a cavity when it faces the other
/// way. What lies inside the union is no surface.
///
/// Throws InvalidParameter for a plan that refuses; CancelledError.
std::shared_ptr<const Volume<float>> solidOf(const core::TriangleMesh& mesh,
                                             const MeshSolidPlan& plan,
                                             const core::Progress& progress = {});

/// Both at once; null when the plan refuses.
std::shared_ptr<const Volume<float>> solidOf(const core::TriangleMesh& mesh, double spacing,
                                             const core::Progress& progress = {});

/// Whether a point (patient LPS mm) lies inside a solid.
bool isInside(const Volume<float>& solid, const Eigen::Vector3d& patient) noexcept;

/// What a structure that must not be drilled needs: an occupancy on the voxels of `grid` (cut to a box
/// round the solid) which, interpolated between them, does not fall below 0.5 anywhere in the
/// solid, though parts of it be thinner than a voxel. Neighbours differ by 1/2 at most, as they do
/// in a smoothed union, so that the mask it is written to has no steeper walls than a cut. Null
/// where the solid reaches no voxel of the grid.
std::shared_ptr<const Volume<float>> protectionMaskOf(const Volume<float>& solid,
                                             const core::GridGeometry& grid);

} // namespace petrous::volume
