#pragma once

#include <cstdint>

#include "petrous/Core/SnapshotBuffer.h"
#include "petrous/Haptics/Device.h"
#include "petrous/Session/TickRecord.h"

namespace petrous::interaction
{

/// A haptic device emulated by mouse and keyboard, for use without hardware. It senses position and
/// orientation and renders no force.
///
/// The window sets the wanted pose of the tool in the patient; the servo reads it as the pose of a
/// device whose axes are the patient's (parameters as set by PointerToolController::apply: camera
/// 1, scale 1) and whose origin is `center`. A mouse at rest does not make the device stale: each
/// reading's time is `now`. Between the window's updates, about 60 per second, the pose moves
/// smoothly and never faster than `Limits`, so that a jump of the pointer is not a jump of the
/// device (haptics::DeviceGuard). A drill that is pressed before the pose has arrived is reported
/// when it has, since it must not drill on the way. A window that is silent for longer than
/// `Limits::silence`, as during a slow frame, makes the device stale: from then on nothing is
/// drilled, and with the drill still held the stroke goes on afterwards (DissectionLoop).
///
/// The servo may re-anchor the tool where it is (clutch, restored tissue, a stall); `see` detects
/// this from its records, so that the tool returns under the pointer.
///
/// `read` and `send` are called by the servo thread, everything else by one other thread. `read`
/// does not lock, allocate or throw.
class PointerDevice final : public haptics::Device
{
public:
  static constexpr std::uint32_t kDrill = 1;  ///< button that drills
  static constexpr std::uint32_t kFreeze = 2; ///< button that holds the tool still (clutch)

  struct Limits
  {
    double speed = 500.0;       ///< mm/s, in (0, 4000]
    double angularSpeed = 10.0; ///< rad/s, in (0, 50]
    double settle = 0.01;       ///< s, time constant of the approach to the wanted pose, in (0, 1]
    double silence = 0.5; ///< s without an update from the window, after which the device is stale
  };

  /// center  mm, patient; as in session::ServoSetup
  /// Throws InvalidParameter naming the first invalid value.
  PointerDevice(const Eigen::Vector3d& center, const Limits& limits);
  explicit PointerDevice(const Eigen::Vector3d& center = Eigen::Vector3d::Zero())
    : PointerDevice(center, Limits())
  {
  }

  /// Sets the wanted pose of the tool, X_PT. Before the first call the device is NotReady. Throws
  /// InvalidParameter if the pose is not finite.
  void want(const haptics::Pose& tool);

  void setButtons(std::uint32_t held) noexcept;

  /// Takes the servo's latest record; call it once per frame, also as a sign of life. Returns true
  /// if the servo re-anchored the tool since the last call: see PointerToolController::see.
  bool see(const session::TickRecord& record) noexcept;

  const haptics::DeviceDescription& description() const noexcept override { return m_description; }
  haptics::DeviceReading read(double now) noexcept override;
  void send(const haptics::Wrench&) noexcept override {}

private:
  struct Word
  {
    session::PoseValues pose; // X_DT
    std::uint32_t buttons = 0;
    std::uint32_t ready = 0;
  };
  void say() noexcept;
  void glide(double dt) noexcept;
  std::uint32_t buttonsNow(double now) noexcept;

  haptics::DeviceDescription m_description;
  Limits m_limits;
  core::SnapshotBuffer<Word> m_word;

  // Window's thread. The servo maps a device pose d to X_PT = (d.p + offset, d.q * turn).
  Word m_next;
  haptics::Pose m_wanted; // X_PT
  Eigen::Vector3d m_offset;
  Eigen::Quaterniond m_turn = Eigen::Quaterniond::Identity();

  // Servo thread.
  Word m_heard;
  haptics::Pose m_pose; // X_DT
  std::uint64_t m_count = 0;
  double m_heardAt = 0.0; // s
  double m_time = 0.0;    // s
  double m_due = 0.0;     // s, until when it has arrived if the pointer rests
  bool m_placed = false;
  bool m_pressed = false; // the drill is held
  bool m_arrived = false; // since it is, at the wanted pose
};

} // namespace petrous::interaction
