#pragma once

#include "AnalyticFields.h"

namespace petrous::haptics::testing
{

constexpr double kSoftVoxel = 0.3;

inline double air(const Eigen::Vector3d&)
{
  return -2.0;
}

/// An occupancy on a grid whose 1/2 isosurface is the solid's surface.
inline volume::TissueField::SolidUnion occupancyOf(const SignedDistance& solid,
                                                   const core::GridGeometry& grid)
{
  auto occupancy = std::make_shared<volume::Volume<float>>(grid);
  const core::Index3& n = grid.dims();
  for (int k = 0; k < n[2]; ++k)
    for (int j = 0; j < n[1]; ++j)
      for (int i = 0; i < n[0]; ++i)
      {
        const double d = solid(grid.patientFromVoxel({double(i), double(j), double(k)}));
        occupancy->at(i, j, k) =
            static_cast<float>(std::clamp(0.5 + d / (6.0 * grid.minSpacing()), 0.0, 1.0));
      }
  return occupancy;
}

struct SoftPart
{
  SignedDistance solid;
  double stiffness; ///< N/mm
};

/// Soft structures in a cube of `half` mm, surrounded by bone or air.
inline Scene softScene(const std::vector<SoftPart>& parts, const SignedDistance& rigid = air,
                       double half = 6.0)
{
  const auto ct = scanOf(rigid, kSoftVoxel, half);
  std::vector<SoftStructure> soft;
  for (const SoftPart& part : parts)
    soft.push_back(
        {volume::makeDistanceMap(*occupancyOf(part.solid, ct->geometry()), ct->geometry()),
         part.stiffness});
  return sceneOf(ct, {}, soft);
}

} // namespace petrous::haptics::testing
