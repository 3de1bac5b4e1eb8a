#include <algorithm>
#include <functional>

#include <Eigen/Geometry>
#include <gdcmImage.h>
#include <gdcmImageChangeTransferSyntax.h>
#include <gdcmSequenceOfFragments.h>
#include <gtest/gtest.h>
#include <zlib.h>

#include "SegmentationReader.h"
#include "TestDicom.h"
#include "TestFiles.h"
#include "petrous/Imaging/DicomWriter.h"
#include "petrous/Imaging/LabelFile.h"

namespace petrous::imaging
{
namespace
{

using Reason = FileError::Reason;
using test::TestSlice;

constexpr const char* kDeflatedFile = "1.2.840.10008.1.2.1.99";
constexpr const char* kDeflatedFrames = "1.2.840.10008.1.2.8.1";

/// Raw DEFLATE, as DICOM has it.
std::string deflated(const std::string& bytes)
{
  z_stream stream = {};
  std::string out(compressBound(bytes.size()) + 64, '\0');
  EXPECT_EQ(deflateInit2(&stream, 9, Z_DEFLATED, -MAX_WBITS, 8, Z_DEFAULT_STRATEGY), Z_OK);
  std::string in = bytes;
  stream.next_in = reinterpret_cast<Bytef*>(in.data());
  stream.avail_in = static_cast<uInt>(in.size());
  stream.next_out = reinterpret_cast<Bytef*>(out.data());
  stream.avail_out = static_cast<uInt>(out.size());
  EXPECT_EQ(deflate(&stream, Z_FINISH), Z_STREAM_END);
  out.resize(out.size() - stream.avail_out);
  deflateEnd(&stream);
  return out;
}

/// A frame in RLE (PS3.5 annex G): a segment for each byte of a pixel, the most significant first.
std::string runLengths(const std::string& frame, int columns, int rows, int bits)
{
  const auto segments = static_cast<std::size_t>(bits / 8);
  std::string data;
  std::vector<std::uint32_t> head{static_cast<std::uint32_t>(segments)};
  for (std::size_t n = 0; n < segments; ++n)
  {
    head.push_back(static_cast<std::uint32_t>(64 + data.size()));
    for (int j = 0; j < rows; ++j)
      for (int i = 0; i < columns;)
      {
        const auto at = [&](int column) {
          return frame[static_cast<std::size_t>(j * columns + column) * segments + segments - 1 -
                       n];
        };
        int run = 1;
        while (i + run < columns && at(i + run) == at(i))
          ++run;
        data += static_cast<char>(run > 1 ? 1 - run : 0); // repeated, or one literal byte
        data += at(i);
        i += run;
      }
    data += std::string(data.size() % 2, '\x80'); // -128: nothing
  }
  head.resize(16);
  std::string out;
  for (const std::uint32_t value : head)
    TestSlice().append(out, value, 4);
  return out + data;
}

/// A frame as GDCM's encoders compress it.
std::string encoded(const std::string& frame, int columns, int rows, int bits,
                    gdcm::TransferSyntax::TSType syntax)
{
  gdcm::DataElement element(gdcm::Tag(0x7fe0, 0x0010));
  element.SetVR(bits == 8 ? gdcm::VR::OB : gdcm::VR::OW);
  element.SetByteValue(frame.data(), gdcm::VL(static_cast<std::uint32_t>(frame.size())));
  const gdcm::SmartPointer<gdcm::Image> image = new gdcm::Image;
  image->SetNumberOfDimensions(2);
  image->SetDimension(0, static_cast<unsigned>(columns));
  image->SetDimension(1, static_cast<unsigned>(rows));
  const auto width = static_cast<unsigned short>(bits);
  image->SetPixelFormat(
      gdcm::PixelFormat(1, width, width, static_cast<unsigned short>(width - 1), 0));
  image->SetPhotometricInterpretation(gdcm::PhotometricInterpretation::MONOCHROME2);
  image->SetTransferSyntax(gdcm::TransferSyntax::ExplicitVRLittleEndian);
  image->SetDataElement(element);
  gdcm::ImageChangeTransferSyntax change;
  change.SetTransferSyntax(syntax);
  change.SetInput(*image);
  EXPECT_TRUE(change.Change());
  const gdcm::SequenceOfFragments* fragments =
      change.GetOutput().GetDataElement().GetSequenceOfFragments();
  std::string out;
  for (std::size_t n = 0; fragments && n < fragments->GetNumberOfFragments(); ++n)
  {
    const gdcm::ByteValue* bytes = fragments->GetFragment(n).GetByteValue();
    out.append(bytes->GetPointer(), bytes->GetLength());
  }
  EXPECT_FALSE(out.empty());
  return out;
}

/// A segmentation written byte by byte according to PS3.5 and PS3.3 A.51, sharing no code with the
/// reader.
struct TestSegmentation
{
  struct Frame
  {
    int segment;
    double z;
    std::function<int(int i, int j)> value; ///< 0 or 1; or a fraction or label
  };

  std::string type = "BINARY";
  int columns = 5; // 15 pixels: frames begin within a byte
  int rows = 3;
  int bits = 1;
  double spacing = 2.0;    ///< 0: not declared
  double thickness = 0.0;  ///< 0: not stated
  bool sharesPlane = true; ///< orientation and spacing in the shared groups, else in each frame's
  std::string sharedOrientation; ///< beside that of each frame, without sharesPlane; empty: none
  bool undefinedLength = false;
  std::string orientation = "1\\0\\0\\0\\1\\0";
  std::string segments; ///< items
  std::vector<Frame> frames;
  std::string extra;
  TestSlice code; ///< how elements are encoded
  std::string syntax;
  const char* pixelVr = "OB";
  /// Makes the item of a frame from its bytes; empty: not encapsulated.
  std::function<std::string(const std::string&)> compress;

  std::string element(std::uint32_t tag, const char* vr, const std::string& value) const
  {
    std::string out;
    code.element(out, tag, vr, value);
    return out;
  }
  std::string number(std::uint32_t tag, int value) const
  {
    std::string out;
    code.number(out, tag, static_cast<std::uint32_t>(value));
    return out;
  }
  std::string delimiter(std::uint32_t element) const
  {
    std::string out;
    code.append(out, 0xfffe, 2);
    code.append(out, element, 2);
    code.append(out, 0, 4);
    return out;
  }
  std::string item(const std::string& content) const
  {
    std::string out;
    code.append(out, 0xfffe, 2);
    code.append(out, 0xe000, 2);
    code.append(out, undefinedLength ? 0xffffffffU : static_cast<std::uint32_t>(content.size()), 4);
    out += content;
    if (undefinedLength)
      out += delimiter(0xe00d);
    return out;
  }
  std::string sequence(std::uint32_t tag, const std::string& items) const
  {
    std::string out = element(tag, "SQ", items + std::string(items.size() % 2, ' '));
    if (undefinedLength)
    {
      const std::size_t at = code.implicitVr ? 4 : 8;
      out.replace(at, 4, "\xff\xff\xff\xff");
      out += delimiter(0xe0dd);
    }
    return out;
  }

  void addSegment(int index, const std::string& name, const std::string& more = "")
  {
    segments += item(number(0x00620004, index) + element(0x00620005, "LO", name) + more);
  }

  std::string bytes() const
  {
    TestSlice meta;
    std::string out;
    meta.element(out, 0x00020010, "UI",
                 !syntax.empty()   ? syntax
                 : code.bigEndian  ? "1.2.840.10008.1.2.2"
                 : code.implicitVr ? "1.2.840.10008.1.2"
                                   : "1.2.840.10008.1.2.1");
    const std::string head = std::string(128, '\0') + "DICM" + out;
    out.clear();
    out += element(0x00080005, "CS", "ISO_IR 100");
    out += element(0x00080016, "UI",
                   type == "LABELMAP" ? "1.2.840.10008.5.1.4.1.1.66.7"
                                      : "1.2.840.10008.5.1.4.1.1.66.4");
    out += element(0x00200052, "UI", "1.2.3.9");
    out += element(0x00280008, "IS", std::to_string(frames.size()));
    out += number(0x00280010, rows) + number(0x00280011, columns) + number(0x00280100, bits);
    out += extra;
    out += element(0x00620001, "CS", type);
    out += sequence(0x00620002, segments);
    const std::string plane =
        sequence(0x00209116, item(element(0x00200037, "DS", orientation))) +
        sequence(
            0x00289110,
            item((thickness > 0.0 ? element(0x00180050, "DS", core::fixedText(thickness, 3)) : "") +
                 (spacing > 0.0 ? element(0x00180088, "DS", core::fixedText(spacing, 3)) : "") +
                 element(0x00280030, "DS", "0.5\\0.4")));
    const std::string beside =
        sharedOrientation.empty()
            ? std::string()
            : sequence(0x00209116, item(element(0x00200037, "DS", sharedOrientation)));
    out += sequence(0x52009229, item(sharesPlane ? plane : beside));
    std::string groups;
    for (const Frame& frame : frames)
      groups += item(
          sequence(0x00209113,
                   item(element(0x00200032, "DS", "-10\\20.5\\" + core::fixedText(frame.z, 4)))) +
          (sharesPlane ? "" : plane) +
          (type == "LABELMAP" ? ""
                              : sequence(0x0062000a, item(number(0x0062000b, frame.segment)))));
    out += sequence(0x52009230, groups);
    std::string pixels;
    std::string items = item("");
    std::size_t bit = 0;
    for (const Frame& frame : frames)
    {
      for (int j = 0; j < rows; ++j)
        for (int i = 0; i < columns; ++i)
        {
          const int value = frame.value(i, j);
          if (bits == 1)
          {
            pixels.resize(bit / 8 + 1, '\0');
            pixels[bit / 8] = static_cast<char>(pixels[bit / 8] | (value << bit % 8));
            ++bit;
          }
          else
            for (int b = 0; b < bits; b += 8)
              pixels += static_cast<char>(value >> b);
        }
      if (compress)
      {
        const std::string packed = compress(pixels);
        items += item(packed + std::string(packed.size() % 2, '\0'));
        pixels.clear();
        bit = 0;
      }
    }
    pixels += std::string(pixels.size() % 2, '\0');
    if (code.bigEndian && std::string(pixelVr) == "OW")
      for (std::size_t at = 0; at < pixels.size(); at += 2)
        std::swap(pixels[at], pixels[at + 1]);
    if (!compress)
      out += element(0x7fe00010, pixelVr, pixels);
    else
      out += std::string("\xe0\x7f\x10\0OB\0\0\xff\xff\xff\xff", 12) + items + delimiter(0xe0dd);
    return head + (syntax == kDeflatedFile ? deflated(out) : out);
  }
};

int left(int i, int)
{
  return i < 2;
}
int right(int i, int)
{
  return i >= 3;
}
int most(int i, int)
{
  return i >= 1;
}
int none(int, int)
{
  return 0;
}

TestSegmentation twoSegments(const TestSlice& code = {})
{
  TestSegmentation file;
  file.code = code;
  file.addSegment(1, "chorda");
  file.addSegment(7, "stapes");
  // out of order, one slice left out, and a frame without a voxel
  file.frames = {{7, 6.0, right}, {1, 0.0, left}, {7, 0.0, none}, {1, 4.0, left}};
  return file;
}

TEST(DicomSegmentation, RefusesWhatDoesNotFitTheMemory)
{
  const TestFolder folder;
  for (const bool overlap : {false, true}) // two layers
    for (const bool isLabelmap : {false, true})
    {
      if (overlap && isLabelmap)
        continue;
      TestSegmentation file;
      if (isLabelmap)
      {
        file.type = "LABELMAP";
        file.bits = 8;
      }
      file.addSegment(1, "chorda");
      file.addSegment(2, "stapes");
      file.frames = {{1, 0.0, left}, {2, 9e4, overlap ? left : right}};
      if (overlap)
        file.frames.push_back({2, 0.0, left});
      test::writeText(folder.path() / "seg.dcm", file.bytes());
      const std::uint64_t bytes = std::uint64_t{2} * 15 * 45001 * (overlap ? 2 : 1);
      EXPECT_EQ(loadLabels(folder.path() / "seg.dcm", {}, {}, {}, std::nullopt, bytes).maps.size(),
                overlap ? 2U : 1U);
      try
      {
        loadLabels(folder.path() / "seg.dcm", {}, {}, {}, std::nullopt, bytes - 1);
        ADD_FAILURE() << "read";
      }
      catch (const FileError& error)
      {
        EXPECT_NE(std::string(error.what()).find("GB of memory"), std::string::npos)
            << error.what();
        EXPECT_NE(std::string(error.what()).find("seg.dcm"), std::string::npos);
      }
    }
}

TEST(DicomSegmentation, APlaceThatIsStatedTwiceAndDiffersIsRefused)
{
  const TestFolder folder;
  TestSegmentation file;
  file.sharesPlane = false;
  file.addSegment(1, "chorda");
  for (const double z : {0.0, 2.0})
    file.frames.push_back({1, z, [](int i, int) { return i % 2; }});
  file.sharedOrientation = "1.0\\0\\0\\0\\1\\0";
  EXPECT_EQ(loadLabels(putFile(folder / "a.dcm", file.bytes())).maps.size(), 1U);
  file.sharedOrientation = "-1\\0\\0\\0\\1\\0";
  expectRefused(refusalOf([&] { loadLabels(putFile(folder / "b.dcm", file.bytes())); }),
                Reason::NoGeometry, "states its place twice");
}

TEST(DicomSegmentation, PlacesFramesByPositionAndLeavesGapsEmpty)
{
  const TestFolder folder;
  for (const bool implicitVr : {false, true})
    for (const bool undefinedLength : {false, true})
      for (const bool sharesPlane : {false, true})
      {
        TestSegmentation file;
        file.code.implicitVr = implicitVr;
        file.undefinedLength = undefinedLength;
        file.sharesPlane = sharesPlane;
        file.addSegment(1, "chorda");
        file.addSegment(7, "stapes");
        file.frames = twoSegments().frames;
        // whatever its name
        const auto loaded = loadLabels(putFile(folder / "a.seg", file.bytes()));
        ASSERT_EQ(loaded.maps.size(), 1u);
        EXPECT_EQ(loaded.frameOfReferenceUid, "1.2.3.9");
        const volume::LabelMap& map = loaded.maps[0];
        const core::GridGeometry& grid = map.voxels->geometry();
        EXPECT_EQ(grid.dims(), (core::Index3{5, 3, 4}));
        EXPECT_TRUE(grid.spacing().isApprox(Eigen::Vector3d(0.4, 0.5, 2.0)));
        EXPECT_TRUE(grid.origin().isApprox(Eigen::Vector3d(-10.0, 20.5, 0.0)));
        ASSERT_EQ(map.segments.size(), 2u);
        EXPECT_EQ(map.segments[0].name, "chorda");
        EXPECT_EQ(map.segments[0].voxels, 12u);
        EXPECT_EQ(map.segments[1].name, "stapes");
        EXPECT_EQ(map.segments[1].index, 7);
        EXPECT_EQ(map.segments[1].voxels, 6u);
        for (int k = 0; k < 4; ++k)
          for (int j = 0; j < 3; ++j)
            for (int i = 0; i < 5; ++i)
              EXPECT_EQ(map.voxels->at(i, j, k), (k == 0 || k == 2) && i < 2 ? 1
                                                 : k == 3 && i >= 3          ? 7
                                                                             : 0);
      }
}

/// Frames of 6 voxels of 0.4 x 0.5 mm each, 1 mm thick, without a declared spacing.
TestSegmentation sparse(const std::vector<double>& places)
{
  TestSegmentation file;
  file.addSegment(1, "chorda");
  file.spacing = 0.0;
  file.thickness = 1.0;
  for (const double z : places)
    file.frames.push_back({1, z, left});
  return file;
}

TEST(DicomSegmentation, FramesFarApartAreAsThickAsTheySay)
{
  const TestFolder folder;
  const double frame = 6 * 0.4 * 0.5; // mm^2
  for (const std::vector<double>& places :
       {std::vector<double>{20.0, 30.0}, std::vector<double>{5.0, 8.0, 11.0, 14.0}})
  {
    const auto loaded = loadLabels(putFile(folder / "a.dcm", sparse(places).bytes()));
    const volume::LabelMap& map = loaded.maps.at(0);
    const auto count = static_cast<double>(places.size());
    EXPECT_NEAR(map.volume(map.segments.at(0)), count * frame, 1e-9);
    EXPECT_NEAR(loaded.fileVolumes.at("chorda"), count * frame, 1e-9);
    EXPECT_NEAR(map.voxels->geometry().spacing()[2], 1.0, 1e-9);
    ASSERT_EQ(loaded.notes.size(), 1u);
    EXPECT_NE(loaded.notes[0].find("taken to be empty"), std::string::npos) << loaded.notes[0];
  }
}

TEST(DicomSegmentation, AnImageSaysHowFarApartItsSlicesAre)
{
  const TestFolder folder;
  TestSegmentation file = sparse({20.0, 30.0, 32.5});
  file.thickness = 0.0;
  const std::string path = putFile(folder / "a.dcm", file.bytes());
  // the other two do not have all frames on their slices, or not these pixels
  const core::GridGeometry turned({20, 60, 20}, {0.4, 2.5, 0.5}, {-10.0, 0.0, 20.5});
  const core::GridGeometry coarse({20, 20, 20}, {0.4, 0.5, 5.0}, {-10.0, 20.5, 0.0});
  const core::GridGeometry image({20, 20, 60}, {0.4, 0.5, 2.5}, {-10.0, 20.5, 5.0});
  const auto loaded = loadLabels(path, {}, {}, {turned, coarse, image});
  const core::GridGeometry& grid = loaded.maps.at(0).voxels->geometry();
  EXPECT_NEAR(grid.spacing()[2], 2.5, 1e-9);
  EXPECT_EQ(grid.dims()[2], 6);
  EXPECT_TRUE(loaded.notes.empty());
  EXPECT_NEAR(loaded.fileVolumes.at("chorda"), 3 * 6 * 0.4 * 0.5 * 2.5, 1e-9);

  // without an image the smallest gap is all that there is
  const auto guessed = loadLabels(path);
  EXPECT_NEAR(guessed.maps.at(0).voxels->geometry().spacing()[2], 2.5, 1e-9);
  ASSERT_EQ(guessed.notes.size(), 1u);
  EXPECT_NE(guessed.notes[0].find("2.5 mm apart"), std::string::npos) << guessed.notes[0];
}

// One slice is put on the image's slices; where it says that it is thicker, that is told.
TEST(DicomSegmentation, AnImageSaysHowThickOneSliceIs)
{
  const TestFolder folder;
  TestSegmentation file = sparse({20.0});
  file.thickness = 3.0;
  const std::string path = putFile(folder / "a.dcm", file.bytes());
  const core::GridGeometry image({20, 20, 60}, {0.4, 0.5, 0.6}, {-10.0, 20.5, 20.0 - 18 * 0.6});
  const auto loaded = loadLabels(path, {}, {}, {image});
  EXPECT_NEAR(loaded.maps.at(0).voxels->geometry().spacing()[2], 0.6, 1e-9);
  EXPECT_NEAR(loaded.fileVolumes.at("chorda"), 6 * 0.4 * 0.5 * 3.0, 1e-9) << "as the file says";
  ASSERT_EQ(loaded.notes.size(), 1u);
  EXPECT_NE(loaded.notes[0].find("3 mm thick"), std::string::npos) << loaded.notes[0];
  EXPECT_NE(loaded.notes[0].find("0.6 mm apart"), std::string::npos) << loaded.notes[0];
  file.thickness = 0.6;
  EXPECT_TRUE(loadLabels(putFile(folder / "b.dcm", file.bytes()), {}, {}, {image}).notes.empty());
  const auto alone = loadLabels(path);
  EXPECT_NEAR(alone.maps.at(0).voxels->geometry().spacing()[2], 3.0, 1e-9);
  ASSERT_EQ(alone.notes.size(), 1u);
  EXPECT_NE(alone.notes[0].find("mm thick"), std::string::npos) << alone.notes[0];
}

// Drawn on a reconstruction of 2 mm, and seen on the one of 0.5 mm.
TEST(DicomSegmentation, FramesThatAreAsThickAsTheyAreApartFillTheImagesSlicesBetween)
{
  const TestFolder folder;
  const core::GridGeometry image({20, 20, 60}, {0.4, 0.5, 0.5}, {-10.0, 20.5, 15.0});
  const double frame = 6 * 0.4 * 0.5; // mm^2
  for (const double thickness : {2.0, 1.5, 0.5})
  {
    SCOPED_TRACE(thickness);
    TestSegmentation file = sparse({20.0, 22.0, 24.0, 30.0});
    file.thickness = thickness;
    const auto loaded = loadLabels(putFile(folder / "a.dcm", file.bytes()), {}, {}, {image});
    const volume::LabelMap& map = loaded.maps.at(0);
    EXPECT_NEAR(loaded.fileVolumes.at("chorda"), 4 * frame * thickness, 1e-9);
    const bool isTiled = thickness == 2.0;
    EXPECT_NEAR(map.volume(map.segments.at(0)), 4 * frame * (isTiled ? 2.0 : 0.5), 1e-9);
    EXPECT_EQ(loaded.notes.empty(), thickness != 1.5);
    if (thickness == 1.5)
    {
      EXPECT_NE(loaded.notes.at(0).find("1.5 mm thick"), std::string::npos) << loaded.notes[0];
    }
    if (!isTiled)
      continue;
    const auto at = [&](double z)
    {
      const Eigen::Vector3d voxel = map.voxels->geometry().voxelFromPatient({-10.0, 20.5, z});
      return map.voxels->at(0, 0, static_cast<int>(std::lround(voxel[2])));
    };
    EXPECT_EQ(at(22.5), 1);
    EXPECT_EQ(at(27.0), 0) << "no frame is there";
  }
}

// Two frames of a segment at one place: equal ones count once, others contradict each other.
TEST(DicomSegmentation, FramesOfOnePlaceMustBeEqual)
{
  const TestFolder folder;
  const TestSegmentation once = sparse({20.0, 21.0, 22.0});
  TestSegmentation file = once;
  file.frames.push_back(file.frames[1]);
  const auto loaded = loadLabels(putFile(folder / "a.dcm", file.bytes()));
  const volume::LabelMap& map = loaded.maps.at(0);
  EXPECT_EQ(map.segments.at(0).voxels, 3u * 6u);
  EXPECT_NEAR(loaded.fileVolumes.at("chorda"), 3 * 6 * 0.4 * 0.5, 1e-9);
  const std::size_t before = loaded.notes.size();
  file.frames.back().value = [](int, int) { return 0; };
  const auto withEmpty = loadLabels(putFile(folder / "b.dcm", file.bytes()));
  EXPECT_EQ(withEmpty.maps.at(0).segments.at(0).voxels, 3u * 6u);
  ASSERT_EQ(withEmpty.notes.size(), before + 1);
  EXPECT_NE((withEmpty.notes.front() + withEmpty.notes.back()).find("the first is frame 4"),
            std::string::npos)
      << withEmpty.notes.back();
  file.frames.back().value = [value = once.frames[1].value](int i, int j)
  { return 1 - value(i, j); };
  expectRefused(refusalOf([&] { loadLabels(putFile(folder / "c.dcm", file.bytes())); }),
                Reason::NoGeometry, "frame 2");
}

// 60 % and 100 % are the same voxels, and not the same volume.
TEST(DicomSegmentation, FractionsOfOnePlaceMustBeEqual)
{
  const TestFolder folder;
  TestSegmentation file = sparse({20.0, 21.0});
  file.type = "FRACTIONAL";
  file.bits = 8;
  file.extra = file.number(0x0062000e, 100) + file.element(0x00620010, "CS", "OCCUPANCY");
  for (TestSegmentation::Frame& frame : file.frames)
    frame.value = [](int i, int) { return i < 2 ? 60 : 0; };
  file.frames.push_back(file.frames[1]);
  const auto loaded = loadLabels(putFile(folder / "a.dcm", file.bytes()));
  file.frames.pop_back();
  EXPECT_EQ(loaded.fileVolumes, loadLabels(putFile(folder / "b.dcm", file.bytes())).fileVolumes);
  file.frames.push_back({1, 21.0, [](int i, int) { return i < 2 ? 100 : 0; }});
  expectRefused(refusalOf([&] { loadLabels(putFile(folder / "c.dcm", file.bytes())); }),
                Reason::NoGeometry, "differs from it");
}

TEST(DicomSegmentation, EqualFramesOfALabelMapCountOnce)
{
  const TestFolder folder;
  TestSegmentation file = sparse({20.0, 21.0});
  file.type = "LABELMAP";
  file.bits = 8;
  file.frames.push_back(file.frames[1]);
  const auto loaded = loadLabels(putFile(folder / "a.dcm", file.bytes()));
  EXPECT_EQ(loaded.maps.at(0).segments.at(0).voxels, 2u * 6u);
  file.frames.back().value = [](int i, int) { return i == 4 ? 1 : 0; };
  expectRefused(refusalOf([&] { loadLabels(putFile(folder / "b.dcm", file.bytes())); }),
                Reason::NoGeometry, "differs from it");
}

TEST(DicomSegmentation, FramesAreOfSegmentsThatAreDescribed)
{
  const TestFolder folder;
  TestSegmentation file = sparse({20.0, 21.0, 22.0});
  file.frames[1].segment = 7;
  expectRefused(refusalOf([&] { loadLabels(putFile(folder / "a.dcm", file.bytes())); }),
                Reason::NoGeometry, "segment 7");
}

TEST(DicomSegmentation, OverlappingSlicesAreAsThickAsTheyAreApart)
{
  const TestFolder folder;
  TestSegmentation file = sparse({20.0, 21.0, 22.0});
  file.thickness = 2.0;
  const auto loaded = loadLabels(putFile(folder / "a.dcm", file.bytes()));
  EXPECT_NEAR(loaded.maps.at(0).voxels->geometry().spacing()[2], 1.0, 1e-9);
  EXPECT_NEAR(loaded.fileVolumes.at("chorda"), 3 * 6 * 0.4 * 0.5, 1e-9);
  EXPECT_TRUE(loaded.notes.empty());
}

TEST(DicomSegmentation, KeepsOverlappingSegmentsInLayers)
{
  const TestFolder folder;
  TestSegmentation file = twoSegments();
  file.addSegment(9, "bone");
  file.frames.push_back({9, 0.0, right}); // first without overlap, then with
  file.frames.push_back({9, 4.0, most});
  const auto path = putFile(folder / "a.dcm", file.bytes());
  const auto maps = loadLabels(path).maps;
  ASSERT_EQ(maps.size(), 2u);
  ASSERT_EQ(maps[0].segments.size(), 2u);
  EXPECT_EQ(maps[0].segments[0].voxels, 12u);
  EXPECT_EQ(maps[0].segments[1].voxels, 6u);
  ASSERT_EQ(maps[1].segments.size(), 1u);
  EXPECT_EQ(maps[1].segments[0].name, "bone");
  EXPECT_EQ(maps[1].segments[0].voxels, 18u);
  expectRefused(refusalOf([&] { readLabelFile(path); }), Reason::Unsupported, "overlap");
}

TEST(DicomSegmentation, KeepsCodesAndAlgorithm)
{
  const TestFolder folder;
  TestSegmentation file;
  const auto code = [&file](const char* tagOfValue, const std::string& value,
                            const std::string& scheme, const std::string& meaning,
                            const std::string& more = "")
  {
    const bool isLong = std::string(tagOfValue) == "long";
    return file.item((isLong ? "" : file.element(0x00080100, "SH", value)) +
                     file.element(0x00080102, "SH", scheme) +
                     file.element(0x00080104, "LO", meaning) +
                     (isLong ? file.element(0x00080119, "UC", value) : "") + more);
  };
  const std::string isLeft = file.sequence(0x00620011, code("short", "7771000", "SCT", "Left"));
  const std::string isRight = file.sequence(0x00082220, code("short", "24028007", "SCT", "Right"));
  file.addSegment(
      1, "a",
      file.sequence(0x00082218, code("short", "60911003", "SCT", "Temporal bone", isRight)) +
          file.sequence(0x00620003, code("short", "123037004", "SCT", "Anatomical Structure")) +
          file.element(0x00620008, "CS", "AUTOMATIC") +
          file.element(0x00620009, "LO", "a network") +
          file.sequence(0x0062000f,
                        code("long", "12345678901234567890", "99X", "N. facialis", isLeft)));
  file.addSegment(2, "b", file.element(0x00620008, "CS", "MANUAL"));
  file.frames = {{1, 0.0, left}, {2, 0.0, right}};
  const LoadedLabels loaded = loadLabels(putFile(folder / "a.dcm", file.bytes()));
  const volume::SegmentCodes& codes = loaded.codes.at("a");
  using volume::CodedConcept;
  EXPECT_EQ(codes.category, (CodedConcept{"123037004", "SCT", "Anatomical Structure"}));
  EXPECT_EQ(codes.type, (CodedConcept{"12345678901234567890", "99X", "N. facialis"}));
  EXPECT_EQ(codes.typeModifier, (CodedConcept{"7771000", "SCT", "Left"}));
  EXPECT_EQ(codes.region, (CodedConcept{"60911003", "SCT", "Temporal bone"}));
  EXPECT_EQ(codes.regionModifier, (CodedConcept{"24028007", "SCT", "Right"}));
  EXPECT_EQ(codes.algorithm, volume::SegmentCodes::Algorithm::Automatic);
  EXPECT_EQ(codes.algorithmName, "a network");
  EXPECT_EQ(loaded.codes.at("b").algorithm, volume::SegmentCodes::Algorithm::Manual);

  // Written and read again.
  SegmentationDescription description;
  description.studyUid = "1.2.3";
  description.seriesUid = "1.2.3.4";
  description.frameOfReferenceUid = "1.2.3.9";
  SegmentationDescription::Segment segment;
  segment.index = 1;
  segment.label = "a";
  segment.category = codes.category;
  segment.type = codes.type;
  segment.typeModifier = codes.typeModifier;
  segment.region = codes.region;
  segment.regionModifier = codes.regionModifier;
  segment.algorithm = SegmentationDescription::Algorithm::Automatic;
  segment.algorithmName = codes.algorithmName;
  description.segments = {segment};
  writeDicomSegmentation(folder / "b.dcm", loaded.maps, description);
  EXPECT_EQ(loadLabels(folder / "b.dcm").codes.at("a"), codes);
}

TEST(DicomSegmentation, SegmentsOfOneNameAreNumbered)
{
  const TestFolder folder;
  TestSegmentation file = twoSegments();
  file.addSegment(9, "chorda");
  file.frames.push_back({9, 4.0, most}); // in a layer of its own
  const LoadedLabels loaded = loadLabels(putFile(folder / "a.dcm", file.bytes()));
  ASSERT_EQ(loaded.maps.size(), 2u);
  EXPECT_EQ(loaded.maps[1].segments[0].name, "chorda 2");
  EXPECT_DOUBLE_EQ(loaded.fileVolumes.at("chorda"), 12 * 0.4);
  EXPECT_DOUBLE_EQ(loaded.fileVolumes.at("chorda 2"), 12 * 0.4);
  ASSERT_EQ(loaded.notes.size(), 1u);
  EXPECT_NE(loaded.notes[0].find("'chorda 2'"), std::string::npos);
}

TEST(DicomSegmentation, TakesHalfOfTheLargestFraction)
{
  const TestFolder folder;
  TestSegmentation file;
  file.type = "FRACTIONAL";
  file.bits = 8;
  file.extra = file.number(0x0062000e, 100);
  file.addSegment(1, "dura");
  file.frames = {{1, 0.0, [](int i, int j) { return i == 0 ? 49 : i == 1 ? 50 : j * 30; }}};
  const auto loaded = loadLabels(putFile(folder / "a.dcm", file.bytes()));
  EXPECT_EQ(loaded.maps.at(0).segments.at(0).voxels, 3u + 3u);
  ASSERT_EQ(loaded.notes.size(), 1u);
  EXPECT_NE(loaded.notes[0].find("50 %"), std::string::npos);
}

TEST(DicomSegmentation, ReadsLabelMapsWithTheirPadding)
{
  const TestFolder folder;
  for (const int bits : {8, 16})
  {
    TestSegmentation file;
    file.type = "LABELMAP";
    file.bits = bits;
    file.extra = file.number(0x00280120, 5);
    file.addSegment(0, "Background");
    const int label = bits == 8 ? 200 : 3000;
    file.addSegment(label, "cochlea");
    file.frames = {{0, 2.0, [label](int i, int) { return i == 4 ? label : 5; }},
                   {0, 0.0, [label](int i, int) { return i < 2 ? label : 0; }}};
    const auto map = readLabelFile(putFile(folder / "a.dcm", file.bytes()));
    ASSERT_EQ(map.segments.size(), 1u);
    EXPECT_EQ(map.segments[0].name, "cochlea");
    EXPECT_EQ(map.segments[0].voxels, 9u);
    EXPECT_EQ(map.voxels->at(0, 0, 0), label);
    EXPECT_EQ(map.voxels->at(4, 2, 1), label);
  }
}

TEST(DicomSegmentation, ReadsColorMeaningAndLatinName)
{
  const TestFolder folder;
  TestSegmentation file;
  std::string lab;
  for (const unsigned value :
       {35579U, 53665U, 50858U}) // sRGB red is (54.29, 80.81, 69.89) relative to D50
    file.code.append(lab, value, 2);
  file.addSegment(
      1, "N\xe9ural",
      file.element(0x0062000d, "US", lab) +
          file.sequence(0x0062000f, file.item(file.element(0x00080104, "LO", "Facial nerve"))));
  file.frames = {{1, 0.0, left}};
  const auto loaded = loadLabels(putFile(folder / "a.dcm", file.bytes()));
  const volume::Segment& segment = loaded.maps.at(0).segments.at(0);
  EXPECT_EQ(segment.name, "N\xc3\xa9ural");
  EXPECT_EQ(loaded.meanings.at(segment.name), "Facial nerve");
  EXPECT_NEAR(segment.color[0], 1.0, 0.01);
  EXPECT_NEAR(segment.color[1], 0.0, 0.02);
  EXPECT_NEAR(segment.color[2], 0.0, 0.02);
}

TEST(DicomSegmentation, NamesAreUtf8WhateverTheFileSays)
{
  const TestFolder folder;
  TestSegmentation file;
  file.addSegment(1, "N\xe9ural"); // Latin-1
  file.frames = {{1, 0.0, left}};
  std::string bytes = file.bytes();
  const std::size_t at = bytes.find("ISO_IR 100");
  ASSERT_NE(at, std::string::npos);
  bytes.replace(at, 10, "ISO_IR 192");
  const auto loaded = loadLabels(putFile(folder / "a.dcm", bytes));
  EXPECT_EQ(loaded.maps.at(0).segments.at(0).name, "N?ural");
}

// CIE L*a*b* relative to D50: white is (100, 0, 0), and greys keep equal channels; L* = 50 is
// Y = 0.18419, in sRGB 0.46633.
TEST(DicomSegmentation, TurnsCieLabIntoSrgb)
{
  const int zero = 32896; // of a* and b*
  const auto expectGrey = [&](int l, double grey)
  {
    for (const float channel : colorFromCieLab({l, zero, zero}))
      EXPECT_NEAR(channel, grey, 1e-3);
  };
  expectGrey(65535, 1.0);
  expectGrey(32768, 0.46633);
  expectGrey(0, 0.0);
}

TEST(DicomSegmentation, ToleratesRoundedPositionsAndRefusesUnevenOnes)
{
  const TestFolder folder;
  TestSegmentation file;
  file.spacing = 0.0;
  file.addSegment(1, "dura");
  for (int k = 0; k < 300; ++k) // a third of a millimetre, to two decimals
    file.frames.push_back({1, std::round(k * 100.0 / 3.0) / 100.0, left});
  const auto loaded = loadLabels(putFile(folder / "a.dcm", file.bytes()));
  EXPECT_EQ(loaded.maps.at(0).voxels->geometry().dims()[2], 300);
  EXPECT_NEAR(loaded.maps[0].voxels->geometry().spacing()[2], 1.0 / 3.0, 1e-4);
  EXPECT_EQ(loaded.notes.size(), 2u); // the rounding, and that nothing states the spacing

  file.frames = {{1, 0.0, left}, {1, 1.0, left}, {1, 2.4, left}}; // of 1.2 mm each
  expectRefused(refusalOf([&] { loadLabels(putFile(folder / "b.dcm", file.bytes())); }),
                Reason::NoGeometry, "0.2 mm off");
}

TEST(DicomSegmentation, RefusesWhatCannotBeTrue)
{
  const TestFolder folder;
  const auto refused = [&](const TestSegmentation& file, Reason reason, const std::string& word)
  {
    expectRefused(refusalOf([&] { loadLabels(putFile(folder / "a.dcm", file.bytes())); }), reason,
                  word);
  };
  TestSegmentation far = twoSegments();
  far.frames[0].z = 1e12; // voxels beyond all memory
  refused(far, Reason::Unsupported, "more voxels");
  const TestSegmentation fewer;
  std::string bytes = twoSegments().bytes();
  const std::string small = fewer.number(0x00280010, 3) + fewer.number(0x00280011, 5);
  const std::size_t at = bytes.find(small);
  ASSERT_NE(at, std::string::npos);
  bytes.replace(at, small.size(),
                fewer.number(0x00280010, 65535) + fewer.number(0x00280011, 65535));
  expectRefused(refusalOf([&] { loadLabels(putFile(folder / "b.dcm", bytes)); }),
                Reason::Unreadable, "fewer pixels");
  TestSegmentation nameless = twoSegments();
  nameless.frames[2].segment = 0;
  refused(nameless, Reason::Unreadable, "names no segment");
  TestSegmentation twice = twoSegments();
  twice.addSegment(7, "again");
  refused(twice, Reason::Unreadable, "two of one number");
  TestSegmentation strange = twoSegments();
  strange.type = "SURFACE";
  refused(strange, Reason::Unsupported, "BINARY");
}

void expectEqualMaps(const LoadedLabels& a, const LoadedLabels& b, const std::string& which)
{
  ASSERT_EQ(a.maps.size(), b.maps.size()) << which;
  for (std::size_t m = 0; m < a.maps.size(); ++m)
  {
    ASSERT_TRUE(core::sameGrid(a.maps[m].voxels->geometry(), b.maps[m].voxels->geometry()))
        << which;
    EXPECT_TRUE(std::equal(a.maps[m].voxels->data(),
                           a.maps[m].voxels->data() + a.maps[m].voxels->size(),
                           b.maps[m].voxels->data()))
        << which;
    ASSERT_EQ(a.maps[m].segments.size(), b.maps[m].segments.size()) << which;
    for (std::size_t n = 0; n < a.maps[m].segments.size(); ++n)
      EXPECT_EQ(a.maps[m].segments[n].name, b.maps[m].segments[n].name) << which;
  }
  EXPECT_EQ(a.fileVolumes, b.fileVolumes) << which;
}

/// One file of each type, with frames of an odd number of pixels.
std::vector<TestSegmentation> oneOfEachType(const TestSlice& code = {})
{
  std::vector<TestSegmentation> files{twoSegments(code)};
  TestSegmentation fractional = twoSegments(code);
  fractional.type = "FRACTIONAL";
  fractional.bits = 8;
  fractional.extra = fractional.number(0x0062000e, 200);
  for (auto& frame : fractional.frames)
    frame.value = [of = frame.segment](int i, int j) { return (61 * i + 40 * j * of) % 201; };
  files.push_back(fractional);
  for (const int bits : {8, 16})
  {
    TestSegmentation labels;
    labels.code = code;
    labels.type = "LABELMAP";
    labels.bits = bits;
    const int label = bits == 8 ? 200 : 3000;
    labels.addSegment(label, "cochlea");
    labels.addSegment(3, "stapes");
    labels.frames = {{0, 0.0, [label](int i, int j) { return i == j  ? label
                                                             : i > 2 ? 3
                                                                     : 0; }},
                     {0, 2.0, [label](int i, int j) { return i > j ? label : 0; }},
                     {0, 6.0, none}};
    files.push_back(labels);
  }
  for (TestSegmentation& file : files) // GDCM's encoder of JPEG 2000 overruns on smaller images
  {
    file.columns = 41;
    file.rows = 31;
  }
  return files;
}

TEST(DicomSegmentation, EqualsItsTwinInAnyLosslessTransferSyntax)
{
  const TestFolder folder;
  TestSlice bigEndian;
  bigEndian.bigEndian = true;
  const auto files = oneOfEachType();
  const auto bigFiles = oneOfEachType(bigEndian);
  for (std::size_t n = 0; n < files.size(); ++n)
  {
    const TestSegmentation& plain = files[n];
    const std::string type = plain.type + " " + std::to_string(plain.bits) + " ";
    const auto truth = loadLabels(putFile(folder / "plain.dcm", plain.bytes()));
    const auto expectTwin = [&](const TestSegmentation& file, const std::string& which) {
      expectEqualMaps(loadLabels(putFile(folder / "twin.dcm", file.bytes())), truth, type + which);
    };
    for (const bool undefinedLength : {false, true})
      for (const char* vr : {"OB", "OW"})
        if (plain.bits < 16 || std::string(vr) == "OW")
        {
          TestSegmentation file = bigFiles[n];
          file.undefinedLength = undefinedLength;
          file.pixelVr = vr;
          expectTwin(file, "big endian " + std::string(vr));
        }
    TestSegmentation file = plain;
    file.syntax = kDeflatedFile;
    expectTwin(file, "deflated");
    file.syntax = kDeflatedFrames;
    file.compress = deflated;
    expectTwin(file, "deflated frames");
    const std::pair<const char*, gdcm::TransferSyntax::TSType> codecs[] = {
        {"1.2.840.10008.1.2.5", gdcm::TransferSyntax::RLELossless},
        {"1.2.840.10008.1.2.4.70", gdcm::TransferSyntax::JPEGLosslessProcess14_1},
        {"1.2.840.10008.1.2.4.80", gdcm::TransferSyntax::JPEGLSLossless},
        {"1.2.840.10008.1.2.4.90", gdcm::TransferSyntax::JPEG2000Lossless}};
    for (const auto& [uid, codec] : codecs)
    {
      file.syntax = uid;
      if (plain.bits == 1)
      {
        file.compress = [](const std::string& frame) { return frame; };
        expectRefused(refusalOf([&] { loadLabels(putFile(folder / "a.dcm", file.bytes())); }),
                      Reason::Unsupported, "uncompressed");
        continue;
      }
      file.compress = [&, by = codec](const std::string& frame)
      {
        return by == gdcm::TransferSyntax::RLELossless
                   ? runLengths(frame, file.columns, file.rows, file.bits)
                   : encoded(frame, file.columns, file.rows, file.bits, by);
      };
      expectTwin(file, uid);
    }
  }
}

TEST(DicomSegmentation, RefusesDamagedCompressedFrames)
{
  const TestFolder folder;
  for (TestSegmentation file : oneOfEachType())
  {
    file.extra += file.element(0x00100010, "PN", "SECRET^NAME");
    file.compress = [](const std::string& frame) { return "SECRET^NAME" + frame; };
    for (const char* syntax : {kDeflatedFrames, "1.2.840.10008.1.2.5", "1.2.840.10008.1.2.4.70",
                               "1.2.840.10008.1.2.4.80", "1.2.840.10008.1.2.4.90"})
    {
      file.syntax = syntax;
      const auto refusal = refusalOf([&] { loadLabels(putFile(folder / "a.dcm", file.bytes())); });
      EXPECT_NE(refusal.text, "") << syntax;
      EXPECT_EQ(refusal.text.find("SECRET"), std::string::npos) << syntax;
    }
    file.syntax = "1.2.840.10008.1.2.4.50"; // JPEG with loss
    expectRefused(refusalOf([&] { loadLabels(putFile(folder / "a.dcm", file.bytes())); }),
                  Reason::Unsupported, "lossless");
    file.syntax = kDeflatedFrames;
    file.compress = deflated;
    const std::string whole = file.bytes();
    for (std::size_t hundredths = 0; hundredths < 100; ++hundredths)
    {
      const auto path = putFile(folder / "a.dcm", whole.substr(0, whole.size() * hundredths / 100));
      EXPECT_THROW(loadLabels(path), FileError) << hundredths;
    }
  }
}

TEST(DicomSegmentation, SurvivesEveryTruncation)
{
  const TestFolder folder;
  const std::string whole = twoSegments().bytes();
  for (std::size_t size = 0; size < whole.size(); ++size)
  {
    const auto path = putFile(folder / "a.dcm", whole.substr(0, size));
    EXPECT_THROW(loadLabels(path), FileError) << size;
  }
}

/// Two overlapping layers on an oblique grid whose slices are no whole number of bytes.
std::vector<volume::LabelMap> overlappingMaps()
{
  const Eigen::Matrix3d turn =
      (Eigen::AngleAxisd(0.4, Eigen::Vector3d(1.0, 2.0, -0.5).normalized())).toRotationMatrix();
  const core::GridGeometry grid({7, 5, 6}, {0.31, 0.4, 1.25}, {-20.0, 31.5, 7.75}, turn);
  std::vector<volume::LabelMap> maps;
  for (int map = 0; map < 2; ++map)
  {
    auto voxels = volume::makeZeroVolume<std::uint16_t>(grid);
    for (int k = 0; k < 6; ++k)
      for (int j = 0; j < 5; ++j)
        for (int i = 0; i < 7; ++i)
          if ((i * 31 + j * 17 + k * 7 + map) % 5 == 0)
            voxels->at(i, j, k) = static_cast<std::uint16_t>(k == 2 ? 40 : 3);
    maps.push_back(volume::makeLabelMap(std::move(voxels), {}));
  }
  return maps;
}

SegmentationDescription overlappingSegments()
{
  SegmentationDescription description;
  description.studyUid = "1.2.3";
  description.seriesUid = "1.2.4";
  description.frameOfReferenceUid = "1.2.9";
  for (std::size_t map = 0; map < 2; ++map)
    for (const int index : {3, 40})
    {
      SegmentationDescription::Segment segment;
      segment.map = map;
      segment.index = static_cast<std::uint16_t>(index);
      segment.label = "N\xc3\xa9rf " + std::to_string(map) + " " + std::to_string(index);
      segment.color = {0.25F, static_cast<float>(map), static_cast<float>(index) / 64.0F};
      segment.type = {"119410002", "SCT", "Nerve"};
      description.segments.push_back(segment);
    }
  return description;
}

TEST(DicomSegmentationWriter, WritesWhatComesBackToTheBit)
{
  const TestFolder folder;
  const auto maps = overlappingMaps();
  const auto description = overlappingSegments();
  writeDicomSegmentation(folder / "a.dcm", maps, description);
  const LoadedLabels loaded = loadLabels(folder / "a.dcm");
  EXPECT_TRUE(loaded.notes.empty());
  EXPECT_EQ(loaded.frameOfReferenceUid, "1.2.9");
  std::size_t found = 0;
  for (const volume::LabelMap& map : loaded.maps)
  {
    const core::GridGeometry& grid = map.voxels->geometry();
    EXPECT_LT((grid.origin() - maps[0].voxels->geometry().origin()).norm(), 1e-9);
    EXPECT_LT((grid.direction() - maps[0].voxels->geometry().direction()).norm(), 1e-9);
    ASSERT_EQ(grid.dims(), maps[0].voxels->geometry().dims());
    for (const volume::Segment& segment : map.segments)
    {
      const auto& wanted = description.segments[static_cast<std::size_t>(segment.index - 1)];
      EXPECT_EQ(segment.name, wanted.label);
      EXPECT_EQ(loaded.meanings.at(segment.name), "Nerve");
      for (std::size_t c = 0; c < 3; ++c)
        EXPECT_NEAR(segment.color[c], wanted.color[c], 0.5 / 255.0) << segment.name;
      ++found;
      for (std::size_t p = 0; p < map.voxels->size(); ++p)
        ASSERT_EQ(map.voxels->data()[p] == segment.index,
                  maps[wanted.map].voxels->data()[p] == wanted.index)
            << segment.name << " " << p;
    }
  }
  EXPECT_EQ(found, 4U);
  // equal input, equal bytes; names without what would split them
  writeDicomSegmentation(folder / "b.dcm", maps, description);
  EXPECT_TRUE(fileBytes(folder / "a.dcm") == fileBytes(folder / "b.dcm"));
  auto odd = description;
  odd.segments[0].label = std::string(70, 'x') + "\\";
  odd.segments[1].label = "a\\b";
  writeDicomSegmentation(folder / "c.dcm", maps, odd);
  const LoadedLabels renamed = loadLabels(folder / "c.dcm");
  EXPECT_EQ(renamed.meanings.count(std::string(70, 'x') + "/"), 1U) << "the label holds 64";
  EXPECT_NE(fileBytes(folder / "c.dcm").find(std::string(64, 'x') + "\x62"), std::string::npos);
  EXPECT_EQ(renamed.meanings.count("a/b"), 1U);
}

TEST(DicomSegmentationWriter, RefusesWhatWouldBeNoSegmentation)
{
  const TestFolder folder;
  const auto maps = overlappingMaps();
  const auto refused = [&](const auto& change)
  {
    auto description = overlappingSegments();
    change(description);
    EXPECT_THROW(writeDicomSegmentation(folder / "a.dcm", maps, description),
                 core::InvalidParameter);
    EXPECT_FALSE(std::filesystem::exists(folder / "a.dcm"));
  };
  using Description = SegmentationDescription;
  refused([](Description& d) { d.segments.clear(); });
  refused([](Description& d) { d.studyUid = "a"; });
  refused([](Description& d) { d.segments[0].label.clear(); });
  refused([](Description& d) { d.segments[0].map = 2; });
  refused([](Description& d) { d.segments[0].index = 0; });
  refused([](Description& d) { d.segments[0].algorithm = Description::Algorithm::Automatic; });
  refused(
      [](Description& d) {
        d.source = Description::Source{SeriesDescription::Modality::Ct, "1.2", 5, true};
      });
  refused(
      [](Description& d)
      {
        for (auto& segment : d.segments)
          segment.index = 77;
      });
  std::vector<volume::LabelMap> other{maps[0], maps[1]};
  other[1] = volume::makeLabelMap(
      volume::makeZeroVolume<std::uint16_t>(core::GridGeometry({7, 5, 6}, {1, 1, 1}, {0, 0, 0})),
      {});
  EXPECT_THROW(writeDicomSegmentation(folder / "a.dcm", other, overlappingSegments()),
               core::InvalidParameter);
}

// Each displayable colour comes back within half a step of 8 bits.
TEST(DicomSegmentationWriter, KeepsColoursThroughCieLab)
{
  for (int r = 0; r <= 255; r += 15)
    for (int g = 0; g <= 255; g += 15)
      for (int b = 0; b <= 255; b += 15)
      {
        const std::array<float, 3> color{static_cast<float>(r) / 255.0F,
                                         static_cast<float>(g) / 255.0F,
                                         static_cast<float>(b) / 255.0F};
        const auto lab = cieLabFromColor(color);
        const auto back = colorFromCieLab({lab[0], lab[1], lab[2]});
        for (std::size_t c = 0; c < 3; ++c)
          ASSERT_NEAR(back[c], color[c], 0.5 / 255.0) << r << ' ' << g << ' ' << b;
      }
  // PS3.3 C.10.7.1.1: white is L* = 100, a* = b* = 0, which is 32896 (8080H).
  const auto white = cieLabFromColor({1.0F, 1.0F, 1.0F});
  EXPECT_EQ(white[0], 65535);
  EXPECT_NEAR(white[1], 32896, 3);
  EXPECT_NEAR(white[2], 32896, 3);
}

} // namespace
} // namespace petrous::imaging
