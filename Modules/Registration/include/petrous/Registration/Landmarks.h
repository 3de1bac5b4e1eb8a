#pragma once

#include <vector>

#include "petrous/Core/RigidTransform.h"

namespace petrous::registration
{

/// One anatomical point as seen in both images, patient LPS mm.
struct LandmarkPair
{
  Eigen::Vector3d ct;
  Eigen::Vector3d mr;
};

struct LandmarkFit
{
  core::RigidTransform mrFromCt; ///< X_MC
  std::vector<double> residuals; ///< mm, per pair: distance of mapped CT point and MR point
  double rms = 0.0;              ///< mm, of the residuals (fiducial registration error)
};

/// The rigid transform that minimizes the sum of squared residuals (Horn 1987; Umeyama 1991 without
/// scale).
///
/// Throws InvalidParameter for fewer than three pairs, for non-finite points, and if the points of
/// either image are collinear (within 1 mm), which leaves the rotation about the line undetermined.
LandmarkFit fitLandmarks(const std::vector<LandmarkPair>& pairs);

} // namespace petrous::registration
