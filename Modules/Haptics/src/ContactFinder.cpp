#include "ContactFinder.h"

#include <algorithm>
#include <cmath>

namespace petrous::haptics
{

namespace
{
constexpr std::size_t kGradient = 6; // samples
constexpr double kFlat = 1e-6;       // of f a voxel: no slope to speak of
constexpr double kAlong = 0.05;      // cosine: a normal along the way that led into tissue
constexpr double kLookAhead = 1.5;   // of the near gap: normals up to 48 degrees apart
constexpr double kClose = 0.002;     // voxels: a gap that needs no better estimate
constexpr double kExplained = 0.02;  // voxels: as deep as a known contact's plane says
constexpr std::size_t kMostRefined = 16;
constexpr std::size_t kMostOnBall = 64; // deepest first; the sweep answers for the others
constexpr double kFarthest = 0.6;       // rad, from a shell point to the ball's contact
constexpr double kAligned = 0.01;       // rad, residual of a found contact
constexpr double kMisaligned = 0.05;    // rad, residual of one that was not found
constexpr int kTurns = 4;
constexpr double kAtHit = 0.1; // voxels: what stopped the tool is the surface as it is, ripples too
constexpr double kDeepest = 0.05; // voxels: of a gap that is given back in one motion
} // namespace

ContactFinder::ContactFinder(const ShellSweep& sweep, double nearGap)
  : m_sweep(sweep)
  , m_nearGap(nearGap * sweep.field().voxel())
  , m_order(sweep.shell().points.size())
  , m_found(sweep.shell().points.size())
{
}

ContactFinder::Surface ContactFinder::surfaceAt(const Eigen::Vector3d& voxel,
                                                const FieldSample& sample,
                                                double step) const noexcept
{
  const HapticField& field = m_sweep.field();
  const double h = field.voxel();
  const double value = sample.value;
  const Eigen::Vector3d gradient = field.gradient(voxel, sample, m_sweep.state(), step);
  m_samples += kGradient;
  const double slope = gradient.norm();
  if (!(slope * h > kFlat))
    return {};
  Surface result{-gradient / slope, -value / slope, slope};
  if (std::abs(result.gap) > kClose * h)
  {
    // One secant step along the normal: the edges of an image are no straight ramps.
    const double ahead = std::clamp(result.gap, -h, h);
    const Eigen::Vector3d there =
        voxel - field.geometry().voxelFromPatientLinear() * (ahead * result.normal);
    ++m_samples;
    const double rise = field.sample(there, m_sweep.state()).value - value;
    const double better = ahead * -value / rise;
    if (better / ahead > 0.0 && better / ahead < 2.0)
    {
      result.gap = better;
      result.slope = rise / ahead;
    }
  }
  return result;
}

// The tissue's surface as seen from the ball's point in direction `toPoint` (unit, patient axes);
// false where the shaft hides that point, or there is nothing to be seen.
bool ContactFinder::surfaceOfBall(const Eigen::Vector3d& toPoint, Surface& surface) const noexcept
{
  const PointShell& shell = m_sweep.shell();
  const Pose& pose = m_sweep.pose();
  if (shell.burrRadius * (pose.rotation.conjugate() * toPoint).z() > shell.burrTop)
    return false;
  const HapticField& field = m_sweep.field();
  const Eigen::Vector3d voxel =
      field.geometry().voxelFromPatient(pose.position + shell.burrRadius * toPoint);
  ++m_samples;
  const FieldSample sample = field.sample(voxel, m_sweep.state());
  if (sample.decider == Decider::Outside)
    return false;
  surface = surfaceAt(voxel, sample);
  return surface.normal.dot(toPoint) < -0.2;
}

void ContactFinder::refineOnBall(ProxyContact& contact, double& slope) const noexcept
{
  const double radius = m_sweep.shell().burrRadius;
  const Eigen::Vector3d start = contact.arm / radius;
  Eigen::Vector3d at = start;
  Surface surface{contact.normal, contact.gap, slope};
  double step = 1.0; // of the residual: 1 where tissue is flat, less where it bulges
  for (int turn = 0; turn < kTurns; ++turn)
  {
    const Eigen::Vector3d residual = -surface.normal - at;
    if (residual.norm() < kAligned)
      break;
    const Eigen::Vector3d next = (at + step * residual).normalized();
    Surface there;
    if ((next - start).norm() > kFarthest || !surfaceOfBall(next, there))
      break;
    // Secant over the residual along this step.
    const Eigen::Vector3d fall = residual - (-there.normal - next);
    const double along = residual.dot(fall);
    const double better = along > 0.0 ? step * residual.squaredNorm() / along : 2.0 * step;
    const bool closer = (-there.normal - next).norm() < residual.norm();
    step = std::clamp(better, 0.1, 3.0);
    if (!closer)
      continue; // once more from where we are, with the step that the secant gives
    at = next;
    surface = there;
  }
  if ((surface.normal + at).norm() > kMisaligned)
    return;
  // The ball against the plane that was found at `at`.
  contact.gap = surface.gap - radius * (1.0 + surface.normal.dot(at));
  contact.normal = surface.normal;
  contact.arm = -radius * surface.normal;
  slope = surface.slope;
}

// One look ahead spares most gradients: no tissue within reach along the tool's own normal.
bool ContactFinder::farFrom(const Eigen::Vector3d& voxel,
                            const Eigen::Vector3d& outward) const noexcept
{
  ++m_samples;
  const HapticField& field = m_sweep.field();
  const Eigen::Vector3d ahead =
      field.geometry().voxelFromPatientLinear() * (kLookAhead * m_nearGap * outward);
  return field.sample(voxel + ahead, m_sweep.state()).value < 0.0;
}

void ContactFinder::add(const ShellSweep::Near& near, bool refine,
                        const ShellSweep::Hit* hit) noexcept
{
  const PointShell& shell = m_sweep.shell();
  const Pose& pose = m_sweep.pose();
  ProxyContact contact;
  contact.point = near.point;
  contact.arm = pose.rotation * shell.points[near.point];
  const Eigen::Vector3d voxel = m_sweep.voxelOf(near.point);
  if (!hit && farFrom(voxel, pose.rotation * shell.normals[near.point]))
    return;
  const Surface surface = surfaceAt(voxel, near.sample, hit ? kAtHit : 1.0);
  contact.normal = surface.normal;
  contact.gap = surface.gap;
  double slope = surface.slope;
  if (surface.normal.isZero())
  {
    // Where the field is flat, the tool's own surface says which way is out of what stopped it.
    if (!hit)
      return;
    contact.normal = -(pose.rotation * shell.normals[near.point]);
  }
  if (hit)
  {
    contact.gap = std::min(contact.gap, 0.0);
    // It went in, whatever the gradient at a thin edge says.
    if (contact.normal.dot(hit->direction) > kAlong)
      contact.normal = -hit->direction;
  }
  else if (contact.gap > m_nearGap)
    return;
  else if (refine)
    refineOnBall(contact, slope);
  contact.gap = std::max(contact.gap, -kDeepest * m_sweep.field().voxel());
  m_found[m_count++] = {contact, slope, hit != nullptr};
}

bool ContactFinder::explained(const ShellSweep::Near& near) const noexcept
{
  const double h = m_sweep.field().voxel();
  const Eigen::Vector3d arm = m_sweep.pose().rotation * m_sweep.shell().points[near.point];
  for (std::size_t n = 0; n < std::min(m_count, kMostRefined); ++n)
  {
    const FoundContact& known = m_found[n];
    const double byPlane = known.contact.gap + known.contact.normal.dot(arm - known.contact.arm);
    if (byPlane <= -near.sample.value / known.slope + kExplained * h)
      return true;
  }
  return false;
}

void ContactFinder::find(const ShellSweep::Hit* hits, std::size_t hitCount) noexcept
{
  const PointShell& shell = m_sweep.shell();
  const auto hitOf = [&](std::uint32_t point) -> const ShellSweep::Hit*
  {
    for (std::size_t n = 0; n < hitCount; ++n)
      if (hits[n].point == point)
        return &hits[n];
    return nullptr;
  };
  m_count = 0;
  m_samples = 0;
  const ShellSweep::Near* near = m_sweep.begin();
  std::size_t ball = 0;
  for (std::uint32_t n = 0; n < m_sweep.nearCount(); ++n)
    if (near[n].point < shell.burrCount && shell.burrRadius > 0.0)
      m_order[ball++] = n;
  std::sort(m_order.begin(), m_order.begin() + static_cast<std::ptrdiff_t>(ball),
            [near](std::uint32_t a, std::uint32_t b)
            { return near[a].sample.value > near[b].sample.value; });
  for (std::size_t n = 0; n < ball && m_count < kMostOnBall; ++n)
    if (!explained(near[m_order[n]]))
      add(near[m_order[n]], m_count < kMostRefined, nullptr);
  for (std::size_t n = 0; n < m_sweep.nearCount(); ++n)
  {
    const ShellSweep::Hit* hit = hitOf(near[n].point);
    if (hit || near[n].point >= shell.burrCount || !(shell.burrRadius > 0.0))
      add(near[n], false, hit);
  }
}

} // namespace petrous::haptics
