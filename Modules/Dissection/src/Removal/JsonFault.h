#pragma once

#include <algorithm>
#include <string>
#include <string_view>

#include <nlohmann/json.hpp>

namespace petrous::dissection
{

/// What is wrong with `text`, in words of our own: the parser's quote the file. Of a key that is
/// missing or of another type it tells what the parser says of that, without its own numbering.
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
