#pragma once

#include <Eigen/Core>

namespace petrous::rendering
{

/// Colour of bone by its density a little below the surface: cellular bone is warm, cortical bone
/// ivory. Shared by the GPU's picture and the reference.
struct BoneColor
{
  Eigen::Vector3d cellular{0.80, 0.60, 0.42};
  Eigen::Vector3d cortical{0.95, 0.91, 0.80};
  double cellularValue; ///< HU
  double corticalValue; ///< HU

  explicit BoneColor(double iso)
    : cellularValue(iso)
    , corticalValue(iso + 1100.0)
  {
  }

  Eigen::Vector3d at(double value) const;

  /// How far below the surface the density is taken, in smallest spacings.
  static constexpr double kDepth = 1.0;
};

/// Cosine of the angle between eye and normal -> lit colour, with the lamp at the eye.
Eigen::Vector3d headlight(const Eigen::Vector3d& color, double cosine, double ambient,
                          double specular, double shininess, double intensity);

/// What is behind everything; RGB, 0 to 1.
constexpr double kBackground[3] = {0.105, 0.115, 0.130};

} // namespace petrous::rendering
