#include "PixelMetadata.h"

#include <algorithm>
#include <cstring>

namespace petrous::library
{

namespace
{

std::size_t number(const std::uint8_t* at, int bytes)
{
  std::size_t value = 0;
  for (int n = 0; n < bytes; ++n)
    value = value << 8 | at[n];
  return value;
}

void zero(std::uint8_t* bytes, std::size_t first, std::size_t end)
{
  std::fill(bytes + first, bytes + end, std::uint8_t{0});
}

bool startsWith(const std::uint8_t* bytes, std::size_t count, const char* text, std::size_t length)
{
  return count >= length && std::equal(text, text + length, bytes);
}

// Of what no marker leads to: after the last end-of-image marker.
void clearAfterEndOfImage(std::uint8_t* bytes, std::size_t count)
{
  for (std::size_t at = count; at >= 2; --at)
    if (bytes[at - 2] == 0xff && bytes[at - 1] == 0xd9)
    {
      zero(bytes, at, count);
      return;
    }
}

// ITU-T T.81 Annex B, T.87.
void clearJpeg(std::uint8_t* bytes, std::size_t count)
{
  std::size_t at = 2;
  bool isCoded = false; // between the header of a scan and the next marker
  while (at + 2 <= count)
  {
    if (bytes[at] != 0xff)
    {
      if (!isCoded)
        bytes[at] = 0xff; // stray bytes between segments, as fill bytes
      ++at;
      continue;
    }
    const std::uint8_t marker = bytes[at + 1];
    if (marker < 0xc0 || (marker >= 0xd0 && marker <= 0xd8) || marker == 0xff)
    {
      ++at;
      continue;
    }
    at += 2;
    if (marker == 0xd9)
    {
      zero(bytes, at, count);
      return;
    }
    if (at + 2 > count)
      return;
    const std::size_t end = std::min(count, at + std::max<std::size_t>(2, number(bytes + at, 2)));
    isCoded = marker == 0xda;
    // And JPG0 to JPG13, but for those that JPEG-LS defines.
    const bool isApplication =
        (marker >= 0xe0 && marker <= 0xef) ||
        (marker >= 0xf0 && marker <= 0xfd && marker != 0xf7 && marker != 0xf8);
    std::size_t keep = 0;
    if (marker == 0xee && startsWith(bytes + at + 2, end - at - 2, "Adobe", 5))
      keep = 12;
    else if (marker == 0xe0 && startsWith(bytes + at + 2, end - at - 2, "JFIF", 4))
      keep = 12; // up to the size of the thumbnail, which is zeroed with it
    else if (marker == 0xe8 && startsWith(bytes + at + 2, end - at - 2, "mrfx", 4))
      keep = 5;
    if (isApplication || marker == 0xfe)
      zero(bytes, std::min(end, at + 2 + keep), end);
    at = end;
  }
}

// ITU-T T.800 Annex A.
void clearJpeg2000(std::uint8_t* bytes, std::size_t count)
{
  std::size_t at = 2, tile = 0, tileEnd = 0;
  while (at + 2 <= count)
  {
    const std::size_t marker = number(bytes + at, 2);
    if (marker == 0xffd9) // EOC
    {
      zero(bytes, at + 2, count);
      return;
    }
    if (marker == 0xff93) // SOD: the data of the tile-part
    {
      if (tileEnd <= at) // to the end
      {
        clearAfterEndOfImage(bytes, count);
        return;
      }
      at = tileEnd;
      continue;
    }
    if (at + 4 > count)
      return;
    const std::size_t end =
        std::min(count, at + 2 + std::max<std::size_t>(2, number(bytes + at + 2, 2)));
    if (marker == 0xff90 && at + 12 <= count) // SOT
    {
      tile = at;
      const std::size_t length = number(bytes + at + 6, 4);
      tileEnd = length == 0 ? 0 : std::min(count, tile + length);
    }
    if (marker == 0xff64) // COM
      zero(bytes, std::min(end, at + 6), end);
    at = end;
  }
}

} // namespace

bool clearCodestreamMetadata(std::uint8_t* bytes, std::size_t count)
{
  if (count < 4 || bytes[0] != 0xff)
    return false;
  if (bytes[1] == 0xd8)
    clearJpeg(bytes, count);
  else if (bytes[1] == 0x4f)
    clearJpeg2000(bytes, count);
  else
    return false;
  return true;
}

int codestreamPrecision(const std::uint8_t* bytes, std::size_t count)
{
  if (count < 4 || bytes[0] != 0xff)
    return 0;
  if (bytes[1] == 0x4f) // SIZ follows at once (ITU-T T.800 A.5.1)
  {
    constexpr std::size_t kComponents = 40;
    if (count < kComponents + 2 || number(bytes + 2, 2) != 0xff51)
      return 0;
    int deepest = 0;
    const std::size_t components = number(bytes + kComponents, 2);
    for (std::size_t n = 0, at = kComponents + 2; n < components && at < count; ++n, at += 3)
      deepest = std::max(deepest, (bytes[at] & 0x7f) + 1);
    return deepest;
  }
  for (std::size_t at = 2; at + 5 <= count;)
  {
    if (bytes[at] != 0xff || bytes[at + 1] == 0xff || bytes[at + 1] < 0xc0)
    {
      ++at;
      continue;
    }
    const std::uint8_t marker = bytes[at + 1];
    const bool isFrame =
        (marker >= 0xc0 && marker <= 0xcf && marker != 0xc4 && marker != 0xc8 && marker != 0xcc) ||
        marker == 0xf7;
    if (isFrame)
      return bytes[at + 4];
    at += 2 + std::max<std::size_t>(2, number(bytes + at + 2, 2));
  }
  return 0;
}

bool isClearable(const StoredBits& bits)
{
  return (bits.allocated == 8 || bits.allocated == 16 || bits.allocated == 32) &&
         bits.stored >= 1 && bits.high < bits.allocated && bits.high + 1 >= bits.stored;
}

namespace
{

/// The bits of a cell: of the sample, and above it.
struct Masks
{
  explicit Masks(const StoredBits& bits)
    : upTo(bits.high >= 31 ? 0xffffffffU : (1U << static_cast<unsigned>(bits.high + 1)) - 1U)
    , stored(upTo & ~((1U << static_cast<unsigned>(bits.high + 1 - bits.stored)) - 1U))
    , above((bits.allocated >= 32 ? 0xffffffffU
                                  : (1U << static_cast<unsigned>(bits.allocated)) - 1U) &
            ~upTo)
    , sign(bits.isSigned ? 1U << static_cast<unsigned>(bits.high) : 0U)
  {
  }

  std::uint32_t upTo, stored, above, sign;
};

template <class Cell>
bool clearCells(std::uint8_t* bytes, std::size_t cells, const Masks& masks)
{
  bool extends = masks.sign != 0, hasUnused = false;
  for (std::size_t n = 0; n < cells; ++n)
  {
    Cell cell = 0;
    std::memcpy(&cell, bytes + n * sizeof cell, sizeof cell);
    const bool isNegative = (cell & masks.sign) != 0;
    extends = extends && (cell & masks.above) == (isNegative ? masks.above : 0U);
    hasUnused = hasUnused || (cell & ~masks.stored) != 0;
  }
  if (!hasUnused)
    return false;
  const std::uint32_t keep = masks.stored | (extends ? masks.above : 0U);
  bool changed = false;
  for (std::size_t n = 0; n < cells; ++n)
  {
    Cell cell = 0;
    std::memcpy(&cell, bytes + n * sizeof cell, sizeof cell);
    const auto rest = static_cast<Cell>(cell & keep);
    changed = changed || rest != cell;
    std::memcpy(bytes + n * sizeof cell, &rest, sizeof rest);
  }
  return changed;
}

/// Calls `use(byte, isCell)` for each byte of an RLE segment that is a value, until `pixels` are
/// decoded. Returns where the segment ends; > end: it is damaged.
template <class Use>
std::size_t decodeRle(std::uint8_t* bytes, std::size_t at, std::size_t end, std::size_t pixels,
                      const Use& use)
{
  std::size_t decoded = 0;
  while (decoded < pixels && at < end)
  {
    const int code = static_cast<std::int8_t>(bytes[at++]);
    if (code == -128)
      continue;
    const std::size_t values = code >= 0 ? static_cast<std::size_t>(code) + 1 : 1;
    for (std::size_t n = 0; n < values && at + n < end; ++n)
      use(bytes[at + n]);
    at += values;
    decoded += code >= 0 ? values : static_cast<std::size_t>(-code) + 1;
  }
  return decoded < pixels ? end + 1 : at;
}

} // namespace

bool clearRleMetadata(std::uint8_t* bytes, std::size_t count, std::size_t pixels,
                      const StoredBits& bits, bool& hadBits)
{
  constexpr std::size_t kHeader = 64;
  if (count < kHeader || !isClearable(bits))
    return false;
  const auto entry = [bytes](std::size_t n)
  {
    const std::uint8_t* at = bytes + 4 * n;
    return std::size_t{at[0]} | std::size_t{at[1]} << 8 | std::size_t{at[2]} << 16 |
           std::size_t{at[3]} << 24;
  };
  const std::size_t segments = entry(0), ofCell = static_cast<std::size_t>(bits.allocated) / 8;
  if (segments < 1 || segments > 15 || segments % ofCell != 0)
    return false;
  zero(bytes, 4 * (segments + 1), kHeader);
  const Masks masks(bits);
  std::size_t last = kHeader; // end of what was decoded
  for (std::size_t n = 1; n <= segments; ++n)
  {
    const std::size_t at = entry(n);
    const std::size_t end = n < segments ? entry(n + 1) : count;
    if (at < last || at > end || end > count)
      return false;
    zero(bytes, last, at);
    // The most significant byte of a sample comes first.
    const auto shift = static_cast<unsigned>(8 * (ofCell - 1 - (n - 1) % ofCell));
    const auto part = [shift](std::uint32_t mask)
    { return static_cast<std::uint8_t>(mask >> shift & 0xffU); };
    const std::uint8_t stored = part(masks.stored), above = part(masks.above),
                       sign = part(masks.sign);
    bool extends = sign != 0;
    last = decodeRle(bytes, at, end, pixels,
                     [&](std::uint8_t value) {
                       extends = extends && (value & above) == ((value & sign) != 0 ? above : 0);
                     });
    if (last > end)
      return false;
    const auto keep = static_cast<std::uint8_t>(stored | (extends ? above : 0));
    decodeRle(bytes, at, end, pixels,
              [&](std::uint8_t& value)
              {
                hadBits = hadBits || (value & keep) != value;
                value = static_cast<std::uint8_t>(value & keep);
              });
  }
  zero(bytes, last, count);
  return true;
}

bool clearUnusedBits(std::uint8_t* bytes, std::size_t cells, const StoredBits& bits)
{
  if (!isClearable(bits))
    return false;
  const Masks masks(bits);
  switch (bits.allocated)
  {
  case 8:
    return clearCells<std::uint8_t>(bytes, cells, masks);
  case 16:
    return clearCells<std::uint16_t>(bytes, cells, masks);
  default:
    return clearCells<std::uint32_t>(bytes, cells, masks);
  }
}

} // namespace petrous::library
