#include "petrous/Presenters/StructureDistances.h"

#include <algorithm>
#include <cmath>

namespace petrous::presenters
{

namespace
{

constexpr double kFar = StructureSurfaces::kFar;
constexpr double kStep = 0.01; // mm, minimum spacing of stored poses

// mm, of no point within `reach` of the tool's origin more. A ball is the same whichever way it is
// turned.
double stepOf(const haptics::Pose& from, const haptics::Pose& to, double reach)
{
  const double turn = reach > 0.0 ? from.rotation.angularDistance(to.rotation) : 0.0;
  return (to.position - from.position).norm() + turn * reach;
}

} // namespace

StructureDistances::StructureDistances(const scene::Case& value, const MeasuredTool& tool)
  : m_surfaces(value)
  , m_tool(tool)
{
}

void StructureDistances::add(const haptics::Pose& pose)
{
  const double reach = m_tool.isInstrument() ? m_tool.reach() : 0.0;
  const double step = m_poses.empty() ? kStep : stepOf(m_poses.back(), pose, reach);
  if (m_surfaces.count() == 0 || step < kStep)
    return;
  m_way.push_back(m_way.empty() ? 0.0 : m_way.back() + step);
  m_poses.push_back(pose);
}

// Minimum distance from the tool to the surface; 0 or less where it reaches it. The distance is
// 1-Lipschitz in path length, so between two poses it is at least half of the sum of theirs minus
// the path length.
double StructureDistances::nearest(std::size_t structure)
{
  struct Stretch
  {
    std::size_t begin, end;
    double atBegin, atEnd;
  };
  const double slack = m_surfaces.spacing(structure);
  const auto surface = [&](const Eigen::Vector3d& patient, double most)
  { return m_surfaces.distance(structure, patient, most); };
  const auto distance = [&](std::size_t n, double most)
  { return m_tool.distance(m_poses[n], surface, most).millimetres; };
  const std::size_t last = m_poses.size() - 1;
  std::vector<Stretch> stretches{{0, last, distance(0, kFar), distance(last, kFar)}};
  double best = std::min(stretches.back().atBegin, stretches.back().atEnd);
  while (!stretches.empty() && best > 0.0)
  {
    const Stretch s = stretches.back();
    stretches.pop_back();
    const double least = 0.5 * (s.atBegin + s.atEnd - (m_way[s.end] - m_way[s.begin]));
    if (s.end - s.begin < 2 || least >= best - (kTolerance - kStep))
      continue;
    const std::size_t middle = (s.begin + s.end) / 2;
    const double there =
        distance(middle, std::abs(s.atBegin) + slack + m_way[middle] - m_way[s.begin]);
    best = std::min(best, there);
    stretches.push_back({s.begin, middle, s.atBegin, there});
    stretches.push_back({middle, s.end, there, s.atEnd});
  }
  return best;
}

std::map<std::string, double> StructureDistances::smallest()
{
  std::map<std::string, double> result;
  if (m_poses.empty())
    return result;
  for (std::size_t n = 0; n < m_surfaces.count(); ++n)
  {
    const double distance = nearest(n);
    if (distance < kFar)
      result[m_surfaces.name(n)] = std::max(0.0, distance);
  }
  return result;
}

} // namespace petrous::presenters
