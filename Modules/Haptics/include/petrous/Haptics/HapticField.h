#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "petrous/Core/DerivedStore.h"
#include "petrous/Core/LockedMemory.h"
#include "petrous/Volume/DistanceMap.h"
#include "petrous/Volume/PublishedMask.h"
#include "petrous/Volume/TissueField.h"

namespace petrous::haptics
{

/// A deformable structure: a spring that acts from its surface inwards.
struct SoftStructure
{
  std::shared_ptr<const volume::DistanceMap> depth;
  double stiffness = 0.0; ///< N/mm, in [0.001, 100]
};

/// Operand that determines f at a point.
enum class Decider : std::uint8_t
{
  Outside, ///< outside the hull of the voxel centres
  Ct,
  Solid, ///< a smoothed union of structures
  Mask,
  Hull ///< inside, but closer to the grid's border than to any other surface
};

struct FieldSample
{
  double value = volume::TissueField::kAir; ///< f, without soft structures
  Decider decider = Decider::Outside;
  std::uint8_t solid = 0;                   ///< index of the union if the decider is Solid
  double uncut = volume::TissueField::kAir; ///< f without mask and hull
  double left = volume::TissueField::kAir;  ///< minimum of mask and hull
};

/// Where a field stores what it derives from the tissue, for reuse by a later field of the same.
struct KeptField
{
  std::shared_ptr<core::DerivedStore> store; ///< null: not stored
  std::string key;                           ///< identifies everything that the rigid tissue
                                             ///< depends on
};

/// The tissue field ("One field" in Documentation/equations.md) as sampled by the servo: the same f
/// as volume::TissueField, with the current mask state, in voxel coordinates of the CT.
///
/// f has one more operand here, a quarter of the distance to the hull of the voxel centres (in
/// voxels), so that the border of the grid is a surface like any other; the sign of f is the same.
///
/// Built once per tissue field (about a second for 512^3). Queries are thread-safe and do not
/// allocate, lock or throw.
class HapticField
{
public:
  /// `tissue` is the rigid tissue: CT, unions, iso and scale; its mask is not used, each query
  /// takes the mask state. `soft` are the deformable structures, which are not part of f. Throws
  /// InvalidParameter if the mask is not on the CT's grid, or a soft structure has no map or its
  /// stiffness is out of range.
  HapticField(const volume::TissueField& tissue, std::shared_ptr<const volume::PublishedMask> mask,
              std::vector<SoftStructure> soft = {}, const KeptField& kept = {});

  const core::GridGeometry& geometry() const noexcept { return m_geometry; }
  const volume::PublishedMask& mask() const noexcept { return *m_mask; }
  double voxel() const noexcept { return m_voxel; } ///< h, mm, the smallest spacing
  const std::vector<SoftStructure>& soft() const noexcept { return m_soft; }

  FieldSample sample(const Eigen::Vector3d& voxel, const volume::MaskState& mask) const noexcept;

  /// Mask - 1/2 at a point: 1/2 where nothing was removed, also outside the grid.
  double left(const Eigen::Vector3d& voxel, const volume::MaskState& mask) const noexcept;

  /// Gradient of the deciding operand, per mm in patient axes, by central differences over +-`step`
  /// voxels: 1 as in TissueField::normal, less for the interpolated surface itself. Zero outside.
  Eigen::Vector3d gradient(const Eigen::Vector3d& voxel, const FieldSample& sample,
                           const volume::MaskState& mask, double step = 1.0) const noexcept;

  /// Slope of f along a unit vector in patient axes, per mm: over +-`reach` mm.
  double slope(const Eigen::Vector3d& voxel, const Eigen::Vector3d& direction, double reach,
               const volume::MaskState& mask) const noexcept;

  /// Distance in mm within which there is no tissue for any mask; 0 near tissue.
  double clearance(const Eigen::Vector3d& voxel) const noexcept;

  /// Distance in mm within which there is no tissue until some is restored, from f at the point and
  /// the local bound on its slope; 0 in tissue.
  double freeRadius(const Eigen::Vector3d& voxel, const FieldSample& sample) const noexcept;

  /// Bound on the slope of `uncut`, per mm, in the cells that a path of half a voxel around the
  /// point can cross; `leftSteepness` bounds that of `left` everywhere.
  double steepness(const Eigen::Vector3d& voxel) const noexcept;
  double leftSteepness() const noexcept { return m_leftSteepness; }

  /// Operands of f at the 3^3 voxels of a brick of 2^3 cells, first axis fastest, each separately:
  /// they are interpolated before the maximum or minimum is taken. Beyond the grid's last voxel all
  /// are air; where nothing is removed and the hull is far, `mask` and `hull` are just above 0.
  struct BrickValues
  {
    static constexpr std::size_t kMaxTissues = 8; ///< further ones are combined at the voxels
    std::array<std::array<float, 27>, kMaxTissues> tissue; ///< CT, then unions above 0 somewhere
    std::size_t tissues = 1;
    bool others = false; ///< unions on other grids than the CT's may be here: see unionCell
    std::array<float, 27> mask;
    std::array<float, 27> hull;
  };
  const core::Index3& brickDims() const noexcept { return m_bricks; }
  void brickValues(const core::Index3& brick, const volume::MaskState& mask,
                   BrickValues& values) const noexcept;

  /// BrickValues::mask alone; returns false where the brick is `untouched`.
  bool maskValues(const core::Index3& brick, const volume::MaskState& mask,
                  std::array<float, 27>& values) const noexcept;

  /// Whether nothing was removed near a brick and the hull is far: f equals `uncut` there.
  bool untouched(const core::Index3& brick, const volume::MaskState& mask) const noexcept;

  /// Minimum of mask - 1/2 and hull; negative outside the hull.
  double rest(const Eigen::Vector3d& voxel, const volume::MaskState& mask) const noexcept;

  /// Unions by index, below `unions`. One whose voxels coincide with the CT's is `onGrid`; others
  /// have cells of their own, between their voxels v and v + 1, with corner values occupancy - 1/2,
  /// first axis fastest. A union ends at the hull of its voxels, whatever its value there.
  std::size_t unions() const noexcept { return m_solids.size(); }
  bool onGrid(std::size_t n) const noexcept { return m_solids[n].onGrid; }
  std::array<float, 8> unionCell(std::size_t n, const core::Index3& cell) const noexcept;
  Eigen::Vector3d unionFromCt(std::size_t n, const Eigen::Vector3d& voxel) const noexcept
  {
    return m_solids[n].fromCt * voxel + m_solids[n].offset;
  }
  const core::GridGeometry& unionGrid(std::size_t n) const noexcept
  {
    return m_solids[n].occupancy->geometry();
  }

  /// f of the CT (kCt) or of a single union, without mask, at a voxel position of the CT.
  static constexpr std::size_t kCt = static_cast<std::size_t>(-1);
  double tissueOf(std::size_t of, const Eigen::Vector3d& voxel) const noexcept;

  /// Memory that `sample` reads, for locking: CT, unions and derived data. Excludes the mask
  /// states, which come and go and are not file-backed. Valid as long as the field.
  std::vector<core::LockedMemory::Range> memory() const;

private:
  struct Solid
  {
    volume::TissueField::SolidUnion occupancy;
    Eigen::Matrix3d fromCt; ///< CT voxel to union voxel: fromCt * v + offset
    Eigen::Vector3d offset;
    Eigen::Vector3d last; ///< largest voxel coordinate
    bool onGrid = false;  ///< its voxels coincide with the CT's
  };

  struct Cell;
  static Cell cellAt(const Eigen::Vector3d& voxel, const core::Index3& dims) noexcept;
  double ct(const Cell& cell) const noexcept;
  double solid(std::size_t n, const Eigen::Vector3d& voxel) const noexcept;
  double left(const Cell& cell, const volume::MaskState& mask) const noexcept;
  double hull(const Eigen::Vector3d& voxel) const noexcept;
  double operand(const FieldSample& sample, const Eigen::Vector3d& voxel,
                 const volume::MaskState& mask) const noexcept;
  std::size_t brickAt(const Eigen::Vector3d& voxel) const noexcept;

  std::shared_ptr<const volume::IntensityVolume> m_ct;
  std::vector<Solid> m_solids;
  std::shared_ptr<const volume::PublishedMask> m_mask;
  std::vector<SoftStructure> m_soft;
  core::GridGeometry m_geometry;
  volume::TissueField::Parameters m_parameters;
  double m_voxel = 1.0;
  Eigen::Vector3d m_last;
  core::Index3 m_bricks;                 ///< of 2 voxels
  std::vector<std::uint8_t> m_distance;  ///< see TissueBricks
  std::vector<std::uint8_t> m_steepness; ///< codes
  double m_leftSteepness = 0.0;
};

} // namespace petrous::haptics
