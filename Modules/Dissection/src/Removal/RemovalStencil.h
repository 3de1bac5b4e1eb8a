#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "BurrCoverage.h"
#include "CellTissue.h"
#include "QuadratureSums.h"
#include "petrous/Dissection/RemovalDepthSolver.h"

namespace petrous::dissection
{

/// Where a burr removes tissue: directions from its centre, weighted by the removed amount.
class PatchSums
{
public:
  void clear()
  {
    m_places.clear();
    m_sum.setZero();
    m_all = 0.0;
  }

  /// offset  from the burr's centre, not zero
  /// weight  may be slightly negative due to rounding
  void add(const Eigen::Vector3d& offset, double weight)
  {
    const Eigen::Vector3d direction = offset.normalized();
    m_places.push_back({direction, weight});
    m_sum += weight * direction;
    m_all += weight;
  }

  /// Axes as those of the offsets; spindle: unit, or zero. Zero if nothing is removed.
  ContactPatch patch(double radius, const Eigen::Vector3d& spindle) const
  {
    ContactPatch patch;
    const double length = m_sum.norm();
    if (!(m_all > 0.0) || !(length > 0.0))
      return patch;
    patch.middle = m_sum / length;
    patch.spread = meanDistance(radius, patch.middle);
    if (!spindle.isZero(0.0))
      patch.arm = meanDistance(radius, spindle);
    return patch;
  }

private:
  // Mean distance of the directions, on the sphere, from the line through its centre along `axis`.
  double meanDistance(double radius, const Eigen::Vector3d& axis) const
  {
    double moment = 0.0;
    for (const Place& place : m_places)
    {
      const double along = place.direction.dot(axis);
      moment += place.weight * std::sqrt(std::max(0.0, 1.0 - along * along));
    }
    return radius * std::clamp(moment / m_all, 0.0, 1.0);
  }

  struct Place
  {
    Eigen::Vector3d direction;
    double weight;
  };
  std::vector<Place> m_places;
  Eigen::Vector3d m_sum{0.0, 0.0, 0.0};
  double m_all = 0.0;
};

/// Contiguous copy of the voxels and cells around a burr that a step may change, which the depth
/// search evaluates repeatedly.
class RemovalStencil
{
public:
  RemovalStencil(const volume::TissueField& tissue, const TissueResistance& resistance,
                 ProtectedTissue keep);

  /// Collects what the burr may change on its path. False if there is nothing.
  bool gather(const volume::CutMask& mask, const SweptSphere& way);

  /// Work in N mm of the burr at rest at `place`, which lies on the collected path.
  double work(const Eigen::Vector3d& place, double radius);

  struct Taken
  {
    double work = 0.0;   ///< N mm
    double volume = 0.0; ///< mm^3
    ContactPatch patch;
  };

  /// Work, volume and contact patch of the accepted step; the results are cached.
  /// spindle  patient axes, unit, or zero: see ContactPatch::arm
  Taken taken(const Eigen::Vector3d& place, double radius, const Eigen::Vector3d& spindle);

  double partVolume() const noexcept { return m_sums.partVolume(); } ///< mm^3 of a sub-cell

private:
  struct Cell
  {
    std::uint32_t corner; // lowest corner, in the window
    CellContent* content;
    QuadratureSums::Sums before; // for m_now
    QuadratureSums::Sums after;  // for m_after
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
  std::vector<std::uint16_t> m_after; // after the step
  std::vector<std::uint8_t> m_marked; // cells that contain an affected voxel
  std::vector<std::uint16_t> m_row;
  // Voxels that may change.
  std::vector<std::uint32_t> m_voxels; // in the box
  std::vector<double> m_x, m_y, m_z;   // mm along the grid's axes from the first voxel
  std::vector<std::uint16_t> m_least;  // minimum left by protection; empty without protection
  std::vector<std::uint16_t> m_left;
  std::vector<Cell> m_cells;
  std::vector<std::uint32_t> m_bitten; // cells that the accepted step removes from
  PatchSums m_patch;

  // Step for which m_after and the cells' sums are valid.
  bool m_reckoned = false;
  Eigen::Vector3d m_place{0.0, 0.0, 0.0};
  double m_radius = 0.0;
  double m_work = 0.0;
};

} // namespace petrous::dissection
