#include "Codestream.h"

#include <algorithm>
#include <cstdint>

namespace petrous::imaging
{

namespace
{

/// Reads big-endian numbers; 0 beyond the end.
class Head
{
public:
  explicit Head(const std::vector<char>& bytes)
    : m_bytes(bytes)
  {
  }

  std::uint32_t number(std::size_t offset, std::size_t width) const
  {
    std::uint32_t value = 0;
    for (std::size_t i = 0; i < width && offset + width <= m_bytes.size(); ++i)
      value = (value << 8) | static_cast<unsigned char>(m_bytes[offset + i]);
    return value;
  }
  std::size_t size() const { return m_bytes.size(); }

private:
  const std::vector<char>& m_bytes;
};

bool sizeFits(std::uint32_t columns, std::uint32_t rows, std::uint32_t components,
              const SliceHeader& slice)
{
  return columns == static_cast<std::uint32_t>(slice.columns) &&
         rows == static_cast<std::uint32_t>(slice.rows) && components == 1;
}

bool bitsFit(std::uint32_t bits, const SliceHeader& slice)
{
  return bits >= 2 && bits <= static_cast<std::uint32_t>(slice.pixels.bitsAllocated);
}

/// Tables and comments that may precede a scan (T.81 B.2.4, T.87 C.2.4).
bool isTable(std::uint32_t marker)
{
  return marker == 0xffc4 || marker == 0xffcc || marker == 0xffdb || marker == 0xffdd ||
         (marker >= 0xffe0 && marker <= 0xffef) || marker == 0xfff8 || marker == 0xfffe;
}

/// The scan header (SOS) of ITU-T T.81 B.2.3: one component, and for lossless frames one of
/// predictors 1 to 7. GDCM aborts the program on any other.
bool scanFits(const Head& head, std::size_t at, std::uint32_t frame)
{
  const bool isLossless = frame == 0xffc3 || frame == 0xffc7 || frame == 0xffcb || frame == 0xffcf;
  const std::uint32_t predictor = head.number(at + 7, 1);
  return head.number(at + 2, 2) == 8 && head.number(at + 4, 1) == 1 &&
         (!isLossless || (predictor >= 1 && predictor <= 7));
}

/// Whether the stream ends with the marker EOI, but for padding. On a JPEG-LS stream that ends
/// earlier GDCM's decoder may not return.
bool hasEnd(const std::vector<char>& bytes)
{
  const auto last =
      std::find_if(bytes.rbegin(), bytes.rend(), [](char byte) { return byte != '\0'; });
  return bytes.rend() - last >= 2 && static_cast<unsigned char>(*last) == 0xd9 &&
         static_cast<unsigned char>(*(last + 1)) == 0xff;
}

/// The sample precision by the frame header (SOFn) of ITU-T T.81 B.2.2 and T.87 C.2.2; 0 if that or
/// the scan header after it does not fit.
int precisionOf(const Head& head, const SliceHeader& slice)
{
  if (head.number(0, 2) != 0xffd8)
    return 0;
  std::uint32_t precision = 0;
  std::size_t at = 2;
  std::uint32_t frame = 0;
  while (at + 4 <= head.size())
  {
    const std::uint32_t marker = head.number(at, 2);
    if (marker == 0xffff) // fill byte
    {
      ++at;
      continue;
    }
    const bool isFrame = (marker >= 0xffc0 && marker <= 0xffcf && marker != 0xffc4 &&
                          marker != 0xffc8 && marker != 0xffcc) ||
                         marker == 0xfff7;
    if (isFrame)
    {
      if (frame != 0 || !bitsFit(head.number(at + 4, 1), slice) ||
          !sizeFits(head.number(at + 7, 2), head.number(at + 5, 2), head.number(at + 9, 1), slice))
        return 0;
      precision = head.number(at + 4, 1);
      frame = marker;
    }
    if (marker == 0xffda)
      return frame != 0 && scanFits(head, at, frame) ? static_cast<int>(precision) : 0;
    const std::uint32_t length = head.number(at + 2, 2);
    if ((!isFrame && !isTable(marker)) || length < 2)
      return 0;
    at += 2 + length;
  }
  return 0;
}

/// The bits of a component by the SIZ segment of ITU-T T.800 A.5.1, always the second marker; 0 if
/// that does not fit.
int jpeg2000Precision(const Head& head, const SliceHeader& slice)
{
  // Some writers wrap the codestream in a JP2 file.
  std::size_t at = 0;
  if (head.number(4, 4) == 0x6a502020U)
    while (at + 4 <= head.size() && head.number(at, 4) != 0xff4fff51U)
      ++at;
  if (head.number(at, 4) != 0xff4fff51U)
    return 0;
  const auto field = [&head, at](std::size_t offset) { return head.number(at + offset, 4); };
  const std::uint32_t bits = (head.number(at + 42, 1) & 0x7fU) + 1;
  return sizeFits(field(8) - field(16), field(12) - field(20), head.number(at + 40, 2), slice) &&
                 bitsFit(bits, slice)
             ? static_cast<int>(bits)
             : 0;
}

} // namespace

int codestreamPrecision(const std::vector<char>& bytes, const SliceHeader& slice)
{
  const std::string& syntax = slice.pixels.transferSyntax;
  if (syntax == "1.2.840.10008.1.2.4.90" || syntax == "1.2.840.10008.1.2.4.91")
    return jpeg2000Precision(Head(bytes), slice);
  return jpegPrecision(bytes, slice);
}

std::uint64_t mostPixels(const PixelFormat& format, std::uint64_t bytes)
{
  constexpr std::uint64_t kMost = std::uint64_t{1} << 26; // JPEG-LS and JPEG 2000 have no bound
  constexpr std::uint64_t kPackBits = 64; // bytes of a pixel for one: a run of 128 takes two
  constexpr std::uint64_t kHuffman = 256; // a block of 64 takes two bits at least (T.81 F.1.2)
  if (format.transferSyntax == "1.2.840.10008.1.2.5")
    return std::min(kMost, kPackBits * bytes * 8 /
                               static_cast<std::uint64_t>(std::max(format.bitsAllocated, 8)));
  const bool isHuffman = format.transferSyntax.rfind("1.2.840.10008.1.2.4.5", 0) == 0 ||
                         format.transferSyntax == "1.2.840.10008.1.2.4.70";
  return isHuffman ? std::min(kMost, kHuffman * bytes) : kMost;
}

namespace
{

/// The first of some marker segments from `at` on, at one of which the header ends otherwise;
/// nullopt: there is none.
std::optional<std::uint64_t> findSegment(const CodestreamNumber& number, std::uint64_t at,
                                         std::uint32_t wanted, std::uint32_t end)
{
  for (std::optional<std::uint32_t> marker; (marker = number(at, 2)) && *marker != end;)
  {
    if (*marker == wanted)
      return at;
    if (*marker == 0xffff) // fill byte
    {
      ++at;
      continue;
    }
    const auto length = number(at + 2, 2);
    if (*marker < 0xff00 || !length || *length < 2)
      break;
    at += 2 + *length;
  }
  return std::nullopt;
}

/// The beginning of the JPEG 2000 codestream, which some writers wrap in a JP2 file (T.800 I.4).
std::optional<std::uint64_t> findJpeg2000(const CodestreamNumber& number)
{
  std::uint64_t at = 0;
  while (number(at, 2) != 0xff4fU)
  {
    const auto length = number(at, 4);
    const auto type = number(at + 4, 4);
    if (!length || !type)
      return std::nullopt;
    const bool isLong = *length == 1; // eight more bytes of length
    if (*type == 0x6a703263U)
      at += isLong ? 16 : 8;
    else if (isLong && number(at + 8, 4) == 0U)
      at += std::max<std::uint64_t>(number(at + 12, 4).value_or(0), 16);
    else if (!isLong && *length >= 8)
      at += *length;
    else
      return std::nullopt;
  }
  return at;
}

} // namespace

std::optional<bool> isLossyCodestream(const CodestreamNumber& number,
                                      const std::string& transferSyntax)
{
  if (transferSyntax == "1.2.840.10008.1.2.4.81")
  {
    const auto scan = findSegment(number, 2, 0xffda, 0xffd9);
    // SOS (T.87 C.2.3): length, components, two bytes for each, then NEAR
    const auto components = scan ? number(*scan + 4, 1) : std::nullopt;
    const auto near = components ? number(*scan + 5 + 2 * *components, 1) : std::nullopt;
    return near ? std::optional(*near > 0) : std::nullopt;
  }
  if (transferSyntax != "1.2.840.10008.1.2.4.91")
    return false;
  const auto start = findJpeg2000(number);
  const auto style = start ? findSegment(number, *start + 2, 0xff52, 0xff90) : std::nullopt;
  // COD (T.800 A.6.1): the transformation is its tenth byte, 0 the irreversible one
  const auto wavelet = style ? number(*style + 13, 1) : std::nullopt;
  return wavelet ? std::optional(*wavelet == 0) : std::nullopt;
}

int jpegPrecision(const std::vector<char>& bytes, const SliceHeader& slice)
{
  return hasEnd(bytes) ? precisionOf(Head(bytes), slice) : 0;
}

} // namespace petrous::imaging
