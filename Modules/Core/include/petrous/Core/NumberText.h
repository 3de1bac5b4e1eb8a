#pragma once

#include <optional>
#include <string>
#include <string_view>

#include <locale.h>

namespace petrous::core
{

// Numbers as text with a decimal point and without grouping, whatever LC_NUMERIC and the global
// std::locale say: what is written into a file, a shader or an answer reads the same everywhere.
// Thread-safe.

/// `decimals` digits after the point, as "%.*f" of the C locale.
std::string fixedText(double value, int decimals);
/// `digits` significant ones, as "%.*g" of the C locale; 6 are what a stream shows.
std::string generalText(double value, int digits = 6);
/// The shortest digits that read back to the same number.
std::string exactText(double value);
std::string exactText(float value);

/// The whole of `text` as a number, with or without a sign; nothing where it is none or too large
/// for the type. A number too small for it is 0.
std::optional<double> parseDouble(std::string_view text);
std::optional<float> parseFloat(std::string_view text);

/// While it lives, the C library reads and writes numbers with a point in this thread: for calls
/// into libraries that follow LC_NUMERIC.
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
