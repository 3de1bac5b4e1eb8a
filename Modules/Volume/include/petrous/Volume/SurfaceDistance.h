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

/// How far any point is from a structure's surface, near or at the other end of the head.
///
/// The surface is where the trilinear occupancy (SmoothedUnion.h) is 1/2. The cells that it crosses lie
/// in a tree of boxes, so a question looks into those only that may hold something nearer. Where
/// DistanceMap answers on a grid round the structure, this one answers everywhere, in the memory of
/// the occupancy and some ten bytes for each cell of the surface.
///
/// Distances are right to about 0.01 voxel of the occupancy, and to a tenth of one at creases. Beyond
/// the occupancy's grid there is nothing. Immutable; queries are thread-safe.
class SurfaceDistance
{
public:
  /// Throws CancelledError; InvalidParameter without an occupancy.
  explicit SurfaceDistance(std::shared_ptr<const Volume<float>> occupancy,
                           const core::Progress& progress = {});

  /// Signed distance of a patient point (LPS mm), negative within; no more than `most` to either
  /// side where the surface is farther.
  double at(const Eigen::Vector3d& patient, double most) const;

  const core::GridGeometry& geometry() const noexcept { return m_occupancy->geometry(); }
  std::size_t bytes() const noexcept;

private:
  using Cell = std::array<std::uint16_t, 3>; // its lowest corner
  struct Box
  {
    Cell lower;
    Cell upper; // of the highest corner
  };
  struct Search;

  double squareTo(const Box& box, const Eigen::Vector3d& position) const noexcept;
  void visit(Search& search, std::size_t level, std::size_t box) const;
  void look(Search& search, const Cell& cell) const;

  std::shared_ptr<const Volume<float>> m_occupancy;
  std::vector<Cell> m_cells;              // in the order of a curve that fills space
  std::vector<std::vector<Box>> m_levels; // the last one has one box, or none
};

} // namespace petrous::volume
