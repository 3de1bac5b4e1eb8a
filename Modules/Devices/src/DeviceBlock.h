#pragma once

#include <string>

#include "petrous/Devices/DeviceServerProtocol.h"

namespace petrous::devices
{

/// The shared memory of one device server, made, mapped and in the end removed by us. It stays
/// mapped at one place while the servers behind it come and go, so that the servo's thread never
/// meets memory that has gone. A lock on the file tells a block in use from one left by a crash.
class DeviceBlock
{
public:
  /// Throws InvalidParameter for a bad name; ServerError when the block is in use or cannot be
  /// made.
  explicit DeviceBlock(const std::string& name);
  ~DeviceBlock();
  DeviceBlock(const DeviceBlock&) = delete;
  DeviceBlock& operator=(const DeviceBlock&) = delete;

  /// What shm_open takes: "/petrous-device-NAME".
  const std::string& path() const noexcept { return m_path; }

  petrous_device_block* operator->() const noexcept { return m_block; }
  petrous_device_block& operator*() const noexcept { return *m_block; }

  /// Clears what the last server said; only while there is none.
  void forgetServer() noexcept;

private:
  void removeLeftover(const std::string& name);

  std::string m_path;
  int m_file = -1;
  petrous_device_block* m_block = nullptr;
};

} // namespace petrous::devices
