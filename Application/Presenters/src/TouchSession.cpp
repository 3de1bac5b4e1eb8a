#include "petrous/Presenters/TouchSession.h"

#include <algorithm>
#include <chrono>
#include <utility>

namespace petrous::presenters
{

namespace
{

// 8 s of ticks: a window that stands longer loses bites, not the session.
constexpr std::size_t kRing = 8192;

double now()
{
  // The servo's clock: see ServoThread.
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

simulation::ServoSetup setupOf(const TouchScene& scene, const TouchSession::Setup& setup)
{
  simulation::ServoSetup servo = scene.servoOf(setup.tool);
  servo.center = setup.center;
  servo.guard = setup.guard;
  servo.limits = setup.limits;
  servo.passivity = setup.passivity;
  return servo;
}

} // namespace

TouchSession::BoundedFeed::BoundedFeed(double radius, double gain)
  : m_feed(radius, gain)
  , m_most(kDeepest * radius)
{
}

std::optional<dissection::SweptSphere>
TouchSession::BoundedFeed::bite(const simulation::TickRecord& record, double seconds)
{
  auto bite = m_feed.bite(record, seconds);
  if (!bite)
    return std::nullopt;
  const Eigen::Vector3d way = bite->to - bite->from;
  const double depth = std::min(way.norm(), m_left);
  if (!(depth > 0.0))
    return std::nullopt;
  m_left -= depth;
  bite->to = bite->from + depth * way.normalized();
  return bite;
}

TouchSession::TouchSession(scene::Case& value, TouchScene& scene, haptics::Device& device,
                           const Setup& setup)
  : m_case(value)
  , m_scene(scene)
  , m_proxy(scene.proxyOf(setup.tool))
  , m_servo(*m_proxy, setupOf(scene, setup))
  , m_recorder(
        setup.recording.empty()
            ? nullptr
            : std::make_unique<simulation::SessionRecorder>(
                  setup.recording, scene.recordingOf(setup.tool, m_servo.setup(), "live session")))
  , m_cuts(setup.cuts)
  , m_feed(0.5 * setup.tool.burr.diameter, setup.feed)
  , m_loop(*value.dissection, *scene.mask(), m_feed, scene.drill().protectedTissue(),
           hooks(setup.tool.burr))
  , m_ring(kRing)
  , m_batch(m_ring.capacity())
  , m_thread(std::make_unique<simulation::ServoThread>(m_servo, device, m_ring, setup.parameters))
{
}

TouchSession::~TouchSession()
{
  m_thread->stop();
  hear(); // what the recording still lacks
}

simulation::DissectionLoop::Hooks TouchSession::hooks(const dissection::Burr& burr)
{
  auto hooks = m_scene.hooksOf(burr, [this] { return m_camera; });
  hooks.close = [this](dissection::Dissection&)
  { m_news.strokes.push_back(m_scene.drill().end()); };
  hooks.changed = [this](const std::vector<std::size_t>& bricks)
  { m_news.bricks.insert(m_news.bricks.end(), bricks.begin(), bricks.end()); };
  if (m_recorder)
    hooks.edited = [this](const simulation::MaskEdit& edit) { m_recorder->add(edit); };
  return hooks;
}

bool TouchSession::drilling() const noexcept
{
  return m_case.dissection->strokeOpen();
}

void TouchSession::setParameters(const simulation::ServoParameters& parameters)
{
  m_thread->setParameters(parameters);
}

// The ticks since the last time, into the batch and the recording.
std::size_t TouchSession::hear()
{
  const std::size_t count = m_ring.pop(m_batch.data(), m_batch.size());
  if (m_recorder)
    m_recorder->add(m_batch.data(), count);
  return count;
}

void TouchSession::drain()
{
  m_feed.begin();
  const std::size_t count = hear();
  if (m_cuts)
    m_loop.step(m_batch.data(), count);
  for (std::size_t n = count; n-- > 0;)
    if (m_batch[n].fault != 0)
    {
      m_news.fault = simulation::inWords(m_batch[n]);
      break;
    }
}

void TouchSession::close()
{
  drain();
  m_loop.endStroke();
  // A tick that begins from now on has heard what the hand does now.
  m_loop.ignoreUntil(now());
}

TouchSession::News TouchSession::take()
{
  News news = std::exchange(m_news, {});
  std::sort(news.bricks.begin(), news.bricks.end());
  news.bricks.erase(std::unique(news.bricks.begin(), news.bricks.end()), news.bricks.end());
  simulation::TickRecord record;
  if (m_thread->latest(record))
    news.record = record;
  if (m_recorder)
    news.recordingFault = m_recorder->takeFailure();
  return news;
}

TouchSession::News TouchSession::advance()
{
  drain();
  return take();
}

TouchSession::News TouchSession::endStroke()
{
  close();
  return take();
}

bool TouchSession::step(bool (simulation::DissectionLoop::*way)())
{
  close();
  if (!(m_loop.*way)())
    return false;
  // Ticks until now still felt the tissue as it was.
  m_loop.ignoreUntil(now());
  return true;
}

bool TouchSession::undo()
{
  return step(&simulation::DissectionLoop::undo);
}

bool TouchSession::redo()
{
  return step(&simulation::DissectionLoop::redo);
}

TouchSession::News TouchSession::stop()
{
  m_thread->stop();
  drain();
  m_loop.endStroke();
  if (m_recorder)
    m_recorder->close();
  return take();
}

} // namespace petrous::presenters
