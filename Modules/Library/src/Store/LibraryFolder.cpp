#include "LibraryFolder.h"

#include <cerrno>
#include <cstdio>
#include <vector>

#include <unistd.h>

namespace petrous::library
{

namespace fs = std::filesystem;
using Reason = LibraryError::Reason;

namespace
{

std::string joined(const std::string& text, const std::string& consequence)
{
  return consequence.empty() ? text : text + "; " + consequence;
}

// Temporary files of older program versions.
bool isOldLeftover(const fs::path& path)
{
  return path.filename().string().rfind(".tmp-", 0) == 0;
}

} // namespace

LibraryError libraryError(const core::InputFileError& error, const std::string& consequence)
{
  return {error.reason == core::InputFileError::Reason::NotFound ? Reason::NotFound
                                                                 : Reason::Damaged,
          joined(error.what(), consequence)};
}

LibraryError libraryError(const core::OutputFileError& error, const std::string& consequence)
{
  return {error.reason == core::OutputFileError::Reason::DiskFull ? Reason::DiskFull
                                                                  : Reason::Unwritable,
          joined(error.what(), consequence)};
}

void throwForErrno(int error, const fs::path& path)
{
  try
  {
    core::throwOutputError(error, path);
  }
  catch (const core::OutputFileError& fault)
  {
    throw libraryError(fault);
  }
}

bool moveFile(const fs::path& from, const fs::path& to)
{
  if (::rename(from.c_str(), to.c_str()) != 0)
    throwForErrno(errno, to);
  return core::syncFolder(to.parent_path());
}

void makeFolder(const fs::path& path)
{
  std::vector<fs::path> missing;
  std::error_code error;
  for (fs::path folder = path; !folder.empty() && !fs::exists(folder, error);
       folder = folder.parent_path())
    missing.push_back(folder);
  fs::create_directories(path, error);
  if (!error && !fs::is_directory(path))
    error = std::make_error_code(std::errc::not_a_directory);
  if (error == std::errc::not_a_directory || error == std::errc::file_exists)
    throw LibraryError(Reason::Unwritable, core::printable(path) +
                                               ": a file stands where the library needs a folder; "
                                               "choose another library folder");
  if (error)
    throwForErrno(error.value(), path);
  for (const fs::path& folder : missing)
    core::syncFolder(folder.parent_path());
}

void removeLeftovers(const fs::path& folder) noexcept
{
  try
  {
    std::error_code error;
    for (fs::directory_iterator entry(folder, error), end; !error && entry != end;
         entry.increment(error))
      if (core::isLeftover(entry->path()) || isOldLeftover(entry->path()))
      {
        std::error_code ignored;
        fs::remove(entry->path(), ignored);
      }
  }
  catch (const std::exception&)
  {
    // They are harmless.
  }
}

core::FileLock lockFolder(const fs::path& library, const core::Progress& progress,
                          const std::function<void(double)>& waiting)
{
  constexpr double kSay = 1.0; // s
  const auto wait = [&](double seconds)
  {
    const std::string text = "another program is using the library";
    if (seconds >= kSay)
      progress.report(0.0, text);
    else
      progress.check(text);
    if (waiting)
      waiting(seconds);
  };
  try
  {
    return core::FileLock(library / ".lock", wait);
  }
  catch (const core::OutputFileError& error)
  {
    throw libraryError(error);
  }
}

} // namespace petrous::library
