#pragma once

#include <cmath>
#include <cstdint>

#include "petrous/Dissection/SweptSphereCut.h"

namespace petrous::dissection
{

/// To be called before leastLeft, for a cut that reaches `reach` mm around its path.
inline void prepare(const ProtectedTissue& keep, const SweptSphere& burr, double reach,
                    const core::GridGeometry& grid)
{
  const Eigen::Vector3d margin = Eigen::Vector3d::Constant(reach + 2.0 * grid.spacing().maxCoeff());
  keep.prepare({burr.from.cwiseMin(burr.to) - margin, burr.from.cwiseMax(burr.to) + margin});
}

/// The minimum that a cut leaves of a voxel at a patient point, in quantisation steps of the mask.
inline std::uint16_t leastLeft(const ProtectedTissue& keep, const Eigen::Vector3d& patient)
{
  double most = 0.0;
  for (const auto& field : keep)
  {
    const Eigen::Vector3d voxel = field->geometry().voxelFromPatient(patient);
    if (field->geometry().hullContains(voxel))
      most = std::max(most, volume::sampleTrilinear(*field, voxel));
  }
  return static_cast<std::uint16_t>(
      std::lround(std::min(most, 1.0) * double{volume::CutMask::kUntouched}));
}

} // namespace petrous::dissection
