#include "petrous/Session/SurfaceApproach.h"

#include <algorithm>
#include <cmath>

namespace petrous::session
{

using Eigen::Vector3d;

namespace
{
constexpr double kSameWay = 0.05; // of the distance
constexpr double kMinWay = 1e-3;  // mm: a position on the surface has a direction, too
} // namespace

Vector3d SurfaceApproach::at(const Vector3d& place)
{
  const double moved = (place - m_place).norm();
  if (m_known && moved <= kSameWay * m_distance)
    return m_way;
  if (!m_search)
    m_search.emplace(m_field, kReach);
  const double h = m_field.geometry().minSpacing();
  // The nearest surface is at most as far as the last one plus the distance moved.
  std::optional<volume::NearestSurface> nearest;
  for (double reach = std::min(m_distance + moved + 2.0 * h, kReach);;
       reach = std::min(2.0 * reach, kReach))
  {
    nearest = m_search->find(place, reach);
    if (nearest || !(reach < kReach))
      break;
  }
  m_known = true;
  m_place = place;
  m_distance = nearest ? std::abs(nearest->distance) : kReach;
  m_way.setZero();
  if (nearest)
  {
    // Within part of a voxel the slope is more accurate.
    Vector3d into = nearest->distance > 0.0 ? Vector3d(nearest->point - place)
                                            : Vector3d(place - nearest->point);
    if (m_distance < 0.5 * h && !nearest->normal.isZero())
      into = -nearest->normal;
    const double length = into.norm();
    if (length > 0.0)
      m_way = std::max(m_distance, kMinWay) / length * into;
  }
  return m_way;
}

void SurfaceApproach::apply(const Vector3d& place, ServoParameters& parameters)
{
  const Vector3d way = at(place);
  std::copy(way.data(), way.data() + 3, parameters.approach);
}

} // namespace petrous::session
