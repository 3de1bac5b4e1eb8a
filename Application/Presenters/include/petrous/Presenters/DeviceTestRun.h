#pragma once

#include <functional>
#include <string>

#include "petrous/Devices/DeviceCheck.h"

namespace petrous::devices
{
class ServedDevice;
}

namespace petrous::presenters
{

/// What the user does at this stage of the test, one sentence without a full stop.
std::string deviceTestAdvice(const devices::DeviceCheck& check);

/// Tests a device that nothing else reads, a tick a millisecond, to the end of the check.
/// `report` comes at the beginning of each stage and about ten times a second; where it throws, the
/// test ends. The device has no force afterwards.
devices::DeviceCheck::Result
testDevice(devices::ServedDevice& device, const devices::DeviceCheck::Options& options,
           const std::function<void(const devices::DeviceCheck&)>& report);

} // namespace petrous::presenters
