#include "petrous/Presenters/DrillSession.h"

#include <ctime>

#include "petrous/Scene/CaseField.h"

namespace petrous::presenters
{

namespace
{

dissection::RemovedVolume removedBy(const dissection::Dissection& work,
                                    const volume::TissueField& field,
                                    const std::vector<dissection::NamedStructure>& structures)
{
  return dissection::measureRemoved(field, work.maskBeforeStroke(), work.mask(), work.openBricks(),
                                    structures);
}

} // namespace

DrillSession::DrillSession(scene::Case& value)
  : m_case(value)
  , m_field(scene::tissueField(value))
  , m_keep(scene::protectedTissue(value))
  , m_structures(scene::drillableStructures(value))
{
  if (!value.dissection)
    throw core::InvalidParameter("drill: the case's dissection is not loaded");
}

void DrillSession::begin(const dissection::Burr& burr, const std::string& startedAt, double seconds,
                         const std::optional<core::CameraPose>& camera)
{
  dissection::StrokeInfo info;
  info.startedAt = startedAt;
  info.burr = burr;
  info.camera = camera;
  m_case.dissection->beginStroke(info);
  m_last.reset();
  m_startedAt = seconds;
}

bool DrillSession::drilling() const noexcept
{
  return m_case.dissection->strokeOpen();
}

bool DrillSession::moveTo(const Eigen::Vector3d& patient, double seconds)
{
  if (!drilling())
    return false;
  auto& info = m_case.dissection->openInfo();
  info.duration = seconds - m_startedAt;
  const bool resting = m_last && *m_last == patient;
  const Eigen::Vector3d from = m_last.value_or(patient);
  m_last = patient;
  if (resting)
    return false;
  return m_case.dissection->cut({from, patient, 0.5 * info.burr.diameter}, m_keep);
}

std::shared_ptr<const dissection::Stroke> DrillSession::end()
{
  if (!drilling())
    return nullptr;
  auto& work = *m_case.dissection;
  auto removed = measure(work);
  work.openInfo().removed = removed.total;
  work.openInfo().structures = std::move(removed.structures);
  m_last.reset();
  return scene::endStroke(m_case);
}

dissection::RemovedVolume DrillSession::measure(const dissection::Dissection& work) const
{
  return removedBy(work, m_field, m_structures);
}

std::function<dissection::RemovedVolume(const dissection::Dissection&)>
DrillSession::measurer() const
{
  return [field = m_field, structures = m_structures](const dissection::Dissection& work)
  { return removedBy(work, field, structures); };
}

std::string utcNow()
{
  const std::time_t now = std::time(nullptr);
  std::tm utc{};
  ::gmtime_r(&now, &utc);
  char text[32];
  std::strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%SZ", &utc);
  return text;
}

} // namespace petrous::presenters
