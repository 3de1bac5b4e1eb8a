#include "petrous/Session/TouchSession.h"

#include <stdexcept>
#include <utility>

#include "petrous/Core/Log.h"
#include "petrous/Core/NumberText.h"

namespace petrous::session
{

namespace
{

using Event = DissectionEvent;

// 8 s of ticks: a longer stall of the machine loses bites, not the session.
constexpr std::size_t kRing = 8192;

ServoSetup setupOf(const TouchScene& scene, const TouchSession::Setup& setup)
{
  ServoSetup servo = scene.servoOf(setup.tool);
  servo.center = setup.center;
  servo.guard = setup.guard;
  servo.limits = setup.limits;
  servo.passivity = setup.passivity;
  return servo;
}

std::unique_ptr<SessionRecorder> recorderOf(const TouchScene& scene,
                                            const TouchSession::Setup& setup, const Servo& servo)
{
  if (setup.recording.empty())
    return nullptr;
  return std::make_unique<SessionRecorder>(
      setup.recording, scene.recordingOf(setup.tool, servo.setup(), "live session"));
}

// As every device does, and a pointer whenever it rests.
bool startsUp(const TickRecord& record)
{
  const auto verdict = static_cast<haptics::DeviceVerdict>(record.verdict);
  return static_cast<ServoFault>(record.fault) == ServoFault::Device &&
         (verdict == haptics::DeviceVerdict::NotReady ||
          verdict == haptics::DeviceVerdict::Settling);
}

void list(const Event& event, TouchSession::News& news)
{
  switch (event.kind)
  {
  case Event::Kind::StrokeBegun:
    break;
  case Event::Kind::StrokeClosed:
    news.strokes.push_back(event.stroke);
    break;
  case Event::Kind::Undone:
    news.steps.push_back(true);
    break;
  case Event::Kind::Redone:
    news.steps.push_back(false);
    break;
  }
}

// A fork whose changes are all known to the servo and the case.
dissection::Dissection forkOf(const dissection::Dissection& start)
{
  dissection::Dissection fork = start;
  fork.mask().takeDirty();
  return fork;
}

} // namespace

TouchSession::TouchSession(scene::Case& value, TouchScene& scene, haptics::Device& device,
                           const Setup& setup)
  : m_case(value)
  , m_scene(scene)
  , m_burr(setup.tool.burr)
  , m_journal(setup.journal)
  , m_heard(setup.heard)
  , m_locked(scene.lockedMemory())
  , m_proxy(scene.proxyOf(setup.tool))
  , m_servo(*m_proxy, setupOf(scene, setup))
  , m_recorder(recorderOf(scene, setup, m_servo))
  , m_ring(kRing)
  , m_fork(forkOf(value.dissection))
  , m_changes(m_fork.changes())
  , m_removal(scene.removalOf(setup.tool.burr, setup.catalogues))
  , m_reporter(m_fork, m_queue)
  , m_loop(m_fork, *scene.mask(), m_removal->removalModel, scene.drill().protectedTissue(), hooks())
  , m_dissectionThread(m_ring, m_loop,
                       {[this](const TickRecord& record)
                        {
                          m_reporter.note(record);
                          if (m_recorder)
                            m_recorder->add(&record, 1);
                          if (m_heard)
                            m_heard(record);
                        },
                        [this] { passUpdates(); }},
                       setup.cuts && !setup.tool.instrument)
  , m_servoThread(std::make_unique<ServoThread>(m_servo, device, m_ring, setup.parameters))
{
}

DissectionLoop::Hooks TouchSession::hooks()
{
  auto begin = TouchScene::beginOf(m_burr,
                                   [this]
                                   {
                                     const std::lock_guard<std::mutex> lock(m_mutex);
                                     return m_camera;
                                   });
  DissectionLoop::Edited edited;
  if (m_recorder)
    edited = [this](const MaskEdit& edit) { m_recorder->add(edit); };
  return m_reporter.listen(std::move(begin), std::move(edited),
                           [&drill = std::as_const(m_scene.drill())](dissection::Dissection& work)
                           {
                             auto removed = drill.measure(work);
                             work.openInfo().removed = removed.total;
                             work.openInfo().structures = std::move(removed.structures);
                           });
}

void TouchSession::writeJournal()
{
  const auto now = std::chrono::steady_clock::now();
  const bool due =
      m_fork.strokeOpen() && std::chrono::duration<double>(now - m_journalled).count() >= kJournal;
  if (!m_journal || (m_fork.changes() == m_changes && !due))
    return;
  m_journal(m_fork);
  m_changes = m_fork.changes();
  m_journalled = now;
}

void TouchSession::passUpdates()
{
  writeJournal();
  if (m_recorder)
    if (const std::string fault = m_recorder->takeFailure(); !fault.empty())
      m_reporter.note(fault);
  m_reporter.post();
  if (const std::string complaint = m_reporter.takeComplaint(); !complaint.empty())
    throw std::runtime_error(complaint);
}

void TouchSession::setCamera(const core::CameraPose& camera)
{
  const std::lock_guard<std::mutex> lock(m_mutex);
  m_camera = camera;
}

TouchSession::~TouchSession()
{
  try
  {
    stop();
  }
  catch (const std::exception&) // out of memory: the case lacks what it has not followed
  {
  }
}

bool TouchSession::drilling() const noexcept
{
  return m_case.dissection.strokeOpen();
}

void TouchSession::setParameters(const ServoParameters& parameters)
{
  m_servoThread->setParameters(parameters);
}

TouchSession::News TouchSession::advance()
{
  News news;
  news.failure = m_dissectionThread.takeFailure();
  DissectionUpdate update = m_queue.take();
  news.bricks = follow(update, m_case.dissection);
  for (const Event& event : update.events)
    list(event, news);
  if (update.fault)
    news.fault = toString(*update.fault);
  if (update.fault && std::exchange(m_loggedFault, update.fault->fault) != update.fault->fault)
    core::log::write(startsUp(*update.fault) ? core::log::Level::Debug : core::log::Level::Warning,
                     "servo: " + news.fault);
  news.recordingFault = std::move(update.recordingFault);
  TickRecord record;
  if (m_servoThread->latest(record))
    news.record = record;
  return news;
}

// The servo thread itself logs nothing.
void TouchSession::logEnd() const
{
  constexpr double kMicro = 1e6;
  const ServoThread::State state = m_servoThread->state();
  core::log::info(
      "servo: " + std::to_string(state.ticks) + " ticks, " + std::to_string(state.late) +
      " late, p99.9 " + core::fixedText(kMicro * m_servoThread->wallTimes().quantile(0.999), 0) +
      " us, longest " + core::fixedText(kMicro * state.worstWall, 0) + " us (" +
      core::fixedText(kMicro * state.worstProcessor, 0) + " us of the processor), " +
      std::to_string(state.postponed) + " left motion to the next, " +
      std::to_string(state.dropped) + " records lost, " + std::to_string(state.majorFaults) +
      " page faults" + (state.realTime ? "" : ", no real-time priority"));
}

TouchSession::News TouchSession::stop()
{
  const bool ran = m_servoThread->state().running;
  m_servoThread->stop();
  if (ran)
    logEnd();
  m_dissectionThread.stop();
  if (ran && m_heard)
    m_heard(TickRecord());
  if (m_recorder)
  {
    m_recorder->close();
    passUpdates();
  }
  return advance();
}

} // namespace petrous::session
