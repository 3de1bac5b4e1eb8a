#pragma once

#include <memory>
#include <optional>

#include "petrous/Dissection/SweptSphereCut.h"
#include "petrous/Dissection/TissueResistance.h"
#include "petrous/Volume/TissueField.h"

namespace petrous::dissection
{

/// The part of a burr that takes tissue, in the mean over the volume taken.
struct ContactPatch
{
  Eigen::Vector3d middle{0.0, 0.0, 0.0}; ///< unit, from the burr's centre, patient axes; zero where
                                         ///< nothing is taken
  double spread = 0.0; ///< mm, mean distance of the patch from the line through centre and middle:
                       ///< 2/3 of the radius of a round patch
  double arm = 0.0;    ///< mm, mean distance of the patch from the spindle's axis; 0 where none was
                       ///< given
};

/// What a burr takes when it is set down a little further in the tissue.
struct RemovalStep
{
  SweptSphere burr;    ///< at rest there: from = to
  double depth = 0.0;  ///< mm from the place, along the way in; below 0 where it lies before it
  double volume = 0.0; ///< mm^3 lost from {f > 0}
  double work = 0.0;   ///< N mm that they take: sum of resistance times volume over all tissues
  ContactPatch patch;
  bool capped = false; ///< it was not allowed deeper, though there is work left
};

/// Finds how deep a burr goes for a given work, by bracketed search: the depth d at which
///
///   sum_t w_t dV_t(d) = F_t r omega dt        over the tissues t that it meets
///
/// [Chan2016, Eq. 6 to 9; several tissues in one bite share the work]. dV is what {f > 0} loses, by
/// quadrature of the interpolated fields with 4^3 points a cell; each point counts by the share of
/// its part of the cell that is solid, as the mask's ramp says it, so that dV rises smoothly with d
/// (Documentation/adr/0011). The mask is reckoned with as `cut` will write it, to the last bit.
///
/// The cut is made `kClearance` wider than the burr, as a spindle's runout makes it: a hole of just
/// the burr's size, which the field holds to a hundredth of a voxel or two, would jam it.
///
/// Each search remembers the last one, so that the next starts near its result. One thread.
class RemovalDepthSolver
{
public:
  struct Wish
  {
    Eigen::Vector3d place{0.0, 0.0, 0.0};   ///< of the burr's centre, patient mm
    Eigen::Vector3d into{0.0, 0.0, 1.0};    ///< unit, against the force on the tool
    double work = 0.0;                      ///< N mm, > 0
    double deepest = 0.0;                   ///< mm from the place; no bite goes beyond
    Eigen::Vector3d spindle{0.0, 0.0, 0.0}; ///< unit, the spindle's axis; zero: not asked for
  };

  static constexpr double kStep = 0.25;      ///< voxels (smallest spacing) that one bite may go on
  static constexpr double kEnough = 0.9;     ///< share of the work that a bite which is not capped
                                             ///< takes at least; never more than the work
  static constexpr double kClearance = 0.02; ///< voxels
  static constexpr double kFarthest = 2.2;   ///< radii that a sunken burr is drawn back at most

  /// tissue  is asked for f before any mask; must outlive this, as `resistance` must
  /// keep    structures that are not drilled
  /// radius  of the burr, mm. Throws InvalidParameter when it is not above 0.
  RemovalDepthSolver(const volume::TissueField& tissue, const TissueResistance& resistance,
             ProtectedTissue keep, double radius);
  ~RemovalDepthSolver();

  /// Nothing where no bite takes anything: there is no tissue within reach, it is protected, or the
  /// work is too little for a step of the mask.
  std::optional<RemovalStep> find(const volume::CutMask& mask, const Wish& wish);

  /// Resistance of the first tissue along the way in, N/mm^2; nothing where there is none within
  /// two voxels of the burr.
  std::optional<double> ahead(const volume::CutMask& mask, const Eigen::Vector3d& place,
                              const Eigen::Vector3d& into) const;

  /// Depth for a unit of work at the last bite, mm/(N mm); 0 before there was one.
  double yielding() const noexcept;

  /// The burr is somewhere else: the last bite says nothing about the next.
  void forget() noexcept;

  double radius() const noexcept; ///< mm, of the burr itself

private:
  struct Parts;
  std::unique_ptr<Parts> m_parts;
};

} // namespace petrous::dissection
