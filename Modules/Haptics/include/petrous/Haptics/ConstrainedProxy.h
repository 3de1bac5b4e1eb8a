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

/// The tool as it may be, held to the tissue's surface while the hand goes where it likes: six
/// degrees of freedom, constraint-based [Chan2016, Eq. 1], with PHYSICS' corrections.
///
/// A tick takes the proxy from its pose towards the goal: contact rows for every shell point near
/// the surface, quasi-static motion by ContactQp, a swept test of that motion, and again with the
/// contacts met on the way, until it is done, or the rounds are, or the tick's samples of the
/// field. Then the tool stands where it came to, and the way that is left is made in the ticks that
/// follow: what a tick costs is bounded, and is the same on every machine. A pose is kept only when
/// f <= 0 at every shell point, so the tool never enters rigid tissue. Soft structures
/// (HapticField::soft) are springs in the same problem; see src/Contact/SoftContacts.h.
///
/// `step` neither allocates, locks nor throws. One thread.
class ConstrainedProxy : public Proxy
{
public:
  /// Throws InvalidParameter naming the first bad value.
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
  std::unique_ptr<ContactFinder> m_finder; // looks at m_sweep
  ProxyQp m_qp;
  std::size_t m_found = 0;              // samples of the finder in this tick
  std::unique_ptr<SoftContacts> m_soft; // null where all is rigid
  std::vector<Row> m_rows;              // of the last problem
  std::size_t m_rowCount = 0;
  ContactQp::Vector6 m_forced = ContactQp::Vector6::Zero(); // a - u, before the skin

  std::array<ShellSweep::Hit, kMaxHits> m_hits; // since the tool last made some way; the latest
  std::size_t m_hitCount = 0;
  double m_lift = 0.0;              // mm, over the next bump
  bool m_caught = false;            // the last tick made no way
  bool m_waits = false;             // for samples of the surface, to go on in the next tick
  std::uint64_t m_caughtIn = 0;     // number of the mask's state in which that was
  std::unique_ptr<PoseBacktracker> m_refuge; // moves m_sweep
  ProxyTick m_tick;
};

} // namespace petrous::haptics
