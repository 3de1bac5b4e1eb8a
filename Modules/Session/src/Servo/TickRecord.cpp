#include "petrous/Session/TickRecord.h"

#include <algorithm>
#include <cstddef>
#include <cstring>

#include "petrous/Haptics/DeviceGuard.h"

namespace petrous::session
{

TickInput TickInput::of(double now, const haptics::DeviceReading& reading,
                        const ServoParameters& parameters) noexcept
{
  TickInput input;
  input.now = now;
  input.time = reading.time;
  input.device = PoseValues::of(reading.pose);
  input.pedal = reading.pedal;
  input.buttons = reading.buttons;
  input.health = static_cast<std::uint32_t>(reading.health);
  input.parameters = parameters;
  return input;
}

haptics::DeviceReading TickInput::reading() const noexcept
{
  haptics::DeviceReading reading;
  reading.time = time;
  reading.pose = device.pose();
  reading.buttons = buttons;
  reading.pedal = pedal;
  reading.health = health <= static_cast<std::uint32_t>(haptics::DeviceHealth::Faulty)
                       ? static_cast<haptics::DeviceHealth>(health)
                       : haptics::DeviceHealth::Faulty;
  return reading;
}

namespace
{

bool fullSpeedWanted(const TickInput& input) noexcept
{
  return (input.parameters.drill & ServoParameters::kDrill) != 0 ||
         (input.buttons & input.parameters.drillButtons) != 0;
}

bool isSpeed(const TickInput& input) noexcept
{
  return (input.parameters.drill & ServoParameters::kPedalSpeed) != 0;
}

} // namespace

bool TickInput::pedalDown() const noexcept
{
  constexpr double kSwitched = 0.5;
  return pedal >= (isSpeed(*this) ? ServoParameters::kOffPressure : kSwitched);
}

bool TickInput::drillWanted() const noexcept
{
  return fullSpeedWanted(*this) || pedalDown();
}

double TickInput::spindle() const noexcept
{
  if (fullSpeedWanted(*this))
    return 1.0;
  if (!pedalDown())
    return 0.0;
  return isSpeed(*this) ? std::min(pedal, 1.0) : 1.0;
}

bool TickInput::pedalSetsSpeed() const noexcept
{
  return isSpeed(*this) && pedalDown() && !fullSpeedWanted(*this);
}

bool TickInput::clutched() const noexcept
{
  return parameters.clutch || (buttons & parameters.clutchButtons) != 0;
}

bool hasToolPose(const TickRecord& record) noexcept
{
  const auto fault = static_cast<ServoFault>(record.fault);
  return fault != ServoFault::Device && fault != ServoFault::Clock &&
         fault != ServoFault::Parameters && record.proxy.pose().finite();
}

bool isHeldOff(const TickRecord& record) noexcept
{
  const double force = record.wrench.wrench().linear.norm();
  return record.drill != 0 && record.held != 0 && record.thrust < 0.5 * force;
}

bool isArriving(const TickRecord& record) noexcept
{
  return record.drill == 0 && record.input.drillWanted() && !record.input.clutched() &&
         !record.input.parameters.pause &&
         static_cast<ServoFault>(record.fault) == ServoFault::None;
}

bool isInterruption(const TickRecord& record) noexcept
{
  if (!record.input.drillWanted())
    return false;
  switch (static_cast<ServoFault>(record.fault))
  {
  case ServoFault::Stalled:
  case ServoFault::Device:
  case ServoFault::Clock:
    return true;
  case ServoFault::None:
    return isArriving(record);
  default:
    return false;
  }
}

std::string holderToString(std::uint8_t held)
{
  const bool shaft = (held & TickRecord::kShaft) != 0;
  const bool handpiece = (held & TickRecord::kHandpiece) != 0;
  if (shaft && handpiece)
    return "shaft and handpiece";
  return shaft ? "the shaft" : handpiece ? "the handpiece" : "";
}

std::string toString(const TickRecord& record)
{
  switch (static_cast<ServoFault>(record.fault))
  {
  case ServoFault::None:
    return {};
  case ServoFault::Device:
  {
    haptics::DeviceGuard::Judgement judgement;
    judgement.verdict = static_cast<haptics::DeviceVerdict>(record.verdict);
    judgement.value = record.verdictValue;
    return haptics::toString(judgement);
  }
  case ServoFault::Stalled:
    return "The computer stood still for a moment; the tool stays where it was, and the force "
           "comes back slowly.";
  case ServoFault::Clock:
    return "The computer's clock ran back; there is no force until it runs on.";
  case ServoFault::Parameters:
    return "A setting of the device is out of its range; there is no force until it is put right.";
  case ServoFault::Inside:
    return "The tool stands inside tissue; it has no force until it is drawn out.";
  case ServoFault::Retreated:
    return "Tissue came back where the tool was; the tool went back on its path.";
  case ServoFault::Wrench:
    return "The force could not be computed; there is none for a moment.";
  }
  return "The servo reports a fault that this program does not know.";
}

bool identical(const TickRecord& a, const TickRecord& b) noexcept
{
  return std::memcmp(&a, &b, sizeof(TickRecord)) == 0;
}

std::string differenceOf(const TickRecord& a, const TickRecord& b)
{
  // In the record's order; each part ends where the next begins.
  struct Part
  {
    std::size_t begin;
    const char* name;
  };
  constexpr Part parts[] = {{0, "the tick's number"},
                            {offsetof(TickRecord, input), "the device's reading"},
                            {offsetof(TickRecord, mapped), "the device's pose in the patient"},
                            {offsetof(TickRecord, proxy), "the tool's pose"},
                            {offsetof(TickRecord, wrench), "the force"},
                            {offsetof(TickRecord, output), "what the device was sent"},
                            {offsetof(TickRecord, thrust), "the contact"},
                            {offsetof(TickRecord, maskState), "the state of the mask"},
                            {offsetof(TickRecord, contacts), "contacts, faults or drill"}};
  const auto* bytesOfA = reinterpret_cast<const unsigned char*>(&a);
  const auto* bytesOfB = reinterpret_cast<const unsigned char*>(&b);
  const char* name = "";
  for (std::size_t n = 0; n < sizeof(TickRecord); ++n)
  {
    if (bytesOfA[n] == bytesOfB[n])
      continue;
    for (const Part& part : parts)
      if (part.begin <= n)
        name = part.name;
    break;
  }
  return name;
}

} // namespace petrous::session
