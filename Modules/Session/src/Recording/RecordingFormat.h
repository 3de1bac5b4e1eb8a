#pragma once

#include <cstdint>
#include <vector>

namespace petrous::session
{

// File format, little-endian:
//
//   "PTRTICK\n"  u32 format version  u32 bytes of a TickRecord
//   u32 bytes of the setup, the setup as JSON, zstd with checksum
//   blocks: u32 kBlockMark  u32 ticks  u32 edits  u32 bytes of the ticks  u32 bytes of the edits
//           the ticks (RecordCodec.h), the edits (EditCodec.h), each zstd with checksum
//   at the end of a complete file: u32 kEndMark  u64 total ticks  u64 total edits
//
// The mask state of a tick results from edits of its block or of previous ones. In format 2 a pedal
// was a switch: ServoParameters::kPedalSpeed, which its readers would take for a drill that is on.
// Format 1 had no edits, and its ticks did not record their mask state.
constexpr char kMagic[] = "PTRTICK\n"; // 8 bytes without the terminating zero
constexpr std::size_t kMagicBytes = 8;
constexpr std::uint32_t kFormatVersion = 3;
constexpr std::uint32_t kOldestVersion = 2;      // that is read
constexpr std::uint32_t kBlockMark = 0x4B434C42; // "BLCK"
constexpr std::uint32_t kEndMark = 0x21444E45;   // "END!"
constexpr std::uint32_t kMaxTicks = 100000;      // per block
constexpr std::uint32_t kMaxEdits = 100000;      // per block
constexpr std::size_t kMarkBytes = 20;           // of a block's header, and of the end
constexpr std::uint32_t kMaxSetup = 1 << 20;     // bytes

inline void putU32(std::vector<std::uint8_t>& to, std::uint32_t value)
{
  for (int byte = 0; byte < 4; ++byte)
    to.push_back(static_cast<std::uint8_t>(value >> (8 * byte)));
}

inline void putU64(std::vector<std::uint8_t>& to, std::uint64_t value)
{
  putU32(to, static_cast<std::uint32_t>(value));
  putU32(to, static_cast<std::uint32_t>(value >> 32));
}

inline std::uint32_t getU32(const std::uint8_t* from)
{
  std::uint32_t value = 0;
  for (int byte = 0; byte < 4; ++byte)
    value |= static_cast<std::uint32_t>(from[byte]) << (8 * byte);
  return value;
}

inline std::uint64_t getU64(const std::uint8_t* from)
{
  return getU32(from) | static_cast<std::uint64_t>(getU32(from + 4)) << 32;
}

// Compresses with a checksum. Throws core::Error if the library fails.
std::vector<std::uint8_t> pack(const std::vector<std::uint8_t>& raw);

// False if the bytes are damaged or decompress to more than `most`.
bool unpack(const std::vector<std::uint8_t>& packed, std::size_t most,
            std::vector<std::uint8_t>& raw);

} // namespace petrous::session
