#pragma once

#include <filesystem>

namespace petrous::library
{

/// The library's folder where neither --library nor PETROUS_LIBRARY names one, for window and
/// command: the chosen one, else the usual one. Empty: there is no home folder. Throws LibraryError
/// (NotFound) if the chosen one is not there, since another library must not take its place
/// silently; (Damaged) if the file that names it cannot be read.
std::filesystem::path defaultFolder();

/// $XDG_DATA_HOME/petrous, else ~/.local/share/petrous; empty: there is no home folder.
std::filesystem::path usualFolder();

/// Chooses the default for all programs of this user from their next start; makes the folder if it
/// is not there (checkLibraryFolder). Empty, or the usual one: back to that. Nothing is moved.
/// Throws LibraryError.
void chooseDefaultFolder(const std::filesystem::path& folder);

/// The file that names it, a line: $XDG_CONFIG_HOME/petrous/library, else below ~/.config.
std::filesystem::path defaultFolderFile();

} // namespace petrous::library
