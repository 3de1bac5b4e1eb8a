#include "petrous/Registration/StillPose.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include <Eigen/Dense>
#include <Eigen/Geometry>

#include "petrous/Core/Error.h"

namespace petrous::registration
{

namespace
{

using core::InvalidParameter;
using Eigen::Index;
using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr double kDegree = 3.14159265358979323846 / 180.0;
constexpr double kLeastAngle = 0.5;
constexpr double kMostAngle = 120.0;
constexpr double kOtherPose = 5.0; // degrees between poses that are not the same

/// Camera axes: x to the right, y down, z into the scene. A point is seen at focal * (x, y) / z
/// from the still's centre.
struct Pinhole
{
  Matrix3d rotation = Matrix3d::Identity(); // camera axes from patient axes
  Vector3d position = Vector3d::Zero();     // patient, mm
  double focal = 1.0;                       // pixels
};

struct Points
{
  Eigen::Matrix3Xd patient;
  Eigen::Matrix2Xd seen; // pixels from the still's centre
};

/// Residuals in pixels, x and y of each landmark; infinite where one is behind the camera.
Eigen::VectorXd residualsOf(const Pinhole& camera, const Points& points)
{
  Eigen::VectorXd residuals(2 * points.patient.cols());
  for (Index n = 0; n < points.patient.cols(); ++n)
  {
    const Vector3d p = camera.rotation * (points.patient.col(n) - camera.position);
    if (p.z() <= 0.0)
      return Eigen::VectorXd::Constant(residuals.size(), std::numeric_limits<double>::infinity());
    residuals.segment<2>(2 * n) = camera.focal / p.z() * p.head<2>() - points.seen.col(n);
  }
  return residuals;
}

Matrix3d crossMatrix(const Vector3d& v)
{
  Matrix3d m;
  m << 0.0, -v.z(), v.y(), v.z(), 0.0, -v.x(), -v.y(), v.x(), 0.0;
  return m;
}

/// Derivatives of the residuals by a rotation of the camera (radians, camera axes, applied last),
/// its position (mm) and the logarithm of its focal length.
Eigen::MatrixXd jacobianOf(const Pinhole& camera, const Points& points, bool withFocal)
{
  Eigen::MatrixXd jacobian(2 * points.patient.cols(), withFocal ? 7 : 6);
  for (Index n = 0; n < points.patient.cols(); ++n)
  {
    const Vector3d p = camera.rotation * (points.patient.col(n) - camera.position);
    Eigen::Matrix<double, 2, 3> projection;
    projection << 1.0, 0.0, -p.x() / p.z(), 0.0, 1.0, -p.y() / p.z();
    projection *= camera.focal / p.z();
    jacobian.block<2, 3>(2 * n, 0) = -projection * crossMatrix(p);
    jacobian.block<2, 3>(2 * n, 3) = -projection * camera.rotation;
    if (withFocal)
      jacobian.block<2, 1>(2 * n, 6) = camera.focal / p.z() * p.head<2>();
  }
  return jacobian;
}

Pinhole moved(const Pinhole& camera, const Eigen::VectorXd& step)
{
  Pinhole next = camera;
  const Vector3d turn = step.head<3>();
  if (turn.norm() > 0.0)
    next.rotation =
        Eigen::AngleAxisd(turn.norm(), turn.normalized()).toRotationMatrix() * camera.rotation;
  next.position += step.segment<3>(3);
  if (step.size() > 6)
    next.focal *= std::exp(std::clamp(step[6], -0.5, 0.5));
  return next;
}

/// Levenberg-Marquardt with the damping scaled by the diagonal.
Pinhole minimized(Pinhole camera, const Points& points, bool withFocal)
{
  double lambda = 1e-3;
  Eigen::VectorXd residuals = residualsOf(camera, points);
  for (int round = 0; round < 200; ++round)
  {
    const Eigen::MatrixXd jacobian = jacobianOf(camera, points, withFocal);
    const Eigen::MatrixXd normal = jacobian.transpose() * jacobian;
    const Eigen::VectorXd gradient = jacobian.transpose() * residuals;
    bool better = false;
    double gain = 0.0;
    while (!better && lambda < 1e12)
    {
      Eigen::MatrixXd damped = normal;
      damped.diagonal() += lambda * (normal.diagonal().array() + 1e-12).matrix();
      const Pinhole next = moved(camera, -damped.ldlt().solve(gradient));
      const Eigen::VectorXd left = residualsOf(next, points);
      better = left.allFinite() && left.squaredNorm() < residuals.squaredNorm();
      lambda *= better ? 0.2 : 5.0;
      if (better)
      {
        gain = residuals.squaredNorm() - left.squaredNorm();
        camera = next;
        residuals = left;
      }
    }
    if (!better || gain <= 1e-14 * residuals.squaredNorm() || residuals.squaredNorm() < 1e-22)
      break;
  }
  // the product of many small rotations is one again
  camera.rotation = Eigen::Quaterniond(camera.rotation).normalized().toRotationMatrix();
  return camera;
}

/// The 24 rotations that carry a cube to itself: no rotation is farther than 63 degrees from one.
std::vector<Matrix3d> cubeRotations()
{
  std::vector<Matrix3d> rotations;
  for (int a = 0; a < 3; ++a)
    for (int b = 0; b < 3; ++b)
      if (b != a)
        for (const double sa : {-1.0, 1.0})
          for (const double sb : {-1.0, 1.0})
          {
            Matrix3d m;
            m.col(0) = sa * Vector3d::Unit(a);
            m.col(1) = sb * Vector3d::Unit(b);
            m.col(2) = m.col(0).cross(m.col(1));
            rotations.push_back(m);
          }
  return rotations;
}

/// Orthogonal iteration: the rotation that brings the points nearest to their lines of sight, with
/// the translation that is best for it, in turn.
Pinhole iterated(const Matrix3d& start, double focal, const Points& points, int rounds)
{
  const Index count = points.patient.cols();
  std::vector<Matrix3d> sights; // projections on the lines of sight
  Matrix3d mean = Matrix3d::Zero();
  for (Index n = 0; n < count; ++n)
  {
    const Vector3d sight(points.seen(0, n), points.seen(1, n), focal);
    sights.emplace_back(sight * sight.transpose() / sight.squaredNorm());
    mean += sights.back() / static_cast<double>(count);
  }
  const Matrix3d solve = (Matrix3d::Identity() - mean).inverse();
  const Vector3d middle = points.patient.rowwise().mean();
  const Eigen::Matrix3Xd centred = points.patient.colwise() - middle;

  Matrix3d rotation = start;
  Vector3d shift;
  const auto translate = [&]
  {
    Vector3d sum = Vector3d::Zero();
    for (Index n = 0; n < count; ++n)
      sum +=
          (sights[static_cast<std::size_t>(n)] - Matrix3d::Identity()) * rotation * centred.col(n);
    shift = solve * sum / static_cast<double>(count);
    if (shift.z() < 0.0) // behind the camera: as far before it
      shift = -shift;
  };
  translate();
  for (int round = 0; round < rounds; ++round)
  {
    Matrix3d product = Matrix3d::Zero();
    Eigen::Matrix3Xd seen(3, count);
    for (Index n = 0; n < count; ++n)
      seen.col(n) = sights[static_cast<std::size_t>(n)] * (rotation * centred.col(n) + shift);
    const Vector3d seenMiddle = seen.rowwise().mean();
    for (Index n = 0; n < count; ++n)
      product += (seen.col(n) - seenMiddle) * centred.col(n).transpose();
    const Eigen::JacobiSVD<Matrix3d> svd(product, Eigen::ComputeFullU | Eigen::ComputeFullV);
    Matrix3d proper = Matrix3d::Identity();
    proper(2, 2) = (svd.matrixU() * svd.matrixV().transpose()).determinant();
    rotation = svd.matrixU() * proper * svd.matrixV().transpose();
    translate();
  }
  return {rotation, middle - rotation.transpose() * shift, focal};
}

double angleBetween(const Matrix3d& a, const Matrix3d& b)
{
  return Eigen::AngleAxisd(a * b.transpose()).angle() / kDegree;
}

Points checked(const std::vector<StillLandmark>& landmarks, const std::array<int, 2>& size,
               const std::optional<double>& viewAngle)
{
  const std::size_t needed = viewAngle ? 4 : 6;
  if (landmarks.size() < needed)
    throw InvalidParameter("still: " + std::to_string(landmarks.size()) + " landmarks; " +
                           (viewAngle ? "four are needed"
                                      : "six are needed to find the angle of "
                                        "view too, four if it is given"));
  if (size[0] < 1 || size[1] < 1)
    throw InvalidParameter("still: it has no pixels");
  if (viewAngle && !(*viewAngle >= kLeastAngle && *viewAngle <= kMostAngle))
    throw InvalidParameter("still: the angle of view must lie within 0.5 to 120 degrees");
  const auto count = static_cast<Index>(landmarks.size());
  Points points{Eigen::Matrix3Xd(3, count), Eigen::Matrix2Xd(2, count)};
  for (Index n = 0; n < count; ++n)
  {
    const StillLandmark& one = landmarks[static_cast<std::size_t>(n)];
    if (!one.patient.allFinite() || !one.still.allFinite())
      throw InvalidParameter("still: landmark " + std::to_string(n + 1) +
                             " has a coordinate that is not a number");
    points.patient.col(n) = one.patient;
    points.seen.col(n) = one.still - 0.5 * Eigen::Vector2d(size[0], size[1]);
  }
  const Eigen::Matrix3Xd centred = points.patient.colwise() - points.patient.rowwise().mean();
  const Vector3d spread = Eigen::JacobiSVD<Eigen::Matrix3Xd>(centred).singularValues() /
                          std::sqrt(static_cast<double>(count));
  if (std::hypot(spread[1], spread[2]) < 1.0)
    throw InvalidParameter("still: the landmarks lie on one line within 1 mm; add one that does "
                           "not");
  return points;
}

/// Of a normal matrix; infinite where it is singular.
Eigen::MatrixXd inverseOf(const Eigen::MatrixXd& normal)
{
  const Eigen::VectorXd scale = normal.diagonal().cwiseMax(1e-300).cwiseSqrt().cwiseInverse();
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> scaled(scale.asDiagonal() * normal *
                                                              scale.asDiagonal());
  if (scaled.eigenvalues()[0] < 1e-11)
    return Eigen::MatrixXd::Constant(normal.rows(), normal.cols(),
                                     std::numeric_limits<double>::infinity());
  return scale.asDiagonal() * scaled.eigenvectors() *
         scaled.eigenvalues().cwiseInverse().asDiagonal() * scaled.eigenvectors().transpose() *
         scale.asDiagonal();
}

/// Poses of least residuals, best first, each another than those before.
std::vector<Pinhole> solve(const Points& points, double height, std::optional<double> viewAngle)
{
  const auto focalOf = [&](double angle) { return 0.5 * height / std::tan(0.5 * angle * kDegree); };
  std::vector<double> focals;
  if (viewAngle)
    focals.push_back(focalOf(*viewAngle));
  else
    for (double angle = 1.0; angle < kMostAngle; angle *= 1.4)
      focals.push_back(focalOf(angle));

  std::vector<Pinhole> starts;
  for (const double focal : focals)
    for (const Matrix3d& rotation : cubeRotations())
    {
      const Pinhole camera = iterated(rotation, focal, points, 25);
      if (residualsOf(camera, points).allFinite())
        starts.push_back(camera);
    }
  const auto error = [&points](const Pinhole& camera)
  { return residualsOf(camera, points).squaredNorm(); };
  const auto byError = [&error](const Pinhole& a, const Pinhole& b) { return error(a) < error(b); };
  std::sort(starts.begin(), starts.end(), byError);

  constexpr std::size_t kRefined = 24;
  std::vector<Pinhole> refined;
  for (const Pinhole& start : starts)
  {
    if (refined.size() == kRefined)
      break;
    const bool new_ = std::none_of(refined.begin(), refined.end(),
                                   [&start](const Pinhole& other)
                                   {
                                     return angleBetween(start.rotation, other.rotation) < 0.5 &&
                                            std::abs(std::log(start.focal / other.focal)) < 0.1;
                                   });
    if (new_)
      refined.push_back(start);
  }
  for (Pinhole& camera : refined)
    camera = minimized(camera, points, !viewAngle);
  std::sort(refined.begin(), refined.end(), byError);
  std::vector<Pinhole> poses;
  for (const Pinhole& camera : refined)
    if (std::none_of(poses.begin(), poses.end(),
                     [&camera](const Pinhole& other)
                     { return angleBetween(camera.rotation, other.rotation) < kOtherPose; }))
      poses.push_back(camera);
  return poses;
}

} // namespace

StillPose poseOfStill(const std::vector<StillLandmark>& landmarks, const std::array<int, 2>& size,
                      std::optional<double> viewAngle)
{
  const Points points = checked(landmarks, size, viewAngle);
  const std::vector<Pinhole> poses = solve(points, size[1], viewAngle);
  if (poses.empty())
    throw InvalidParameter("still: no camera sees the landmarks so; is one of them mistaken for "
                           "another?");
  const Pinhole& best = poses.front();
  const Eigen::VectorXd residuals = residualsOf(best, points);
  const Eigen::MatrixXd jacobian = jacobianOf(best, points, !viewAngle);

  StillPose pose;
  const auto count = static_cast<double>(landmarks.size());
  const double freedom = 2.0 * count - static_cast<double>(jacobian.cols());
  const double variance = std::max(StillPose::kSetting * StillPose::kSetting,
                                   freedom > 0.0 ? residuals.squaredNorm() / freedom : 0.0);
  const Eigen::MatrixXd covariance = variance * inverseOf(jacobian.transpose() * jacobian);
  const double angle = 2.0 * std::atan(0.5 * size[1] / best.focal) / kDegree;
  if (!viewAngle)
  {
    // d angle / d log f = -sin(angle)
    pose.viewAngleSigma = std::sin(angle * kDegree) * std::sqrt(covariance(6, 6)) / kDegree;
    if (!(pose.viewAngleSigma < 0.2 * angle) || angle > kMostAngle)
      throw InvalidParameter("still: the landmarks do not tell the angle of view; give it, or set "
                             "landmarks of more different depth");
  }
  pose.rotationSigma = std::sqrt(covariance.topLeftCorner<3, 3>().trace()) / kDegree;
  pose.positionSigma = std::sqrt(covariance.block<3, 3>(3, 3).trace());

  double depth = 0.0;
  double squares = 0.0;
  for (Index n = 0; n < points.patient.cols(); ++n)
  {
    const double error = residuals.segment<2>(2 * n).norm();
    const double z = (best.rotation * (points.patient.col(n) - best.position)).z();
    pose.residuals.push_back(error);
    squares += error * error * z * z / (best.focal * best.focal);
    depth += z / count;
  }
  pose.rms = std::sqrt(residuals.squaredNorm() / count);
  pose.rmsAtLandmarks = std::sqrt(squares / count);
  pose.camera.position = best.position;
  pose.camera.focalPoint = best.position + depth * best.rotation.row(2).transpose();
  pose.camera.viewUp = -best.rotation.row(1).transpose();
  pose.camera.viewAngle = angle;

  if (poses.size() > 1)
  {
    // as likely as one in a hundred beside the best
    const double worse = residualsOf(poses[1], points).squaredNorm() - residuals.squaredNorm();
    pose.ambiguous = worse < 2.0 * std::log(100.0) * variance;
  }
  return pose;
}

} // namespace petrous::registration
