#include "petrous/Imaging/NrrdFile.h"

#include <csignal>
#include <cstdint>
#include <numeric>

#include <Eigen/Geometry>
#include <gtest/gtest.h>
#include <sys/resource.h>

#include "petrous/Imaging/VolumeFile.h"

#include "ItkReader.h"
#include "TestFiles.h"

namespace petrous::imaging
{
namespace
{

using Reason = FileError::Reason;

core::GridGeometry obliqueGrid()
{
  const Eigen::Matrix3d turn =
      Eigen::AngleAxisd(0.3, Eigen::Vector3d(1.0, 2.0, -0.5).normalized()).toRotationMatrix();
  return {{7, 5, 3}, {0.1 + 0.2, 1.0 / 3.0, 0.625}, {-101.7, 33.1, 1e-3}, turn};
}

template <class T>
std::shared_ptr<volume::Volume<T>> ramp(const core::GridGeometry& grid)
{
  auto volume = std::make_shared<volume::Volume<T>>(grid);
  std::iota(volume->data(), volume->data() + volume->size(), static_cast<T>(3));
  return volume;
}

template <class T>
void expectRoundTrip(std::optional<double> padding)
{
  const TestFolder folder;
  const auto grid = obliqueGrid();
  const std::shared_ptr<const volume::Volume<T>> voxels = ramp<T>(grid);
  writeRawNrrd(folder / "a.nrrd", volume::IntensityVolume(voxels, padding));
  const auto back = mapRawNrrd(folder / "a.nrrd");
  ASSERT_TRUE(std::holds_alternative<std::shared_ptr<const volume::Volume<T>>>(back->voxels()));
  const auto& map = *std::get<std::shared_ptr<const volume::Volume<T>>>(back->voxels());
  EXPECT_EQ(map.geometry().dims(), grid.dims());
  EXPECT_EQ(map.geometry().spacing(), grid.spacing()); // bit-exact
  EXPECT_EQ(map.geometry().origin(), grid.origin());
  EXPECT_EQ(map.geometry().direction(), grid.direction());
  EXPECT_EQ(back->padding(), padding);
  EXPECT_EQ(std::memcmp(map.data(), voxels->data(), voxels->bytes()), 0);
  EXPECT_EQ(reinterpret_cast<std::uintptr_t>(map.data()) % 4096, 0U);
  EXPECT_EQ(folder.fileCount(), 1U);
}

// A mapping would end the program here.
TEST(NrrdFile, ACopyOutlivesItsMedium)
{
  const TestFolder folder;
  const std::shared_ptr<const volume::Volume<std::int16_t>> voxels =
      ramp<std::int16_t>(obliqueGrid());
  writeRawNrrd(folder / "a.nrrd", volume::IntensityVolume(voxels));
  const auto copy = mapRawNrrd(folder / "a.nrrd", VoxelAccess::Copied);
  std::filesystem::resize_file(folder / "a.nrrd", 0);
  const auto& back = *std::get<std::shared_ptr<const volume::Volume<std::int16_t>>>(copy->voxels());
  EXPECT_EQ(std::memcmp(back.data(), voxels->data(), voxels->bytes()), 0);
}

TEST(NrrdFile, RoundTripIsExactToTheBit)
{
  expectRoundTrip<std::int16_t>(std::nullopt);
  expectRoundTrip<std::uint16_t>(65535.0);
  expectRoundTrip<float>(-1024.1);
}

TEST(NrrdFile, EqualVolumesGiveEqualBytes)
{
  const TestFolder folder;
  writeRawNrrd(folder / "a.nrrd", *ramp<std::uint16_t>(obliqueGrid()));
  writeRawNrrd(folder / "b.nrrd", *ramp<std::uint16_t>(obliqueGrid()));
  EXPECT_EQ(fileBytes(folder / "a.nrrd"), fileBytes(folder / "b.nrrd"));
}

TEST(NrrdFile, ItkReadsPlaceAndVoxels)
{
  const TestFolder folder;
  const auto grid = obliqueGrid();
  const auto voxels = ramp<std::uint16_t>(grid);
  writeRawNrrd(folder / "a.nrrd", *voxels);
  ItkReader itk(folder / "a.nrrd", ItkReader::Format::Nrrd);
  ASSERT_TRUE(itk.readHeader());
  for (unsigned a = 0; a < 3; ++a)
  {
    EXPECT_NEAR(itk.spacing(a), grid.spacing()[a], 1e-12);
    EXPECT_NEAR(itk.origin(a), grid.origin()[a], 1e-12);
    for (unsigned row = 0; row < 3; ++row)
      EXPECT_NEAR(itk.axis(a)[row], grid.direction()(row, a), 1e-12);
  }
  std::vector<std::uint16_t> read(voxels->size());
  ASSERT_TRUE(itk.read({0, 0, 0}, grid.dims(), read.data()));
  EXPECT_EQ(std::memcmp(read.data(), voxels->data(), voxels->bytes()), 0);
}

TEST(NrrdFile, RefusesAFileOfAnotherLength)
{
  const TestFolder folder;
  writeRawNrrd(folder / "a.nrrd", *ramp<std::uint16_t>(obliqueGrid()));
  const std::string whole = fileBytes(folder / "a.nrrd");
  for (const std::size_t length : {whole.size() - 1, std::size_t{4096}, std::size_t{300},
                                   std::size_t{9}, std::size_t{3}, std::size_t{0}})
  {
    putFile(folder / "b.nrrd", whole.substr(0, length));
    EXPECT_TRUE(refusalOf([&] { mapRawNrrd(folder / "b.nrrd"); }).thrown) << length;
  }
  putFile(folder / "b.nrrd", whole + "x");
  expectRefused(refusalOf([&] { mapRawNrrd(folder / "b.nrrd"); }), Reason::Unreadable,
                "bytes long");
}

TEST(NrrdFile, RefusesHeadersOfOtherWritersAndContradictions)
{
  const TestFolder folder;
  writeRawNrrd(folder / "a.nrrd", *ramp<std::uint16_t>(obliqueGrid()));
  const std::string whole = fileBytes(folder / "a.nrrd");
  const auto with = [&](const std::string& from, const std::string& to)
  {
    std::string bytes = whole;
    bytes.replace(bytes.find(from), from.size(), to);
    // The padding keeps the voxels at their offset.
    const std::size_t pad = bytes.find("# ", bytes.find("petrous_direction"));
    if (to.size() > from.size())
      bytes.erase(pad + 1, to.size() - from.size());
    else
      bytes.insert(pad + 1, from.size() - to.size(), ' ');
    putFile(folder / "b.nrrd", bytes);
    return refusalOf([&] { mapRawNrrd(folder / "b.nrrd"); });
  };
  EXPECT_FALSE(with("left-posterior-superior", "left-posterior-superior").thrown);
  expectRefused(with("encoding: raw", "encoding: gzip"), Reason::Unsupported, "encoding");
  expectRefused(with("endian: little", "endian: big"), Reason::Unsupported, "endian");
  expectRefused(with("space origin:", "space origin: (9,9,9)\nspace origin:"), Reason::Unreadable,
                "twice");
  expectRefused(with("sizes: 7 5 3", "sizes: 70000000 50000000 30000000"), Reason::Unreadable);
  expectRefused(with("sizes: 7 5 3", "sizes: 7 5 -3"), Reason::Unreadable);
  expectRefused(with("petrous_spacing:=0.3", "petrous_spacing:=0.4"), Reason::Unreadable,
                "contradicts");
  expectRefused(with("type: unsigned short", "type: double"), Reason::Unsupported);
}

TEST(NrrdFile, LeavesNothingBehindWhenItCannotWrite)
{
  const TestFolder folder;
  const auto voxels = ramp<std::uint16_t>(obliqueGrid());
  expectRefused(refusalOf([&] { writeRawNrrd(folder / "none" / "a.nrrd", *voxels); }),
                Reason::Unwritable, "folder");
  const auto token = std::make_shared<core::CancelToken>();
  token->cancel();
  EXPECT_THROW(writeRawNrrd(folder / "a.nrrd", *voxels, core::Progress({}, token)),
               core::CancelledError);
  EXPECT_EQ(folder.fileCount(), 0U);
}

TEST(VolumeFile, ItkReadsEveryFormatWhereItLies)
{
  const TestFolder folder;
  const auto grid = obliqueGrid();
  const auto voxels = ramp<std::int16_t>(grid);
  const std::pair<const char*, ItkReader::Format> formats[] = {
      {"a.nrrd", ItkReader::Format::Nrrd},
      {"a.nii", ItkReader::Format::Nifti},
      {"a.nii.gz", ItkReader::Format::Nifti},
      {"a.mha", ItkReader::Format::Meta}};
  for (const auto& [name, format] : formats)
  {
    writeVolume(folder / name, *voxels);
    ItkReader itk(folder / name, format);
    ASSERT_TRUE(itk.readHeader()) << name;
    for (unsigned a = 0; a < 3; ++a)
    {
      // NIfTI stores float32.
      EXPECT_NEAR(itk.spacing(a), grid.spacing()[a], 1e-6) << name;
      EXPECT_NEAR(itk.origin(a), grid.origin()[a], 1e-5) << name;
      for (unsigned row = 0; row < 3; ++row)
        EXPECT_NEAR(itk.axis(a)[row], grid.direction()(row, a), 1e-6) << name;
    }
    std::vector<std::int16_t> read(voxels->size());
    ASSERT_TRUE(itk.read({0, 0, 0}, grid.dims(), read.data())) << name;
    EXPECT_EQ(std::memcmp(read.data(), voxels->data(), voxels->bytes()), 0) << name;
  }
}

TEST(VolumeFile, ItkReadsAMirroredGridFromNifti)
{
  const TestFolder folder;
  Eigen::Matrix3d mirrored = obliqueGrid().direction();
  mirrored.col(2) *= -1.0;
  const core::GridGeometry grid({4, 3, 2}, {0.5, 0.6, 0.7}, {1.0, 2.0, 3.0}, mirrored);
  writeVolume(folder / "a.nii", *ramp<float>(grid));
  ItkReader itk(folder / "a.nii", ItkReader::Format::Nifti);
  ASSERT_TRUE(itk.readHeader());
  for (unsigned a = 0; a < 3; ++a)
    for (unsigned row = 0; row < 3; ++row)
      EXPECT_NEAR(itk.axis(a)[row], mirrored(row, a), 1e-6);
}

TEST(VolumeFile, EqualVolumesGiveEqualBytes)
{
  const TestFolder folder;
  for (const std::string end : {".nrrd", ".nii.gz", ".nii", ".mha"})
  {
    writeVolume(folder / ("a" + end), *ramp<std::uint8_t>(obliqueGrid()));
    writeVolume(folder / ("b" + end), *ramp<std::uint8_t>(obliqueGrid()));
    EXPECT_EQ(fileBytes(folder / ("a" + end)), fileBytes(folder / ("b" + end))) << end;
  }
}

TEST(VolumeFile, RefusesOtherNamesAndNamesTheAllowedOnes)
{
  const TestFolder folder;
  const auto voxels = ramp<float>(obliqueGrid());
  expectRefused(refusalOf([&] { writeVolume(folder / "a.tif", *voxels); }), Reason::UnknownFormat,
                ".nii.gz");
  expectRefused(refusalOf([&] { writeVolume(folder / "none/a.nrrd", *voxels); }),
                Reason::Unwritable);
  std::filesystem::create_directory(folder / "b.nrrd");
  expectRefused(refusalOf([&] { writeVolume(folder / "b.nrrd", *voxels); }), Reason::Unwritable,
                "is a folder");
  const core::GridGeometry longGrid({40000, 1, 1}, {1.0, 1.0, 1.0}, {0.0, 0.0, 0.0});
  expectRefused(refusalOf([&] { writeVolume(folder / "a.nii", *ramp<float>(longGrid)); }),
                Reason::Unsupported, "32767");
  EXPECT_EQ(folder.fileCount(), 1U);
}

TEST(VolumeFile, SaysThatThereIsNoRoomAndLeavesNothing)
{
  // A file size limit simulates a full disk: the write stops half way.
  const TestFolder folder;
  const core::GridGeometry grid({64, 64, 64}, {1.0, 1.0, 1.0}, {0.0, 0.0, 0.0});
  const volume::Volume<std::uint16_t> voxels(grid, 7);
  rlimit before = {};
  ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &before), 0);
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  rlimit small = before;
  small.rlim_cur = 65536;
  ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &small), 0);
  const Refusal raw = refusalOf([&] { writeRawNrrd(folder / "a.nrrd", voxels); });
  const Refusal nifti = refusalOf([&] { writeVolume(folder / "a.nii", voxels); });
  setrlimit(RLIMIT_FSIZE, &before);
  std::signal(SIGXFSZ, handler);
  expectRefused(raw, Reason::Unwritable, "a.nrrd");
  expectRefused(nifti, Reason::Unwritable, "a.nii");
  EXPECT_EQ(folder.fileCount(), 0U);
}

} // namespace
} // namespace petrous::imaging
