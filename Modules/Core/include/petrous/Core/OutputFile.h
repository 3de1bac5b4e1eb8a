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
    DiskFull,     ///< no room, a quota or a limit on the size of files
    NotPermitted, ///< no permission, or a read-only medium
    WrongPlace,   ///< no such folder, or something that is not a regular file stands there
    Failed        ///< anything else
  };

  OutputFileError(Reason why, const std::filesystem::path& path, const std::string& what);

  Reason reason;
  std::string problem; ///< the message without the path
};

/// Throws the OutputFileError for a value of errno.
[[noreturn]] void throwOutputError(int error, const std::filesystem::path& path);

/// The one atomic and durable file writer: the file appears whole or not at all, also when the
/// program is killed or the power fails.
///
/// Bytes go to a new file in the same folder, with an unpredictable name, opened with O_EXCL.
/// `commit` syncs it, renames it over the target and syncs the folder. Everything that can fail is
/// done before the rename; after it nothing throws. Without a commit nothing is left behind but by
/// a kill: such leftovers are named isLeftover.
///
/// A symbolic link to a regular file stays, and the file it points to is replaced. What is neither
/// a regular file nor absent (a device, a pipe, a folder) is refused.
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

  /// Throws OutputFileError; the target is then what it was. False: the file is in place, but the
  /// disk reported an error for the folder's sync, so that a power failure may undo it.
  bool commit();

  /// The file until `commit`.
  const std::filesystem::path& temporary() const noexcept { return m_temporary; }
  int descriptor() const noexcept { return m_descriptor; }

private:
  std::filesystem::path m_path; ///< links resolved
  std::filesystem::path m_temporary;
  int m_folder = -1;
  int m_descriptor = -1;
};

/// Makes `bytes` the content of a file. As OutputFile::commit.
bool writeFile(const std::filesystem::path& path, std::string_view bytes);

/// The file that writing to `path` replaces: the end of a chain of links, or `path` where nothing is
/// there. Throws OutputFileError where something else than a regular file stands there: opening a
/// pipe would wait for its reader. For files that grow while they are written, and so are no
/// OutputFile.
std::filesystem::path outputTarget(const std::filesystem::path& path);

/// A name in the same folder that nobody has or can guess, for files and folders to be renamed to
/// `path` later. It satisfies isLeftover.
std::filesystem::path temporaryBeside(const std::filesystem::path& path);

/// Whether a file has the name of one whose writer was killed.
bool isLeftover(const std::filesystem::path& path);

/// Syncs a folder's entries. False where the disk reports an error, or the folder cannot be opened;
/// true also on file systems that cannot sync folders.
bool syncFolder(const std::filesystem::path& folder) noexcept;

} // namespace petrous::core
