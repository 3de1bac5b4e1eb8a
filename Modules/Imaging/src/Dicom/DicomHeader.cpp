#include "DicomHeader.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <string_view>
#include <utility>

#include "Codestream.h"
#include "DicomDataSet.h"
#include "DicomElements.h"
#include "DicomItem.h"
#include "FileHelpers.h"
#include "PixelCodec.h"
#include "SegmentationReader.h"
#include "petrous/Core/NumberText.h"

namespace petrous::imaging
{

namespace
{

constexpr const char* kCutShort = "is cut short";
constexpr const char* kFewPixels = "holds fewer pixels than its header says";
constexpr const char* kReadError = "could not be read: the disk or medium reports an error";

const char* const kDeflated = "1.2.840.10008.1.2.1.99";
const char* const kImplicit = "1.2.840.10008.1.2";
const char* const kExplicit = "1.2.840.10008.1.2.1";
const char* const kBigEndian = "1.2.840.10008.1.2.2";
const char* const kDirectoryClass = "1.2.840.10008.1.3.10";

/// Single-image compressions that GDCM decodes: JPEG, JPEG-LS, JPEG 2000, RLE.
bool isDecodable(const std::string& syntax)
{
  static const char* const kKnown[] = {
      "1.2.840.10008.1.2.4.50", "1.2.840.10008.1.2.4.51", "1.2.840.10008.1.2.4.57",
      "1.2.840.10008.1.2.4.70", "1.2.840.10008.1.2.4.80", "1.2.840.10008.1.2.4.81",
      "1.2.840.10008.1.2.4.90", "1.2.840.10008.1.2.4.91", "1.2.840.10008.1.2.5"};
  return std::find(std::begin(kKnown), std::end(kKnown), syntax) != std::end(kKnown);
}

/// Whether a SOP class is one of those, by the ends of their UIDs.
template <std::size_t Count>
bool isStorage(std::string_view sopClass, const std::array<std::string_view, Count>& ends)
{
  constexpr std::string_view kStorage = "1.2.840.10008.5.1.4.1.1.";
  return sopClass.substr(0, kStorage.size()) == kStorage &&
         std::find(ends.begin(), ends.end(), sopClass.substr(kStorage.size())) != ends.end();
}

/// SOP classes of slices: CT, MR, their enhanced forms, PET, CR, secondary capture.
bool isSliceClass(std::string_view sopClass)
{
  static constexpr std::array<std::string_view, 9> kEnds = {"1",   "2",   "2.1", "2.2", "4",
                                                            "4.1", "4.4", "7",   "128"};
  return isStorage(sopClass, kEnds);
}

/// SOP classes whose frames are slices placed by functional groups: enhanced and legacy converted
/// CT and MR, X-ray 3D (cone beam).
bool isEnhancedClass(std::string_view sopClass)
{
  static constexpr std::array<std::string_view, 6> kEnds = {"2.1", "2.2",    "4.1",
                                                            "4.4", "13.1.1", "13.1.2"};
  return isStorage(sopClass, kEnds);
}

/// Parametric maps: the frames of those with floating-point pixels are read as an image.
bool isParametricMap(const std::string& sopClass)
{
  return sopClass == "1.2.840.10008.5.1.4.1.1.30";
}

bool isNative(const std::string& syntax)
{
  return syntax == kImplicit || syntax == kExplicit || syntax == kBigEndian || syntax == kDeflated;
}

/// The values of a compressed image.
struct Fragments
{
  std::uint64_t count = 0; ///< without the offset table
  std::uint64_t bytes = 0; ///< of all; 0 also where they reach beyond the file
};

Fragments fragmentsAt(ByteSource& source, std::uint64_t offset)
{
  Fragments all;
  std::uint64_t items = 0;
  std::array<unsigned char, 8> item{};
  while (source.read(offset, item.data(), item.size()))
  {
    const bool isDelimiter = item[0] == 0xfe && item[1] == 0xff && item[2] == 0xdd;
    const bool isItem = item[0] == 0xfe && item[1] == 0xff && item[2] == 0x00;
    if (isDelimiter || !isItem)
      break; // some writers omit the sequence delimiter
    const std::uint64_t length =
        item[4] | (item[5] << 8) | (item[6] << 16) | (static_cast<std::uint64_t>(item[7]) << 24);
    offset += item.size() + length;
    if (offset > source.size())
      return {};
    all.bytes += length;
    all.count = items++;
  }
  return all;
}

/// Whether compressed frames say that they were made with loss, the header of each followed as far
/// as it goes: true if any does; nullopt if one of the others does not say.
std::optional<bool> isLossy(ByteSource& source, const SliceHeader& slice)
{
  const std::vector<Fragment> fragments = readFragments(source, slice);
  const auto byteAt = [&source](std::uint64_t at) -> std::optional<std::uint32_t>
  {
    unsigned char byte = 0;
    return source.readNear(at, &byte, 1) ? std::optional<std::uint32_t>(byte) : std::nullopt;
  };
  const auto begins = [&](const Fragment& fragment) // a frame of several fragments goes on
  {
    const auto first = byteAt(fragment.offset);
    const auto second = byteAt(fragment.offset + 1);
    const bool isJp2 = first == 0U && second == 0U && byteAt(fragment.offset + 3) == 12U;
    return (first == 0xffU && (second == 0xd8U || second == 0x4fU)) || isJp2;
  };
  bool isKnown = true;
  bool isAny = false;
  for (std::size_t from = 1; from < fragments.size() && !isAny;)
  {
    std::size_t to = from + 1;
    while (to < fragments.size() && (slice.frames == 1 || !begins(fragments[to])))
      ++to;
    const auto number = [&](std::uint64_t at, std::size_t bytes) -> std::optional<std::uint32_t>
    {
      std::uint32_t value = 0;
      for (std::size_t b = 0; b < bytes; ++b)
      {
        std::uint64_t within = at + b;
        std::size_t n = from;
        for (; n < to && within >= fragments[n].length; ++n)
          within -= fragments[n].length;
        const auto byte = n < to ? byteAt(fragments[n].offset + within) : std::nullopt;
        if (!byte)
          return std::nullopt;
        value = (value << 8) | *byte;
      }
      return value;
    };
    const auto frame = isLossyCodestream(number, slice.pixels.transferSyntax);
    isKnown = isKnown && frame;
    isAny = isAny || frame.value_or(false);
    from = to;
  }
  return isAny || isKnown ? std::optional(isAny) : std::nullopt;
}

std::optional<Eigen::Vector3d> vectorAt(const std::vector<double>& values, std::size_t first)
{
  if (values.size() < first + 3)
    return std::nullopt;
  return Eigen::Vector3d(values[first], values[first + 1], values[first + 2]);
}

/// The unit of the last decimal, mm. 0 if the numbers have none: scanners whose table moves by
/// whole millimetres write those, and nothing is rounded.
double positionStepOf(const std::vector<std::string>& position)
{
  std::size_t digits = 0;
  for (const std::string& word : position)
  {
    if (word.find_first_of("eE") != std::string::npos)
      return 0.0;
    const std::size_t point = word.find('.');
    if (point != std::string::npos)
      digits = std::max(digits, word.size() - point - 1);
  }
  return digits == 0 ? 0.0 : std::pow(10.0, -static_cast<double>(digits));
}

void readPlace(const DicomElements& elements, SliceHeader& slice)
{
  slice.position = vectorAt(elements.numbers(0x00200032, 3), 0);
  const std::vector<double> cosines = elements.numbers(0x00200037, 6);
  slice.positionStep = positionStepOf(elements.words(0x00200032));
  slice.rowDirection = vectorAt(cosines, 0);
  slice.columnDirection = vectorAt(cosines, 3);
  const std::vector<double> spacing = elements.numbers(0x00280030, 2);
  if (!spacing.empty())
    slice.pixelSpacing = Eigen::Vector2d(spacing[0], spacing[1]);
  slice.thickness = elements.number(0x00180050);
  slice.declaredSpacing = elements.number(0x00180088);
  slice.declaredTilt = elements.number(0x00181120);
  slice.frameOfReferenceUid = elements.text(0x00200052);
  slice.instanceNumber =
      static_cast<int>(std::clamp(elements.number(0x00200013).value_or(0.0), -1e9, 1e9));
}

// The first date present, with its time to the minute.
std::string takenOf(const DicomElements& elements)
{
  constexpr std::pair<Tag, Tag> kDates[] = {
      {0x00080022, 0x00080032}, {0x00080021, 0x00080031}, {0x00080020, 0x00080030}};
  for (const auto& [date, time] : kDates)
    if (const std::string day = elements.text(date); !day.empty())
    {
      const std::string minute = elements.text(time).substr(0, 4);
      return minute.empty() ? day : day + " " + minute;
    }
  return {};
}

void readOrigin(const DicomElements& elements, SliceHeader& slice)
{
  slice.taken = takenOf(elements);
  slice.patientPosition = elements.text(0x00185100);
  slice.patient = patientOf(elements);
  slice.studyUid = elements.text(0x0020000d);
  slice.modality = elements.text(0x00080060);
  slice.kernel = elements.text(0x00181210);
  slice.tube = elements.number(0x00180060);
  const auto whole = [&elements](Tag tag) -> std::optional<int>
  {
    const auto value = elements.number(tag);
    return value && std::abs(*value) < 1e9 ? std::optional(static_cast<int>(*value)) : std::nullopt;
  };
  slice.declaredCount = whole(0x00201209); // of the series
  if (!slice.declaredCount)
    slice.declaredCount = whole(0x00201002); // of the acquisition
  slice.seriesNumber = whole(0x00200011);
  slice.acquisition = whole(0x00200012);
  slice.hasModalityLut = elements.hasModalityLut();
}

void readTraits(const DicomElements& elements, SliceHeader& slice)
{
  const auto whole = [&elements](Tag tag) -> std::optional<int>
  {
    const auto value = elements.number(tag);
    return value && std::abs(*value) < 1e9 ? std::optional(static_cast<int>(*value)) : std::nullopt;
  };
  SliceTraits& traits = slice.traits;
  traits.bValue = elements.real(0x00189087);
  if (!traits.bValue)
    traits.bValue = elements.number(0x0019100c); // Siemens
  if (const auto ge = elements.words(0x00431039); !traits.bValue && !ge.empty())
    if (const auto value = core::parseDouble(ge.front()))
      traits.bValue = std::fmod(*value, 1e9);  // GE adds flags above
  traits.echoTime = elements.real(0x00189082); // of a frame
  if (!traits.echoTime)
    traits.echoTime = elements.number(0x00180081);
  traits.triggerTime = elements.real(0x00209153); // of a frame
  if (!traits.triggerTime)
    traits.triggerTime = elements.number(0x00181060);
  traits.phasePercent = elements.real(0x00209241);
  traits.inversionTime = elements.number(0x00180082);
  traits.echo = whole(0x00180086);
  traits.temporal = elements.integer(0x00209128); // of a frame
  if (!traits.temporal)
    traits.temporal = whole(0x00200100);
  traits.gradient = elements.bytes(0x00189089);
  traits.stack = elements.text(0x00209056);
}

void readPixelFormat(const DicomElements& elements, SliceHeader& slice)
{
  slice.rows = elements.integer(0x00280010).value_or(0);
  slice.columns = elements.integer(0x00280011).value_or(0);
  slice.frames = static_cast<int>(std::clamp(elements.number(0x00280008).value_or(1.0), 1.0, 1e6));
  PixelFormat& pixels = slice.pixels;
  pixels.bitsAllocated = elements.integer(0x00280100).value_or(0);
  pixels.bitsStored = elements.integer(0x00280101).value_or(pixels.bitsAllocated);
  pixels.highBit = elements.integer(0x00280102).value_or(pixels.bitsStored - 1);
  pixels.isSigned = elements.integer(0x00280103).value_or(0) == 1;
  pixels.samplesPerPixel = elements.integer(0x00280002).value_or(1);
  pixels.photometric = elements.text(0x00280004);
  pixels.transferSyntax = elements.transferSyntax();
  pixels.isBigEndian = elements.isBigEndian();
  pixels.isDeflated = pixels.transferSyntax == kDeflated;
  // By the header, or a transfer syntax that cannot be without.
  slice.isLossy = elements.text(0x00282110) == "01" ||
                  pixels.transferSyntax == "1.2.840.10008.1.2.4.50" ||
                  pixels.transferSyntax == "1.2.840.10008.1.2.4.51";
  const std::size_t ratios = elements.words(0x00282112).size(); // one for each compression
  for (const double ratio : elements.numbers(0x00282112, ratios))
    slice.lossyRatio = std::max(slice.lossyRatio.value_or(0.0), ratio);
  const Tag pixelTag = elements.pixels().tag;
  pixels.isReal = pixelTag == kFloatPixelData || pixelTag == kDoublePixelData;
  pixels.isWords = elements.pixels().isWords;
  const auto paddingOf = [&](Tag whole, Tag single, Tag twice) -> std::optional<double>
  {
    if (pixels.isReal)
      return elements.real(pixelTag == kFloatPixelData ? single : twice);
    return elements.integer(whole, pixels.isSigned);
  };
  slice.padding = paddingOf(0x00280120, 0x00280122, 0x00280123);
  slice.paddingRangeLimit = paddingOf(0x00280121, 0x00280124, 0x00280125);
}

/// Whether the table moved while the source turned, which it does in no cone-beam scanner.
bool isHelical(const DicomElements& elements)
{
  const auto says = [](const std::string& option) // "HELICAL MODE", "HELICAL_CT"; "NON-HELICAL"
  {
    const std::size_t at = std::min(option.find("HELI"), option.find("SPIRAL"));
    return at != std::string::npos && option.rfind("NON", at) == std::string::npos;
  };
  const std::vector<std::string> options = elements.words(0x00180022);
  return elements.text(0x00189302) == "SPIRAL" || elements.real(0x00189311).value_or(0.0) > 0.0 ||
         std::any_of(options.begin(), options.end(), says);
}

/// What is wrong with the rescale, or an empty string.
const char* readRescale(const DicomElements& elements, SliceHeader& slice)
{
  constexpr Tag kSlope = 0x00281053;
  constexpr Tag kIntercept = 0x00281052;
  slice.rescaleType = elements.text(0x00281054);
  slice.isCalibrated = slice.rescaleType == kHounsfield && elements.text(0x00080060) == "CT" &&
                       (elements.text(0x00080070) == kManufacturer || isHelical(elements));
  slice.hasRescale = !elements.text(kSlope).empty() || !elements.text(kIntercept).empty();
  if (!slice.hasRescale)
    return "";
  const auto slope = elements.number(kSlope);
  const auto intercept = elements.number(kIntercept);
  if (!slope || !intercept || *slope == 0.0 || std::abs(*slope) > 1e9 || std::abs(*intercept) > 1e9)
    return "states a rescale slope and intercept that cannot be";
  slice.slope = *slope;
  slice.intercept = *intercept;
  return "";
}

/// What is wrong with the encoding of a greyscale image, or an empty string.
const char* checkFormat(const SliceHeader& slice, Tag tag)
{
  const PixelFormat& pixels = slice.pixels;
  const int bits = pixels.bitsAllocated;
  if (pixels.isReal)
    return bits == (tag == kFloatPixelData ? 32 : 64)
               ? ""
               : "contradicts itself about the bits of a pixel";
  if (!isNative(pixels.transferSyntax) && !isDecodable(pixels.transferSyntax))
    return "is compressed in a way that cannot be read";
  // 12 bits, which DICOM allowed until 2007, follow each other within words of 16, the first in the
  // least significant bits (PS3.5-2007 8.1.1). So do 8 bits that are written as words.
  const bool isPacked = bits == 12 || (bits == 8 && pixels.isBigEndian && pixels.isWords);
  const bool isEven = static_cast<std::int64_t>(slice.rows) * slice.columns % 2 == 0;
  if ((bits != 8 && bits != 12 && bits != 16 && bits != 32) ||
      (bits == 12 && (pixels.isEncapsulated || (pixels.isBigEndian && !pixels.isWords))) ||
      (isPacked && slice.frames > 1 && !isEven)) // a frame would begin within a word
    return "has pixels of an unusual number of bits";
  if (pixels.bitsStored < 1 || pixels.bitsStored > bits || pixels.highBit >= bits ||
      pixels.highBit < pixels.bitsStored - 1)
    return "contradicts itself about the bits of a pixel";
  return "";
}

/// Locates the pixels; returns what is wrong with them, or an empty string.
const char* checkPixels(ByteSource& source, const DicomElements::Pixels& found, bool isEnhanced,
                        SliceHeader& slice)
{
  PixelFormat& pixels = slice.pixels;
  pixels.offset = found.offset;
  if (found.offsetCount == static_cast<std::uint64_t>(slice.frames))
    pixels.offsetTable = found.offsetTable;
  pixels.isEncapsulated = found.length == DicomElements::kUndefinedLength;
  pixels.length = pixels.isEncapsulated ? source.size() - found.offset : found.length;
  if (pixels.isEncapsulated && pixels.isReal)
    return "is compressed in a way that cannot be read";
  if (pixels.isEncapsulated && isNative(pixels.transferSyntax))
    return "is compressed, but does not say how";
  if (pixels.offset + pixels.length > source.size())
    return kCutShort;
  if ((slice.frames > 1 && !isEnhanced) || pixels.samplesPerPixel != 1)
    return ""; // excluded for that reason, which is the better one to report
  if (pixels.isEncapsulated)
  {
    const Fragments fragments = fragmentsAt(source, pixels.offset);
    if (fragments.bytes == 0)
      return kCutShort;
    const std::uint64_t count = static_cast<std::uint64_t>(slice.rows) * slice.columns;
    if ((slice.frames > 1 && fragments.count < static_cast<std::uint64_t>(slice.frames)) ||
        count > mostPixels(pixels, fragments.bytes))
      return kFewPixels;
    // These may have loss or not, whatever the header says.
    if (pixels.transferSyntax == "1.2.840.10008.1.2.4.81" ||
        pixels.transferSyntax == "1.2.840.10008.1.2.4.91")
    {
      const auto loss = isLossy(source, slice);
      slice.isLossUnknown = !slice.isLossy && !loss;
      slice.isLossy = slice.isLossy || loss.value_or(false);
    }
  }
  else
  {
    const auto count = static_cast<std::uint64_t>(slice.rows) * slice.columns * slice.frames;
    if (!isNative(pixels.transferSyntax) && !pixels.isReal)
      return "says it is compressed, but is not";
    if (pixels.length < (count * pixels.bitsAllocated + 7) / 8)
      return kFewPixels;
  }
  return checkFormat(slice, found.tag);
}

/// The mapping of a parametric map; what is wrong with it, or an empty string.
const char* readMapping(const DicomElements& elements, SliceHeader& slice)
{
  const auto slope = elements.real(0x00409225);
  const auto intercept = elements.real(0x00409224);
  if (!slope || !intercept || *slope == 0.0)
    return "does not say by a slope and an intercept what its values mean (real world value "
           "mapping)";
  if (elements.text(kRealWorldMapping) != "1")
    return "says in several ways what its values mean (real world value mappings)";
  slice.slope = *slope;
  slice.intercept = *intercept;
  if (const std::string unit = elements.text(0x00080100);
      !unit.empty() && elements.text(0x00080102) == "UCUM")
    slice.rescaleType = unit == "[hnsf'U]" ? "HU" : unit;
  else
    slice.rescaleType = "PARAMETRIC_MAP";
  return "";
}

/// Each frame as a slice. None without functional groups; several frames are then refused.
///
/// isMap  the values are those of the real world value mapping
void readFrames(DicomElements& elements, FileHeader& header, bool isMap)
{
  const SliceHeader& file = header.slice;
  const auto count = static_cast<std::size_t>(file.frames);
  if (elements.frameCount() != count)
  {
    if (elements.frameCount() > 0)
      header.slice.damage =
          "contradicts itself about how many frames it holds: " + std::to_string(count) +
          " (Number of Frames), and " + std::to_string(elements.frameCount()) +
          " (Per-Frame Functional Groups Sequence)";
    return;
  }
  const std::uint64_t bytes = static_cast<std::uint64_t>(file.rows) * file.columns *
                              static_cast<std::uint64_t>(file.pixels.bitsAllocated) / 8;
  for (std::size_t f = 0; f < count; ++f)
  {
    elements.selectFrame(f);
    SliceHeader slice = file;
    readPlace(elements, slice);
    readTraits(elements, slice);
    slice.damage = isMap ? readMapping(elements, slice) : readRescale(elements, slice);
    // Position, orientation, pixel spacing, rescale intercept, slope and type.
    for (const Tag tag :
         {0x00200032U, 0x00200037U, 0x00280030U, 0x00281052U, 0x00281053U, 0x00281054U})
      if (elements.contradictsShared(tag))
        slice.damage = "states place or values twice, for all frames and for one, and they differ";
    // Not Volumetric Properties: Siemens calls echo-planar MR that lies on a grid DISTORTED.
    if (elements.text(0x00089207) == "CURVED_MPR") // Volume Based Calculation Technique
      slice.damage =
          "is a curved reformat (Volume Based Calculation Technique), whose pixels lie on "
          "no straight grid";
    if (const auto type = elements.words(0x00089007); !type.empty())
      slice.imageType = type;
    if (const auto acquisition = elements.integer(0x00209156))
      slice.acquisition = acquisition;
    slice.kernel = elements.text(0x00181210);
    slice.frames = 1;
    // Files of one series in their order, the frames of each in theirs.
    slice.instanceNumber = static_cast<int>(std::min<std::int64_t>(
        static_cast<std::int64_t>(file.instanceNumber) * file.frames + static_cast<int>(f),
        std::numeric_limits<int>::max()));
    slice.stackPosition = elements.integer(0x00209057);
    slice.pixels.frame = static_cast<int>(f);
    slice.pixels.frameCount = file.frames;
    if (!slice.pixels.isEncapsulated)
    {
      slice.pixels.offset += f * bytes;
      slice.pixels.length = bytes;
    }
    header.frames.push_back(std::move(slice));
  }
}

void readSlice(ByteSource& source, DicomElements& elements, const std::string& sopClass,
               FileHeader& header)
{
  SliceHeader& slice = header.slice;
  header.sopClass = sopClass;
  header.seriesUid = elements.text(0x0020000e);
  header.modality = elements.text(0x00080060);
  header.description = elements.text(0x0008103e);
  slice.imageType = elements.words(0x00080008);
  slice.burnedIn = burnedInText(elements.text(0x00280301), header.modality, sopClass,
                                elements.text(0x00080008), !elements.text(0x00080064).empty());
  readPlace(elements, slice);
  readOrigin(elements, slice);
  readTraits(elements, slice);
  readPixelFormat(elements, slice);
  const char* rescale = readRescale(elements, slice);

  const bool complete = elements.state() == DicomElements::State::Complete;
  if (!complete || elements.empty())
  {
    header.kind = header.seriesUid.empty() ? FileKind::Broken : FileKind::Dicom;
    slice.damage = elements.empty() ? kCutShort : "is cut short or damaged";
    return;
  }
  header.kind = FileKind::Dicom;
  // Of a segmentation the frames are structures, and its pixels may be single bits.
  const bool isSegmentation = isSegmentationClass(sopClass);
  slice.isImage = elements.pixels().tag != 0 && (!isSegmentation || slice.frames > 1);
  const bool isMap = isParametricMap(sopClass) && slice.pixels.isReal;
  const bool isEnhanced = isEnhancedClass(sopClass) || isMap;
  if (slice.isImage)
    slice.damage = checkPixels(source, elements.pixels(), isEnhanced, slice);
  // Before DICOM there was another packing of 12 bits.
  if (slice.damage.empty() && slice.pixels.bitsAllocated == 12 && elements.text(0x00020010).empty())
    slice.damage = "has pixels of an unusual number of bits";
  if (isSegmentation && elements.pixels().tag == 0)
    slice.damage = "holds no pixels";
  else if (isSegmentation && !slice.isImage &&
           elements.pixels().length != DicomElements::kUndefinedLength &&
           elements.pixels().offset + elements.pixels().length > source.size())
    slice.damage = kCutShort;
  if (!slice.isImage && !isSegmentation &&
      (slice.rows > 0 || header.seriesUid.empty() || isSliceClass(sopClass)))
  {
    // Truncated between two elements, or stripped: in either case data are lost.
    slice.damage = "holds no pixels";
    if (header.seriesUid.empty())
      header.kind = FileKind::Broken;
  }
  if (slice.damage.empty())
    slice.damage = rescale;
  if (isMap)
    slice.rescaleType = "PARAMETRIC_MAP";
  if (slice.damage.empty() && slice.isImage && isEnhanced)
    readFrames(elements, header, isMap);
}

/// Why a file that is not DICOM may have been, or an empty string: empty, or only zeros of the
/// preamble before the DICM prefix.
const char* shortDamage(ByteSource& source)
{
  std::array<unsigned char, 132> head{};
  const std::uint64_t size = source.size();
  if (size == 0)
    return "is empty";
  if (size >= head.size() || !source.read(0, head.data(), static_cast<std::size_t>(size)))
    return "";
  return std::all_of(head.begin(), head.end(), [](unsigned char c) { return c == 0; }) ? kCutShort
                                                                                       : "";
}

} // namespace

PatientKey patientOf(const DicomElements& elements)
{
  const std::string stated = elements.text(0x00100010);
  const std::string name = toUtf8(stated, elements.text(0x00080005));
  const auto unknown = [](const std::string& text)
  { return std::count(text.begin(), text.end(), '?'); };
  return patientKey(elements.text(0x00100020), elements.text(0x00100021),
                    unknown(name) > unknown(stated) ? stated : name, elements.text(0x00100030));
}

FileHeader readHeader(const std::filesystem::path& file)
{
  FileHeader header;
  header.slice.file = file;
  ByteSource source(file);
  if (!source.isOpen())
  {
    header.kind = FileKind::Broken;
    header.hasFailed = true;
    header.slice.damage = "cannot be opened";
    return header;
  }
  header.slice.stamp = source.stamp();
  DicomElements elements(source);
  if (elements.state() == DicomElements::State::Foreign)
    header.slice.damage = shortDamage(source);
  else
  {
    std::string sopClass = elements.text(0x00080016);
    if (sopClass.empty())
      sopClass = elements.text(0x00020002);
    if (sopClass == kDirectoryClass)
      header.kind = FileKind::Directory;
    else
      readSlice(source, elements, sopClass, header);
  }
  if (source.hasFailed())
  {
    header.hasFailed = true;
    if (header.kind == FileKind::Foreign)
      header.kind = FileKind::Broken; // nobody knows
    header.frames.clear();
    header.slice.damage = kReadError;
  }
  return header;
}

} // namespace petrous::imaging
