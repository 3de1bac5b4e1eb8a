#include "SurfaceShadows.h"

#include <algorithm>
#include <cmath>
#include <utility>

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
                               const SceneContents& contents)
  : m_optics(optics)
  , m_drawn(drawn)
  , m_mask(contents.mask)
  , m_step(kStep * optics.field().geometry().minSpacing())
{
  for (const MeshContents& mesh : contents.meshes)
  {
    if (!mesh.mesh || !mesh.look.shown || !(mesh.look.opacity > 0.0F))
      continue;
    volume::MeshInside inside(*mesh.mesh);
    if (inside.openEdges() == 0)
      m_meshes.push_back({volume::MeshTree(*mesh.mesh), std::move(inside),
                          std::min(static_cast<double>(mesh.look.opacity), 1.0), mesh.drilled});
  }
  if (contents.tool && tool::isShown(*contents.tool))
    m_tool = contents.tool;
  if (m_tool && m_tool->instrument)
    m_instrument.emplace(*m_tool->instrument);
}

// Where the ray enters what the drill left of a mesh, from outside.
void SurfaceShadows::addEntries(const Mesh& mesh, const PixelRay& ray, double last,
                                std::vector<Entry>& entries) const
{
  constexpr double kSlack = 1e-9; // of a triangle: no ray passes between two
  const auto isLeft = [&](double t)
  {
    const Eigen::Vector3d voxel =
        m_mask->geometry().voxelFromPatient(ray.origin + t * ray.direction);
    return m_mask->sample(voxel) > 0.5;
  };
  const bool isCut = mesh.drilled && m_mask;
  bool isIn = mesh.inside.contains(ray.origin);
  bool isSolid = isIn && (!isCut || isLeft(0.0));
  for (double t = 0.0; t < last;)
  {
    const auto hit = mesh.tree.firstAlong(ray.origin, ray.direction, t, kSlack);
    const double next = hit ? std::min(hit->distance, last) : last;
    if (isIn && isCut)
      for (double inside = t; inside < next; inside += m_step)
      {
        const bool isNext = isLeft(inside);
        if (isNext && !isSolid)
          entries.push_back({inside, mesh.opacity});
        isSolid = isNext;
      }
    isIn = !isIn;
    if (isIn && !isCut && next < last)
      entries.push_back({next, mesh.opacity});
    if (!isIn)
      isSolid = false;
    t = next;
  }
}

std::optional<double> SurfaceShadows::toolAlong(const PixelRay& ray) const
{
  if (!m_tool)
    return std::nullopt;
  if (!m_instrument)
    return rendering::toolAlong(*m_tool, ray);
  const Eigen::Quaterniond toTool = m_tool->rotation.conjugate();
  const auto hit =
      m_instrument->firstAlong(toTool * (ray.origin - m_tool->center), toTool * ray.direction, 0.0);
  return hit ? std::optional(hit->distance) : std::nullopt;
}

// The fraction that tissue, meshes and tool stop on a ray, each part weighted by the distance where
// it does.
template <class Weight>
double SurfaceShadows::stopped(const PixelRay& ray, double reach, Of surface,
                               const Weight& weight) const
{
  const RaySpan span = m_drawn.clip(ray);
  const auto tool = surface == Of::Tool ? std::nullopt : toolAlong(ray);
  const double end = std::min(reach, tool.value_or(reach));
  const double last = std::min(span.last, end);
  std::vector<Entry> entries;
  for (const Mesh& mesh : m_meshes)
    addEntries(mesh, ray, last, entries);
  // What is clipped away of a mesh stops nothing either.
  entries.erase(std::remove_if(entries.begin(), entries.end(),
                               [&](const Entry& entry) { return entry.t < span.first; }),
                entries.end());
  std::sort(entries.begin(), entries.end(),
            [](const Entry& a, const Entry& b) { return a.t < b.t; });
  double left = 1.0;
  double sum = 0.0;
  const auto meet = [&](double t, double opacity)
  {
    const double stops = left * opacity;
    sum += stops * weight(t);
    left -= stops;
  };
  auto next = entries.begin();
  const auto passMeshes = [&](double to)
  {
    for (; next != entries.end() && next->t <= to; ++next)
      meet(next->t, next->opacity);
  };
  TissueOptics::State before =
      surface == Of::Tissue ? TissueOptics::kAir : m_optics.at(ray.origin).state;
  for (double t = span.first; t < last && left > kNothing; t += m_step)
  {
    passMeshes(t);
    const TissueOptics::State state = m_optics.at(ray.origin + t * ray.direction).state;
    if (!TissueOptics::isSolid(before) && TissueOptics::isSolid(state))
      meet(t, static_cast<double>(m_optics.materialOf(state).surfaceOpacity));
    before = state;
  }
  passMeshes(last);
  if (tool && *tool < reach)
    meet(*tool, 1.0);
  return sum;
}

optics::Seen SurfaceShadows::at(const Eigen::Vector3d& point, const Eigen::Vector3d& normal,
                                const optics::Lamp& lamp, Of surface) const
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
    seen.sky -= stopped({from, way}, optics::kOcclusionReach, surface,
                        [](double t)
                        {
                          const double share = t / optics::kOcclusionReach;
                          return 1.0 - share * share;
                        }) /
                kSkyRays;
  }
  const Disc disc{lamp.from(point)};
  const double reach = lamp.reach(point);
  for (int n = 0; n < kLampRays; ++n)
  {
    const Eigen::Vector3d way =
        (disc.axis + disc.place(n, kLampRays, optics::kLampTangent)).normalized();
    seen.lamp -= stopped({from, way}, reach, surface, [](double) { return 1.0; }) / kLampRays;
  }
  return {std::clamp(seen.sky, 0.0, 1.0), std::clamp(seen.lamp, 0.0, 1.0)};
}

} // namespace petrous::rendering
