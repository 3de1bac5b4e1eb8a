#pragma once

#include <functional>
#include <optional>

#include <Eigen/Core>

#include "petrous/Volume/TissueField.h"

namespace petrous::interaction
{

/// A straight line of sight, patient LPS mm.
struct PickRay
{
  Eigen::Vector3d origin{0.0, 0.0, 0.0};
  Eigen::Vector3d direction{0.0, 0.0, 1.0}; ///< unit, away from the eye

  Eigen::Vector3d at(double distance) const { return origin + distance * direction; }
};

/// Where a line first meets tissue, mm from its origin; nothing when it passes by.
using TissueQuery = std::function<std::optional<double>(const PickRay&)>;

/// The same of a field; 0 where the line begins in tissue. The grid may lie anywhere on the line.
std::optional<double> firstTissue(const volume::TissueField& field, const PickRay& line);

} // namespace petrous::interaction
