#include "petrous/Haptics/ShellSweep.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "SurfaceSamples.h"

namespace petrous::haptics
{

namespace
{
// Path segments shorter than this fraction of a voxel are not halved further.
constexpr double kFinest = 1.0 / 16.0;
constexpr std::size_t kLooksInADistance = 4; // skipped samples that cost as much as one distance
constexpr std::size_t kMaxMeetings = SolidParts::kParts * SurfaceSamples::kMaxSamples;
} // namespace

ShellSweep::ShellSweep(std::shared_ptr<const HapticField> field, PointShell shell, double step,
                       int bisections)
  : m_field(std::move(field))
  , m_shell(std::move(shell))
  , m_step(step * m_field->voxel())
  , m_tolerance(std::ldexp(1.0, -bisections))
{
  m_shell.reach = 0.0;
  for (const Eigen::Vector3d& point : m_shell.points)
  {
    m_arm.push_back(point.norm());
    m_shell.reach = std::max(m_shell.reach, m_arm.back());
  }
  m_clearance.assign(m_shell.points.size(), 0.0);
  m_near.resize(m_shell.points.size());
  m_isNear.resize(m_shell.points.size());
  m_wake.resize(m_shell.points.size());
  m_known.resize(m_shell.points.size());
  m_maps[0] = mapOf(m_pose);
  m_surface = std::make_unique<SurfaceSamples>(*m_field, m_shell.solid);
  if (m_surface->any())
    m_meetings.assign(kMaxMeetings, Meeting{});
}

ShellSweep::~ShellSweep() = default;

void ShellSweep::look(const volume::MaskState& state) noexcept
{
  m_state = &state;
  m_samples = 0;
  m_distances = 0;
  m_surface->look(state);
}

std::size_t ShellSweep::samples() const noexcept
{
  return m_samples + m_distances / SurfaceSamples::kUnit;
}

std::size_t ShellSweep::surfaceSamples() const noexcept
{
  return m_surface->samples();
}

ShellSweep::VoxelMap ShellSweep::mapOf(const Pose& pose) const noexcept
{
  const core::GridGeometry& grid = m_field->geometry();
  return {grid.voxelFromPatientLinear() * pose.rotation.toRotationMatrix(),
          grid.voxelFromPatient(pose.position)};
}

void ShellSweep::moveTo(const Pose& pose) noexcept
{
  m_pose = pose;
  m_pose.rotation.normalize();
  m_maps[0] = mapOf(m_pose);
  m_deepest = volume::TissueField::kAir;
  forgetClearances();
}

void ShellSweep::forgetClearances() noexcept
{
  std::fill(m_clearance.begin(), m_clearance.end(), 0.0);
  m_surface->forget();
  m_inside = 0.0;
}

// Examines a point whose known clearance is insufficient.
void ShellSweep::judge(std::size_t point, double way) noexcept
{
  const Eigen::Vector3d voxel = voxelOf(static_cast<std::uint32_t>(point));
  m_clearance[point] = m_field->clearance(voxel);
  if (m_clearance[point] > way)
    return;
  const FieldSample sample = sampleAt(voxel);
  m_clearance[point] = std::max(m_clearance[point], m_field->freeRadius(voxel, sample));
  if (m_clearance[point] > way)
    return;
  m_near[m_nearCount++] = {static_cast<std::uint32_t>(point), sample};
  m_isNear[point] = true;
}

void ShellSweep::findNear(double distance) noexcept
{
  std::fill(m_isNear.begin(), m_isNear.end(), false);
  m_nearCount = 0;
  for (std::size_t i = 0; i < m_clearance.size(); ++i)
    if (!(m_clearance[i] > distance))
      judge(i, distance);
  if (m_surface->any())
    m_surface->find(m_pose, 0.0, 0.0, distance);
}

double ShellSweep::addNear(double linear, double angular) noexcept
{
  for (std::size_t i = 0; i < m_clearance.size(); ++i)
  {
    const double way = linear + angular * m_arm[i];
    if (!(m_clearance[i] > way) && !m_isNear[i])
      judge(i, way);
  }
  return m_surface->any() ? m_surface->find(m_pose, linear, angular, 0.0) : 1.0;
}

bool ShellSweep::freeAt(const Pose& pose) noexcept
{
  const VoxelMap map = mapOf(pose);
  if (!std::all_of(m_shell.points.begin(), m_shell.points.end(),
                   [&](const Eigen::Vector3d& p)
                   { return sampleAt(map.linear * p + map.offset).value <= 0.0; }))
    return false;
  return m_surface->insideAt(pose, kMaxQuery) == 0.0;
}

bool ShellSweep::nearFreeAt(const Pose& pose) noexcept
{
  const VoxelMap map = mapOf(pose);
  m_deepest = volume::TissueField::kAir;
  for (const Near& near : *this)
  {
    deepen(sampleAt(map.linear * m_shell.points[near.point] + map.offset).value, near.point);
    if (m_deepest > 0.0)
      return false;
  }
  return true;
}

bool ShellSweep::measure(std::size_t most) noexcept
{
  m_deepest = volume::TissueField::kAir;
  for (std::uint32_t i = 0; i < m_shell.points.size(); ++i)
    deepen(sampleAt(voxelOf(i)).value, i);
  m_inside = 0.0;
  if (m_deepest > 0.0)
    return false;
  const std::optional<double> inside = m_surface->insideAt(m_pose, most);
  m_inside = inside.value_or(0.0);
  return inside == 0.0;
}

double ShellSweep::penetration() const noexcept
{
  const double ofSolid = std::max(m_inside, m_surface->any() ? m_surface->depth(m_pose) : 0.0);
  if (!(m_deepest > 0.0))
    return ofSolid;
  const Eigen::Vector3d voxel = voxelOf(m_deepestPoint);
  const double slope = m_field->gradient(voxel, m_field->sample(voxel, *m_state), *m_state).norm();
  const double depth = m_deepest / std::max(slope, 1e-9);
  if (m_shell.burrRadius > 0.0)
    return std::max(ofSolid, std::min(depth, std::max(m_shell.burrRadius, m_field->voxel())));
  // The slope is that of the surface no deeper than a voxel.
  return depth <= m_field->voxel() ? std::max(ofSolid, depth)
                                   : std::numeric_limits<double>::quiet_NaN();
}

// Where f rises above 0 on the chord: the fraction of it that is free, 1 if all of it is.
double ShellSweep::firstInside(const Eigen::Vector3d& from, const FieldSample& atFrom,
                               const Eigen::Vector3d& to, const FieldSample& atTo,
                               double limit) const noexcept
{
  struct End
  {
    double at, value, uncut, left;
  };
  struct Stretch
  {
    End begin, end;
  };
  const Eigen::Vector3d way = to - from;
  const double length = (m_field->geometry().patientFromVoxelLinear() * way).norm();
  const double steepness = m_field->steepness(0.5 * (from + to));
  const double finest = kFinest * m_field->voxel();
  const auto endOf = [](double at, const FieldSample& s) -> End {
    return {at, s.value, s.uncut, s.left};
  };
  std::array<Stretch, 40> stack; // one per halving
  std::size_t depth = 0;
  stack[depth++] = {endOf(0.0, atFrom), endOf(1.0, atTo)};
  while (depth > 0)
  {
    const auto [begin, end] = stack[--depth];
    if (begin.at >= limit)
      return 1.0;
    const double part = end.at - begin.at;
    const double run = part * length;
    // Tissue requires both operands to be above 0 somewhere on the segment.
    const bool free = begin.uncut + end.uncut + steepness * run <= 0.0 ||
                      begin.left + end.left + m_field->leftSteepness() * run <= 0.0 ||
                      run <= finest;
    if (end.value <= 0.0 && free)
      continue;
    if (end.value > 0.0 && part <= m_tolerance)
      return begin.at;
    const double at = 0.5 * (begin.at + end.at);
    const End middle = endOf(at, sampleAt(from + at * way));
    if (middle.value <= 0.0)
      stack[depth++] = {middle, end};
    stack[depth++] = {begin, middle};
  }
  return 1.0;
}

double ShellSweep::distanceAt(const Meeting& meeting, const Pose& pose) const noexcept
{
  ++m_distances;
  return m_surface->parts().distance(meeting.part,
                                     pose.rotation.conjugate() * (meeting.place - pose.position));
}

// The surface samples that the motion can bring into the tool. One that is in it already, within
// the tolerance or since the mask changed, may not go deeper.
void ShellSweep::findMeetings(const Motion& motion) noexcept
{
  m_meetingCount = 0;
  if (!m_surface->any())
    return;
  const double linear = motion.linear.norm();
  const double angular = motion.angular.norm();
  const SolidParts& parts = m_surface->parts();
  const Eigen::Matrix3d toTool = m_pose.rotation.toRotationMatrix().transpose();
  for (std::size_t part = 0; part < SolidParts::kParts; ++part)
  {
    if (!parts.has(part))
      continue;
    const std::size_t count =
        m_surface->within(part, linear + angular * (m_surface->arm(part) + linear));
    m_distances += count;
    for (std::size_t n = 0; n < count; ++n)
    {
      const Eigen::Vector3d& place = m_surface->place(part, n);
      const Eigen::Vector3d at = toTool * (place - m_pose.position);
      const double distance = parts.distance(part, at);
      if (distance > linear + angular * (at.norm() + linear))
        continue;
      m_meetings[m_meetingCount++] = {place, std::min(distance, 0.0) - SurfaceSamples::kTolerance,
                                      static_cast<std::uint32_t>(part), 1};
    }
  }
}

std::uint32_t ShellSweep::chordsTo(const Meeting& meeting, double distance, double linear,
                                   double angular) const noexcept
{
  // The place may be beyond the part's reach by as much as its distance from it.
  const double arm = m_surface->parts().reach(meeting.part) + std::max(distance, 0.0);
  const double chords = (distance - meeting.least) / std::max(linear + angular * arm, 1e-12);
  return static_cast<std::uint32_t>(std::clamp(chords, 1.0, double{kMaxSteps}));
}

ShellSweep::Hit ShellSweep::hitOf(const Meeting& meeting, const Pose& pose,
                                  const Motion& motion) const noexcept
{
  Hit hit;
  hit.any = true;
  hit.point = kNoPoint;
  hit.part = meeting.part;
  hit.place = meeting.place;
  hit.direction =
      (motion.linear + motion.angular.cross(meeting.place - pose.position)).normalized();
  return hit;
}

// Tests the samples at the end of chord s.
void ShellSweep::meet(std::uint32_t s, const Motion& motion, double perStep, double& best,
                      Hit& hit) noexcept
{
  const double linear = perStep * motion.linear.norm();
  const double angular = perStep * motion.angular.norm();
  m_distances += m_meetingCount / kLooksInADistance;
  for (std::size_t n = 0; n < m_meetingCount; ++n)
  {
    Meeting& meeting = m_meetings[n];
    if (meeting.next > s)
      continue;
    const double distance = distanceAt(meeting, m_poses[s]);
    if (distance >= meeting.least)
    {
      meeting.next = s + chordsTo(meeting, distance, linear, angular);
      continue;
    }
    auto inside = static_cast<double>(s);
    if (best < inside)
    {
      if (distanceAt(meeting, moved(m_pose, motion, perStep * best)) >= meeting.least)
        continue;
      inside = best;
    }
    double free = static_cast<double>(s - 1);
    while (inside - free > m_tolerance)
    {
      const double middle = 0.5 * (free + inside);
      const bool met = distanceAt(meeting, moved(m_pose, motion, perStep * middle)) < meeting.least;
      (met ? inside : free) = middle;
    }
    best = free;
    hit = hitOf(meeting, m_poses[s], motion);
  }
}

bool ShellSweep::meetingsFreeAt(const Pose& pose) const noexcept
{
  m_deepestMeeting = nullptr;
  for (std::size_t n = 0; n < m_meetingCount && !m_deepestMeeting; ++n)
    if (distanceAt(m_meetings[n], pose) < m_meetings[n].least)
      m_deepestMeeting = &m_meetings[n];
  return !m_deepestMeeting;
}

ShellSweep::Hit ShellSweep::advance(const Motion& motion, std::size_t maxSamples) noexcept
{
  const double way = maxDisplacement(motion, m_shell.reach);
  const double share = std::min(1.0, kMaxSteps * m_step / std::max(way, 1e-12));
  const auto steps = static_cast<std::size_t>(
      std::clamp(std::ceil(share * way / m_step), 1.0, static_cast<double>(kMaxSteps)));
  const double perStep = share / static_cast<double>(steps);
  for (std::size_t s = 1; s <= steps; ++s)
  {
    m_poses[s] = moved(m_pose, motion, perStep * static_cast<double>(s));
    m_maps[s] = mapOf(m_poses[s]);
  }
  m_poses[0] = m_pose;
  m_blocker = {};
  findMeetings({share * motion.linear, share * motion.angular});

  // Chord by chord, so that cost is proportional to the motion made. A point sleeps while it cannot
  // have reached tissue.
  Hit hit;
  auto best = static_cast<double>(steps);
  const double linear = perStep * motion.linear.norm();
  const double angular = perStep * motion.angular.norm();
  const auto sleep = [&](double clearance, double arm)
  {
    const double chords = clearance / std::max(linear + angular * arm, 1e-12);
    return static_cast<std::uint32_t>(std::clamp(chords, 0.0, double{kMaxSteps}));
  };
  for (std::size_t n = 0; n < m_nearCount; ++n)
  {
    m_wake[n] = sleep(m_clearance[m_near[n].point], m_arm[m_near[n].point]);
    m_known[n] = m_wake[n] == 0;
  }
  for (std::uint32_t s = 1; s <= steps && !hit.any; ++s)
  {
    if (s > 1 && samples() >= maxSamples)
    {
      best = static_cast<double>(s - 1);
      break;
    }
    for (std::size_t n = 0; n < m_nearCount; ++n)
    {
      if (m_wake[n] >= s)
        continue;
      Near& near = m_near[n];
      const Eigen::Vector3d& point = m_shell.points[near.point];
      const Eigen::Vector3d from = m_maps[s - 1].linear * point + m_maps[s - 1].offset;
      if (!m_known[n])
        near.sample = sampleAt(from);
      const Eigen::Vector3d to = m_maps[s].linear * point + m_maps[s].offset;
      const FieldSample atTo = sampleAt(to);
      const double limit = std::min(1.0, best - static_cast<double>(s - 1));
      const double inside = firstInside(from, near.sample, to, atTo, limit);
      if (inside < limit)
      {
        best = static_cast<double>(s - 1) + inside;
        hit.any = true;
        hit.point = near.point;
        hit.direction = (m_field->geometry().patientFromVoxelLinear() * (to - from)).normalized();
      }
      near.sample = atTo;
      const std::uint32_t rest = sleep(m_field->freeRadius(to, atTo), m_arm[near.point]);
      m_wake[n] = s + rest;
      m_known[n] = rest == 0;
    }
    meet(s, motion, perStep, best, hit);
  }
  hit.free = perStep * best;
  if (!hit.any)
  {
    // The tool came to rest at the end of a chord.
    m_deepest = volume::TissueField::kAir;
    for (std::size_t n = 0; n < m_nearCount; ++n)
      if (m_known[n])
        deepen(m_near[n].sample.value, m_near[n].point);
  }
  // The field is sampled at the ends of chords: the final pose is tested itself.
  if (hit.any)
  {
    const double before = m_deepest;
    const auto freeThere = [this](const Pose& pose)
    { return nearFreeAt(pose) && meetingsFreeAt(pose); };
    for (int tries = 0; hit.free > 0.0; ++tries)
    {
      const Pose pose = moved(m_pose, motion, hit.free);
      if (freeThere(pose))
        break;
      // A different place blocks the tool, and needs a contact of its own.
      if (m_deepest > 0.0)
      {
        const Eigen::Vector3d arm = pose.rotation * m_shell.points[m_deepestPoint];
        m_blocker.any = true;
        m_blocker.point = m_deepestPoint;
        m_blocker.direction = (motion.linear + motion.angular.cross(arm)).normalized();
      }
      else
        m_blocker = hitOf(*m_deepestMeeting, pose, motion);
      hit.free = tries < 4 ? 0.9 * hit.free : 0.0;
    }
    if (!(hit.free > 0.0))
      m_deepest = before;
  }
  commit(motion, hit.free);
  return hit;
}

void ShellSweep::commit(const Motion& motion, double share) noexcept
{
  if (!(share > 0.0))
    return;
  const double linear = share * motion.linear.norm();
  const double angular = share * motion.angular.norm();
  for (std::size_t i = 0; i < m_clearance.size(); ++i)
    m_clearance[i] -= linear + angular * m_arm[i];
  m_pose = moved(m_pose, motion, share);
  m_surface->moved(m_pose);
  m_inside = 0.0;
  m_maps[0] = mapOf(m_pose);
}

} // namespace petrous::haptics
