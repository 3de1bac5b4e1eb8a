#include "petrous/Interaction/PointerDevice.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "petrous/Core/Error.h"

namespace petrous::interaction
{

using haptics::Pose;
using session::PoseValues;
using session::ServoFault;
using session::TickRecord;

namespace
{

constexpr double kMaxStep = 0.05;     // s, max. time step after a pause of the servo
constexpr double kSamePlace = 1e-6;   // mm
constexpr double kSameHeading = 1e-6; // rad
constexpr double kArrived = 0.5;      // mm from the wanted pose
constexpr double kSettled = 5.0;      // time constants: under a pointer that goes on moving

void check(bool holds, const char* what)
{
  if (!holds)
    throw core::InvalidParameter(std::string("pointer device: ") + what);
}

bool within(double value, double most)
{
  return value > 0.0 && value <= most; // false for NaN
}

// Whether `mapped` is the plain mapping of the device's pose, so that the offset can be derived.
bool tells(const TickRecord& record) noexcept
{
  const auto fault = static_cast<ServoFault>(record.fault);
  const session::ServoParameters& p = record.input.parameters;
  const bool plain = p.scale == 1.0 && std::abs(p.camera[0]) == 1.0;
  const bool ticked = record.input.now > 0.0; // otherwise not a record of a tick
  // After a retreat the tool was re-anchored after the mapping.
  return ticked && plain && !record.input.clutched() && session::hasToolPose(record) &&
         fault != ServoFault::Retreated && record.mapped.pose().finite() &&
         record.input.device.pose().finite();
}

} // namespace

PointerDevice::PointerDevice(const Eigen::Vector3d& center, const Limits& limits)
  : m_limits(limits)
  , m_offset(center)
{
  check(center.allFinite(), "the centre is not finite");
  check(within(limits.speed, 4000.0), "the speed must lie within 0 to 4000 mm/s");
  check(within(limits.angularSpeed, 50.0), "the angular speed must lie within 0 to 50 rad/s");
  check(within(limits.settle, 1.0), "the time to settle must lie within 0 to 1 s");
  check(limits.silence > 0.0, "the silence that is borne must be above 0 s");
  m_description.name = "Pointer and keys";
}

void PointerDevice::want(const Pose& tool)
{
  check(tool.finite(), "the wanted pose is not finite");
  m_wanted = {tool.position, tool.rotation.normalized()};
  m_next.ready = 1;
  say();
}

void PointerDevice::setButtons(std::uint32_t held) noexcept
{
  m_next.buttons = held;
  say();
}

void PointerDevice::say() noexcept
{
  m_next.pose = PoseValues::of(
      {m_wanted.position - m_offset, (m_wanted.rotation * m_turn.conjugate()).normalized()});
  m_word.write(m_next);
}

bool PointerDevice::see(const TickRecord& record) noexcept
{
  bool anew = false;
  if (m_next.ready && tells(record))
  {
    const Pose device = record.input.device.pose();
    const Pose mapped = record.mapped.pose();
    const Eigen::Vector3d offset = mapped.position - device.position;
    const Eigen::Quaterniond turn = (device.rotation.conjugate() * mapped.rotation).normalized();
    anew = (offset - m_offset).norm() > kSamePlace ||
           haptics::rotationVector(turn * m_turn.conjugate()).norm() > kSameHeading;
    if (anew)
    {
      m_offset = offset;
      m_turn = turn;
    }
  }
  say();
  return anew;
}

haptics::DeviceReading PointerDevice::read(double now) noexcept
{
  const std::uint64_t count = m_word.count();
  if (count != m_count && m_word.read(m_heard))
  {
    m_count = count;
    m_heardAt = now;
  }
  const double dt = now - m_time;
  m_time = now;
  if (m_heard.ready && !m_placed)
  {
    m_pose = m_heard.pose.pose();
    m_placed = true;
  }
  else if (m_placed && dt > 0.0)
    glide(std::min(dt, kMaxStep));

  haptics::DeviceReading reading;
  reading.time = now;
  reading.pose = m_pose;
  reading.buttons = buttonsNow(now);
  const bool silent = now - m_heardAt > m_limits.silence;
  reading.health = !m_placed ? haptics::DeviceHealth::NotReady
                   : silent  ? haptics::DeviceHealth::Stale
                             : haptics::DeviceHealth::Good;
  return reading;
}

std::uint32_t PointerDevice::buttonsNow(double now) noexcept
{
  const std::uint32_t held = m_heard.buttons;
  const bool pressed = (held & kDrill) != 0;
  const double way = (m_heard.pose.pose().position - m_pose.position).norm();
  if (pressed && !m_pressed)
    m_due = now + way / m_limits.speed + kSettled * m_limits.settle;
  m_pressed = pressed;
  m_arrived = pressed && (m_arrived || way <= kArrived || now > m_due);
  return pressed && !m_arrived ? held & ~kDrill : held;
}

void PointerDevice::glide(double dt) noexcept
{
  const Pose goal = m_heard.pose.pose();
  haptics::Motion way = haptics::motionBetween(m_pose, goal);
  const double distance = way.linear.norm();
  const double angle = way.angular.norm();
  if (distance <= kSamePlace && angle <= kSameHeading)
  {
    m_pose = goal;
    return;
  }
  const double share = 1.0 - std::exp(-dt / m_limits.settle);
  const auto bounded = [share](double whole, double most)
  { return whole > 0.0 ? std::min(share, most / whole) : 0.0; };
  way.linear *= bounded(distance, m_limits.speed * dt);
  way.angular *= bounded(angle, m_limits.angularSpeed * dt);
  m_pose = haptics::moved(m_pose, way);
}

} // namespace petrous::interaction
