#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "petrous/Core/Error.h"
#include "petrous/Dissection/Stroke.h"
#include "petrous/Haptics/ProxyTick.h"
#include "petrous/Simulation/MaskEdit.h"
#include "petrous/Simulation/Servo.h"

namespace petrous::simulation
{

/// What was felt in a recorded session, to know it again: core::Fingerprint of each part.
struct RecordedScene
{
  std::uint64_t ct = 0;         ///< voxels and grid
  double iso = 0.0;             ///< HU, threshold of bone
  std::uint64_t tissue = 0;     ///< structures that are felt, structures that are left
  std::uint64_t mask = 0;       ///< when the session began
  std::uint64_t applied = 0;    ///< strokes in the mask then
  std::uint64_t firstState = 0; ///< number of the mask's published state then
};

/// With what a session was recorded: enough to make its servo and proxy again. Never patient data.
struct RecordingSetup
{
  std::string tool; ///< for people
  std::string note; ///< free text
  dissection::Burr burr;
  int degrees = 6; ///< of freedom, 3 or 6
  RecordedScene scene;
  haptics::ProxyParameters proxy;
  ServoSetup servo;
};

/// "cutting burr 4 mm, 6 degrees of freedom".
std::string toString(const RecordingSetup& setup);

/// A stretch of a recording: what its ticks felt was made by its edits and those before it.
struct RecordingBlock
{
  std::vector<TickRecord> ticks;
  std::vector<MaskEdit> edits;
};

/// JSON, numbers with all their digits. Throws InvalidParameter when one is not finite or a text is
/// not UTF-8.
std::string toJson(const RecordingSetup& setup);

/// Throws InvalidParameter naming what is missing or wrong.
RecordingSetup setupFromJson(const std::string& json);

/// A recording that cannot be written or read. The message begins with the file's name.
struct RecordingError : core::Error
{
  enum class Reason
  {
    NotFound,
    NotWritten,   ///< the disk is full, or the folder cannot be written
    NotRecording, ///< another kind of file
    NewerVersion, ///< written by a later program
    OlderVersion, ///< of a format that says too little
    Corrupt       ///< bytes were changed
  };
  RecordingError(Reason why, const std::string& message)
    : core::Error(core::Fault::BadInput, message)
    , reason(why)
  {
  }
  Reason reason;
};

} // namespace petrous::simulation
