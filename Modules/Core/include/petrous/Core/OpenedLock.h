#pragma once

#include <chrono>
#include <filesystem>

namespace petrous::core
{

enum class LockState
{
  Ours,
  Anothers,
  NoLocks ///< the file system has none, or not for a file that was opened so; errno says why
};

/// For lockOpened: however long another has it.
constexpr std::chrono::milliseconds kWaitForLock{-1};

/// Locks what is open against other processes (flock); the lock ends with the descriptor, however
/// the process ends. While another has it, waits for at most `patience`; without, it asks once.
/// Unlike FileLock, which guards what follows, it marks the file itself.
LockState lockOpened(int descriptor, std::chrono::milliseconds patience = {}) noexcept;

/// Whether the path still names what is open: others may have removed or replaced it.
bool isOpenedAt(int descriptor, const std::filesystem::path& path) noexcept;

} // namespace petrous::core
