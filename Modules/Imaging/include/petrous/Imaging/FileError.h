#pragma once

#include <string>

#include "petrous/Core/Error.h"

namespace petrous::imaging
{

/// A file of another program (or one of ours) that cannot be read or written.
///
/// The message is one line, "PATH: what is wrong; what would be right". It is made from numbers
/// and our own words only: texts inside a file may carry patient data.
struct FileError : core::Error
{
  enum class Reason
  {
    NotFound,      ///< there is no file there, or it is a folder
    UnknownFormat, ///< neither name nor first bytes are of a format that is read
    Unreadable,    ///< broken off, damaged, or contradicting itself
    NoGeometry,    ///< where the voxels lie in the patient cannot be told without a guess
    Unwritable,    ///< no folder, no right, no room
    Unsupported    ///< valid, but holds what has no place in a scene
  };

  FileError(Reason why, const std::string& message, core::Fault fault = core::Fault::BadInput)
    : core::Error(fault, message)
    , reason(why)
  {
  }

  Reason reason;
};

} // namespace petrous::imaging
