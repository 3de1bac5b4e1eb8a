#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "petrous/Dissection/RemovalDepthSolver.h"

namespace petrous::dissection
{

/// Where a burr removes tissue: directions from its centre, weighted by the removed amount.
class PatchSums
{
public:
  void clear()
  {
    m_places.clear();
    m_sum.setZero();
    m_all = 0.0;
  }

  /// offset  from the burr's centre, not zero
  /// weight  may be slightly negative due to rounding
  void add(const Eigen::Vector3d& offset, double weight)
  {
    const Eigen::Vector3d direction = offset.normalized();
    m_places.push_back({direction, weight});
    m_sum += weight * direction;
    m_all += weight;
  }

  /// Axes as those of the offsets; spindle: unit, or zero. Zero if nothing is removed.
  ContactPatch patch(double radius, const Eigen::Vector3d& spindle) const
  {
    ContactPatch patch;
    const double length = m_sum.norm();
    if (!(m_all > 0.0) || !(length > 0.0))
      return patch;
    patch.middle = m_sum / length;
    patch.spread = meanDistance(radius, patch.middle);
    if (!spindle.isZero(0.0))
      patch.arm = meanDistance(radius, spindle);
    return patch;
  }

private:
  // Mean distance of the directions, on the sphere, from the line through its centre along `axis`.
  double meanDistance(double radius, const Eigen::Vector3d& axis) const
  {
    double moment = 0.0;
    for (const Place& place : m_places)
    {
      const double along = place.direction.dot(axis);
      moment += place.weight * std::sqrt(std::max(0.0, 1.0 - along * along));
    }
    return radius * std::clamp(moment / m_all, 0.0, 1.0);
  }

  struct Place
  {
    Eigen::Vector3d direction;
    double weight;
  };
  std::vector<Place> m_places;
  Eigen::Vector3d m_sum{0.0, 0.0, 0.0};
  double m_all = 0.0;
};

} // namespace petrous::dissection
