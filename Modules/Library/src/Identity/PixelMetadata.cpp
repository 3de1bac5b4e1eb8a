#include "PixelMetadata.h"

#include <algorithm>
#include <vector>

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

void clearAfterEndOfImage(std::uint8_t* bytes, std::size_t count)
{
  for (std::size_t at = count; at >= 2; --at)
    if (bytes[at - 2] == 0xff && bytes[at - 1] == 0xd9)
    {
      zero(bytes, at, count);
      return;
    }
}

bool clearRleMetadata(std::uint8_t* bytes, std::size_t count, std::size_t pixels)
{
  constexpr std::size_t kHeader = 64;
  if (count < kHeader)
    return false;
  const auto entry = [bytes](std::size_t n)
  {
    const std::uint8_t* at = bytes + 4 * n;
    return std::size_t{at[0]} | std::size_t{at[1]} << 8 | std::size_t{at[2]} << 16 |
           std::size_t{at[3]} << 24;
  };
  const std::size_t segments = entry(0);
  if (segments < 1 || segments > 15)
    return false;
  zero(bytes, 4 * (segments + 1), kHeader);
  std::size_t last = kHeader; // end of what was decoded
  for (std::size_t n = 1; n <= segments; ++n)
  {
    std::size_t at = entry(n);
    const std::size_t end = n < segments ? entry(n + 1) : count;
    if (at < last || at > end || end > count)
      return false;
    zero(bytes, last, at);
    std::size_t decoded = 0;
    while (decoded < pixels && at < end)
    {
      const int code = static_cast<std::int8_t>(bytes[at++]);
      if (code >= 0)
      {
        at += static_cast<std::size_t>(code) + 1;
        decoded += static_cast<std::size_t>(code) + 1;
      }
      else if (code != -128)
      {
        ++at;
        decoded += static_cast<std::size_t>(-code) + 1;
      }
    }
    if (decoded < pixels || at > end)
      return false;
    last = at;
  }
  zero(bytes, last, count);
  return true;
}

void clearUnusedBits(std::uint16_t* cells, std::size_t count, int bitsStored, int highBit,
                     bool isSigned)
{
  if (bitsStored < 1 || bitsStored >= 16 || highBit > 15 || highBit + 1 < bitsStored)
    return;
  const auto low = static_cast<unsigned>(highBit + 1 - bitsStored);
  const unsigned stored = ((1U << static_cast<unsigned>(bitsStored)) - 1U) << low;
  const unsigned above = 0xffffU & ~((1U << static_cast<unsigned>(highBit + 1)) - 1U);
  for (std::size_t n = 0; n < count; ++n)
  {
    const unsigned cell = cells[n];
    const bool isNegative = isSigned && (cell >> static_cast<unsigned>(highBit) & 1U) != 0;
    const bool isExtended = isNegative && (cell & above) == above;
    cells[n] = static_cast<std::uint16_t>((cell & stored) | (isExtended ? above : 0U));
  }
}

} // namespace petrous::library
