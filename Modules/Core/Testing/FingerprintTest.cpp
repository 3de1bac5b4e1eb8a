#include <set>
#include <vector>

#include <gtest/gtest.h>

#include "petrous/Core/Fingerprint.h"

using petrous::core::Fingerprint;

namespace
{

std::uint64_t of(const std::vector<unsigned char>& bytes)
{
  Fingerprint print;
  print.add(bytes.data(), bytes.size());
  return print.value();
}

} // namespace

TEST(Fingerprint, IsTheSameForTheSameDataOnly)
{
  std::vector<unsigned char> bytes(101);
  for (std::size_t n = 0; n < bytes.size(); ++n)
    bytes[n] = static_cast<unsigned char>(7 * n);
  EXPECT_EQ(of(bytes), of(bytes));
  std::set<std::uint64_t> seen{of(bytes)};
  for (std::size_t n = 0; n < bytes.size(); ++n)
    for (int bit = 0; bit < 8; ++bit)
    {
      auto other = bytes;
      other[n] = static_cast<unsigned char>(other[n] ^ 1 << bit);
      EXPECT_TRUE(seen.insert(of(other)).second) << n;
    }
}

TEST(Fingerprint, TellsLengthsAndPiecesApart)
{
  std::set<std::uint64_t> seen;
  for (std::size_t length = 0; length < 40; ++length)
    EXPECT_TRUE(seen.insert(of(std::vector<unsigned char>(length))).second) << length;
  Fingerprint ab, ba;
  ab.add(1.0);
  ab.add(2.0);
  ba.add(2.0);
  ba.add(1.0);
  EXPECT_NE(ab.value(), ba.value());
  Fingerprint zero, minus;
  zero.add(0.0);
  minus.add(-0.0);
  EXPECT_NE(zero.value(), minus.value()) << "of bits, not of values";
}
