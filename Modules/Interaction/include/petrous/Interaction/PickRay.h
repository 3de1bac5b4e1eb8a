#pragma once

#include <functional>
#include <optional>

#include <Eigen/Core>

#include "petrous/Volume/TissueField.h"

namespace petrous::interaction
{

/// A ray of sight, patient LPS mm.
struct PickRay
{
  Eigen::Vector3d origin{0.0, 0.0, 0.0};
  Eigen::Vector3d direction{0.0, 0.0, 1.0}; ///< unit, away from the camera

  Eigen::Vector3d at(double distance) const { return origin + distance * direction; }
};

/// Distance in mm from the ray's origin to the first tissue; nullopt if it misses.
using TissueQuery = std::function<std::optional<double>(const PickRay&)>;

/// Query on a field; 0 if the ray starts in tissue. The grid may be anywhere along the ray.
std::optional<double> firstTissue(const volume::TissueField& field, const PickRay& line);

} // namespace petrous::interaction
