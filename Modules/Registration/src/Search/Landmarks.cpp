#include "petrous/Registration/Landmarks.h"

#include <cmath>
#include <string>

#include <Eigen/SVD>

#include "petrous/Core/Error.h"

namespace petrous::registration
{

namespace
{

constexpr double kOffLine = 1.0; // mm; less counts as collinear

// RMS distance of the columns from their best-fitting line.
double offLine(const Eigen::Matrix3Xd& points)
{
  const Eigen::Matrix3Xd centred = points.colwise() - points.rowwise().mean();
  const Eigen::Vector3d singular = Eigen::JacobiSVD<Eigen::Matrix3Xd>(centred).singularValues();
  return std::hypot(singular[1], singular[2]) / std::sqrt(static_cast<double>(points.cols()));
}

} // namespace

LandmarkFit fitLandmarks(const std::vector<LandmarkPair>& pairs)
{
  if (pairs.size() < 3)
    throw core::InvalidParameter("landmarks: " + std::to_string(pairs.size()) +
                                 (pairs.size() == 1 ? " pair" : " pairs") +
                                 "; a rigid fit needs three");
  const auto count = static_cast<Eigen::Index>(pairs.size());
  Eigen::Matrix3Xd ct(3, count);
  Eigen::Matrix3Xd mr(3, count);
  for (Eigen::Index n = 0; n < count; ++n)
  {
    const LandmarkPair& pair = pairs[static_cast<std::size_t>(n)];
    if (!pair.ct.allFinite() || !pair.mr.allFinite())
      throw core::InvalidParameter("landmarks: pair " + std::to_string(n + 1) +
                                   " has a coordinate that is not a number");
    ct.col(n) = pair.ct;
    mr.col(n) = pair.mr;
  }
  if (offLine(ct) < kOffLine || offLine(mr) < kOffLine)
    throw core::InvalidParameter("landmarks: the points lie on one line within 1 mm; add one that "
                                 "does not");
  LandmarkFit fit;
  fit.mrFromCt = core::RigidTransform::fromMatrix(Eigen::umeyama(ct, mr, false));
  double sum = 0.0;
  for (const LandmarkPair& pair : pairs)
  {
    fit.residuals.push_back((fit.mrFromCt * pair.ct - pair.mr).norm());
    sum += fit.residuals.back() * fit.residuals.back();
  }
  fit.rms = std::sqrt(sum / static_cast<double>(pairs.size()));
  return fit;
}

} // namespace petrous::registration
