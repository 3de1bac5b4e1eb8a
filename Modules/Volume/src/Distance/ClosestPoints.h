#pragma once

#include <cstdint>
#include <vector>

#include "petrous/Core/Progress.h"
#include "petrous/Volume/Volume.h"

namespace petrous::volume
{

/// Closest of a set of points for every node of a cubic grid: nodes next to a point are initialised
/// with it, and the closest point is propagated between nodes in eight sweeps (after Danielsson
/// 1980, doi 10.1016/0146-664X(80)90054-4, with the points themselves in place of voxels).
class ClosestPoints
{
public:
  static constexpr std::int32_t kNone = -1;

  /// Node n is at `origin` + `edge` * n.
  ClosestPoints(std::vector<Eigen::Vector3f> points, const core::Index3& dims,
                const Eigen::Vector3d& origin, double edge, const core::Progress& progress);

  bool any() const noexcept { return !m_points.empty(); }
  const Eigen::Vector3f& point(std::size_t node) const noexcept
  {
    return m_points[static_cast<std::size_t>(m_closest[node])];
  }

private:
  Eigen::Vector3f positionOf(int i, int j, int k) const noexcept;
  bool relax(std::size_t node, const Eigen::Vector3f& at, std::int32_t point) noexcept;
  void start();
  bool sweep(const core::Index3& way);

  std::vector<Eigen::Vector3f> m_points;
  core::Index3 m_dims;
  Eigen::Vector3f m_origin;
  float m_edge;
  std::vector<std::int32_t> m_closest;
  std::vector<float> m_square; // squared distance
};

} // namespace petrous::volume
