#pragma once

namespace petrous::core
{

/// Letters of ASCII in the other case; all else is kept. That of the C library follows the locale:
/// in Turkish the lower case of "I" is no letter of ASCII.
constexpr char asciiLower(char c) noexcept
{
  return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
}
constexpr char asciiUpper(char c) noexcept
{
  return c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
}

} // namespace petrous::core
