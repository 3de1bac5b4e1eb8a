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
  std::vector<double> residuals; ///< mm, of each pair: how far its CT point lands from its MR point
  double rms = 0.0;              ///< mm, of the residuals (fiducial registration error)
};

/// The rigid motion with the least sum of squared residuals (Horn 1987; Umeyama 1991 without
/// scale).
///
/// Throws InvalidParameter for fewer than three pairs, for points that are not finite, and where
/// either image's points lie on one line (within 1 mm), which leaves the turn about it open.
LandmarkFit fitLandmarks(const std::vector<LandmarkPair>& pairs);

} // namespace petrous::registration
