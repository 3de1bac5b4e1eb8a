#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include <Eigen/Core>

#include "petrous/Haptics/PointShell.h"

namespace petrous::haptics
{

/// The convex parts of a ToolSolid in frame T: the ball, the shaft and the handpiece. Lengths mm.
class SolidParts
{
public:
  static constexpr std::size_t kParts = 3;
  static constexpr std::size_t kBall = 0;

  struct Cylinder
  {
    double radius = 0.0; ///< 0: absent
    double from = 0.0;   ///< z of its ends
    double to = 0.0;
    bool lowerFace = false; ///< whether the end is a face, or is inside the adjacent part
    bool upperFace = false;
  };

  /// Where a part is closest to a point.
  struct Nearest
  {
    double distance = 0.0;                  ///< negative inside the part
    Eigen::Vector3d outward{0.0, 0.0, 1.0}; ///< unit, from the part's surface to the point outside
    bool onSide = false;                    ///< of a cylinder, not on a face or edge
    bool onEdge = false;
  };

  explicit SolidParts(const ToolSolid& solid)
    : m_ball(solid.burrRadius)
  {
    const bool hasHandpiece = solid.handpieceRadius > 0.0;
    m_cylinders[0] = {solid.shaftRadius, 0.0, solid.shaftEnd, false, !hasHandpiece};
    m_cylinders[1] = {solid.handpieceRadius, solid.shaftEnd, solid.handpieceEnd, true, true};
  }

  bool has(std::size_t part) const noexcept
  {
    return part == kBall ? m_ball > 0.0 : m_cylinders[part - 1].radius > 0.0;
  }

  const Cylinder& cylinder(std::size_t part) const noexcept { return m_cylinders[part - 1]; }

  /// Of the part, from the tool's origin.
  double reach(std::size_t part) const noexcept
  {
    return part == kBall ? m_ball : std::hypot(cylinder(part).to, cylinder(part).radius);
  }

  double radius(std::size_t part) const noexcept
  {
    return part == kBall ? m_ball : cylinder(part).radius;
  }

  double distance(std::size_t part, const Eigen::Vector3d& p) const noexcept
  {
    if (part == kBall)
      return p.norm() - m_ball;
    const Cylinder& c = cylinder(part);
    const double side = std::sqrt(p.x() * p.x() + p.y() * p.y()) - c.radius;
    const double below = c.from - p.z();
    const double above = p.z() - c.to;
    const double end = std::max(below, above);
    if (end > 0.0)
      return side > 0.0 ? std::sqrt(side * side + end * end) : end;
    double inside = side;
    if (c.lowerFace)
      inside = std::max(inside, below);
    if (c.upperFace)
      inside = std::max(inside, above);
    return inside;
  }

  Nearest nearest(std::size_t part, const Eigen::Vector3d& p) const noexcept
  {
    Nearest result;
    result.distance = distance(part, p);
    if (part == kBall)
    {
      result.outward = unit(p, Eigen::Vector3d::UnitZ());
      return result;
    }
    const Cylinder& c = cylinder(part);
    const Eigen::Vector3d across(p.x(), p.y(), 0.0);
    const double side = across.norm() - c.radius;
    const double below = c.from - p.z();
    const double above = p.z() - c.to;
    const double end = std::max(below, above);
    const Eigen::Vector3d outward = unit(across, Eigen::Vector3d::UnitX());
    const Eigen::Vector3d along(0.0, 0.0, below > above ? -1.0 : 1.0);
    if (end > 0.0 && side > 0.0)
    {
      result.onEdge = true;
      result.outward = (side * outward + end * along).normalized();
    }
    else if (end > 0.0 || (result.distance > side && end <= 0.0))
      result.outward = along;
    else
    {
      result.onSide = true;
      result.outward = outward;
    }
    return result;
  }

private:
  static Eigen::Vector3d unit(const Eigen::Vector3d& v, const Eigen::Vector3d& otherwise) noexcept
  {
    const double length = v.norm();
    return length > 1e-12 ? Eigen::Vector3d(v / length) : otherwise;
  }

  double m_ball;
  std::array<Cylinder, 2> m_cylinders;
};

} // namespace petrous::haptics
