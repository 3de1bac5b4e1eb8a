#include "petrous/Interaction/PointerToolController.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include <Eigen/Geometry>

#include "petrous/Core/Error.h"
#include "petrous/Interaction/PointerDevice.h"

namespace petrous::interaction
{

using Eigen::Quaterniond;
using Eigen::Vector3d;

namespace
{

constexpr double kDegree = 3.14159265358979323846 / 180.0;
constexpr double kGrazing = 0.05; // cosine below which a ray counts as parallel to the depth plane

void check(bool holds, const char* what)
{
  if (!holds)
    throw core::InvalidParameter(std::string("pointer: ") + what);
}

// `open`: excludes `least`.
bool within(double value, double least, double most, bool open = false)
{
  return value >= least && value <= most && !(open && value == least); // false for NaN
}

const AimSettings& checked(const AimSettings& s)
{
  check(within(s.tilt, 0.0, AimSettings::kMaxTilt), "the tilt must lie within 0 to 80 degrees");
  check(std::isfinite(s.turn), "the turn is not finite");
  check(within(s.depthStep, 0.0, 10.0, true), "a step of depth must lie within 0 to 10 mm");
  check(within(s.nudgeStep, 0.0, 10.0, true), "a step of the keys must lie within 0 to 10 mm");
  check(within(s.fineFraction, 0.0, 1.0, true), "the share of a fine step must lie within 0 to 1");
  check(within(s.maxLead, 0.0, 50.0, true), "the lead must lie within 0 to 50 mm");
  check(within(s.maxFall, 0.0, 100.0, true), "the deepest fall must lie within 0 to 100 mm");
  check(within(s.maxRise, 0.0, 100.0, true), "the highest rise must lie within 0 to 100 mm");
  check(within(s.burrRadius, 0.0, 10.0, true), "the burr's radius must lie within 0 to 10 mm");
  check(within(s.beyond, 0.0, 10.0), "the way beyond the surface must lie within 0 to 10 mm");
  check(within(s.lift, 0.0, 20.0), "the lift must lie within 0 to 20 mm");
  check(within(s.thrust, 0.0, 20.0), "the thrust must lie within 0 to 20 N");
  check(within(s.approachSpeed, 0.0, 1000.0, true), "the approach must lie within 0 to 1000 mm/s");
  return s;
}

} // namespace

PointerToolController::PointerToolController(TissueQuery surface, const AimSettings& settings)
  : m_settings(checked(settings))
{
  setSurface(std::move(surface));
}

void PointerToolController::setSettings(const AimSettings& settings)
{
  m_settings = checked(settings);
  update();
}

void PointerToolController::setSurface(TissueQuery surface)
{
  check(static_cast<bool>(surface), "a surface is needed");
  m_surface = std::move(surface);
}

void PointerToolController::setCamera(const core::CameraPose& camera)
{
  session::ServoParameters parameters;
  session::setCamera(parameters, camera);
  const double* q = parameters.camera;
  m_screen = Quaterniond(q[0], q[1], q[2], q[3]);
  m_focal = camera.focalPoint;
}

void PointerToolController::begin()
{
  m_line.reset();
  m_place.reset();
  m_tool.reset();
  m_wanted.reset();
  m_pressedAt.reset();
  m_meets = m_lifted = false;
}

void PointerToolController::resume()
{
  if (m_tool && m_settings.mode == AimSettings::Mode::Depth)
    m_place = m_tool; // the wanted place may lie deep in tissue
  m_tool.reset();
  m_pressedAt.reset();
  m_sank = 0.0;
  update();
}

void PointerToolController::point(const PickRay& line)
{
  check(line.origin.allFinite() && std::abs(line.direction.norm() - 1.0) < 1e-6,
        "the line of sight needs a finite origin and a direction of length 1");
  m_line = line;
  update();
}

PickRay PointerToolController::shifted() const
{
  PickRay line = *m_line;
  line.origin += m_screen * Vector3d(m_nudge.x(), m_nudge.y(), 0.0);
  return line;
}

// Intersection of the ray with the plane through the last position (initially the focal point).
Vector3d PointerToolController::atDepth(const PickRay& line) const
{
  const Vector3d forward = m_screen * -Vector3d::UnitZ();
  const Vector3d through = m_place.value_or(m_focal);
  const double along = forward.dot(line.direction);
  if (along < kGrazing)
    return through;
  return line.at(forward.dot(through - line.origin) / along);
}

// The screen's axes, rotated to the line of sight, then tilted away from it.
Quaterniond PointerToolController::heading(const PickRay& line) const
{
  const Vector3d back = m_screen * Vector3d::UnitZ();
  const Quaterniond toEye = Quaterniond::FromTwoVectors(back, -line.direction) * m_screen;
  const double turn = m_settings.turn * kDegree;
  const Eigen::AngleAxisd tilt(m_settings.tilt * kDegree,
                               Vector3d(-std::sin(turn), std::cos(turn), 0.0));
  return (toEye * tilt).normalized();
}

// Position of a burr in front of the tissue, or above the last pressed position if the tissue is
// another surface.
Vector3d PointerToolController::onSurface(const PickRay& line, double hit)
{
  const bool pressed = m_press != Press::None;
  const double lift = pressed ? 0.0 : m_settings.lift;
  const Vector3d place = line.at(std::max(hit - m_settings.burrRadius - lift, 0.0));
  if (!pressed)
    return place;
  const Vector3d forward = m_screen * -Vector3d::UnitZ();
  const double deeper = m_pressedAt ? forward.dot(place - *m_pressedAt) : 0.0;
  m_lifted = deeper > m_settings.maxFall || deeper < -m_settings.maxRise;
  if (!m_lifted)
  {
    // Deeper only as far as the tool itself went: a wall scanned pixel by pixel is not a jump.
    if (!m_pressedAt || !m_tool || deeper < m_sank)
      m_pressedAt = place;
    else
      *m_pressedAt = place - (deeper - m_sank) * forward;
    m_sank = 0.0;
    return place;
  }
  m_place = *m_pressedAt - m_settings.lift * forward;
  return atDepth(line);
}

void PointerToolController::update()
{
  if (!m_line)
    return;
  const PickRay line = shifted();
  const std::optional<double> hit = m_surface(line);
  m_meets = hit.has_value();
  const bool surface = m_settings.mode == AimSettings::Mode::Surface || !m_place;
  m_lifted = false;
  if (surface && hit)
    m_place = onSurface(line, *hit);
  else
    m_place = atDepth(line);
  m_wanted = haptics::Pose{*m_place, heading(line)};
}

void PointerToolController::press(Press press)
{
  if (press == m_press)
    return;
  m_press = press;
  m_pressedAt.reset();
  m_sank = 0.0;
  update();
}

void PointerToolController::wheel(double notches, bool fine)
{
  if (m_settings.mode != AimSettings::Mode::Depth || !m_place || !std::isfinite(notches))
    return;
  const Vector3d direction = m_line->direction;
  double step = notches * m_settings.depthStep * (fine ? m_settings.fineFraction : 1.0);
  if (m_tool && step > 0.0)
  {
    const double lead = direction.dot(*m_place - *m_tool);
    step = std::clamp(m_settings.maxLead - lead, 0.0, step);
  }
  *m_place += step * direction;
  update();
}

void PointerToolController::nudge(double rightward, double upward, bool fine)
{
  const double step = m_settings.nudgeStep * (fine ? m_settings.fineFraction : 1.0);
  m_nudge += step * Eigen::Vector2d(rightward, upward);
  update();
}

void PointerToolController::tiltBy(double degrees)
{
  if (std::isfinite(degrees))
    m_settings.tilt = std::clamp(m_settings.tilt + degrees, 0.0, AimSettings::kMaxTilt);
  update();
}

void PointerToolController::turnBy(double degrees)
{
  if (std::isfinite(degrees))
    m_settings.turn = std::remainder(m_settings.turn + degrees, 360.0);
  update();
}

void PointerToolController::home()
{
  m_nudge.setZero();
  update();
}

void PointerToolController::see(const session::TickRecord& record, bool takenUp)
{
  if (static_cast<session::ServoFault>(record.fault) == session::ServoFault::Device)
    m_tool.reset();
  else
  {
    const Vector3d tool = record.proxy.pose().position;
    if (m_tool)
      m_sank += std::max((m_screen * -Vector3d::UnitZ()).dot(tool - *m_tool), 0.0);
    m_tool = tool;
  }
  if (takenUp && m_tool && m_place && m_settings.mode == AimSettings::Mode::Depth)
  {
    m_place = m_tool;
    update();
  }
}

std::uint32_t PointerToolController::buttons() const noexcept
{
  return m_press == Press::Drill && !m_lifted ? PointerDevice::kDrill : 0U;
}

void PointerToolController::apply(session::ServoParameters& parameters) const
{
  parameters.camera[0] = 1.0;
  parameters.camera[1] = parameters.camera[2] = parameters.camera[3] = 0.0;
  parameters.scale = 1.0;
  parameters.thrust = m_settings.thrust;
  parameters.approachSpeed = m_settings.approachSpeed;
  parameters.drillButtons = PointerDevice::kDrill;
  parameters.clutchButtons = PointerDevice::kFreeze;
  const bool pressing = m_press != Press::None && m_meets && !m_lifted;
  const bool onSurface = m_settings.mode == AimSettings::Mode::Surface;
  using Parameters = session::ServoParameters;
  parameters.pause = m_lifted ? 1 : parameters.pause;
  parameters.constantThrust = 0;
  if (onSurface)
    parameters.constantThrust = Parameters::kPointer | (pressing ? Parameters::kPressed : 0);
  // In depth mode only the wheel's lead presses, not lateral motion of the pointer.
  parameters.driftLimit = onSurface ? 0.0F : static_cast<float>(m_settings.maxLead);
  // A pressed burr is placed with its tip on the tissue.
  Vector3d approach = Vector3d::Zero();
  if (m_line)
    approach = (m_settings.burrRadius + m_settings.beyond) * m_line->direction;
  std::copy(approach.data(), approach.data() + 3, parameters.approach);
}

} // namespace petrous::interaction
