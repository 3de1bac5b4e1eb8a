#include <algorithm>
#include <array>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include <unistd.h>

#include <gtest/gtest.h>

#include "petrous/Imaging/FileFormats.h"
#include "petrous/Imaging/ImageFile.h"
#include "petrous/Imaging/LabelFile.h"
#include "petrous/Imaging/StructureSet.h"

#include "ItkReader.h"

namespace petrous::imaging
{
namespace
{

namespace fs = std::filesystem;

/// A file in the archives folder (PETROUS_DATA_ARCHIVES) or in the unpacked one (PETROUS_DATA);
/// empty if in neither.
fs::path dataFile(const std::string& name)
{
  for (const char* variable : {"PETROUS_DATA_ARCHIVES", "PETROUS_DATA"})
    if (const char* folder = std::getenv(variable); folder && *folder)
    {
      std::error_code ignored;
      if (fs::exists(fs::path(folder) / name, ignored))
        return fs::path(folder) / name;
    }
  return {};
}

// GTEST_SKIP returns from the test, so this is a macro.
#define PETROUS_NEED(variable, name)                                                               \
  const fs::path variable = dataFile(name);                                                        \
  if (variable.empty())                                                                            \
  GTEST_SKIP() << (name) << " is not there; name its folder in PETROUS_DATA_ARCHIVES"

const volume::Segment* find(const volume::LabelMap& map, const std::string& name)
{
  const auto at = std::find_if(map.segments.begin(), map.segments.end(),
                               [&name](const auto& segment) { return segment.name == name; });
  return at == map.segments.end() ? nullptr : &*at;
}

TEST(FilesData, HeadAndNeckAtlasHasItsPlaceAndItsNames)
{
  PETROUS_NEED(path, "labels/HN-Atlas-labels.nrrd");
  const volume::LabelMap map = readLabelFile(path);
  const auto& grid = map.voxels->geometry();
  EXPECT_EQ(grid.dims(), (core::Index3{255, 255, 229}));
  // Computed by hand from its header: origin (124.0234375, 124.0234375, -159.6028), steps
  // -0.9765625, -0.9765625, 1.4000244 mm, so voxel (100, 200, 50) lies at
  EXPECT_NEAR(grid.patientFromVoxel({100.0, 200.0, 50.0})[0], 26.3671875, 1e-9);
  EXPECT_NEAR(grid.patientFromVoxel({100.0, 200.0, 50.0})[1], -71.2890625, 1e-9);
  EXPECT_NEAR(grid.patientFromVoxel({100.0, 200.0, 50.0})[2], -89.6015616, 1e-6);
  ASSERT_NE(find(map, "mandible"), nullptr);
  EXPECT_EQ(find(map, "mandible")->index, 25);
  EXPECT_NEAR(find(map, "mandible")->color[0], 220.0F / 255.0F, 1e-6F);
  // The right clavicle is on the patient's right: LPS x below 0 on average.
  const volume::Segment* clavicle = find(map, "right_clavicle");
  ASSERT_NE(clavicle, nullptr);
  double x = 0.0;
  std::uint64_t count = 0;
  for (int k = 0; k < grid.dims()[2]; ++k)
    for (int j = 0; j < grid.dims()[1]; ++j)
      for (int i = 0; i < grid.dims()[0]; ++i)
        if (map.voxels->at(i, j, k) == clavicle->index)
        {
          x += grid.patientFromVoxel({double(i), double(j), double(k)})[0];
          ++count;
        }
  EXPECT_EQ(count, clavicle->voxels);
  EXPECT_LT(x / static_cast<double>(count), -20.0);
}

void expectTemplate(const fs::path& path, double slope)
{
  const LoadedImage image = readImageFile(path);
  const auto& grid = image.volume->geometry();
  EXPECT_EQ(grid.dims(), (core::Index3{91, 109, 91}));
  EXPECT_TRUE(image.notes.empty());
  // sform (-2 0 0 90; 0 2 0 -126; 0 0 2 -72) RAS; LPS negates x and y.
  EXPECT_TRUE(grid.patientFromVoxel({10.0, 20.0, 30.0}).isApprox(Eigen::Vector3d(-70, 86, -12)));
  EXPECT_TRUE(
      std::holds_alternative<std::shared_ptr<const volume::Volume<float>>>(image.volume->voxels()));
  // Every value is an integer from 0 to 255 times the slope, and values near both ends occur.
  const auto range = image.volume->range();
  EXPECT_GE(range.min, 0.0);
  EXPECT_LE(range.max, 255.0 * slope * (1.0 + 1e-6));
  EXPECT_GT(range.max, 100.0 * slope);

  // ITK, independently, gives the same voxels at the same position.
  ItkReader itk(path, ItkReader::Format::Nifti);
  ASSERT_TRUE(itk.readHeader());
  for (unsigned a = 0; a < 3; ++a)
    EXPECT_NEAR(itk.origin(a), grid.origin()[a], 1e-4);
  std::vector<float> voxels(grid.voxelCount());
  ASSERT_TRUE(itk.read({0, 0, 0}, grid.dims(), voxels.data()));
  for (const core::Index3& v : {core::Index3{45, 54, 45}, {30, 60, 40}, {0, 0, 0}, {60, 20, 70}})
    EXPECT_NEAR(image.volume->at(v[0], v[1], v[2]), voxels[grid.linearIndex(v[0], v[1], v[2])],
                1e-3);
}

TEST(FilesData, TemplateCtHasItsPlaceAndItsRescale)
{
  PETROUS_NEED(path, "registration/scct.nii.gz");
  expectTemplate(path, 14.880134582519531);
}

TEST(FilesData, TemplateMrHasItsPlaceAndItsRescale)
{
  PETROUS_NEED(path, "registration/avg152T1.nii.gz");
  expectTemplate(path, 0.003921568859368563);
}

// Voxels of each segment as counted by pydicom 2.3.1: sums of `pixel_array` over the frames of a
// Referenced Segment Number; for label maps, pixels of its value.
TEST(FilesData, SegmentationsOfDcmqiHavePydicomsVoxels)
{
  struct File
  {
    const char* name;
    core::Index3 dims;
    Eigen::Vector3d first; ///< patient position of the first voxel
    std::vector<std::uint64_t> voxels;
  };
  const Eigen::Vector3d cropped(46.4649, 5.01881, -177.75);
  const Eigen::Vector3d liver(-235.2, -226.8, -128.69);
  const File files[] = {
      {"segmentations/23x38x3/seg/label.seg", {23, 38, 3}, cropped, {322}},
      {"segmentations/24x38x3/seg/label.seg", {24, 38, 3}, cropped, {315}},
      {"segmentations/liver.dcm", {512, 512, 3}, liver, {107098}},
      {"segmentations/partial_overlaps.dcm",
       {512, 512, 3},
       liver,
       {9602, 11888, 10743, 6693, 4713}},
      {"segmentations/sparse-labelmap-noppv.dcm", {24, 38, 3}, cropped, {630}},
      {"segmentations/sparse-labelmap-ppv5.dcm", {24, 38, 3}, cropped, {630}},
      {"sr-example/seg.dcm", {128, 128, 13}, {-226.4105, -430.7887, -119.271}, {795}}};
  PETROUS_NEED(folder, "seg_rt/dcmqi/data");
  for (const File& file : files)
  {
    const LoadedLabels loaded = loadLabels(folder / file.name);
    std::vector<std::uint64_t> voxels(file.voxels.size());
    for (const volume::LabelMap& map : loaded.maps)
    {
      EXPECT_EQ(map.voxels->geometry().dims(), file.dims) << file.name;
      EXPECT_LT((map.voxels->geometry().origin() - file.first).norm(), 1e-4) << file.name;
      for (const volume::Segment& segment : map.segments)
        voxels.at(segment.index - 1U) += segment.voxels;
    }
    EXPECT_EQ(voxels, file.voxels) << file.name;
  }
}

TEST(FilesData, EveryNiftiLiesWhereItkPutsIt)
{
  const char* folder = std::getenv("PETROUS_DATA");
  if (!folder || !fs::is_directory(folder))
    GTEST_SKIP() << "no folder of real data; name it in PETROUS_DATA";
  int compared = 0;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
  {
    const std::string name = entry.path().filename().string();
    if (name.find(".nii") == name.npos || !isReadAs(entry.path(), kImage | kLabels))
      continue;
    try
    {
      const LoadedImage image = readImageFile(entry.path());
      ItkReader itk(entry.path(), ItkReader::Format::Nifti);
      ASSERT_TRUE(itk.readHeader()) << entry.path();
      for (unsigned a = 0; a < 3; ++a)
      {
        EXPECT_NEAR(itk.origin(a), image.volume->geometry().origin()[a], 1e-2) << entry.path();
        for (unsigned row = 0; row < 3; ++row)
          EXPECT_NEAR(itk.axis(a)[row], image.volume->geometry().direction()(row, a), 1e-3)
              << entry.path();
      }
      ++compared;
    }
    catch (const FileError& error)
    {
      // Only colour pictures and time series are not supported in a scene.
      EXPECT_EQ(error.reason, FileError::Reason::Unsupported) << error.what();
      const std::string what = error.what();
      EXPECT_TRUE(entry.path().string().find("rgb") != std::string::npos ||
                  what.find("one volume of 3 dimensions") != std::string::npos ||
                  what.find("one is needed: name it by its number") != std::string::npos)
          << what;
    }
  }
  EXPECT_GT(compared, 0);
}

TEST(FilesData, EverySegmentationOfDcmqiReads)
{
  PETROUS_NEED(folder, "seg_rt/dcmqi/data/segmentations");
  int read = 0;
  for (const auto& entry : fs::directory_iterator(folder))
    if (entry.path().extension() == ".nrrd")
    {
      const volume::LabelMap map = readLabelFile(entry.path());
      EXPECT_FALSE(map.segments.empty()) << entry.path();
      ++read;
    }
  EXPECT_GT(read, 5);
}

/// Volume in voxels and in the file, mm^3.
std::pair<double, double> volumes(const fs::path& path, const std::string& name,
                                  const core::GridGeometry& grid)
{
  const LoadedLabels loaded = labelsOf(readStructureSet(path), grid, path);
  for (const volume::LabelMap& map : loaded.maps)
    if (const volume::Segment* segment = find(map, name))
      return {map.volume(*segment), loaded.fileVolumes.at(name)};
  return {0.0, 0.0};
}

// Areas by the shoelace formula from the points as strings(1) shows them.
TEST(FilesData, StructureSetsHaveTheVolumeOfTheirPolygons)
{
  PETROUS_NEED(ring, "seg_rt/rt-utils/tests/mock_data/rt.dcm");
  for (const double spacing : {0.4, 1.0, 1.7})
  {
    // A square of 24 mm around a hole of 15 mm without a corner, on one plane
    const double area = 24.0 * 24.0 - (15.0 * 15.0 - 0.5);
    const core::GridGeometry grid({200, 200, 5}, Eigen::Vector3d(spacing, spacing, 2.0),
                                  Eigen::Vector3d(-60.13, -60.29, 56.0));
    const auto [voxels, file] = volumes(ring, "ROI-1", grid);
    EXPECT_NEAR(file, area * 2.0, 1e-2 * area * 2.0) << spacing;
    EXPECT_NEAR(voxels, area * 2.0, 1e-2 * area * 2.0) << spacing;
  }
  PETROUS_NEED(box, "dicom_odd/pydicom_test_files/test_files/rtstruct.dcm");
  const core::GridGeometry grid({90, 70, 20}, Eigen::Vector3d(5.0, 5.0, 2.5),
                                Eigen::Vector3d(-221.0, -173.0, -212.0));
  const auto [voxels, file] = volumes(box, "patient", grid);
  EXPECT_NEAR(file, 400.0 * 300.0 * 30.0, 1.0); // three planes, 10 mm apart
  EXPECT_NEAR(voxels, 400.0 * 300.0 * 30.0, 1e-3 * file);
}

TEST(FilesData, TruncatedSegmentationsAndStructureSetsAreRefusedInOneLine)
{
  const char* folder = std::getenv("PETROUS_DATA");
  if (!folder || !fs::is_directory(folder))
    GTEST_SKIP() << "no folder of real data; name it in PETROUS_DATA";
  std::string name = (fs::temp_directory_path() / "petrous-cut-XXXXXX").string();
  ASSERT_NE(::mkdtemp(name.data()), nullptr);
  const fs::path cut = fs::path(name) / "cut.dcm";
  int files = 0;
  for (const char* part : {"seg_rt", "dicom_odd/pydicom_test_files/test_files"})
    for (const auto& entry : fs::recursive_directory_iterator(fs::path(folder) / part))
    {
      if (!entry.is_regular_file() ||
          (!isStructureSet(entry.path()) && !isDicomSegmentation(entry.path())))
        continue;
      ++files;
      std::ifstream stream(entry.path(), std::ios::binary);
      const std::string whole((std::istreambuf_iterator<char>(stream)),
                              std::istreambuf_iterator<char>());
      for (std::size_t hundredths = 0; hundredths < 100; ++hundredths)
      {
        std::ofstream(cut, std::ios::binary)
            .write(whole.data(), static_cast<std::streamsize>(whole.size() * hundredths / 100));
        try
        {
          if (isStructureSet(cut))
            readStructureSet(cut);
          else if (isDicomSegmentation(cut))
            loadLabels(cut);
        }
        catch (const FileError& error)
        {
          const std::string what = error.what();
          EXPECT_EQ(what.find('\n'), std::string::npos) << what;
          EXPECT_EQ(what.find("PHANTOM"), std::string::npos); // a patient's name
        }
      }
    }
  std::error_code ignored;
  fs::remove_all(name, ignored);
  EXPECT_GE(files, 5);
}

} // namespace
} // namespace petrous::imaging
