#include "petrous/Core/NumberText.h"

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

} // namespace
} // namespace petrous::core
