#pragma once

#include <cstdint>
#include <string>

#include "petrous/Haptics/Device.h"

namespace petrous::haptics
{

/// What a guard makes of one reading.
enum class DeviceVerdict : std::uint8_t
{
  Good,
  Repeated,     ///< no new reading since the last tick; harmless until it is stale
  Settling,     ///< sound again, but not for long enough yet
  NotReady,     ///< no reading yet
  NotFinite,    ///< NaN or infinity in time or pose
  NotUnit,      ///< the quaternion is no rotation
  OutOfReach,   ///< farther from the device's origin than any hand gets
  TimeBackward, ///< older than the reading before
  TimeAhead,    ///< of the future: its clock is not the servo's
  Stale,        ///< too old
  Jump,         ///< moved or turned faster than a hand does
  Disconnected, ///< the device says so
  Faulty        ///< the device says so
};

/// One plain sentence for people.
const char* toString(DeviceVerdict verdict) noexcept;

/// Judges a device's readings before anything is computed from them.
///
/// A bad reading is not used: the pose stays the last good one and no force may be given. After it
/// `goodTicks` new readings in a row must be sound, each against the one before (not against the
/// pose held: the hand may have moved on); then the verdict is Good again, `returned` is set once,
/// and the pose may be anywhere: place the tool anew and fade the force in. The first readings of
/// all are judged in the same way. Readings that are repeated neither count nor start anew.
///
/// One thread. `judge` neither allocates, locks nor throws.
class DeviceGuard
{
public:
  struct Limits
  {
    double speed = 5000.0;       ///< mm/s of the grip, > 0
    double angularSpeed = 60.0;  ///< rad/s, > 0
    double reach = 2000.0;       ///< mm from the device's origin, > 0
    double staleAfter = 0.05;    ///< s, > 0; also how far ahead a reading's time may be
    double unitTolerance = 1e-3; ///< largest ||q| - 1|, > 0
    int goodTicks = 20;          ///< sound readings before force is given again, >= 1
  };

  struct Judgement
  {
    DeviceVerdict verdict = DeviceVerdict::NotReady;
    Pose pose;             ///< of the last good reading, unit quaternion; hold it
    bool usable = false;   ///< Good, or Repeated after it: force may be given
    bool returned = false; ///< usable now and not before
    double value = 0.0;    ///< mm of a jump or a distance, s of a time, |q|, readings to wait for;
                           ///< 0 where the verdict has no number
  };

  /// Throws InvalidParameter naming the first bad limit.
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
  Pose m_good;         ///< what is held
  Pose m_latest;       ///< the last sound reading, good or settling
  double m_time = 0.0; ///< s, of m_latest
  bool m_hasLatest = false;
  bool m_usable = false;
  int m_sound = 0; ///< sound readings in a row, up to goodTicks
};

/// The sentence with its number, where it has one: "The device's handle jumped by 50.0 mm ...".
/// It allocates; not for the servo.
std::string toString(const DeviceGuard::Judgement& judgement);

} // namespace petrous::haptics
