#pragma once

#include <cstddef>
#include <vector>

#include <Eigen/Core>

namespace petrous::haptics
{

/// Points that cover the unit sphere without a cap around +z as evenly as possible.
struct SphereCover
{
  std::vector<Eigen::Vector3d> points; ///< unit; those on the cap's rim first
  double spacing =
      0.0; ///< largest distance (chord) of a point outside the cap to its nearest point
};

/// Number of points of an even cover with covering radius `spacing`.
std::size_t pointsToCover(double rim, double spacing);

/// rim    radius of the cap's rim, sine of its half angle, in (0, 1]; the cap is the small one
/// total number of points, at least 24
///
/// A ring of fixed points on the rim; the others start on a spherical Fibonacci lattice and move to
/// the centre of their Voronoi cells: first to the centroid, which evens out the density (Lloyd),
/// then to the centre of the smallest circle around the cell, which minimises the holes. Measured:
/// height of the holes 1.13 to 1.2 times that of the ideal triangular lattice, against 1.6 to 1.8
/// for the Fibonacci lattice.
SphereCover coverSphere(double rim, std::size_t count);

} // namespace petrous::haptics
