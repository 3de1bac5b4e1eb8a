#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "petrous/Library/Library.h"

namespace petrous::presenters
{

/// Default file for the recording of a session that begins now:
///
///   LIBRARY/recordings/CASE 2026-03-01 09-30-00.ticks     local time; " (2)" if it exists
///
/// The folder is beside the cases, so that a copy of the library includes it but a case's archive
/// does not. Creates the folder; throws core::Error (Refused) if it cannot.
std::filesystem::path newRecording(const library::Library& library, const scene::Case& value);

/// The recordings that newRecording named after the case, latest first.
std::vector<std::filesystem::path> recordingsOf(const library::Library& library,
                                                const std::string& name);

/// The recordings of one operation belong together: a session's first file and those that it began
/// with another burr, "NAME.ticks", "NAME (2).ticks" and so on (unusedName) in one folder. Each
/// operation's files in order; the operations in the order in which `files` first has one of each.
std::vector<std::vector<std::filesystem::path>>
inOperations(const std::vector<std::filesystem::path>& files);

/// `file`, or if that exists "NAME (2).ticks", "NAME (3).ticks" and so on beside it.
std::filesystem::path unusedName(const std::filesystem::path& file);

} // namespace petrous::presenters
