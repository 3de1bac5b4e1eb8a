#include "GzipMembers.h"

#include <cmath>
#include <random>

#include <gtest/gtest.h>
#include <zlib.h>

using namespace petrous::library;

namespace
{

/// Voxels of 16 bits, as of a CT: a smooth field with noise that is smooth along rows, too, as a
/// reconstruction leaves it; air all around is one value. `noise`: standard deviation.
std::string voxels(std::size_t edge, double noise, double smoothness)
{
  std::mt19937 random(7);
  std::normal_distribution<double> normal;
  std::string bytes;
  for (std::size_t k = 0; k < edge; ++k)
    for (std::size_t j = 0; j < edge; ++j)
    {
      double last = 0.0;
      for (std::size_t i = 0; i < edge; ++i)
      {
        last = smoothness * last + std::sqrt(1.0 - smoothness * smoothness) * normal(random);
        const auto place = [edge](std::size_t n)
        { return 2.0 * static_cast<double>(n) / static_cast<double>(edge) - 1.0; };
        const double r = std::hypot(place(i), place(j), place(k));
        const double value = r > 0.9 ? -1000.0 : 1000.0 * std::cos(5.0 * r) + noise * last;
        const auto voxel = static_cast<std::uint16_t>(std::lround(value));
        bytes += {static_cast<char>(voxel & 0xffU), static_cast<char>(voxel >> 8U)};
      }
    }
  return bytes;
}

std::vector<std::string> samplesOf(const std::string& bytes)
{
  constexpr std::size_t kParts = 8;
  std::vector<std::string> all;
  for (std::size_t n = 0; n < kParts; ++n)
    all.push_back(
        bytes.substr((2 * n + 1) * bytes.size() / (2 * kParts) - kSampleBytes / 2, kSampleBytes));
  return all;
}

std::size_t byGzip(const std::string& bytes)
{
  z_stream stream = {};
  EXPECT_EQ(::deflateInit2(&stream, 6, Z_DEFLATED, 15 + 16, 8, Z_DEFAULT_STRATEGY), Z_OK);
  std::string out(::deflateBound(&stream, static_cast<uLong>(bytes.size())), '\0');
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data()));
  stream.avail_in = static_cast<uInt>(bytes.size());
  stream.next_out = reinterpret_cast<Bytef*>(out.data());
  stream.avail_out = static_cast<uInt>(out.size());
  EXPECT_EQ(::deflate(&stream, Z_FINISH), Z_STREAM_END);
  ::deflateEnd(&stream);
  return out.size() - stream.avail_out;
}

} // namespace

// All at level 4 they would be up to 0.6 % larger. White noise of 20 HU on a smooth field is larger
// at each level that is fast enough, by less than 0.3 %.
TEST(GzipMembers, AreHardlyLargerThanByGzipForNoiseOfAnyKind)
{
  for (const double smoothness : {0.0, 0.9})
    for (const double noise : {5.0, 20.0})
    {
      const std::string bytes = voxels(160, noise, smoothness);
      const MemberLevels levels = levelsFor(samplesOf(bytes));
      const std::size_t ours = packMembers(bytes, levels).size();
      EXPECT_LE(static_cast<double>(ours), 1.003 * static_cast<double>(byGzip(bytes)))
          << noise << " HU, " << smoothness << ": " << levels.share << " of 12 at level "
          << levels.thorough << ", the others at " << levels.fast;
    }
}

// What is small at any level is packed at the fastest.
TEST(GzipMembers, AreFastWhereNothingIsGained)
{
  std::mt19937_64 random(7);
  std::string bytes;
  while (bytes.size() < 8 * kSampleBytes)
    bytes += static_cast<char>(random());
  const MemberLevels levels = levelsFor(samplesOf(bytes));
  for (std::size_t n = 0; n < MemberLevels::kCycle; ++n)
    EXPECT_EQ(levels(n), 1) << n;
}

TEST(GzipMembers, HaveEachLevelAsOftenAsItsShareSays)
{
  for (int share = 0; share <= MemberLevels::kCycle; ++share)
  {
    const MemberLevels levels{1, 7, share};
    int thorough = 0;
    for (std::size_t n = 0; n < MemberLevels::kCycle; ++n)
      thorough += levels(n) == 7 ? 1 : 0;
    EXPECT_EQ(thorough, share);
    EXPECT_EQ(levels(0), share > 0 ? 7 : 1);
  }
}
