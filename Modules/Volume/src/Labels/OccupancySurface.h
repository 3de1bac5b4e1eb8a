#pragma once

#include <array>
#include <vector>

#include "petrous/Core/Progress.h"
#include "petrous/Volume/Volume.h"

namespace petrous::volume
{

/// The 1/2 level of a trilinear occupancy. Positions are mm along the axes of the occupancy's grid,
/// (0, 0, 0) its first voxel's centre.
class OccupancySurface
{
public:
  explicit OccupancySurface(const Volume<float>& occupancy);

  struct Sample
  {
    double value;             ///< occupancy - 1/2, clamped to the hull beyond the grid
    Eigen::Vector3d gradient; ///< per mm, of the cell
  };
  Sample at(const Eigen::Vector3d& position) const noexcept;

  /// Cells (by their lowest corner) with corners on both sides. The last axis is slowest.
  std::vector<core::Index3> crossedCells(const core::Progress& progress) const;

  static constexpr int kMaxParts = 3;

  struct Crossing
  {
    Eigen::Vector3d point;
    Eigen::Index axis; // axis of the line
    bool shared;       // the line is on an upper face, and belongs to the next cell
  };

  /// Calls `visit(const Crossing&)` with the intersections of the surface with the lines of a finer
  /// lattice in the cell, `parts` per edge (1 to kMaxParts). Occupancies are linear along the axes,
  /// so these points are exact.
  template <class Visit>
  void forEachCrossing(const core::Index3& cell, int parts, const Visit& visit) const;

  /// Points on the surface, several in each crossed cell.
  std::vector<Eigen::Vector3f> points(const core::Progress& progress) const;

  /// Distance to the surface, given a point on it that is nearly the closest.
  double refined(const Eigen::Vector3d& position, const Eigen::Vector3f& near) const noexcept;

private:
  std::array<double, 8> corners(const core::Index3& lower,
                                const core::Index3& upper) const noexcept;

  const Volume<float>& m_occupancy;
  Eigen::Vector3d m_spacing;
  Eigen::Vector3d m_last; // voxel coordinate
};

template <class Visit>
void OccupancySurface::forEachCrossing(const core::Index3& cell, int parts,
                                       const Visit& visit) const
{
  const std::array<double, 8> c = corners(cell, {cell[0] + 1, cell[1] + 1, cell[2] + 1});
  constexpr int most = kMaxParts + 1;
  std::array<double, most * most * most> lattice{};
  const auto value = [&](int i, int j, int k) -> double&
  { return lattice[static_cast<std::size_t>(i + most * (j + most * k))]; };
  const double part = 1.0 / parts;
  // interpolateCell at a lattice: the ends of each row once.
  const auto mix = [](double a, double b, double w) { return a + (b - a) * w; };
  for (int k = 0; k <= parts; ++k)
    for (int j = 0; j <= parts; ++j)
    {
      const double y = part * j;
      const double z = part * k;
      const double first = mix(mix(c[0], c[2], y), mix(c[4], c[6], y), z) - 0.5;
      const double last = mix(mix(c[1], c[3], y), mix(c[5], c[7], y), z) - 0.5;
      for (int i = 0; i <= parts; ++i)
        value(i, j, k) = mix(first, last, part * i);
    }
  const Eigen::Vector3d corner(cell[0], cell[1], cell[2]);
  for (int k = 0; k <= parts; ++k)
    for (int j = 0; j <= parts; ++j)
      for (int i = 0; i <= parts; ++i)
      {
        const double here = value(i, j, k);
        const core::Index3 at{i, j, k};
        for (std::size_t a = 0; a < 3; ++a)
        {
          if (at[a] == parts)
            continue;
          const double there = value(i + int{a == 0}, j + int{a == 1}, k + int{a == 2});
          if ((here > 0.0) == (there > 0.0))
            continue;
          const auto axis = static_cast<Eigen::Index>(a);
          Eigen::Vector3d point(i, j, k);
          point[axis] += here / (here - there);
          const bool shared = at[(a + 1) % 3] == parts || at[(a + 2) % 3] == parts;
          visit(Crossing{(corner + part * point).cwiseProduct(m_spacing), axis, shared});
        }
      }
}

} // namespace petrous::volume
