#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include <Eigen/Geometry>

#include "AnalyticFields.h"

namespace petrous::haptics::testing
{

/// A surface for which the pose of a ball pressed into it is known exactly.
struct AnalyticSurface
{
  std::string name;
  SignedDistance distance;

  /// Constrained position of the centre of a ball for a goal: the point nearest to the goal at
  /// which the ball touches tissue without entering it.
  std::function<Eigen::Vector3d(const Eigen::Vector3d& goal, double radius)> held;

  /// A goal that moves along the surface with s, `depth` mm below the ball's first contact.
  std::function<Eigen::Vector3d(double s, double radius, double depth)> goal;
};

/// Bone below a plane through the origin.
inline AnalyticSurface planeSurface(const Eigen::Matrix3d& turn)
{
  const Eigen::Vector3d n = turn.col(2);
  return {"plane", plane(n),
          [n](const Eigen::Vector3d& goal, double radius)
          { return Eigen::Vector3d(goal + std::max(0.0, radius - n.dot(goal)) * n); },
          [turn](double s, double radius, double depth)
          {
            return Eigen::Vector3d(
                turn * Eigen::Vector3d(1.5 * std::cos(s), 1.5 * std::sin(0.7 * s), radius - depth));
          }};
}

/// A ball of bone, radius 3 mm.
inline AnalyticSurface ballSurface(const Eigen::Matrix3d& turn)
{
  constexpr double bone = 3.0;
  return {"ball", ball(bone),
          [](const Eigen::Vector3d& goal, double radius)
          { return Eigen::Vector3d(goal.normalized() * std::max(goal.norm(), bone + radius)); },
          [turn](double s, double radius, double depth)
          {
            const Eigen::Vector3d out(std::sin(0.5 * std::sin(s)),
                                      std::sin(0.5 * std::cos(0.7 * s)), 1.0);
            return Eigen::Vector3d(turn * out.normalized() * (bone + radius - depth));
          }};
}

/// A torus of bone, radii 4 mm and 1.5 mm.
inline AnalyticSurface torusSurface(const Eigen::Matrix3d& turn)
{
  constexpr double ring = 4.0;
  constexpr double tube = 1.5;
  const Eigen::Vector3d n = turn.col(2);
  return {"torus", torus(ring, tube, n),
          [=](const Eigen::Vector3d& goal, double radius)
          {
            const Eigen::Vector3d across = goal - n.dot(goal) * n;
            const Eigen::Vector3d middle = ring * across.normalized();
            const Eigen::Vector3d out = goal - middle;
            return Eigen::Vector3d(middle + out.normalized() * std::max(out.norm(), tube + radius));
          },
          [=](double s, double radius, double depth)
          {
            const Eigen::Vector3d across(std::cos(0.2 * s), std::sin(0.2 * s), 0.0);
            const double angle = 0.6 + 0.4 * std::sin(s);
            const Eigen::Vector3d out =
                std::cos(angle) * Eigen::Vector3d::UnitZ() + std::sin(angle) * across;
            return Eigen::Vector3d(turn * (ring * across + (tube + radius - depth) * out));
          }};
}

/// A valley of two walls rising at 0.6 rad from its floor; the goal moves from one to the other and
/// along it.
inline AnalyticSurface wedgeSurface(const Eigen::Matrix3d& turn)
{
  constexpr double rise = 0.6;
  const Eigen::Vector3d a = turn * Eigen::Vector3d(std::sin(rise), 0.0, std::cos(rise));
  const Eigen::Vector3d b = turn * Eigen::Vector3d(-std::sin(rise), 0.0, std::cos(rise));
  return {"wedge", wedge(rise, turn),
          [a, b](const Eigen::Vector3d& goal, double radius) -> Eigen::Vector3d
          {
            const double missingA = radius - a.dot(goal);
            const double missingB = radius - b.dot(goal);
            const Eigen::Vector3d onA = goal + std::max(0.0, missingA) * a;
            if (b.dot(onA) >= radius)
              return onA;
            const Eigen::Vector3d onB = goal + std::max(0.0, missingB) * b;
            if (a.dot(onB) >= radius)
              return onB;
            const double c = a.dot(b);
            return goal +
                   ((missingA - c * missingB) * a + (missingB - c * missingA) * b) / (1.0 - c * c);
          },
          [turn](double s, double radius, double depth)
          {
            return Eigen::Vector3d(turn * Eigen::Vector3d(1.2 * std::sin(s),
                                                          2.0 * std::sin(0.3 * s),
                                                          radius / std::cos(rise) - depth));
          }};
}

/// Axis-aligned, or tilted against all three axes of the grid.
inline Eigen::Matrix3d surfaceTurn(bool tilted)
{
  if (!tilted)
    return Eigen::Matrix3d::Identity();
  return Eigen::Quaterniond::FromTwoVectors(Eigen::Vector3d::UnitZ(),
                                            Eigen::Vector3d(0.3, -0.5, 0.8))
      .toRotationMatrix();
}

inline std::vector<AnalyticSurface> analyticSurfaces(bool tilted)
{
  const Eigen::Matrix3d turn = surfaceTurn(tilted);
  return {planeSurface(turn), ballSurface(turn), torusSurface(turn), wedgeSurface(turn)};
}

} // namespace petrous::haptics::testing
