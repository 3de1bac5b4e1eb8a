#pragma once

#include <filesystem>
#include <string_view>

namespace petrous::library
{

/// Replaces `path` with `bytes`: temporary file beside it, fsync, rename, fsync of the folder.
/// Under a kill or a power cut the file is the old one or the new one. Throws LibraryError
/// (DiskFull, Unwritable) and leaves the old file and no temporary one.
void replaceDurably(const std::filesystem::path& path, std::string_view bytes);

/// A new file with its bytes on the disk; not yet its folder's entry.
void writeDurably(const std::filesystem::path& path, std::string_view bytes);

/// Renames and makes the folder's entry durable.
void renameDurably(const std::filesystem::path& from, const std::filesystem::path& to);

/// Makes the entries of a folder durable.
void syncFolder(const std::filesystem::path& folder);

/// Makes a folder and its parents. Throws LibraryError.
void makeFolder(const std::filesystem::path& path);

/// A name in the folder of `path` that nobody uses.
std::filesystem::path temporaryBeside(const std::filesystem::path& path);

/// Throws the LibraryError that fits errno for `path`.
[[noreturn]] void throwForErrno(int error, const std::filesystem::path& path);

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
