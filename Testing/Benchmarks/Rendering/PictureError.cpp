#include "PictureError.h"

#include <algorithm>
#include <cmath>

#include "petrous/Core/Error.h"

namespace petrous::rendering
{

namespace
{
double quantile(std::vector<double>& values, double share)
{
  if (values.empty())
    return 0.0;
  const auto last = static_cast<double>(values.size() - 1);
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(std::lround(share * last));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}
} // namespace

PictureError comparePictures(const Picture& picture, const DepthImage& depth,
                             const std::vector<float>& trueRgb, const DepthImage& trueDepth,
                             double voxel)
{
  const std::size_t pixels = depth.millimetres.size();
  if (picture.rgb.size() != 3 * pixels || trueRgb.size() != 3 * pixels ||
      trueDepth.millimetres.size() != pixels)
    throw core::InvalidParameter("picture error: the pictures' sizes differ");
  PictureError error;
  error.pixels = pixels;
  std::vector<double> depths;
  double squares = 0.0;
  for (std::size_t p = 0; p < pixels; ++p)
  {
    const bool isHit = !std::isnan(depth.millimetres[p]);
    const bool isTrulyHit = !std::isnan(trueDepth.millimetres[p]);
    error.hit += isHit || isTrulyHit;
    if (!isHit || !isTrulyHit)
      continue;
    const double apart =
        std::abs(static_cast<double>(depth.millimetres[p]) - trueDepth.millimetres[p]) / voxel;
    depths.push_back(apart);
    if (apart > kDepthAgreement)
      continue;
    ++error.agreeing;
    for (std::size_t c = 3 * p; c < 3 * p + 3; ++c)
      squares += std::pow(picture.rgb[c] - 255.0 * trueRgb[c], 2);
  }
  if (error.agreeing)
    error.rms = std::sqrt(squares / (3.0 * static_cast<double>(error.agreeing)));
  error.depthMedian = quantile(depths, 0.5);
  error.depthP95 = quantile(depths, 0.95);
  return error;
}

} // namespace petrous::rendering
