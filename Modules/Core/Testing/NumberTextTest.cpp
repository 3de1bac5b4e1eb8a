#include "petrous/Core/NumberText.h"
#include "petrous/Core/PositionText.h"

#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <locale>
#include <random>

#include <gtest/gtest.h>

namespace petrous::core
{
namespace
{

// German number format for streams: 1.234,5.
class Comma : public std::numpunct<char>
{
  char do_decimal_point() const override { return ','; }
  char do_thousands_sep() const override { return '.'; }
  std::string do_grouping() const override { return "\3"; }
};

class CommaStreams
{
public:
  CommaStreams()
    : m_before(std::locale::global(std::locale(std::locale(), new Comma)))
  {
  }
  ~CommaStreams() { std::locale::global(m_before); }

private:
  std::locale m_before;
};

TEST(NumberText, WritesAPointWhereTheLocaleHasAComma)
{
  const CommaStreams comma;
  EXPECT_EQ(fixedText(-1234.5678, 2), "-1234.57");
  EXPECT_EQ(fixedText(0.05, 0), "0");
  EXPECT_EQ(generalText(0.125), "0.125");
  EXPECT_EQ(generalText(1234567.0), "1.23457e+06");
  EXPECT_EQ(generalText(1e-5, 3), "1e-05");
  EXPECT_EQ(plainText(17353.2, 4), "17350");
  EXPECT_EQ(plainText(1234567.0), "1234570");
  EXPECT_EQ(plainText(1.49012e-8, 3), "0.0000000149");
  EXPECT_EQ(plainText(-0.125), "-0.125");
  EXPECT_EQ(plainText(2.5000001, 4), "2.5");
  EXPECT_EQ(plainText(0.0), "0");
  EXPECT_EQ(plainText(-1e30), "-1e+30");
  EXPECT_EQ(plainText(1e-300, 3), "1e-300");
  EXPECT_EQ(exactText(0.1), "0.1");
  EXPECT_EQ(exactText(0.1F), "0.1");
  EXPECT_EQ(fixedText(std::nan(""), 2), "nan");
}

TEST(NumberText, WritesTheLargestNumbersWhole)
{
  const double most = std::numeric_limits<double>::max();
  EXPECT_EQ(fixedText(-most, 6).size(), 1 + 309 + 7);
  EXPECT_EQ(parseDouble(fixedText(-most, 6)), -most);
}

TEST(NumberText, ReadsBackWhatItWroteToTheBit)
{
  std::mt19937_64 random(3);
  for (int n = 0; n < 20000; ++n)
  {
    const std::uint64_t bits = random();
    double value = 0.0;
    std::memcpy(&value, &bits, sizeof value);
    if (!std::isfinite(value))
      continue;
    ASSERT_EQ(parseDouble(exactText(value)), value);
    ASSERT_EQ(parseDouble(generalText(value, 17)), value);
  }
}

TEST(NumberText, ReadsWholeNumbersOfTextOnly)
{
  EXPECT_EQ(parseDouble("+2.5e3"), 2500.0);
  EXPECT_EQ(parseDouble("-.5"), -0.5);
  for (const char* bad : {"", "+", "-", "+-1", "2,5", "1.000,5", "1 ", " 1", "0x10", "mm"})
    EXPECT_FALSE(parseDouble(bad)) << bad;
}

TEST(NumberText, TakesTooSmallForZeroAndRefusesTooLarge)
{
  EXPECT_EQ(parseDouble("1e-400"), 0.0);
  EXPECT_EQ(parseDouble("-1E-400"), 0.0);
  EXPECT_EQ(parseDouble("0." + std::string(400, '0') + "1"), 0.0);
  EXPECT_EQ(parseFloat("1e-60"), 0.0F);
  EXPECT_FALSE(parseDouble("1e400"));
  EXPECT_FALSE(parseDouble("-1e+400"));
  EXPECT_FALSE(parseDouble("1" + std::string(400, '0')));
  EXPECT_FALSE(parseFloat("1e60"));
}

// All sequences of up to four bytes of a few that border each rule, judged by decoding them as the
// Unicode standard defines it: the shortest form of a code point up to U+10FFFF, no surrogate.
TEST(Utf8, AcceptsTheEncodingsOfCodePointsAlone)
{
  const auto decodes = [](std::string_view text)
  {
    while (!text.empty())
    {
      const auto lead = static_cast<unsigned char>(text[0]);
      std::size_t length = 0;
      while (length < 8 && (lead >> (7 - length) & 1) != 0)
        ++length;
      if (length == 1 || length > 4)
        return false;
      std::uint32_t code = length == 0 ? lead : lead & (0x7FU >> length);
      length = length == 0 ? 1 : length;
      if (text.size() < length)
        return false;
      for (std::size_t n = 1; n < length; ++n)
      {
        const auto byte = static_cast<unsigned char>(text[n]);
        if (byte >> 6 != 2)
          return false;
        code = code << 6 | (byte & 0x3FU);
      }
      const std::uint32_t least[] = {0, 0x80, 0x800, 0x10000};
      if (code < least[length - 1] || code > 0x10FFFF || (code >= 0xD800 && code <= 0xDFFF))
        return false;
      text.remove_prefix(length);
    }
    return true;
  };
  const std::string bytes("\x00\x41\x7f\x80\x8f\x90\x9f\xa0\xbf\xc0\xc1\xc2\xdf\xe0\xe1\xec\xed\xee"
                          "\xef\xf0\xf1\xf3\xf4\xf5\xff",
                          25);
  std::size_t valid = 0;
  for (std::size_t length = 0; length <= 4; ++length)
  {
    std::size_t count = 1;
    for (std::size_t n = 0; n < length; ++n)
      count *= bytes.size();
    for (std::size_t n = 0; n < count; ++n)
    {
      std::string text;
      for (std::size_t rest = n; text.size() < length; rest /= bytes.size())
        text += bytes[rest % bytes.size()];
      ASSERT_EQ(isUtf8(text), decodes(text)) << ::testing::PrintToString(text);
      valid += isUtf8(text) ? 1 : 0;
    }
  }
  EXPECT_GT(valid, 1000U);
}

TEST(Utf8, PrefixCutsNoCharacterInTwo)
{
  const std::string text = "a\xC3\xBC\xE2\x82\xAC\xF0\x9F\xA6\xB4z"; // 1, 2, 3, 4, 1 bytes
  const std::size_t whole[] = {0, 1, 1, 3, 3, 3, 6, 6, 6, 6, 10, 11, 11};
  for (std::size_t bytes = 0; bytes < 13; ++bytes)
    EXPECT_EQ(utf8Prefix(text, bytes), text.substr(0, whole[bytes])) << bytes;
}

TEST(NumberText, ARangeNamesItselfAndTheValueThatItRefuses)
{
  const CommaStreams comma;
  const NumberRange stiffness{0.001, 100.0, "N/mm"};
  EXPECT_TRUE(stiffness.contains(0.001) && stiffness.contains(100.0));
  EXPECT_FALSE(stiffness.contains(0.0) || stiffness.contains(100.5));
  EXPECT_FALSE(stiffness.contains(std::nan("")));
  EXPECT_EQ(stiffness.refusal(100.5), "must lie within 0.001 to 100 N/mm, not 100.5");
  EXPECT_EQ(stiffness.refusal(0.0, "rigid"),
            "must lie within 0.001 to 100 N/mm, or be 'rigid', not 0");
  const NumberRange thrust{0.0, 20.0, "N", true};
  EXPECT_FALSE(thrust.contains(0.0));
  EXPECT_EQ(thrust.refusal(0.0), "must lie above 0, up to 20 N, not 0");
  EXPECT_EQ((NumberRange{0.0, 1.0}.refusal(-1.0)), "must lie within 0 to 1, not -1");
}

// Towards right, anterior and inferior a coordinate in LPS is negative.
TEST(PositionText, NamesTheDirectionsAndHasNoSigns)
{
  EXPECT_EQ(positionText({-40.21, -5.04, -0.04}), "R 40.2  A 5.0  I 0.0 mm");
  EXPECT_EQ(positionText({3.0, 12.26, 145.0}), "L 3.0  P 12.3  S 145.0 mm");
}

} // namespace
} // namespace petrous::core
