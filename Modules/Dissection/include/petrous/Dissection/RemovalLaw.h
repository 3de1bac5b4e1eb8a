#pragma once

namespace petrous::dissection
{

/// The two laws of bone removal by a burr, in SI units. In both, the work done at the contact, F_t
/// r omega per second, removes a proportional volume:
///
///   dV/dt = F_t r omega / w       F_t    thrust, N
///                                 r      distance of the contact from the spindle axis, m
///                                 omega  spindle speed, rad/s
///                                 w      resistance, Pa = J/m^3: energy per unit volume

/// Orthogonal cutting, for the cutting burr [Chan2016, Eq. 5 and 8; signs as in
/// Documentation/equations.md, "Removal of bone"]:
///
///   F_c = F_t (1 + mu tan alpha) / (mu - tan alpha)
///   w   = W_c (mu - tan alpha) / (1 + mu tan alpha)
///
/// Domain: mu - tan alpha >= 0.1 and 1 + mu tan alpha > 0. As mu - tan alpha approaches 0, the
/// force on the chip is unbounded.
class OrthogonalCutting
{
public:
  static constexpr double kMinDifference = 0.1; ///< of mu - tan alpha
  static constexpr double kMaxFriction = 2.0;
  static constexpr double kMaxRake = 1.0471975511965976; ///< pi/3, rad; to either side

  /// specificEnergy  W_c, Pa, > 0
  /// friction        mu of the chip on the tool face, 0 to kMaxFriction
  /// rake            alpha, rad, within +-kMaxRake
  /// Throws InvalidParameter naming the value, or the pair, outside the domain.
  OrthogonalCutting(double specificEnergy, double friction, double rake);

  double resistance() const noexcept { return m_resistance; } ///< Pa

private:
  double m_resistance = 0.0;
};

/// Abrasive wear, for the diamond burr [Chan2016, Eq. 9, after Misra & Finnie]:
///
///   w = 3 H / k       H  Vickers hardness, Pa;  k  wear coefficient
class AbrasiveWear
{
public:
  static constexpr double kMaxWearCoefficient = 1.0;

  /// hardness         H, Pa, > 0
  /// wearCoefficient  k, above 0 to kMaxWearCoefficient
  /// Throws InvalidParameter naming the value outside the domain.
  AbrasiveWear(double hardness, double wearCoefficient);

  double resistance() const noexcept { return m_resistance; } ///< Pa

private:
  double m_resistance = 0.0;
};

} // namespace petrous::dissection
