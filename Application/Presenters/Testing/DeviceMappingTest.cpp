#include "petrous/Presenters/DeviceMapping.h"

#include <gtest/gtest.h>

#include "petrous/Core/Error.h"
#include "petrous/Presenters/ActiveDevice.h"

using namespace petrous;
using namespace petrous::presenters;
using Eigen::Vector3d;

namespace
{

haptics::DeviceDescription motors(double stiffness)
{
  haptics::DeviceDescription device;
  device.givesForce = true;
  device.maxForce = 3.3;
  device.maxStiffness = stiffness;
  return device;
}

// Looks along -y; right is -x, up is z.
core::CameraPose camera()
{
  core::CameraPose pose;
  pose.position = {0.0, 100.0, 0.0};
  pose.focalPoint = {0.0, 0.0, 0.0};
  pose.viewUp = {0.0, 0.0, 1.0};
  return pose;
}

} // namespace

TEST(DeviceMapping, TheUserNeverFeelsAStifferSpringThanTheDeviceRenders)
{
  for (const double stiffness : {0.1, 0.4, 2.0, 10.0})
    for (const double scale : {0.05, 0.25, 0.5, 1.0, 2.0})
    {
      const auto device = motors(stiffness);
      session::TouchSession::Setup setup;
      DeviceMapping held;
      held.scale = scale;
      fit(setup, device, held, false);
      const auto parameters = parametersFor(device, held, camera());
      // At the device: k scale^2 gain (ServoSetup).
      const double felt = setup.tool.coupling.stiffness * scale * scale * parameters.forceGain;
      EXPECT_LE(felt, stiffness + 1e-12);
      EXPECT_GE(felt, 0.5 * stiffness) << "a device is used as far as it goes";
      EXPECT_NEAR(setup.passivity->stiffness, felt, 1e-12);
      // Forces are not scaled: F_D = gain scale F_P (PoseMapping).
      EXPECT_NEAR(parameters.forceGain * parameters.scale, 1.0, 1e-12);
    }
}

TEST(DeviceMapping, NoDeviceGivesMoreThanTenNewtonsPerMillimetre)
{
  session::TouchSession::Setup setup;
  DeviceMapping held;
  held.scale = 0.5;
  fit(setup, motors(50.0), held, false);
  EXPECT_DOUBLE_EQ(setup.passivity->stiffness, 10.0);
}

TEST(DeviceMapping, TheUsersLimitOnlyLowersTheDevices)
{
  const auto most = [](std::optional<double> limit)
  {
    session::TouchSession::Setup setup;
    DeviceMapping held;
    held.forceLimit = limit;
    fit(setup, motors(1.0), held, false);
    return setup.limits.maxForce;
  };
  EXPECT_EQ(most(std::nullopt), 3.3);
  EXPECT_EQ(most(1.2), 1.2);
  EXPECT_EQ(most(50.0), 3.3);
  EXPECT_EQ(most(-1.0), 0.0);
}

TEST(DeviceMapping, ADeviceWithoutMotorsHasADriftLimitOfItsThrust)
{
  const haptics::DeviceDescription cap;
  DeviceMapping held;
  held.thrust = 2.5;
  session::TouchSession::Setup setup;
  fit(setup, cap, held, true);
  EXPECT_NEAR(setup.tool.coupling.stiffness *
                  static_cast<double>(parametersFor(cap, held, camera()).driftLimit),
              2.5, 1e-6);
  EXPECT_FALSE(setup.passivity);
  EXPECT_EQ(setup.limits.maxForce, 0.0);
  EXPECT_GT(setup.guard.reach, 1e6);
  EXPECT_EQ(parametersFor(motors(1.0), held, camera()).driftLimit, 0.0F);
}

TEST(DeviceMapping, TheCentreBringsTheToolThereByTheServosOwnMapping)
{
  const Vector3d tool(1.0, 2.0, 3.0);
  const Vector3d hand(10.0, -20.0, 30.0);
  DeviceMapping held;
  held.scale = 0.3;
  const auto parameters = parametersFor(motors(1.0), held, camera());
  const double* q = parameters.camera;
  const session::PoseMapping::View view{{q[0], q[1], q[2], q[3]}, held.scale};
  session::PoseMapping mapping(centerFor(tool, hand, held.scale, camera()));
  EXPECT_LT((mapping.map({hand, Eigen::Quaterniond::Identity()}, view).position - tool).norm(),
            1e-12);
  // Moving the device to the right moves the tool to the picture's right, which is -x here.
  const auto moved =
      mapping.map({hand + Vector3d(10.0, 0.0, 0.0), Eigen::Quaterniond::Identity()}, view);
  EXPECT_LT((moved.position - tool - Vector3d(-3.0, 0.0, 0.0)).norm(), 1e-12);
  EXPECT_EQ(centerFor(tool, Vector3d::Zero(), 0.3, camera()), tool);
}

TEST(DeviceMapping, RefusesAScaleBeyondTheServosLimits)
{
  const auto parameters = parametersFor(motors(1.0), {}, camera());
  EXPECT_EQ(parameters.clutch, 0);
  EXPECT_EQ(parameters.drill, 0);
  EXPECT_EQ(parameters.constantThrust, 0);
  DeviceMapping bad;
  bad.scale = 1e9;
  EXPECT_THROW(parametersFor(motors(1.0), bad, camera()), core::InvalidParameter);
}
