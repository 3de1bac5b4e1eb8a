#include "petrous/Presenters/PointerDrill.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <Eigen/Geometry>

namespace petrous::presenters
{

namespace
{

constexpr double kPi = 3.14159265358979323846;
constexpr int kMostSteps = 64;

struct Span
{
  double from, to; // mm along the line
};

// Where the line passes the patient box of the grid, from the line's origin on.
std::optional<Span> spanInGrid(const core::GridGeometry& grid, const SightLine& line)
{
  const auto [lower, upper] = grid.patientBounds();
  Span span{0.0, 1e9};
  for (Eigen::Index a = 0; a < 3; ++a)
  {
    if (line.direction[a] == 0.0)
    {
      if (line.origin[a] < lower[a] || line.origin[a] > upper[a])
        return std::nullopt;
      continue;
    }
    const double one = (lower[a] - line.origin[a]) / line.direction[a];
    const double two = (upper[a] - line.origin[a]) / line.direction[a];
    span.from = std::max(span.from, std::min(one, two));
    span.to = std::min(span.to, std::max(one, two));
  }
  if (!(span.from < span.to))
    return std::nullopt;
  return span;
}

Eigen::Vector3d pointOn(const SightLine& line, double distance)
{
  return line.origin + distance * line.direction;
}

// Offsets over the ball's disc, in radii. The rim is left out: there the wall of the burr's own
// hole would be felt.
std::array<Eigen::Vector2d, 24> discOffsets()
{
  std::array<Eigen::Vector2d, 24> offsets;
  std::size_t n = 0;
  for (const auto& [ring, count] : {std::pair{0.28, 6}, std::pair{0.55, 8}, std::pair{0.78, 10}})
    for (int k = 0; k < count; ++k, ++n)
      offsets[n] =
          ring * Eigen::Vector2d(std::cos(2.0 * kPi * k / count), std::sin(2.0 * kPi * k / count));
  return offsets;
}

SightLine between(const SightLine& a, const SightLine& b, double share)
{
  return {a.origin + share * (b.origin - a.origin),
          (a.direction + share * (b.direction - a.direction)).normalized()};
}

} // namespace

std::optional<double> firstTissue(const volume::TissueField& field, const SightLine& line)
{
  const auto span = spanInGrid(field.geometry(), line);
  if (!span)
    return std::nullopt;
  const auto hit = field.firstHit(pointOn(line, span->from), pointOn(line, span->to));
  if (!hit)
    return std::nullopt;
  return span->from + *hit;
}

std::optional<double> burrRest(const volume::TissueField& field, const SightLine& line,
                               double radius)
{
  static const auto offsets = discOffsets();
  const Eigen::Vector3d right = line.direction.unitOrthogonal();
  const Eigen::Vector3d up = right.cross(line.direction);
  std::optional<double> nearest;
  const auto feel = [&](const Eigen::Vector2d& offset)
  {
    const SightLine parallel{line.origin + radius * (offset[0] * right + offset[1] * up),
                             line.direction};
    if (const auto hit = firstTissue(field, parallel))
    {
      // The ball's front lies sqrt(R^2 - offset^2) before its centre.
      const double center = *hit - radius * std::sqrt(1.0 - offset.squaredNorm());
      nearest = std::min(nearest.value_or(center), center);
    }
  };
  feel(Eigen::Vector2d::Zero());
  for (const Eigen::Vector2d& offset : offsets)
    feel(offset);
  if (nearest)
    nearest = std::max(*nearest, 0.0);
  return nearest;
}

PointerDrill::PointerDrill(DrillSession& session, const dissection::Burr& burr, double feed)
  : m_session(session)
  , m_burr(burr)
  , m_feed(feed)
{
  if (!(feed >= 0.0))
    throw core::InvalidParameter("drill: feed must be 0 mm/s or more");
}

void PointerDrill::begin(const SightLine& line, double seconds,
                         const std::optional<core::CameraPose>& camera)
{
  m_session.begin(m_burr, utcNow(), seconds, camera);
  m_last = seconds;
  m_line.reset();
  m_depth.reset();
  m_center.reset();
  step(line, 0.0, seconds);
}

bool PointerDrill::moveTo(const SightLine& line, double seconds)
{
  if (!m_session.drilling())
    return false;
  const double radius = 0.5 * m_burr.diameter;
  const double feed = std::min(m_feed * std::max(seconds - m_last, 0.0), radius);
  m_last = seconds;
  int steps = 1;
  const SightLine from = m_line.value_or(line);
  if (m_depth)
  {
    const double way = (pointOn(line, *m_depth) - pointOn(from, *m_depth)).norm();
    steps = std::clamp(static_cast<int>(std::ceil(way / (0.5 * radius))), 1, kMostSteps);
  }
  bool changed = false;
  for (int n = 1; n <= steps; ++n)
    changed =
        step(between(from, line, static_cast<double>(n) / steps), feed / steps, seconds) || changed;
  return changed;
}

bool PointerDrill::step(const SightLine& line, double feed, double seconds)
{
  const SightLine from = m_line.value_or(line);
  m_line = line;
  const auto rest = burrRest(m_session.field(), line, 0.5 * m_burr.diameter);
  if (!rest && !m_depth)
    return false; // in the air from the start
  // Past the bone's edge the burr stays at its height.
  const double depth = rest ? *rest + feed : *m_depth;
  const double before = m_depth.value_or(depth);
  m_depth = depth;
  m_center = pointOn(line, depth);
  const Eigen::Vector3d corner = depth > before ? pointOn(line, before) : pointOn(from, depth);
  const bool moved = m_session.moveTo(corner, seconds);
  return m_session.moveTo(*m_center, seconds) || moved;
}

std::shared_ptr<const dissection::Stroke> PointerDrill::end()
{
  return m_session.end();
}

} // namespace petrous::presenters
