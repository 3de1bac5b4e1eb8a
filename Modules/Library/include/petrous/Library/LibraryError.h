#pragma once

#include <string>

#include "petrous/Core/Error.h"

namespace petrous::library
{

/// Messages name the library's file or folder, or the case.
struct LibraryError : core::Error
{
  enum class Reason
  {
    NotFound,   ///< no case of that name, or an object is missing
    NameTaken,  ///< a case of that name is there already
    Conflict,   ///< the case was changed by someone else since it was opened
    DiskFull,   ///< nothing was changed
    Unwritable, ///< no permission, or the medium is read-only; nothing was changed
    Damaged     ///< a file is not what it should be
  };
  LibraryError(Reason r, const std::string& message)
    : Error(r == Reason::NotFound || r == Reason::Damaged ? core::Fault::BadInput
                                                          : core::Fault::Refused,
            message)
    , reason(r)
  {
  }
  Reason reason;
};

} // namespace petrous::library
