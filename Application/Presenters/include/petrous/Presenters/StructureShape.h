#pragma once

#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "petrous/Core/Progress.h"
#include "petrous/Volume/SurfaceDistance.h"
#include "petrous/Volume/Volume.h"

namespace petrous::presenters
{

// Dimensions of a structure by its surface, the 1/2 level of the trilinear occupancy
// (scene::StructureOccupancy). Points in patient LPS mm.

/// Where the edges between voxel centres cross the surface.
std::vector<Eigen::Vector3d> surfacePoints(const volume::Volume<float>& occupancy);

/// The box around a structure along its principal axes of inertia.
struct PrincipalBox
{
  Eigen::Vector3d center = Eigen::Vector3d::Zero();   ///< of mass
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity(); ///< columns, the longest extent first
  Eigen::Vector3d extents = Eigen::Vector3d::Zero();  ///< mm, of the surface along each axis
};
/// None if no voxel is inside.
std::optional<PrincipalBox> principalBox(const volume::Volume<float>& occupancy);

/// Centre line of a tube: a nerve, a canal, a vessel.
struct CentreLine
{
  std::vector<Eigen::Vector3d> points; ///< from one end of the structure to the other
  std::vector<double> diameters; ///< mm, at each point: of the circle with the cross-section's area
  double length() const;         ///< mm
};

/// The line through the centroids of the cross-sections perpendicular to itself; at its ends it is
/// straight up to the surface. It begins as the centroids of what is equally far, inside the
/// structure, from one of the two points that are farthest from each other; of a structure that
/// branches along the way between them. Of several pieces, of the largest. None, and `why` in
/// words, if the structure is no tube: shorter than 1.5 times its median diameter, or than 4
/// voxels; closed to a ring, or with a hole from side to side; or if the line would leave it.
std::optional<CentreLine> centreLine(const volume::Volume<float>& occupancy,
                                     const core::Progress& progress = {},
                                     std::string* why = nullptr);

/// Between the places of the line nearest to two points, from the first to the second.
std::vector<Eigen::Vector3d> partOf(const CentreLine& line, const Eigen::Vector3d& from,
                                    const Eigen::Vector3d& to);

/// mm, of the point nearest to the line.
double distanceTo(const CentreLine& line, const Eigen::Vector3d& patient);

/// The shortest way between two structures' surfaces.
struct ShortestWay
{
  double distance = 0.0; ///< mm; 0 if they touch or overlap
  Eigen::Vector3d from = Eigen::Vector3d::Zero();
  Eigen::Vector3d to = Eigen::Vector3d::Zero();
};
/// From one of surfacePoints(from), so that it is too long by up to about a third of a voxel where
/// that surface is curved. None if `from` has no surface.
std::optional<ShortestWay> shortestWay(const volume::Volume<float>& from,
                                       const volume::SurfaceDistance& to,
                                       const core::Progress& progress = {});
/// From a point.
ShortestWay shortestWay(const Eigen::Vector3d& from, const volume::SurfaceDistance& to);

} // namespace petrous::presenters
