#pragma once

#include <string>

#include <unistd.h>

#include "Eventually.h"
#include "petrous/Devices/ServedDevice.h"

namespace petrous::devices::testing
{

/// Options with a name that is unique to this test run.
inline ServedDevice::Options optionsFor(const std::string& name)
{
  ServedDevice::Options options;
  options.name = "test-" + name + "-" + std::to_string(::getpid());
  return options;
}

inline ServedDevice::Options exampleFor(const std::string& name)
{
  ServedDevice::Options options = optionsFor(name);
  options.command = {PETROUS_EXAMPLE_SERVER, "--compliance", "1.0"};
  return options;
}

inline haptics::DeviceHealth healthOf(ServedDevice& device)
{
  return device.read(steadySeconds()).health;
}

inline bool becomes(ServedDevice& device, haptics::DeviceHealth health)
{
  return eventually([&] { return healthOf(device) == health; });
}

} // namespace petrous::devices::testing
