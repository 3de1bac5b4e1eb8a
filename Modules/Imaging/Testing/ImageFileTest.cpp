#include "petrous/Imaging/ImageFile.h"
#include "petrous/Imaging/ImagePreview.h"

#include <cmath>
#include <limits>
#include <numeric>

#include <Eigen/Geometry>
#include <bzlib.h>
#include <gtest/gtest.h>
#include <itkOutputWindow.h>
#include <sys/stat.h>

#include "petrous/Core/InputFile.h"
#include "petrous/Core/Log.h"
#include "petrous/Core/NumberText.h"
#include "petrous/Imaging/LabelFile.h"
#include "petrous/Imaging/MeshFile.h"
#include "petrous/Imaging/VolumeFile.h"

#include "TestFiles.h"

namespace petrous::imaging
{
namespace
{

using Reason = FileError::Reason;

template <class T>
bool holds(const LoadedImage& image)
{
  return std::holds_alternative<std::shared_ptr<const volume::Volume<T>>>(image.volume->voxels());
}

template <class T>
std::vector<T> counting(std::size_t count)
{
  std::vector<T> values(count);
  std::iota(values.begin(), values.end(), T{0});
  return values;
}

bool noted(const LoadedImage& image, const std::string& word)
{
  for (const std::string& note : image.notes)
    if (note.find(word) != note.npos)
      return true;
  return false;
}

/// A NRRD of 4 x 3 x 2 voxels, written by hand.
std::string nrrd(const std::string& type, const std::string& voxels,
                 const std::string& directions = "(0.5,0,0) (0,0.25,0) (0,0,2)",
                 const std::string& more = "", const std::string& space = "left-posterior-superior")
{
  return "NRRD0004\ntype: " + type + "\ndimension: 3\nspace: " + space +
         "\nsizes: 4 3 2\nspace directions: " + directions +
         "\nkinds: domain domain domain\nendian: little\nencoding: raw\nspace origin: "
         "(10,20,30)\n" +
         more + "\n" + voxels;
}

TestNifti shortNifti()
{
  TestNifti nifti;
  nifti.voxels = bytesOf(counting<std::int16_t>(24));
  return nifti;
}

TEST(ImageFile, KeepsTheTypesOfCtAndMr)
{
  const TestFolder folder;
  const auto a =
      readImageFile(putFile(folder / "a.nrrd", nrrd("short", bytesOf(counting<std::int16_t>(24)))));
  EXPECT_TRUE(holds<std::int16_t>(a));
  EXPECT_EQ(a.volume->at(1, 2, 1), 1 + 4 * (2 + 3 * 1));
  EXPECT_TRUE(holds<std::uint16_t>(readImageFile(
      putFile(folder / "b.nrrd", nrrd("ushort", bytesOf(counting<std::uint16_t>(24)))))));
  EXPECT_TRUE(holds<float>(
      readImageFile(putFile(folder / "c.nrrd", nrrd("float", bytesOf(counting<float>(24)))))));
}

TEST(ImageFile, NarrowsOtherTypesOnlyWhereNoValueChanges)
{
  const TestFolder folder;
  const auto read = [&folder](const std::string& type, const std::string& voxels)
  { return readImageFile(putFile(folder / "a.nrrd", nrrd(type, voxels))); };
  EXPECT_TRUE(holds<std::int16_t>(read("uchar", bytesOf(std::vector<std::uint8_t>(24, 200)))));
  EXPECT_EQ(read("uchar", bytesOf(std::vector<std::uint8_t>(24, 200))).volume->at(0, 0, 0), 200);
  EXPECT_EQ(read("signed char", bytesOf(std::vector<std::int8_t>(24, -100))).volume->at(0, 0, 0),
            -100);
  EXPECT_TRUE(holds<std::int16_t>(read("int", bytesOf(std::vector<std::int32_t>(24, -1000)))));
  EXPECT_TRUE(holds<std::uint16_t>(read("uint", bytesOf(std::vector<std::uint32_t>(24, 60000)))));
  EXPECT_TRUE(holds<float>(read("int", bytesOf(std::vector<std::int32_t>(24, 70000)))));
  EXPECT_TRUE(holds<std::int16_t>(read("int64", bytesOf(std::vector<std::int64_t>(24, 12)))));
  EXPECT_TRUE(holds<std::int16_t>(read("double", bytesOf(std::vector<double>(24, -1024.0)))));
  const auto half = read("double", bytesOf(std::vector<double>(24, 0.5)));
  EXPECT_TRUE(holds<float>(half));
  EXPECT_EQ(half.volume->at(3, 2, 1), 0.5);
}

TEST(ImageFile, SaysByHowMuchValuesWereRounded)
{
  const TestFolder folder;
  const auto note = [&folder](const std::string& type, const std::string& voxels)
  {
    for (const std::string& each :
         readImageFile(putFile(folder / "a.nrrd", nrrd(type, voxels))).notes)
      if (each.find("rounded") != each.npos)
        return each;
    return std::string();
  };
  std::vector<std::int32_t> whole(24, 16777216); // 2^24: what float counts up to
  EXPECT_EQ(note("int", bytesOf(whole)), "");
  whole[5] = 16777217;
  EXPECT_EQ(note("int", bytesOf(whole)),
            "Values were rounded to 32-bit floating point, by up to 1.");
  std::vector<double> real(24, 0.5);
  EXPECT_EQ(note("double", bytesOf(real)), "");
  real[7] = 0.5 + std::ldexp(1.0, -26);
  EXPECT_EQ(note("double", bytesOf(real)),
            "Values were rounded to 32-bit floating point, by up to 0.0000000149.");
}

TEST(ImageFile, ReadsBigEndianVoxels)
{
  const TestFolder folder;
  std::string bytes = nrrd("short", std::string(48, '\0'));
  bytes.replace(bytes.find("little"), 6, "big");
  bytes[bytes.size() - 48] = 1; // the first voxel's high byte
  EXPECT_EQ(readImageFile(putFile(folder / "a.nrrd", bytes)).volume->at(0, 0, 0), 256);
}

TEST(ImageFile, ReadsNiftiAsLps)
{
  const TestFolder folder;
  TestNifti nifti = shortNifti();
  // First axis to the left, second anterior, third up; RAS mm.
  nifti.srow = {-2.0F, 0.0F, 0.0F, 90.0F, 0.0F, 3.0F, 0.0F, -126.0F, 0.0F, 0.0F, 4.0F, -72.0F};
  nifti.pixdim = {1.0F, 2.0F, 3.0F, 4.0F, 1.0F, 1.0F, 1.0F, 1.0F};
  for (const bool packed : {false, true})
  {
    const auto path = packed ? putGzip(folder / "a.nii.gz", nifti.bytes())
                             : putFile(folder / "a.nii", nifti.bytes());
    const auto image = readImageFile(path);
    const auto& grid = image.volume->geometry();
    // RAS (90 - 2 i, -126 + 3 j, -72 + 4 k); LPS negates the first two.
    const Eigen::Vector3d p = grid.patientFromVoxel({3.0, 2.0, 1.0});
    EXPECT_TRUE(p.isApprox(Eigen::Vector3d(-84.0, 120.0, -68.0), 1e-9)) << p.transpose();
    EXPECT_EQ(image.volume->at(3, 2, 1), 23);
    EXPECT_TRUE(image.notes.empty());
  }
}

TEST(ImageFile, ReadsTheQformByTheStandard)
{
  const TestFolder folder;
  TestNifti nifti = shortNifti();
  nifti.sform = 0;
  nifti.qform = 1;
  // 90 degrees about z: x maps to y; qfac -1 mirrors the third axis.
  const float s = std::sqrt(0.5F);
  nifti.quaternion = {0.0F, 0.0F, s};
  nifti.pixdim = {-1.0F, 2.0F, 3.0F, 4.0F, 1.0F, 1.0F, 1.0F, 1.0F};
  nifti.offset = {5.0F, 6.0F, 7.0F};
  const auto image = readImageFile(putFile(folder / "a.nii", nifti.bytes()));
  // RAS: (5 - 3 j, 6 + 2 i, 7 - 4 k).
  const Eigen::Vector3d p = image.volume->geometry().patientFromVoxel({1.0, 1.0, 1.0});
  EXPECT_TRUE(p.isApprox(Eigen::Vector3d(-2.0, -8.0, 3.0), 1e-6)) << p.transpose();
}

TEST(ImageFile, ReadsTheSecondNiftiAndPairsOfFiles)
{
  const TestFolder folder;
  TestNifti nifti = shortNifti();
  nifti.srow = {-2.0F, 0.0F, 0.0F, 90.0F, 0.0F, 3.0F, 0.0F, -126.0F, 0.0F, 0.0F, 4.0F, -72.0F};
  nifti.qform = 1; // both placements, in the same words
  nifti.quaternion = {0.0F, 1.0F, 0.0F};
  nifti.offset = {90.0F, -126.0F, -72.0F};
  nifti.pixdim = {-1.0F, 2.0F, 3.0F, 4.0F, 1.0F, 1.0F, 1.0F, 1.0F};
  std::string swapped = nifti.voxels;
  for (std::size_t v = 0; v < swapped.size(); v += 2)
    std::swap(swapped[v], swapped[v + 1]);
  std::string pair = nifti.bytes().substr(0, 348);
  pair.replace(344, 3, "ni1");
  const std::string start(16, 'x');

  putFile(folder / "a.nii", nifti.second("n+2", 544) + nifti.voxels);
  putFile(folder / "b.nii", nifti.second("n+2", 544, true) + swapped);
  putFile(folder / "c.nii", nifti.second("n+2", 560) + start + nifti.voxels);
  putGzip(folder / "d.nii.gz", nifti.second("n+2", 544) + nifti.voxels);
  putFile(folder / "e.hdr", pair);
  const float none = 0.0F; // vox_offset counts within the other file
  std::memcpy(pair.data() + 108, &none, sizeof none);
  putFile(folder / "e.hdr", pair);
  putFile(folder / "e.img", nifti.voxels);
  putFile(folder / "f.hdr", nifti.second("ni2", 16).substr(0, 540));
  putFile(folder / "f.img", start + nifti.voxels);
  for (const char* name :
       {"a.nii", "b.nii", "c.nii", "d.nii.gz", "e.hdr", "e.img", "f.hdr", "f.img"})
  {
    const auto image = readImageFile(folder / name);
    const Eigen::Vector3d p = image.volume->geometry().patientFromVoxel({3.0, 2.0, 1.0});
    EXPECT_TRUE(p.isApprox(Eigen::Vector3d(-84.0, 120.0, -68.0), 1e-12)) << name << p.transpose();
    EXPECT_EQ(image.volume->at(3, 2, 1), 23) << name;
    EXPECT_EQ(image.volume->at(1, 0, 0), 1) << name;
    EXPECT_TRUE(image.notes.empty()) << name << " " << image.notes.front();
  }

  nifti.slope = 0.5F;
  nifti.intercept = -1000.0F;
  EXPECT_EQ(readImageFile(putFile(folder / "g.nii", nifti.second("n+2", 544) + nifti.voxels))
                .volume->at(3, 2, 1),
            23 * 0.5 - 1000.0);
}

TEST(ImageFile, RefusesPairsThatAreNotWhole)
{
  const TestFolder folder;
  const TestNifti nifti = shortNifti();
  const auto refusal = [&folder](const char* name)
  { return refusalOf([&] { readImageFile(folder / name); }); };
  putFile(folder / "a.hdr", nifti.second("ni2", 0));
  expectRefused(refusal("a.hdr"), Reason::NotFound, "one folder");
  putFile(folder / "a.img", nifti.voxels.substr(1));
  expectRefused(refusal("a.hdr"), Reason::Unreadable, "too short");
  putFile(folder / "b.img", nifti.voxels);
  expectRefused(refusal("b.img"), Reason::NotFound, "one folder");
  std::string analyze = nifti.bytes().substr(0, 348);
  analyze.replace(344, 4, std::string(4, '\0'));
  putFile(folder / "b.hdr", analyze);
  expectRefused(refusal("b.img"), Reason::Unsupported, "left");
  putFile(folder / "b.hdr", nifti.second("n+2", 544) + nifti.voxels);
  expectRefused(refusal("b.hdr"), Reason::UnknownFormat, ".nii");
  putFile(folder / "c.nii", nifti.second("ni2", 544) + nifti.voxels);
  expectRefused(refusal("c.nii"), Reason::UnknownFormat, ".hdr");
  putFile(folder / "d.nii", nifti.second("n+2", 544).substr(0, 400));
  expectRefused(refusal("d.nii"), Reason::Unreadable, "header");
  TestNifti huge = nifti;
  std::string bytes = huge.second("n+2", 544) + nifti.voxels;
  const std::int64_t absurd = std::int64_t{1} << 62;
  for (std::size_t at : {std::size_t{24}, std::size_t{32}, std::size_t{40}})
    std::memcpy(bytes.data() + at, &absurd, sizeof absurd);
  putFile(folder / "e.nii", bytes);
  expectRefused(refusal("e.nii"), Reason::Unreadable, "too short");
}

TEST(ImageFile, AppliesTheRescaleOfNifti)
{
  const TestFolder folder;
  TestNifti nifti = shortNifti();
  nifti.intercept = -1024.0F;
  const auto ct = readImageFile(putFile(folder / "a.nii", nifti.bytes()));
  EXPECT_TRUE(holds<std::int16_t>(ct));
  EXPECT_EQ(ct.volume->at(3, 2, 1), 23 - 1024);
  nifti.slope = 0.1F;
  const auto mr = readImageFile(putFile(folder / "b.nii", nifti.bytes()));
  EXPECT_TRUE(holds<float>(mr));
  EXPECT_NEAR(mr.volume->at(3, 2, 1), 2.3 - 1024.0, 1e-3);
  nifti.slope = std::numeric_limits<float>::quiet_NaN();
  expectRefused(refusalOf([&] { readImageFile(putFile(folder / "c.nii", nifti.bytes())); }),
                Reason::Unreadable, "slope");
}

/// The same image, 4 x 3 x 2 voxels of 0.5 mm from 10, 20, 30 mm, in units of `unit` mm; `said`:
/// what the file calls it.
std::string niftiIn(double unit, char said)
{
  TestNifti nifti = shortNifti();
  const auto of = [unit](double mm) { return static_cast<float>(mm / unit); };
  nifti.srow = {of(-0.5), 0.0F,      0.0F, of(-10.0), 0.0F,    of(-0.5),
                0.0F,     of(-20.0), 0.0F, 0.0F,      of(0.5), of(30.0)}; // RAS
  nifti.units = said;
  return nifti.bytes();
}
std::string textOf(double value)
{
  return core::generalText(value, 12);
}
std::string nrrdIn(double unit, const std::string& said)
{
  const std::string h = textOf(0.5 / unit);
  std::string text =
      nrrd("short", bytesOf(counting<std::int16_t>(24)),
           "(" + h + ",0,0) (0," + h + ",0) (0,0," + h + ")",
           said.empty() ? "" : "space units: \"" + said + "\" \"" + said + "\" \"" + said + "\"\n");
  const std::string origin =
      "(" + textOf(10.0 / unit) + "," + textOf(20.0 / unit) + "," + textOf(30.0 / unit) + ")";
  return text.replace(text.find("(10,20,30)"), 10, origin);
}
std::string metaIn(double unit, const std::string& said)
{
  const std::string h = textOf(0.5 / unit) + " ";
  return "ObjectType = Image\nNDims = 3\nBinaryData = True\nTransformMatrix = 1 0 0 0 1 0 0 0 1\n"
         "Offset = " +
         textOf(10.0 / unit) + " " + textOf(20.0 / unit) + " " + textOf(30.0 / unit) +
         "\nElementSpacing = " + h + h + h + "\nDimSize = 4 3 2\n" +
         (said.empty() ? "" : "DistanceUnits = " + said + "\n") +
         "ElementType = MET_SHORT\nElementDataFile = LOCAL\n" + bytesOf(counting<std::int16_t>(24));
}

TEST(ImageFile, TurnsUnitsIntoMillimetresAndNotesThem)
{
  const TestFolder folder;
  const core::GridGeometry truth({4, 3, 2}, {0.5, 0.5, 0.5}, {10.0, 20.0, 30.0});
  const auto expectTruth = [&](const std::filesystem::path& path, const char* word)
  {
    const LoadedImage image = readImageFile(path);
    EXPECT_TRUE(core::sameGrid(image.volume->geometry(), truth, 1e-4)) << path << word;
    EXPECT_TRUE(noted(image, word)) << path << word;
    EXPECT_TRUE(unitDoubtOf(path).likely.empty()) << path << word;
  };
  expectTruth(putFile(folder / "0.nii", niftiIn(1.0, 0)), "taken as mm");
  expectTruth(putFile(folder / "1.nii", niftiIn(1000.0, 1)), "is in m;");
  expectTruth(putFile(folder / "3.nii", niftiIn(0.001, 3)), "is in um;");
  expectTruth(putFile(folder / "no.nrrd", nrrdIn(1.0, "")), "taken as mm");
  expectTruth(putFile(folder / "m.nrrd", nrrdIn(1000.0, "m")), "is in m;");
  expectTruth(putFile(folder / "um.nrrd", nrrdIn(0.001, "um")), "is in um;");
  expectTruth(putFile(folder / "cm.nrrd", nrrdIn(10.0, "cm")), "is in cm;");
  expectTruth(putFile(folder / "no.mha", metaIn(1.0, "")), "taken as mm");
  expectTruth(putFile(folder / "um.mha", metaIn(0.001, "um")), "is in um;");
  expectTruth(putFile(folder / "m.mha", metaIn(1000.0, "m")), "is in m;");
}

// What was read and what was assumed, and not the one and then the other.
TEST(ImageFile, SaysInWhichUnitAFileWasRead)
{
  const TestFolder folder;
  const auto notesOf = [&](char unit, const std::optional<double>& asked)
  {
    std::string all;
    const auto path = putFile(folder / "a.nii", niftiIn(1000.0, unit)); // 0.0005 each
    for (const std::string& note : readImageFile(path, {}, {}, {}, 0, asked).notes)
      all += note + "\n";
    return all;
  };
  EXPECT_EQ(notesOf(1, {}), "is in m; converted, its voxels are 0.5 x 0.5 x 0.5 mm\n");
  EXPECT_EQ(notesOf(1, 10.0), "states m, but its numbers were taken in units of 10 mm, as "
                              "asked: its voxels are 0.005 x 0.005 x 0.005 mm\n");
  EXPECT_EQ(notesOf(1, 1000.0),
            "states m, which was taken, as asked: its voxels are 0.5 x 0.5 x 0.5 mm\n");
  EXPECT_EQ(notesOf(0, 1000.0), "states no unit of length, but its numbers were taken in units of "
                                "1000 mm, as asked: its voxels are 0.5 x 0.5 x 0.5 mm\n");
  EXPECT_EQ(notesOf(2, {}), "");
}

// Half a millimetre is 500 micrometres, and 0.0005 metres.
TEST(ImageFile, AsksForTheUnitWhereTheSizeMakesNoSense)
{
  const TestFolder folder;
  const core::GridGeometry truth({4, 3, 2}, {0.5, 0.5, 0.5}, {10.0, 20.0, 30.0});
  struct Case
  {
    std::filesystem::path path;
    double real;   ///< mm
    double stated; ///< mm; taken, if it is not stated
    bool isStated;
  };
  for (const Case& one : {Case{putFile(folder / "a.nii", niftiIn(0.001, 0)), 0.001, 1.0, false},
                          {putFile(folder / "b.nii", niftiIn(1000.0, 0)), 1000.0, 1.0, false},
                          {putFile(folder / "c.nii", niftiIn(1.0, 3)), 1.0, 0.001, true},
                          {putFile(folder / "d.nii", niftiIn(1.0, 1)), 1.0, 1000.0, true},
                          {putFile(folder / "a.nrrd", nrrdIn(0.001, "")), 0.001, 1.0, false},
                          {putFile(folder / "b.nrrd", nrrdIn(1.0, "um")), 1.0, 0.001, true},
                          {putFile(folder / "a.mha", metaIn(0.001, "")), 0.001, 1.0, false},
                          {putFile(folder / "b.mha", metaIn(1000.0, "mm")), 1000.0, 1.0, true}})
  {
    SCOPED_TRACE(one.path.filename());
    const UnitDoubt doubt = unitDoubtOf(one.path);
    EXPECT_EQ(doubt.unit, one.stated);
    EXPECT_EQ(doubt.isStated, one.isStated);
    EXPECT_NEAR(doubt.edge, 2.0 * one.stated / one.real, 1e-6 * doubt.edge);
    EXPECT_EQ(std::count(doubt.likely.begin(), doubt.likely.end(), one.real), 1);
    const LoadedImage image = readImageFile(one.path, {}, {}, {}, 0, one.real);
    EXPECT_TRUE(core::sameGrid(image.volume->geometry(), truth, 1e-4));
    EXPECT_TRUE(noted(image, "as asked"));
    // Nothing is scaled without being asked: the library's own files are read so, too.
    const core::GridGeometry asStated = readImageFile(one.path).volume->geometry();
    EXPECT_TRUE(asStated.spacing().isApprox(one.stated / one.real * truth.spacing(), 1e-6));
    // The grid of the image of which they are settles it for labels.
    const LoadedLabels alone = loadLabels(one.path);
    EXPECT_FALSE(alone.unitDoubt.likely.empty());
    const LoadedLabels beside = loadLabels(one.path, {}, {}, {truth});
    EXPECT_TRUE(beside.unitDoubt.likely.empty());
    EXPECT_TRUE(core::sameGrid(beside.maps.front().voxels->geometry(), truth, 1e-4));
  }
  // A micro-CT of 5 micrometres, and a whole body.
  TestNifti specimen = shortNifti();
  specimen.srow = {-0.005F, 0.0F, 0.0F, 0.0F, 0.0F, -0.005F, 0.0F, 0.0F, 0.0F, 0.0F, 5.0F, 0.0F};
  EXPECT_TRUE(unitDoubtOf(putFile(folder / "specimen.nii", specimen.bytes())).likely.empty());
  specimen.srow = {-4.0F, 0.0F, 0.0F, 0.0F, 0.0F, -4.0F, 0.0F, 0.0F, 0.0F, 0.0F, 900.0F, 0.0F};
  EXPECT_TRUE(unitDoubtOf(putFile(folder / "body.nii", specimen.bytes())).likely.empty());
}

// A head of 200 mm in micrometres that states no unit, or says millimetres: its place, 200 m and
// more from the origin, is no reason to refuse it before its unit is known.
TEST(ImageFile, AsksForTheUnitBeforeItJudgesThePlace)
{
  const TestFolder folder;
  TestNifti nifti = shortNifti();
  nifti.dims = {3, 401, 401, 3, 1, 1, 1, 1};
  nifti.voxels.assign(std::size_t{2} * 401 * 401 * 3, '\0');
  nifti.voxels[0] = 1; // read as labels, too
  nifti.pixdim = {1.0F, 500.0F, 500.0F, 500.0F, 1.0F, 1.0F, 1.0F, 1.0F};
  // An axis off perpendicular by 1e-4, 0.02 mm over the slice.
  nifti.srow = {-500.0F, 0.0F, 0.0F, 1e5F, 0.05F, -500.0F, 0.0F, 1e5F, 0.0F, 0.0F, 500.0F, -9e4F};
  for (const int units : {0, 2})
  {
    SCOPED_TRACE(units);
    nifti.units = static_cast<char>(units);
    const auto path = putFile(folder / ("head" + std::to_string(units) + ".nii"), nifti.bytes());
    const UnitDoubt doubt = unitDoubtOf(path);
    EXPECT_EQ(doubt.isStated, units == 2);
    EXPECT_EQ(std::count(doubt.likely.begin(), doubt.likely.end(), 1e-3), 1);
    EXPECT_FALSE(readImageHeader(path).unitDoubt.likely.empty());
    EXPECT_FALSE(loadLabels(path).unitDoubt.likely.empty());
    const core::GridGeometry grid = readImageFile(path, {}, {}, {}, 0, 1e-3).volume->geometry();
    EXPECT_TRUE(grid.spacing().isApprox(Eigen::Vector3d::Constant(0.5), 1e-6));
    EXPECT_TRUE(grid.origin().isApprox(Eigen::Vector3d(-100.0, -100.0, -90.0), 1e-3));
    expectRefused(refusalOf([&] { readImageFile(path); }), Reason::NoGeometry,
                  "from the origin of the patient's frame");
    expectRefused(refusalOf([&] { previewImageFile(path, 2); }), Reason::NoGeometry,
                  "from the origin of the patient's frame");
    expectRefused(refusalOf([&] { readImageFile(path, {}, {}, {}, 0, 1.0); }), Reason::NoGeometry,
                  "from the origin of the patient's frame");
  }
}

// The library keeps such files, too: labels of a cut-out of a micro-CT, and of a phantom.
TEST(ImageFile, AFileOfThisProgramIsReadInMillimetresWhateverItsSize)
{
  const TestFolder folder;
  for (const double spacing : {0.001, 400.0})
  {
    const core::GridGeometry grid({8, 8, 8}, Eigen::Vector3d::Constant(spacing),
                                  {10.0, 20.0, 30.0});
    auto voxels = std::make_shared<volume::Volume<std::uint16_t>>(grid, std::uint16_t{0});
    voxels->at(1, 2, 3) = 1;
    volume::Segment nerve;
    nerve.name = "nerve";
    nerve.index = 1;
    const auto path = folder / "labels.seg.nrrd";
    writeLabelFile(path, volume::makeLabelMap(voxels, {nerve}));
    EXPECT_FALSE(unitDoubtOf(path).likely.empty()) << "no head, ear or specimen";
    const core::GridGeometry read = readLabelFile(path).voxels->geometry();
    EXPECT_TRUE(read.spacing().isApprox(grid.spacing(), 1e-6)) << spacing;
    EXPECT_TRUE(read.origin().isApprox(grid.origin(), 1e-6)) << spacing;
  }
}

// 0.4 mm, whatever unit the file states.
TEST(ImageFile, NotesOfItsPlaceAreInTheUnitThatWasTaken)
{
  const TestFolder folder;
  TestNifti nifti = shortNifti();
  nifti.units = 0;
  nifti.qform = 1;
  nifti.pixdim = {1.0F, 500.0F, 500.0F, 500.0F, 1.0F, 1.0F, 1.0F, 1.0F};
  nifti.srow = {500.0F, 0.0F, 0.0F, 0.0F, 0.0F, 500.0F, 0.0F, 0.0F, 0.0F, 0.0F, 500.0F, 0.0F};
  nifti.offset = {400.0F, 0.0F, 0.0F};
  const auto path = putFile(folder / "a.nii", nifti.bytes());
  const auto asked = readImageFile(path, {}, {}, {}, 0, 0.001);
  EXPECT_TRUE(noted(asked, "up to 0.4 mm apart"));
  EXPECT_FALSE(noted(asked, "up to 400 mm apart"));
  EXPECT_TRUE(noted(readImageFile(path), "up to 400 mm apart"));
  nifti.offset = {40.0F, 0.0F, 0.0F}; // 0.04 mm are not worth a note
  EXPECT_FALSE(noted(readImageFile(putFile(folder / "b.nii", nifti.bytes()), {}, {}, {}, 0, 0.001),
                     "places itself twice"));
}

TEST(ImageFile, RefusesShearWithTheMillimetresAtStake)
{
  const TestFolder folder;
  TestNifti nifti = shortNifti();
  nifti.dims = {3, 101, 101, 11, 1, 1, 1, 1};
  nifti.voxels.assign(std::size_t{2} * 101 * 101 * 11, '\0');
  nifti.srow[8 + 1] = 0.1F; // z sheared along y by 5.7 degrees
  const Refusal refusal =
      refusalOf([&] { readImageFile(putFile(folder / "a.nii", nifti.bytes())); });
  expectRefused(refusal, Reason::NoGeometry, "degrees");
  EXPECT_NE(refusal.text.find(" mm"), std::string::npos);
  nifti.srow[8 + 1] = 5e-4F; // below 0.1 mm: orthogonalized and noted
  const auto image = readImageFile(putFile(folder / "b.nii", nifti.bytes()));
  EXPECT_TRUE(noted(image, "straightened"));
  const auto& grid = image.volume->geometry();
  const Eigen::Vector3d far = grid.patientFromVoxel({100.0, 100.0, 10.0});
  EXPECT_NEAR((far - Eigen::Vector3d(-100.0, -100.0, 10.0 + 100.0 * 5e-4)).norm(), 0.0, 0.04);
  expectRefused(refusalOf(
                    [&]
                    {
                      readImageFile(putFile(folder / "c.nrrd",
                                            nrrd("short", bytesOf(counting<std::int16_t>(24)),
                                                 "(0.5,0,0) (0.1,0.25,0) (0,0,2)")));
                    }),
                Reason::NoGeometry, "perpendicular");
  expectRefused(refusalOf(
                    [&]
                    {
                      readImageFile(putFile(folder / "d.nrrd",
                                            nrrd("short", bytesOf(counting<std::int16_t>(24)),
                                                 "(0.5,0,0) (0,0,0) (0,0,2)")));
                    }),
                Reason::NoGeometry);
}

TEST(ImageFile, RotatedCosinesAreNoFault)
{
  const TestFolder folder;
  const Eigen::Matrix3d turn =
      Eigen::AngleAxisd(0.7, Eigen::Vector3d(0.3, -0.2, 0.9).normalized()).toRotationMatrix();
  const core::GridGeometry grid({4, 3, 2}, {0.4, 0.5, 0.6}, {-80.0, 12.5, 3.0}, turn);
  const volume::Volume<std::int16_t> voxels(grid, 7);
  for (const char* name : {"a.nrrd", "a.nii", "a.nii.gz", "a.mha"})
  {
    writeVolume(folder / name, voxels);
    const auto image = readImageFile(folder / name);
    EXPECT_TRUE(core::sameGrid(image.volume->geometry(), grid, 1e-4)) << name;
    EXPECT_TRUE(image.notes.empty()) << name << " " << image.notes.front();
  }
}

TEST(ImageFile, NotesWhenQformAndSformDisagree)
{
  const TestFolder folder;
  TestNifti nifti = shortNifti();
  nifti.qform = 1;
  EXPECT_TRUE(readImageFile(putFile(folder / "a.nii", nifti.bytes())).notes.empty());
  nifti.offset = {0.0F, 0.0F, 3.0F};
  const auto image = readImageFile(putFile(folder / "b.nii", nifti.bytes()));
  EXPECT_TRUE(noted(image, "3 mm apart"));
  EXPECT_EQ(image.volume->geometry().origin()[2], 0.0);
}

// nifti1.h: NIFTI_XFORM_TALAIRACH 3, NIFTI_XFORM_MNI_152 4.
TEST(ImageFile, TakesTheScannersPlaceAndNotThatOfATemplate)
{
  const TestFolder folder;
  TestNifti nifti = shortNifti();
  nifti.offset = {0.0F, 0.0F, 3.0F};
  for (const std::int16_t code : {std::int16_t{3}, std::int16_t{4}})
  {
    nifti.sform = code;
    nifti.qform = 1;
    const auto image = readImageFile(putFile(folder / "a.nii", nifti.bytes()));
    EXPECT_TRUE(noted(image, "space of a template")) << code;
    EXPECT_EQ(image.volume->geometry().origin()[2], 3.0) << code;
    nifti.qform = code; // all of it lies there
    EXPECT_EQ(
        readImageFile(putFile(folder / "b.nii", nifti.bytes())).volume->geometry().origin()[2],
        0.0);
  }
}

// Of a label map the grid of the image on which it was drawn tells which place is meant.
TEST(ImageFile, TakesThePlaceOfLabelsByWhichTheirGridIsThatOfAnImage)
{
  const TestFolder folder;
  TestNifti nifti = shortNifti();
  nifti.offset = {0.0F, 0.0F, 3.0F}; // of the qform; the sform is at 0
  nifti.qform = 1;
  const auto gridAt = [](double z)
  {
    return ImageGrid(core::GridGeometry({4, 3, 2}, Eigen::Vector3d::Ones(), {0.0, 0.0, z},
                                        Eigen::Vector3d(-1.0, -1.0, 1.0).asDiagonal()));
  };
  for (const std::int16_t code : {std::int16_t{1}, std::int16_t{4}}) // the scanner's, a template's
  {
    SCOPED_TRACE(code);
    nifti.sform = code;
    const auto path = putFile(folder / "labels.nii", nifti.bytes());
    const auto read = [&](const std::vector<ImageGrid>& images)
    { return loadLabels(path, {}, {}, images); };
    const auto says = [](const LoadedLabels& labels, const std::string& words)
    {
      return std::any_of(labels.notes.begin(), labels.notes.end(),
                         [&words](const auto& note)
                         { return note.find(words) != std::string::npos; });
    };
    const auto height = [](const LoadedLabels& labels)
    { return labels.maps.at(0).voxels->geometry().origin()[2]; };
    const double first = code == 1 ? 0.0 : 3.0;
    EXPECT_NEAR(height(read({})), first, 1e-6);
    for (const double z : {0.0, 3.0})
    {
      const LoadedLabels labels = read({gridAt(50.0), gridAt(z)});
      EXPECT_NEAR(height(labels), z, 1e-6);
      EXPECT_TRUE(says(labels, "up to 3 mm apart"));
      EXPECT_TRUE(says(labels, z == 0.0 ? "the sform is used" : "the qform is used"));
      EXPECT_EQ(says(labels, "that of an image of the case"), z != first);
    }
    const LoadedLabels neither = read({gridAt(10.0)});
    EXPECT_NEAR(height(neither), first, 1e-6);
    EXPECT_TRUE(says(neither, "7 mm from that of the first by the qform, and 10 mm by the sform"));
  }
}

TEST(ImageFile, RefusesTwoPlacesThatAreMirrorImages)
{
  const TestFolder folder;
  TestNifti nifti = shortNifti();
  nifti.qform = 1;
  nifti.pixdim[0] = nifti.pixdim[0] < 0.0F ? 1.0F : -1.0F; // qfac: the third axis turned round
  expectRefused(refusalOf([&] { readImageFile(putFile(folder / "a.nii", nifti.bytes())); }),
                Reason::NoGeometry, "mirror images");
}

TEST(ImageFile, RefusesAxesOfDifferentUnits)
{
  const TestFolder folder;
  std::string text = nrrd("short", bytesOf(counting<std::int16_t>(24)));
  text.insert(text.find('\n') + 1, "space units: \"mm\" \"m\" \"mm\"\n");
  expectRefused(refusalOf([&] { readImageFile(putFile(folder / "a.nrrd", text)); }),
                Reason::NoGeometry, "different units");
}

TEST(ImageFile, NotesAMissingPlaceAndUnit)
{
  const TestFolder folder;
  TestNifti nifti = shortNifti();
  nifti.sform = 0;
  EXPECT_TRUE(noted(readImageFile(putFile(folder / "a.nii", nifti.bytes())), "no place"));
  EXPECT_TRUE(noted(
      readImageFile(putFile(folder / "c.nrrd", nrrd("short", bytesOf(counting<std::int16_t>(24))))),
      "unit"));
}

TEST(ImageFile, SaysWhereTheSideIsLeftOpen)
{
  const TestFolder folder;
  TestNifti nifti = shortNifti();
  EXPECT_FALSE(readImageFile(putFile(folder / "a.nii", nifti.bytes())).assumedRas);
  nifti.sform = 0;
  const auto path = putFile(folder / "b.nii", nifti.bytes());
  EXPECT_EQ(assumedRasOf(path), true);
  const auto ras = readImageFile(path);
  const auto lps = readImageFile(path, std::nullopt, {}, false);
  EXPECT_EQ(lps.assumedRas, false);
  EXPECT_TRUE(noted(lps, "taken as LPS, as asked"));
  const Eigen::Vector3d voxel(3.0, 2.0, 1.0);
  const Eigen::Vector3d at = ras.volume->geometry().patientFromVoxel(voxel);
  EXPECT_TRUE(lps.volume->geometry().patientFromVoxel(voxel).isApprox(
      Eigen::Vector3d(-at[0], -at[1], at[2])));
  EXPECT_EQ(lps.volume->at(3, 2, 1), ras.volume->at(3, 2, 1));
  const auto stated = readImageFile(folder / "a.nii", std::nullopt, {}, false);
  EXPECT_TRUE(stated.volume->geometry().patientFromVoxel(voxel).isApprox(
      readImageFile(folder / "a.nii").volume->geometry().patientFromVoxel(voxel)))
      << "what a file states holds";
  const std::string voxels = bytesOf(counting<std::int16_t>(24));
  const std::string whole = nrrd("short", voxels);
  EXPECT_FALSE(assumedRasOf(putFile(folder / "c.nrrd", whole)));
  const std::string field = "space: left-posterior-superior\n";
  std::string open = whole;
  open.replace(open.find(field), field.size(), "space dimension: 3\n");
  EXPECT_EQ(assumedRasOf(putFile(folder / "d.nrrd", open)), false);
  const std::string meta = "ObjectType = Image\nNDims = 3\nBinaryData = True\n"
                           "BinaryDataByteOrderMSB = False\nOffset = 1 2 3\n"
                           "ElementSpacing = 1 1 1\nDimSize = 4 3 2\nElementType = MET_SHORT\n";
  const std::string end = "ElementDataFile = LOCAL\n" + voxels;
  EXPECT_EQ(assumedRasOf(putFile(folder / "e.mha", meta + end)), false);
  EXPECT_FALSE(assumedRasOf(
      putFile(folder / "f.mha", meta + "TransformMatrix = 1 0 0 0 1 0 0 0 1\n" + end)));
}

TEST(ImageFile, NotesOfAnOpenSideDoNotContradictEachOther)
{
  const TestFolder folder;
  const std::string voxels = bytesOf(counting<std::int16_t>(24));
  TestNifti nifti = shortNifti();
  nifti.sform = 0;
  const std::string head = "NRRD0004\ntype: short\ndimension: 3\nsizes: 4 3 2\nendian: little\n"
                           "encoding: raw\n";
  const std::string axes = "space directions: (1,0,0) (0,1,0) (0,0,1)\nspace origin: (0,0,0)\n\n";
  const std::string meta = "ObjectType = Image\nNDims = 3\nBinaryData = True\n"
                           "BinaryDataByteOrderMSB = False\nElementSpacing = 1 1 1\n"
                           "DimSize = 4 3 2\nElementType = MET_SHORT\nElementDataFile = LOCAL\n";
  for (const auto& path :
       {putFile(folder / "a.nii", nifti.bytes()),
        putFile(folder / "b.nrrd", head + "spacings: 1 1 1\n\n" + voxels),
        putFile(folder / "c.nrrd", head + "space dimension: 3\n" + axes + voxels),
        putFile(folder / "d.nrrd", head + "space: scanner-xyz\n" + axes + voxels),
        putFile(folder / "e.mha", meta + voxels)})
    for (const bool isRas : {false, true})
    {
      const auto image = readImageFile(path, std::nullopt, {}, isRas);
      EXPECT_TRUE(noted(image, isRas ? "taken as RAS, as asked" : "taken as LPS, as asked"));
      for (const char* side : {"left,", "back", "posterior", isRas ? "LPS" : "RAS"})
        EXPECT_FALSE(noted(image, side)) << path << ' ' << side;
    }
}

TEST(ImageFile, KeepsThePaddingOfEveryFormatThatIsWritten)
{
  const TestFolder folder;
  const core::GridGeometry grid({4, 4, 4}, Eigen::Vector3d::Ones(), Eigen::Vector3d::Zero());
  auto voxels = std::make_shared<volume::Volume<std::int16_t>>(grid, std::int16_t{40});
  voxels->at(0, 0, 0) = -3024;
  voxels->at(1, 1, 1) = -1000;
  const volume::IntensityVolume image(std::shared_ptr<const volume::Volume<std::int16_t>>(voxels),
                                      -3024.0);
  for (const char* name : {"a.nrrd", "a.nii", "a.nii.gz", "a.mha"})
  {
    writeVolume(folder / name, image);
    const auto back = readImageFile(folder / name);
    ASSERT_TRUE(back.volume->padding()) << name;
    EXPECT_EQ(*back.volume->padding(), -3024.0) << name;
    EXPECT_EQ(back.volume->range().min, -1000.0) << name;
    EXPECT_EQ(back.volume->at(0, 0, 0), -3024.0) << name;
  }
}

TEST(ImageFile, KeepsThatValuesAreHounsfieldUnitsInEveryFormatThatIsWritten)
{
  const TestFolder folder;
  const core::GridGeometry grid({4, 4, 4}, Eigen::Vector3d::Ones(), Eigen::Vector3d::Zero());
  const auto voxels = std::make_shared<volume::Volume<std::int16_t>>(grid, std::int16_t{700});
  const volume::IntensityVolume image(std::shared_ptr<const volume::Volume<std::int16_t>>(voxels),
                                      -3024.0);
  for (const char* name : {"a.nrrd", "a.nii", "a.nii.gz", "a.mha"})
    for (const bool isHounsfield : {true, false})
    {
      writeVolume(folder / name, image, {}, isHounsfield);
      const auto back = readImageFile(folder / name);
      EXPECT_EQ(back.isHounsfield, isHounsfield) << name;
      EXPECT_EQ(back.volume->padding(), -3024.0) << name;
    }
}

TEST(ImageFile, RefusesVoxelsThatAreNotFinite)
{
  const TestFolder folder;
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  for (const double bad : {std::nan(""), kInfinity, -kInfinity, 1e300})
  {
    std::vector<double> values = counting<double>(24);
    values[3] = values[20] = bad;
    expectRefused(
        refusalOf([&]
                  { readImageFile(putFile(folder / "a.nrrd", nrrd("double", bytesOf(values)))); }),
        Reason::Unsupported, "2 voxels that are not finite");
  }
  TestNifti nifti;
  nifti.dataType = 16;
  nifti.bits = 32;
  std::vector<float> values = counting<float>(24);
  values[7] = std::numeric_limits<float>::quiet_NaN();
  nifti.voxels = bytesOf(values);
  expectRefused(refusalOf([&] { readImageFile(putGzip(folder / "b.nii.gz", nifti.bytes())); }),
                Reason::Unsupported, "1 voxels that are not finite");
}

// By hand, from the definition of each space: voxel (1, 1, 1) lies at (10.5, 20.25, 32) in the
// file's own frame.
TEST(ImageFile, PutsEveryNrrdSpaceWhereItsNameSays)
{
  const TestFolder folder;
  const Eigen::Vector3d lps(10.5, 20.25, 32.0);
  const Eigen::Vector3d ras(-10.5, -20.25, 32.0);
  const Eigen::Vector3d las(10.5, -20.25, 32.0);
  const std::pair<const char*, Eigen::Vector3d> spaces[] = {
      {"left-posterior-superior", lps}, {"LPS", lps},
      {"right-anterior-superior", ras}, {"RAS", ras},
      {"left-anterior-superior", las},  {"LAS", las},
      {"Left-Anterior-Superior", las},  {"scanner-xyz", lps},
      {"3D-right-handed", lps}};
  for (const auto& [space, place] : spaces)
  {
    const auto image =
        readImageFile(putFile(folder / "a.nrrd", nrrd("short", bytesOf(counting<std::int16_t>(24)),
                                                      "(0.5,0,0) (0,0.25,0) (0,0,2)", "", space)));
    const Eigen::Vector3d at = image.volume->geometry().patientFromVoxel({1.0, 1.0, 1.0});
    EXPECT_TRUE(at.isApprox(place, 1e-12)) << space << ": " << at.transpose();
    EXPECT_EQ(noted(image, "not a patient's"), space[0] == 's' || space[0] == '3') << space;
  }
  // Left and right would be ambiguous.
  for (const char* space : {"3D-left-handed", "left-posterior-inferior", "somewhere"})
    expectRefused(refusalOf(
                      [&]
                      {
                        readImageFile(putFile(folder / "b.nrrd",
                                              nrrd("short", bytesOf(counting<std::int16_t>(24)),
                                                   "(0.5,0,0) (0,0.25,0) (0,0,2)", "", space)));
                      }),
                  Reason::NoGeometry, "left-posterior-superior");
}

TEST(ImageFile, PutsTurnedAxesOfEveryNrrdSpaceWhereTheyPoint)
{
  const TestFolder folder;
  // First axis down, second posterior (in LPS), third to the left; voxel (3, 2, 1).
  const char* directions = "(0, 0, -2) (0, 0.5, 0) (0.25, 0, 0)";
  const Eigen::Vector3d inFile(10.0 + 0.25, 20.0 + 1.0, 30.0 - 6.0);
  const std::pair<const char*, Eigen::Vector3d> signs[] = {
      {"LPS", {1.0, 1.0, 1.0}}, {"RAS", {-1.0, -1.0, 1.0}}, {"LAS", {1.0, -1.0, 1.0}}};
  for (const auto& [space, sign] : signs)
  {
    const auto image =
        readImageFile(putFile(folder / "a.nrrd", nrrd("short", bytesOf(counting<std::int16_t>(24)),
                                                      directions, "", space)));
    EXPECT_TRUE(image.volume->geometry()
                    .patientFromVoxel({3.0, 2.0, 1.0})
                    .isApprox(sign.cwiseProduct(inFile), 1e-12))
        << space;
    EXPECT_EQ(image.volume->at(3, 2, 1), 23);
  }
}

TEST(ImageFile, ReadsNrrdWithTimeSkipsAndText)
{
  const TestFolder folder;
  const std::string rest = "\nkinds: domain domain domain time\nendian: little\n";
  const std::string head = "NRRD0005\ntype: int16\ndimension: 4\nspace: LAST\nsizes: 4 3 2 1\n"
                           "space directions: (0.5,0,0,0) (0,0.25,0,0) (0,0,2,0) (0,0,0,1)\n"
                           "space origin: (10,20,30,7)" +
                           rest;
  const std::string voxels = bytesOf(counting<std::int16_t>(24));
  std::string text;
  for (int v = 0; v < 24; ++v)
    text += std::to_string(v) + (v % 4 == 3 ? "\n" : " ");
  const std::pair<const char*, std::string> files[] = {
      {"raw.nrrd", head + "encoding: raw\n\n" + voxels},
      {"skip.nrrd", head + "encoding: raw\nline skip: 2\nbyte skip: 3\n\na\nb\nxyz" + voxels},
      {"end.nrrd", head + "encoding: raw\nbyte skip: -1\n\nwhatever" + voxels},
      {"text.nrrd", head + "encoding: ascii\n\n" + text}};
  for (const auto& [name, bytes] : files)
  {
    const auto image = readImageFile(putFile(folder / name, bytes));
    EXPECT_EQ(image.volume->at(3, 2, 1), 23) << name;
    EXPECT_EQ(image.volume->at(1, 0, 0), 1) << name;
    EXPECT_TRUE(image.volume->geometry()
                    .patientFromVoxel({1.0, 1.0, 1.0})
                    .isApprox(Eigen::Vector3d(10.5, -20.25, 32.0), 1e-12))
        << name;
  }
  expectRefused(refusalOf(
                    [&]
                    {
                      readImageFile(putFile(folder / "bad.nrrd",
                                            head + "encoding: ascii\n\n" + text.substr(0, 50)));
                    }),
                Reason::Unreadable);
  expectRefused(
      refusalOf([&] { readImageFile(putFile(folder / "bz.nrrd", head + "encoding: lzma\n\nx")); }),
      Reason::Unsupported, "gzip");
}

std::string bzipped(const std::string& bytes)
{
  std::string packed(bytes.size() + bytes.size() / 50 + 600, '\0');
  auto size = static_cast<unsigned>(packed.size());
  EXPECT_EQ(BZ2_bzBuffToBuffCompress(packed.data(), &size, const_cast<char*>(bytes.data()),
                                     static_cast<unsigned>(bytes.size()), 9, 0, 0),
            BZ_OK);
  return packed.substr(0, size);
}

std::string inHex(const std::string& bytes)
{
  std::string text;
  for (std::size_t n = 0; n < bytes.size(); ++n)
  {
    for (const int digit : {static_cast<unsigned char>(bytes[n]) >> 4, bytes[n] & 15})
      text += (n % 3 == 0 ? "0123456789ABCDEF" : "0123456789abcdef")[digit];
    text += n % 7 == 0 ? "\n" : n % 5 == 0 ? " " : "";
  }
  return text;
}

TEST(ImageFile, ReadsEveryEncodingOfNrrd)
{
  const TestFolder folder;
  // Repeated values, as only they fill a block of bzip2 with runs.
  std::vector<std::int16_t> values(std::size_t{200} * 150 * 100, -1024);
  std::uint32_t random = 1;
  for (std::size_t v = 0; v < values.size(); v += v < values.size() / 2 ? 1 : 4099)
  {
    random = random * 1664525U + 1013904223U;
    values[v] = static_cast<std::int16_t>(random >> 16);
  }
  const std::string voxels = bytesOf(values);
  const std::size_t third = voxels.size() / 3;
  std::string head = nrrd("short", "");
  head.replace(head.find("4 3 2"), 5, "200 150 100");
  const auto with = [&](const char* encoding, const std::string& packed, const char* more = "")
  {
    std::string bytes = head;
    bytes.replace(bytes.find("raw"), 3, encoding);
    return bytes.substr(0, bytes.size() - 1) + more + "\n" + packed;
  };
  const std::pair<const char*, std::string> files[] = {
      {"bz2", with("bz2", bzipped(voxels))},
      {"bz2 of several streams",
       with("bzip2", bzipped(voxels.substr(0, third)) + bzipped(voxels.substr(third)))},
      {"bz2 behind bytes to be skipped", with("bzip2", bzipped("abc" + voxels), "byte skip: 3\n")},
      {"hex", with("hex", inHex(voxels) + "\n")},
      {"hex behind a line", with("hex", "a line\n" + inHex(voxels), "line skip: 1\n")}};
  const core::PatientBox middle{Eigen::Vector3d(20.0, 25.0, 60.0),
                                Eigen::Vector3d(60.0, 45.0, 130.0)};
  for (const auto& [name, bytes] : files)
  {
    const auto image = readImageFile(putFile(folder / "a.nrrd", bytes));
    ASSERT_TRUE(holds<std::int16_t>(image)) << name;
    std::size_t wrong = 0;
    for (int k = 0, v = 0; k < 100; ++k)
      for (int j = 0; j < 150; ++j)
        for (int i = 0; i < 200; ++i, ++v)
          wrong += image.volume->at(i, j, k) != values[static_cast<std::size_t>(v)] ? 1 : 0;
    EXPECT_EQ(wrong, 0U) << name;
    const auto part = readImageFile(folder / "a.nrrd", middle);
    const Eigen::Vector3d first = part.volume->geometry().origin();
    const Eigen::Vector3d at = image.volume->geometry().voxelFromPatient(first);
    EXPECT_EQ(part.volume->at(0, 0, 0), image.volume->at(static_cast<int>(std::lround(at[0])),
                                                         static_cast<int>(std::lround(at[1])),
                                                         static_cast<int>(std::lround(at[2]))))
        << name;
    putFile(folder / "a.nrrd", bytes.substr(0, bytes.size() - bytes.size() / 50));
    expectRefused(refusalOf([&] { readImageFile(folder / "a.nrrd"); }), Reason::Unreadable);
  }
  std::string spoilt = files[0].second;
  spoilt[spoilt.size() / 2] = static_cast<char>(spoilt[spoilt.size() / 2] ^ 16);
  expectRefused(refusalOf([&] { readImageFile(putFile(folder / "a.nrrd", spoilt)); }),
                Reason::Unreadable, "damaged");
  spoilt = files[3].second;
  spoilt[spoilt.size() / 2] = 'g';
  expectRefused(refusalOf([&] { readImageFile(putFile(folder / "a.nrrd", spoilt)); }),
                Reason::Unreadable, "damaged");
}

TEST(ImageFile, ReadsNrrdWhoseVoxelsAreInSeveralFiles)
{
  const TestFolder folder;
  const std::vector<std::int16_t> values = counting<std::int16_t>(4 * 3 * 6);
  const std::string voxels = bytesOf(values);
  const std::size_t slice = voxels.size() / 6;
  std::string head = nrrd("short", "");
  head.replace(head.find("4 3 2"), 5, "4 3 6");
  for (std::size_t k = 0; k < 6; ++k)
  {
    const std::string n = std::to_string(k + 1);
    putFile(folder / ("s00" + n + ".raw"), "line\nab" + voxels.substr(k * slice, slice));
    putGzip(folder / ("s" + n + ".gz"), voxels.substr(k * slice, slice));
    putFile(folder / ("h" + n), inHex(voxels.substr(k * slice, slice)));
  }
  putFile(folder / "low.raw", voxels.substr(0, 3 * slice));
  putFile(folder / "high.raw", voxels.substr(3 * slice));
  const auto with = [&head](const char* encoding, const std::string& fields)
  {
    std::string bytes = head.substr(0, head.size() - 1);
    bytes.replace(bytes.find("raw"), 3, encoding);
    return bytes + fields;
  };
  const std::pair<const char*, std::string> files[] = {
      {"numbered", with("raw", "line skip: 1\nbyte skip: 2\ndata file: s%03d.raw 1 6 1\n")},
      {"counted from the end", with("raw", "byte skip: -1\ndata file: s%03d.raw 1 6 1 2\n")},
      {"gzip", with("gzip", "datafile: s%d.gz 1 6 1\n")},
      {"hex", with("hex", "data file: h%d 1 6 1\n")},
      {"list", with("raw", "data file: LIST\nlow.raw\nhigh.raw\n")},
      {"list with blank line", with("raw", "data file: LIST 3\nlow.raw\nhigh.raw\n\n")}};
  for (const auto& [name, bytes] : files)
  {
    const auto image = readImageFile(putFile(folder / "a.nhdr", bytes));
    for (int k = 0, v = 0; k < 6; ++k)
      for (int j = 0; j < 3; ++j)
        for (int i = 0; i < 4; ++i, ++v)
          EXPECT_EQ(image.volume->at(i, j, k), v) << name;
    // Slices 2 to 4: rows across the border of two files.
    const auto part =
        readImageFile(folder / "a.nhdr", core::PatientBox{Eigen::Vector3d(10.6, 20.3, 34.1),
                                                          Eigen::Vector3d(11.1, 20.4, 37.9)});
    const Eigen::Vector3d at =
        image.volume->geometry().voxelFromPatient(part.volume->geometry().origin());
    EXPECT_GT(at[2], 1.5) << name;
    EXPECT_EQ(part.volume->at(1, 1, 1), image.volume->at(static_cast<int>(std::lround(at[0])) + 1,
                                                         static_cast<int>(std::lround(at[1])) + 1,
                                                         static_cast<int>(std::lround(at[2])) + 1))
        << name;
  }
  for (const char* list :
       {"data file: LIST\n", "data file: LIST\nlow.raw\nhigh.raw\nhigh.raw\nhigh.raw\n",
        "data file: s%d.gz 1 6\n", "data file: s%d.gz 1 6 0\n", "data file: s%s.gz 1 6 1\n",
        "data file: s%9999999999d.gz 1 6 1\n", "data file: s%d.gz 0 9000000000 1\n",
        "data file: s%d%n.gz 1 6 1\n"})
    EXPECT_TRUE(
        refusalOf([&] { readImageFile(putFile(folder / "b.nhdr", with("raw", list))); }).thrown)
        << list;
  std::filesystem::resize_file(folder / "high.raw", slice);
  expectRefused(refusalOf([&] { readImageFile(putFile(folder / "b.nhdr", files[4].second)); }),
                Reason::Unreadable, "too short");
  std::filesystem::remove(folder / "high.raw");
  expectRefused(refusalOf([&] { readImageFile(folder / "b.nhdr"); }), Reason::NotFound);
}

TEST(ImageFile, NotesBytesThatTheHeaderOfRawVoxelsDoesNotSpeakOf)
{
  const TestFolder folder;
  const std::string voxels = bytesOf(counting<std::int16_t>(24));
  const auto read = [&](const std::string& fields, const std::string& data)
  {
    std::string header = nrrd("short", "");
    header.insert(header.find("endian"), "data file: b.raw\n" + fields);
    putFile(folder / "b.raw", data);
    return readImageFile(putFile(folder / "b.nhdr", header));
  };
  EXPECT_FALSE(noted(read("", voxels), "byte"));
  EXPECT_FALSE(noted(read("byte skip: 3\n", "abc" + voxels), "byte"));
  EXPECT_FALSE(noted(read("byte skip: -1\n", "abc" + voxels), "byte"));
  EXPECT_TRUE(noted(read("", voxels + "x"), "1 byte more"));
  EXPECT_TRUE(noted(read("", voxels + "xy"), "2 bytes more"));
  const auto shifted = read("", std::string(348, '\0') + voxels);
  EXPECT_NE(shifted.volume->at(3, 2, 1), 23);
  EXPECT_TRUE(noted(shifted, "348 bytes more"));
  EXPECT_TRUE(noted(shifted, "shifted"));
  const auto skipped = read("byte skip: 3\n", "abc" + voxels + "xy");
  EXPECT_EQ(skipped.volume->at(3, 2, 1), 23);
  EXPECT_TRUE(noted(skipped, "2 bytes behind"));
  EXPECT_FALSE(noted(readImageFile(putFile(folder / "a.nrrd", nrrd("short", voxels))), "byte"));
  EXPECT_TRUE(noted(readImageFile(putFile(folder / "a.nrrd", nrrd("short", voxels + "x"))),
                    "1 byte behind"));
}

TEST(ImageFile, NotesVoxelsOutsideTheFolderOfTheirHeader)
{
  const TestFolder folder;
  const TestFolder other;
  const std::string voxels = bytesOf(counting<std::int16_t>(24));
  std::filesystem::create_directory(folder / "sub");
  for (const auto& file : {folder / "b.raw", folder / "sub" / "b.raw", other / "b.raw"})
    putFile(file, voxels);
  const auto isNoted = [&](const std::filesystem::path& header, const std::string& name)
  {
    std::string text = nrrd("short", "");
    text.insert(text.find("endian"), "data file: " + name + "\n");
    const auto image = readImageFile(putFile(header, text));
    EXPECT_EQ(image.volume->at(3, 2, 1), 23);
    return noted(image, "outside the folder");
  };
  EXPECT_FALSE(isNoted(folder / "b.nhdr", "b.raw"));
  EXPECT_FALSE(isNoted(folder / "b.nhdr", "sub/b.raw"));
  EXPECT_FALSE(isNoted(folder / "b.nhdr", (folder / "b.raw").string()));
  EXPECT_TRUE(isNoted(folder / "b.nhdr", (other / "b.raw").string()));
  EXPECT_TRUE(isNoted(folder / "sub" / "b.nhdr", "../b.raw"));
  EXPECT_TRUE(noted(
      readImageFile(putFile(folder / "b.mhd", "ObjectType = Image\nNDims = 3\nBinaryData = True\n"
                                              "TransformMatrix = 1 0 0 0 1 0 0 0 1\n"
                                              "Offset = 1 2 3\nElementSpacing = 1 1 2\n"
                                              "DimSize = 4 3 2\nElementType = MET_SHORT\n"
                                              "ElementDataFile = " +
                                                  (other / "b.raw").string() + "\n")),
      "outside the folder"));
}

// As where a disk is pulled out: the file is shorter than it was when its header was read.
TEST(ImageFile, NamesAFileThatChangesWhileItIsRead)
{
  const TestFolder folder;
  const core::GridGeometry grid({64, 64, 64}, {1.0, 1.0, 1.0}, {0.0, 0.0, 0.0});
  volume::Volume<std::int16_t> voxels(grid);
  for (std::size_t v = 0; v < voxels.size(); ++v)
    voxels.data()[v] = static_cast<std::int16_t>(v * 2654435761U >> 7);
  for (const char* name : {"a.nrrd", "a.nii", "a.nii.gz", "a.mha"})
  {
    writeVolume(folder / name, voxels);
    const auto whole = std::filesystem::file_size(folder / name);
    const core::Progress cut(
        [&, n = name](double done, const std::string&)
        {
          if (done > 0.1)
            std::filesystem::resize_file(folder / n, whole / 8);
        });
    const Refusal refusal = refusalOf([&] { readImageFile(folder / name, std::nullopt, cut); });
    expectRefused(refusal, Reason::Unreadable, (folder / name).string());
  }
}

/// Two gzip members, as written by pigz and bgzip.
std::string gzipped(const TestFolder& folder, const std::string& bytes, std::size_t members)
{
  std::string all;
  const std::size_t part = (bytes.size() + members - 1) / members;
  for (std::size_t at = 0; at < bytes.size(); at += part)
    all += fileBytes(putGzip(folder / "member.gz", bytes.substr(at, part)));
  return all;
}

// Flipped bits that leave a valid stream are detected only by the checksum after it.
TEST(ImageFile, NoticesEveryFlippedBitInGzipVoxels)
{
  const TestFolder folder;
  std::vector<std::int16_t> voxels(std::size_t{40} * 30 * 20);
  std::uint32_t random = 1;
  for (std::int16_t& value : voxels)
  {
    random = random * 1664525U + 1013904223U;
    value = static_cast<std::int16_t>(random >> 26);
  }
  std::string head = nrrd("short", "");
  head.replace(head.find("4 3 2"), 5, "40 30 20");
  head.replace(head.find("raw"), 3, "gzip");
  TestNifti nifti;
  nifti.dims = {3, 40, 30, 20, 1, 1, 1, 1};
  nifti.voxels = bytesOf(voxels);
  const core::PatientBox first{Eigen::Vector3d(10.0, 20.0, 30.0),
                               Eigen::Vector3d(14.0, 22.0, 34.0)};
  for (const std::size_t members : {std::size_t{1}, std::size_t{3}})
    for (const char* name : {"a.nrrd", "a.nii.gz"})
    {
      const bool isNrrd = name[2] == 'n' && name[3] == 'r';
      const std::string packed = gzipped(folder, isNrrd ? bytesOf(voxels) : nifti.bytes(), members);
      const std::string start = isNrrd ? head : "";
      const auto whole = readImageFile(putFile(folder / name, start + packed));
      EXPECT_EQ(whole.volume->at(39, 29, 19), voxels.back()) << name;
      std::size_t refused = 0;
      constexpr std::size_t kFlips = 40;
      for (std::size_t n = 0; n < kFlips; ++n)
      {
        std::string spoilt = packed;
        // From after the ten-byte header, part of which is not significant, to the end of the
        // trailer.
        const std::size_t at = 10 + n * (packed.size() - 11) / (kFlips - 1);
        spoilt[at] = static_cast<char>(spoilt[at] ^ (1 << n % 8));
        putFile(folder / name, start + spoilt);
        refused += refusalOf([&] { readImageFile(folder / name); }).thrown ? 1 : 0;
        // A region of interest does not skip verification of the rest.
        const bool part = refusalOf([&] { readImageFile(folder / name, first); }).thrown;
        EXPECT_TRUE(part || !isNrrd) << n;
      }
      EXPECT_GE(refused, members == 1 ? kFlips : kFlips - 2) << name; // inner headers
    }
}

TEST(ImageFile, RefusesAGzipStreamThatGoesOn)
{
  const TestFolder folder;
  TestNifti nifti = shortNifti();
  nifti.voxels += std::string(std::size_t{4} << 20, '\0');
  expectRefused(refusalOf([&] { readImageFile(putGzip(folder / "a.nii.gz", nifti.bytes())); }),
                Reason::Unreadable, "far more voxels");
}

TEST(ImageFile, RefusesImpossibleQuaternionsAndPlaces)
{
  const TestFolder folder;
  TestNifti nifti = shortNifti();
  nifti.sform = 0;
  nifti.qform = 1;
  nifti.quaternion = {0.9F, 0.9F, 0.1F};
  expectRefused(refusalOf([&] { readImageFile(putFile(folder / "a.nii", nifti.bytes())); }),
                Reason::NoGeometry, "not a rotation");
  nifti.quaternion = {std::numeric_limits<float>::quiet_NaN(), 0.0F, 0.0F};
  expectRefused(refusalOf([&] { readImageFile(putFile(folder / "a.nii", nifti.bytes())); }),
                Reason::NoGeometry, "not a rotation");
  nifti.sform = 1;
  EXPECT_TRUE(noted(readImageFile(putFile(folder / "b.nii", nifti.bytes())), "not a rotation"));
  nifti = shortNifti();
  nifti.srow[3] = 1e30F;
  expectRefused(refusalOf([&] { readImageFile(putFile(folder / "c.nii", nifti.bytes())); }),
                Reason::NoGeometry, "1e+30 mm");
  std::string far = nrrd("short", bytesOf(counting<std::int16_t>(24)));
  far.replace(far.find("(10,20,30)"), 10, "(10,-2e5,30)");
  expectRefused(refusalOf([&] { readImageFile(putFile(folder / "d.nrrd", far)); }),
                Reason::NoGeometry, "200000 mm");
}

TEST(ImageFile, ReadsRasNrrdAndDetachedFiles)
{
  const TestFolder folder;
  const std::string voxels = bytesOf(counting<std::int16_t>(24));
  const auto ras =
      readImageFile(putFile(folder / "a.nrrd", nrrd("short", voxels, "(0.5,0,0) (0,0.25,0) (0,0,2)",
                                                    "", "right-anterior-superior")));
  EXPECT_TRUE(ras.volume->geometry()
                  .patientFromVoxel({1.0, 1.0, 1.0})
                  .isApprox(Eigen::Vector3d(-10.5, -20.25, 32.0)));
  putFile(folder / "b.raw", voxels);
  std::string header = nrrd("short", "");
  header.insert(header.find("endian"), "data file: b.raw\n");
  EXPECT_EQ(readImageFile(putFile(folder / "b.nhdr", header)).volume->at(3, 2, 1), 23);
  const std::string meta = "ObjectType = Image\nNDims = 3\nBinaryData = True\n"
                           "BinaryDataByteOrderMSB = False\nTransformMatrix = 1 0 0 0 1 0 0 0 1\n"
                           "Offset = 1 2 3\nElementSpacing = 1 1 2\nDimSize = 4 3 2\n"
                           "ElementType = MET_SHORT\nElementDataFile = ";
  const auto mhd = readImageFile(putFile(folder / "b.mhd", meta + "b.raw\n"));
  EXPECT_EQ(mhd.volume->at(3, 2, 1), 23);
  EXPECT_TRUE(mhd.volume->geometry()
                  .patientFromVoxel({0.0, 0.0, 1.0})
                  .isApprox(Eigen::Vector3d(1.0, 2.0, 5.0)));
  expectRefused(refusalOf([&] { readImageFile(putFile(folder / "c.mhd", meta + "none.raw\n")); }),
                Reason::NotFound, "one folder");
}

TEST(ImageFile, ReadsCompressedMetaImageAndChecksItsEnd)
{
  const TestFolder folder;
  const std::string voxels = bytesOf(counting<std::int16_t>(24));
  std::string packed(200, '\0');
  uLongf size = packed.size();
  ASSERT_EQ(compress(reinterpret_cast<Bytef*>(packed.data()), &size,
                     reinterpret_cast<const Bytef*>(voxels.data()), voxels.size()),
            Z_OK);
  packed.resize(size);
  const std::string meta = "ObjectType = Image\nNDims = 3\nBinaryData = True\n"
                           "CompressedData = True\nTransformMatrix = 0 1 0 -1 0 0 0 0 1\n"
                           "Offset = 1 2 3\nElementSpacing = 1 4 2\nDimSize = 4 3 2\n"
                           "DistanceUnits = mm\nElementType = MET_SHORT\n"
                           "ElementDataFile = LOCAL\n";
  const auto image = readImageFile(putFile(folder / "a.mha", meta + packed));
  EXPECT_EQ(image.volume->at(3, 2, 1), 23);
  EXPECT_TRUE(image.notes.empty());
  // The first axis runs along y, the second along -y.
  EXPECT_TRUE(image.volume->geometry()
                  .patientFromVoxel({1.0, 1.0, 0.0})
                  .isApprox(Eigen::Vector3d(-3.0, 3.0, 3.0)));
  packed.back() = static_cast<char>(packed.back() ^ 1); // the checksum
  expectRefused(refusalOf([&] { readImageFile(putFile(folder / "b.mha", meta + packed)); }),
                Reason::Unreadable, "damaged");
  packed.resize(packed.size() - 4);
  expectRefused(refusalOf([&] { readImageFile(putFile(folder / "b.mha", meta + packed)); }),
                Reason::Unreadable, "breaks off");
  expectRefused(refusalOf(
                    [&]
                    {
                      readImageFile(putFile(folder / "c.mha",
                                            "NDims = 2\nDimSize = 4 3\nElementType = "
                                            "MET_SHORT\nElementDataFile = LOCAL\n"));
                    }),
                Reason::Unsupported, "2 dimensions");
}

TEST(ImageFile, AppliesTheRescaleOfMetaImageAndComparesItsAxes)
{
  const TestFolder folder;
  const std::string voxels = bytesOf(counting<std::int16_t>(24));
  const auto read = [&](const std::string& more)
  {
    return readImageFile(
        putFile(folder / "a.mha", "ObjectType = Image\nNDims = 3\nBinaryData = True\n"
                                  "TransformMatrix = 0 1 0 -1 0 0 0 0 1\nOffset = 1 2 3\n"
                                  "ElementSpacing = 1 4 2\nDimSize = 4 3 2\nDistanceUnits = mm\n" +
                                      more + "ElementType = MET_SHORT\nElementDataFile = LOCAL\n" +
                                      voxels));
  };
  EXPECT_EQ(read("").volume->at(3, 2, 1), 23);
  EXPECT_EQ(read("ElementToIntensityFunctionSlope = 2\nElementToIntensityFunctionOffset = -1024\n")
                .volume->at(3, 2, 1),
            2 * 23 - 1024);
  EXPECT_EQ(read("ElementToIntensityFunctionOffset = 0.5\n").volume->at(3, 2, 1), 23.5);
  for (const char* slope : {"0", "nan", "inf", "x"})
    expectRefused(
        refusalOf([&] { read(std::string("ElementToIntensityFunctionSlope = ") + slope + "\n"); }),
        Reason::Unreadable, "slope");
  // The first axis starts anterior (A), the second at the left (L), the third inferior.
  EXPECT_TRUE(read("AnatomicalOrientation = ALI\n").notes.empty());
  EXPECT_TRUE(noted(read("AnatomicalOrientation = RAI\n"), "ALI"));
}

TEST(ImageFile, RefusesMetaImageThatContradictsItself)
{
  const TestFolder folder;
  const std::string voxels = bytesOf(counting<std::int16_t>(24));
  const auto read = [&](const std::string& more)
  {
    return readImageFile(putFile(
        folder / "a.mha", "ObjectType = Image\nNDims = 3\nBinaryData = True\n"
                          "BinaryDataByteOrderMSB = False\nTransformMatrix = 1 0 0 0 1 0 0 0 1\n"
                          "Offset = 1 2 3\nElementSpacing = 1 4 2\nDimSize = 4 3 2\n"
                          "DistanceUnits = mm\nElementType = MET_SHORT\n" +
                              more + "ElementDataFile = LOCAL\n" + voxels));
  };
  const std::pair<const char*, const char*> cases[] = {
      {"TransformMatrix = -1 0 0 0 1 0 0 0 1", "TransformMatrix twice"},
      {"Rotation = -1 0 0 0 1 0 0 0 1", "TransformMatrix and Rotation"},
      {"Orientation = -1 0 0 0 1 0 0 0 1", "TransformMatrix and Orientation"},
      {"Offset = 50 2 3", "Offset twice"},
      {"Origin = 50 2 3", "Offset and Origin"},
      {"Position = 50 2 3", "Offset and Position"},
      {"ElementSpacing = 1 4 3", "ElementSpacing twice"},
      {"DimSize = 3 4 2", "DimSize twice"},
      {"NDims = 4", "NDims twice"},
      {"ElementType = MET_USHORT", "ElementType twice"},
      {"DistanceUnits = um", "DistanceUnits twice"},
      {"ElementByteOrderMSB = True", "BinaryDataByteOrderMSB and ElementByteOrderMSB"}};
  for (const auto& [line, words] : cases)
    expectRefused(refusalOf([&, text = line] { read(std::string(text) + "\n"); }),
                  Reason::Unreadable, words);
  // The same value is no contradiction, nor is a slice thicker than the distance of slices.
  for (const char* line : {"Offset = 1 2 3", "Position = 1.0 2.0 3.0", "ElementSize = 1 4 5",
                           "Rotation = 1 0 0 0 1 0 0 0 1", "Comment = a\nComment = b"})
  {
    const auto image = read(std::string(line) + "\n");
    EXPECT_TRUE(image.volume->geometry().spacing().isApprox(Eigen::Vector3d(1.0, 4.0, 2.0)));
    EXPECT_TRUE(image.notes.empty()) << image.notes.front();
  }
}

TEST(ImageFile, SaysThatANegativeSpacingOfMetaImageMirrors)
{
  const TestFolder folder;
  const auto read = [&](const std::string& spacing, const std::string& orientation)
  {
    return readImageFile(putFile(
        folder / "a.mha", "ObjectType = Image\nNDims = 3\nBinaryData = True\n"
                          "TransformMatrix = 1 0 0 0 1 0 0 0 1\nOffset = 1 2 3\nElementSpacing = " +
                              spacing + "\nDimSize = 4 3 2\nAnatomicalOrientation = " +
                              orientation + "\nElementType = MET_SHORT\nElementDataFile = LOCAL\n" +
                              bytesOf(counting<std::int16_t>(24))));
  };
  EXPECT_FALSE(noted(read("1 4 2", "RAI"), "negative"));
  const auto mirrored = read("-1 4 2", "LAI"); // the first axis starts at the left
  EXPECT_TRUE(noted(mirrored, "negative voxel size (ElementSpacing)"));
  EXPECT_FALSE(noted(mirrored, "AnatomicalOrientation"));
  EXPECT_TRUE(noted(read("-1 4 2", "RAI"), "LAI"));
  // ITK's ImageFileReader: the origin stays, the axis is turned round.
  const core::GridGeometry& grid = mirrored.volume->geometry();
  double least = 100.0;
  double most = -100.0;
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 3; ++j)
      for (int k = 0; k < 2; ++k)
      {
        const Eigen::Vector3d at = grid.patientFromVoxel(Eigen::Vector3d(i, j, k));
        least = std::min(least, at[0]);
        most = std::max(most, at[0]);
        const double column = std::round(1.0 - at[0]); // of the file
        EXPECT_EQ(mirrored.volume->at(i, j, k), column + 4.0 * std::round((at[1] - 2.0) / 4.0) +
                                                    12.0 * std::round((at[2] - 3.0) / 2.0));
      }
  EXPECT_NEAR(least, -2.0, 1e-9);
  EXPECT_NEAR(most, 1.0, 1e-9);
}

TEST(ImageFile, KeepsOnlyTheRegionOfInterest)
{
  const TestFolder folder;
  const core::GridGeometry grid({40, 30, 20}, {0.5, 0.5, 1.0}, {-10.0, 5.0, 100.0});
  volume::Volume<std::int16_t> voxels(grid);
  std::iota(voxels.data(), voxels.data() + voxels.size(), std::int16_t{0});
  const core::PatientBox box{Eigen::Vector3d(-7.0, 6.0, 103.0), Eigen::Vector3d(-3.0, 9.0, 109.0)};
  for (const char* name : {"a.nrrd", "a.nii.gz", "a.mha"})
  {
    writeVolume(folder / name, voxels);
    const auto image = readImageFile(folder / name, box);
    const auto& cut = image.volume->geometry();
    EXPECT_EQ(cut.dims(), (core::Index3{9, 7, 7})) << name;
    EXPECT_TRUE(cut.origin().isApprox(Eigen::Vector3d(-7.0, 6.0, 103.0))) << name;
    EXPECT_EQ(image.volume->bytes(), 9U * 7 * 7 * 2);
    for (const core::Index3& v : {core::Index3{0, 0, 0}, core::Index3{8, 6, 6}, {3, 2, 1}})
      EXPECT_EQ(image.volume->at(v[0], v[1], v[2]), voxels.at(v[0] + 6, v[1] + 2, v[2] + 3))
          << name;
  }
  const core::PatientBox outside{Eigen::Vector3d(50.0, 6.0, 103.0),
                                 Eigen::Vector3d(60.0, 9.0, 109.0)};
  expectRefused(refusalOf([&] { readImageFile(folder / "a.nrrd", outside); }), Reason::Unsupported,
                "region of interest");
}

TEST(ImageFile, APreviewTakesNoMoreMemoryThanThereIs)
{
  const TestFolder folder;
  constexpr int kSide = 40;
  constexpr int kSlices = 12;
  std::vector<std::int16_t> voxels;
  for (int k = 0; k < kSlices; ++k)
    for (int j = 0; j < kSide; ++j)
      for (int i = 0; i < kSide; ++i)
        voxels.push_back(static_cast<std::int16_t>(1000 * k + 20 * j - 3 * i));
  const auto path = putFile(
      folder / "a.nrrd",
      "NRRD0004\ntype: short\ndimension: 3\nspace: left-posterior-superior\nsizes: 40 40 12\n"
      "space directions: (0.5,0,0) (0,0.5,0) (0,0,2)\nspace origin: (-3,4,5)\nendian: little\n"
      "encoding: raw\n\n" +
          bytesOf(voxels));
  for (const std::uint64_t memory : {0UL, 60000UL, 9000UL, 2000UL})
  {
    SCOPED_TRACE(memory);
    const ImagePreview preview = previewImageFile(path, 4, {}, std::nullopt, memory);
    EXPECT_TRUE(core::sameGrid(preview.grid, readImageFile(path).volume->geometry()));
    const core::GridGeometry& grid = preview.volume->geometry();
    EXPECT_EQ(grid.dims()[2], 4);
    if (memory == 0)
    {
      EXPECT_EQ(grid.dims(), (core::Index3{kSide, kSide, 4}));
    }
    else
    {
      EXPECT_LE(grid.voxelCount() * sizeof(std::int16_t), memory);
    }
    for (int k = 0; k < grid.dims()[2]; ++k)
      for (int j = 0; j < grid.dims()[1]; ++j)
        for (int i = 0; i < grid.dims()[0]; ++i)
        {
          const Eigen::Vector3d at = grid.patientFromVoxel(Eigen::Vector3d(i, j, k));
          ASSERT_NEAR(preview.volume->at(i, j, k),
                      500.0 * (at[2] - 5.0) + 40.0 * (at[1] - 4.0) - 6.0 * (at[0] + 3.0), 1e-9);
        }
  }
  expectRefused(refusalOf([&] { previewImageFile(path, 4, {}, std::nullopt, 16); }),
                FileError::Reason::Unreadable, "memory");
}

TEST(ImageFile, AcceptsAFourthDimensionOfOneOnly)
{
  const TestFolder folder;
  TestNifti nifti = shortNifti();
  nifti.dims = {4, 4, 3, 2, 1, 1, 1, 1};
  EXPECT_EQ(readImageFile(putFile(folder / "a.nii", nifti.bytes())).volume->at(3, 2, 1), 23);
  nifti.dims = {4, 4, 3, 2, 5, 1, 1, 1};
  nifti.voxels.assign(240, '\0');
  expectRefused(refusalOf([&] { readImageFile(putFile(folder / "b.nii", nifti.bytes())); }),
                Reason::Unsupported, "5 volumes of 4 x 3 x 2 voxels");
  nifti.dims = {5, 4, 3, 2, 1, 5, 1, 1}; // vectors
  expectRefused(refusalOf([&] { readImageFile(putFile(folder / "f.nii", nifti.bytes())); }),
                Reason::Unsupported, "4 x 3 x 2 x 1 x 5");
  nifti.dims = {2, 4, 3, 1, 1, 1, 1, 1};
  expectRefused(refusalOf([&] { readImageFile(putFile(folder / "c.nii", nifti.bytes())); }),
                Reason::Unsupported);
  nifti.dims = {3, 4, 3, 1, 1, 1, 1, 1};
  expectRefused(refusalOf([&] { readImageFile(putFile(folder / "d.nii", nifti.bytes())); }),
                Reason::Unsupported, "single slice");
  const std::string colour = "NRRD0004\ntype: uchar\ndimension: 4\nspace: left-posterior-superior\n"
                             "sizes: 3 4 3 2\nspace directions: none (1,0,0) (0,1,0) (0,0,1)\n"
                             "kinds: RGB-color domain domain domain\nencoding: raw\n"
                             "space origin: (0,0,0)\n\n" +
                             std::string(72, '\1');
  expectRefused(refusalOf([&] { readImageFile(putFile(folder / "e.nrrd", colour)); }),
                Reason::Unsupported, "3 numbers a voxel");
}

TEST(ImageFile, RefusesBrokenAndHostileFiles)
{
  const TestFolder folder;
  const std::string nii = shortNifti().bytes();
  const std::string raw = nrrd("short", bytesOf(counting<std::int16_t>(24)));
  const core::GridGeometry grid({30, 30, 30}, {1.0, 1.0, 1.0}, {0.0, 0.0, 0.0});
  volume::Volume<std::int16_t> voxels(grid);
  for (std::size_t v = 0; v < voxels.size(); ++v)
    voxels.data()[v] = static_cast<std::int16_t>(v * 2654435761U >> 7);
  for (const char* name : {"w.nrrd", "w.nii.gz", "w.mha"})
    writeVolume(folder / name, voxels);
  const std::pair<const char*, std::string> whole[] = {{"a.nii", nii},
                                                       {"a.nrrd", raw},
                                                       {"b.nrrd", fileBytes(folder / "w.nrrd")},
                                                       {"a.nii.gz", fileBytes(folder / "w.nii.gz")},
                                                       {"a.mha", fileBytes(folder / "w.mha")}};
  for (const auto& [name, bytes] : whole)
  {
    ASSERT_NO_THROW(readImageFile(putFile(folder / name, bytes))) << name;
    for (std::size_t hundredths = 0; hundredths < 100; ++hundredths)
    {
      const std::size_t length = hundredths * bytes.size() / 100;
      putFile(folder / name, bytes.substr(0, length));
      const Refusal refusal = refusalOf([&, n = name] { readImageFile(folder / n); });
      EXPECT_TRUE(refusal.thrown) << name << " cut to " << length;
      EXPECT_EQ(refusal.text.find('\n'), std::string::npos);
    }
  }
}

TEST(ImageFile, NeverBelievesAbsurdDimensions)
{
  const TestFolder folder;
  std::string bytes = nrrd("short", bytesOf(counting<std::int16_t>(24)));
  for (const char* sizes : {"1000000000 1000000000 1000000000", "100000 100000 4", "4 3 -2",
                            "4 3 99999999999999999999", "0 3 2"})
  {
    std::string hostile = bytes;
    hostile.replace(hostile.find("4 3 2"), 5, sizes);
    EXPECT_TRUE(refusalOf([&] { readImageFile(putFile(folder / "a.nrrd", hostile)); }).thrown)
        << sizes;
  }
  TestNifti nifti = shortNifti();
  nifti.dims = {3, 32767, 32767, 32767, 1, 1, 1, 1};
  expectRefused(refusalOf([&] { readImageFile(putFile(folder / "a.nii", nifti.bytes())); }),
                Reason::Unreadable, "too short");
  nifti.dims = {3, 4, -3, 2, 1, 1, 1, 1};
  expectRefused(refusalOf([&] { readImageFile(putFile(folder / "a.nii", nifti.bytes())); }),
                Reason::Unreadable, "-3");
  nifti = shortNifti();
  nifti.srow[3] = std::numeric_limits<float>::quiet_NaN();
  expectRefused(refusalOf([&] { readImageFile(putFile(folder / "a.nii", nifti.bytes())); }),
                Reason::NoGeometry);
  const std::string meta =
      "ObjectType = Image\nNDims = 3\nElementSpacing = 1 1 1\nDimSize = "
      "100000 100000 100000\nElementType = MET_SHORT\nElementDataFile = LOCAL\n";
  expectRefused(refusalOf([&] { readImageFile(putFile(folder / "a.mha", meta + "x")); }),
                Reason::Unreadable, "too short");
}

TEST(ImageFile, NamesWhatIsWrongWithAPath)
{
  const TestFolder folder;
  expectRefused(refusalOf([&] { readImageFile(folder / "none.nii"); }), Reason::NotFound);
  expectRefused(refusalOf([&] { readImageFile(folder.path()); }), Reason::NotFound, "folder");
  expectRefused(refusalOf([&] { readImageFile(putFile(folder / "a.png", "x")); }),
                Reason::UnknownFormat, ".nrrd");
  const std::string raw = nrrd("short", bytesOf(counting<std::int16_t>(24)));
  expectRefused(refusalOf([&] { readImageFile(putFile(folder / "a.nii", raw + raw)); }),
                Reason::UnknownFormat, "NIfTI");
  expectRefused(refusalOf([&] { readImageFile(putFile(folder / "a.mha", raw)); }),
                Reason::UnknownFormat, "MetaImage");
  expectRefused(refusalOf([&] { readImageFile(putFile(folder / "a.nrrd", shortNifti().bytes())); }),
                Reason::UnknownFormat, "NRRD");
  expectRefused(refusalOf([&] { readImageFile(putGzip(folder / "b.nii", shortNifti().bytes())); }),
                Reason::UnknownFormat, ".nii.gz");
  const std::string secret = "NRRD0004\nDoe^John\ntype: what\n\n";
  const Refusal refusal = refusalOf([&] { readImageFile(putFile(folder / "b.nrrd", secret)); });
  ASSERT_TRUE(refusal.thrown);
  EXPECT_EQ(refusal.text.find("Doe"), std::string::npos); // no text of the file in a message
}

// Each of these would block, or be read, forever.
TEST(ImageFile, RefusesPipesAndDevicesOfEveryFormat)
{
  const TestFolder folder;
  for (const char* name : {"a.nii", "a.nii.gz", "a.nrrd", "a.nhdr", "a.mha", "a.mhd", "a.seg.nrrd",
                           "a.obj", "a.stl", "a.ply", "b.ctbl"})
    ASSERT_EQ(::mkfifo((folder / name).c_str(), 0600), 0);
  for (const char* name : {"a.nii", "a.nii.gz", "a.nrrd", "a.nhdr", "a.mha", "a.mhd"})
  {
    expectRefused(refusalOf([&] { readImageFile(folder / name); }), Reason::Unreadable, "ordinary");
    expectRefused(refusalOf([&] { readLabelFile(folder / name); }), Reason::Unreadable, "ordinary");
  }
  for (const char* name : {"a.obj", "a.stl", "a.ply"})
    expectRefused(refusalOf([&] { readMesh(folder / name); }), Reason::Unreadable, "ordinary");
  std::filesystem::create_symlink("/dev/zero", folder / "zero.nrrd");
  expectRefused(refusalOf([&] { readImageFile(folder / "zero.nrrd"); }), Reason::Unreadable);
  std::string header = nrrd("short", "");
  header.insert(header.find("endian"), "data file: a.nii\n");
  expectRefused(refusalOf([&] { readImageFile(putFile(folder / "c.nhdr", header)); }),
                Reason::NotFound);
  // A name table next to the labels is optional.
  EXPECT_NO_THROW(readLabelFile(
      putFile(folder / "b.nrrd", nrrd("short", bytesOf(counting<std::int16_t>(24))))));
}

/// Volume n of a file of several, as counted up over all its voxels.
void expectVolume(const LoadedImage& image, int volume, int volumes, const std::string& name)
{
  ASSERT_EQ(image.volume->geometry().dims(), (core::Index3{4, 3, 2})) << name;
  for (int k = 0; k < 2; ++k)
    for (int j = 0; j < 3; ++j)
      for (int i = 0; i < 4; ++i)
        ASSERT_EQ(image.volume->at(i, j, k), 24 * volume + i + 4 * j + 12 * k) << name;
  EXPECT_TRUE(noted(image, "holds " + std::to_string(volumes) +
                               " volumes, of which this is number " + std::to_string(volume + 1)))
      << name;
}

// Along a fourth axis, and interleaved in each voxel as 3D Slicer writes sequences.
TEST(ImageFile, ReadsOneOfTheVolumesOfAFile)
{
  const TestFolder folder;
  constexpr int kVolumes = 3;
  const auto values = counting<std::int16_t>(24 * kVolumes);
  std::vector<std::int16_t> listed;
  std::string text;
  for (int v = 0; v < 24; ++v)
    for (int n = 0; n < kVolumes; ++n)
      listed.push_back(static_cast<std::int16_t>(24 * n + v));
  for (const std::int16_t value : listed)
    text += std::to_string(value) + (value % 5 == 0 ? ",\n" : " ");
  std::string swapped = bytesOf(values);
  for (std::size_t n = 0; n < swapped.size(); n += 2)
    std::swap(swapped[n], swapped[n + 1]);
  const auto head = [](bool isList, const std::string& more)
  {
    const std::string vectors = "(0.5,0,0) (0,0.25,0) (0,0,2)";
    return "NRRD0005\ntype: short\ndimension: 4\nspace: left-posterior-superior\nsizes: " +
           std::string(isList ? "3 4 3 2" : "4 3 2 3") +
           "\nspace directions: " + (isList ? "none " + vectors : vectors + " none") +
           "\nkinds: " + (isList ? "list domain domain domain" : "domain domain domain list") +
           "\nspace origin: (10,20,30)\n" + more + "\n";
  };
  const std::string little = "endian: little\nencoding: raw\n";
  TestNifti nifti;
  nifti.dims = {4, 4, 3, 2, kVolumes, 1, 1, 1};
  nifti.voxels = bytesOf(values);
  putFile(folder / "1.raw", bytesOf(values).substr(0, 48));
  putFile(folder / "2.raw", bytesOf(values).substr(48, 48));
  putFile(folder / "3.raw", bytesOf(values).substr(96, 48));
  const std::filesystem::path files[] = {
      putFile(folder / "a.nii", nifti.bytes()),
      putGzip(folder / "a.nii.gz", nifti.bytes()),
      putFile(folder / "time.nrrd", head(false, little) + bytesOf(values)),
      putFile(folder / "big.nrrd", head(false, "endian: big\nencoding: raw\n") + swapped),
      putFile(folder / "list.nrrd", head(true, little) + bytesOf(listed)),
      putFile(folder / "text.nrrd", head(true, "encoding: text\n") + text),
      putFile(folder / "parts.nhdr", head(false, little + "data file: %d.raw 1 3 1\n")),
      putFile(folder / "a.mha",
              "ObjectType = Image\nNDims = 4\nBinaryData = True\nBinaryDataByteOrderMSB = False\n"
              "TransformMatrix = 1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1\nOffset = 0 0 0 0\n"
              "ElementSpacing = 1 1 1 1\nDimSize = 4 3 2 3\nElementType = MET_SHORT\n"
              "ElementDataFile = LOCAL\n" +
                  bytesOf(values))};
  for (const auto& path : files)
  {
    const std::string name = path.filename().string();
    EXPECT_EQ(readImageHeader(path).volumes, 3U) << name;
    for (int n = 0; n < kVolumes; ++n)
    {
      const auto volume = static_cast<std::size_t>(n + 1);
      expectVolume(readImageFile(path, {}, {}, {}, volume), n, kVolumes, name);
      const auto preview = previewImageFile(path, 8, {}, {}, 0, volume);
      EXPECT_EQ(preview.volume->at(3, 2, 1), 24 * n + 23) << name;
    }
    const auto grid = readImageHeader(path).grid;
    core::PatientBox box(grid.patientFromVoxel({1.0, 1.0, 0.0}));
    box.extend(grid.patientFromVoxel({2.0, 2.0, 1.0}));
    const auto part = readImageFile(path, box, {}, {}, 2);
    EXPECT_EQ(part.volume->geometry().dims(), (core::Index3{2, 2, 2})) << name;
    EXPECT_EQ(part.volume->at(1, 1, 1), 24 + 2 + 8 + 12) << name;
    expectRefused(refusalOf([&] { readImageFile(path); }), Reason::Unsupported,
                  "by its number, 1 to 3");
    expectRefused(refusalOf([&] { readImageFile(path, {}, {}, {}, 4); }), Reason::Unsupported,
                  "no volume 4; it holds volumes 1 to 3");
    expectRefused(refusalOf([&] { readLabelFile(path); }), Reason::Unsupported, "3 volumes");
    EXPECT_EQ(volumeNumber(path, "#2"), 2U);
    EXPECT_EQ(volumeNumber(path, "2"), 2U);
    EXPECT_EQ(volumeNumber(path, {}), 0U);
    expectRefused(refusalOf([&] { volumeNumber(path, "#echo 2"); }), Reason::Unsupported,
                  "one of 1 to 3");
  }
  const auto single = putFile(folder / "one.nii", shortNifti().bytes());
  EXPECT_EQ(readImageFile(single, {}, {}, {}, 1).volume->at(3, 2, 1), 23);
  expectRefused(refusalOf([&] { readImageFile(single, {}, {}, {}, 2); }), Reason::Unsupported,
                "it holds one");
}

/// Progress whose task is cancelled when it reports one of this name.
core::Progress cancelledAt(const std::string& task)
{
  const auto token = std::make_shared<core::CancelToken>();
  return core::Progress(
      [token, task](double, const std::string& text)
      {
        if (text == task)
          token->cancel();
      },
      token);
}

TEST(ImageFile, StopsWithinTextAndLabels)
{
  const TestFolder folder;
  const std::string head = "NRRD0004\ntype: int\ndimension: 3\nspace: left-posterior-superior\n"
                           "sizes: 40 40 40\nspace directions: (1,0,0) (0,1,0) (0,0,1)\n"
                           "space origin: (0,0,0)\n";
  std::string text;
  for (int v = 0; v < 64000; ++v)
    text += "1 ";
  const auto words = putFile(folder / "a.nrrd", head + "encoding: text\n\n" + text);
  EXPECT_NO_THROW(readImageFile(words));
  EXPECT_THROW(readImageFile(words, {}, cancelledAt("reading voxels")), core::CancelledError);
  const auto labels = putFile(folder / "b.nrrd", head + "endian: little\nencoding: raw\n\n" +
                                                     bytesOf(std::vector<std::int32_t>(64000, 1)));
  int reports = 0; // the second of this name is after the voxels were read
  const auto token = std::make_shared<core::CancelToken>();
  const core::Progress second(
      [&](double, const std::string& task)
      {
        if (task == "reading labels" && ++reports == 2)
          token->cancel();
      },
      token);
  EXPECT_NO_THROW(readLabelFile(labels));
  EXPECT_THROW(readLabelFile(labels, second), core::CancelledError);
}

TEST(ImageFile, StopsWhenAsked)
{
  const TestFolder folder;
  const auto path = putFile(folder / "a.nii", shortNifti().bytes());
  const auto token = std::make_shared<core::CancelToken>();
  token->cancel();
  EXPECT_THROW(readImageFile(path, {}, core::Progress({}, token)), core::CancelledError);
}

TEST(ToolkitMessages, OfItkGoToTheLogWithoutTheirText)
{
  const TestFolder folder;
  core::log::Setup setup;
  setup.file = folder.path() / "petrous.log";
  core::log::start(setup);
  logToolkitMessages();
  itkGenericOutputMacro("cannot read /data/Meier^Anna.nii");
  itk::OutputWindowDisplayErrorText("ERROR: In /usr/include/itkReader.hxx, line 7\nMeier^Anna");
  itk::OutputWindow::SetInstance(nullptr);
  setup.level = core::log::Level::Off;
  core::log::start(setup);
  const std::string log = core::readFile(setup.file, 10000);
  EXPECT_NE(log.find(" error ITK message, itkReader.hxx:7\n"), std::string::npos) << log;
  EXPECT_EQ(log.find("Meier"), std::string::npos);
}

} // namespace
} // namespace petrous::imaging
