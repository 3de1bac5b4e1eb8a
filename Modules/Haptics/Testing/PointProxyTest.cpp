#include "petrous/Haptics/PointProxy.h"

#include <random>

#include <gtest/gtest.h>

#include "ShellChecks.h"
#include "SurfaceErrors.h"

using namespace petrous;
using namespace petrous::haptics;
using namespace petrous::haptics::testing;
using Eigen::Vector3d;

namespace
{

constexpr double kPi = 3.141592653589793;
constexpr double kDegrees = 180.0 / kPi;
constexpr double kStiffness = 1.0; // N/mm, of ProxyParameters

Pose at(const Vector3d& position)
{
  return {position, Eigen::Quaterniond::Identity()};
}

double degreesBetween(const Vector3d& a, const Vector3d& b)
{
  return kDegrees * std::atan2(a.cross(b).norm(), a.dot(b));
}

std::vector<Vector3d> directions(int count)
{
  std::vector<Vector3d> result;
  for (int i = 0; i < count; ++i)
  {
    const double z = 1.0 - (2.0 * i + 1.0) / count;
    const double rho = std::sqrt(1.0 - z * z);
    result.emplace_back(rho * std::cos(2.4 * i), rho * std::sin(2.4 * i), z);
  }
  return result;
}

/// Normal component of the unit vectors towards the centre, summed over the points of a ball's
/// segment: density * integral of cos over the ball beyond a plane at a from the centre.
double segmentSum(double points, double radius, double depth)
{
  const double a = radius - depth;
  const double density = points / (4.0 / 3.0 * kPi * std::pow(radius, 3.0));
  return density * kPi * ((std::pow(radius, 3.0) - std::pow(a, 3.0)) / 3.0 - a * a * depth);
}

Vector3d randomVector(std::mt19937& random, double size)
{
  std::uniform_real_distribution<double> component(-size, size);
  const double x = component(random);
  const double y = component(random);
  return {x, y, component(random)};
}

/// Sum of F . dx over a closed path of the goal, trapezoidal rule, N mm.
template <typename Path>
double workOver(PointProxy& proxy, int steps, Path path)
{
  proxy.place(at(path(0.0)));
  Vector3d before = proxy.step(at(path(0.0))).wrench.linear;
  double work = 0.0;
  for (int i = 1; i <= steps; ++i)
  {
    const Vector3d from = path((i - 1.0) / steps);
    const Vector3d to = path(double(i) / steps);
    const Vector3d force = proxy.step(at(to)).wrench.linear;
    work += 0.5 * (before + force).dot(to - from);
    before = force;
  }
  return work;
}

} // namespace

TEST(PointProxy, FillsTheBallEvenlyWithPoints)
{
  const Scene scene = sceneOf(scanOf(plane({0, 0, 1}), 0.5, 4.0));
  for (const std::size_t count : {500U, 1000U, 1500U})
  {
    const PointProxy proxy(scene.field, {1.5, count, 1.0});
    const auto size = static_cast<double>(proxy.points().size());
    EXPECT_NEAR(size, double(count), 0.02 * double(count));
    Vector3d sum = Vector3d::Zero();
    Eigen::Matrix3d second = Eigen::Matrix3d::Zero();
    int inner = 0;
    for (const Vector3d& point : proxy.points())
    {
      ASSERT_LT(point.norm(), 1.5);
      ASSERT_GT(point.norm(), 0.0);
      sum += point.normalized();
      second += point * point.transpose();
      inner += point.norm() < 1.5 * std::cbrt(0.5);
    }
    EXPECT_LT(sum.norm(), 1e-9);
    // A ball: integral of x x^T over the volume is R^2 / 5 on the diagonal.
    const Eigen::Matrix3d ideal = Eigen::Matrix3d::Identity() * (1.5 * 1.5 / 5.0);
    EXPECT_LT((second / size - ideal).norm(), 0.03 * ideal.norm());
    EXPECT_NEAR(inner / size, 0.5, 0.1);
  }
}

// The superficial force of [Chan2013]: a constant force for each point of the ball beyond the
// plane.
TEST(PointProxy, PushesWithTheSegmentOfTheBallThatIsInTissue)
{
  const double radius = 2.0;
  const CentreBurr burr{radius, 1000, 2.0 / 3.0};
  for (const Vector3d& normal : directions(7))
  {
    const Scene scene = sceneOf(scanOf(plane(normal), 0.3, 5.0));
    PointProxy proxy(scene.field, burr);
    const double most = burr.superficialShare * kStiffness * radius;
    proxy.place(at(1.5 * radius * normal));
    for (double depth = 0.05; depth < radius; depth += 0.13)
    {
      const ProxyTick& tick = proxy.step(at((radius - depth) * normal));
      const double truth =
          proxy.pointForce() * segmentSum(double(proxy.points().size()), radius, depth);
      const double q = depth / radius;
      ASSERT_NEAR(truth, most * q * q * (3.0 - 2.0 * q), 1e-9) << "the closed form as stated";
      EXPECT_NEAR(tick.wrench.linear.norm(), truth, 0.015 * most) << depth;
      EXPECT_NEAR(tick.thrust, tick.wrench.linear.norm(), 1e-9);
      EXPECT_LT((tick.pose.position - (radius - depth) * normal).norm(), 1e-12);
      if (q > 0.2)
      {
        EXPECT_LT(degreesBetween(tick.wrench.linear, normal), 1.5) << depth;
        EXPECT_NEAR(tick.penetration, depth, 0.03 * radius);
        EXPECT_EQ(tick.status, ProxyStatus::Contact);
      }
    }
  }
}

TEST(PointProxy, AddsTheSpringWhereTheCentreWouldEnter)
{
  const double radius = 2.0;
  const CentreBurr burr{radius, 1000, 1.0};
  for (const Vector3d& normal : directions(5))
  {
    const Scene scene = sceneOf(scanOf(plane(normal), 0.3, 5.0));
    PointProxy proxy(scene.field, burr);
    proxy.place(at(1.5 * radius * normal));
    for (const double depth : {0.1, 0.5, 1.0, 2.0})
    {
      const ProxyTick& tick = proxy.step(at(-depth * normal));
      const double truth = kStiffness * (depth + radius);
      EXPECT_NEAR(tick.wrench.linear.norm(), truth, 0.02 * kStiffness * radius);
      EXPECT_LT(degreesBetween(tick.wrench.linear, normal), 1.0);
      EXPECT_NEAR(tick.thrust, truth, 0.02 * kStiffness * radius);
      EXPECT_NEAR(tick.penetration, radius, 0.02 * radius);
      EXPECT_LT(tick.pose.position.norm(), 0.05 * 0.3);
      ASSERT_EQ(tick.contactCount, 2U) << "the plane that holds the centre, and the points";
      EXPECT_LT((tick.contacts[0].arm + radius * normal).norm(), 0.05 * radius);
      EXPECT_NEAR(tick.contacts[0].gap, -radius, 0.01);
    }
  }
}

// Figure 4 of the paper: what fails with points alone, and does not with the proxy.
TEST(PointProxy, KeepsItsDirectionInAThinPlateWherePointsAloneTurnRound)
{
  const double radius = 2.0;
  const Vector3d normal = Vector3d(0.3, -0.5, 0.8).normalized();
  const SignedDistance bone = plate(normal, 0.6);
  const Scene scene = sceneOf(scanOf(bone, 0.3, 6.0));
  PointProxy proxy(scene.field, {radius, 1000, 2.0 / 3.0});
  proxy.place(at(4.0 * normal));
  int turned = 0;
  for (double height = 4.0; height > -4.0; height -= 0.05)
  {
    const Vector3d goal = height * normal;
    Vector3d alone = Vector3d::Zero();
    for (const Vector3d& point : proxy.points())
      if (bone(goal + point) > 0.0)
        alone -= proxy.pointForce() * point.normalized();
    turned += alone.dot(normal) < -0.1;
    const ProxyTick& tick = proxy.step(at(goal));
    EXPECT_GE(tick.wrench.linear.dot(normal), 0.0) << height;
    if (height < 1.5)
    {
      EXPECT_GT(tick.wrench.linear.dot(normal), 0.1) << height;
      EXPECT_LT(degreesBetween(tick.wrench.linear, normal), 4.0) << height;
    }
  }
  EXPECT_GT(turned, 20);
}

// While the centre is free the force has a potential; likewise beyond a plane or a ball.
TEST(PointProxy, GivesAndTakesTheSameOverClosedPaths)
{
  const double radius = 2.0;
  const double stored = kStiffness * radius * radius; // energy scale, N mm
  const Vector3d normal = Vector3d(0.3, -0.5, 0.8).normalized();
  const Vector3d along = normal.unitOrthogonal();
  const Vector3d across = normal.cross(along);
  const auto loop = [&](double height, double size)
  {
    return [=](double s)
    {
      const double turn = 2.0 * kPi * s;
      return Vector3d((height + size * std::cos(turn)) * normal + size * std::sin(turn) * along +
                      0.5 * size * std::sin(2.0 * turn) * across);
    };
  };
  const Scene flat = sceneOf(scanOf(plane(normal), 0.3, 6.0));
  const Scene valley = sceneOf(scanOf(wedge(0.6, surfaceTurn(true)), 0.3, 6.0));
  const Scene round = sceneOf(scanOf(ball(3.0), 0.3, 6.0));
  const CentreBurr burr{radius, 1000, 2.0 / 3.0};
  PointProxy onFlat(flat.field, burr);
  EXPECT_NEAR(workOver(onFlat, 2000, loop(1.2, 0.8)), 0.0, 0.02 * stored) << "superficial";
  EXPECT_NEAR(workOver(onFlat, 2000, loop(1.0, 2.0)), 0.0, 0.02 * stored) << "and deep";
  PointProxy inValley(valley.field, burr);
  EXPECT_NEAR(workOver(inValley, 2000, loop(1.8, 0.8)), 0.0, 0.02 * stored);
  PointProxy onBall(round.field, burr);
  EXPECT_NEAR(workOver(onBall, 2000, loop(3.5, 1.2)), 0.0, 0.02 * stored);
}

TEST(PointProxy, GivesNoTorqueAndTurnsWithTheDevice)
{
  const Scene scene = sceneOf(scanOf(ball(3.0), 0.3, 6.0));
  PointProxy proxy(scene.field, {2.0, 500, 2.0 / 3.0});
  const Vector3d place(1.0, 2.0, 1.5);
  proxy.place(at(2.0 * place));
  proxy.step(at(place));
  const Vector3d straight = proxy.step(at(place)).wrench.linear;
  for (const Vector3d& axis : directions(10))
  {
    const Pose goal{place, Eigen::Quaterniond(Eigen::AngleAxisd(1.3, axis))};
    const ProxyTick& tick = proxy.step(goal);
    EXPECT_EQ(tick.wrench.angular.norm(), 0.0);
    EXPECT_LT((tick.wrench.linear - straight).norm(), 1e-3);
    EXPECT_LT(sumError(tick), 1e-9);
    EXPECT_LT(tick.pose.rotation.angularDistance(goal.rotation), 1e-9);
    EXPECT_LT(proxy.pose().rotation.angularDistance(goal.rotation), 1e-9);
  }
}

TEST(PointProxy, GivesTheSameBitsForTheSameTicks)
{
  const Scene scene = sceneOf(scanOf(ball(2.0), 0.3, 7.0));
  PointProxy one(scene.field, {1.5, 500, 1.0});
  PointProxy two(scene.field, {1.5, 500, 1.0});
  std::mt19937 random(4);
  Vector3d goal(0, 0, 5);
  one.place(at(goal));
  two.place(at(goal));
  int contacts = 0;
  for (int t = 0; t < 1500; ++t)
  {
    goal += randomVector(random, 0.3) - 0.02 * goal;
    const ProxyTick& a = one.step(at(goal));
    const ProxyTick& b = two.step(at(goal));
    contacts += a.contactCount > 1;
    ASSERT_EQ(a.wrench.linear, b.wrench.linear);
    ASSERT_EQ(a.pose.position, b.pose.position);
  }
  EXPECT_GT(contacts, 50);
}

TEST(PointProxy, RefusesWhatItCannotWorkWith)
{
  const Scene scene = sceneOf(scanOf(plane({0, 0, 1}), 0.5, 3.0));
  const auto refused = [&](const CentreBurr& burr, const ProxyParameters& parameters)
  { return checks::refusal([&] { PointProxy(scene.field, burr, parameters); }); };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_NE(refused({nan, 500, 1.0}, {}).find("radius"), std::string::npos);
  EXPECT_NE(refused({6.0, 500, 1.0}, {}).find("radius"), std::string::npos);
  EXPECT_NE(refused({2.0, 10, 1.0}, {}).find("points"), std::string::npos);
  EXPECT_NE(refused({2.0, 500, -0.1}, {}).find("superficial share"), std::string::npos);
  ProxyParameters soft;
  soft.stiffness = 0.0;
  EXPECT_NE(refused({}, soft).find("stiffness"), std::string::npos);
  const std::string fieldless =
      checks::refusal([] { PointProxy(std::shared_ptr<const HapticField>(), CentreBurr()); });
  EXPECT_NE(fieldless.find("field"), std::string::npos);
  EXPECT_EQ(refused({}, {}), "");
}
