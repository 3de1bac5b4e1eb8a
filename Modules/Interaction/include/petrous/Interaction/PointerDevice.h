#pragma once

#include <cstdint>

#include "petrous/Core/SnapshotBuffer.h"
#include "petrous/Haptics/Device.h"
#include "petrous/Simulation/TickRecord.h"

namespace petrous::interaction
{

/// A hand made of pointer and keys, for a surgeon without hardware. It senses place and heading and
/// gives no force.
///
/// The window says where the tool shall be, in the patient; the servo reads that as the pose of a
/// device whose axes are the patient's (parameters as PointerToolController::apply sets them: camera 1, scale
/// 1) and whose origin is `center`. A mouse that rests is no stale device: each reading is of
/// `now`. Between the window's words, some 60 a second, the hand glides, never faster than
/// `Limits`, so that no leap of the pointer is one of the hand (haptics::DeviceGuard).
///
/// The servo may take the tool up anew where it is (clutch, tissue that came back, a stall); `see`
/// learns that from its records, so that the tool comes back under the pointer.
///
/// `read` and `send` belong to the servo's thread, all else to one other thread. `read` neither
/// locks, allocates nor throws.
class PointerDevice final : public haptics::Device
{
public:
  static constexpr std::uint32_t kDrill = 1;  ///< button that drills
  static constexpr std::uint32_t kFreeze = 2; ///< button that holds the tool still (clutch)

  struct Limits
  {
    double speed = 500.0;       ///< mm/s, in (0, 4000]
    double angularSpeed = 10.0; ///< rad/s, in (0, 50]
    double settle = 0.01;       ///< s in which two thirds of a short way are made, in (0, 1]
    double silence = 0.5; ///< s without a word from the window: it hangs, and buttons are released
  };

  /// center  mm, patient: the one of simulation::ServoSetup
  /// Throws InvalidParameter naming the first bad value.
  PointerDevice(const Eigen::Vector3d& center, const Limits& limits);
  explicit PointerDevice(const Eigen::Vector3d& center = Eigen::Vector3d::Zero())
    : PointerDevice(center, Limits())
  {
  }

  /// Where the tool shall be, X_PT. Until the first call there is no hand (NotReady).
  /// Throws InvalidParameter when it is not finite.
  void want(const haptics::Pose& tool);

  void setButtons(std::uint32_t held) noexcept;
  void setPedal(double pressure) noexcept; ///< 0 to 1

  /// The servo's latest record; to be called with each frame, also as a sign of life. True when
  /// the servo has taken the tool up anew since the last call: see PointerToolController::see.
  bool see(const simulation::TickRecord& record) noexcept;

  const haptics::DeviceDescription& description() const noexcept override { return m_description; }
  haptics::DeviceReading read(double now) noexcept override;
  void send(const haptics::Wrench&) noexcept override {}

private:
  struct Word
  {
    simulation::PoseValues pose; // X_DT
    double pedal = 0.0;
    std::uint32_t buttons = 0;
    std::uint32_t ready = 0;
  };
  void say() noexcept;
  void glide(double dt) noexcept;

  haptics::DeviceDescription m_description;
  Limits m_limits;
  core::SnapshotBuffer<Word> m_word;

  // The window's: what the servo makes of a device's pose d is X_PT = (d.p + offset, d.q * turn).
  Word m_next;
  haptics::Pose m_wanted; // X_PT
  Eigen::Vector3d m_offset;
  Eigen::Quaterniond m_turn = Eigen::Quaterniond::Identity();

  // The servo's.
  Word m_heard;
  haptics::Pose m_pose; // X_DT
  std::uint64_t m_count = 0;
  double m_heardAt = 0.0; // s
  double m_time = 0.0;    // s
  bool m_placed = false;
};

} // namespace petrous::interaction
