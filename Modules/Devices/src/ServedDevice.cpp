#include "petrous/Devices/ServedDevice.h"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "ServerWatch.h"
#include "petrous/Devices/DeviceServerExchange.h"

namespace petrous::devices
{

namespace
{

using haptics::DeviceHealth;

constexpr double kFarthest = 2000.0; // mm; beyond the reach of any desktop device
// A hand moves below 5 m/s. Twice that, plus 20 mm for two samples in quick succession.
constexpr double kMaxSpeed = 10000.0; // mm/s
constexpr double kMaxStep = 20.0;     // mm
constexpr double kBadFor = 0.1;       // s for which one bad pose counts

// s; only differences are used. The servo's own clock may be simulated.
double steadyNow() noexcept
{
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

bool possible(const haptics::Pose& pose) noexcept
{
  const double norm = pose.rotation.norm();
  return pose.finite() && pose.position.norm() <= kFarthest && norm > 0.9 && norm < 1.1;
}

// `value` limited to length `limit`; zero if it is not finite or the device cannot render it.
Eigen::Vector3d within(const Eigen::Vector3d& value, bool gives, double limit) noexcept
{
  const double norm = value.norm();
  if (!gives || !std::isfinite(norm))
    return Eigen::Vector3d::Zero();
  return norm > limit ? Eigen::Vector3d(value * (limit / norm)) : value;
}

} // namespace

ServerError::ServerError(Reason reason, const std::string& message)
  : core::Error(core::Fault::BadInput, message)
  , m_reason(reason)
{
}

ServedDevice::ServedDevice(const Options& options)
  : m_options(options)
{
  if (!(options.startTimeout > 0.0 && options.staleAfter > 0.0 && options.hungAfter > 0.0))
    throw core::InvalidParameter("device server '" + options.name +
                                 "': its time limits must be above 0 s");
  m_watch = std::make_unique<ServerWatch>(options);
  m_description = m_watch->awaitReady();
}

ServedDevice::~ServedDevice() = default;

haptics::DeviceReading ServedDevice::read(double now) noexcept
{
  const std::uint64_t epoch = m_watch->epoch();
  if (epoch != m_epoch)
  {
    m_epoch = epoch;
    m_hasPose = false;
    m_badUntil = -1.0;
    // The block still contains the last server's pose.
    petrous_device_pose old;
    m_sequence = petrous_device_get(&m_watch->block().pose_sequence, m_watch->block().pose, &old);
  }
  takePose(now);
  m_reading.health = health(now);
  return m_reading;
}

void ServedDevice::takePose(double now) noexcept
{
  petrous_device_pose sent;
  const petrous_device_block& block = m_watch->block();
  const std::uint64_t sequence = petrous_device_get(&block.pose_sequence, block.pose, &sent);
  if (sequence == 0 || sequence == m_sequence)
    return;
  m_sequence = sequence;
  ++m_exchange.poses;

  haptics::Pose pose;
  pose.position = {sent.position[0], sent.position[1], sent.position[2]};
  pose.rotation = {sent.rotation[0], sent.rotation[1], sent.rotation[2], sent.rotation[3]};
  bool good = possible(pose) && sent.pedal >= 0.0 && sent.pedal <= 1.0;
  if (good)
  {
    pose.rotation.normalize();
    const double reach = kMaxStep + kMaxSpeed * std::max(0.0, now - m_poseTime);
    good = !m_hasPose || (pose.position - m_lastPose.position).norm() <= reach;
    m_lastPose = pose;
    m_hasPose = true;
  }
  m_poseTime = now;
  if (!good)
  {
    ++m_exchange.rejected;
    m_badUntil = now + kBadFor;
    return;
  }
  if (now >= m_badUntil)
  {
    m_reading.time = now;
    m_reading.pose = pose;
    m_reading.buttons = static_cast<std::uint32_t>(sent.buttons);
    m_reading.pedal = sent.pedal;
  }
  if (sent.echo != m_echo && sent.echo != 0 && sent.echo <= m_tick &&
      m_tick - sent.echo < m_sendTimes.size())
  {
    m_exchange.roundTrip = steadyNow() - m_sendTimes[sent.echo % m_sendTimes.size()];
    m_exchange.worstRoundTrip = std::max(m_exchange.worstRoundTrip, m_exchange.roundTrip);
  }
  m_echo = sent.echo;
}

DeviceHealth ServedDevice::health(double now) const noexcept
{
  switch (m_watch->link())
  {
  case ServerWatch::Link::Starting:
    return DeviceHealth::NotReady;
  case ServerWatch::Link::Gone:
    return DeviceHealth::Disconnected;
  case ServerWatch::Link::Hung:
  case ServerWatch::Link::Refused:
    return DeviceHealth::Faulty;
  case ServerWatch::Link::Up:
    break;
  }
  switch (__atomic_load_n(&m_watch->block().server_state, __ATOMIC_ACQUIRE))
  {
  case PETROUS_SERVER_READY:
    break;
  case PETROUS_SERVER_EMPTY:
  case PETROUS_SERVER_STARTING:
    return DeviceHealth::NotReady;
  case PETROUS_SERVER_NO_DEVICE:
    return DeviceHealth::Disconnected;
  default:
    return DeviceHealth::Faulty;
  }
  if (now < m_badUntil)
    return DeviceHealth::Faulty;
  if (!m_hasPose)
    return DeviceHealth::NotReady;
  return now - m_poseTime > m_options.staleAfter ? DeviceHealth::Stale : DeviceHealth::Good;
}

void ServedDevice::send(const haptics::Wrench& wrench) noexcept
{
  const Eigen::Vector3d force =
      within(wrench.linear, m_description.givesForce, m_description.maxForce);
  const Eigen::Vector3d torque =
      within(wrench.angular, m_description.givesTorque, m_description.maxTorque);
  petrous_device_wrench sent{};
  sent.tick = ++m_tick;
  for (int i = 0; i < 3; ++i)
  {
    sent.force[i] = force[i];
    sent.torque[i] = torque[i];
  }
  m_sendTimes[m_tick % m_sendTimes.size()] = steadyNow();
  petrous_device_block& block = m_watch->block();
  petrous_device_put(&block.wrench_sequence, block.wrench, &sent);
  ++m_exchange.wrenches;
}

ServedDevice::Status ServedDevice::status() const
{
  return m_watch->status();
}

} // namespace petrous::devices
