#pragma once

#include <string>

#include "petrous/Devices/DeviceServerProtocol.h"
#include "petrous/Haptics/Device.h"

namespace petrous::devices
{

/// A text of the block as one printable line, whatever lies there.
std::string serverText(const char* field, std::size_t size);

/// What the server says of its device. Empty `fault`, or why there is no such device.
haptics::DeviceDescription serverDescription(const petrous_device_block& block, std::string& fault);

bool same(const haptics::DeviceDescription& a, const haptics::DeviceDescription& b);

} // namespace petrous::devices
