#include "petrous/Scene/MeshTouch.h"

#include <mutex>
#include <optional>

namespace petrous::scene
{

struct MeshTouch::State
{
  // With the mutex held.
  const volume::MeshSolidPlan& planFor(const std::shared_ptr<const core::TriangleMesh>& wanted,
                                       const core::GridGeometry& ct)
  {
    if (plan && mesh == wanted && sameGrid(grid, ct))
      return *plan;
    plan.reset();
    solid = nullptr;
    volume::MeshSolidLimits limits;
    limits.spacing = ct.minSpacing();
    limits.region = ct.patientBounds();
    plan = volume::planMeshSolid(*wanted, limits);
    mesh = wanted;
    grid = ct;
    return *plan;
  }

  std::mutex mutex;
  std::shared_ptr<const core::TriangleMesh> mesh;
  core::GridGeometry grid; // the CT's
  std::optional<volume::MeshSolidPlan> plan;
  std::shared_ptr<const volume::Volume<float>> solid;
};

MeshTouch::MeshTouch()
  : m_state(std::make_shared<State>())
{
}

std::string MeshTouch::refusal(const std::shared_ptr<const core::TriangleMesh>& mesh,
                               const core::GridGeometry& ct) const
{
  const std::lock_guard<std::mutex> lock(m_state->mutex);
  return m_state->planFor(mesh, ct).refusal;
}

std::shared_ptr<const volume::Volume<float>>
MeshTouch::solid(const std::shared_ptr<const core::TriangleMesh>& mesh,
                 const core::GridGeometry& ct, const core::Progress& progress) const
{
  const std::lock_guard<std::mutex> lock(m_state->mutex);
  const volume::MeshSolidPlan& plan = m_state->planFor(mesh, ct);
  if (plan && !m_state->solid)
    m_state->solid = volume::solidOf(*mesh, plan, progress);
  return m_state->solid;
}

std::shared_ptr<const volume::Volume<float>> MeshTouch::resident() const
{
  const std::lock_guard<std::mutex> lock(m_state->mutex);
  return m_state->solid;
}

} // namespace petrous::scene
