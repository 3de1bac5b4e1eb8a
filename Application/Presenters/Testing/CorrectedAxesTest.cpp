#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <memory>
#include <string>
#include <tuple>
#include <vector>

#include <gtest/gtest.h>

#include <unistd.h>

#include "petrous/Imaging/DicomWriter.h"
#include "petrous/Imaging/LabelFile.h"
#include "petrous/Imaging/MeshFile.h"
#include "petrous/Imaging/VolumeFile.h"
#include "petrous/Library/Library.h"
#include "petrous/Presenters/CaseBuilder.h"
#include "petrous/Presenters/CorrectedCase.h"
#include "petrous/Presenters/Measuring.h"
#include "petrous/Presenters/ProvenanceText.h"
#include "petrous/Presenters/SlicePlanes.h"
#include "petrous/Presenters/WorkstationModel.h"
#include "petrous/Scene/ApplyRegistration.h"
#include "petrous/Scene/Placement.h"

using namespace petrous;
using core::AxesCorrection;
using Eigen::Vector3d;

namespace
{

// By its file; its centre is -0.5, 7.5, 7.5.
const core::GridGeometry kFileGrid({16, 12, 10}, Vector3d::Ones(), Vector3d(-8, 2, 3));

/// An element of explicit VR little endian; `tag` is group and element.
std::string elementOf(std::uint32_t tag, const char* vr, std::string value)
{
  const bool isSequence = std::string(vr) == "SQ";
  if (value.size() % 2 != 0)
    value += std::string(vr) == "UI" ? '\0' : ' ';
  const auto number = [](std::uint32_t of, int bytes)
  {
    std::string text;
    for (int n = 0; n < bytes; ++n)
      text += static_cast<char>(of >> 8 * n & 0xFF);
    return text;
  };
  const auto size = static_cast<std::uint32_t>(value.size());
  const std::string name = number(tag >> 16, 2) + number(tag & 0xFFFF, 2);
  if (tag == 0xFFFEE000) // an item
    return name + number(size, 4) + value;
  return name + vr + (isSequence ? std::string(2, '\0') + number(size, 4) : number(size, 2)) +
         value;
}

std::string itemOf(const std::string& elements)
{
  return elementOf(0xFFFEE000, "", elements);
}

class CorrectedAxes : public ::testing::Test
{
protected:
  void SetUp() override
  {
    m_folder =
        std::filesystem::temp_directory_path() / ("petrous-axes-" + std::to_string(::getpid()));
    std::filesystem::create_directories(m_folder);
    auto ct = std::make_shared<volume::Volume<std::int16_t>>(kFileGrid, std::int16_t{-1000});
    ct->at(7, 6, 5) = 1200; // by the file at -1, 8, 8
    imaging::writeVolume(m_folder / "ct.nrrd", *ct);
    m_sources.ct = m_folder / "ct.nrrd";
    m_sources.axes = AxesCorrection::parse("RPS");
  }
  void TearDown() override { std::filesystem::remove_all(m_folder); }

  /// One voxel of structure, at 4, 4, 4.
  presenters::PartSource labelsOn(const core::GridGeometry& grid, const std::string& file,
                                  const std::string& drawnOn = {}) const
  {
    auto voxels = volume::makeZeroVolume<std::uint16_t>(grid);
    voxels->at(4, 4, 4) = 1;
    imaging::writeLabelFile(m_folder / file, volume::makeLabelMap(voxels, {}));
    return {"incus", m_folder / file, drawnOn};
  }

  static Vector3d placeOf(const scene::LabelPart& part)
  {
    return part.labels.get()->voxels->geometry().patientFromVoxel({4, 4, 4});
  }

  /// A DICOM CT of 8 x 8 x 8 mm from the origin, its frame of reference 1.2.3.
  void writeDicomCt()
  {
    const core::GridGeometry grid({8, 8, 8}, Vector3d::Ones(), Vector3d::Zero());
    auto scan = std::make_shared<volume::Volume<std::int16_t>>(grid, std::int16_t{40});
    scan->at(2, 2, 1) = 1200;
    imaging::SeriesDescription series;
    series.modality = imaging::SeriesDescription::Modality::Ct;
    series.studyUid = "1.2.4";
    series.seriesUid = "1.2.5";
    series.frameOfReferenceUid = "1.2.3";
    imaging::writeDicomSeries(
        m_folder / "ct",
        volume::IntensityVolume(std::shared_ptr<const volume::Volume<std::int16_t>>(scan)), series);
    m_sources.ct = m_folder / "ct";
  }

  /// One voxel at 1, 2, 1 of a part of that CT: of a grid of its own.
  presenters::PartSource segmentationIn(const std::string& frame, const std::string& file,
                                        const std::string& drawnOn = {}) const
  {
    auto voxels = volume::makeZeroVolume<std::uint16_t>(
        core::GridGeometry({4, 4, 4}, Vector3d::Ones(), Vector3d(1, 1, 1)));
    voxels->at(1, 2, 1) = 1;
    imaging::SegmentationDescription description;
    description.studyUid = "1.2.4";
    description.seriesUid = "1.2.6";
    description.frameOfReferenceUid = frame;
    imaging::SegmentationDescription::Segment segment;
    segment.index = 1;
    segment.label = "incus";
    description.segments = {segment};
    imaging::writeDicomSegmentation(m_folder / file, {volume::makeLabelMap(voxels, {{"incus", 1}})},
                                    description);
    return {"", m_folder / file, drawnOn};
  }

  /// A square of 2 mm in the slice of z = 2, from 0.5 to 2.5 mm in x and y.
  presenters::PartSource structureSetIn(const std::string& frame, const std::string& file,
                                        const std::string& drawnOn = {}) const
  {
    std::string bytes(128, '\0');
    bytes +=
        "DICM" + elementOf(0x00020010, "UI", "1.2.840.10008.1.2.1") +
        elementOf(0x00080016, "UI", "1.2.840.10008.5.1.4.1.1.481.3") +
        elementOf(0x00080018, "UI", "1.2.7") + elementOf(0x00080060, "CS", "RTSTRUCT") +
        elementOf(0x0020000D, "UI", "1.2.4") + elementOf(0x0020000E, "UI", "1.2.8") +
        elementOf(0x30060020, "SQ",
                  itemOf(elementOf(0x30060022, "IS", "1") + elementOf(0x30060024, "UI", frame) +
                         elementOf(0x30060026, "LO", "incus"))) +
        elementOf(0x30060039, "SQ",
                  itemOf(elementOf(0x30060040, "SQ",
                                   itemOf(elementOf(0x30060042, "CS", "CLOSED_PLANAR") +
                                          elementOf(0x30060046, "IS", "4") +
                                          elementOf(0x30060050, "DS",
                                                    "0.5\\0.5\\2\\2.5\\0.5\\2\\2.5\\2.5\\2\\0.5\\2."
                                                    "5\\2"))) +
                         elementOf(0x30060084, "IS", "1")));
    std::ofstream(m_folder / file, std::ios::binary) << bytes;
    return {"", m_folder / file, drawnOn};
  }

  /// The centre of all voxels that are some structure.
  static Vector3d middleOf(const scene::LabelPart& part)
  {
    const auto labels = part.labels.get();
    const auto& voxels = *labels->voxels;
    const core::Index3 dims = voxels.geometry().dims();
    Vector3d sum = Vector3d::Zero();
    int count = 0;
    for (int k = 0; k < dims[2]; ++k)
      for (int j = 0; j < dims[1]; ++j)
        for (int i = 0; i < dims[0]; ++i)
          if (voxels.at(i, j, k) != 0)
          {
            sum += voxels.geometry().patientFromVoxel(Vector3d(i, j, k));
            ++count;
          }
    return count == 0 ? Vector3d(Vector3d::Constant(std::nan(""))) : Vector3d(sum / count);
  }

  /// Two structures of one map: the first, incus as labelsOn, and malleus beside it at 5, 4, 4.
  presenters::PartSource ossicles(const char* first = "incus") const
  {
    auto voxels = volume::makeZeroVolume<std::uint16_t>(kFileGrid);
    voxels->at(4, 4, 4) = 1;
    voxels->at(5, 4, 4) = 2;
    volume::Segment incus, malleus;
    incus.name = first;
    incus.index = 1;
    malleus.name = "malleus";
    malleus.index = 2;
    imaging::writeLabelFile(m_folder / "ossicles.seg.nrrd",
                            volume::makeLabelMap(voxels, {incus, malleus}));
    return {"", m_folder / "ossicles.seg.nrrd"};
  }

  /// A tetrahedron, its right angle at `corner`, its other vertices 1 mm along each axis.
  presenters::PartSource meshNamed(const std::string& name,
                                   const Eigen::Vector3f& corner = {0, 4, 5}) const
  {
    core::TriangleMesh mesh;
    mesh.vertices = {corner};
    for (int axis = 0; axis < 3; ++axis)
      mesh.vertices.push_back(corner + Eigen::Vector3f::Unit(axis));
    mesh.triangles = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
    imaging::writeMesh(m_folder / (name + ".obj"), mesh);
    return {name, m_folder / (name + ".obj")};
  }

  /// A stroke that removed some of a structure.
  static void record(scene::Case& value, const std::string& structure)
  {
    const Vector3d middle = value.ct.geometry.center();
    value.dissection = dissection::Dissection(value.ct.geometry);
    value.dissection.beginStroke({});
    value.dissection.cut({middle, middle, 1.0});
    value.dissection.openInfo().structures = {{structure, 1.0}};
    value.dissection.endStroke();
    ASSERT_FALSE(value.dissection.strokes().empty());
  }

  static void expectRefused(scene::Case value, const std::string& part, const std::string& told)
  {
    const Vector3d before = placeOf(value.labels.at(0));
    try
    {
      presenters::correctPart(value, presenters::axesPart(value, part),
                              AxesCorrection::parse("RPS"));
      ADD_FAILURE() << part << " was corrected";
    }
    catch (const core::Error& error)
    {
      EXPECT_EQ(error.fault(), core::Fault::Refused) << error.what();
      EXPECT_NE(std::string(error.what()).find(told), std::string::npos) << error.what();
    }
    EXPECT_EQ(placeOf(value.labels.at(0)), before);
  }

  static bool isNoted(const std::vector<std::string>& notes, const std::string& part)
  {
    return std::any_of(notes.begin(), notes.end(),
                       [&part](const std::string& note)
                       { return note.find(part) != std::string::npos; });
  }

  std::filesystem::path m_folder;
  presenters::CaseSources m_sources;
};

} // namespace

TEST_F(CorrectedAxes, OfACtMirrorItAboutItsCentre)
{
  const scene::Case value = presenters::buildCase("ear", m_sources, {});
  const core::GridGeometry& grid = value.ct.geometry;
  EXPECT_LT((grid.patientFromVoxel({7, 6, 5}) - Vector3d(0, 8, 8)).norm(), 1e-9);
  EXPECT_LT((grid.center() - kFileGrid.center()).norm(), 1e-9);
  EXPECT_LT(grid.direction().determinant(), 0.0);
  EXPECT_EQ(value.ct.volume.get()->at(7, 6, 5), 1200.0);
  EXPECT_TRUE(core::sameGrid(value.ct.volume.get()->geometry(), grid));
  EXPECT_EQ(value.ct.provenance.axes.letters(), "RPS");
  const std::string said = "what it calls left, back and head is the patient's right, back and "
                           "head";
  EXPECT_TRUE(isNoted(value.ct.notes, said));
  EXPECT_TRUE(isNoted(presenters::provenanceTexts(value.ct), said));
  EXPECT_TRUE(isNoted(presenters::assumedSideTexts(value), "CT: axes of the file corrected (RPS)"));
  EXPECT_NE(presenters::derivationText(value.ct, false).find(said), std::string::npos);
  EXPECT_FALSE(presenters::statesPlace(value.ct)) << "which half it is, is not known";
  m_sources.axes = {};
  EXPECT_TRUE(presenters::statesPlace(presenters::buildCase("ear", m_sources, {}).ct));
  // A permutation: its left is superior, its posterior left, its superior anterior.
  m_sources.axes = AxesCorrection::parse("SLA");
  const scene::Case turned = presenters::buildCase("ear", m_sources, {});
  EXPECT_LT((turned.ct.geometry.patientFromVoxel({7, 6, 5}) - Vector3d(0, 7, 7)).norm(), 1e-9);
}

TEST_F(CorrectedAxes, AreFollowedByLabelsOnTheGridOfTheFile)
{
  m_sources.parts.labels = {labelsOn(kFileGrid, "incus.nrrd")}; // by the file at -4, 6, 7
  const scene::Case value = presenters::buildCase("ear", m_sources, {});
  ASSERT_EQ(value.labels.size(), 1U);
  EXPECT_LT((placeOf(value.labels[0]) - Vector3d(3, 6, 7)).norm(), 1e-9);
  EXPECT_TRUE(core::sameGrid(value.labels[0].labels.get()->voxels->geometry(), value.ct.geometry));
  EXPECT_EQ(value.labels[0].drawnOn, std::string());
  EXPECT_EQ(value.labels[0].provenance.axes.letters(), "RPS");
  EXPECT_NEAR(value.labels[0].structures.at(0).volume, 1.0, 1e-9);
  EXPECT_TRUE(isNoted(value.labels[0].notes, "follows the correction of its axes (RPS)"));
  // Those on the grid as it is, which other programs drew on an export of the case, do not.
  scene::Case later = presenters::buildCase("ear", m_sources, {});
  presenters::PartSources parts;
  parts.labels = {labelsOn(later.ct.geometry, "malleus.nrrd")};
  parts.labels[0].name = "malleus";
  presenters::addParts(later, parts, {});
  ASSERT_EQ(later.labels.size(), 2U);
  EXPECT_LT((placeOf(later.labels[1]) - Vector3d(3, 6, 7)).norm(), 1e-9);
  EXPECT_TRUE(later.labels[1].provenance.axes.isIdentity());
}

TEST_F(CorrectedAxes, AreAskedAboutForLabelsOfAnotherGrid)
{
  scene::Case value = presenters::buildCase("ear", m_sources, {});
  const core::GridGeometry part({8, 8, 8}, Vector3d::Ones(), Vector3d(-6, 3, 3)); // at -2, 7, 7
  presenters::PartSources parts;
  parts.labels = {labelsOn(part, "incus.nrrd")};
  const auto failures = presenters::addSoundParts(value, parts, {});
  ASSERT_EQ(failures.size(), 1U);
  EXPECT_TRUE(failures[0].isFrameUnclear) << failures[0].why;
  EXPECT_NE(failures[0].why.find("--labels-axes LPS"), std::string::npos) << failures[0].why;
  scene::Case followed = value;
  parts.labels[0].drawnOn = "ct";
  presenters::addParts(followed, parts, {});
  EXPECT_LT((placeOf(followed.labels.at(0)) - Vector3d(1, 7, 7)).norm(), 1e-9);
  EXPECT_EQ(followed.labels[0].provenance.axes.letters(), "RPS");
  parts.labels[0].drawnOn = "";
  parts.labels[0].axes = AxesCorrection();
  presenters::addParts(value, parts, {});
  EXPECT_LT((placeOf(value.labels.at(0)) - Vector3d(-2, 7, 7)).norm(), 1e-9);
  EXPECT_TRUE(value.labels[0].provenance.axes.isIdentity());
}

// A label file with wrong axes, of a CT with right ones.
TEST_F(CorrectedAxes, OfLabelsAloneAreTheirOwn)
{
  m_sources.axes = {};
  m_sources.parts.labels = {labelsOn(AxesCorrection::parse("RPS").applied(kFileGrid), "i.nrrd")};
  m_sources.parts.labels[0].axes = AxesCorrection::parse("RPS");
  const scene::Case value = presenters::buildCase("ear", m_sources, {});
  EXPECT_LT((placeOf(value.labels.at(0)) - Vector3d(-4, 6, 7)).norm(), 1e-9);
  EXPECT_EQ(value.labels[0].drawnOn, std::string()) << "it has the CT's grid";
  EXPECT_EQ(value.labels[0].provenance.axes.letters(), "RPS");
}

// Cut out of the file's grid, which turns about -0.5, 7.5, 7.5: each place is computed by hand.
TEST_F(CorrectedAxes, OfLabelsTurnThemAboutTheMiddleOfTheirImage)
{
  const core::GridGeometry part({8, 8, 8}, Vector3d::Ones(), Vector3d(-6, 3, 3));
  m_sources.parts.labels = {labelsOn(part, "incus.nrrd")}; // by the file at -2, 7, 7
  for (const auto& [letters, place] :
       {std::pair("RPS", Vector3d(1, 7, 7)), std::pair("LPI", Vector3d(-2, 7, 8)),
        std::pair("SLA", Vector3d(-1, 8, 6))})
    for (const char* const ofCt : {"LPS", letters})
    {
      m_sources.axes = AxesCorrection::parse(ofCt);
      m_sources.parts.labels[0].axes = AxesCorrection::parse(letters);
      const scene::Case value = presenters::buildCase("ear", m_sources, {});
      EXPECT_LT((placeOf(value.labels.at(0)) - place).norm(), 1e-9)
          << letters << ": " << placeOf(value.labels.at(0)).transpose();
      EXPECT_EQ(value.labels[0].provenance.axes.letters(), letters);
      EXPECT_EQ(value.labels[0].drawnOn, std::string());
    }
  // Of a region of the CT it is the region's: x from -8 to -1, its middle -4.5.
  m_sources.axes = AxesCorrection::parse("RPS");
  m_sources.roi = core::PatientBox(Vector3d(-8, 2, 3), Vector3d(-1, 13, 12));
  m_sources.parts.labels = {labelsOn(kFileGrid, "incus.nrrd")}; // by the file at -4, 6, 7
  m_sources.parts.labels[0].axes = m_sources.axes;
  const scene::Case region = presenters::buildCase("ear", m_sources, {});
  ASSERT_LT((region.ct.geometry.center() - Vector3d(-4.5, 7.5, 7.5)).norm(), 1e-9);
  EXPECT_LT((placeOf(region.labels.at(0)) - Vector3d(-5, 6, 7)).norm(), 1e-9)
      << placeOf(region.labels[0]).transpose();
}

TEST_F(CorrectedAxes, OfAFolderOfMasksLeaveTheDistancesBetweenThem)
{
  std::filesystem::create_directories(m_folder / "masks");
  labelsOn(kFileGrid, "masks/incus.nrrd"); // by the file at -4, 6, 7
  labelsOn(core::GridGeometry({8, 8, 8}, Vector3d::Ones(), Vector3d(-6, 3, 3)),
           "masks/malleus.nrrd"); // at -2, 7, 7
  m_sources.parts.labels = {{"", m_folder / "masks"}};
  m_sources.parts.labels[0].axes = m_sources.axes;
  const scene::Case value = presenters::buildCase("ear", m_sources, {});
  ASSERT_EQ(value.labels.size(), 2U);
  for (const scene::LabelPart& one : value.labels)
  {
    const std::string& name = one.structures.at(0).name;
    const Vector3d place = name == "incus" ? Vector3d(3, 6, 7) : Vector3d(1, 7, 7);
    EXPECT_LT((middleOf(one) - place).norm(), 1e-9) << name << ": " << middleOf(one).transpose();
  }
}

TEST_F(CorrectedAxes, OfLabelsOnAnMrTurnThemAboutItsMiddle)
{
  const core::GridGeometry grid({9, 9, 11}, Vector3d::Constant(1.5), Vector3d(-30, 20, 10));
  imaging::writeVolume(m_folder / "mr.nrrd", volume::Volume<std::int16_t>(grid, std::int16_t{7}));
  m_sources.axes = {};
  m_sources.parts.mr = {{"t2", m_folder / "mr.nrrd"}}; // its centre is -24, 26, 17.5
  const core::GridGeometry part({8, 8, 8}, Vector3d::Ones(), Vector3d(-28, 21, 8));
  for (const core::GridGeometry& drawn : {grid, part}) // at -24, 26, 16 and at -24, 25, 12
    for (const char* const ofMr : {"LPS", "LPI"})
    {
      m_sources.parts.mr[0].axes = AxesCorrection::parse(ofMr);
      m_sources.parts.labels = {labelsOn(drawn, "tumour.nrrd")};
      m_sources.parts.labels[0].axes = AxesCorrection::parse("LPI");
      if (!core::sameGrid(drawn, grid))
        m_sources.parts.labels[0].drawnOn = "t2";
      const scene::Case value = presenters::buildCase("ear", m_sources, {});
      EXPECT_EQ(value.labels.at(0).drawnOn, "t2") << ofMr;
      const Vector3d place =
          core::sameGrid(drawn, grid) ? Vector3d(-24, 26, 19) : Vector3d(-24, 25, 23);
      EXPECT_LT((placeOf(value.labels[0]) - place).norm(), 1e-9)
          << ofMr << ": " << placeOf(value.labels[0]).transpose();
    }
}

TEST_F(CorrectedAxes, OfAnMrAreFollowedByWhatWasDrawnOnIt)
{
  const core::GridGeometry grid({9, 9, 9}, Vector3d::Constant(1.5), Vector3d(-30, 20, 10));
  imaging::writeVolume(m_folder / "mr.nrrd", volume::Volume<std::int16_t>(grid, std::int16_t{7}));
  m_sources.axes = {};
  m_sources.parts.mr = {{"t2", m_folder / "mr.nrrd"}};
  m_sources.parts.mr[0].axes = AxesCorrection::parse("LPI");
  auto voxels = volume::makeZeroVolume<std::uint16_t>(grid);
  voxels->at(1, 2, 0) = 1; // by the file at -28.5, 23, 10; the centre's z is 16
  imaging::writeLabelFile(m_folder / "tumour.nrrd", volume::makeLabelMap(voxels, {}));
  m_sources.parts.labels = {{"tumour", m_folder / "tumour.nrrd"}};
  const scene::Case value = presenters::buildCase("ear", m_sources, {});
  EXPECT_EQ(value.mr.at(0).provenance.axes.letters(), "LPI");
  EXPECT_TRUE(value.ct.provenance.axes.isIdentity());
  EXPECT_EQ(value.labels.at(0).drawnOn, "t2");
  EXPECT_LT((value.labels[0].labels.get()->voxels->geometry().patientFromVoxel({1, 2, 0}) -
             Vector3d(-28.5, 23, 22))
                .norm(),
            1e-9);
  // The labels were there first.
  m_sources.parts.mr.clear();
  scene::Case first = presenters::buildCase("ear", m_sources, {});
  presenters::PartSources parts;
  parts.mr = {{"t2", m_folder / "mr.nrrd"}};
  parts.mr[0].axes = AxesCorrection::parse("LPI");
  presenters::addParts(first, parts, {});
  EXPECT_EQ(first.labels.at(0).drawnOn, "t2");
  EXPECT_LT((middleOf(first.labels[0]) - Vector3d(-28.5, 23, 22)).norm(), 1e-9);
}

// That an MR of their grid comes later moves none.
TEST_F(CorrectedAxes, ThatWereSaidOfLabelsStay)
{
  const core::GridGeometry grid({9, 9, 9}, Vector3d::Constant(1.5), Vector3d(-30, 20, 10));
  imaging::writeVolume(m_folder / "mr.nrrd", volume::Volume<std::int16_t>(grid, std::int16_t{7}));
  m_sources.axes = {};
  m_sources.parts.labels = {labelsOn(grid, "tumour.nrrd")}; // at -24, 26, 16
  m_sources.parts.labels[0].axes = AxesCorrection();
  for (const char* const ofMr : {"LPS", "LPI", "SLA"})
  {
    scene::Case value = presenters::buildCase("ear", m_sources, {});
    presenters::PartSources parts;
    parts.mr = {{"t2", m_folder / "mr.nrrd"}};
    parts.mr[0].axes = AxesCorrection::parse(ofMr);
    presenters::addParts(value, parts, {});
    EXPECT_EQ(value.labels.at(0).drawnOn, std::string()) << ofMr;
    EXPECT_TRUE(core::sameGrid(value.labels[0].labels.get()->voxels->geometry(), grid)) << ofMr;
    EXPECT_TRUE(value.labels[0].provenance.axes.isIdentity()) << ofMr;
  }
}

TEST_F(CorrectedAxes, AreFollowedInTheCtsFrameOfReference)
{
  writeDicomCt();                                                // its centre is 3.5, 3.5, 3.5
  m_sources.parts.labels = {segmentationIn("1.2.3", "seg.dcm")}; // by the file at 2, 3, 2
  scene::Case value = presenters::buildCase("ear", m_sources, {});
  EXPECT_LT((middleOf(value.labels.at(0)) - Vector3d(5, 3, 2)).norm(), 1e-6);
  EXPECT_EQ(value.labels[0].provenance.axes.letters(), "RPS");
  m_sources.parts.labels.clear();
  value = presenters::buildCase("ear", m_sources, {});
  presenters::PartSources parts;
  parts.labels = {segmentationIn("1.2.99", "other.dcm")};
  auto failures = presenters::addSoundParts(value, parts, {});
  ASSERT_EQ(failures.size(), 1U);
  EXPECT_TRUE(failures[0].isFrameUnclear);
  // Of an export of this case it lies where it belongs.
  parts.labels = {segmentationIn(presenters::exportedFrame(value, ""), "exported.dcm")};
  presenters::addParts(value, parts, {});
  EXPECT_LT((middleOf(value.labels.at(0)) - Vector3d(2, 3, 2)).norm(), 1e-6);
  EXPECT_TRUE(value.labels[0].provenance.axes.isIdentity());
}

TEST_F(CorrectedAxes, AreFollowedByStructureSets)
{
  writeDicomCt();
  // By the file the voxels 1 and 2 along x and y, in slice 2.
  m_sources.parts.labels = {structureSetIn("1.2.3", "set.dcm")};
  const scene::Case value = presenters::buildCase("ear", m_sources, {});
  ASSERT_EQ(value.labels.size(), 1U);
  EXPECT_LT((middleOf(value.labels[0]) - Vector3d(5.5, 1.5, 2)).norm(), 1e-6);
  EXPECT_NEAR(value.labels[0].structures.at(0).volume, 4.0, 1e-6);
  EXPECT_EQ(value.labels[0].provenance.axes.letters(), "RPS");
  EXPECT_TRUE(core::sameGrid(value.labels[0].labels.get()->voxels->geometry(), value.ct.geometry));
  // Another one's frame.
  m_sources.parts.labels = {structureSetIn("1.2.99", "other.dcm")};
  EXPECT_THROW(presenters::buildCase("ear", m_sources, {}), presenters::FrameUnclear);
  m_sources.parts.labels[0].drawnOn = "ct";
  m_sources.parts.labels[0].axes = AxesCorrection();
  EXPECT_LT(
      (middleOf(presenters::buildCase("ear", m_sources, {}).labels.at(0)) - Vector3d(1.5, 1.5, 2))
          .norm(),
      1e-6);
}

TEST_F(CorrectedAxes, TurnMeshesInsideOutNever)
{
  core::TriangleMesh mesh;
  mesh.vertices = {{0, 4, 5}, {1, 4, 5}, {0, 5, 5}, {0, 4, 6}};
  mesh.triangles = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
  imaging::writeMesh(m_folder / "incus.obj", mesh);
  scene::Case value = presenters::buildCase("ear", m_sources, {});
  presenters::PartSources parts;
  parts.meshes = {{"incus", m_folder / "incus.obj"}};
  const auto failures = presenters::addSoundParts(value, parts, {});
  ASSERT_EQ(failures.size(), 1U);
  EXPECT_TRUE(failures[0].isFrameUnclear) << failures[0].why;
  parts.meshes[0].drawnOn = "ct";
  presenters::addParts(value, parts, {});
  const auto moved = value.meshes.at(0).mesh.get();
  EXPECT_LT((moved->vertices.at(1) - Eigen::Vector3f(-2, 4, 5)).norm(), 1e-4F);
  EXPECT_NEAR(mesh.signedVolume(), 1.0 / 6.0, 1e-6);
  EXPECT_NEAR(moved->signedVolume(), 1.0 / 6.0, 1e-6);
  EXPECT_TRUE(isNoted(value.meshes[0].notes, "follows the correction of its axes (RPS)"));
  // One that lies where it belongs.
  parts.meshes[0].name = "malleus";
  parts.meshes[0].drawnOn = "";
  parts.meshes[0].axes = AxesCorrection();
  presenters::addParts(value, parts, {});
  EXPECT_LT((value.meshes.at(1).mesh.get()->vertices.at(1) - Eigen::Vector3f(1, 4, 5)).norm(),
            1e-4F);
}

TEST_F(CorrectedAxes, OfAnOpenCaseMakeAnotherOne)
{
  m_sources.axes = {};
  m_sources.parts.labels = {labelsOn(kFileGrid, "incus.nrrd")};
  imaging::writeVolume(
      m_folder / "mr.nrrd",
      volume::Volume<std::int16_t>(
          core::GridGeometry({9, 9, 9}, Vector3d::Ones(), Vector3d::Zero()), std::int16_t{7}));
  m_sources.parts.mr = {{"t2", m_folder / "mr.nrrd"}};
  scene::Case value = presenters::buildCase("ear", m_sources, {});
  value.description.side = scene::Side::Left;
  value.description.note = "a note";
  library::Library library(m_folder / "library");
  library.save(value);
  const auto left = presenters::leftBehind(value);
  EXPECT_EQ(left.mr, std::vector<std::string>{"t2"});
  EXPECT_TRUE(left.drawnOnMr.empty());
  EXPECT_EQ(left.strokes, 0U);

  scene::Case next =
      presenters::correctedCase(value, AxesCorrection::parse("RPS"), "ear (axes corrected)");
  EXPECT_EQ(value.ct.provenance.axes.letters(), "LPS") << "the given case stays";
  EXPECT_TRUE(next.mr.empty());
  EXPECT_EQ(next.description.side, scene::Side::Unknown) << "asked again";
  EXPECT_EQ(next.description.note, "a note");
  EXPECT_LT((placeOf(next.labels.at(0)) - Vector3d(3, 6, 7)).norm(), 1e-9);
  library.save(next);
  const scene::Case saved = library.open("ear (axes corrected)");
  EXPECT_NE(saved.ct.object, value.ct.object) << "another CT";
  EXPECT_NE(saved.id, value.id);
  EXPECT_EQ(saved.ct.provenance.axes.letters(), "RPS");
  EXPECT_LT(
      (saved.ct.volume.get()->geometry().patientFromVoxel({7, 6, 5}) - Vector3d(0, 8, 8)).norm(),
      1e-6)
      << "its voxels' own file says so, too";
  EXPECT_LT((placeOf(saved.labels.at(0)) - Vector3d(3, 6, 7)).norm(), 1e-4);
  EXPECT_EQ(saved.labels[0].provenance.axes.letters(), "RPS");
  EXPECT_EQ(library.open("ear").ct.object, value.ct.object);

  // Twice is none.
  const scene::Case back = presenters::correctedCase(saved, AxesCorrection::parse("RPS"), "back");
  EXPECT_TRUE(back.ct.provenance.axes.isIdentity());
  EXPECT_TRUE(core::sameGrid(back.ct.geometry, kFileGrid));
  EXPECT_FALSE(isNoted(back.ct.notes, "axes of the file corrected"));
  EXPECT_FALSE(isNoted(back.labels.at(0).notes, "follows the correction"));
  EXPECT_THROW(presenters::correctedCase(value, {}, "same"), core::InvalidParameter);
}

// Names are unique, but not in every older case.
TEST_F(CorrectedAxes, LeaveBehindWhatWasDrawnOnAnMrAlsoIfNamesAreThereTwice)
{
  m_sources.axes = {};
  m_sources.parts.labels = {labelsOn(kFileGrid, "incus.nrrd")};
  imaging::writeVolume(
      m_folder / "mr.nrrd",
      volume::Volume<std::int16_t>(
          core::GridGeometry({9, 9, 9}, Vector3d::Ones(), Vector3d::Zero()), std::int16_t{7}));
  m_sources.parts.mr = {{"t2", m_folder / "mr.nrrd"}};
  core::TriangleMesh mesh;
  mesh.vertices = {{0, 4, 5}, {1, 4, 5}, {0, 5, 5}, {0, 4, 6}};
  mesh.triangles = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
  imaging::writeMesh(m_folder / "nerve.obj", mesh);
  m_sources.parts.meshes = {{"nerve", m_folder / "nerve.obj", "t2"}};
  const scene::Case value = presenters::buildCase("ear", m_sources, {});
  for (const char* const name : {"nerve", "t2"}) // as the mesh on the MR, and as the MR itself
  {
    scene::Case older = value;
    older.labels.at(0).structures.at(0).name = name;
    older.boneLook.sourceImage = "t2";
    const scene::Case next =
        presenters::correctedCase(older, AxesCorrection::parse("RPS"), "corrected");
    ASSERT_EQ(next.labels.size(), 1U) << name << " lies in the CT";
    EXPECT_EQ(next.labels[0].structures.at(0).name, name);
    EXPECT_LT((placeOf(next.labels[0]) - Vector3d(3, 6, 7)).norm(), 1e-9);
    EXPECT_TRUE(next.meshes.empty()) << name << " lies in the MR";
    EXPECT_TRUE(next.mr.empty()) << name;
    EXPECT_TRUE(next.boneLook.sourceImage.empty()) << "there is no MR to read";
  }
}

// As if the file had been added with --mr-axes: what was drawn on it follows, and is undone.
TEST_F(CorrectedAxes, OfAnMrOfTheOpenCaseAreCorrectedInIt)
{
  const core::GridGeometry grid({9, 9, 9}, Vector3d::Constant(1.5), Vector3d(-30, 20, 10));
  imaging::writeVolume(m_folder / "mr.nrrd", volume::Volume<std::int16_t>(grid, std::int16_t{7}));
  auto voxels = volume::makeZeroVolume<std::uint16_t>(grid);
  voxels->at(1, 2, 0) = 1; // by the file at -28.5, 23, 10; the centre's z is 16
  imaging::writeLabelFile(m_folder / "tumour.nrrd", volume::makeLabelMap(voxels, {}));
  core::TriangleMesh mesh; // of the middle at z = 11
  mesh.vertices = {{-28, 22, 11}, {-27, 22, 11}, {-28, 23, 11}, {-28, 22, 12}};
  mesh.triangles = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
  imaging::writeMesh(m_folder / "cyst.obj", mesh);
  m_sources.axes = {};
  m_sources.parts.mr = {{"t2", m_folder / "mr.nrrd"}};
  m_sources.parts.labels = {{"tumour", m_folder / "tumour.nrrd"},
                            labelsOn(kFileGrid, "incus.nrrd")};
  m_sources.parts.meshes = {{"cyst", m_folder / "cyst.obj", "t2"}};
  library::Library library(m_folder / "library");
  presenters::WorkstationModel model(library);
  model.adopt(presenters::buildCase("ear", m_sources, {}));
  const core::RigidTransform lies{Eigen::Quaterniond::Identity(), {1.0, 2.0, 3.0}};
  model.changeMr([&](scene::Case& value) { scene::applyRegistration(value, "t2", lies, {}); },
                 "registration");
  model.save();
  const auto at = [&model](const char* name)
  {
    for (const scene::LabelPart& part : model.value().labels)
      if (part.structures.at(0).name == name)
        return middleOf(part);
    return Vector3d(Vector3d::Constant(std::nan("")));
  };
  const auto expectStated = [&]
  {
    const scene::Case& value = model.value();
    EXPECT_TRUE(core::sameGrid(value.mr.at(0).geometry, grid));
    EXPECT_TRUE(core::sameGrid(value.mr[0].volume.get()->geometry(), grid));
    EXPECT_TRUE(value.mr[0].provenance.axes.isIdentity());
    EXPECT_TRUE(value.mr[0].registered);
    EXPECT_EQ(value.mr[0].mrFromCt.translation(), lies.translation());
    EXPECT_LT((at("tumour") - Vector3d(-28.5, 23, 10)).norm(), 1e-6);
    EXPECT_EQ(value.meshes.at(0).mesh.get()->vertices.at(3).z(), 12.0F);
    EXPECT_FALSE(isNoted(value.mr[0].notes, "axes of the file corrected"));
  };
  const auto expectCorrected = [&]
  {
    const scene::Case& value = model.value();
    EXPECT_EQ(value.mr.at(0).provenance.axes.letters(), "LPI");
    EXPECT_LT((value.mr[0].geometry.patientFromVoxel({1, 2, 0}) - Vector3d(-28.5, 23, 22)).norm(),
              1e-6);
    EXPECT_FALSE(value.mr[0].registered);
    EXPECT_LT((at("tumour") - Vector3d(-28.5, 23, 22)).norm(), 1e-6);
    EXPECT_LT((at("incus") - Vector3d(-4, 6, 7)).norm(), 1e-4) << "drawn on the CT";
    const auto moved = value.meshes.at(0).mesh.get();
    EXPECT_NEAR(moved->vertices.at(3).z(), 20.0F, 1e-4F);
    EXPECT_NEAR(moved->signedVolume(), 1.0 / 6.0, 1e-5);
    EXPECT_TRUE(isNoted(value.mr[0].notes, "axes of the file corrected (LPI)"));
  };
  const auto followers =
      presenters::axesFollowers(model.value(), {presenters::AxesPart::Kind::Mr, "t2"});
  EXPECT_EQ(followers.parts, (std::vector<std::string>{"tumour", "cyst"}));
  EXPECT_EQ(followers.unregistered, std::vector<std::string>{"t2"});
  model.correctAxes("t2", AxesCorrection::parse("LPI"));
  expectCorrected();
  EXPECT_EQ(model.undoText(), "axes of t2");
  model.undo();
  expectStated();
  model.redo();
  expectCorrected();
  model.save();
  const scene::Case saved = library.open("ear");
  EXPECT_EQ(saved.mr.at(0).provenance.axes.letters(), "LPI");
  EXPECT_LT(
      (saved.mr[0].volume.get()->geometry().patientFromVoxel({1, 2, 0}) - Vector3d(-28.5, 23, 22))
          .norm(),
      1e-4);
  // What was taken out comes back to where the MR is by now.
  model.undo();
  model.removePart("tumour");
  model.correctAxes("t2", AxesCorrection::parse("LPI"));
  model.restorePart();
  expectCorrected();
  model.undo();
  model.undo();
  model.undo();
  expectStated();
  EXPECT_THROW(model.correctAxes("t2", {}), core::InvalidParameter);
  EXPECT_THROW(model.correctAxes("ct", AxesCorrection::parse("RPS")), core::InvalidParameter);
  expectStated();
}

// What was measured along a structure or to it lies where that was; what was taken out comes back
// without it. Of marks and of other structures nothing changes.
TEST_F(CorrectedAxes, AreNotFollowedByWhatWasMeasured)
{
  m_sources.axes = {};
  m_sources.parts.labels = {ossicles("nerve")};
  m_sources.parts.meshes = {meshNamed("stapes")};
  library::Library library(m_folder / "library");
  presenters::WorkstationModel model(library);
  model.adopt(presenters::buildCase("ear", m_sources, {}));
  std::vector<scene::Measurement> made(3);
  for (std::size_t n = 0; n < made.size(); ++n)
  {
    made[n].kind = scene::Measurement::Kind::Length;
    made[n].name = "length " + std::to_string(n);
    made[n].points = {{-4, 6, 7}, {-3, 6, 7}};
    made[n].structure = std::vector<std::string>{"nerve", "malleus", "stapes"}[n];
  }
  model.setMeasurements(made);
  const auto gone = [&model]
  {
    std::string flags;
    for (const scene::Measurement& one : model.value().measurements)
      flags += one.structureGone ? '1' : '0';
    return flags;
  };
  const AxesCorrection mirrored = AxesCorrection::parse("RPS");
  scene::Case corrected = model.value();
  presenters::correctPart(corrected, presenters::axesPart(corrected, "nerve"), mirrored);
  EXPECT_TRUE(corrected.measurements[0].structureGone);
  EXPECT_TRUE(corrected.measurements[1].structureGone) << "of the same map";
  EXPECT_FALSE(corrected.measurements[2].structureGone);
  EXPECT_NE(presenters::quantitiesOf(corrected, corrected.measurements[0])[0].remark.find("moved"),
            std::string::npos);

  model.correctAxes("nerve", mirrored);
  EXPECT_EQ(gone(), "110");
  model.undo();
  EXPECT_EQ(gone(), "000");
  model.redo();
  EXPECT_EQ(gone(), "110");
  model.correctAxes("stapes", mirrored);
  EXPECT_EQ(gone(), "111");
  model.undo();
  model.undo();
  EXPECT_EQ(gone(), "000");
  model.removePart("malleus");
  EXPECT_EQ(gone(), "010");
  model.correctAxes("nerve", mirrored);
  model.restorePart();
  EXPECT_EQ(gone(), "110") << "it comes back mirrored";
  model.undo();
  model.undo();
  EXPECT_EQ(gone(), "010");
  model.restorePart();
  EXPECT_EQ(gone(), "000");
}

// As of --labels-axes and --mesh-axes.
TEST_F(CorrectedAxes, OfLabelsAndMeshesOfTheOpenCaseAreCorrectedInIt)
{
  m_sources.axes = {};
  m_sources.parts.labels = {ossicles()}; // the incus at -4, 6, 7
  m_sources.parts.meshes = {meshNamed("stapes")};
  library::Library library(m_folder / "library");
  presenters::WorkstationModel model(library);
  model.adopt(presenters::buildCase("ear", m_sources, {}));
  EXPECT_EQ(
      presenters::axesFollowers(model.value(), presenters::axesPart(model.value(), "incus")).parts,
      std::vector<std::string>{"malleus"});
  model.removePart("malleus"); // comes back with the map
  model.correctAxes("incus", AxesCorrection::parse("RPS"));
  EXPECT_LT((placeOf(model.value().labels.at(0)) - Vector3d(3, 6, 7)).norm(), 1e-9);
  EXPECT_EQ(model.value().labels[0].provenance.axes.letters(), "RPS");
  EXPECT_TRUE(isNoted(model.value().labels[0].notes, "axes of the file corrected (RPS)"));
  EXPECT_TRUE(model.value().ct.provenance.axes.isIdentity());
  model.restorePart();
  ASSERT_EQ(model.value().labels.size(), 1U) << "one map";
  EXPECT_EQ(model.value().labels[0].structures.size(), 2U);
  model.correctAxes("malleus", AxesCorrection::parse("RPS")); // twice is none
  EXPECT_TRUE(core::sameGrid(model.value().labels[0].labels.get()->voxels->geometry(), kFileGrid));
  EXPECT_FALSE(isNoted(model.value().labels[0].notes, "axes of the file corrected"));
  model.undo();
  EXPECT_LT((placeOf(model.value().labels.at(0)) - Vector3d(3, 6, 7)).norm(), 1e-9);

  model.correctAxes("stapes", AxesCorrection::parse("RPS"));
  const auto moved = model.value().meshes.at(0).mesh.get();
  EXPECT_LT((moved->vertices.at(1) - Eigen::Vector3f(-2, 4, 5)).norm(), 1e-4F);
  EXPECT_NEAR(moved->signedVolume(), 1.0 / 6.0, 1e-6);
  model.undo();
  EXPECT_EQ(model.value().meshes[0].mesh.get()->vertices.at(1).x(), 1.0F);

  // What was removed from it lies where it was drilled.
  scene::Case drilled = model.value();
  record(drilled, "malleus");
  expectRefused(drilled, "incus", "'malleus' keeps its axes");
  EXPECT_LT((placeOf(drilled.labels.at(0)) - Vector3d(3, 6, 7)).norm(), 1e-9);
}

// One structure of a map was edited and its edit undone: it is a part of its own, as such also in
// the library.
TEST_F(CorrectedAxes, OfAStructureMoveAllPartsWithItsMap)
{
  m_sources.axes = {};
  m_sources.parts.labels = {ossicles()};
  scene::Case value = presenters::buildCase("ear", m_sources, {});
  ASSERT_EQ(value.labels.at(0).structures.size(), 2U);
  value.labels.push_back(value.labels[0]);
  value.labels[0].structures.pop_back();
  value.labels[1].structures.erase(value.labels[1].structures.begin());
  library::Library library(m_folder / "library");
  library.save(value);
  for (scene::Case one : {value, library.open("ear")})
  {
    ASSERT_EQ(one.labels.size(), 2U);
    const presenters::AxesPart incus = presenters::axesPart(one, "incus");
    EXPECT_EQ(presenters::axesFollowers(one, incus).parts, std::vector<std::string>{"malleus"});
    scene::Case drilled = one;
    record(drilled, "malleus");
    expectRefused(drilled, "incus", "'malleus' keeps its axes");
    presenters::correctPart(one, incus, AxesCorrection::parse("RPS"));
    for (const scene::LabelPart& part : one.labels)
    {
      EXPECT_LT((placeOf(part) - Vector3d(3, 6, 7)).norm(), 1e-4)
          << part.structures.at(0).name << ": " << placeOf(part).transpose();
      EXPECT_EQ(part.provenance.axes.letters(), "RPS") << part.structures[0].name;
    }
  }
  presenters::WorkstationModel model(library);
  model.open("ear");
  model.correctAxes("malleus", AxesCorrection::parse("RPS"));
  for (const bool isCorrected : {true, false, true})
  {
    for (const scene::LabelPart& part : model.value().labels)
      EXPECT_LT((placeOf(part) - Vector3d(isCorrected ? 3 : -4, 6, 7)).norm(), 1e-4)
          << part.structures.at(0).name << ": " << placeOf(part).transpose();
    if (isCorrected)
      model.undo();
    else
      model.redo();
  }
}

// One that was taken out may be put back to where its strokes removed something.
TEST_F(CorrectedAxes, OfAStructureAreRefusedIfStrokesRecordOneThatWasTakenOut)
{
  m_sources.axes = {};
  m_sources.parts.labels = {ossicles()};
  scene::Case value = presenters::buildCase("ear", m_sources, {});
  record(value, "malleus");
  presenters::WorkstationModel model(library::Library(m_folder / "library"));
  model.adopt(std::move(value));
  model.removePart("malleus");
  EXPECT_THROW(model.correctAxes("incus", AxesCorrection::parse("RPS")), core::Error);
  model.restorePart();
  EXPECT_LT((placeOf(model.value().labels.at(0)) - Vector3d(-4, 6, 7)).norm(), 1e-9);
}

TEST_F(CorrectedAxes, AreThoseOfThePartThatIsThereAndNotOfANamesakeThatWasTakenOut)
{
  m_sources.axes = {};
  m_sources.parts.labels = {labelsOn(kFileGrid, "incus.nrrd")};
  const scene::LabelPart drawn = presenters::buildCase("ear", m_sources, {}).labels.at(0);
  m_sources.parts.labels.clear();
  m_sources.parts.meshes = {meshNamed("incus")};
  presenters::WorkstationModel model(library::Library(m_folder / "library"));
  model.adopt(presenters::buildCase("ear", m_sources, {}));
  model.removePart("incus");
  model.putStructure(drawn);
  model.correctAxes("incus", AxesCorrection::parse("RPS"));
  EXPECT_LT((placeOf(model.value().labels.at(0)) - Vector3d(3, 6, 7)).norm(), 1e-9);
  model.undo();
  EXPECT_LT((placeOf(model.value().labels.at(0)) - Vector3d(-4, 6, 7)).norm(), 1e-9);
  // Where a name is there twice, as in older cases, it is the structure.
  scene::Case older = model.value();
  older.meshes = presenters::buildCase("ear", m_sources, {}).meshes;
  const presenters::AxesPart part = presenters::axesPart(older, "incus");
  EXPECT_EQ(part.kind, presenters::AxesPart::Kind::Structure);
  presenters::correctPart(older, part, AxesCorrection::parse("RPS"));
  EXPECT_LT((placeOf(older.labels.at(0)) - Vector3d(3, 6, 7)).norm(), 1e-9);
  EXPECT_EQ(older.meshes.at(0).mesh.get()->vertices.at(1).x(), 1.0F);
}

// Older cases know by the grid alone that a map lies on an MR, whose grid it has no more.
TEST_F(CorrectedAxes, OfAMapOfAnOlderCaseLeaveItOnItsMr)
{
  const core::GridGeometry grid({9, 9, 9}, Vector3d::Constant(1.5), Vector3d(-30, 20, 10));
  imaging::writeVolume(m_folder / "mr.nrrd", volume::Volume<std::int16_t>(grid, std::int16_t{7}));
  m_sources.axes = {};
  m_sources.parts.mr = {{"t2", m_folder / "mr.nrrd"}}; // its centre is -24, 26, 16
  m_sources.parts.labels = {labelsOn(grid, "tumour.nrrd"), labelsOn(kFileGrid, "malleus.nrrd")};
  m_sources.parts.labels[0].name = "tumour"; // at -24, 26, 16
  m_sources.parts.labels[1].name = "malleus";
  scene::Case older = presenters::buildCase("ear", m_sources, {});
  for (scene::LabelPart& map : older.labels)
    map.drawnOn.reset();
  const core::RigidTransform lies{Eigen::Quaterniond::Identity(), {1.0, 2.0, 3.0}};
  scene::applyRegistration(older, "t2", lies, {});
  presenters::WorkstationModel model(library::Library(m_folder / "library"));
  model.adopt(older);
  for (const char* const part : {"tumour", "t2"})
  {
    model.correctAxes(part, AxesCorrection::parse("SLA"));
    const scene::LabelPart& moved = model.value().labels.at(0);
    EXPECT_EQ(moved.drawnOn, "t2") << part;
    EXPECT_EQ(scene::placementOf(model.value(), moved).drawnOn, "t2") << part;
    EXPECT_EQ(model.value().labels.at(1).drawnOn, std::nullopt) << part << ": of the CT";
    model.undo();
    EXPECT_EQ(model.value().labels.at(0).drawnOn, std::nullopt) << part;
    EXPECT_EQ(scene::placementOf(model.value(), model.value().labels[0]).drawnOn, "t2") << part;
  }
  // Of two MRs of one grid it may lie on either.
  scene::ImagePart other = older.mr.at(0);
  other.name = "t1";
  older.mr.push_back(other);
  expectRefused(older, "tumour", "on any of the MR images 't2', 't1'");
  expectRefused(older, "t1", "whether 'tumour' goes with it");
  expectRefused(older, "t2", "whether 'tumour' goes with it");
  presenters::correctPart(older, presenters::axesPart(older, "malleus"),
                          AxesCorrection::parse("RPS"));
  EXPECT_LT((placeOf(older.labels.at(1)) - Vector3d(3, 6, 7)).norm(), 1e-9);
  EXPECT_EQ(older.labels[1].drawnOn, std::string());
}

// PLS exchanges left and back, RPS mirrors: first PLS, then RPS, then PLS takes x, y to y, x, then
// to -y, x, then to x, -y, so that what the file calls left and back is the patient's left and
// front.
TEST_F(CorrectedAxes, AreNotedAsOneOfSeveral)
{
  m_sources.axes = {};
  m_sources.parts.labels = {labelsOn(kFileGrid, "incus.nrrd")};
  m_sources.parts.meshes = {meshNamed("stapes")};
  scene::Case value = presenters::buildCase("ear", m_sources, {});
  const auto correct = [](scene::Case& of, const char* part, const char* letters)
  { presenters::correctPart(of, presenters::axesPart(of, part), AxesCorrection::parse(letters)); };
  const auto notesOf = [](const scene::Case& of) {
    return std::vector{of.labels.at(0).notes, of.meshes.at(0).notes};
  };
  const auto without = notesOf(value);
  for (const char* const letters : {"PLS", "RPS", "PLS"})
  {
    correct(value, "incus", letters);
    correct(value, "stapes", letters);
  }
  // The mesh's vertex 1, 4, 5 about -0.5, 7.5, 7.5.
  EXPECT_LT((value.meshes.at(0).mesh.get()->vertices.at(1) - Eigen::Vector3f(1, 11, 5)).norm(),
            1e-4F);
  EXPECT_LT((placeOf(value.labels.at(0)) - Vector3d(-4, 9, 7)).norm(), 1e-9);
  for (const auto& notes : notesOf(value))
  {
    EXPECT_TRUE(isNoted(notes, "axes of the file corrected (LAS)"));
    EXPECT_FALSE(isNoted(notes, "PLS"));
    EXPECT_FALSE(isNoted(notes, "RPS"));
  }
  correct(value, "incus", "LAS");
  correct(value, "stapes", "LAS");
  EXPECT_EQ(notesOf(value), without) << "they are as before";
  // What followed its image is corrected by itself.
  m_sources.axes = AxesCorrection::parse("RPS");
  m_sources.parts.meshes[0].drawnOn = "ct";
  value = presenters::buildCase("ear", m_sources, {});
  correct(value, "incus", "LPI");
  correct(value, "stapes", "LPI");
  for (const auto& notes : notesOf(value))
  {
    EXPECT_TRUE(isNoted(notes, "axes of the file corrected (RPI)"));
    EXPECT_FALSE(isNoted(notes, "follows the correction"));
  }
  // And follows the image again.
  value = presenters::correctedCase(value, AxesCorrection::parse("LAS"), "corrected");
  for (const auto& notes : notesOf(value))
    EXPECT_TRUE(isNoted(notes, "axes of the file corrected (RAI)"));
  correct(value, "incus", "LPI");
  correct(value, "stapes", "LPI");
  for (const auto& notes : notesOf(value))
    EXPECT_TRUE(isNoted(notes, "as its file states it, and follows the correction of its "
                               "axes (RAS)"));
}

// Of what is on a grid of its own, or on an MR: the places of
// OfLabelsTurnThemAboutTheMiddleOfTheir- Image and OfLabelsOnAnMrTurnThemAboutItsMiddle, of which
// the files were corrected when they came.
TEST_F(CorrectedAxes, OfPartsOfTheOpenCaseTurnThemAboutTheMiddleOfTheirImage)
{
  const core::GridGeometry grid({9, 9, 11}, Vector3d::Constant(1.5), Vector3d(-30, 20, 10));
  imaging::writeVolume(m_folder / "mr.nrrd", volume::Volume<std::int16_t>(grid, std::int16_t{7}));
  m_sources.axes = {};
  m_sources.parts.mr = {{"t2", m_folder / "mr.nrrd"}}; // its centre is -24, 26, 17.5
  m_sources.parts.labels = {
      labelsOn(core::GridGeometry({8, 8, 8}, Vector3d::Ones(), Vector3d(-6, 3, 3)),
               "incus.nrrd"), // at -2, 7, 7
      labelsOn(core::GridGeometry({8, 8, 8}, Vector3d::Ones(), Vector3d(-28, 21, 8)), "tumour.nrrd",
               "t2")}; // at -24, 25, 12
  m_sources.parts.labels[1].name = "tumour";
  m_sources.parts.meshes = {meshNamed("cyst", {-28, 22, 11})};
  m_sources.parts.meshes[0].drawnOn = "t2";
  const scene::Case value = presenters::buildCase("ear", m_sources, {});
  for (const auto& [letters, ofCt, ofMr, vertex] :
       {std::tuple("RPS", Vector3d(1, 7, 7), Vector3d(-24, 25, 12), Vector3d(-21, 22, 11)),
        std::tuple("LPI", Vector3d(-2, 7, 8), Vector3d(-24, 25, 23), Vector3d(-27, 22, 24)),
        std::tuple("SLA", Vector3d(-1, 8, 6), Vector3d(-25, 31.5, 17.5),
                   Vector3d(-28, 32.5, 14.5))})
  {
    scene::Case corrected = value;
    for (const char* const name : {"incus", "tumour", "cyst"})
      presenters::correctPart(corrected, presenters::axesPart(corrected, name),
                              AxesCorrection::parse(letters));
    EXPECT_LT((placeOf(corrected.labels.at(0)) - ofCt).norm(), 1e-9)
        << letters << ": " << placeOf(corrected.labels[0]).transpose();
    EXPECT_LT((placeOf(corrected.labels.at(1)) - ofMr).norm(), 1e-9)
        << letters << ": " << placeOf(corrected.labels[1]).transpose();
    EXPECT_EQ(corrected.labels[1].drawnOn, "t2");
    const Vector3d moved = corrected.meshes.at(0).mesh.get()->vertices.at(1).cast<double>();
    EXPECT_LT((moved - vertex).norm(), 1e-4) << letters << ": " << moved.transpose();
    EXPECT_TRUE(core::sameGrid(corrected.mr.at(0).geometry, grid)) << "the image stays";
    EXPECT_TRUE(core::sameGrid(corrected.ct.geometry, kFileGrid));
  }
}
