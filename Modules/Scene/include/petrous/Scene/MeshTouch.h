#pragma once

#include <memory>
#include <string>

#include "petrous/Volume/MeshSolid.h"

namespace petrous::scene
{

/// A mesh as the hand feels it: whether it can be felt, and its voxels, each made when first asked
/// for and kept. Copies occupancy what is made. Thread-safe.
///
/// Both are for one mesh and one CT grid; asked with another mesh or grid, they are made anew.
class MeshTouch
{
public:
  MeshTouch();

  /// Why the mesh cannot become voxels, in words that follow its name; empty when it can.
  std::string refusal(const std::shared_ptr<const core::TriangleMesh>& mesh,
                      const core::GridGeometry& ct) const;

  /// Occupancy of "inside" (volume::solidOf) where the CT is; null where `refusal` says why not. Voxels
  /// are as fine as the CT's finest, and finer where the mesh needs it. Throws CancelledError.
  std::shared_ptr<const volume::Volume<float>>
  solid(const std::shared_ptr<const core::TriangleMesh>& mesh, const core::GridGeometry& ct,
        const core::Progress& progress = {}) const;

  /// The voxels where they are made already, else null; never waits for who makes them. Nor does
  /// `refusal` where it is known.
  std::shared_ptr<const volume::Volume<float>> resident() const;

private:
  struct State;
  std::shared_ptr<State> m_state;
};

} // namespace petrous::scene
