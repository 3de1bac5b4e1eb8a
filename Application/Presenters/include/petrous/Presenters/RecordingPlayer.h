#pragma once

#include <memory>
#include <optional>
#include <string>

#include "petrous/Session/RecordingReplay.h"
#include "petrous/Session/TouchScene.h"

namespace petrous::presenters
{

/// The tool with which a recording was made. Throws InvalidParameter if there is no such tool.
session::TouchTool toolOf(const session::RecordingSetup& setup);

/// How a case, of which `now` is the fingerprint, differs from its state when a recording began,
/// and how to restore that; empty: it does not.
std::string misfitOf(const scene::Case& value, const session::RecordedScene& now,
                     const session::RecordedScene& then);

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
  RecordingPlayer(scene::Case& value, session::TouchScene& scene, session::RecordingReader& reader,
                  const std::string& name, std::optional<core::CameraPose> camera = std::nullopt);

  /// Brings the mask to the state in effect at the next tick; returns that tick as recorded, or
  /// nullptr at the end. Throws RecordingError.
  const session::TickRecord* next() { return m_replay.next(); }

  /// The servo's tick, after next(). The record is valid until the next one.
  const session::TickRecord& feel() noexcept { return m_replay.feel(); }

  /// Applies that tick's changes to the tissue, as far as the next tick saw them; next() would do
  /// it.
  void follow() { m_replay.follow(); }

  const session::RecordingReplay::Outcome& outcome() const noexcept { return m_replay.outcome(); }

private:
  std::unique_ptr<haptics::Proxy> m_proxy;
  session::Servo m_servo;
  session::NoRemovalModel m_removalModel; // recorded cuts are replayed as they were
  session::DissectionLoop m_loop;
  session::RecordingReplay m_replay;
};

} // namespace petrous::presenters
