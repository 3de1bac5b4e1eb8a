#pragma once

#include <string>

#include "petrous/Core/Error.h"
#include "petrous/Dissection/Stroke.h"
#include "petrous/Haptics/ProxyTick.h"
#include "petrous/Simulation/Servo.h"

namespace petrous::simulation
{

/// With what a session was recorded: enough to make its servo and proxy again. The field (case and
/// mask at the start) is named by whoever records, in `note`. Never patient data.
struct RecordingSetup
{
  std::string tool; ///< for people: "cutting burr 4 mm"
  std::string note; ///< free text
  dissection::Burr burr;
  haptics::ProxyParameters proxy;
  ServoSetup servo;
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
