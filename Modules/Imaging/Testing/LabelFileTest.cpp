#include "petrous/Imaging/LabelFile.h"

#include <algorithm>
#include <limits>
#include <optional>
#include <set>

#include <gtest/gtest.h>

#include "LabelNames.h"
#include "NrrdHeader.h"
#include "TestFiles.h"
#include "petrous/Imaging/ImageFile.h"

namespace petrous::imaging
{
namespace
{

using Reason = FileError::Reason;

template <class T>
std::string nrrd(const std::string& type, const std::vector<T>& voxels,
                 const std::string& more = "")
{
  return "NRRD0004\ntype: " + type +
         "\ndimension: 3\nspace: left-posterior-superior\nsizes: 3 2 2\n"
         "space directions: (0.5,0,0) (0,0.5,0) (0,0,1)\nkinds: domain domain domain\n"
         "endian: little\nencoding: raw\nspace origin: (1,2,3)\n" +
         more + "\n" + bytesOf(voxels);
}

std::string slicerKeys(int number, const std::string& name, int value, int layer)
{
  const std::string prefix = "Segment" + std::to_string(number) + "_";
  return prefix + "ID:=Segment_" + std::to_string(number + 1) + "\n" + prefix + "Name:=" + name +
         "\n" + prefix + "Color:=0.5 0.25 1\n" + prefix + "LabelValue:=" + std::to_string(value) +
         "\n" + prefix + "Layer:=" + std::to_string(layer) + "\n";
}

const volume::Segment* find(const volume::LabelMap& map, const std::string& name)
{
  const auto at = std::find_if(map.segments.begin(), map.segments.end(),
                               [&name](const auto& segment) { return segment.name == name; });
  return at == map.segments.end() ? nullptr : &*at;
}

volume::LabelMap sample(std::uint16_t second)
{
  const core::GridGeometry grid({5, 4, 3}, {0.5, 0.6, 0.7}, {-10.0, 20.0, 30.0});
  auto voxels = std::make_shared<volume::Volume<std::uint16_t>>(grid, std::uint16_t{0});
  voxels->at(1, 2, 1) = 2;
  voxels->at(3, 2, 2) = 2;
  voxels->at(4, 0, 0) = second;
  volume::Segment facial;
  facial.name = "facial nerve \\ left";
  facial.index = 2;
  facial.color = {1.0F, 0.5F, 0.1F};
  volume::Segment other;
  other.name = "cochlea";
  other.index = second;
  volume::Segment empty;
  empty.name = "empty";
  empty.index = 9;
  return volume::makeLabelMap(voxels, {facial, other, empty});
}

TEST(LabelFile, OneStructureIsNamedAfterTheFile)
{
  const TestFolder folder;
  const std::vector<std::uint8_t> mask{0, 255, 255, 0, 0, 0, 0, 0, 0, 0, 0, 255};
  const auto map = readLabelFile(putFile(folder / "facial_nerve.nrrd", nrrd("uchar", mask)));
  ASSERT_EQ(map.segments.size(), 1U);
  EXPECT_EQ(map.segments[0].name, "facial_nerve");
  EXPECT_EQ(map.segments[0].index, 1);
  EXPECT_EQ(map.segments[0].voxels, 3U);
  EXPECT_NEAR(map.volume(map.segments[0]), 3 * 0.25, 1e-12);
  EXPECT_EQ(map.voxels->at(1, 0, 0), 1);

  TestNifti nifti;
  nifti.dims = {3, 3, 2, 2, 1, 1, 1, 1};
  nifti.dataType = 2;
  nifti.bits = 8;
  nifti.voxels = bytesOf(mask);
  EXPECT_EQ(readLabelFile(putGzip(folder / "stapes.nii.gz", nifti.bytes())).segments[0].name,
            "stapes");
}

TEST(LabelFile, TakesEveryTypeOfWholeNumber)
{
  const TestFolder folder;
  const auto read = [&folder](const std::string& type, const auto& values)
  {
    const auto map = readLabelFile(putFile(folder / "a.nrrd", nrrd(type, values)));
    EXPECT_EQ(map.segments.size(), 2U) << type;
    EXPECT_EQ(map.segments[1].name, "label 7") << type;
    EXPECT_EQ(map.voxels->at(2, 1, 1), 7) << type;
  };
  const auto fill = [](auto value)
  {
    std::vector<decltype(value)> values(12, value);
    values[0] = 3;
    values[11] = 7;
    return values;
  };
  read("uchar", fill(std::uint8_t{0}));
  read("signed char", fill(std::int8_t{0}));
  read("short", fill(std::int16_t{0}));
  read("ushort", fill(std::uint16_t{0}));
  read("int", fill(std::int32_t{0}));
  read("uint", fill(std::uint32_t{0}));
  read("int64", fill(std::int64_t{0}));
  read("uint64", fill(std::uint64_t{0}));
  read("float", fill(0.0F));
  read("double", fill(0.0));
}

TEST(LabelFile, RefusesWhatIsNoLabel)
{
  const TestFolder folder;
  const auto refused = [&folder](const std::string& type, auto value)
  {
    std::vector<decltype(value)> values(12, value);
    values[0] = 0;
    return refusalOf([&] { readLabelFile(putFile(folder / "a.nrrd", nrrd(type, values))); });
  };
  expectRefused(refused("short", std::int16_t{-1024}), Reason::Unsupported, "-1024");
  expectRefused(refused("int", std::int32_t{65536}), Reason::Unsupported, "65536");
  expectRefused(refused("int64", std::numeric_limits<std::int64_t>::min()), Reason::Unsupported);
  expectRefused(refused("float", 0.5F), Reason::Unsupported, "not a whole number");
  expectRefused(refused("float", std::numeric_limits<float>::quiet_NaN()), Reason::Unsupported,
                "not a whole number");
  expectRefused(refused("double", 1e300), Reason::Unsupported);
  expectRefused(refused("short", std::int16_t{0}), Reason::Unsupported, "no structure");
  expectRefused(refusalOf([&] { readLabelFile(folder / "none.nrrd"); }), Reason::NotFound);
  expectRefused(refusalOf([&] { readLabelFile(folder.path()); }), Reason::NotFound);
}

TEST(LabelFile, ReadsNamesAndColoursOfSlicersSegmentation)
{
  const TestFolder folder;
  const std::vector<std::uint8_t> values{0, 4, 4, 0, 0, 7, 0, 0, 0, 0, 0, 3};
  const auto map = readLabelFile(putFile(
      folder / "a.seg.nrrd",
      nrrd("uchar", values, slicerKeys(0, "sigmoid sinus", 7, 0) + slicerKeys(1, "incus", 4, 0))));
  ASSERT_EQ(map.segments.size(), 3U);
  ASSERT_NE(find(map, "sigmoid sinus"), nullptr);
  EXPECT_EQ(find(map, "sigmoid sinus")->index, 7);
  EXPECT_EQ(find(map, "sigmoid sinus")->color, (std::array<float, 3>{0.5F, 0.25F, 1.0F}));
  EXPECT_EQ(find(map, "incus")->voxels, 2U);
  EXPECT_NE(find(map, "label 3"), nullptr);
  expectRefused(
      refusalOf(
          [&]
          {
            readLabelFile(putFile(
                folder / "b.seg.nrrd",
                nrrd("uchar", values, slicerKeys(0, "a", 7, 0) + slicerKeys(1, "b", 7, 0))));
          }),
      Reason::Unreadable, "label value 7");
  expectRefused(refusalOf(
                    [&]
                    {
                      readLabelFile(putFile(folder / "c.seg.nrrd",
                                            nrrd("uchar", values, slicerKeys(0, "a", 0, 0))));
                    }),
                Reason::Unreadable, "1 to 65535");
}

TEST(LabelFile, ReadsOverlappingStructuresAsOneMapALayer)
{
  const TestFolder folder;
  // Two layers interleaved in each voxel.
  std::vector<std::uint8_t> values(24, 0);
  values[0] = 1;          // layer 0, voxel 0
  values[1] = 1;          // layer 1, voxel 0: overlaps
  values[2 * 11 + 1] = 2; // layer 1, last voxel
  std::string bytes = nrrd("uchar", values,
                           slicerKeys(0, "bone", 1, 0) + slicerKeys(1, "canal", 1, 1) +
                               slicerKeys(2, "drum", 2, 1));
  const auto replace = [&bytes](const std::string& from, const std::string& to)
  { bytes.replace(bytes.find(from), from.size(), to); };
  replace("dimension: 3", "dimension: 4");
  replace("sizes: 3", "sizes: 2 3");
  replace("directions: ", "directions: none ");
  replace("kinds: ", "kinds: list ");
  const auto path = putFile(folder / "a.seg.nrrd", bytes);
  const auto maps = loadLabels(path).maps;
  ASSERT_EQ(maps.size(), 2U);
  EXPECT_EQ(maps[0].segments.size(), 1U);
  EXPECT_EQ(maps[0].segments[0].name, "bone");
  ASSERT_EQ(maps[1].segments.size(), 2U);
  EXPECT_EQ(maps[1].segments[0].name, "canal");
  EXPECT_EQ(maps[1].voxels->at(0, 0, 0), 1);
  EXPECT_EQ(maps[1].voxels->at(2, 1, 1), 2);
  EXPECT_NEAR(maps[1].voxels->geometry().spacing()[2], 1.0, 1e-12);
  expectRefused(refusalOf([&] { readLabelFile(path); }), Reason::Unsupported, "overlap");
}

TEST(LabelFile, ReadsSegmentsBeyondANumberThatIsMissing)
{
  const TestFolder folder;
  const std::vector<std::uint8_t> values{0, 4, 4, 0, 0, 7, 0, 0, 0, 0, 0, 3};
  const auto map = readLabelFile(putFile(
      folder / "a.seg.nrrd",
      nrrd("uchar", values, slicerKeys(1, "sigmoid sinus", 7, 0) + slicerKeys(12, "incus", 4, 0))));
  ASSERT_NE(find(map, "sigmoid sinus"), nullptr);
  ASSERT_NE(find(map, "incus"), nullptr);
  EXPECT_EQ(find(map, "incus")->index, 4);
}

TEST(LabelFile, ReadsTheTerminologyOfSlicersSegments)
{
  const TestFolder folder;
  const std::vector<std::uint8_t> values{0, 4, 4, 0, 0, 7, 0, 0, 0, 0, 0, 4};
  const auto path = putFile(
      folder / "a.seg.nrrd",
      nrrd("uchar", values,
           slicerKeys(0, "incus", 4, 0) + slicerKeys(1, "drum", 7, 0) +
               "Segment0_Tags:=Segmentation.Status:completed|TerminologyEntry:Segmentation "
               "category and type - a list~SCT^123037004^Anatomical Structure~SCT^56052001^Facial "
               "nerve~SCT^7771000^Left~Anatomic codes - a list~SCT^60911003^Temporal bone~^^|\n"
               "Segment1_Tags:=TerminologyEntry:cut short~SCT^1|\n"));
  const LoadedLabels loaded = loadLabels(path);
  ASSERT_EQ(loaded.codes.size(), 1U) << "what is damaged says nothing";
  const volume::SegmentCodes& codes = loaded.codes.at("incus");
  EXPECT_EQ(codes.category, (volume::CodedConcept{"123037004", "SCT", "Anatomical Structure"}));
  EXPECT_EQ(codes.type, (volume::CodedConcept{"56052001", "SCT", "Facial nerve"}));
  EXPECT_EQ(codes.typeModifier, (volume::CodedConcept{"7771000", "SCT", "Left"}));
  EXPECT_EQ(codes.region, (volume::CodedConcept{"60911003", "SCT", "Temporal bone"}));
  EXPECT_TRUE(codes.regionModifier.empty());

  writeLabelLayers(folder / "b.seg.nrrd", loaded.maps, {}, {{4, codes}});
  const LoadedLabels back = loadLabels(folder / "b.seg.nrrd");
  EXPECT_EQ(back.codes, loaded.codes) << "written and read again";
}

// By hand: voxel (2, 1, 1) lies at (1 + 1, 2 + 0.5, 3 + 1) in the file's own frame.
TEST(LabelFile, ReadsThousandsOfSegments)
{
  constexpr int kCount = 4000;
  const TestFolder folder;
  std::string keys;
  std::vector<std::uint16_t> voxels;
  for (int n = 0; n < kCount; ++n)
  {
    const std::string prefix = "Segment" + std::to_string(n) + "_";
    keys += prefix + "Name:=" + (n % 2 == 0 ? "same" : "part " + std::to_string(n)) + "\n" +
            prefix + "LabelValue:=" + std::to_string(n + 1) + "\n" + prefix + "Color:=1 0 0\n" +
            prefix + "Layer:=0\n" + prefix + "Tags:=TerminologyEntry:x~SCT^1^Tissue~SCT^" +
            std::to_string(n) + "^thing~^^~y~^^~^^|\n";
    voxels.push_back(static_cast<std::uint16_t>(n + 1));
  }
  const auto path = putFile(
      folder / "many.seg.nrrd",
      "NRRD0004\ntype: unsigned short\ndimension: 3\nspace: left-posterior-superior\nsizes: 40 10 "
      "10\nspace directions: (1,0,0) (0,1,0) (0,0,1)\nkinds: domain domain domain\nendian: little\n"
      "encoding: raw\nspace origin: (0,0,0)\n" +
          keys + "\n" + bytesOf(voxels));
  const LoadedLabels loaded = loadLabels(path);
  ASSERT_EQ(loaded.maps.size(), 1U);
  const auto& segments = loaded.maps[0].segments;
  ASSERT_EQ(segments.size(), std::size_t{kCount});
  EXPECT_EQ(segments[0].name, "same");
  EXPECT_EQ(segments[3999].name, "part 3999");
  std::set<std::string> names;
  for (const auto& segment : segments)
  {
    names.insert(segment.name);
    EXPECT_EQ(loaded.codes.at(segment.name).type.value, std::to_string(segment.index - 1));
  }
  EXPECT_EQ(names.size(), std::size_t{kCount});
  EXPECT_EQ(names.count("same 2000"), 1U);
}

TEST(LabelFile, LiesWhereEverySpaceSays)
{
  const TestFolder folder;
  const std::vector<std::uint8_t> values{0, 4, 4, 0, 0, 7, 0, 0, 0, 0, 0, 4};
  const std::pair<const char*, Eigen::Vector3d> spaces[] = {
      {"left-posterior-superior", {2.0, 2.5, 4.0}},
      {"right-anterior-superior", {-2.0, -2.5, 4.0}},
      {"left-anterior-superior", {2.0, -2.5, 4.0}}};
  for (const auto& [space, place] : spaces)
    for (const char* name : {"a.seg.nrrd", "a.nrrd"})
    {
      std::string bytes = nrrd("uchar", values, slicerKeys(0, "incus", 4, 0));
      bytes.replace(bytes.find("left-posterior-superior"), 23, space);
      const auto map = readLabelFile(putFile(folder / name, bytes));
      EXPECT_EQ(map.voxels->at(2, 1, 1), 4);
      EXPECT_TRUE(map.voxels->geometry().patientFromVoxel({2.0, 1.0, 1.0}).isApprox(place, 1e-12))
          << space << " " << name;
    }
}

/// Where voxel (1, 0, 0) lies, or nothing if it is left open which side is left.
std::optional<Eigen::Vector3d> placed(const std::filesystem::path& path,
                                      const std::vector<ImageGrid>& images)
{
  const LoadedLabels loaded = loadLabels(path, {}, {}, images);
  if (loaded.isSideOpen)
    return std::nullopt;
  return loaded.maps.at(0).voxels->geometry().patientFromVoxel({1, 0, 0});
}

TEST(LabelFile, AGridSettlesTheSideOnlyWhereItTellsOne)
{
  const TestFolder folder;
  const auto nrrdFrom = [&folder](const std::string& name, const std::string& origin)
  {
    return putFile(folder / name,
                   "NRRD0004\ntype: uchar\ndimension: 3\nsizes: 4 3 2\nspace dimension: 3\n"
                   "space directions: (1,0,0) (0,1,0) (0,0,1)\nspace origin: " +
                       origin + "\nendian: little\nencoding: raw\n\n" + std::string(23, '\0') +
                       '\1');
  };
  const Eigen::Matrix3d turned = Eigen::Vector3d(-1, -1, 1).asDiagonal();
  const core::GridGeometry middle({4, 3, 2}, {1, 1, 1}, {0, 0, 0});
  const core::GridGeometry middleRas({4, 3, 2}, {1, 1, 1}, {0, 0, 0}, turned);
  const core::GridGeometry aside({4, 3, 2}, {1, 1, 1}, {-8, 2, 3});
  const core::GridGeometry asideRas({4, 3, 2}, {1, 1, 1}, {8, -2, 3}, turned);
  const auto zero = nrrdFrom("zero.nrrd", "(0,0,0)");
  const auto far = nrrdFrom("far.nrrd", "(-8,2,3)");
  const Eigen::Vector3d lps(-7, 2, 3);
  const Eigen::Vector3d ras(7, -2, 3);

  // From 0, 0, 0 any image of the size has this grid, whichever side is meant.
  EXPECT_FALSE(placed(zero, {middle}));
  EXPECT_FALSE(placed(nrrdFrom("up.nrrd", "(0,0,3)"),
                      {core::GridGeometry({4, 3, 2}, {1, 1, 1}, {0, 0, 3})}));
  // Unless the image's own file was as silent: it counts as that was said to.
  EXPECT_EQ(placed(zero, {{middle, true}}), Eigen::Vector3d(1, 0, 0));
  EXPECT_EQ(placed(zero, {{middleRas, true}}), Eigen::Vector3d(-1, 0, 0));
  // An origin on one side is that of one image only.
  EXPECT_EQ(placed(far, {aside}), lps);
  EXPECT_EQ(placed(far, {middle, asideRas}), ras);
  EXPECT_FALSE(placed(far, {middle}));
  // Two images, of one side each.
  EXPECT_FALSE(placed(far, {aside, asideRas}));
  EXPECT_FALSE(placed(far, {asideRas, aside}));
  EXPECT_FALSE(placed(zero, {{middle, true}, {middleRas, true}}));
}

TEST(LabelFile, SaysWhichStructuresLieInNoLayer)
{
  const TestFolder folder;
  const std::vector<std::uint8_t> values{0, 4, 4, 0, 0, 7, 0, 0, 0, 0, 0, 3};
  const auto loaded = loadLabels(
      putFile(folder / "a.seg.nrrd",
              nrrd("uchar", values, slicerKeys(0, "incus", 4, 0) + slicerKeys(1, "drum", 7, 3))));
  ASSERT_EQ(loaded.maps.size(), 1U);
  EXPECT_NE(find(loaded.maps[0], "incus"), nullptr);
  EXPECT_EQ(find(loaded.maps[0], "drum"), nullptr);
  EXPECT_TRUE(std::any_of(loaded.notes.begin(), loaded.notes.end(),
                          [](const std::string& note)
                          { return note.find("'drum' was left out") != note.npos; }));
}

TEST(LabelFile, ColoursAreAlwaysNumbers)
{
  const TestFolder folder;
  const std::vector<std::uint8_t> values{0, 4, 4, 0, 0, 7, 0, 0, 0, 0, 0, 4};
  std::string keys = slicerKeys(0, "incus", 4, 0);
  keys.replace(keys.find("0.5 0.25 1"), 10, "nan inf 0.5");
  const auto map = readLabelFile(putFile(folder / "a.seg.nrrd", nrrd("uchar", values, keys)));
  EXPECT_EQ(find(map, "incus")->color, (std::array<float, 3>{0.0F, 0.0F, 0.5F}));
  for (const char* table : {"4 incus nan 0 0 255\n", "4 nan inf 0 1 1 1 \"incus\"\n"})
    EXPECT_TRUE(parseLabelTable(table).empty()) << table;
}

TEST(LabelFile, TakesNamesFromATableBesideIt)
{
  const TestFolder folder;
  const std::vector<std::uint8_t> values{0, 4, 4, 0, 0, 7, 0, 0, 0, 0, 0, 3};
  const auto path = putFile(folder / "HeadAtlas-labels.nrrd", nrrd("uchar", values));
  EXPECT_NE(find(readLabelFile(path), "label 4"), nullptr);

  putFile(folder / "OtherThing.ctbl", "4 wrong 1 2 3 255\n");
  EXPECT_EQ(find(readLabelFile(path), "wrong"), nullptr); // no common word
  std::filesystem::remove(folder / "OtherThing.ctbl");

  putFile(folder / "BrainAtlas-colors.ctbl",
          "# Color table\n0 Background 0 0 0 0\n4 incus 255 0 51 255\n7 stapes 0 0 0 255\n"
          "8 absent 0 0 0 255\n");
  auto map = readLabelFile(path);
  ASSERT_NE(find(map, "incus"), nullptr);
  EXPECT_NEAR(find(map, "incus")->color[2], 0.2F, 1e-6F);
  EXPECT_NE(find(map, "stapes"), nullptr);
  EXPECT_NE(find(map, "label 3"), nullptr);
  EXPECT_EQ(find(map, "absent"), nullptr);

  putFile(folder / "HeadAtlas-labels.label",
          "# ITK-SNAP\n    4  255  128 0   1  1  1  \"the anvil\"\n");
  EXPECT_NE(find(readLabelFile(path), "the anvil"), nullptr); // its own table wins
}

TEST(LabelFile, ParsesTablesLineByLine)
{
  const auto segments = parseLabelTable("# c\n\nnonsense\n70000 a 1 2 3 4\n-1 b 1 2 3 4\n"
                                        "5 first 255 0 0 255\n5 second 0 0 0 0\n6 \"two words\" "
                                        "0 255 0 255\n7 short 1\n");
  ASSERT_EQ(segments.size(), 2U);
  EXPECT_EQ(segments[0].name, "first");
  EXPECT_EQ(segments[1].name, "two words");
  EXPECT_EQ(segments[1].color, (std::array<float, 3>{0.0F, 1.0F, 0.0F}));
}

TEST(LabelFile, RoundTripKeepsNamesColoursAndVoxels)
{
  const TestFolder folder;
  for (const std::uint16_t second : {std::uint16_t{200}, std::uint16_t{60000}})
    for (const char* name : {"a.seg.nrrd", "a.nrrd"})
    {
      const volume::LabelMap map = sample(second);
      writeLabelFile(folder / name, map);
      const volume::LabelMap back = readLabelFile(folder / name);
      ASSERT_EQ(back.segments.size(), 3U);
      for (std::size_t s = 0; s < 3; ++s)
      {
        EXPECT_EQ(back.segments[s].name, map.segments[s].name);
        EXPECT_EQ(back.segments[s].index, map.segments[s].index);
        EXPECT_EQ(back.segments[s].color, map.segments[s].color);
        EXPECT_EQ(back.segments[s].voxels, map.segments[s].voxels);
      }
      EXPECT_TRUE(core::sameGrid(back.voxels->geometry(), map.voxels->geometry(), 1e-12));
      EXPECT_EQ(std::memcmp(back.voxels->data(), map.voxels->data(), map.voxels->bytes()), 0);
      const NrrdHeader header = readNrrdHeader(folder / name);
      EXPECT_EQ(*header.field("type"), second > 255 ? "unsigned short" : "unsigned char");
      EXPECT_EQ(*header.key("Segment0_Extent"), "1 3 2 2 1 2");
      EXPECT_EQ(*header.key("Segment1_Extent"), "0 -1 0 -1 0 -1");
      EXPECT_EQ(*header.key("Segmentation_MasterRepresentation"), "Binary labelmap");
    }
}

TEST(LabelFile, EqualMapsGiveEqualBytes)
{
  const TestFolder folder;
  for (const std::string end : {".seg.nrrd", ".nii.gz", ".nii", ".nrrd"})
  {
    writeLabelFile(folder / ("a" + end), sample(3));
    writeLabelFile(folder / ("b" + end), sample(3));
    EXPECT_EQ(fileBytes(folder / ("a" + end)), fileBytes(folder / ("b" + end))) << end;
    EXPECT_EQ(readLabelFile(folder / ("a" + end)).voxels->at(4, 0, 0), 3) << end;
  }
}

// No region of a label file can be chosen: it is read whole.
TEST(LabelFile, OfMoreMemoryThanThereIsIsToBeCut)
{
  const TestFolder folder;
  constexpr std::uint64_t kSide = 8192;
  constexpr std::uint64_t kSlices = 40000; // 5 TB, none of which is written
  const std::string header =
      "NRRD0004\ntype: uint16\ndimension: 3\nspace: left-posterior-superior\nsizes: " +
      std::to_string(kSide) + " " + std::to_string(kSide) + " " + std::to_string(kSlices) +
      "\nspace directions: (0.01,0,0) (0,0.01,0) (0,0,0.01)\nkinds: domain domain domain\n"
      "endian: little\nencoding: raw\nspace origin: (1,2,3)\n\n";
  putFile(folder / "large.nrrd", header);
  std::error_code refused;
  std::filesystem::resize_file(folder / "large.nrrd",
                               header.size() + kSide * kSide * kSlices * sizeof(std::uint16_t),
                               refused);
  if (refused)
    GTEST_SKIP() << "no sparse files here: " << refused.message();
  const auto refusal = refusalOf([&] { readLabelFile(folder / "large.nrrd"); });
  expectRefused(refusal, Reason::Unreadable, "GB of memory, which is not free; close programs or");
  expectRefused(refusal, Reason::Unreadable, "export only the part of it around its structures");
  expectRefused(refusalOf([&] { readImageFile(folder / "large.nrrd"); }), Reason::Unreadable,
                "give a region of interest");
}

TEST(LabelFile, RefusesToWriteInWords)
{
  const TestFolder folder;
  expectRefused(refusalOf([&] { writeLabelFile(folder / "a.mha", sample(3)); }),
                Reason::UnknownFormat, ".seg.nrrd");
  expectRefused(refusalOf([&] { writeLabelFile(folder / "none/a.nrrd", sample(3)); }),
                Reason::Unwritable);
  EXPECT_THROW(writeLabelFile(folder / "a.nrrd", {}), core::InvalidParameter);
  EXPECT_EQ(folder.fileCount(), 0U);
}

} // namespace
} // namespace petrous::imaging
