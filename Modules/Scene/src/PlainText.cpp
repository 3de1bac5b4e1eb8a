#include "petrous/Scene/PlainText.h"

#include <cstddef>

#include "petrous/Core/NumberText.h"

namespace petrous::scene
{

namespace
{

/// A character of UTF-8: its code point, and its bytes. Where the text is malformed: one byte.
struct Character
{
  char32_t code = 0;
  std::size_t bytes = 1;
  bool isWhole = true; ///< false: a byte of no character
};

Character characterAt(std::string_view text, std::size_t at)
{
  const auto byte = [text](std::size_t n) { return static_cast<unsigned char>(text[n]); };
  const unsigned first = byte(at);
  const std::size_t bytes = first >= 0xf0 ? 4 : first >= 0xe0 ? 3 : first >= 0xc0 ? 2 : 1;
  if (bytes == 1 || !core::isUtf8(text.substr(at, bytes)))
    return {first, 1, first < 0x80};
  char32_t code = first & (0xffU >> (bytes + 1));
  for (std::size_t n = 1; n < bytes; ++n)
    code = code << 6 | (byte(at + n) & 0x3fU);
  return {code, bytes};
}

bool isWithin(char32_t code, char32_t first, char32_t last)
{
  return code >= first && code <= last;
}

bool isControl(char32_t code)
{
  return code < 0x20 || isWithin(code, 0x7f, 0x9f) || isWithin(code, 0x202a, 0x202e) ||
         isWithin(code, 0x2066, 0x2069);
}

bool isInvisible(char32_t code)
{
  return isControl(code) || code == 0xad || code == 0x61c || isWithin(code, 0x200b, 0x200f) ||
         isWithin(code, 0x2028, 0x2029) || isWithin(code, 0x2060, 0x206f) || code == 0xfeff ||
         isWithin(code, 0xe0000, 0xe007f);
}

bool isOneOf(std::string_view allowed, const Character& one)
{
  return one.code < 0x80 && allowed.find(static_cast<char>(one.code)) != allowed.npos;
}

template <class IsHidden>
std::string withReplaced(std::string_view text, const IsHidden& isHidden)
{
  constexpr std::string_view kReplacement = "\ufffd";
  std::string seen;
  for (std::size_t at = 0; at < text.size();)
  {
    const Character one = characterAt(text, at);
    seen += isHidden(one) ? kReplacement : text.substr(at, one.bytes);
    at += one.bytes;
  }
  return seen;
}

} // namespace

bool hasControls(std::string_view text, std::string_view allowed) noexcept
{
  for (std::size_t at = 0; at < text.size();)
  {
    const Character one = characterAt(text, at);
    if (isControl(one.code) && !isOneOf(allowed, one))
      return true;
    at += one.bytes;
  }
  return false;
}

bool hasInvisible(std::string_view text) noexcept
{
  for (std::size_t at = 0; at < text.size();)
  {
    const Character one = characterAt(text, at);
    if (isInvisible(one.code))
      return true;
    at += one.bytes;
  }
  return false;
}

std::string withoutInvisible(std::string_view text)
{
  std::string seen;
  for (std::size_t at = 0; at < text.size();)
  {
    const Character one = characterAt(text, at);
    if (!isInvisible(one.code))
      seen += text.substr(at, one.bytes);
    at += one.bytes;
  }
  const std::size_t first = seen.find_first_not_of(' ');
  return first == seen.npos ? std::string()
                            : seen.substr(first, seen.find_last_not_of(' ') + 1 - first);
}

std::string withVisible(std::string_view text)
{
  return withReplaced(text,
                      [](const Character& one) { return !one.isWhole || isInvisible(one.code); });
}

std::string withVisibleControls(std::string_view text, std::string_view allowed)
{
  return withReplaced(text, [allowed](const Character& one)
                      { return isControl(one.code) && !isOneOf(allowed, one); });
}

} // namespace petrous::scene
