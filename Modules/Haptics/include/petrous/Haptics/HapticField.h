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

/// A structure that yields under the hand: a spring from its surface on.
struct SoftStructure
{
  std::shared_ptr<const volume::DistanceMap> depth;
  double stiffness = 0.0; ///< N/mm, in [0.001, 100]
};

/// What decides f at a point.
enum class Decider : std::uint8_t
{
  Outside, ///< beyond the hull of the voxel centres
  Ct,
  Solid, ///< a structure's smoothed union
  Mask,
  Hull ///< inside, but nearer to the border of the grid than to any other surface
};

struct FieldSample
{
  double value = volume::TissueField::kAir; ///< f; soft tissue left out where it decides
  Decider decider = Decider::Outside;
  std::uint8_t solid = 0;                   ///< which union, where one decides
  double uncut = volume::TissueField::kAir; ///< f without mask and hull
  double left = volume::TissueField::kAir;  ///< of mask and hull the lower
};

/// Where a field keeps what it makes of the tissue, for the next one of the same.
struct KeptField
{
  std::shared_ptr<core::DerivedStore> store; ///< null: nowhere
  std::string key;                           ///< all that the rigid tissue depends on
};

/// The tissue field of PHYSICS.md ("One field") as a servo tick samples it: the same f as
/// volume::TissueField, with the mask's present state, in voxel coordinates of the CT.
///
/// f has one operand more here, a quarter of the distance to the hull of the voxel
/// centres (in voxels), so that
/// the border of the grid is a surface like others; the sign of f is the same.
///
/// Made once for a tissue field (about a second for 512^3); the queries neither allocate, lock nor
/// throw, and are thread-safe.
class HapticField
{
public:
  /// `tissue` is what is rigid: CT, unions, iso and scale; its mask is not used, `mask` of each
  /// query is. `soft` is what yields, and takes no part in f.
  /// Throws InvalidParameter when the mask does not lie on the CT's grid, or a soft structure has
  /// no map or a stiffness out of its domain.
  HapticField(const volume::TissueField& tissue, std::shared_ptr<const volume::PublishedMask> mask,
              std::vector<SoftStructure> soft = {}, const KeptField& kept = {});

  const core::GridGeometry& geometry() const noexcept { return m_geometry; }
  const volume::PublishedMask& mask() const noexcept { return *m_mask; }
  double voxel() const noexcept { return m_voxel; } ///< h, mm, the smallest spacing
  const std::vector<SoftStructure>& soft() const noexcept { return m_soft; }

  FieldSample sample(const Eigen::Vector3d& voxel, const volume::MaskState& mask) const noexcept;

  /// Mask - 1/2 at a point: 1/2 where nothing was cut, also beyond the grid.
  double left(const Eigen::Vector3d& voxel, const volume::MaskState& mask) const noexcept;

  /// Gradient of the operand that decided, per mm in patient axes, by central differences over
  /// +-`step` voxels: 1 as TissueField::normal has it, less for the interpolated surface itself.
  /// Zero outside.
  Eigen::Vector3d gradient(const Eigen::Vector3d& voxel, const FieldSample& sample,
                           const volume::MaskState& mask, double step = 1.0) const noexcept;

  /// Slope of f at the point along a unit vector of the patient, per mm: over +-`reach` mm.
  double slope(const Eigen::Vector3d& voxel, const Eigen::Vector3d& direction, double reach,
               const volume::MaskState& mask) const noexcept;

  /// Within this many millimetres there is certainly no tissue, whatever the mask; 0 near some.
  double clearance(const Eigen::Vector3d& voxel) const noexcept;

  /// Within this many millimetres there is no tissue while none comes back, by f at the point and
  /// by how steep it is around; 0 in tissue.
  double freeRadius(const Eigen::Vector3d& voxel, const FieldSample& sample) const noexcept;

  /// `uncut` changes by no more than this a millimetre in the cells that a path of half a voxel
  /// round the point can cross; `left` by no more than `leftSteepness` anywhere.
  double steepness(const Eigen::Vector3d& voxel) const noexcept;
  double leftSteepness() const noexcept { return m_leftSteepness; }

  /// Operands of f at the 3^3 voxels of a brick of 2^3 cells, first axis fastest, each of them by
  /// itself: they are interpolated before the greater or lower of them is taken. Beyond the grid's
  /// last voxel all are air; where nothing is cut and the hull is far, it is just above 0.
  struct BrickValues
  {
    static constexpr std::size_t kMaxTissues = 8; ///< of more, the rest are taken at the voxels
    std::array<std::array<float, 27>, kMaxTissues> tissue; ///< CT, then unions above 0 somewhere
    std::size_t tissues = 1;
    bool others = false; ///< unions whose voxels are not the CT's may be here: see unionCell
    std::array<float, 27> mask;
    std::array<float, 27> hull;
  };
  const core::Index3& brickDims() const noexcept { return m_bricks; }
  void brickValues(const core::Index3& brick, const volume::MaskState& mask,
                   BrickValues& values) const noexcept;

  /// Whether nothing was cut near a brick, and the hull is not there: f is its uncut part.
  bool untouched(const core::Index3& brick, const volume::MaskState& mask) const noexcept;

  /// Of mask - 1/2 and hull the lower; below 0 beyond the hull.
  double rest(const Eigen::Vector3d& voxel, const volume::MaskState& mask) const noexcept;

  /// Unions by number, below `unions`. One whose voxels are the CT's is `onGrid`; others have cells
  /// of their own, between the voxels v and v + 1 of theirs, with corners as occupancy - 1/2, first
  /// axis fastest. A union ends at the hull of its voxels, whatever it is there.
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

  /// f of the CT (kCt) or of a union alone, uncut, at a voxel position of the CT.
  static constexpr std::size_t kCt = static_cast<std::size_t>(-1);
  double tissueOf(std::size_t of, const Eigen::Vector3d& voxel) const noexcept;

  /// What `sample` reads, for a thread that may not wait for the disk: CT, unions and what was made
  /// here. The mask's states come and go, and are in no file. Valid as long as the field.
  std::vector<core::LockedMemory::Range> memory() const;

  std::size_t residentBytes() const noexcept; ///< of what was made here, and soft maps

private:
  struct Solid
  {
    volume::TissueField::SolidUnion occupancy;
    Eigen::Matrix3d fromCt; ///< voxel of the union from voxel of the CT: fromCt * v + offset
    Eigen::Vector3d offset;
    Eigen::Vector3d last; ///< greatest voxel coordinate
    bool onGrid = false;  ///< its voxels are voxels of the CT
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
