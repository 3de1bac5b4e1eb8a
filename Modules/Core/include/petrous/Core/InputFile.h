#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>

#include "petrous/Core/Error.h"

namespace petrous::core
{

/// A file that cannot be opened or read. The message is "PATH: problem", one line.
struct InputFileError : InvalidParameter
{
  enum class Reason
  {
    NotFound,   ///< no such file
    NotRegular, ///< a directory, named pipe, device or socket
    Denied,     ///< no permission
    TooLarge,   ///< more bytes than the caller's limit
    Unreadable  ///< read error, or changed during reading
  };

  InputFileError(Reason why, const std::filesystem::path& path, const std::string& what);

  Reason reason;
  std::string problem; ///< the message without the path
};

/// A regular file, opened for reading. Anything else is refused without blocking: opening a named
/// pipe without a writer would block, and a device may never end.
///
/// Move-only; the descriptor is closed on destruction.
class InputFile
{
public:
  static constexpr std::uintmax_t kUnlimited = UINTMAX_MAX;

  /// Throws InputFileError, also if the file is larger than `limit` bytes.
  explicit InputFile(const std::filesystem::path& path, std::uintmax_t limit = kUnlimited);
  ~InputFile();
  InputFile(InputFile&& other) noexcept;
  InputFile& operator=(InputFile&& other) noexcept;

  const std::filesystem::path& path() const noexcept { return m_path; }
  std::uintmax_t size() const noexcept { return m_size; } ///< bytes, when it was opened
  int descriptor() const noexcept { return m_descriptor; }

  /// The first `size()` bytes, or the first `count` of them. Throws InputFileError (Unreadable) if
  /// the file has become shorter.
  std::string read(std::uintmax_t count = kUnlimited) const;

private:
  std::filesystem::path m_path;
  int m_descriptor = -1;
  std::uintmax_t m_size = 0;
};

/// The whole content. Throws InputFileError.
std::string readFile(const std::filesystem::path& path,
                     std::uintmax_t limit = InputFile::kUnlimited);

/// Opens a regular file as a binary stream. Throws InputFileError.
std::ifstream openInput(const std::filesystem::path& path,
                        std::uintmax_t limit = InputFile::kUnlimited);

/// The path for use in a message; control characters become '?'.
std::string printable(const std::filesystem::path& path);

} // namespace petrous::core
