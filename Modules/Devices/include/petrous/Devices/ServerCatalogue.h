#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace petrous::devices
{

/// An installed device server: its program, and its name for ServedDevice.
struct FoundServer
{
  std::string name;
  std::filesystem::path program; ///< absolute
};

/// Executable programs in these folders whose name is a valid server name (letters, digits, '.',
/// '-', '_'; at most 48), sorted by name; of two with the same name, the one in the first folder.
/// "petrous-device-touch" is called "touch". A missing folder contains none. Starts nothing.
std::vector<FoundServer> findServers(const std::vector<std::filesystem::path>& folders);

/// Folders of this machine's servers: those in $PETROUS_DEVICE_SERVERS (separated by ':') if set,
/// otherwise petrous/devices in the user's data folder, then in /usr/local/lib and /usr/lib.
std::vector<std::filesystem::path> serverFolders();

} // namespace petrous::devices
