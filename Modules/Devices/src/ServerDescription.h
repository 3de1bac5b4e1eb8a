#pragma once

#include <string>

#include "petrous/Devices/DeviceServerProtocol.h"
#include "petrous/Haptics/Device.h"

namespace petrous::devices
{

/// A text field of the block as one printable line, for any content.
std::string serverText(const char* field, std::size_t size);

/// The server's description of its device. `fault` is empty, or the reason why it is impossible.
haptics::DeviceDescription serverDescription(const petrous_device_block& block, std::string& fault);

bool same(const haptics::DeviceDescription& a, const haptics::DeviceDescription& b);

} // namespace petrous::devices
