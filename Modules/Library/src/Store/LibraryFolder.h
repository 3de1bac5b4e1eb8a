#pragma once

#include <filesystem>
#include <string>

#include "petrous/Core/InputFile.h"
#include "petrous/Core/OutputFile.h"
#include "petrous/Library/LibraryError.h"

namespace petrous::library
{

/// What a failed read or write of a file means to the library. `consequence` ends the message.
LibraryError libraryError(const core::InputFileError& error, const std::string& consequence = {});
LibraryError libraryError(const core::OutputFileError& error, const std::string& consequence = {});

/// Throws the LibraryError for a value of errno.
[[noreturn]] void throwForErrno(int error, const std::filesystem::path& path);

/// Makes a folder and its parents, durably. Throws LibraryError.
void makeFolder(const std::filesystem::path& path);

/// Removes what killed writers left in a folder. Only while nobody else writes there.
void removeLeftovers(const std::filesystem::path& folder) noexcept;

/// Exclusive while it lives, between processes; waits for the other. Throws LibraryError.
class FolderLock
{
public:
  explicit FolderLock(const std::filesystem::path& file);
  ~FolderLock();
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;

private:
  int m_descriptor;
};

} // namespace petrous::library
