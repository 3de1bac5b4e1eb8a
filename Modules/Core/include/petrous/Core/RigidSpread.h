#pragma once

#include <vector>

#include <Eigen/Core>

#include "petrous/Core/PatientBox.h"
#include "petrous/Core/RigidTransform.h"

namespace petrous::core
{

/// How far a rigid transform X_BA may be off: second moments about zero of the small motion
/// X_BA^-1 X'_BA of frame A, where X' is a transform that is as likely. For errors without bias it
/// is the covariance of the six parameters.
struct RigidSpread
{
  using Moments = Eigen::Matrix<double, 6, 6>;

  Eigen::Vector3d about = Eigen::Vector3d::Zero(); ///< mm, in A: the point whose translation counts
  /// Of the translation of `about` (mm) and the rotation vector (rad), in the axes of A; symmetric.
  Moments moments = Moments::Zero();
};

bool operator==(const RigidSpread& a, const RigidSpread& b) noexcept;

/// Of the repeats X'_BA about `transform` X_BA. Zero without repeats.
RigidSpread spreadOf(const RigidTransform& transform, const std::vector<RigidTransform>& repeats,
                     const Eigen::Vector3d& about);

/// The same spread about another point.
RigidSpread takenAbout(const RigidSpread& spread, const Eigen::Vector3d& about);

/// Spread of X_CB X_BA, in frame A about the point of the first, from the independent spreads of
/// `second` X_CB and of `first` X_BA.
RigidSpread chained(const RigidSpread& second, const RigidSpread& first,
                    const RigidTransform& bFromA);

/// mm^2: second moments of the displacement of a point of A, J M J^T with J = [1, -[p - about]x]:
/// rotation acts with the lever from `about`. Linearized: a rotation by w rad at a lever of l mm
/// displaces the point by w^2 l / 2 mm beside that.
Eigen::Matrix3d displacementMoments(const RigidSpread& spread, const Eigen::Vector3d& point);

/// Quantiles of the standard normal distribution.
constexpr double kNormalMedian = 0.0;
constexpr double kNormal95 = 1.6449;
constexpr double kNormal999 = 3.0902;

/// Quantile of the length of a normally distributed displacement of these second moments (mm^2):
/// the squared length is approximated by a scaled chi-square distribution of the same mean and
/// variance (Satterthwaite 1946), and that by Wilson and Hilferty (1931), accurate to 1 % from one
/// degree of freedom, a displacement along a line, to three, an isotropic one (2.80 deviations
/// along each axis for 95 %).
double lengthQuantile(const Eigen::Matrix3d& moments, double normalQuantile);

/// Greatest 95th percentile of the displacement's length, mm, over the corners of a box in A. The
/// mean square of the displacement is a convex function of the point, so that a corner has the
/// greatest.
double largestP95(const RigidSpread& spread, const PatientBox& box);

} // namespace petrous::core
