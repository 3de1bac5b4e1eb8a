#include "TextureReduction.h"

#include <algorithm>

namespace petrous::rendering
{

core::Index3 reducedDims(const core::Index3& dims, const core::Index3& factor)
{
  core::Index3 result;
  for (std::size_t a = 0; a < 3; ++a)
    result[a] = (dims[a] + factor[a] - 1) / factor[a];
  return result;
}

core::Index3 reductionFor(const TexelFormat& format, core::Index3 dims, int largest)
{
  core::Index3 factor{1, 1, 1};
  const core::Index3 whole = dims;
  const auto fits = [&](std::size_t longest)
  { return (largest == 0 || dims[longest] <= largest) && GlTexture::fits(format, dims); };
  for (;;)
  {
    const auto longest =
        static_cast<std::size_t>(std::max_element(dims.begin(), dims.end()) - dims.begin());
    if (fits(longest))
      break;
    if (dims[longest] == 1)
      break; // even one texel is refused: the upload reports the error
    factor[longest] *= 2;
    dims = reducedDims(whole, factor);
  }
  return factor;
}

TextureMap textureMap(const core::Index3& dims, const core::Index3& factor)
{
  const core::Index3 texels = reducedDims(dims, factor);
  TextureMap map;
  for (int a = 0; a < 3; ++a)
  {
    const auto axis = static_cast<std::size_t>(a);
    // The centre of block t lies at voxel factor * t + (factor - 1) / 2.
    map.scale[a] = 1.0 / (static_cast<double>(factor[axis]) * texels[axis]);
    map.offset[a] = (0.5 - 0.5 * (factor[axis] - 1.0) / factor[axis]) / texels[axis];
  }
  return map;
}

} // namespace petrous::rendering
