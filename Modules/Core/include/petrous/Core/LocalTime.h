#pragma once

#include <ctime>
#include <string>

namespace petrous::core
{

/// A time in the local time zone, in a format of strftime that does not follow the locale, e.g.
/// "%Y-%m-%d"; at most 63 characters.
inline std::string localTime(const char* format, std::time_t time = std::time(nullptr))
{
  std::tm local{};
  ::localtime_r(&time, &local);
  char text[64] = "";
  std::strftime(text, sizeof text, format, &local);
  return text;
}

/// Today's date as YYYY-MM-DD.
inline std::string today()
{
  return localTime("%Y-%m-%d");
}

} // namespace petrous::core
