#pragma once

#include <filesystem>
#include <functional>
#include <string>

#include "petrous/Scene/Case.h"

namespace petrous::library
{

class Library;

/// Recovers a journal (journalOf) of a case, unless a running program has it: applies it to the
/// case, saves the case and removes the journal. Returns a message for the user, empty if nothing
/// happened. `value` matches the manifest, before and after; `read` reads it again, once no other
/// program can recover the journal.
///
/// A journal that cannot be used is set aside, one that cannot be saved is kept; the message says
/// so. Throws LibraryError only if `value` cannot be read again.
std::string recover(Library library, scene::Case& value, const std::filesystem::path& path,
                    const std::function<scene::Case()>& read);

} // namespace petrous::library
