#pragma once

#include <optional>

#include "petrous/Dissection/SweptSphereCut.h"
#include "petrous/Simulation/TickRecord.h"

namespace petrous::simulation
{

/// How far a drill that is pressed goes into the tissue.
class Feed
{
public:
  virtual ~Feed() = default;

  /// The space that the burr takes in `seconds` of a tick with the drill on; nothing where it takes
  /// nothing. The servo may not have felt the last bites yet, or not made way for them: for a loop
  /// that lags, a bite at their place holds them, too (OwedFeed). It must end within about a voxel
  /// of the tool, so that a loop that stood still does not run ahead of what is felt.
  virtual std::optional<dissection::SweptSphere> bite(const TickRecord& record, double seconds) = 0;
};

/// Feed in proportion to thrust, whatever the tissue:
///
///   v = gain F_t      along the burr's contact force, into the tissue
///
/// gain  mm/s per N
/// F_t   thrust, N: what the burr's contacts push back together, so that walls between which the
///       burr is wedged do not count twice
class SimpleFeed : public Feed
{
public:
  /// radius  of the burr, mm. Throws InvalidParameter when one is not above 0.
  explicit SimpleFeed(double radius, double gain = 20.0);

  std::optional<dissection::SweptSphere> bite(const TickRecord& record, double seconds) override;

private:
  double m_radius;
  double m_gain;
};

/// Carries depth over: what the burr has not come forward by since its last bite is owed, and the
/// next bite takes it with its own. So it drills at the feed's rate where a bite is smaller than
/// what the burr stands off the surface of the last one, and where the servo feels it some ticks
/// later; a loop that stood still takes `kMost` at a place, however many ticks wait for it.
class OwedFeed : public Feed
{
public:
  static constexpr double kMost = 0.1; ///< mm: a burr that is held elsewhere does not bore on alone

  explicit OwedFeed(Feed& feed) noexcept ///< which must outlive this
    : m_feed(feed)
  {
  }

  std::optional<dissection::SweptSphere> bite(const TickRecord& record, double seconds) override;

private:
  Feed& m_feed;
  double m_owed = 0.0;                 // mm
  Eigen::Vector3d m_at{0.0, 0.0, 0.0}; // of the last bite
  std::uint64_t m_number = 0;          // of its tick
};

} // namespace petrous::simulation
