#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>

#include "petrous/Haptics/HapticField.h"
#include "petrous/Haptics/PointShell.h"

namespace petrous::haptics::testing
{

/// Signed distance to a solid at a patient point, mm, positive inside.
using SignedDistance = std::function<double(const Eigen::Vector3d&)>;

constexpr double kIso = 300.0;
constexpr double kPerMillimetre = 400.0; ///< HU per mm of distance, within the range of int16
                                         ///< voxels

/// A CT whose isosurface is the solid's surface.
inline std::shared_ptr<const volume::IntensityVolume> scanOn(const core::GridGeometry& grid,
                                                             const SignedDistance& solid)
{
  auto voxels = std::make_shared<volume::Volume<std::int16_t>>(grid);
  const core::Index3& n = grid.dims();
  for (int k = 0; k < n[2]; ++k)
    for (int j = 0; j < n[1]; ++j)
      for (int i = 0; i < n[0]; ++i)
      {
        const double d = solid(grid.patientFromVoxel({double(i), double(j), double(k)}));
        voxels->at(i, j, k) = static_cast<std::int16_t>(
            std::lround(kIso + std::clamp(kPerMillimetre * d, -8000.0, 8000.0)));
      }
  return std::make_shared<volume::IntensityVolume>(
      std::shared_ptr<const volume::Volume<std::int16_t>>(voxels));
}

/// The same on an axis-aligned cube of `half` mm about the origin.
inline std::shared_ptr<const volume::IntensityVolume> scanOf(const SignedDistance& solid, double h,
                                                             double half)
{
  const int n = static_cast<int>(std::ceil(2.0 * half / h)) + 1;
  return scanOn(core::GridGeometry({n, n, n}, Eigen::Vector3d::Constant(h),
                                   Eigen::Vector3d::Constant(-0.5 * h * (n - 1))),
                solid);
}

struct Scene
{
  std::shared_ptr<volume::CutMask> mask;
  std::shared_ptr<volume::PublishedMask> published;
  std::shared_ptr<const volume::TissueField> tissue;
  std::shared_ptr<const HapticField> field;
};

inline Scene sceneOf(std::shared_ptr<const volume::IntensityVolume> ct,
                     std::vector<volume::TissueField::SolidUnion> solids = {},
                     std::vector<SoftStructure> soft = {})
{
  Scene scene;
  scene.mask = std::make_shared<volume::CutMask>(ct->geometry());
  scene.published = std::make_shared<volume::PublishedMask>(*scene.mask);
  scene.tissue = std::make_shared<volume::TissueField>(
      ct, std::move(solids), scene.mask, volume::TissueField::Parameters{kIso, 1000.0});
  scene.field = std::make_shared<HapticField>(*scene.tissue, scene.published, std::move(soft));
  return scene;
}

inline SignedDistance plane(const Eigen::Vector3d& normal, double offset = 0.0)
{
  const Eigen::Vector3d n = normal.normalized();
  return [n, offset](const Eigen::Vector3d& p) { return offset - n.dot(p); };
}

inline SignedDistance ball(double radius)
{
  return [radius](const Eigen::Vector3d& p) { return radius - p.norm(); };
}

inline SignedDistance torus(double major, double minor, const Eigen::Vector3d& axis)
{
  const Eigen::Vector3d n = axis.normalized();
  return [=](const Eigen::Vector3d& p)
  {
    const double along = n.dot(p);
    return minor - std::hypot((p - along * n).norm() - major, along);
  };
}

/// Two walls that meet in a valley along `along`, each rising at `angle` (rad) from the floor.
inline SignedDistance wedge(double angle, const Eigen::Matrix3d& turn)
{
  const Eigen::Vector3d a = turn * Eigen::Vector3d(std::sin(angle), 0.0, std::cos(angle));
  const Eigen::Vector3d b = turn * Eigen::Vector3d(-std::sin(angle), 0.0, std::cos(angle));
  return [a, b](const Eigen::Vector3d& p) { return std::max(-a.dot(p), -b.dot(p)); };
}

inline SignedDistance plate(const Eigen::Vector3d& normal, double thickness)
{
  const Eigen::Vector3d n = normal.normalized();
  return [n, thickness](const Eigen::Vector3d& p) { return 0.5 * thickness - std::abs(n.dot(p)); };
}

/// A plain ball as a shell: an even spiral of points, for tests without a shaft.
inline PointShell ballShell(double radius, std::size_t count)
{
  PointShell shell;
  for (std::size_t i = 0; i < count; ++i)
  {
    const double z = 1.0 - (2.0 * static_cast<double>(i) + 1.0) / static_cast<double>(count);
    const double turn = 2.399963229728653 * static_cast<double>(i);
    const double rho = std::sqrt(1.0 - z * z);
    const Eigen::Vector3d n(rho * std::cos(turn), rho * std::sin(turn), z);
    shell.points.push_back(radius * n);
    shell.normals.push_back(n);
  }
  shell.burrCount = count;
  shell.burrRadius = radius;
  shell.burrTop = radius;
  shell.reach = radius;
  return shell;
}

} // namespace petrous::haptics::testing
