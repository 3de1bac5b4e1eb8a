#pragma once

#include <functional>
#include <map>
#include <memory>
#include <optional>

#include "petrous/Core/LockedMemory.h"
#include "petrous/Haptics/HapticField.h"
#include "petrous/Haptics/PointShell.h"
#include "petrous/Haptics/Proxy.h"
#include "petrous/Presenters/CaseRemoval.h"
#include "petrous/Presenters/DrillSession.h"
#include "petrous/Simulation/DissectionLoop.h"
#include "petrous/Simulation/Recording.h"
#include "petrous/Simulation/Servo.h"

namespace petrous::presenters
{

/// The tool in the hand and how it is held.
struct TouchTool
{
  enum class Mode
  {
    SixDof,  ///< burr, shaft and handpiece, with torque [Chan2016]
    ThreeDof ///< the burr alone, its centre held at the surface [Chan2013]
  };
  dissection::Burr burr;
  Mode mode = Mode::SixDof;
  haptics::ProxyParameters coupling; ///< 1 N/mm and 20 N mm/rad by default
};

/// How such a tool is best tied to a hand that a set thrust presses, in newtons, and without one to
/// a hand that presses by its way.
haptics::ProxyParameters couplingFor(TouchTool::Mode mode, std::optional<double> thrust) noexcept;

/// A case made ready for touch: its tissue field as a servo samples it, and the mask as the servo
/// sees it. Made once for a case and its touchable structures; tools come and go.
///
/// The case must have its dissection loaded and outlive the scene. One thread, but for the field,
/// which a servo thread may use.
class TouchScene
{
public:
  /// Reads the CT once (about a second for 512^3), and measures soft structures. `firstState` is
  /// the number of the mask's state as the servo sees it: a session that is played again counts as
  /// it did.
  /// regional: see DrillSession. Throws CancelledError.
  explicit TouchScene(scene::Case& value, const core::Progress& progress = {},
                      std::uint64_t firstState = 0, bool regional = false);

  /// The same with what is known of the case already.
  TouchScene(scene::Case& value, const DrillSession& drill, const core::Progress& progress = {},
             std::uint64_t firstState = 0);

  DrillSession& drill() noexcept { return m_drill; }
  const std::shared_ptr<volume::PublishedMask>& mask() const noexcept { return m_mask; }
  const std::shared_ptr<const haptics::HapticField>& field() const noexcept { return m_field; }

  /// What a servo reads of the field, kept in memory while somebody holds this; the same for all.
  std::shared_ptr<const core::LockedMemory> lockedMemory() const;

  /// Tells the servo of bricks that were changed by other means than drilling: undo, redo.
  void publish(const std::vector<std::size_t>& bricks);

  /// Points on the tool for this scene's voxels, made once for each burr (about a second) and kept.
  /// Throws InvalidParameter.
  const haptics::PointShell& shellOf(const TouchTool& tool) const;

  /// The tool held by the tissue. Throws InvalidParameter naming the first bad value.
  std::unique_ptr<haptics::Proxy> proxyOf(const TouchTool& tool) const;

  /// What a servo must know of that tool.
  simulation::ServoSetup servoOf(const TouchTool& tool) const;

  /// What is felt here as it is now, to know it again. Reads every voxel (0.1 s for 512^3).
  simulation::RecordedScene fingerprint() const;

  /// The head of a recording that begins now.
  /// servo  as the session has it
  /// note   for people: what kind of session
  simulation::RecordingSetup recordingOf(const TouchTool& tool, const simulation::ServoSetup& servo,
                                         const std::string& note) const;

  /// What the burr removes, by the laws, in a `loop` of its own. `catalogues` say what it meets.
  /// Loads what the case's tissues need. Throws InvalidParameter.
  std::unique_ptr<CaseRemoval> removalOf(const dissection::Burr& burr,
                                         const dissection::Catalogues& catalogues) const;

  /// What is known of a stroke that begins now; `camera` is asked where it is drilled from.
  static simulation::DissectionLoop::Begin
  beginOf(const dissection::Burr& burr, std::function<std::optional<core::CameraPose>()> camera);

  /// What a dissection loop that cuts the case's own dissection tells the case: strokes are opened
  /// and listed as by a DrillSession, and the case goes through its list when one is undone or
  /// redone. No loop that cuts a fork of it (TouchDissection) may have these.
  simulation::DissectionLoop::Hooks
  hooksOf(const dissection::Burr& burr, std::function<std::optional<core::CameraPose>()> camera);

private:
  scene::Case& m_case;
  DrillSession m_drill;
  std::shared_ptr<volume::PublishedMask> m_mask;
  std::shared_ptr<const haptics::HapticField> m_field;
  mutable std::weak_ptr<const core::LockedMemory> m_locked;
  mutable std::map<double, haptics::PointShell> m_shells; // by diameter, mm
};

} // namespace petrous::presenters
