#pragma once

#include <cstdint>
#include <optional>

#include "petrous/Core/CameraPose.h"
#include "petrous/Haptics/Pose.h"
#include "petrous/Interaction/PickRay.h"
#include "petrous/Session/TickRecord.h"

namespace petrous::interaction
{

/// How a pointer on the screen controls a tool in space.
struct AimSettings
{
  enum class Mode : std::uint8_t
  {
    Surface, ///< the tool follows the tissue under the pointer; pressed with constant thrust
    Depth    ///< the wheel moves the tool along the line of sight; the coupling presses it
  };
  Mode mode = Mode::Surface;

  static constexpr double kMaxTilt = 80.0; ///< degrees
  /// Angle between shaft and line of sight, degrees, in [0, kMaxTilt]. At 20 the default handpiece
  /// (6 mm, from 30 mm on) does not occlude the largest burr of 7 mm: 30 sin 20 - 6 cos 20 = 4.6
  /// > 3.5 mm; with a larger angle the shaft would touch the rim of a narrow cavity earlier.
  double tilt = 20.0;
  double turn =
      -40.0; ///< degrees on the screen from right (0) to up (90): a right hand, from below

  double depthStep = 0.25;   ///< mm per notch or key, in (0, 10]; over half a typical CT voxel
  double nudgeStep = 0.25;   ///< mm per key, in (0, 10]
  double fineFraction = 0.2; ///< fraction of a step while Shift is held, in (0, 1]
  double maxLead = 5.0; ///< mm that the wanted position leads the tool, in (0, 50]; limits force

  /// Depth change in mm of the tissue under a pressed pointer, deeper or higher than where it was
  /// last pressed, in (0, 100]. Beyond it the tissue counts as another surface, over an edge of
  /// bone or through a wall, and the tool lifts. maxFall exceeds the width of an air cell. maxRise
  /// is the distance at which the servo would place the tool anew (session::Servo::kFarthest);
  /// the tool is not pulled up a wall.
  double maxFall = 5.0;
  double maxRise = 10.0;

  double burrRadius = 2.0;     ///< mm, in (0, 10]
  double beyond = 0.0;         ///< mm that a pressed tool without a ball may go in, in [0, 10]
  double lift = 1.0;           ///< mm above the surface while not pressed, in [0, 20]
  double thrust = 1.0;         ///< N, constant thrust, in [0, 20]
  double approachSpeed = 50.0; ///< mm/s, in (0, 1000]
};

/// Computes the tool's wanted pose and the servo parameters from the pointer's pick ray, wheel and
/// keys. Pure: no window, no clock.
///
/// Surface mode: while not pressed, the burr hovers in front of the tissue under the pointer;
/// pressed, the servo moves it along the line of sight against the tissue (ConstantThrust). Where
/// the ray meets no tissue the tool keeps its last depth, without thrust. If the depth of the
/// tissue under a pressed pointer jumps (maxFall, maxRise), the tool lifts from where it was last
/// pressed, and neither presses nor cuts until the pointer returns to that depth or is pressed
/// again.
///
/// Depth mode: the depth is a plane through the tool, parallel to the screen; the first position is
/// in front of the tissue, or in the plane of the focal point. Moving the camera does not move the
/// tool; the next `point` does.
class PointerToolController
{
public:
  enum class Press : std::uint8_t
  {
    None,
    Touch, ///< pressed without the drill
    Drill
  };

  /// Throws InvalidParameter naming the first invalid value.
  explicit PointerToolController(TissueQuery surface, const AimSettings& settings = {});

  const AimSettings& settings() const noexcept { return m_settings; }
  void setSettings(const AimSettings& settings); ///< throws InvalidParameter
  void setSurface(TissueQuery surface);          ///< of another case; throws InvalidParameter

  /// Throws InvalidParameter if the camera has no viewing direction.
  void setCamera(const core::CameraPose& camera);

  /// Starts with a new tool: no wanted pose until the next ray; in depth mode the depth then starts
  /// in front of the tissue.
  void begin();

  /// Goes on with another tool: under the last ray, and in depth mode where the last tool was.
  void resume();

  void point(const PickRay& line);
  void update(); ///< repeats the last ray, after a change of tissue or settings

  void press(Press press);
  Press pressed() const noexcept { return m_press; }

  void wheel(double notches, bool fine); ///< > 0 deeper; Mode::Depth only
  void nudge(double rightward, double upward,
             bool fine); ///< screen steps, added to the ray
  void tiltBy(double degrees);
  void turnBy(double degrees);
  void home(); ///< resets the nudge; tilt and turn stay

  /// Takes the servo's latest record. takenUp: result of PointerDevice::see; resets the depth to
  /// the tool's.
  void see(const session::TickRecord& record, bool takenUp);

  /// X_PT; nullopt before the first ray.
  const std::optional<haptics::Pose>& wanted() const noexcept { return m_wanted; }
  bool meetsTissue() const noexcept { return m_meets; } ///< result of the last query
  bool lifted() const noexcept { return m_lifted; }     ///< pressed, but lifted: the depth jumped
  std::uint32_t buttons() const noexcept;               ///< for PointerDevice

  /// Sets camera, scale, approach, thrust and the button masks, and pauses while the tool is
  /// lifted, because a pedal may drill as well; other parameters are kept.
  void apply(session::ServoParameters& parameters) const;

private:
  PickRay shifted() const;
  Eigen::Vector3d atDepth(const PickRay& line) const;
  Eigen::Vector3d onSurface(const PickRay& line, double hit);
  Eigen::Quaterniond heading(const PickRay& line) const;

  TissueQuery m_surface;
  AimSettings m_settings;
  Eigen::Quaterniond m_screen = Eigen::Quaterniond::Identity(); // right, up, back in patient axes
  Eigen::Vector3d m_focal{0.0, 0.0, 0.0};
  std::optional<PickRay> m_line;
  Eigen::Vector2d m_nudge{0.0, 0.0}; // mm right, up
  std::optional<Eigen::Vector3d> m_place;
  std::optional<Eigen::Vector3d> m_tool; // from the last record
  std::optional<haptics::Pose> m_wanted;
  std::optional<Eigen::Vector3d> m_pressedAt; // last pressed position, no deeper than the tool went
  double m_sank = 0.0;                        // mm by which the tool went deeper since
  Press m_press = Press::None;
  bool m_meets = false;
  bool m_lifted = false;
};

} // namespace petrous::interaction
