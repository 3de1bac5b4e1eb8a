#pragma once

#include <string>

#include "petrous/Devices/DeviceServerProtocol.h"

namespace petrous::devices
{

/// Shared memory of one device server, created, mapped and finally removed by Petrous. It stays
/// mapped at the same address while servers come and go, so that the servo thread never accesses
/// unmapped memory. A file lock distinguishes a block in use from one left by a crash.
class DeviceBlock
{
public:
  /// Throws InvalidParameter for an invalid name; ServerError if the block is in use or cannot be
  /// created.
  explicit DeviceBlock(const std::string& name);
  ~DeviceBlock();
  DeviceBlock(const DeviceBlock&) = delete;
  DeviceBlock& operator=(const DeviceBlock&) = delete;

  /// Name for shm_open: "/petrous-device-NAME".
  const std::string& path() const noexcept { return m_path; }

  petrous_device_block* operator->() const noexcept { return m_block; }
  petrous_device_block& operator*() const noexcept { return *m_block; }

  /// Clears the fields of the last server; only while there is none.
  void forgetServer() noexcept;

private:
  void removeLeftover(const std::string& name);

  std::string m_path;
  int m_file = -1;
  petrous_device_block* m_block = nullptr;
};

} // namespace petrous::devices
