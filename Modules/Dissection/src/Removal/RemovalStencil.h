#pragma once

#include <array>
#include <vector>

#include "QuadratureSums.h"
#include "BurrCoverage.h"
#include "CellTissue.h"
#include "PatchSums.h"

namespace petrous::dissection
{

/// The voxels and cells round a burr that a bite may change, laid side by side: what is reckoned
/// again and again while the depth is searched.
class RemovalStencil
{
public:
  RemovalStencil(const volume::TissueField& tissue, const TissueResistance& resistance,
             ProtectedTissue keep);

  /// Gathers what the burr may change on its way. False when it is nothing.
  bool gather(const volume::CutMask& mask, const SweptSphere& way);

  /// N mm that the burr takes at rest at `place`, which lies on the way that was gathered.
  double work(const Eigen::Vector3d& place, double radius);

  struct Taken
  {
    double work = 0.0;   ///< N mm
    double volume = 0.0; ///< mm^3
    ContactPatch patch;
  };

  /// The same and more, of the bite that is made: what was reckoned of it is kept.
  /// spindle  patient axes, unit, or zero: see ContactPatch::arm
  Taken taken(const Eigen::Vector3d& place, double radius, const Eigen::Vector3d& spindle);

  double partVolume() const noexcept { return m_sums.partVolume(); } ///< mm^3 of a counted point

private:
  struct Cell
  {
    std::uint32_t corner; // in the window, the lowest one
    CellContent* content;
    QuadratureSums::Sums before; // as the mask is now
    QuadratureSums::Sums after;  // as m_after is
  };
  void load(const volume::CutMask& mask, const core::IndexBox& box);
  void gatherRow(const BurrCoverage& burr, int first, int j, int k, int count);
  void gatherRun(const BurrCoverage& burr, int first, int j, int k, int count, std::size_t start);
  void gatherCells();
  void addCell(int x, int y, int z, std::uint32_t corner);
  using Corners = std::array<std::uint16_t, 8>;
  Corners cornersOf(const std::vector<std::uint16_t>& values, std::uint32_t corner) const noexcept;
  void lower(const Eigen::Vector3d& place, double radius);
  void addToPatch(const Cell& cell, const Eigen::Vector3d& place, bool fine);

  const core::GridGeometry m_grid;
  ProtectedTissue m_keep;
  CellTissue m_tissue;
  QuadratureSums m_sums;

  core::IndexBox m_box;
  core::Index3 m_dims{0, 0, 0};
  std::vector<std::uint16_t> m_now;   // the mask in the box, first axis fastest
  std::vector<std::uint16_t> m_after; // as the bite would leave it
  std::vector<std::uint8_t> m_marked; // cells that a voxel touches
  std::vector<std::uint16_t> m_row;
  // Voxels that may change.
  std::vector<std::uint32_t> m_voxels; // in the box
  std::vector<double> m_x, m_y, m_z;   // mm along the grid's axes from the first voxel
  std::vector<std::uint16_t> m_least;  // that protection leaves; empty without any
  std::vector<std::uint16_t> m_left;
  std::vector<Cell> m_cells;
  std::vector<std::uint32_t> m_bitten; // cells that the bite made takes from
  PatchSums m_patch;

  // What m_after and the cells' sums are of.
  bool m_reckoned = false;
  Eigen::Vector3d m_place{0.0, 0.0, 0.0};
  double m_radius = 0.0;
  double m_work = 0.0;
};

} // namespace petrous::dissection
