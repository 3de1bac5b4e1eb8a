#include "petrous/Library/LibraryFiles.h"

#include <string>

#include "petrous/Core/Error.h"
#include "petrous/Core/InputFile.h"

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
        "burrs.json", "nodes.json", ".nodes.lock", "presets.json", ".presets.lock"})
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

void refuseOverwriting(const fs::path& file, const fs::path& folder)
{
  if ((!folder.empty() && isOfLibrary(file, folder)) || isOfAnyLibrary(file))
    throw core::Error(core::Fault::Refused,
                      core::printable(file) +
                          ": the library keeps its own data there; name another file");
}

} // namespace petrous::library
