#include "GzipMembers.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstring>
#include <limits>
#include <memory>
#include <new>

#include <libdeflate.h>
#include <tbb/parallel_for.h>
#include <zlib.h>

namespace petrous::library
{

namespace
{

constexpr std::size_t kTrailer = 8; // CRC-32, length

struct Level
{
  int level;
  double cost; ///< ns a byte, as on CTs; the same everywhere, so that equal images are packed alike
};
constexpr std::array<Level, 5> kLevels{{{1, 5.0}, {2, 9.0}, {4, 11.0}, {6, 17.0}, {7, 30.0}}};

void putNumber(char* to, std::uint32_t value)
{
  for (int n = 0; n < 4; ++n)
    to[n] = static_cast<char>(value >> (8 * n));
}

std::uint32_t number(const char* from)
{
  std::uint32_t value = 0;
  for (int n = 0; n < 4; ++n)
    value |= static_cast<std::uint32_t>(static_cast<unsigned char>(from[n])) << (8 * n);
  return value;
}

// ID, deflate, FEXTRA, no time, no flags, unknown system, 8 bytes of extra field, "PT", 4 bytes
constexpr char kHead[] = "\x1f\x8b\x08\x04\0\0\0\0\0\xff\x08\0PT\x04\0";
constexpr std::size_t kFixed = sizeof kHead - 1;
static_assert(kFixed + 4 == kMemberHead);

using Compressor = std::unique_ptr<libdeflate_compressor, decltype(&libdeflate_free_compressor)>;

Compressor compressorOf(int level)
{
  Compressor compressor(libdeflate_alloc_compressor(level), &libdeflate_free_compressor);
  if (!compressor)
    throw std::bad_alloc();
  return compressor;
}

std::vector<char> packed(std::string_view bytes, int level)
{
  const Compressor compressor = compressorOf(level);
  std::vector<char> out(kMemberHead + kTrailer +
                        libdeflate_deflate_compress_bound(compressor.get(), bytes.size()));
  const std::size_t got =
      libdeflate_deflate_compress(compressor.get(), bytes.data(), bytes.size(),
                                  out.data() + kMemberHead, out.size() - kMemberHead - kTrailer);
  out.resize(kMemberHead + got + kTrailer);
  std::memcpy(out.data(), kHead, kFixed);
  putNumber(out.data() + kFixed, static_cast<std::uint32_t>(out.size()));
  putNumber(out.data() + kMemberHead + got, libdeflate_crc32(0, bytes.data(), bytes.size()));
  putNumber(out.data() + kMemberHead + got + 4, static_cast<std::uint32_t>(bytes.size()));
  return out;
}

/// Of a piece with the two bytes and the checksum of the zlib format, which are the same for all.
std::size_t packedBytes(const std::string& piece, int level)
{
  const Compressor compressor = compressorOf(level);
  std::vector<char> out(libdeflate_zlib_compress_bound(compressor.get(), piece.size()));
  return libdeflate_zlib_compress(compressor.get(), piece.data(), piece.size(), out.data(),
                                  out.size());
}

std::size_t packedByZlib(const std::string& piece)
{
  constexpr int kOfGzip = 6;
  uLongf bytes = compressBound(static_cast<uLong>(piece.size()));
  std::vector<Bytef> out(bytes);
  if (compress2(out.data(), &bytes, reinterpret_cast<const Bytef*>(piece.data()),
                static_cast<uLong>(piece.size()), kOfGzip) != Z_OK)
    throw std::bad_alloc();
  return bytes;
}

} // namespace

// The first of a cycle is at the thorough level if any is: small files have one member.
int MemberLevels::operator()(std::size_t member) const noexcept
{
  const auto before = [this](std::size_t n)
  { return (n * static_cast<std::size_t>(share) + kCycle - 1) / kCycle; };
  const std::size_t n = member % kCycle;
  return before(n + 1) > before(n) ? thorough : fast;
}

MemberLevels levelsFor(const std::vector<std::string>& samples)
{
  using Sizes = std::array<double, kLevels.size() + 1>; // bytes; the last by zlib
  std::vector<Sizes> sizes(samples.size());
  tbb::parallel_for(std::size_t{0}, samples.size(),
                    [&](std::size_t n)
                    {
                      for (std::size_t l = 0; l < kLevels.size(); ++l)
                        sizes[n][l] =
                            static_cast<double>(packedBytes(samples[n], kLevels[l].level));
                      sizes[n].back() = static_cast<double>(packedByZlib(samples[n]));
                    });

  // Of each level, by how much it is larger than zlib, as a part; and at worst, with the standard
  // error of a ratio of means (Cochran, Sampling Techniques, 1977, 6.3).
  std::array<double, kLevels.size()> excess{}, atWorst{};
  const auto count = static_cast<double>(sizes.size());
  for (std::size_t l = 0; l < kLevels.size(); ++l)
  {
    double sum = 0.0, byZlib = 0.0, squares = 0.0;
    for (const Sizes& size : sizes)
    {
      sum += size[l];
      byZlib += size.back();
    }
    const double ratio = sum / byZlib;
    for (const Sizes& size : sizes)
      squares += std::pow(size[l] - ratio * size.back(), 2);
    excess[l] = ratio - 1.0;
    atWorst[l] = excess[l] + std::sqrt(squares * count / std::max(count - 1.0, 1.0)) / byZlib;
  }

  const auto smallest =
      static_cast<std::size_t>(std::min_element(excess.begin(), excess.end()) - excess.begin());
  MemberLevels best{kLevels[smallest].level, kLevels[smallest].level};
  double least = std::numeric_limits<double>::infinity();
  const auto offer = [&](std::size_t fast, std::size_t thorough, int share)
  {
    const double cost =
        (MemberLevels::kCycle - share) * kLevels[fast].cost + share * kLevels[thorough].cost;
    if (cost >= least)
      return;
    least = cost;
    best = {kLevels[fast].level, kLevels[thorough].level, share};
  };
  for (std::size_t l = 0; l < kLevels.size(); ++l)
    if (atWorst[l] <= 0.0)
    {
      offer(l, l, MemberLevels::kCycle);
      for (std::size_t fast = 0; fast < l; ++fast)
        if (atWorst[fast] > 0.0)
          offer(fast, l,
                static_cast<int>(std::ceil(MemberLevels::kCycle * atWorst[fast] /
                                           (atWorst[fast] - atWorst[l])))); // at most kCycle
    }
  return best;
}

std::string packMembers(std::string_view bytes, const MemberLevels& levels)
{
  std::vector<std::vector<char>> members((bytes.size() + kMemberBytes - 1) / kMemberBytes);
  tbb::parallel_for(std::size_t{0}, members.size(),
                    [&](std::size_t n) {
                      members[n] = packed(bytes.substr(n * kMemberBytes, kMemberBytes), levels(n));
                    });
  std::string all;
  for (const auto& member : members)
    all.append(member.data(), member.size());
  return all;
}

std::size_t memberLength(const char* head)
{
  if (std::memcmp(head, kHead, kFixed) != 0)
    return 0;
  const std::size_t length = number(head + kFixed);
  // Incompressible data grow by 5 bytes a block of at least 5000.
  constexpr std::size_t kMost = kMemberBytes + kMemberBytes / 512 + 4096;
  return length > kMemberHead + kTrailer && length <= kMost ? length : 0;
}

bool unpackMembers(const std::vector<std::string_view>& members, std::vector<char>& bytes)
{
  std::vector<std::size_t> starts{0};
  for (const std::string_view member : members)
  {
    const std::uint32_t length = number(member.data() + member.size() - 4);
    if (length > kMemberBytes)
      return false;
    starts.push_back(starts.back() + length);
  }
  bytes.resize(starts.back());
  std::atomic<bool> sound{true};
  tbb::parallel_for(
      std::size_t{0}, members.size(),
      [&](std::size_t n)
      {
        const std::unique_ptr<libdeflate_decompressor, decltype(&libdeflate_free_decompressor)>
            decompressor(libdeflate_alloc_decompressor(), &libdeflate_free_decompressor);
        if (!decompressor)
          throw std::bad_alloc();
        const std::string_view member = members[n];
        char* to = bytes.data() + starts[n];
        const std::size_t length = starts[n + 1] - starts[n];
        const libdeflate_result result = libdeflate_deflate_decompress(
            decompressor.get(), member.data() + kMemberHead, member.size() - kMemberHead - kTrailer,
            to, length, nullptr);
        if (result != LIBDEFLATE_SUCCESS ||
            libdeflate_crc32(0, to, length) != number(member.data() + member.size() - kTrailer))
          sound = false;
      });
  return sound;
}

} // namespace petrous::library
