#include "SurfaceShadows.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

#include "SurfaceGeometry.h"
#include "petrous/Rendering/ToolShape.h"

namespace petrous::rendering
{

namespace
{

constexpr double kStep = 0.5;                       // of the smallest spacing
constexpr double kOffset = 0.02;                    // of it, from the surface
constexpr double kNothing = 1e-3;                   // that a ray still carries
constexpr double kGoldenTurn = 2.39996322972865332; // rad

// Unit vectors around an axis: the n-th of `count` at sqrt(share) = sine or tangent of the angle.
struct Disc
{
  Eigen::Vector3d axis;
  Eigen::Vector3d u = axis.unitOrthogonal();
  Eigen::Vector3d v = axis.cross(u);

  Eigen::Vector3d place(int n, int count, double radius) const
  {
    const double r = radius * std::sqrt((n + 0.5) / count);
    const double turn = kGoldenTurn * n;
    return r * (std::cos(turn) * u + std::sin(turn) * v);
  }
};

} // namespace

SurfaceShadows::SurfaceShadows(const TissueOptics& optics, const ClippedRegion& drawn,
                               const std::optional<ToolPose>& tool)
  : m_optics(optics)
  , m_drawn(drawn)
  , m_step(kStep * optics.field().geometry().minSpacing())
{
  if (tool && tool::castsShadow(*tool))
    m_tool = tool;
}

// The fraction that tissue and tool stop on a ray, each part weighted by the distance where it
// does.
template <class Weight>
double SurfaceShadows::stopped(const PixelRay& ray, double reach, const Weight& weight) const
{
  const RaySpan span = m_drawn.clip(ray);
  const auto tool = m_tool ? toolAlong(*m_tool, ray) : std::nullopt;
  const double end = std::min(reach, tool.value_or(reach));
  const double last = std::min(span.last, end);
  double left = 1.0;
  double sum = 0.0;
  TissueOptics::State before = TissueOptics::kAir;
  for (double t = span.first; t < last && left > kNothing; t += m_step)
  {
    const TissueOptics::State state = m_optics.at(ray.origin + t * ray.direction).state;
    if (!TissueOptics::isSolid(before) && TissueOptics::isSolid(state))
    {
      const double stops = left * static_cast<double>(m_optics.materialOf(state).surfaceOpacity);
      sum += stops * weight(t);
      left -= stops;
    }
    before = state;
  }
  if (tool && *tool < reach)
    sum += left * weight(*tool);
  return sum;
}

optics::Seen SurfaceShadows::at(const Eigen::Vector3d& point, const Eigen::Vector3d& normal,
                                const optics::Lamp& lamp) const
{
  if (!(normal.norm() > 0.0))
    return {};
  const Eigen::Vector3d from = point + kOffset / kStep * m_step * normal;
  optics::Seen seen;
  const Disc sky{normal};
  for (int n = 0; n < kSkyRays; ++n)
  {
    const Eigen::Vector3d aside = sky.place(n, kSkyRays, 1.0);
    const Eigen::Vector3d way = aside + std::sqrt(1.0 - aside.squaredNorm()) * normal;
    seen.sky -= stopped({from, way}, optics::kOcclusionReach,
                        [](double t)
                        {
                          const double share = t / optics::kOcclusionReach;
                          return 1.0 - share * share;
                        }) /
                kSkyRays;
  }
  const Disc disc{lamp.from(point)};
  for (int n = 0; n < kLampRays; ++n)
  {
    const Eigen::Vector3d way =
        (disc.axis + disc.place(n, kLampRays, optics::kLampTangent)).normalized();
    seen.lamp -= stopped({from, way}, optics::kShadowReach, [](double) { return 1.0; }) / kLampRays;
  }
  return {std::clamp(seen.sky, 0.0, 1.0), std::clamp(seen.lamp, 0.0, 1.0)};
}

} // namespace petrous::rendering
