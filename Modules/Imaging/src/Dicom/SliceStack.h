#pragma once

#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "petrous/Imaging/SeriesGeometry.h"

namespace petrous::imaging
{

/// Fixed-point text with this many decimals, locale-independent.
std::string decimals(double value, int digits);

constexpr std::size_t kFewest = 3; ///< fewer slices of another orientation or size are no stack

/// Slices closer to each other than this are at one height, mm along the normal.
double sharedPlace(double spacing);

/// Of each three equal gaps in a row (within a tenth) the finest mean, of at least `least`, mm.
std::optional<double> finestPitch(const std::vector<double>& gaps, double least);

/// The numbers by which slices lost along the stack can be told: instance numbers, of frames their
/// InStackPositionNumber. Empty: none, as frames that state none are numbered as they lie in the
/// file.
std::vector<double> numbersAlong(const std::vector<SliceHeader>& slices);

/// Slices of one size and orientation as a stack along their common normal.
///
///   t_k = n . p_k                 position of slice k along the normal n = row x column, mm
///   e_k = (p_k - p_0) - n (t_k - t_0)   its sideways shift; 0 in a straight stack, mm
///   e_k ~ a + b (t_k - t_0)       |b| is the tangent of the gantry tilt
class SliceStack
{
public:
  /// Sorts `slices` along the normal (stable). At least 2 slices, all with a position.
  explicit SliceStack(std::vector<SliceHeader>& slices);

  /// Adds the defects of the stack to `result`, and what was accepted.
  void judge(SeriesGeometry& result);

  /// Slices that share their place with another, in all three axes.
  std::size_t duplicates() const;

  /// Slices that lie beside another of the same height.
  std::size_t besides() const;

  /// Columns of slices beside each other, at overlapping heights, by index: those that are farther
  /// sideways of the last slice of a column than any tilt puts them are of another one. One column
  /// if there are no several of kFewest slices; slices of none are left out.
  std::vector<std::vector<std::size_t>> columns() const;

  /// The slices from which a straight line through the stack leans otherwise, the first being 0:
  /// {0} unless all of it is a few straight stretches.
  std::vector<std::size_t> tiltChanges() const;

  /// Tangents of the lean along rows and columns, of the slices from `first` to before `end`.
  Eigen::Vector2d lean(std::size_t first, std::size_t end) const;

  /// The straight grid closest to the slices, or nullopt if all coincide. Throws
  /// core::InvalidParameter.
  std::optional<core::GridGeometry> grid() const;

private:
  /// The spacing of the stack, mm: the usual gap, or a finer one that occurs and that tells of it
  /// that slices are missing there, or may be. 0 if all slices coincide.
  double pitch() const;
  std::vector<double> numberSteps() const; ///< from slice to slice; empty: not stated
  void followNumbers();
  void judgeGaps(SeriesGeometry& result);
  void judgeLosses(SeriesGeometry& result);
  void judgeEvenness(SeriesGeometry& result);
  void judgeSideways(SeriesGeometry& result) const;
  void noteDeclarations(SeriesGeometry& result) const;
  /// Of a slice whether one of the same height precedes it: at its place, or beside it.
  enum class Twin
  {
    None,
    SamePlace,
    Beside
  };
  std::vector<Twin> twins() const;
  /// p_k - p_0, without the part along the normal.
  Eigen::Vector3d sideways(std::size_t k) const;
  double usualGap() const;
  double tolerance(double spacing) const;
  double sidewaysTolerance() const;

  const std::vector<SliceHeader>& m_slices;
  Eigen::Matrix3d m_direction;
  std::vector<double> m_place;  ///< t_k, mm
  std::vector<double> m_number; ///< k, with jumps where slices are missing
  /// Whether the numbers (numbersAlong) go on across gap k as they do within the stack, so that no
  /// slice was lost in it. Empty: they tell nothing.
  std::vector<bool> m_goesOn;
  double m_spacing = 0.0; ///< mm
  double m_step = 0.0;    ///< unit of the last decimal of the positions, mm
  std::string m_loss;     ///< why its gaps are not interpolated; a sentence, or empty
};

} // namespace petrous::imaging
