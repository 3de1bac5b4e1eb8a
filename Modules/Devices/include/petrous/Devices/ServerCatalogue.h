#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace petrous::devices
{

/// A device server that is installed here: its program, and its name as ServedDevice takes it.
struct FoundServer
{
  std::string name;
  std::filesystem::path program; ///< absolute
};

/// The programs in these folders that may be executed and whose name a device server can have
/// (letters, digits, '.', '-', '_'; at most 48), by name; of two with one name the first folder's.
/// "petrous-device-touch" is called "touch". A folder that is not there has none. Starts nothing.
std::vector<FoundServer> findServers(const std::vector<std::filesystem::path>& folders);

/// Where the servers of this machine are: the folders of $PETROUS_DEVICE_SERVERS (separated by
/// ':') if it is set, otherwise petrous/devices in the user's data, and then in /usr/local/lib and
/// /usr/lib.
std::vector<std::filesystem::path> serverFolders();

} // namespace petrous::devices
