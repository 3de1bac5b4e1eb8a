#include "petrous/Presenters/MeasuredTool.h"

#include <algorithm>
#include <utility>

namespace petrous::presenters
{

namespace
{

using Eigen::Vector3d;

constexpr std::size_t kFew = 8; // points that are not divided further
constexpr double kSmall = 0.5;  // mm; a bound is less than the distance by as much: of a smaller
                                // ball the distance itself rules out more

} // namespace

MeasuredTool::MeasuredTool(double radius)
  : m_radius(radius)
  , m_reach(radius)
{
}

// A place of the surface within kInstrumentTip of the tip has a point within `burrSpacing`, any
// other one within `spacing`. So what is nearest to one of the first part lies within
// `burrSpacing` of it.
MeasuredTool::MeasuredTool(const haptics::PointShell& instrument)
  : m_reach(instrument.reach)
{
  std::vector<Vector3d> tip, rest;
  for (const Vector3d& point : instrument.points)
    (point.norm() <= haptics::kInstrumentTip - instrument.spacing ? tip : rest).push_back(point);
  if (!tip.empty())
    m_parts.push_back(partOf(std::move(tip), instrument.burrSpacing));
  if (!rest.empty())
    m_parts.push_back(partOf(std::move(rest), instrument.spacing));
}

MeasuredTool::Part MeasuredTool::partOf(std::vector<Vector3d> points, double spacing)
{
  Part part;
  part.points = std::move(points);
  part.spacing = spacing;
  part.balls.resize(1);
  part.balls[0].end = part.points.size();
  divide(part, 0);
  return part;
}

void MeasuredTool::divide(Part& part, std::size_t ball)
{
  Ball& whole = part.balls[ball];
  const auto begin = part.points.begin() + static_cast<std::ptrdiff_t>(whole.begin);
  const auto end = part.points.begin() + static_cast<std::ptrdiff_t>(whole.end);
  Vector3d lower = *begin;
  Vector3d upper = *begin;
  std::for_each(begin, end,
                [&](const Vector3d& point)
                {
                  lower = lower.cwiseMin(point);
                  upper = upper.cwiseMax(point);
                });
  whole.center = 0.5 * (lower + upper);
  std::for_each(begin, end,
                [&](const Vector3d& point)
                { whole.radius = std::max(whole.radius, (point - whole.center).norm()); });
  const std::size_t count = whole.end - whole.begin;
  if (count <= kFew)
    return;
  Eigen::Index axis = 0;
  (upper - lower).maxCoeff(&axis);
  const auto middle = begin + static_cast<std::ptrdiff_t>(count / 2);
  std::nth_element(begin, middle, end,
                   [axis](const Vector3d& a, const Vector3d& b) { return a[axis] < b[axis]; });
  Ball first, second;
  first.begin = whole.begin;
  first.end = second.begin = whole.begin + count / 2;
  second.end = whole.end;
  const std::size_t halves = whole.halves = part.balls.size();
  part.balls.push_back(first); // `whole` is gone
  part.balls.push_back(second);
  divide(part, halves);
  divide(part, halves + 1);
}

// A distance changes by no more than the way between two points (1-Lipschitz): no point of a ball
// is nearer than its centre less its radius.
MeasuredTool::Distance MeasuredTool::distance(const haptics::Pose& pose, const Surface& surface,
                                              double most, const Surface& bound) const
{
  if (!isInstrument())
  {
    const double there = surface(pose.position, most + m_radius);
    return {there < most + m_radius ? there - m_radius : most, 0.0};
  }
  double nearest = most;
  double least = most;                              // of a place between points
  std::vector<std::pair<double, std::size_t>> open; // least possible distance, ball
  const Surface& lookUp = bound ? bound : surface;
  for (const Part& part : m_parts)
  {
    // Points farther than that change neither the distance nor what may be nearer.
    double best = std::min(most, std::max(nearest, least + part.spacing));
    const double farthest = best;
    const auto consider = [&](std::size_t ball)
    {
      const Ball& one = part.balls[ball];
      const Surface& look = one.radius < kSmall ? surface : lookUp;
      const double reached = look(pose * one.center, best + one.radius) - one.radius;
      if (reached < best)
        open.emplace_back(reached, ball);
    };
    open.clear();
    consider(0);
    while (!open.empty() && best > 0.0)
    {
      const auto [reached, ball] = open.back();
      open.pop_back();
      if (reached >= best)
        continue;
      const Ball& one = part.balls[ball];
      if (one.halves == 0)
        for (std::size_t n = one.begin; n < one.end; ++n)
        {
          if (reached + one.radius - (part.points[n] - one.center).norm() >= best)
            continue;
          const Vector3d point = pose * part.points[n];
          if (one.radius < kSmall || lookUp(point, best) < best)
            best = std::min(best, surface(point, best));
        }
      else
      {
        const std::size_t before = open.size();
        consider(one.halves);
        consider(one.halves + 1);
        if (open.size() == before + 2 && open[before].first < open[before + 1].first)
          std::swap(open[before], open[before + 1]); // the nearer one is next
      }
    }
    nearest = std::min(nearest, best);
    if (best < farthest)
      least = std::min(least, best - part.spacing);
  }
  return {nearest, nearest - std::min(nearest, least)};
}

double MeasuredTool::sampling() const noexcept
{
  double most = 0.0;
  for (const Part& part : m_parts)
    most = std::max(most, part.spacing);
  return most;
}

} // namespace petrous::presenters
