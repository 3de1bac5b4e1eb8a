#pragma once

#include <atomic>
#include <functional>
#include <mutex>
#include <string>
#include <thread>

#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>

#include "Eventually.h"
#include "petrous/Devices/DeviceServerExchange.h"

namespace petrous::devices::testing
{

/// A device server on a thread of the test, which can imitate any broken one.
class FakeServer
{
public:
  /// `describe` is called on the block before its state becomes ready.
  explicit FakeServer(const std::string& name,
                      std::function<void(petrous_device_block&)> describe = {},
                      std::uint32_t version = PETROUS_DEVICE_VERSION)
    : m_path("/petrous-device-" + name)
    , m_thread([this, describe, version] { serve(describe, version); })
  {
  }

  ~FakeServer()
  {
    m_done = true;
    m_thread.join();
    if (m_block)
      ::munmap(m_block, sizeof(petrous_device_block));
  }

  /// The pose sent from now on, at 1 kHz.
  void setPose(const petrous_device_pose& pose)
  {
    const std::lock_guard<std::mutex> lock(m_mutex);
    m_pose = pose;
  }

  /// Stops or resumes poses and heartbeats.
  void setSilent(bool silent) { m_silent = silent; }

  void say(std::uint32_t state, const char* error)
  {
    petrous_device_block& block = *m_block;
    petrous_device_text(block.error, sizeof block.error, error);
    __atomic_store_n(&block.server_state, state, __ATOMIC_RELEASE);
  }

  petrous_device_wrench wrench() const
  {
    petrous_device_wrench wrench{};
    const petrous_device_block& block = *m_block;
    petrous_device_get(&block.wrench_sequence, block.wrench, &wrench);
    return wrench;
  }

  static petrous_device_pose poseAt(double x, double y, double z)
  {
    petrous_device_pose pose{};
    pose.position[0] = x;
    pose.position[1] = y;
    pose.position[2] = z;
    pose.rotation[0] = 1.0;
    return pose;
  }

private:
  bool open()
  {
    const int file = ::shm_open(m_path.c_str(), O_RDWR, 0);
    if (file < 0)
      return false;
    const bool whole = ::lseek(file, 0, SEEK_END) >= off_t{sizeof(petrous_device_block)};
    void* memory = whole ? ::mmap(nullptr, sizeof(petrous_device_block), PROT_READ | PROT_WRITE,
                                  MAP_SHARED, file, 0)
                         : MAP_FAILED;
    ::close(file);
    if (memory == MAP_FAILED)
      return false;
    auto* block = static_cast<petrous_device_block*>(memory);
    m_block = block;
    return __atomic_load_n(&block->magic, __ATOMIC_ACQUIRE) == PETROUS_DEVICE_MAGIC;
  }

  void serve(const std::function<void(petrous_device_block&)>& describe, std::uint32_t version)
  {
    if (!eventually([this] { return m_done || open(); }) || !m_block)
      return;
    petrous_device_block& block = *m_block;
    __atomic_store_n(&block.server_version, version, __ATOMIC_RELEASE);
    __atomic_store_n(&block.server_pid, static_cast<std::uint32_t>(::getpid()), __ATOMIC_RELEASE);
    petrous_device_text(block.name, sizeof block.name, "Fake");
    block.flags = PETROUS_GIVES_FORCE;
    block.max_force = 3.0;
    if (describe)
      describe(block);
    __atomic_store_n(&block.server_state, std::uint32_t{PETROUS_SERVER_READY}, __ATOMIC_RELEASE);
    while (!m_done)
    {
      if (!m_silent)
      {
        const std::lock_guard<std::mutex> lock(m_mutex);
        petrous_device_put(&block.pose_sequence, block.pose, &m_pose);
        __atomic_add_fetch(&block.server_beat, 1, __ATOMIC_RELEASE);
      }
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
  }

  std::string m_path;
  std::atomic<petrous_device_block*> m_block{nullptr};
  std::atomic<bool> m_done{false};
  std::atomic<bool> m_silent{false};
  mutable std::mutex m_mutex;
  petrous_device_pose m_pose = poseAt(0.0, 0.0, 0.0);
  std::thread m_thread;
};

} // namespace petrous::devices::testing
