#pragma once

#include <cmath>
#include <random>

#include "CutBall.h"
#include "petrous/Haptics/ConstrainedProxy.h"

// Shared by the tests of proxies. Ground truth of "inside" is volume::TissueField, the field of
// renderer and drill, not the servo's own.
namespace petrous::haptics::testing
{

inline Pose poseAt(const Eigen::Vector3d& position,
                   const Eigen::Quaterniond& rotation = Eigen::Quaterniond::Identity())
{
  return {position, rotation};
}

/// Largest f over the points of a shell.
inline double deepest(const volume::TissueField& tissue, const PointShell& shell, const Pose& pose)
{
  double most = volume::TissueField::kAir;
  for (const Eigen::Vector3d& point : shell.points)
    most = std::max(most, tissue.value(pose * point));
  return most;
}

/// A point without extent.
inline PointShell pointShell()
{
  PointShell shell;
  shell.points = {Eigen::Vector3d::Zero()};
  shell.normals = {-Eigen::Vector3d::UnitZ()};
  return shell;
}

/// A burr with a plain shaft, `reach` mm from the burr's centre to the open end.
inline PointShell shortBurr(double radius, double reach, double h, std::size_t budget)
{
  BurrShape shape;
  shape.radius = radius;
  shape.shaftLength = reach;
  shape.handpieceRadius = 0.0;
  return makeBurrShell(shape, h, budget);
}

/// Random motion within a ball, at up to 1 m/s and 10 rad/s at 1 kHz.
class RandomHand
{
public:
  RandomHand(unsigned seed, const Pose& start, double within)
    : m_random(seed)
    , m_goal(start)
    , m_within(within)
  {
  }

  const Pose& tick()
  {
    if (m_ticks++ % 50 == 0)
    {
      m_velocity = direction() * uniform();
      m_turning = direction() * 0.01 * uniform();
    }
    const Eigen::Vector3d next = m_goal.position + m_velocity;
    if (next.norm() > m_within && next.dot(m_velocity) > 0.0)
      m_velocity = -m_velocity;
    m_goal = moved(m_goal, {m_velocity, m_turning});
    return m_goal;
  }

private:
  double uniform() { return std::uniform_real_distribution<double>(0.0, 1.0)(m_random); }
  Eigen::Vector3d direction()
  {
    std::normal_distribution<double> normal;
    const double x = normal(m_random);
    const double y = normal(m_random);
    const double z = normal(m_random);
    return Eigen::Vector3d(x, y, z).normalized();
  }

  std::mt19937 m_random;
  Pose m_goal;
  double m_within; // mm
  long m_ticks = 0;
  Eigen::Vector3d m_velocity{0.0, 0.0, 0.0}; // mm per tick
  Eigen::Vector3d m_turning{0.0, 0.0, 0.0};  // rad per tick
};

} // namespace petrous::haptics::testing
