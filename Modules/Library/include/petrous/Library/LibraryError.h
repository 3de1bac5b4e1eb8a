#pragma once

#include <string>

#include "petrous/Core/Error.h"

namespace petrous::library
{

/// Messages name the file or folder of the library, or the case.
struct LibraryError : core::Error
{
  enum class Reason
  {
    NotFound,   ///< no case of that name, or a missing object
    NameTaken,  ///< the name is already in use
    Conflict,   ///< the case was changed by another program since it was opened
    DiskFull,   ///< nothing was changed
    Unwritable, ///< no permission, or read-only medium; nothing was changed
    Damaged     ///< a file has unexpected content
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

/// A structure or a mesh of a case is missing or damaged.
struct StructureError : LibraryError
{
  using LibraryError::LibraryError;
};

} // namespace petrous::library
