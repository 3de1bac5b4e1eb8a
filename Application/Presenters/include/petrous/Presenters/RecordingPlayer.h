#pragma once

#include <memory>
#include <optional>
#include <string>

#include "petrous/Presenters/TouchScene.h"
#include "petrous/Simulation/RecordingReplay.h"

namespace petrous::presenters
{

/// The tool with which a recording was made. Throws InvalidParameter if there is no such tool.
TouchTool toolOf(const simulation::RecordingSetup& setup);

/// Replays a recording (of a tool path or of a live session) on its case: tool, force and cuts,
/// comparing each tick with the record. Strokes are opened and added to the case's history as they
/// were.
///
///     TouchScene scene(value, progress, reader.setup().scene.firstState);
///     RecordingPlayer replay(value, scene, reader, "session.ticks");
///     while (replay.next())
///       use(replay.feel());
///
/// Case, scene and reader must outlive this. Not thread-safe.
class RecordingPlayer
{
public:
  /// scene   made with the recording's first state
  /// name    of the file, for messages
  /// camera  stored with each stroke
  /// Throws InvalidParameter describing how the case differs from its state when the recording
  /// began, and how to restore that.
  RecordingPlayer(scene::Case& value, TouchScene& scene, simulation::RecordingReader& reader,
             const std::string& name, std::optional<core::CameraPose> camera = std::nullopt);

  /// Brings the mask to the state in effect at the next tick; returns that tick as recorded, or
  /// nullptr at the end. Throws RecordingError.
  const simulation::TickRecord* next() { return m_replay.next(); }

  /// The servo's tick, after next(). The record is valid until the next one.
  const simulation::TickRecord& feel() noexcept { return m_replay.feel(); }

  /// Applies that tick's changes to the tissue, as far as the next tick saw them; next() would do
  /// it.
  void follow() { m_replay.follow(); }

  const simulation::RecordingReplay::Outcome& outcome() const noexcept
  {
    return m_replay.outcome();
  }

private:
  std::unique_ptr<haptics::Proxy> m_proxy;
  simulation::Servo m_servo;
  simulation::NoRemovalModel m_removalModel; // recorded cuts are replayed as they were
  simulation::DissectionLoop m_loop;
  simulation::RecordingReplay m_replay;
};

} // namespace petrous::presenters
