#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "petrous/Imaging/SeriesGeometry.h"

namespace petrous::imaging
{

/// A number with so many digits after the point, the same in every locale.
std::string decimals(double value, int digits);

/// Slices of one size and orientation as a stack along their common normal.
///
///   t_k = n . p_k                 place of slice k along the normal n = row x column, mm
///   e_k = (p_k - p_0) - n (t_k - t_0)   its sideways shift; 0 in a straight stack, mm
///   e_k ~ a + b (t_k - t_0)       |b| is the tangent of the gantry tilt
class SliceStack
{
public:
  /// Sorts `slices` along the normal (equal places keep their order). At least 2, all placed.
  explicit SliceStack(std::vector<SliceHeader>& slices);

  /// Adds what is wrong with the stack, and what was accepted.
  void judge(SeriesGeometry& result);

  /// The straight grid nearest to the slices, or nothing where they all lie at one place.
  /// Throws core::InvalidParameter.
  std::optional<core::GridGeometry> grid() const;

private:
  void judgeGaps(SeriesGeometry& result);
  void judgeEvenness(SeriesGeometry& result);
  void judgeSideways(SeriesGeometry& result) const;
  void noteDeclarations(SeriesGeometry& result) const;
  double usualGap() const;
  double tolerance() const;

  const std::vector<SliceHeader>& m_slices;
  Eigen::Matrix3d m_direction;
  std::vector<double> m_place;  ///< t_k, mm
  std::vector<double> m_number; ///< k, with a jump where slices are missing
  double m_spacing = 0.0;       ///< mm
};

} // namespace petrous::imaging
