#include "petrous/Session/ServoParameters.h"

#include <cmath>

#include <Eigen/Geometry>

#include "petrous/Core/Error.h"

namespace petrous::session
{

namespace
{

bool within(double value, double least, double most) noexcept
{
  return value >= least && value <= most; // false for NaN
}

const char* firstFault(const ServoParameters& p) noexcept
{
  const double* q = p.camera;
  const double norm = std::sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
  if (!within(norm, 1.0 - 1e-9, 1.0 + 1e-9))
    return "the camera's rotation must be a unit quaternion";
  if (!within(p.scale, 0.01, 10.0))
    return "the scale must lie within 0.01 to 10";
  if (!within(p.forceGain, 0.0, 100.0))
    return "the force's gain must lie within 0 to 100";
  if (!within(p.thrust, 0.0, 20.0))
    return "the thrust must lie within 0 to 20 N";
  if (!within(p.approachSpeed, 1e-6, 1000.0))
    return "the approach must lie within 0 to 1000 mm/s";
  if (!within(static_cast<double>(p.driftLimit), 0.0, 50.0))
    return "the drift limit must lie within 0 to 50 mm";
  if (p.constantThrust > (ServoParameters::kPressed | ServoParameters::kPointer))
    return "the mode of constant thrust is unknown";
  if (p.drill > (ServoParameters::kDrill | ServoParameters::kPedalSpeed))
    return "the drill's mode is unknown";
  for (const double a : p.approach)
    if (!within(a, -1e6, 1e6))
      return "the approach's direction is not finite";
  return nullptr;
}

} // namespace

bool ServoParameters::valid() const noexcept
{
  return firstFault(*this) == nullptr;
}

void check(const ServoParameters& parameters)
{
  if (const char* fault = firstFault(parameters))
    throw core::InvalidParameter(std::string("servo: ") + fault);
}

void setCamera(ServoParameters& parameters, const core::CameraPose& camera)
{
  const Eigen::Vector3d back = (camera.position - camera.focalPoint).stableNormalized();
  const Eigen::Vector3d right = camera.viewUp.cross(back).stableNormalized();
  Eigen::Matrix3d axes;
  axes << right, back.cross(right), back;
  if (!axes.allFinite() || !(std::abs(axes.determinant() - 1.0) < 1e-6))
    throw core::InvalidParameter(
        "servo: the camera has no direction, or looks along its own up vector");
  const Eigen::Quaterniond q = Eigen::Quaterniond(axes).normalized();
  parameters.camera[0] = q.w();
  parameters.camera[1] = q.x();
  parameters.camera[2] = q.y();
  parameters.camera[3] = q.z();
}

} // namespace petrous::session
