#include "PixelCodec.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstring>
#include <exception>
#include <limits>
#include <mutex>
#include <optional>

#include <gdcmDataElement.h>
#include <gdcmFragment.h>
#include <gdcmImage.h>
#include <gdcmSequenceOfFragments.h>
#include <gdcmTrace.h>
#include <unistd.h>

#include "ByteSource.h"
#include "Codestream.h"
#include "DicomElements.h"
#include "JpegDecoder.h"
#include "petrous/Imaging/DicomScan.h"

namespace petrous::imaging
{

namespace
{

[[noreturn]] void fail(const SliceHeader& slice, const char* what)
{
  throw DicomError(DicomError::Reason::Unreadable, slice.file.filename().string() + " " + what +
                                                       "; copy it again from where it "
                                                       "came from");
}

[[noreturn]] void failChanged(const SliceHeader& slice)
{
  throw DicomError(DicomError::Reason::Unreadable,
                   slice.file.filename().string() +
                       " was changed or replaced after its header was read; wait until the copying "
                       "is done, then read the folder again");
}

/// Extraction of the stored value from its allocated bits: shift, mask, sign extension.
struct BitField
{
  int shift = 0;  ///< unused bits below
  int unused = 0; ///< unused bits above, relative to 32
  bool isSigned = false;

  std::int32_t operator()(std::uint32_t cell) const
  {
    const std::uint32_t top = (cell >> shift) << unused;
    return isSigned ? static_cast<std::int32_t>(top) >> unused
                    : static_cast<std::int32_t>(top >> unused);
  }
};

/// Plain pointers and one branch outside the loop, so that the compiler can vectorize it.
template <class Cell>
void unpack(const unsigned char* bytes, bool swap, const BitField& field,
            std::vector<std::int32_t>& values)
{
  std::int32_t* const out = values.data();
  const std::size_t count = values.size();
  const auto each = [=](auto convert)
  {
    for (std::size_t i = 0; i < count; ++i)
    {
      Cell cell = 0;
      std::memcpy(&cell, bytes + i * sizeof(Cell), sizeof cell);
      out[i] = convert(cell);
    }
  };
  const int shift = field.shift;
  const int unused = field.unused;
  if (swap)
    each(
        [&field](Cell cell)
        {
          std::array<unsigned char, sizeof(Cell)> cellBytes{};
          std::memcpy(cellBytes.data(), &cell, sizeof cell);
          std::reverse(cellBytes.begin(), cellBytes.end());
          std::memcpy(&cell, cellBytes.data(), sizeof cell);
          return field(cell);
        });
  else if (field.isSigned)
    each([=](Cell cell)
         { return static_cast<std::int32_t>((std::uint32_t{cell} >> shift) << unused) >> unused; });
  else
    each(
        [=](Cell cell) {
          return static_cast<std::int32_t>(((std::uint32_t{cell} >> shift) << unused) >> unused);
        });
}

/// 12 bits a pixel, little endian, the first of two in the lower bits.
void unpackPairs(const unsigned char* bytes, const BitField& field,
                 std::vector<std::int32_t>& values)
{
  for (std::size_t p = 0; p < values.size(); ++p)
  {
    const unsigned char* at = bytes + p / 2 * 3 + p % 2;
    const std::uint32_t pair = at[0] | static_cast<std::uint32_t>(at[1]) << 8;
    values[p] = field(p % 2 == 0 ? pair & 0xFFFU : pair >> 4);
  }
}

void unpackCells(const SliceHeader& slice, int bitsAllocated, const BitField& field, bool swap,
                 StoredPixels& pixels)
{
  const unsigned char* bytes = pixels.scratch.data();
  if (bitsAllocated == 12)
    unpackPairs(bytes, field, pixels.values);
  else if (bitsAllocated == 8)
    unpack<std::uint8_t>(bytes, false, field, pixels.values);
  else if (bitsAllocated == 16)
    unpack<std::uint16_t>(bytes, swap, field, pixels.values);
  else if (bitsAllocated == 32)
    unpack<std::uint32_t>(bytes, swap, field, pixels.values);
  else
    fail(slice, "has pixels of an unusual number of bits");
  // Unsigned 32-bit values that do not fit appear as negative.
  if (field.unused != 0 || field.isSigned ||
      *std::min_element(pixels.values.begin(), pixels.values.end()) >= 0)
    return;
  pixels.reals.resize(pixels.values.size());
  std::transform(pixels.values.begin(), pixels.values.end(), pixels.reals.begin(),
                 [](std::int32_t value)
                 { return static_cast<double>(static_cast<std::uint32_t>(value)); });
  pixels.values.clear();
}

/// Floating-point pixels, which have no compression.
template <class Real>
void unpackReals(bool swap, StoredPixels& pixels)
{
  for (std::size_t p = 0; p < pixels.reals.size(); ++p)
  {
    std::array<unsigned char, sizeof(Real)> bytes{};
    std::memcpy(bytes.data(), pixels.scratch.data() + p * sizeof(Real), sizeof(Real));
    if (swap)
      std::reverse(bytes.begin(), bytes.end());
    Real value = 0;
    std::memcpy(&value, bytes.data(), sizeof value);
    pixels.reals[p] = static_cast<double>(value);
  }
}

BitField bitField(int bitsStored, int highBit, bool isSigned)
{
  return {highBit + 1 - bitsStored, 32 - bitsStored, isSigned};
}

std::uint64_t littleEndian(const unsigned char* bytes, std::size_t count)
{
  std::uint64_t value = 0;
  for (std::size_t b = count; b-- > 0;)
    value = value << 8 | bytes[b];
  return value;
}

/// Pixels with bits outside of those that the header says are stored.
struct OutsideBits
{
  std::size_t beyond = 0; ///< they are no copies of the sign, and not the declared padding
  bool isPadded = false;  ///< some are of the declared padding
  SignCopies signs;
};

/// The value of a whole cell, if the header declares it as padding.
std::optional<std::int32_t> paddingOf(const SliceHeader& slice, std::uint64_t cell)
{
  const PixelFormat& format = slice.pixels;
  if (!slice.padding || format.highBit + 1 != format.bitsStored)
    return std::nullopt;
  const int unused = 64 - format.bitsAllocated;
  const std::int64_t value = format.isSigned ? static_cast<std::int64_t>(cell << unused) >> unused
                                             : static_cast<std::int64_t>(cell);
  const double limit = slice.paddingRangeLimit.value_or(*slice.padding);
  const auto number = static_cast<double>(value);
  if (number < std::min(*slice.padding, limit) || number > std::max(*slice.padding, limit))
    return std::nullopt;
  return static_cast<std::int32_t>(value);
}

/// `others`: bits of a cell that are left out. Most images have no bits outside, and no sign, which
/// one pass without a branch tells.
template <class Cell>
OutsideBits outsideBits(const SliceHeader& slice, const std::vector<unsigned char>& bytes,
                        bool swap, std::uint64_t others)
{
  const PixelFormat& format = slice.pixels;
  const std::size_t count = bytes.size() / sizeof(Cell);
  const auto cellAt = [&](std::size_t n)
  {
    Cell cell = 0;
    std::memcpy(&cell, bytes.data() + n * sizeof(Cell), sizeof cell);
    return cell;
  };
  const auto swapped = [swap](Cell cell)
  {
    std::array<unsigned char, sizeof(Cell)> own{};
    std::memcpy(own.data(), &cell, sizeof cell);
    if (swap)
      std::reverse(own.begin(), own.end());
    std::memcpy(&cell, own.data(), sizeof cell);
    return cell;
  };
  const std::uint64_t sign =
      format.isSigned ? std::uint64_t{1} << format.highBit : std::uint64_t{0};
  const std::uint64_t whole = ~std::uint64_t{0} >> (64 - format.bitsAllocated);
  const std::uint64_t above = whole & ~std::uint64_t{0} << format.highBit << 1 & ~others;
  const std::uint64_t below =
      ((std::uint64_t{1} << (format.highBit + 1 - format.bitsStored)) - 1) & ~others;
  Cell any = 0;
  for (std::size_t n = 0; n < count; ++n)
    any = static_cast<Cell>(any | cellAt(n));
  OutsideBits outside;
  if ((swapped(any) & (above | below | (above != 0 ? sign : 0))) == 0)
    return outside;
  for (std::size_t n = 0; n < count; ++n)
  {
    const std::uint64_t cell = swapped(cellAt(n));
    const bool isNegative = (cell & sign) != 0;
    if ((cell & (above | below)) == 0)
      outside.signs.none += isNegative && above != 0 ? 1 : 0;
    else if (isNegative && above != 0 && (cell & (above | below)) == above)
      outside.signs.any = true;
    else if (paddingOf(slice, cell))
      outside.isPadded = true;
    else
      ++outside.beyond;
  }
  return outside;
}

OutsideBits outsideBits(const SliceHeader& slice, const std::vector<unsigned char>& bytes,
                        bool swap, std::uint64_t others = 0)
{
  const PixelFormat& format = slice.pixels;
  if (format.bitsStored >= format.bitsAllocated)
    return {};
  return format.bitsAllocated == 8    ? outsideBits<std::uint8_t>(slice, bytes, swap, others)
         : format.bitsAllocated == 16 ? outsideBits<std::uint16_t>(slice, bytes, swap, others)
         : format.bitsAllocated == 32 ? outsideBits<std::uint32_t>(slice, bytes, swap, others)
                                      : OutsideBits{};
}

/// Gives pixels of a padding that needs more than the bits stored its whole value.
void restorePadding(const SliceHeader& slice, bool swap, StoredPixels& pixels)
{
  const auto bytes = static_cast<std::size_t>(slice.pixels.bitsAllocated / 8);
  for (std::size_t p = 0; p < pixels.values.size(); ++p)
  {
    std::uint64_t cell = 0;
    for (std::size_t b = 0; b < bytes; ++b)
      cell = cell << 8 | pixels.scratch[p * bytes + (swap ? b : bytes - 1 - b)];
    pixels.values[p] = paddingOf(slice, cell).value_or(pixels.values[p]);
  }
}

/// The bits of a cell in which the file declares overlays, as old scanners wrote them (PS3.3 of
/// 2004, C.9.2).
std::uint64_t overlayBits(const std::filesystem::path& file)
{
  constexpr Tag kFirst = 0x60000102;     // Overlay Bit Position
  constexpr Tag kAllocated = 0x60000100; // Overlay Bits Allocated: 1 where its data are apart
  constexpr Tag kNext = 0x00020000;      // group
  constexpr Tag kMostOverlays = 16;
  ByteSource source(file);
  const DicomElements elements(source);
  std::uint64_t bits = 0;
  for (Tag n = 0; n < kMostOverlays; ++n)
  {
    const int place = elements.integer(kFirst + n * kNext).value_or(-1);
    if (elements.integer(kAllocated + n * kNext).value_or(1) > 1 && place >= 0 && place < 32)
      bits |= std::uint64_t{1} << place;
  }
  return bits;
}

/// Takes bits that are overlays out of values that were unpacked with all bits allocated: above the
/// highest other bit of a signed value they are copies of it.
void removeOverlays(const PixelFormat& format, std::uint64_t overlays, StoredPixels& pixels)
{
  const std::uint64_t whole = ~std::uint64_t{0} >> (64 - format.bitsAllocated);
  const auto others = static_cast<std::uint32_t>(overlays & whole);
  std::uint32_t top = 0; // bit of the sign
  for (int bit = format.bitsAllocated - 1; format.isSigned && top == 0 && bit >= 0; --bit)
    if (const auto one = std::uint32_t{1} << bit; (others & one) == 0)
      top = one;
  const std::uint32_t copies = top == 0 ? 0 : ~(top - 1);
  const auto without = [=](std::uint32_t bits)
  { return (bits & top) != 0 ? bits | others | copies : bits & ~(others | copies); };
  for (std::int32_t& value : pixels.values)
    value = static_cast<std::int32_t>(without(static_cast<std::uint32_t>(value)));
  for (double& value : pixels.reals) // unsigned
    value = without(static_cast<std::uint32_t>(value));
}

/// Unpacks `scratch`. Cut to the bits that the header says are stored, larger values would turn
/// into smaller ones: metal into soft tissue.
void unpackWithin(const SliceHeader& slice, bool swap, StoredPixels& pixels,
                  UndeclaredBits undeclared)
{
  const PixelFormat& format = slice.pixels;
  OutsideBits outside = outsideBits(slice, pixels.scratch, swap);
  const auto beyond = [&outside]
  { return outside.beyond + (outside.signs.any ? outside.signs.none : std::size_t{0}); };
  const std::uint64_t overlays = beyond() > 0 ? overlayBits(slice.file) : 0;
  if (beyond() > 0)
    outside = outsideBits(slice, pixels.scratch, swap, overlays);
  pixels.undeclared = beyond();
  pixels.signs = outside.signs;
  if (pixels.undeclared > 0 && undeclared == UndeclaredBits::Refuse)
    throw DicomError(DicomError::Reason::BitsUnclear,
                     bitsStoredText(slice, pixels.undeclared) +
                         "; export it again, uncompressed and with all bits");
  pixels.hasBitsBelow = format.highBit + 1 != format.bitsStored;
  if (undeclared == UndeclaredBits::Keep && (pixels.undeclared > 0 || outside.signs.none > 0))
  {
    if (pixels.hasBitsBelow)
      throw DicomError(DicomError::Reason::Unreadable,
                       bitsStoredText(slice, pixels.undeclared) +
                           "; export it again, uncompressed and with all bits");
    unpackCells(slice, format.bitsAllocated,
                bitField(format.bitsAllocated, format.bitsAllocated - 1, format.isSigned), swap,
                pixels);
    if (overlays != 0)
      removeOverlays(format, overlays, pixels);
    if (outside.isPadded)
      restorePadding(slice, swap, pixels);
    return;
  }
  unpackCells(slice, format.bitsAllocated,
              bitField(format.bitsStored, format.highBit, format.isSigned), swap, pixels);
  if (outside.isPadded)
    restorePadding(slice, swap, pixels);
}

/// The fragments of the slice's frame (PS3.5 A.4): all of them if it is the only one, those that
/// the extended offset table gives it, one each if there are as many as frames, else those that the
/// basic offset table gives it.
std::vector<Fragment> fragmentsOf(ByteSource& source, const SliceHeader& slice,
                                  const std::vector<Fragment>& items)
{
  if (items.empty())
    return items;
  constexpr std::uint64_t kItemHead = 8; // bytes before the value
  const Fragment& table = items.front();
  const auto frame = static_cast<std::size_t>(slice.pixels.frame);
  const auto count = static_cast<std::size_t>(slice.pixels.frameCount);
  if (count == 1)
    return {items.begin() + 1, items.end()};
  const bool isExtended = slice.pixels.offsetTable != 0;
  if (!isExtended && items.size() == count + 1)
    return {items[frame + 1]};
  if (items.size() == 1 || (!isExtended && table.length != 4 * count))
    fail(slice, "does not say where its compressed frames begin");
  const std::size_t width = isExtended ? 8 : 4;
  const std::uint64_t at = (isExtended ? slice.pixels.offsetTable : table.offset) + width * frame;
  std::array<unsigned char, 16> starts{}; // of this frame and the next
  const std::size_t known = frame + 1 < count ? 2 : 1;
  if (!source.read(at, starts.data(), known * width))
    fail(slice, "cannot be read");
  const std::uint64_t first = items[1].offset - kItemHead;
  const std::uint64_t begin = first + littleEndian(starts.data(), width);
  const std::uint64_t end =
      known == 2 ? first + littleEndian(starts.data() + width, width) : source.size();
  std::vector<Fragment> own;
  for (auto one = items.begin() + 1; one != items.end(); ++one)
    if (one->offset - kItemHead >= begin && one->offset - kItemHead < end)
      own.push_back(*one);
  if (own.empty() || own.front().offset - kItemHead != begin)
    fail(slice, "does not say where its compressed frames begin");
  return own;
}

/// Suppresses stderr output of the codecs used by GDCM, on this thread and during its lifetime: it
/// is not part of this program's output. Codecs print nothing for a valid image; on damage they
/// print a warning and continue decoding.
class CodecMessages
{
public:
  CodecMessages()
  {
    static std::once_flag once;
    std::call_once(once,
                   []
                   {
                     gdcm::Trace::DebugOff();
                     gdcm::Trace::WarningOff();
                     gdcm::Trace::ErrorOff();
                     // They print to C's stderr, which is a variable in glibc. Without buffering,
                     // the write callback runs on the printing thread.
                     cookie_io_functions_t functions{};
                     functions.write = write;
                     if (FILE* stream = ::fopencookie(nullptr, "w", functions))
                     {
                       std::setvbuf(stream, nullptr, _IONBF, 0);
                       stderr = stream;
                     }
                   });
    t_listener = this;
  }
  ~CodecMessages() { t_listener = nullptr; }
  CodecMessages(const CodecMessages&) = delete;
  CodecMessages& operator=(const CodecMessages&) = delete;

  bool any() const noexcept { return m_any; }

private:
  static ssize_t write(void*, const char* bytes, std::size_t count)
  {
    if (!t_listener)
      return ::write(STDERR_FILENO, bytes, count);
    t_listener->m_any = true;
    return static_cast<ssize_t>(count);
  }

  static thread_local CodecMessages* t_listener;
  bool m_any = false;
};

thread_local CodecMessages* CodecMessages::t_listener = nullptr;

/// JPEG-LS and JPEG 2000, decoded in this process. GetBuffer would also hand a stream that its own
/// codecs refuse to a program of another package (pvrg-jpeg), by a shell and a temporary file with
/// the patient's image.
class InProcessImage : public gdcm::Image
{
public:
  bool decode(char* buffer) const
  {
    bool isLossy = false;
    return TryJPEGLSCodec(buffer, isLossy) || TryJPEG2000Codec(buffer, isLossy);
  }
};

} // namespace

std::vector<Fragment> readFragments(ByteSource& source, const SliceHeader& slice)
{
  std::uint64_t offset = slice.pixels.offset;
  std::array<unsigned char, 8> item{};
  std::vector<Fragment> items;
  while (source.readNear(offset, item.data(), item.size()) && item[0] == 0xfe && item[1] == 0xff &&
         item[2] == 0x00)
  {
    const auto length = static_cast<std::uint32_t>(littleEndian(item.data() + 4, 4));
    offset += item.size();
    if (offset + length > source.size())
      fail(slice, "is cut short");
    items.push_back({offset, length});
    offset += length;
  }
  return items;
}

std::vector<char> readCodestream(ByteSource& source, const SliceHeader& slice,
                                 const std::vector<Fragment>& fragments)
{
  std::vector<char> bytes;
  for (const Fragment& fragment : fragmentsOf(source, slice, fragments))
  {
    const std::size_t filled = bytes.size();
    bytes.resize(filled + fragment.length);
    if (!source.read(fragment.offset, bytes.data() + filled, fragment.length))
      fail(slice, "cannot be read");
  }
  return bytes;
}

constexpr const char* kRleLossless = "1.2.840.10008.1.2.5";

/// RLE Lossless (PS3.5 Annex G): one segment of PackBits for each byte of a pixel, the most
/// significant first. `cells`: little-endian pixels of `bytes` bytes. False if the stream is
/// damaged; GDCM's decoder, as Debian builds it, would abort the program.
bool decodeRle(const std::vector<char>& stream, std::size_t bytes,
               std::vector<unsigned char>& cells)
{
  constexpr std::size_t kHead = 64; // the number of segments, and 15 offsets
  const std::size_t count = cells.size() / bytes;
  if (count == 0 || stream.size() < kHead)
    return false;
  const auto number = [&stream](std::size_t at)
  {
    std::size_t value = 0;
    for (std::size_t b = 4; b-- > 0;)
      value = value << 8 | static_cast<unsigned char>(stream[at + b]);
    return value;
  };
  if (number(0) != bytes)
    return false;
  for (std::size_t segment = 0; segment < bytes; ++segment)
  {
    std::size_t at = number(4 + 4 * segment);
    const std::size_t end = segment + 1 < bytes ? number(8 + 4 * segment) : stream.size();
    if (at < kHead || at > end || end > stream.size())
      return false;
    unsigned char* to = cells.data() + (bytes - 1 - segment);
    std::size_t done = 0;
    while (done < count)
    {
      if (at >= end)
        return false;
      const auto control = static_cast<unsigned char>(stream[at++]);
      if (control == 128)
        continue;
      const bool isRun = control > 128;
      const std::size_t length = isRun ? 257U - control : control + 1U;
      if (length > count - done || (isRun ? 1 : length) > end - at)
        return false;
      for (std::size_t n = 0; n < length; ++n)
        to[(done + n) * bytes] = static_cast<unsigned char>(stream[isRun ? at : at + n]);
      at += isRun ? 1 : length;
      done += length;
    }
  }
  return true;
}

/// The scan reports what is wrong with such slices in better words, and excludes them. GDCM's
/// assertions would end the program.
void requireWholePixels(const SliceHeader& slice)
{
  const PixelFormat& format = slice.pixels;
  const int bits = format.bitsAllocated;
  if ((bits != 8 && bits != 12 && bits != 16 && bits != 32) || format.bitsStored < 1 ||
      format.bitsStored > bits || format.highBit >= bits ||
      format.highBit < format.bitsStored - 1 || format.samplesPerPixel != 1)
    fail(slice, "does not have one pixel value of 8, 12, 16 or 32 bits");
}

void decodeFrame(ByteSource& source, const SliceHeader& slice,
                 const std::vector<Fragment>& fragments, StoredPixels& pixels,
                 UndeclaredBits undeclared)
{
  pixels.signs = {};
  pixels.undeclared = 0;
  requireWholePixels(slice);
  if (slice.pixels.bitsAllocated % 8 != 0)
    fail(slice, "has a damaged compressed image");
  pixels.reals.clear();
  const CodecMessages messages;
  const PixelFormat& format = slice.pixels;
  gdcm::DataElement element(gdcm::Tag(0x7fe0, 0x0010));
  element.SetVR(gdcm::VR::OB);
  std::vector<char> codestream = readCodestream(source, slice, fragments);
  const std::size_t count =
      static_cast<std::size_t>(slice.rows) * static_cast<std::size_t>(slice.columns);
  const bool isRle = format.transferSyntax == kRleLossless;
  const int precision = isRle ? 0 : codestreamPrecision(codestream, slice);
  if (codestream.empty() || (!isRle && precision == 0) ||
      count > mostPixels(format, codestream.size()))
    fail(slice, "has a damaged compressed image");
  pixels.values.resize(count);
  const bool isWider = precision > format.bitsStored;
  if (isRle)
  {
    const auto bytes = static_cast<std::size_t>(format.bitsAllocated / 8);
    pixels.scratch.assign(pixels.values.size() * bytes, 0);
    if (!decodeRle(codestream, bytes, pixels.scratch))
      fail(slice, "has a damaged compressed image");
    unpackWithin(slice, false, pixels, undeclared);
    return;
  }
  if (isJpeg(format.transferSyntax))
  {
    const std::size_t bytes = precision <= 8 ? 1 : 2;
    pixels.scratch.assign(pixels.values.size() * bytes, 0);
    if (format.bitsAllocated != static_cast<int>(8 * bytes) ||
        !decodeJpeg(codestream, precision, pixels.scratch))
      fail(slice, "has a damaged compressed image");
    if (isWider)
      unpackWithin(slice, false, pixels, undeclared);
    else
      unpackCells(slice, format.bitsAllocated,
                  bitField(format.bitsStored, format.highBit, format.isSigned), false, pixels);
    return;
  }
  gdcm::Fragment fragment;
  fragment.SetByteValue(codestream.data(), gdcm::VL(static_cast<std::uint32_t>(codestream.size())));
  const gdcm::SmartPointer<gdcm::SequenceOfFragments> sequence = gdcm::SequenceOfFragments::New();
  sequence->AddFragment(fragment);
  element.SetValue(*sequence);

  InProcessImage image;
  image.SetNumberOfDimensions(2);
  image.SetDimension(0, static_cast<unsigned int>(slice.columns));
  image.SetDimension(1, static_cast<unsigned int>(slice.rows));
  image.SetPixelFormat(
      gdcm::PixelFormat(1, static_cast<unsigned short>(format.bitsAllocated),
                        static_cast<unsigned short>(isWider ? precision : format.bitsStored),
                        static_cast<unsigned short>(isWider ? precision - 1 : format.highBit),
                        static_cast<unsigned short>(format.isSigned ? 1 : 0)));
  image.SetPhotometricInterpretation(gdcm::PhotometricInterpretation::MONOCHROME2);
  image.SetTransferSyntax(
      gdcm::TransferSyntax(gdcm::TransferSyntax::GetTSType(format.transferSyntax.c_str())));
  image.SetDataElement(element);

  bool decoded = false;
  try
  {
    const std::size_t needed =
        pixels.values.size() * static_cast<std::size_t>(format.bitsAllocated / 8);
    if (image.GetBufferLength() == needed)
    {
      pixels.scratch.assign(needed, 0);
      decoded = image.decode(reinterpret_cast<char*>(pixels.scratch.data()));
    }
  }
  catch (const std::exception&) // the text may contain patient data
  {
    decoded = false;
  }
  const gdcm::PixelFormat& real = image.GetPixelFormat();
  if (!decoded || messages.any() || real.GetSamplesPerPixel() != 1 ||
      real.GetBitsAllocated() != format.bitsAllocated)
    fail(slice, "has a damaged compressed image");
  if (isWider)
    unpackWithin(slice, false, pixels, undeclared);
  else
    unpackCells(
        slice, format.bitsAllocated,
        bitField(real.GetBitsStored(), real.GetHighBit(), real.GetPixelRepresentation() == 1),
        false, pixels);
}

namespace
{

/// Before memory is taken for them.
void requireBytes(const ByteSource& source, const SliceHeader& slice, std::uint64_t bytes)
{
  if (slice.pixels.offset > source.size() || bytes > source.size() - slice.pixels.offset)
    fail(slice, "is cut short");
}

void decodeUnchecked(ByteSource& source, const SliceHeader& slice, StoredPixels& pixels,
                     UndeclaredBits undeclared)
{
  const PixelFormat& format = slice.pixels;
  const std::size_t count =
      static_cast<std::size_t>(slice.rows) * static_cast<std::size_t>(slice.columns);
  const auto bits = static_cast<std::size_t>(format.bitsAllocated);
  if (format.isDeflated)
    const DicomElements inflated(source); // side effect: inflates the source
  if (format.isReal)
  {
    if ((bits != 32 && bits != 64) || format.samplesPerPixel != 1 || format.isEncapsulated)
      fail(slice, "does not have one floating-point value of 32 or 64 bits");
    requireBytes(source, slice, count * bits / 8);
    pixels.values.clear();
    pixels.signs = {};
    pixels.reals.resize(count);
    pixels.scratch.resize(count * bits / 8);
    if (!source.read(format.offset, pixels.scratch.data(), pixels.scratch.size()))
      fail(slice, "is cut short");
    if (bits == 32)
      unpackReals<float>(format.isBigEndian, pixels);
    else
      unpackReals<double>(format.isBigEndian, pixels);
    return;
  }
  requireWholePixels(slice);
  pixels.reals.clear();
  pixels.signs = {};
  if (format.isEncapsulated)
  {
    decodeFrame(source, slice, readFragments(source, slice), pixels, undeclared);
    return;
  }
  requireBytes(source, slice, (count * bits + 7) / 8);
  pixels.values.resize(count);
  pixels.scratch.resize((count * bits + 7) / 8);
  const bool isPaired = format.isBigEndian && format.isWords && bits % 16 != 0;
  if (isPaired)
    pixels.scratch.resize(pixels.scratch.size() + pixels.scratch.size() % 2);
  if (!source.read(format.offset, pixels.scratch.data(), pixels.scratch.size()))
    fail(slice, "is cut short");
  for (std::size_t at = 0; isPaired && at + 1 < pixels.scratch.size(); at += 2)
    std::swap(pixels.scratch[at], pixels.scratch[at + 1]);
  unpackWithin(slice, format.isBigEndian, pixels, undeclared);
}

} // namespace

std::string bitsStoredText(const SliceHeader& slice, std::size_t count, const std::string& why)
{
  return slice.file.filename().string() +
         " contradicts itself about the bits of a pixel: " + std::to_string(count) +
         (count == 1 ? " pixel has" : " pixels have") + " values of more than the " +
         std::to_string(slice.pixels.bitsStored) + " bits that its header states (Bits Stored)" +
         why;
}

void decodePixels(const SliceHeader& slice, StoredPixels& pixels, UndeclaredBits undeclared)
{
  pixels.undeclared = 0;
  ByteSource source(slice.file);
  if (!source.isOpen())
    fail(slice, "cannot be opened");
  // What the header says of another file places these pixels wrongly, also where they can be read.
  const bool isKnown = slice.stamp.inode != 0 || slice.stamp.size != 0;
  if (isKnown && !sameContents(source.stamp(), slice.stamp))
    failChanged(slice);
  try
  {
    decodeUnchecked(source, slice, pixels, undeclared);
  }
  catch (const DicomError&)
  {
    if (!source.isUnchanged())
      failChanged(slice);
    if (source.hasFailed())
      throw DicomError(
          DicomError::Reason::Unreadable,
          slice.file.filename().string() +
              " could not be read: the disk or medium was removed or reports an error");
    throw;
  }
  if (!source.isUnchanged())
    failChanged(slice);
}

} // namespace petrous::imaging
