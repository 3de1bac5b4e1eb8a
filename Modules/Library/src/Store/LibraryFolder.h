#pragma once

#include <filesystem>
#include <functional>
#include <string>

#include "petrous/Core/FileLock.h"
#include "petrous/Core/InputFile.h"
#include "petrous/Core/OutputFile.h"
#include "petrous/Core/Progress.h"
#include "petrous/Library/LibraryError.h"

namespace petrous::library
{

/// Converts a failed read or write to a LibraryError. `consequence` is appended to the message.
LibraryError libraryError(const core::InputFileError& error, const std::string& consequence = {});
LibraryError libraryError(const core::OutputFileError& error, const std::string& consequence = {});

/// Throws the LibraryError for an errno value.
[[noreturn]] void throwForErrno(int error, const std::filesystem::path& path);

/// Renames a file durably. Throws LibraryError; the file then has its old name. Returns false if it
/// has the new one but the disk did not confirm it.
bool moveFile(const std::filesystem::path& from, const std::filesystem::path& to);

/// Creates a folder and its parents, durably. Throws LibraryError.
void makeFolder(const std::filesystem::path& path);

/// Removes leftovers of killed writers. Only while no other process writes there.
void removeLeftovers(const std::filesystem::path& folder) noexcept;

/// The lock that every writer of the library holds. While another program has it, `progress` says
/// so after a second and can cancel, and `waiting` is called with the time waited, s. Throws
/// LibraryError, CancelledError and what `waiting` throws.
core::FileLock lockFolder(const std::filesystem::path& library, const core::Progress& progress = {},
                          const std::function<void(double)>& waiting = {});

} // namespace petrous::library
