#include <algorithm>
#include <fstream>
#include <iterator>
#include <map>
#include <random>
#include <set>

#include <gtest/gtest.h>

#include <unistd.h>

#include "../../../Modules/Imaging/Testing/TestDicom.h"
#include "SharedSample.h"
#include "petrous/Core/SystemMemory.h"
#include "petrous/Imaging/DicomReader.h"
#include "petrous/Imaging/DicomScan.h"
#include "petrous/Imaging/LabelFile.h"
#include "petrous/Imaging/MeshFile.h"
#include "petrous/Imaging/VolumeFile.h"
#include "petrous/Presenters/CaseBuilder.h"
#include "petrous/Presenters/PartFiles.h"
#include "petrous/Presenters/SeriesPreview.h"
#include "petrous/Presenters/SourceContent.h"

using namespace petrous;
using Eigen::Vector3d;
using presenters::Content;

namespace
{

const core::GridGeometry kGrid({24, 20, 16}, Vector3d::Constant(0.5), Vector3d::Zero());

// A voxel's value from its position, -1 to 1 in each axis.
template <class T, class Value>
std::shared_ptr<const volume::Volume<T>> filled(const Value& value)
{
  auto image = std::make_shared<volume::Volume<T>>(kGrid);
  for (int k = 0; k < 16; ++k)
    for (int j = 0; j < 20; ++j)
      for (int i = 0; i < 24; ++i)
        image->at(i, j, k) =
            static_cast<T>(value(Vector3d(i / 11.5 - 1.0, j / 9.5 - 1.0, k / 7.5 - 1.0)));
  return image;
}

template <class T, class Value>
Content contentOf(const Value& value)
{
  return presenters::contentOf(volume::IntensityVolume(filled<T>(value)));
}

class SourceContent : public ::testing::Test
{
protected:
  void SetUp() override
  {
    m_folder =
        std::filesystem::temp_directory_path() / ("petrous-content-" + std::to_string(::getpid()));
    std::filesystem::create_directories(m_folder);
  }
  void TearDown() override { std::filesystem::remove_all(m_folder); }
  Content at(const std::string& name) const
  {
    return presenters::lookAt(m_folder / name, {}).content;
  }
  std::filesystem::path m_folder;
};

double headInHounsfield(const Vector3d& at)
{
  const double r = at.norm();
  return r > 0.9 ? -1000.0 : r > 0.7 ? 1100.0 + 100.0 * at.x() : 40.0 + 10.0 * at.y();
}

} // namespace

TEST(Content, HounsfieldUnitsAreACt)
{
  EXPECT_EQ(contentOf<std::int16_t>(headInHounsfield), Content::Ct);
  EXPECT_EQ(contentOf<float>(headInHounsfield), Content::Ct);
}

TEST(Content, UnitsOfTheirOwnAreInDoubt)
{
  std::mt19937 random(7);
  std::normal_distribution<double> noise(0.0, 12.0);
  const auto mr = [&](const Vector3d& at)
  { return at.norm() > 0.9 ? std::abs(noise(random)) : std::abs(120.0 + noise(random)); };
  EXPECT_EQ(contentOf<std::uint16_t>(mr), Content::Image);
  EXPECT_EQ(contentOf<std::int16_t>(mr), Content::Image);
  EXPECT_EQ(contentOf<float>([&](const Vector3d& at) { return 7.3 * mr(at); }), Content::Image);
  const auto coneBeam = [](const Vector3d& at)
  { return 8000.0 + 20.0 * headInHounsfield(at) + 20000.0; };
  EXPECT_EQ(contentOf<std::uint16_t>(coneBeam), Content::Image);
}

// A masked 8-bit MR: few values, many of them 0.
TEST(Content, AnMrOfEightBitsIsNoLabelMap)
{
  std::mt19937 random(7);
  std::normal_distribution<double> noise(0.0, 12.0);
  const auto brain = [&](const Vector3d& at)
  { return at.norm() > 0.9 ? 0.0 : std::clamp(std::round(120.0 + noise(random)), 0.0, 255.0); };
  EXPECT_EQ(contentOf<std::int16_t>(brain), Content::Image);
}

TEST(Content, FewWholeNumbersInPatchesAreLabels)
{
  const auto two = [](const Vector3d& at) {
    return at.norm() < 0.4 ? 2.0 : at.norm() < 0.6 ? 1.0 : 0.0;
  };
  EXPECT_EQ(contentOf<std::int16_t>(two), Content::Labels);
  EXPECT_EQ(contentOf<std::uint16_t>(two), Content::Labels);
  EXPECT_EQ(contentOf<float>(two), Content::Labels);
  const auto thirty = [](const Vector3d& at) {
    return std::floor(5.99 * (0.5 * at.x() + 0.5)) + 6.0 * std::floor(4.99 * (0.5 * at.y() + 0.5));
  };
  EXPECT_EQ(contentOf<std::int16_t>(thirty), Content::Labels);
  // A nerve one voxel thin, oblique, whose voxels touch only at corners.
  const auto thread = [](const Vector3d& at)
  {
    const int i = static_cast<int>(std::lround(11.5 * (at.x() + 1.0)));
    const int j = static_cast<int>(std::lround(9.5 * (at.y() + 1.0)));
    const int k = static_cast<int>(std::lround(7.5 * (at.z() + 1.0)));
    return i == j && j == k ? 255.0 : 0.0;
  };
  EXPECT_EQ(contentOf<std::int16_t>(thread), Content::Labels);
  EXPECT_EQ(contentOf<float>([&](const Vector3d& at) { return 0.5 * two(at); }), Content::Image);
  EXPECT_NE(contentOf<std::int16_t>([](const Vector3d&) { return 0.0; }), Content::Labels);
}

TEST_F(SourceContent, IsKnownOfEachKindOfFile)
{
  phantom::SampleOptions options;
  options.spacing = 1.5;
  petrous::testing::writeSharedSample(m_folder, options);
  EXPECT_EQ(at("ct"), Content::Ct);
  EXPECT_EQ(at("mr"), Content::Mr);
  EXPECT_EQ(at("labels.seg.nrrd"), Content::Labels);
  imaging::writeVolume(m_folder / "ear.nrrd", *filled<std::int16_t>(headInHounsfield));
  EXPECT_EQ(at("ear.nrrd"), Content::Ct);
  auto labels = filled<std::uint16_t>([](const Vector3d& a) { return a.norm() < 0.5 ? 3.0 : 0.0; });
  imaging::writeLabelFile(m_folder / "x.nii.gz", volume::makeLabelMap(std::move(labels), {}));
  EXPECT_EQ(at("x.nii.gz"), Content::Labels);
  for (const auto& entry : std::filesystem::recursive_directory_iterator(m_folder / "meshes"))
  {
    EXPECT_EQ(presenters::lookAt(entry.path(), {}).content, Content::Mesh);
    break;
  }
}

// A head whose file calls its micrometres millimetres lies 100 m and more from the origin: it is
// looked at all the same, so that its unit can be asked about.
TEST_F(SourceContent, IsKnownBeforeTheUnitOfLengthIs)
{
  const core::GridGeometry grid({401, 401, 3}, Vector3d::Constant(500.0),
                                Vector3d(-1e5, -1e5, 0.0));
  auto voxels = std::make_shared<volume::Volume<std::int16_t>>(grid);
  for (int k = 0; k < 3; ++k)
    for (int j = 0; j < 401; ++j)
      for (int i = 0; i < 401; ++i)
        voxels->at(i, j, k) = static_cast<std::int16_t>(
            headInHounsfield(Vector3d(i / 200.0 - 1.0, j / 200.0 - 1.0, k - 1.0)));
  const std::shared_ptr<const volume::Volume<std::int16_t>> image = voxels;
  imaging::writeVolume(m_folder / "far.nii", volume::IntensityVolume(image));
  const auto found = presenters::lookAt(m_folder / "far.nii", {});
  EXPECT_EQ(found.content, Content::Ct);
  EXPECT_EQ(std::count(found.unitDoubt.likely.begin(), found.unitDoubt.likely.end(), 1e-3), 1);
}

// Structures that nothing names: a table can be asked for. One beside the file is found.
TEST_F(SourceContent, CountsTheStructuresOfALabelMapThatNothingNames)
{
  const auto map =
      volume::makeLabelMap(filled<std::uint16_t>(
                               [](const Vector3d& at) {
                                 return at.norm() > 0.8 ? 0.0 : at.x() < 0.0 ? 3.0 : 7.0;
                               }),
                           {});
  imaging::writeLabelFile(m_folder / "ear.nii.gz", map);
  EXPECT_EQ(presenters::lookAt(m_folder / "ear.nii.gz", {}).unnamed, 2U);
  EXPECT_EQ(presenters::lookAt(m_folder / "ear.nii.gz", {}).structureCount, 2U);
  imaging::writeLabelFile(m_folder / "cochlea.nii.gz", map);
  EXPECT_EQ(presenters::lookAt(m_folder / "cochlea.nii.gz", {}).unnamed, 2U);
  std::ofstream(m_folder / "ear.csv") << "index,name\n3,cochlea\n";
  EXPECT_EQ(presenters::lookAt(m_folder / "ear.nii.gz", {}).unnamed, 1U);
  std::ofstream(m_folder / "ear.csv") << "index,name\n3,cochlea\n7,incus\n";
  EXPECT_EQ(presenters::lookAt(m_folder / "ear.nii.gz", {}).unnamed, 0U);

  const auto names = [this](const std::filesystem::path& table)
  {
    presenters::CaseSources sources;
    auto ct = std::make_shared<volume::Volume<std::int16_t>>(kGrid, std::int16_t{-1000});
    ct->at(7, 6, 5) = 1200;
    imaging::writeVolume(m_folder / "ct.nrrd", *ct);
    sources.ct = m_folder / "ct.nrrd";
    sources.parts.labels.push_back({"", m_folder / "cochlea.nii.gz"});
    sources.parts.labels.back().labelNames = table;
    std::string all;
    const scene::Case value = presenters::buildCase("c", sources, {});
    for (const auto& structure : value.labels[0].structures)
      all += structure.name + ";";
    return all;
  };
  EXPECT_EQ(names({}), "label 3;label 7;");
  EXPECT_EQ(names(m_folder / "ear.csv"), "cochlea;incus;");
}

TEST_F(SourceContent, CountsTheObjectsOfAMesh)
{
  const std::string corners = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
  std::ofstream(m_folder / "two.obj") << corners << "o a\nf 1 2 3\no b\nf 1 3 2\n";
  std::ofstream(m_folder / "one.obj") << corners << "o a\nf 1 2 3\n";
  std::ofstream(m_folder / "damaged.obj") << corners << "o a\nf 1 2 9\no b\nf 1 3 2\n";
  EXPECT_EQ(presenters::lookAt(m_folder / "two.obj", {}).structureCount, 2U);
  EXPECT_EQ(presenters::lookAt(m_folder / "one.obj", {}).structureCount, 1U);
  const auto damaged = presenters::lookAt(m_folder / "damaged.obj", {});
  EXPECT_EQ(damaged.content, Content::Mesh) << "told when it is added";
  EXPECT_EQ(damaged.structureCount, 0U);
}

TEST_F(SourceContent, OfAFolderWithCtAndMrTheUserSaysWhich)
{
  phantom::SampleOptions options;
  options.spacing = 1.5;
  petrous::testing::writeSharedSample(m_folder, options);
  std::filesystem::create_directory(m_folder / "visit");
  std::filesystem::rename(m_folder / "ct", m_folder / "visit" / "ct");
  std::filesystem::rename(m_folder / "mr", m_folder / "visit" / "mr");
  const auto found = presenters::lookAt(m_folder / "visit", {});
  EXPECT_EQ(std::count_if(found.series.begin(), found.series.end(),
                          [](const auto& one) { return one.files.empty(); }),
            2);
  EXPECT_EQ(found.series[0].content, Content::Ct);
  EXPECT_EQ(found.series[1].content, Content::Mr);
  EXPECT_GT(found.series[0].slices, 10u);
  EXPECT_EQ(found.series[0].folder, "ct");
  EXPECT_EQ(found.series[1].folder, "mr");
  EXPECT_EQ(found.series[0].taken, "20200101 1200"); // as written by the test
  EXPECT_EQ(found.series[0].patientPosition, "HFS");
}

// Two visits whose series lie in folders of one name, and two series of one folder.
TEST_F(SourceContent, SeriesAreToldApartByTheirPlaces)
{
  phantom::SampleOptions options;
  options.spacing = 3.0;
  petrous::testing::writeSharedSample(m_folder, options);
  const auto put = [this](const char* from, const std::filesystem::path& to)
  {
    std::filesystem::create_directories(to.parent_path());
    std::filesystem::copy(m_folder / from, to, std::filesystem::copy_options::recursive);
  };
  const auto all = m_folder / "junk";
  put("ct", all / "first" / "dicom" / "001");
  put("mr", all / "second" / "dicom" / "001");
  const auto foldersOf = [&]
  {
    std::set<std::string> folders;
    for (const presenters::SeriesContent& one : presenters::lookAt(all, {}).series)
      if (one.files.empty()) // of DICOM; files of structures lie beside
        folders.insert(one.folder);
    return folders;
  };
  EXPECT_EQ(foldersOf(), (std::set<std::string>{"first/dicom/001", "second/dicom/001"}));
  // One of them gives a case the name of its folder; both, or one of a single folder, none.
  std::vector<presenters::SeriesContent> images;
  for (const presenters::SeriesContent& one : presenters::lookAt(all, {}).series)
    if (one.files.empty())
      images.push_back(one);
  ASSERT_EQ(images.size(), 2u);
  EXPECT_EQ(presenters::namingFolder({images[1]}, images).parent_path().parent_path().filename(),
            images[1].content == Content::Mr ? "second" : "first");
  EXPECT_TRUE(presenters::namingFolder(images, images).empty());
  EXPECT_TRUE(presenters::namingFolder({images[0]}, {images[0]}).empty());
  std::filesystem::rename(all / "second" / "dicom", all / "second" / "mr");
  EXPECT_EQ(foldersOf(), (std::set<std::string>{"dicom/001", "mr/001"}));
  std::filesystem::rename(all / "second" / "mr" / "001", all / "second" / "mr" / "002");
  EXPECT_EQ(foldersOf(), (std::set<std::string>{"001", "002"}));
}

TEST_F(SourceContent, ASeriesThatNothingPlacesIsListedWithTheReason)
{
  namespace imagingTest = imaging::test;
  imagingTest::writeSeries(m_folder / "sound", 5);
  imagingTest::writeSeries(m_folder / "unplaced", 4,
                           [](int, imagingTest::TestSlice& slice)
                           {
                             slice.seriesUid = "1.2.3.5";
                             slice.orientation.clear();
                           });
  imagingTest::writeSeries(m_folder / "report", 4,
                           [](int, imagingTest::TestSlice& slice)
                           {
                             slice.seriesUid = "1.2.3.6";
                             slice.modality = "SR";
                             slice.sopClass = "1.2.840.10008.5.1.4.1.1.88.11";
                             slice.pixels = false;
                             slice.rows = slice.columns = 0;
                           });
  const auto found = presenters::lookAt(m_folder, {});
  ASSERT_EQ(found.series.size(), 2u);
  EXPECT_EQ(found.series[0].selector, "1.2.3.4");
  EXPECT_EQ(found.series[0].verdict, imaging::Verdict::Ok);
  EXPECT_EQ(found.series[0].folder, "sound");
  const presenters::SeriesContent& unplaced = found.series[1];
  EXPECT_EQ(unplaced.selector, "1.2.3.5");
  EXPECT_EQ(unplaced.content, Content::Ct);
  EXPECT_EQ(unplaced.slices, 4u);
  EXPECT_EQ(unplaced.verdict, imaging::Verdict::Refused);
  EXPECT_EQ(unplaced.folder, "");
  ASSERT_FALSE(unplaced.findings.empty());
  EXPECT_EQ(unplaced.findings.front().kind, imaging::FindingKind::NoGeometry);
}

// The elements of an RT structure set that tell what it is (PS3.3 A.19), explicit little endian.
// Slices of more than the machine's memory, of which the disk holds the headers alone.
TEST_F(SourceContent, ASeriesThatTheMemoryDoesNotHoldIsKnownBeforeItIsRead)
{
  constexpr int kEdge = 32000;
  constexpr std::uint64_t kBytes = std::uint64_t{2} * kEdge * kEdge;
  const std::uint64_t memory = core::systemMemory().total;
  if (memory == 0)
    GTEST_SKIP() << "its size is not known";
  imaging::test::writeSeries(m_folder / "small", 5);
  EXPECT_FALSE(presenters::lookAt(m_folder / "small", {}).isTooLarge);
  const auto count = static_cast<int>(memory / kBytes) + 3;
  const auto folder = m_folder / "large";
  std::filesystem::create_directories(folder);
  for (int k = 0; k < count; ++k)
  {
    imaging::test::TestSlice slice;
    slice.z = 0.5 * k;
    slice.rows = slice.columns = kEdge;
    slice.pixels = false;
    std::string bytes = slice.bytes();
    slice.element(bytes, 0x7fe00010, "OW", {});
    bytes.resize(bytes.size() - 4); // the length of nothing
    slice.append(bytes, static_cast<std::uint32_t>(kBytes), 4);
    const auto file = folder / ("s" + std::to_string(k) + ".dcm");
    imaging::test::writeText(file, bytes);
    std::filesystem::resize_file(file, bytes.size() + kBytes);
  }
  const auto found = presenters::lookAt(folder, {});
  EXPECT_EQ(found.content, Content::Ct);
  EXPECT_TRUE(found.isTooLarge);
  presenters::CaseSources sources;
  sources.ct = folder;
  try
  {
    presenters::buildCase("ear", sources, {});
    ADD_FAILURE() << "read";
  }
  catch (const imaging::DicomError& error)
  {
    EXPECT_EQ(error.reason(), imaging::DicomError::Reason::TooLarge) << error.what();
    EXPECT_EQ(error.fault(), core::Fault::Refused) << "the input is sound, and a region may do";
  }
}

// Sparse files: the disk holds their headers alone.
TEST_F(SourceContent, AFileThatTheMemoryDoesNotHoldIsOfferedByRegion)
{
  constexpr std::uint64_t kEdge = 512;
  constexpr std::uint64_t kBytes = kEdge * kEdge * sizeof(std::int16_t);
  const std::uint64_t memory = core::systemMemory().total;
  if (memory == 0)
    GTEST_SKIP() << "its size is not known";
  const std::uint64_t slices = memory / kBytes + 3;
  const std::string sizes =
      std::to_string(kEdge) + " " + std::to_string(kEdge) + " " + std::to_string(slices);
  const std::map<std::string, std::string> headers{
      {"large.nrrd",
       "NRRD0004\ntype: int16\ndimension: 3\nspace: left-posterior-superior\nsizes: " + sizes +
           "\nspace directions: (0.01,0,0) (0,0.01,0) (0,0,0.001)\n"
           "kinds: domain domain domain\nendian: little\nencoding: raw\n"
           "space origin: (1,2,3)\n\n"},
      {"large.mha", "ObjectType = Image\nNDims = 3\nBinaryData = True\nBinaryDataByteOrderMSB = "
                    "False\nCompressedData = False\nTransformMatrix = 1 0 0 0 1 0 0 0 1\n"
                    "Offset = 1 2 3\nElementSpacing = 0.01 0.01 0.001\nDimSize = " +
                        sizes + "\nElementType = MET_SHORT\nElementDataFile = LOCAL\n"}};
  for (const auto& [name, header] : headers)
  {
    const auto file = m_folder / name;
    imaging::test::writeText(file, header);
    std::error_code refused;
    std::filesystem::resize_file(file, header.size() + kBytes * slices, refused);
    if (refused)
      GTEST_SKIP() << "no sparse files here: " << refused.message();
    const auto found = presenters::lookAt(file, {});
    EXPECT_TRUE(found.isTooLarge) << name;
    EXPECT_EQ(found.content, Content::Image) << name; // all zero
  }
}

TEST_F(SourceContent, OffersTheStructureSetsOfAFolder)
{
  phantom::SampleOptions options;
  options.spacing = 1.5;
  petrous::testing::writeSharedSample(m_folder, options);
  std::string file(128, '\0');
  file += "DICM";
  const auto element = [&file](const std::string& tag, const char* vr, std::string value)
  {
    value += std::string(value.size() % 2, value.find('.') != value.npos ? '\0' : ' ');
    file += tag + vr + static_cast<char>(value.size()) + '\0' + value;
  };
  const std::string sopClass = "1.2.840.10008.5.1.4.1.1.481.3";
  element(std::string("\x02\0\x10\0", 4), "UI", "1.2.840.10008.1.2.1");
  element(std::string("\x08\0\x16\0", 4), "UI", sopClass);
  element(std::string("\x08\0\x18\0", 4), "UI", "1.2.3.77");
  element(std::string("\x08\0\x60\0", 4), "CS", "RTSTRUCT");
  element(std::string("\x20\0\x0d\0", 4), "UI", "1.2.9");
  element(std::string("\x20\0\x0e\0", 4), "UI", "1.2.10");
  std::ofstream(m_folder / "ct" / "set.dcm", std::ios::binary) << file;
  const auto found = presenters::lookAt(m_folder / "ct", {});
  const auto set = std::find_if(found.series.begin(), found.series.end(),
                                [](const auto& one) { return one.modality == "RTSTRUCT"; });
  ASSERT_NE(set, found.series.end());
  EXPECT_EQ(set->content, Content::Labels);
  EXPECT_EQ(set->files.front().filename(), "set.dcm");

  // A DICOMDIR stands for its folder.
  std::string index(128, '\0');
  index += "DICM" + std::string("\x02\0\x02\0UI\x14\0", 8) + "1.2.840.10008.1.3.10" +
           std::string("\x02\0\x10\0UI\x14\0", 8) + std::string("1.2.840.10008.1.2.1\0", 20) +
           std::string("\x04\0\x20\x12SQ\0\0\0\0\0\0", 12);
  std::ofstream(m_folder / "ct" / "DICOMDIR", std::ios::binary) << index;
  const auto disc = presenters::lookAt(m_folder / "ct" / "DICOMDIR", {});
  ASSERT_EQ(disc.series.size(), found.series.size());
  EXPECT_TRUE(std::any_of(disc.series.begin(), disc.series.end(),
                          [](const auto& one) {
                            return !one.files.empty() && one.files.front().filename() == "set.dcm";
                          }));
}

TEST_F(SourceContent, MasksAreTakenForWhatTheyAreAlsoAboveDicom)
{
  phantom::SampleOptions options;
  options.spacing = 1.5;
  petrous::testing::writeSharedSample(m_folder, options);
  auto voxels = volume::makeZeroVolume<std::uint16_t>(kGrid);
  voxels->at(3, 4, 5) = 1;
  std::filesystem::create_directories(m_folder / "study");
  std::filesystem::rename(m_folder / "ct", m_folder / "study" / "ct");
  imaging::writeLabelFile(m_folder / "study" / "incus.nii.gz", volume::makeLabelMap(voxels, {}));
  auto both = presenters::lookAt(m_folder / "study", {}).series;
  both.erase(std::remove_if(both.begin(), both.end(), [](const auto& one) { return one.isBeside; }),
             both.end());
  ASSERT_EQ(both.size(), 2u);
  EXPECT_EQ(both[0].content, Content::Ct);
  EXPECT_EQ(both[1].content, Content::Labels);
  EXPECT_EQ(both[1].files, std::vector{m_folder / "study" / "incus.nii.gz"});
  EXPECT_EQ(both[1].image, "") << "on another grid";
  const auto masks = presenters::lookAt(m_folder / "study", {}, Content::Labels);
  EXPECT_EQ(masks.content, Content::Labels);
  EXPECT_EQ(masks.structures, std::vector<std::string>{"incus"});
  EXPECT_EQ(presenters::lookAt(m_folder / "study" / "ct", {}, Content::Labels).content, Content::Ct)
      << "there are none";
}

TEST_F(SourceContent, OffersTheVolumesOfAFile)
{
  std::string voxels;
  for (const double more : {0.0, 25.0})
  {
    const auto image =
        filled<std::int16_t>([more](const Vector3d& at) { return headInHounsfield(at) + more; });
    voxels.append(reinterpret_cast<const char*>(image->data()),
                  image->size() * sizeof(std::int16_t));
  }
  const auto path = m_folder / "t2 rest.nrrd";
  std::ofstream(path, std::ios::binary)
      << "NRRD0004\ntype: short\ndimension: 4\nspace: left-posterior-superior\n"
         "sizes: 24 20 16 2\nspace directions: (.5,0,0) (0,.5,0) (0,0,.5) none\n"
         "kinds: domain domain domain list\nendian: little\nencoding: raw\n"
         "space origin: (0,0,0)\n\n"
      << voxels;
  for (const auto expected : {std::optional<Content>(), std::optional(Content::Mr)})
  {
    const auto source = presenters::lookAt(path, {}, expected);
    ASSERT_EQ(source.series.size(), 2U);
    for (std::size_t n = 0; n < 2; ++n)
    {
      const presenters::SeriesContent& one = source.series[n];
      EXPECT_EQ(one.selector, "#" + std::to_string(n + 1));
      EXPECT_EQ(one.content, expected.value_or(Content::Ct));
      EXPECT_EQ(one.name, "t2 " + std::to_string(n + 1));
      EXPECT_EQ(one.slices, 16U);
      EXPECT_EQ(one.verdict, imaging::Verdict::Ok);
      EXPECT_TRUE(one.files.empty());
      const auto preview = presenters::previewScan(path, one.selector, false, {});
      EXPECT_EQ(preview.value.ct.volume.get()->at(12, 10, 8),
                std::trunc(headInHounsfield({12 / 11.5 - 1.0, 10 / 9.5 - 1.0, 8 / 7.5 - 1.0}) +
                           25.0 * static_cast<double>(n)));
    }
  }
  EXPECT_THROW(presenters::lookAt(path, {}, Content::Labels), imaging::FileError);
}

TEST_F(SourceContent, OffersStructuresAndMeshesThatLieWithTheSlices)
{
  namespace fs = std::filesystem;
  const fs::path visit = m_folder / "visit";
  phantom::SampleOptions options;
  options.spacing = 1.5;
  petrous::testing::writeSharedSample(visit, options);
  const auto masks = std::distance(fs::directory_iterator(visit / "labels"), {});
  const auto meshes = std::distance(fs::directory_iterator(visit / "meshes"), {});
  ASSERT_GT(masks, 4);
  presenters::CaseSources sources;
  sources.ct = visit / "ct";
  const scene::Case truth = presenters::buildCase("ear", sources, {});
  imaging::writeVolume(visit / "ct" / "converted.nii.gz", *truth.ct.volume.get());
  auto voxels = volume::makeZeroVolume<std::uint16_t>(kGrid);
  voxels->at(3, 4, 5) = 1;
  voxels->at(6, 4, 5) = 2;
  imaging::writeLabelFile(visit / "other.nrrd", volume::makeLabelMap(voxels, {}));
  fs::copy(visit / "other.nrrd", visit / "._other.nrrd");
  std::ofstream(visit / "broken.nii.gz") << "not one";

  const auto of = [](const std::vector<presenters::SeriesContent>& all, const std::string& name)
  {
    const auto found = std::find_if(all.begin(), all.end(),
                                    [&](const auto& one)
                                    { return !one.files.empty() && one.description == name; });
    return found == all.end() ? presenters::SeriesContent() : *found;
  };
  const auto found = presenters::lookAt(visit, {}).series;
  ASSERT_GT(found.size(), 2u);
  const std::string ct = found[0].selector;
  EXPECT_EQ(found[0].content, Content::Ct);
  const auto folder = of(found, "labels");
  EXPECT_EQ(folder.content, Content::Labels);
  EXPECT_EQ(folder.files, std::vector{visit / "labels"});
  EXPECT_EQ(folder.slices, static_cast<std::size_t>(masks));
  EXPECT_EQ(folder.image, ct) << "its grid";
  const auto slicer = of(found, "labels.seg.nrrd");
  EXPECT_EQ(slicer.image, ct);
  EXPECT_EQ(slicer.content, Content::Labels);
  const auto other = of(found, "other.nrrd");
  EXPECT_EQ(other.what, "label map");
  EXPECT_EQ(other.image, "") << "the grid of no image";
  for (const char* none : {"converted.nii.gz", "._other.nrrd", "broken.nii.gz"})
    EXPECT_TRUE(of(found, none).files.empty()) << none;
  std::size_t surfaces = 0;
  for (const auto& one : found)
  {
    surfaces += one.content == Content::Mesh ? one.files.size() : 0;
    EXPECT_FALSE(one.isBeside);
  }
  EXPECT_EQ(surfaces, static_cast<std::size_t>(meshes));

  // Of the folders beside the scan only what fits its images, and a lone CT asks nothing.
  EXPECT_EQ(presenters::lookAt(visit / "ct", {}).content, Content::Ct);
  EXPECT_TRUE(presenters::lookAt(visit / "ct", {}).series.empty());
  const auto scan = imaging::scanDicom(visit / "ct", {});
  bool hasFolder = false;
  for (const presenters::PartFiles& files : presenters::partFilesOf(visit / "ct", scan, {}))
  {
    EXPECT_FALSE(files.isBelow);
    EXPECT_NE(files.paths.front().filename(), "other.nrrd");
    hasFolder = hasFolder || files.paths.front().filename() == "labels";
  }
  EXPECT_TRUE(hasFolder);
  // An MR or labels were asked for: nothing else is offered.
  for (const auto& one : presenters::lookAt(visit, {}, Content::Mr).series)
    EXPECT_TRUE(one.files.empty());
}

TEST_F(SourceContent, ARelativeFolderIsLookedAtLikeAnAbsoluteOne)
{
  namespace fs = std::filesystem;
  const fs::path visit = m_folder / "visit";
  phantom::SampleOptions options;
  options.spacing = 1.5;
  petrous::testing::writeSharedSample(visit, options);
  const auto foldersIn = [](const fs::path& path)
  {
    std::vector<std::string> folders;
    for (const presenters::SeriesContent& one : presenters::lookAt(path, {}).series)
      folders.push_back(one.folder);
    return folders;
  };
  const std::vector<std::string> folders = foldersIn(visit);
  ASSERT_GT(folders.size(), 2U);
  struct WorkingFolder
  {
    fs::path before = fs::current_path();
    ~WorkingFolder()
    {
      std::error_code error;
      fs::current_path(before, error);
    }
  } const restored;
  fs::current_path(m_folder);
  EXPECT_EQ(foldersIn("visit"), folders);
  fs::current_path(visit);
  EXPECT_EQ(foldersIn(".").size(), folders.size());
  fs::create_directory(m_folder / "gone");
  fs::current_path(m_folder / "gone");
  fs::remove(m_folder / "gone");
  EXPECT_EQ(foldersIn(visit), folders);
}

// The preview leaves undeclared bits out before anybody is asked about them.
TEST_F(SourceContent, APreviewOfARepairClaimsNoAnswer)
{
  imaging::test::writeSeries(m_folder / "gap", 24,
                             [](int k, imaging::test::TestSlice& slice)
                             {
                               slice.z = 0.5 * (k < 12 ? k : k + 1); // one slice is missing
                               slice.bitsStored = 12;
                               slice.isSigned = false;
                               slice.cell = [](int i, int j)
                               { return i == 3 || j == 3 ? 0x1064U : 40U; };
                             });
  const auto preview = presenters::previewRepair(m_folder / "gap", {}, {});
  std::string notes;
  for (const std::string& note : preview.notes)
    notes += note + "\n";
  EXPECT_NE(notes.find("left out, as DICOM says"), std::string::npos) << notes;
  EXPECT_EQ(notes.find("as asked"), std::string::npos) << notes;
}

TEST(SequenceName, KeepsOnlyWhatNamesASequence)
{
  using presenters::sequenceName;
  EXPECT_EQ(sequenceName("T2_CISS_3D tra IAC Doe^John 1962"), "T2 CISS 3D tra IAC");
  EXPECT_EQ(sequenceName("DOE JOHN"), "");
  EXPECT_EQ(sequenceName("ep2d_diff b1000 Mueller"), "b1000");
  EXPECT_EQ(sequenceName("DWI b 1000"), "DWI b 1000");
  EXPECT_EQ(sequenceName("T1 echo 2"), "T1 echo 2");
  EXPECT_EQ(sequenceName("T2 B. Smith"), "T2") << "an initial";
  EXPECT_EQ(sequenceName("phase Jones"), "");
  EXPECT_EQ(sequenceName("19620131"), "");
}

namespace
{

// The sample's CT without its slice `missing`, counted along the stack.
std::filesystem::path withoutSlice(const std::filesystem::path& folder, std::size_t missing)
{
  phantom::SampleOptions options;
  options.spacing = 1.5;
  petrous::testing::writeSharedSample(folder, options);
  const auto scan = imaging::scanDicom(folder / "ct", {});
  std::filesystem::remove(scan.series.at(0).geometry.slices.at(missing).file);
  return folder / "ct";
}

} // namespace

TEST_F(SourceContent, WhatRepairInterpolatedIsKnownFromTheCase)
{
  const auto ct = withoutSlice(m_folder, 11);
  presenters::CaseSources sources;
  sources.ct = ct;
  sources.repair = true;
  auto value = presenters::buildCase("ear", sources, {});
  EXPECT_EQ(value.ct.provenance.interpolated, (std::vector<volume::SliceRange>{{11, 11}}));
  const auto found = presenters::lookAt(ct, {});
  EXPECT_FALSE(found.repair.empty());
  EXPECT_TRUE(std::any_of(found.repair.begin(), found.repair.end(),
                          [](const imaging::Finding& one)
                          { return one.kind == imaging::FindingKind::MissingSlice; }));
  // In a region the slices are counted anew.
  const Vector3d from = value.ct.geometry.patientFromVoxel(Vector3d(2, 2, 5));
  const Vector3d to = value.ct.geometry.patientFromVoxel(Vector3d(20, 20, 15));
  core::PatientBox box;
  box.extend(from);
  box.extend(to);
  sources.roi = box;
  value = presenters::buildCase("ear", sources, {});
  EXPECT_EQ(value.ct.provenance.interpolated, (std::vector<volume::SliceRange>{{6, 6}}));
}

TEST_F(SourceContent, ThePreviewOfARegionCountsWhatWouldBeRead)
{
  phantom::SampleOptions options;
  options.spacing = 0.3; // more slices than a preview takes
  options.dims = {24, 24, 300};
  petrous::testing::writeSharedSample(m_folder, options);
  const auto preview = presenters::previewScan(m_folder / "ct", {}, false, {});
  presenters::CaseSources sources;
  sources.ct = m_folder / "ct";
  const auto whole = presenters::buildCase("ear", sources, {});
  EXPECT_TRUE(core::sameGrid(preview.grid, whole.ct.geometry));
  EXPECT_LT(preview.value.ct.geometry.dims()[2], 160);
  EXPECT_EQ(preview.voxelsIn(preview.grid.patientBounds()), whole.ct.geometry.voxelCount());
  core::PatientBox box(preview.grid.center() - Vector3d(1.9, 2.3, 11.0),
                       preview.grid.center() + Vector3d(2.6, 1.1, 20.0));
  sources.roi = box;
  const auto part = presenters::buildCase("ear", sources, {});
  EXPECT_EQ(preview.voxelsIn(box), part.ct.geometry.voxelCount());
  EXPECT_EQ(preview.bytesPerVoxel * part.ct.geometry.voxelCount(), part.ct.volume.get()->bytes());
}

// Before, the tilted stack is sheared: seen from the side a landmark is elsewhere than after.
TEST_F(SourceContent, ThePreviewOfARepairShowsTheSlicesAsTheyLieAndAsTheyBelong)
{
  phantom::SampleOptions options;
  options.spacing = 1.5;
  options.tilt = 15.0;
  petrous::testing::writeSharedSample(m_folder, options);
  const auto preview = presenters::previewRepair(m_folder / "ct", {}, {});
  EXPECT_EQ(preview.orientation, presenters::SliceOrientation::Sagittal) << "where the tilt shows";
  presenters::CaseSources sources;
  sources.ct = m_folder / "ct";
  sources.repair = true;
  const auto truth = presenters::buildCase("ear", sources, {});
  const auto& after = preview.after.value.ct;
  const auto& before = preview.before.value.ct;
  const auto& image = *truth.ct.volume.get();
  double most = 0.0;
  double sheared = 0.0;
  const Vector3d middle = after.geometry.center();
  for (double y = -20.0; y <= 20.0; y += 1.0)
    for (double z = -20.0; z <= 20.0; z += 1.0)
    {
      const Vector3d at = middle + Vector3d(0.0, y, z);
      const auto value = [&at](const scene::ImagePart& part, const volume::IntensityVolume& from)
      { return from.sample(part.geometry.voxelFromPatient(at)); };
      if (!truth.ct.geometry.hullContains(truth.ct.geometry.voxelFromPatient(at)) ||
          !before.geometry.hullContains(before.geometry.voxelFromPatient(at)) ||
          !after.geometry.hullContains(after.geometry.voxelFromPatient(at)))
        continue;
      const double right = value(truth.ct, image);
      most = std::max(most, std::abs(value(after, *after.volume.get()) - right));
      sheared = std::max(sheared, std::abs(value(before, *before.volume.get()) - right));
    }
  EXPECT_LT(most, 1e-6);
  EXPECT_GT(sheared, 300.0);
  EXPECT_TRUE(std::any_of(preview.notes.begin(), preview.notes.end(),
                          [](const std::string& note)
                          { return note.find("15.0 degrees") != std::string::npos; }));
}
