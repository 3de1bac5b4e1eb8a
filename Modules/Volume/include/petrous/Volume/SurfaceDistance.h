#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "petrous/Core/Progress.h"
#include "petrous/Volume/Volume.h"

namespace petrous::volume
{

/// Distance of any point, near or far, from a structure's surface.
///
/// The surface is the 1/2 level of the trilinear occupancy (SmoothedUnion.h). The cells that it
/// crosses are stored in a tree of boxes, so a query visits only those that may contain a nearer
/// point. While DistanceMap covers a grid around the structure, this class covers all space, in the
/// memory of the occupancy and about ten bytes per surface cell.
///
/// Distances are accurate to about 0.01 voxel of the occupancy, and to a tenth of one at creases.
/// There is no surface beyond the occupancy's grid. Immutable; queries are thread-safe.
class SurfaceDistance
{
public:
  /// Throws CancelledError; InvalidParameter if the occupancy is null.
  explicit SurfaceDistance(std::shared_ptr<const Volume<float>> occupancy,
                           const core::Progress& progress = {});

  /// Signed distance of a patient point (LPS mm), negative inside; clamped to `most` in magnitude
  /// where the surface is farther.
  double at(const Eigen::Vector3d& patient, double most) const;

  /// At most what `at` gives, and at most a cell's diagonal less; a fraction of its cost, as no
  /// cell is looked into. Inside 0 or less.
  double bound(const Eigen::Vector3d& patient, double most) const;

  const core::GridGeometry& geometry() const noexcept { return m_occupancy->geometry(); }
  std::size_t bytes() const noexcept;

private:
  using Cell = std::array<std::uint16_t, 3>; // lowest corner
  struct Box
  {
    Cell lower;
    Cell upper; // highest corner
  };
  struct Search;

  bool isInside(const Eigen::Vector3d& voxel, const Eigen::Vector3d& position) const;
  double squareTo(const Box& box, const Eigen::Vector3d& position) const noexcept;
  template <class Look>
  void visit(Search& search, std::size_t level, std::size_t box, const Look& look) const;
  void look(Search& search, const Cell& cell) const;

  std::shared_ptr<const Volume<float>> m_occupancy;
  std::vector<Cell> m_cells;              // in the order of a space-filling curve
  std::vector<std::vector<Box>> m_levels; // the last one has one box, or none
};

} // namespace petrous::volume
