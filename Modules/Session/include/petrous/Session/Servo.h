#pragma once

#include <optional>
#include <utility>

#include "petrous/Haptics/DeviceGuard.h"
#include "petrous/Haptics/ForceLimits.h"
#include "petrous/Haptics/PassivityGuard.h"
#include "petrous/Haptics/PointShell.h"
#include "petrous/Haptics/Proxy.h"
#include "petrous/Session/ConstantThrust.h"
#include "petrous/Session/PoseMapping.h"
#include "petrous/Session/TickRecord.h"
#include "petrous/Session/Traverse.h"

namespace petrous::session
{

/// Configuration of a servo; constant while it runs.
struct ServoSetup
{
  haptics::DeviceGuard::Limits guard;
  haptics::ForceLimits::Limits limits;
  /// For the wrench on the hand, so its stiffness is the one at the hand: k scale^2 forceGain.
  std::optional<haptics::PassivityGuard::Parameters> passivity;
  double stiffness = 1.0;     ///< of the proxy's coupling, N/mm, > 0
  std::size_t burrPoints = 0; ///< PointShell::burrCount of the proxy's tool
  double handpiece = haptics::BurrShape().shaftLength; ///< mm along the shaft to its beginning
  Eigen::Vector3d center{0.0, 0.0, 0.0};               ///< patient mm: see PoseMapping
  double stallAfter = 0.05; ///< s without a tick: the tool is re-anchored
};

/// One tick of haptic rendering: reading -> guard -> mapping -> proxy -> passivity -> limits ->
/// wrench for the device.
///
/// The first good reading places the tool. After bad readings, a stall, a clutch, or restored
/// tissue the device may be anywhere: the tool stays where it is and continues from there, with the
/// force fading in (in constant-thrust mode it goes to the given position). While force is disabled
/// the tool rests, and is still moved out of restored tissue. Without force feedback the coupling
/// has a drift limit (ServoParameters::driftLimit), since nothing stops the device at tissue.
///
/// A pointer tool (ServoParameters::kPointer) that is more than `kFarthest` from its target, stands
/// in tissue or is stuck is relocated: along its pick ray, in front of the tissue, at the first
/// free position from its target towards the camera (0, 1, 2, 4 mm ...). Each tick tries one of
/// them. It drills from its arrival at the pick ray on, not on its way there. In this mode and with
/// set thrust, the force on the hand never exceeds the thrust.
///
/// Deterministic: the same inputs in the same order give bit-identical records, if proxy and field
/// are deterministic. `tick` does not allocate, lock, throw or do I/O. Not thread-safe.
class Servo
{
public:
  /// `proxy` must outlive this. Throws InvalidParameter naming the first invalid value.
  Servo(haptics::Proxy& proxy, const ServoSetup& setup);

  /// The record is valid until the next tick; send `output` to the device.
  const TickRecord& tick(const TickInput& input) noexcept;

  const ServoSetup& setup() const noexcept { return m_setup; }

  /// haptics::ProxyTick::postponed of the last tick, mm.
  double postponed() const noexcept { return m_postponed; }

  static constexpr double kFarthest = 10.0; ///< mm

private:
  struct Step
  {
    PoseMapping::View view;
    haptics::Pose device;
    haptics::Pose mapped;
    double dt = 0.0;
    bool usable = false; ///< reading, clock and parameters are valid
    bool clutch = false;
    bool pressed = false; ///< with a set thrust
    bool pointer = false; ///< pointer tool
  };
  Step judge(const TickInput& input) noexcept;
  void map(Step& step, bool anew) noexcept;
  void limitDrift(Step& step, double limit) noexcept;
  bool isFar(const Step& step) const noexcept;
  bool placeAnew(const Step& step) noexcept;
  haptics::Pose goalOf(const Step& step) noexcept;
  void awaitArrival(const Step& step, bool wanted, const Eigen::Vector3d& way) noexcept;
  void notifyStretch(const Eigen::Vector3d& stretch, const Eigen::Vector3d& way) noexcept;
  void reportContacts(const haptics::ProxyTick& tick, double share) noexcept;
  void giveForce(const Step& step, const haptics::Wrench& wrench, bool anew) noexcept;

  ServoSetup m_setup;
  haptics::Proxy& m_proxy;
  haptics::DeviceGuard m_guard;
  haptics::ForceLimits m_limits;
  haptics::PassivityGuard m_passivity;
  PoseMapping m_mapping;
  ConstantThrust m_thrust;
  Traverse m_traverse;
  TickRecord m_record;
  haptics::ProxyTick m_none; // before the tool is placed
  std::uint64_t m_number = 0;
  double m_time = 0.0;
  bool m_hasTime = false;
  bool m_placed = false; ///< the first good reading has arrived
  bool m_giving = false; ///< force was enabled at the last tick
  bool m_wasUsable = false;
  bool m_touches = false;                   ///< at the last tick
  bool m_inside = false;                    ///< at the last tick
  bool m_pedalOn = false;                   ///< ServoParameters::kPedalSpeed
  bool m_arrived = false;                   ///< the pressed tool has been where it was pressed
  Eigen::Vector3d m_stillAt{0.0, 0.0, 0.0}; ///< where a pressed tool has rested for m_stillFor
  double m_stillFor = 0.0;                  ///< s
  double m_postponed = 0.0;
  double m_back = 0.0; ///< mm from its target towards the camera, tried next
  int m_rest = 0;      ///< ticks until the next search for another position
};

static_assert(noexcept(std::declval<Servo&>().tick(std::declval<const TickInput&>())));

} // namespace petrous::session
