#pragma once

#include <memory>
#include <string>

#include "petrous/Volume/MeshSolid.h"

namespace petrous::scene
{

/// Haptic representation of a mesh: whether it can be touched, and its voxels, each computed on
/// first use and cached. Copies share the cache. Thread-safe.
///
/// Both are for one mesh and one CT grid; for another mesh or grid they are recomputed.
class MeshTouch
{
public:
  MeshTouch();

  /// Why the mesh cannot be voxelized, phrased to follow its name; empty if it can.
  std::string refusal(const std::shared_ptr<const core::TriangleMesh>& mesh,
                      const core::GridGeometry& ct) const;

  /// Occupancy of the interior (volume::solidOf) within the CT; nullptr if refused (see `refusal`).
  /// Voxels are as fine as the CT's smallest spacing, and finer if the mesh requires it. Throws
  /// CancelledError.
  std::shared_ptr<const volume::Volume<float>>
  solid(const std::shared_ptr<const core::TriangleMesh>& mesh, const core::GridGeometry& ct,
        const core::Progress& progress = {}) const;

  /// The voxels if already computed, else nullptr; never waits for a computation in progress. Nor
  /// does `refusal` if its answer is known.
  std::shared_ptr<const volume::Volume<float>> resident() const;

private:
  struct State;
  std::shared_ptr<State> m_state;
};

} // namespace petrous::scene
