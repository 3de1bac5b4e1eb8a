#include "petrous/Presenters/DeviceMapping.h"

#include <algorithm>

#include "petrous/Presenters/ActiveDevice.h"

namespace petrous::presenters
{

namespace
{

constexpr double kSoft = 0.2;           // N/mm: rendered by any device with force feedback
constexpr double kStiffest = 10.0;      // N/mm felt: stiffer than any hand-held device renders
constexpr double kMinStiffness = 0.02;  // N/mm: anything softer is unusable
constexpr double kMaxStiffness = 100.0; // N/mm, of a proxy
constexpr double kEndless = 1e9;        // mm

// N/mm, of the proxy's coupling.
double stiffnessFor(const haptics::DeviceDescription& device, double scale)
{
  if (!device.givesForce)
    return haptics::ProxyParameters().stiffness;
  const double rendered =
      device.maxStiffness > 0.0 ? std::min(device.maxStiffness, kStiffest) : kSoft;
  return std::clamp(rendered / scale, kMinStiffness, kMaxStiffness);
}

// In the usual ratio to the stiffness, so that a tool held at its burr turns as easily.
double angularStiffnessFor(const haptics::DeviceDescription& device, double scale)
{
  const haptics::ProxyParameters usual;
  const double inRatio = usual.angularStiffness / usual.stiffness * stiffnessFor(device, scale);
  if (!device.givesTorque || !(device.maxAngularStiffness > 0.0))
    return std::max(inRatio, usual.angularStiffness);
  return std::min(device.maxAngularStiffness * scale, inRatio);
}

} // namespace

double usualScale(const haptics::DeviceDescription& device)
{
  return device.givesForce ? 0.5 : 0.25;
}

void fit(session::TouchSession::Setup& setup, const haptics::DeviceDescription& device,
         const DeviceMapping& mapping, bool endless)
{
  setup.tool.coupling.stiffness = stiffnessFor(device, mapping.scale);
  setup.tool.coupling.angularStiffness = angularStiffnessFor(device, mapping.scale);
  setup.guard = {};
  if (endless)
    setup.guard.reach = kEndless;
  setup.limits = {};
  setup.limits.maxForce =
      device.givesForce
          ? std::clamp(mapping.forceLimit.value_or(device.maxForce), 0.0, device.maxForce)
          : 0.0;
  setup.limits.maxTorque = device.givesTorque ? device.maxTorque : 0.0;
  setup.passivity.reset();
  if (!device.givesForce)
    return;
  // As felt at the device, at a gain of 1 / scale.
  haptics::PassivityGuard::Parameters passivity;
  passivity.stiffness = setup.tool.coupling.stiffness * mapping.scale;
  passivity.angularStiffness = setup.tool.coupling.angularStiffness / mapping.scale;
  setup.passivity = passivity;
}

session::ServoParameters parametersFor(const haptics::DeviceDescription& device,
                                       const DeviceMapping& mapping, const core::CameraPose& camera)
{
  session::ServoParameters parameters;
  session::setCamera(parameters, camera);
  parameters.scale = mapping.scale;
  parameters.forceGain = 1.0 / mapping.scale;
  parameters.drillButtons = ActiveDevice::kDrill;
  parameters.clutchButtons = ActiveDevice::kClutch;
  if (!device.givesForce)
    parameters.driftLimit =
        static_cast<float>(mapping.thrust / stiffnessFor(device, mapping.scale));
  session::check(parameters);
  return parameters;
}

Eigen::Vector3d centerFor(const Eigen::Vector3d& tool, const Eigen::Vector3d& hand, double scale,
                          const core::CameraPose& camera)
{
  session::ServoParameters parameters;
  session::setCamera(parameters, camera);
  const double* q = parameters.camera;
  return tool - scale * (Eigen::Quaterniond(q[0], q[1], q[2], q[3]) * hand);
}

} // namespace petrous::presenters
