#pragma once

#include <cstdint>
#include <string>

#include "petrous/Haptics/Device.h"

namespace petrous::haptics
{

/// Result of checking one reading.
enum class DeviceVerdict : std::uint8_t
{
  Good,
  Repeated,     ///< no new reading since the last tick; harmless until stale
  Settling,     ///< valid again, but not for long enough yet
  NotReady,     ///< no reading yet
  NotFinite,    ///< NaN or infinity in time or pose
  NotUnit,      ///< the quaternion is not a unit quaternion
  OutOfReach,   ///< implausibly far from the device's origin
  TimeBackward, ///< older than the previous reading
  TimeAhead,    ///< in the future: not the servo's clock
  Stale,        ///< too old
  Jump,         ///< moved or turned faster than a hand can
  Disconnected, ///< reported by the device
  Faulty        ///< reported by the device
};

/// One sentence for display.
const char* toString(DeviceVerdict verdict) noexcept;

/// Validates a device's readings before anything is computed from them.
///
/// A bad reading is not used: the pose remains the last good one and no force may be rendered.
/// Afterwards `goodTicks` consecutive new readings must be valid, each compared with its
/// predecessor (not with the held pose: the device may have moved on). Then the verdict is Good
/// again, and the pose may be anywhere: place the tool anew and fade the force in. The very first
/// readings are checked the same way. Repeated readings neither count nor reset the count.
///
/// Not thread-safe. `judge` does not allocate, lock or throw.
class DeviceGuard
{
public:
  struct Limits
  {
    double speed = 5000.0;       ///< mm/s of the grip, > 0
    double angularSpeed = 60.0;  ///< rad/s, > 0
    double reach = 2000.0;       ///< mm from the device's origin, > 0
    double staleAfter = 0.05;    ///< s, > 0; also how far in the future a reading's time may be
    double unitTolerance = 1e-3; ///< largest ||q| - 1|, > 0
    int goodTicks = 20;          ///< valid readings before force is rendered again, >= 1
  };

  struct Judgement
  {
    DeviceVerdict verdict = DeviceVerdict::NotReady;
    Pose pose;           ///< of the last good reading, unit quaternion; hold it
    bool usable = false; ///< Good, or Repeated after Good: force may be rendered
    double value = 0.0;  ///< mm of a jump or distance, s of a time, |q|, or readings left to wait
                         ///< for; 0 if the verdict has no number
  };

  /// Throws InvalidParameter naming the first invalid limit.
  explicit DeviceGuard(const Limits& limits);
  DeviceGuard()
    : DeviceGuard(Limits())
  {
  }

  /// now  s, the servo's clock
  Judgement judge(const DeviceReading& reading, double now) noexcept;

private:
  DeviceVerdict verdictOn(const DeviceReading& reading, double now, double& value) noexcept;

  Limits m_limits;
  Pose m_good;         ///< the held pose
  Pose m_latest;       ///< the last valid reading, good or settling
  double m_time = 0.0; ///< s, of m_latest
  bool m_hasLatest = false;
  bool m_usable = false;
  int m_sound = 0; ///< consecutive valid readings, up to goodTicks
};

/// The sentence including its number, if any: "The device's handle jumped by 50.0 mm ...".
/// Allocates; not for the servo thread.
std::string toString(const DeviceGuard::Judgement& judgement);

} // namespace petrous::haptics
