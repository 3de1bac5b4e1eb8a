#include "GzipMembers.h"

#include <algorithm>
#include <atomic>
#include <cstring>
#include <memory>
#include <new>

#include <libdeflate.h>
#include <tbb/parallel_for.h>

namespace petrous::library
{

namespace
{

constexpr std::size_t kTrailer = 8; // CRC-32, length

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

std::vector<char> packed(std::string_view bytes, int level)
{
  const std::unique_ptr<libdeflate_compressor, decltype(&libdeflate_free_compressor)> compressor(
      libdeflate_alloc_compressor(level), &libdeflate_free_compressor);
  if (!compressor)
    throw std::bad_alloc();
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

} // namespace

std::string packMembers(std::string_view bytes, std::optional<int> level)
{
  const auto levelOf = [level](std::size_t n) { return level ? *level : n % 3 == 2 ? 4 : 1; };
  std::vector<std::vector<char>> members((bytes.size() + kMemberBytes - 1) / kMemberBytes);
  tbb::parallel_for(std::size_t{0}, members.size(),
                    [&](std::size_t n) {
                      members[n] = packed(bytes.substr(n * kMemberBytes, kMemberBytes), levelOf(n));
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
