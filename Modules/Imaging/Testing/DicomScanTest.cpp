#include "petrous/Imaging/DicomScan.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <functional>
#include <map>
#include <sstream>
#include <stdexcept>

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include "TestDicom.h"
#include "petrous/Imaging/DicomReader.h"

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

TEST(DicomScan, TakesADicomdirForTheFolderThatItIndexes)
{
  const TemporaryFolder folder;
  writeSeries(folder.path() / "a", 4);
  TestSlice index;
  index.sopClass = "1.2.840.10008.1.3.10";
  index.pixels = false;
  index.write(folder.path() / "DICOMDIR");
  const ScanResult result = scanDicom(folder.path() / "DICOMDIR", {});
  ASSERT_EQ(result.series.size(), 1U);
  EXPECT_EQ(result.series.front().files, 4U);
  EXPECT_EQ(result.series.front().geometry.verdict, Verdict::Ok);
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
  // Its position says which slice is lost, so that consent can be given to interpolate it.
  EXPECT_EQ(geometry.verdict, Verdict::Repairable);
  ASSERT_TRUE(has(geometry, FindingKind::Unreadable));
  EXPECT_EQ(geometry.findings.front().text, "s2.dcm is cut short.");
  EXPECT_TRUE(has(geometry, FindingKind::MissingSlice));

  for (const char* name : {"s0.dcm", "s4.dcm"})
  {
    const TemporaryFolder other;
    writeSeries(other.path(), 5);
    fs::resize_file(other.path() / name, fs::file_size(other.path() / name) - 10);
    const ScanResult end = scanDicom(other.path(), {});
    EXPECT_EQ(end.series.front().geometry.verdict, Verdict::Refused) << name;
  }
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

/// A slice across a stack, which is taken for a scout of it.
TestSlice scoutOf(const std::string& modality)
{
  TestSlice scout;
  scout.modality = modality;
  scout.orientation = "1\\0\\0\\0\\0\\-1";
  return scout;
}

void leaveOutPixels(TestSlice& slice)
{
  slice.sopClass = "1.2.840.10008.5.1.4.1.1.88.11"; // a report
  slice.pixels = false;
  slice.rows = slice.columns = 0;
}

// Files are heard in the order of their names.
TEST(DicomScan, WhatIsNoSliceSaysNothingOfTheSeries)
{
  for (const char* modality : {"SR", "PR", "OT"})
    for (const char* name : {"a.dcm", "z.dcm"})
    {
      const TemporaryFolder folder;
      writeSeries(folder.path(), 8);
      TestSlice other = scoutOf(modality);
      if (modality != std::string("OT"))
        leaveOutPixels(other);
      std::string bytes = other.bytes();
      const std::size_t at = bytes.find("EAR ");
      ASSERT_NE(at, std::string::npos);
      writeText(folder.path() / name, bytes.replace(at, 3, "XXX"));
      const ScanResult result = scanDicom(folder.path(), {});
      ASSERT_EQ(result.series.size(), 1U) << modality << name;
      const DicomSeries& series = result.series.front();
      EXPECT_EQ(series.modality, "CT") << modality << name;
      EXPECT_EQ(series.description.find("EAR"), 0U) << modality << name;
      EXPECT_EQ(series.geometry.verdict, Verdict::Ok) << modality << name;
      EXPECT_EQ(series.geometry.slices.size(), 8U) << modality << name;
    }
  const TemporaryFolder folder;
  TestSlice report;
  report.modality = "SR";
  leaveOutPixels(report);
  report.write(folder.path() / "a.dcm");
  const ScanResult alone = scanDicom(folder.path(), {});
  ASSERT_EQ(alone.series.size(), 1U);
  EXPECT_EQ(alone.series.front().modality, "SR");
}

TEST(DicomScan, SlicesOfTwoModalitiesAreTwoVolumesOrNone)
{
  const auto scan = [](double z)
  {
    const TemporaryFolder folder;
    for (int k = 0; k < 12; ++k)
    {
      TestSlice slice;
      slice.modality = k % 2 == 0 ? "CT" : "MR";
      slice.z = 0.5 * (k / 2) + (k % 2 == 0 ? 0.0 : z);
      slice.write(folder.path() / ("s" + std::to_string(100 + k) + ".dcm"));
    }
    return scanDicom(folder.path(), {});
  };
  const ScanResult alike = scan(0.0);
  ASSERT_EQ(alike.series.size(), 2U);
  for (const std::size_t n : {0U, 1U})
  {
    const std::string modality = n == 0 ? "CT" : "MR";
    EXPECT_EQ(alike.series[n].modality, modality);
    EXPECT_EQ(alike.series[n].volume, "modality " + modality);
    EXPECT_EQ(alike.series[n].geometry.verdict, Verdict::Ok);
    EXPECT_EQ(alike.series[n].geometry.slices.size(), 6U);
  }
  const ScanResult behind = scan(3.0); // one stack without a gap
  ASSERT_EQ(behind.series.size(), 1U);
  EXPECT_EQ(behind.series.front().geometry.verdict, Verdict::Refused);
  EXPECT_TRUE(has(behind.series.front().geometry, FindingKind::MixedAcquisitions));
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

/// Six slices at each place, `values` telling the stacks apart.
ScanResult scanOf(const fs::path& folder, std::uint32_t tag, const char* vr,
                  const std::vector<std::string>& values)
{
  int file = 0;
  for (int k = 0; k < 6; ++k)
    for (const std::string& value : values)
    {
      TestSlice slice;
      slice.z = 0.5 * k;
      slice.modality = "MR";
      slice.element(slice.extra, tag, vr, value);
      slice.write(folder / ("s" + std::to_string(file++) + ".dcm"));
    }
  return scanDicom(folder, {});
}

TEST(DicomScan, ListsTheVolumesOfASeriesAndLetsTheUserChoose)
{
  struct Case
  {
    std::uint32_t tag;
    const char* vr;
    std::vector<std::string> values, names;
  };
  const Case cases[] = {
      {0x00180086, "IS", {"1", "2"}, {"echo 1", "echo 2"}},
      {0x0019100c, "IS", {"0", "500", "1000"}, {"b 0", "b 500", "b 1000"}},
      {0x00200100, "IS", {"1", "2", "3", "4"}, {"time 1", "time 2", "time 3", "time 4"}},
      {0x00181210, "SH", {"H30", "H70"}, {"kernel H30", "kernel H70"}}};
  for (const Case& one : cases)
  {
    const TemporaryFolder folder;
    const ScanResult result = scanOf(folder.path(), one.tag, one.vr, one.values);
    ASSERT_EQ(result.series.size(), one.names.size());
    for (std::size_t i = 0; i < one.names.size(); ++i)
    {
      EXPECT_EQ(result.series[i].volume, one.names[i]);
      EXPECT_EQ(result.series[i].geometry.verdict, Verdict::Ok);
      EXPECT_EQ(result.series[i].geometry.slices.size(), 6U);
      EXPECT_EQ(&chooseSeries(result, folder.path(), "#" + one.names[i]), &result.series[i]);
      EXPECT_EQ(&chooseSeries(result, folder.path(), selectorOf(result.series[i])),
                &result.series[i]);
    }
    const std::string error = chooseError(folder.path(), DicomError::Reason::Ambiguous);
    for (const std::string& name : one.names)
      EXPECT_NE(error.find("'" + name + "'"), std::string::npos) << error;
    EXPECT_THROW(chooseSeries(result, folder.path(), "1.2.3.4"), DicomError);
    EXPECT_THROW(chooseSeries(result, folder.path(), "#echo 9"), DicomError);
  }
}

TEST(DicomScan, DoesNotGuessWhichOfTwoSlicesBelongs)
{
  const TemporaryFolder folder;
  const ScanResult result = scanOf(folder.path(), 0x00180086, "IS", {"1", "1"});
  ASSERT_EQ(result.series.size(), 1U) << "copies: these files are equal";
  EXPECT_EQ(result.series.front().geometry.verdict, Verdict::Ok);
  ASSERT_EQ(result.series.front().geometry.notes.size(), 1U);
  EXPECT_NE(result.series.front().geometry.notes.front().find("6 files are copies"),
            std::string::npos);
  const TemporaryFolder other;
  writeSeries(other.path(), 12,
              [](int k, TestSlice& s)
              {
                s.z = 0.5 * (k / 2);
                s.cell = [k](int, int) { return static_cast<std::uint32_t>(k); };
              });
  const ScanResult unknown = scanDicom(other.path(), {});
  ASSERT_EQ(unknown.series.size(), 1U);
  EXPECT_EQ(unknown.series.front().geometry.verdict, Verdict::Refused);
  EXPECT_TRUE(has(unknown.series.front().geometry, FindingKind::DuplicateSlice));
}

TEST(DicomScan, DoesNotDivideASeriesOfTwoPatientsIntoVolumes)
{
  const TemporaryFolder folder;
  const ScanResult result = scanOf(folder.path(), 0x00100020, "LO", {"DOE17", "DOE18"});
  ASSERT_EQ(result.series.size(), 1U);
  EXPECT_TRUE(has(result.series.front().geometry, FindingKind::MixedPatients));
  EXPECT_EQ(result.series.front().geometry.verdict, Verdict::Refused);
}

/// A DICOMDIR by the offsets of PS3.3 F.3: SERIES records with the files of each, or IMAGE records
/// alone (uid "").
void writeIndex(const fs::path& path,
                const std::vector<std::pair<std::string, std::vector<std::string>>>& series)
{
  struct Record
  {
    std::string type, uid, file;
    std::size_t next = 0; ///< number of a record; 0: none, as the first one is never named
    std::size_t below = 0;
  };
  std::vector<Record> records{{"PATIENT", {}, {}}};
  std::size_t before = 0;
  for (const auto& [uid, files] : series)
  {
    const std::size_t parent = records.size();
    if (!uid.empty())
    {
      records.push_back({"SERIES", uid, {}});
      (before == 0 ? records[0].below : records[before].next) = parent;
      before = parent;
    }
    for (std::size_t n = 0; n < files.size(); ++n)
    {
      if (!uid.empty())
        (n == 0 ? records[parent].below : records.back().next) = records.size();
      records.push_back({"IMAGE", {}, files[n]});
    }
  }
  TestSlice index;
  std::string head = std::string(128, '\0') + "DICM";
  index.element(head, 0x00020002, "UI", "1.2.840.10008.1.3.10");
  index.element(head, 0x00020010, "UI", "1.2.840.10008.1.2.1");
  std::vector<std::size_t> offsets(records.size(), 0);
  std::string items;
  for (int round = 0; round < 2; ++round) // the offsets are known after the first
  {
    items.clear();
    for (std::size_t n = 0; n < records.size(); ++n)
    {
      constexpr std::size_t kSequenceHead = 12; // bytes
      offsets[n] = head.size() + kSequenceHead + items.size();
      const auto offset = [&](std::size_t of)
      {
        std::string bytes;
        index.append(bytes, of == 0 ? 0 : static_cast<std::uint32_t>(offsets[of]), 4);
        return bytes;
      };
      std::string record;
      index.element(record, 0x00041400, "UL", offset(records[n].next));
      index.element(record, 0x00041420, "UL", offset(records[n].below));
      index.element(record, 0x00041430, "CS", records[n].type);
      if (!records[n].file.empty())
        index.element(record, 0x00041500, "CS", records[n].file);
      if (!records[n].uid.empty())
        index.element(record, 0x0020000e, "UI", records[n].uid);
      items += std::string("\xfe\xff\x00\xe0", 4);
      index.append(items, static_cast<std::uint32_t>(record.size()), 4);
      items += record;
    }
  }
  index.element(head, 0x00041220, "SQ", items);
  writeText(path, head);
}

TEST(DicomScan, NamesWhatADicomdirListsAndIsNotThere)
{
  const TemporaryFolder folder;
  writeSeries(folder.path() / "A", 4);
  for (int k = 0; k < 4; ++k)
    fs::rename(folder.path() / "A" / ("s" + std::to_string(k) + ".dcm"),
               folder.path() / "A" / ("im" + std::to_string(k)));
  const auto scanned = [&](int listed)
  {
    std::vector<std::string> files;
    for (int k = 0; k < listed; ++k)
      files.push_back("A\\IM" + std::to_string(k));
    writeIndex(folder.path() / "DICOMDIR", {{"", files}});
    return scanDicom(folder.path(), {});
  };
  const auto whole = scanned(4);
  EXPECT_TRUE(whole.lossNotes.empty()) << "case does not count";
  EXPECT_EQ(whole.lostFiles, 0U);
  ASSERT_EQ(whole.series.size(), 1U);
  EXPECT_FALSE(has(whole.series[0].geometry, FindingKind::MissingEnd));
  const auto lost = scanned(6);
  ASSERT_EQ(lost.lossNotes.size(), 1U);
  EXPECT_NE(
      lost.lossNotes[0].find("lists 6 files, of which 2 are not there (the first is 'A/IM4')"),
      std::string::npos)
      << lost.lossNotes[0];
  EXPECT_EQ(lost.lostFiles, 2U);
  // The series whose files lie in the folder is told to be short, without a file's name.
  ASSERT_EQ(lost.series.size(), 1U);
  const SeriesGeometry& geometry = lost.series[0].geometry;
  EXPECT_EQ(geometry.verdict, Verdict::Ok);
  ASSERT_EQ(geometry.findings.size(), 1U);
  EXPECT_EQ(geometry.findings[0].kind, FindingKind::MissingEnd);
  EXPECT_NE(geometry.findings[0].text.find("2 files of the series"), std::string::npos)
      << geometry.findings[0].text;
  EXPECT_EQ(geometry.findings[0].text.find("IM4"), std::string::npos);
}

TEST(DicomScan, HoldsWhatADicomdirLostAgainstTheSeriesThatItNames)
{
  const TemporaryFolder folder;
  // Both in one folder: only the index tells whose the lost ones are.
  for (int k = 0; k < 5; ++k)
    for (const char* uid : {"1.2.3.10", "1.2.3.20"})
    {
      TestSlice slice;
      slice.seriesUid = uid;
      slice.z = 0.5 * k;
      slice.write(folder.path() / "A" / (std::string(uid).substr(6) + std::to_string(k)));
    }
  const auto names = [](const std::string& series, int count)
  {
    std::vector<std::string> files;
    for (int k = 0; k < count; ++k)
      files.push_back("A\\" + series + std::to_string(k));
    return files;
  };
  writeIndex(folder.path() / "DICOMDIR",
             {{"1.2.3.10", names("10", 5)}, {"1.2.3.20", names("20", 8)}, {"1.2.3.30", {"B\\X"}}});
  const auto result = scanDicom(folder.path(), {});
  EXPECT_EQ(result.lostFiles, 4U);
  ASSERT_EQ(result.series.size(), 2U);
  for (const DicomSeries& series : result.series)
  {
    EXPECT_EQ(series.lostFiles, series.uid == "1.2.3.20" ? 3U : 0U) << series.uid;
    EXPECT_EQ(has(series.geometry, FindingKind::MissingEnd), series.uid == "1.2.3.20");
  }
}

// As other programs keep a disc: other names and folders, and its index beside them.
TEST(DicomScan, MissesNothingThatADicomdirKnowsByAnotherName)
{
  const TemporaryFolder folder;
  for (int k = 0; k < 5; ++k)
  {
    TestSlice slice;
    slice.seriesUid = "1.2.3.10";
    slice.z = 0.5 * k;
    slice.write(folder.path() / "copied" / ("slice " + std::to_string(k)));
  }
  const auto scanned = [&](int count)
  {
    std::vector<std::string> files;
    for (int k = 0; k < count; ++k)
      files.push_back("DICOM\\I" + std::to_string(k));
    writeIndex(folder.path() / "DICOMDIR", {{"1.2.3.10", files}});
    return scanDicom(folder.path(), {});
  };
  const auto whole = scanned(5);
  EXPECT_EQ(whole.lostFiles, 0U);
  EXPECT_TRUE(whole.series.at(0).geometry.findings.empty());
  EXPECT_TRUE(whole.lossNotes.empty());
  const auto broken = scanned(7);
  EXPECT_EQ(broken.lostFiles, 2U);
  EXPECT_EQ(broken.series.at(0).lostFiles, 2U);
}

// A disc that broke off is short however many other series lie in the tree that is scanned.
TEST(DicomScan, HoldsWhatADiscLostAgainstItHoweverMuchLiesBesideIt)
{
  const TemporaryFolder folder;
  const auto write = [&](const fs::path& to, const std::string& uid, int count)
  {
    for (int k = 0; k < count; ++k)
    {
      TestSlice slice;
      slice.seriesUid = uid;
      slice.z = 0.5 * k;
      slice.write(to / ("I" + std::to_string(k)));
    }
  };
  write(folder.path() / "disc" / "DICOM", "1.2.3.10", 5);
  write(folder.path() / "other", "1.2.3.99", 20);
  std::vector<std::string> files;
  for (int k = 0; k < 8; ++k)
    files.push_back("DICOM\\I" + std::to_string(k));
  for (const std::string uid : {"1.2.3.10", ""})
  {
    writeIndex(folder.path() / "disc" / "DICOMDIR", {{uid, files}});
    const ScanResult result = scanDicom(folder.path(), {});
    EXPECT_EQ(result.lostFiles, 3U) << uid;
    ASSERT_EQ(result.series.size(), 2U);
    for (const DicomSeries& series : result.series)
      EXPECT_EQ(series.lostFiles, series.uid == "1.2.3.10" ? 3U : 0U) << series.uid;
  }
}

TEST(DicomScan, KnowsSegmentationsAndStructureSets)
{
  const TemporaryFolder folder;
  const auto write = [&](const std::string& name, const std::string& sopClass, bool hasPixels)
  {
    TestSlice file;
    file.seriesUid = "1.2." + std::to_string(name.size());
    file.sopClass = sopClass;
    file.modality = name;
    file.pixels = hasPixels;
    file.bitsAllocated = file.bitsStored = hasPixels ? 1 : 16;
    if (!hasPixels)
      file.rows = file.columns = 0;
    file.write(folder.path() / (name + ".dcm"));
  };
  write("SEG", "1.2.840.10008.5.1.4.1.1.66.4", true);
  write("RTSTRUCT", "1.2.840.10008.5.1.4.1.1.481.3", false);
  writeSeries(folder.path() / "ct", 3);
  const ScanResult result = scanDicom(folder.path(), {});
  ASSERT_EQ(result.series.size(), 3U);
  for (const DicomSeries& series : result.series)
  {
    EXPECT_EQ(std::string(kindName(series.kind)), series.modality == "SEG"  ? "segmentation"
                                                  : series.modality == "CT" ? "image"
                                                                            : "structure-set");
    if (series.modality != "CT")
    {
      EXPECT_EQ(series.geometry.verdict, Verdict::Refused) << "it is no image";
      EXPECT_TRUE(has(series.geometry, FindingKind::NotAnImage));
    }
  }
  fs::resize_file(folder.path() / "SEG.dcm", fs::file_size(folder.path() / "SEG.dcm") - 2);
  for (const DicomSeries& series : scanDicom(folder.path(), {}).series)
    if (series.modality == "SEG")
    {
      EXPECT_EQ(series.kind, SeriesKind::Image) << "damaged";
    }
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

TEST(DicomScan, DoesNotFollowAFolderLinkThatLeadsOut)
{
  const TemporaryFolder folder;
  const TemporaryFolder elsewhere;
  writeSeries(folder.path() / "mine", 3);
  writeSeries(elsewhere.path(), 3, [](int, TestSlice& s) { s.seriesUid = "9.9"; });
  fs::create_directory_symlink(elsewhere.path(), folder.path() / "out");
  fs::create_directory_symlink("..", folder.path() / "up");
  fs::create_symlink(elsewhere.path() / "s1.dcm", folder.path() / "one.dcm");
  const ScanResult result = scanDicom(folder.path(), {});
  ASSERT_EQ(result.series.size(), 2U);
  EXPECT_EQ(result.series[0].files, 3U);
  EXPECT_EQ(result.series[1].files, 1U) << "links to files are as good as files";
  ASSERT_EQ(result.notes.size(), 2U);
  EXPECT_NE(result.notes[0].find("'out' leads to a folder elsewhere"), std::string::npos);
  // A link that is given explicitly is followed.
  EXPECT_EQ(scanDicom(folder.path() / "out", {}).series.front().files, 3U);
}

// Headers are read in parts; an element may lie across the end of one, in any way.
TEST(DicomScan, ReadsHeadersOfAnyLength)
{
  const TemporaryFolder folder;
  constexpr int kLengths = 70;
  for (const std::uint32_t fillers : {36U, 200U}) // of 108 bytes each
    for (int k = 0; k < kLengths; ++k)
    {
      TestSlice slice;
      slice.seriesUid = "1.2." + std::to_string(fillers);
      slice.z = 0.5 * k;
      slice.cell = [k](int, int) { return static_cast<std::uint32_t>(k); };
      for (std::uint32_t n = 0; n < fillers; ++n)
        slice.element(slice.extra, 0x00091000 + n, "LO", std::string(100, 'x'));
      slice.element(slice.extra, 0x00091100, "UN",
                    std::string(2 * static_cast<std::size_t>(k), 'x'));
      writeText(folder.path() / (std::to_string(fillers) + "-" + std::to_string(k) + ".dcm"),
                slice.bytes());
    }
  const ScanResult result = scanDicom(folder.path(), {});
  ASSERT_EQ(result.series.size(), 2U);
  for (const DicomSeries& series : result.series)
  {
    EXPECT_EQ(series.geometry.verdict, Verdict::Ok);
    ASSERT_EQ(series.geometry.slices.size(), static_cast<std::size_t>(kLengths));
    for (std::size_t k = 0; k < series.geometry.slices.size(); ++k)
    {
      const SliceHeader& slice = series.geometry.slices[k];
      EXPECT_EQ(*slice.position, Eigen::Vector3d(-10.0, 20.5, 0.5 * static_cast<double>(k)));
      EXPECT_EQ(slice.rows, 6);
      EXPECT_EQ(slice.columns, 8);
      EXPECT_EQ(slice.frameOfReferenceUid, "1.2.3.9");
    }
    const auto voxels = std::get<std::shared_ptr<const volume::Volume<std::int16_t>>>(
        readSeries(series, {}, {}).voxels());
    for (int k = 0; k < kLengths; ++k)
      EXPECT_EQ(voxels->at(0, 0, k), k);
  }
}

// Without this file the volume would be one slice shorter, with no other indication.
TEST(DicomScan, NamesALostFirstOrLastSlice)
{
  for (const int k : {0, 4})
    for (const long bytes : {0L, 100L, 131L, 140L, -1L})
    {
      const TemporaryFolder folder;
      writeSeries(folder.path(), 5);
      const fs::path file = folder.path() / ("s" + std::to_string(k) + ".dcm");
      if (bytes >= 0)
        fs::resize_file(file, static_cast<std::uintmax_t>(bytes));
      else
      {
        fs::remove(file);
        fs::create_symlink(folder.path() / "annex" / "gone", file);
      }
      const ScanResult result = scanDicom(folder.path(), {});
      ASSERT_EQ(result.series.size(), 1U);
      const SeriesGeometry& geometry = result.series.front().geometry;
      EXPECT_EQ(geometry.verdict, Verdict::Refused) << k << ", " << bytes;
      EXPECT_TRUE(has(geometry, FindingKind::Unreadable)) << k << ", " << bytes;
      EXPECT_EQ(geometry.findings.front().text.find(file.filename().string()), 0U);
    }
}

TEST(DicomScan, LeavesWhatWasNeverASliceAlone)
{
  const TemporaryFolder folder;
  writeSeries(folder.path(), 5);
  writeText(folder.path() / "readme.dcm", "this is no DICOM");
  writeText(folder.path() / "LOCKFILE", "");
  writeText(folder.path() / "s.txt", "");
  const ScanResult result = scanDicom(folder.path(), {});
  EXPECT_EQ(result.series.front().geometry.verdict, Verdict::Ok);
  EXPECT_EQ(result.foreignFiles, 3U);
}

/// The series of a folder with eight slices, numbered from `first`, to which `spoil` adds files.
ScanResult scanNumbered(
    const std::function<void(const fs::path&)>& spoil, int first = 1,
    const std::function<void(int, TestSlice&)>& change = [](int, TestSlice&) {})
{
  const TemporaryFolder folder;
  writeSeries(folder.path(), 8,
              [&](int k, TestSlice& s)
              {
                s.element(s.extra, 0x00200013, "IS", std::to_string(first + k));
                change(k, s);
              });
  spoil(folder.path());
  ScanResult result = scanDicom(folder.path(), {});
  EXPECT_EQ(result.series.size(), 1U);
  return result;
}

// The numbers say that the stack is whole, unless the file was the slice after the last.
void putNumber(TestSlice& slice, int number, int declared = 0)
{
  slice.element(slice.extra, 0x00200013, "IS", std::to_string(number));
  if (declared > 0)
    slice.element(slice.extra, 0x00201002, "IS", std::to_string(declared));
}

/// A series sent twice, with new instance UIDs and equal numbers.
void writeTwice(const fs::path& folder, int times, const std::function<bool(int k, int n)>& isOther)
{
  for (int n = 0; n < times; ++n)
    for (int k = 0; k < 12; ++k)
    {
      TestSlice slice;
      slice.z = 0.5 * k;
      slice.element(slice.extra, 0x00080018, "UI", "1.2.3.5." + std::to_string(100 * n + k));
      slice.element(slice.extra, 0x00200013, "IS", std::to_string(k + 1));
      slice.cell = [k, isLast = isOther(k, n)](int i, int j)
      { return static_cast<std::uint32_t>(i + 10 * j + 100 * k + (isLast && i == 7 ? 1 : 0)); };
      slice.write(folder / ("s" + std::to_string(100 * n + k) + ".dcm"));
    }
}

TEST(DicomScan, RepairsASeriesThatCameTwiceIfItsPixelsAreEqual)
{
  for (const int times : {2, 3})
  {
    const TemporaryFolder folder;
    writeTwice(folder.path(), times, [](int, int) { return false; });
    const ScanResult result = scanDicom(folder.path(), {});
    ASSERT_EQ(result.series.size(), 1U);
    const SeriesGeometry& geometry = result.series.front().geometry;
    EXPECT_EQ(geometry.verdict, Verdict::Repairable);
    ASSERT_EQ(geometry.findings.size(), 1U);
    EXPECT_EQ(geometry.findings[0].kind, FindingKind::DuplicateSlice);
    EXPECT_NE(geometry.findings[0].text.find("equal pixels"), std::string::npos);
    ReadOptions options;
    options.repair = true;
    const volume::IntensityVolume image = readSeries(result.series.front(), options, {});
    ASSERT_EQ(image.geometry().dims(), (core::Index3{8, 6, 12}));
    for (int k = 0; k < 12; ++k)
      EXPECT_EQ(image.at(7, 5, k), 57 + 100 * k);
  }
  const TemporaryFolder other;
  writeTwice(other.path(), 2, [](int k, int n) { return n == 1 && k == 11; });
  const ScanResult result = scanDicom(other.path(), {});
  ASSERT_EQ(result.series.size(), 1U);
  EXPECT_EQ(result.series.front().geometry.verdict, Verdict::Refused) << "one pixel of a slice";
}

TEST(DicomScan, SplitsTiltsIntoStacksAndSetsTheRestAside)
{
  const auto write = [](const fs::path& folder, double degrees, int count, double z0)
  {
    static int file = 0;
    const double a = degrees * M_PI / 180.0;
    for (int k = 0; k < count; ++k)
    {
      TestSlice slice;
      slice.z = z0 + 0.5 * k;
      slice.columns = slice.rows = 64; // large enough for the tilt to show
      slice.orientation =
          "1\\0\\0\\0\\" + core::fixedText(std::cos(a), 6) + "\\" + core::fixedText(std::sin(a), 6);
      slice.cell = [degrees, k](int, int)
      { return static_cast<std::uint32_t>(100.0 + degrees + k); };
      putNumber(slice, ++file);
      slice.write(folder / ("s" + std::to_string(file) + ".dcm"));
    }
  };
  const TemporaryFolder folder;
  write(folder.path(), -10.0, 14, 0.0);
  write(folder.path(), 12.0, 9, 20.0);
  write(folder.path(), 4.0, 2, 40.0);
  const ScanResult result = scanDicom(folder.path(), {});
  ASSERT_EQ(result.series.size(), 3U);
  const std::size_t sizes[] = {14, 9, 2};
  for (std::size_t n = 0; n < 3; ++n)
  {
    const DicomSeries& series = result.series[n];
    ASSERT_EQ(series.geometry.slices.size(), sizes[n]) << series.volume;
    if (n == 2)
    {
      EXPECT_EQ(series.geometry.verdict, Verdict::Refused);
      EXPECT_NE(series.volume.find("set aside"), std::string::npos) << series.volume;
      continue;
    }
    EXPECT_EQ(series.volume, n == 0 ? "axial, tilt -10.0" : "axial, tilt 12.0");
    EXPECT_EQ(series.geometry.verdict, Verdict::Repairable);
    ASSERT_EQ(series.geometry.findings.size(), 1U);
    EXPECT_EQ(series.geometry.findings[0].kind, FindingKind::GantryTilt);
    const double slide = 0.5 * (static_cast<double>(sizes[n]) - 1.0) *
                         std::sin((n == 0 ? 10.0 : 12.0) * M_PI / 180.0);
    EXPECT_NEAR(series.geometry.findings[0].errorMm, 0.5 * slide, 1e-3);
    ASSERT_FALSE(series.geometry.notes.empty());
    EXPECT_NE(series.geometry.notes.back().find("2 slices of the series are turned"),
              std::string::npos);
    ReadOptions options;
    options.repair = true;
    const volume::IntensityVolume image = readSeries(series, options, {});
    ASSERT_EQ(image.geometry().dims()[2], static_cast<int>(sizes[n]));
    for (int k = 0; k < image.geometry().dims()[2]; ++k)
      EXPECT_EQ(image.at(32, 32, k), (n == 0 ? 90 : 112) + k);
  }
}

/// The centre of mass of what is brighter than 0, and its distance from `mark` in voxels.
double distanceInVoxels(const volume::IntensityVolume& image, const Eigen::Vector3d& mark)
{
  const core::GridGeometry& grid = image.geometry();
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  double weight = 0.0;
  for (int k = 0; k < grid.dims()[2]; ++k)
    for (int j = 0; j < grid.dims()[1]; ++j)
      for (int i = 0; i < grid.dims()[0]; ++i)
      {
        sum += image.at(i, j, k) * grid.patientFromVoxel(Eigen::Vector3d(i, j, k));
        weight += image.at(i, j, k);
      }
  return (sum / weight - mark).norm() / grid.minSpacing();
}

// Parallel slices that slide forwards and then backwards; each stretch has a landmark of its own.
// Repair straightens the whole, but not across a gap in which too many slices are missing.
TEST(DicomScan, DividesAVShapedTiltOnlyWhereTheWholeIsRefused)
{
  struct Lean
  {
    double lower, upper; // degrees
  };
  for (const double gap : {0.0, 9.0})
    for (const auto& [lower, upper] :
         {Lean{20.0, -20.0}, {12.0, -7.0}, {-15.0, 0.0}, {6.0, 25.0}, {3.0, -3.0}})
    {
      if (gap > 0.0 && lower == 3.0)
        continue;
      constexpr int kHalf = 24;
      const auto tangent = [](double degrees) { return std::tan(degrees * M_PI / 180.0); };
      const auto forwardOf = [&, low = lower, up = upper](double z)
      {
        const double hinge = 0.5 * (kHalf - 1);
        return tangent(low) * std::min(z, hinge) + tangent(up) * std::max(z - hinge, 0.0);
      };
      const auto centreOf = [&](double z)
      { return Eigen::Vector3d(-10.0 + 0.4 * 23.3, 20.5 + forwardOf(z) + 0.5 * 24.6, z); };
      const Eigen::Vector3d marks[] = {centreOf(5.63), centreOf(gap + 17.81)};
      const TemporaryFolder folder;
      for (int k = 0; k < 2 * kHalf; ++k)
      {
        TestSlice slice;
        slice.z = 0.5 * k + (k < kHalf ? 0.0 : gap);
        slice.y = 20.5 + forwardOf(slice.z);
        slice.columns = slice.rows = 48;
        slice.cell = [&](int i, int j)
        {
          const Eigen::Vector3d p(-10.0 + 0.4 * i, slice.y + 0.5 * j, slice.z);
          double value = 0.0;
          for (const Eigen::Vector3d& mark : marks)
            value += 20000.0 * std::exp(-(p - mark).squaredNorm() / 1.5);
          return static_cast<std::uint32_t>(std::lround(value));
        };
        putNumber(slice, k + 1);
        slice.write(folder.path() / ("s" + std::to_string(100 + k) + ".dcm"));
      }
      const ScanResult result = scanDicom(folder.path(), {});
      ReadOptions options;
      options.repair = true;
      if (gap == 0.0)
      {
        ASSERT_EQ(result.series.size(), 1U) << lower << " and " << upper;
        const DicomSeries& whole = result.series[0];
        EXPECT_EQ(whole.volume, "");
        EXPECT_EQ(whole.geometry.verdict, Verdict::Repairable);
        EXPECT_EQ(whole.geometry.slices.size(), 48U);
        const Eigen::Vector3d middle = 0.5 * (marks[0] + marks[1]); // of equal ones
        EXPECT_LT(distanceInVoxels(readSeries(whole, options, {}), middle), 0.1) << lower;
        continue;
      }
      ASSERT_EQ(result.series.size(), 2U) << lower << " and " << upper;
      std::size_t slices = 0;
      for (std::size_t n = 0; n < 2; ++n)
      {
        const DicomSeries& series = result.series[n];
        const double degrees = n == 0 ? lower : upper;
        EXPECT_EQ(series.volume, "tilt " + core::fixedText(degrees, 1));
        EXPECT_EQ(series.geometry.verdict, degrees == 0.0 ? Verdict::Ok : Verdict::Repairable);
        EXPECT_EQ(has(series.geometry, FindingKind::GantryTilt), degrees != 0.0);
        EXPECT_FALSE(has(series.geometry, FindingKind::UnevenSpacing));
        EXPECT_LT(distanceInVoxels(readSeries(series, options, {}), marks[n]), 0.1) << degrees;
        slices += series.geometry.slices.size();
      }
      EXPECT_EQ(slices, 48U) << "each slice is in one stack";
    }
}

// Two targeted reconstructions of one series: `apart` mm from each other, numbered in turn.
void writeBothEars(const fs::path& folder, double apart, double higher, bool areEqual)
{
  for (int k = 0; k < 24; ++k)
  {
    TestSlice slice;
    const bool isSecond = k % 2 == 1;
    slice.z = 0.5 * (k / 2) + (isSecond ? higher : 0.0);
    slice.y = 20.5 + (isSecond ? apart : 0.0);
    slice.cell = [=](int, int) { return areEqual ? 7U : static_cast<std::uint32_t>(100 + k); };
    putNumber(slice, k + 1);
    slice.write(folder / ("s" + std::to_string(100 + k) + ".dcm"));
  }
}

TEST(DicomScan, DividesReconstructionsBesideEachOther)
{
  for (const double higher : {0.0, 0.2})
    for (const bool areEqual : {false, true})
      for (const double apart : {80.0, 12.0})
      {
        const TemporaryFolder folder;
        writeBothEars(folder.path(), apart, higher, areEqual);
        const ScanResult result = scanDicom(folder.path(), {});
        ASSERT_EQ(result.series.size(), 2U) << apart << ", " << higher;
        for (std::size_t n = 0; n < 2; ++n)
        {
          const DicomSeries& series = result.series[n];
          EXPECT_EQ(series.volume, n == 0 ? "farther anterior" : "farther posterior");
          EXPECT_EQ(series.geometry.verdict, Verdict::Ok);
          const volume::IntensityVolume image = readSeries(series, {}, {});
          ASSERT_EQ(image.geometry().dims(), (core::Index3{8, 6, 12}));
          EXPECT_TRUE(image.geometry().origin().isApprox(
              Eigen::Vector3d(-10.0, n == 0 ? 20.5 : 20.5 + apart, n == 0 ? 0.0 : higher)));
          for (int k = 0; k < 12 && !areEqual; ++k)
            EXPECT_EQ(image.at(3, 3, k), 100 + 2 * k + static_cast<int>(n));
        }
        EXPECT_THROW(chooseSeries(result, folder.path()), DicomError) << "the user says which ear";
      }
}

// Cone beam writes places from the corner of its volume: both ears are left of the zero point.
TEST(DicomScan, NamesReconstructionsBesideEachOtherByTheOthers)
{
  for (const double first : {-90.0, -40.0, 30.0})
    for (const int count : {2, 3})
    {
      const TemporaryFolder folder;
      for (int k = 0; k < 12; ++k)
        for (int n = 0; n < count; ++n)
        {
          TestSlice slice;
          slice.z = 0.5 * k;
          slice.x = first + 60.0 * ((n + 1) % count); // not in their order
          slice.cell = [n](int, int) { return 100U + static_cast<unsigned>(n); };
          putNumber(slice, count * k + n + 1);
          slice.write(folder.path() / ("s" + std::to_string(100 + count * k + n) + ".dcm"));
        }
      const ScanResult result = scanDicom(folder.path(), {});
      ASSERT_EQ(result.series.size(), static_cast<std::size_t>(count));
      std::map<std::string, double> xOf;
      for (const DicomSeries& series : result.series)
        xOf[series.volume] = series.geometry.grid->origin()[0];
      const std::map<std::string, double> two = {{"farther right", first},
                                                 {"farther left", first + 60.0}};
      const std::map<std::string, double> three = {{"farthest right", first},
                                                   {"2 of 3 from the right", first + 60.0},
                                                   {"farthest left", first + 120.0}};
      EXPECT_EQ(xOf, count == 2 ? two : three);
    }
}

void cutHeader(const fs::path& folder)
{
  writeText(folder / "s8.dcm", TestSlice().bytes().substr(0, 190)); // before the series UID
}

TEST(DicomScan, SaysThatEndsMayBeMissing)
{
  const auto scan = [](int first, int count, int declared)
  {
    const TemporaryFolder folder;
    writeSeries(folder.path(), count,
                [&](int k, TestSlice& slice) { putNumber(slice, first + k, declared); });
    return scanDicom(folder.path(), {}).series.front().geometry;
  };
  const SeriesGeometry cut = scan(11, 50, 60);
  EXPECT_EQ(cut.verdict, Verdict::Ok);
  ASSERT_EQ(cut.findings.size(), 1U);
  EXPECT_EQ(cut.findings[0].kind, FindingKind::MissingEnd);
  EXPECT_EQ(std::string(kindName(cut.findings[0].kind)), "missing-end");
  EXPECT_NE(cut.findings[0].text.find("states 60 images, and 50 are there"), std::string::npos);
  EXPECT_NE(cut.findings[0].text.find("numbered from 11 to 60"), std::string::npos);
  const SeriesGeometry end = scan(1, 50, 60);
  ASSERT_EQ(end.findings.size(), 1U);
  EXPECT_EQ(end.findings[0].text.find("numbered"), std::string::npos);
  ASSERT_EQ(scan(7, 20, 0).findings.size(), 1U) << "by its numbers alone";
  EXPECT_TRUE(scan(1, 60, 60).findings.empty());
  EXPECT_TRUE(scan(0, 20, 0).findings.empty());
  EXPECT_TRUE(scan(101, 20, 20).findings.empty()) << "as many as stated";
}

TEST(DicomScan, SaysThatEverySecondSliceMayBeMissing)
{
  std::string notes;
  const auto said = [&notes](int step, const std::string& thickness)
  {
    const TemporaryFolder folder;
    writeSeries(folder.path(), 20,
                [&](int k, TestSlice& slice)
                {
                  slice.z = 1.0 * k;
                  slice.element(slice.extra, 0x00180050, "DS", thickness);
                  putNumber(slice, step > 0 ? 1 + step * k : 100 + step * k);
                });
    const SeriesGeometry geometry = scanDicom(folder.path(), {}).series.front().geometry;
    EXPECT_EQ(geometry.verdict, Verdict::Ok);
    notes.clear();
    for (const std::string& note : geometry.notes)
      notes += note;
    std::string between;
    for (const Finding& finding : geometry.findings)
    {
      if (finding.kind == FindingKind::MissingBetween)
        between += finding.text;
      EXPECT_TRUE(between.empty() || finding.text.find("has no gap") == std::string::npos)
          << finding.text;
    }
    return between;
  };
  for (const int step : {2, -2, 3})
  {
    const std::string text = said(step, "0.4");
    EXPECT_NE(text.find("in steps of " + std::to_string(std::abs(step))), std::string::npos)
        << text;
    EXPECT_NE(text.find("0.40 mm thick, but stand 1.00 mm apart"), std::string::npos) << text;
    EXPECT_NE(text.find("0.60 mm from each to the next were not measured"), std::string::npos)
        << text;
  }
  EXPECT_EQ(said(1, "0.4"), "") << "a scan with gaps, or numbered anew";
  EXPECT_NE(notes.find("0.40 mm thick and stand 1.00 mm apart: 0.60 mm from each"),
            std::string::npos)
      << notes;
  EXPECT_EQ(said(2, "1.0"), "") << "numbered with those of another reconstruction";
  EXPECT_EQ(notes, "");
}

// Every second slice of most of the stack is lost: its gaps are the common ones.
TEST(DicomScan, CallsNoStackWholeThatLacksEverySecondSlice)
{
  const auto scan = [](bool isNumbered, bool isNumberedOn)
  {
    const TemporaryFolder folder;
    int number = 1079;
    for (int k = 0; k < 166; ++k)
    {
      if (k > 20 && k < 146 && k % 2 == 1)
        continue;
      ++number;
      TestSlice slice;
      slice.z = 1.0 * k;
      if (isNumbered)
        putNumber(slice, isNumberedOn ? number : 1080 + k);
      slice.write(folder.path() / ("s" + std::to_string(k) + ".dcm"));
    }
    const ScanResult result = scanDicom(folder.path(), {});
    EXPECT_EQ(result.series.size(), 1U);
    return result.series.empty() ? SeriesGeometry() : result.series.front().geometry;
  };
  const auto textOf = [](const SeriesGeometry& geometry)
  {
    std::string text;
    for (const Finding& finding : geometry.findings)
      text += finding.text;
    return text;
  };
  const SeriesGeometry lost = scan(true, false);
  EXPECT_EQ(lost.verdict, Verdict::Refused);
  EXPECT_TRUE(has(lost, FindingKind::MissingSlice));
  EXPECT_NE(textOf(lost).find("63 slices are missing"), std::string::npos) << textOf(lost);
  EXPECT_EQ(textOf(lost).find("has no gap"), std::string::npos) << textOf(lost);
  const SeriesGeometry unknown = scan(false, false);
  EXPECT_EQ(unknown.verdict, Verdict::Refused);
  EXPECT_NE(textOf(unknown).find("63.0 mm of 165.0 mm"), std::string::npos) << textOf(unknown);
  EXPECT_NE(textOf(unknown).find("cannot be told"), std::string::npos) << textOf(unknown);
  const SeriesGeometry coarse = scan(true, true);
  EXPECT_EQ(coarse.verdict, Verdict::Repairable) << textOf(coarse);
  EXPECT_TRUE(has(coarse, FindingKind::UnevenSpacing));
  EXPECT_EQ(textOf(coarse).find("has no gap"), std::string::npos) << textOf(coarse);
}

// As many slices as make a stack are no scouts, however few beside another.
TEST(DicomScan, ListsAFewReformatsOfASeriesAsAVolume)
{
  for (const int coronal : {2, 3, 10})
  {
    const TemporaryFolder folder;
    int number = 0;
    writeSeries(folder.path() / "axial", 40,
                [&](int, TestSlice& slice) { putNumber(slice, ++number); });
    writeSeries(folder.path() / "coronal", coronal,
                [&](int k, TestSlice& slice)
                {
                  slice.orientation = "1\\0\\0\\0\\0\\-1";
                  slice.y = 2.0 * k;
                  slice.z = 0.0;
                  putNumber(slice, ++number);
                });
    const ScanResult result = scanDicom(folder.path(), {});
    if (coronal == 2)
    {
      ASSERT_EQ(result.series.size(), 1U);
      EXPECT_EQ(result.series[0].geometry.slices.size(), 40U);
      continue;
    }
    ASSERT_EQ(result.series.size(), 2U) << coronal;
    EXPECT_EQ(result.series[0].volume, "axial");
    EXPECT_EQ(result.series[1].volume, "coronal");
    EXPECT_EQ(result.series[1].geometry.slices.size(), static_cast<std::size_t>(coronal));
    EXPECT_EQ(result.series[1].geometry.verdict, Verdict::Ok);
  }
}

TEST(DicomScan, SaysThatAVolumeIsShorterThanItsSiblings)
{
  // slices of each phase: from and to
  const auto scan = [](const std::vector<std::pair<int, int>>& phases, int declared = 0)
  {
    const TemporaryFolder folder;
    int file = 0;
    for (std::size_t p = 0; p < phases.size(); ++p)
      for (int k = phases[p].first; k < phases[p].second; ++k)
      {
        TestSlice slice;
        slice.z = 0.5 * k;
        putNumber(slice, ++file, declared);
        slice.element(slice.extra, 0x00200100, "IS", std::to_string(p + 1));
        slice.cell = [p](int, int) { return static_cast<std::uint32_t>(p); };
        slice.write(folder.path() / ("s" + std::to_string(file) + ".dcm"));
      }
    std::vector<std::string> texts;
    for (const DicomSeries& series : scanDicom(folder.path(), {}).series)
    {
      EXPECT_EQ(series.geometry.verdict, Verdict::Ok) << series.volume;
      EXPECT_LE(series.geometry.findings.size(), 1U);
      EXPECT_TRUE(series.geometry.findings.empty() ||
                  has(series.geometry, FindingKind::MissingEnd));
      texts.push_back(series.geometry.findings.empty() ? "" : series.geometry.findings[0].text);
    }
    return texts;
  };
  const auto cut = scan({{0, 20}, {0, 17}, {2, 20}});
  ASSERT_EQ(cut.size(), 3U);
  EXPECT_EQ(cut[0], "");
  EXPECT_NE(cut[1].find("goes on for 1.5 mm (3 slices) beyond its last slice;"), std::string::npos)
      << cut[1];
  EXPECT_NE(cut[2].find("goes on for 1.0 mm (2 slices) before the first slice of this one;"),
            std::string::npos)
      << cut[2];
  const auto both = scan({{0, 18}, {2, 20}}); // each lacks what the other has
  ASSERT_EQ(both.size(), 2U);
  EXPECT_NE(both[0].find("beyond its last slice"), std::string::npos);
  EXPECT_NE(both[1].find("before the first slice"), std::string::npos);
  EXPECT_EQ(scan({{0, 20}, {0, 20}}), (std::vector<std::string>{"", ""}));
  const auto slabs = scan({{0, 20}, {14, 34}});
  EXPECT_EQ(slabs, (std::vector<std::string>{"", ""})) << "neighbours that overlap";
  EXPECT_EQ(scan({{0, 20}, {0, 20}}, 40), (std::vector<std::string>{"", ""}));
  const auto counted = scan({{0, 20}, {0, 20}}, 46);
  ASSERT_EQ(counted.size(), 2U);
  EXPECT_NE(counted[1].find("states 46 images of the series, and 40 are there"), std::string::npos)
      << counted[1];
}

TEST(DicomScan, RefusesSlicesOfOnePlaceThatShowDifferentThings)
{
  const auto scan = [](bool isOther)
  {
    const TemporaryFolder folder;
    writeSeries(folder.path(), 21,
                [&](int k, TestSlice& slice)
                {
                  slice.cell = [k](int i, int j)
                  { return static_cast<std::uint32_t>(i + 8 * j + k); };
                  if (k == 20) // again slice 4, by another writer
                  {
                    slice.z = 0.5 * 4;
                    slice.cell = [isOther](int i, int j)
                    { return static_cast<std::uint32_t>(i + 8 * j + 4 + (isOther && j == 2)); };
                  }
                  putNumber(slice, k == 20 ? 5 : k + 1);
                  slice.element(slice.extra, 0x00200011, "IS", "3"); // not byte by byte the same
                  if (k == 20)
                    slice.element(slice.extra, 0x00204000, "LT", "again");
                });
    return scanDicom(folder.path(), {}).series.front().geometry;
  };
  const SeriesGeometry same = scan(false);
  EXPECT_EQ(same.verdict, Verdict::Repairable);
  const SeriesGeometry other = scan(true);
  EXPECT_EQ(other.verdict, Verdict::Refused);
  ASSERT_EQ(other.findings.size(), 1U);
  EXPECT_EQ(other.findings[0].kind, FindingKind::DuplicateSlice);
  EXPECT_NE(other.findings[0].text.find("in up to 8 of 48 voxels"), std::string::npos)
      << other.findings[0].text; // one row of 8
}

// Of two slices at one place that differ in bits which the header calls not stored, none is left
// out: kept as the user may say, they are different values.
TEST(DicomScan, ComparesSlicesAtOnePlaceWithTheirUndeclaredBits)
{
  for (const bool isOther : {false, true})
  {
    const TemporaryFolder folder;
    writeSeries(folder.path(), 21,
                [isOther](int k, TestSlice& slice)
                {
                  const int at = k == 20 ? 4 : k; // again slice 4
                  slice.z = 0.5 * at;
                  slice.bitsStored = 12;
                  slice.isSigned = false;
                  slice.cell = [=](int i, int j)
                  {
                    const unsigned metal = isOther && k == 20 ? 0x2000U : 0x1000U;
                    return static_cast<std::uint32_t>(i + 8 * j + at) |
                           (at == 4 && i == 3 && j == 2 ? metal : 0U);
                  };
                  putNumber(slice, at + 1);
                  slice.element(slice.extra, 0x00200011, "IS", "3");
                  if (k == 20)
                    slice.element(slice.extra, 0x00204000, "LT", "again");
                });
    const SeriesGeometry geometry = scanDicom(folder.path(), {}).series.front().geometry;
    EXPECT_EQ(geometry.verdict, isOther ? Verdict::Refused : Verdict::Repairable);
    if (isOther)
    {
      EXPECT_NE(geometry.findings.at(0).text.find("in up to 1 of 48 voxels"), std::string::npos)
          << geometry.findings.at(0).text;
    }
  }
}

// Left out, the bits of these slices at one place are equal; kept, they are not, or cannot be
// compared.
TEST(DicomScan, LeavesOutNoSliceOfOnePlaceThatCannotBeCompared)
{
  enum class Other
  {
    Same,
    BigEndian,   // undeclared bits of cells that are stored otherwise
    WithoutCopy, // of the sign that the first has: -1096, or 3000
  };
  for (const Other other : {Other::Same, Other::BigEndian, Other::WithoutCopy})
  {
    const TemporaryFolder folder;
    writeSeries(folder.path(), 21,
                [other](int k, TestSlice& slice)
                {
                  const int at = k == 20 ? 4 : k; // again slice 4
                  slice.z = 0.5 * at;
                  slice.bitsStored = 12;
                  slice.isSigned = other == Other::WithoutCopy;
                  slice.bigEndian = k == 20 && other == Other::BigEndian;
                  slice.cell = [=](int i, int j)
                  {
                    const unsigned metal = other != Other::WithoutCopy ? 0x1000U
                                           : k == 20                   ? 0x0BB8U
                                                                       : 0xFBB8U;
                    return at == 4 && i == 3 && j == 2 ? metal
                                                       : static_cast<std::uint32_t>(i + 8 * j + at);
                  };
                  putNumber(slice, at + 1);
                  slice.element(slice.extra, 0x00200011, "IS", "3");
                  if (k == 20)
                    slice.element(slice.extra, 0x00204000, "LT", "again");
                });
    const SeriesGeometry geometry = scanDicom(folder.path(), {}).series.front().geometry;
    EXPECT_EQ(geometry.verdict, other == Other::Same ? Verdict::Repairable : Verdict::Refused)
        << static_cast<int>(other);
  }
}

// What is refused when it is read is not called sound before.
TEST(DicomScan, RefusesSignedSlicesAmongUnsignedOnesWhereAValueDependsOnIt)
{
  for (const bool areFewSigned : {false, true})
    for (const bool depends : {false, true})
    {
      const TemporaryFolder folder;
      writeSeries(folder.path(), 4,
                  [=](int k, TestSlice& slice)
                  {
                    slice.isSigned = (k == 2) == areFewSigned;
                    slice.cell = [=](int i, int j)
                    {
                      return depends && i == 0 && k == 2
                                 ? 0xFC18U
                                 : static_cast<std::uint32_t>(7 * (i + j + k));
                    }; // -1000
                  });
      const ScanResult result = scanDicom(folder.path(), {});
      ASSERT_EQ(result.series.size(), 1U);
      const SeriesGeometry& geometry = result.series.front().geometry;
      EXPECT_EQ(geometry.verdict, depends ? Verdict::Refused : Verdict::Ok);
      ASSERT_EQ(geometry.findings.size(), depends ? 1U : 0U);
      if (depends)
      {
        const std::string& why = geometry.findings.front().text;
        EXPECT_NE(why.find("6 values would be another one"), why.npos) << why; // a column
      }
    }
}

TEST(DicomScan, SaysThatPixelsWereCompressedWithLoss)
{
  const auto notes = [](const std::function<void(TestSlice&)>& change)
  {
    const TemporaryFolder folder;
    writeSeries(folder.path(), 4, [&](int, TestSlice& slice) { change(slice); });
    return scanDicom(folder.path(), {}).series.front().geometry.notes;
  };
  EXPECT_TRUE(notes([](TestSlice& s) { s.element(s.extra, 0x00282110, "CS", "00"); }).empty());
  const auto lossy = notes(
      [](TestSlice& s)
      {
        s.element(s.extra, 0x00282110, "CS", "01");
        s.element(s.extra, 0x00282112, "DS", "8\\12.5");
      });
  ASSERT_EQ(lossy.size(), 1U);
  EXPECT_NE(lossy[0].find("with loss"), std::string::npos);
  EXPECT_NE(lossy[0].find("1/12.5"), std::string::npos) << lossy[0];
}

TEST(DicomScan, SaysThatTextMayBeInThePixels)
{
  const auto scanned = [](const std::function<void(int, TestSlice&)>& change)
  {
    const TemporaryFolder folder;
    writeSeries(folder.path(), 4, change);
    const SeriesGeometry geometry = scanDicom(folder.path(), {}).series.front().geometry;
    EXPECT_EQ(geometry.verdict, Verdict::Ok);
    return geometry.notes;
  };
  const auto stated = scanned([](int k, TestSlice& s)
                              { s.element(s.extra, 0x00280301, "CS", k == 2 ? "YES" : "NO"); });
  ASSERT_EQ(stated.size(), 1U);
  EXPECT_NE(stated[0].find("header states text in the pixels"), std::string::npos) << stated[0];
  EXPECT_NE(stated[0].find("in 1 of"), std::string::npos) << stated[0];
  const auto suspected =
      scanned([](int, TestSlice& s) { s.element(s.extra, 0x00080064, "CS", "WSD"); });
  ASSERT_EQ(suspected.size(), 1U);
  EXPECT_NE(suspected[0].find("may be in the pixels"), std::string::npos) << suspected[0];
  EXPECT_EQ(scanned([](int, TestSlice& s) { s.modality = "OT"; }).size(), 1U);
  const auto denied = scanned(
      [](int, TestSlice& s)
      {
        s.element(s.extra, 0x00080064, "CS", "WSD");
        s.element(s.extra, 0x00280301, "CS", "NO");
      });
  EXPECT_TRUE(denied.empty());
  EXPECT_TRUE(scanned([](int, TestSlice&) {}).empty()) << "a CT that does not say";
}

TEST(DicomScan, SuspectsTextInSecondaryCapturesAndNotInClassesOfLongerNumbers)
{
  const auto ofClass = [](const std::string& number)
  { return burnedInText("", "CT", "1.2.840.10008.5.1.4.1.1." + number, "ORIGINAL", false); };
  EXPECT_EQ(ofClass("7"), BurnedInText::Suspected);
  EXPECT_EQ(ofClass("7.4"), BurnedInText::Suspected);
  EXPECT_EQ(ofClass("77.1.5.1"), BurnedInText::None); // PS3.4 B.5: ophthalmic photography
  EXPECT_EQ(ofClass("78.1"), BurnedInText::None);
  EXPECT_EQ(ofClass("2"), BurnedInText::None);
}

TEST(DicomScan, SetsABrokenOrForeignFileBesideAWholeStackAside)
{
  const std::function<void(const fs::path&)> spoilers[] = {
      cutHeader, [](const fs::path& folder) { writeText(folder / "s8.dcm", ""); },
      [](const fs::path& folder) { writeText(folder / "s8.dcm", "this is no DICOM"); },
      [](const fs::path& folder) { fs::create_symlink("gone", folder / "s8.dcm"); }};
  for (const auto& spoil : spoilers)
    for (const int first : {0, 1})
    {
      const ScanResult result = scanNumbered(spoil, first);
      const SeriesGeometry& geometry = result.series.front().geometry;
      EXPECT_EQ(geometry.verdict, Verdict::Ok);
      EXPECT_EQ(geometry.slices.size(), 8U);
      EXPECT_TRUE(geometry.findings.empty());
      ASSERT_EQ(geometry.notes.size(), 1U);
      EXPECT_NE(geometry.notes.front().find("ends 0.5 mm too early"), std::string::npos)
          << geometry.notes.front();
      EXPECT_EQ(geometry.notes.front().find("s8"), std::string::npos) << "stored with the case";
      ASSERT_EQ(result.notes.size(), 1U);
      EXPECT_EQ(result.notes.front().find("s8.dcm "), 0U);
    }
}

// A localizer may be counted with the slices or not.
TEST(DicomScan, ALocalizerBesideABrokenFileLeavesTheNumbersOfTheSlicesTheirs)
{
  const auto scan = [](int first, int ofScout, int declared)
  {
    return scanNumbered(
        [&](const fs::path& folder)
        {
          cutHeader(folder);
          TestSlice scout = scoutOf("CT");
          putNumber(scout, ofScout, declared);
          scout.write(folder / "a.dcm");
        },
        first);
  };
  struct Case
  {
    int first = 1;
    int ofScout = 0;
    int declared = 0;
    const char* note = nullptr; // no note: refused
  };
  const Case cases[] = {{1, 9, 0, "numbered 1 to 8."},
                        {1, 100, 0, "numbered 1 to 8."},
                        {1, 1, 0, "numbered 1 to 8."},
                        {2, 1, 0, "numbered 2 to 9."},
                        {1, 9, 8, "numbered 1 to 8, as many as the header states."},
                        {1, 9, 9, "numbered 1 to 8, and with what else is in the series as many"},
                        {2, 100, 0},
                        {2, 2, 0},
                        {1, 9, 10}};
  for (const Case& one : cases)
  {
    const ScanResult result = scan(one.first, one.ofScout, one.declared);
    const SeriesGeometry& geometry = result.series.front().geometry;
    const std::string what = std::to_string(one.first) + ", " + std::to_string(one.ofScout) + ", " +
                             std::to_string(one.declared);
    EXPECT_EQ(geometry.slices.size(), 8U) << what;
    EXPECT_TRUE(has(geometry, FindingKind::LocalizerMixedIn)) << what;
    EXPECT_EQ(geometry.verdict, one.note ? Verdict::Ok : Verdict::Refused) << what;
    EXPECT_EQ(has(geometry, FindingKind::Unreadable), !one.note) << what;
    const auto says = [&one](const std::string& note)
    { return one.note && note.find(one.note) != std::string::npos; };
    EXPECT_EQ(std::any_of(geometry.notes.begin(), geometry.notes.end(), says), one.note != nullptr)
        << what;
  }
}

// The numbers of one echo say nothing of the other's.
TEST(DicomScan, ABrokenFileMayBeTheFirstSliceOfOneOfTwoVolumes)
{
  const TemporaryFolder folder;
  for (int k = 0; k < 16; ++k)
    if (k != 0)
    {
      TestSlice slice;
      slice.modality = "MR";
      slice.z = 0.5 * (k / 2);
      slice.element(slice.extra, 0x00180086, "IS", std::to_string(k % 2 + 1));
      putNumber(slice, k / 2 + 1);
      slice.write(folder.path() / ("s" + std::to_string(100 + k) + ".dcm"));
    }
  writeText(folder.path() / "s100.dcm", "");
  const ScanResult result = scanDicom(folder.path(), {});
  ASSERT_EQ(result.series.size(), 2U);
  for (const DicomSeries& series : result.series)
  {
    const bool isWhole = series.geometry.slices.size() == 8;
    EXPECT_EQ(series.volume, isWhole ? "echo 2" : "echo 1");
    EXPECT_EQ(series.geometry.verdict, isWhole ? Verdict::Ok : Verdict::Refused) << series.volume;
  }
}

TEST(DicomScan, HoldsABrokenFileAgainstAStackThatItsNumbersDoNotShowToBeWhole)
{
  const auto verdictOf = [](const ScanResult& result)
  { return result.series.front().geometry.verdict; };
  const auto stating = [](const char* count)
  { return [count](int, TestSlice& s) { s.element(s.extra, 0x00201209, "IS", count); }; };
  EXPECT_EQ(verdictOf(scanNumbered(cutHeader, 1)), Verdict::Ok);
  EXPECT_EQ(verdictOf(scanNumbered(cutHeader, 2)), Verdict::Refused) << "number 1 is missing";
  EXPECT_EQ(verdictOf(scanNumbered(cutHeader, 1, stating("9"))), Verdict::Refused);
  const ScanResult counted = scanNumbered(cutHeader, 1, stating("8"));
  EXPECT_EQ(verdictOf(counted), Verdict::Ok);
  EXPECT_NE(counted.series.front().geometry.notes.front().find("as many as the header states"),
            std::string::npos);
  // Number 4 is missing, but no slice: the broken file may be it, and lie anywhere.
  EXPECT_EQ(verdictOf(scanNumbered(cutHeader, 1,
                                   [](int k, TestSlice& s)
                                   {
                                     s.extra.clear();
                                     s.element(s.extra, 0x00200013, "IS",
                                               std::to_string(k < 3 ? k + 1 : k + 2));
                                   })),
            Verdict::Refused);
  EXPECT_EQ(verdictOf(scanNumbered(
                cutHeader, 1, [](int k, TestSlice& s) { s.z = k < 4 ? 0.5 * k : 0.5 * (k + 1); })),
            Verdict::Refused)
      << "a slice is missing";
  EXPECT_EQ(verdictOf(scanNumbered(
                [](const fs::path& folder)
                {
                  cutHeader(folder);
                  writeText(folder / "s9.dcm", "");
                })),
            Verdict::Refused)
      << "a copy that failed more than once";
}

TEST(DicomScan, LeavesOutADamagedFileWhoseSliceIsThereWhole)
{
  for (const int k : {0, 3, 7})
  {
    const ScanResult result = scanNumbered(
        [k](const fs::path& folder)
        {
          const fs::path copy = folder / ("copy of s" + std::to_string(k) + ".dcm");
          fs::copy_file(folder / ("s" + std::to_string(k) + ".dcm"), copy);
          fs::resize_file(copy, fs::file_size(copy) - 10);
        });
    const SeriesGeometry& geometry = result.series.front().geometry;
    EXPECT_EQ(geometry.verdict, Verdict::Ok) << k;
    ASSERT_EQ(geometry.notes.size(), 1U);
    EXPECT_NE(geometry.notes.front().find("the same slice is there whole"), std::string::npos);
  }
}

TEST(DicomScan, NotesALostSliceThatMayBeOfSeveralSeries)
{
  const TemporaryFolder folder;
  writeSeries(folder.path(), 5);
  for (int k = 5; k < 9; ++k)
  {
    TestSlice slice;
    slice.z = k;
    slice.seriesUid = "7.7";
    slice.write(folder.path() / ("s" + std::to_string(k) + ".dcm"));
  }
  writeText(folder.path() / "s9.dcm", "");
  const ScanResult result = scanDicom(folder.path(), {});
  EXPECT_EQ(result.unreadable.size(), 1U);
  ASSERT_EQ(result.notes.size(), 1U);
  EXPECT_EQ(result.notes.front().find("s9.dcm is empty"), 0U);
  for (const DicomSeries& series : result.series)
  {
    EXPECT_EQ(series.geometry.verdict, Verdict::Refused) << "nobody knows that it is whole";
    EXPECT_TRUE(has(series.geometry, FindingKind::Unreadable));
  }
}

TEST(DicomScan, ALostSliceSaysNothingOfASeriesInAnotherFolder)
{
  const TemporaryFolder folder;
  writeSeries(folder.path() / "whole", 5);
  writeSeries(folder.path() / "a", 5, [](int, TestSlice& s) { s.seriesUid = "7.7"; });
  for (int k = 5; k < 9; ++k)
  {
    TestSlice slice;
    slice.z = k;
    slice.seriesUid = "8.8";
    slice.write(folder.path() / "a" / ("s" + std::to_string(k) + ".dcm"));
  }
  writeText(folder.path() / "a" / "s9.dcm", "");
  for (const DicomSeries& series : scanDicom(folder.path(), {}).series)
    EXPECT_EQ(series.geometry.verdict == Verdict::Ok, series.uid != "7.7" && series.uid != "8.8")
        << series.uid;
}

/// Runs as a user to whom file permissions apply.
class AsNobody
{
public:
  AsNobody()
    : m_before(::geteuid())
  {
    if (m_before == 0 && ::seteuid(65534) != 0)
      throw std::runtime_error("cannot become another user");
  }
  ~AsNobody()
  {
    if (m_before == 0 && ::seteuid(0) != 0)
      std::abort();
  }
  AsNobody(const AsNobody&) = delete;
  AsNobody& operator=(const AsNobody&) = delete;

private:
  uid_t m_before;
};

TEST(DicomScan, SaysThatASubfolderMayNotBeRead)
{
  const TemporaryFolder folder;
  writeSeries(folder.path() / "a", 3);
  writeSeries(folder.path() / "b", 3);
  fs::permissions(folder.path(), fs::perms::all);
  const auto scanWith = [&folder](fs::perms rights)
  {
    fs::permissions(folder.path() / "b", rights);
    ScanResult result;
    {
      const AsNobody user;
      result = scanDicom(folder.path(), {});
    }
    fs::permissions(folder.path() / "b", fs::perms::all);
    return result;
  };
  const ScanResult namesOnly = scanWith(fs::perms::others_read | fs::perms::owner_read);
  ASSERT_EQ(namesOnly.unreadable.size(), 1U);
  EXPECT_EQ(namesOnly.series.front().geometry.verdict, Verdict::Refused);
  const ScanResult result = scanWith(fs::perms::none);
  ASSERT_EQ(result.series.size(), 1U);
  ASSERT_EQ(result.unreadable.size(), 1U);
  EXPECT_NE(result.unreadable.front().text.find("'b' may not be read"), std::string::npos);
  EXPECT_EQ(result.series.front().geometry.verdict, Verdict::Refused) << "'b' may hold more of it";
  EXPECT_TRUE(has(result.series.front().geometry, FindingKind::Unreadable));
  ASSERT_EQ(result.notes.size(), 1U);
}

TEST(DicomScan, NeverWaitsForAPipe)
{
  const TemporaryFolder folder;
  writeSeries(folder.path(), 3);
  ASSERT_EQ(::mkfifo((folder.path() / "s3.dcm").c_str(), 0600), 0);
  const ScanResult result = scanDicom(folder.path(), {});
  EXPECT_EQ(result.series.front().files, 3U);
  ASSERT_EQ(result.notes.size(), 1U);
  EXPECT_NE(result.notes.front().find("not an ordinary file"), std::string::npos);
  EXPECT_THROW(scanDicom(folder.path() / "s3.dcm", {}), DicomError);
  EXPECT_THROW(scanDicom("/dev/zero", {}), DicomError);
}

/// The kinds of findings for six slices, each modified by `change`.
std::vector<FindingKind> kindsOf(const std::function<void(int, TestSlice&)>& change)
{
  const TemporaryFolder folder;
  writeSeries(folder.path(), 6, change);
  const ScanResult result = scanDicom(folder.path(), {});
  std::vector<FindingKind> kinds;
  for (const DicomSeries& series : result.series)
    for (const Finding& finding : series.geometry.findings)
    {
      kinds.push_back(finding.kind);
      EXPECT_EQ(finding.text.find("DOE"), std::string::npos) << finding.text;
    }
  EXPECT_EQ(result.series.size(), 1U);
  return kinds;
}

using Kinds = std::vector<FindingKind>;

TEST(DicomScan, TellsPatientsOfOneSeriesApart)
{
  const auto blocks = [](std::uint32_t tag, const char* vr, const char* one, const char* other) {
    return kindsOf([=](int k, TestSlice& s) { s.element(s.extra, tag, vr, k < 4 ? one : other); });
  };
  const Kinds patients{FindingKind::MixedPatients};
  EXPECT_EQ(blocks(0x00100020, "LO", "DOE17", "DOE18"), patients);
  EXPECT_EQ(blocks(0x00100030, "DA", "19500101", "19500102"), patients);
  EXPECT_EQ(blocks(0x00100020, "LO", "DOE17", ""), Kinds());
  EXPECT_EQ(blocks(0x00100020, "LO", "DOE17", "doe17 "), Kinds());
  EXPECT_EQ(kindsOf([](int k, TestSlice& s) { s.studyUid = k < 4 ? "1.2.3" : "1.2.4"; }),
            Kinds{FindingKind::MixedStudies});
  // Without a UID, the objects of a folder are treated as one series.
  EXPECT_EQ(kindsOf(
                [](int k, TestSlice& s)
                {
                  s.seriesUid.clear();
                  s.element(s.extra, 0x00100020, "LO", k % 2 == 0 ? "DOE17" : "DOE18");
                })
                .front(),
            FindingKind::MixedPatients);
  EXPECT_EQ(kindsOf([](int, TestSlice& s) { s.seriesUid.clear(); }), Kinds());
}

TEST(DicomScan, TellsAcquisitionsAndKernelsApart)
{
  const auto with = [](std::uint32_t tag, const char* vr, const std::vector<std::string>& values,
                       const std::string& modality = "CT", const std::string& thickness = "")
  {
    return kindsOf(
        [=](int k, TestSlice& s)
        {
          s.modality = modality;
          s.element(s.extra, tag, vr, values[static_cast<std::size_t>(k)]);
          if (!thickness.empty())
            s.element(s.extra, 0x00180050, "DS", thickness);
        });
  };
  const Kinds mixed{FindingKind::MixedAcquisitions};
  // Each of the two fills the gaps of the other: the stack is evenly spaced at half the spacing.
  EXPECT_EQ(with(0x00200012, "IS", {"1", "2", "1", "2", "1", "2"}), mixed);
  EXPECT_EQ(with(0x00200012, "IS", {"1", "1", "2", "2", "1", "1"}), mixed);
  EXPECT_EQ(with(0x00200012, "IS", {"1", "1", "1", "2", "2", "2"}), Kinds()) << "steps";
  EXPECT_EQ(with(0x00200012, "IS", {"6", "5", "4", "3", "2", "1"}), Kinds()) << "steps";
  EXPECT_EQ(with(0x00200012, "IS", {"1", "2", "1", "2", "1", "2"}, "MR", "0.5"), Kinds());
  EXPECT_EQ(with(0x00200012, "IS", {"1", "2", "1", "2", "1", "2"}, "MR", "1.0"), mixed);
  EXPECT_EQ(with(0x00181210, "SH", {"H30", "H70", "H30", "H70", "H30", "H70"}), mixed);
  EXPECT_EQ(with(0x00181210, "SH", {"H30", "H30", "H30", "H30", "H30", "H70"}), mixed);
  EXPECT_EQ(with(0x00181210, "SH", {"H30", "H30", "H30", "H30", "H30", "H30"}), Kinds());
  EXPECT_EQ(with(0x00180060, "DS", {"80", "140", "80", "140", "80", "140"}), mixed);
  EXPECT_EQ(with(0x00180060, "DS", {"120", "120.0", "120", "120", "120", "120"}), Kinds());
  EXPECT_EQ(with(0x00200011, "IS", {"3", "3", "3", "4", "4", "4"}), mixed);
}

TEST(DicomScan, NotesAPartThatWasScannedLater)
{
  const auto notesWith = [](const char* second, const char* number, const std::string& modality)
  {
    const TemporaryFolder folder;
    writeSeries(folder.path(), 6,
                [=](int k, TestSlice& s)
                {
                  s.modality = modality;
                  s.element(s.extra, 0x00080022, "DA", "20200131");
                  s.element(s.extra, 0x00080032, "TM", k < 4 ? "100059" : second);
                  s.element(s.extra, 0x00200012, "IS", k < 4 ? "1" : number);
                });
    const ScanResult scan = scanDicom(folder.path(), {});
    std::string all;
    for (const std::string& note : scan.series.at(0).geometry.notes)
      all += note;
    return all;
  };
  const std::string told = notesWith("113000", "2", "CT");
  EXPECT_NE(told.find("Slices 4 and 5 were acquired 90 minutes apart"), told.npos) << told;
  EXPECT_EQ(told.find("2020"), told.npos) << "no date";
  EXPECT_EQ(notesWith("100200", "2", "CT").find("minutes apart"), told.npos) << "in steps";
  EXPECT_EQ(notesWith("113000", "1", "CT").find("minutes apart"), told.npos) << "one acquisition";
  EXPECT_EQ(notesWith("113000", "2", "MR").find("minutes apart"), told.npos) << "slabs";
}

TEST(DicomScan, RefusesAModalityLut)
{
  const std::string item("\xfe\xff\x00\xe0\x00\x00\x00\x00", 8);
  const std::string itemEnd("\xfe\xff\xdd\xe0\0\0\0\0", 8);
  const std::string undefined("\x28\x00\x00\x30SQ\0\0\xff\xff\xff\xff", 12);
  EXPECT_EQ(kindsOf([&](int, TestSlice& s) { s.element(s.extra, 0x00283000, "SQ", item); }),
            Kinds{FindingKind::ModalityLut});
  EXPECT_EQ(kindsOf([&](int, TestSlice& s) { s.extra = undefined + item + itemEnd; }),
            Kinds{FindingKind::ModalityLut});
  EXPECT_EQ(kindsOf([&](int, TestSlice& s) { s.extra = undefined + itemEnd; }), Kinds());
  EXPECT_EQ(kindsOf([&](int, TestSlice& s) { s.element(s.extra, 0x00283000, "SQ", ""); }), Kinds());
}

/// A cache in memory that counts.
class Shelf : public core::DerivedStore
{
public:
  std::optional<Bytes> find(const std::string& key) noexcept override
  {
    const auto found = entries.find(key);
    found == entries.end() ? ++misses : ++hits;
    return found == entries.end() ? std::nullopt : std::optional(found->second);
  }
  void put(const std::string& key, const Bytes& bytes) noexcept override { entries[key] = bytes; }
  std::uintmax_t bytes() const noexcept override { return 0; }

  std::map<std::string, Bytes> entries;
  int hits = 0;
  int misses = 0;
};

/// Bytes that this process has read by system calls; nullopt: not told.
std::optional<std::uint64_t> bytesRead()
{
  std::ifstream io("/proc/self/io");
  std::string word;
  std::uint64_t value = 0;
  if (io >> word >> value && word == "rchar:")
    return value;
  return std::nullopt;
}

/// As if all files had been written an hour ago.
void settle(const fs::path& folder)
{
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    if (entry.is_regular_file())
      fs::last_write_time(entry.path(), fs::file_time_type::clock::now() - std::chrono::hours(1));
}

/// What a scan says, as text.
std::string textOf(const ScanResult& result)
{
  std::ostringstream text;
  for (const DicomSeries& series : result.series)
  {
    text << series.uid << series.volume << series.modality << series.description << series.files
         << series.frameOfReferenceUid << verdictName(series.geometry.verdict);
    for (const Finding& finding : series.geometry.findings)
      text << kindName(finding.kind) << finding.text;
    for (const std::string& note : series.geometry.notes)
      text << note;
    for (const SliceHeader& s : series.geometry.slices)
      text << s.file << s.position->transpose() << s.rows << s.slope << s.intercept << s.taken
           << s.patient.id << s.patient.name << s.studyUid << s.kernel << s.pixels.offset
           << s.pixels.length << s.pixels.transferSyntax << s.instanceNumber << s.positionStep
           << s.padding.value_or(-1.0) << s.traits.echoTime.value_or(-1.0);
  }
  for (const Finding& finding : result.unreadable)
    text << finding.text;
  for (const std::string& note : result.notes)
    text << note;
  text << result.foreignFiles;
  return text.str();
}

void writeMany(const fs::path& folder)
{
  writeSeries(folder / "a", 5,
              [](int, TestSlice& s)
              {
                s.padding = 7;
                s.element(s.extra, 0x00080022, "DA", "20200131");
                s.element(s.extra, 0x00181210, "SH", "H70");
              });
  writeSeries(folder / "b", 6,
              [](int k, TestSlice& s)
              {
                s.seriesUid = "7.7";
                s.z = 0.5 * (k / 2);
                s.element(s.extra, 0x00180081, "DS", k % 2 == 0 ? "10" : "20");
              });
  fs::resize_file(folder / "b" / "s5.dcm", fs::file_size(folder / "b" / "s5.dcm") - 10);
  writeText(folder / "readme.txt", "this is no DICOM");
  settle(folder);
}

TEST(DicomScan, ReadsUnchangedHeadersFromTheCache)
{
  const TemporaryFolder folder;
  writeMany(folder.path());
  const std::string plain = textOf(scanDicom(folder.path(), {}));
  Shelf shelf;
  EXPECT_EQ(textOf(scanDicom(folder.path(), {}, &shelf)), plain);
  EXPECT_EQ(shelf.misses, 1);
  ASSERT_EQ(shelf.entries.size(), 1U);
  EXPECT_EQ(textOf(scanDicom(folder.path(), {}, &shelf)), plain);
  EXPECT_EQ(shelf.hits, 1);
  EXPECT_EQ(shelf.entries.size(), 1U);
}

TEST(DicomScan, RemembersWhatComparingFilesShowed)
{
  const TemporaryFolder folder;
  writeTwice(folder.path() / "twice", 2, [](int, int) { return false; });
  const auto copies = folder.path() / "copies";
  writeSeries(copies, 4, [](int, TestSlice& s) { s.seriesUid = "7.8"; });
  for (int k = 0; k < 4; ++k)
    fs::copy_file(copies / ("s" + std::to_string(k) + ".dcm"),
                  copies / ("t" + std::to_string(k) + ".dcm"));
  settle(folder.path());
  Shelf shelf;
  const std::string plain = textOf(scanDicom(folder.path(), {}));
  EXPECT_NE(plain.find("equal pixels"), std::string::npos);
  EXPECT_NE(plain.find("4 files are copies"), std::string::npos);
  EXPECT_EQ(textOf(scanDicom(folder.path(), {}, &shelf)), plain);
  EXPECT_EQ(shelf.entries.size(), 1U);
  const auto before = bytesRead();
  EXPECT_EQ(textOf(scanDicom(folder.path(), {}, &shelf)), plain);
  EXPECT_EQ(shelf.hits, 1);
  if (before)
  {
    std::uintmax_t all = 0;
    for (const auto& entry : fs::recursive_directory_iterator(folder.path()))
      all += entry.is_regular_file() ? entry.file_size() : 0;
    EXPECT_LT(*bytesRead() - *before, all / 2) << "files were compared again";
  }
}

TEST(DicomScan, ReadsHeadersAnewIfAnyFileWasTouched)
{
  const fs::path changed("a/s2.dcm");
  // Of the same size and, by utimensat, the same age.
  const auto rewrite = [&](const fs::path& folder)
  {
    struct stat before = {};
    struct stat now = {};
    ASSERT_EQ(::stat((folder / changed).c_str(), &before), 0);
    TestSlice slice;
    slice.z = 1.1;
    slice.padding = 7;
    slice.element(slice.extra, 0x00080022, "DA", "20200131");
    slice.element(slice.extra, 0x00181210, "SH", "H70");
    do // until the clock of the file system has moved on
    {
      slice.write(folder / changed);
      const struct timespec times[2] = {before.st_atim, before.st_mtim};
      ASSERT_EQ(::utimensat(AT_FDCWD, (folder / changed).c_str(), times, 0), 0);
      ASSERT_EQ(::stat((folder / changed).c_str(), &now), 0);
    } while (now.st_ctim.tv_sec == before.st_ctim.tv_sec &&
             now.st_ctim.tv_nsec == before.st_ctim.tv_nsec);
    ASSERT_EQ(now.st_size, before.st_size);
  };
  const std::function<void(const fs::path&)> changes[] = {
      rewrite, [&](const fs::path& folder) { fs::remove(folder / changed); },
      [&](const fs::path& folder) { fs::rename(folder / changed, folder / "a" / "s9.dcm"); },
      [&](const fs::path& folder) { fs::resize_file(folder / changed, 200); },
      [&](const fs::path& folder) { TestSlice().write(folder / "c" / "s0.dcm"); }};
  for (const auto& change : changes)
  {
    const TemporaryFolder folder;
    writeMany(folder.path());
    Shelf shelf;
    const std::string before = textOf(scanDicom(folder.path(), {}, &shelf));
    ASSERT_EQ(shelf.entries.size(), 1U);
    change(folder.path());
    const std::string after = textOf(scanDicom(folder.path(), {}));
    EXPECT_NE(after, before);
    EXPECT_EQ(textOf(scanDicom(folder.path(), {}, &shelf)), after);
    EXPECT_EQ(shelf.hits, 0);
  }
}

TEST(DicomScan, KeepsNothingOfFilesThatMayStillBeChanging)
{
  const TemporaryFolder folder;
  writeSeries(folder.path(), 3);
  Shelf shelf;
  scanDicom(folder.path(), {}, &shelf);
  EXPECT_TRUE(shelf.entries.empty()) << "written just now";
  settle(folder.path());
  fs::last_write_time(folder.path() / "s1.dcm",
                      fs::file_time_type::clock::now() + std::chrono::hours(1));
  scanDicom(folder.path(), {}, &shelf);
  EXPECT_TRUE(shelf.entries.empty()) << "a clock that is fast";
}

TEST(DicomScan, IgnoresADamagedCache)
{
  const TemporaryFolder folder;
  writeMany(folder.path());
  Shelf shelf;
  const std::string plain = textOf(scanDicom(folder.path(), {}, &shelf));
  ASSERT_EQ(shelf.entries.size(), 1U);
  const auto whole = *shelf.entries.begin();
  for (std::size_t n = 0; n < 64; ++n)
  {
    auto bytes = whole.second;
    if (n % 2 == 0)
      bytes[n * (bytes.size() - 1) / 63] ^= 1;
    else
      bytes.resize(n * bytes.size() / 64);
    shelf.entries[whole.first] = bytes;
    ASSERT_EQ(textOf(scanDicom(folder.path(), {}, &shelf)), plain) << n;
    ASSERT_EQ(shelf.entries.size(), 1U);
  }
}

TEST(DicomScan, KeepsThePatientOutOfTheCache)
{
  const TemporaryFolder folder;
  const fs::path root = folder.path() / "MILLER";
  writeMany(root);
  Shelf shelf;
  scanDicom(root, {}, &shelf);
  ASSERT_EQ(shelf.entries.size(), 1U);
  const auto& [key, bytes] = *shelf.entries.begin();
  const std::string all = key + std::string(bytes.begin(), bytes.end());
  for (const char* word :
       {"SECRET", "MILLER", "[31mTEST", "1.2.3.4", "1.2.3.8", "20200131", "s2.dcm"})
    EXPECT_EQ(all.find(word), std::string::npos) << word;
  const std::string first(bytes.begin(), bytes.end());
  shelf.entries.clear();
  scanDicom(root, {}, &shelf);
  const auto& again = shelf.entries.begin()->second;
  EXPECT_NE(std::string(again.begin(), again.end()), first) << "a nonce of its own";
}

TEST(DicomScan, StopsWhenCancelled)
{
  const TemporaryFolder folder;
  writeSeries(folder.path(), 40);
  const auto token = std::make_shared<core::CancelToken>();
  const core::Progress progress([&](double, const std::string&) { token->cancel(); }, token);
  EXPECT_THROW(scanDicom(folder.path(), progress), core::CancelledError);
}

TEST(DicomScan, StopsWhileSlicesAreCompared)
{
  const TemporaryFolder folder;
  writeTwice(folder.path(), 3, [](int, int) { return false; });
  const auto token = std::make_shared<core::CancelToken>();
  std::atomic<int> compared{0};
  const core::Progress progress(
      [&](double, const std::string& text)
      {
        if (text != "comparing slices")
          return;
        ++compared;
        token->cancel();
      },
      token);
  EXPECT_THROW(scanDicom(folder.path(), progress), core::CancelledError);
  EXPECT_EQ(compared, 1) << "of 24";
}

TEST(DicomScan, KeepsThePatientOutOfEveryMessage)
{
  const TemporaryFolder folder;
  writeSeries(folder.path(), 5, [](int k, TestSlice& s) { s.z = k == 3 ? 9.0 : 0.5 * k; });
  fs::resize_file(folder.path() / "s2.dcm", fs::file_size(folder.path() / "s2.dcm") - 10);
  ::testing::internal::CaptureStderr();
  ::testing::internal::CaptureStdout();
  const ScanResult result = scanDicom(folder.path(), {});
  std::string all = ::testing::internal::GetCapturedStderr();
  all += ::testing::internal::GetCapturedStdout();
  EXPECT_EQ(all, "");
  for (const Finding& finding : result.series.front().geometry.findings)
    EXPECT_EQ(finding.text.find("SECRET"), std::string::npos);
}

} // namespace
} // namespace petrous::imaging
