#include "petrous/Presenters/StructureDistances.h"

#include <algorithm>
#include <cmath>

namespace petrous::presenters
{

namespace
{

constexpr double kFar = StructureSurfaces::kFar;
constexpr double kStep = 0.01; // mm, minimum spacing of stored positions

} // namespace

StructureDistances::StructureDistances(const scene::Case& value, double radius)
  : m_surfaces(value)
  , m_radius(radius)
{
}

void StructureDistances::add(const Eigen::Vector3d& centre)
{
  const double step = m_positions.empty() ? kStep : (centre - m_positions.back()).norm();
  if (m_surfaces.count() == 0 || step < kStep)
    return;
  m_way.push_back(m_way.empty() ? 0.0 : m_way.back() + step);
  m_positions.push_back(centre);
}

// Minimum distance from the centre to the surface; negative inside the structure. The distance is
// 1-Lipschitz in path length, so between two positions it is at least half of the sum of theirs
// minus the path length.
double StructureDistances::nearest(std::size_t structure)
{
  struct Stretch
  {
    std::size_t begin, end;
    double atBegin, atEnd;
  };
  const double slack = m_surfaces.spacing(structure);
  const auto distance = [&](std::size_t n, double most)
  { return m_surfaces.distance(structure, m_positions[n], most); };
  const std::size_t last = m_positions.size() - 1;
  std::vector<Stretch> stretches{{0, last, distance(0, kFar), distance(last, kFar)}};
  double best = std::min(stretches.back().atBegin, stretches.back().atEnd);
  while (!stretches.empty() && best > m_radius)
  {
    const Stretch s = stretches.back();
    stretches.pop_back();
    const double least = 0.5 * (s.atBegin + s.atEnd - (m_way[s.end] - m_way[s.begin]));
    if (s.end - s.begin < 2 || least >= best - (kTolerance - kStep))
      continue;
    const std::size_t middle = (s.begin + s.end) / 2;
    const double there = distance(middle, std::abs(s.atBegin) + slack +
                                              (m_positions[middle] - m_positions[s.begin]).norm());
    best = std::min(best, there);
    stretches.push_back({s.begin, middle, s.atBegin, there});
    stretches.push_back({middle, s.end, there, s.atEnd});
  }
  return best;
}

std::map<std::string, double> StructureDistances::smallest()
{
  std::map<std::string, double> result;
  if (m_positions.empty())
    return result;
  for (std::size_t n = 0; n < m_surfaces.count(); ++n)
  {
    const double distance = nearest(n);
    if (distance < kFar)
      result[m_surfaces.name(n)] = std::max(0.0, distance - m_radius);
  }
  return result;
}

} // namespace petrous::presenters
