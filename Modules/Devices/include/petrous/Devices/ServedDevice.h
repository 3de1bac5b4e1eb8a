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
    NotStarted,      ///< no such program, or nobody opened the block in time
    Ended,           ///< crashed, killed or ended by itself
    NotReady,        ///< opened the block, but is not ready in time, or hangs
    NoDevice,        ///< says that its device is unplugged
    Fault,           ///< says that its SDK reports an error
    BadDescription,  ///< describes a device that there cannot be
    VersionMismatch, ///< built for another version of the protocol
    InUse            ///< another Petrous has this server's block
  };
  ServerError(Reason reason, const std::string& message);
  Reason reason() const noexcept { return m_reason; }

private:
  Reason m_reason;
};

/// A vendor's device behind a server, a process of its own that shares memory with this one
/// (DeviceServerProtocol.h, Documentation/device-servers.md). A crash or hang of the vendor's SDK
/// ends or stops the server, not Petrous: the reading's health changes and `status` names it.
class ServedDevice final : public haptics::Device
{
public:
  struct Options
  {
    std::string name;                 ///< letters, digits, '.', '-', '_'; at most 48
    std::vector<std::string> command; ///< program and arguments; the block's name is appended.
                                      ///< Empty: somebody else starts the server
    bool restart = true;              ///< start it again when it has ended or hangs
    double startTimeout = 10.0;       ///< s until it must be ready
    double staleAfter = 0.05;         ///< s without a pose
    double hungAfter = 1.0;           ///< s without a beat of the server
    /// Asked some 20 times a second until the server is ready; false: it is waited for no longer.
    std::function<bool()> wanted;
  };

  struct Status
  {
    std::string fault;     ///< what is wrong now, in words; empty while all is well
    std::string lastFault; ///< the latest that was wrong; stays after it has passed
    int restarts = 0;
    int pid = 0; ///< the server's; 0 while there is none
  };

  /// Counted by the servo's own calls.
  struct Exchange
  {
    std::uint64_t poses = 0;     ///< readings that brought a new pose
    std::uint64_t wrenches = 0;  ///< sent
    std::uint64_t rejected = 0;  ///< poses that no such device can send
    double roundTrip = 0.0;      ///< s, from the latest wrench that came back echoed
    double worstRoundTrip = 0.0; ///< s
  };

  /// Starts the server and waits until it is ready; throws ServerError, or InvalidParameter for a
  /// bad option. Not from the servo's thread.
  explicit ServedDevice(const Options& options);

  /// Asks the server to end, and ends it when it does not within half a second.
  ~ServedDevice() override;

  const haptics::DeviceDescription& description() const noexcept override { return m_description; }

  /// Health: Good; NotReady until the first pose after each start; Stale without a new pose for
  /// `staleAfter`; Disconnected when the server has gone or has no device; Faulty when it hangs,
  /// reports an error, or in the last 0.1 s has sent a pose that is not finite, farther than 2 m
  /// from the origin, or farther from the last one than a hand moves. The pose is the last good
  /// one; it may have jumped when health comes back to Good.
  haptics::DeviceReading read(double now) noexcept override;

  /// A wrench that is not finite is sent as zero, one above the device's limits scaled to them.
  void send(const haptics::Wrench& wrench) noexcept override;

  /// Not from the servo's thread.
  Status status() const;

  /// From the servo's thread.
  const Exchange& exchange() const noexcept { return m_exchange; }

private:
  void takePose(double now) noexcept;
  haptics::DeviceHealth health(double now) const noexcept;

  Options m_options;
  std::unique_ptr<ServerWatch> m_watch;
  haptics::DeviceDescription m_description;

  // What follows belongs to the servo's thread.
  haptics::DeviceReading m_reading;
  haptics::Pose m_lastPose; // also of rejected ones, so that a steady stream is taken up again
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
