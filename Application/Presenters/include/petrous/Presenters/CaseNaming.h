#pragma once

#include <filesystem>
#include <string>

#include "petrous/Library/Library.h"

namespace petrous::presenters
{

/// A name that checkCaseName accepts, from that of a folder or file: endings of image formats, and
/// what may not stand in a case's name, are left out. "case" where nothing is left.
std::string caseNameFrom(const std::filesystem::path& source);

/// `name`, or "name 2", "name 3", ... when the library has one of that name.
std::string freeCaseName(const library::Library& library, const std::string& name);

/// Whether the library has a case of that name; false too for what is no name, as a path.
bool namesCase(const library::Library& library, const std::string& text);

} // namespace petrous::presenters
