#pragma once

#include <string>

namespace petrous::testing
{

/// Interposes the C library calls that change files between the test program (with all its
/// libraries) and the C library: open for writing, write, fsync, fdatasync, rename, unlink,
/// flock, ftruncate. Not thread-safe.
class SystemCalls
{
public:
  /// The `n`-th call of `name` from now on, counted from 1, fails once with `error`.
  static void fail(const std::string& name, int n, int error);

  /// Raises SIGKILL instead of the `n`-th call of any of them from now on.
  static void killAt(int n);

  static int count();       ///< calls since `fail`, `killAt` or `reset`
  static int countOfName(); ///< of these, calls of the name given to `fail`
  static void reset();
};

} // namespace petrous::testing
