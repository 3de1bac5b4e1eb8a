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

/// Looks after one server from a thread of its own, 100 times a second: starts it, beats for
/// Petrous, reads its description, and notices when it ends, hangs or is of the wrong version.
class ServerWatch
{
public:
  enum class Link : std::uint32_t
  {
    Starting,
    Up,     ///< has described itself; its state says the rest
    Gone,   ///< no process
    Hung,   ///< does not beat
    Refused ///< other version, or a description that there cannot be
  };

  /// Makes the block and starts the thread.
  explicit ServerWatch(const ServedDevice::Options& options);

  /// Ends the server.
  ~ServerWatch();

  /// Waits for the server's first description; throws ServerError.
  haptics::DeviceDescription awaitReady();

  ServedDevice::Status status() const;

  // For the servo's thread: atomics only.
  Link link() const noexcept { return m_link.load(std::memory_order_acquire); }
  /// Another number for each start of a server.
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

  // Of the watching thread.
  ServerProcess m_process;
  std::uint64_t m_beat = 0;
  double m_silence = 0.0;    // s since the last beat
  double m_sinceBegin = 0.0; // s since the start of this server
  double m_untilStart = 0.0; // s
  int m_failures = 0;        // since it last ran for long
  bool m_accepted = false;   // this server's description

  mutable std::mutex m_mutex; // for what follows; never taken by the servo's thread
  std::condition_variable m_wake;
  bool m_stop = false;
  std::optional<haptics::DeviceDescription> m_description;
  std::optional<Reason> m_reason;
  ServedDevice::Status m_status;

  std::thread m_thread;
};

} // namespace petrous::devices
