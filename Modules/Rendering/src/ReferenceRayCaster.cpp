#include "petrous/Rendering/ReferenceRayCaster.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include <Eigen/Geometry>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include "BoneColor.h"
#include "petrous/Core/HullClip.h"
#include "petrous/Rendering/RenderingError.h"
#include "petrous/Volume/Sampling.h"
#include "petrous/Volume/SmoothedUnion.h"

namespace petrous::rendering
{

namespace
{
constexpr double kStep = 0.25;      // of the smallest spacing
constexpr double kTolerance = 1e-5; // of the smallest spacing
constexpr double kDegree = 3.14159265358979323846 / 180.0;

// [first, last] mm along the ray inside the hull, or last < first.
std::pair<double, double> insideHull(const core::GridGeometry& grid, const PixelRay& ray)
{
  return core::clipToHull(grid, grid.voxelFromPatient(ray.origin),
                          grid.voxelFromPatientLinear() * ray.direction, 0.0,
                          std::numeric_limits<double>::infinity());
}

// The first point of the ray where f > 0, mm; NaN where none.
double firstSurface(const volume::TissueField& field, const PixelRay& ray)
{
  const double h = field.geometry().minSpacing();
  auto [first, last] = insideHull(field.geometry(), ray);
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  if (last < first)
    return none;
  // Rounding must not put the ends outside, where f is air by definition.
  const double inset = std::min(1e-9 * (1.0 + last), 0.5 * (last - first));
  first += inset;
  last -= inset;
  const auto solid = [&](double t) { return field.value(ray.origin + t * ray.direction) > 0.0; };
  if (solid(first))
    return first;
  const auto steps = static_cast<long>(std::ceil((last - first) / (kStep * h)));
  double before = first;
  for (long i = 1; i <= steps; ++i)
  {
    const double t = std::min(first + static_cast<double>(i) * kStep * h, last);
    if (solid(t))
    {
      double air = before;
      double tissue = t;
      while (tissue - air > kTolerance * h)
      {
        const double middle = 0.5 * (air + tissue);
        (solid(middle) ? tissue : air) = middle;
      }
      return 0.5 * (air + tissue);
    }
    before = t;
  }
  return none;
}

// Tissue that the hull's border cuts off is lit as a flat face, as in the GPU's picture.
std::optional<Eigen::Vector3d> borderNormal(const core::GridGeometry& grid,
                                            const Eigen::Vector3d& patient)
{
  const Eigen::Vector3d voxel = grid.voxelFromPatient(patient);
  for (int axis = 0; axis < 3; ++axis)
  {
    const double top = grid.dims()[static_cast<std::size_t>(axis)] - 1.0;
    if (std::min(std::abs(voxel[axis]), std::abs(voxel[axis] - top)) < 1e-4)
      return grid.direction().col(axis);
  }
  return std::nullopt;
}

std::uint8_t toByte(double value)
{
  return static_cast<std::uint8_t>(std::lround(255.0 * std::clamp(value, 0.0, 1.0)));
}
} // namespace

PixelRays::PixelRays(const core::CameraPose& camera, int width, int height)
  : m_camera(camera)
{
  const Eigen::Vector3d towards = camera.focalPoint - camera.position;
  m_forward = towards.normalized();
  const Eigen::Vector3d across = m_forward.cross(camera.viewUp);
  if (!(towards.norm() > 0.0) || !(across.norm() > 1e-9 * camera.viewUp.norm()))
    throw core::InvalidParameter(
        "camera: position and focal point must differ, and view up must not point along the view");
  m_right = across.normalized();
  m_down = m_forward.cross(m_right);
  m_centerColumn = 0.5 * (width - 1.0);
  m_centerRow = 0.5 * (height - 1.0);
  const double halfHeight =
      camera.parallelScale ? *camera.parallelScale : std::tan(0.5 * camera.viewAngle * kDegree);
  const bool valid = camera.parallelScale ? *camera.parallelScale > 0.0
                                          : camera.viewAngle > 0.0 && camera.viewAngle < 180.0;
  if (!valid || !std::isfinite(halfHeight))
    throw core::InvalidParameter(
        "camera: the angle must lie between 0 and 180 degrees, the parallel scale above 0 mm");
  m_pixel = 2.0 * halfHeight / height;
}

PixelRay PixelRays::through(double column, double row) const
{
  const Eigen::Vector3d aside =
      m_pixel * ((column - m_centerColumn) * m_right + (row - m_centerRow) * m_down);
  if (m_camera.parallelScale)
    return {m_camera.position + aside, m_forward};
  return {m_camera.position, (m_forward + aside).normalized()};
}

ReferenceRayCaster::ReferenceRayCaster(const volume::TissueField& field,
                                       const SceneContents& contents)
  : m_field(field)
  , m_contents(contents)
{
  for (const StructureContents& structure : contents.structures)
    if (structure.look.shown && structure.labels)
      if (auto inside =
              volume::makeSmoothedUnion(*structure.labels, [&structure](std::uint16_t index)
                                        { return index == structure.index; }))
        m_structures.push_back({std::move(inside), structure.look.color});
}

ReferenceRayCaster::~ReferenceRayCaster() = default;

Eigen::Vector3d ReferenceRayCaster::colorAt(const Eigen::Vector3d& patient,
                                            const Eigen::Vector3d& normal) const
{
  // On the surface of a structure its share is 0.5 within the march's tolerance.
  constexpr double threshold = 0.5 - 1e-3;
  for (const Structure& structure : m_structures)
  {
    const core::GridGeometry& grid = structure.inside->geometry();
    const Eigen::Vector3d voxel = grid.voxelFromPatient(patient);
    if (grid.hullContains(voxel) && volume::sampleTrilinear(*structure.inside, voxel) > threshold)
      return {structure.color[0], structure.color[1], structure.color[2]};
  }
  const BoneColor color(m_contents.iso);
  if (!m_contents.ct)
    return color.cellular;
  const core::GridGeometry& grid = m_contents.ct->geometry();
  const Eigen::Vector3d below = patient - BoneColor::kDepth * grid.minSpacing() * normal;
  return color.at(m_contents.ct->sample(grid.voxelFromPatient(below)));
}

ReferencePicture ReferenceRayCaster::render(const core::CameraPose& camera, int width, int height,
                                            const core::Progress& progress) const
{
  if (width < 1 || height < 1)
    throw RenderingError(RenderingError::Reason::BadSize, "a picture of " + std::to_string(width) +
                                                              " x " + std::to_string(height) +
                                                              " pixels; at least 1 x 1 is needed");
  const PixelRays rays(camera, width, height);
  const std::size_t pixels = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  ReferencePicture result;
  result.picture = {width, height, std::vector<std::uint8_t>(3 * pixels)};
  result.depth = {width, height, std::vector<float>(pixels)};
  const LightSettings& light = m_contents.light;

  const auto drawPixel = [&](int column, int row)
  {
    const std::size_t index = static_cast<std::size_t>(row) * static_cast<std::size_t>(width) +
                              static_cast<std::size_t>(column);
    const PixelRay ray = rays.through(column, row);
    const double depth = firstSurface(m_field, ray);
    result.depth.millimetres[index] = static_cast<float>(depth);
    Eigen::Vector3d color(kBackground[0], kBackground[1], kBackground[2]);
    if (!std::isnan(depth))
    {
      const Eigen::Vector3d point = ray.origin + depth * ray.direction;
      const auto border = borderNormal(m_field.geometry(), point);
      const Eigen::Vector3d slope = border ? *border : m_field.normal(point);
      const double cosine = slope.norm() > 0.0 ? slope.dot(ray.direction) : 1.0;
      const Eigen::Vector3d inwards = border ? Eigen::Vector3d::Zero().eval() : slope;
      color = headlight(colorAt(point, inwards), cosine, light.ambient, light.specular,
                        light.shininess, light.intensity);
    }
    for (int channel = 0; channel < 3; ++channel)
      result.picture.rgb[3 * index + static_cast<std::size_t>(channel)] = toByte(color[channel]);
  };

  std::atomic<int> done{0};
  tbb::parallel_for(tbb::blocked_range<int>(0, height, 1),
                    [&](const tbb::blocked_range<int>& rows)
                    {
                      for (int row = rows.begin(); row < rows.end(); ++row)
                      {
                        progress.check("reference picture");
                        for (int column = 0; column < width; ++column)
                          drawPixel(column, row);
                        progress.report(static_cast<double>(++done) / height, "reference picture");
                      }
                    });
  return result;
}

} // namespace petrous::rendering
