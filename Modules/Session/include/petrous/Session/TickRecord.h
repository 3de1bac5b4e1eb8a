#pragma once

#include <cstdint>
#include <string>
#include <type_traits>

#include "petrous/Haptics/Device.h"
#include "petrous/Session/ServoParameters.h"
#include "petrous/Session/TickValues.h"

namespace petrous::session
{

/// All inputs of a tick: the same inputs from the start give the same records.
struct TickInput
{
  double now = 0.0;   ///< s, the servo's clock
  double time = 0.0;  ///< s, of the reading
  PoseValues device;  ///< X_DT as reported by the device, mm
  double pedal = 0.0; ///< 0 to 1
  std::uint32_t buttons = 0;
  std::uint32_t health = 0; ///< haptics::DeviceHealth
  ServoParameters parameters;

  static TickInput of(double now, const haptics::DeviceReading& reading,
                      const ServoParameters& parameters) noexcept;
  haptics::DeviceReading reading() const noexcept;
  /// By parameter, pedal or button, whether or not the burr may cut in this tick.
  bool drillWanted() const noexcept;
  bool pedalDown() const noexcept; ///< of a tick: the servo sets a pedal that is not on to 0
  /// Fraction of the spindle's speed that is wanted, 0 to 1 (ServoParameters::kPedalSpeed).
  double spindle() const noexcept;
  /// Whether the pedal's pressure is that fraction, and not a button, key or switch.
  bool pedalSetsSpeed() const noexcept;
  /// The tool is held in place, by parameter or button.
  bool clutched() const noexcept;
};

/// Why a tick renders no force, or less than wanted.
enum class ServoFault : std::uint8_t
{
  None,
  Device,     ///< the guard rejected the reading; see `verdict`
  Stalled,    ///< the servo itself stood still: the tool is re-anchored
  Clock,      ///< the servo's clock ran backward or is not a number
  Parameters, ///< a parameter is out of range
  Inside,     ///< the tool is in tissue; no force until it is free
  Retreated,  ///< tissue was restored around the tool; it went back along its path
  Wrench      ///< the computed wrench is not finite
};

/// One tick of the servo, with fixed layout and no padding.
struct TickRecord
{
  std::uint64_t number = 0; ///< tick number, from 0
  TickInput input;
  PoseValues mapped; ///< the device as mapped to the patient, X_PT
  PoseValues proxy;  ///< the tool, X_PT; origin at the burr's centre
  /// On the hand, about the tool's origin, patient axes, before limits. Sum of the contacts, except
  /// for pointer and pressed tools: limited to the thrust and, where tissue holds the tool, the
  /// coupling's force, which the contacts may not fully account for.
  WrenchValues wrench;
  WrenchValues output;                   ///< as sent to the device, frame D
  double thrust = 0.0;                   ///< N, sum over the burr's contacts
  double burrForce[3] = {0.0, 0.0, 0.0}; ///< N, of the burr's contacts on the tool, patient axes
  double contactRadius = 0.0;            ///< mm, of the burr's contacts from the spindle axis,
                                         ///< thrust-weighted
  double elevation = 0.0;                ///< rad, of the spindle above the contact's tangent plane
  double penetration = 0.0;              ///< mm
  double verdictValue = 0.0;   ///< haptics::DeviceGuard::Judgement::value of a bad reading
  std::uint64_t maskState = 0; ///< number of the mask state used (volume::MaskState)
  std::uint16_t contacts = 0;  ///< active contacts
  std::uint8_t status = 0;     ///< haptics::ProxyStatus
  std::uint8_t fault = 0;      ///< ServoFault
  std::uint8_t verdict = 0;    ///< haptics::DeviceVerdict
  std::uint8_t drill = 0;      ///< 1: the burr rotates and may cut
  std::uint8_t held = 0;       ///< what presses on tissue besides the burr: kShaft, kHandpiece
  std::uint8_t spare = 0;

  static constexpr std::uint8_t kShaft = 1;
  static constexpr std::uint8_t kHandpiece = 2;

  double time() const noexcept { return input.now; }
};

static_assert(std::is_trivially_copyable_v<TickRecord>);
static_assert(sizeof(TickInput) == 8 + 8 + 56 + 8 + 8 + 104);
static_assert(sizeof(TickRecord) == 8 + sizeof(TickInput) + 2 * 56 + 2 * 48 + 8 * 8 + 8 + 8);

/// One sentence on the tick's fault; empty if there is none. Allocates.
std::string toString(const TickRecord& record);

/// Whether the tick had a valid reading and knows the tool's pose. At any other tick `mapped` and
/// `proxy` stand where they were, or at the origin before the tool is placed.
bool hasToolPose(const TickRecord& record) noexcept;

/// "the shaft", "the handpiece", "shaft and handpiece": which parts other than the burr press on
/// tissue; empty if none. Allocates.
std::string holderToString(std::uint8_t held);

/// The drill is on, and shaft or handpiece carry most of the burr's force.
bool isHeldOff(const TickRecord& record) noexcept;

/// The drill is to be on, but a pointer's tool is still on its way to where it is pressed.
bool isArriving(const TickRecord& record) noexcept;

/// The drill is to be on, but the machine stood still, a reading was lost, or a pointer's tool is
/// on its way back after that. Of a drill that was on, it divides no stroke.
bool isInterruption(const TickRecord& record) noexcept;

/// Whether two records are bit-identical.
bool identical(const TickRecord& a, const TickRecord& b) noexcept;

/// The first difference of two records, for display ("the tool's pose"); empty if none.
std::string differenceOf(const TickRecord& a, const TickRecord& b);

} // namespace petrous::session
