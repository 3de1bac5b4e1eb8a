#pragma once

#include <optional>

#include "petrous/Dissection/Stroke.h"
#include "petrous/Session/TickRecord.h"

namespace petrous::session
{

/// Measures how fast the burr turned over some ticks, if a pedal set its speed in one of them.
class SpindleMeter
{
public:
  /// A tick in which the burr turned, for `seconds`.
  void add(const TickInput& input, double seconds) noexcept;

  /// Of a burr that was set to `rpm`; ticks without the pedal count at full speed. nullopt: no
  /// pedal set it.
  std::optional<dissection::SpindleSpeed> speed(double rpm) const noexcept;

private:
  double m_seconds = 0.0;
  double m_turned = 0.0; // s, of full speed
  double m_max = 0.0;    // of full speed
  bool m_isByPedal = false;
};

} // namespace petrous::session
