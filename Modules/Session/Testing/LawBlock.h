#pragma once

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "petrous/Dissection/Catalogues.h"
#include "petrous/Dissection/Stroke.h"
#include "petrous/Dissection/TissueResistance.h"
#include "petrous/Haptics/PointShell.h"
#include "petrous/Volume/LabelMap.h"
#include "petrous/Volume/TissueField.h"

namespace petrous::session::testing
{

/// How a burr is pressed onto the block.
struct LawSetting
{
  dissection::Burr burr;
  double thrust = 1.0;          // N
  double elevation = 0.0;       // rad, of the spindle above the surface
  double voxel = 0.3;           // mm
  double tick = 0.001;          // s
  std::optional<double> border; // x, mm
  double speed = 0.0;           // mm/s, back and forth along y
  double travel = 1.5;          // mm, to either side
  Eigen::Vector3d place{0.013, -0.027, 0.0};
};

/// N/mm^2.
inline double resistance(const dissection::Burr& burr, const std::string& material)
{
  const auto catalogues = dissection::Catalogues::builtIn();
  return resistanceOf(catalogues.materials.material(material), catalogues.burrs.model(burr.kind));
}

/// Of the tool, built once: building takes longer than some time of drilling.
inline std::shared_ptr<const haptics::PointShell> shellOf(const LawSetting& s)
{
  static std::map<std::pair<double, double>, std::shared_ptr<const haptics::PointShell>> shells;
  auto& shell = shells[{s.burr.diameter, s.voxel}];
  if (!shell)
  {
    haptics::BurrShape shape;
    shape.radius = 0.5 * s.burr.diameter;
    shell = std::make_shared<haptics::PointShell>(haptics::makeBurrShell(shape, s.voxel));
  }
  return shell;
}

/// rad/s.
inline double speedOf(const dissection::Burr& burr)
{
  return burr.rpm * 3.14159265358979323846 / 30.0;
}

inline core::GridGeometry gridOf(const LawSetting& s)
{
  const double half = 0.5 * s.burr.diameter + 2.5;
  const int n = static_cast<int>(std::ceil(2.0 * half / s.voxel));
  const int depth = static_cast<int>(std::ceil(4.5 / s.voxel));
  return {{n, n, depth}, Eigen::Vector3d::Constant(s.voxel), {-half, -half, -3.5}};
}

inline volume::TissueField tissueOf(const LawSetting& s, const core::GridGeometry& grid)
{
  auto voxels = std::make_shared<volume::Volume<std::int16_t>>(grid);
  for (int k = 0; k < grid.dims()[2]; ++k)
    for (int j = 0; j < grid.dims()[1]; ++j)
      for (int i = 0; i < grid.dims()[0]; ++i)
      {
        const Eigen::Vector3d p = grid.patientFromVoxel({1.0 * i, 1.0 * j, 1.0 * k});
        voxels->at(i, j, k) = static_cast<std::int16_t>(
            std::clamp(300.0 - p.z() / s.voxel * 1500.0, -1000.0, 1800.0));
      }
  return {std::make_shared<volume::IntensityVolume>(
              std::shared_ptr<const volume::Volume<std::int16_t>>(voxels)),
          {},
          nullptr,
          {}};
}

// 1 before the border, 2 beyond it.
inline std::shared_ptr<const volume::LabelMap> sidesOf(const LawSetting& s,
                                                       const core::GridGeometry& grid)
{
  auto sides = std::make_shared<volume::Volume<std::uint16_t>>(grid);
  for (int k = 0; k < grid.dims()[2]; ++k)
    for (int j = 0; j < grid.dims()[1]; ++j)
      for (int i = 0; i < grid.dims()[0]; ++i)
        sides->at(i, j, k) =
            grid.patientFromVoxel({1.0 * i, 1.0 * j, 1.0 * k}).x() < s.border.value_or(1e9) ? 1 : 2;
  return std::make_shared<volume::LabelMap>(
      volume::makeLabelMap(std::shared_ptr<const volume::Volume<std::uint16_t>>(sides), {}));
}

inline dissection::TissueResistance meetsOf(const LawSetting& s, const volume::TissueField& tissue,
                                            const std::shared_ptr<const volume::LabelMap>& sides)
{
  const double cortical = resistance(s.burr, "cortical-bone");
  return {tissue.ct(),
          {300.0, 1800.0, 1.0, 1.0},
          {{sides, 1, cortical}, {sides, 2, resistance(s.burr, "cellular-bone")}}};
}

} // namespace petrous::session::testing
