#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "petrous/Haptics/Proxy.h"
#include "petrous/Haptics/ProxyQp.h"
#include "petrous/Haptics/ShellSweep.h"

namespace petrous::haptics
{

class ContactFinder;
class PoseBacktracker;
class SoftContacts;

/// Virtual-coupling proxy with six degrees of freedom, kept on the surface of rigid tissue:
/// constraint-based [Chan2016, Eq. 1], in the form of Documentation/equations.md.
///
/// Each tick moves the proxy from its pose towards the goal: contact rows for every shell point
/// near the surface, quasi-static motion by ContactQp and a swept test of that motion, repeated
/// with the contacts met on the way until the motion is complete or the tick's limit of rounds or
/// field samples is reached. The tool then stays where it is and following ticks make the rest of
/// the motion, so the cost of a tick is bounded and the same on every machine. A pose is kept only
/// if f <= 0 at every shell point, so the tool never enters rigid tissue. Soft structures
/// (HapticField::soft) are springs in the same problem; see src/Contact/SoftContacts.h.
///
/// `step` does not allocate, lock or throw. Not thread-safe.
class ConstrainedProxy : public Proxy
{
public:
  /// Throws InvalidParameter naming the first invalid value.
  ConstrainedProxy(std::shared_ptr<const HapticField> field, PointShell shell,
                   const ProxyParameters& parameters = {});
  ~ConstrainedProxy() override;

  const PointShell& shell() const noexcept { return m_sweep.shell(); }
  const HapticField& field() const noexcept { return m_sweep.field(); }
  const Pose& pose() const noexcept override { return m_sweep.pose(); }

  void place(const Pose& pose) noexcept override;
  bool placeFree(const Pose& pose) noexcept override;
  const ProxyTick& step(const Pose& goal) noexcept override;

private:
  struct Row
  {
    ProxyContact contact;
    ContactQp::Vector6 jacobian;
    double bound = 0.0;
  };
  static constexpr std::size_t kMaxRows = 1024;
  static constexpr std::size_t kMaxHits = 20;

  void follow(const Pose& goal) noexcept;
  Motion solve(const Motion& wanted, double lift) noexcept;
  ShellSweep::Hit advance(const Motion& motion, double way) noexcept;
  void report() noexcept;
  bool spent() const noexcept;

  ProxyParameters m_parameters;
  ShellSweep m_sweep;
  std::unique_ptr<ContactFinder> m_finder; // refers to m_sweep
  ProxyQp m_qp;
  std::size_t m_found = 0;              // field samples taken by the finder in this tick
  std::unique_ptr<SoftContacts> m_soft; // null if all tissue is rigid
  std::vector<Row> m_rows;              // of the last problem
  std::size_t m_rowCount = 0;
  ContactQp::Vector6 m_forced = ContactQp::Vector6::Zero(); // a - u of the problem without skin

  std::array<ShellSweep::Hit, kMaxHits> m_hits; // latest stops since the tool last moved
  std::size_t m_hitCount = 0;
  double m_lift = 0.0;                            // mm, over the next bump
  bool m_caught = false;                          // the last tick made no progress
  bool m_waits = false;                           // for surface samples; continues in the next tick
  std::uint64_t m_caughtIn = 0;                   // number of the mask state of that tick
  std::unique_ptr<PoseBacktracker> m_backtracker; // moves m_sweep
  ProxyTick m_tick;
};

} // namespace petrous::haptics
