#include "petrous/Imaging/DicomReader.h"

#include <atomic>

#include <gtest/gtest.h>

#include "TestDicom.h"

namespace petrous::imaging
{
namespace
{

namespace fs = std::filesystem;
using core::GridGeometry;
using test::TemporaryFolder;
using test::TestSlice;
using test::writeSeries;
using volume::IntensityVolume;
using volume::Volume;

IntensityVolume readFolder(const fs::path& folder, const ReadOptions& options = {},
                           std::vector<std::string>* notes = nullptr)
{
  const ScanResult result = scanDicom(folder, {});
  return readSeries(chooseSeries(result, folder), options, {}, notes);
}

template <class T>
bool isType(const IntensityVolume& volume)
{
  return std::holds_alternative<std::shared_ptr<const Volume<T>>>(volume.voxels());
}

std::uint32_t ramp(int i, int j, int k)
{
  return static_cast<std::uint32_t>(17 * i + 31 * j + 101 * k);
}

DicomError::Reason reasonOf(const std::function<void()>& action)
{
  try
  {
    action();
  }
  catch (const DicomError& error)
  {
    return error.reason();
  }
  ADD_FAILURE() << "no error";
  return DicomError::Reason::NotFound;
}

TEST(DicomReader, ReadsEveryVoxelAtItsPlace)
{
  const TemporaryFolder folder;
  writeSeries(folder.path(), 5,
              [](int k, TestSlice& s)
              {
                s.intercept = -1024;
                s.isSigned = false;
                s.bitsStored = 12;
                s.cell = [k](int i, int j) { return ramp(i, j, k); };
              });
  const IntensityVolume volume = readFolder(folder.path());
  EXPECT_TRUE(isType<std::int16_t>(volume));
  ASSERT_EQ(volume.geometry().dims(), (core::Index3{8, 6, 5}));
  for (int k = 0; k < 5; ++k)
    for (int j = 0; j < 6; ++j)
      for (int i = 0; i < 8; ++i)
        ASSERT_EQ(volume.at(i, j, k), ramp(i, j, k) - 1024.0);
}

TEST(DicomReader, ExtendsTheSignOfTwelveBitsAndDropsWhatStandsAbove)
{
  const TemporaryFolder folder;
  writeSeries(folder.path(), 2,
              [](int, TestSlice& s)
              {
                s.bitsStored = 12;
                s.cell = [](int i, int j) {
                  return i == 0 ? 0xA801U : i == 1 ? 0x57FFU : 0xF000U * (j % 2);
                };
              });
  const IntensityVolume volume = readFolder(folder.path());
  EXPECT_EQ(volume.at(0, 0, 0), -2047.0);
  EXPECT_EQ(volume.at(1, 0, 0), 2047.0);
  EXPECT_EQ(volume.at(2, 1, 0), 0.0);
}

TEST(DicomReader, AppliesEachSlicesOwnSlope)
{
  const TemporaryFolder folder;
  writeSeries(folder.path(), 3,
              [](int k, TestSlice& s)
              {
                s.slope = 0.25 * (k + 1);
                s.cell = [](int i, int) { return static_cast<std::uint32_t>(i); };
              });
  ReadOptions options;
  EXPECT_EQ(reasonOf([&] { readFolder(folder.path(), options); }), DicomError::Reason::Misleading);
  options.acceptDefects = true;
  const IntensityVolume volume = readFolder(folder.path(), options);
  EXPECT_TRUE(isType<float>(volume));
  for (int k = 0; k < 3; ++k)
    EXPECT_EQ(volume.at(5, 2, k), 5 * 0.25 * (k + 1));
}

TEST(DicomReader, ChoosesTheSmallestTypeThatHoldsTheRealValues)
{
  const auto typeIndex = [](const std::function<void(int, TestSlice&)>& change)
  {
    const TemporaryFolder folder;
    writeSeries(folder.path(), 2, change);
    return readFolder(folder.path()).voxels().index();
  };
  EXPECT_EQ(typeIndex([](int, TestSlice&) {}), 0U);
  // 16 bits signed and -1024 could exceed int16, but these do not
  EXPECT_EQ(typeIndex([](int, TestSlice& s) { s.intercept = -1024; }), 0U);
  EXPECT_EQ(typeIndex(
                [](int, TestSlice& s)
                {
                  s.intercept = -1024;
                  s.cell = [](int, int) { return 0x8001U; };
                }),
            2U);
  EXPECT_EQ(typeIndex([](int, TestSlice& s) { s.isSigned = false; }), 1U);
  EXPECT_EQ(typeIndex(
                [](int, TestSlice& s)
                {
                  s.slope = 2;
                  s.cell = [](int, int) { return 30000U; };
                }),
            1U);
  EXPECT_EQ(typeIndex([](int, TestSlice& s) { s.slope = 0.5; }), 2U);
  EXPECT_EQ(typeIndex([](int, TestSlice& s) { s.intercept = 0.5; }), 2U);
}

TEST(DicomReader, ReadsEightAndThirtyTwoBitsAndBigEndian)
{
  for (const int bits : {8, 16, 32})
    for (const bool bigEndian : {false, true})
    {
      if (bits == 8 && bigEndian)
        continue;
      const TemporaryFolder folder;
      writeSeries(folder.path(), 2,
                  [&](int k, TestSlice& s)
                  {
                    s.bitsAllocated = s.bitsStored = bits;
                    s.isSigned = false;
                    s.bigEndian = bigEndian;
                    s.cell = [k](int i, int j) { return (ramp(i, j, k) % 251); };
                  });
      const IntensityVolume volume = readFolder(folder.path());
      for (int j = 0; j < 6; ++j)
        ASSERT_EQ(volume.at(7, j, 1), ramp(7, j, 1) % 251) << bits << bigEndian;
    }
}

TEST(DicomReader, KeepsALowPaddingAndLeavesItOutOfTheRange)
{
  const TemporaryFolder folder;
  writeSeries(folder.path(), 2,
              [](int, TestSlice& s)
              {
                s.padding = static_cast<std::uint16_t>(-2000);
                s.intercept = -1024;
                s.cell = [](int i, int j) { return i == 0 ? 0xFFFFU & -2000 : ramp(i, j, 0); };
              });
  std::vector<std::string> notes;
  const IntensityVolume volume = readFolder(folder.path(), {}, &notes);
  EXPECT_EQ(volume.padding(), -3024.0);
  EXPECT_EQ(volume.range().min, 17.0 - 1024.0);
  EXPECT_TRUE(notes.empty());
}

TEST(DicomReader, ReplacesPaddingThatWouldPassForTissue)
{
  const TemporaryFolder folder;
  writeSeries(folder.path(), 2,
              [](int, TestSlice& s)
              {
                s.isSigned = false;
                s.padding = 63536;
                s.intercept = -1024;
                s.cell = [](int i, int)
                { return i == 0 ? 63536U : 100U * static_cast<unsigned>(i); };
              });
  std::vector<std::string> notes;
  const IntensityVolume volume = readFolder(folder.path(), {}, &notes);
  EXPECT_TRUE(isType<std::int16_t>(volume));
  EXPECT_EQ(volume.at(0, 3, 1), -1024.0);
  EXPECT_EQ(volume.at(7, 3, 1), 700.0 - 1024.0);
  EXPECT_EQ(volume.padding(), -1024.0);
  EXPECT_EQ(notes.size(), 1U);
}

TEST(DicomReader, TreatsTheWholePaddingRangeAsPadding)
{
  const TemporaryFolder folder;
  writeSeries(folder.path(), 2,
              [](int, TestSlice& s)
              {
                s.padding = static_cast<std::uint16_t>(-2000);
                s.paddingLimit = static_cast<std::uint16_t>(-1900);
                s.cell = [](int i, int j)
                { return i < 2 ? 0xFFFFU & static_cast<unsigned>(-1900 - 50 * i) : ramp(i, j, 0); };
              });
  const IntensityVolume volume = readFolder(folder.path());
  EXPECT_EQ(volume.padding(), -2000.0);
  EXPECT_EQ(volume.at(0, 0, 0), -2000.0);
  EXPECT_EQ(volume.range().min, 34.0);
}

TEST(DicomReader, KeepsTissueThatTheHeaderCallsPadding)
{
  const TemporaryFolder folder;
  writeSeries(folder.path(), 2,
              [](int, TestSlice& s)
              {
                s.padding = 0; // water
                s.cell = [](int i, int j) { return i == 3 && j == 3 ? 0U : 0xFFFFU & -1000; };
              });
  std::vector<std::string> notes;
  const IntensityVolume volume = readFolder(folder.path(), {}, &notes);
  EXPECT_EQ(volume.at(3, 3, 0), 0.0);
  EXPECT_FALSE(volume.padding());
  EXPECT_EQ(notes.size(), 1U);
}

// The sum of the largest value and the intercept exceeds 32 bits (found by the sanitizer).
TEST(DicomReader, RescalesTheLargestValuesOf32Bits)
{
  for (const double slope : {1.0, 3.0})
  {
    const TemporaryFolder folder;
    writeSeries(folder.path(), 2,
                [slope](int, TestSlice& s)
                {
                  s.bitsAllocated = s.bitsStored = 32;
                  s.slope = slope;
                  s.intercept = 60000;
                  s.cell = [](int i, int) {
                    return i == 7 ? 0x7FFFFFFFU : i == 6 ? 0x80000000U : 0U;
                  };
                });
    const IntensityVolume volume = readFolder(folder.path());
    EXPECT_EQ(volume.at(7, 3, 1), static_cast<float>(slope * 2147483647.0 + 60000.0));
    EXPECT_EQ(volume.at(6, 3, 1), static_cast<float>(slope * -2147483648.0 + 60000.0));
    EXPECT_EQ(volume.at(0, 0, 0), 60000.0);
  }
}

TEST(DicomReader, CropsToTheRegionAndReadsOnlyItsSlices)
{
  const TemporaryFolder folder;
  writeSeries(folder.path(), 10,
              [](int k, TestSlice& s) { s.cell = [k](int i, int j) { return ramp(i, j, k); }; });
  const IntensityVolume whole = readFolder(folder.path());
  const ScanResult result = scanDicom(folder.path(), {});
  fs::remove(folder.path() / "s9.dcm"); // outside the region
  ReadOptions options;
  options.roi =
      core::PatientBox(Eigen::Vector3d(-9.3, 21.2, 1.1), Eigen::Vector3d(-8.5, 22.3, 2.4));
  const IntensityVolume part = readSeries(result.series.front(), options, {});
  EXPECT_EQ(part.geometry().dims(), (core::Index3{4, 4, 4}));
  for (int k = 0; k < 4; ++k)
    for (int j = 0; j < 4; ++j)
      for (int i = 0; i < 4; ++i)
      {
        const Eigen::Vector3d at = whole.geometry().voxelFromPatient(
            part.geometry().patientFromVoxel(Eigen::Vector3d(i, j, k)));
        ASSERT_NEAR(part.at(i, j, k), whole.sample(at), 1e-6);
      }
  options.roi = core::PatientBox(Eigen::Vector3d(50, 50, 50), Eigen::Vector3d(60, 60, 60));
  EXPECT_EQ(reasonOf([&] { readSeries(result.series.front(), options, {}); }),
            DicomError::Reason::OutsideRoi);
}

TEST(DicomReader, NamesTheFindingWhenItRefuses)
{
  const TemporaryFolder folder;
  writeSeries(folder.path(), 10);
  fs::remove(folder.path() / "s4.dcm");
  try
  {
    readFolder(folder.path());
    FAIL() << "read a series with a missing slice";
  }
  catch (const DicomError& error)
  {
    EXPECT_EQ(error.reason(), DicomError::Reason::Misleading);
    EXPECT_NE(std::string(error.what()).find("missing-slice"), std::string::npos) << error.what();
  }
}

TEST(DicomReader, NamesAFileThatVanishedAfterTheScan)
{
  const TemporaryFolder folder;
  writeSeries(folder.path(), 4);
  const ScanResult result = scanDicom(folder.path(), {});
  fs::resize_file(folder.path() / "s2.dcm", 400);
  EXPECT_EQ(reasonOf([&] { readSeries(result.series.front(), {}, {}); }),
            DicomError::Reason::Unreadable);
  fs::remove(folder.path() / "s2.dcm");
  EXPECT_EQ(reasonOf([&] { readSeries(result.series.front(), {}, {}); }),
            DicomError::Reason::Unreadable);
}

TEST(DicomReader, StopsWhenCancelled)
{
  const TemporaryFolder folder;
  writeSeries(folder.path(), 40);
  const ScanResult result = scanDicom(folder.path(), {});
  const auto token = std::make_shared<core::CancelToken>();
  std::atomic<int> calls{0};
  const core::Progress progress(
      [&](double, const std::string&)
      {
        if (++calls == 5)
          token->cancel();
      },
      token);
  EXPECT_THROW(readSeries(result.series.front(), {}, progress), core::CancelledError);
  EXPECT_LT(calls.load(), 20);
}

} // namespace
} // namespace petrous::imaging
