#include "petrous/Haptics/ConstrainedProxy.h"

#include <algorithm>
#include <cmath>

#include "CheckedParameters.h"
#include "ContactFinder.h"
#include "PoseBacktracker.h"
#include "SoftContacts.h"

namespace petrous::haptics
{

namespace
{

// Height in voxels above the surface at which the motion aims, so that curvature unknown to the
// rows rarely costs another round.
constexpr double kSkin = 0.01;
constexpr double kSkinSlack = 0.3; // of the skin, which need not be recovered
constexpr double kMaxLift = 0.05;  // voxels, over a bump
constexpr int kMaxStretches = 32;  // sweeps per tick that end freely
constexpr double kMinWay = 1e-6;   // mm

constexpr ParameterCheck kCheck("constrained proxy");

const ProxyParameters& checked(const ProxyParameters& p)
{
  kCheck.require(p.angularStiffness > 0.0 && p.angularStiffness <= 1e5,
                 "the angular stiffness must lie within 0 to 100000 N mm/rad");
  return kCheck(p);
}

PointShell checked(PointShell shell)
{
  kCheck.require(!shell.points.empty() && shell.points.size() == shell.normals.size(),
                 "a shell needs points, and a normal for each");
  return shell;
}

ContactQp::Vector6 vector6(const Eigen::Vector3d& linear, const Eigen::Vector3d& angular)
{
  ContactQp::Vector6 result;
  result << linear, angular;
  return result;
}

} // namespace

ConstrainedProxy::ConstrainedProxy(std::shared_ptr<const HapticField> field, PointShell shell,
                                   const ProxyParameters& parameters)
  : m_parameters(checked(parameters))
  , m_sweep(kCheck.field(field), checked(std::move(shell)), parameters.sweepStep,
            parameters.bisections)
  , m_finder(std::make_unique<ContactFinder>(m_sweep, parameters.nearGap))
  , m_qp(kMaxRows,
         vector6(Eigen::Vector3d::Constant(parameters.stiffness),
                 Eigen::Vector3d::Constant(parameters.angularStiffness)),
         !field->soft().empty())
  , m_rows(kMaxRows)
  , m_backtracker(std::make_unique<PoseBacktracker>(m_sweep))
{
  if (!field->soft().empty())
    m_soft = std::make_unique<SoftContacts>(*field, m_sweep.shell(), m_parameters, true);
}

ConstrainedProxy::~ConstrainedProxy() = default;

void ConstrainedProxy::place(const Pose& pose) noexcept
{
  if (!m_backtracker->place(pose))
    return;
  m_tick.pose = m_sweep.pose();
  m_hitCount = 0; // stops at the previous pose
  m_caught = false;
  if (m_soft)
    m_soft->begin(pose);
}

bool ConstrainedProxy::placeFree(const Pose& pose) noexcept
{
  if (!m_backtracker->freeAt(pose))
    return false;
  place(pose);
  return true;
}

// Two problems. In the first, standing still is feasible, and its forces are rendered. In the
// second the tool also keeps the skin above rigid tissue; if tissue on all sides leaves no room for
// that, the first one's motion is used.
Motion ConstrainedProxy::solve(const Motion& wanted, double lift) noexcept
{
  static_assert(kMaxHits <= ContactFinder::kMaxHits);
  const double skin = kSkin * m_sweep.field().voxel();
  m_finder->find(m_hits.data(), std::min(m_hitCount, kMaxHits));
  m_found += m_finder->samples();
  m_rowCount = 0;
  bool tight = false;
  m_qp.clear();
  for (const auto& [contact, slope, stopped] : *m_finder)
  {
    if (m_rowCount == kMaxRows)
      break;
    Row& row = m_rows[m_rowCount];
    row.contact = contact;
    row.jacobian = vector6(contact.normal, contact.arm.cross(contact.normal));
    row.bound = (stopped ? lift : skin) - contact.gap;
    const bool lowered = row.bound > 0.0;
    if (!m_qp.add(row.jacobian, lowered ? 0.0 : row.bound))
      continue;
    tight = tight || (lowered && row.bound > kSkinSlack * skin);
    ++m_rowCount;
  }
  if (m_soft)
    m_soft->find(m_sweep.pose(), m_sweep.state(), m_qp);
  m_qp.solve(vector6(wanted.linear, wanted.angular));
  ContactQp::Vector6 motion = m_qp.solution();
  m_forced = motion - vector6(wanted.linear, wanted.angular);
  for (std::size_t n = 0; n < m_rowCount; ++n)
    m_rows[n].contact.thrust = m_qp.lambda(n);
  if (m_soft)
    m_soft->takeForces(m_qp);
  if (tight)
  {
    m_qp.clear();
    for (std::size_t n = 0; n < m_rowCount; ++n)
      m_qp.add(m_rows[n].jacobian, m_rows[n].bound);
    if (m_soft)
      m_soft->addTo(m_qp);
    if (m_qp.solve(vector6(wanted.linear, wanted.angular)) == ContactQp::Status::Solved)
      motion = m_qp.solution();
  }
  return {motion.head<3>(), motion.tail<3>()};
}

void ConstrainedProxy::report() noexcept
{
  m_tick.contactCount = 0;
  m_tick.thrust = 0.0;
  m_tick.wrench.linear = m_parameters.stiffness * m_forced.head<3>();
  m_tick.wrench.angular = m_parameters.angularStiffness * m_forced.tail<3>();
  const auto note = [this](const ProxyContact& contact)
  {
    if (!(contact.thrust > 0.0))
      return;
    if (contact.point < m_sweep.shell().burrCount)
      m_tick.thrust += contact.thrust;
    if (m_tick.contactCount < ProxyTick::kMaxContacts)
      m_tick.contacts[m_tick.contactCount++] = contact;
  };
  for (std::size_t n = 0; n < m_rowCount; ++n)
    note(m_rows[n].contact);
  if (m_soft)
    for (const SoftContacts::Contact& soft : m_soft->contacts())
      note(soft.contact);
  if (m_tick.contactCount > 0 && m_tick.status == ProxyStatus::Free)
    m_tick.status = ProxyStatus::Contact;
}

bool ConstrainedProxy::spent() const noexcept
{
  return m_sweep.samples() + m_found >= static_cast<std::size_t>(m_parameters.samples);
}

// A sweep is limited to its number of chords, and so is the search for near points.
ShellSweep::Hit ConstrainedProxy::advance(const Motion& motion, double way) noexcept
{
  // In growing stretches: obstacles are mostly near, and distant points are not examined.
  const double step = m_parameters.sweepStep * m_sweep.field().voxel();
  const double farthest = std::min(1.0, ShellSweep::kMaxSteps * step / std::max(way, 1e-12));
  double share = std::min(farthest, 2.0 * step / std::max(way, 1e-12));
  double done = 0.0;
  ShellSweep::Hit hit;
  for (;;)
  {
    share = std::min(share, farthest - done);
    if (done > 0.0)
      m_sweep.findNear(0.0);
    const double known =
        m_sweep.addNear(share * motion.linear.norm(), share * motion.angular.norm());
    m_waits = known * share * way < kMinWay;
    if (m_waits)
      break;
    share *= known;
    const Motion part{share * motion.linear, share * motion.angular};
    m_tick.nearPoints = std::max(m_tick.nearPoints, m_sweep.nearCount());
    const std::size_t most = static_cast<std::size_t>(m_parameters.samples);
    hit = m_sweep.advance(part, most - std::min(most, m_found));
    done += share * hit.free;
    if (hit.any || done >= farthest - 1e-12 || spent())
      break;
    share *= 2.0;
  }
  hit.free = !hit.any && done >= 1.0 - 1e-12 ? 1.0 : done;
  return hit;
}

void ConstrainedProxy::follow(const Pose& goal) noexcept
{
  const double h = m_sweep.field().voxel();
  const double reach = m_sweep.shell().reach;
  const double ahead = (m_parameters.nearGap + kSkin) * h;
  int stretches = 0;
  m_waits = false;
  // What stopped a tick that made no progress is still there in the next one. A tick therefore need
  // not find all obstacles: its work can be bounded without the tool being caught on a bump.
  if (!m_caught || m_caughtIn != m_sweep.state().number())
  {
    m_hitCount = 0;
    m_lift = 2.0 * kSkin * h;
  }
  double made = 0.0; // mm
  while (m_tick.rounds < m_parameters.rounds && stretches < kMaxStretches &&
         !(m_soft && m_soft->spent()))
  {
    const Motion wanted = motionBetween(m_sweep.pose(), goal);
    m_sweep.findNear(ahead);
    const Motion found = solve(wanted, kSkin * h);
    report();
    const double part = m_soft ? m_soft->share(found) : 1.0;
    const Motion motion{part * found.linear, part * found.angular};
    const double way = maxDisplacement(motion, reach);
    m_tick.postponed = 0.0;
    if (way < m_parameters.deadband)
      break;
    m_tick.postponed = way;
    if (made > 0.0 && spent())
      break;
    const ShellSweep::Hit hit = advance(motion, way);
    m_backtracker->remember();
    made += hit.free * way;
    m_tick.postponed = maxDisplacement(found, reach) - hit.free * way;
    if (hit.any)
    {
      ++m_tick.rounds;
      for (const ShellSweep::Hit& stop : {hit, m_sweep.blocker()})
        if (stop.any)
          m_hits[m_hitCount++ % kMaxHits] = stop;
    }
    if ((!hit.any && hit.free >= 1.0 && part >= 1.0) || spent() || m_waits)
      break;
    if (!hit.any)
      ++stretches;
    else if (hit.free * way < m_lift && m_tick.rounds < m_parameters.rounds)
    {
      // It rests on a bump unknown to a smooth normal: first up, then on.
      m_sweep.findNear(ahead);
      const Motion up = solve({}, m_lift);
      advance(up, maxDisplacement(up, reach));
      m_lift = std::min(2.0 * m_lift, kMaxLift * h);
    }
  }
  if (m_tick.postponed < m_parameters.deadband)
    m_tick.postponed = 0.0;
  m_caught = made < kSkin * h && m_hitCount > 0;
  m_caughtIn = m_sweep.state().number();
  if (m_soft && m_soft->spent())
    m_tick.wrench = m_soft->pull(m_sweep.pose());
}

const ProxyTick& ConstrainedProxy::step(const Pose& goal) noexcept
{
  m_found = 0;
  m_backtracker->tick(goal, m_tick,
                      [&](bool free)
                      {
                        if (m_soft)
                          m_soft->begin(goal);
                        if (free)
                          follow(goal);
                        m_tick.pose = m_sweep.pose();
                        m_tick.penetration = m_sweep.penetration();
                        m_tick.samples = m_sweep.samples() + m_sweep.surfaceSamples() + m_found;
                      });
  return m_tick;
}

} // namespace petrous::haptics
