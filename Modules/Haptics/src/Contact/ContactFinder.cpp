#include "ContactFinder.h"

#include <algorithm>
#include <cmath>

#include "SurfaceSamples.h"

namespace petrous::haptics
{

namespace
{
constexpr std::size_t kGradient = 6; // samples
constexpr double kFlat = 1e-6;       // of f per voxel: below this the slope is meaningless
constexpr double kAlong = 0.05;      // cosine: normal almost along the motion that led into tissue
constexpr double kLookAhead = 1.5;   // times the near gap: normals up to 48 degrees apart
constexpr double kClose = 0.002;     // voxels: a gap that needs no better estimate
constexpr double kExplained = 0.02;  // voxels: tolerance to the plane of a known contact
constexpr std::size_t kMaxRefined = 16;
constexpr std::size_t kMaxOnBall = 64; // deepest first; the sweep covers the others
constexpr double kFarthest = 0.6;      // rad, from a shell point to the ball's contact
constexpr double kAligned = 0.01;      // rad, residual of a found contact
constexpr double kMisaligned = 0.05;   // rad, maximum residual accepted
constexpr int kTurns = 4;
constexpr double kAtHit = 0.1;    // voxels: what stopped the tool is the actual surface, ripples
                                  // included
constexpr double kDeepest = 0.05; // voxels: largest penetration recovered in one motion
constexpr std::size_t kMaxOnSolid = 128;   // near ones, in addition to those that stopped a motion
constexpr std::size_t kMaxLooked = 1024;   // samples, nearest first; the sweep has all
constexpr std::size_t kLooksInASample = 2; // field samples, at known contacts
constexpr std::size_t kMaxSmooth = 24;     // whose tissue normal is examined
constexpr double kStretch = 1.0;           // voxels between two contacts of a line contact
constexpr double kOnBall = 0.1;            // voxels: tolerance of a sample to the ball's contacts
constexpr double kSmooth = 0.9;            // cosine between the normals of tissue and tool
constexpr double kSameGap = 0.1; // voxels: the surface is smooth if its normal leads to it
} // namespace

ContactFinder::ContactFinder(const ShellSweep& sweep, double nearGap)
  : m_sweep(sweep)
  , m_nearGap(nearGap * sweep.field().voxel())
  , m_order(sweep.shell().points.size())
  , m_found(sweep.shell().points.size() + kMaxOnSolid + kMaxHits)
  , m_next(m_found.size())
  , m_candidates(sweep.surface().any() ? SolidParts::kParts * SurfaceSamples::kMaxSamples : 0)
{
  const PointShell& shell = sweep.shell();
  const auto first = std::find_if(
      shell.points.begin() + static_cast<std::ptrdiff_t>(shell.burrCount), shell.points.end(),
      [&](const Eigen::Vector3d& p) { return p.z() >= shell.solid.shaftEnd - 1e-9; });
  m_firstOnHandpiece = static_cast<std::uint32_t>(first - shell.points.begin());
  for (std::uint32_t part = 1; part < SolidParts::kParts; ++part)
  {
    const SolidParts::Cylinder& c = sweep.surface().parts().cylinder(part);
    m_stretches[part - 1] =
        std::clamp((c.to - c.from) / (kStretch * sweep.field().voxel()), 1.0, kBins - 1.0);
  }
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
    // One secant step along the normal: edges in an image are not linear ramps.
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
// false if the shaft hides that point or no surface is found.
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
  double step = 1.0; // of the residual: 1 for flat tissue, less for convex tissue
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
      continue; // retry from the same point with the secant's step
    at = next;
    surface = there;
  }
  if ((surface.normal + at).norm() > kMisaligned)
    return;
  // The ball against the plane found at `at`.
  contact.gap = surface.gap - radius * (1.0 + surface.normal.dot(at));
  contact.normal = surface.normal;
  contact.arm = -radius * surface.normal;
  slope = surface.slope;
}

// One probe ahead saves most gradients: no tissue within reach along the tool's own normal.
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
    // If the field is flat, the tool's own surface gives the outward direction at a stop.
    if (!hit)
      return;
    contact.normal = -(pose.rotation * shell.normals[near.point]);
  }
  if (hit)
  {
    contact.gap = std::min(contact.gap, 0.0);
    // The motion went in, whatever the gradient at a thin edge suggests.
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

// The tool's part against a point of the tissue's surface.
FoundContact ContactFinder::contactAt(std::uint32_t part,
                                      const Eigen::Vector3d& place) const noexcept
{
  const PointShell& shell = m_sweep.shell();
  const Pose& pose = m_sweep.pose();
  const Eigen::Vector3d at = pose.rotation.conjugate() * (place - pose.position);
  const SolidParts::Nearest nearest = m_sweep.surface().parts().nearest(part, at);
  FoundContact found;
  found.contact.normal = -(pose.rotation * nearest.outward);
  found.contact.gap = nearest.distance;
  found.contact.arm = pose.rotation * (at - nearest.distance * nearest.outward);
  found.contact.point =
      part == SolidParts::kBall
          ? 0
          : (part == 1 ? static_cast<std::uint32_t>(shell.burrCount) : m_firstOnHandpiece);
  return found;
}

// One bin for the ball; for each cylinder, segments along its axis no shorter than kStretch.
std::size_t ContactFinder::binOf(std::uint32_t part, double z) const noexcept
{
  if (part == SolidParts::kBall)
    return 0;
  const SolidParts::Cylinder& c = m_sweep.surface().parts().cylinder(part);
  const double bin = std::clamp((z - c.from) / (c.to - c.from), 0.0, 1.0) * m_stretches[part - 1];
  return 1 + (part - 1) * kBins + static_cast<std::size_t>(bin);
}

// Whether the plane of a known contact nearby on the same part already limits the tool as much.
bool ContactFinder::explained(std::uint32_t part, double z,
                              const FoundContact& candidate) const noexcept
{
  const double h = m_sweep.field().voxel();
  const double slack = h * (part == SolidParts::kBall ? kOnBall : kExplained);
  const std::size_t bin = binOf(part, z);
  const std::size_t first = part == SolidParts::kBall ? 0 : bin - 1;
  const std::size_t last = part == SolidParts::kBall ? 0 : std::min(bin + 1, m_bins.size() - 1);
  for (std::size_t b = first; b <= last; ++b)
    for (std::uint32_t n = m_bins[b]; n > 0; n = m_next[n - 1])
    {
      const ProxyContact& known = m_found[n - 1].contact;
      const Eigen::Vector3d way = candidate.contact.arm - known.arm;
      if (part != SolidParts::kBall && way.squaredNorm() > kStretch * kStretch * h * h)
        continue;
      if (known.gap + known.normal.dot(way) <= candidate.contact.gap + slack)
        return true;
    }
  return false;
}

// Where the tissue's surface is smooth, its own normal is better than the tool's at a sample, which
// is up to half a line spacing away from the actual contact.
void ContactFinder::smooth(std::uint32_t part, const Eigen::Vector3d& place,
                           FoundContact& found) const noexcept
{
  const HapticField& field = m_sweep.field();
  const Pose& pose = m_sweep.pose();
  const SolidParts& parts = m_sweep.surface().parts();
  const Eigen::Vector3d at = pose.rotation.conjugate() * (place - pose.position);
  const SolidParts::Nearest nearest = parts.nearest(part, at);
  const double same = kSameGap * field.voxel();
  if (part == SolidParts::kBall)
  {
    const Eigen::Vector3d toPoint = -found.contact.normal;
    Surface there;
    if (!surfaceOfBall(toPoint, there) || there.normal.dot(found.contact.normal) < kSmooth)
      return;
    ProxyContact refined = found.contact;
    refined.normal = there.normal;
    refined.gap = there.gap;
    double slope = there.slope;
    refineOnBall(refined, slope);
    if (!(std::abs(refined.gap - found.contact.gap) < same))
      return;
    refined.gap = std::min(refined.gap, found.contact.gap);
    found.contact = refined;
    found.slope = slope;
    return;
  }
  if (!nearest.onSide)
    return;
  const Eigen::Vector3d voxel = field.geometry().voxelFromPatient(place);
  const FieldSample sample = field.sample(voxel, m_sweep.state());
  const Eigen::Vector3d gradient = field.gradient(voxel, sample, m_sweep.state());
  m_samples += kGradient + 2;
  const double slope = gradient.norm();
  if (!(slope * field.voxel() > kFlat))
    return;
  const Eigen::Vector3d axis = pose.rotation * Eigen::Vector3d::UnitZ();
  Eigen::Vector3d normal = -gradient / slope;
  normal -= axis.dot(normal) * axis;
  const double across = normal.norm();
  if (!(across > kSmooth))
    return;
  normal /= across;
  if (!(normal.dot(found.contact.normal) > kSmooth))
    return;
  const Eigen::Vector3d arm = at.z() * axis - parts.radius(part) * normal;
  const double byPlane = normal.dot(pose.position + arm - place);
  const double value =
      field.sample(field.geometry().voxelFromPatient(pose.position + arm), m_sweep.state()).value;
  const double gap = -value / slope;
  if (!(std::abs(gap - byPlane) < same))
    return;
  found.contact.normal = normal;
  found.contact.arm = arm;
  found.contact.gap = std::clamp(gap, found.contact.gap - same, found.contact.gap);
  found.slope = slope;
}

void ContactFinder::addSurface(const ShellSweep::Hit* hits, std::size_t hitCount) noexcept
{
  const SurfaceSamples& surface = m_sweep.surface();
  const Pose& pose = m_sweep.pose();
  const double deepest = -kDeepest * m_sweep.field().voxel();
  const Eigen::Matrix3d toTool = pose.rotation.toRotationMatrix().transpose();
  const Eigen::Vector3d axis = toTool.row(2);
  const auto alongTool = [&axis](const FoundContact& found) { return axis.dot(found.contact.arm); };
  m_bins.fill(0);
  const auto enter = [&](std::uint32_t part, std::size_t n)
  {
    std::uint32_t& bin = m_bins[binOf(part, alongTool(m_found[n]))];
    m_next[n] = bin;
    bin = static_cast<std::uint32_t>(n + 1);
  };
  for (std::size_t n = 0; n < m_count; ++n)
    enter(SolidParts::kBall, n);
  const auto take = [&](std::uint32_t part, FoundContact found)
  {
    found.contact.gap = std::max(found.contact.gap, deepest);
    m_found[m_count] = found;
    enter(part, m_count++);
  };
  for (std::size_t n = 0; n < std::min(hitCount, kMaxHits); ++n)
  {
    if (hits[n].point != ShellSweep::kNoPoint)
      continue;
    FoundContact found = contactAt(hits[n].part, hits[n].place);
    if (found.contact.gap > m_nearGap)
      continue;
    // The surface's own normal first; what stopped the tool twice is an edge hidden by that normal.
    const bool again =
        std::any_of(hits, hits + n,
                    [&](const ShellSweep::Hit& other) {
                      return other.point == ShellSweep::kNoPoint && other.place == hits[n].place;
                    });
    if (!again)
      smooth(hits[n].part, hits[n].place, found);
    found.contact.gap = std::min(found.contact.gap, 0.0);
    found.stopped = true;
    take(hits[n].part, found);
  }
  std::size_t count = 0;
  std::size_t looked = 0;
  for (std::uint32_t part = 0; part < SolidParts::kParts; ++part)
  {
    const std::size_t within = surface.within(part, m_nearGap);
    looked += within;
    for (std::size_t n = 0; n < within; ++n)
    {
      const double gap =
          surface.parts().distance(part, toTool * (surface.place(part, n) - pose.position));
      if (gap <= m_nearGap)
        m_candidates[count++] = {gap, part, static_cast<std::uint32_t>(n)};
    }
  }
  m_samples += looked / SurfaceSamples::kUnit;
  // Nearest first; ties by number.
  const auto after = [](const Candidate& a, const Candidate& b)
  {
    return a.gap != b.gap     ? a.gap > b.gap
           : a.part != b.part ? a.part > b.part
                              : a.number > b.number;
  };
  const auto begin = m_candidates.begin();
  auto end = begin + static_cast<std::ptrdiff_t>(count);
  std::make_heap(begin, end, after);
  std::size_t added = 0;
  looked = 0;
  for (; end != begin && added < kMaxOnSolid && looked < kMaxLooked; ++looked)
  {
    std::pop_heap(begin, end, after);
    const std::size_t n = static_cast<std::size_t>(--end - begin);
    const std::uint32_t part = m_candidates[n].part;
    const Eigen::Vector3d& place = surface.place(part, m_candidates[n].number);
    FoundContact found = contactAt(part, place);
    if (explained(part, alongTool(found), found))
      continue;
    if (added < kMaxSmooth)
      smooth(part, place, found);
    if (part == SolidParts::kBall && explained(part, 0.0, found))
      continue;
    take(part, found);
    ++added;
  }
  m_samples += looked / kLooksInASample;
}

bool ContactFinder::explained(const ShellSweep::Near& near) const noexcept
{
  const double h = m_sweep.field().voxel();
  const Eigen::Vector3d arm = m_sweep.pose().rotation * m_sweep.shell().points[near.point];
  for (std::size_t n = 0; n < std::min(m_count, kMaxRefined); ++n)
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
  for (std::size_t n = 0; n < ball && m_count < kMaxOnBall; ++n)
    if (!explained(near[m_order[n]]))
      add(near[m_order[n]], m_count < kMaxRefined, nullptr);
  const bool solid = m_sweep.surface().any();
  if (solid)
    addSurface(hits, hitCount);
  for (std::size_t n = 0; n < m_sweep.nearCount(); ++n)
  {
    const ShellSweep::Hit* hit = hitOf(near[n].point);
    if (!hit && solid)
      continue;
    if (hit || near[n].point >= shell.burrCount || !(shell.burrRadius > 0.0))
      add(near[n], false, hit);
  }
}

} // namespace petrous::haptics
