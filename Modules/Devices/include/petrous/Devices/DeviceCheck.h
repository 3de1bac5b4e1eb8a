#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "petrous/Haptics/Device.h"

namespace petrous::devices
{

/// Examines a haptic device tick by tick: workspace and rate while the user moves the handle, then,
/// with the handle held lightly and once it rests, a step of force along each axis and, along those
/// axes that followed it, a spring of rising stiffness that ends at the first sign of a limit
/// cycle. A handle that moves against its step ends the check at once.
///
/// Spring of one axis, at stiffness k, for a level of 0.4 s:
///
///   F_n = -k (x_n - x_0), |F_n| <= forceCap
///
/// x_0    where the handle was when the axis began; again where it was pulled away for 0.1 s
///
/// A tap begins each level in the spring's stead, to be answered by a decaying oscillation: a force
/// that rises by 25 N/s until the handle moved by 0.5 mm, for 60 ms at most. A handle of 0.15 to
/// 0.4 kg then has 40 to 60 mm/s, as a hand that comes onto bone, however much friction its joints
/// have. Friction holds a weaker tap, and hides a limit cycle that a faster motion finds.
///
/// F is high-passed (two poles of 25 Hz). A limit cycle is an oscillation that from 0.12 s on does
/// not decay: in the second half of that time at least 3 changes of sign, 0.05 N, and 0.85 of the
/// first half's amplitude; or the force at its cap both ways; or the handle faster than 500 mm/s at
/// any time, by the readings' own times; or a fault of the device. A stable spring decays faster
/// than that up to about 0.75 of the stability limit. k rises by 15 % a level.
///
/// Not thread-safe; `tick` does not throw.
class DeviceCheck
{
public:
  struct Options
  {
    double readyTime = 30.0;    ///< s to wait for a good reading, > 0
    double workspaceTime = 8.0; ///< s, >= 0.5
    bool force = true;          ///< give forces at all
    double stepForce = 0.5;     ///< N, at most a quarter of the device's maximum; > 0
    double maxStiffness = 10.0; ///< N/mm, the end of the ramp, in [0.1, 20]
  };

  enum class Stage : std::uint8_t
  {
    Ready,     ///< waits for the device
    Workspace, ///< the user moves the handle through all of its workspace
    Rest,      ///< waits until the handle stays within 1 mm for 1 s, before each step
    ForceStep, ///< the user holds it lightly
    Stiffness, ///< likewise
    Done
  };

  struct Axis
  {
    // Step of force along +axis.
    Eigen::Vector3d moved{0.0, 0.0, 0.0}; ///< mm, at its end
    double latency = 0.0;                 ///< s until the handle moved by 0.05 mm; 0: it did not
    bool follows = false;                 ///< it moved mainly along +axis
    // Ramp.
    double stable = 0.0;  ///< N/mm, the largest that was; 0: none
    double limit = 0.0;   ///< N/mm at which a limit cycle began; 0: none up to maxStiffness
    bool faulted = false; ///< the limit is where the device reported a fault
    double hertz = 0.0;   ///< of the limit cycle
  };

  struct Result
  {
    std::string problem; ///< why the check ended early; empty if it did not
    int faults = 0;      ///< that the device reported from the workspace stage on
    Eigen::Vector3d lowest{0.0, 0.0, 0.0};
    Eigen::Vector3d highest{0.0, 0.0, 0.0}; ///< mm, of the workspace
    double turned = 0.0;                    ///< rad, the largest rotation from the first pose
    std::uint32_t buttons = 0;              ///< that were pressed in between
    double pedal = 0.0;                     ///< its greatest pressure
    double rate = 0.0;                      ///< readings per second
    double worstGap = 0.0;                  ///< s between two readings
    std::vector<double> roundTrips;         ///< s, of wrenches, unsorted
    std::array<Axis, 3> axes;
    /// N/mm: half of the smallest `stable`, as the hand that held it damps, too; 0: no forces were
    /// tested, or not on every axis.
    double proposed = 0.0;
  };

  /// Throws InvalidParameter naming the first invalid option.
  DeviceCheck(const haptics::DeviceDescription& description, const Options& options);

  /// The wrench to send. roundTrip: of the latest wrench, s; 0 if unknown.
  haptics::Wrench tick(const haptics::DeviceReading& reading, double now,
                       double roundTrip = 0.0) noexcept;

  Stage stage() const noexcept { return m_stage; }
  int axis() const noexcept { return m_axis; } ///< 0 to 2, of the present step or ramp; 3: none
  double stiffness() const noexcept { return m_stiffness; } ///< N/mm, of the ramp; at present
  double progress() const noexcept;                         ///< 0 to 1, roughly
  const Result& result() const noexcept { return m_result; }

private:
  void enter(Stage stage, int axis, double now) noexcept;
  void nextAxis(double now) noexcept;
  void beginLevel(double now) noexcept;
  void end(const std::string& problem) noexcept;
  void roam(const haptics::DeviceReading& reading, double now) noexcept;
  void fault(double now) noexcept;
  void comeBack(const haptics::DeviceReading& reading, double now) noexcept;
  bool tooFast(const haptics::DeviceReading& reading) noexcept;
  void rest(const Eigen::Vector3d& position, double now) noexcept;
  double step(const haptics::DeviceReading& reading, double now) noexcept;
  double spring(const haptics::DeviceReading& reading, double now) noexcept;
  void judgeLevel(double now) noexcept;

  haptics::DeviceDescription m_description;
  Options m_options;
  double m_stepForce = 0.0;
  double m_forceCap = 0.0;
  Stage m_stage = Stage::Ready;
  Result m_result;

  double m_since = 0.0; ///< s, begin of the stage, axis or level
  bool m_started = false;
  bool m_good = false;        ///< the last reading
  bool m_faulty = false;      ///< likewise
  double m_lastGood = 0.0;    ///< s, or when it became faulty
  double m_lastReading = 0.0; ///< s, time of the last reading
  double m_firstReading = 0.0;
  int m_readings = 0;
  haptics::Pose m_first;
  Eigen::Vector3d m_last{0.0, 0.0, 0.0}; ///< mm, the last position
  double m_lastTime = 0.0;               ///< s

  double m_restSince = 0.0;                 ///< s
  Eigen::Vector3d m_speedAt{0.0, 0.0, 0.0}; ///< mm, where the speed is taken from
  double m_speedTime = 0.0;                 ///< s, likewise
  bool m_wasFast = false;

  int m_axis = 0;
  Eigen::Vector3d m_anchor{0.0, 0.0, 0.0};
  double m_stiffness = 0.0;
  int m_restarts = 0;                    ///< of an axis
  double m_pulledSince = 0.0;            ///< s; 0: not pulled away
  std::array<double, 2> m_low{0.0, 0.0}; ///< states of the two high-passes
  double m_amplitudes[2] = {0.0, 0.0};   ///< N, of the halves
  double m_sign = 0.0;
  int m_changes = 0; ///< of sign in the second half
  bool m_fast = false;
  bool m_tapped = false;                      ///< the tap of this level is over
  double m_tapAt = 0.0;                       ///< mm, where it began
  std::array<bool, 2> m_capped{false, false}; ///< the force was, downward and upward
};

} // namespace petrous::devices
