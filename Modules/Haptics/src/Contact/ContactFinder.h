#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "petrous/Haptics/ProxyTick.h"
#include "petrous/Haptics/ShellSweep.h"

namespace petrous::haptics
{

struct FoundContact
{
  ProxyContact contact;
  double slope = 0.0;   ///< of f along the inward normal, per mm
  bool stopped = false; ///< ended a motion of this tick
};

/// Turns shell points near rigid tissue into contacts: position, outward normal and gap.
///
/// The burr is a ball, and its contact is where the ball is closest to tissue, not at one of its
/// shell points: at c + R s with s = -n(c + R s), n the tissue's normal there, found from the
/// deepest shell point by a secant step over the residual -n - s. Neither the height at which it
/// rests nor the direction of the force therefore shows the spacing of its points, and a
/// frictionless ball receives no torque. A shell point whose depth in f is explained by the plane
/// of a known contact gives no contact of its own.
///
/// Points of other tools are contacts themselves. Shaft and handpiece of a solid tool touch where a
/// sample of the tissue's surface is closest to them, one contact per segment of about a voxel:
/// along the tissue's normal where its surface is smooth, along the tool's own at a ridge or spike.
/// Points of their shell give a contact only if one ended a motion.
///
/// `find` does not allocate, lock or throw. Not thread-safe.
class ContactFinder
{
public:
  static constexpr std::size_t kMaxHits = 64; ///< limit for `find`

  /// `nearGap` in voxels: there are no contacts farther away.
  ContactFinder(const ShellSweep& sweep, double nearGap);

  /// Contacts of the sweep's near points; `hits` are the stops of this tick's motion so far.
  void find(const ShellSweep::Hit* hits, std::size_t hitCount) noexcept;

  /// Field samples taken by the last `find`.
  std::size_t samples() const noexcept { return m_samples; }

  const FoundContact* begin() const noexcept { return m_found.data(); }
  const FoundContact* end() const noexcept { return m_found.data() + m_count; }

private:
  struct Surface
  {
    Eigen::Vector3d normal{0.0, 0.0, 0.0}; // unit, out of the tissue; zero if f is flat
    double gap = 0.0;                      // mm
    double slope = 0.0;                    // of f along the inward normal, per mm
  };
  Surface surfaceAt(const Eigen::Vector3d& voxel, const FieldSample& sample,
                    double step = 1.0) const noexcept;
  bool farFrom(const Eigen::Vector3d& voxel, const Eigen::Vector3d& outward) const noexcept;
  bool surfaceOfBall(const Eigen::Vector3d& toPoint, Surface& surface) const noexcept;
  void refineOnBall(ProxyContact& contact, double& slope) const noexcept;
  void add(const ShellSweep::Near& near, bool refine, const ShellSweep::Hit* hit) noexcept;
  bool explained(const ShellSweep::Near& near) const noexcept;
  struct Candidate // a surface sample within reach
  {
    double gap;
    std::uint32_t part;
    std::uint32_t number;
  };
  void addSurface(const ShellSweep::Hit* hits, std::size_t hitCount) noexcept;
  FoundContact contactAt(std::uint32_t part, const Eigen::Vector3d& place) const noexcept;
  std::size_t binOf(std::uint32_t part, double z) const noexcept;
  bool explained(std::uint32_t part, double z, const FoundContact& candidate) const noexcept;
  void smooth(std::uint32_t part, const Eigen::Vector3d& place, FoundContact& found) const noexcept;

  const ShellSweep& m_sweep;
  double m_nearGap; // mm
  std::vector<std::uint32_t> m_order;
  std::vector<FoundContact> m_found;
  static constexpr std::size_t kBins = 256;
  std::array<std::uint32_t, 2 * kBins + 1> m_bins; // last contact of a segment of the solid, + 1
  std::vector<std::uint32_t> m_next;               // the previous one in that segment, + 1
  std::vector<Candidate> m_candidates;
  std::uint32_t m_firstOnHandpiece = 0;
  std::array<double, 2> m_stretches{}; // of shaft and handpiece, below kBins
  std::size_t m_count = 0;
  mutable std::size_t m_samples = 0;
};

} // namespace petrous::haptics
