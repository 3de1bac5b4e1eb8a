#include "ServerDescription.h"

#include <cmath>

#include "petrous/Core/NumberText.h"

namespace petrous::devices
{

namespace
{

// Limits for hand-held devices; the strongest on the market give about 40 N and 15 N/mm.
constexpr double kMaxForce = 200.0;          // N
constexpr double kMaxTorque = 20000.0;       // N mm
constexpr double kMaxStiffness = 100.0;      // N/mm
constexpr double kMaxAngularStiffness = 1e6; // N mm/rad

double number(const double& field)
{
  double value = 0.0;
  __atomic_load(&field, &value, __ATOMIC_RELAXED);
  return value;
}

void check(double value, double most, const char* what, const char* unit, std::string& fault)
{
  if (fault.empty() && !(value >= 0.0 && value <= most))
    fault = std::string("describes a device with a ") + what + " of " + core::generalText(value) +
            " " + unit + "; it must lie between 0 and " + core::generalText(most);
}

} // namespace

std::string serverText(const char* field, std::size_t size)
{
  std::string text;
  for (std::size_t i = 0; i < size; ++i)
  {
    const char c = __atomic_load_n(&field[i], __ATOMIC_RELAXED);
    if (c == '\0')
      break;
    const auto byte = static_cast<unsigned char>(c);
    text += byte < 0x20 || byte == 0x7f ? ' ' : c;
  }
  return text;
}

haptics::DeviceDescription serverDescription(const petrous_device_block& block, std::string& fault)
{
  const std::uint32_t flags = __atomic_load_n(&block.flags, __ATOMIC_RELAXED);
  haptics::DeviceDescription description;
  description.name = serverText(block.name, sizeof block.name);
  description.sensesRotation = (flags & PETROUS_SENSES_ROTATION) != 0;
  description.givesForce = (flags & PETROUS_GIVES_FORCE) != 0;
  description.givesTorque = (flags & PETROUS_GIVES_TORQUE) != 0;
  description.maxForce = number(block.max_force);
  description.maxTorque = number(block.max_torque);
  description.maxStiffness = number(block.max_stiffness);
  description.maxAngularStiffness = number(block.max_angular_stiffness);

  fault.clear();
  check(description.maxForce, kMaxForce, "force", "N", fault);
  check(description.maxTorque, kMaxTorque, "torque", "N mm", fault);
  check(description.maxStiffness, kMaxStiffness, "stiffness", "N/mm", fault);
  check(description.maxAngularStiffness, kMaxAngularStiffness, "angular stiffness", "N mm/rad",
        fault);
  return description;
}

bool same(const haptics::DeviceDescription& a, const haptics::DeviceDescription& b)
{
  return a.name == b.name && a.sensesRotation == b.sensesRotation && a.givesForce == b.givesForce &&
         a.givesTorque == b.givesTorque && a.maxForce == b.maxForce && a.maxTorque == b.maxTorque &&
         a.maxStiffness == b.maxStiffness && a.maxAngularStiffness == b.maxAngularStiffness;
}

} // namespace petrous::devices
