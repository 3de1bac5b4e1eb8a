#pragma once

#include <vector>

#include <Eigen/Core>

#include "TubePath.h"
#include "petrous/Core/Progress.h"

namespace petrous::segmentation
{

/// A centre line under refinement; one entry for each vertex.
struct CentreLine
{
  std::vector<Eigen::Vector3d> vertices; ///< about evenly spaced, patient LPS mm
  std::vector<double> halfRadius;        ///< of the half-maximum border, mm
  std::vector<double> contrast;          ///< surroundings against lumen, image units, >= 0
  std::vector<double> lumen;             ///< mean of the lumen, image units
  /// How much of that contrast the wall has at the quarter of the circumference where it is least:
  /// 1 where the surroundings are the same all around, about 0 beside a plate or at an edge.
  std::vector<double> closure;
};

/// Calls `change` with each of the line's lists of numbers.
template <class Change>
void forEachNumber(CentreLine& line, const Change& change)
{
  change(line.halfRadius);
  change(line.contrast);
  change(line.lumen);
  change(line.closure);
}

/// Arc length from the first vertex to each, mm.
std::vector<double> arcLengths(const std::vector<Eigen::Vector3d>& line);

/// The polyline with vertices evenly spaced at most `step` mm apart.
std::vector<Eigen::Vector3d> resampled(const std::vector<Eigen::Vector3d>& line, double step);

/// Moves the line to the centre of the half-maximum borders of its cross-sections.
///
/// halfRadius  expected, of the half-maximum border, mm
/// blur        sigma of the scan's point spread, mm
/// held        positions the line must pass
CentreLine refineLine(const TubeImage& image, const std::vector<Eigen::Vector3d>& path,
                      const TubeModel& model, double halfRadius, double blur, bool isRadiusGiven,
                      const std::vector<Eigen::Vector3d>& held, const core::Progress& progress);

/// Half-maximum radius of the cross-section of a cylinder of radius R, mm, in an image with a
/// Gaussian point spread of standard deviation sigma, between the values on the axis and far away:
///   f(rho) = 1/sigma^2 int_0^R exp(-(rho^2 + t^2) / (2 sigma^2)) I0(rho t / sigma^2) t dt,
///   f(result) = f(0) / 2
double halfMaximumRadius(double radius, double sigma);

/// The radii of the cylinders that have these half-maximum radii; 0 where one is not above that of
/// a line, sigma sqrt(2 ln 2).
std::vector<double> radiiFromHalfMaximum(const std::vector<double>& halfRadii, double sigma);

} // namespace petrous::segmentation
