// What a planner does with the open case: how near structures are, how thick bone is, how MRs lie,
// approaches.

#include <utility>

#include "Tell.h"
#include "petrous/Presenters/WorkstationModel.h"
#include "petrous/Scene/Branches.h"

namespace petrous::presenters
{

std::optional<std::vector<NearbyStructure>> WorkstationModel::nearby(const Eigen::Vector3d& burr,
                                                                     double radius)
{
  if (!m_case)
    return std::nullopt;
  if (!m_nearby)
    m_nearby = std::make_unique<NearbyStructures>(*m_case);
  if (!m_nearby->ready())
    return std::nullopt;
  return m_nearby->around(*m_case, burr, radius, kNear, strokeSoFar());
}

const dissection::RemovedVolume& WorkstationModel::strokeSoFar()
{
  static const dissection::RemovedVolume kNothing;
  if (!m_case || !m_case->dissection || !m_scene)
    return kNothing;
  return m_meter.soFar(*m_case->dissection, m_scene->drill().measurer());
}

void WorkstationModel::forgetNearby()
{
  m_nearby.reset();
}

void WorkstationModel::goToBranch(const std::string& name)
{
  if (!m_case)
    return;
  stopTouch();
  scene::goToBranch(*m_case, name);
  followHistory();
}

void WorkstationModel::startBranch(const std::string& name)
{
  if (!m_case)
    return;
  stopTouch();
  scene::startBranch(*m_case, name);
  followHistory();
}

void WorkstationModel::showThickness(const std::string& structure)
{
  if (!m_case || structure == thicknessOver())
    return;
  SceneAssembly next = m_assembly;
  next.showThickness(structure);
  next.contents(*m_case);
  m_assembly = std::move(next);
  if (events.appearanceChanged)
    events.appearanceChanged();
}

void WorkstationModel::changeMr(const std::function<void(scene::Case&)>& change)
{
  if (!m_case || drilling())
    return;
  forgetTissue();
  m_nearby.reset();
  change(*m_case);
  tell(events.mrMoved);
  setUnsaved(true);
}

} // namespace petrous::presenters
