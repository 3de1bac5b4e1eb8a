#pragma once

#include <optional>
#include <string>

#include "petrous/Dissection/Stroke.h"

namespace petrous::dissection
{

/// "cutting" or "diamond": the word of the command line, of manifests and of JSON.
const char* nameOf(Burr::Kind kind) noexcept;

/// The kind of that name; nothing for any other word.
std::optional<Burr::Kind> parseBurrKind(const std::string& name);

} // namespace petrous::dissection
