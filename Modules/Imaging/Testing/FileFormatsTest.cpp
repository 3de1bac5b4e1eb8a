#include "petrous/Imaging/FileFormats.h"

#include <algorithm>

#include <gtest/gtest.h>

#include "TestFiles.h"
#include "petrous/Imaging/ImageFile.h"
#include "petrous/Imaging/LabelFile.h"
#include "petrous/Imaging/MeshFile.h"
#include "petrous/Imaging/VolumeFile.h"

namespace petrous::imaging
{
namespace
{

using Reason = FileError::Reason;

const core::GridGeometry kGrid({4, 5, 6}, {0.5, 0.5, 1.0}, {1.0, 2.0, 3.0});

void write(const std::filesystem::path& path, FileContent content)
{
  if (content == kImage)
    writeVolume(path, volume::Volume<std::int16_t>(kGrid, std::int16_t{7}));
  if (content == kLabels)
  {
    volume::Segment nerve;
    nerve.name = "nerve";
    nerve.index = 1;
    writeLabelFile(path, volume::makeLabelMap(std::make_shared<volume::Volume<std::uint16_t>>(
                                                  kGrid, std::uint16_t{1}),
                                              {nerve}));
  }
  core::TriangleMesh mesh;
  mesh.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  mesh.triangles = {{0, 1, 2}};
  if (content == kMesh)
    writeMesh(path, mesh);
}

void read(const std::filesystem::path& path, FileContent content)
{
  core::Index3 dims = kGrid.dims();
  if (content == kImage)
    dims = readImageFile(path).volume->geometry().dims();
  if (content == kLabels)
    dims = readLabelFile(path).voxels->geometry().dims();
  EXPECT_EQ(dims, kGrid.dims()) << path;
  EXPECT_TRUE(content != kMesh || readMesh(path).triangles.size() == 1U) << path;
}

} // namespace

TEST(FileFormats, EveryWrittenEndingIsReadAndRecognisedAgain)
{
  const TestFolder folder;
  for (const FileContent content : {kImage, kLabels, kMesh})
  {
    EXPECT_FALSE(writtenEndings(content).empty());
    for (const std::string_view ending : writtenEndings(content))
    {
      const auto path = folder / ("A" + std::string(ending));
      write(path, content);
      read(path, content);
      EXPECT_TRUE(isReadAs(path, content)) << path;
      const FileFormat* found = recognisedFormat(path);
      const bool marked = ending != ".obj" && ending != ".stl"; // nor has STL in its binary form
      EXPECT_EQ(found ? found->name : "none", marked ? formatOf(path)->name : "none") << path;
    }
  }
}

TEST(FileFormats, AnEndingThatIsNotWrittenIsRefusedWithThoseThatAre)
{
  const TestFolder folder;
  for (const FileContent content : {kImage, kLabels, kMesh})
    for (const char* name : {"a", "a.tif", "a.nhdr", "a.mhd", "a.dcm", "nrrd"})
    {
      const Refusal refusal = refusalOf([&] { write(folder / name, content); });
      expectRefused(refusal, Reason::UnknownFormat);
      for (const std::string_view ending : writtenEndings(content))
        EXPECT_NE(refusal.text.find(ending), refusal.text.npos) << refusal.text;
    }
  EXPECT_EQ(folder.fileCount(), 0U);
  expectRefused(refusalOf([&] { write(folder / "a.mha", kLabels); }), Reason::UnknownFormat);
  expectRefused(refusalOf([&] { write(folder / "a.seg.nrrd", kImage); }), Reason::UnknownFormat);
}

// Each file under the name of each other format: the message gives the name that would be right.
TEST(FileFormats, AFileOfAnotherFormatThanItsNameSaysIsNamed)
{
  const TestFolder folder;
  write(folder / "a.nrrd", kImage);
  write(folder / "a.nii", kImage);
  write(folder / "a.nii.gz", kImage);
  write(folder / "a.mha", kImage);
  write(folder / "a.ply", kMesh);
  putFile(folder / "a.stl", "solid x\nendsolid x\n");
  putFile(folder / "a.dcm", std::string(128, '\0') + "DICM" + std::string(64, '\0'));
  const std::vector<std::string> all{".nrrd", ".nii", ".nii.gz", ".mha", ".ply", ".stl", ".dcm"};
  for (const std::string& is : all)
    for (const std::string& named :
         {std::string(".nrrd"), std::string(".nii"), std::string(".nii.gz"), std::string(".mha"),
          std::string(".ply"), std::string(".stl"), std::string(".obj")})
    {
      if (formatOf("x" + is)->name == formatOf("x" + named)->name)
        continue;
      const auto path = folder / ("b" + named);
      std::filesystem::copy_file(folder / ("a" + is), path,
                                 std::filesystem::copy_options::overwrite_existing);
      const Refusal refusal = refusalOf(
          [&]
          {
            if (isReadAs(path, kMesh))
              readMesh(path);
            else
              readImageFile(path);
          });
      ASSERT_TRUE(refusal.thrown) << is << " as " << named;
      EXPECT_EQ(refusal.reason, Reason::UnknownFormat) << refusal.text;
      EXPECT_NE(refusal.text.find("end its name in " + is), refusal.text.npos) << refusal.text;
    }
}

TEST(FileFormats, ListsEachEndingOnceAndNoneThatAnotherCovers)
{
  EXPECT_EQ(orText(readEndings(kMesh)), ".obj, .stl, .ply or .vtp");
  EXPECT_EQ(orText(readEndings(kImage | kLabels)),
            ".nrrd, .nhdr, .nii.gz, .nii, .hdr, .img, .mha or .mhd");
  EXPECT_EQ(orText(readEndings(kDicom)), ".dcm");
  EXPECT_EQ(orText(writtenEndings(kLabels)), ".seg.nrrd, .nrrd, .nii.gz or .nii");
  EXPECT_EQ(orText({}), "");
}

TEST(FileFormats, TheLongestEndingIsTheFormatAndIsLeftOutOfTheName)
{
  for (const auto& [name, ending, base] :
       {std::tuple("Ear.SEG.NRRD", ".seg.nrrd", "Ear"), std::tuple("a.seg.nhdr", ".seg.nhdr", "a"),
        std::tuple("facial_nerve.NII.gz", ".nii.gz", "facial_nerve"),
        std::tuple("v1.2.nrrd", ".nrrd", "v1.2"), std::tuple("a.nii.ply", ".ply", "a.nii"),
        std::tuple("slice.DCM", ".dcm", "slice"), std::tuple("table.ctbl", "", "table"),
        std::tuple("a.gz", "", "a"), std::tuple("nrrd", "", "nrrd")})
  {
    const FileFormat* format = formatOf(name);
    EXPECT_EQ(format ? format->ending : "", ending) << name;
    EXPECT_EQ(baseName(std::filesystem::path("folder.nrrd") / name), base) << name;
  }
}

} // namespace petrous::imaging
