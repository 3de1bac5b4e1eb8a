#include "petrous/Imaging/DicomScan.h"

#include <algorithm>

#include <gtest/gtest.h>

#include "TestDicom.h"

namespace petrous::imaging
{
namespace
{

namespace fs = std::filesystem;
using test::TemporaryFolder;
using test::TestSlice;
using test::writeSeries;
using test::writeText;

std::string chooseError(const fs::path& path, DicomError::Reason reason)
{
  try
  {
    chooseSeries(scanDicom(path, {}), path);
  }
  catch (const DicomError& error)
  {
    EXPECT_EQ(error.reason(), reason) << error.what();
    EXPECT_EQ(error.fault(), core::Fault::BadInput);
    return error.what();
  }
  ADD_FAILURE() << "no error";
  return {};
}

bool has(const SeriesGeometry& series, FindingKind kind)
{
  return std::any_of(series.findings.begin(), series.findings.end(),
                     [kind](const Finding& f) { return f.kind == kind; });
}

TEST(DicomScan, FindsASeriesByContentBelowSubfolders)
{
  const TemporaryFolder folder;
  writeSeries(folder.path() / "a" / "b", 4);
  fs::rename(folder.path() / "a/b/s0.dcm", folder.path() / "a/IM000");
  writeText(folder.path() / "readme.dcm", "this is no DICOM");
  const ScanResult result = scanDicom(folder.path(), {});
  ASSERT_EQ(result.series.size(), 1U);
  const DicomSeries& series = result.series.front();
  EXPECT_EQ(series.uid, "1.2.3.4");
  EXPECT_EQ(series.modality, "CT");
  EXPECT_EQ(series.frameOfReferenceUid, "1.2.3.9");
  EXPECT_EQ(series.geometry.verdict, Verdict::Ok);
  EXPECT_EQ(series.geometry.grid->dims(), (core::Index3{8, 6, 4}));
  EXPECT_TRUE(series.geometry.grid->spacing().isApprox(Eigen::Vector3d(0.4, 0.5, 0.5), 1e-12));
  EXPECT_EQ(result.foreignFiles, 1U);
}

TEST(DicomScan, StripsControlCharactersFromTheDescription)
{
  const TemporaryFolder folder;
  writeSeries(folder.path(), 2);
  EXPECT_EQ(scanDicom(folder.path(), {}).series.front().description, "EAR [31mTEST");
}

TEST(DicomScan, ReadsImplicitBigEndianAndUnmarkedFiles)
{
  const TemporaryFolder folder;
  writeSeries(folder.path() / "i", 2,
              [](int, TestSlice& s)
              {
                s.implicitVr = true;
                s.seriesUid = "1.1";
              });
  writeSeries(folder.path() / "b", 2,
              [](int, TestSlice& s)
              {
                s.bigEndian = true;
                s.seriesUid = "1.2";
              });
  writeSeries(folder.path() / "u", 2,
              [](int, TestSlice& s)
              {
                s.marker = false;
                s.seriesUid = "1.3";
              });
  const ScanResult result = scanDicom(folder.path(), {});
  ASSERT_EQ(result.series.size(), 3U);
  for (const DicomSeries& series : result.series)
    EXPECT_EQ(series.geometry.verdict, Verdict::Ok) << series.uid;
}

TEST(DicomScan, BelievesTheBytesMoreThanTheDeclaredSyntax)
{
  const TemporaryFolder folder;
  writeSeries(folder.path(), 2, [](int, TestSlice& s) { s.syntax = "1.2.840.10008.1.2"; });
  EXPECT_EQ(scanDicom(folder.path(), {}).series.front().geometry.verdict, Verdict::Ok);
}

TEST(DicomScan, StepsOverNestedSequencesOfUndefinedLength)
{
  const std::string item("\xfe\xff\x00\xe0\xff\xff\xff\xff", 8);
  const std::string itemEnd("\xfe\xff\x0d\xe0\0\0\0\0", 8);
  const std::string sequenceEnd("\xfe\xff\xdd\xe0\0\0\0\0", 8);
  const std::string sequence("\x08\x00\x40\x11SQ\0\0\xff\xff\xff\xff", 12);
  const std::string name("\x20\x00\x0e\x00UI\x02\x00"
                         "9\x00",
                         10); // a series UID, nested
  const TemporaryFolder folder;
  writeSeries(folder.path(), 2,
              [&](int, TestSlice& s)
              {
                s.extra = sequence + item + name + sequence + item + name + itemEnd + sequenceEnd +
                          itemEnd + sequenceEnd;
              });
  const ScanResult result = scanDicom(folder.path(), {});
  ASSERT_EQ(result.series.size(), 1U);
  EXPECT_EQ(result.series.front().uid, "1.2.3.4");
  EXPECT_EQ(result.series.front().geometry.verdict, Verdict::Ok);
}

TEST(DicomScan, SurvivesSequencesNestedWithoutEnd)
{
  std::string deep;
  for (int i = 0; i < 20000; ++i)
    deep += std::string("\x08\x00\x40\x11SQ\0\0\xff\xff\xff\xff", 12) +
            std::string("\xfe\xff\x00\xe0\xff\xff\xff\xff", 8);
  const TemporaryFolder folder;
  writeSeries(folder.path(), 1, [&](int, TestSlice& s) { s.extra = deep; });
  const ScanResult result = scanDicom(folder.path(), {});
  EXPECT_EQ(result.unreadable.size(), 1U);
}

TEST(DicomScan, NamesAFileWhosePixelsAreCutShort)
{
  const TemporaryFolder folder;
  writeSeries(folder.path(), 5);
  fs::resize_file(folder.path() / "s2.dcm", fs::file_size(folder.path() / "s2.dcm") - 10);
  const ScanResult result = scanDicom(folder.path(), {});
  ASSERT_EQ(result.series.size(), 1U);
  const SeriesGeometry& geometry = result.series.front().geometry;
  EXPECT_EQ(geometry.verdict, Verdict::Refused);
  ASSERT_TRUE(has(geometry, FindingKind::Unreadable));
  EXPECT_EQ(geometry.findings.front().text, "s2.dcm is cut short.");
  EXPECT_TRUE(has(geometry, FindingKind::MissingSlice));
}

TEST(DicomScan, HoldsADamagedFileAgainstTheOnlySeriesOfItsFolder)
{
  const TemporaryFolder folder;
  writeSeries(folder.path(), 5);
  fs::resize_file(folder.path() / "s4.dcm", 190); // before the series UID
  const ScanResult result = scanDicom(folder.path(), {});
  ASSERT_EQ(result.series.size(), 1U);
  EXPECT_TRUE(has(result.series.front().geometry, FindingKind::Unreadable));
  EXPECT_TRUE(result.unreadable.empty());
}

TEST(DicomScan, NeverCrashesOnAFileCutAnywhere)
{
  const TemporaryFolder folder;
  const std::string whole = TestSlice().bytes();
  for (std::size_t length = 0; length < whole.size(); length += 3)
    writeText(folder.path() / (std::to_string(length) + ".dcm"), whole.substr(0, length));
  const ScanResult result = scanDicom(folder.path(), {});
  for (const DicomSeries& series : result.series)
    EXPECT_EQ(series.geometry.verdict, Verdict::Refused);
}

TEST(DicomScan, NeverCrashesOnSpoiltBytes)
{
  const TemporaryFolder folder;
  const std::string whole = TestSlice().bytes();
  std::uint32_t random = 12345;
  for (int trial = 0; trial < 300; ++trial)
  {
    std::string spoilt = whole;
    for (int n = 0; n < 6; ++n)
    {
      random = random * 1664525U + 1013904223U;
      spoilt[132 + (random >> 8) % (spoilt.size() - 132)] = static_cast<char>(random >> 24);
    }
    writeText(folder.path() / (std::to_string(trial) + ".dcm"), spoilt);
  }
  EXPECT_NO_THROW(scanDicom(folder.path(), {}));
}

TEST(DicomScan, CallsAnObjectWithoutPixelsNoImage)
{
  const TemporaryFolder folder;
  writeSeries(folder.path(), 2,
              [](int, TestSlice& s)
              {
                s.sopClass = "1.2.840.10008.5.1.4.1.1.88.11"; // a report
                s.pixels = false;
                s.rows = 0;
                s.columns = 0;
              });
  const ScanResult result = scanDicom(folder.path(), {});
  ASSERT_EQ(result.series.size(), 1U);
  EXPECT_TRUE(has(result.series.front().geometry, FindingKind::NotAnImage));
}

TEST(DicomScan, TellsSeriesApartAndChoosesTheOneNamed)
{
  const TemporaryFolder folder;
  writeSeries(folder.path() / "a", 3, [](int, TestSlice& s) { s.seriesUid = "1.1"; });
  writeSeries(folder.path() / "b", 3, [](int, TestSlice& s) { s.seriesUid = "1.2"; });
  const ScanResult result = scanDicom(folder.path(), {});
  EXPECT_EQ(result.series.size(), 2U);
  EXPECT_EQ(chooseSeries(result, folder.path(), "1.2").uid, "1.2");
  EXPECT_THROW(chooseSeries(result, folder.path(), "1.3"), DicomError);
  const std::string error = chooseError(folder.path(), DicomError::Reason::Ambiguous);
  EXPECT_NE(error.find("1.1"), std::string::npos);
}

TEST(DicomScan, ChoosesTheStackBesideASingleSliceScout)
{
  const TemporaryFolder folder;
  writeSeries(folder.path() / "a", 3);
  writeSeries(folder.path() / "b", 1, [](int, TestSlice& s) { s.seriesUid = "1.9"; });
  EXPECT_EQ(chooseSeries(scanDicom(folder.path(), {}), folder.path()).uid, "1.2.3.4");
}

TEST(DicomScan, SaysWhatIsWrongWithEmptyForeignAndAbsentFolders)
{
  const TemporaryFolder folder;
  EXPECT_NE(chooseError(folder.path(), DicomError::Reason::NoImages)
                .find("no DICOM image found (0 other files)"),
            std::string::npos);
  for (int i = 0; i < 12; ++i)
    writeText(folder.path() / (std::to_string(i) + ".jpg"), "\xff\xd8\xff\xe0 picture");
  EXPECT_NE(chooseError(folder.path(), DicomError::Reason::NoImages)
                .find("no DICOM image found (12 other files)"),
            std::string::npos);
  chooseError(folder.path() / "absent", DicomError::Reason::NotFound);
}

TEST(DicomScan, ReadsALinkedFolderOnceAndEndsOnALoop)
{
  const TemporaryFolder folder;
  writeSeries(folder.path() / "real", 3);
  fs::create_directory_symlink(folder.path() / "real", folder.path() / "again");
  fs::create_directory_symlink(folder.path(), folder.path() / "real" / "loop");
  fs::create_symlink(folder.path() / "absent", folder.path() / "dangling");
  const ScanResult result = scanDicom(folder.path(), {});
  ASSERT_EQ(result.series.size(), 1U);
  EXPECT_EQ(result.series.front().files, 3U);
  EXPECT_EQ(result.series.front().geometry.verdict, Verdict::Ok);
}

TEST(DicomScan, StopsWhenCancelled)
{
  const TemporaryFolder folder;
  writeSeries(folder.path(), 40);
  const auto token = std::make_shared<core::CancelToken>();
  const core::Progress progress([&](double, const std::string&) { token->cancel(); }, token);
  EXPECT_THROW(scanDicom(folder.path(), progress), core::CancelledError);
}

TEST(DicomScan, KeepsThePatientOutOfEveryMessage)
{
  const TemporaryFolder folder;
  writeSeries(folder.path(), 5, [](int k, TestSlice& s) { s.z = k == 3 ? 9.0 : 0.5 * k; });
  fs::resize_file(folder.path() / "s2.dcm", fs::file_size(folder.path() / "s2.dcm") - 10);
  testing::internal::CaptureStderr();
  testing::internal::CaptureStdout();
  const ScanResult result = scanDicom(folder.path(), {});
  std::string all = testing::internal::GetCapturedStderr();
  all += testing::internal::GetCapturedStdout();
  EXPECT_EQ(all, "");
  for (const Finding& finding : result.series.front().geometry.findings)
    EXPECT_EQ(finding.text.find("SECRET"), std::string::npos);
}

} // namespace
} // namespace petrous::imaging
