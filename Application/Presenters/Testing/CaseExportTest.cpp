#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <unistd.h>

#include "../../../Modules/Volume/Testing/SyntheticHead.h"
#include "BoneCase.h"
#include "petrous/Imaging/DicomReader.h"
#include "petrous/Imaging/DicomScan.h"
#include "petrous/Imaging/ImageFile.h"
#include "petrous/Imaging/LabelFile.h"
#include "petrous/Imaging/MeshFile.h"
#include "petrous/Presenters/CaseExport.h"
#include "petrous/Presenters/LeavingImages.h"

using namespace petrous;
using namespace petrous::presenters;
using Eigen::Vector3d;

namespace
{

/// Voxels and their mean position, patient LPS mm.
struct Extent
{
  std::uint64_t voxels = 0;
  Vector3d sum = Vector3d::Zero();

  Vector3d center() const { return sum / static_cast<double>(voxels); }
};

class CaseExport : public ::testing::Test
{
protected:
  void SetUp() override
  {
    m_folder =
        std::filesystem::temp_directory_path() / ("petrous-export-" + std::to_string(::getpid()));
    std::filesystem::create_directories(m_folder);
    m_case = presenters::testing::block();
  }
  void TearDown() override { std::filesystem::remove_all(m_folder); }

  // Every voxel of `grid` in `box` whose indices pass a fixed pattern.
  void add(const std::string& name, const core::GridGeometry& grid, const core::IndexBox& box)
  {
    auto voxels = volume::makeZeroVolume<std::uint16_t>(grid);
    for (int k = box.lower[2]; k < box.upper[2]; ++k)
      for (int j = box.lower[1]; j < box.upper[1]; ++j)
        for (int i = box.lower[0]; i < box.upper[0]; ++i)
          if ((i + 2 * j + 3 * k) % 5 != 0)
          {
            voxels->at(i, j, k) = 1;
            ++m_truth[name].voxels;
            m_truth[name].sum += grid.patientFromVoxel(Vector3d(i, j, k));
          }
    volume::Segment segment;
    segment.name = name;
    segment.index = 1;
    scene::StructurePart structure;
    structure.name = name;
    structure.index = 1;
    structure.voxels = m_truth[name].voxels;
    scene::LabelPart part;
    part.structures.push_back(structure);
    part.drawnOn = "";
    part.labels = std::make_shared<const volume::LabelMap>(
        volume::makeLabelMap(std::move(voxels), {segment}));
    m_case.labels.push_back(std::move(part));
  }

  // The grid of the CT's voxels in `box`; `order` and `sense` of its axes.
  core::GridGeometry partOfCt(const core::IndexBox& box, const core::Index3& order = {0, 1, 2},
                              const core::Index3& sense = {1, 1, 1}) const
  {
    const core::GridGeometry& ct = m_case.ct.geometry;
    core::Index3 dims;
    Vector3d spacing, first;
    Eigen::Matrix3d direction;
    for (std::size_t a = 0; a < 3; ++a)
    {
      const std::size_t of = static_cast<std::size_t>(order[a]);
      const auto axis = static_cast<Eigen::Index>(of);
      const auto to = static_cast<Eigen::Index>(a);
      dims[a] = box.size()[of];
      spacing[to] = ct.spacing()[axis];
      direction.col(to) = sense[a] * ct.direction().col(axis);
      first[axis] = sense[a] > 0 ? box.lower[of] : box.upper[of] - 1;
    }
    return {dims, spacing, ct.patientFromVoxel(first), direction};
  }

  ExportSummary write(const std::string& file, bool onCt = false)
  {
    ExportOptions options;
    options.what = "labels";
    options.out = (m_folder / file).string();
    options.onCt = onCt;
    m_warnings.clear();
    return exportCase(m_library, m_case, options, {},
                      [this](const std::string& line) { m_warnings += line + '\n'; }, {});
  }

  std::map<std::string, Extent> read(const std::string& file, core::GridGeometry& grid) const
  {
    std::map<std::string, Extent> found;
    for (const auto& map : imaging::loadLabels(m_folder / file).maps)
    {
      grid = map.voxels->geometry();
      const core::Index3& n = grid.dims();
      for (const auto& segment : map.segments)
        for (int k = 0; k < n[2]; ++k)
          for (int j = 0; j < n[1]; ++j)
            for (int i = 0; i < n[0]; ++i)
              if (map.voxels->at(i, j, k) == segment.index)
              {
                ++found[segment.name].voxels;
                found[segment.name].sum += grid.patientFromVoxel(Vector3d(i, j, k));
              }
    }
    return found;
  }

  void expectAll(const std::string& file)
  {
    SCOPED_TRACE(file);
    core::GridGeometry grid;
    const auto found = read(file, grid);
    ASSERT_EQ(found.size(), m_truth.size());
    for (const auto& one : m_truth)
    {
      SCOPED_TRACE(one.first);
      ASSERT_TRUE(found.count(one.first));
      EXPECT_EQ(found.at(one.first).voxels, one.second.voxels);
      EXPECT_LT((found.at(one.first).center() - one.second.center()).norm(), 0.005);
    }
  }

  std::filesystem::path m_folder;
  library::Library m_library{std::filesystem::temp_directory_path() / "petrous-export-nothing"};
  scene::Case m_case;
  std::map<std::string, Extent> m_truth;
  /// But for the one on the name of the case, of whose patient nothing is known here.
  std::string otherWarnings() const
  {
    std::string others;
    std::istringstream lines(m_warnings);
    for (std::string line; std::getline(lines, line);)
      if (line.rfind("the name of the case is not the patient's", 0) != 0)
        others += line + '\n';
    return others;
  }

  std::string m_warnings;
};

constexpr const char* kFiles[] = {"all.dcm", "all.seg.nrrd", "all.nrrd", "all.nii.gz"};

} // namespace

// A segmentation with the slices that have a structure, one counted downwards with other axes
// first, and structures made on the CT: all on its lattice, so no voxel is lost or moved.
/// An element of a file as PS3.5 7.1.2 encodes it: explicit VR of short length, little endian.
std::string element(int group, int number, const std::string& vr, std::string text)
{
  text += std::string(text.size() % 2, ' ');
  std::string bytes;
  for (const int value : {group, number})
    bytes += {static_cast<char>(value & 0xff), static_cast<char>(value >> 8)};
  return bytes + vr + static_cast<char>(text.size()) + '\0' + text;
}

// As an archive does with one whose face cannot be masked.
TEST(LeavingImages, AnMrIsLeftOutUnlessStructuresWereDrawnOnIt)
{
  scene::Case value;
  for (const char* name : {"T1", "T2"})
  {
    value.mr.emplace_back();
    value.mr.back().name = name;
  }
  value.meshes.emplace_back();
  value.meshes.back().name = "tumour";
  value.meshes.back().drawnOn = "T1";
  leaveOutMrs(value, {"T2"});
  ASSERT_EQ(value.mr.size(), 1U);
  EXPECT_EQ(value.mr[0].name, "T1");
  EXPECT_THROW(leaveOutMrs(value, {"T1"}), core::Error);
  EXPECT_THROW(leaveOutMrs(value, {"tumour"}), core::InvalidParameter);
  EXPECT_EQ(value.meshes.size(), 1U);
}

// Names are unique, but not in every older case: what leaves must not be the face.
TEST(LeavingImages, NoStructureIsLeftOutInPlaceOfAnMrOfItsName)
{
  scene::Case value;
  value.mr.emplace_back();
  value.mr.back().name = "T2";
  value.labels.emplace_back();
  value.labels.back().structures.emplace_back();
  value.labels.back().structures.back().name = "T2";
  value.meshes.emplace_back();
  value.meshes.back().name = "T2";
  leaveOutMrs(value, {"T2"});
  EXPECT_TRUE(value.mr.empty());
  EXPECT_EQ(value.labels.size(), 1U);
  EXPECT_EQ(value.meshes.size(), 1U);
}

// Whether it is named or the only one; what stays is not looked at.
TEST_F(CaseExport, MasksTheFaceOfTheImageThatIsWritten)
{
  scene::ImagePart mr;
  mr.name = "T2";
  mr.geometry = volume::test::gridOver(volume::test::headBox(), Vector3d::Constant(3.0));
  mr.volume = std::make_shared<const volume::IntensityVolume>(
      volume::test::scanned(volume::test::SyntheticHead(), mr.geometry, true));
  mr.range = mr.volume.get()->range();
  m_case.mr = {mr};
  m_case.dissection = dissection::Dissection(m_case.ct.geometry);
  const auto notesOf = [&](const std::string& what, const std::string& part)
  {
    scene::Case value = m_case;
    ExportOptions options;
    options.what = what;
    options.part = part;
    options.out = (m_folder / (what + part + ".nii.gz")).string();
    options.mask.face = true;
    std::string notes;
    exportCase(m_library, value, options, {},
               [&notes](const std::string& line) { notes += line + '\n'; }, {});
    return notes;
  };
  for (const std::string part : {"", "T2"})
  {
    const std::string notes = notesOf("mr", part);
    EXPECT_NE(notes.find("MR 'T2': the face is masked"), std::string::npos) << notes;
    EXPECT_EQ(notes.find("the CT: "), std::string::npos) << notes;
  }
  const std::string notes = notesOf("ct", "");
  EXPECT_NE(notes.find("the CT: "), std::string::npos) << notes;
  EXPECT_EQ(notes.find("T2"), std::string::npos) << notes;
}

TEST_F(CaseExport, DicomStatesWhatIsKnownToBeWrongWithTheImage)
{
  const auto written = [this](const std::string& name)
  {
    ExportOptions options;
    options.what = "ct";
    options.out = (m_folder / name).string() + "/";
    m_warnings.clear();
    exportCase(m_library, m_case, options, {},
               [this](const std::string& line) { m_warnings += line + '\n'; }, {});
    std::ifstream file(m_folder / name / "slice-0001.dcm", std::ios::binary);
    return std::string(std::istreambuf_iterator<char>(file), {});
  };
  const std::string removed = element(0x0012, 0x0062, "CS", "YES");
  const std::string text = element(0x0028, 0x0301, "CS", "YES");
  const std::string loss = element(0x0028, 0x2110, "CS", "01");
  const std::string clean = written("clean");
  EXPECT_NE(clean.find(removed), std::string::npos);
  EXPECT_EQ(clean.find(element(0x0028, 0x0301, "CS", "").substr(0, 6)), std::string::npos);
  EXPECT_EQ(clean.find(element(0x0028, 0x2110, "CS", "").substr(0, 6)), std::string::npos);
  EXPECT_EQ(otherWarnings(), "");

  volume::ImageProvenance& provenance = m_case.ct.provenance;
  for (const auto kind : {imaging::BurnedInText::Stated, imaging::BurnedInText::Suspected})
  {
    provenance.pixels.burnedIn = kind;
    const std::string file = written(kind == imaging::BurnedInText::Stated ? "text" : "suspect");
    EXPECT_NE(file.find(text), std::string::npos);
    EXPECT_EQ(file.find(removed), std::string::npos);
  }
  provenance.pixels = {imaging::BurnedInText::None, true, 12.5};
  provenance.interpolated = {{2, 2}, {6, 8}};
  const std::string file = written("lossy");
  EXPECT_NE(file.find(removed), std::string::npos);
  EXPECT_NE(file.find(loss), std::string::npos);
  EXPECT_NE(file.find(element(0x0028, 0x2112, "DS", "12.5")), std::string::npos);
  const std::string slices = "slices 3, 7-9";
  EXPECT_NE(file.find("Repaired: " + slices + " of 40 interpolated"), std::string::npos);
  EXPECT_NE(m_warnings.find(slices + " interpolated"), std::string::npos) << m_warnings;
}

TEST_F(CaseExport, StatesHounsfieldUnitsOfACtThatIsInThese)
{
  scene::ImagePart mr = m_case.ct;
  mr.name = "T2";
  m_case.mr = {mr};
  const auto isStated = [this](const std::string& what, const std::string& name)
  {
    scene::Case value = m_case;
    ExportOptions options;
    options.what = what;
    options.out = (m_folder / name).string();
    exportCase(m_library, value, options, {}, [](const std::string&) {}, {});
    return imaging::readImageFile(options.out).isHounsfield;
  };
  for (const char* name : {"a.nrrd", "a.nii.gz", "a.mha"})
  {
    EXPECT_TRUE(isStated("ct", name)) << name;
    EXPECT_FALSE(isStated("mr", name)) << name;
  }
  m_case.denseBone = 1500.0; // of a cone beam
  EXPECT_FALSE(isStated("ct", "a.nrrd"));
}

TEST_F(CaseExport, PaddingThatNoVoxelHasNeedsNoRoom)
{
  auto voxels = std::make_shared<volume::Volume<float>>(m_case.ct.geometry);
  for (std::size_t v = 0; v < voxels->size(); ++v)
    voxels->data()[v] = 0.5F * static_cast<float>(v % 1000);
  const auto write = [&](const std::string& name)
  {
    m_case.ct.volume = std::make_shared<const volume::IntensityVolume>(
        std::shared_ptr<const volume::Volume<float>>(voxels), -2000.0);
    ExportOptions options;
    options.what = "ct";
    options.out = (m_folder / name).string() + "/";
    exportCase(m_library, m_case, options, {}, [](const std::string&) {}, {});
    const auto scan = imaging::scanDicom(m_folder / name, {});
    return imaging::readSeries(scan.series.at(0), {}, {});
  };
  const volume::IntensityVolume without = write("without");
  EXPECT_FALSE(without.padding());
  EXPECT_EQ(without.at(1, 0, 0), 0.5);
  voxels->data()[0] = -2000.0F;
  const volume::IntensityVolume with = write("with");
  EXPECT_EQ(with.padding(), -2000.0);
  EXPECT_EQ(with.at(0, 0, 0), -2000.0);
  EXPECT_EQ(with.at(1, 0, 0), 0.5);
}

TEST_F(CaseExport, BringsLabelsOnPartsOfTheCtsGridOntoIt)
{
  add("sinus", m_case.ct.geometry, {{1, 1, 1}, {9, 9, 9}});
  add("nerve", partOfCt({{0, 0, 10}, {40, 40, 24}}), {{20, 3, 0}, {32, 9, 14}});
  add("cochlea", partOfCt({{20, 12, 5}, {35, 30, 21}}, {2, 0, 1}, {-1, 1, -1}),
      {{0, 0, 0}, {12, 9, 6}});
  for (const std::string file : kFiles)
  {
    write(file);
    EXPECT_EQ(otherWarnings(), "") << file;
    expectAll(file);
    core::GridGeometry grid;
    read(file, grid);
    if (file != "all.dcm") // it has the slices with a structure
    {
      EXPECT_TRUE(core::sameGrid(grid, m_case.ct.geometry)) << file;
    }
  }
}

TEST_F(CaseExport, WritesLabelsOfOneLatticeThatReachBeyondTheCtOnTheSmallestCommonGrid)
{
  core::GridGeometry ct = m_case.ct.geometry;
  const core::GridGeometry above({40, 40, 8}, ct.spacing(),
                                 ct.patientFromVoxel(Vector3d(0, 0, 36)));
  add("inside", partOfCt({{0, 0, 30}, {40, 40, 38}}), {{3, 3, 0}, {20, 9, 8}});
  add("beyond", above, {{20, 20, 1}, {30, 24, 8}});
  for (const std::string file : kFiles)
  {
    write(file);
    expectAll(file);
    core::GridGeometry grid;
    read(file, grid);
    if (file != "all.dcm")
    {
      EXPECT_EQ(grid.dims(), (core::Index3{40, 40, 14})) << file;
    }
  }
}

TEST_F(CaseExport, NamesLabelsOnAnotherLatticeAndWritesThemOnTheCt)
{
  add("nerve", m_case.ct.geometry, {{1, 1, 1}, {9, 9, 9}});
  add("vein", core::GridGeometry({10, 10, 10}, Vector3d::Constant(0.5), Vector3d(8, 8, 8.1)),
      {{0, 0, 0}, {10, 10, 10}});
  for (const std::string file : kFiles)
    try
    {
      write(file);
      FAIL() << "written on two lattices: " << file;
    }
    catch (const ExportGridError& error)
    {
      const std::string why = error.what();
      for (const char* part : {"'vein'", "'nerve'", "0.5 x 0.5 x 0.5 mm", "--on-ct"})
        EXPECT_NE(why.find(part), why.npos) << why;
      EXPECT_FALSE(std::filesystem::exists(m_folder / file));
    }
  write("on.seg.nrrd", true);
  EXPECT_NE(m_warnings.find("'vein' reaches beyond the CT"), m_warnings.npos) << m_warnings;
  core::GridGeometry grid;
  const auto found = read("on.seg.nrrd", grid);
  EXPECT_TRUE(core::sameGrid(grid, m_case.ct.geometry));
  EXPECT_EQ(found.at("nerve").voxels, m_truth["nerve"].voxels);
  EXPECT_GT(found.at("vein").voxels, 0U);
}

// A thread of a quarter of a voxel: the nearest voxel's centre is beside it.
TEST_F(CaseExport, SaysWhatTheCtsGridLosesOfAStructure)
{
  const core::GridGeometry& ct = m_case.ct.geometry;
  const Vector3d fine = 0.25 * ct.spacing();
  const Vector3d at = ct.patientFromVoxel({10.3, 10.3, 10.3});
  add("facial nerve", core::GridGeometry({2, 2, 40}, fine, at, ct.direction()),
      {{0, 0, 0}, {1, 1, 40}});
  add("block", core::GridGeometry({40, 40, 40}, fine, at, ct.direction()),
      {{0, 0, 0}, {40, 40, 40}});
  const auto done = write("on.seg.nrrd", true);
  EXPECT_NE(m_warnings.find("'facial nerve' has no voxel on the CT's grid"), m_warnings.npos)
      << m_warnings;
  EXPECT_EQ(m_warnings.find("'block'"), m_warnings.npos) << m_warnings;
  ASSERT_EQ(done.resampled.size(), 2U);
  const double voxel = ct.voxelVolume();
  EXPECT_NEAR(done.resampled[0].own, 32.0 * voxel / 64.0, 1e-9 * voxel) << "four of five";
  EXPECT_EQ(done.resampled[0].written, 0.0);
  EXPECT_NEAR(done.resampled[1].written, 800.0 * voxel, 1e-6 * voxel);
}

// One grid of both would fill the memory.
TEST_F(CaseExport, WritesAMeshFacingOutwardsWithItsVolume)
{
  // Tetrahedra of 8/6 and 1/6 mm^3, the smaller one inside out.
  core::TriangleMesh mesh;
  mesh.vertices = {{0, 0, 0}, {2, 0, 0}, {0, 2, 0}, {0, 0, 2},
                   {5, 0, 0}, {6, 0, 0}, {5, 1, 0}, {5, 0, 1}};
  mesh.triangles = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3},
                    {4, 5, 6}, {4, 7, 5}, {4, 6, 7}, {5, 7, 6}};
  scene::MeshPart part;
  part.name = "incus";
  part.triangles = mesh.triangles.size();
  part.mesh = std::make_shared<const core::TriangleMesh>(mesh);
  m_case.meshes.push_back(part);
  ExportOptions options;
  options.what = "structure";
  options.part = "incus";
  options.out = (m_folder / "incus.stl").string();
  const ExportSummary summary =
      exportCase(m_library, m_case, options, {}, [](const std::string&) {}, {});
  EXPECT_TRUE(summary.closed);
  EXPECT_NEAR(summary.volume.value(), 1.5, 1e-5);
  EXPECT_NEAR(imaging::readMesh(options.out).signedVolume(), 1.5, 1e-5);
}

TEST_F(CaseExport, RefusesLabelsThatLieTooFarApartForOneGrid)
{
  add("nerve", m_case.ct.geometry, {{1, 1, 1}, {9, 9, 9}});
  const core::GridGeometry& ct = m_case.ct.geometry;
  add("far", core::GridGeometry({4, 4, 4}, ct.spacing(), ct.patientFromVoxel({9e4, 9e4, 9e4})),
      {{0, 0, 0}, {4, 4, 4}});
  EXPECT_THROW(write("far.seg.nrrd"), ExportGridError);
}
