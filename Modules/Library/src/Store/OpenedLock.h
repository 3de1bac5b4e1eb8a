#pragma once

#include <chrono>
#include <filesystem>

namespace petrous::library
{

enum class LockState
{
  Ours,
  Anothers,
  NoLocks ///< the file system has none, or not for a file that was opened so
};

/// Locks what is open against other processes (flock); the lock ends with the descriptor, however
/// the process ends. While another has it, waits for at most `patience`; without, it asks once.
/// Unlike core::FileLock, which guards what follows, it marks the file itself.
LockState lockOpened(int descriptor, std::chrono::milliseconds patience = {}) noexcept;

/// Whether the path still names what is open: others may have removed or replaced it.
bool isOpenedAt(int descriptor, const std::filesystem::path& path) noexcept;

} // namespace petrous::library
