#include "SoftContacts.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "petrous/Haptics/ShellSweep.h"
#include "petrous/Volume/Sampling.h"

namespace petrous::haptics
{

namespace
{

constexpr double kStep = 0.5;        // voxels of the field: minimum look-ahead of contacts
constexpr double kFastStep = 1.5;    // voxels of the field: its maximum, for fast motion
constexpr double kHandShare = 0.25;  // look-ahead as a fraction of the device's motion per tick
constexpr float kSteepest = 1.05F;   // approximate bound on the slope of a map's depth, per mm
constexpr double kFar = 1.5;         // mm: structures beyond are not examined point by point
constexpr double kMinWay = 1e-12;    // mm
constexpr double kRounding = 1e-5;   // mm, tolerance of bounds
constexpr int kMaxSteps = 8;         // per tick
constexpr double kCreep = 0.02;      // mm per tick beyond the device's motion
constexpr double kAhead = 2.0;       // times the device's motion per tick, allowed for the tool
constexpr double kWhole = 0.4999;    // of the mask's operand: nothing removed here
constexpr double kExplained = 0.02;  // voxels: tolerance to the ball's plane
constexpr double kRidge = 0.5;       // a shorter gradient is near the medial ridge
constexpr double kAligned = 0.005;   // rad, residual of the ball's deepest point
constexpr double kMisaligned = 0.05; // rad, maximum residual accepted
constexpr double kFarthest = 0.6;    // rad, from a shell point to the ball's deepest point
constexpr int kTurns = 6;
constexpr std::size_t kMaxOfOne = 160; // contacts per structure

} // namespace

SoftContacts::SoftContacts(const HapticField& field, const PointShell& shell,
                           const ProxyParameters& coupling, bool turns)
  : m_field(field)
  , m_shell(shell)
  , m_turns(turns)
  , m_stiffness(coupling.stiffness)
  , m_angularStiffness(turns ? coupling.angularStiffness : 0.0)
  , m_lever(std::sqrt(m_angularStiffness / m_stiffness))
  , m_step(kStep * field.voxel())
  , m_ramp(field.geometry().spacing().norm())
{
  m_arm.resize(static_cast<Eigen::Index>(shell.points.size()));
  for (std::size_t i = 0; i < shell.points.size(); ++i)
    m_arm[static_cast<Eigen::Index>(i)] = static_cast<float>(shell.points[i].norm());
  for (const SoftStructure& soft : field.soft())
  {
    Structure structure{soft.depth.get(), 1.0 / std::sqrt(soft.stiffness), {}, 0.0, 0.0, 0.0};
    structure.top = std::numeric_limits<double>::max();
    structure.bound.setConstant(m_arm.size(), std::numeric_limits<float>::max());
    m_structures.push_back(std::move(structure));
  }
  m_looks.resize(shell.points.size() * m_structures.size());
  m_order.reserve(m_structures.size());
  m_near.reserve(m_structures.size());
  m_contacts.reserve((kMaxOfOne + 1) * kMaxSprings);
}

void SoftContacts::begin(const Pose& goal) noexcept
{
  const Motion way = motionBetween(m_goal, goal);
  m_behind = m_spent;
  m_spent = false;
  m_steps = 0;
  const double voxel = m_field.voxel();
  m_step = std::clamp(kHandShare * maxDisplacement(way, m_shell.reach), kStep * voxel,
                      kFastStep * voxel);
  m_left = kAhead * std::hypot(way.linear.norm(), m_lever * way.angular.norm()) + kCreep;
  m_goal = goal;
}

double SoftContacts::fractionOf(const Structure& structure, double linear,
                                double angular) const noexcept
{
  const auto way = static_cast<float>(linear + kMinWay) + static_cast<float>(angular) * m_arm;
  const auto spare = (static_cast<float>(structure.least) - structure.bound).max(0.0F);
  return double{((static_cast<float>(m_step) + spare / kSteepest) / way).minCoeff()};
}

double SoftContacts::share(const Motion& motion) noexcept
{
  const double linear = motion.linear.norm();
  const double angular = motion.angular.norm();
  double share = std::min(1.0, m_away / std::max(maxDisplacement(motion, m_shell.reach), kMinWay));
  // A point with a contact may move by a step. The others may move until they could need one.
  if (share * maxDisplacement(motion, m_shell.reach) > m_step)
    for (const std::size_t n : m_near)
      share = std::min(share, fractionOf(m_structures[n], linear, angular));
  m_spent = ++m_steps >= kMaxSteps;
  const auto inside = [](const Contact& contact) { return contact.depth > 0.0; };
  if (m_pressed || m_behind || std::any_of(m_contacts.begin(), m_contacts.end(), inside))
  {
    const double length = std::hypot(linear, m_lever * angular);
    if (m_left < share * length)
    {
      share = m_left / length;
      m_spent = true;
    }
    m_left -= share * length;
  }
  m_spent = m_spent && share < 1.0;
  return share;
}

Wrench SoftContacts::pull(const Pose& pose) const noexcept
{
  const Motion left = motionBetween(pose, m_goal);
  return {-m_stiffness * left.linear, -m_angularStiffness * left.angular};
}

// What was cut is air: depth counts from there too. The mask knows the distance to its surface only
// within its ramp, so the ramp is stretched over all depths, starting with their own slope.
double SoftContacts::belowCut(double left) const noexcept
{
  const double whole = 2.0 * left; // position on the ramp: 0 at the surface, 1 where nothing is cut
  return m_ramp * whole / (1.0 - (left > 0.0 ? whole : -whole));
}

Eigen::Vector3d SoftContacts::slopeBelowCut(const Eigen::Vector3d& voxel) const noexcept
{
  const auto left = [&](const Eigen::Vector3d& at) { return m_field.left(at, *m_state); };
  const double rest = 1.0 - 2.0 * std::abs(left(voxel));
  const double rise = left(voxel) > 0.0 ? 1.0 / (rest * rest) : 1.0 / ((2.0 - rest) * (2.0 - rest));
  return 2.0 * m_ramp * rise * volume::gradientInPatient(m_field.geometry(), voxel, 0.5, left);
}

// At a point `arm` (patient axes) from the tool's origin. `bound` becomes its depth in the map if
// the map is sampled.
SoftContacts::Look SoftContacts::lookAt(const volume::DistanceMap& map, const Eigen::Vector3d& arm,
                                        float& bound) const noexcept
{
  Look look;
  look.arm = arm;
  const Eigen::Vector3d patient = m_pose.position + arm;
  const Eigen::Vector3d voxel = map.geometry().voxelFromPatient(patient);
  const double away = map.away(voxel);
  if (away > 0.0)
  {
    look.at.depth = -away;
    bound = static_cast<float>(-away);
    return look;
  }
  const double left = m_field.left(m_field.geometry().voxelFromPatient(patient), *m_state);
  const double most = left < kWhole ? belowCut(left) : std::numeric_limits<double>::max();
  if (most < -m_step)
  {
    look.at.depth = most; // in removed tissue, far from what remains
    return look;
  }
  look.at = map.at(voxel);
  bound = static_cast<float>(look.at.depth);
  look.cut = most < look.at.depth;
  if (look.cut)
    look.at.depth = most;
  return look;
}

// The gradient below a cut costs more than the depth, and few points need it.
void SoftContacts::complete(Look& look) const noexcept
{
  if (look.cut)
    look.at.gradient =
        slopeBelowCut(m_field.geometry().voxelFromPatient(m_pose.position + look.arm));
}

// Finds the points that are deepest or may be after a step. The others are skipped: each depth has
// a bound that grows with the tool's motion.
void SoftContacts::look(Structure& structure) noexcept
{
  structure.bound += static_cast<float>(double{kSteepest} * structure.linear + kRounding) +
                     static_cast<float>(double{kSteepest} * structure.angular) * m_arm;
  structure.linear = structure.angular = 0.0;
  const double reach = double{kSteepest} * m_step;
  const double band = 2.0 * reach;
  double deepest = -std::numeric_limits<double>::max();
  Look* const looks = &m_looks[structure.first];
  structure.count = 0;
  const auto lookAtPoint = [&](std::uint32_t point)
  {
    Look look =
        lookAt(*structure.map, m_pose.rotation * m_shell.points[point], structure.bound[point]);
    look.point = point;
    if (look.at.depth > deepest)
    {
      deepest = look.at.depth;
      structure.last = point;
    }
    looks[structure.count++] = look;
  };
  const std::uint32_t seed = structure.last;
  lookAtPoint(seed);
  for (std::uint32_t i = 0; i < m_arm.size(); ++i)
    if (double{structure.bound[i]} >= std::max(deepest - band, -reach) && i != seed)
      lookAtPoint(i);
  structure.top = double{structure.bound.maxCoeff()};
  structure.depth = deepest;
  structure.least = std::max(deepest - band, -reach);
  const auto shallow = [&](const Look& look) { return look.at.depth < structure.least; };
  structure.count =
      static_cast<std::size_t>(std::remove_if(looks, looks + structure.count, shallow) - looks);
  if (structure.count > kMaxOfOne)
  {
    std::nth_element(looks, looks + kMaxOfOne, looks + structure.count,
                     [](const Look& a, const Look& b) { return a.at.depth > b.at.depth; });
    structure.count = kMaxOfOne;
  }
}

void SoftContacts::find(const Pose& pose, const volume::MaskState& state, ProxyQp& qp) noexcept
{
  const Motion way = motionBetween(m_pose, pose);
  m_pose = pose;
  m_state = &state;
  m_contacts.clear();
  m_order.clear();
  m_away = std::numeric_limits<double>::max();
  m_near.clear();
  for (std::size_t n = 0; n < m_structures.size(); ++n)
  {
    Structure& structure = m_structures[n];
    structure.linear += way.linear.norm();
    structure.angular += way.angular.norm();
    const double top =
        structure.top + double{kSteepest} * (structure.linear + structure.angular * m_shell.reach);
    if (top < -kFar)
    {
      m_away = std::min(m_away, -top / double{kSteepest});
      continue;
    }
    structure.first = n * m_shell.points.size();
    look(structure);
    m_near.push_back(n);
    if (structure.count > 0)
      m_order.push_back(n);
  }
  const auto deeper = [this](std::size_t a, std::size_t b)
  { return m_structures[a].depth > m_structures[b].depth; };
  if (m_order.size() > kMaxSprings)
    std::nth_element(m_order.begin(), m_order.begin() + kMaxSprings, m_order.end(), deeper);
  for (std::size_t n = 0; n < std::min<std::size_t>(m_order.size(), kMaxSprings); ++n)
    addContacts(m_structures[m_order[n]], n);
  addTo(qp);
}

void SoftContacts::addTo(ProxyQp& qp) noexcept
{
  m_firstRow = qp.count();
  for (const Contact& contact : m_contacts)
    qp.addSoft(contact.row, contact.depth, contact.spring, contact.give);
}

// A row's multiplier is the force where depth rises by 1 per mm; near the middle of a structure it
// rises less.
void SoftContacts::takeForces(const ProxyQp& qp) noexcept
{
  m_pressed = false;
  for (std::size_t n = 0; n < m_contacts.size() && m_firstRow + n < qp.count(); ++n)
  {
    Contact& contact = m_contacts[n];
    contact.contact.thrust = contact.slope * qp.lambda(m_firstRow + n);
    m_pressed = m_pressed || contact.contact.thrust > 0.0;
  }
}

void SoftContacts::add(const Structure& structure, std::size_t spring, const Look& look) noexcept
{
  const Eigen::Vector3d out = -look.at.gradient;
  Contact contact;
  contact.slope = out.norm();
  contact.contact.arm = look.arm;
  if (contact.slope > 0.0)
    contact.contact.normal = out / contact.slope;
  contact.contact.gap = -look.at.depth;
  contact.contact.point = look.point;
  contact.contact.soft = true;
  contact.row.head<3>() = out;
  contact.row.tail<3>() = m_turns ? look.arm.cross(out) : Eigen::Vector3d::Zero();
  contact.depth = look.at.depth;
  contact.spring = spring;
  contact.give = structure.give;
  m_contacts.push_back(contact);
}

// Deepest point of the ball: ascends the depth from the deepest shell point, along the ball, by
// secant steps over the tangential part of the gradient.
bool SoftContacts::addBall(const Structure& structure, std::size_t spring) noexcept
{
  if (structure.last >= m_shell.burrCount || !(m_shell.burrRadius > 0.0))
    return false;
  const double radius = m_shell.burrRadius;
  const auto lookTo = [&](const Eigen::Vector3d& direction)
  {
    float bound = 0.0F;
    Look look = lookAt(*structure.map, radius * direction, bound);
    complete(look);
    return look;
  };
  const auto along = [](const Look& look, const Eigen::Vector3d& at) -> Eigen::Vector3d
  { return look.at.gradient - look.at.gradient.dot(at) * at; };
  const Eigen::Vector3d start = m_pose.rotation * m_shell.points[structure.last] / radius;
  Eigen::Vector3d at = start;
  Look look = lookTo(at);
  Eigen::Vector3d residual = along(look, at);
  double step = 1.0;
  for (int turn = 0; turn < kTurns && residual.norm() > kAligned; ++turn)
  {
    const Eigen::Vector3d next = (at + step * residual).normalized();
    if ((next - start).norm() > kFarthest ||
        radius * (m_pose.rotation.conjugate() * next).z() > m_shell.burrTop)
      break;
    const Look there = lookTo(next);
    const Eigen::Vector3d left = along(there, next);
    const double agree = residual.dot(residual - left);
    const bool closer = left.norm() < residual.norm();
    step = std::clamp(agree > 0.0 ? step * residual.squaredNorm() / agree : 2.0 * step, 0.1, 3.0);
    if (!closer)
      continue; // retry from the same point
    at = next;
    look = there;
    residual = left;
  }
  if (residual.norm() > kMisaligned || look.at.gradient.dot(at) < kRidge)
    return false;
  look.point = structure.last;
  add(structure, spring, look);
  return true;
}

void SoftContacts::addContacts(const Structure& structure, std::size_t spring) noexcept
{
  Look* const looks = &m_looks[structure.first];
  const std::size_t ball = m_contacts.size();
  const bool hasBall = addBall(structure, spring);
  for (std::size_t n = 0; n < structure.count; ++n)
  {
    Look& look = looks[n];
    if (hasBall && look.point < m_shell.burrCount)
    {
      const Contact& known = m_contacts[ball];
      const double byPlane = known.depth - known.row.head<3>().dot(look.arm - known.contact.arm);
      if (look.at.depth <= byPlane + kExplained * m_field.voxel())
        continue;
    }
    complete(look);
    add(structure, spring, look);
  }
}

} // namespace petrous::haptics
