#pragma once

#include <filesystem>
#include <string>

#include "petrous/Library/Library.h"

namespace petrous::presenters
{

/// A name that checkCaseName accepts, from that of a folder or file: image file extensions and
/// characters not allowed in case names are dropped. "case" if nothing is left.
std::string caseNameFrom(const std::filesystem::path& source);

/// `name`, or "name 2", "name 3", ... if the library has a case of that name.
std::string freeCaseName(const library::Library& library, const std::string& name);

/// Throws InvalidParameter unless the name is valid for a case and the library has none of it.
void checkFreeCaseName(const library::Library& library, const std::string& name);

/// The name of a structure, mesh or MR as lists, pictures, messages and reports show it: with
/// blanks for underscores.
std::string shownName(std::string part);

/// Whether the library has a case of that name; false also for an invalid name, such as a path.
bool namesCase(const library::Library& library, const std::string& text);

} // namespace petrous::presenters
