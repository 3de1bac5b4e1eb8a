#pragma once

#include <memory>
#include <optional>
#include <string>

#include "petrous/Presenters/TouchScene.h"
#include "petrous/Simulation/RecordingReplay.h"

namespace petrous::presenters
{

/// The tool with which a recording was made. Throws InvalidParameter where no tool is like that.
TouchTool toolOf(const simulation::RecordingSetup& setup);

/// Plays a recording (of a tool path or of a live session) on its case again: tool, force and cuts,
/// each tick held against the record. Strokes are opened and listed in the case as they were.
///
///     TouchScene scene(value, progress, reader.setup().scene.firstState);
///     RecordingPlayer replay(value, scene, reader, "session.ticks");
///     while (replay.next())
///       use(replay.feel());
///
/// Case, scene and reader must outlive this. One thread.
class RecordingPlayer
{
public:
  /// scene   made with the recording's first state
  /// name    of the file, for messages
  /// camera  noted with each stroke
  /// Throws InvalidParameter that says what of the case is not as it was when the recording began,
  /// and what would make it so.
  RecordingPlayer(scene::Case& value, TouchScene& scene, simulation::RecordingReader& reader,
             const std::string& name, std::optional<core::CameraPose> camera = std::nullopt);

  /// Takes the mask to the state that the next tick felt; the tick as it was recorded, or null at
  /// the end. Throws RecordingError.
  const simulation::TickRecord* next() { return m_replay.next(); }

  /// The servo's tick, after next(). The record holds until the next one.
  const simulation::TickRecord& feel() noexcept { return m_replay.feel(); }

  /// What followed that tick in the tissue, as far as the next one felt it; next() would do it.
  void follow() { m_replay.follow(); }

  const simulation::RecordingReplay::Outcome& outcome() const noexcept
  {
    return m_replay.outcome();
  }

private:
  std::unique_ptr<haptics::Proxy> m_proxy;
  simulation::Servo m_servo;
  simulation::NoRemovalModel m_removalModel; // cuts are done again as they were
  simulation::DissectionLoop m_loop;
  simulation::RecordingReplay m_replay;
};

} // namespace petrous::presenters
