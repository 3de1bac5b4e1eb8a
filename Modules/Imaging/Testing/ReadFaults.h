#pragma once

#include <filesystem>

namespace petrous::testing
{

/// A medium that is pulled out while it is read: interposes pread and read between the test program
/// (with all its libraries) and the C library. Thread-safe.
class ReadFaults
{
public:
  enum class Kind
  {
    Error, ///< EIO
    End    ///< no more bytes: the file was cut meanwhile
  };

  /// The `n`-th read of a file below `folder` from now on, counted from 1, and all after it fail.
  static void pullOut(const std::filesystem::path& folder, int n, Kind kind = Kind::Error);
  static int failures(); ///< since pullOut
  static void reset();
};

} // namespace petrous::testing
