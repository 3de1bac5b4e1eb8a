#include "TissueBricks.h"

#include <algorithm>
#include <cmath>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include "petrous/Volume/ChebyshevDistance.h"
#include "petrous/Volume/Sampling.h"

namespace petrous::haptics
{

namespace
{

constexpr std::uint8_t kTissue = 1;
constexpr int kMostDistance = 255;

struct Found
{
  float max = -std::numeric_limits<float>::infinity();
  Eigen::Array3f step = Eigen::Array3f::Zero(); // largest difference of neighbours along each axis
};

// Voxels that are no number are no tissue; f jumps beside them.
constexpr float kJump = 1e9F;

template <class Volume>
Found look(const Volume& volume, const core::IndexBox& box)
{
  Found found;
  const core::Index3& dims = volume.geometry().dims();
  for (int k = box.lower[2]; k < box.upper[2]; ++k)
    for (int j = box.lower[1]; j < box.upper[1]; ++j)
      for (int i = box.lower[0]; i < box.upper[0]; ++i)
      {
        const auto value = static_cast<float>(volume.at(i, j, k));
        if (value > found.max)
          found.max = value;
        const auto against = [&](int axis, float other)
        {
          const float step = std::abs(other - value);
          found.step[axis] = std::max(found.step[axis], std::isfinite(step) ? step : kJump);
        };
        if (i + 1 < dims[0])
          against(0, static_cast<float>(volume.at(i + 1, j, k)));
        if (j + 1 < dims[1])
          against(1, static_cast<float>(volume.at(i, j + 1, k)));
        if (k + 1 < dims[2])
          against(2, static_cast<float>(volume.at(i, j, k + 1)));
      }
  return found;
}

// The gradient of a trilinear cell is, along each axis, a mean of the four edges' steps.
float steepnessOf(const Found& found, const Eigen::Vector3d& spacing)
{
  return (found.step / spacing.array().cast<float>()).matrix().norm();
}

} // namespace

TissueBricks findTissueBricks(const volume::TissueField& tissue)
{
  const core::GridGeometry& grid = tissue.geometry();
  TissueBricks result;
  for (std::size_t a = 0; a < 3; ++a)
    result.dims[a] = (grid.dims()[a] + kTissueBrick - 1) / kTissueBrick;
  const core::IndexBox all{{0, 0, 0}, result.dims};
  std::vector<std::uint8_t> flags(all.count());
  result.steepness.resize(all.count());
  const auto iso = static_cast<float>(tissue.parameters().iso);
  const auto scale = static_cast<float>(tissue.parameters().scale);

  tbb::parallel_for(
      tbb::blocked_range<int>(0, result.dims[1] * result.dims[2]),
      [&](const tbb::blocked_range<int>& rows)
      {
        for (int row = rows.begin(); row != rows.end(); ++row)
          for (int i = 0; i < result.dims[0]; ++i)
          {
            const core::Index3 at{i, row % result.dims[1], row / result.dims[1]};
            core::IndexBox box;
            for (std::size_t a = 0; a < 3; ++a)
            {
              box.lower[a] = at[a] * kTissueBrick - 1;
              box.upper[a] = (at[a] + 1) * kTissueBrick + 1;
            }
            box = box.intersected(grid.fullBox());
            const Found ct = tissue.ct()->visit([&](const auto& v) { return look(v, box); });
            bool any = ct.max > iso;
            float steepness = steepnessOf(ct, grid.spacing()) / scale;
            Eigen::Vector3d low = Eigen::Vector3d::Constant(std::numeric_limits<double>::max());
            Eigen::Vector3d high = -low;
            for (int corner = 0; corner < 8; ++corner)
            {
              const Eigen::Vector3d p =
                  grid.patientFromVoxel({double(corner & 1 ? box.upper[0] : box.lower[0]),
                                         double(corner & 2 ? box.upper[1] : box.lower[1]),
                                         double(corner & 4 ? box.upper[2] : box.lower[2])});
              low = low.cwiseMin(p);
              high = high.cwiseMax(p);
            }
            for (const auto& share : tissue.solids())
            {
              const core::IndexBox part = share->geometry().boxCovering(low, high);
              if (part.empty())
                continue;
              const Found found = look(*share, part);
              any = any || found.max > 0.5F;
              steepness = std::max(steepness, steepnessOf(found, share->geometry().spacing()));
            }
            const std::size_t n =
                static_cast<std::size_t>(row) * static_cast<std::size_t>(result.dims[0]) +
                static_cast<std::size_t>(i);
            flags[n] = any ? kTissue : 0;
            result.steepness[n] = steepness;
          }
      });

  const volume::DistanceBlock distances =
      volume::chebyshevDistances(flags.data(), 1, kTissue, result.dims, all, kMostDistance);
  result.distance.resize(all.count());
  for (int k = 0; k < result.dims[2]; ++k)
    for (int j = 0; j < result.dims[1]; ++j)
    {
      const std::uint8_t* row = distances.row(j, k);
      std::copy(row, row + result.dims[0],
                result.distance.begin() +
                    static_cast<std::ptrdiff_t>(result.dims[0]) *
                        (j + static_cast<std::ptrdiff_t>(result.dims[1]) * k));
    }
  return result;
}

} // namespace petrous::haptics
