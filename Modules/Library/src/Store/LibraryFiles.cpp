#include "petrous/Library/LibraryFiles.h"

#include <string>

#include "Sources.h"
#include "petrous/Core/Error.h"
#include "petrous/Core/InputFile.h"
#include "petrous/Library/LibraryError.h"

namespace petrous::library
{

namespace fs = std::filesystem;

fs::path resolvedPath(const fs::path& file)
{
  std::error_code error;
  const fs::path path = fs::weakly_canonical(file, error);
  return error ? fs::absolute(file, error).lexically_normal() : path;
}

bool isOfLibrary(const fs::path& file, const fs::path& folder)
{
  const fs::path below = resolvedPath(file).lexically_relative(resolvedPath(folder));
  const std::string first = below.empty() ? "" : below.begin()->string();
  for (const char* own :
       {"cases", "objects", "thumbnails", "derived", "open", "salt", ".lock", "materials.json",
        "burrs.json", "nodes.json", "sources", ".nodes.lock", "presets.json", ".presets.lock"})
    if (first == own)
      return true;
  std::error_code error; // new recordings are written there
  if (first == "recordings" && fs::exists(fs::symlink_status(file, error)))
    return true;
  return first.rfind("library.sqlite", 0) == 0;
}

bool isOfAnyLibrary(const fs::path& file)
{
  std::error_code error;
  for (fs::path folder = resolvedPath(file).parent_path(); folder != folder.parent_path();
       folder = folder.parent_path())
    if (fs::is_directory(folder / "cases", error) && fs::is_directory(folder / "objects", error) &&
        fs::exists(folder / ".lock", error) && isOfLibrary(file, folder))
      return true;
  return false;
}

bool isSource(const fs::path& file, const fs::path& folder)
{
  std::error_code error;
  if (folder.empty() || !fs::is_regular_file(file, error))
    return false;
  const Sources sources(folder);
  if (sources.empty())
    return false;
  const fs::path path = resolvedPath(file);
  if (sources.whenRead(path))
    return true;
  const fs::file_time_type written = fs::last_write_time(path, error);
  for (fs::path within = path.parent_path(); within != within.parent_path();
       within = within.parent_path())
    if (const auto read = sources.whenRead(within); read && (error || written <= *read))
      return true;
  return false;
}

void refuseOverwriting(const fs::path& file, const fs::path& folder)
{
  if ((!folder.empty() && isOfLibrary(file, folder)) || isOfAnyLibrary(file))
    throw core::Error(core::Fault::Refused,
                      core::printable(file) +
                          ": the library keeps its own data there; name another file");
  if (isSource(file, folder))
    throw core::Error(core::Fault::Refused,
                      core::printable(file) +
                          ": a case was made from this file, which would be replaced; name "
                          "another file");
}

void checkLibraryFolder(const fs::path& folder)
{
  std::error_code error;
  const fs::path whole = fs::absolute(folder, error).lexically_normal();
  const fs::path path = whole.has_filename() ? whole : whole.parent_path(); // "folder/"
  const fs::file_status status = fs::status(path, error);
  if (fs::is_directory(status))
    return;
  if (fs::exists(status))
    throw LibraryError(LibraryError::Reason::NotFound,
                       core::printable(folder) +
                           ": is a file; a library is a folder: give one, or a new name");
  const fs::path parent = path.parent_path();
  const fs::file_status above = fs::status(parent, error);
  if (fs::is_directory(above) || above.type() == fs::file_type::none) // may not be looked at
    return;
  if (fs::exists(above) || error == std::errc::not_a_directory)
    throw LibraryError(LibraryError::Reason::NotFound,
                       core::printable(folder) + ": no library can be there, as " +
                           core::printable(parent) + " is a file; give a folder");
  throw LibraryError(LibraryError::Reason::NotFound,
                     core::printable(folder) + ": no library can be there, as " +
                         core::printable(parent) +
                         " is not there; is the path right, and its disk mounted? For a new "
                         "library make that folder first");
}

} // namespace petrous::library
