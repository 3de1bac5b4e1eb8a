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

/// Throws Error (Refused) naming the file if isOfLibrary, or isOfAnyLibrary: what is written there
/// would replace a case or a part of one.
void refuseOverwriting(const std::filesystem::path& file, const std::filesystem::path& folder = {});

} // namespace petrous::library
