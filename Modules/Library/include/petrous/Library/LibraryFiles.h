#pragma once

#include <filesystem>
#include <string>

namespace petrous::library
{

/// Absolute, without links as far as it exists; never throws.
std::filesystem::path resolvedPath(const std::filesystem::path& file);

/// The case of the library in that folder whose name reads as this one (scene::asRead), itself if
/// it is there; empty: none. A file system without regard to case cannot hold two.
std::string caseLike(const std::filesystem::path& library, const std::string& name);
/// Throws LibraryError (NameTaken) if there is one; `besides` does not count.
void refuseTakenName(const std::filesystem::path& library, const std::string& name,
                     const std::string& besides = {});

/// Whether the library in `folder`, which need not be there yet, keeps its own data at this path.
/// Of recordings, those that are there.
bool isOfLibrary(const std::filesystem::path& file, const std::filesystem::path& folder);
/// The same of any library that is there.
bool isOfAnyLibrary(const std::filesystem::path& file);

/// Whether parts of a case of the library in `folder` were read from this file, which is there: it
/// was itself imported or attached as a link, or it lies in a folder that was, and has not been
/// written since. Known by hashes of paths with the library's salt, also of cases that are deleted.
/// Throws LibraryError if the library cannot tell.
bool isSource(const std::filesystem::path& file, const std::filesystem::path& folder);

/// The one rule for files that the user names to be written; any other file that is there is
/// replaced (core::OutputFile). Throws Error (Refused) naming the file if isOfLibrary or
/// isOfAnyLibrary, since what is written there would replace a case or a part of one, and if
/// isSource. `folder`: of the library; empty: none is open.
void refuseOverwriting(const std::filesystem::path& file, const std::filesystem::path& folder);

/// Of a folder that the user named: throws LibraryError (NotFound) unless it is there or can be
/// made, that is, unless it is a file or the folder that it should lie in is not there.
void checkLibraryFolder(const std::filesystem::path& folder);

} // namespace petrous::library
