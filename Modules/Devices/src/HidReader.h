#pragma once

#include <atomic>
#include <condition_variable>
#include <cstddef>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <thread>

#include "petrous/Devices/HidLibrary.h"

namespace petrous::devices
{

/// A thread that waits for one kind of HID device, reads it while it is connected, and waits again
/// when it is gone. Devices are therefore hot-pluggable.
class HidReader
{
public:
  /// Called on the reader thread; must not throw.
  struct Calls
  {
    std::function<bool(const HidInterface&)> matches;
    std::function<void(const HidInterface&)> connected;
    std::function<void(const unsigned char* bytes, std::size_t size)> report;
    std::function<void()> disconnected;
  };

  /// what       for messages: "SpaceMouse"
  /// lookEvery  s between two enumerations of connected devices
  HidReader(std::shared_ptr<const HidLibrary> library, std::string what, double lookEvery,
            Calls calls);
  ~HidReader();
  HidReader(const HidReader&) = delete;
  HidReader& operator=(const HidReader&) = delete;

  /// Why no device is read, for display; empty while one is.
  std::string problem() const;

private:
  void run();
  std::unique_ptr<HidLibrary::Connection> connect();
  void read(HidLibrary::Connection& connection);
  void setProblem(const std::string& words);

  const std::shared_ptr<const HidLibrary> m_library;
  const std::string m_what;
  const double m_lookEvery;
  const Calls m_calls;
  std::atomic<bool> m_stop{false};
  mutable std::mutex m_mutex;
  std::condition_variable m_wake;
  std::string m_problem;
  std::thread m_thread;
};

} // namespace petrous::devices
