#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include <Eigen/Core>

#include "petrous/Core/TriangleMesh.h"

namespace petrous::haptics
{

/// Ball, shaft and handpiece as solids of revolution about +z of frame T; mm. The ball is centred
/// at the origin, the shaft extends from there to `shaftEnd`, the handpiece onwards from there.
struct ToolSolid
{
  double burrRadius = 0.0; ///< 0: the tool consists of its points only
  double shaftRadius = 0.0;
  double shaftEnd = 0.0;
  double handpieceRadius = 0.0; ///< 0: none
  double handpieceEnd = 0.0;
};

/// A rigid tool as points on its surface, in frame T: origin at the burr's centre, +z along the
/// shaft to the hand; mm. The first `burrCount` points are on the burr (they can cut). An
/// instrument's origin is its tip, and all of its points count: thrust is what any of them bears.
struct PointShell
{
  std::vector<Eigen::Vector3d> points;
  std::vector<Eigen::Vector3d> normals; ///< unit, outward
  std::size_t burrCount = 0;
  double burrSpacing = 0.0; ///< mm, as `spacing`, of the burr only, or of what of an instrument is
                            ///< within kInstrumentTip of its tip
  double burrRadius = 0.0;  ///< mm, of the ball about the origin; 0 without one
  double burrTop = 0.0;     ///< mm along +z, above which the shaft hides the ball
  double spacing = 0.0;     ///< mm, largest distance of a surface point to its nearest shell point,
                            ///< overestimated by at most 1 %
  double reach = 0.0;       ///< mm, largest distance of a shell point from the origin
  ToolSolid solid;          ///< the surface that the points sample, if known
};

/// Spherical burr with shaft and handpiece.
struct BurrShape
{
  double radius = 2.0;           ///< mm, in [0.25, 5]
  double shaftRadius = 0.0;      ///< mm, at most the burr's; 0: 0.6 of the burr's, at most 1.2
  double shaftLength = 30.0;     ///< mm from the burr's centre, in [1.01 radius, 300]
  double handpieceRadius = 6.0;  ///< mm, from the shaft's to 50; 0: none
  double handpieceLength = 60.0; ///< mm beyond the shaft, in [0.1, 300]

  /// mm, with the default in place of 0.
  double resolvedShaftRadius() const noexcept
  {
    return shaftRadius > 0.0 ? shaftRadius : std::min(0.6 * radius, 1.2);
  }
};

/// Samples a burr, its shaft and handpiece. On the burr the spacing s satisfies the sagitta bound
/// s^2/(6 R) <= 0.02 voxel (Documentation/equations.md), so that the rendered ball is correct to a
/// fiftieth of a voxel; shaft and handpiece share the rest of `budget`.
///
/// s is the distance of neighbours in a regular triangular lattice, whose holes are s/sqrt(3) from
/// their corners. With c = `burrSpacing`, that distance as measured (a chord), a ball on a plane is
/// felt lower than it is, by at most c^2/(2 R) exactly, which is s^2/(6 R) for the ideal lattice;
/// never higher, as the points are on the ball. The bound applies to that measured height.
///
/// No point is on the part of the sphere that the shaft hides; a ring of burr points marks its rim.
/// The far end of the handpiece (of the shaft, without one) is open: it is in the hand.
///
/// voxel   mm, smallest spacing of the field, in [0.01, 10]
/// budget  maximum total number of points, in [200, 20000]
///
/// Throws InvalidParameter naming the value out of range. If the budget is too small for the bound,
/// the burr gets what is available (at least 3/5 of it) and `burrSpacing` gives the result.
PointShell makeBurrShell(const BurrShape& shape, double voxel, std::size_t budget = 2000);

/// mm from an instrument's tip, its working end: `burrSpacing` is of the surface within.
constexpr double kInstrumentTip = 10.0;

/// Samples the surface of an instrument, in frame T. The first point is the surface's nearest to
/// the origin, the tip; each further one is, of some 50,000 places on the surface and of its
/// vertices, the farthest from those before (farthest-point sampling), in units of a spacing that
/// grows linearly with the distance r from the tip, s (1 + r / 5 mm), up to 10 s; once every place
/// has a point within that spacing for s = 0.1 mm, in mm. That ends when `budget` is used up or
/// every place has a point within 0.1 mm. So points are dense at the tip, whatever the triangles,
/// and sharp ends have one.
///
/// `spacing` is a distance between points, no bound on what they miss. With c the spacing at a
/// place, bone that is flat or rounded is met there by up to c^2 / 2R late, for a surface of radius
/// R; a straight cone of bone of half angle a on a flat side by up to c / tan(a); bone thinner than
/// 2 c may pass between the points unfelt.
///
/// surface  closed; may consist of several shells, with triangles of any orientation; mm
/// budget   maximum number of points, in [200, 20000]
///
/// Throws InvalidParameter for a mesh without triangles, with vertices that do not exist or are not
/// finite, or for a budget out of range.
PointShell makeInstrumentShell(const core::TriangleMesh& surface, std::size_t budget = 2000);

} // namespace petrous::haptics
