// What a medium that is pulled out, or a file that is cut, does to each reader.
#include <fstream>
#include <functional>

#include <gtest/gtest.h>
#include <zlib.h>

#include "ReadFaults.h"
#include "TestDicom.h"
#include "petrous/Imaging/DicomReader.h"
#include "petrous/Imaging/DicomWriter.h"
#include "petrous/Imaging/FileFormats.h"
#include "petrous/Imaging/ImageFile.h"
#include "petrous/Imaging/LabelFile.h"
#include "petrous/Imaging/StructureSet.h"
#include "petrous/Imaging/VolumeFile.h"

namespace petrous::imaging
{
namespace
{

namespace fs = std::filesystem;
using petrous::testing::ReadFaults;
using test::TemporaryFolder;
using test::TestSlice;

/// Runs `read`, which returns a sum over all it read, with every read below the folder failing, one
/// after the other, until none does. Where one fails, it throws an error that names a file, unless
/// nothing was missing: readers look beyond the last byte that they need.
void expectNamed(const fs::path& folder, const std::string& name,
                 const std::function<std::uint64_t()>& read)
{
  const std::uint64_t whole = read();
  for (const auto kind : {ReadFaults::Kind::Error, ReadFaults::Kind::End})
  {
    int told = 0;
    for (int n = 1;; ++n)
    {
      ASSERT_LT(n, 500);
      ReadFaults::pullOut(folder, n, kind);
      std::string what;
      std::uint64_t sum = 0;
      try
      {
        sum = read();
      }
      catch (const core::Error& error)
      {
        what = error.what();
      }
      const int failures = ReadFaults::failures();
      ReadFaults::reset();
      if (!what.empty())
      {
        ++told;
        EXPECT_NE(what.find(name), std::string::npos) << what;
        EXPECT_EQ(what.find('\n'), std::string::npos) << what;
      }
      else
        EXPECT_EQ(sum, whole) << "read " << n << " failed, and nobody was told";
      if (failures == 0)
        break;
    }
    EXPECT_GT(told, 0);
  }
}

template <class T>
std::uint64_t sumOf(const volume::Volume<T>& voxels)
{
  std::uint64_t sum = 1;
  for (std::size_t v = 0; v < voxels.size(); ++v)
    sum = sum * 31 + static_cast<std::uint64_t>(static_cast<std::int64_t>(voxels.data()[v]));
  return sum;
}

std::uint64_t sumOf(const volume::IntensityVolume& image)
{
  return image.visit([](const auto& voxels) { return sumOf(voxels); });
}

volume::Volume<std::int16_t> someVolume()
{
  volume::Volume<std::int16_t> voxels(
      core::GridGeometry({40, 40, 20}, Eigen::Vector3d(0.5, 0.5, 1.0), Eigen::Vector3d(1, 2, 3)));
  for (std::size_t v = 0; v < voxels.size(); ++v) // does not compress to nothing
    voxels.data()[v] = static_cast<std::int16_t>(v * 2654435761U >> 18);
  return voxels;
}

TEST(PulledOut, ADicomScanHoldsItAgainstTheSeries)
{
  const TemporaryFolder folder;
  test::writeSeries(folder.path(), 6);
  for (int n = 1;; ++n)
  {
    ASSERT_LT(n, 200);
    ReadFaults::pullOut(folder.path(), n);
    const ScanResult result = scanDicom(folder.path(), {});
    const int failures = ReadFaults::failures();
    ReadFaults::reset();
    if (failures == 0)
    {
      EXPECT_EQ(result.series.front().geometry.verdict, Verdict::Ok);
      break;
    }
    std::string texts;
    for (const DicomSeries& series : result.series)
    {
      EXPECT_NE(series.geometry.verdict, Verdict::Ok) << "read " << n;
      for (const Finding& finding : series.geometry.findings)
        texts += finding.text;
    }
    for (const Finding& finding : result.unreadable)
      texts += finding.text;
    EXPECT_NE(texts.find(".dcm could not be read"), std::string::npos) << texts;
  }
}

TEST(PulledOut, VoxelsOfASeriesNameTheFile)
{
  const TemporaryFolder folder;
  test::writeSeries(folder.path(), 4);
  const ScanResult result = scanDicom(folder.path(), {});
  expectNamed(folder.path(), ".dcm",
              [&] { return sumOf(readSeries(result.series.front(), {}, {})); });
}

TEST(PulledOut, ASeriesCutBetweenScanAndReadingNamesTheFile)
{
  const TemporaryFolder folder;
  test::writeSeries(folder.path(), 4);
  const fs::path file = folder.path() / "s2.dcm";
  const auto size = fs::file_size(file);
  const ScanResult result = scanDicom(folder.path(), {});
  for (const std::uintmax_t left : {size - 1, size / 2, std::uintmax_t{140}, std::uintmax_t{0}})
  {
    fs::resize_file(file, left);
    try
    {
      readSeries(result.series.front(), {}, {});
      ADD_FAILURE() << "read";
    }
    catch (const DicomError& error)
    {
      EXPECT_NE(std::string(error.what()).find("s2.dcm was changed"), std::string::npos)
          << error.what();
    }
  }
}

TEST(PulledOut, ImagesOfEveryFormatNameTheFile)
{
  for (const char* name : {"ct.nii", "ct.nii.gz", "ct.nrrd", "ct.mha"})
  {
    SCOPED_TRACE(name);
    const TemporaryFolder folder;
    writeVolume(folder.path() / name, someVolume());
    expectNamed(folder.path(), "ct.",
                [&] { return sumOf(*readImageFile(folder.path() / name, {}, {}).volume); });
  }
}

TEST(PulledOut, StructuresOfEveryFormatNameTheFile)
{
  auto voxels = volume::makeZeroVolume<std::uint16_t>(someVolume().geometry());
  for (std::size_t v = 0; v < voxels->size(); v += 3)
    voxels->data()[v] = static_cast<std::uint16_t>(1 + v % 2);
  const volume::LabelMap map = volume::makeLabelMap(voxels, {{"incus", 1, {}, 0}});
  for (const char* name : {"ear.nii.gz", "ear.seg.nrrd", "ear.dcm"})
  {
    SCOPED_TRACE(name);
    const TemporaryFolder folder;
    const fs::path file = folder.path() / name;
    if (file.extension() == ".dcm")
    {
      SegmentationDescription segmentation;
      segmentation.studyUid = "1.2.3";
      segmentation.seriesUid = "1.2.3.4";
      segmentation.frameOfReferenceUid = "1.2.3.5";
      SegmentationDescription::Segment segment;
      segment.index = 1;
      segment.label = "incus";
      segmentation.segments = {segment};
      writeDicomSegmentation(file, {map}, segmentation);
    }
    else
      writeLabelFile(file, map);
    expectNamed(folder.path(), name, [&] { return sumOf(*loadLabels(file).maps.front().voxels); });
  }
}

} // namespace
} // namespace petrous::imaging
