#pragma once

#include <string>
#include <string_view>

#include "petrous/Scene/Case.h"

namespace petrous::scene
{

/// One line of JSON each, in the manifest's format: for a journal. Numbers round-trip exactly.
/// `...FromText` throws InvalidParameter if the text was not written by these functions.
std::string toText(const dissection::Stroke& stroke);
std::string toText(const dissection::History& history);
dissection::Stroke strokeFromText(std::string_view text);
dissection::History historyFromText(std::string_view text);

} // namespace petrous::scene
