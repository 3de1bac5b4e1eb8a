#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "petrous/Volume/CutMask.h"
#include "petrous/Volume/IntensityVolume.h"
#include "petrous/Volume/LabelMap.h"

namespace petrous::volume
{

/// The one field shared by renderer, haptics and drill (Documentation/equations.md, "One field"):
///
///   f(x) = min(max(c_CT(x), c_L(x)), m(x)),  solid where f > 0
///
///   c_CT = (HU - iso) / scale     scale in HU; it sets the unit of f, not the surface
///   c_L  = smoothed union - 0.5   over the solid, touchable structures
///   m    = mask - 0.5             1 untouched, 0 removed
///
/// The operands are interpolated trilinearly before they are combined; the normal is the gradient
/// of the operand that decides. Outside the hull of the CT's voxel centres f is air.
///
/// Holds references to shared voxels; the mask is read in its current state at each call. Queries
/// are const and thread-safe while nobody writes the mask.
class TissueField
{
public:
  struct Parameters
  {
    double iso = 300.0;    ///< HU
    double scale = 1000.0; ///< HU; > 0
  };

  /// Smoothed union of a structure map (see SmoothedUnion.h).
  using SolidUnion = std::shared_ptr<const Volume<float>>;

  /// The mask may be null (nothing cut yet); it must be on the CT's grid. Throws InvalidParameter
  /// if scale is not positive or the grids differ.
  TissueField(std::shared_ptr<const IntensityVolume> ct, std::vector<SolidUnion> solids,
              std::shared_ptr<const CutMask> mask, const Parameters& parameters);

  const core::GridGeometry& geometry() const noexcept { return m_ct->geometry(); }
  const Parameters& parameters() const noexcept { return m_parameters; }
  const std::shared_ptr<const IntensityVolume>& ct() const noexcept { return m_ct; }
  const std::vector<SolidUnion>& solids() const noexcept { return m_solids; }

  /// The minimum spacing of the CT and of the unions, mm: step size for a search that must find a
  /// mesh with walls thinner than a CT voxel.
  double finestSpacing() const noexcept { return m_finest; }

  /// Sets a callback for the regions (patient LPS mm) that will be read next, where unions are
  /// computed on demand (RegionalUnion.h).
  void onPrepare(std::function<void(const std::vector<core::PatientBox>&)> prepare)
  {
    m_prepare = std::move(prepare);
  }

  /// For callers that read few places: to be called before the queries below, all within the box.
  /// The searches do so themselves. Not thread-safe with queries.
  void prepare(const core::PatientBox& box) const
  {
    if (m_prepare)
      m_prepare({box});
  }

  /// The same for several places at once, which is cheaper than one after the other.
  void prepareEach(const std::vector<core::PatientBox>& boxes) const
  {
    if (m_prepare)
      m_prepare(boxes);
  }

  /// f at a patient point (LPS mm); kAir outside the grid.
  double value(const Eigen::Vector3d& patient) const;

  /// f before the mask: max(c_CT, c_L).
  double uncut(const Eigen::Vector3d& patient) const;

  /// Unit vector towards decreasing f (out of the tissue), patient axes; zero where the field is
  /// flat or outside the grid. Central differences over +-`step` voxels.
  Eigen::Vector3d normal(const Eigen::Vector3d& patient, double step = 1.0) const;

  /// Normal over +-1 voxel, by edgeGradientInPatient where the CT decides: slower, and without the
  /// shading steps due to slices.
  Eigen::Vector3d smoothNormal(const Eigen::Vector3d& patient) const;

  /// First point on the segment from `start` to `end` where f rises above 0, in mm from start;
  /// nullopt if there is none. Steps of at most half the finest spacing, then bisection to 1e-4 of
  /// it. Zero if the start is in tissue.
  std::optional<double> firstHit(const Eigen::Vector3d& start, const Eigen::Vector3d& end) const;

  static constexpr double kAir = -1.0;

private:
  enum class Operand
  {
    None,
    Ct,
    Labels,
    Mask
  };
  struct Decision
  {
    double value = kAir;
    Operand operand = Operand::None;
    std::size_t solid = 0;
  };
  Decision decide(const Eigen::Vector3d& patient) const;
  Eigen::Vector3d normalOf(const Decision& decision, const Eigen::Vector3d& patient, double step,
                           bool smooth) const;
  double ctOperand(const Eigen::Vector3d& voxel) const;
  double solidOperand(std::size_t solid, const Eigen::Vector3d& patient) const;

  std::shared_ptr<const IntensityVolume> m_ct;
  std::vector<SolidUnion> m_solids;
  std::shared_ptr<const CutMask> m_mask;
  Parameters m_parameters;
  double m_finest = 0.0;
  std::function<void(const std::vector<core::PatientBox>&)> m_prepare;
};

} // namespace petrous::volume
