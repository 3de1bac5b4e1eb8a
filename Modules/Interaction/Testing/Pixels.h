#pragma once

#include <vector>

#include <Eigen/Core>

#include "petrous/Rendering/Picture.h"

namespace petrous::interaction::testing
{

/// Centres of the pixels that differ between two pictures, in pixels from the picture's centre,
/// right and up.
inline std::vector<Eigen::Vector2d> difference(const rendering::Picture& a,
                                               const rendering::Picture& b)
{
  std::vector<Eigen::Vector2d> pixels;
  for (int row = 0; row < a.height; ++row)
    for (int column = 0; column < a.width; ++column)
    {
      int apart = 0;
      for (int c = 0; c < 3; ++c)
        apart += std::abs(a.pixel(column, row)[c] - b.pixel(column, row)[c]);
      if (apart > 30)
        pixels.emplace_back(column + 0.5 - 0.5 * a.width, 0.5 * a.height - row - 0.5);
    }
  return pixels;
}

/// Extent of a set of pixels along and across a direction, from a start point.
struct Reach
{
  double least = 1e9, most = -1e9, aside = 0.0;
};

inline Reach reach(const std::vector<Eigen::Vector2d>& pixels, const Eigen::Vector2d& start,
                   const Eigen::Vector2d& along)
{
  Reach result;
  const Eigen::Vector2d unit = along.normalized();
  for (const Eigen::Vector2d& pixel : pixels)
  {
    const Eigen::Vector2d arm = pixel - start;
    result.least = std::min(result.least, arm.dot(unit));
    result.most = std::max(result.most, arm.dot(unit));
    result.aside = std::max(result.aside, std::abs(arm.x() * unit.y() - arm.y() * unit.x()));
  }
  return result;
}

} // namespace petrous::interaction::testing
