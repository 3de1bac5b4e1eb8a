#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <cstdlib>
#include <new>
#include <string>
#include <thread>

#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>

namespace petrous::devices::testing
{

/// A vendor's device that is not there, in a file that a test and the stand-in of the vendor's SDK,
/// in the server's process, both map. Positions and forces are in the SDK's own units and axes.
struct StandInDevice
{
  static constexpr const char* kVariable = "PETROUS_STANDIN_DEVICE"; ///< names the file

  // Set by the test.
  std::atomic<double> position[3];
  std::atomic<double> rotation[9]; ///< row-major; of a grip: quaternion w, x, y, z in the first 4
  std::atomic<std::uint32_t> buttons;
  std::atomic<int> plugged;
  std::atomic<int> powered;
  std::atomic<int> calibrated;
  std::atomic<int> forceOff; ///< cause, by the SDK's numbers; 0: forces are allowed
  std::atomic<int> error;    ///< of the next call that can report one, by the SDK's numbers
  std::atomic<int> stall;    ///< ms that each reading takes
  std::atomic<int> format;   ///< of a service's messages: 31 or 35
  std::atomic<int> serial;   ///< number; 0: none is told
  std::atomic<int> another;  ///< a second device, elsewhere, is listed first
  std::atomic<int> untold;   ///< bits of a service's status that it leaves out: 1 calibrated,
                             ///< 2 powered, 4 ready; 8: all of it

  // Seen by the stand-in.
  std::atomic<double> force[3];
  std::atomic<double> torque[3];
  std::atomic<std::uint64_t> commands; ///< forces that were set
  std::atomic<int> opened;             ///< times
  std::atomic<int> closed;             ///< times
  std::atomic<int> enabled;            ///< forces, by the program
  std::atomic<int> gravity;            ///< compensation is on
  std::atomic<int> watchdog;           ///< as set
  std::atomic<int> piled;              ///< messages that came before the last was answered
  std::atomic<int> port;               ///< of a service

  void place(double x, double y, double z)
  {
    position[0] = x;
    position[1] = y;
    position[2] = z;
  }

  void reset()
  {
    place(0.0, 0.0, 0.0);
    for (int i = 0; i < 9; ++i)
      rotation[i] = i % 4 == 0 ? 1.0 : 0.0;
    plugged = powered = calibrated = 1;
    format = 35;
  }

  /// Sleeps as long as a reading of the stalled SDK takes.
  void wait() const
  {
    if (const int milliseconds = stall; milliseconds > 0)
      std::this_thread::sleep_for(std::chrono::milliseconds(milliseconds));
  }
};

static_assert(std::atomic<double>::is_always_lock_free);

/// The mapped file; `create` resets it.
inline StandInDevice* mapStandIn(const std::string& path, bool create)
{
  const int file = ::open(path.c_str(), O_RDWR | O_CLOEXEC | (create ? O_CREAT : 0), 0600);
  if (file < 0 || (create && ::ftruncate(file, sizeof(StandInDevice)) != 0))
    std::abort();
  void* memory =
      ::mmap(nullptr, sizeof(StandInDevice), PROT_READ | PROT_WRITE, MAP_SHARED, file, 0);
  ::close(file);
  if (memory == MAP_FAILED)
    std::abort();
  auto* device = static_cast<StandInDevice*>(memory);
  if (create)
    (new (memory) StandInDevice{})->reset();
  return device;
}

/// In the server's process.
inline StandInDevice& standIn()
{
  static StandInDevice* const kDevice = mapStandIn(std::getenv(StandInDevice::kVariable), false);
  return *kDevice;
}

} // namespace petrous::devices::testing
