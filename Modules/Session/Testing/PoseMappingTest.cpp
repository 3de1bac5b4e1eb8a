#include <random>

#include <gtest/gtest.h>

#include "petrous/Core/Error.h"
#include "petrous/Session/PoseMapping.h"
#include "petrous/Session/ServoParameters.h"

using namespace petrous;
using Eigen::Quaterniond;
using Eigen::Vector3d;
using haptics::Pose;
using session::PoseMapping;

namespace
{

class Random
{
public:
  Vector3d vector(double size)
  {
    std::uniform_real_distribution<double> value(-size, size);
    return {value(m_engine), value(m_engine), value(m_engine)};
  }
  Quaterniond rotation()
  {
    std::normal_distribution<double> value;
    return Quaterniond(value(m_engine), value(m_engine), value(m_engine), value(m_engine))
        .normalized();
  }
  Pose pose() { return {vector(100.0), rotation()}; }
  PoseMapping::View view()
  {
    return {rotation(), std::uniform_real_distribution<double>(0.1, 1.0)(m_engine)};
  }

private:
  std::mt19937 m_engine{11};
};

double angle(const Quaterniond& a, const Quaterniond& b)
{
  return haptics::rotationVector(a * b.conjugate()).norm();
}

void expectSame(const Pose& a, const Pose& b, double tolerance = 1e-11)
{
  EXPECT_LT((a.position - b.position).norm(), tolerance);
  EXPECT_LT(angle(a.rotation, b.rotation), tolerance);
}

// The camera's axes on the screen.
struct Screen
{
  core::CameraPose camera;
  Vector3d right, up, toEye;
};

Screen screenOf(Random& random)
{
  Screen screen;
  screen.camera.focalPoint = random.vector(50.0);
  screen.camera.position = screen.camera.focalPoint + random.vector(200.0);
  screen.camera.viewUp = random.vector(1.0);
  // By projection: up is the component of viewUp perpendicular to the line of sight.
  screen.toEye = (screen.camera.position - screen.camera.focalPoint).normalized();
  screen.up =
      (screen.camera.viewUp - screen.camera.viewUp.dot(screen.toEye) * screen.toEye).normalized();
  screen.right = screen.up.cross(screen.toEye);
  return screen;
}

} // namespace

TEST(PoseMapping, MovesAlongTheScreenWhateverTheCamera)
{
  Random random;
  for (int n = 0; n < 200; ++n)
  {
    const Screen screen = screenOf(random);
    session::ServoParameters parameters;
    setCamera(parameters, screen.camera);
    const double* q = parameters.camera;
    const PoseMapping::View view{{q[0], q[1], q[2], q[3]}, 0.5};
    PoseMapping mapping;
    Pose devicePose = random.pose();
    const Vector3d start = mapping.map(devicePose, view).position;
    devicePose.position.x() += 3.0;
    EXPECT_LT((mapping.map(devicePose, view).position - start - 1.5 * screen.right).norm(), 1e-11);
    devicePose.position.y() += 4.0;
    const Vector3d twice = 1.5 * screen.right + 2.0 * screen.up;
    EXPECT_LT((mapping.map(devicePose, view).position - start - twice).norm(), 1e-11);
    devicePose.position.z() -= 5.0;
    EXPECT_LT((mapping.map(devicePose, view).position - start - twice + 2.5 * screen.toEye).norm(),
              1e-11);
  }
}

TEST(PoseMapping, TurnsAboutTheScreensAxes)
{
  Random random;
  for (int n = 0; n < 200; ++n)
  {
    const Screen screen = screenOf(random);
    session::ServoParameters parameters;
    setCamera(parameters, screen.camera);
    const double* q = parameters.camera;
    const PoseMapping::View view{{q[0], q[1], q[2], q[3]}, 0.3};
    PoseMapping mapping;
    Pose devicePose = random.pose();
    const Quaterniond start = mapping.map(devicePose, view).rotation;
    // The device tilts right on the screen: a rotation about the axis towards the camera.
    devicePose.rotation =
        Quaterniond(Eigen::AngleAxisd(0.7, Vector3d::UnitZ())) * devicePose.rotation;
    const Quaterniond expected = Eigen::AngleAxisd(0.7, screen.toEye) * start;
    EXPECT_LT(angle(mapping.map(devicePose, view).rotation, expected), 1e-12);
  }
}

TEST(PoseMapping, IsTheDevicePoseItselfWithoutCameraAndScale)
{
  Random random;
  PoseMapping mapping;
  for (int n = 0; n < 100; ++n)
  {
    const Pose devicePose = random.pose();
    const Pose tool = mapping.map(devicePose, {});
    EXPECT_EQ(tool.position, devicePose.position);
    EXPECT_EQ(tool.rotation.coeffs(), devicePose.rotation.coeffs());
  }
}

TEST(PoseMapping, FirstPlacesTheToolAboutTheCentreWithTheHeadingOnTheScreen)
{
  Random random;
  for (int n = 0; n < 100; ++n)
  {
    const Vector3d center = random.vector(100.0);
    const PoseMapping::View view = random.view();
    const Pose devicePose = random.pose();
    PoseMapping mapping(center);
    const Pose tool = mapping.map(devicePose, view);
    expectSame(tool, {center + view.scale * (view.camera * devicePose.position),
                      view.camera * devicePose.rotation});
  }
}

TEST(PoseMapping, NeverMovesTheToolWhenTheCameraMoves)
{
  Random random;
  PoseMapping mapping(random.vector(50.0));
  Pose devicePose = random.pose();
  for (int n = 0; n < 50; ++n)
  {
    const Pose before = mapping.map(devicePose, random.view());
    for (int turn = 0; turn < 20; ++turn)
      expectSame(mapping.map(devicePose, random.view()), before, 1e-10);
    devicePose = random.pose();
  }
}

TEST(PoseMapping, StaysAUnitRotationWhileTheCameraTurnsForHours)
{
  Random random;
  PoseMapping mapping;
  const Pose devicePose = random.pose();
  const Pose before = mapping.map(devicePose, random.view());
  Pose after;
  for (int n = 0; n < 1000000; ++n)
  {
    PoseMapping::View view;
    view.camera = Quaterniond(std::cos(1e-5 * n), 0.0, std::sin(1e-5 * n), 0.0);
    after = mapping.map(devicePose, view);
  }
  EXPECT_NEAR(after.rotation.norm(), 1.0, 1e-14);
  expectSame(after, before, 1e-8);
}

TEST(PoseMapping, ClutchMovesTheDeviceAndNotTheTool)
{
  Random random;
  PoseMapping mapping;
  mapping.map(random.pose(), random.view());
  for (int n = 0; n < 100; ++n)
  {
    const Pose tool = random.pose();
    const PoseMapping::View view = random.view();
    Pose devicePose;
    for (int tick = 0; tick < 20; ++tick)
      mapping.hold(devicePose = random.pose(), view, tool);
    expectSame(mapping.map(devicePose, view), tool);
    // From here on only the device's own motion counts.
    const Vector3d step = random.vector(5.0);
    const Quaterniond turn(Eigen::AngleAxisd(0.4, random.vector(1.0).normalized()));
    const Pose moved = mapping.map({devicePose.position + step, turn * devicePose.rotation}, view);
    expectSame(moved, {tool.position + view.scale * (view.camera * step),
                       view.camera * turn * view.camera.conjugate() * tool.rotation});
  }
}

TEST(PoseMapping, KeepsThePowerTimesTheGain)
{
  Random random;
  for (int n = 0; n < 500; ++n)
  {
    const PoseMapping::View view = random.view();
    const double gain = 0.2 + 0.01 * n;
    PoseMapping mapping(random.vector(20.0));
    const Pose devicePose = random.pose();
    const Pose tool = mapping.map(devicePose, view);
    const haptics::Motion slow{random.vector(1e-4), random.vector(1e-5)};
    const haptics::Motion moved =
        haptics::motionBetween(tool, mapping.map(haptics::moved(devicePose, slow), view));
    const haptics::Wrench force{random.vector(3.0), random.vector(60.0)};
    const haptics::Wrench felt = mapping.toHand(force, gain);
    const double atTool = force.linear.dot(moved.linear) + force.angular.dot(moved.angular);
    const double atHand = felt.linear.dot(slow.linear) + felt.angular.dot(slow.angular);
    EXPECT_NEAR(atHand, gain * atTool, 1e-9 * (1.0 + gain));
  }
}

TEST(PoseMapping, PushesTheDeviceTheWayTheScreenShows)
{
  Random random;
  const Screen screen = screenOf(random);
  session::ServoParameters parameters;
  setCamera(parameters, screen.camera);
  const double* q = parameters.camera;
  PoseMapping mapping;
  mapping.map({}, {{q[0], q[1], q[2], q[3]}, 0.25});
  const haptics::Wrench felt = mapping.toHand({2.0 * screen.up, 8.0 * screen.toEye}, 4.0);
  EXPECT_LT((felt.linear - Vector3d(0.0, 2.0, 0.0)).norm(), 1e-12);
  EXPECT_LT((felt.angular - Vector3d(0.0, 0.0, 32.0)).norm(), 1e-12);
}

TEST(ServoParameters, NameTheValueThatIsOutOfItsRange)
{
  session::ServoParameters good;
  EXPECT_TRUE(good.valid());
  EXPECT_NO_THROW(check(good));
  const auto expectBad = [&good](double session::ServoParameters::*value, double bad)
  {
    session::ServoParameters p = good;
    p.*value = bad;
    EXPECT_FALSE(p.valid());
    EXPECT_THROW(check(p), core::InvalidParameter);
  };
  expectBad(&session::ServoParameters::scale, 0.0);
  expectBad(&session::ServoParameters::scale, std::nan(""));
  expectBad(&session::ServoParameters::forceGain, -1.0);
  expectBad(&session::ServoParameters::thrust, 21.0);
  expectBad(&session::ServoParameters::approachSpeed, 0.0);
  session::ServoParameters p = good;
  p.camera[0] = 2.0;
  EXPECT_FALSE(p.valid());
  p = good;
  p.approach[2] = std::numeric_limits<double>::infinity();
  EXPECT_FALSE(p.valid());
}

TEST(ServoParameters, RefuseACameraThatLooksNowhere)
{
  session::ServoParameters parameters;
  core::CameraPose camera;
  camera.focalPoint = camera.position;
  EXPECT_THROW(setCamera(parameters, camera), core::InvalidParameter);
  camera.focalPoint = {0.0, 0.0, 5.0};
  camera.viewUp = {0.0, 0.0, 1.0};
  EXPECT_THROW(setCamera(parameters, camera), core::InvalidParameter);
}
