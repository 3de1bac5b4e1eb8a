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

std::shared_ptr<const dissection::Stroke> DrillSession::end()
{
  auto& work = *m_case.dissection;
  if (!work.strokeOpen())
    return nullptr;
  auto removed = measure(work);
  work.openInfo().removed = removed.total;
  work.openInfo().structures = std::move(removed.structures);
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
