#pragma once

#include <optional>
#include <string>

#include "petrous/Dissection/Stroke.h"

namespace petrous::dissection
{

/// "cutting" or "diamond", as used on the command line, in manifests and in JSON.
const char* nameOf(Burr::Kind kind) noexcept;

/// The kind of that name; nullopt for any other word.
std::optional<Burr::Kind> parseBurrKind(const std::string& name);

/// The burr's name in the catalogue; the usual burr of a kind has that of the kind.
std::string nameOf(const Burr& burr);

/// Whether a burr or material may have that name: 1 to 40 of a to z, 0 to 9 and hyphens, as it is
/// used on the command line and in cases.
bool isCatalogueName(const std::string& name) noexcept;

/// For a burr read from a file: as `name` there, empty if it had none. Throws InvalidParameter for
/// what is no burr's name; its message does not repeat it.
void setName(Burr& burr, const std::string& name);

} // namespace petrous::dissection
