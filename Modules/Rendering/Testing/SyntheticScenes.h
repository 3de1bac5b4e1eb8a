#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <type_traits>
#include <utility>

#include <Eigen/Geometry>

#include "petrous/Rendering/SceneContents.h"
#include "petrous/Volume/TissueField.h"

/// Volumes with analytic surfaces.
namespace petrous::rendering::synthetic
{

constexpr double kIso = 300.0; // HU

inline core::GridGeometry cube(int samples, double spacing,
                               const Eigen::Matrix3d& direction = Eigen::Matrix3d::Identity(),
                               const Eigen::Vector3d& center = Eigen::Vector3d::Zero())
{
  const Eigen::Vector3d half = Eigen::Vector3d::Constant(0.5 * spacing * (samples - 1));
  return {{samples, samples, samples},
          Eigen::Vector3d::Constant(spacing),
          center - direction * half,
          direction};
}

inline Eigen::Matrix3d oblique()
{
  return Eigen::AngleAxisd(0.6, Eigen::Vector3d(1.0, 2.0, -0.5).normalized()).toRotationMatrix();
}

inline Eigen::Matrix3d obliqueMirrored()
{
  Eigen::Matrix3d direction = oblique();
  direction.col(0) *= -1.0;
  return direction;
}

/// Voxels with the values `value(patient)`.
template <class T, class Value>
std::shared_ptr<volume::Volume<T>> sampled(const core::GridGeometry& grid, const Value& value)
{
  auto voxels = std::make_shared<volume::Volume<T>>(grid);
  const core::Index3& n = grid.dims();
  for (int k = 0; k < n[2]; ++k)
    for (int j = 0; j < n[1]; ++j)
      for (int i = 0; i < n[0]; ++i)
        voxels->at(i, j, k) =
            static_cast<T>(value(grid.patientFromVoxel(Eigen::Vector3d(i, j, k))));
  return voxels;
}

template <class T>
std::shared_ptr<const volume::IntensityVolume>
intensities(std::shared_ptr<const volume::Volume<T>> voxels)
{
  return std::make_shared<volume::IntensityVolume>(std::move(voxels));
}

/// CT for which `tissue(patient)` is the signed distance into bone, mm.
template <class T, class Tissue>
std::shared_ptr<const volume::IntensityVolume> ct(const core::GridGeometry& grid,
                                                  const Tissue& tissue)
{
  const double lowest = std::is_same_v<T, std::uint16_t> ? 0.0 : -1000.0;
  return intensities<T>(sampled<T>(grid,
                                   [&](const Eigen::Vector3d& p)
                                   {
                                     const double value =
                                         std::clamp(kIso + 120.0 * tissue(p) / grid.minSpacing(),
                                                    lowest, 2500.0);
                                     return std::is_integral_v<T> ? std::round(value) : value;
                                   }));
}

template <class T = std::int16_t>
std::shared_ptr<const volume::IntensityVolume>
ball(const core::GridGeometry& grid, double radius,
     const Eigen::Vector3d& center = Eigen::Vector3d::Zero())
{
  return ct<T>(grid, [&](const Eigen::Vector3d& p) { return radius - (p - center).norm(); });
}

/// Mask for which `kept(patient)` is the signed distance into the remaining tissue, mm.
template <class Kept>
std::shared_ptr<volume::CutMask> cut(const core::GridGeometry& grid, const Kept& kept)
{
  auto mask = std::make_shared<volume::CutMask>(grid);
  for (std::size_t b = 0; b < mask->brickCount(); ++b)
  {
    auto brick = std::make_shared<volume::CutMask::Brick>();
    brick->fill(volume::CutMask::kUntouched);
    bool touched = false;
    const core::IndexBox box = mask->brickBox(b);
    for (int k = box.lower[2]; k < box.upper[2]; ++k)
      for (int j = box.lower[1]; j < box.upper[1]; ++j)
        for (int i = box.lower[0]; i < box.upper[0]; ++i)
        {
          const double depth =
              kept(grid.patientFromVoxel(Eigen::Vector3d(i, j, k))) / grid.minSpacing();
          const double left = std::clamp(0.5 + 0.5 * depth, 0.0, 1.0);
          constexpr int edge = volume::CutMask::kBrickEdge;
          const int at =
              (i - box.lower[0]) + edge * ((j - box.lower[1]) + edge * (k - box.lower[2]));
          (*brick)[static_cast<std::size_t>(at)] =
              static_cast<std::uint16_t>(std::lround(65535.0 * left));
          touched = touched || left < 1.0;
        }
    if (touched)
      mask->setBrick(b, brick);
  }
  return mask;
}

/// Closed; two triangles a side.
inline std::shared_ptr<const core::TriangleMesh> boxMesh(const Eigen::Vector3d& lower,
                                                         const Eigen::Vector3d& upper)
{
  auto mesh = std::make_shared<core::TriangleMesh>();
  for (int corner = 0; corner < 8; ++corner)
    mesh->vertices.emplace_back(static_cast<float>((corner & 1) != 0 ? upper.x() : lower.x()),
                                static_cast<float>((corner & 2) != 0 ? upper.y() : lower.y()),
                                static_cast<float>((corner & 4) != 0 ? upper.z() : lower.z()));
  mesh->triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                     {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  return mesh;
}

/// Closed; a ball by rings and sectors.
inline std::shared_ptr<const core::TriangleMesh> ballMesh(const Eigen::Vector3d& center,
                                                          double radius, int rings = 48)
{
  auto mesh = std::make_shared<core::TriangleMesh>();
  constexpr double kPi = 3.14159265358979323846;
  const int sectors = 2 * rings;
  const auto at = [&](int ring, int sector)
  {
    const double polar = kPi * ring / rings;
    const double around = 2.0 * kPi * (sector % sectors) / sectors;
    return (center + radius * Eigen::Vector3d(std::sin(polar) * std::cos(around),
                                              std::sin(polar) * std::sin(around), std::cos(polar)))
        .cast<float>()
        .eval();
  };
  mesh->vertices.push_back(at(0, 0));
  for (int ring = 1; ring < rings; ++ring)
    for (int sector = 0; sector < sectors; ++sector)
      mesh->vertices.push_back(at(ring, sector));
  mesh->vertices.push_back(at(rings, 0));
  const auto index = [&](int ring, int sector) -> std::uint32_t
  {
    if (ring == 0)
      return 0;
    if (ring == rings)
      return static_cast<std::uint32_t>(mesh->vertices.size() - 1);
    return static_cast<std::uint32_t>(1 + (ring - 1) * sectors + sector % sectors);
  };
  for (int ring = 0; ring < rings; ++ring)
    for (int sector = 0; sector < sectors; ++sector)
    {
      if (ring > 0)
        mesh->triangles.push_back(
            {index(ring, sector), index(ring + 1, sector), index(ring, sector + 1)});
      if (ring < rings - 1)
        mesh->triangles.push_back(
            {index(ring, sector + 1), index(ring + 1, sector), index(ring + 1, sector + 1)});
    }
  return mesh;
}

template <class Inside>
std::shared_ptr<const volume::LabelMap> labels(const core::GridGeometry& grid, const Inside& inside)
{
  return std::make_shared<volume::LabelMap>(volume::makeLabelMap(
      sampled<std::uint16_t>(grid, inside), {volume::Segment{"marker", 1, {}, 0}}));
}

/// CT with the unrounded intensity `value(patient)`, HU.
template <class Value>
std::shared_ptr<const volume::IntensityVolume> image(const core::GridGeometry& grid,
                                                     const Value& value)
{
  return intensities<float>(sampled<float>(grid, value));
}

inline volume::TissueField field(const SceneContents& contents,
                                 std::vector<volume::TissueField::SolidUnion> solids = {})
{
  return {contents.ct, std::move(solids), contents.mask, {contents.iso, 1000.0}};
}

/// First intersection of a ray with a sphere, mm; negative if there is none.
inline double raySphere(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction,
                        const Eigen::Vector3d& center, double radius)
{
  const Eigen::Vector3d to = center - origin;
  const double along = to.dot(direction);
  const double inside = radius * radius - (to.squaredNorm() - along * along);
  return inside < 0.0 ? -1.0 : along - std::sqrt(inside);
}

} // namespace petrous::rendering::synthetic
