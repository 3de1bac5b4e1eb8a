#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

#include <locale.h>

namespace petrous::core
{

// Locale-independent number formatting and parsing: decimal point, no grouping, regardless of
// LC_NUMERIC and the global std::locale, so that files, shaders and responses are the same
// everywhere. Thread-safe.

/// `decimals` digits after the point, as "%.*f" in the C locale.
std::string fixedText(double value, int decimals);
/// `digits` significant digits, as "%.*g" in the C locale; 6 is the default of a stream.
std::string generalText(double value, int digits = 6);
/// The same digits without an exponent, for texts that people read: "17350", "0.0000000149"; with
/// one from 1e15 on and below 1e-9, which only damaged files have.
std::string plainText(double value, int digits = 6);
/// The shortest representation that round-trips.
std::string exactText(double value);
std::string exactText(float value);

/// Parses the whole of `text`, with an optional sign; nullopt if it is not a number or overflows.
/// Underflow gives 0.
std::optional<double> parseDouble(std::string_view text);
std::optional<float> parseFloat(std::string_view text);

/// Whether `text` is well-formed UTF-8 [Unicode, table 3-7]: no overlong forms, surrogates or code
/// points beyond U+10FFFF.
bool isUtf8(std::string_view text) noexcept;

/// The start of a well-formed UTF-8 text, of at most `bytes` bytes; no character is cut in two.
std::string utf8Prefix(std::string_view text, std::size_t bytes);

/// The values that a number may have, and the text that refuses any other.
struct NumberRange
{
  double lower = 0.0;
  double upper = 0.0;
  const char* unit = "";
  bool isLowerExcluded = false;

  constexpr bool contains(double value) const noexcept // false for NaN
  {
    return (isLowerExcluded ? value > lower : value >= lower) && value <= upper;
  }
  /// "0.001 to 100 N/mm"; without its lower end "above 0, up to 20 N".
  std::string text() const;
  /// "must lie within 0.001 to 100 N/mm, or be 'rigid', not 7"; `word`: what may stand instead of a
  /// number, nullptr: nothing may.
  std::string refusal(double value, const char* word = nullptr) const;
};

/// RAII: while it lives, the C library formats and parses numbers with a decimal point in this
/// thread. For calls into libraries that follow LC_NUMERIC.
class PlainNumbers
{
public:
  PlainNumbers();
  ~PlainNumbers();
  PlainNumbers(const PlainNumbers&) = delete;
  PlainNumbers& operator=(const PlainNumbers&) = delete;

private:
  locale_t m_plain;
  locale_t m_before;
};

} // namespace petrous::core
