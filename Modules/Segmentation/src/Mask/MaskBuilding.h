#pragma once

#include <algorithm>
#include <functional>
#include <memory>
#include <string>

#include <tbb/parallel_for.h>

#include "petrous/Core/Error.h"
#include "petrous/Segmentation/Mask.h"
#include "petrous/Volume/IntensityVolume.h"

namespace petrous::segmentation
{

using Voxels = volume::Volume<std::uint8_t>;

inline void requireSameGrid(const core::GridGeometry& a, const core::GridGeometry& b,
                            const char* what)
{
  if (!core::sameGrid(a, b))
    throw core::InvalidParameter(std::string(what) +
                                 ": the grids differ; use masks and images on one grid");
}

/// `box` with `voxels[a]` more on each side, within the grid.
inline core::IndexBox padded(core::IndexBox box, const core::Index3& voxels,
                             const core::GridGeometry& grid)
{
  for (std::size_t a = 0; a < 3; ++a)
  {
    box.lower[a] -= voxels[a];
    box.upper[a] += voxels[a];
  }
  return box.intersected(grid.fullBox());
}

/// Calls row(j, k) for each row of the box, slices in parallel; cancellable.
template <class Row>
void forEachRow(const core::IndexBox& box, const core::Progress& progress, const char* task,
                const Row& row)
{
  if (box.empty())
    return;
  tbb::parallel_for(box.lower[2], box.upper[2],
                    [&](int k)
                    {
                      progress.check(task);
                      for (int j = box.lower[1]; j < box.upper[1]; ++j)
                        row(j, k);
                    });
}

/// The voxel of a seed (patient, LPS mm). Throws InvalidParameter if that lies outside the image.
core::Index3 seedVoxel(const volume::IntensityVolume& image, const Eigen::Vector3d& seed);

/// The islands of `mask` that hold a voxel of `marks`, on the same grid.
Mask islandsWith(const Mask& mask, const Mask& marks, const core::Progress& progress);

} // namespace petrous::segmentation
