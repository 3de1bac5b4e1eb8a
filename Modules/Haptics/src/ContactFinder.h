#pragma once

#include <cstdint>
#include <vector>

#include "petrous/Haptics/ProxyTick.h"
#include "petrous/Haptics/ShellSweep.h"

namespace petrous::haptics
{

struct FoundContact
{
  ProxyContact contact;
  double slope = 0.0;   ///< of f against the normal, per mm
  bool stopped = false; ///< it ended a motion of this tick
};

/// Turns shell points near rigid tissue into contacts: where, which way is out, and how far it is.
///
/// The burr is a ball, and its contact is where the ball comes nearest to tissue, not where one of
/// its shell points happens to be: at c + R s with s = -n(c + R s), n the tissue's normal there,
/// found from the deepest shell point by a secant step over the residual -n - s. So neither the
/// height at which it rests nor the force's direction shows the spacing of its points, and a ball
/// without friction is given no torque. A shell point that lies on the free side of a contact's
/// plane as deep as it lies in f adds nothing and gives no contact of its own.
/// Points of other tools, of shaft and handpiece are contacts themselves.
///
/// `find` neither allocates, locks nor throws. One thread.
class ContactFinder
{
public:
  /// `nearGap` in voxels: contacts farther away than that are none.
  ContactFinder(const ShellSweep& sweep, double nearGap);

  /// Contacts of the sweep's near points; `hits` are those where this tick's motion ended so far.
  void find(const ShellSweep::Hit* hits, std::size_t hitCount) noexcept;

  /// Values of the field asked for by the last `find`.
  std::size_t samples() const noexcept { return m_samples; }

  const FoundContact* begin() const noexcept { return m_found.data(); }
  const FoundContact* end() const noexcept { return m_found.data() + m_count; }

private:
  struct Surface
  {
    Eigen::Vector3d normal{0.0, 0.0, 0.0}; // unit, out of the tissue; zero where f is flat
    double gap = 0.0;                      // mm
    double slope = 0.0;                    // of f against the normal, per mm
  };
  Surface surfaceAt(const Eigen::Vector3d& voxel, const FieldSample& sample,
                    double step = 1.0) const noexcept;
  bool farFrom(const Eigen::Vector3d& voxel, const Eigen::Vector3d& outward) const noexcept;
  bool surfaceOfBall(const Eigen::Vector3d& toPoint, Surface& surface) const noexcept;
  void refineOnBall(ProxyContact& contact, double& slope) const noexcept;
  void add(const ShellSweep::Near& near, bool refine, const ShellSweep::Hit* hit) noexcept;
  bool explained(const ShellSweep::Near& near) const noexcept;

  const ShellSweep& m_sweep;
  double m_nearGap; // mm
  std::vector<std::uint32_t> m_order;
  std::vector<FoundContact> m_found;
  std::size_t m_count = 0;
  mutable std::size_t m_samples = 0;
};

} // namespace petrous::haptics
