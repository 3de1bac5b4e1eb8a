#include "LiveServo.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <random>
#include <string>
#include <thread>
#include <utility>

#include "BenchmarkPatients.h"
#include "ProcessMemory.h"
#include "SimulatedDevice.h"
#include "petrous/Core/Error.h"
#include "petrous/Core/NumberText.h"
#include "petrous/Presenters/ActiveDevice.h"
#include "petrous/Presenters/DeviceMapping.h"
#include "petrous/Session/TouchSession.h"

namespace petrous::cli
{

namespace
{

using Eigen::Vector3d;

constexpr double kDiameter = 4.0;                  // mm
constexpr std::chrono::microseconds kFrame(16667); // 60 Hz
constexpr double kWanted[] = {250e-6, 500e-6};     // s, of p99.9 and p99.99
constexpr std::size_t kBudgets[] = {2000, 10000};  // points of the tool
constexpr std::pair<const char*, double> kShares[] = {
    {"10", 0.1},     {"50", 0.5},       {"90", 0.9},       {"99", 0.99},        {"99.5", 0.995},
    {"99.9", 0.999}, {"99.95", 0.9995}, {"99.99", 0.9999}, {"99.999", 0.99999}, {"100", 1.0}};

// A hand on a simulated device, in its frame: the tissue lies towards -z. It descends until it
// feels the force that it wants, sweeps with the drill on or off, lifts, and goes elsewhere. Used
// by the servo's thread alone while a session runs; does not allocate in `read`.
class RandomHand : public haptics::Device
{
public:
  RandomHand()
    : m_device([this](double time) { return targetAt(time); }, handOf(), {})
  {
    next();
  }

  const haptics::DeviceDescription& description() const noexcept override
  {
    return m_device.description();
  }

  haptics::DeviceReading read(double now) noexcept override
  {
    think(now);
    m_device.press(m_phase == Phase::Sweep && m_drills ? presenters::ActiveDevice::kDrill : 0U,
                   0.0);
    return m_device.read(now);
  }

  void send(const haptics::Wrench& wrench) noexcept override { m_device.send(wrench); }

private:
  enum class Phase
  {
    Cross, // above the tissue to the next place
    Descend,
    Sweep,
    Lift
  };
  static constexpr double kArea = 24.0;     // mm, radius: 12 mm on the patient
  static constexpr double kAbove = 20.0;    // mm, where it crosses
  static constexpr double kDeepest = 50.0;  // mm below the cortex
  static constexpr double kWall = 3.0;      // N
  static constexpr double kMostStep = 0.01; // s

  static haptics::SimulatedDevice::Hand handOf()
  {
    haptics::SimulatedDevice::Hand hand;
    hand.tremor = 0.05;
    hand.friction = 0.05;
    return hand;
  }

  double uniform(double low, double high) noexcept
  {
    return low + (high - low) * static_cast<double>(m_random()) / 4294967296.0;
  }

  void next() noexcept
  {
    const double radius = kArea * std::sqrt(uniform(0.0, 1.0));
    const double angle = uniform(0.0, 6.283185307179586);
    m_place = {radius * std::cos(angle), radius * std::sin(angle), kAbove};
    m_tilt = {uniform(-0.35, 0.35), uniform(-0.35, 0.35), 0.0};
    m_force = uniform(0.3, 4.0);
    m_speed = uniform(20.0, 200.0);
    m_drills = uniform(0.0, 1.0) < 0.6;
    m_left = uniform(0.3, 4.0);
    const double way = uniform(0.0, 6.283185307179586);
    const double sweep = uniform(0.0, 60.0);
    m_sweep = {sweep * std::cos(way), sweep * std::sin(way), 0.0};
    m_phase = Phase::Cross;
  }

  // The sweep goes no further along `way`.
  void turnBack(const Vector3d& way) noexcept
  {
    const Vector3d along = way.normalized();
    m_sweep -= (m_sweep.dot(along) + std::abs(m_sweep.dot(along))) * along;
  }

  // Sets the target's rate until the next tick.
  void think(double now) noexcept
  {
    const double dt = m_time > 0.0 ? std::clamp(now - m_time, 0.0, kMostStep) : 0.0;
    m_target += dt * m_rate;
    m_turn += dt * m_turnRate;
    m_time = now;
    m_turnRate = 3.0 * (m_tilt - m_turn);
    const Vector3d force = m_device.sent().linear;
    const double pushed = force.z(); // N, out of the tissue
    const double down =
        pushed > 0.05 ? std::clamp(15.0 * (m_force - pushed), -60.0, 60.0) : 40.0; // mm/s
    switch (m_phase)
    {
    case Phase::Cross:
    {
      const Vector3d way = m_place - m_target;
      m_rate = std::min(m_speed, 20.0 * way.norm()) * way.normalized();
      if (way.norm() < 1.0)
        m_phase = Phase::Descend;
      break;
    }
    case Phase::Descend:
      m_rate = {0.0, 0.0, -down};
      if (pushed > 0.8 * m_force)
        m_phase = Phase::Sweep;
      break;
    case Phase::Sweep:
      m_rate = m_sweep - Vector3d(0.0, 0.0, down);
      if (const Vector3d outward(m_target.x(), m_target.y(), 0.0); outward.norm() > kArea)
        turnBack(outward);
      else if (const Vector3d wall(-force.x(), -force.y(), 0.0); wall.norm() > kWall)
        turnBack(wall);
      m_left -= dt;
      if (m_left < 0.0)
        m_phase = Phase::Lift;
      break;
    case Phase::Lift:
      // Back to where it went in; slowly where its hole holds it.
      m_rate = 2.0 * (m_place - m_target);
      m_rate.z() = pushed < -kWall ? 5.0 : std::min(m_speed, 60.0);
      if (m_target.z() > kAbove)
        next();
      break;
    }
    if (m_target.z() < -kDeepest)
      m_phase = Phase::Lift;
  }

  haptics::Pose targetAt(double time) const noexcept
  {
    const double after = std::clamp(time - m_time, -kMostStep, kMostStep);
    return {m_target + after * m_rate, haptics::rotationFrom(m_turn + after * m_turnRate)};
  }

  haptics::SimulatedDevice m_device; // calls targetAt in `read` only
  std::mt19937 m_random{20261128};
  Phase m_phase = Phase::Cross;
  double m_time = 0.0;
  Vector3d m_target{0.0, 0.0, kAbove};
  Vector3d m_rate{0.0, 0.0, 0.0}; // mm/s
  Vector3d m_turn{0.0, 0.0, 0.0}; // rotation vector
  Vector3d m_turnRate{0.0, 0.0, 0.0};
  Vector3d m_place{0.0, 0.0, 0.0}, m_tilt{0.0, 0.0, 0.0}, m_sweep{0.0, 0.0, 0.0};
  double m_force = 0.0; // N
  double m_speed = 0.0; // mm/s
  double m_left = 0.0;  // s of the sweep
  bool m_drills = false;
};

// What the ticks did; written in the thread of removal, read after the session's end.
struct Seen
{
  std::uint64_t ticks = 0, contact = 0, drilling = 0, faults = 0;
  double force = 0.0; // N, largest

  void note(const session::TickRecord& record)
  {
    ++ticks;
    contact += record.contacts > 0;
    drilling += record.drill > 0;
    faults += record.fault != 0;
    force = std::max(force, record.output.wrench().linear.norm());
  }
};

// Quantiles in the order of kShares, and counts.
void enter(const std::string& scene, const std::string& points, const char* what,
           const core::TickHistogram& times, std::vector<core::BenchmarkPoint>& report)
{
  for (const auto& [text, share] : kShares)
  {
    core::BenchmarkPoint point;
    point.scene = scene;
    point.setting["points"] = points;
    point.setting["of"] = what;
    point.setting["percent"] = text;
    point.seconds = times.quantile(share);
    point.error = std::numeric_limits<double>::quiet_NaN();
    report.push_back(std::move(point));
  }
}

struct LiveRun
{
  const BenchmarkPatient& patient;
  double seconds;

  void operator()(std::size_t budget, const core::Progress& progress,
                  std::vector<core::BenchmarkPoint>& report) const;
};

void LiveRun::operator()(std::size_t budget, const core::Progress& progress,
                         std::vector<core::BenchmarkPoint>& report) const
{
  scene::Case value = touchCaseOf(patient);
  session::TouchScene scene(value, progress.part(0.0, 0.1));
  session::TouchSession::Setup setup;
  setup.tool.burr.diameter = kDiameter;
  haptics::BurrShape shape;
  shape.radius = 0.5 * kDiameter;
  const auto shell = std::make_shared<const haptics::PointShell>(
      haptics::makeBurrShell(shape, value.ct.geometry.minSpacing(), budget));
  scene.giveShell(setup.tool.burr, shell);

  RandomHand hand;
  presenters::DeviceMapping mapping;
  mapping.scale = presenters::usualScale(hand.description());
  presenters::fit(setup, hand.description(), mapping, false);
  core::CameraPose camera; // from beside the head: the device's -z points into it
  camera.position = patient.entry + 200.0 * patient.lateral;
  camera.focalPoint = patient.entry;
  setup.parameters = presenters::parametersFor(hand.description(), mapping, camera);
  setup.center = patient.entry;
  Seen seen;
  setup.heard = [&seen](const session::TickRecord& record) { seen.note(record); };

  const core::Progress run = progress.part(0.1, 1.0);
  const double memory = imaging::residentMb();
  std::size_t strokes = 0;
  const auto begin = std::chrono::steady_clock::now();
  session::TouchSession session(value, scene, hand, setup);
  const auto advance = [&](const session::TouchSession::News& news)
  {
    strokes += news.strokes.size();
    if (!news.failure.empty())
      throw core::Error(core::Fault::Refused, "bench servo: " + news.failure);
  };
  for (auto frame = begin;;)
  {
    const std::chrono::duration<double> passed = std::chrono::steady_clock::now() - begin;
    if (passed.count() >= seconds)
      break;
    run.report(passed.count() / seconds, "drilling with " + std::to_string(budget) + " points");
    advance(session.advance());
    frame += kFrame;
    std::this_thread::sleep_until(frame);
  }
  const session::ServoThread::State state = session.state();
  const std::chrono::duration<double> ran = std::chrono::steady_clock::now() - begin;
  advance(session.stop());

  const core::TickHistogram& wall = session.servo().wallTimes();
  const core::TickHistogram& lateness = session.servo().lateness();
  const std::string scenery = "live: " + patient.name + ", structures, cavity";
  const std::string points = std::to_string(shell->points.size());
  const auto ticks = static_cast<double>(std::max<std::uint64_t>(1, state.ticks));
  core::BenchmarkPoint point;
  point.scene = scenery;
  point.setting["points"] = points;
  point.setting["of"] = "session";
  point.isDefault = budget == kBudgets[0];
  point.seconds = wall.quantile(0.5);
  point.error = 100.0 * static_cast<double>(state.late) / ticks;
  point.errorUnit = "% of the ticks that began after the next was due";
  const std::pair<const char*, double> shares[] = {
      {"p50", 0.5}, {"p99", 0.99}, {"p99.9", 0.999}, {"p99.99", 0.9999}, {"max", 1.0}};
  for (const auto& [name, share] : shares)
  {
    point.extra[std::string("wall_us_") + name] = 1e6 * wall.quantile(share);
    point.extra[std::string("lateness_us_") + name] = 1e6 * lateness.quantile(share);
  }
  point.extra["p99.9_met"] = wall.quantile(0.999) <= kWanted[0];
  point.extra["p99.99_met"] = wall.quantile(0.9999) <= kWanted[1];
  point.extra["ran_s"] = ran.count();
  point.extra["ticks"] = static_cast<double>(state.ticks);
  point.extra["ticks_late"] = static_cast<double>(state.late);
  point.extra["real_time_priority"] = state.realTime;
  point.extra["records_lost"] = static_cast<double>(state.dropped);
  point.extra["page_faults"] = static_cast<double>(state.majorFaults);
  point.extra["processor_us_max"] = 1e6 * state.worstProcessor;
  point.extra["ticks_that_left_motion"] = static_cast<double>(state.postponed);
  point.extra["motion_left_mm_max"] = state.worstPostponed;
  point.extra["burr_points"] = static_cast<double>(shell->burrCount);
  point.extra["contact_share"] = static_cast<double>(seen.contact) / ticks;
  point.extra["drilling_share"] = static_cast<double>(seen.drilling) / ticks;
  point.extra["ticks_with_fault"] = static_cast<double>(seen.faults);
  point.extra["force_max_n"] = seen.force;
  point.extra["strokes"] = static_cast<double>(strokes);
  point.extra["removed_mm3"] = value.removedVolume();
  point.extra["memory_mb_before"] = memory;
  point.extra["memory_mb_after"] = imaging::residentMb();
  report.push_back(std::move(point));
  enter(scenery, points, "tick", wall, report);
  enter(scenery, points, "lateness", lateness, report);
}

} // namespace

std::vector<core::BenchmarkPoint> runLiveServo(double seconds, bool quick,
                                               const std::filesystem::path& data,
                                               const core::Progress& progress)
{
  std::optional<BenchmarkPatient> patient = realPatient(data, progress.part(0.0, 0.05));
  if (!patient)
    patient = phantomPatient(quick ? 96 : 256, progress.part(0.0, 0.05));
  const double second = std::max(seconds / 6.0, std::min(seconds, 20.0));
  std::vector<core::BenchmarkPoint> points;
  LiveRun{*patient, seconds}(kBudgets[0], progress.part(0.05, 0.8), points);
  LiveRun{*patient, second}(kBudgets[1], progress.part(0.8, 1.0), points);
  return points;
}

} // namespace petrous::cli
