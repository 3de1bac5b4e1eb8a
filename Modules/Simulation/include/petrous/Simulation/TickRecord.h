#pragma once

#include <cstdint>
#include <string>
#include <type_traits>

#include "petrous/Haptics/Device.h"
#include "petrous/Simulation/ServoParameters.h"
#include "petrous/Simulation/TickValues.h"

namespace petrous::simulation
{

/// All that goes into a tick: with the same inputs from the start a servo gives the same records.
struct TickInput
{
  double now = 0.0;   ///< s, the servo's clock
  double time = 0.0;  ///< s, of the reading
  PoseValues device;  ///< X_DT as the device gave it, mm
  double pedal = 0.0; ///< 0 to 1
  std::uint32_t buttons = 0;
  std::uint32_t health = 0; ///< haptics::DeviceHealth
  ServoParameters parameters;

  static TickInput of(double now, const haptics::DeviceReading& reading,
                      const ServoParameters& parameters) noexcept;
  haptics::DeviceReading reading() const noexcept;
};

/// Why a tick gives no force, or less than it would.
enum class ServoFault : std::uint8_t
{
  None,
  Device,     ///< the guard refused the reading; `verdict` says why
  Stalled,    ///< the servo itself stood still: the tool is taken up anew
  Clock,      ///< the servo's clock ran back or is no number
  Parameters, ///< a parameter is out of its range
  Inside,     ///< the tool stands in tissue; no force until it is free
  Retreated,  ///< tissue came back round the tool; it went back on its path
  Wrench      ///< the computed wrench is not finite
};

/// One tick of the servo, with fixed layout and no gaps.
struct TickRecord
{
  std::uint64_t number = 0; ///< of the tick, from 0
  TickInput input;
  PoseValues mapped;   ///< the device as mapped to the patient, X_PT
  PoseValues proxy;    ///< the tool, X_PT; origin at the burr's centre
  /// On the hand, about the tool's origin, patient axes, no limits. It is the contacts' sum, but for
  /// a pointer's or a pressed tool: that feels at most the thrust, and where tissue holds it what
  /// the coupling is stretched by, also where the contacts do not say all of it.
  WrenchValues wrench;
  WrenchValues output; ///< as sent to the device, frame D
  double thrust = 0.0; ///< N, sum over the burr's contacts
  double burrForce[3] = {0.0, 0.0, 0.0}; ///< N, of the burr's contacts on the tool, patient axes
  double contactRadius = 0.0;  ///< mm, of the burr's contacts from the spindle, thrust-weighted
  double elevation = 0.0;      ///< rad, of the spindle above the contact's tangent plane
  double penetration = 0.0;    ///< mm
  double verdictValue = 0.0;   ///< haptics::DeviceGuard::Judgement::value where the device is bad
  std::uint64_t maskState = 0; ///< number of the mask's state that was felt (volume::MaskState)
  std::uint16_t contacts = 0;  ///< that press
  std::uint8_t status = 0;     ///< haptics::ProxyStatus
  std::uint8_t fault = 0;      ///< ServoFault
  std::uint8_t verdict = 0;    ///< haptics::DeviceVerdict
  std::uint8_t drill = 0;      ///< 1: the burr turns and may cut
  std::uint8_t held = 0;       ///< what presses on tissue besides the burr: of kShaft, kHandpiece
  std::uint8_t spare = 0;

  static constexpr std::uint8_t kShaft = 1;
  static constexpr std::uint8_t kHandpiece = 2;

  double time() const noexcept { return input.now; }
};

static_assert(std::is_trivially_copyable_v<TickRecord>);
static_assert(sizeof(TickInput) == 8 + 8 + 56 + 8 + 8 + 104);
static_assert(sizeof(TickRecord) == 8 + sizeof(TickInput) + 2 * 56 + 2 * 48 + 8 * 8 + 8 + 8);

/// One plain sentence on the tick's fault; empty when there is none. It allocates.
std::string toString(const TickRecord& record);

/// "the shaft", "the handpiece", "shaft and handpiece": what of the tool presses on tissue besides
/// the burr; empty when nothing does. It allocates.
std::string holderInWords(std::uint8_t held);

/// The drill is on, and shaft or handpiece carry most of the force that the burr should have.
bool isHeldOff(const TickRecord& record) noexcept;

} // namespace petrous::simulation
