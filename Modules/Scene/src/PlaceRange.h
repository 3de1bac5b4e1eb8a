#pragma once

#include <Eigen/Core>

namespace petrous::scene
{

/// mm. Farther from the origin than any image lies, and no program writes it; what is computed of
/// such a place is still a number.
constexpr double kFarthestPlace = 1e7;

/// Whether a point, patient LPS mm, or an offset can be one of a picture.
inline bool isPlace(const Eigen::Vector3d& point)
{
  return (point.array().abs() <= kFarthestPlace).all(); // false for NaN
}

} // namespace petrous::scene
