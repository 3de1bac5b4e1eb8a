#pragma once

#include <string>

#include "petrous/Core/Error.h"

namespace petrous::imaging
{

/// A file, foreign or our own, that cannot be read or written.
///
/// The message is one line, "PATH: what is wrong; what would be right". It contains only numbers
/// and our own words, since text inside a file may be patient data.
struct FileError : core::Error
{
  enum class Reason
  {
    NotFound,      ///< no such file, or it is a folder
    UnknownFormat, ///< neither name nor first bytes match a supported format
    Unreadable,    ///< truncated, damaged or inconsistent
    NoGeometry,    ///< the position of the voxels in the patient is not known without guessing
    Unwritable,    ///< no folder, no permission or no space
    Unsupported    ///< valid, but its content cannot be part of a scene
  };

  FileError(Reason why, const std::string& message, core::Fault fault = core::Fault::BadInput)
    : core::Error(fault, message)
    , reason(why)
  {
  }

  Reason reason;
};

/// Messages of ITK, which may quote a file, go to the log without their text, and not to stderr;
/// GDCM gives none. For a program to call once.
void logToolkitMessages();

} // namespace petrous::imaging
