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

} // namespace petrous::dissection
