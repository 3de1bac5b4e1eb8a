#include "petrous/Session/TouchDissection.h"

#include <stdexcept>
#include <utility>

namespace petrous::session
{

namespace
{

// A fork whose changes are all known to the servo and the case.
dissection::Dissection forkOf(const dissection::Dissection& start)
{
  dissection::Dissection fork = start;
  fork.mask().takeDirty();
  return fork;
}

} // namespace

TouchDissection::TouchDissection(const dissection::Dissection& start, TouchScene& scene,
                                 session::SpscRing<session::TickRecord>& ring, Setup setup)
  : m_setup(std::move(setup))
  , m_work(forkOf(start))
  , m_changes(m_work.changes())
  , m_removal(scene.removalOf(m_setup.burr, m_setup.catalogues))
  , m_reporter(m_work, m_mailbox)
  , m_loop(m_work, *scene.mask(), m_removal->removalModel, scene.drill().protectedTissue(), hooks(scene))
  , m_thread(ring, m_loop,
             {[this](const session::TickRecord& record)
              {
                m_reporter.note(record);
                if (m_setup.recorder)
                  m_setup.recorder->add(&record, 1);
              },
              [this] { pass(); }},
             m_setup.cuts)
{
}

session::DissectionLoop::Hooks TouchDissection::hooks(TouchScene& scene)
{
  auto begin = TouchScene::beginOf(m_setup.burr,
                                   [this]
                                   {
                                     const std::lock_guard<std::mutex> lock(m_mutex);
                                     return m_camera;
                                   });
  session::DissectionLoop::Edited edited;
  if (m_setup.recorder)
    edited = [this](const session::MaskEdit& edit) { m_setup.recorder->add(edit); };
  return m_reporter.listen(std::move(begin), std::move(edited),
                           [&drill = std::as_const(scene.drill())](dissection::Dissection& work)
                           {
                             auto removed = drill.measure(work);
                             work.openInfo().removed = removed.total;
                             work.openInfo().structures = std::move(removed.structures);
                           });
}

void TouchDissection::journal()
{
  const auto now = std::chrono::steady_clock::now();
  const bool due =
      m_work.strokeOpen() && std::chrono::duration<double>(now - m_journalled).count() >= kJournal;
  if (!m_setup.journal || (m_work.changes() == m_changes && !due))
    return;
  m_setup.journal(m_work);
  m_changes = m_work.changes();
  m_journalled = now;
}

void TouchDissection::pass()
{
  journal();
  if (m_setup.recorder)
    if (const std::string fault = m_setup.recorder->takeFailure(); !fault.empty())
      m_reporter.note(fault);
  m_reporter.post();
  if (const std::string complaint = m_reporter.takeComplaint(); !complaint.empty())
    throw std::runtime_error(complaint);
}

void TouchDissection::setCamera(const core::CameraPose& camera)
{
  const std::lock_guard<std::mutex> lock(m_mutex);
  m_camera = camera;
}

void TouchDissection::stop()
{
  m_thread.stop();
  if (!m_setup.recorder)
    return;
  m_setup.recorder->close();
  pass();
}

} // namespace petrous::session
