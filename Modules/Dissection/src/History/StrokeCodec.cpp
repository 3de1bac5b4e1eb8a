#include "petrous/Dissection/StrokeCodec.h"

#include <algorithm>
#include <cstring>

#include <zstd.h>

namespace petrous::dissection
{

namespace
{

using volume::CutMask;

// Layout before compression, little endian: magic "PSTK", u32 version, u32 edge, u32 brick count,
// then the u32 brick indices, then for each brick the low bytes of all differences, then the high
// bytes: these are nearly constant and compress well.
constexpr char kMagic[4] = {'P', 'S', 'T', 'K'};
constexpr std::uint32_t kVersion = 1;
constexpr std::size_t kHeader = 16;
constexpr int kLevel = 3;
constexpr std::size_t kBrickBytes = 2 * CutMask::kBrickVoxels;

void putU32(std::uint8_t* to, std::uint32_t value)
{
  for (int byte = 0; byte < 4; ++byte)
    to[byte] = static_cast<std::uint8_t>(value >> (8 * byte));
}

std::uint32_t getU32(const std::uint8_t* from)
{
  std::uint32_t value = 0;
  for (int byte = 0; byte < 4; ++byte)
    value |= static_cast<std::uint32_t>(from[byte]) << (8 * byte);
  return value;
}

std::uint16_t valueOf(const CutMask::BrickVersion& version, std::size_t n)
{
  return version ? (*version)[n] : CutMask::kUntouched;
}

[[noreturn]] void damaged(const char* what)
{
  throw core::InvalidParameter(std::string("stroke: ") + what +
                               "; the file is damaged or belongs to another case");
}

std::vector<std::uint8_t> decompress(const std::vector<std::uint8_t>& bytes, std::size_t limit)
{
  const unsigned long long size = ZSTD_getFrameContentSize(bytes.data(), bytes.size());
  if (size == ZSTD_CONTENTSIZE_ERROR || size == ZSTD_CONTENTSIZE_UNKNOWN || size < kHeader ||
      size > limit)
    damaged("its size is not that of a stroke on this grid");
  std::vector<std::uint8_t> raw(static_cast<std::size_t>(size));
  if (ZSTD_decompress(raw.data(), raw.size(), bytes.data(), bytes.size()) != raw.size())
    damaged("it does not unpack");
  return raw;
}

// Bricks at the grid's upper faces extend beyond it.
bool takesBeyond(const CutMask& mask, std::size_t brick, const std::uint8_t* voxels)
{
  constexpr int kEdge = CutMask::kBrickEdge;
  const core::Index3 size = mask.brickBox(brick).size();
  if (size == core::Index3{kEdge, kEdge, kEdge})
    return false;
  for (int k = 0, n = 0; k < kEdge; ++k)
    for (int j = 0; j < kEdge; ++j)
      for (int i = 0; i < kEdge; ++i, ++n)
        if ((i >= size[0] || j >= size[1] || k >= size[2]) &&
            (voxels[n] | voxels[CutMask::kBrickVoxels + n]) != 0)
          return true;
  return false;
}

} // namespace

std::vector<std::uint8_t> encodeDeltas(const std::vector<BrickDelta>& deltas)
{
  std::vector<std::uint8_t> raw(kHeader + deltas.size() * (4 + kBrickBytes));
  std::memcpy(raw.data(), kMagic, sizeof kMagic);
  putU32(&raw[4], kVersion);
  putU32(&raw[8], CutMask::kBrickEdge);
  putU32(&raw[12], static_cast<std::uint32_t>(deltas.size()));
  std::uint8_t* voxels = raw.data() + kHeader + 4 * deltas.size();
  for (std::size_t d = 0; d < deltas.size(); ++d)
  {
    putU32(&raw[kHeader + 4 * d], static_cast<std::uint32_t>(deltas[d].brick));
    for (std::size_t n = 0; n < CutMask::kBrickVoxels; ++n)
    {
      const int taken = valueOf(deltas[d].before, n) - valueOf(deltas[d].after, n);
      voxels[n] = static_cast<std::uint8_t>(taken & 255);
      voxels[CutMask::kBrickVoxels + n] = static_cast<std::uint8_t>(taken >> 8 & 255);
    }
    voxels += kBrickBytes;
  }
  std::vector<std::uint8_t> packed(ZSTD_compressBound(raw.size()));
  const std::size_t size =
      ZSTD_compress(packed.data(), packed.size(), raw.data(), raw.size(), kLevel);
  if (ZSTD_isError(size))
    throw core::Error(core::Fault::Internal, "stroke: could not be compressed");
  packed.resize(size);
  packed.shrink_to_fit(); // it may be kept for a long time
  return packed;
}

void applyDeltas(const std::vector<std::uint8_t>& packed, Step step, BrickDraft& draft)
{
  const volume::CutMask& mask = draft.mask();
  const auto raw = decompress(packed, kHeader + mask.brickCount() * (4 + kBrickBytes));
  const std::size_t count = getU32(&raw[12]);
  if (std::memcmp(raw.data(), kMagic, sizeof kMagic) != 0)
    damaged("it does not begin as a stroke does");
  if (getU32(&raw[4]) != kVersion || getU32(&raw[8]) != CutMask::kBrickEdge)
    damaged("its version is unknown");
  if (raw.size() != kHeader + count * (4 + kBrickBytes))
    damaged("it is too short");

  const int sign = step == Step::Undo ? 1 : -1;
  const std::uint8_t* voxels = raw.data() + kHeader + 4 * count;
  std::size_t least = 0;
  for (std::size_t d = 0; d < count; ++d)
  {
    const std::size_t brick = getU32(&raw[kHeader + 4 * d]);
    if (brick >= mask.brickCount() || brick < least)
      damaged("it names a brick that is not in the grid");
    least = brick + 1;
    CutMask::Brick& values = draft.edit(brick);
    bool fits = true;
    for (std::size_t n = 0; n < CutMask::kBrickVoxels; ++n)
    {
      const int taken = voxels[n] | voxels[CutMask::kBrickVoxels + n] << 8;
      const int value = values[n] + sign * taken;
      fits = fits && value >= 0 && value <= CutMask::kUntouched;
      values[n] = static_cast<std::uint16_t>(value);
    }
    if (!fits)
      damaged("it takes more than is there");
    if (takesBeyond(mask, brick, voxels))
      damaged("it takes voxels beyond the grid");
    voxels += kBrickBytes;
  }
}

CutMask::Brick& BrickDraft::edit(std::size_t brick)
{
  auto& draft = m_bricks[brick];
  if (!draft)
  {
    draft = std::make_shared<CutMask::Brick>();
    if (const auto& version = m_mask.brick(brick))
      *draft = *version;
    else
      draft->fill(CutMask::kUntouched);
  }
  return *draft;
}

std::vector<BrickDelta> BrickDraft::take()
{
  std::vector<BrickDelta> deltas;
  deltas.reserve(m_bricks.size());
  for (auto& [brick, draft] : m_bricks)
  {
    const bool untouched = std::all_of(draft->begin(), draft->end(),
                                       [](std::uint16_t v) { return v == CutMask::kUntouched; });
    deltas.push_back({brick, m_mask.brick(brick), untouched ? nullptr : std::move(draft)});
  }
  m_bricks.clear();
  return deltas;
}

} // namespace petrous::dissection
