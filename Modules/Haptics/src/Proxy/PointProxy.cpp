#include "petrous/Haptics/PointProxy.h"

#include <algorithm>
#include <cmath>

#include "BurrVolume.h"
#include "CheckedParameters.h"
#include "PoseBacktracker.h"
#include "SoftContacts.h"

namespace petrous::haptics
{

namespace
{

using Eigen::Vector3d;

constexpr double kSkin = 0.01;    // voxels: height above the surface at which the centre aims
constexpr double kMaxLift = 0.05; // voxels, over a bump
constexpr double kKept = 0.1;     // voxels: a plane is reused within this distance of its origin
constexpr std::size_t kMaxKept = 8;
constexpr double kReach = 0.1;    // voxels: scale of the actual surface, ripples included
constexpr double kWithin = 0.005; // voxels: beyond the end of a sweep, to see what ended it
constexpr double kAgainst = 0.02; // cosine: minimum by which a normal opposes the motion
constexpr double kAstray = 0.5;   // cosine: a normal this far along the motion is not used
constexpr double kFlat = 1e-6;    // of f per voxel: below this the slope is meaningless
constexpr double kMin = 1e-9;     // N: a smaller push is ignored
constexpr int kMaxStretches = 32; // sweeps per tick that end freely

constexpr ParameterCheck kCheck("centre proxy");

const CentreBurr& checked(const CentreBurr& burr)
{
  kCheck.require(burr.radius >= 0.25 && burr.radius <= 5.0,
                 "the radius must lie within 0.25 to 5 mm");
  kCheck.require(burr.points >= 100 && burr.points <= 5000, "the points must be 100 to 5000");
  kCheck.require(burr.superficialShare >= 0.0 && burr.superficialShare <= 2.0,
                 "the superficial share must lie within 0 to 2");
  return burr;
}

PointShell centreAlone()
{
  PointShell shell;
  shell.points = {Vector3d::Zero()};
  shell.normals = {Vector3d::UnitZ()};
  shell.burrCount = 1;
  return shell;
}

// The ball's surface: the outermost of the points that fill it, projected onto the sphere.
PointShell ballOf(const BurrVolume& volume, double radius)
{
  PointShell shell;
  for (const Vector3d& point : volume.points())
    if (point.norm() > radius - volume.spacing())
    {
      shell.normals.push_back(point.normalized());
      shell.points.push_back(radius * shell.normals.back());
    }
  shell.burrCount = shell.points.size();
  shell.burrRadius = shell.burrTop = shell.reach = radius;
  return shell;
}

// Translation only: the angular half of rows and goal is zero.
ContactQp::Vector6 straight(const Vector3d& linear)
{
  ContactQp::Vector6 result;
  result << linear, Vector3d::Zero();
  return result;
}

} // namespace

PointProxy::PointProxy(std::shared_ptr<const HapticField> field, const CentreBurr& burr,
                       const ProxyParameters& parameters)
  : m_parameters(kCheck(parameters))
  , m_sweep(kCheck.field(field), centreAlone(), parameters.sweepStep, parameters.bisections)
  , m_volume(std::make_unique<BurrVolume>(m_sweep.field(), checked(burr).radius, burr.points))
  , m_radius(burr.radius)
  , m_pointForce(4.0 * burr.superficialShare * parameters.stiffness * burr.radius /
                 static_cast<double>(m_volume->points().size()))
  , m_qp(field->soft().empty() ? kMaxHits + 1 : kMaxRows,
         ContactQp::Vector6::Constant(parameters.stiffness), !field->soft().empty())
  , m_backtracker(std::make_unique<PoseBacktracker>(m_sweep))
{
  if (field->soft().empty())
    return;
  m_ball = ballOf(*m_volume, m_radius);
  m_soft = std::make_unique<SoftContacts>(*field, m_ball, m_parameters, false);
}

PointProxy::~PointProxy() = default;

const std::vector<Vector3d>& PointProxy::points() const noexcept
{
  return m_volume->points();
}

void PointProxy::place(const Pose& pose) noexcept
{
  if (!m_backtracker->place(pose))
    return;
  if (m_soft)
    m_soft->begin({pose.position, Eigen::Quaterniond::Identity()});
  m_tick.pose = m_sweep.pose();
}

bool PointProxy::placeFree(const Pose& pose) noexcept
{
  if (!m_backtracker->freeAt(pose))
    return false;
  place(pose);
  return true;
}

// The tissue's surface near the centre. The normal is smoothed over a voxel; the distance follows
// from the local slope, as edges in an image are not linear ramps.
bool PointProxy::nearPlane(Plane& plane) const noexcept
{
  if (m_sweep.nearCount() == 0)
    return false;
  const HapticField& field = m_sweep.field();
  const double h = field.voxel();
  const FieldSample& sample = m_sweep.begin()->sample;
  const Vector3d voxel = m_sweep.voxelOf(0);
  const Vector3d gradient = field.gradient(voxel, sample, m_sweep.state());
  const double steep = gradient.norm();
  if (!(steep * h > kFlat))
    return false;
  plane.normal = -gradient / steep;
  const double slope = -field.slope(voxel, plane.normal, kReach * h, m_sweep.state());
  const double gap = -sample.value / slope;
  if (!(slope * h > kFlat) || gap > m_parameters.nearGap * h)
    return false;
  plane.point = m_sweep.pose().position - std::max(gap, 0.0) * plane.normal;
  return true;
}

// The surface that ended a sweep. Without a usable gradient the normal opposes the motion.
PointProxy::Plane PointProxy::planeOf(const ShellSweep::Hit& hit) const noexcept
{
  const HapticField& field = m_sweep.field();
  Vector3d voxel = m_sweep.voxelOf(0);
  const Vector3d within =
      voxel + field.geometry().voxelFromPatientLinear() * (kWithin * field.voxel() * hit.direction);
  FieldSample sample = field.sample(within, m_sweep.state());
  if (sample.value > 0.0)
    voxel = within;
  else
    sample = field.sample(voxel, m_sweep.state());
  const Vector3d gradient = field.gradient(voxel, sample, m_sweep.state(), kReach);
  const double steep = gradient.norm();
  Vector3d normal = -hit.direction;
  if (steep * field.voxel() > kFlat && gradient.dot(hit.direction) > -kAstray * steep)
  {
    // The motion went in, so a normal along it is tilted against it, by no more than needed.
    normal = -gradient / steep;
    const double along = normal.dot(hit.direction) + kAgainst;
    normal = (normal - std::max(along, 0.0) * hit.direction).normalized();
  }
  return {normal, m_sweep.pose().position};
}

void PointProxy::addRow(const Plane& plane, double lift, bool tight) noexcept
{
  const double gap = plane.normal.dot(m_sweep.pose().position - plane.point);
  const std::size_t row = m_qp.count();
  if (m_qp.add(straight(plane.normal), tight ? std::min(lift - gap, 0.0) : lift - gap))
    m_rows[row] = plane;
}

// The motion closest to the wanted one on the right side of every plane. If there is no room for
// skin and lift, standing still must be feasible.
Vector3d PointProxy::solve(const Vector3d& wanted, double lift) noexcept
{
  Plane near;
  const bool hasNear = nearPlane(near);
  for (const bool tight : {false, true})
  {
    m_qp.clear();
    if (hasNear)
      addRow(near, kSkin * m_sweep.field().voxel(), tight);
    m_firstHit = m_qp.count();
    for (std::size_t n = 0; n < m_hitCount; ++n)
      addRow(m_hits[n], lift, tight);
    m_planes = m_qp.count();
    if (m_soft && !tight)
      m_soft->find(m_sweep.pose(), m_sweep.state(), m_qp);
    else if (m_soft)
      m_soft->addTo(m_qp);
    if (m_qp.solve(straight(wanted)) == ContactQp::Status::Solved)
      break;
  }
  if (m_soft)
    m_soft->takeForces(m_qp);
  return m_qp.solution().head<3>();
}

// A sweep is limited to its number of chords, and so is the search for tissue.
ShellSweep::Hit PointProxy::advance(const Vector3d& motion) noexcept
{
  const double most =
      static_cast<double>(ShellSweep::kMaxSteps) * m_parameters.sweepStep * m_sweep.field().voxel();
  m_sweep.addNear(std::min(motion.norm(), most), 0.0);
  return m_sweep.advance({motion, Vector3d::Zero()});
}

// Planes of the last ticks that are active and nearby stay valid while the mask is unchanged: in
// corners the centre comes to rest rather than meeting the same walls again and again.
void PointProxy::keepPlanes() noexcept
{
  const bool same = m_sweep.state().number() == m_number;
  m_number = m_sweep.state().number();
  m_hitCount = 0;
  for (std::size_t n = m_firstHit; same && n < m_planes && m_hitCount < kMaxKept; ++n)
    if (m_qp.lambda(n) > 0.0 &&
        (m_rows[n].point - m_sweep.pose().position).norm() < kKept * m_sweep.field().voxel())
      m_hits[m_hitCount++] = m_rows[n];
}

void PointProxy::follow(const Vector3d& goal) noexcept
{
  const double h = m_sweep.field().voxel();
  const double ahead = (m_parameters.nearGap + kSkin) * h;
  double lift = 2.0 * kSkin * h;
  int stretches = 0;
  keepPlanes();
  while (m_tick.rounds < m_parameters.rounds && stretches < kMaxStretches &&
         !(m_soft && m_soft->spent()))
  {
    m_sweep.findNear(ahead);
    const Vector3d found = solve(goal - m_sweep.pose().position, kSkin * h);
    const double part = m_soft ? m_soft->share({found, Vector3d::Zero()}) : 1.0;
    const Vector3d motion = part * found;
    m_tick.postponed = 0.0;
    if (motion.norm() < m_parameters.deadband)
      return;
    const ShellSweep::Hit hit = advance(motion);
    m_backtracker->remember();
    m_tick.postponed = found.norm() - hit.free * motion.norm();
    if (!hit.any && hit.free >= 1.0 && part >= 1.0)
      return;
    if (!hit.any)
    {
      ++stretches;
      continue;
    }
    ++m_tick.rounds;
    m_hits[m_hitCount++] = planeOf(hit);
    if (hit.free * motion.norm() < lift && m_tick.rounds < m_parameters.rounds)
    {
      // It rests on a bump unknown to the smooth normal: first up, then on.
      m_sweep.findNear(ahead);
      advance(solve(Vector3d::Zero(), lift));
      lift = std::min(2.0 * lift, kMaxLift * h);
    }
  }
  if (m_tick.postponed < m_parameters.deadband)
    m_tick.postponed = 0.0;
}

void PointProxy::addContact(const Vector3d& normal, double thrust, double gap) noexcept
{
  ProxyContact& contact = m_tick.contacts[m_tick.contactCount++];
  contact = {};
  contact.arm = -m_radius * normal;
  contact.normal = normal;
  contact.gap = gap;
  contact.thrust = thrust;
}

// Force of the soft structures; adds their contacts.
Vector3d PointProxy::softPush() noexcept
{
  Vector3d sum = Vector3d::Zero();
  for (const SoftContacts::Contact& soft : m_soft->contacts())
  {
    const ProxyContact& contact = soft.contact;
    if (!(contact.thrust > 0.0) || m_tick.contactCount + 1 >= ProxyTick::kMaxContacts)
      continue;
    sum += contact.thrust * contact.normal;
    m_tick.thrust += contact.thrust;
    addContact(contact.normal, contact.thrust, contact.gap);
    m_tick.contacts[m_tick.contactCount - 1].soft = true;
  }
  return sum;
}

void PointProxy::report() noexcept
{
  const Vector3d& place = m_sweep.pose().position;
  Vector3d spring = Vector3d::Zero();
  for (std::size_t n = 0; n < m_planes; ++n)
  {
    const double lambda = m_qp.lambda(n);
    if (!(lambda > 0.0))
      continue;
    const Plane& plane = m_rows[n];
    spring += lambda * plane.normal;
    m_tick.thrust += lambda;
    addContact(plane.normal, lambda, plane.normal.dot(place - plane.point) - m_radius);
  }
  if (m_soft)
    spring += softPush();
  const BurrVolume::Push push = m_volume->push(place, m_sweep.state());
  const Vector3d points = m_pointForce * push.sum;
  const double size = points.norm();
  if (size > kMin)
  {
    m_tick.thrust +=
        m_tick.contactCount > 0 ? std::max(0.0, points.dot(spring.normalized())) : size;
    addContact(points / size, size, -push.depth);
    m_tick.wrench.linear = spring + points;
  }
  else
    m_tick.wrench.linear = spring;
  if (m_soft && m_soft->spent())
    m_tick.wrench.linear += m_soft->pull(m_sweep.pose()).linear - spring;
  m_tick.penetration = push.depth;
  m_tick.nearPoints = push.looked;
  if (m_tick.contactCount > 0 && m_tick.status == ProxyStatus::Free)
    m_tick.status = ProxyStatus::Contact;
}

const ProxyTick& PointProxy::step(const Pose& goal) noexcept
{
  m_backtracker->tick(goal, m_tick,
                      [&](bool free)
                      {
                        if (m_soft)
                          m_soft->begin({goal.position, Eigen::Quaterniond::Identity()});
                        if (free)
                        {
                          follow(goal.position);
                          report();
                        }
                        else if (m_tick.status == ProxyStatus::Inside)
                          m_tick.penetration = m_radius;
                        m_tick.pose = {m_sweep.pose().position, goal.rotation.normalized()};
                      });
  return m_tick;
}

} // namespace petrous::haptics
