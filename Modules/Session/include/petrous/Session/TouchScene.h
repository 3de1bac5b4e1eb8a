#pragma once

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>

#include "petrous/Core/LockedMemory.h"
#include "petrous/Core/TriangleMesh.h"
#include "petrous/Haptics/HapticField.h"
#include "petrous/Haptics/PointShell.h"
#include "petrous/Haptics/Proxy.h"
#include "petrous/Session/CaseRemoval.h"
#include "petrous/Session/DissectionLoop.h"
#include "petrous/Session/DrillSession.h"
#include "petrous/Session/Recording.h"
#include "petrous/Session/Servo.h"

namespace petrous::session
{

/// An instrument that is felt with its whole surface and removes nothing: pick, dissector, curette.
/// Frame T: the tip at the origin, +z to the hand; mm. Immutable.
struct Instrument
{
  std::string name;                                  ///< display name
  std::shared_ptr<const core::TriangleMesh> surface; ///< as drawn
  std::shared_ptr<const haptics::PointShell> shell;  ///< as felt: points of that surface
};

/// A tool and its coupling.
struct TouchTool
{
  enum class Mode
  {
    SixDof,  ///< burr, shaft and handpiece, with torque [Chan2016]
    ThreeDof ///< the burr alone, its centre constrained to the surface [Chan2013]
  };
  dissection::Burr burr;
  Mode mode = Mode::SixDof;
  /// In place of burr and mode, if any: always with six degrees of freedom.
  std::shared_ptr<const Instrument> instrument = nullptr;
  haptics::ProxyParameters coupling; ///< 1 N/mm and 20 N mm/rad by default

  /// Whether the tool needs a burr's point shell (shellOf).
  bool needsBurrShell() const noexcept { return !instrument && mode == Mode::SixDof; }
};

/// Recommended coupling for a tool pressed with a given thrust, in newtons, or without one, by the
/// device's displacement.
haptics::ProxyParameters couplingFor(TouchTool::Mode mode, std::optional<double> thrust) noexcept;

/// What is felt of a case, whatever the tool: the part of a TouchScene that takes long.
struct FeltTissue
{
  std::shared_ptr<volume::PublishedMask> mask;
  std::shared_ptr<const haptics::HapticField> field;
};

/// Reads the CT once (about a second for 512^3), and computes the distance fields of soft
/// structures (some seconds each). `whole` is the case's scene::tissueField. For a thread of its
/// own with a copy of the case: what is drilled meanwhile is taken over by TouchScene. `firstState`
/// is the number of the mask's state as seen by the servo: a replay continues the recorded
/// numbering. Throws CancelledError.
FeltTissue feltTissue(const scene::Case& value, const volume::TissueField& whole,
                      const core::Progress& progress = {}, std::uint64_t firstState = 0);

/// Burr, shaft and handpiece as points for the voxels of a case: up to a second. Throws
/// InvalidParameter.
std::shared_ptr<const haptics::PointShell> shellOf(const dissection::Burr& burr,
                                                   const core::GridGeometry& geometry);

/// RecordedScene::mask of a mask.
std::uint64_t fingerprintOf(const volume::CutMask& mask);

/// A case prepared for touch: its tissue field as sampled by a servo, and the mask as seen by the
/// servo. Made once for a case and its touchable structures; tools come and go.
///
/// The case must have its dissection loaded and outlive the scene. Not thread-safe, except the
/// field, which a servo thread may use.
class TouchScene
{
public:
  /// By `feltTissue`, with its parameters. regional: see DrillSession. Throws CancelledError.
  explicit TouchScene(scene::Case& value, const core::Progress& progress = {},
                      std::uint64_t firstState = 0, bool regional = false);

  /// The same, reusing what is known of the case.
  TouchScene(scene::Case& value, const DrillSession& drill, const core::Progress& progress = {},
             std::uint64_t firstState = 0);

  /// The same, with what was felt of the case, or of a copy with the same structures and threshold
  /// on which less or more was drilled.
  TouchScene(scene::Case& value, const DrillSession& drill, FeltTissue felt);

  DrillSession& drill() noexcept { return m_drill; }
  const std::shared_ptr<volume::PublishedMask>& mask() const noexcept { return m_mask; }
  const std::shared_ptr<const haptics::HapticField>& field() const noexcept { return m_field; }

  /// What a servo reads of the field, locked in memory while any holder exists; shared.
  std::shared_ptr<const core::LockedMemory> lockedMemory() const;

  /// Publishes to the servo bricks changed by other means than drilling: undo, redo.
  void publish(const std::vector<std::size_t>& bricks);

  /// Point shell of the tool for this scene's voxels, kept per burr; made on first use, unless it
  /// was given. An instrument has its own. Throws InvalidParameter.
  const haptics::PointShell& shellOf(const TouchTool& tool) const;
  void giveShell(const dissection::Burr& burr, std::shared_ptr<const haptics::PointShell> shell);

  /// The tool's proxy. Throws InvalidParameter naming the first bad value.
  std::unique_ptr<haptics::Proxy> proxyOf(const TouchTool& tool) const;

  /// The servo's setup for that tool.
  ServoSetup servoOf(const TouchTool& tool) const;

  /// Fingerprint of what can be touched now. Reads every voxel (0.1 s for 512^3).
  RecordedScene fingerprint() const;

  /// The header of a recording that begins now. Throws InvalidParameter for an instrument, whose
  /// surface a recording does not hold.
  /// servo  as the session has it
  /// note   for the reader: what kind of session
  RecordingSetup recordingOf(const TouchTool& tool, const ServoSetup& servo,
                             const std::string& note) const;

  /// The burr's removal model, for a `loop` of its own, with resistances from `catalogues`. Loads
  /// what the case's tissues need. Throws InvalidParameter.
  std::unique_ptr<CaseRemoval> removalOf(const dissection::Burr& burr,
                                         const dissection::Catalogues& catalogues) const;

  /// Metadata of a stroke that begins now; `camera` returns the viewpoint.
  static DissectionLoop::Begin beginOf(const dissection::Burr& burr,
                                       std::function<std::optional<core::CameraPose>()> camera);

  /// Hooks for a dissection loop that cuts the case's own dissection: strokes are opened and closed
  /// as by a DrillSession. Not for a loop that cuts a fork of it (TouchSession).
  DissectionLoop::Hooks hooksOf(const dissection::Burr& burr,
                                std::function<std::optional<core::CameraPose>()> camera);

private:
  scene::Case& m_case;
  DrillSession m_drill;
  std::shared_ptr<volume::PublishedMask> m_mask;
  std::shared_ptr<const haptics::HapticField> m_field;
  mutable std::weak_ptr<const core::LockedMemory> m_locked;
  mutable std::map<double, std::shared_ptr<const haptics::PointShell>> m_shells; // by diameter, mm
};

} // namespace petrous::session
