#include "SurfaceGeometry.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Geometry>

#include "DrilledMesh.h"
#include "OpticalModel.h"
#include "SurfaceActor.h"
#include "petrous/Rendering/RenderingError.h"
#include "petrous/Rendering/ToolShape.h"

namespace petrous::rendering
{

namespace
{

struct ShapeHit
{
  double distance = 0.0;  // mm along the ray
  Eigen::Vector3d normal; // unit; orientation unspecified
};
using Hit = std::optional<ShapeHit>;

void takeNearer(Hit& nearest, const Hit& other)
{
  if (other && (!nearest || other->distance < nearest->distance))
    nearest = other;
}

Hit meetSphere(const PixelRay& ray, const Eigen::Vector3d& center, double radius)
{
  const Eigen::Vector3d to = center - ray.origin;
  const double along = to.dot(ray.direction);
  const double inside = radius * radius - (to - along * ray.direction).squaredNorm();
  if (inside < 0.0)
    return std::nullopt;
  double t = along - std::sqrt(inside);
  if (t <= 0.0)
    t = along + std::sqrt(inside);
  if (t <= 0.0)
    return std::nullopt;
  return ShapeHit{t, (t * ray.direction - to) / radius};
}

// A capped cylinder from `base` along the unit axis.
Hit meetCylinder(const PixelRay& ray, const Eigen::Vector3d& base, const Eigen::Vector3d& axis,
                 double length, double radius)
{
  Hit nearest;
  const Eigen::Vector3d from = ray.origin - base;
  const double rise = ray.direction.dot(axis);
  const double height = from.dot(axis);
  const Eigen::Vector3d across = ray.direction - rise * axis;
  const Eigen::Vector3d aside = from - height * axis;
  const auto offer = [&](double t, const Eigen::Vector3d& normal)
  {
    if (t > 0.0 && std::isfinite(t))
      takeNearer(nearest, ShapeHit{t, normal});
  };
  const double a = across.squaredNorm();
  const double b = across.dot(aside);
  const double inside = b * b - a * (aside.squaredNorm() - radius * radius);
  if (a > 0.0 && inside >= 0.0)
    for (const double root : {-std::sqrt(inside), std::sqrt(inside)})
    {
      const double t = (-b + root) / a;
      if (height + t * rise >= 0.0 && height + t * rise <= length)
        offer(t, (aside + t * across) / radius);
    }
  if (rise != 0.0)
    for (const double end : {0.0, length})
    {
      const double t = (end - height) / rise;
      if ((aside + t * across).norm() <= radius)
        offer(t, axis);
    }
  return nearest;
}

// Interpolated between the vertices.
Eigen::Vector3d normalAt(const core::TriangleMesh& mesh,
                         const std::vector<Eigen::Vector3f>& normals,
                         const volume::MeshTree::Hit& hit)
{
  const auto& corner = mesh.triangles[hit.triangle];
  const Eigen::Vector3d normal = (1.0 - hit.u - hit.v) * normals[corner[0]].cast<double>() +
                                 hit.u * normals[corner[1]].cast<double>() +
                                 hit.v * normals[corner[2]].cast<double>();
  if (normal.norm() > 0.0)
    return normal.normalized();
  const Eigen::Vector3d a = mesh.vertices[corner[0]].cast<double>();
  return (mesh.vertices[corner[1]].cast<double>() - a)
      .cross(mesh.vertices[corner[2]].cast<double>() - a)
      .normalized();
}

// What a hit is seen by.
struct Sight
{
  const PixelRay& ray;
  double focus;
  const SurfaceGeometry::Seeing& seeing;
};

Eigen::Vector3d lit(const Eigen::Vector3d& color, const ShapeHit& hit, const Sight& sight,
                    const LightSettings& light, bool isTool)
{
  const double cosine = hit.normal.dot(sight.ray.direction);
  optics::Seen seen;
  if (sight.seeing)
    seen = sight.seeing(sight.ray.origin + hit.distance * sight.ray.direction,
                        cosine > 0.0 ? (-hit.normal).eval() : hit.normal, isTool);
  return optics::displayed(optics::surfaceColor({{color[0], color[1], color[2]}, 0.0, 1.0},
                                                light.shininess, cosine, light, hit.distance, seen,
                                                sight.focus),
                           light);
}

struct ToolHits
{
  Hit burr, shaft, handpiece;
};

ToolHits meetTool(const ToolPose& tool, const PixelRay& ray)
{
  const Eigen::Vector3d axis = tool.axisToHand.normalized();
  ToolHits hits;
  hits.burr = meetSphere(ray, tool.center, tool.radius);
  hits.shaft = meetCylinder(ray, tool.center, axis, tool::kShaftLength, tool::shaftRadius(tool));
  if (tool.handpiece)
    hits.handpiece = meetCylinder(ray, tool.center + tool::kShaftLength * axis, axis,
                                  tool::kHandpieceLength, tool::kHandpieceRadius);
  return hits;
}

// Flat triangles.
Hit meetInstrument(const ToolPose& tool, const volume::MeshTree& tree, const PixelRay& ray)
{
  const Eigen::Quaterniond toTool = tool.rotation.conjugate();
  const auto hit =
      tree.firstAlong(toTool * (ray.origin - tool.center), toTool * ray.direction, 0.0);
  if (!hit)
    return std::nullopt;
  const auto& [a, b, c] = tree.triangles()[hit->triangle];
  return ShapeHit{hit->distance, tool.rotation * (b - a).cross(c - a).normalized()};
}

void addTool(const ToolPose& tool, const std::optional<volume::MeshTree>& instrument,
             const LightSettings& lamp, const Sight& sight, std::vector<SurfaceGeometry::Hit>& hits)
{
  LightSettings light = lamp;
  light.intensity = 1.0;
  light.ambient = tool::kAmbient;
  light.specular = tool::kSpecular;
  light.shininess = tool::kShininess;
  const auto add = [&](const Hit& hit, const std::array<double, 3>& color)
  {
    if (hit)
      hits.push_back(
          {hit->distance, lit({color[0], color[1], color[2]}, *hit, sight, light, true), 1.0});
  };
  if (instrument)
    return add(meetInstrument(tool, *instrument, sight.ray), tool::kShaftColor);
  const ToolHits met = meetTool(tool, sight.ray);
  add(met.burr, tool.drilling ? tool::kDrillingColor : tool::kBurrColor);
  add(met.shaft, tool::kShaftColor);
  add(met.handpiece, tool::kHandpieceColor);
}

} // namespace

std::optional<double> toolAlong(const ToolPose& tool, const PixelRay& ray)
{
  const ToolHits met = meetTool(tool, ray);
  std::optional<double> nearest;
  for (const Hit& hit : {met.burr, met.shaft, met.handpiece})
    if (hit && !(nearest && *nearest <= hit->distance))
      nearest = hit->distance;
  return nearest;
}

SurfaceGeometry::SurfaceGeometry(const SceneContents& contents)
  : m_hasSection(contents.section.has_value())
  , m_mask(contents.mask)
  , m_light(contents.light)
{
  const std::vector<ClippingPlane> cuts = cutsOf(contents);
  if (!cuts.empty())
    m_kept.emplace(cuts);
  m_light.wetness = 0.0; // VTK draws them dry
  for (const MeshContents& mesh : contents.meshes)
  {
    if (!mesh.mesh)
      throw RenderingError(RenderingError::Reason::BadContents,
                           "picture: mesh " + mesh.name + " has no triangles");
    if (!mesh.look.shown || !(mesh.look.opacity > 0.0F))
      continue;
    std::optional<ShadedMesh> drilled;
    if (contents.mask && mesh.drilled)
      drilled = DrilledMesh(mesh.mesh).surface(*contents.mask);
    const auto shape =
        drilled ? std::make_shared<const core::TriangleMesh>(std::move(drilled->mesh)) : mesh.mesh;
    std::optional<volume::MeshInside> inside;
    if (m_kept)
      inside.emplace(*mesh.mesh);
    if (inside && inside->openEdges() > 0)
      inside.reset();
    m_meshes.push_back({volume::MeshTree(*shape), shape,
                        drilled ? std::move(drilled->normals) : vertexNormals(*shape), mesh.look,
                        std::move(inside), drilled.has_value()});
  }
  if (contents.tool && tool::isShown(*contents.tool))
    m_tool = contents.tool;
  if (m_tool && m_tool->instrument)
    m_instrument.emplace(*m_tool->instrument);
}

std::optional<SurfaceGeometry::Hit> SurfaceGeometry::meet(const Mesh& mesh, const PixelRay& ray,
                                                          double focus, const Seeing& seeing) const
{
  RaySpan span;
  span.last = std::numeric_limits<double>::infinity();
  if (m_kept)
    span = m_kept->clip(ray);
  if (!(span.first < span.last))
    return std::nullopt;
  const Eigen::Vector3d color(mesh.look.color[0], mesh.look.color[1], mesh.look.color[2]);
  const double opacity = std::min(static_cast<double>(mesh.look.opacity), 1.0);
  const auto shaded = [&](const ShapeHit& hit) {
    return lit(color, hit, {ray, focus, seeing}, m_light, false);
  };
  const auto isLeft = [&](const Eigen::Vector3d& point)
  { return m_mask->sample(m_mask->geometry().voxelFromPatient(point)) > 0.5; };
  const Eigen::Vector3d entry = ray.origin + span.first * ray.direction;
  if (span.face && mesh.inside && mesh.inside->contains(entry) &&
      (!mesh.isDrilled || isLeft(entry)))
    return Hit{span.first, m_hasSection ? color : shaded({span.first, *span.face}), opacity};
  const auto hit = mesh.tree.firstAlong(ray.origin, ray.direction, span.first);
  if (!hit || hit->distance > span.last)
    return std::nullopt;
  return Hit{hit->distance, shaded({hit->distance, normalAt(*mesh.mesh, mesh.normals, *hit)}),
             opacity};
}

std::vector<SurfaceGeometry::Hit> SurfaceGeometry::along(const PixelRay& ray, double focus,
                                                         const Seeing& seeing) const
{
  std::vector<Hit> hits;
  for (const Mesh& mesh : m_meshes)
    if (const auto hit = meet(mesh, ray, focus, seeing))
      hits.push_back(*hit);
  if (m_tool)
    addTool(*m_tool, m_instrument, m_light, {ray, focus, seeing}, hits);
  std::sort(hits.begin(), hits.end(),
            [](const Hit& a, const Hit& b) { return a.distance < b.distance; });
  const auto solid =
      std::find_if(hits.begin(), hits.end(), [](const Hit& hit) { return hit.opacity >= 1.0; });
  if (solid != hits.end())
    hits.erase(solid + 1, hits.end());
  return hits;
}

} // namespace petrous::rendering
