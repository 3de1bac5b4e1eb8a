#pragma once

#include <cctype>
#include <filesystem>
#include <functional>
#include <string>
#include <system_error>

#include <gtest/gtest.h>
#include <unistd.h>

namespace petrous::testing
{

/// Copies into `out` the folder that `make` fills, which is made once for all tests of a build and
/// kept in the build tree (PETROUS_TEST_CACHE): seconds of work that many tests begin with. `key`
/// names it; what was made by another build of the program (PETROUS_CACHED_BY) is removed.
inline void copyMadeOnce(const std::string& key, const std::filesystem::path& out,
                         const std::function<void(const std::filesystem::path&)>& make)
{
  namespace fs = std::filesystem;
  std::error_code fault;
  const auto built = fs::last_write_time(PETROUS_CACHED_BY, fault).time_since_epoch().count();
  if (fault)
    return make(out); // the program was not built
  const fs::path cache = fs::path(PETROUS_TEST_CACHE) / std::to_string(built);
  std::string name;
  for (const char c : key)
    name += std::isalnum(static_cast<unsigned char>(c)) || c == '.' || c == '-' ? c : '_';
  if (!fs::exists(cache / name))
  {
    if (!fs::exists(cache))
      fs::remove_all(PETROUS_TEST_CACHE, fault);
    fs::create_directories(cache);
    const fs::path fresh = cache / (".making-" + name + "-" + std::to_string(::getpid()));
    make(fresh);
    if (::testing::Test::HasFatalFailure())
      return;
    fs::rename(fresh, cache / name, fault); // another test may have been faster
    if (fault)
      fs::remove_all(fresh, fault);
  }
  fs::create_directories(out);
  fs::copy(cache / name, out, fs::copy_options::recursive);
}

} // namespace petrous::testing
