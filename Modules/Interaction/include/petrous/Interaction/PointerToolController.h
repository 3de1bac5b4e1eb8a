#pragma once

#include <cstdint>
#include <optional>

#include "petrous/Core/CameraPose.h"
#include "petrous/Haptics/Pose.h"
#include "petrous/Interaction/PickRay.h"
#include "petrous/Simulation/TickRecord.h"

namespace petrous::interaction
{

/// How a pointer on a screen leads a tool in space.
struct AimSettings
{
  enum class Mode : std::uint8_t
  {
    Surface, ///< the tool keeps to the tissue under the pointer; pressed there by constant thrust
    Depth    ///< the wheel moves the tool along the line of sight; the coupling presses it
  };
  Mode mode = Mode::Surface;

  /// Degrees of the shaft from the line to the eye, in [0, 80]. At 20 the usual handpiece (6 mm,
  /// from 30 mm on) leaves the largest burr of 7 mm in sight: 30 sin 20 - 6 cos 20 = 4.6 > 3.5 mm;
  /// more would bring the shaft to the rim of a narrow cavity earlier.
  double tilt = 20.0;
  double turn =
      -40.0; ///< degrees on the screen from right (0) to up (90): a right hand, from below

  double depthStep = 0.25; ///< mm a notch or key, in (0, 10]: a good half of a CT's usual voxel
  double nudgeStep = 0.25; ///< mm a key, in (0, 10]
  double fineOccupancy = 0.2;  ///< of a step while Shift is held, in (0, 1]
  double maxLead = 5.0;   ///< mm that the wanted place goes beyond the tool, in (0, 50]: bounds N

  /// mm that the tissue under a pressed pointer may lie deeper, or higher, than where it was
  /// pressed last, in (0, 100]: beyond that it is another surface, over an edge of bone or through
  /// a wall, and the tool lifts. Deeper: more than an air cell is wide. Higher: where it would have
  /// to be placed anew (simulation::Servo::kFarthest), and not pulled up a wall.
  double maxFall = 5.0;
  double maxRise = 10.0;

  double burrRadius = 2.0;     ///< mm, in (0, 10]
  double lift = 1.0;           ///< mm above the surface while nothing is pressed, in [0, 20]
  double thrust = 1.0;         ///< N, constant thrust, in [0, 20]
  double approachSpeed = 50.0; ///< mm/s, in (0, 1000]
};

/// From the pointer's line of sight, wheel and keys to the tool's wanted pose and what the servo
/// must know of it. Pure: no window, no clock.
///
/// On the surface: while nothing is pressed the burr hovers before the tissue under the pointer;
/// pressed, the servo leads it along the line of sight against the tissue (ConstantThrust). Where
/// the line meets nothing the tool keeps its last depth, and no thrust is given. Where the tissue
/// under a pressed pointer leaps in depth (maxFall, maxRise) the tool lifts from where it was
/// pressed last, and neither presses nor cuts, until the pointer is back at that depth or is
/// pressed anew.
///
/// A depth is a plane through the tool, parallel to the screen; the first place is before the
/// tissue, or in the focal point's plane. A camera that moves does not move the tool: the next
/// `point` does.
class PointerToolController
{
public:
  enum class Press : std::uint8_t
  {
    None,
    Touch, ///< pressed without the drill
    Drill
  };

  /// Throws InvalidParameter naming the first bad value.
  explicit PointerToolController(TissueQuery surface, const AimSettings& settings = {});

  const AimSettings& settings() const noexcept { return m_settings; }
  void setSettings(const AimSettings& settings); ///< throws InvalidParameter
  void setSurface(TissueQuery surface);          ///< of another case; throws InvalidParameter

  /// Throws InvalidParameter when it looks nowhere.
  void setCamera(const core::CameraPose& camera);

  /// A tool is taken up: nothing is wanted until the next line, and a depth begins there, before
  /// the tissue.
  void begin();

  void point(const PickRay& line);
  void update(); ///< again by the same line: tissue gives way, settings change

  void press(Press press);
  Press pressed() const noexcept { return m_press; }

  void wheel(double notches, bool fine); ///< > 0 deeper; Mode::Depth only
  void nudge(double rightward, double upward,
             bool fine); ///< steps on the screen, added to the line
  void tiltBy(double degrees);
  void turnBy(double degrees);
  void home(); ///< no nudge; the heading of the settings stays

  /// The servo's latest record. takenUp: PointerDevice::see said so; the depth is the tool's then.
  void see(const simulation::TickRecord& record, bool takenUp);

  /// X_PT; nothing before the first line.
  const std::optional<haptics::Pose>& wanted() const noexcept { return m_wanted; }
  bool meetsTissue() const noexcept { return m_meets; } ///< the line, at the last look
  bool lifted() const noexcept { return m_lifted; }     ///< pressed, and lifted: the depth leapt
  std::uint32_t buttons() const noexcept;               ///< for PointerDevice

  /// Camera, scale, approach, thrust and the buttons' meaning, and a pause where the tool is
  /// lifted, since a pedal may drill, too; the rest stays.
  void apply(simulation::ServoParameters& parameters) const;

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
  std::optional<Eigen::Vector3d> m_tool; // of the last record
  std::optional<haptics::Pose> m_wanted;
  std::optional<Eigen::Vector3d> m_pressedAt; // pressed on last, no deeper than the tool went
  double m_sank = 0.0;                        // mm that the tool went deeper since
  Press m_press = Press::None;
  bool m_meets = false;
  bool m_lifted = false;
};

} // namespace petrous::interaction
