#pragma once

#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "DeviceBlock.h"
#include "ServerProcess.h"
#include "petrous/Devices/ServedDevice.h"

namespace petrous::devices
{

/// Supervises one server from a thread of its own, at 100 Hz: starts it, sends Petrous' heartbeat,
/// reads its description, and detects when it ends, hangs or is of the wrong version.
class ServerWatch
{
public:
  enum class Link : std::uint32_t
  {
    Starting,
    Up,     ///< has described itself; see its state
    Gone,   ///< no process
    Hung,   ///< no heartbeat
    Refused ///< other version, or an impossible description
  };

  /// Creates the block and starts the thread.
  explicit ServerWatch(const ServedDevice::Options& options);

  /// Ends the server.
  ~ServerWatch();

  /// Waits for the server's first description; throws ServerError.
  haptics::DeviceDescription awaitReady();

  ServedDevice::Status status() const;

  // For the servo thread: atomics only.
  Link link() const noexcept { return m_link.load(std::memory_order_acquire); }
  /// A different number for each start of a server.
  std::uint64_t epoch() const noexcept { return m_epoch.load(std::memory_order_acquire); }
  petrous_device_block& block() noexcept { return *m_block; }

private:
  using Reason = ServerError::Reason;

  void run();
  void look(double elapsed);
  void lookAfterProcess();
  void lookForProcess();
  void lookAtBeat(double elapsed);
  void lookAtState();
  void lookAtStart(const std::string& text);
  void accept();
  void begin();
  void start();
  bool launches() const { return !m_options.command.empty(); }
  bool mayRestart() const;
  void giveUpOn(Link link, Reason reason, const std::string& words);
  void setLink(Link link) noexcept { m_link.store(link, std::memory_order_release); }
  void fail(Reason reason, const std::string& words);
  void clearFault();

  const ServedDevice::Options m_options;
  DeviceBlock m_block;
  std::atomic<Link> m_link{Link::Starting};
  std::atomic<std::uint64_t> m_epoch{0};
  std::atomic<int> m_pid{0};

  // Watch thread only.
  ServerProcess m_process;
  std::uint64_t m_beat = 0;
  double m_silence = 0.0;    // s since the last beat
  double m_sinceBegin = 0.0; // s since the start of this server
  double m_untilStart = 0.0; // s
  int m_failures = 0;        // since it last ran for kSettled
  bool m_accepted = false;   // this server's description was accepted

  mutable std::mutex m_mutex; // for the members below; never taken by the servo thread
  std::condition_variable m_wake;
  bool m_stop = false;
  std::optional<haptics::DeviceDescription> m_description;
  std::optional<Reason> m_reason;
  std::string m_waitsFor; // what a starting server asks the user to do
  ServedDevice::Status m_status;

  std::thread m_thread;
};

} // namespace petrous::devices
