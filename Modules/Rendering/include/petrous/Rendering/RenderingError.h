#pragma once

#include <string>

#include "petrous/Core/Error.h"

namespace petrous::rendering
{

/// Why no picture came about.
struct RenderingError : core::Error
{
  enum class Reason
  {
    NoOpenGL,    ///< EGL or a driver is missing, or too old; the text says what to install
    BadSize,     ///< a picture of no pixels, or larger than the machine draws
    BadContents, ///< a scene that contradicts itself
    CannotWrite  ///< the file system refused; the text names the file
  };

  RenderingError(Reason why, const std::string& message);

  Reason reason;
};

} // namespace petrous::rendering
