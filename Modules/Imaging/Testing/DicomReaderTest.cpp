#include "petrous/Imaging/DicomReader.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstring>

#include <gtest/gtest.h>

#include "TestDicom.h"
#include "petrous/Imaging/DicomWriter.h"

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

TEST(DicomReader, ExtendsTheSignOfTwelveBits)
{
  for (const std::uint32_t negative : {0x801U, 0xF801U}) // without copies of the sign, and with
  {
    const TemporaryFolder folder;
    writeSeries(folder.path(), 2,
                [negative](int, TestSlice& s)
                {
                  s.bitsStored = 12;
                  s.cell = [negative](int i, int) { return i == 0 ? negative : 0x7FFU; };
                });
    const IntensityVolume volume = readFolder(folder.path());
    EXPECT_EQ(volume.at(0, 0, 0), -2047.0) << negative;
    EXPECT_EQ(volume.at(1, 0, 0), 2047.0);
  }
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

// Some writers end each value with a backslash; two values are none.
TEST(DicomReader, ANumberMayEndWithABackslash)
{
  const TemporaryFolder folder;
  writeSeries(folder.path(), 3,
              [](int, TestSlice& s)
              {
                s.slope.reset();
                s.element(s.extraPixel, 0x00281052, "DS", "7\\");
                s.element(s.extraPixel, 0x00281053, "DS", "2\\");
                s.cell = [](int i, int) { return static_cast<std::uint32_t>(i); };
              });
  EXPECT_EQ(readFolder(folder.path()).at(5, 2, 1), 17.0);
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

// In a slice that wrongly says so air would be metal.
TEST(DicomReader, RefusesOneUnsignedSliceAmongSignedOnesWhereThatMakesAirMetal)
{
  for (const int air : {-1000, 0})
  {
    const TemporaryFolder folder;
    writeSeries(folder.path(), 4,
                [air](int k, TestSlice& s)
                {
                  s.isSigned = k != 2;
                  s.cell = [air, k](int i, int j)
                  { return i == 0 ? 0xFFFFU & static_cast<unsigned>(air) : ramp(i, j, k); };
                });
    std::vector<std::string> notes;
    if (air < 0)
    {
      try
      {
        readFolder(folder.path());
        ADD_FAILURE() << "a slice of 64536 HU";
      }
      catch (const DicomError& error)
      {
        EXPECT_EQ(error.reason(), DicomError::Reason::Misleading); // as the scan says
        const std::string why = error.what();
        EXPECT_NE(why.find("6 values would be another one"), why.npos) << why; // a column
        EXPECT_NE(why.find("Pixel Representation"), why.npos) << why;
      }
      continue;
    }
    EXPECT_EQ(readFolder(folder.path(), {}, &notes).at(3, 2, 2), ramp(3, 2, 2));
    ASSERT_EQ(notes.size(), 1U);
    EXPECT_NE(notes[0].find("Of 4 slices 1 says"), notes[0].npos) << notes[0];
  }
}

// The other way round bone would be air; a rescale of its own says how a slice is meant.
TEST(DicomReader, RefusesOneSignedSliceAmongUnsignedOnesUnlessItIsRescaledByItself)
{
  for (const bool isRescaled : {false, true})
  {
    const TemporaryFolder folder;
    writeSeries(folder.path(), 4,
                [isRescaled](int k, TestSlice& s)
                {
                  s.isSigned = k == 2;
                  s.bitsStored = 12;
                  s.intercept = isRescaled && k == 2 ? 0.0 : -1024.0;
                  s.cell = [k](int i, int j) { return k == 2 && i == 0 ? 0xFF00U : ramp(i, j, k); };
                });
    ReadOptions options;
    options.repair = isRescaled; // consent to a mixed rescale
    if (!isRescaled)
      EXPECT_THROW(readFolder(folder.path()), DicomError);
    else
      EXPECT_EQ(readFolder(folder.path(), options).at(0, 2, 2), -256.0);
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

TEST(DicomReader, RefusesWhatDoesNotFitTheMemoryBeforeItIsRead)
{
  const TemporaryFolder folder;
  writeSeries(folder.path(), 10);
  const ScanResult result = scanDicom(folder.path(), {});
  const DicomSeries& series = result.series.front();
  const std::size_t bytes = 2 * series.geometry.grid->fullBox().count();
  ReadOptions options;
  options.memory = bytes;
  EXPECT_NO_THROW(readSeries(series, options, {}));
  EXPECT_TRUE(mayFitMemory(series, bytes));
  EXPECT_FALSE(mayFitMemory(series, bytes - 1));
  options.memory = bytes - 1;
  for (int k = 0; k < 10; ++k)
    fs::remove(folder.path() / ("s" + std::to_string(k) + ".dcm")); // none is read
  EXPECT_EQ(reasonOf([&] { readSeries(series, options, {}); }), DicomError::Reason::TooLarge);
  options.memory = 0; // what this machine has is enough
  EXPECT_EQ(reasonOf([&] { readSeries(series, options, {}); }), DicomError::Reason::Unreadable);

  writeSeries(folder.path(), 10);
  const ScanResult again = scanDicom(folder.path(), {});
  options.memory = bytes / 2;
  options.roi =
      core::PatientBox(Eigen::Vector3d(-9.3, 21.2, 1.1), Eigen::Vector3d(-8.5, 22.3, 2.4));
  EXPECT_NO_THROW(readSeries(again.series.front(), options, {}));
}

TEST(DicomReader, CountsTheBytesThatVoxelsTakeInTheEnd)
{
  // 32-bit values: as 16 bits if these hold them, else as float, which takes twice as much.
  for (const bool isLarge : {false, true})
  {
    const TemporaryFolder folder;
    writeSeries(folder.path(), 10,
                [isLarge](int, TestSlice& slice)
                {
                  slice.bitsAllocated = slice.bitsStored = 32;
                  slice.cell = [isLarge](int i, int) { return isLarge && i == 3 ? 70000U : 9U; };
                });
    const ScanResult result = scanDicom(folder.path(), {});
    const DicomSeries& series = result.series.front();
    const std::size_t count = series.geometry.grid->fullBox().count();
    ReadOptions options;
    options.memory = (isLarge ? 4 : 2) * count;
    EXPECT_EQ(readSeries(series, options, {}).at(3, 0, 0), isLarge ? 70000.0 : 9.0);
    --options.memory;
    EXPECT_EQ(reasonOf([&] { readSeries(series, options, {}); }), DicomError::Reason::TooLarge);
  }
}

TEST(DicomWriter, WritesFractionsWithARescaleAndStatesTheError)
{
  struct Case
  {
    const char* name;
    std::function<float(std::size_t n)> value;
    bool isExact;
  };
  const Case cases[] = {
      {"halves", [](std::size_t n) { return -1024.0F + 0.5F * static_cast<float>(n); }, true},
      {"sixteenths", [](std::size_t n) { return 3.0F + static_cast<float>(n) / 16.0F; }, true},
      {"thirds", [](std::size_t n) { return static_cast<float>(n) / 3.0F - 100.0F; }, false},
      {"small", [](std::size_t n) { return 1e-4F * std::sqrt(static_cast<float>(n)); }, false},
      {"one value", [](std::size_t) { return 0.3F; }, false}};
  for (const Case& one : cases)
    for (const bool isCt : {false, true})
    {
      SCOPED_TRACE(one.name);
      auto voxels = std::make_shared<volume::Volume<float>>(
          core::GridGeometry({7, 6, 5}, Eigen::Vector3d(0.5, 0.5, 1.0), Eigen::Vector3d(1, 2, 3)));
      for (std::size_t n = 0; n < voxels->size(); ++n)
        voxels->data()[n] = one.value(n);
      const auto stored = storedFractions(*voxels);
      ASSERT_TRUE(stored);
      SeriesDescription series;
      series.modality = isCt ? SeriesDescription::Modality::Ct : SeriesDescription::Modality::Mr;
      series.studyUid = "1.2.3";
      series.seriesUid = "1.2.3.4";
      series.frameOfReferenceUid = "1.2.3.5";
      series.rescaleSlope = stored->slope;
      series.rescaleIntercept = stored->intercept;
      const TemporaryFolder folder;
      writeDicomSeries(folder.path(),
                       IntensityVolume(std::shared_ptr<const volume::Volume<float>>(voxels)),
                       series);
      const ScanResult result = scanDicom(folder.path(), {});
      ASSERT_EQ(result.series.size(), 1U);
      const IntensityVolume image = readSeries(result.series.front(), {}, {});
      double worst = 0.0;
      for (int k = 0; k < 5; ++k)
        for (int j = 0; j < 6; ++j)
          for (int i = 0; i < 7; ++i)
            worst = std::max(
                worst, std::abs(image.at(i, j, k) - static_cast<double>(voxels->at(i, j, k))));
      const auto [low, high] = std::minmax_element(voxels->data(), voxels->data() + voxels->size());
      const double range = static_cast<double>(*high) - static_cast<double>(*low);
      const double digits = 6e-8 * std::max(std::abs(static_cast<double>(*low)),
                                            std::abs(static_cast<double>(*high))); // of a float
      EXPECT_LE(worst, (one.isExact ? 0.0 : 0.5 * range / 65535.0 * 1.001 + digits));
      EXPECT_NEAR(stored->error, worst, digits + 1e-12);
    }
  volume::Volume<float> odd(core::GridGeometry({2, 2, 2}, {1, 1, 1}, {0, 0, 0}), 0.5F);
  odd.at(1, 1, 1) = std::nanf("");
  EXPECT_FALSE(storedFractions(odd));
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

TEST(DicomReader, RefusesAFileThatWasReplacedAfterTheScan)
{
  const TemporaryFolder folder;
  const auto value = [](std::uint32_t number)
  { return [number](int, TestSlice& s) { s.cell = [number](int, int) { return number; }; }; };
  writeSeries(folder.path(), 3, value(7));
  const ScanResult result = scanDicom(folder.path(), {});
  const auto readAgain = [&] { return readSeries(chooseSeries(result, folder.path()), {}, {}); };
  EXPECT_EQ(readAgain().at(0, 0, 1), 7.0);
  // The same header with other pixels, and the same size: another slice under this name.
  writeSeries(folder.path() / "other", 3, value(9));
  fs::rename(folder.path() / "other" / "s1.dcm", folder.path() / "s1.dcm");
  try
  {
    readAgain();
    FAIL() << "read";
  }
  catch (const DicomError& error)
  {
    EXPECT_EQ(error.reason(), DicomError::Reason::Unreadable);
    EXPECT_NE(std::string(error.what()).find("s1.dcm was changed"), std::string::npos)
        << error.what();
  }
}

TEST(DicomReader, ReadsAFileWhoseRightsAloneWereChanged)
{
  const TemporaryFolder folder;
  writeSeries(folder.path(), 2);
  const ScanResult result = scanDicom(folder.path(), {});
  fs::permissions(folder.path() / "s1.dcm", fs::perms::owner_read | fs::perms::owner_write);
  EXPECT_NO_THROW(readSeries(chooseSeries(result, folder.path()), {}, {}));
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

/// An enhanced MR written by PS3.3 C.7.6.16: two echoes of `slices` slices, frames in no order,
/// orientation and spacing shared, position, echo and rescale per frame.
void writeEnhanced(const fs::path& file, int slices, bool implicitVr,
                   const std::string& sopClass = "1.2.840.10008.5.1.4.1.1.4.1")
{
  TestSlice s;
  s.implicitVr = implicitVr;
  s.sopClass = sopClass;
  s.modality = "MR";
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
  const int frames = 2 * slices;
  std::string perFrame;
  std::string data;
  for (int f = 0; f < frames; ++f)
  {
    const int n = (f * 7 + 3) % frames; // 7 and the number of frames have no common factor
    const int echo = n / slices;
    const int k = n % slices;
    perFrame += item(
        group(0x00209113, [&](std::string& out)
              { s.element(out, 0x00200032, "DS", "-10\\20.5\\" + core::fixedText(0.5 * k, 2)); }) +
        group(0x00189114,
              [&](std::string& out)
              {
                const double time = 10.0 * (echo + 1);
                std::string bytes(sizeof time, '\0');
                std::memcpy(bytes.data(), &time, sizeof time);
                s.element(out, 0x00189082, "FD", bytes);
              }) +
        group(0x00289145,
              [&](std::string& out)
              {
                s.element(out, 0x00281052, "DS", echo == 0 ? "0" : "-1000");
                s.element(out, 0x00281053, "DS", echo == 0 ? "1" : "2");
              }));
    for (int j = 0; j < s.rows; ++j)
      for (int i = 0; i < s.columns; ++i)
        s.append(data, ramp(i, j, k), 2);
  }
  std::string all = s.bytes();
  s.element(all, 0x00280008, "IS", std::to_string(frames));
  s.element(all, 0x52009229, "SQ",
            item(group(0x00289110,
                       [&](std::string& out) { s.element(out, 0x00280030, "DS", "0.7\\0.6"); }) +
                 group(0x00209116, [&](std::string& out)
                       { s.element(out, 0x00200037, "DS", "0\\1\\0\\-1\\0\\0"); })));
  s.element(all, 0x52009230, "SQ", perFrame);
  s.element(all, 0x7fe00010, "OW", data);
  test::writeText(file, all);
}

TEST(DicomReader, ReadsTheStacksOfAnEnhancedMr)
{
  for (const bool implicitVr : {false, true})
  {
    const TemporaryFolder folder;
    writeEnhanced(folder.path() / "e.dcm", 5, implicitVr);
    const ScanResult result = scanDicom(folder.path(), {});
    ASSERT_EQ(result.series.size(), 2U);
    for (int echo = 0; echo < 2; ++echo)
    {
      const DicomSeries& series =
          chooseSeries(result, folder.path(), echo == 0 ? "#echo time 10" : "#echo time 20");
      ASSERT_EQ(series.geometry.verdict, Verdict::Ok);
      const IntensityVolume volume = readSeries(series, {}, {});
      Eigen::Matrix3d axes;
      axes << 0, -1, 0, 1, 0, 0, 0, 0, 1;
      const GridGeometry expected({8, 6, 5}, {0.6, 0.7, 0.5}, {-10, 20.5, 0}, axes);
      EXPECT_TRUE(core::sameGrid(volume.geometry(), expected, 1e-9));
      for (int k = 0; k < 5; ++k)
        for (int j = 0; j < 6; ++j)
          for (int i = 0; i < 8; ++i)
            ASSERT_EQ(volume.at(i, j, k), echo == 0 ? ramp(i, j, k) : 2.0 * ramp(i, j, k) - 1000.0);
    }
  }
}

TEST(DicomReader, RefusesFramesThatNothingPlaces)
{
  const TemporaryFolder folder;
  writeEnhanced(folder.path() / "e.dcm", 5, false, "1.2.840.10008.5.1.4.1.1.7.3");
  const ScanResult result = scanDicom(folder.path(), {});
  ASSERT_EQ(result.series.size(), 1U);
  EXPECT_EQ(result.series.front().geometry.findings.front().kind, FindingKind::MultiFrame);
  EXPECT_THROW(readSeries(result.series.front(), {}, {}), DicomError);
}

/// A parametric map of floats (PS3.3 A.75) with these items of Real World Value Mapping.
void writeMap(const fs::path& file, const std::vector<std::string>& mappings)
{
  TestSlice s;
  s.sopClass = "1.2.840.10008.5.1.4.1.1.30";
  s.modality = "MR";
  s.bitsAllocated = 32;
  s.pixels = false;
  s.slope.reset();
  const auto sequence = [&s](std::uint32_t tag, const std::vector<std::string>& items)
  {
    std::string content;
    for (const std::string& one : items)
    {
      s.append(content, 0xfffe, 2);
      s.append(content, 0xe000, 2);
      s.append(content, static_cast<std::uint32_t>(one.size()), 4);
      content += one;
    }
    std::string out;
    s.element(out, tag, "SQ", content);
    return out;
  };
  constexpr int kFrames = 4;
  std::string orientation, measures, frames, data;
  s.element(orientation, 0x00200037, "DS", "1\\0\\0\\0\\1\\0");
  s.element(measures, 0x00280030, "DS", "1\\1");
  std::vector<std::string> places;
  for (int f = 0; f < kFrames; ++f)
  {
    std::string place;
    s.element(place, 0x00200032, "DS", "0\\0\\" + std::to_string(f));
    places.push_back(sequence(0x00209113, {place}));
    for (int n = 0; n < s.rows * s.columns; ++n)
      s.appendReal(data, 0.25F * static_cast<float>(n + f));
  }
  std::string all = s.bytes();
  s.element(all, 0x00280008, "IS", std::to_string(kFrames));
  std::string shared = sequence(0x00209116, {orientation}) + sequence(0x00289110, {measures});
  if (!mappings.empty())
    shared += sequence(0x00409096, mappings);
  all += sequence(0x52009229, {shared}) + sequence(0x52009230, places);
  s.element(all, 0x7fe00008, "OF", data);
  test::writeText(file, all);
}

TEST(DicomReader, AParametricMapSaysWhatItsValuesMean)
{
  TestSlice s;
  const auto linear = [&s](double slope, double intercept, const std::string& unit)
  {
    std::string code, item;
    s.element(code, 0x00080100, "SH", unit);
    s.element(code, 0x00080102, "SH", "UCUM");
    std::string units;
    s.append(units, 0xfffe, 2);
    s.append(units, 0xe000, 2);
    s.append(units, static_cast<std::uint32_t>(code.size()), 4);
    s.element(item, 0x004008ea, "SQ", units + code);
    for (const auto& [tag, value] : {std::pair(0x00409224U, intercept), {0x00409225U, slope}})
    {
      std::string bytes;
      s.appendReal(bytes, value);
      s.element(item, tag, "FD", bytes);
    }
    return item;
  };
  std::string table;
  s.element(table, 0x00409212, "FD", std::string(24, '\0'));
  const auto read = [](const std::vector<std::string>& mappings)
  {
    const TemporaryFolder folder;
    writeMap(folder.path() / "map", mappings);
    const ScanResult result = scanDicom(folder.path(), {});
    const SeriesGeometry& geometry = result.series.at(0).geometry;
    if (geometry.verdict != Verdict::Ok)
      return "refused: " + geometry.findings.at(0).text;
    return geometry.slices.at(0).rescaleType + " " +
           core::generalText(readSeries(result.series.at(0), {}, {}).at(3, 0, 1));
  };
  // The stored value of pixel 3 of frame 1 is 1.
  EXPECT_EQ(read({linear(2.0, 5.0, "mm2/s")}), "mm2/s 7");
  EXPECT_EQ(read({linear(1.0, -1024.0, "[hnsf'U]")}), "HU -1023");
  for (const std::vector<std::string>& silent : {std::vector<std::string>{}, {table}})
    EXPECT_NE(read(silent).find("does not say by a slope and an intercept what its values mean"),
              std::string::npos)
        << read(silent);
  EXPECT_NE(read({linear(2.0, 5.0, "mm2/s"), linear(0.001, 0.0, "um2/s")}).find("in several ways"),
            std::string::npos);
}

TEST(DicomReader, NeverCrashesOnAnEnhancedFileCutAnywhere)
{
  const TemporaryFolder folder;
  writeEnhanced(folder.path() / "e.dcm", 5, false);
  const fs::path file = folder.path() / "e.dcm";
  for (std::uintmax_t size = fs::file_size(file); size > 7; size -= 7)
  {
    fs::resize_file(file, size - 7);
    for (const DicomSeries& series : scanDicom(folder.path(), {}).series)
      EXPECT_EQ(series.geometry.verdict, Verdict::Refused);
  }
}

} // namespace
} // namespace petrous::imaging
