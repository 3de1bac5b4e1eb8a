#pragma once

#include <algorithm>
#include <string>
#include <string_view>

#include <nlohmann/json.hpp>

namespace petrous::dissection
{

/// Error message for `text`: the parser's own message would quote the file. For a missing key or a
/// wrong type it is the parser's message without its id.
inline std::string jsonFault(const nlohmann::json::exception& error, std::string_view text)
{
  if (const auto* parsing = dynamic_cast<const nlohmann::json::parse_error*>(&error))
  {
    const std::string_view before = text.substr(0, std::min(parsing->byte, text.size()));
    return "not JSON; look at line " +
           std::to_string(1 + std::count(before.begin(), before.end(), '\n'));
  }
  const std::string what = error.what(); // "[json.exception.out_of_range.403] key 'x' not found"
  const std::size_t tag = what.find("] ");
  return tag == std::string::npos ? "not a catalogue" : what.substr(tag + 2);
}

} // namespace petrous::dissection
