#include <algorithm>
#include <fstream>

#include <gtest/gtest.h>

#include <unistd.h>

#include "petrous/Imaging/DicomWriter.h"
#include "petrous/Imaging/LabelFile.h"
#include "petrous/Imaging/MeshFile.h"
#include "petrous/Imaging/VolumeFile.h"
#include "petrous/Presenters/CaseBuilder.h"
#include "petrous/Scene/Manifest.h"
#include "petrous/Scene/Placement.h"

using namespace petrous;
using Eigen::Vector3d;
using presenters::PartSource;

namespace
{

class CaseBuilder : public ::testing::Test
{
protected:
  void SetUp() override
  {
    m_folder =
        std::filesystem::temp_directory_path() / ("petrous-builder-" + std::to_string(::getpid()));
    std::filesystem::create_directories(m_folder);
    const core::GridGeometry grid({16, 12, 10}, Vector3d::Ones(), Vector3d(-8, 2, 3));
    auto ct = std::make_shared<volume::Volume<std::int16_t>>(grid, std::int16_t{-1000});
    ct->at(7, 6, 5) = 1200;
    imaging::writeVolume(m_folder / "ct.nrrd", *ct);
    auto labels = std::make_shared<volume::Volume<std::uint16_t>>(grid, std::uint16_t{0});
    labels->at(4, 4, 4) = 1;
    imaging::writeLabelFile(m_folder / "facial_nerve.nii.gz",
                            volume::makeLabelMap(std::move(labels), {}));
    core::TriangleMesh mesh;
    mesh.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    mesh.triangles = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
    imaging::writeMesh(m_folder / "incus.obj", mesh);
    m_sources.ct = m_folder / "ct.nrrd";
  }
  void TearDown() override { std::filesystem::remove_all(m_folder); }

  std::filesystem::path m_folder;
  presenters::CaseSources m_sources;
};

} // namespace

TEST(PartSource, SplitsTheNameFromTheFile)
{
  EXPECT_EQ(PartSource::parse("nerve=/a/b=c.nrrd").name, "nerve");
  EXPECT_EQ(PartSource::parse("nerve=/a/b=c.nrrd").path, "/a/b=c.nrrd");
  EXPECT_EQ(PartSource::parse("/a/b.nrrd").name, "");
  EXPECT_EQ(PartSource::parse("=x").path, "=x");
}

TEST_F(CaseBuilder, SplitsTheMrFromTheFile)
{
  const auto parsed = PartSource::parseDrawn("x=" + (m_folder / "incus.obj").string() + "@T2");
  EXPECT_EQ(parsed.name, "x");
  EXPECT_EQ(parsed.path, m_folder / "incus.obj");
  EXPECT_EQ(parsed.drawnOn, "T2");
  std::ofstream(m_folder / "odd@T2") << "x";
  EXPECT_EQ(PartSource::parseDrawn((m_folder / "odd@T2").string()).path, m_folder / "odd@T2");
  EXPECT_EQ(PartSource::parseDrawn("@T2").path, "@T2");
  EXPECT_EQ(PartSource::parseDrawn("a@").path, "a@");
}

TEST_F(CaseBuilder, KnowsOnWhichMrLabelsWereDrawn)
{
  const core::GridGeometry grid({9, 9, 9}, Vector3d::Constant(1.5), Vector3d(-30, 20, 10));
  imaging::writeVolume(m_folder / "mr.nrrd", volume::Volume<std::int16_t>(grid, std::int16_t{7}));
  auto voxels = std::make_shared<volume::Volume<std::uint16_t>>(grid, std::uint16_t{0});
  voxels->at(4, 4, 4) = 1;
  imaging::writeLabelFile(m_folder / "tumour.nii.gz", volume::makeLabelMap(voxels, {}));
  const auto mr = [this](const std::string& name) {
    return PartSource{name, m_folder / "mr.nrrd"};
  };
  const auto labels = [this](const std::string& name, const std::string& on) {
    return PartSource{name, m_folder / "tumour.nii.gz", on};
  };
  m_sources.parts.labels = {labels("a", ""), {"nerve", m_folder / "facial_nerve.nii.gz"}};
  auto value = presenters::buildCase("ear", m_sources, {});
  EXPECT_FALSE(value.labels[0].drawnOn) << "on a grid that nothing of the case has";
  EXPECT_EQ(value.labels[1].drawnOn, "");
  EXPECT_EQ(scene::missingPlace(value, "a"), "");

  presenters::PartSources more;
  more.mr = {mr("T2")};
  more.labels = {labels("b", ""), labels("c", "ct")};
  presenters::addParts(value, more, {});
  EXPECT_EQ(scene::placementOf(value, value.labels[0]).drawnOn, "T2") << "its image came later";
  EXPECT_EQ(value.labels[2].drawnOn, "T2");
  EXPECT_EQ(value.labels[3].drawnOn, "");

  presenters::PartSources second;
  second.mr = {mr("DWI")};
  presenters::addParts(value, second, {});
  EXPECT_EQ(scene::placementOf(value, value.labels[0]).drawnOn, "T2") << "decided before";
  presenters::PartSources ambiguous;
  ambiguous.labels = {labels("d", "")};
  const auto before = value.labels.size();
  try
  {
    presenters::addParts(value, ambiguous, {});
    FAIL() << "guessed";
  }
  catch (const core::InvalidParameter& error)
  {
    const std::string words = error.what();
    EXPECT_NE(words.find("tumour.nii.gz"), std::string::npos) << words;
    EXPECT_NE(words.find("FILE@T2 or FILE@DWI"), std::string::npos) << words;
  }
  EXPECT_EQ(value.labels.size(), before);
  ambiguous.labels = {labels("d", "DWI")};
  ambiguous.meshes = {{"", m_folder / "incus.obj", "T2"}};
  presenters::addParts(value, ambiguous, {});
  EXPECT_EQ(value.labels.back().drawnOn, "DWI");
  EXPECT_EQ(value.meshes[0].drawnOn, "T2");
  ambiguous.labels = {labels("e", "T1")};
  ambiguous.meshes.clear();
  EXPECT_THROW(presenters::addParts(value, ambiguous, {}), core::InvalidParameter);
  ambiguous.labels.clear();
  ambiguous.meshes = {{"other", m_folder / "incus.obj", "T1"}};
  EXPECT_THROW(presenters::addParts(value, ambiguous, {}), core::InvalidParameter);
}

TEST_F(CaseBuilder, PutsACaseTogether)
{
  m_sources.parts.labels = {{"", m_folder / "facial_nerve.nii.gz"}};
  m_sources.parts.meshes = {{"", m_folder / "incus.obj"}};
  m_sources.parts.mr = {{"t2", m_folder / "ct.nrrd"}};
  const auto value = presenters::buildCase("ear", m_sources, {});
  EXPECT_EQ(value.ct.range.max, 1200.0);
  EXPECT_EQ(value.labels.at(0).structures.at(0).name, "facial_nerve");
  EXPECT_EQ(value.labels.at(0).structures.at(0).look.preset, "nerve");
  EXPECT_EQ(value.meshes.at(0).name, "incus");
  EXPECT_EQ(value.mr.at(0).name, "t2");
  EXPECT_FALSE(value.mr.at(0).registered);
}

TEST_F(CaseBuilder, PutsTheSurfaceWhereBoneIsInUnitsOfItsOwn)
{
  // A dry bone of 16 bits without calibration: a ball of 42000 in air of 8000.
  const core::GridGeometry grid({40, 40, 40}, Vector3d::Constant(0.05), Vector3d::Zero());
  auto scan = std::make_shared<volume::Volume<std::uint16_t>>(grid, std::uint16_t{8000});
  for (int k = 0; k < 40; ++k)
    for (int j = 0; j < 40; ++j)
      for (int i = 0; i < 40; ++i)
        if (Vector3d(i - 20, j - 20, k - 20).norm() < 12.0)
          scan->at(i, j, k) = 42000;
  imaging::writeVolume(m_folder / "specimen.nrrd", *scan);
  m_sources.ct = m_folder / "specimen.nrrd";
  const auto value = presenters::buildCase("specimen", m_sources, {});
  EXPECT_NEAR(value.iso, 25000.0, 0.03 * 34000.0);
  ASSERT_FALSE(value.ct.notes.empty());
  EXPECT_NE(value.ct.notes.back().find("not Hounsfield units"), std::string::npos);

  m_sources.ct = m_folder / "ct.nrrd";
  const auto calibrated = presenters::buildCase("ear", m_sources, {});
  EXPECT_EQ(calibrated.iso, 300.0);
  for (const std::string& note : calibrated.ct.notes)
    EXPECT_EQ(note.find("Hounsfield"), std::string::npos);
}

TEST_F(CaseBuilder, TellsImagesOfOneFrameOfReferenceWithoutItsUid)
{
  const auto scan = std::make_shared<const volume::Volume<std::int16_t>>(
      core::GridGeometry({8, 8, 8}, Vector3d::Ones(), Vector3d::Zero()), std::int16_t{40});
  const auto write = [&](const std::string& name, const std::string& frame)
  {
    imaging::SeriesDescription series;
    series.modality = imaging::SeriesDescription::Modality::Mr;
    series.studyUid = "1.2.3";
    series.seriesUid = imaging::deterministicUid(1, name);
    series.frameOfReferenceUid = frame;
    imaging::writeDicomSeries(m_folder / name, volume::IntensityVolume(scan), series);
    m_sources.parts.mr.push_back({name, m_folder / name});
  };
  const std::string uid = "1.2.840.99.7.2026";
  write("T2", uid);
  write("DWI", uid);
  write("T1", "1.2.840.99.8");
  const auto value = presenters::buildCase("ear", m_sources, {});
  EXPECT_EQ(value.mr[0].frameOfReference.size(), 64u);
  EXPECT_EQ(value.mr[0].frameOfReference, value.mr[1].frameOfReference);
  EXPECT_NE(value.mr[0].frameOfReference, value.mr[2].frameOfReference);
  EXPECT_EQ(scene::toManifest(value).find(uid), std::string::npos);
  EXPECT_EQ(value.ct.frameOfReference, "") << "of a NRRD file nothing is known";
}

TEST_F(CaseBuilder, CropsToTheRegionAsked)
{
  m_sources.roi = {Vector3d(-2, 6, 6), Vector3d(2, 10, 10)};
  const auto value = presenters::buildCase("ear", m_sources, {});
  EXPECT_EQ(value.ct.geometry.dims(), (core::Index3{5, 5, 5}));
  EXPECT_EQ(value.ct.geometry.origin(), Vector3d(-2, 6, 6));
  EXPECT_EQ(value.ct.range.max, 1200.0);
}

TEST_F(CaseBuilder, RefusesAStructureTwiceAndLeavesTheCase)
{
  m_sources.parts.labels = {{"", m_folder / "facial_nerve.nii.gz"}};
  auto value = presenters::buildCase("ear", m_sources, {});
  presenters::PartSources more;
  more.labels = {{"second", m_folder / "facial_nerve.nii.gz"},
                 {"", m_folder / "facial_nerve.nii.gz"}};
  EXPECT_THROW(presenters::addParts(value, more, {}), core::InvalidParameter);
  EXPECT_EQ(value.labels.size(), 1u);
}

TEST_F(CaseBuilder, NamesTheFileThatIsNotThere)
{
  m_sources.ct = m_folder / "missing.nrrd";
  try
  {
    presenters::buildCase("ear", m_sources, {});
    FAIL();
  }
  catch (const core::Error& error)
  {
    EXPECT_NE(std::string(error.what()).find("missing.nrrd"), std::string::npos);
    EXPECT_EQ(error.fault(), core::Fault::BadInput);
  }
}

// A label file without names, as most segmentation programs export it.
TEST_F(CaseBuilder, StructuresWithoutANameDifferInColour)
{
  const core::GridGeometry grid({16, 12, 10}, Vector3d::Ones(), Vector3d(-8, 2, 3));
  auto labels = std::make_shared<volume::Volume<std::uint16_t>>(grid, std::uint16_t{0});
  constexpr int count = 60;
  for (int n = 0; n < count; ++n)
    labels->at(n % 16, n / 16, 5) = static_cast<std::uint16_t>(n + 1);
  imaging::writeLabelFile(m_folder / "many.nii.gz", volume::makeLabelMap(std::move(labels), {}));
  std::filesystem::copy(m_folder / "incus.obj", m_folder / "piece.obj");
  m_sources.parts.labels = {{"", m_folder / "many.nii.gz"}};
  m_sources.parts.meshes = {{"", m_folder / "piece.obj"}};
  const auto colors = [this]
  {
    const scene::Case value = presenters::buildCase("x", m_sources, {});
    std::vector<std::array<float, 3>> found{value.meshes.front().look.color};
    for (const auto& structure : value.labels.front().structures)
      found.push_back(structure.look.color);
    return found;
  };
  auto found = colors();
  EXPECT_EQ(found, colors());
  ASSERT_EQ(found.size(), static_cast<std::size_t>(count + 1));
  std::sort(found.begin(), found.end());
  EXPECT_EQ(std::adjacent_find(found.begin(), found.end()), found.end());
}
