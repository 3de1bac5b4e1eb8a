#pragma once

#include <cstdint>
#include <vector>

namespace petrous::simulation
{

// The file, little endian:
//
//   "PTRTICK\n"  u32 format version  u32 bytes of a TickRecord
//   u32 bytes of the set-up, the set-up as JSON, zstd with its checksum
//   blocks: u32 kBlockMark  u32 ticks  u32 bytes  the ticks (RecordCodec.h), zstd with its checksum
//   at the end of a whole file: u32 kEndMark  u64 ticks in all
constexpr char kMagic[] = "PTRTICK\n"; // 8 bytes without its zero
constexpr std::size_t kMagicBytes = 8;
constexpr std::uint32_t kFormatVersion = 1;
constexpr std::uint32_t kBlockMark = 0x4B434C42; // "BLCK"
constexpr std::uint32_t kEndMark = 0x21444E45;   // "END!"
constexpr std::uint32_t kMostTicks = 100000;     // of a block
constexpr std::uint32_t kMostSetup = 1 << 20;    // bytes

inline void putU32(std::vector<std::uint8_t>& to, std::uint32_t value)
{
  for (int byte = 0; byte < 4; ++byte)
    to.push_back(static_cast<std::uint8_t>(value >> (8 * byte)));
}

inline std::uint32_t getU32(const std::uint8_t* from)
{
  std::uint32_t value = 0;
  for (int byte = 0; byte < 4; ++byte)
    value |= static_cast<std::uint32_t>(from[byte]) << (8 * byte);
  return value;
}

// Packs with a checksum; throws core::Error when the library fails.
std::vector<std::uint8_t> pack(const std::vector<std::uint8_t>& raw);

// False when the bytes are damaged or give more than `most`.
bool unpack(const std::vector<std::uint8_t>& packed, std::size_t most,
            std::vector<std::uint8_t>& raw);

} // namespace petrous::simulation
