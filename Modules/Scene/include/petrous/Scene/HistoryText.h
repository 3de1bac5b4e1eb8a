#pragma once

#include <string>
#include <string_view>

#include "petrous/Scene/Case.h"

namespace petrous::scene
{

/// One line of JSON each, as the manifest has them: for a journal. Numbers go there and back
/// without loss. `...FromText` throws InvalidParameter when the text is not one that was written.
std::string toText(const StrokePart& stroke);
std::string toText(const dissection::History& history);
StrokePart strokeFromText(std::string_view text);
dissection::History historyFromText(std::string_view text);

} // namespace petrous::scene
