#pragma once

#include <memory>
#include <optional>

#include "petrous/Dissection/SweptSphereCut.h"
#include "petrous/Dissection/TissueResistance.h"
#include "petrous/Volume/TissueField.h"

namespace petrous::dissection
{

/// Contact patch of a burr, averaged over the removed volume.
struct ContactPatch
{
  Eigen::Vector3d middle{0.0, 0.0, 0.0}; ///< unit, from the burr's centre, patient axes; zero if
                                         ///< nothing is removed
  double spread = 0.0; ///< mm, mean distance of the patch from the line through centre and middle:
                       ///< 2/3 of the radius of a round patch
  double arm = 0.0;    ///< mm, mean distance of the patch from the spindle axis; 0 without one
};

/// Removal when a burr is advanced a little farther into the tissue.
struct RemovalStep
{
  SweptSphere burr;    ///< at rest there: from = to
  double depth = 0.0;  ///< mm from the place in the direction of advance; may be negative
  double volume = 0.0; ///< mm^3 removed from {f > 0}
  double work = 0.0;   ///< N mm: sum of resistance times volume over all tissues removed
  ContactPatch patch;
  bool capped = false; ///< limited by the maximum depth, with work left over
};

/// Finds how deep a burr advances for a given work, by bracketed search: the depth d at which
///
///   sum_t w_t dV_t(d) = F_t r omega dt        over all tissues t in contact
///
/// [Chan2016, Eq. 6 to 9; several tissues in one step share the work]. dV is the volume lost from
/// {f > 0}, by quadrature of the interpolated fields with 4^3 points per cell; each point is
/// weighted by the solid fraction of its sub-cell, according to the mask's ramp, so that dV is
/// smooth in d (Documentation/adr/0011). The mask values are bit-identical to those that `cut` will
/// write.
///
/// The cut is `kClearance` wider than the burr, like spindle runout: a hole of exactly the burr's
/// size, which the field represents to within one or two hundredths of a voxel, would jam it.
///
/// Each search is warm-started from the previous one. Not thread-safe.
class RemovalDepthSolver
{
public:
  struct Wish
  {
    Eigen::Vector3d place{0.0, 0.0, 0.0};   ///< of the burr's centre, patient mm
    Eigen::Vector3d into{0.0, 0.0, 1.0};    ///< unit, opposite to the force on the tool
    double work = 0.0;                      ///< N mm, > 0
    double deepest = 0.0;                   ///< mm from the place; maximum depth of the step
    Eigen::Vector3d spindle{0.0, 0.0, 0.0}; ///< unit, spindle axis; zero: not requested
  };

  static constexpr double kStep = 0.25;      ///< voxels (minimum spacing), advance per step
  static constexpr double kEnough = 0.9;     ///< minimum fraction of the work that an uncapped step
                                             ///< uses; never more than the work
  static constexpr double kClearance = 0.02; ///< voxels
  static constexpr double kFarthest = 2.2;   ///< radii, maximum retraction of a penetrating burr

  /// tissue  evaluated before any mask; must outlive this, as must `resistance`
  /// keep    structures that are not drilled
  /// radius  of the burr, mm. Throws InvalidParameter if it is not above 0.
  RemovalDepthSolver(const volume::TissueField& tissue, const TissueResistance& resistance,
                     ProtectedTissue keep, double radius);
  ~RemovalDepthSolver();

  /// Returns nullopt if the work is not positive or too little for a quantisation step of the mask,
  /// or if the burr removes too much even when retracted by kFarthest. If no tissue is within reach
  /// or it is protected, returns a capped step of volume 0.
  std::optional<RemovalStep> find(const volume::CutMask& mask, const Wish& wish);

  /// Resistance of the first tissue in the direction of advance, N/mm^2; nullopt if there is none
  /// within two voxels of the burr.
  std::optional<double> ahead(const volume::CutMask& mask, const Eigen::Vector3d& place,
                              const Eigen::Vector3d& into) const;

  /// Depth per unit of work at the last step, mm/(N mm); 0 before the first.
  double yielding() const noexcept;

  /// To be called when the burr has been moved elsewhere: the last step is no longer a valid start.
  void forget() noexcept;

  double radius() const noexcept; ///< mm, of the burr itself

private:
  struct Parts;
  std::unique_ptr<Parts> m_parts;
};

} // namespace petrous::dissection
