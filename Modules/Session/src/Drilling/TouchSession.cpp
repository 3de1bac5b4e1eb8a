#include "petrous/Session/TouchSession.h"

#include <utility>

namespace petrous::session
{

namespace
{

using Event = session::DissectionEvent;

// 8 s of ticks: a longer stall of the machine loses bites, not the session.
constexpr std::size_t kRing = 8192;

session::ServoSetup setupOf(const TouchScene& scene, const TouchSession::Setup& setup)
{
  session::ServoSetup servo = scene.servoOf(setup.tool);
  servo.center = setup.center;
  servo.guard = setup.guard;
  servo.limits = setup.limits;
  servo.passivity = setup.passivity;
  return servo;
}

std::unique_ptr<session::SessionRecorder> recorderOf(const TouchScene& scene,
                                                        const TouchSession::Setup& setup,
                                                        const session::Servo& servo)
{
  if (setup.recording.empty())
    return nullptr;
  return std::make_unique<session::SessionRecorder>(
      setup.recording, scene.recordingOf(setup.tool, servo.setup(), "live session"));
}

// Updates the case's history, which the dissection already follows.
void list(const Event& event, scene::Case& value, TouchSession::News& news)
{
  switch (event.kind)
  {
  case Event::Kind::StrokeBegun:
    break;
  case Event::Kind::StrokeClosed:
    if (event.stroke)
      scene::listStroke(value, event.stroke);
    news.strokes.push_back(event.stroke);
    break;
  case Event::Kind::Undone:
    value.history.undo();
    news.steps.push_back(true);
    break;
  case Event::Kind::Redone:
    value.history.redo();
    news.steps.push_back(false);
    break;
  }
}

} // namespace

TouchSession::TouchSession(scene::Case& value, TouchScene& scene, haptics::Device& device,
                           const Setup& setup)
  : m_case(value)
  , m_locked(scene.lockedMemory())
  , m_proxy(scene.proxyOf(setup.tool))
  , m_servo(*m_proxy, setupOf(scene, setup))
  , m_ring(kRing)
  , m_dissection(*value.dissection, scene, m_ring,
                 {setup.tool.burr, setup.catalogues, setup.cuts, recorderOf(scene, setup, m_servo),
                  setup.journal})
  , m_thread(std::make_unique<session::ServoThread>(m_servo, device, m_ring, setup.parameters))
{
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
  return m_case.dissection->strokeOpen();
}

void TouchSession::setParameters(const session::ServoParameters& parameters)
{
  m_thread->setParameters(parameters);
}

TouchSession::News TouchSession::advance()
{
  News news;
  news.failure = m_dissection.takeFailure();
  session::DissectionUpdate mail = m_dissection.take();
  news.bricks = session::follow(mail, *m_case.dissection);
  for (const Event& event : mail.events)
    list(event, m_case, news);
  if (mail.fault)
    news.fault = session::toString(*mail.fault);
  news.recordingFault = std::move(mail.recordingFault);
  session::TickRecord record;
  if (m_thread->latest(record))
    news.record = record;
  return news;
}

TouchSession::News TouchSession::stop()
{
  m_thread->stop();
  m_dissection.stop();
  return advance();
}

} // namespace petrous::session
