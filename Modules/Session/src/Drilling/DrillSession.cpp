#include "petrous/Session/DrillSession.h"

#include <ctime>
#include <utility>

#include "petrous/Scene/CaseField.h"

namespace petrous::session
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

void checkLoaded(const scene::Case& value)
{
  if (!value.dissection.loaded())
    throw core::InvalidParameter("drill: the case's dissection is not loaded");
}

std::shared_ptr<const volume::CutMask> maskOf(const scene::Case& value)
{
  checkLoaded(value);
  return value.dissection.sharedMask();
}

} // namespace

DrillSession::DrillSession(scene::Case& value, const core::Progress& progress, bool regional)
  : m_case(value)
  , m_field(scene::tissueField(value, progress.part(0.0, 0.6)))
  , m_keep(scene::protectedTissue(value, progress.part(0.6, 1.0), regional))
  , m_structures(scene::drillableStructures(value))
{
  checkLoaded(value);
}

DrillSession::DrillSession(scene::Case& value, const DrillSession& like)
  : m_case(value)
  , m_field(like.m_field.ct(), like.m_field.solids(), maskOf(value),
            {value.iso, like.m_field.parameters().scale})
  , m_keep(like.m_keep)
  , m_structures(like.m_structures)
{
}

std::shared_ptr<const dissection::Stroke> DrillSession::end()
{
  auto& work = m_case.dissection;
  if (!work.strokeOpen())
    return nullptr;
  auto removed = measure(work);
  work.openInfo().removed = removed.total;
  work.openInfo().structures = std::move(removed.structures);
  return work.endStroke();
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

} // namespace petrous::session
