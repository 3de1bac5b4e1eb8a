// Third-party files (label "data"): geometry, verdicts and voxels of whole series.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <iterator>
#include <sstream>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "TestDicom.h"
#include "petrous/Imaging/DicomReader.h"

namespace petrous::imaging
{
namespace
{

namespace fs = std::filesystem;
using volume::IntensityVolume;

class DicomData : public ::testing::Test
{
protected:
  void SetUp() override
  {
    const char* folder = std::getenv("PETROUS_DATA");
    if (!folder || !*folder || !fs::is_directory(folder))
      GTEST_SKIP() << "no real data: PETROUS_DATA names no folder";
    m_root = folder;
  }

  /// The part of the data below `name`; skips the test if it was not unpacked.
  fs::path part(const fs::path& name) const { return m_root / name; }

  fs::path m_root;
};

#define PETROUS_NEEDS(path)                                                                        \
  if (!fs::exists(path))                                                                           \
  GTEST_SKIP() << "not unpacked: " << (path)

DicomSeries only(const fs::path& folder)
{
  const ScanResult result = scanDicom(folder, {});
  return chooseSeries(result, folder);
}

const Finding* findingOf(const DicomSeries& series, FindingKind kind)
{
  const auto& all = series.geometry.findings;
  const auto found =
      std::find_if(all.begin(), all.end(), [kind](const Finding& f) { return f.kind == kind; });
  return found == all.end() ? nullptr : &*found;
}

/// CRC-32 (IEEE 802.3), as zlib and Python compute it.
std::uint32_t crc32(const unsigned char* bytes, std::size_t count)
{
  std::array<std::uint32_t, 256> table{};
  for (std::uint32_t n = 0; n < 256; ++n)
  {
    std::uint32_t c = n;
    for (int bit = 0; bit < 8; ++bit)
      c = c & 1U ? 0xEDB88320U ^ (c >> 1) : c >> 1;
    table[n] = c;
  }
  std::uint32_t crc = 0xFFFFFFFFU;
  for (std::size_t i = 0; i < count; ++i)
    crc = table[(crc ^ bytes[i]) & 0xFFU] ^ (crc >> 8);
  return crc ^ 0xFFFFFFFFU;
}

std::string run(const std::string& command)
{
  std::string output;
  FILE* pipe = ::popen(command.c_str(), "r");
  if (!pipe)
    return output;
  std::array<char, 256> buffer{};
  while (std::fgets(buffer.data(), buffer.size(), pipe))
    output += buffer.data();
  return ::pclose(pipe) == 0 ? output : std::string();
}

bool hasPydicom()
{
  return !run("/usr/bin/python3 -c 'import pydicom, numpy; print(1)' 2>/dev/null").empty();
}

/// Sum and CRC of the int16 values, slices sorted along row x column, computed with pydicom and
/// numpy.
std::string peerChecksum(const fs::path& folder)
{
  const test::TemporaryFolder work;
  test::writeText(work.path() / "peer.py", R"(
import os, sys, zlib, numpy, pydicom
slices = []
for name in os.listdir(sys.argv[1]):
    try:
        data = pydicom.dcmread(os.path.join(sys.argv[1], name))
        cosines = [float(c) for c in data.ImageOrientationPatient]
        normal = numpy.cross(cosines[:3], cosines[3:])
        place = float(numpy.dot(normal, [float(p) for p in data.ImagePositionPatient]))
        values = data.pixel_array.astype(numpy.int64)
    except Exception:
        continue
    values = values * int(data.get('RescaleSlope', 1)) + int(data.get('RescaleIntercept', 0))
    slices.append((place, values.astype('<i2')))
slices.sort(key=lambda s: s[0])
crc, total = 0, 0
for place, values in slices:
    crc = zlib.crc32(values.tobytes(), crc)
    total += int(values.sum(dtype=numpy.int64))
print(len(slices), total, crc)
)");
  return run("/usr/bin/python3 '" + (work.path() / "peer.py").string() + "' '" + folder.string() +
             "' 2>/dev/null");
}

std::string checksum(const IntensityVolume& volume)
{
  using Voxels = std::shared_ptr<const volume::Volume<std::int16_t>>;
  const auto& voxels = std::get<Voxels>(volume.voxels());
  long long total = 0;
  for (std::size_t i = 0; i < voxels->size(); ++i)
    total += voxels->data()[i];
  std::ostringstream text;
  text << voxels->geometry().dims()[2] << " " << total << " "
       << crc32(reinterpret_cast<const unsigned char*>(voxels->data()), voxels->bytes()) << "\n";
  return text.str();
}

void expectPeersVoxels(const fs::path& folder, bool acceptDefects = false)
{
  if (!hasPydicom())
    GTEST_SKIP() << "python3 has no pydicom to compare with";
  ReadOptions options;
  options.acceptDefects = acceptDefects;
  EXPECT_EQ(checksum(readSeries(only(folder), options, {})), peerChecksum(folder));
}

TEST_F(DicomData, VisibleHumanHeadIsOkAndLiesWhereItsFilesSay)
{
  const fs::path folder = part("ct_head_vhm/vhm_1080-1245");
  PETROUS_NEEDS(folder);
  const DicomSeries series = only(folder);
  EXPECT_EQ(series.geometry.verdict, Verdict::Ok);
  ASSERT_TRUE(series.geometry.grid);
  const core::GridGeometry expected({512, 512, 166}, {1, 1, 1}, {0, 0, 1079});
  EXPECT_TRUE(core::sameGrid(*series.geometry.grid, expected, 1e-6));
  const IntensityVolume volume = readSeries(series, {}, {});
  EXPECT_EQ(volume.range().min, -1024.0);
  EXPECT_EQ(volume.range().max, 3617.0);
}

TEST_F(DicomData, VisibleHumanVoxelsEqualPydicomToTheBit)
{
  const fs::path folder = part("ct_head_vhm/vhm_1080-1245");
  PETROUS_NEEDS(folder);
  expectPeersVoxels(folder);
}

TEST_F(DicomData, StraightPhantomScanIsOkAndEqualsPydicomToTheBit)
{
  const fs::path folder = part("ct_phantom/philips_S21570_S2020_notilt_1mm/S2020");
  PETROUS_NEEDS(folder);
  const DicomSeries series = only(folder);
  EXPECT_EQ(series.geometry.verdict, Verdict::Ok);
  const core::GridGeometry expected({512, 512, 140}, {0.451171875, 0.451171875, 1},
                                    {-115.5, -1.85, 694.21});
  EXPECT_TRUE(core::sameGrid(*series.geometry.grid, expected, 1e-6));
  expectPeersVoxels(folder);
}

TEST_F(DicomData, TiltedPhantomScanIsRefusedWithItsMillimetres)
{
  const fs::path folder = part("ct_phantom/philips_S21610_S2010_tilt-18.5/S2010");
  PETROUS_NEEDS(folder);
  const DicomSeries series = only(folder);
  EXPECT_EQ(series.geometry.verdict, Verdict::Repairable);
  EXPECT_THROW(readSeries(series, {}, {}), DicomError);
  const Finding* tilt = findingOf(series, FindingKind::GantryTilt);
  ASSERT_TRUE(tilt);
  EXPECT_GE(tilt->errorMm, 18.0);
  EXPECT_LE(tilt->errorMm, 25.0);
  EXPECT_EQ(series.geometry.findings.size(), 1U);
  EXPECT_NEAR(series.geometry.grid->spacing()[2], 2.5 * 0.9483237, 1e-5);
  expectPeersVoxels(folder, true);
}

TEST_F(DicomData, MissingSliceIsNamed)
{
  const fs::path folder = part("dicom_odd/dicom2nifti_failing_public/failing/sliceincrement/001");
  PETROUS_NEEDS(folder);
  const DicomSeries series = only(folder);
  const Finding* missing = findingOf(series, FindingKind::MissingSlice);
  ASSERT_TRUE(missing);
  EXPECT_NEAR(missing->errorMm, 5.0, 1e-3);
}

TEST_F(DicomData, SlicesAtOnePlaceAreNoVolume)
{
  const fs::path folder = part("dicom_odd/dicom2nifti_failing_public/failing/notavolume/001");
  PETROUS_NEEDS(folder);
  const DicomSeries series = only(folder);
  EXPECT_TRUE(findingOf(series, FindingKind::DuplicateSlice));
  EXPECT_THROW(readSeries(series, {}, {}), DicomError);
}

TEST_F(DicomData, MixedOrientationIsNamed)
{
  const fs::path folder = part("dicom_odd/dicom2nifti_failing_public/failing/sliceorientation/001");
  PETROUS_NEEDS(folder);
  EXPECT_TRUE(findingOf(only(folder), FindingKind::OddOrientation));
}

TEST_F(DicomData, HeadFirstSupineAndProneLieInOnePatientFrame)
{
  for (const char* name : {"HFS/3_t1_fl2d_sag", "HFP/2_t1_fl2d_sag"})
  {
    const fs::path folder = part("mr_positions/siemens_t1_HFS_HFP") / name;
    PETROUS_NEEDS(folder);
    const DicomSeries series = only(folder);
    EXPECT_EQ(series.geometry.verdict, Verdict::Ok) << name;
    EXPECT_EQ(series.geometry.grid->dims(), (core::Index3{256, 256, 35}));
    // Sagittal: rows point posteriorly, columns inferiorly, slices from left to right.
    Eigen::Matrix3d axes;
    axes << 0, 0, -1, 1, 0, 0, 0, -1, 0;
    EXPECT_TRUE(series.geometry.grid->direction().isApprox(axes, 1e-9));
    EXPECT_NEAR(series.geometry.grid->spacing()[2], 4.8, 1e-6);
    expectPeersVoxels(folder);
  }
}

TEST_F(DicomData, EveryCompressionGivesTheSameVoxels)
{
  const fs::path root = part("dicom_odd/dicom2nifti_generic/generic");
  PETROUS_NEEDS(root);
  const std::string lossless = checksum(readSeries(only(root / "compressed_j2k/001"), {}, {}));
  for (const char* name :
       {"compressed/001", "compressed_jpeg/001", "compressed_jpegls/001", "compressed_rle/001"})
    EXPECT_EQ(checksum(readSeries(only(root / name), {}, {})), lossless) << name;
}

TEST_F(DicomData, ColoursAreRefusedInWords)
{
  const fs::path folder = part("dicom_odd/dicom2nifti_generic/generic/rgb/001");
  PETROUS_NEEDS(folder);
  const ScanResult result = scanDicom(folder, {});
  ASSERT_EQ(result.series.size(), 1U);
  EXPECT_TRUE(findingOf(result.series.front(), FindingKind::NotAnImage));
}

TEST_F(DicomData, ValuesOfMoreThanTheBitsStoredAreReadAsTheUserSays)
{
  const fs::path folder = part("dicom_odd/dcm_qa_12bit/dcm_qa_12bit/In");
  PETROUS_NEEDS(folder);
  // Three files at one position: each is read as a stack of its own, with a shifted copy.
  DicomSeries series = only(folder);
  ASSERT_EQ(series.geometry.slices.size(), 3U);
  const auto imageOf = [&](const std::string& name, UndeclaredBits undeclared)
  {
    DicomSeries two = series;
    std::vector<SliceHeader> slices;
    for (const SliceHeader& slice : series.geometry.slices)
      if (slice.file.filename() == name)
        slices = {slice, slice};
    EXPECT_EQ(slices.size(), 2U) << name;
    const Eigen::Vector3d normal = slices[0].rowDirection->cross(*slices[0].columnDirection);
    *slices[1].position += 5.0 * normal;
    two.geometry = assess(slices);
    ReadOptions options;
    options.undeclaredBits = undeclared;
    return readSeries(two, options, {});
  };
  // Mosaics with stripes of bits above 12: values of 16 bits, or rubbish, which nobody can tell.
  // dcm2niix leaves them out.
  const std::pair<const char*, const char*> all[] = {{"12bitUnsigned.dcm", "2.nii"},
                                                     {"12bitUnsigned_0x0F0F.dcm", "3.nii"},
                                                     {"12bitSigned_0x0F0F.dcm", "4.nii"}};
  for (const auto& [odd, reference] : all)
  {
    try
    {
      imageOf(odd, UndeclaredBits::Refuse);
      ADD_FAILURE() << odd << " was read";
    }
    catch (const DicomError& error)
    {
      EXPECT_NE(std::string(error.what()).find("more than the 12 bits"), std::string::npos)
          << error.what();
    }
    const auto image = imageOf(odd, UndeclaredBits::LeaveOut);
    std::ifstream file(folder.parent_path() / "Ref" / reference, std::ios::binary);
    file.seekg(352); // its header
    int differing = 0;
    for (int k = 0; k < 35; ++k)
      for (int j = 63; j >= 0; --j) // rows from below
        for (int i = 0; i < 64; ++i)
        {
          std::int16_t value = 0;
          file.read(reinterpret_cast<char*>(&value), 2);
          differing += image.at(k % 6 * 64 + i, k / 6 * 64 + j, 0) == value ? 0 : 1;
        }
    EXPECT_TRUE(file.good());
    EXPECT_EQ(differing, 0) << odd;
  }
}

TEST_F(DicomData, OddFilesNeverCrashAndNeverSpeak)
{
  for (const char* name : {"dicom_odd/pydicom_test_files", "seg_rt"})
  {
    const fs::path folder = part(name);
    PETROUS_NEEDS(folder);
    ::testing::internal::CaptureStderr();
    ::testing::internal::CaptureStdout();
    const ScanResult result = scanDicom(folder, {});
    ReadOptions options;
    options.acceptDefects = true;
    std::size_t readable = 0;
    for (const DicomSeries& series : result.series)
      try
      {
        readSeries(series, options, {});
        ++readable;
      }
      catch (const DicomError&)
      {
      }
    std::string spoken = ::testing::internal::GetCapturedStderr();
    spoken += ::testing::internal::GetCapturedStdout();
    EXPECT_EQ(spoken, "");
    EXPECT_GT(result.series.size(), 10U);
    EXPECT_GT(readable, 1U);
  }
}

TEST_F(DicomData, SegmentationsAndStructureSetsAreNoImages)
{
  const fs::path folder = part("seg_rt");
  PETROUS_NEEDS(folder);
  for (const DicomSeries& series : scanDicom(folder, {}).series)
    if (series.modality == "SEG" || series.modality == "RTSTRUCT" || series.modality == "SR")
    {
      EXPECT_EQ(series.geometry.verdict, Verdict::Refused);
      EXPECT_TRUE(findingOf(series, FindingKind::MultiFrame) ||
                  findingOf(series, FindingKind::NotAnImage));
    }
}

/// The stored values of volume `t` of an int16 NIfTI file by dcm2niix, each at its place in
/// `series`. Stored values, because dcm2niix scales those of Philips by private elements of its
/// own.
void expectStoredValuesOf(const DicomSeries& series, const fs::path& reference, int t)
{
  std::ifstream file(reference, std::ios::binary);
  std::string bytes((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
  ASSERT_GT(bytes.size(), 352U);
  const auto number = [&bytes](auto value, std::size_t at)
  {
    std::memcpy(&value, bytes.data() + at, sizeof value);
    return value;
  };
  const std::int16_t none = 0;
  ASSERT_EQ(number(none, 70), 4) << "int16";
  const int n[3] = {number(none, 42), number(none, 44), number(none, 46)};
  Eigen::Matrix<double, 3, 4> affine; // of the sform, RAS turned to LPS
  for (int r = 0; r < 3; ++r)
    for (int c = 0; c < 4; ++c)
      affine(r, c) =
          static_cast<double>(number(0.0F, static_cast<std::size_t>(280 + 16 * r + 4 * c))) *
          (r < 2 ? -1.0 : 1.0);
  const IntensityVolume volume = readSeries(series, {}, {});
  const core::GridGeometry& to = volume.geometry();
  ASSERT_EQ(static_cast<std::size_t>(n[0]) * n[1] * n[2], to.voxelCount());
  const SliceHeader& slice = series.geometry.slices.front();
  std::size_t different = 0;
  double worst = 0.0;
  std::size_t at = 352 + 2 * to.voxelCount() * static_cast<std::size_t>(t);
  ASSERT_LE(at + 2 * to.voxelCount(), bytes.size());
  for (int k = 0; k < n[2]; ++k)
    for (int j = 0; j < n[1]; ++j)
      for (int i = 0; i < n[0]; ++i, at += 2)
      {
        const Eigen::Vector3d place = to.voxelFromPatient(affine * Eigen::Vector4d(i, j, k, 1.0));
        const Eigen::Vector3i v = place.array().round().cast<int>();
        worst = std::max(worst, (place - v.cast<double>()).cwiseProduct(to.spacing()).norm());
        for (int a = 0; a < 3; ++a)
          ASSERT_TRUE(v[a] >= 0 && v[a] < to.dims()[static_cast<std::size_t>(a)]);
        const double stored =
            std::nearbyint((volume.at(v[0], v[1], v[2]) - slice.intercept) / slice.slope);
        different += stored == number(none, at) ? 0 : 1;
      }
  EXPECT_EQ(different, 0U);
  EXPECT_LT(worst, 1e-3) << "mm";
}

TEST_F(DicomData, EnhancedMrOfTwoMakersEqualsDcm2niix)
{
  const fs::path root = part("dicom_enhanced/dcm_qa_enh");
  PETROUS_NEEDS(root / "In/Philips/IM_0027_fMAP.dcm");
  const ScanResult philips = scanDicom(root / "In/Philips", {});
  ASSERT_EQ(philips.series.size(), 2U);
  expectStoredValuesOf(philips.series[0], root / "Ref/Philips_WIP_B0_NS_801_e1.nii", 0);
  expectStoredValuesOf(philips.series[1], root / "Ref/Philips_WIP_B0_NS_801_e2_fieldmaphz.nii", 0);

  const ScanResult siemens = scanDicom(root / "In/Siemens", {});
  ASSERT_EQ(siemens.series.size(), 4U) << "a file each, at one place";
  for (int t = 0; t < 4; ++t)
  {
    const DicomSeries& series = siemens.series[static_cast<std::size_t>(t)];
    EXPECT_EQ(series.volume, "time " + std::to_string(t + 1));
    expectStoredValuesOf(series, root / "Ref/Siemens_REST1_w_SMS_PF7-8_6.nii", t);
  }
}

/// Whether a volume of a NIfTI file by dcm2niix is this image: each voxel's place within 1e-3 mm
/// and its value, stored or as scaled by the file, to the bit of the smaller type.
bool isVolumeOf(const DicomSeries& series, const IntensityVolume& image, const fs::path& reference)
{
  std::ifstream file(reference, std::ios::binary);
  const std::string bytes((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
  if (bytes.size() < 352)
    return false;
  const auto number = [&bytes](auto value, std::size_t at)
  {
    std::memcpy(&value, bytes.data() + at, sizeof value);
    return value;
  };
  const auto value = [&](std::size_t n) -> double
  {
    switch (number(std::int16_t{}, 70))
    {
    case 2:
      return number(std::uint8_t{}, 352 + n);
    case 4:
      return number(std::int16_t{}, 352 + 2 * n);
    case 512:
      return number(std::uint16_t{}, 352 + 2 * n);
    case 16:
      return static_cast<double>(number(0.0F, 352 + 4 * n));
    default:
      return std::nan("");
    }
  };
  std::array<int, 3> n{};
  for (std::size_t a = 0; a < 3; ++a)
    n[a] = number(std::int16_t{}, 42 + 2 * a);
  const core::GridGeometry& to = image.geometry();
  const auto count = static_cast<std::size_t>(n[0]) * static_cast<std::size_t>(n[1]) *
                     static_cast<std::size_t>(n[2]);
  if (count != to.voxelCount())
    return false;
  const std::size_t bytesOfVoxel = static_cast<std::size_t>(number(std::int16_t{}, 72)) / 8;
  const std::size_t volumes =
      (bytes.size() - 352) / (count * std::max<std::size_t>(bytesOfVoxel, 1));
  Eigen::Matrix<double, 3, 4> affine; // of the sform, RAS turned to LPS
  for (int r = 0; r < 3; ++r)
    for (int c = 0; c < 4; ++c)
      affine(r, c) =
          static_cast<double>(number(0.0F, static_cast<std::size_t>(280 + 16 * r + 4 * c))) *
          (r < 2 ? -1.0 : 1.0);
  const SliceHeader& slice = series.geometry.slices.front();
  const double slope = static_cast<double>(number(0.0F, 112));
  const double intercept = static_cast<double>(number(0.0F, 116));
  for (std::size_t t = 0; t < volumes; ++t)
  {
    bool same = true;
    std::size_t at = t * count;
    for (int k = 0; same && k < n[2]; ++k)
      for (int j = 0; same && j < n[1]; ++j)
        for (int i = 0; same && i < n[0]; ++i, ++at)
        {
          const Eigen::Vector3d place = to.voxelFromPatient(affine * Eigen::Vector4d(i, j, k, 1.0));
          const Eigen::Vector3i v = place.array().round().cast<int>();
          for (int a = 0; a < 3; ++a)
            same = same && v[a] >= 0 && v[a] < to.dims()[static_cast<std::size_t>(a)];
          same = same && (place - v.cast<double>()).cwiseProduct(to.spacing()).norm() < 1e-3;
          if (!same)
            break;
          const double ours = image.at(v[0], v[1], v[2]);
          const double stored = std::nearbyint((ours - slice.intercept) / slice.slope);
          same = stored == value(at) ||
                 std::abs(ours - (slope * value(at) + intercept)) <= 1e-6 * (1.0 + std::abs(ours));
        }
    if (same)
      return true;
  }
  return false;
}

// Every stack of the real data: the image that dcm2niix makes of it, or refused, or repairable with
// the finding that says so. Nothing differs in silence.
TEST_F(DicomData, EverySeriesEqualsDcm2niixOrIsRefusedWithItsFinding)
{
  if (run("command -v dcm2niix").empty())
    GTEST_SKIP() << "dcm2niix is not there to compare with";
  const test::TemporaryFolder work;
  run("dcm2niix -f %j -z n -b n -w 2 -d 9 -o '" + work.path().string() + "' '" + m_root.string() +
      "' 2>/dev/null");
  int equal = 0;
  int unmatched = 0;
  for (const DicomSeries& series : scanDicom(m_root, {}).series)
  {
    if (series.geometry.verdict != Verdict::Ok)
    {
      EXPECT_FALSE(series.geometry.findings.empty()) << series.uid;
      continue;
    }
    const IntensityVolume image = readSeries(series, {}, {});
    bool found = false;
    bool any = false;
    for (const auto& file : fs::directory_iterator(work.path()))
      if (file.path().filename().string().rfind(series.uid, 0) == 0)
      {
        any = true;
        found = found || isVolumeOf(series, image, file.path());
      }
    if (!any) // dcm2niix does not read it
      ++unmatched;
    else if (found)
      ++equal;
    else
      ADD_FAILURE() << series.uid << " " << series.volume << " differs from dcm2niix's";
  }
  RecordProperty("equal", equal);
  RecordProperty("unmatched", unmatched);
  std::cout << equal << " equal, " << unmatched << " not read by dcm2niix\n";
  EXPECT_GE(equal, 10);
}

} // namespace
} // namespace petrous::imaging
