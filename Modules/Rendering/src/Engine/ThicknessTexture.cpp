#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include <tbb/parallel_for.h>

#include "SceneTextures.h"

namespace petrous::rendering
{

void ThicknessTexture::upload(const ThicknessOverlay& overlay)
{
  const volume::Volume<float>& distance = *overlay.distance;
  const core::Index3& dims = distance.geometry().dims();
  // Values just beyond `farthest` must stay distinguishable after interpolation.
  unit = kReach * overlay.farthest;
  map = textureMap(dims, {1, 1, 1});
  constexpr double largest = std::numeric_limits<std::int16_t>::max();
  std::vector<std::int16_t> texels(distance.size());
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, texels.size(), 1U << 16U),
                    [&](const tbb::blocked_range<std::size_t>& range)
                    {
                      for (std::size_t n = range.begin(); n < range.end(); ++n)
                        texels[n] = static_cast<std::int16_t>(std::lround(
                            largest * std::clamp(double{distance.data()[n]} / unit, -1.0, 1.0)));
                    });
  texture.create(texel::kShort, dims, texels.data(), GL_LINEAR);
}

} // namespace petrous::rendering
