#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>

#include "petrous/Core/Error.h"

namespace petrous::core
{

/// A file that cannot be written. The message is "PATH: problem", one line.
struct OutputFileError : Error
{
  enum class Reason
  {
    DiskFull,     ///< no space left, quota or file size limit exceeded
    NotPermitted, ///< no permission, or a read-only file system
    WrongPlace,   ///< no such directory, or the target is not a regular file
    Failed        ///< anything else
  };

  OutputFileError(Reason why, const std::filesystem::path& path, const std::string& what);

  Reason reason;
  std::string problem; ///< the message without the path
};

/// Throws the OutputFileError for an errno value.
[[noreturn]] void throwOutputError(int error, const std::filesystem::path& path);

/// The only atomic and durable file writer (OutputFolder: of folders): the file appears complete or
/// not at all, even if the program is killed or the power fails.
///
/// Bytes go to a new file in the same directory, with an unpredictable name, opened with O_EXCL.
/// `commit` syncs it, renames it over the target and syncs the directory. Everything that can fail
/// is done before the rename; nothing throws after it. Without a commit the temporary file is
/// removed, unless the process is killed: isLeftover recognises such files.
///
/// A symbolic link to a regular file is kept, and the file it points to is replaced. A target that
/// is neither a regular file nor absent (a device, a pipe, a directory) is refused.
class OutputFile
{
public:
  /// Throws OutputFileError.
  explicit OutputFile(const std::filesystem::path& path);
  ~OutputFile();
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  void write(const void* bytes, std::size_t count); ///< throws OutputFileError
  void write(std::string_view bytes) { write(bytes.data(), bytes.size()); }

  /// Lets the system begin with what was written, which `commit` then need not wait for.
  void startSync() noexcept;

  /// Throws OutputFileError; the target is then unchanged. Returns false if the file is in place
  /// but syncing the directory failed, so that a power failure may undo it.
  bool commit();

  /// The temporary file, until `commit`.
  const std::filesystem::path& temporary() const noexcept { return m_temporary; }
  int descriptor() const noexcept { return m_descriptor; }

private:
  std::filesystem::path m_path; ///< symbolic links resolved
  std::filesystem::path m_temporary;
  int m_folder = -1;
  int m_descriptor = -1;
};

/// Writes `bytes` to a file. Returns and throws as OutputFile::commit.
bool writeFile(const std::filesystem::path& path, std::string_view bytes);

/// The same for a folder of files: complete or not at all. They are written in a folder of another
/// name, which `commit` syncs and renames; into a target that exists, which must be empty, its
/// entries are renamed one by one, and back if one fails. The folder's files need not be durable
/// by themselves.
///
/// Without a commit everything is removed, created parent folders included.
class OutputFolder
{
public:
  /// Throws OutputFileError if the target is a file or a folder that is not empty, or if nothing
  /// can be written there.
  explicit OutputFolder(const std::filesystem::path& target);
  ~OutputFolder();
  OutputFolder(const OutputFolder&) = delete;
  OutputFolder& operator=(const OutputFolder&) = delete;

  const std::filesystem::path& path() const noexcept { return m_staging; } ///< where to write

  /// Throws and returns as OutputFile::commit.
  bool commit();

private:
  std::filesystem::path m_target;
  std::filesystem::path m_staging;
  std::filesystem::path m_made; ///< the topmost folder created
  bool m_inside = false;        ///< staged inside the empty target
  bool m_done = false;
};

/// The file that writing to `path` replaces: the end of a chain of links, or `path` if nothing
/// exists there. Throws OutputFileError if the target is not a regular file: opening a pipe would
/// block until it has a reader. For files that grow while they are written and therefore cannot be
/// an OutputFile.
std::filesystem::path outputTarget(const std::filesystem::path& path);

/// A unique, unpredictable name in the same directory, for files and directories to be renamed to
/// `path` later. It satisfies isLeftover.
std::filesystem::path temporaryBeside(const std::filesystem::path& path);

/// Whether the file name is that of a temporary file whose writer was killed.
bool isLeftover(const std::filesystem::path& path);

/// Syncs a directory. Returns false if the disk reports an error or the directory cannot be opened;
/// true also on file systems that cannot sync directories.
bool syncFolder(const std::filesystem::path& folder) noexcept;

} // namespace petrous::core
