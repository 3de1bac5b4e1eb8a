#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

namespace petrous::appearance
{

/// Control point of a transfer function [Chan2016, "Visual rendering"].
struct ControlPoint
{
  double value = 0.0;                           ///< HU for CT, native unit for MR
  std::array<float, 3> color{1.0F, 1.0F, 1.0F}; ///< RGB, 0 to 1
  float opacity = 0.0F;                         ///< of 1 mm of this tissue, 0 to 1
  float specular = 1.0F; ///< fraction of the specular highlight on a surface here, 0 to 1
};

/// Maps intensity to colour, opacity per millimetre and specular reflection; piecewise linear,
/// clamped to the first and last control point.
///
/// Opacity refers to one millimetre, so the image depends neither on sampling distance nor on
/// resolution: opacity o of 1 mm is an extinction of -ln(1 - min(o, kLargestOpacity)) per mm.
class TransferFunction
{
public:
  struct Optics
  {
    std::array<double, 3> color{};
    double extinction = 0.0; ///< 1/mm
    double specular = 0.0;
  };

  static constexpr double kLargestOpacity = 0.9999; ///< 9.2 per mm: opaque within a voxel

  /// Throws InvalidParameter naming the first invalid point: no points, values not finite or not
  /// strictly increasing, or a component outside 0 to 1.
  explicit TransferFunction(std::vector<ControlPoint> points);

  /// The same appearance at every intensity.
  static TransferFunction constant(const std::array<float, 3>& color, float opacity,
                                   float specular = 1.0F);

  /// {"points": [{"value": 300, "color": [r, g, b], "opacity": 0.2, "specular": 0.5}, ...]}. Throws
  /// InvalidParameter naming the error.
  static TransferFunction fromJson(std::string_view json);
  std::string toJson() const;

  const std::vector<ControlPoint>& points() const noexcept { return m_points; }
  Optics at(double value) const noexcept; ///< NaN: as the first point
  bool transparent() const noexcept;      ///< opacity 0 at every intensity

private:
  std::vector<ControlPoint> m_points;
};

bool operator==(const ControlPoint& a, const ControlPoint& b) noexcept;
bool operator==(const TransferFunction& a, const TransferFunction& b) noexcept;

} // namespace petrous::appearance
