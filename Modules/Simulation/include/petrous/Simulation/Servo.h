#pragma once

#include <optional>
#include <utility>

#include "petrous/Haptics/DeviceGuard.h"
#include "petrous/Haptics/ForceLimits.h"
#include "petrous/Haptics/PassivityGuard.h"
#include "petrous/Haptics/PointShell.h"
#include "petrous/Haptics/Proxy.h"
#include "petrous/Simulation/ConstantThrust.h"
#include "petrous/Simulation/PoseMapping.h"
#include "petrous/Simulation/TickRecord.h"
#include "petrous/Simulation/Traverse.h"

namespace petrous::simulation
{

/// What a servo is made with; fixed while it runs.
struct ServoSetup
{
  haptics::DeviceGuard::Limits guard;
  haptics::ForceLimits::Limits limits;
  /// Of the wrench on the hand, so stiffness means that in the hand: k scale^2 forceGain.
  std::optional<haptics::PassivityGuard::Parameters> passivity;
  double stiffness = 1.0;     ///< of the proxy's coupling, N/mm, > 0
  std::size_t burrPoints = 0; ///< PointShell::burrCount of the proxy's tool
  double handpiece = haptics::BurrShape().shaftLength; ///< mm along the shaft, where it begins
  Eigen::Vector3d center{0.0, 0.0, 0.0};               ///< patient mm: see PoseMapping
  double stallAfter = 0.05; ///< s without a tick: the tool is taken up anew
};

/// One tick of touch: reading -> guard -> mapping -> proxy -> passivity -> limits -> the wrench
/// that the device is to be sent.
///
/// The first good reading places the tool. After a bad stretch, a stall, a clutch, or tissue that
/// came back, the hand may be anywhere: the tool stays where it is and goes on from there, the
/// force rising anew (in constant-thrust mode it goes to the place that is given). While force may
/// not be given the tool rests, so that tissue that comes back still moves it out. A hand without
/// force is kept on a leash (ServoParameters::maxLead), since nothing stops it in the tissue.
///
/// A pointer's tool (ServoParameters::kPointer) that is more than `kFarthest` from its place, that
/// stands in tissue, or that tissue does not let go, is placed anew: on its line of sight, before
/// the tissue, at the first place from its own towards the eye (0, 1, 2, 4 mm ...) that is free.
/// Each tick tries one of them.
/// There, and where a set thrust presses, the force on the hand is never more than the thrust.
///
/// The same inputs in the same order give the same records to the last bit, as long as the proxy
/// and its field do. `tick` neither allocates, locks, throws nor does I/O. One thread.
class Servo
{
public:
  /// `proxy` must outlive this. Throws InvalidParameter naming the first bad value.
  Servo(haptics::Proxy& proxy, const ServoSetup& setup);

  /// The record holds until the next tick; send `output` to the device.
  const TickRecord& tick(const TickInput& input) noexcept;

  const ServoSetup& setup() const noexcept { return m_setup; }

  static constexpr double kFarthest = 10.0; ///< mm

private:
  struct Step
  {
    PoseMapping::View view;
    haptics::Pose device;
    haptics::Pose mapped;
    double dt = 0.0;
    bool usable = false; ///< reading, clock and parameters are sound
    bool clutch = false;
    bool pressed = false; ///< by a set thrust
    bool pointer = false; ///< a pointer's tool
  };
  Step judge(const TickInput& input) noexcept;
  void map(Step& step, bool anew) noexcept;
  void boundLead(Step& step, double maxLead) noexcept;
  bool isFar(const Step& step) const noexcept;
  bool placeAnew(const Step& step) noexcept;
  haptics::Pose goalOf(const Step& step) noexcept;
  void notifyStretch(const Eigen::Vector3d& lead, const Eigen::Vector3d& way) noexcept;
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
  bool m_placed = false; ///< the first good reading has come
  bool m_giving = false; ///< force was let in at the last tick
  bool m_wasUsable = false;
  bool m_touches = false; ///< at the last tick
  bool m_inside = false;  ///< at the last tick
  double m_back = 0.0;    ///< mm from its place towards the eye, where it is tried next
  int m_rest = 0;         ///< ticks before it looks for another place again
};

static_assert(noexcept(std::declval<Servo&>().tick(std::declval<const TickInput&>())));

} // namespace petrous::simulation
