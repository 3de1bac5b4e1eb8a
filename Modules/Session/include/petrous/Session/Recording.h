#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "petrous/Core/Error.h"
#include "petrous/Dissection/Stroke.h"
#include "petrous/Haptics/ProxyTick.h"
#include "petrous/Session/MaskEdit.h"
#include "petrous/Session/Servo.h"

namespace petrous::session
{

/// Identifies the scene of a recorded session: core::Fingerprint of each part.
struct RecordedScene
{
  std::uint64_t ct = 0;         ///< voxels and grid
  double iso = 0.0;             ///< HU, threshold of bone
  std::uint64_t tissue = 0;     ///< touchable structures, protected structures
  std::uint64_t mask = 0;       ///< at the start of the session
  std::uint64_t applied = 0;    ///< strokes in the mask at that time
  std::uint64_t firstState = 0; ///< number of the published mask state at that time
};

/// Configuration of a recorded session, sufficient to recreate its servo and proxy. No patient
/// data.
struct RecordingSetup
{
  std::string tool; ///< display name
  std::string note; ///< free text
  dissection::Burr burr;
  int degrees = 6; ///< of freedom, 3 or 6
  RecordedScene scene;
  haptics::ProxyParameters proxy;
  ServoSetup servo;
};

/// "cutting burr 4 mm, 6 degrees of freedom".
std::string toString(const RecordingSetup& setup);

/// Part of a recording: the mask states of its ticks result from its edits and those before it.
struct RecordingBlock
{
  std::vector<TickRecord> ticks;
  std::vector<MaskEdit> edits;
};

/// JSON with full-precision numbers. Throws InvalidParameter if one is not finite or a text is not
/// UTF-8.
std::string toJson(const RecordingSetup& setup);

/// Throws InvalidParameter naming what is missing or invalid.
RecordingSetup setupFromJson(const std::string& json);

/// A recording that cannot be written or read. The message begins with the file's name.
struct RecordingError : core::Error
{
  enum class Reason
  {
    NotFound,
    NotWritten,   ///< disk full, or folder not writable
    NotRecording, ///< another type of file
    NewerVersion, ///< written by a newer program
    OlderVersion, ///< of an obsolete format with too little information
    Corrupt       ///< damaged
  };
  RecordingError(Reason why, const std::string& message)
    : core::Error(core::Fault::BadInput, message)
    , reason(why)
  {
  }
  Reason reason;
};

} // namespace petrous::session
