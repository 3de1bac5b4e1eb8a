#include "BurrVolume.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

namespace petrous::haptics
{

namespace
{
constexpr double kPi = 3.141592653589793;
constexpr double kGoldenAngle = 2.399963229728653; // pi (3 - sqrt 5)
constexpr double kFlat = 1e-6;                     // of f per voxel: below this the slope is
                                                   // meaningless
constexpr double kUntouched = 0.5;                 // of the mask's operand
constexpr double kLayers = 1.25; // spheres per spacing: least ripple between 1 and 2
constexpr int kBisections = 8;

Eigen::Vector3d onSpiral(std::size_t i, std::size_t count)
{
  const double z = 1.0 - (2.0 * static_cast<double>(i) + 1.0) / static_cast<double>(count);
  const double turn = kGoldenAngle * static_cast<double>(i);
  const double rho = std::sqrt(1.0 - z * z);
  return {rho * std::cos(turn), rho * std::sin(turn), z};
}
} // namespace

BurrVolume::BurrVolume(const HapticField& field, double radius, std::size_t count)
  : m_field(field)
  , m_radius(radius)
{
  const auto wished = static_cast<double>(count);
  const double spacing = std::cbrt(4.0 / 3.0 * kPi / wished); // of the unit ball
  const auto layers = static_cast<std::size_t>(std::lround(kLayers / spacing));
  for (std::size_t n = 0; n < layers; ++n)
  {
    const auto cube = [layers](std::size_t edge)
    { return std::pow(static_cast<double>(edge) / static_cast<double>(layers), 3.0); };
    const double inner = cube(n);
    const double outer = cube(n + 1);
    const auto pairs =
        static_cast<std::size_t>(std::max(1.0, std::round(0.5 * wished * (outer - inner))));
    const double r = radius * std::cbrt(0.5 * (inner + outer));
    const Eigen::Quaterniond turn(
        Eigen::AngleAxisd(1.0 + kGoldenAngle * static_cast<double>(n), onSpiral(n, layers)));
    for (std::size_t i = 0; i < pairs; ++i)
    {
      const Eigen::Vector3d u = turn * onSpiral(i, 2 * pairs);
      for (const double side : {1.0, -1.0})
      {
        m_points.push_back(side * r * u);
        m_outward.push_back(side * u);
        m_offsets.push_back(field.geometry().voxelFromPatientLinear() * m_points.back());
      }
    }
  }
  m_spacing = radius * std::cbrt(4.0 / 3.0 * kPi / static_cast<double>(m_points.size()));
}

// Fraction of the point's volume inside tissue, taking its surface there as a plane.
double BurrVolume::filled(const Eigen::Vector3d& voxel, const FieldSample& sample,
                          const volume::MaskState& mask) const noexcept
{
  const double value = sample.value;
  const double half = 0.5 * m_spacing;
  const double uncutMost = half * m_field.steepness(voxel);
  const double leftMost = std::min(kUntouched, half * m_field.leftSteepness());
  if (sample.left <= -leftMost || (sample.decider == Decider::Outside))
    return 0.0;
  if (value <= -uncutMost && value < sample.left)
    return 0.0;
  if (value >= uncutMost && sample.left >= leftMost)
    return 1.0;
  const double slope = m_field.gradient(voxel, sample, mask).norm();
  if (!(slope * m_field.voxel() > kFlat))
    return value > 0.0 ? 1.0 : 0.0;
  return std::clamp(0.5 + value / (slope * m_spacing), 0.0, 1.0);
}

// Fraction of the path (voxels) up to tissue, from the centre, which is not in rigid tissue, to a
// point that is.
double BurrVolume::firstInside(const Eigen::Vector3d& centre, const Eigen::Vector3d& way,
                               const volume::MaskState& mask) const noexcept
{
  double free = 0.0;
  double inside = 1.0;
  for (int n = 0; n < kBisections; ++n)
  {
    const double middle = 0.5 * (free + inside);
    const bool tissue = m_field.sample(centre + middle * way, mask).value > 0.0;
    (tissue ? inside : free) = middle;
  }
  return inside;
}

BurrVolume::Push BurrVolume::push(const Eigen::Vector3d& centre,
                                  const volume::MaskState& mask) const noexcept
{
  Push result;
  const Eigen::Vector3d voxel = m_field.geometry().voxelFromPatient(centre);
  if (m_field.clearance(voxel) > m_radius + m_spacing)
    return result;
  std::size_t nearest = m_points.size();
  result.looked = m_points.size();
  for (std::size_t i = 0; i < m_points.size(); ++i)
  {
    const Eigen::Vector3d at = voxel + m_offsets[i];
    const FieldSample sample = m_field.sample(at, mask);
    result.sum -= filled(at, sample, mask) * m_outward[i];
    if (sample.value > 0.0 && nearest == m_points.size())
      nearest = i; // inner points come first
  }
  if (nearest == m_points.size())
    return result;
  double distance = m_points[nearest].norm() * firstInside(voxel, m_offsets[nearest], mask);
  // In the direction opposite to the push tissue is closer still, if it is nearly flat over the
  // ball.
  const Eigen::Vector3d ahead =
      m_field.geometry().voxelFromPatientLinear() * (-distance * result.sum.normalized());
  if (m_field.sample(voxel + ahead, mask).value > 0.0)
    distance *= firstInside(voxel, ahead, mask);
  result.depth = m_radius - distance;
  return result;
}

} // namespace petrous::haptics
