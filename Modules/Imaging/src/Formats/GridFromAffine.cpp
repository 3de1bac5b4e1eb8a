#include "GridFromAffine.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <Eigen/LU>
#include <Eigen/SVD>

#include "FileHelpers.h"

namespace petrous::imaging
{

namespace
{
constexpr double kLargestShear = 1e-3;  // dot product of two unit axes
constexpr double kLargestCost = 0.1;    // mm
constexpr double kNotedCost = 1e-3;     // mm
constexpr double kCoarsest = 1e3;       // mm, voxel size
constexpr double kFarthest = 1e5;       // mm; invalid beyond, as in SeriesGeometry.cpp
constexpr double kRoundingShear = 1e-6; // float32 headers; not corrected
constexpr double kDegrees = 180.0 / 3.14159265358979323846;
} // namespace

core::GridGeometry gridFromAffine(const std::filesystem::path& path,
                                  const std::vector<std::uint64_t>& dims,
                                  const Eigen::Matrix3d& linear, const Eigen::Vector3d& origin,
                                  std::vector<std::string>& notes, bool isUnitKnown)
{
  core::Index3 size{};
  for (std::size_t a = 0; a < 3; ++a)
  {
    if (dims[a] < 1 || dims[a] > static_cast<std::uint64_t>(std::numeric_limits<int>::max()))
      fail(FileError::Reason::Unreadable, path,
           "its header gives impossible dimensions, " + dimsText(dims) +
               "; export it again from where it came");
    size[a] = static_cast<int>(dims[a]);
  }
  const Eigen::Vector3d spacing = linear.colwise().norm().transpose();
  if (!linear.allFinite() || !origin.allFinite() || spacing.minCoeff() < 1e-6 ||
      (isUnitKnown && spacing.maxCoeff() > kCoarsest))
    fail(FileError::Reason::NoGeometry, path,
         "its header gives no voxel size or place in the patient that can be true; export it "
         "again with its geometry");
  const Eigen::Vector3d last(size[0] - 1.0, size[1] - 1.0, size[2] - 1.0);
  const double reach = origin.cwiseAbs().maxCoeff() + spacing.cwiseProduct(last).maxCoeff();
  if (isUnitKnown && reach > kFarthest)
    fail(FileError::Reason::NoGeometry, path,
         "its header puts it " + roughText(reach) +
             " mm from the origin of the patient's frame; a place within 100 m is believed, export "
             "it again with its geometry");

  Eigen::Matrix3d axes = linear;
  for (int a = 0; a < 3; ++a)
    axes.col(a) /= spacing[a];
  const double shear =
      (axes.transpose() * axes - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff();
  if (shear > kRoundingShear)
  {
    // The nearest orthogonal axes (orthogonal Procrustes problem, solved by SVD).
    const Eigen::JacobiSVD<Eigen::Matrix3d> svd(axes, Eigen::ComputeFullU | Eigen::ComputeFullV);
    const Eigen::Matrix3d straight = svd.matrixU() * svd.matrixV().transpose();
    const Eigen::Vector3d half =
        0.5 * Eigen::Vector3d(size[0] - 1.0, size[1] - 1.0, size[2] - 1.0).cwiseProduct(spacing);
    double cost = 0.0;
    for (int corner = 0; corner < 4; ++corner)
    {
      const Eigen::Vector3d sign((corner & 1) ? 1.0 : -1.0, (corner & 2) ? 1.0 : -1.0, 1.0);
      cost = std::max(cost, ((axes - straight) * half.cwiseProduct(sign)).norm());
    }
    if (shear > kLargestShear || (isUnitKnown && cost > kLargestCost))
      fail(FileError::Reason::NoGeometry, path,
           "its axes are not perpendicular (off by " +
               roughText(std::asin(std::min(shear, 1.0)) * kDegrees) +
               " degrees): taken as perpendicular, voxels would lie wrong by up to " +
               roughText(cost) + " mm; resample it to perpendicular axes");
    if (cost > kNotedCost)
      notes.push_back(
          "axes off perpendicular were straightened, which moves no voxel by more than " +
          roughText(cost) + " mm");
    const Eigen::Vector3d center = origin + axes * half;
    return {size, spacing, center - straight * half, straight};
  }
  return {size, spacing, origin, axes};
}

LengthUnit namedUnit(std::string name)
{
  name.erase(std::remove(name.begin(), name.end(), '"'), name.end());
  const std::string unit(trimmed(name));
  for (const char* known : {"mm", "millimeter", "millimeters", "millimetre", "millimetres"})
    if (unit == known)
      return {1.0, true};
  for (const auto& [known, scale] :
       {std::pair("um", 1e-3), std::pair("\xc2\xb5m", 1e-3), std::pair("\xce\xbcm", 1e-3),
        std::pair("micron", 1e-3), std::pair("microns", 1e-3), std::pair("micrometer", 1e-3),
        std::pair("micrometers", 1e-3), std::pair("micrometre", 1e-3), std::pair("nm", 1e-6),
        std::pair("cm", 10.0), std::pair("centimeter", 10.0), std::pair("inch", 25.4),
        std::pair("m", 1e3), std::pair("meter", 1e3), std::pair("meters", 1e3),
        std::pair("metre", 1e3)})
    if (unit == known)
      return {scale, true, unit};
  return {1.0, false, {}, !unit.empty()};
}

double longestEdge(const std::vector<std::uint64_t>& dims, const Eigen::Matrix3d& linear)
{
  double longest = 0.0;
  for (std::size_t a = 0; a < 3; ++a)
    longest = std::max(longest, static_cast<double>(dims[a]) *
                                    linear.col(static_cast<Eigen::Index>(a)).norm());
  return longest;
}

bool isPlausibleSize(const std::vector<std::uint64_t>& dims, const Eigen::Matrix3d& linear)
{
  constexpr double kSmallest = 1.0;   // mm, the longest edge
  constexpr double kFinest = 0.01;    // mm; a tiny file of ordinary voxels is a test or a cut-out
  constexpr double kLargest = 1500.0; // mm
  constexpr double kCoarse = 4.5;     // mm; whole bodies are scanned in finer or as coarse voxels
  constexpr double kTallest = 2500.0; // mm, of whatever voxels
  const double longest = longestEdge(dims, linear);
  const auto voxel = linear.colwise().norm();
  return longest <= kTallest && !(longest < kSmallest && voxel.maxCoeff() < kFinest) &&
         !(longest > kLargest && voxel.minCoeff() > kCoarse);
}

} // namespace petrous::imaging
