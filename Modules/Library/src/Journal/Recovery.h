#pragma once

#include <functional>
#include <string>

#include "petrous/Scene/Case.h"

namespace petrous::library
{

class Library;

/// Brings what the journal of a case holds into the case, where no program that runs has that
/// journal: saved, and the journal gone. What happened in words for the user, empty where nothing
/// did. `value` is as the manifest has it, before and after; `read` reads it again, once nobody
/// else can bring the journal back.
///
/// Where the journal cannot be used it is set aside, where it cannot be saved it stays; the words
/// say so. Throws LibraryError only where `value` could not be read again.
std::string recover(Library library, scene::Case& value, const std::function<scene::Case()>& read);

} // namespace petrous::library
