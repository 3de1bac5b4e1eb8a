#include "petrous/Core/NumberText.h"

#include <array>
#include <charconv>
#include <cmath>

namespace petrous::core
{

namespace
{

// The largest double has 309 digits before the point.
constexpr std::size_t kMaxLength = 512;

template <class T, class... Form>
std::string written(T value, Form... form)
{
  std::array<char, kMaxLength> text{};
  const auto end = std::to_chars(text.data(), text.data() + text.size(), value, form...);
  return {text.data(), end.ptr};
}

template <class T>
std::optional<T> parse(std::string_view text)
{
  if (!text.empty() && text.front() == '+')
  {
    text.remove_prefix(1);
    if (!text.empty() && text.front() == '-')
      return std::nullopt;
  }
  T value{};
  const auto end = std::from_chars(text.data(), text.data() + text.size(), value);
  if (end.ptr != text.data() + text.size() || text.empty() || end.ec == std::errc::invalid_argument)
    return std::nullopt;
  if (end.ec == std::errc())
    return value;
  // Underflow gives zero, as in strtod; overflow is not a number.
  if (text.front() == '-')
    text.remove_prefix(1);
  const std::size_t exponent = text.find_first_of("eE");
  const bool small = exponent == text.npos ? text.front() == '0' || text.front() == '.'
                                           : text[exponent + 1] == '-';
  return small ? std::optional<T>(T{0}) : std::nullopt;
}

} // namespace

std::string fixedText(double value, int decimals)
{
  return written(value, std::chars_format::fixed, decimals);
}

std::string generalText(double value, int digits)
{
  return written(value, std::chars_format::general, digits);
}

std::string plainText(double value, int digits)
{
  constexpr double kMost = 1e15, kLeast = 1e-9;
  const double size = std::abs(value);
  if (size >= kMost || (size > 0.0 && size < kLeast))
    return generalText(value, digits);
  const std::string rounded = written(value, std::chars_format::scientific, digits - 1);
  return written(parseDouble(rounded).value_or(value), std::chars_format::fixed);
}

std::string exactText(double value)
{
  return written(value);
}

std::string exactText(float value)
{
  return written(value);
}

std::optional<double> parseDouble(std::string_view text)
{
  return parse<double>(text);
}

std::optional<float> parseFloat(std::string_view text)
{
  return parse<float>(text);
}

std::string NumberRange::text() const
{
  const std::string upperText =
      plainText(upper) + (*unit == '\0' ? "" : " ") + unit; // no unit: a plain number
  return isLowerExcluded ? "above " + plainText(lower) + ", up to " + upperText
                         : plainText(lower) + " to " + upperText;
}

std::string NumberRange::refusal(double value, const char* word) const
{
  return std::string(isLowerExcluded ? "must lie " : "must lie within ") + text() +
         (word ? ", or be '" + std::string(word) + "'" : "") + ", not " + plainText(value);
}

namespace
{

bool isContinuation(char c) noexcept
{
  return (static_cast<unsigned char>(c) & 0xC0U) == 0x80U;
}

} // namespace

bool isUtf8(std::string_view text) noexcept
{
  for (std::size_t i = 0; i < text.size();)
  {
    const auto lead = static_cast<unsigned char>(text[i]);
    const std::size_t length = lead < 0x80                    ? 1
                               : lead >= 0xC2 && lead <= 0xDF ? 2
                               : lead >= 0xE0 && lead <= 0xEF ? 3
                               : lead >= 0xF0 && lead <= 0xF4 ? 4
                                                              : 0;
    if (length == 0 || length > text.size() - i)
      return false;
    for (std::size_t n = 1; n < length; ++n)
      if (!isContinuation(text[i + n]))
        return false;
    const int second = length > 2 ? static_cast<unsigned char>(text[i + 1]) : 0x80;
    if ((lead == 0xE0 && second < 0xA0) || (lead == 0xED && second > 0x9F) ||
        (lead == 0xF0 && second < 0x90) || (lead == 0xF4 && second > 0x8F))
      return false;
    i += length;
  }
  return true;
}

std::string utf8Prefix(std::string_view text, std::size_t bytes)
{
  if (text.size() > bytes)
    while (bytes > 0 && isContinuation(text[bytes]))
      --bytes;
  return std::string(text.substr(0, bytes));
}

PlainNumbers::PlainNumbers()
  : m_plain(newlocale(LC_NUMERIC_MASK, "C", static_cast<locale_t>(nullptr)))
  , m_before(uselocale(m_plain))
{
}

PlainNumbers::~PlainNumbers()
{
  uselocale(m_before);
  if (m_plain)
    freelocale(m_plain);
}

} // namespace petrous::core
