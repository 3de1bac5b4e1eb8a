#include "petrous/Scene/MeshTouch.h"

#include <mutex>

namespace petrous::scene
{

// `making` is held during computations, for seconds if a mesh is large. `mutex` is held only to
// copy pointers, so that queries of known results never wait for a computation.
struct MeshTouch::State
{
  using Plan = std::shared_ptr<const volume::MeshSolidPlan>;
  using Solid = std::shared_ptr<const volume::Volume<float>>;

  // nullptr if none is known for this mesh and grid.
  Plan planKnown(const std::shared_ptr<const core::TriangleMesh>& wanted,
                 const core::GridGeometry& ct) const
  {
    const std::lock_guard<std::mutex> lock(mutex);
    return plan && mesh == wanted && sameGrid(grid, ct) ? plan : nullptr;
  }

  // Requires `making` to be held.
  Plan planFor(const std::shared_ptr<const core::TriangleMesh>& wanted,
               const core::GridGeometry& ct)
  {
    if (Plan known = planKnown(wanted, ct))
      return known;
    {
      const std::lock_guard<std::mutex> lock(mutex);
      plan = nullptr;
      solid = nullptr;
    }
    volume::MeshSolidLimits limits;
    limits.spacing = ct.minSpacing();
    limits.region = ct.patientBounds();
    auto made =
        std::make_shared<const volume::MeshSolidPlan>(volume::planMeshSolid(*wanted, limits));
    const std::lock_guard<std::mutex> lock(mutex);
    plan = made;
    mesh = wanted;
    grid = ct;
    return made;
  }

  Solid solidKnown() const
  {
    const std::lock_guard<std::mutex> lock(mutex);
    return solid;
  }

  std::mutex making;
  mutable std::mutex mutex; // guards the following members
  std::shared_ptr<const core::TriangleMesh> mesh;
  core::GridGeometry grid; // the CT's
  Plan plan;
  Solid solid;
};

MeshTouch::MeshTouch()
  : m_state(std::make_shared<State>())
{
}

std::string MeshTouch::refusal(const std::shared_ptr<const core::TriangleMesh>& mesh,
                               const core::GridGeometry& ct) const
{
  if (const State::Plan known = m_state->planKnown(mesh, ct))
    return known->refusal;
  const std::lock_guard<std::mutex> lock(m_state->making);
  return m_state->planFor(mesh, ct)->refusal;
}

std::shared_ptr<const volume::Volume<float>>
MeshTouch::solid(const std::shared_ptr<const core::TriangleMesh>& mesh,
                 const core::GridGeometry& ct, const core::Progress& progress) const
{
  const std::lock_guard<std::mutex> lock(m_state->making);
  const State::Plan plan = m_state->planFor(mesh, ct);
  if (State::Solid known = m_state->solidKnown())
    return known;
  if (!*plan)
    return nullptr;
  State::Solid made = volume::solidOf(*mesh, *plan, progress);
  const std::lock_guard<std::mutex> publishing(m_state->mutex);
  m_state->solid = made;
  return made;
}

std::shared_ptr<const volume::Volume<float>> MeshTouch::resident() const
{
  return m_state->solidKnown();
}

} // namespace petrous::scene
