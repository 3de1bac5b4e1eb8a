#pragma once

#include <string>

namespace petrous::testing
{

/// Stands between the test program (with all its libraries) and the C library's calls that change
/// files: open for writing, write, fsync, fdatasync, rename, unlink, ftruncate. Not thread-safe.
class SystemCalls
{
public:
  /// The `n`-th call of `name` from now on, counted from 1, fails with `error`; once.
  static void fail(const std::string& name, int n, int error);

  /// SIGKILL instead of the `n`-th call of any of them from now on.
  static void killAt(int n);

  static int count(); ///< calls since `fail`, `killAt` or `reset`
  static void reset();
};

} // namespace petrous::testing
