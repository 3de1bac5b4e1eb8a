#pragma once

#include <vector>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include "GlTexture.h"
#include "petrous/Volume/Volume.h"

namespace petrous::rendering
{

/// Reduction factor along each axis (1: none) for the driver to accept a volume, with no edge
/// longer than `largest` texels; 0: only the driver's limit.
core::Index3 reductionFor(const TexelFormat& format, core::Index3 dims, int largest);

/// Texels along each axis after reduction.
core::Index3 reducedDims(const core::Index3& dims, const core::Index3& factor);

/// Maps voxel position to texture coordinate, per axis: v * scale + offset.
struct TextureMap
{
  Eigen::Vector3d scale{1.0, 1.0, 1.0};
  Eigen::Vector3d offset{0.0, 0.0, 0.0};
};
TextureMap textureMap(const core::Index3& dims, const core::Index3& factor);

/// Means of `at(i, j, k)` over blocks of `factor` voxels, for a box of texels.
template <class T, class At>
std::vector<T> reduceBox(const core::Index3& dims, const core::Index3& factor,
                         const core::IndexBox& texels, const At& at)
{
  const core::Index3 size = texels.size();
  std::vector<T> result(texels.count());
  const auto meanOf = [&](int x, int y, int z)
  {
    double sum = 0.0;
    int count = 0;
    for (int k = z * factor[2]; k < std::min((z + 1) * factor[2], dims[2]); ++k)
      for (int j = y * factor[1]; j < std::min((y + 1) * factor[1], dims[1]); ++j)
        for (int i = x * factor[0]; i < std::min((x + 1) * factor[0], dims[0]); ++i, ++count)
          sum += static_cast<double>(at(i, j, k));
    return static_cast<T>(sum / count);
  };
  tbb::parallel_for(
      tbb::blocked_range<int>(0, size[2]),
      [&](const tbb::blocked_range<int>& slices)
      {
        for (int z = slices.begin(); z < slices.end(); ++z)
          for (int y = 0; y < size[1]; ++y)
            for (int x = 0; x < size[0]; ++x)
              result[static_cast<std::size_t>(x) +
                     static_cast<std::size_t>(size[0]) *
                         (static_cast<std::size_t>(y) +
                          static_cast<std::size_t>(size[1]) * static_cast<std::size_t>(z))] =
                  meanOf(texels.lower[0] + x, texels.lower[1] + y, texels.lower[2] + z);
      });
  return result;
}

} // namespace petrous::rendering
