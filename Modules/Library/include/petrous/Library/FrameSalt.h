#pragma once

#include <string>

namespace petrous::library
{

class Library;

/// `frameOfReference` (as ImagePart, not salted) as the cases of this library store it: a hash with
/// the library's salt, so that nobody can test a hospital's UIDs against it. Throws LibraryError if
/// the salt cannot be read, or created where there is none yet (not while the library is locked by
/// the caller).
std::string saltedFrame(const Library& library, const std::string& frameOfReference);

} // namespace petrous::library
