#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "petrous/Core/TriangleMesh.h"

namespace petrous::haptics
{

/// Ball, shaft and handpiece as solids of revolution about +z of frame T; mm. The ball lies round
/// the origin, the shaft reaches from there to `shaftEnd`, the handpiece from there on.
struct ToolSolid
{
  double burrRadius = 0.0; ///< 0: the tool is its points alone
  double shaftRadius = 0.0;
  double shaftEnd = 0.0;
  double handpieceRadius = 0.0; ///< 0: none
  double handpieceEnd = 0.0;
};

/// A rigid tool as points on its surface, in frame T: origin at the burr's centre, +z along the
/// shaft to the hand; mm. The first `burrCount` points lie on the burr (they can cut).
struct PointShell
{
  std::vector<Eigen::Vector3d> points;
  std::vector<Eigen::Vector3d> normals; ///< unit, outward
  std::size_t burrCount = 0;
  double burrSpacing = 0.0; ///< mm, as `spacing`, of the burr alone; 0 where there is none
  double burrRadius = 0.0;  ///< mm, of the ball round the origin; 0 where the tool has none
  double burrTop = 0.0;     ///< mm along +z, from where on the shaft hides the ball
  double spacing = 0.0;     ///< mm, largest distance of a surface point to its nearest shell point,
                            ///< at most 1 % too large
  double reach = 0.0;       ///< mm, largest distance of a shell point from the origin
  ToolSolid solid;          ///< what the points lie on, where that is known
};

/// Spherical burr with its shaft and handpiece.
struct BurrShape
{
  double radius = 2.0;           ///< mm, in [0.25, 5]
  double shaftRadius = 0.0;      ///< mm, at most the burr's; 0: 0.6 of the burr's, at most 1.2
  double shaftLength = 30.0;     ///< mm from the burr's centre, in (radius, 300]
  double handpieceRadius = 6.0;  ///< mm, from the shaft's to 50; 0: none
  double handpieceLength = 60.0; ///< mm beyond the shaft, in (0, 300]
};

/// Points on a burr, its shaft and handpiece. On the burr the spacing s obeys the sagitta bound
/// s^2/(6 R) <= 0.02 voxel (PHYSICS oracle), so that the ball that is felt is the ball within a
/// fiftieth of a voxel; shaft and handpiece share what is left of `budget`.
///
/// s is the distance of neighbours in an even triangular lattice, whose holes are s/sqrt(3) from
/// their corners. With c = `burrSpacing` that distance as measured (a chord), a ball on a plane is
/// felt lower than it is, by at most c^2/(2 R) exactly, which is s^2/(6 R) for the ideal lattice;
/// never higher, as the points lie on the ball. That measured height is what is held to the bound.
///
/// No point lies on the part of the sphere that the shaft hides; a ring of burr points marks its
/// rim. The far end of the handpiece (of the shaft, without one) is open: it is in the hand.
///
/// voxel   mm, smallest spacing of the field, in [0.01, 10]
/// budget  most points in all, in [200, 20000]
///
/// Throws InvalidParameter naming the value that is out of its domain. When the budget is too
/// small for the bound, the burr gets what it can (at least 3/5 of it) and `burrSpacing` says so.
PointShell makeBurrShell(const BurrShape& shape, double voxel, std::size_t budget = 2000);

/// Points spread evenly over a closed surface, tool frame, mm, first those on sharp corners and
/// edges. A side of a thin blade has points of its own. Normals are those of the triangles, at
/// corners and edges their mean, outward also where the mesh is inside out. `name` is for messages.
/// budget as above; `burrCount` is 0. The same mesh gives the same points.
///
/// Throws InvalidParameter "NAME: ..." when the mesh is empty, not closed, has a triangle without
/// area only, an index out of range or a vertex that is not finite.
PointShell makeMeshShell(const core::TriangleMesh& mesh, const std::string& name,
                         std::size_t budget = 2000);

} // namespace petrous::haptics
