#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
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

/// Packs bytes into members of kMemberBytes, in parallel. Level 1 to 12 (libdeflate);
/// ArchiveOptions::level.
std::string packMembers(std::string_view bytes, std::optional<int> level);

/// Length of the member that begins so; 0 if this is no member of packMembers. `head`: kMemberHead
/// bytes.
std::size_t memberLength(const char* head);

/// Unpacks whole members in parallel, verifying each one's CRC-32 and length. False if one is
/// damaged.
bool unpackMembers(const std::vector<std::string_view>& members, std::vector<char>& bytes);

} // namespace petrous::library
