#include "petrous/Core/NumberText.h"

#include <array>
#include <charconv>

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
      generalText(upper) + (*unit == '\0' ? "" : " ") + unit; // no unit: a plain number
  return isLowerExcluded ? "above " + generalText(lower) + ", up to " + upperText
                         : generalText(lower) + " to " + upperText;
}

std::string NumberRange::refusal(double value, const char* word) const
{
  return std::string(isLowerExcluded ? "must lie " : "must lie within ") + text() +
         (word ? ", or be '" + std::string(word) + "'" : "") + ", not " + generalText(value);
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
