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
  /// nothing.
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

} // namespace petrous::simulation
