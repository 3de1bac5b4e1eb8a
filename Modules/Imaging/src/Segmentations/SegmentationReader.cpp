#include "SegmentationReader.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <iterator>
#include <limits>
#include <map>
#include <set>
#include <utility>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <zlib.h>

#include "ByteSource.h"
#include "DicomElements.h"
#include "DicomHeader.h"
#include "DicomItem.h"
#include "FileHelpers.h"
#include "GridFromAffine.h"
#include "LabelNames.h"
#include "MemoryCheck.h"
#include "PixelCodec.h"
#include "petrous/Imaging/DicomScan.h"

namespace petrous::imaging
{

namespace
{

using Reason = FileError::Reason;
using LabelVolume = volume::Volume<std::uint16_t>;

constexpr std::uint64_t kMaxHeader = std::uint64_t{512} << 20; // bytes before the pixels
constexpr std::uint64_t kMaxVoxels = std::uint64_t{1} << 31;   // of all layers
constexpr double kMaxTurn = 1e-4;      // between the orientations of two frames, of unit vectors
constexpr double kMinTolerance = 0.05; // mm, of a frame's place
constexpr double kRelativeTolerance = 0.1;                   // of the spacing of slices
constexpr std::size_t kLongestPartName = 200;                // bytes; longer text is no name
constexpr double kNotedError = 1e-3;                         // mm
constexpr double kMinSpacing = 1e-3;                         // mm, of slices
constexpr std::size_t kMaxCompressed = std::size_t{1} << 26; // pixels of a frame

/// Deflated Image Frame Compression (PS3.5 A.4.13): the only one for frames of single bits.
constexpr const char* kDeflatedFrames = "1.2.840.10008.1.2.8.1";
constexpr const char* kLossless[] = {kDeflatedFrames,
                                     "1.2.840.10008.1.2.5",     // RLE
                                     "1.2.840.10008.1.2.4.57",  // JPEG
                                     "1.2.840.10008.1.2.4.70",  // JPEG, first-order prediction
                                     "1.2.840.10008.1.2.4.80",  // JPEG-LS
                                     "1.2.840.10008.1.2.4.90"}; // JPEG 2000

enum class Type
{
  Binary,
  Fractional,
  Labelmap
};

struct Frame
{
  std::size_t number = 0; ///< its place in the pixel data
  int segment = 0;        ///< not used by LABELMAP
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
  int slice = 0;
};

struct Segmentation
{
  std::filesystem::path path;
  Type type = Type::Binary;
  int rows = 0, columns = 0, bits = 0;
  int padding = 0;          ///< LABELMAP: the value of voxels of no segment
  int maxFraction = 255;    ///< FRACTIONAL
  bool isOccupancy = false; ///< FRACTIONAL: how much of a voxel is in the segment
  DicomElements::Pixels pixels;
  bool swapsWords = false;         ///< big endian, written as words of 16 bits
  std::vector<Fragment> fragments; ///< of compressed frames; none: uncompressed
  SliceHeader compressed;          ///< of these, for the decoder
  StoredPixels decoded;            ///< of one frame; reused
  std::vector<Frame> frames;
  Eigen::Vector3d row = Eigen::Vector3d::UnitX(), column = Eigen::Vector3d::UnitY();
  Eigen::Vector2d pixelSpacing = Eigen::Vector2d::Zero(); ///< between rows, between columns; mm
  double sliceSpacing = 0.0;                              ///< as declared; 0: not
  double thickness = 0.0;                                 ///< likewise
  double gap = std::numeric_limits<double>::infinity();   ///< of neighbouring frames, mm
  std::uint64_t memory = 0; ///< bytes that the voxels may take; 0: what is left
};

std::size_t pixelsPerFrame(const Segmentation& file)
{
  return static_cast<std::size_t>(file.rows) * static_cast<std::size_t>(file.columns);
}

/// The functional group that states a value of one frame: its own, else the one that all share.
DicomItem groupOf(const DicomItem& own, const DicomItem& shared, Tag group, Tag value)
{
  DicomItem item = own.item(group);
  return item.has(value) ? item : shared.item(group);
}

bool isContradicted(const DicomItem& own, const DicomItem& shared, Tag group, Tag value)
{
  return contradict(own.item(group).text(value), shared.item(group).text(value));
}

Type typeOf(const std::filesystem::path& path, const DicomItem& data)
{
  const std::string type = data.text(0x00620001);
  if (type == "BINARY")
    return Type::Binary;
  if (type == "FRACTIONAL")
    return Type::Fractional;
  if (type == "LABELMAP")
    return Type::Labelmap;
  fail(Reason::Unsupported, path,
       "is a DICOM segmentation of a type that is not read; export it as BINARY, FRACTIONAL or "
       "LABELMAP");
}

[[noreturn]] void failFrame(const std::filesystem::path& path, std::size_t frame,
                            const std::string& what)
{
  fail(Reason::NoGeometry, path,
       "its frame " + std::to_string(frame + 1) + " " + what + "; export the segmentation again");
}

void readFrame(Segmentation& file, const DicomItem& own, const DicomItem& shared, Frame& frame)
{
  const auto numbers = [&](Tag group, Tag value)
  { return groupOf(own, shared, group, value).numbers(value); };
  const auto number = [&](Tag group, Tag value)
  { return groupOf(own, shared, group, value).number(value).value_or(0.0); };
  const auto position = numbers(0x00209113, 0x00200032);
  const auto axes = numbers(0x00209116, 0x00200037);
  const auto spacing = numbers(0x00289110, 0x00280030);
  if (isContradicted(own, shared, 0x00209113, 0x00200032) ||
      isContradicted(own, shared, 0x00209116, 0x00200037) ||
      isContradicted(own, shared, 0x00289110, 0x00280030) ||
      isContradicted(own, shared, 0x00289110, 0x00180088))
    failFrame(file.path, frame.number,
              "states its place twice, for itself and for all frames, and they differ");
  if (position.size() != 3)
    failFrame(file.path, frame.number, "states no position");
  if (axes.size() != 6 || spacing.size() != 2)
    failFrame(file.path, frame.number, "states no orientation or no pixel spacing");
  frame.position = Eigen::Vector3d(position[0], position[1], position[2]);
  const Eigen::Vector3d row(axes[0], axes[1], axes[2]);
  const Eigen::Vector3d column(axes[3], axes[4], axes[5]);
  const Eigen::Vector2d pixel(spacing[0], spacing[1]);
  if (frame.number == 0)
  {
    file.row = row;
    file.column = column;
    file.pixelSpacing = pixel;
    file.sliceSpacing = std::abs(number(0x00289110, 0x00180088));
    file.thickness = number(0x00289110, 0x00180050);
  }
  else if ((row - file.row).norm() > kMaxTurn || (column - file.column).norm() > kMaxTurn ||
           (pixel - file.pixelSpacing).norm() > kMaxTurn)
    failFrame(file.path, frame.number,
              "has another orientation or pixel spacing than the first, which is not read");
  if (file.type != Type::Labelmap)
    frame.segment = groupOf(own, shared, 0x0062000a, 0x0062000b).integer(0x0062000b).value_or(0);
  if (file.type != Type::Labelmap && frame.segment == 0)
    fail(Reason::Unreadable, file.path,
         "its frame " + std::to_string(frame.number + 1) +
             " names no segment; export the segmentation again");
}

/// What `read` returns; errors of the codec become the file's.
template <class Read>
auto decoding(const Segmentation& file, const Read& read)
{
  try
  {
    return read();
  }
  catch (const DicomError&)
  {
    fail(Reason::Unreadable, file.path, "has a damaged compressed frame; copy or export it again");
  }
}

/// Finds the compressed frames.
void findFragments(Segmentation& file, ByteSource& source, const DicomElements& elements)
{
  const std::string& syntax = elements.transferSyntax();
  const bool isDeflated = syntax == kDeflatedFrames;
  if (pixelsPerFrame(file) > kMaxCompressed)
    fail(Reason::Unsupported, file.path,
         "holds compressed frames of more than 64 million pixels; export it uncompressed");
  if (std::find(std::begin(kLossless), std::end(kLossless), syntax) == std::end(kLossless) ||
      (file.bits == 1 && !isDeflated))
    fail(Reason::Unsupported, file.path,
         "is a DICOM segmentation of a compression that is not read or not lossless; export it "
         "uncompressed (explicit VR little endian)");
  file.compressed.file = file.path;
  file.compressed.rows = file.rows;
  file.compressed.columns = file.columns;
  PixelFormat& format = file.compressed.pixels;
  format.bitsAllocated = file.bits;
  format.bitsStored = file.bits;
  format.highBit = file.bits - 1;
  format.transferSyntax = syntax;
  format.isEncapsulated = true;
  format.offset = file.pixels.offset;
  format.frameCount = static_cast<int>(file.frames.size());
  file.fragments = decoding(file, [&] { return readFragments(source, file.compressed); });
  if (file.fragments.size() < file.frames.size() + 1)
    fail(Reason::Unreadable, file.path,
         "holds fewer pixels than its " + std::to_string(file.frames.size()) +
             " frames need; copy or export it again");
}

/// Checks that the pixels of all frames are there.
void checkPixels(Segmentation& file, ByteSource& source, const DicomElements& elements)
{
  const int bits = file.bits;
  const bool fits = file.type == Type::Binary       ? bits == 1
                    : file.type == Type::Fractional ? bits == 8
                                                    : bits == 8 || bits == 16;
  if (file.rows < 1 || file.columns < 1 || !fits)
    fail(Reason::Unreadable, file.path,
         "its rows, columns and bits of a pixel are not those of its type of segmentation; export "
         "it again");
  if (file.pixels.tag != kPixelData)
    fail(Reason::Unreadable, file.path, "holds no pixel data; copy or export it again");
  if (file.pixels.length == DicomElements::kUndefinedLength)
  {
    findFragments(file, source, elements);
    return;
  }
  if (elements.isBigEndian())
  {
    std::array<char, 2> vr{}; // before two bytes that are reserved, and the length
    file.swapsWords = file.pixels.offset >= 8 &&
                      source.read(file.pixels.offset - 8, vr.data(), vr.size()) && vr[1] == 'W';
  }
  // 65535 squared, 16 bits and frames of 8 bytes a header at least: below 2^64
  const std::uint64_t needed =
      (std::uint64_t{pixelsPerFrame(file)} * file.frames.size() * static_cast<unsigned>(bits) + 7) /
      8;
  if (file.pixels.length < needed || file.pixels.offset > source.size() ||
      source.size() - file.pixels.offset < needed)
    fail(Reason::Unreadable, file.path,
         "holds fewer pixels than its " + std::to_string(file.frames.size()) +
             " frames need; copy or export it again");
}

/// How far a frame may lie from its slice, mm.
double toleranceOf(double spacing)
{
  return std::max(kMinTolerance, kRelativeTolerance * spacing);
}

/// The same in slices; less than what any place would have.
double shareOf(double spacing)
{
  return std::min(toleranceOf(spacing) / spacing, 0.25);
}

/// Whether all places (mm along the normal) lie on slices of this spacing.
bool liesOnSlices(const std::vector<double>& at, double spacing)
{
  return spacing > kMinSpacing &&
         std::all_of(at.begin(), at.end(),
                     [&](double place)
                     {
                       const double slices = (place - at.front()) / spacing;
                       return std::abs(slices - std::round(slices)) <= shareOf(spacing);
                     });
}

/// The spacing of the slices of an image in which all frames lie; 0: there is none.
double spacingOfImage(const Segmentation& file, const std::vector<ImageGrid>& images)
{
  const Eigen::Vector3d normal = file.row.cross(file.column).normalized();
  for (const core::GridGeometry& image : images)
    for (int axis = 0; axis < 3; ++axis)
    {
      const double spacing = image.spacing()[axis];
      if (std::abs(normal.dot(image.direction().col(axis))) < 1.0 - kMaxTurn ||
          !(spacing > kMinSpacing))
        continue;
      const auto isSlice = [&](const Frame& frame)
      {
        const double slice = image.voxelFromPatient(frame.position)[axis];
        return std::abs(slice - std::round(slice)) <= shareOf(spacing);
      };
      const double rows = image.spacing()[(axis + 1) % 3];
      const double columns = image.spacing()[(axis + 2) % 3];
      const Eigen::Vector2d pixel(std::min(rows, columns), std::max(rows, columns));
      const Eigen::Vector2d own(file.pixelSpacing.minCoeff(), file.pixelSpacing.maxCoeff());
      if (pixel.isApprox(own, kMinSpacing) &&
          std::all_of(file.frames.begin(), file.frames.end(), isSlice))
        return spacing;
    }
  return 0.0;
}

/// The smallest distance of neighbouring places, as the mean of those that rounded decimals make
/// differ.
double smallestGap(const std::vector<double>& at)
{
  double smallest = std::numeric_limits<double>::infinity();
  for (std::size_t n = 1; n < at.size(); ++n)
    smallest = std::min(smallest, at[n] - at[n - 1]);
  double sum = 0.0;
  int count = 0;
  for (std::size_t n = 1; n < at.size(); ++n)
    if (const double gap = at[n] - at[n - 1]; gap < 1.5 * smallest)
    {
      sum += gap;
      ++count;
    }
  return count > 0 ? sum / count : smallest;
}

/// That the frames are thicker than the image's slices, of which they have some only.
std::string thickerText(const Segmentation& file, double spacing)
{
  return "states no spacing of its slices, which are " + roughText(file.thickness) +
         " mm thick; those of the image are " + roughText(spacing) +
         " mm apart, which was taken, so that what lies between the slices of the file is empty; "
         "check the volumes";
}

/// The spacing of slices whose sorted places (mm along the normal) are `at`: as declared, if that
/// is true to the places, which may be far apart; else their distance, if they are just as thick;
/// else that of an image that has all of them; else the thickness; else the smallest gap. Guesses
/// are noted.
double spacingOf(const Segmentation& file, const std::vector<double>& at,
                 const std::vector<ImageGrid>& images, std::vector<std::string>& notes)
{
  if (at.size() < 2)
  {
    if (file.sliceSpacing > 0.0)
      return file.sliceSpacing;
    const double ofImage = spacingOfImage(file, images);
    if (ofImage > 0.0 && file.thickness > ofImage + toleranceOf(ofImage))
      notes.push_back("states no spacing of its one slice, which is " + roughText(file.thickness) +
                      " mm thick; the slices of the image are " + roughText(ofImage) +
                      " mm apart, which was taken; check the volumes");
    if (ofImage <= 0.0 && file.thickness > 0.0)
      notes.push_back("states no spacing of its one slice, which is " + roughText(file.thickness) +
                      " mm thick; that was taken");
    return ofImage > 0.0 ? ofImage : file.thickness;
  }
  if (liesOnSlices(at, file.sliceSpacing))
    return file.sliceSpacing;
  const double gap = file.gap;
  if (const double spacing = spacingOfImage(file, images); spacing > 0.0)
  {
    const bool isTiled =
        std::abs(file.thickness - gap) <= toleranceOf(gap) && liesOnSlices(at, gap);
    if (isTiled || spacing >= gap - toleranceOf(gap))
      return gap;
    if (file.thickness > spacing + toleranceOf(spacing))
      notes.push_back(thickerText(file, spacing));
    return spacing;
  }
  if (file.thickness >= gap - toleranceOf(gap)) // slices may overlap
    return gap;
  const std::string apart =
      "states no spacing of its slices; its frames lie " + roughText(gap) + " mm apart or more";
  if (liesOnSlices(at, file.thickness))
  {
    notes.push_back(apart + " and are " + roughText(file.thickness) +
                    " mm thick, so that what lies between them was taken to be empty");
    return file.thickness;
  }
  notes.push_back(apart + ", which was taken for their thickness; check the volumes");
  return gap;
}

/// Puts each frame into its slice.
core::GridGeometry placeFrames(Segmentation& file, const std::vector<ImageGrid>& images,
                               std::vector<std::string>& notes)
{
  const Eigen::Vector3d normal = file.row.cross(file.column).normalized();
  if (!normal.allFinite() || normal.norm() < 0.5)
    failFrame(file.path, 0, "has no orientation that can be true");
  std::vector<double> at;
  for (const Frame& frame : file.frames)
    at.push_back(normal.dot(frame.position));
  std::sort(at.begin(), at.end());
  at.erase(std::unique(at.begin(), at.end(), [](double a, double b) { return b - a < 1e-3; }),
           at.end());
  file.gap = smallestGap(at);
  double spacing = spacingOf(file, at, images, notes);
  if (!(spacing > kMinSpacing))
    fail(Reason::NoGeometry, file.path,
         "its one slice states no thickness and no spacing; export the segmentation again");
  const double range = at.back() - at.front();
  const double steps = std::round(range / spacing);
  const double limit = static_cast<double>(kMaxVoxels) / static_cast<double>(pixelsPerFrame(file));
  if (!(steps + 1.0 <= limit))
    fail(Reason::Unsupported, file.path,
         "its frames lie " + roughText(range) +
             " mm apart, in more voxels than are read; crop it, or look at the positions of its "
             "frames");
  if (steps > 0.0)
    spacing = range / steps;
  const Frame* lowest = &file.frames.front();
  for (const Frame& frame : file.frames)
    if (normal.dot(frame.position) < normal.dot(lowest->position))
      lowest = &frame;
  const double tolerance = toleranceOf(spacing);
  double worst = 0.0;
  for (Frame& frame : file.frames)
  {
    frame.slice =
        static_cast<int>(std::lround(normal.dot(frame.position - lowest->position) / spacing));
    const double error =
        (frame.position - lowest->position - frame.slice * spacing * normal).norm();
    if (!(error <= tolerance))
      failFrame(file.path, frame.number,
                "lies " + roughText(error) +
                    " mm off the even slices of the others (uneven spacing or a tilted gantry), "
                    "which is not read");
    worst = std::max(worst, error);
  }
  if (worst > kNotedError)
    notes.push_back("frames up to " + roughText(worst) +
                    " mm off even slices were taken to lie on them");
  Eigen::Matrix3d linear;
  linear << file.row * file.pixelSpacing[1], file.column * file.pixelSpacing[0], normal * spacing;
  return gridFromAffine(file.path,
                        {static_cast<std::uint64_t>(file.columns),
                         static_cast<std::uint64_t>(file.rows),
                         static_cast<std::uint64_t>(steps) + 1},
                        linear, lowest->position, notes);
}

/// How thick a frame is by the file itself, mm, whatever grid it was put into; overlapping slices
/// are as thick as they are apart.
double thicknessOf(const Segmentation& file, const core::GridGeometry& grid)
{
  const double spacing = grid.spacing()[2];
  if (file.thickness <= kMinSpacing ||
      (file.sliceSpacing > kMinSpacing &&
       std::abs(file.sliceSpacing - spacing) <= toleranceOf(spacing)))
    return spacing;
  const double thickness = std::min(file.thickness, file.gap);
  return std::abs(thickness - spacing) <= toleranceOf(spacing) ? spacing : thickness;
}

/// Calls visit(pixel) for the pixels of a frame that belong to its segment, until it returns false.
template <class Visit>
bool forEachPixel(const Segmentation& file, const std::vector<unsigned char>& bytes,
                  std::size_t firstBit, const Visit& visit)
{
  const std::size_t count = pixelsPerFrame(file);
  if (file.type == Type::Fractional)
  {
    for (std::size_t p = 0; p < count; ++p)
      if (bytes[p] != 0 && 2 * int{bytes[p]} >= file.maxFraction && !visit(p))
        return false;
    return true;
  }
  const std::size_t end = firstBit + count; // the least significant bit of a byte comes first
  for (std::size_t byte = 0; byte < bytes.size(); ++byte)
  {
    while (byte + 8 <= bytes.size())
    {
      std::uint64_t word = 0;
      std::memcpy(&word, bytes.data() + byte, sizeof word);
      if (word != 0)
        break;
      byte += 8;
    }
    if (byte >= bytes.size())
      break;
    for (unsigned rest = bytes[byte]; rest != 0; rest &= rest - 1)
    {
      const std::size_t bit = 8 * byte + static_cast<std::size_t>(__builtin_ctz(rest));
      if (bit >= firstBit && bit < end && !visit(bit - firstBit))
        return false;
    }
  }
  return true;
}

/// Inflates raw DEFLATE data to just `bytes`.
bool inflateTo(const std::vector<char>& packed, std::vector<unsigned char>& bytes)
{
  z_stream stream = {};
  if (inflateInit2(&stream, -MAX_WBITS) != Z_OK) // negative: no zlib header
    return false;
  // zlib does not write to it
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(packed.data()));
  stream.avail_in = static_cast<uInt>(packed.size());
  stream.next_out = bytes.data();
  stream.avail_out = static_cast<uInt>(bytes.size());
  const int state = inflate(&stream, Z_FINISH);
  inflateEnd(&stream);
  return state == Z_STREAM_END && stream.avail_out == 0;
}

void decompress(Segmentation& file, ByteSource& source, const Frame& frame,
                std::vector<unsigned char>& bytes)
{
  file.compressed.pixels.frame = static_cast<int>(frame.number);
  const auto bits = static_cast<std::size_t>(file.bits);
  bytes.resize((pixelsPerFrame(file) * bits + 7) / 8);
  if (file.compressed.pixels.transferSyntax == kDeflatedFrames)
  {
    if (!inflateTo(
            decoding(file, [&] { return readCodestream(source, file.compressed, file.fragments); }),
            bytes))
      fail(Reason::Unreadable, file.path,
           "has a damaged compressed frame; copy or export it again");
    return;
  }
  decoding(file, [&] { decodeFrame(source, file.compressed, file.fragments, file.decoded); });
  for (std::size_t p = 0; p < pixelsPerFrame(file); ++p)
    for (std::size_t b = 0; b < bits / 8; ++b)
      bytes[p * bits / 8 + b] = static_cast<unsigned char>(file.decoded.values[p] >> 8 * b);
}

/// Reads the bytes of a frame, little endian; returns where its first pixel lies in them, in bits.
std::size_t readPixels(Segmentation& file, ByteSource& source, const Frame& frame,
                       std::vector<unsigned char>& bytes)
{
  if (!file.fragments.empty())
  {
    decompress(file, source, frame, bytes);
    return 0;
  }
  const std::uint64_t bits = std::uint64_t{pixelsPerFrame(file)} * static_cast<unsigned>(file.bits);
  const std::uint64_t first = bits * frame.number;
  std::uint64_t begin = first / 8;
  std::uint64_t end = (first + bits + 7) / 8;
  if (file.swapsWords)
  {
    begin -= begin % 2;
    end = std::min<std::uint64_t>(end + end % 2, file.pixels.length);
  }
  bytes.resize(static_cast<std::size_t>(end - begin));
  if (!source.read(file.pixels.offset + begin, bytes.data(), bytes.size()))
    fail(Reason::Unreadable, file.path, "cannot be read to its end; copy it again");
  if (file.swapsWords)
  {
    for (std::size_t at = 0; at + 1 < bytes.size(); at += 2)
      std::swap(bytes[at], bytes[at + 1]);
    if (file.bits > 1) // whole bytes, of this frame only
    {
      bytes.erase(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(first / 8 - begin));
      bytes.resize(static_cast<std::size_t>(bits / 8));
      return 0;
    }
  }
  return static_cast<std::size_t>(first - 8 * begin);
}

struct Layers
{
  void add(const std::filesystem::path& path, const core::GridGeometry& grid, std::uint64_t memory)
  {
    // What is left is after the layers before.
    const std::uint64_t count = memory == 0 ? 1 : voxels.size() + 1;
    requireMemory(path, count * grid.voxelCount() * sizeof(std::uint16_t), kFewer, memory);
    voxels.push_back(volume::makeZeroVolume<std::uint16_t>(grid));
  }

  static constexpr const char* kFewer = "export fewer of its segments at a time";
  std::vector<std::shared_ptr<LabelVolume>> voxels;
  std::map<int, std::size_t> layerOf; ///< by segment number
  std::map<int, double> pixels;       ///< in the frames of each segment; of occupancy, their sum
};

/// Paints one segment into the first layer in which it overlaps no other.
void paintSegment(Segmentation& file, ByteSource& source, const core::GridGeometry& grid,
                  const Frame* first, const Frame* last, Layers& layers)
{
  const auto label = static_cast<std::uint16_t>(first->segment);
  std::vector<unsigned char> bytes;
  for (std::size_t layer = 0;; ++layer)
  {
    if (layer == layers.voxels.size())
    {
      if ((layer + 1) * grid.voxelCount() > kMaxVoxels)
        fail(Reason::Unsupported, file.path,
             "its segments overlap in more layers than are read; export fewer of them at a time");
      layers.add(file.path, grid, file.memory);
    }
    const Frame* frame = first;
    double pixels = 0.0;
    for (; frame != last; ++frame)
    {
      const std::size_t bit = readPixels(file, source, *frame, bytes);
      if (file.isOccupancy)
        for (const unsigned char fraction : bytes)
          pixels += static_cast<double>(fraction) / file.maxFraction;
      std::uint16_t* slice = &layers.voxels[layer]->at(0, 0, frame->slice);
      if (!forEachPixel(file, bytes, bit,
                        [&](std::size_t p)
                        {
                          if (slice[p] != 0 && slice[p] != label)
                            return false;
                          slice[p] = label;
                          pixels += file.isOccupancy ? 0.0 : 1.0;
                          return true;
                        }))
        break;
    }
    if (frame == last)
    {
      layers.layerOf[label] = layer;
      layers.pixels[label] = pixels;
      return;
    }
    for (const Frame* painted = first; painted <= frame; ++painted)
    {
      std::uint16_t* slice = &layers.voxels[layer]->at(0, 0, painted->slice);
      for (std::size_t p = 0; p < pixelsPerFrame(file); ++p)
        if (slice[p] == label)
          slice[p] = 0;
    }
  }
}

/// The pixels of a frame that belong to its segment; of fractions, each with its value.
std::vector<std::size_t> pixelsOf(Segmentation& file, ByteSource& source, const Frame& frame)
{
  std::vector<unsigned char> bytes;
  const std::size_t bit = readPixels(file, source, frame, bytes);
  std::vector<std::size_t> pixels;
  if (file.type == Type::Fractional)
  {
    for (std::size_t p = 0; p < pixelsPerFrame(file); ++p)
      if (bytes[p] != 0)
        pixels.push_back(p << 8 | bytes[p]);
    return pixels;
  }
  forEachPixel(file, bytes, bit,
               [&pixels](std::size_t p)
               {
                 pixels.push_back(p);
                 return true;
               });
  return pixels;
}

/// Of frames of one segment at one place, which lie together, keeps one if they are equal or the
/// others are empty.
void dropCopies(Segmentation& file, ByteSource& source, std::vector<std::string>& notes)
{
  std::size_t empty = 0;
  std::size_t firstEmpty = 0;
  auto kept = file.frames.begin();
  for (auto frame = std::next(kept); frame < file.frames.end(); ++frame)
  {
    if (frame->segment != kept->segment || frame->slice != kept->slice)
    {
      *++kept = *frame;
      continue;
    }
    const auto first = pixelsOf(file, source, *kept);
    const auto second = pixelsOf(file, source, *frame);
    if (!first.empty() && !second.empty() && first != second)
      failFrame(file.path, frame->number,
                "lies where frame " + std::to_string(kept->number + 1) +
                    " of the same segment does, and differs from it");
    if (first.empty() != second.empty() && empty++ == 0)
      firstEmpty = (first.empty() ? *kept : *frame).number + 1;
    if (first.empty())
      *kept = *frame;
  }
  file.frames.erase(std::next(kept), file.frames.end());
  if (empty > 0)
    notes.push_back("has " + std::to_string(empty) +
                    (empty == 1 ? " empty frame" : " empty frames") + " (the first is frame " +
                    std::to_string(firstEmpty) +
                    ") where another of the same segment lies, which was taken");
}

Layers paintSegments(Segmentation& file, ByteSource& source, const core::GridGeometry& grid,
                     std::vector<std::string>& notes, const core::Progress& progress)
{
  std::stable_sort(file.frames.begin(), file.frames.end(),
                   [](const Frame& a, const Frame& b)
                   { return std::pair(a.segment, a.slice) < std::pair(b.segment, b.slice); });
  dropCopies(file, source, notes);
  Layers layers;
  layers.add(file.path, grid, file.memory);
  const Frame* end = file.frames.data() + file.frames.size();
  for (const Frame* first = file.frames.data(); first != end;)
  {
    progress.report(static_cast<double>(first - file.frames.data()) /
                        static_cast<double>(file.frames.size()),
                    "reading labels");
    const Frame* last = std::find_if(
        first, end, [first](const Frame& frame) { return frame.segment != first->segment; });
    paintSegment(file, source, grid, first, last, layers);
    first = last;
  }
  return layers;
}

Layers copyLabelmap(Segmentation& file, ByteSource& source, const core::GridGeometry& grid,
                    const core::Progress& progress)
{
  Layers layers;
  layers.add(file.path, grid, file.memory);
  std::vector<unsigned char> bytes;
  std::vector<const Frame*> taken(static_cast<std::size_t>(grid.dims()[2]), nullptr);
  for (const Frame& frame : file.frames)
  {
    progress.report(static_cast<double>(frame.number) / static_cast<double>(file.frames.size()),
                    "reading labels");
    readPixels(file, source, frame, bytes);
    if (const Frame* other = std::exchange(taken[static_cast<std::size_t>(frame.slice)], &frame))
    {
      std::vector<unsigned char> same;
      readPixels(file, source, *other, same);
      if (bytes != same)
        failFrame(file.path, frame.number,
                  "lies where frame " + std::to_string(other->number + 1) +
                      " does, and differs from it");
      continue;
    }
    std::uint16_t* slice = &layers.voxels[0]->at(0, 0, frame.slice);
    const std::size_t size = static_cast<std::size_t>(file.bits) / 8;
    for (std::size_t p = 0; p < pixelsPerFrame(file); ++p)
    {
      const int value = size == 1 ? bytes[p] : bytes[2 * p] | (bytes[2 * p + 1] << 8);
      if (value != 0 && value != file.padding)
        slice[p] = static_cast<std::uint16_t>(value);
    }
  }
  return layers;
}

/// That the segments of all frames are described.
void requireDeclared(const Segmentation& file, const std::vector<DicomItem>& segments)
{
  if (file.type == Type::Labelmap)
    return; // their values are named by index, and found in the pixels
  std::set<int> declared;
  for (const DicomItem& item : segments)
    declared.insert(item.integer(0x00620004).value_or(0));
  for (const Frame& frame : file.frames)
    if (declared.count(frame.segment) == 0)
      failFrame(file.path, frame.number,
                "is of segment " + std::to_string(frame.segment) +
                    ", which the file does not describe");
}

// XYZ of white, of illuminant D50; Y is 1
constexpr double kWhiteX = 0.96422;
constexpr double kWhiteZ = 0.82521;

/// Linear sRGB (IEC 61966-2-1) from XYZ relative to D50, adapted to D65 (Bradford).
Eigen::Matrix3d rgbFromXyz()
{
  Eigen::Matrix3d matrix;
  matrix << 3.1338561, -1.6168667, -0.4906146, -0.9787684, 1.9161415, 0.0334540, 0.0719453,
      -0.2289914, 1.4052427;
  return matrix;
}

/// What a segment is, by its codes: its anatomic region, if stated, and its type.
std::string meaningOf(const DicomItem& segment, const std::string& characters)
{
  const DicomItem anatomy = segment.item(0x00082218);
  const DicomItem type = segment.item(0x0062000f);
  std::string text = type.text(0x00080104);
  if (const std::string place = anatomy.text(0x00080104); !place.empty())
    text = place + " " + text;
  return toUtf8(text, characters);
}

volume::SegmentCodes codesOf(const DicomItem& segment, const std::string& characters)
{
  volume::SegmentCodes codes;
  codes.category = codedConcept(segment.item(0x00620003), characters);
  const DicomItem type = segment.item(0x0062000f);
  codes.type = codedConcept(type, characters);
  codes.typeModifier = codedConcept(type.item(0x00620011), characters);
  const DicomItem region = segment.item(0x00082218);
  codes.region = codedConcept(region, characters);
  codes.regionModifier = codedConcept(region.item(0x00082220), characters);
  codes.algorithm = algorithmFrom(segment.text(0x00620008));
  codes.algorithmName = toUtf8(segment.text(0x00620009), characters);
  return codes;
}

} // namespace

volume::CodedConcept codedConcept(const DicomItem& item, const std::string& characters)
{
  volume::CodedConcept code;
  for (const Tag tag : {Tag{0x00080100}, Tag{0x00080119}, Tag{0x00080120}})
    if (code.value.empty())
      code.value = toUtf8(item.text(tag), characters);
  code.scheme = toUtf8(item.text(0x00080102), characters);
  code.meaning = toUtf8(item.text(0x00080104), characters);
  return code;
}

volume::SegmentCodes::Algorithm algorithmFrom(const std::string& text)
{
  using Algorithm = volume::SegmentCodes::Algorithm;
  return text == "MANUAL"          ? Algorithm::Manual
         : text == "SEMIAUTOMATIC" ? Algorithm::SemiAutomatic
         : text == "AUTOMATIC"     ? Algorithm::Automatic
                                   : Algorithm::Unknown;
}

std::string sopClassOf(const std::filesystem::path& path)
{
  ByteSource source(path);
  if (!source.isOpen())
    return {};
  const DicomElements elements(source);
  const std::string stated = elements.text(0x00080016);
  return stated.empty() ? elements.text(0x00020002) : stated;
}

bool isSegmentationClass(const std::string& sopClass)
{
  return sopClass == "1.2.840.10008.5.1.4.1.1.66.4" || sopClass == "1.2.840.10008.5.1.4.1.1.66.7";
}

std::array<float, 3> colorFromCieLab(const std::vector<int>& value)
{
  if (value.size() != 3)
    return {};
  const double l = value[0] * 100.0 / 65535.0;
  const double a = value[1] * 255.0 / 65535.0 - 128.0;
  const double b = value[2] * 255.0 / 65535.0 - 128.0;
  const auto inverse = [](double t)
  { return t > 6.0 / 29.0 ? t * t * t : 3.0 * (6.0 / 29.0) * (6.0 / 29.0) * (t - 4.0 / 29.0); };
  const double fy = (l + 16.0) / 116.0;
  const Eigen::Vector3d xyz(kWhiteX * inverse(fy + a / 500.0), inverse(fy),
                            kWhiteZ * inverse(fy - b / 200.0));
  const Eigen::Vector3d linear = rgbFromXyz() * xyz;
  std::array<float, 3> color{};
  for (int c = 0; c < 3; ++c)
  {
    const double x = std::clamp(linear[c], 0.0, 1.0);
    const double encoded = x <= 0.0031308 ? 12.92 * x : 1.055 * std::pow(x, 1.0 / 2.4) - 0.055;
    color[static_cast<std::size_t>(c)] = static_cast<float>(std::clamp(encoded, 0.0, 1.0));
  }
  return color;
}

std::array<std::uint16_t, 3> cieLabFromColor(const std::array<float, 3>& color)
{
  Eigen::Vector3d linear;
  for (int c = 0; c < 3; ++c)
  {
    const double x = std::clamp(static_cast<double>(color[static_cast<std::size_t>(c)]), 0.0, 1.0);
    linear[c] = x <= 0.04045 ? x / 12.92 : std::pow((x + 0.055) / 1.055, 2.4);
  }
  const Eigen::Vector3d xyz = rgbFromXyz().inverse() * linear;
  const auto cubeRoot = [](double t)
  {
    constexpr double kKnee = 6.0 / 29.0;
    return t > kKnee * kKnee * kKnee ? std::cbrt(t) : t / (3.0 * kKnee * kKnee) + 4.0 / 29.0;
  };
  const double fx = cubeRoot(xyz.x() / kWhiteX);
  const double fy = cubeRoot(xyz.y());
  const double fz = cubeRoot(xyz.z() / kWhiteZ);
  const auto scaled = [](double share)
  { return static_cast<std::uint16_t>(std::lround(std::clamp(share, 0.0, 1.0) * 65535.0)); };
  return {scaled((116.0 * fy - 16.0) / 100.0), scaled((500.0 * (fx - fy) + 128.0) / 255.0),
          scaled((200.0 * (fy - fz) + 128.0) / 255.0)};
}

LoadedLabels readSegmentation(const std::filesystem::path& path, const core::Progress& progress,
                              const std::vector<ImageGrid>& images, std::uint64_t memory)
{
  progress.report(0.0, "reading labels");
  ByteSource source(path);
  const DicomElements elements(source);
  Segmentation file;
  file.path = path;
  file.memory = memory;
  file.pixels = elements.pixels();
  const std::uint64_t end =
      file.pixels.tag != 0 ? file.pixels.offset - (elements.isExplicit() ? 12 : 8) : source.size();
  if (elements.state() != DicomElements::State::Complete || end < elements.dataStart())
    fail(Reason::Unreadable, path, "is cut short or damaged; copy or export it again");
  if (end - elements.dataStart() > kMaxHeader)
    fail(Reason::Unsupported, path,
         "describes its frames in more than 512 MB; export fewer of its segments at a time");
  requireMemory(path, end - elements.dataStart(), Layers::kFewer, memory);
  std::string head(static_cast<std::size_t>(end - elements.dataStart()), '\0');
  if (!source.read(elements.dataStart(), head.data(), head.size()))
    fail(Reason::Unreadable, path, "cannot be read to its end; copy it again");
  const DicomItem data(head, {elements.isExplicit(), elements.isBigEndian()});

  file.type = typeOf(path, data);
  file.rows = data.integer(0x00280010).value_or(0);
  file.columns = data.integer(0x00280011).value_or(0);
  file.bits = data.integer(0x00280100).value_or(0);
  file.padding = data.integer(0x00280120).value_or(0);
  file.maxFraction = std::max(data.integer(0x0062000e).value_or(255), 1);
  file.isOccupancy = file.type == Type::Fractional && data.text(0x00620010) == "OCCUPANCY";
  const DicomItem shared = data.item(0x52009229);
  const std::vector<DicomItem> own = data.items(0x52009230);
  const double stated = data.number(0x00280008).value_or(static_cast<double>(own.size()));
  if (own.empty() || stated != static_cast<double>(own.size()))
    fail(Reason::Unreadable, path,
         "describes another number of frames (" + std::to_string(own.size()) +
             ") than it states; export the segmentation again");
  file.frames.resize(own.size());
  checkPixels(file, source, elements);
  for (std::size_t n = 0; n < own.size(); ++n)
  {
    file.frames[n].number = n;
    readFrame(file, own[n], shared, file.frames[n]);
  }

  LoadedLabels loaded;
  loaded.frameOfReferenceUid = data.text(0x00200052);
  loaded.patient = patientOf(elements);
  const std::vector<DicomItem> segments = data.items(0x00620002);
  requireDeclared(file, segments);
  const core::GridGeometry grid = placeFrames(file, images, loaded.notes);
  const double frameVolume = thicknessOf(file, grid) * grid.spacing()[0] * grid.spacing()[1];
  if (file.type == Type::Fractional)
    loaded.notes.push_back(std::string("holds fractions (") +
                           (file.isOccupancy ? "occupancy" : "probability") +
                           "): voxels of 50 % and more were taken as the structure");
  const core::Progress painting = progress.part(0.1, 0.9);
  Layers layers = file.type == Type::Labelmap
                      ? copyLabelmap(file, source, grid, painting)
                      : paintSegments(file, source, grid, loaded.notes, painting);

  const std::string characters = data.text(0x00080005);
  std::vector<std::vector<volume::Segment>> names(layers.voxels.size());
  std::vector<char> isKnown(65536, 0);
  UniqueNames unique;
  for (const DicomItem& item : segments)
    unique.reserve(toUtf8(item.text(0x00620005), characters));
  for (const DicomItem& item : segments)
  {
    const auto number = item.integer(0x00620004);
    if (!number || isKnown[static_cast<std::size_t>(*number)])
      fail(Reason::Unreadable, path,
           "describes a segment without a number, or two of one number; export it again");
    isKnown[static_cast<std::size_t>(*number)] = 1;
    if (*number == 0)
      continue; // the background of a label map
    volume::Segment segment;
    segment.index = static_cast<std::uint16_t>(*number);
    segment.name = toUtf8(item.text(0x00620005), characters);
    // Its description may begin with the whole of a name that was cut.
    const std::string whole = toUtf8(item.text(0x00620006), characters);
    const auto characterCount =
        std::count_if(segment.name.begin(), segment.name.end(),
                      [](char c) { return (static_cast<unsigned char>(c) & 0xC0) != 0x80; });
    if (characterCount == kLongestName && whole.size() <= kLongestPartName &&
        whole.compare(0, segment.name.size(), segment.name) == 0)
      segment.name = whole;
    if (segment.name.empty())
      segment.name = "label " + std::to_string(*number);
    segment.name = unique.take(segment.name, loaded.notes);
    segment.color = colorFromCieLab(item.shorts(0x0062000d));
    loaded.meanings[segment.name] = meaningOf(item, characters);
    loaded.codes[segment.name] = codesOf(item, characters);
    if (const auto pixels = layers.pixels.find(*number); pixels != layers.pixels.end())
      loaded.fileVolumes[segment.name] = pixels->second * frameVolume;
    const auto layer = layers.layerOf.find(*number);
    names[layer == layers.layerOf.end() ? 0 : layer->second].push_back(std::move(segment));
  }
  for (std::size_t layer = 0; layer < layers.voxels.size(); ++layer)
    loaded.maps.push_back(
        volume::makeLabelMap(std::move(layers.voxels[layer]), std::move(names[layer])));
  progress.report(1.0, "reading labels");
  return loaded;
}

} // namespace petrous::imaging
