#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace petrous::library
{

/// gzip files (RFC 1952) of independent members, so that all cores pack and unpack them. A member
/// states its own length in an extra field ("PT", 4 bytes: its bytes, little-endian), as blocked
/// gzip files do; other programs read one member after the other.
constexpr std::size_t kMemberBytes = std::size_t{4} << 20; ///< of a member, unpacked; the last less

/// Bytes that state a member's length: the fixed header and the extra field.
constexpr std::size_t kMemberHead = 20;

/// The levels (libdeflate, 1 to 12) at which members are packed.
struct MemberLevels
{
  static constexpr int kCycle = 12; ///< members

  int fast = 1, thorough = 1;
  int share = kCycle; ///< of kCycle members in turn, how many at `thorough`

  int operator()(std::size_t member) const noexcept;
};

constexpr std::size_t kSampleBytes = std::size_t{128} << 10; ///< of a sample for levelsFor

/// The fastest mix of two levels up to 7 that makes a file no larger than zlib does at level 6
/// (gzip -6), by samples of it (at least one) and with the standard error of what they say; the
/// level with the smallest samples where none does. The whole may be larger than zlib's all the
/// same, by up to 0.3 % for much noise: the standard error does not cover that both pack a sample
/// and the whole unlike. Voxels of CTs differ too much for one mix: at level 1 those of scanners
/// are up to 9 % larger than by zlib, noise alone is as large.
MemberLevels levelsFor(const std::vector<std::string>& samples);

/// Packs bytes into members of kMemberBytes, in parallel. A file that is packed piece by piece is
/// given in pieces of MemberLevels::kCycle members.
std::string packMembers(std::string_view bytes, const MemberLevels& levels);

/// Length of the member that begins so; 0 if this is no member of packMembers. `head`: kMemberHead
/// bytes.
std::size_t memberLength(const char* head);

/// Unpacks whole members in parallel, verifying each one's CRC-32 and length. False if one is
/// damaged.
bool unpackMembers(const std::vector<std::string_view>& members, std::vector<char>& bytes);

} // namespace petrous::library
