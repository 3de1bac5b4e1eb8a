#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "petrous/Core/Error.h"
#include "petrous/Haptics/Device.h"

namespace petrous::devices
{

class ServerWatch;

/// A device server that cannot be used. The message begins "device server 'NAME'".
class ServerError : public core::Error
{
public:
  enum class Reason
  {
    NotStarted,      ///< no such program, or the block was not opened in time
    Ended,           ///< crashed, killed or exited
    NotReady,        ///< opened the block, but is not ready in time, or hangs
    NoDevice,        ///< reports that its device is unplugged
    Fault,           ///< reports an error of its SDK
    BadDescription,  ///< describes an impossible device
    VersionMismatch, ///< built for another version of the protocol
    InUse            ///< another Petrous process uses this server's block
  };
  ServerError(Reason reason, const std::string& message);
  Reason reason() const noexcept { return m_reason; }

private:
  Reason m_reason;
};

/// A vendor's device behind a server, a separate process sharing memory with this one
/// (DeviceServerProtocol.h, Documentation/device-servers.md). A crash or hang of the vendor's SDK
/// ends or stops the server, not Petrous: the reading's health changes and `status` gives the
/// reason.
class ServedDevice final : public haptics::Device
{
public:
  struct Options
  {
    std::string name;                 ///< letters, digits, '.', '-', '_'; at most 48
    std::vector<std::string> command; ///< program and arguments; the block's name is appended.
                                      ///< Empty: the server is started externally
    bool restart = true;              ///< restart it after it ended or hung
    double startTimeout = 10.0;       ///< s until it must be ready
    double staleAfter = 0.05;         ///< s without a pose
    double hungAfter = 1.0;           ///< s without a heartbeat of the server
    /// Polled about 20 times a second until the server is ready; false cancels the wait.
    std::function<bool()> wanted;
    /// Called in the same rhythm, with what the user has to do for a server that waits for it,
    /// such as calibrating the device; then it may take two minutes until the server is ready.
    std::function<void(const std::string&)> waits;
  };

  struct Status
  {
    std::string fault;     ///< current problem, for display; empty if none
    std::string lastFault; ///< most recent problem; kept after it has passed
    int restarts = 0;
    int pid = 0; ///< of the server; 0 if there is none
  };

  /// Updated by the servo's calls.
  struct Exchange
  {
    std::uint64_t poses = 0;     ///< readings with a new pose
    std::uint64_t wrenches = 0;  ///< sent
    std::uint64_t rejected = 0;  ///< implausible poses
    double roundTrip = 0.0;      ///< s, of the latest echoed wrench
    double worstRoundTrip = 0.0; ///< s
  };

  /// Starts the server and waits until it is ready. Throws ServerError, or InvalidParameter for a
  /// bad option. Not from the servo thread.
  explicit ServedDevice(const Options& options);

  /// Asks the server to end, and terminates it if it does not within half a second.
  ~ServedDevice() override;

  const haptics::DeviceDescription& description() const noexcept override { return m_description; }

  /// Health: Good; NotReady until the first pose after each start; Stale without a new pose for
  /// `staleAfter`; Disconnected if the server has ended or has no device; Faulty if it hangs,
  /// reports an error, or in the last 0.1 s sent a pose that is not finite, more than 2 m from the
  /// origin, or farther from the previous one than a hand can move. The pose is the last good one;
  /// it may jump when health returns to Good.
  haptics::DeviceReading read(double now) noexcept override;

  /// A wrench that is not finite is sent as zero; one above the device's limits is scaled to them.
  void send(const haptics::Wrench& wrench) noexcept override;

  /// Not from the servo thread.
  Status status() const;

  /// From the servo thread.
  const Exchange& exchange() const noexcept { return m_exchange; }

private:
  void takePose(double now) noexcept;
  haptics::DeviceHealth health(double now) const noexcept;

  Options m_options;
  std::unique_ptr<ServerWatch> m_watch;
  haptics::DeviceDescription m_description;

  // Servo thread only.
  haptics::DeviceReading m_reading;
  haptics::Pose m_lastPose; // including rejected ones, so that a steady stream is accepted again
  std::uint64_t m_sequence = 0;
  std::uint64_t m_epoch = 0;
  bool m_hasPose = false;
  double m_poseTime = 0.0;
  double m_badUntil = -1.0;
  std::uint64_t m_tick = 0;
  std::uint64_t m_echo = 0;
  std::array<double, 256> m_sendTimes{}; // s of the steady clock, by tick
  Exchange m_exchange;
};

} // namespace petrous::devices
