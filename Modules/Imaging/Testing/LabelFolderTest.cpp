#include <algorithm>
#include <limits>

#include <gtest/gtest.h>

#include "TestFiles.h"
#include "petrous/Imaging/LabelFile.h"

namespace petrous::imaging
{
namespace
{

using Reason = FileError::Reason;

constexpr int kSide = 8;

/// A cube of `size` voxels from `first` on in a grid of 8 x 8 x 8, by its own value.
template <class T>
std::vector<T> cube(int first, int size, T value)
{
  std::vector<T> voxels(kSide * kSide * kSide, T{0});
  for (int k = first; k < first + size; ++k)
    for (int j = first; j < first + size; ++j)
      for (int i = first; i < first + size; ++i)
        voxels[static_cast<std::size_t>((k * kSide + j) * kSide + i)] = value;
  return voxels;
}

template <class T>
std::string nrrd(const std::string& type, const std::vector<T>& voxels, double spacing = 0.5)
{
  const std::string h = spacing == 0.5 ? "0.5" : "1";
  return "NRRD0004\ntype: " + type +
         "\ndimension: 3\nspace: left-posterior-superior\nsizes: 8 8 8\nspace directions: (" + h +
         ",0,0) (0," + h + ",0) (0,0," + h +
         ")\nkinds: domain domain domain\nendian: little\nencoding: raw\nspace origin: "
         "(0,0,0)\n\n" +
         bytesOf(voxels);
}

std::string nifti(const std::vector<std::uint8_t>& voxels)
{
  TestNifti file;
  file.dims = {3, kSide, kSide, kSide, 1, 1, 1, 1};
  file.dataType = 2;
  file.bits = 8;
  file.pixdim = {1.0F, 0.5F, 0.5F, 0.5F, 1.0F, 1.0F, 1.0F, 1.0F};
  file.srow = {-0.5F, 0.0F, 0.0F, 0.0F, 0.0F, -0.5F, 0.0F, 0.0F, 0.0F, 0.0F, 0.5F, 0.0F};
  file.voxels = bytesOf(voxels);
  return file.bytes();
}

std::string metaImage(const std::vector<std::uint16_t>& voxels)
{
  return "ObjectType = Image\nNDims = 3\nBinaryData = True\nBinaryDataByteOrderMSB = False\n"
         "CompressedData = False\nTransformMatrix = 1 0 0 0 1 0 0 0 1\nOffset = 0 0 0\n"
         "ElementSpacing = 0.5 0.5 0.5\nDimSize = 8 8 8\nElementType = MET_USHORT\n"
         "ElementDataFile = LOCAL\n" +
         bytesOf(voxels);
}

/// "name=voxels" of each structure, a '|' after each map.
std::string contentsOf(const LoadedLabels& loaded)
{
  std::string text;
  for (const auto& map : loaded.maps)
  {
    for (const auto& segment : map.segments)
      text += segment.name + "=" + std::to_string(segment.voxels) + " ";
    text += "| ";
  }
  return text;
}

bool tellsOf(const std::vector<std::string>& lines, const std::string& start)
{
  return std::any_of(lines.begin(), lines.end(),
                     [&start](const std::string& line) { return line.find(start) == 0; });
}

} // namespace

TEST(LabelFolder, ReadsAStructureAFileOfEveryFormatIntoOneMap)
{
  const TestFolder folder;
  putGzip(folder / "cochlea.nii.gz", nifti(cube<std::uint8_t>(0, 2, 1)));
  putFile(folder / "facial_nerve.nrrd", nrrd("short", cube<std::int16_t>(2, 2, 300)));
  putFile(folder / "incus.mha", metaImage(cube<std::uint16_t>(4, 3, 7)));
  putFile(folder / "stapes.nrrd", nrrd("float", cube<float>(7, 1, 1.0F)));
  putFile(folder / "vein.nrrd", nrrd("uchar", cube<std::uint8_t>(0, 0, 1)));
  const LoadedLabels loaded = loadLabels(folder.path());
  EXPECT_EQ(contentsOf(loaded), "cochlea=8 facial_nerve=8 incus=27 stapes=1 vein=0 | ");
  EXPECT_TRUE(loaded.isNamedAfterFile);
  EXPECT_TRUE(loaded.leftOut.empty());
  ASSERT_EQ(loaded.maps.size(), 1U);
  const auto& voxels = *loaded.maps[0].voxels;
  EXPECT_EQ(voxels.at(1, 1, 1), 1);
  EXPECT_EQ(voxels.at(2, 3, 3), 2);
  EXPECT_EQ(voxels.at(6, 6, 6), 3);
  EXPECT_EQ(voxels.at(7, 7, 7), 4);
  EXPECT_EQ(voxels.at(0, 7, 0), 0);
  EXPECT_TRUE(
      core::sameGrid(voxels.geometry(), core::GridGeometry({8, 8, 8}, {0.5, 0.5, 0.5}, {0, 0, 0})));
  EXPECT_DOUBLE_EQ(loaded.fileVolumes.at("incus"), 27 * 0.125);
  EXPECT_DOUBLE_EQ(loaded.fileVolumes.at("vein"), 0.0);
}

TEST(LabelFolder, KeepsOverlapsInLayersAndGridsApart)
{
  const TestFolder folder;
  putFile(folder / "a.nrrd", nrrd("uchar", cube<std::uint8_t>(0, 4, 1)));
  putFile(folder / "b.nrrd", nrrd("uchar", cube<std::uint8_t>(3, 3, 1)));
  putFile(folder / "c.nrrd", nrrd("uchar", cube<std::uint8_t>(5, 2, 1)));
  putFile(folder / "d.nrrd", nrrd("uchar", cube<std::uint8_t>(1, 2, 1), 1.0));
  const LoadedLabels loaded = loadLabels(folder.path());
  EXPECT_EQ(contentsOf(loaded), "a=64 c=8 | b=27 | d=8 | ");
  EXPECT_EQ(loaded.maps[0].voxels->at(3, 3, 3), 1);
  EXPECT_EQ(loaded.maps[1].voxels->at(3, 3, 3), 2);
  EXPECT_EQ(loaded.maps[2].voxels->geometry().spacing()[0], 1.0);
  EXPECT_TRUE(tellsOf(loaded.notes, "its structures lie on 2 different grids"));
  EXPECT_TRUE(tellsOf(loaded.notes, "some of its structures overlap"));
}

TEST(LabelFolder, TellsOfEachFileThatIsNoStructure)
{
  const TestFolder folder;
  putFile(folder / "incus.nrrd", nrrd("uchar", cube<std::uint8_t>(0, 4, 1)));
  auto two = cube<std::uint8_t>(0, 4, 1);
  two[5] = 2;
  putFile(folder / "all.nrrd", nrrd("uchar", two));
  putFile(folder / "negative.nrrd", nrrd("short", cube<std::int16_t>(0, 4, -1)));
  putFile(folder / "half.nrrd", nrrd("float", cube<float>(0, 4, 0.5F)));
  putFile(folder / "statistics.json", "{}");
  putFile(folder / ".DS_Store", "x");
  std::filesystem::create_directory(folder / "more");
  const LoadedLabels loaded = loadLabels(folder.path());
  EXPECT_EQ(contentsOf(loaded), "incus=64 | ");
  EXPECT_EQ(loaded.leftOut.size(), 5U);
  EXPECT_TRUE(tellsOf(loaded.leftOut, "all.nrrd was left out: it holds more than one value"));
  EXPECT_TRUE(tellsOf(loaded.leftOut, "negative.nrrd was left out: it holds a value"));
  EXPECT_TRUE(tellsOf(loaded.leftOut, "half.nrrd was left out: it holds a value"));
  EXPECT_TRUE(tellsOf(loaded.leftOut, "statistics.json is no "));
  EXPECT_TRUE(tellsOf(loaded.leftOut, "more is not a file"));
}

TEST(LabelFolder, SaysThatAVoxelIsNotANumber)
{
  const TestFolder folder;
  putFile(folder / "incus.nrrd", nrrd("uchar", cube<std::uint8_t>(0, 4, 1)));
  auto first = cube<float>(0, 4, 1.0F);
  first[0] = std::numeric_limits<float>::quiet_NaN();
  putFile(folder / "first.nrrd", nrrd("float", first));
  auto last = cube<float>(0, 4, 1.0F);
  last.back() = std::numeric_limits<float>::quiet_NaN();
  putFile(folder / "last.nrrd", nrrd("float", last));
  const LoadedLabels loaded = loadLabels(folder.path());
  EXPECT_EQ(contentsOf(loaded), "incus=64 | ");
  for (const std::string name : {"first", "last"})
    EXPECT_TRUE(
        tellsOf(loaded.leftOut, name + ".nrrd was left out: it holds a voxel that is not a number"))
        << name;
  ASSERT_EQ(loaded.unread.size(), 2U) << "masks that are left out are structures that are not read";
  EXPECT_EQ(loaded.unread[0].name, "first");
  EXPECT_FALSE(loaded.unread[0].isEmpty);
  EXPECT_NE(loaded.unread[0].why.find("not a number"), std::string::npos);
}

TEST(LabelFolder, FollowsNoLinkOutOfTheFolder)
{
  const TestFolder folder;
  const TestFolder elsewhere;
  putFile(folder / "incus.nrrd", nrrd("uchar", cube<std::uint8_t>(0, 4, 1)));
  putFile(elsewhere / "a.nrrd", nrrd("uchar", cube<std::uint8_t>(0, 3, 1)));
  std::filesystem::create_symlink(elsewhere / "a.nrrd", folder / "stapes.nrrd");
  std::filesystem::create_symlink("incus.nrrd", folder / "malleus.nrrd");
  const std::string whole = nrrd("uchar", cube<std::uint8_t>(0, 2, 1));
  const std::size_t end = whole.find("\n\n") + 2;
  putFile(folder / "vein.nhdr", whole.substr(0, end - 1) + "data file: vein.raw\n\n");
  putFile(elsewhere / "vein.raw", whole.substr(end));
  std::filesystem::create_symlink(elsewhere / "vein.raw", folder / "vein.raw");
  const LoadedLabels loaded = loadLabels(folder.path());
  EXPECT_EQ(contentsOf(loaded), "incus=64 | malleus=64 | ") << "a link within the folder is read";
  EXPECT_TRUE(tellsOf(loaded.leftOut, "stapes.nrrd is a link to a file outside the folder"));
  EXPECT_TRUE(tellsOf(loaded.leftOut, "vein.nhdr belongs to a link"));
  // The folder itself may be reached by a link.
  std::filesystem::create_directory_symlink(folder.path(), elsewhere / "masks");
  EXPECT_EQ(contentsOf(loadLabels(elsewhere / "masks")), "incus=64 | malleus=64 | ");
}

TEST(LabelFolder, NumbersFilesThatDifferInTheirEndingOnly)
{
  const TestFolder folder;
  putFile(folder / "incus.nrrd", nrrd("uchar", cube<std::uint8_t>(0, 2, 1)));
  putFile(folder / "incus.mha", metaImage(cube<std::uint16_t>(4, 3, 7)));
  const LoadedLabels loaded = loadLabels(folder.path());
  EXPECT_EQ(contentsOf(loaded), "incus=27 incus 2=8 | ");
  EXPECT_DOUBLE_EQ(loaded.fileVolumes.at("incus"), 27 * 0.125);
  EXPECT_DOUBLE_EQ(loaded.fileVolumes.at("incus 2"), 8 * 0.125);
  EXPECT_TRUE(tellsOf(loaded.notes, "several of its files"));
}

TEST(LabelFolder, ADamagedMaskRefusesTheFolder)
{
  const TestFolder folder;
  putFile(folder / "incus.nrrd", nrrd("uchar", cube<std::uint8_t>(0, 4, 1)));
  const std::string whole = nrrd("uchar", cube<std::uint8_t>(0, 4, 1));
  putFile(folder / "stapes.nrrd", whole.substr(0, whole.size() - 9));
  try
  {
    loadLabels(folder.path());
    FAIL() << "the others without it would look complete";
  }
  catch (const FileError& error)
  {
    EXPECT_NE(std::string(error.what()).find("stapes.nrrd"), std::string::npos);
  }
}

TEST(LabelFolder, KnowsPairsOfHeaderAndVoxels)
{
  const TestFolder folder;
  const std::string whole = nrrd("uchar", cube<std::uint8_t>(0, 4, 1));
  const std::size_t end = whole.find("\n\n") + 2;
  putFile(folder / "incus.nhdr", whole.substr(0, end - 1) + "data file: incus.raw\n\n");
  putFile(folder / "incus.raw", whole.substr(end));
  const LoadedLabels loaded = loadLabels(folder.path());
  EXPECT_EQ(contentsOf(loaded), "incus=64 | ");
  EXPECT_TRUE(loaded.leftOut.empty());
}

TEST(LabelFolder, RefusesAFolderWithoutAMask)
{
  const TestFolder folder;
  expectRefused(refusalOf([&] { loadLabels(folder.path()); }), Reason::Unsupported,
                "folder without a mask");
  putFile(folder / "report.txt", "x");
  expectRefused(refusalOf([&] { loadLabels(folder.path()); }), Reason::Unsupported, "report.txt");
}

TEST(LabelFolder, CanBeCancelled)
{
  const TestFolder folder;
  putFile(folder / "incus.nrrd", nrrd("uchar", cube<std::uint8_t>(0, 4, 1)));
  const auto token = std::make_shared<core::CancelToken>();
  token->cancel();
  EXPECT_THROW(loadLabels(folder.path(), core::Progress([](double, const std::string&) {}, token)),
               core::CancelledError);
}

} // namespace petrous::imaging
