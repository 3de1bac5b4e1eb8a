#include "petrous/Library/DefaultFolder.h"

#include <cstdlib>

#include "LibraryFolder.h"
#include "petrous/Core/InputFile.h"
#include "petrous/Core/OutputFile.h"
#include "petrous/Library/LibraryError.h"
#include "petrous/Library/LibraryFiles.h"

namespace petrous::library
{

namespace fs = std::filesystem;

namespace
{

constexpr std::uintmax_t kLongestPath = 4096;

fs::path homeFolder(const char* variable, const char* belowHome)
{
  if (const char* folder = std::getenv(variable); folder && *folder)
    return folder;
  if (const char* home = std::getenv("HOME"); home && *home)
    return fs::path(home) / belowHome;
  return {};
}

} // namespace

fs::path usualFolder()
{
  const fs::path data = homeFolder("XDG_DATA_HOME", ".local/share");
  return data.empty() ? data : data / "petrous";
}

fs::path defaultFolderFile()
{
  const fs::path settings = homeFolder("XDG_CONFIG_HOME", ".config");
  return settings.empty() ? settings : settings / "petrous/library";
}

fs::path defaultFolder()
{
  const fs::path file = defaultFolderFile();
  std::error_code error;
  if (file.empty() || !fs::exists(fs::symlink_status(file, error)))
    return usualFolder();
  std::string text;
  try
  {
    text = core::readFile(file, kLongestPath);
  }
  catch (const core::InputFileError& fault)
  {
    throw libraryError(fault);
  }
  const fs::path folder = text.substr(0, text.find('\n'));
  if (!folder.is_absolute())
    throw LibraryError(LibraryError::Reason::Damaged,
                       core::printable(file) +
                           ": does not name the library's folder; write its path there, or remove "
                           "the file to use the usual one");
  if (fs::exists(folder, error))
    checkLibraryFolder(folder);
  if (!fs::is_directory(folder, error))
    throw LibraryError(LibraryError::Reason::NotFound,
                       core::printable(folder) +
                           ": the library's folder is not there; connect its disk, or choose "
                           "another folder (petrous library folder DIR)");
  return folder;
}

void chooseDefaultFolder(const fs::path& folder)
{
  const fs::path file = defaultFolderFile();
  if (file.empty())
    throw LibraryError(LibraryError::Reason::Unwritable,
                       "no home folder to keep the choice in; give --library DIR instead");
  std::error_code error;
  const fs::path chosen = folder.empty() ? folder : fs::absolute(folder).lexically_normal();
  if (chosen.empty() || chosen == usualFolder().lexically_normal())
  {
    if (!fs::remove(file, error) && error)
      throwForErrno(error.value(), file);
    return;
  }
  if (chosen.string().find('\n') != std::string::npos)
    throw LibraryError(LibraryError::Reason::Unwritable,
                       core::printable(chosen) + ": a library's path must be one line");
  if (isOfAnyLibrary(chosen))
    throw LibraryError(LibraryError::Reason::Unwritable,
                       core::printable(chosen) +
                           ": a library keeps its own data there; choose that library's folder, or "
                           "one outside of it");
  checkLibraryFolder(chosen);
  makeFolder(chosen);
  makeFolder(file.parent_path());
  try
  {
    core::writeFile(file, chosen.string() + "\n");
  }
  catch (const core::OutputFileError& fault)
  {
    throw libraryError(fault, "the library's folder is as it was");
  }
}

} // namespace petrous::library
