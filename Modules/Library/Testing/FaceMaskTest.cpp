#include <algorithm>
#include <cstring>
#include <functional>

#include <gtest/gtest.h>

#include "../../Imaging/Testing/TestDicom.h"
#include "../../Volume/Testing/SyntheticHead.h"
#include "TestCase.h"
#include "petrous/Core/InputFile.h"
#include "petrous/Imaging/DicomReader.h"
#include "petrous/Imaging/DicomScan.h"
#include "petrous/Imaging/DicomWriter.h"
#include "petrous/Library/Archive.h"
#include "petrous/Library/Deidentification.h"
#include "petrous/Scene/ImageMask.h"

using namespace petrous;
using namespace petrous::volume::test;
using Eigen::Vector3d;
using library::test::TemporaryFolder;

namespace
{

namespace fs = std::filesystem;

volume::IntensityVolume headImage(const core::PatientBox& box)
{
  return volume::IntensityVolume(scanned(SyntheticHead(), gridOver(box, Vector3d(2.0, 2.0, 4.0))));
}

void writeSeries(const fs::path& folder, const volume::IntensityVolume& image)
{
  imaging::SeriesDescription description;
  description.studyUid = "1.2.3.1";
  description.seriesUid = "1.2.3.2";
  description.frameOfReferenceUid = "1.2.3.3";
  description.rescaleIntercept = -1024.0;
  imaging::writeDicomSeries(folder, image, description);
}

volume::IntensityVolume readBack(const fs::path& folder)
{
  const auto scan = imaging::scanDicom(folder, {});
  EXPECT_EQ(scan.series.size(), 1u);
  return imaging::readSeries(scan.series.front(), {}, {});
}

// Whether the value stands in any of the folder's files.
std::size_t filesWith(const fs::path& folder, const std::string& text)
{
  std::size_t count = 0;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    if (entry.is_regular_file())
      count += core::readFile(entry.path()).find(text) != std::string::npos ? 1 : 0;
  return count;
}

// An enhanced MR by PS3.3 C.7.6.16, of axial frames: one stack per image, by echo time.
void writeEchoes(const fs::path& file, const std::vector<volume::IntensityVolume>& images)
{
  imaging::test::TestSlice s;
  s.sopClass = "1.2.840.10008.5.1.4.1.1.4.1";
  s.modality = "MR";
  const core::GridGeometry& grid = images.front().geometry();
  const core::Index3 n = grid.dims();
  s.columns = n[0];
  s.rows = n[1];
  s.pixels = false;
  const auto item = [&s](const std::string& content)
  {
    std::string out;
    s.append(out, 0xfffe, 2);
    s.append(out, 0xe000, 2);
    s.append(out, static_cast<std::uint32_t>(content.size()), 4);
    return out + content;
  };
  const auto group = [&](std::uint32_t tag, const std::function<void(std::string&)>& fill)
  {
    std::string content;
    fill(content);
    std::string out;
    s.element(out, tag, "SQ", item(content));
    return out;
  };
  std::string perFrame, data;
  double time = 0.0;
  for (const auto& image : images)
  {
    time += 10.0;
    for (int k = 0; k < n[2]; ++k)
    {
      const Vector3d at = grid.patientFromVoxel(Vector3d(0, 0, k));
      perFrame +=
          item(group(0x00209113,
                     [&](std::string& out)
                     {
                       s.element(out, 0x00200032, "DS",
                                 core::fixedText(at.x(), 2) + "\\" + core::fixedText(at.y(), 2) +
                                     "\\" + core::fixedText(at.z(), 2));
                     }) +
               group(0x00189114,
                     [&](std::string& out)
                     {
                       std::string bytes(sizeof time, '\0');
                       std::memcpy(bytes.data(), &time, sizeof time);
                       s.element(out, 0x00189082, "FD", bytes);
                     }));
      for (int j = 0; j < n[1]; ++j)
        for (int i = 0; i < n[0]; ++i)
          s.append(data, static_cast<std::uint32_t>(static_cast<std::int32_t>(image.at(i, j, k))),
                   2);
    }
  }
  std::string all = s.bytes();
  s.element(all, 0x00280008, "IS", std::to_string(images.size() * static_cast<std::size_t>(n[2])));
  s.element(all, 0x52009229, "SQ",
            item(group(0x00289110,
                       [&](std::string& out)
                       {
                         s.element(out, 0x00280030, "DS",
                                   core::fixedText(grid.spacing()[1], 2) + "\\" +
                                       core::fixedText(grid.spacing()[0], 2));
                       }) +
                 group(0x00209116, [&](std::string& out)
                       { s.element(out, 0x00200037, "DS", "1\\0\\0\\0\\1\\0"); })));
  s.element(all, 0x52009230, "SQ", perFrame);
  s.element(all, 0x7fe00010, "OW", data);
  imaging::test::writeText(file, all);
}

library::DeidentificationOptions withMask()
{
  library::DeidentificationOptions options;
  options.maskFace = true;
  return options;
}

// Explicit VR: the tag, CS, length 2, NO.
const std::string kNoFace("\x28\x00\x02\x03"
                          "CS\x02\x00NO",
                          10);

} // namespace

TEST(FaceMaskOfFiles, PutsAirInPlaceOfTheFaceAndChangesNoOtherPixel)
{
  const TemporaryFolder folder;
  const fs::path in = folder.path() / "in", out = folder.path() / "out";
  const auto before = headImage(headBox());
  writeSeries(in, before);
  const auto done = library::deidentify(in, out, withMask(), library::PseudonymKey());
  const auto slices = static_cast<std::size_t>(before.geometry().dims()[2]);
  EXPECT_EQ(done.report.filesWritten, slices);
  EXPECT_EQ(filesWith(out, "113102"), slices);
  EXPECT_EQ(filesWith(out, kNoFace), slices);

  const auto after = readBack(out);
  ASSERT_TRUE(core::sameGrid(before.geometry(), after.geometry()));
  const auto found = volume::findFace(before, {});
  ASSERT_EQ(found.kind, volume::FaceFinding::Kind::Face);
  const core::Index3 n = before.geometry().dims();
  std::size_t masked = 0, wrong = 0;
  for (int k = 0; k < n[2]; ++k)
    for (int j = 0; j < n[1]; ++j)
      for (int i = 0; i < n[0]; ++i)
      {
        const bool isFace =
            found.region.covers(before.geometry().patientFromVoxel(Vector3d(i, j, k)));
        masked += isFace ? 1 : 0;
        wrong += after.at(i, j, k) != (isFace ? -1000.0 : before.at(i, j, k)) ? 1 : 0;
      }
  EXPECT_GT(masked, 10000u);
  EXPECT_EQ(wrong, 0u);

  // Idempotent.
  library::deidentify(out, folder.path() / "again", withMask(), library::PseudonymKey());
  const auto again = readBack(folder.path() / "again");
  std::size_t other = 0;
  for (int k = 0; k < n[2]; ++k)
    for (int j = 0; j < n[1]; ++j)
      for (int i = 0; i < n[0]; ++i)
        other += again.at(i, j, k) != after.at(i, j, k) ? 1 : 0;
  EXPECT_EQ(other, 0u);
}

TEST(FaceMaskOfFiles, SaysThatAnEarHasNoFaceAndStatesNothing)
{
  const TemporaryFolder folder;
  const fs::path in = folder.path() / "in", out = folder.path() / "out";
  const auto before = headImage(core::PatientBox(Vector3d(20, -38, -30), Vector3d(102, 40, 52)));
  writeSeries(in, before);
  const auto done = library::deidentify(in, out, withMask(), library::PseudonymKey());
  EXPECT_EQ(done.report.filesWritten, static_cast<std::size_t>(before.geometry().dims()[2]));
  EXPECT_TRUE(std::any_of(done.report.warnings.begin(), done.report.warnings.end(),
                          [](const auto& warning)
                          { return warning.first.find("no face in this volume") == 0; }));
  EXPECT_EQ(filesWith(out, "113102"), 0u);
  EXPECT_EQ(filesWith(out, kNoFace), 0u);
  const auto after = readBack(out);
  const core::Index3 n = before.geometry().dims();
  for (int k = 0; k < n[2]; ++k)
    for (int j = 0; j < n[1]; ++j)
      for (int i = 0; i < n[0]; ++i)
        ASSERT_EQ(after.at(i, j, k), before.at(i, j, k));
}

// A slice by itself may be one of a face.
TEST(FaceMaskOfFiles, LeavesOutWhatIsInNoVolume)
{
  const TemporaryFolder folder;
  const fs::path in = folder.path() / "in", out = folder.path() / "out";
  writeSeries(in, headImage(headBox()));
  const fs::path first = in / "slice-0001.dcm";
  fs::create_directories(folder.path() / "one");
  fs::copy_file(first, folder.path() / "one" / "slice.dcm");
  EXPECT_THROW(library::deidentify(folder.path() / "one", out, withMask(), library::PseudonymKey()),
               core::Error);
  EXPECT_FALSE(fs::exists(out));
}

// The first volume of a file, in which nothing is found, does not speak for the second.
TEST(FaceMaskOfFiles, MasksEachVolumeOfAFileWithSeveral)
{
  const TemporaryFolder folder;
  const fs::path in = folder.path() / "in", out = folder.path() / "out";
  const core::GridGeometry grid = gridOver(headBox(), Vector3d(2.5, 2.5, 5.0));
  auto ball = std::make_shared<volume::Volume<std::int16_t>>(grid, 20);
  const core::Index3 n = grid.dims();
  for (int k = 0; k < n[2]; ++k)
    for (int j = 0; j < n[1]; ++j)
      for (int i = 0; i < n[0]; ++i)
        if (grid.patientFromVoxel(Vector3d(i, j, k)).norm() < 15.0)
          ball->at(i, j, k) = 300;
  const volume::IntensityVolume head(scanned(SyntheticHead(), grid, true));
  fs::create_directories(in);
  writeEchoes(
      in / "echoes.dcm",
      {volume::IntensityVolume(std::shared_ptr<const volume::Volume<std::int16_t>>(ball)), head});
  const auto done = library::deidentify(in, out, withMask(), library::PseudonymKey());
  EXPECT_EQ(done.report.filesWritten, 1u);
  EXPECT_EQ(filesWith(out, "113102"), 1u);
  const auto scan = imaging::scanDicom(out, {});
  ASSERT_EQ(scan.series.size(), 2u);
  for (const auto& series : scan.series)
  {
    const auto after = imaging::readSeries(series, {}, {});
    for (const Vector3d& own : {Vector3d(0, -100, 0), Vector3d(0, -88, -68), Vector3d(30, -88, 44)})
      EXPECT_LT(after.sample(after.geometry().voxelFromPatient(own)), 100.0) << own.transpose();
  }
}

TEST(FaceMaskOfFiles, LeavesOutPixelsOfEveryKindThatAreInNoVolume)
{
  const TemporaryFolder folder;
  const fs::path in = folder.path() / "in", out = folder.path() / "out";
  writeSeries(in, headImage(headBox()));
  int n = 0;
  for (const std::uint32_t tag : {0x7fe00008U, 0x7fe00009U, 0x7fe00010U})
  {
    imaging::test::TestSlice slice;
    slice.seriesUid = "1.2.3.77." + std::to_string(++n);
    slice.pixelTag = tag;
    slice.bitsAllocated = tag == 0x7fe00008U ? 32 : tag == 0x7fe00009U ? 64 : 16;
    slice.bitsStored = slice.bitsAllocated;
    slice.write(in / ("single-" + std::to_string(n) + ".dcm"));
  }
  const auto done = library::deidentify(in, out, withMask(), library::PseudonymKey());
  EXPECT_EQ(done.leftOut.size(), 3u);
  for (const std::string& line : done.leftOut)
    EXPECT_NE(line.find("no slice of a CT or MR volume"), std::string::npos) << line;
}

// A contour of the body is the skin.
TEST(FaceMaskOfFiles, LeavesOutContoursAndSegments)
{
  const TemporaryFolder folder;
  const fs::path in = folder.path() / "in", out = folder.path() / "out";
  writeSeries(in, headImage(headBox()));
  const std::vector<std::pair<std::string, std::string>> kinds{
      {"1.2.840.10008.5.1.4.1.1.481.3", "RTSTRUCT"},
      {"1.2.840.10008.5.1.4.1.1.66.4", "SEG"},
      {"1.2.840.10008.5.1.4.1.1.66.5", "SEG"}};
  for (const auto& [sopClass, modality] : kinds)
  {
    imaging::test::TestSlice slice;
    slice.seriesUid = "1.2.3.88";
    slice.sopClass = sopClass;
    slice.modality = modality;
    slice.pixels = false;
    slice.write(in / (sopClass + ".dcm"));
  }
  const auto done = library::deidentify(in, out, withMask(), library::PseudonymKey());
  ASSERT_EQ(done.leftOut.size(), kinds.size());
  for (const std::string& line : done.leftOut)
    EXPECT_NE(line.find("skin"), std::string::npos) << line;
  const auto without = library::deidentify(in, folder.path() / "all", {}, library::PseudonymKey());
  EXPECT_TRUE(without.leftOut.empty());
}

// Drilled at home, masked in the archive: the strokes apply where it arrives, to the bit, and the
// case at home stays.
TEST(FaceMaskOfArchives, KeepsStrokesAndTheCaseAtHome)
{
  const TemporaryFolder folder;
  library::Library home(folder.path() / "home"), there(folder.path() / "there");
  scene::Case value;
  value.name = "head";
  value.ct.name = "ct";
  value.ct.geometry = gridOver(headBox(), Vector3d::Constant(3.0));
  value.ct.volume =
      std::make_shared<const volume::IntensityVolume>(scanned(SyntheticHead(), value.ct.geometry));
  value.ct.range = value.ct.volume.get()->range();
  value.dissection = dissection::Dissection(value.ct.geometry);
  for (const Vector3d& at : {Vector3d(62, 4, 15), Vector3d(16, -61, -10)}) // of the face, too
  {
    value.dissection.beginStroke({});
    value.dissection.cut({at, at + Vector3d(0, 4, 0), 4.0});
    value.dissection.endStroke();
  }
  home.save(value);
  const auto before = home.open("head");

  library::ArchiveOptions options;
  options.prepare = [](scene::Case& copy, const core::Progress& progress)
  {
    scene::ImageMask mask;
    mask.face = true;
    return scene::maskImages(copy, mask, progress).notes;
  };
  const fs::path file = folder.path() / "head.petrous";
  const auto archived = library::archiveCase(home, "head", file, options);
  EXPECT_FALSE(archived.notes.empty());
  EXPECT_TRUE(home.verify().damaged.empty());
  EXPECT_EQ(home.open("head").ct.object, before.ct.object);

  library::restoreCase(there, file);
  EXPECT_TRUE(there.verify().damaged.empty());
  scene::Case restored = there.open("head");
  EXPECT_NE(restored.ct.object, before.ct.object);
  there.loadDissection(restored);
  EXPECT_EQ(restored.applied(), 2u);
  const auto ct = restored.ct.volume.get();
  const auto face = volume::findFace(*value.ct.volume.get(), {});
  ASSERT_EQ(face.kind, volume::FaceFinding::Kind::Face);
  const core::Index3 n = value.ct.geometry.dims();
  std::size_t changed = 0, drilled = 0;
  for (int k = 0; k < n[2]; ++k)
    for (int j = 0; j < n[1]; ++j)
      for (int i = 0; i < n[0]; ++i)
      {
        const auto left = value.dissection.mask().at(i, j, k);
        ASSERT_EQ(restored.dissection.mask().at(i, j, k), left);
        const bool isSame = ct->at(i, j, k) == value.ct.volume.get()->at(i, j, k);
        if (left != volume::CutMask::kUntouched)
        {
          ++drilled;
          ASSERT_TRUE(isSame);
        }
        changed += isSame ? 0 : 1;
      }
  EXPECT_GT(drilled, 50u);
  EXPECT_GT(changed, 1000u);
  EXPECT_TRUE(scene::imagesWithFace(restored).empty());
}
