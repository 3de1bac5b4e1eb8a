#pragma once

#include <string>

#include "petrous/Core/Error.h"

namespace petrous::rendering
{

/// A failure to render or to write a picture.
struct RenderingError : core::Error
{
  enum class Reason
  {
    NoOpenGL,    ///< EGL or driver missing or too old; the message says what to install
    BadSize,     ///< an empty picture, or one larger than the machine can draw
    BadContents, ///< an inconsistent scene
    CannotWrite  ///< file system error; the message names the file
  };

  RenderingError(Reason why, const std::string& message);

  Reason reason;
};

/// Messages of VTK go to the log without their text, and not to stderr. For a program to call once.
void logToolkitMessages();

} // namespace petrous::rendering
