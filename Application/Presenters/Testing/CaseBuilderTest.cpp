#include <algorithm>
#include <array>
#include <cctype>
#include <fstream>
#include <iterator>
#include <locale>
#include <map>
#include <set>
#include <stdexcept>
#include <tuple>

#include <gtest/gtest.h>

#include <sys/stat.h>
#include <unistd.h>

#include "petrous/Core/NumberText.h"
#include "petrous/Imaging/DicomScan.h"
#include "petrous/Imaging/DicomWriter.h"
#include "petrous/Imaging/LabelFile.h"
#include "petrous/Imaging/MeshFile.h"
#include "petrous/Imaging/VolumeFile.h"
#include "petrous/Presenters/CaseBuilder.h"
#include "petrous/Presenters/IdentityText.h"
#include "petrous/Presenters/IntensityDisplay.h"
#include "petrous/Scene/Manifest.h"
#include "petrous/Scene/Placement.h"
#include "petrous/Volume/MeshMeasure.h"

using namespace petrous;
using Eigen::Vector3d;
using presenters::PartSource;

namespace
{

/// But for one voxel of bone: an image of one single value is refused.
std::shared_ptr<const volume::Volume<std::int16_t>> softTissue(const core::GridGeometry& grid)
{
  auto scan = std::make_shared<volume::Volume<std::int16_t>>(grid, std::int16_t{40});
  scan->at(2, 2, 1) = 1200;
  return scan;
}

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
    mesh.vertices = {{0, 4, 5}, {1, 4, 5}, {0, 5, 5}, {0, 4, 6}}; // inside the CT
    mesh.triangles = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
    imaging::writeMesh(m_folder / "incus.obj", mesh);
    m_sources.ct = m_folder / "ct.nrrd";
  }
  void TearDown() override { std::filesystem::remove_all(m_folder); }

  /// Of the structures in label maps.
  static std::pair<std::set<std::string>, std::string> namesAndNotes(const scene::Case& value)
  {
    std::pair<std::set<std::string>, std::string> result;
    for (const auto& part : value.labels)
    {
      for (const auto& structure : part.structures)
        result.first.insert(structure.name);
      for (const std::string& note : part.notes)
        result.second += note + "\n";
    }
    return result;
  }

  /// The same voxels in the order of other axes: along `from[a]` of the grid, backwards where
  /// `backwards[a]`.
  static core::GridGeometry reordered(const core::GridGeometry& grid, const core::Index3& from,
                                      const std::array<bool, 3>& backwards)
  {
    core::Index3 dims;
    Vector3d spacing;
    Eigen::Matrix3d direction;
    Vector3d first = Vector3d::Zero(); // its voxel, in those of the grid
    for (int a = 0; a < 3; ++a)
    {
      const int of = from[static_cast<std::size_t>(a)];
      const bool isBackwards = backwards[static_cast<std::size_t>(a)];
      dims[static_cast<std::size_t>(a)] = grid.dims()[static_cast<std::size_t>(of)];
      spacing[a] = grid.spacing()[of];
      direction.col(a) = (isBackwards ? -1.0 : 1.0) * grid.direction().col(of);
      if (isBackwards)
        first[of] = grid.dims()[static_cast<std::size_t>(of)] - 1.0;
    }
    return {dims, spacing, grid.patientFromVoxel(first), direction};
  }

  /// Adds labels on this grid. By how much they may be off where they are asked about, mm; nullopt:
  /// they were added.
  std::optional<double> unrepairedBy(scene::Case& value, const core::GridGeometry& grid) const
  {
    auto voxels = std::make_shared<volume::Volume<std::uint16_t>>(grid, std::uint16_t{0});
    voxels->at(3, 3, 2) = 1;
    imaging::writeLabelFile(m_folder / "stack.nrrd", volume::makeLabelMap(voxels, {}));
    presenters::PartSources parts;
    parts.labels = {{"vein", m_folder / "stack.nrrd"}};
    try
    {
      presenters::addParts(value, parts, {});
    }
    catch (const presenters::LabelsUnrepaired& unrepaired)
    {
      return unrepaired.apart;
    }
    return std::nullopt;
  }

  /// A part of the CT's lattice, which may reach beyond the CT.
  static core::GridGeometry onLattice(const core::GridGeometry& ct, const core::Index3& first,
                                      const core::Index3& size)
  {
    return {size, ct.spacing(), ct.patientFromVoxel(Vector3d(first[0], first[1], first[2])),
            ct.direction()};
  }

  std::optional<double> unrepairedBy(scene::Case& value, const core::Index3& first,
                                     const core::Index3& size) const
  {
    return unrepairedBy(value, onLattice(value.ct.geometry, first, size));
  }

  /// A CT (`file` is "ct") or MR series of this patient.
  PartSource writeSeriesOf(const std::string& file, const std::string& id,
                           const std::string& name) const
  {
    const auto scan = softTissue(core::GridGeometry({8, 8, 8}, Vector3d::Ones(), Vector3d::Zero()));
    imaging::SeriesDescription series;
    series.modality = file == "ct" ? imaging::SeriesDescription::Modality::Ct
                                   : imaging::SeriesDescription::Modality::Mr;
    series.patientId = id;
    series.patientName = name;
    series.studyUid = imaging::deterministicUid(2, file);
    series.seriesUid = imaging::deterministicUid(1, file);
    series.frameOfReferenceUid = imaging::deterministicUid(3, file);
    imaging::writeDicomSeries(m_folder / file, volume::IntensityVolume(scan), series);
    return PartSource{file, m_folder / file};
  }

  /// One structure, of index 1.
  void writeSegmentation(const std::string& file,
                         std::shared_ptr<const volume::Volume<std::uint16_t>> voxels,
                         const std::string& name, const std::string& frameOfReference) const
  {
    volume::Segment structure;
    structure.name = name;
    structure.index = 1;
    imaging::SegmentationDescription segmentation;
    segmentation.studyUid = "1.2.3";
    segmentation.seriesUid = "1.2.3.4";
    segmentation.frameOfReferenceUid = frameOfReference;
    imaging::SegmentationDescription::Segment segment;
    segment.index = 1;
    segment.label = name;
    segmentation.segments = {segment};
    imaging::writeDicomSegmentation(
        m_folder / file, {volume::makeLabelMap(std::move(voxels), {structure})}, segmentation);
  }

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
  ASSERT_FALSE(value.labels[0].notes.empty());
  EXPECT_NE(value.labels[0].notes.back().find("'T2', which was added later"), std::string::npos);
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
  // An uncalibrated 16-bit dry bone: a sphere of 42000 in air of 8000.
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

// On real data a label of the unrepaired stack lies 38 mm off.
TEST_F(CaseBuilder, AsksAboutLabelsOnAnotherGridThanARepairedCt)
{
  auto voxels = std::make_shared<volume::Volume<std::uint16_t>>(
      core::GridGeometry({16, 12, 8}, Vector3d(1.0, 1.0, 1.2), Vector3d(-8, 2, 3)),
      std::uint16_t{0});
  voxels->at(4, 4, 4) = 1;
  imaging::writeLabelFile(m_folder / "vein.nii.gz", volume::makeLabelMap(voxels, {}));
  for (const double shift : {0.0, 5.25})
    for (const int missing : {0, 2})
      for (const char* file : {"vein", "facial_nerve"})
      {
        auto value = presenters::buildCase("ear", m_sources, {});
        value.ct.provenance.shift = shift;
        if (missing > 0)
          value.ct.provenance.interpolated = {{3, 2 + missing}};
        presenters::PartSources parts;
        parts.labels = {{"", m_folder / (file + std::string(".nii.gz"))}};
        if (file == std::string("vein") && (shift > 0.0 || missing > 0))
        {
          try
          {
            presenters::addParts(value, parts, {});
            ADD_FAILURE() << "was added";
          }
          catch (const presenters::LabelsUnrepaired& unrepaired)
          {
            EXPECT_NEAR(unrepaired.apart, shift + missing, 1e-9);
            EXPECT_NE(std::string(unrepaired.what()).find("--labels-as-they-lie"),
                      std::string::npos);
          }
          EXPECT_TRUE(value.labels.empty());
          const auto failures = presenters::addSoundParts(value, parts, {});
          ASSERT_EQ(failures.size(), 1U);
          EXPECT_NEAR(failures[0].unrepaired, shift + missing, 1e-9);
          parts.labels[0].asTheyLie = true;
        }
        presenters::addParts(value, parts, {});
        std::string told;
        for (const std::string& note : value.labels.at(0).notes)
          told += note + "\n";
        const bool isTold = told.find("was repaired") != told.npos;
        EXPECT_EQ(isTold, file == std::string("vein") && (shift > 0.0 || missing > 0)) << told;
        EXPECT_EQ(told.find(core::fixedText(shift + missing, 1) + " mm") != told.npos, isTold);
      }
}

// A gapped stack that is taken for even lies on the repaired CT's lattice, with fewer slices.
TEST_F(CaseBuilder, AsksAboutLabelsOnTheGappedStackOfARepairedCt)
{
  auto value = presenters::buildCase("ear", m_sources, {});
  const core::GridGeometry ct = value.ct.geometry;
  const core::Index3 dims = ct.dims();
  ASSERT_GE(dims[2], 8);
  const auto isAsked = [&](int first, int slices, int interpolated)
  {
    scene::Case with = value;
    if (interpolated > 0)
      with.ct.provenance.interpolated = {{3, 2 + interpolated}};
    const auto apart = unrepairedBy(with, {0, 0, first}, {dims[0], dims[1], slices});
    if (apart)
    {
      EXPECT_NEAR(*apart, interpolated * ct.spacing()[2], 1e-9);
    }
    return apart.has_value();
  };
  EXPECT_TRUE(isAsked(0, dims[2] - 2, 2));
  EXPECT_TRUE(isAsked(0, dims[2] - 1, 2)); // one of them was guessed before it was written
  EXPECT_FALSE(isAsked(0, dims[2], 2)) << "all slices of the repaired CT";
  EXPECT_FALSE(isAsked(0, dims[2] - 3, 2)) << "fewer than there are files: a cut";
  EXPECT_FALSE(isAsked(2, dims[2] - 2, 2)) << "a cut from another slice on";
  EXPECT_FALSE(isAsked(0, dims[2] - 2, 0)) << "nothing is missing";
}

// Slices that repair moved sideways, at their pitch along the normal: the repaired CT is wider.
TEST_F(CaseBuilder, AsksAboutLabelsOnTheStraightStackOfARepairedCt)
{
  auto value = presenters::buildCase("ear", m_sources, {});
  const core::GridGeometry ct = value.ct.geometry;
  const core::Index3 dims = ct.dims();
  value.ct.provenance.shift = 2.4 * ct.spacing()[1];
  const auto isAsked = [&](const core::Index3& first, const core::Index3& size)
  {
    scene::Case with = value;
    return unrepairedBy(with, first, size).has_value();
  };
  EXPECT_TRUE(isAsked({0, 0, 0}, {dims[0], dims[1] - 3, dims[2]}));
  EXPECT_TRUE(isAsked({0, 3, 0}, {dims[0], dims[1] - 3, dims[2]})) << "it leans the other way";
  EXPECT_FALSE(isAsked({0, 0, 0}, dims)) << "the repaired CT's own";
  EXPECT_FALSE(isAsked({0, 0, 0}, {dims[0], dims[1] - 4, dims[2]})) << "more than it was widened";
  EXPECT_FALSE(isAsked({0, 0, 0}, {dims[0], dims[1] - 3, dims[2] - 1})) << "no slice was missing";
  EXPECT_FALSE(isAsked({0, 0, 1}, {dims[0], dims[1] - 3, dims[2]})) << "it begins further up";
}

// What was cut out of the repaired CT, or reaches beyond it, is on its voxels.
TEST_F(CaseBuilder, AsksNotAboutLabelsOnTheVoxelsOfARepairedCt)
{
  auto value = presenters::buildCase("ear", m_sources, {});
  value.ct.provenance.shift = 20.0;
  for (const core::Index3& first : {core::Index3{2, 3, 1}, core::Index3{-2, 0, 0}})
  {
    scene::Case with = value;
    EXPECT_FALSE(unrepairedBy(with, first, {6, 5, 4}));
    EXPECT_EQ(with.labels.size(), 1U);
  }
}

// NiBabel, 3D Slicer and others save again in RAS, or by planes: the order of the voxels is not
// where they lie.
TEST_F(CaseBuilder, AsksAboutLabelsOfARepairedCtInWhicheverOrderTheirVoxelsAre)
{
  auto value = presenters::buildCase("ear", m_sources, {});
  const core::GridGeometry ct = value.ct.geometry;
  const core::Index3 dims = ct.dims();
  ASSERT_GE(dims[2], 8);
  value.ct.provenance.interpolated = {{3, 4}};
  const auto isAsked = [&](const core::GridGeometry& grid)
  {
    scene::Case with = value;
    return unrepairedBy(with, grid).has_value();
  };
  constexpr bool kOn = false, kBack = true;
  core::Index3 order{0, 1, 2};
  do
    for (const auto& backwards :
         {std::array<bool, 3>{kOn, kOn, kOn}, {kBack, kBack, kOn}, {kOn, kBack, kBack}})
    {
      const auto of = [&](const core::Index3& first, const core::Index3& size)
      { return reordered(onLattice(ct, first, size), order, backwards); };
      const std::string way = std::to_string(order[0]) + std::to_string(order[1]) +
                              std::to_string(order[2]) + (backwards[0] ? " back" : " on") +
                              (backwards[2] ? " down" : " up");
      EXPECT_FALSE(isAsked(of({0, 0, 0}, dims))) << way << ": the repaired CT's own";
      EXPECT_FALSE(isAsked(of({4, 3, 1}, {6, 6, 5}))) << way << ": a cut of it";
      EXPECT_TRUE(isAsked(of({0, 0, 0}, {dims[0], dims[1], dims[2] - 2})))
          << way << ": as many slices as there are files";
      const core::GridGeometry aside =
          reordered(core::GridGeometry(dims, ct.spacing(), ct.patientFromVoxel({0.5, 0.0, 0.0})),
                    order, backwards);
      EXPECT_TRUE(isAsked(aside)) << way << ": half a voxel aside";
    }
  while (std::next_permutation(order.begin(), order.end()));
  // A stack that its program counts from the head begins at the last slice.
  const auto fromAbove = [&](int first, const std::array<bool, 3>& backwards)
  {
    return isAsked(reordered(onLattice(ct, {0, 0, first}, {dims[0], dims[1], dims[2] - 2}),
                             {0, 1, 2}, backwards));
  };
  EXPECT_TRUE(fromAbove(2, {kOn, kOn, kBack}));
  EXPECT_FALSE(fromAbove(1, {kOn, kOn, kBack})) << "a cut from neither end";
  EXPECT_FALSE(fromAbove(2, {kBack, kBack, kOn})) << "counted from the feet it is a cut";
}

// Resaved in RAS they would else lie in the CT, away from the MR by its registration.
TEST_F(CaseBuilder, LabelsOnAnMrAreKnownInWhicheverOrderTheirVoxelsAre)
{
  const core::GridGeometry grid({9, 8, 7}, Vector3d(1.5, 1.4, 1.3), Vector3d(-30, 20, 10));
  auto scan = std::make_shared<volume::Volume<std::int16_t>>(grid, std::int16_t{7});
  scan->at(2, 2, 1) = 90;
  imaging::writeVolume(m_folder / "mr.nrrd", *scan);
  const auto labelsOn = [&](const core::GridGeometry& of)
  {
    auto voxels = std::make_shared<volume::Volume<std::uint16_t>>(of, std::uint16_t{0});
    voxels->at(3, 3, 2) = 1;
    imaging::writeLabelFile(m_folder / "vein.nrrd", volume::makeLabelMap(voxels, {}));
    presenters::PartSources parts;
    parts.labels = {{"vein", m_folder / "vein.nrrd"}};
    return parts;
  };
  presenters::PartSources mr;
  mr.mr = {{"t2", m_folder / "mr.nrrd"}};
  for (const core::GridGeometry& of : {reordered(grid, {0, 1, 2}, {true, true, false}),
                                       reordered(grid, {2, 0, 1}, {false, true, false})})
    for (const bool isMrFirst : {true, false})
    {
      auto value = presenters::buildCase("ear", m_sources, {});
      if (isMrFirst)
        presenters::addParts(value, mr, {});
      presenters::addParts(value, labelsOn(of), {});
      if (!isMrFirst)
        presenters::addParts(value, mr, {});
      EXPECT_EQ(value.labels.at(0).drawnOn, "t2") << isMrFirst;
      EXPECT_TRUE(core::sameGrid(value.labels[0].labels.get()->voxels->geometry(), of))
          << isMrFirst;
    }
  // A cut of it does not tell.
  auto value = presenters::buildCase("ear", m_sources, {});
  presenters::addParts(value, mr, {});
  presenters::addParts(
      value,
      labelsOn(reordered(onLattice(grid, {0, 0, 0}, {9, 8, 6}), {0, 1, 2}, {true, true, false})),
      {});
  EXPECT_FALSE(value.labels.at(0).drawnOn);
}

// A box without air and soft tissue shows no unit; that of the whole image is known.
TEST_F(CaseBuilder, ABoxHasTheUnitOfItsImage)
{
  const core::GridGeometry grid({40, 40, 40}, Vector3d::Ones(), Vector3d::Zero());
  auto ct = std::make_shared<volume::Volume<std::int16_t>>(grid, std::int16_t{0});
  const auto noise = [](int i, int j, int k, int range)
  { return (i * 7919 + j * 104729 + k * 1299709) % range; };
  for (int k = 0; k < 40; ++k)
    for (int j = 0; j < 40; ++j)
      for (int i = 0; i < 40; ++i)
        ct->at(i, j, k) = static_cast<std::int16_t>(i < 14   ? -1000 + noise(i, j, k, 20)
                                                    : i < 26 ? 30 + noise(i, j, k, 20)
                                                             : 100 + noise(i, j, k, 1500));
  imaging::writeVolume(m_folder / "head.nrrd", *ct);
  imaging::SeriesDescription series;
  series.studyUid = imaging::deterministicUid(2, "head");
  series.seriesUid = imaging::deterministicUid(1, "head");
  series.frameOfReferenceUid = imaging::deterministicUid(3, "head");
  imaging::writeDicomSeries(m_folder / "head", volume::IntensityVolume(ct), series);
  for (const char* file : {"head.nrrd", "head"})
    for (const bool isWhole : {true, false})
    {
      m_sources.ct = m_folder / file;
      m_sources.roi.reset();
      if (!isWhole)
        m_sources.roi = core::PatientBox(Vector3d(27, 2, 2), Vector3d(38, 38, 38));
      const auto value = presenters::buildCase("ear", m_sources, {});
      EXPECT_EQ(value.ct.geometry.dims()[0] < 40, !isWhole);
      EXPECT_EQ(value.iso, 300.0) << file << isWhole;
      EXPECT_TRUE(presenters::calibratedScale(value).calibrated) << file << isWhole;
    }
}

// A file that is a box: bone alone shows no unit, and is believed where this program wrote it; soft
// tissue beside bone does.
TEST_F(CaseBuilder, AFileOfABoxHasTheUnitThatItStatesOrShows)
{
  const core::GridGeometry grid({40, 40, 40}, Vector3d::Ones(), Vector3d::Zero());
  const auto noise = [](int i, int j, int k, int range)
  { return (i * 7919 + j * 104729 + k * 1299709) % range; };
  auto voxels = std::make_shared<volume::Volume<std::int16_t>>(grid, std::int16_t{0});
  const auto caseOf = [&](bool isBone, bool isStated)
  {
    for (int k = 0; k < 40; ++k)
      for (int j = 0; j < 40; ++j)
        for (int i = 0; i < 40; ++i)
          voxels->at(i, j, k) = static_cast<std::int16_t>(
              isBone || i > 32 ? 100 + noise(i, j, k, 1500)
                               : -40 + noise(i, j, k, 81) + noise(j, k, i, 81)); // peak at 40
    imaging::writeVolume(m_folder / "box.nrrd", volume::IntensityVolume(voxels), {}, isStated);
    presenters::CaseSources sources;
    sources.ct = m_folder / "box.nrrd";
    return presenters::buildCase("ear", sources, {});
  };
  const auto says = [](const scene::Case& value, const char* words)
  {
    return std::any_of(value.ct.notes.begin(), value.ct.notes.end(),
                       [words](const auto& note) { return note.find(words) != std::string::npos; });
  };
  for (const bool isBone : {true, false})
  {
    const auto stated = caseOf(isBone, true);
    EXPECT_EQ(stated.iso, 300.0);
    EXPECT_TRUE(presenters::calibratedScale(stated).calibrated);
    EXPECT_EQ(stated.ct.modality, scene::Modality::Ct);
  }
  const auto bone = caseOf(true, false);
  EXPECT_FALSE(presenters::calibratedScale(bone).calibrated);
  EXPECT_GT(bone.iso, 400.0);
  EXPECT_TRUE(says(bone, "Of a small part of a CT this may be wrong"));
  EXPECT_TRUE(presenters::calibratedScale(caseOf(false, false)).calibrated);
}

// Cone beam states Hounsfield units, too, and has others: a helical CT has them, and what this
// program exported.
TEST_F(CaseBuilder, ADicomSeriesOfABoxHasTheUnitThatAHelicalCtStates)
{
  const core::GridGeometry grid({40, 40, 40}, Vector3d::Ones(), Vector3d::Zero());
  const auto noise = [](int i, int j, int k, int range)
  { return (i * 7919 + j * 104729 + k * 1299709) % range; };
  const auto caseOf = [&](const std::string& maker, bool isHelical, std::int16_t fat)
  {
    auto voxels = std::make_shared<volume::Volume<std::int16_t>>(grid, fat);
    for (int k = 0; k < 40; ++k)
      for (int j = 0; j < 40; ++j)
        for (int i = 0; i < 40; ++i)
          if (noise(i, j, k, 400) > 0)
            voxels->at(i, j, k) = static_cast<std::int16_t>(100 + noise(i, j, k, 1500));
    imaging::SeriesDescription series;
    series.studyUid = "1.2.3";
    series.seriesUid = "1.2.3.4";
    series.frameOfReferenceUid = "1.2.3.9";
    const auto folder = m_folder / (maker + (isHelical ? "helical" : "") + std::to_string(fat));
    imaging::writeDicomSeries(
        folder,
        volume::IntensityVolume(std::shared_ptr<const volume::Volume<std::int16_t>>(voxels)),
        series);
    for (const auto& entry : std::filesystem::directory_iterator(folder))
    {
      std::ifstream in(entry.path(), std::ios::binary);
      std::string bytes((std::istreambuf_iterator<char>(in)), {});
      in.close();
      const std::string own = "Petrous ";
      bytes.replace(bytes.find(own), own.size(), maker);
      const std::string number("\x18\x00\x20\x10LO", 6);
      const std::string options("\x18\x00\x22\x00"
                                "CS\x0c\x00"
                                "HELICAL MODE",
                                20);
      bytes.insert(bytes.find(number), isHelical ? options : std::string());
      std::ofstream(entry.path(), std::ios::binary) << bytes;
    }
    presenters::CaseSources sources;
    sources.ct = folder;
    return presenters::buildCase("ear", sources, {});
  };
  const auto says = [](const scene::Case& value, const char* words)
  {
    return std::any_of(value.ct.notes.begin(), value.ct.notes.end(),
                       [words](const auto& note) { return note.find(words) != std::string::npos; });
  };
  for (const bool isOwn : {true, false})
  {
    const auto stated = caseOf(isOwn ? "Petrous " : "Another ", !isOwn, -60);
    EXPECT_EQ(stated.iso, 300.0) << isOwn;
    EXPECT_TRUE(presenters::calibratedScale(stated).calibrated) << isOwn;
    EXPECT_TRUE(says(stated, "The file states that its values are Hounsfield units")) << isOwn;
  }
  const auto unknown = caseOf("Another ", false, -60);
  EXPECT_FALSE(presenters::calibratedScale(unknown).calibrated);
  EXPECT_GT(unknown.iso, 400.0);
  // Nothing below zero, as of a CT that another program moved to begin at air.
  const auto moved = caseOf("Another ", true, 100);
  EXPECT_FALSE(presenters::calibratedScale(moved).calibrated);
}

TEST_F(CaseBuilder, PutsTheSurfaceOfAnMrWhereTissueBegins)
{
  // Air of 10, a head of 400 with a skull of 20 and fluid of 1500 in it.
  const core::GridGeometry grid({40, 40, 40}, Vector3d::Constant(1.0), Vector3d::Zero());
  auto scan = std::make_shared<volume::Volume<std::uint16_t>>(grid, std::uint16_t{10});
  for (int k = 0; k < 40; ++k)
    for (int j = 0; j < 40; ++j)
      for (int i = 0; i < 40; ++i)
      {
        const double r = Vector3d(i - 20, j - 20, k - 20).norm();
        if (r < 17.0)
          scan->at(i, j, k) = r > 14.0 && r < 15.0 ? 20 : r < 6.0 ? 1500 : 400;
      }
  imaging::writeVolume(m_folder / "t2.nrrd", *scan);
  presenters::CaseSources sources;
  sources.ct = m_folder / "t2.nrrd";
  const auto unstated = presenters::buildCase("ear", sources, {});
  EXPECT_EQ(unstated.ct.modality, scene::Modality::Unknown);
  const auto says = [](const scene::Case& value, const char* words)
  {
    return std::any_of(value.ct.notes.begin(), value.ct.notes.end(),
                       [words](const auto& note) { return note.find(words) != std::string::npos; });
  };
  EXPECT_TRUE(says(unstated, "does not say whether it is a CT or an MR"));

  sources.modality = scene::Modality::Mr;
  const auto mr = presenters::buildCase("ear", sources, {});
  EXPECT_EQ(mr.ct.modality, scene::Modality::Mr);
  EXPECT_GT(mr.iso, 20.0);
  EXPECT_LT(mr.iso, 400.0);
  EXPECT_GT(mr.denseBone, mr.iso);
  EXPECT_TRUE(says(mr, "An MR"));
  EXPECT_FALSE(says(mr, "surface of bone"));
  const auto display = presenters::displayOf(mr);
  EXPECT_FALSE(display.hounsfield);
  EXPECT_EQ(display.text(400.0).find("HU"), std::string::npos);
  EXPECT_GE(display.bone.level - 0.5 * display.bone.width, mr.ct.range.min);
  EXPECT_LE(display.bone.level + 0.5 * display.bone.width, mr.ct.range.max);

  // What it is outlives the case on disk.
  EXPECT_EQ(scene::fromManifest(scene::toManifest(mr), "case").ct.modality, scene::Modality::Mr);
  EXPECT_EQ(scene::fromManifest(scene::toManifest(unstated), "case").ct.modality,
            scene::Modality::Unknown);
}

TEST_F(CaseBuilder, TellsImagesOfOneFrameOfReferenceWithoutItsUid)
{
  const auto scan = softTissue(core::GridGeometry({8, 8, 8}, Vector3d::Ones(), Vector3d::Zero()));
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

// What Petrous wrote for two cases may be of two patients; beside an ID of a hospital it says
// nothing.
TEST_F(CaseBuilder, AsksBeforeAnMrOfAnotherPseudonymJoins)
{
  const std::string one = "PETROUS-0000000000000001", two = "PETROUS-0000000000000002";
  const auto salted = [](const std::string& hash) { return "salt " + hash; };
  for (const bool isSaved : {false, true})
    for (const auto& [ofCt, ofMr, isRefused] :
         {std::tuple(std::pair(one, "Petrous^left ear"), std::pair(two, "Petrous^left ear"), true),
          std::tuple(std::pair(one, "Petrous^left ear"), std::pair(one, "Petrous^now"), false),
          std::tuple(std::pair(one, "Alpha^Ann"), std::pair(two, "Beta^Eve"), true),
          std::tuple(std::pair(one, "Petrous^x"), std::pair(std::string("4711"), "Doe^J"), false),
          std::tuple(std::pair(one, "Petrous^x"), std::pair(std::string(), ""), false)})
    {
      m_sources.ct = writeSeriesOf("ct", ofCt.first, ofCt.second).path;
      auto value = presenters::buildCase("ear", m_sources, {});
      presenters::PartSources parts;
      if (isSaved)
      {
        scene::saltIdentity(value.ct, salted);
        value = scene::fromManifest(scene::toManifest(value), "case");
        parts.salted = salted;
      }
      parts.mr = {writeSeriesOf("mr", ofMr.first, ofMr.second)};
      const std::string what = ofCt.second + std::string(", ") + ofMr.second;
      if (isRefused)
        EXPECT_THROW(presenters::addParts(value, parts, {}), presenters::OtherPatient) << what;
      else
        EXPECT_NO_THROW(presenters::addParts(value, parts, {})) << what;
      parts.mr[0].isOtherPatient = true;
      parts.mr[0].name = "again";
      EXPECT_NO_THROW(presenters::addParts(value, parts, {})) << what;
    }
}

TEST_F(CaseBuilder, KeepsWhatKnowsThePatientsNameWithoutAccentsAndJoined)
{
  const auto salted = [](const std::string& hash) { return "salt " + hash; };
  const std::pair<std::string, std::vector<std::string>> patients[] = {
      {"M\u00fcller-K\u00f6nigsmark^Hildegunde",
       {"Muller", "Konigsmark", "K\u00f6nigsmark", "Mueller 2", "Muellers Zyste", "tumorkonigsmark",
        "4711b"}},
      {"\u0141ukasiewicz^\u017baneta", {"Lukasiewicz", "ear of zaneta"}},
      {"van der Meer^Jan-Willem", {"vanderMeer", "JanWillem", "Meer"}},
      {"MUELLER^HANS", {"MuellerHans", "M\u00fcller"}}};
  for (const auto& [patient, texts] : patients)
  {
    m_sources.ct = writeSeriesOf("ct", "4711", patient).path;
    auto value = presenters::buildCase("ear", m_sources, {});
    EXPECT_LE(value.ct.patient.nameParts.size(), 17u) << "6 words, 8 folded ones, 3 of the whole";
    for (const bool isSaved : {false, true})
    {
      if (isSaved)
      {
        scene::saltIdentity(value.ct, salted);
        value = scene::fromManifest(scene::toManifest(value), "case");
      }
      const presenters::IdentityText identity(value, salted);
      EXPECT_TRUE(identity.knowsName());
      for (const std::string& text : texts)
        EXPECT_TRUE(identity.mayIdentify(text)) << patient << ": " << text;
      for (const char* text : {"Kowalski", "left ear", "van", "4712b", "tumors"})
        EXPECT_FALSE(identity.mayIdentify(text)) << patient << ": " << text;
    }
  }
}

// A scanner that writes capitals without accents, and one that has a second given name.
TEST_F(CaseBuilder, JoinsAnMrWhoseScannerSpellsTheNameOtherwise)
{
  const auto write = [&](const std::string& file, const std::string& id, const std::string& name,
                         const std::string& birth)
  {
    std::filesystem::remove_all(m_folder / file);
    const PartSource source = writeSeriesOf(file, id, name);
    for (const auto& entry : std::filesystem::directory_iterator(source.path))
    {
      std::ifstream in(entry.path(), std::ios::binary);
      std::string bytes{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
      const std::string none("\x10\0\x30\0DA\0\0", 8); // (0010,0030) without a value
      const std::size_t at = bytes.find(none);
      if (at == std::string::npos || birth.size() != 8)
        throw std::logic_error("no date of birth to write");
      bytes[at + 6] = 8;
      bytes.insert(at + none.size(), birth);
      std::ofstream(entry.path(), std::ios::binary) << bytes;
    }
    return source;
  };
  struct Mr
  {
    std::string id, name, birth;
    std::string differing; // empty: it joins
  };
  const auto salted = [](const std::string& hash) { return "salt " + hash; };
  const std::string born = "19610412";
  const auto check = [&](const std::string& patient, const std::vector<Mr>& mrs)
  {
    m_sources.ct = write("ct", "4711", patient, born).path;
    auto value = presenters::buildCase("ear", m_sources, {});
    for (const bool isSaved : {false, true})
    {
      presenters::PartSources parts;
      if (isSaved)
      {
        scene::saltIdentity(value.ct, salted);
        value = scene::fromManifest(scene::toManifest(value), "case");
        parts.salted = salted;
      }
      for (const Mr& mr : mrs)
      {
        auto copy = value;
        parts.mr = {write("mr", mr.id, mr.name, mr.birth)};
        const auto failures = presenters::addSoundParts(copy, parts, {});
        const std::string found = failures.empty() ? "" : failures[0].differing;
        EXPECT_EQ(failures.empty(), mr.differing.empty()) << patient << ", " << mr.name;
        EXPECT_EQ(found, mr.differing) << patient << ", " << mr.name << ", " << mr.birth;
        EXPECT_EQ(copy.mr.size(), mr.differing.empty() ? 1u : 0u);
      }
    }
  };
  check("Lef\u00e8vre^H\u00e9l\u00e8ne",
        {{"4711", "LEFEVRE^HELENE", born, ""},
         {"4711", "LEFEVRE^HELENE MARIE", born, ""},
         {"4711", "LEFEVRE", born, ""},
         {"4711", "LEFEVRE^MARIE", born, "patient name"},
         {"4711", "LEFEVRE^HELENE", "19610413", "patient name"},
         {"4712", "LEFEVRE^HELENE", born, "patient ID and patient name"}});
  check("LEFEVRE^HELENE MARIE", {{"4711", "Lef\u00e8vre^H\u00e9l\u00e8ne", born, ""},
                                 {"4711", "Lef\u00e8vre^Marie Anne", born, "patient name"}});
  check("van der Meer^Jan-Willem", {{"4711", "VANDERMEER^JANWILLEM", born, ""},
                                    {"4711", "MEER^JAN", born, ""},
                                    {"4711", "MEYER^JAN", born, "patient name"}});
}

TEST_F(CaseBuilder, NamesNoMaskOfAFolderByThePatient)
{
  const core::GridGeometry grid({8, 8, 8}, Vector3d::Ones(), Vector3d::Zero());
  const auto write = [&](const std::string& folder, const std::vector<std::string>& names)
  {
    std::filesystem::create_directory(m_folder / folder);
    for (const std::string& name : names)
    {
      auto voxels = volume::makeZeroVolume<std::uint16_t>(grid);
      voxels->at(3, 3, 3) = 1;
      imaging::writeLabelFile(m_folder / folder / (name + ".nii"),
                              volume::makeLabelMap(voxels, {}));
    }
    m_sources.parts.labels = {{"", m_folder / folder}};
  };
  const auto built = [&]
  {
    std::pair<std::set<std::string>, std::string> result;
    const auto value = presenters::buildCase("ear", m_sources, {});
    for (const auto& part : value.labels)
      for (const auto& structure : part.structures)
        result.first.insert(structure.name);
    result.second = scene::toManifest(value);
    return result;
  };
  m_sources.ct = writeSeriesOf("ct", "AB471108", "M\u00fcller^Hans").path;
  write("masks", {"facial_nerve", "Muller_Hans_cochlea", "stapes_19610412", "malleus_muellerhans",
                  "incus_AB471108", "Gyrus_Frobnicus"});
  const auto [names, manifest] = built();
  EXPECT_EQ(names, (std::set<std::string>{"facial_nerve", "cochlea", "stapes", "malleus", "incus",
                                          "Gyrus_Frobnicus"}));
  for (const char* secret : {"Muller", "muellerhans", "19610412", "471108"})
    EXPECT_EQ(manifest.find(secret), std::string::npos) << secret;
  EXPECT_NE(manifest.find("5 words of the files' names"), std::string::npos);

  // Where nothing is known of the name, its form is all there is.
  m_sources.ct = m_folder / "ct.nrrd";
  write("others", {"facial_nerve", "cochlea", "stapes", "Muller_Hans"});
  const auto [unknown, text] = built();
  EXPECT_EQ(unknown, (std::set<std::string>{"facial_nerve", "cochlea", "stapes", "structure"}));
  EXPECT_EQ(text.find("Muller"), std::string::npos);
}

TEST_F(CaseBuilder, AsksBeforeAnMrOfAnotherPatientJoins)
{
  m_sources.ct = writeSeriesOf("ct", "4711", "Doe^Jane").path;
  auto value = presenters::buildCase("ear", m_sources, {});
  const auto before = scene::toManifest(value);
  const auto add = [&](PartSource source)
  {
    presenters::PartSources parts;
    parts.mr = {std::move(source)};
    presenters::addParts(value, parts, {});
  };
  PartSource other = writeSeriesOf("T1", "4712", "Roe^Jane");
  try
  {
    add(other);
    FAIL() << "joined";
  }
  catch (const presenters::OtherPatient& error)
  {
    const std::string words = error.what();
    EXPECT_EQ(error.fault(), core::Fault::Refused);
    EXPECT_NE(words.find("--other-patient"), std::string::npos) << words;
    EXPECT_NE(words.find("(what differs: patient ID and patient name)"), std::string::npos)
        << words;
    EXPECT_EQ(error.differing, "patient ID and patient name");
    for (const char* secret : {"4711", "4712", "Doe", "Roe"})
      EXPECT_EQ(words.find(secret), std::string::npos) << words;
  }
  EXPECT_EQ(scene::toManifest(value), before);
  presenters::PartSources both;
  both.mr = {other, writeSeriesOf("T2", "4711", "DOE JANE^^^")}; // spelled otherwise
  const auto failures = presenters::addSoundParts(value, both, {});
  ASSERT_EQ(failures.size(), 1u);
  EXPECT_TRUE(failures[0].isOtherPatient);
  EXPECT_EQ(failures[0].differing, "patient ID and patient name");
  both.mr = {writeSeriesOf("T0", "4712", "Doe^Jane"), writeSeriesOf("T9", "4711", "Roe^Jane")};
  scene::Case another = value;
  const auto each = presenters::addSoundParts(another, both, {});
  ASSERT_EQ(each.size(), 2u);
  EXPECT_EQ(each[0].differing, "patient ID");
  EXPECT_EQ(each[1].differing, "patient name");
  ASSERT_EQ(value.mr.size(), 1u);
  EXPECT_TRUE(value.mr[0].notes.empty());
  add(writeSeriesOf("T3", "ANONYMOUS", "")); // states none
  other.isOtherPatient = true;
  add(other);
  ASSERT_EQ(value.mr.size(), 3u);
  ASSERT_EQ(value.mr[2].notes.size(), 1u);
  EXPECT_NE(value.mr[2].notes[0].find("added as asked"), std::string::npos);
  EXPECT_EQ(scene::toManifest(value).find("patient"), scene::toManifest(value).find("patient's"))
      << "no hash without a salt";

  // A stored case has salted hashes.
  const auto salted = [](const std::string& hash) { return "salt " + hash; };
  value.mr.clear();
  scene::saltIdentity(value.ct, salted);
  value = scene::fromManifest(scene::toManifest(value), "case");
  presenters::PartSources parts;
  parts.salted = salted;
  other.isOtherPatient = false;
  parts.mr = {other};
  EXPECT_THROW(presenters::addParts(value, parts, {}), presenters::OtherPatient);
  parts.mr = {{"T2", m_folder / "T2"}};
  presenters::addParts(value, parts, {});
  EXPECT_EQ(value.mr.size(), 1u);
}

TEST_F(CaseBuilder, AsksBeforeStructuresOfAnotherPatientJoin)
{
  const auto scan = softTissue(core::GridGeometry({8, 8, 8}, Vector3d::Ones(), Vector3d::Zero()));
  imaging::SeriesDescription series;
  series.patientId = "4711";
  series.patientName = "Doe^Jane";
  series.studyUid = "1.2.3";
  series.seriesUid = "1.2.3.4";
  series.frameOfReferenceUid = "1.2.3.9";
  imaging::writeDicomSeries(m_folder / "ct", volume::IntensityVolume(scan), series);
  m_sources.ct = m_folder / "ct";
  const auto write = [&](const std::string& file, const std::string& id, const std::string& name)
  {
    auto voxels = std::make_shared<volume::Volume<std::uint16_t>>(scan->geometry());
    voxels->at(4, 4, 4) = 1;
    imaging::SegmentationDescription segmentation;
    segmentation.patientId = id;
    segmentation.patientName = name;
    segmentation.studyUid = "1.2.3";
    segmentation.seriesUid = "1.2.3.5";
    segmentation.frameOfReferenceUid = "1.2.3.9";
    imaging::SegmentationDescription::Segment segment;
    segment.index = 1;
    segment.label = file;
    segmentation.segments = {segment};
    imaging::writeDicomSegmentation(m_folder / file, {volume::makeLabelMap(voxels, {})},
                                    segmentation);
    return PartSource{"", m_folder / file};
  };
  const auto salted = [](const std::string& hash) { return "salt " + hash; };
  for (const bool isStored : {false, true})
  {
    auto value = presenters::buildCase("ear", m_sources, {});
    if (isStored)
    {
      scene::saltIdentity(value.ct, salted);
      value = scene::fromManifest(scene::toManifest(value), "case");
    }
    presenters::PartSources parts;
    if (isStored)
      parts.salted = salted;
    PartSource other = write("incus", "4712", "Roe^Jane");
    parts.labels = {other, write("malleus", "4711", "DOE JANE"), write("stapes", "ANONYMOUS", "")};
    const auto failures = presenters::addSoundParts(value, parts, {});
    ASSERT_EQ(failures.size(), 1u);
    EXPECT_TRUE(failures[0].isOtherPatient);
    EXPECT_EQ(failures[0].source.path, other.path);
    for (const char* secret : {"4711", "4712", "Doe", "Roe"})
      EXPECT_EQ(failures[0].why.find(secret), std::string::npos) << failures[0].why;
    ASSERT_EQ(value.labels.size(), 2u);
    EXPECT_TRUE(value.labels[0].notes.empty());
    other.isOtherPatient = true;
    parts.labels = {other};
    presenters::addParts(value, parts, {});
    ASSERT_EQ(value.labels.size(), 3u);
    ASSERT_EQ(value.labels[2].notes.size(), 1u);
    EXPECT_NE(value.labels[2].notes[0].find("added as asked"), std::string::npos);
  }
}

TEST_F(CaseBuilder, RefusesAnImageThatShowsNothing)
{
  const auto refusal = [this]
  {
    try
    {
      presenters::buildCase("ear", m_sources, {});
    }
    catch (const core::InvalidParameter& error)
    {
      return std::string(error.what());
    }
    return std::string();
  };
  const core::GridGeometry grid({16, 12, 10}, Vector3d::Ones(), Vector3d::Zero());
  for (const int value : {0, 700, -1000})
  {
    volume::Volume<std::int16_t> ct(grid, static_cast<std::int16_t>(value));
    imaging::writeVolume(m_folder / "ct.nrrd", ct);
    EXPECT_NE(refusal().find("has the value " + std::to_string(value)), std::string::npos)
        << refusal();
    ct.at(3, 4, 5) = static_cast<std::int16_t>(value + 1);
    imaging::writeVolume(m_folder / "ct.nrrd", ct);
    EXPECT_EQ(refusal(), "");
  }
}

TEST_F(CaseBuilder, NotesFewSlicesAndValuesBeyondAnyCt)
{
  const auto isNoted = [this](int slices, float value, const std::string& text)
  {
    const core::GridGeometry grid({16, 16, slices}, Vector3d(1, 1, 0.5), Vector3d::Zero());
    volume::Volume<float> ct(grid, -1000.0f);
    for (int j = 4; j < 12; ++j)
      for (int i = 4; i < 12; ++i)
        ct.at(i, j, 1) = 40.0f;
    ct.at(6, 6, 1) = value;
    imaging::writeVolume(m_folder / "ct.nrrd", ct);
    const auto built = presenters::buildCase("ear", m_sources, {});
    return std::any_of(built.ct.notes.begin(), built.ct.notes.end(),
                       [&text](const std::string& note)
                       { return note.find(text) != std::string::npos; });
  };
  EXPECT_TRUE(isNoted(9, 1200.0f, "only 9 slices, which cover 4.5 mm"));
  EXPECT_FALSE(isNoted(10, 1200.0f, "slices, which cover"));
  const std::string beyond = "beyond those of any CT";
  EXPECT_TRUE(isNoted(12, 1e30f, beyond));
  EXPECT_TRUE(isNoted(12, -1e30f, beyond));
  EXPECT_TRUE(isNoted(12, 100001.0f, beyond));
  EXPECT_TRUE(isNoted(12, -10001.0f, beyond));
  EXPECT_FALSE(isNoted(12, 30000.0f, beyond)) << "metal, on an extended scale";
}

TEST_F(CaseBuilder, CallsNothingHounsfieldUnitsThatTheFileDoesNot)
{
  // air and soft tissue as in a CT
  auto scan = std::make_shared<volume::Volume<std::int16_t>>(
      core::GridGeometry({24, 24, 24}, Vector3d::Ones(), Vector3d::Zero()), std::int16_t{-1000});
  for (int k = 6; k < 18; ++k)
    for (int j = 6; j < 18; ++j)
      for (int i = 6; i < 18; ++i)
        scan->at(i, j, k) = i < 8 ? 1200 : 40;
  const auto build = [&](const std::string& type, const std::string& modality,
                         scene::Modality wanted = scene::Modality::Unknown)
  {
    const auto folder = m_folder / ("ct" + type + modality);
    imaging::SeriesDescription series;
    series.studyUid = "1.2.3";
    series.seriesUid = "1.2.3.4";
    series.frameOfReferenceUid = "1.2.3.9";
    series.rescaleType = type;
    imaging::writeDicomSeries(
        folder, volume::IntensityVolume(std::shared_ptr<const volume::Volume<std::int16_t>>(scan)),
        series);
    for (const auto& entry : std::filesystem::directory_iterator(folder))
    {
      std::ifstream in(entry.path(), std::ios::binary);
      std::string bytes((std::istreambuf_iterator<char>(in)), {});
      const std::string stated("\x08\x00\x60\x00"
                               "CS\x02\x00"
                               "CT",
                               10);
      bytes.replace(bytes.find(stated) + 8, 2, modality);
      std::ofstream(entry.path(), std::ios::binary) << bytes;
    }
    m_sources.ct = folder;
    m_sources.modality = wanted;
    return presenters::buildCase("ear", m_sources, {});
  };
  const auto notesOf = [](const scene::Case& value)
  {
    std::string all;
    for (const std::string& note : value.ct.notes)
      all += note + "\n";
    return all;
  };
  EXPECT_TRUE(presenters::displayOf(build("HU", "CT")).hounsfield);
  const auto iodine = build("MGML", "CT");
  EXPECT_FALSE(presenters::displayOf(iodine).hounsfield);
  EXPECT_NE(notesOf(iodine).find("type MGML"), std::string::npos) << notesOf(iodine);
  const auto pet = build("HU", "PT");
  EXPECT_FALSE(presenters::displayOf(pet).hounsfield);
  EXPECT_NE(notesOf(pet).find("modality PT"), std::string::npos) << notesOf(pet);
  EXPECT_EQ(notesOf(pet).find("does not say whether"), std::string::npos) << notesOf(pet);
  EXPECT_TRUE(presenters::displayOf(build("MGML", "CT", scene::Modality::Ct)).hounsfield);
  // Unspecified: programs that write CTs without knowing say so.
  const auto unspecified = build("US", "CT");
  EXPECT_FALSE(presenters::displayOf(unspecified).hounsfield);
  EXPECT_NE(notesOf(unspecified).find("unspecified type (US)"), std::string::npos)
      << notesOf(unspecified);
  EXPECT_EQ(unspecified.iso, 300.0) << "its air and soft tissue are those of a CT";
  const auto asked = build("US", "CT", scene::Modality::Ct);
  EXPECT_TRUE(presenters::displayOf(asked).hounsfield);
  EXPECT_EQ(notesOf(asked).find("unspecified"), std::string::npos) << notesOf(asked);
}

TEST_F(CaseBuilder, AsksWhichSideIsLeft)
{
  const core::GridGeometry grid({16, 12, 10}, Vector3d::Ones(), Vector3d(-8, 2, 3));
  auto ct = std::make_shared<volume::Volume<std::int16_t>>(grid, std::int16_t{-1000});
  ct->at(7, 6, 5) = 1200;
  imaging::writeVolume(m_folder / "ct.nii", *ct);
  {
    std::fstream file(m_folder / "ct.nii", std::ios::binary | std::ios::in | std::ios::out);
    file.seekp(252); // qform_code, sform_code
    file.write("\0\0\0\0", 4);
  }
  m_sources.ct = m_folder / "ct.nii";
  try
  {
    presenters::buildCase("ear", m_sources, {});
    FAIL() << "guessed";
  }
  catch (const presenters::ImageSideUnclear& error)
  {
    EXPECT_EQ(error.fault(), core::Fault::BadInput);
    EXPECT_NE(std::string(error.what()).find("--ct-frame"), std::string::npos);
  }
  m_sources.assumeRas = true;
  const auto ras = presenters::buildCase("ear", m_sources, {});
  m_sources.assumeRas = false;
  const auto lps = presenters::buildCase("ear", m_sources, {});
  EXPECT_EQ(ras.ct.provenance.assumedRas, true);
  EXPECT_EQ(lps.ct.provenance.assumedRas, false);
  m_sources.ct = m_folder / "ct.nrrd";
  EXPECT_FALSE(presenters::buildCase("ear", m_sources, {}).ct.provenance.assumedRas) << "stated";
  const Vector3d there = ras.ct.geometry.patientFromVoxel({7, 6, 5});
  EXPECT_TRUE(lps.ct.geometry.patientFromVoxel({7, 6, 5}).isApprox(
      Vector3d(-there[0], -there[1], there[2])));
}

// The same image whose file calls its millimetres micrometres.
TEST_F(CaseBuilder, AnImageWhoseUnitMakesNoSenseIsAskedAbout)
{
  const core::GridGeometry grid = presenters::buildCase("ear", m_sources, {}).ct.geometry;
  std::ifstream in(m_folder / "ct.nrrd", std::ios::binary);
  std::string bytes((std::istreambuf_iterator<char>(in)), std::istreambuf_iterator<char>());
  const std::string said = "\"mm\" \"mm\" \"mm\"";
  ASSERT_NE(bytes.find(said), std::string::npos);
  bytes.replace(bytes.find(said), said.size(), "\"um\" \"um\" \"um\"");
  m_sources.ct = m_folder / "um.nrrd";
  std::ofstream(m_sources.ct, std::ios::binary) << bytes;
  try
  {
    presenters::buildCase("ear", m_sources, {});
    ADD_FAILURE() << "was read";
  }
  catch (const presenters::ImageUnitUnclear& unclear)
  {
    EXPECT_TRUE(unclear.doubt.isStated);
    EXPECT_EQ(std::count(unclear.doubt.likely.begin(), unclear.doubt.likely.end(), 1.0), 1);
    EXPECT_NE(std::string(unclear.what()).find("--ct-unit"), std::string::npos) << unclear.what();
  }
  m_sources.unit = 1.0;
  scene::Case value = presenters::buildCase("ear", m_sources, {});
  EXPECT_TRUE(core::sameGrid(value.ct.geometry, grid));
  presenters::PartSources parts;
  parts.mr = {{"T2", m_sources.ct}};
  const auto failures = presenters::addSoundParts(value, parts, {});
  ASSERT_EQ(failures.size(), 1U);
  EXPECT_FALSE(failures[0].unitDoubt.likely.empty()) << failures[0].why;
  parts.mr[0].unit = 1.0;
  EXPECT_TRUE(presenters::addSoundParts(value, parts, {}).empty());
}

// Those that the readers of files know, none called by another's name.
TEST_F(CaseBuilder, NamesEveryUnitOfLength)
{
  for (const auto& [unit, name] :
       {std::pair(1e-6, "nm"), std::pair(1e-3, "\xc2\xb5m"), std::pair(1.0, "mm"),
        std::pair(10.0, "cm"), std::pair(25.4, "inch"), std::pair(1e3, "m")})
    EXPECT_EQ(presenters::unitName(unit), name);
  EXPECT_EQ(presenters::unitName(2.0), "2 mm");
  for (const auto& [mm, text] :
       {std::pair(153600.4, "153600"), std::pair(1536.0, "1536"), std::pair(15.36, "15.4"),
        std::pair(0.0154, "0.0154"), std::pair(2e-5, "0.000020")})
    EXPECT_EQ(presenters::lengthText(mm), text);
  const imaging::UnitDoubt doubt{1.0, false, 153600.0, {1e-3}};
  const presenters::ImageUnitUnclear unclear("ear.nii", doubt, "--ct-unit");
  EXPECT_EQ(std::string(unclear.what()).find("ear.nii: is 153600 mm long"), 0U) << unclear.what();
  EXPECT_NE(std::string(unclear.what()).find("154 mm if its numbers are in \xc2\xb5m"),
            std::string::npos)
      << unclear.what();
}

// A CT without a header and what was drawn on it, exported by the same tool.
TEST_F(CaseBuilder, PartsOfAHeaderlessExportLieWhereTheCtDoes)
{
  const core::GridGeometry grid({16, 12, 10}, Vector3d::Ones(), Vector3d(-8, 2, 3));
  auto ct = std::make_shared<volume::Volume<std::int16_t>>(grid, std::int16_t{-1000});
  ct->at(7, 6, 5) = 1200;
  const auto dropPlace = [this](const std::string& name)
  {
    std::fstream file(m_folder / name, std::ios::binary | std::ios::in | std::ios::out);
    file.seekp(252); // qform_code, sform_code
    file.write("\0\0\0\0", 4);
  };
  const auto writeLabels = [&](const std::string& name, const core::GridGeometry& on)
  {
    auto voxels = volume::makeZeroVolume<std::uint16_t>(on);
    voxels->at(3, 2, 1) = 1;
    std::filesystem::create_directories((m_folder / name).parent_path());
    imaging::writeLabelFile(m_folder / name, volume::makeLabelMap(voxels, {}));
    dropPlace(name);
  };
  imaging::writeVolume(m_folder / "ct.nii", *ct);
  dropPlace("ct.nii");
  std::filesystem::copy_file(m_folder / "ct.nii", m_folder / "mr.nii");
  writeLabels("incus.nii", grid);
  writeLabels("masks/incus.nii", grid);
  const core::GridGeometry other({8, 6, 5}, Vector3d::Constant(2.0), Vector3d::Zero());
  writeLabels("stapes.nii", other);
  writeLabels("more/stapes.nii", other);
  m_sources.ct = m_folder / "ct.nii";
  for (const bool isRas : {false, true})
  {
    m_sources.assumeRas = isRas;
    // By nifti1.h the place of voxel (i, j, k) is (i, j, k) of unit axes; x, y to the right and
    // front are -x, -y in LPS.
    const Vector3d there = isRas ? Vector3d(-3, -2, 1) : Vector3d(3, 2, 1);
    for (const char* labels : {"incus.nii", "masks"})
    {
      auto value = presenters::buildCase("ear", m_sources, {});
      presenters::PartSources parts;
      parts.labels = {{"", m_folder / labels}};
      presenters::addParts(value, parts, {});
      ASSERT_EQ(value.labels.size(), 1u);
      const auto& map = value.labels[0];
      EXPECT_TRUE(map.labels.get()->voxels->geometry().patientFromVoxel({3, 2, 1}).isApprox(there))
          << labels << isRas;
      EXPECT_EQ(map.drawnOn, std::string()) << "the CT's grid";
      EXPECT_EQ(map.provenance.assumedRas, isRas);
      EXPECT_TRUE(std::any_of(map.notes.begin(), map.notes.end(),
                              [](const std::string& note)
                              { return note.find("which side") != std::string::npos; }));
    }
    // Nothing says how these count.
    auto value = presenters::buildCase("ear", m_sources, {});
    presenters::PartSources parts;
    parts.mr = {{"t2", m_folder / "mr.nii"}};
    parts.labels = {{"", m_folder / "stapes.nii"}, {"", m_folder / "more"}};
    const auto failures = presenters::addSoundParts(value, parts, {});
    ASSERT_EQ(failures.size(), 3u);
    for (const auto& failure : failures)
      EXPECT_TRUE(failure.isSideUnclear) << failure.why;
    EXPECT_NE(failures[0].why.find("--mr-frame"), std::string::npos);
    EXPECT_NE(failures[1].why.find("--labels-frame"), std::string::npos);
    parts.mr[0].assumeRas = isRas;
    parts.labels[0].assumeRas = isRas;
    parts.labels.pop_back();
    presenters::addParts(value, parts, {});
    EXPECT_TRUE(value.mr[0].geometry.patientFromVoxel({3, 2, 1}).isApprox(there));
    EXPECT_EQ(value.mr[0].provenance.assumedRas, isRas);
    EXPECT_EQ(value.labels[0].provenance.assumedRas, isRas);
    EXPECT_TRUE(
        value.labels[0].labels.get()->voxels->geometry().patientFromVoxel({3, 2, 1}).isApprox(
            isRas ? Vector3d(-6, -4, 2) : Vector3d(6, 4, 2)));
  }
}

TEST_F(CaseBuilder, NamesAreUniqueOverAllKindsOfParts)
{
  imaging::writeVolume(
      m_folder / "mr.nrrd",
      volume::Volume<std::int16_t>(
          core::GridGeometry({9, 9, 9}, Vector3d::Ones(), Vector3d::Zero()), std::int16_t{7}));
  m_sources.parts.mr = {{"t2", m_folder / "mr.nrrd"}};
  m_sources.parts.labels = {{"incus", m_folder / "facial_nerve.nii.gz"}};
  auto value = presenters::buildCase("ear", m_sources, {});
  const auto refused = [&](const presenters::PartSources& parts)
  {
    try
    {
      presenters::addParts(value, parts, {});
    }
    catch (const core::Error& error)
    {
      return error.fault() == core::Fault::Refused;
    }
    return false;
  };
  presenters::PartSources structure;
  structure.labels = {{"t2", m_folder / "facial_nerve.nii.gz"}};
  presenters::PartSources mesh;
  mesh.meshes = {{"t2", m_folder / "incus.obj"}};
  presenters::PartSources mr;
  mr.mr = {{"incus", m_folder / "mr.nrrd"}};
  presenters::PartSources twin;
  twin.meshes = {{"incus", m_folder / "incus.obj"}};
  EXPECT_TRUE(refused(structure));
  EXPECT_TRUE(refused(mesh));
  EXPECT_TRUE(refused(mr));
  EXPECT_TRUE(refused(twin));
  twin.meshes = {{"", m_folder / "incus.obj"}}; // named by its file
  presenters::addParts(value, twin, {});
  EXPECT_EQ(value.meshes.at(0).name, "incus 2");
  EXPECT_EQ(std::string(scene::kindOfPart(value, "incus")), "structure");
  EXPECT_EQ(std::string(scene::kindOfPart(value, "t2")), "MR");
  EXPECT_EQ(scene::kindOfPart(value, "stapes"), nullptr);
  // An older case may have two of one name: one goes at a time.
  value.meshes[0].name = "t2";
  scene::removePart(value, "t2");
  EXPECT_TRUE(value.meshes.empty());
  EXPECT_EQ(value.mr.size(), 1u);
  scene::removePart(value, "t2");
  EXPECT_TRUE(value.mr.empty());
}

TEST_F(CaseBuilder, SaysWhereAFrameOfReferenceCannotBeCompared)
{
  const core::GridGeometry grid({8, 8, 4}, Vector3d::Ones(), Vector3d(-4, 4, 5)); // not the CT's
  auto voxels = std::make_shared<volume::Volume<std::uint16_t>>(grid, std::uint16_t{0});
  voxels->at(1, 1, 1) = 1;
  const std::string frame = "1.2.3.4.5";
  writeSegmentation("seg.dcm", voxels, "incus", frame);
  const auto labels = [this](const std::string& on)
  {
    m_sources.parts.labels = {{"", m_folder / "seg.dcm", on}};
    return presenters::buildCase("ear", m_sources, {}).labels.at(0);
  };
  const auto unsaid = labels("");
  ASSERT_EQ(unsaid.notes.size(), 1u);
  EXPECT_NE(unsaid.notes[0].find("could not be compared with the CT's"), std::string::npos)
      << unsaid.notes[0];
  EXPECT_TRUE(unsaid.provenance.isFrameAssumed);
  const auto said = labels("ct");
  EXPECT_TRUE(said.notes.empty()) << "the user knows";
  EXPECT_FALSE(said.provenance.isFrameAssumed);

  // A CT whose frame is known: another one, overruled, stays known to be another one.
  const auto ct =
      softTissue(core::GridGeometry({16, 12, 10}, Vector3d::Ones(), Vector3d(-8, 2, 3)));
  imaging::SeriesDescription series;
  series.studyUid = "1.2.3";
  series.seriesUid = "1.2.3.5";
  for (const bool isOther : {true, false})
  {
    series.frameOfReferenceUid = isOther ? "1.2.3.9" : frame;
    m_sources.ct = m_folder / (isOther ? "other" : "same");
    imaging::writeDicomSeries(m_sources.ct, volume::IntensityVolume(ct), series);
    EXPECT_EQ(labels("ct").provenance.isFrameAssumed, isOther);
    if (isOther)
      EXPECT_THROW(labels(""), presenters::FrameUnclear);
    else
      EXPECT_FALSE(labels("").provenance.isFrameAssumed);
  }
}

// The CT lacks slices in the middle: the sound MR beside it is not taken in its place.
TEST_F(CaseBuilder, TakesNoMrForACtThatCannotBeUsed)
{
  const auto scan = softTissue(core::GridGeometry({8, 8, 24}, Vector3d::Ones(), Vector3d::Zero()));
  using Modality = imaging::SeriesDescription::Modality;
  for (const auto& [name, modality] : {std::pair{"ct", Modality::Ct}, {"mr", Modality::Mr}})
  {
    imaging::SeriesDescription series;
    series.modality = modality;
    series.studyUid = "1.2.3";
    series.seriesUid = imaging::deterministicUid(1, name);
    series.frameOfReferenceUid = "1.2.3.9";
    imaging::writeDicomSeries(m_folder / "mixed" / name, volume::IntensityVolume(scan), series);
  }
  for (int slice = 8; slice < 16; ++slice)
    std::filesystem::remove(
        m_folder / "mixed/ct" /
        ("slice-00" + std::string(slice < 10 ? "0" : "") + std::to_string(slice) + ".dcm"));
  presenters::CaseSources sources;
  sources.ct = m_folder / "mixed";
  try
  {
    presenters::buildCase("ear", sources, {});
    FAIL();
  }
  catch (const imaging::DicomError& error)
  {
    EXPECT_EQ(error.reason(), imaging::DicomError::Reason::Ambiguous);
    EXPECT_NE(std::string(error.what()).find("CT cannot be used"), std::string::npos)
        << error.what();
  }
  sources.series = imaging::deterministicUid(1, "mr");
  EXPECT_EQ(presenters::buildCase("ear", sources, {}).ct.modality, scene::Modality::Mr);
}

TEST_F(CaseBuilder, SaysThatAnMrIsACt)
{
  const auto scan = softTissue(core::GridGeometry({8, 8, 8}, Vector3d::Ones(), Vector3d::Zero()));
  using Modality = imaging::SeriesDescription::Modality;
  for (const auto& [name, modality] : {std::pair{"angio", Modality::Ct}, {"T2", Modality::Mr}})
  {
    imaging::SeriesDescription series;
    series.modality = modality;
    series.studyUid = "1.2.3";
    series.seriesUid = imaging::deterministicUid(1, name);
    series.frameOfReferenceUid = "1.2.3.9";
    imaging::writeDicomSeries(m_folder / name, volume::IntensityVolume(scan), series);
    m_sources.parts.mr.push_back({name, m_folder / name});
  }
  const auto value = presenters::buildCase("ear", m_sources, {});
  const auto saysCt = [](const scene::ImagePart& part)
  {
    return std::any_of(part.notes.begin(), part.notes.end(),
                       [](const std::string& note)
                       { return note.find("says that it is a CT") != note.npos; });
  };
  EXPECT_TRUE(saysCt(value.mr.at(0)));
  EXPECT_FALSE(saysCt(value.mr.at(1)));
}

TEST_F(CaseBuilder, SaysThatAnMrLooksLikeALabelMap)
{
  scene::Case value = presenters::buildCase("ear", m_sources, {});
  const core::GridGeometry& grid = value.ct.geometry;
  const auto note = [&](const char* name, const std::function<int(const Vector3d&, int)>& at)
  {
    auto voxels = std::make_shared<volume::Volume<std::int16_t>>(
        core::GridGeometry({40, 40, 40}, Vector3d::Ones(), grid.origin()));
    std::uint32_t noise = 1;
    for (int k = 0; k < 40; ++k)
      for (int j = 0; j < 40; ++j)
        for (int i = 0; i < 40; ++i)
        {
          noise = noise * 1664525U + 1013904223U;
          voxels->at(i, j, k) =
              static_cast<std::int16_t>(at(Vector3d(i, j, k), static_cast<int>(noise >> 28)));
        }
    const auto file = m_folder / (std::string(name) + ".nrrd");
    imaging::writeVolume(
        file, volume::IntensityVolume(std::shared_ptr<const volume::Volume<std::int16_t>>(voxels)));
    presenters::PartSources parts;
    parts.mr = {{name, file}};
    presenters::addParts(value, parts, {});
    const auto& notes = scene::findMr(value, name)->notes;
    return std::any_of(notes.begin(), notes.end(),
                       [](const std::string& one)
                       { return one.find("label map") != std::string::npos; });
  };
  const auto shells = [](const Vector3d& p)
  { return std::max(0, 5 - static_cast<int>((p - Vector3d::Constant(20.0)).norm()) / 4); };
  EXPECT_TRUE(note("labels", [&](const Vector3d& p, int) { return shells(p); }));
  EXPECT_FALSE(
      note("image", [&](const Vector3d& p, int noise) { return 100 * shells(p) + noise; }));
}

TEST_F(CaseBuilder, ChoosesAnMrFromAFolderOfSeveralSeries)
{
  for (const int value : {40, 50})
  {
    const auto scan = std::make_shared<const volume::Volume<std::int16_t>>(
        core::GridGeometry({8, 8, 8}, Vector3d::Ones(), Vector3d::Zero()),
        static_cast<std::int16_t>(value));
    imaging::SeriesDescription series;
    series.modality = imaging::SeriesDescription::Modality::Mr;
    series.studyUid = "1.2.3";
    series.seriesUid = "1.2.3." + std::to_string(value);
    series.frameOfReferenceUid = "1.2.3.9";
    imaging::writeDicomSeries(m_folder / "mr" / std::to_string(value),
                              volume::IntensityVolume(scan), series);
  }
  const std::string path = (m_folder / "mr").string();
  m_sources.parts.mr = {presenters::PartSource::parseSeries("T2=" + path + "#1.2.3.50")};
  const auto value = presenters::buildCase("ear", m_sources, {});
  EXPECT_EQ(value.mr.front().name, "T2");
  EXPECT_EQ(value.mr.front().range.max, 50.0);
  m_sources.parts.mr = {presenters::PartSource::parseSeries(path)};
  EXPECT_EQ(m_sources.parts.mr.front().series, "");
  EXPECT_THROW(presenters::buildCase("ear", m_sources, {}), imaging::DicomError);

  const auto volume = presenters::PartSource::parseSeries("T2=" + path + "#1.2.3.50#echo 2");
  EXPECT_EQ(volume.path, m_folder / "mr");
  EXPECT_EQ(volume.series, "1.2.3.50#echo 2");
  std::filesystem::create_directory(m_folder / "mr#1");
  EXPECT_EQ(presenters::PartSource::parseSeries(path + "#1").series, "")
      << "such a folder is there";
}

TEST_F(CaseBuilder, CropsToTheRegionAsked)
{
  m_sources.roi = {Vector3d(-2, 6, 6), Vector3d(2, 10, 10)};
  const auto value = presenters::buildCase("ear", m_sources, {});
  EXPECT_EQ(value.ct.geometry.dims(), (core::Index3{5, 5, 5}));
  EXPECT_EQ(value.ct.geometry.origin(), Vector3d(-2, 6, 6));
  EXPECT_EQ(value.ct.range.max, 1200.0);
}

TEST_F(CaseBuilder, CropsAnMrToItsOwnRegion)
{
  const core::GridGeometry grid({20, 16, 12}, Vector3d(1, 1, 2), Vector3d(100, -50, 10));
  auto mr = std::make_shared<volume::Volume<std::int16_t>>(grid);
  for (int k = 0; k < 12; ++k)
    for (int j = 0; j < 16; ++j)
      for (int i = 0; i < 20; ++i)
        mr->at(i, j, k) = static_cast<std::int16_t>(i + 20 * (j + 16 * k));
  imaging::writeVolume(m_folder / "mr.nrrd", *mr);
  auto value = presenters::buildCase("ear", m_sources, {});
  presenters::PartSources parts;
  parts.mr = {{"t2", m_folder / "mr.nrrd"}};
  parts.mr[0].roi = core::PatientBox(Vector3d(103, -46, 14), Vector3d(108, -41, 20));
  presenters::addParts(value, parts, {});
  const scene::ImagePart& part = value.mr.at(0);
  EXPECT_EQ(part.geometry.dims(), (core::Index3{6, 6, 4}));
  EXPECT_EQ(part.geometry.origin(), Vector3d(103, -46, 14)) << "in its own space, not the CT's";
  EXPECT_EQ(part.range.min, 3.0 + 20 * (4 + 16 * 2));
  EXPECT_EQ(part.range.max, 8.0 + 20 * (9 + 16 * 5));
  EXPECT_TRUE(std::any_of(part.notes.begin(), part.notes.end(),
                          [](const std::string& note)
                          { return note.find("FILE@t2") != std::string::npos; }));

  parts.mr[0].name = "far";
  parts.mr[0].roi = core::PatientBox(Vector3d(0, 0, 0), Vector3d(5, 5, 5));
  EXPECT_THROW(presenters::addParts(value, parts, {}), core::Error);
  EXPECT_EQ(value.mr.size(), 1u);
}

TEST_F(CaseBuilder, NamesAllThatAreTakenAndAddsTheOthersWithoutThem)
{
  const auto folder = m_folder / "masks";
  std::filesystem::create_directory(folder);
  const core::GridGeometry grid({16, 12, 10}, Vector3d::Ones(), Vector3d(-8, 2, 3));
  const auto write = [&](const std::string& name, int size)
  {
    auto voxels = volume::makeZeroVolume<std::uint16_t>(grid);
    for (int n = 0; n < size; ++n)
      voxels->at(n, 3, 3) = 1;
    imaging::writeLabelFile(folder / (name + ".nii"), volume::makeLabelMap(voxels, {}));
  };
  write("incus", 1);
  write("malleus", 2);
  m_sources.parts.labels = {{"", folder}};
  auto value = presenters::buildCase("ear", m_sources, {});
  write("incus", 3);
  write("malleus", 4);
  write("stapes", 5);
  write("cochlea", 6);

  presenters::PartSources more;
  more.labels = {{"", folder}};
  auto copy = value;
  const auto failures = presenters::addSoundParts(copy, more, {});
  ASSERT_EQ(failures.size(), 1u);
  EXPECT_EQ(failures[0].taken, (std::vector<std::string>{"incus", "malleus"}));
  for (const char* told : {"'incus' and 'malleus'", "other 2", "--skip-taken", "NAME=FILE"})
    EXPECT_NE(failures[0].why.find(told), std::string::npos) << told << ": " << failures[0].why;
  EXPECT_EQ(copy.labels.size(), value.labels.size());

  more.labels[0].skipsTaken = true;
  std::vector<presenters::StructureReport> reports;
  presenters::addParts(value, more, {}, &reports);
  std::map<std::string, std::uint64_t> voxels;
  for (const auto& part : value.labels)
    for (const auto& structure : part.structures)
      voxels[structure.name] += structure.voxels;
  EXPECT_EQ(voxels, (std::map<std::string, std::uint64_t>{
                        {"incus", 1}, {"malleus", 2}, {"stapes", 5}, {"cochlea", 6}}))
      << "those of the case stay";
  std::string notes;
  for (const auto& part : value.labels)
    for (const std::string& note : part.notes)
      notes += note + "\n";
  EXPECT_NE(notes.find("'incus', 'malleus' left out"), std::string::npos) << notes;
  const auto summary = presenters::summaryOf(reports);
  EXPECT_EQ(summary.read, 2u);
  EXPECT_EQ(summary.skipped, 2u);

  try
  {
    presenters::addParts(value, more, {}); // all of them, now
    ADD_FAILURE() << "nothing was added, and nothing said";
  }
  catch (const presenters::NamesTaken& taken)
  {
    EXPECT_EQ(taken.names.size(), 4u);
    EXPECT_EQ(taken.others, 0u);
    EXPECT_EQ(taken.fault(), core::Fault::Refused);
    EXPECT_EQ(std::string(taken.what()).find("--skip-taken"), std::string::npos) << taken.what();
  }
}

// In one layer and, as they overlap, in two: of the case's own names none is in the way.
TEST_F(CaseBuilder, NumbersTheMasksOfAFolderThatReadTheSame)
{
  const core::GridGeometry grid({16, 12, 10}, Vector3d::Ones(), Vector3d(-8, 2, 3));
  const auto write = [&](const std::filesystem::path& file, int at)
  {
    auto voxels = volume::makeZeroVolume<std::uint16_t>(grid);
    voxels->at(at, 3, 3) = 1;
    imaging::writeLabelFile(file, volume::makeLabelMap(voxels, {}));
  };
  for (const int second : {5, 4})
  {
    const auto folder = m_folder / ("masks at " + std::to_string(second));
    std::filesystem::create_directory(folder);
    write(folder / "Incus.nii", 4);
    write(folder / "incus.nii", second);
    if (std::filesystem::equivalent(folder / "Incus.nii", folder / "incus.nii"))
      GTEST_SKIP() << "a file system without regard to case";
    write(folder / "stapes.nii", 7);
    m_sources.parts.labels = {{"", folder}};
    const auto value = presenters::buildCase("ear", m_sources, {});
    const auto [names, notes] = namesAndNotes(value);
    EXPECT_EQ(names, (std::set<std::string>{"Incus", "incus 2", "stapes"}));
    EXPECT_NE(notes.find("'incus 2' has a number, as other files of the folder give names that "
                         "read the same"),
              std::string::npos)
        << notes;
  }
}

TEST_F(CaseBuilder, SaysThatANameIsGivenTwiceAndNotThatTheCaseHasIt)
{
  std::filesystem::copy_file(m_folder / "incus.obj", m_folder / "anvil.obj");
  const auto refusal = [&](const PartSource& second)
  {
    presenters::PartSources parts;
    parts.meshes = {{"Incus", m_folder / "incus.obj"}, second};
    auto value = presenters::buildCase("ear", m_sources, {});
    std::string text;
    try
    {
      presenters::addParts(value, parts, {});
    }
    catch (const presenters::NamesTaken& taken)
    {
      text = taken.what();
    }
    EXPECT_TRUE(value.meshes.empty());
    const auto failures = presenters::addSoundParts(value, parts, {});
    EXPECT_EQ(value.meshes.size(), 1u);
    EXPECT_EQ(failures.size(), 1u);
    EXPECT_EQ(failures.empty() ? std::string() : failures[0].why, text);
    return text;
  };
  const std::string incus = (m_folder / "incus.obj").string();
  const std::string anvil = (m_folder / "anvil.obj").string();
  EXPECT_EQ(refusal({"incus", anvil})
                .rfind(anvil + ": 'incus' is the name of what " + incus + " gives, too", 0),
            0u);
  EXPECT_EQ(refusal({"Incus", incus})
                .rfind(incus + ": 'Incus' is the name of what the same file gives, too", 0),
            0u);
}

TEST_F(CaseBuilder, RefusesAStructureTwiceAndLeavesTheCase)
{
  m_sources.parts.labels = {{"", m_folder / "facial_nerve.nii.gz"}};
  auto value = presenters::buildCase("ear", m_sources, {});
  presenters::PartSources more;
  more.labels = {{"second", m_folder / "facial_nerve.nii.gz"},
                 {"", m_folder / "facial_nerve.nii.gz"}};
  try
  {
    presenters::addParts(value, more, {});
    ADD_FAILURE() << "took a name twice";
  }
  catch (const core::Error& error)
  {
    EXPECT_EQ(error.fault(), core::Fault::Refused) << error.what();
  }
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

// An MR that was chosen for a label map: its values are not structures.
TEST_F(CaseBuilder, TellsAnImageFromALabelMapByTheNumberOfItsValues)
{
  const core::GridGeometry grid({16, 12, 10}, Vector3d::Ones(), Vector3d(-8, 2, 3));
  const auto built = [&](int count)
  {
    auto labels = std::make_shared<volume::Volume<std::uint16_t>>(grid, std::uint16_t{0});
    for (int n = 0; n < count; ++n)
      labels->at(n % 16, n / 16 % 12, n / 192) = static_cast<std::uint16_t>(n + 1);
    imaging::writeLabelFile(m_folder / "many.nii.gz", volume::makeLabelMap(std::move(labels), {}));
    m_sources.parts.labels = {{"", m_folder / "many.nii.gz"}};
    return presenters::buildCase("x", m_sources, {});
  };
  const auto isNoted = [](const scene::Case& value)
  {
    const auto& notes = value.labels.front().notes;
    return std::any_of(notes.begin(), notes.end(),
                       [](const std::string& note)
                       { return note.find("without a name became") != std::string::npos; });
  };
  EXPECT_FALSE(isNoted(built(120)));
  const scene::Case many = built(1000);
  EXPECT_EQ(many.labels.front().structures.size(), 1000u);
  EXPECT_TRUE(isNoted(many));
  try
  {
    built(1001);
    FAIL();
  }
  catch (const core::InvalidParameter& error)
  {
    EXPECT_NE(
        std::string(error.what()).find("many.nii.gz: has 1001 structures or different values"),
        std::string::npos)
        << error.what();
  }
}

// Labels and MR on the CT's grid, written in three frames: all coincide with the CT.
TEST_F(CaseBuilder, PutsImagesAndLabelsOfEveryNrrdSpaceInOnePlace)
{
  const std::pair<const char*, const char*> frames[] = {
      {"left-posterior-superior", "(1,0,0) (0,1,0) (0,0,1)\nspace origin: (-8,2,3)"},
      {"right-anterior-superior", "(-1,0,0) (0,-1,0) (0,0,1)\nspace origin: (8,-2,3)"},
      {"left-anterior-superior", "(1,0,0) (0,-1,0) (0,0,1)\nspace origin: (-8,-2,3)"}};
  const auto write =
      [&](const std::string& name, const char* space, const char* place, bool isLabel)
  {
    std::ofstream file(m_folder / name, std::ios::binary);
    file << "NRRD0004\ntype: short\ndimension: 3\nspace: " << space
         << "\nsizes: 16 12 10\nspace directions: " << place
         << "\nspace units: \"mm\" \"mm\" \"mm\"\nendian: little\nencoding: raw\n";
    if (isLabel)
      file << "Segment0_ID:=a\nSegment0_Name:=" << name << "\nSegment0_LabelValue:=1\n";
    file << "\n";
    std::vector<std::int16_t> voxels(16 * 12 * 10, 0);
    voxels[4 + 16 * (4 + 12 * 4)] = 1;
    file.write(reinterpret_cast<const char*>(voxels.data()), 2 * 16 * 12 * 10);
  };
  int n = 0;
  for (const auto& [space, place] : frames)
  {
    const std::string number = std::to_string(++n);
    write("ct" + number + ".nrrd", space, place, false);
    write("labels" + number + ".seg.nrrd", space, place, true);
    m_sources.parts.mr.push_back({"mr" + number, m_folder / ("ct" + number + ".nrrd")});
    m_sources.parts.labels.push_back({"", m_folder / ("labels" + number + ".seg.nrrd")});
  }
  for (int ct = 1; ct <= 3; ++ct)
  {
    m_sources.ct = m_folder / ("ct" + std::to_string(ct) + ".nrrd");
    const auto value = presenters::buildCase("ear", m_sources, {});
    const Vector3d there(-8 + 4, 2 + 4, 3 + 4);
    EXPECT_TRUE(value.ct.geometry.patientFromVoxel({4, 4, 4}).isApprox(there)) << ct;
    for (const auto& mr : value.mr)
      EXPECT_TRUE(mr.geometry.patientFromVoxel({4, 4, 4}).isApprox(there)) << mr.name;
    for (const auto& part : value.labels)
    {
      const auto& grid = part.labels.get()->voxels->geometry();
      EXPECT_TRUE(grid.patientFromVoxel({4, 4, 4}).isApprox(there)) << part.structures[0].name;
      EXPECT_EQ(part.drawnOn, "") << "of the CT's grid";
    }
  }
}

TEST_F(CaseBuilder, TakesNoPatientsNameFromAFilesName)
{
  const auto copy = [this](const char* from, const std::string& to)
  {
    std::filesystem::copy_file(m_folder / from, m_folder / to);
    return PartSource{"", m_folder / to};
  };
  m_sources.parts.labels = {copy("facial_nerve.nii.gz", "Doe_John_facial_nerve.nii.gz"),
                            copy("facial_nerve.nii.gz", "DOEJOHN19630412.nii.gz"),
                            copy("facial_nerve.nii.gz", "doe.nii.gz"),
                            {"John's tumour", m_folder / "facial_nerve.nii.gz"},
                            copy("facial_nerve.nii.gz", "chorda_tympani.nii.gz")};
  m_sources.parts.meshes = {copy("incus.obj", "John Doe.obj"), copy("incus.obj", "incus_left.obj")};
  const auto value = presenters::buildCase("ear", m_sources, {});
  std::vector<std::string> names;
  for (const auto& part : value.labels)
    names.push_back(part.structures[0].name);
  EXPECT_EQ(names, (std::vector<std::string>{"facial nerve", "structure", "structure 2",
                                             "John's tumour", "chorda_tympani"}));
  EXPECT_EQ(value.meshes[0].name, "mesh");
  EXPECT_EQ(value.meshes[1].name, "incus_left");
  EXPECT_EQ(value.meshes[1].notes.size(), 0U);
  EXPECT_NE(value.meshes[0].notes.at(0).find("NAME=FILE"), std::string::npos);
  EXPECT_NE(value.labels[1].notes.at(0).find("NAME=FILE"), std::string::npos);
  EXPECT_TRUE(value.labels[4].notes.empty());
  std::string manifest = scene::toManifest(value);
  for (char& c : manifest)
    c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  EXPECT_EQ(manifest.find("doe"), std::string::npos);
}

TEST_F(CaseBuilder, TakesNoPatientsNameFromWhatADicomFolderHoldsBesideItsSlices)
{
  const core::GridGeometry grid({8, 8, 8}, Vector3d::Ones(), Vector3d::Zero());
  imaging::SeriesDescription series;
  series.studyUid = "1.2.3";
  series.frameOfReferenceUid = "1.2.4";
  series.seriesUid = imaging::deterministicUid(1, "ct");
  imaging::writeDicomSeries(m_folder / "series", volume::IntensityVolume(softTissue(grid)), series);
  ASSERT_EQ(::mkfifo((m_folder / "series/Doe, John.pipe").c_str(), 0600), 0);
  std::filesystem::create_directory(m_folder / "elsewhere");
  std::filesystem::create_directory_symlink(m_folder / "elsewhere", m_folder / "series/DOE^JOHN");
  m_sources.ct = m_folder / "series";
  std::string manifest = scene::toManifest(presenters::buildCase("ear", m_sources, {}));
  for (char& c : manifest)
    c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  EXPECT_EQ(manifest.find("doe"), std::string::npos) << manifest;
  EXPECT_NE(manifest.find("left out in 2 places"), std::string::npos) << manifest;
}

TEST_F(CaseBuilder, SaysWhatOfLabelsIsEmptyOrOutsideTheCt)
{
  const core::GridGeometry grid({16, 12, 10}, Vector3d::Ones(), Vector3d(-8, 2, 3));
  const core::GridGeometry away({4, 4, 4}, Vector3d::Ones(), Vector3d(-8, 2, 300));
  const auto write = [this](const char* name, const core::GridGeometry& where, std::uint16_t value,
                            std::vector<volume::Segment> segments)
  {
    auto voxels = std::make_shared<volume::Volume<std::uint16_t>>(where, std::uint16_t{0});
    voxels->at(1, 1, 1) = value;
    imaging::writeLabelFile(m_folder / name, volume::makeLabelMap(voxels, std::move(segments)));
  };
  volume::Segment incus;
  incus.name = "incus";
  incus.index = 1;
  volume::Segment drum;
  drum.name = "drum";
  drum.index = 2;
  write("some.seg.nrrd", grid, 1, {incus, drum});
  write("none.seg.nrrd", grid, 0, {incus, drum});
  write("away.seg.nrrd", away, 2, {drum});
  m_sources.parts.labels = {{"", m_folder / "some.seg.nrrd"}, {"", m_folder / "away.seg.nrrd"}};
  const auto value = presenters::buildCase("ear", m_sources, {});
  ASSERT_EQ(value.labels[0].notes.size(), 1U);
  EXPECT_EQ(value.labels[0].notes[0].find("'drum' left out"), 0U) << value.labels[0].notes[0];
  ASSERT_EQ(value.labels[1].notes.size(), 1U);
  EXPECT_EQ(value.labels[1].notes[0].find("'drum' lies wholly outside the CT"), 0U);
  EXPECT_EQ(scene::fromManifest(scene::toManifest(value), "x").labels[1].notes,
            value.labels[1].notes);
  m_sources.parts.labels = {{"", m_folder / "none.seg.nrrd"}};
  EXPECT_THROW(presenters::buildCase("ear", m_sources, {}), core::InvalidParameter);
}

TEST_F(CaseBuilder, NotesHowMuchOfAStructureLiesOutside)
{
  const auto noted = [this](double up, int columns)
  {
    const core::GridGeometry grid({16, 12, 10}, Vector3d::Ones(), Vector3d(-8, 2, 3 + up));
    auto voxels = std::make_shared<volume::Volume<std::uint16_t>>(grid, std::uint16_t{0});
    for (int k = 0; k < 10; ++k)
      for (int i = 0; i < columns; ++i)
        voxels->at(4 + i, 4, k) = 1;
    volume::Segment nerve;
    nerve.name = "nerve";
    nerve.index = 1;
    imaging::writeLabelFile(m_folder / "part.seg.nrrd", volume::makeLabelMap(voxels, {nerve}));
    m_sources.parts.labels = {{"", m_folder / "part.seg.nrrd"}};
    std::string text;
    const scene::Case value = presenters::buildCase("ear", m_sources, {});
    for (const std::string& note : value.labels.at(0).notes)
      text += note;
    return text;
  };
  EXPECT_EQ(noted(0.0, 2).find("partly outside"), std::string::npos);
  EXPECT_NE(noted(6.0, 2).find("partly outside the CT, where nothing is seen or felt of them: "
                               "'nerve' (60 %)"),
            std::string::npos)
      << noted(6.0, 2);
  EXPECT_NE(noted(-3.0, 1).find("'nerve' (30 %)"), std::string::npos) << noted(-3.0, 1);
  EXPECT_EQ(noted(0.4, 1).find("partly outside"), std::string::npos) << "within its voxels";
}

// Of one map two structures are left out again, and with them their note; the note of a part that
// was there before stays.
TEST_F(CaseBuilder, TheNoteGoesWithTheStructuresThatLieOutside)
{
  const core::GridGeometry grid({16, 12, 10}, Vector3d::Ones(), Vector3d(-8, 2, 3));
  const auto write = [this](const char* name, const core::GridGeometry& where,
                            const std::vector<std::string>& names)
  {
    auto voxels = std::make_shared<volume::Volume<std::uint16_t>>(where, std::uint16_t{0});
    std::vector<volume::Segment> segments;
    for (const std::string& one : names)
    {
      volume::Segment segment;
      segment.name = one;
      segment.index = static_cast<std::uint16_t>(9 - segments.size()); // as 3D Slicer reorders them
      const bool isInside = one == "drum";
      voxels->at(isInside ? 1 : where.dims()[0] - 4 + static_cast<int>(segments.size()), 1, 1) =
          segment.index;
      segments.push_back(std::move(segment));
    }
    imaging::writeLabelFile(m_folder / name, volume::makeLabelMap(voxels, std::move(segments)));
  };
  const core::GridGeometry wide({42, 12, 10}, Vector3d::Ones(), Vector3d(-8, 2, 3));
  const core::GridGeometry away({16, 12, 10}, Vector3d::Ones(), Vector3d(90, 2, 3));
  write("before.seg.nrrd", away, {"incus"});
  write("new.seg.nrrd", wide, {"vein", "drum", "artery"});
  m_sources.parts.labels = {{"", m_folder / "before.seg.nrrd"}};
  scene::Case value = presenters::buildCase("ear", m_sources, {});
  ASSERT_EQ(value.labels.size(), 1U);
  const std::vector<std::string> before = value.labels[0].notes;
  ASSERT_EQ(before.size(), 1U);
  presenters::PartSources parts;
  parts.labels = {{"", m_folder / "new.seg.nrrd"}};
  std::vector<presenters::StructureReport> reports;
  presenters::addParts(value, parts, {}, &reports);
  ASSERT_EQ(value.labels.size(), 2U);
  ASSERT_EQ(value.labels[1].notes.size(), 1U);
  EXPECT_NE(value.labels[1].notes[0].find("lie wholly outside"), std::string::npos)
      << value.labels[1].notes[0];
  presenters::leaveOutside(value, reports);
  ASSERT_EQ(value.labels.size(), 2U);
  EXPECT_EQ(value.labels[0].notes, before);
  EXPECT_EQ(value.labels[1].structures.size(), 1U);
  EXPECT_TRUE(value.labels[1].notes.empty()) << value.labels[1].notes[0];
}

TEST_F(CaseBuilder, WhatIsNotedOfAFileStaysWithWhatIsLeftOfIt)
{
  const core::GridGeometry grid({16, 12, 10}, Vector3d::Ones(), Vector3d(-8, 2, 3));
  scene::Case value = presenters::buildCase("ear", m_sources, {});
  std::vector<presenters::StructureReport> reports;
  for (const char* name : {"incus", "drum"}) // two maps of one file
  {
    scene::LabelPart part;
    scene::StructurePart structure;
    structure.name = name;
    structure.index = 1;
    part.structures.push_back(structure);
    auto voxels = std::make_shared<volume::Volume<std::uint16_t>>(grid, std::uint16_t{0});
    part.labels = std::make_shared<const volume::LabelMap>(volume::makeLabelMap(voxels, {}));
    value.labels.push_back(std::move(part));
    presenters::StructureReport report{name};
    report.file = "set.dcm";
    report.isOutside = reports.empty();
    reports.push_back(report);
  }
  value.labels[0].notes = {
      "states another patient's ID",
      "'incus' lies wholly outside the CT, so nothing of it is seen or felt; check that it is this "
      "patient's"};
  value.labels[1].notes = {"its own"};
  presenters::leaveOutside(value, reports);
  ASSERT_EQ(value.labels.size(), 1U);
  EXPECT_EQ(value.labels[0].structures.front().name, "drum");
  EXPECT_EQ(value.labels[0].notes,
            (std::vector<std::string>{"states another patient's ID", "its own"}));
  EXPECT_EQ(reports[0].status, presenters::StructureReport::Status::Skipped);
}

TEST_F(CaseBuilder, KnowsTheFrameOfReferenceOfWhatItsCaseExports)
{
  const core::GridGeometry grid({16, 12, 10}, Vector3d::Ones(), Vector3d(-8, 2, 3));
  auto value = presenters::buildCase("ear", m_sources, {});
  value.ct.frameOfReference = std::string(64, 'a'); // of a DICOM series
  value.id = "0123456789abcdef";
  value.mr.push_back(value.ct);
  value.mr.back().name = "T2";
  const auto write = [&](const char* name, const std::string& frame)
  {
    auto voxels = std::make_shared<volume::Volume<std::uint16_t>>(grid, std::uint16_t{0});
    voxels->at(1, 1, 1) = 1;
    writeSegmentation(name, voxels, name, frame);
    presenters::PartSources parts;
    parts.labels = {{"", m_folder / name}};
    presenters::addParts(value, parts, {});
    return value.labels.back().drawnOn;
  };
  EXPECT_EQ(write("incus", presenters::exportedFrame(value, "")), "");
  EXPECT_EQ(write("stapes", presenters::exportedFrame(value, "T2")), "T2");
  auto other = value;
  other.id = "another case's";
  EXPECT_THROW(write("malleus", presenters::exportedFrame(other, "")), core::InvalidParameter);
}

// T1 and T2 of one session share their frame of reference, and each is registered by itself.
TEST_F(CaseBuilder, HangsASegmentationOnTheMrOfItsGridOrAsks)
{
  const core::GridGeometry t1({8, 8, 6}, Vector3d(0.6, 0.6, 1), Vector3d(-4, 4, 5));
  const core::GridGeometry t2({12, 12, 6}, Vector3d(0.4, 0.4, 1), Vector3d(-4, 4, 5));
  const std::pair<const char*, core::GridGeometry> images[] = {{"t1", t1}, {"t2", t2}};
  for (const auto& [name, grid] : images)
  {
    imaging::SeriesDescription series;
    series.modality = imaging::SeriesDescription::Modality::Mr;
    series.studyUid = "1.2.3";
    series.seriesUid = imaging::deterministicUid(1, name);
    series.frameOfReferenceUid = "1.2.3.9";
    imaging::writeDicomSeries(m_folder / name, volume::IntensityVolume(softTissue(grid)), series);
  }
  const auto drawnOn = [this](const core::GridGeometry& grid, const std::string& first,
                              const std::string& second, const std::string& on = "")
  {
    auto voxels = std::make_shared<volume::Volume<std::uint16_t>>(grid, std::uint16_t{0});
    for (int k = 0; k < grid.dims()[2]; ++k) // a frame for each slice: the grid is the image's
      voxels->at(1, 1, k) = 1;
    writeSegmentation("seg.dcm", voxels, "cochlea", "1.2.3.9");
    m_sources.parts.mr = {{first, m_folder / first}};
    if (!second.empty())
      m_sources.parts.mr.push_back({second, m_folder / second});
    m_sources.parts.labels = {{"", m_folder / "seg.dcm", on}};
    return presenters::buildCase("ear", m_sources, {}).labels.at(0).drawnOn.value_or("");
  };
  EXPECT_EQ(drawnOn(t2, "t1", "t2"), "t2");
  EXPECT_EQ(drawnOn(t2, "t2", "t1"), "t2");
  EXPECT_EQ(drawnOn(t1, "t2", "t1"), "t1");
  const core::GridGeometry other({20, 20, 6}, Vector3d(0.3, 0.3, 1), Vector3d(-4, 4, 5));
  EXPECT_EQ(drawnOn(other, "t1", ""), "t1") << "there is no other";
  EXPECT_THROW(drawnOn(other, "t1", "t2"), core::InvalidParameter);
  EXPECT_EQ(drawnOn(other, "t1", "t2", "t2"), "t2") << "the user says so";
}

TEST_F(CaseBuilder, TakesCodesFromASegmentationAndLooksByThem)
{
  const core::GridGeometry grid({16, 12, 10}, Vector3d::Ones(), Vector3d(-8, 2, 3));
  auto voxels = std::make_shared<volume::Volume<std::uint16_t>>(grid, std::uint16_t{0});
  imaging::SegmentationDescription segmentation;
  segmentation.studyUid = "1.2.3";
  segmentation.seriesUid = "1.2.3.4";
  segmentation.frameOfReferenceUid = "1.2.3.9";
  const std::pair<const char*, imaging::CodedConcept> given[] = {
      {"Segment_1", {"56052001", "SCT", "nerf facial"}}, // in a language that is not known
      {"Segment_2", {"99", "LOCAL", "Internal carotid artery"}},
      {"cochlea", {"85756007", "SCT", "Tissue"}},
      {"Segment_3", {"85756007", "SCT", "Tissue"}}};
  for (const auto& [name, type] : given)
  {
    imaging::SegmentationDescription::Segment segment;
    segment.index = static_cast<std::uint16_t>(segmentation.segments.size() + 1);
    voxels->at(segment.index, 1, 1) = segment.index;
    segment.label = name;
    segment.type = type;
    segment.color = {0.1F, 0.9F, 0.1F};
    segment.algorithm = imaging::SegmentationDescription::Algorithm::Automatic;
    segment.algorithmName = "a network";
    segmentation.segments.push_back(segment);
  }
  imaging::writeDicomSegmentation(m_folder / "a.dcm", {volume::makeLabelMap(voxels, {})},
                                  segmentation);
  m_sources.parts.labels = {{"", m_folder / "a.dcm"}};
  const auto value =
      scene::fromManifest(scene::toManifest(presenters::buildCase("ear", m_sources, {})), "m");
  const auto& structures = value.labels.at(0).structures;
  ASSERT_EQ(structures.size(), 4U);
  const char* const looks[] = {"nerve", "artery", "inner-ear", "other"};
  for (std::size_t n = 0; n < structures.size(); ++n)
  {
    EXPECT_EQ(structures[n].look.preset, looks[n]) << structures[n].name;
    EXPECT_EQ(structures[n].codes.type, given[n].second);
    EXPECT_EQ(structures[n].codes.algorithm, volume::SegmentCodes::Algorithm::Automatic);
    EXPECT_EQ(structures[n].codes.algorithmName, "a network");
  }
}

TEST_F(CaseBuilder, AReplacementIsTheSameStructureMadeOtherwise)
{
  scene::StructurePart before;
  before.look.preset = "nerve";
  before.codes.type = {"56052001", "SCT", "Facial nerve"};
  before.codes.algorithm = volume::SegmentCodes::Algorithm::Automatic;
  before.codes.algorithmName = "a network";
  scene::StructurePart after;
  after.codes.algorithm = volume::SegmentCodes::Algorithm::SemiAutomatic;
  after.codes.algorithmName = "Petrous";
  presenters::keepIdentity(after, before);
  EXPECT_EQ(after.look.preset, "nerve");
  EXPECT_EQ(after.codes.type, before.codes.type);
  EXPECT_EQ(after.codes.algorithm, volume::SegmentCodes::Algorithm::SemiAutomatic);
  EXPECT_EQ(after.codes.algorithmName, "Petrous");
}

TEST_F(CaseBuilder, ReportsEachOfSixtyStructures)
{
  const core::GridGeometry grid({16, 12, 10}, Vector3d::Ones(), Vector3d(-8, 2, 3));
  auto voxels = std::make_shared<volume::Volume<std::uint16_t>>(grid, std::uint16_t{0});
  std::vector<volume::Segment> segments;
  for (std::uint16_t n = 1; n <= 60; ++n)
  {
    segments.push_back({"region " + std::to_string(n), n, {}, 0});
    for (int i = 0; i < n % 10; ++i) // every tenth is empty
      voxels->at(i, n % 12, n / 12) = n;
  }
  imaging::writeLabelFile(m_folder / "a.seg.nrrd", volume::makeLabelMap(voxels, segments));
  m_sources.parts.labels = {{"", m_folder / "a.seg.nrrd"}};
  std::vector<presenters::StructureReport> reports;
  const auto value = presenters::buildCase("ear", m_sources, {}, &reports);
  ASSERT_EQ(reports.size(), 60U);
  std::set<std::array<float, 3>> colors;
  for (const auto& structure : value.labels.at(0).structures)
    colors.insert(structure.look.color);
  EXPECT_EQ(colors.size(), 54U) << "each has a colour of its own";
  for (std::size_t n = 0; n < reports.size(); ++n)
  {
    EXPECT_EQ(reports[n].name, "region " + std::to_string(n + 1));
    EXPECT_EQ(reports[n].voxels, (n + 1) % 10);
    EXPECT_STREQ(presenters::nameOf(reports[n].status), (n + 1) % 10 == 0 ? "empty" : "read");
  }
  reports[3].fileVolume = 3.2; // of 4 mm^3
  reports[4].fileVolume = 5.0;
  reports[5].status = presenters::StructureReport::Status::Unread;
  const auto summary = presenters::summaryOf(reports);
  EXPECT_EQ(summary.text, "53 structures read, 6 empty, 1 not read");
  ASSERT_EQ(summary.worst, &reports[3]);
  EXPECT_NEAR(*summary.worst->volumeError(), 0.25, 1e-12);
  EXPECT_EQ(presenters::summaryOf({}).worst, nullptr);
}

TEST_F(CaseBuilder, KeepsTheSideInTheNamesOfAFolderAndSaysWhatItLeavesOut)
{
  const auto folder = m_folder / "masks";
  std::filesystem::create_directory(folder);
  const auto labels = imaging::readLabelFile(m_folder / "facial_nerve.nii.gz");
  // "sin" is in most of the files, as a patient's name would be
  for (const char* name : {"facial_nerve_sin", "cochlea_sin", "stapes_sin", "facial_nerve_dx"})
    imaging::writeLabelFile(folder / ("Doe_" + std::string(name) + ".nii.gz"), labels);
  m_sources.parts.labels = {{"", folder}};
  const auto value = presenters::buildCase("ear", m_sources, {});
  const auto [names, notes] = namesAndNotes(value);
  EXPECT_EQ(names, (std::set<std::string>{"facial_nerve_sin", "cochlea_sin", "stapes_sin",
                                          "facial_nerve_dx"}));
  EXPECT_NE(notes.find("1 word of the files' names"), std::string::npos) << notes;
  EXPECT_EQ(notes.find("Doe"), std::string::npos) << notes;
}

TEST_F(CaseBuilder, LosesNothingOfTheNamesInAFolderThatChangesTheirMeaning)
{
  const auto labels = imaging::readLabelFile(m_folder / "facial_nerve.nii.gz");
  const auto namesIn = [&](const std::string& folder, const std::vector<std::string>& files)
  {
    std::filesystem::create_directory(m_folder / folder);
    for (const std::string& file : files)
      imaging::writeLabelFile(m_folder / folder / (file + ".nii.gz"), labels);
    m_sources.parts.labels = {{"", m_folder / folder}};
    const auto value = presenters::buildCase("ear", m_sources, {});
    return namesAndNotes(value).first;
  };
  using Names = std::set<std::string>;
  // What is to be read is what stands there: a letter is no side for sure.
  EXPECT_EQ(namesIn("two", {"cochlea_d", "cochlea_s"}), (Names{"cochlea_d", "cochlea_s"}));
  EXPECT_EQ(namesIn("one-side", {"Doe_cochlea_G", "Doe_stapes_G", "Doe_incus_G"}),
            (Names{"cochlea_G", "stapes_G", "incus_G"}));
  EXPECT_EQ(namesIn("not", {"Doe_tumour_not_resected", "Doe_tumour_resected"}),
            (Names{"tumour_not_resected", "tumour_resected"}));
  EXPECT_EQ(namesIn("joined", {"DoeCochlea_l", "vertebra_C7"}),
            (Names{"cochlea_l", "vertebra_C7"}));
}

TEST_F(CaseBuilder, NamesTheMasksOfAFolderThatItLeavesOut)
{
  const core::GridGeometry grid({16, 12, 10}, Vector3d::Ones(), Vector3d(-8, 2, 3));
  const std::filesystem::path masks = m_folder / "masks";
  std::filesystem::create_directory(masks);
  const auto write = [&](const std::string& name, bool isOne)
  {
    auto voxels = std::make_shared<volume::Volume<std::uint16_t>>(grid, std::uint16_t{0});
    voxels->at(1, 1, 1) = 1;
    voxels->at(2, 1, 1) = isOne ? 1 : 2;
    imaging::writeLabelFile(masks / name, volume::makeLabelMap(voxels, {}));
  };
  write("cochlea.nii", true);
  write("facial_nerve.nii", false);
  write("Doe_John.nii", false);
  m_sources.parts.labels = {{"", masks}};
  std::vector<presenters::StructureReport> reports;
  const auto value = presenters::buildCase("ear", m_sources, {}, &reports);
  ASSERT_FALSE(value.labels[0].notes.empty());
  EXPECT_NE(value.labels[0].notes[0].find("2 files of the folder"), std::string::npos);
  EXPECT_NE(value.labels[0].notes[0].find("'facial_nerve'"), std::string::npos)
      << value.labels[0].notes[0];
  EXPECT_EQ(scene::toManifest(value).find("Doe"), std::string::npos);
  const auto unread = [&reports](const std::string& name)
  {
    return std::any_of(reports.begin(), reports.end(),
                       [&name](const auto& one)
                       {
                         return one.name == name && !one.why.empty() &&
                                one.status == presenters::StructureReport::Status::Unread;
                       });
  };
  EXPECT_TRUE(unread("facial_nerve"));
  EXPECT_TRUE(unread("Doe_John")) << "told at once, and not stored";
}

// A ball of 1000 HU and its surface, written as other programs do.
TEST_F(CaseBuilder, AsksHowAMeshCountsWhereItWouldLieElsewhere)
{
  static constexpr double kRadius = 12.0;
  const auto writeCt = [this](const Vector3d& origin, const Vector3d& center, double hu)
  {
    const core::GridGeometry grid({80, 80, 60}, Vector3d::Ones(), origin);
    auto ct = std::make_shared<volume::Volume<std::int16_t>>(grid, std::int16_t{0});
    ct->at(0, 0, 0) = 1; // an image of one single value is refused
    for (int k = 0; k < 60; ++k)
      for (int j = 0; j < 80; ++j)
        for (int i = 0; i < 80; ++i)
          if ((grid.patientFromVoxel(Vector3d(i, j, k)) - center).norm() < kRadius)
            ct->at(i, j, k) = static_cast<std::int16_t>(hu);
    imaging::writeVolume(m_folder / "ct.nrrd", *ct);
  };
  const auto writeBall =
      [this](const Vector3d& center, const Vector3d& scale, const std::string& head)
  {
    std::ofstream file(m_folder / "ball.obj");
    file.imbue(std::locale::classic());
    file << head;
    constexpr int kSteps = 24;
    for (int b = 0; b <= kSteps; ++b)
      for (int a = 0; a < kSteps; ++a)
      {
        const double theta = M_PI * b / kSteps;
        const double phi = 2.0 * M_PI * a / kSteps;
        const Vector3d p = scale.cwiseProduct(
            center + kRadius * Vector3d(std::sin(theta) * std::cos(phi),
                                        std::sin(theta) * std::sin(phi), std::cos(theta)));
        file << "v " << p[0] << " " << p[1] << " " << p[2] << "\n";
      }
    for (int b = 0; b < kSteps; ++b)
      for (int a = 0; a < kSteps; ++a)
      {
        const int next = (a + 1) % kSteps;
        const int corners[4] = {b * kSteps + a, b * kSteps + next, (b + 1) * kSteps + next,
                                (b + 1) * kSteps + a};
        file << "f " << corners[0] + 1 << " " << corners[1] + 1 << " " << corners[2] + 1 << " "
             << corners[3] + 1 << "\n";
      }
  };
  const auto add = [this](std::optional<bool> isRas = {}, std::optional<double> unit = {})
  {
    auto value = presenters::buildCase("ear", m_sources, {});
    presenters::PartSources more;
    more.meshes = {{"ball", m_folder / "ball.obj"}};
    more.meshes[0].isRas = isRas;
    more.meshes[0].unit = unit;
    presenters::addParts(value, more, {});
    return value.meshes.at(0);
  };
  const auto refusal = [&](std::optional<bool> isRas = {}, std::optional<double> unit = {})
  {
    try
    {
      add(isRas, unit);
    }
    catch (const presenters::MeshSpaceUnclear& unclear)
    {
      return std::string(unclear.what());
    }
    return std::string("was accepted");
  };
  const auto expectCentered = [](const scene::MeshPart& part, const Vector3d& center)
  {
    for (const auto& vertex : part.mesh.get()->vertices)
      ASSERT_NEAR((vertex.cast<double>() - center).norm(), kRadius, 1e-3);
  };
  const Vector3d ras(-1, -1, 1);
  const Vector3d lps(1, 1, 1);

  // The CT of one ear: any other frame or unit is beyond it.
  Vector3d center(-60, 25, 40);
  writeCt({-100, -10, 10}, center, 1000.0);
  writeBall(center, lps, "");
  EXPECT_TRUE(add().notes.empty());
  writeBall(center, ras, "");
  EXPECT_NE(refusal().find("as RAS mm it would lie inside"), std::string::npos) << refusal();
  EXPECT_NE(refusal().find("ball.obj"), std::string::npos);
  expectCentered(add(true), center);
  expectCentered(add(true, 1.0), center);
  writeBall(center, ras, "# SPACE=RAS\n");
  expectCentered(add(), center);
  writeBall(center, 0.001 * lps, "");
  EXPECT_NE(refusal().find("as LPS m it would lie inside"), std::string::npos) << refusal();
  expectCentered(add({}, 1000.0), center);
  writeBall(center, 0.001 * ras, "");
  EXPECT_NE(refusal().find("as RAS m it would lie inside"), std::string::npos) << refusal();
  expectCentered(add(true, 1000.0), center);
  writeBall(center, 1000.0 * lps, "");
  EXPECT_NE(refusal().find("as LPS \xc2\xb5m it would lie inside"), std::string::npos) << refusal();
  expectCentered(add({}, 0.001), center);
  writeBall(center, 0.1 * lps, "# SPACE=LPS\n");
  EXPECT_NE(refusal().find("as LPS cm"), std::string::npos) << refusal();
  // What the file states may be wrong; what the user gives counts.
  writeBall(center, 0.1 * lps, "# SPACE=LPS, unit mm\n");
  EXPECT_NE(refusal().find("as LPS mm, as it states, it reaches"), std::string::npos) << refusal();
  EXPECT_NE(refusal().find("as LPS cm it would lie inside"), std::string::npos) << refusal();
  expectCentered(add({}, 10.0), center);
  const auto wholly = add(false, 1.0);
  ASSERT_FALSE(wholly.notes.empty());
  EXPECT_NE(wholly.notes[0].find("lies outside the CT altogether"), std::string::npos);
  writeBall(center, lps, "# SPACE=RAS\n");
  EXPECT_NE(refusal().find("as LPS mm it would lie inside"), std::string::npos) << refusal();
  expectCentered(add(false), center);
  try
  {
    add();
  }
  catch (const presenters::MeshSpaceUnclear& unclear) // what the window offers
  {
    ASSERT_EQ(unclear.likely.size(), 2U);
    EXPECT_TRUE(unclear.likely[0].isRas);
    EXPECT_FALSE(unclear.likely[1].isRas);
    EXPECT_EQ(unclear.likely[1].mm, 1.0);
  }

  // What would be cut in the other frame is not said to lie inside.
  writeBall({-94.5, 25, 40}, ras, "");
  EXPECT_NE(refusal().find("as RAS mm it would reach 6.0 mm beyond it"), std::string::npos)
      << refusal();
  EXPECT_EQ(refusal().find("it would lie inside"), std::string::npos) << refusal();

  // A ball cut by the first sagittal voxels' outer face, 6 mm from its centre: a cap of height
  // 6 mm is a quarter of the surface.
  writeBall({-94.5, 25, 40}, lps, "# SPACE=LPS, unit mm\n");
  const auto cut = add();
  ASSERT_EQ(cut.notes.size(), 1U);
  EXPECT_NE(cut.notes[0].find("reaches 6.0 mm beyond the CT; 2"), std::string::npos)
      << cut.notes[0];
  EXPECT_NE(cut.notes[0].find(" % of its surface lies outside"), std::string::npos);

  // A whole head around the origin: the surface has to follow the image.
  center = {-20, 14, 3};
  writeCt({-40, -40, -30}, center, 1000.0);
  writeBall(center, lps, "");
  EXPECT_TRUE(add().notes.empty());
  writeBall(center, ras, "");
  EXPECT_NE(refusal().find("of the edges of the CT, as RAS mm 9"), std::string::npos) << refusal();
  expectCentered(add(true), center);
  writeCt({-40, -40, -30}, center, 0.0); // not to be seen in this image
  writeBall(center, lps, "");
  ASSERT_FALSE(add().notes.empty());
  EXPECT_NE(add().notes.back().find("also as RAS mm"), std::string::npos) << add().notes.back();
}

TEST_F(CaseBuilder, NotesWhatIsOddInTheFormOfAMesh)
{
  // Boxes of edge 1, 2 and 0.5 mm in the CT.
  const Vector3d center =
      presenters::buildCase("ear", m_sources, {}).ct.geometry.patientBounds().center();
  const auto box = [&](core::TriangleMesh& mesh, double x, double edge, bool isReversed)
  {
    const auto base = static_cast<std::uint32_t>(mesh.vertices.size());
    for (int n = 0; n < 8; ++n)
      mesh.vertices.push_back(
          (center + Vector3d(x + ((n & 1) != 0 ? edge : 0.0), (n & 2) != 0 ? edge : 0.0,
                             (n & 4) != 0 ? edge : 0.0))
              .cast<float>());
    for (std::array<std::uint32_t, 3> t : std::vector<std::array<std::uint32_t, 3>>{{0, 2, 3},
                                                                                    {0, 3, 1},
                                                                                    {4, 5, 7},
                                                                                    {4, 7, 6},
                                                                                    {0, 1, 5},
                                                                                    {0, 5, 4},
                                                                                    {2, 6, 7},
                                                                                    {2, 7, 3},
                                                                                    {0, 4, 6},
                                                                                    {0, 6, 2},
                                                                                    {1, 3, 7},
                                                                                    {1, 7, 5}})
    {
      if (isReversed)
        std::swap(t[0], t[1]);
      mesh.triangles.push_back({base + t[0], base + t[1], base + t[2]});
    }
  };
  const auto added = [&](const core::TriangleMesh& mesh)
  {
    imaging::writeMesh(m_folder / "incus.ply", mesh);
    auto value = presenters::buildCase("ear", m_sources, {});
    presenters::PartSources more;
    more.meshes = {{"", m_folder / "incus.ply"}};
    more.meshes[0].isRas = false;
    more.meshes[0].unit = 1.0;
    presenters::addParts(value, more, {});
    return value;
  };
  const auto notes = [](const scene::Case& value)
  {
    std::string all;
    for (const std::string& note : value.meshes.at(0).notes)
      all += note + "\n";
    return all;
  };
  core::TriangleMesh mesh;
  box(mesh, -2.0, 1.0, true);
  box(mesh, 0.0, 2.0, false);
  const auto reversed = added(mesh);
  EXPECT_NE(notes(reversed).find("has 2 parts, of which 1 is wound the other way"),
            std::string::npos)
      << notes(reversed);
  EXPECT_NEAR(volume::measure(*reversed.meshes[0].mesh.get()).volume.value(), 9.0, 1e-3);
  EXPECT_EQ(reversed.meshes[0].mesh.get()->triangles.size(), 24U) << "stays as in the file";
  mesh = {};
  box(mesh, 0.0, 2.0, false);
  const core::TriangleMesh once = mesh;
  EXPECT_EQ(notes(added(once)).find("has "), std::string::npos) << notes(added(once));
  mesh.triangles.insert(mesh.triangles.end(), once.triangles.begin(), once.triangles.end());
  const auto twice = added(mesh);
  EXPECT_NE(notes(twice).find("has each triangle twice"), std::string::npos) << notes(twice);
  EXPECT_NEAR(volume::measure(*twice.meshes[0].mesh.get()).volume.value(), 8.0, 1e-3);

  mesh = once;
  box(mesh, 1.5, 1.0, false); // half of it in the other
  const auto overlapping = added(mesh);
  EXPECT_NE(notes(overlapping).find("the volume is that of their union"), std::string::npos)
      << notes(overlapping);
  EXPECT_NEAR(volume::measure(*overlapping.meshes[0].mesh.get()).volume.value(), 8.5, 0.03);
}

TEST_F(CaseBuilder, NotesTheObjectsOfAMeshFileButNoPatientsName)
{
  auto value = presenters::buildCase("ear", m_sources, {});
  const Vector3d center = value.ct.geometry.patientBounds().center();
  std::ofstream file(m_folder / "incus.obj");
  file.imbue(std::locale::classic());
  for (const double x : {0.0, 3.0})
    for (const Vector3d& corner :
         {Vector3d(0, 0, 0), Vector3d(1, 0, 0), Vector3d(0, 1, 0), Vector3d(0, 0, 1)})
    {
      const Vector3d p = center + Vector3d(x, 0, 0) + corner;
      file << "v " << p[0] << " " << p[1] << " " << p[2] << "\n";
    }
  file << "g facial_nerve\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n"
       << "g Mustermann_Erika\nf 5 7 6\nf 5 6 8\nf 5 8 7\nf 6 7 8\n";
  file.close();
  presenters::PartSources more;
  more.meshes = {{"", m_folder / "incus.obj"}};
  more.meshes[0].isRas = false;
  more.meshes[0].unit = 1.0;
  presenters::addParts(value, more, {});
  std::string all;
  for (const std::string& note : value.meshes.at(0).notes)
    all += note + "\n";
  EXPECT_NE(all.find("holds 2 objects, among them 'facial_nerve', taken as one structure"),
            std::string::npos)
      << all;
  EXPECT_EQ(all.find("ustermann"), std::string::npos) << all;
}

TEST_F(CaseBuilder, MakesAPartOfEachObjectOfAMeshFile)
{
  auto value = presenters::buildCase("ear", m_sources, {});
  const Vector3d center = value.ct.geometry.patientBounds().center();
  // Tetrahedra with three edges of a length at right angles, apart from each other; their faces in
  // turns.
  const std::array<double, 3> lengths{1.0, 2.0, 1.5}; // mm
  const std::array<const char*, 3> objects{"facial_nerve", "Mustermann_Erika", "Facial_Nerve"};
  std::ofstream file(m_folder / "objects.obj");
  file.imbue(std::locale::classic());
  for (std::size_t n = 0; n < 3; ++n)
    for (const Vector3d& corner :
         {Vector3d(0, 0, 0), Vector3d(1, 0, 0), Vector3d(0, 1, 0), Vector3d(0, 0, 1)})
    {
      const Vector3d p =
          center + Vector3d(4.0 * static_cast<double>(n) - 4.0, 0, 0) + lengths[n] * corner;
      file << "v " << p[0] << " " << p[1] << " " << p[2] << "\n";
    }
  const std::array<std::array<std::size_t, 3>, 4> faces{
      {{1, 3, 2}, {1, 2, 4}, {1, 4, 3}, {2, 3, 4}}};
  for (const auto& face : faces)
    for (std::size_t n = 0; n < 3; ++n)
      file << "g " << objects[n] << "\nf " << face[0] + 4 * n << " " << face[1] + 4 * n << " "
           << face[2] + 4 * n << "\n";
  file.close();
  const auto partsOf = [this](const std::string& name)
  {
    presenters::PartSources parts;
    parts.meshes = {{name, m_folder / "objects.obj"}};
    parts.meshes[0].isRas = false;
    parts.meshes[0].unit = 1.0;
    parts.meshes[0].isPerObject = true;
    return parts;
  };
  const auto namesOf = [](const scene::Case& one)
  {
    std::vector<std::string> names;
    for (const scene::MeshPart& mesh : one.meshes)
      names.push_back(mesh.name);
    return names;
  };
  using Names = std::vector<std::string>;
  const auto volumeOf = [](const scene::MeshPart& part)
  {
    const auto mesh = part.mesh.get();
    return volume::measure(*mesh).volume.value();
  };

  presenters::PartSources together = partsOf("whole");
  together.meshes[0].isPerObject = false;
  scene::Case one = value;
  presenters::addParts(one, together, {});
  ASSERT_EQ(one.meshes.size(), 1U);

  const scene::Case empty = value;
  presenters::addParts(value, partsOf(""), {});
  EXPECT_EQ(namesOf(value), (Names{"facial_nerve", "structure", "Facial_Nerve 2"}));
  ASSERT_EQ(value.meshes.size(), 3U);
  double sum = 0.0;
  std::string all;
  for (std::size_t n = 0; n < 3; ++n)
  {
    const double length = lengths[n];
    EXPECT_EQ(value.meshes[n].triangles, 4U);
    EXPECT_NEAR(volumeOf(value.meshes[n]), length * length * length / 6.0, 1e-4) << n;
    sum += volumeOf(value.meshes[n]);
    for (const std::string& note : value.meshes[n].notes)
      all += note + "\n";
  }
  EXPECT_NEAR(sum, volumeOf(one.meshes[0]), 1e-4);
  EXPECT_EQ(all.find("ustermann"), std::string::npos) << all;
  EXPECT_NE(all.find("is one of 3 objects of its file"), std::string::npos) << all;
  EXPECT_NE(all.find("'Facial_Nerve 2' has a number"), std::string::npos) << all;
  EXPECT_NE(all.find("2 words of the objects' names"), std::string::npos) << all;

  scene::Case left = empty;
  presenters::addParts(left, partsOf("left"), {});
  EXPECT_EQ(namesOf(left), (Names{"left facial_nerve", "left", "left Facial_Nerve 2"}));

  presenters::PartSources again = partsOf("");
  try
  {
    presenters::addParts(value, again, {});
    FAIL();
  }
  catch (const presenters::NamesTaken& error)
  {
    EXPECT_EQ(error.names, Names{"facial_nerve"});
    EXPECT_EQ(error.others, 2U);
  }
  EXPECT_EQ(value.meshes.size(), 3U);
  again.meshes[0].newNames["facial_nerve"] = "chorda";
  scene::Case renamed = value;
  presenters::addParts(renamed, again, {});
  EXPECT_EQ(namesOf(renamed).at(3), "chorda");
  again.meshes[0].newNames.clear();
  again.meshes[0].skipsTaken = true;
  presenters::addParts(value, again, {});
  EXPECT_EQ(namesOf(value), (Names{"facial_nerve", "structure", "Facial_Nerve 2", "structure 2",
                                   "Facial_Nerve 3"}));

  again = partsOf(""); // a file of one object is named after itself
  again.meshes[0].path = m_folder / "incus.obj";
  presenters::addParts(value, again, {});
  EXPECT_EQ(namesOf(value).back(), "incus");
}

TEST_F(CaseBuilder, NumbersTheObjectsOfAMeshFileThatHaveNoName)
{
  constexpr int kObjects = 40;
  auto value = presenters::buildCase("ear", m_sources, {});
  scene::MeshPart there; // between the numbers
  there.name = "Structure_7";
  there.mesh = std::make_shared<const core::TriangleMesh>();
  value.meshes.push_back(std::move(there));
  const Vector3d p = value.ct.geometry.patientBounds().center();
  std::ofstream file(m_folder / "nameless.stl");
  file.imbue(std::locale::classic());
  for (int n = 0; n < kObjects; ++n)
  {
    file << "solid\nfacet normal 0 0 1\nouter loop\n";
    for (const Vector3d& corner : {Vector3d(0, 0, 0), Vector3d(1, 0, 0), Vector3d(0, 1, 0)})
      file << "vertex " << p[0] + corner[0] << " " << p[1] + corner[1] << " " << p[2] + 0.01 * n
           << "\n";
    file << "endloop\nendfacet\nendsolid\n";
  }
  file.close();
  presenters::PartSources parts;
  parts.meshes = {{"", m_folder / "nameless.stl"}};
  parts.meshes[0].isRas = false;
  parts.meshes[0].unit = 1.0;
  parts.meshes[0].isPerObject = true;
  presenters::addParts(value, parts, {});
  std::vector<std::string> expected{"Structure_7", "structure"};
  for (int n = 2; expected.size() < kObjects + 1; ++n)
    if (n != 7) // reads as the one that is there
      expected.push_back("structure " + std::to_string(n));
  std::vector<std::string> names;
  for (const scene::MeshPart& mesh : value.meshes)
    names.push_back(mesh.name);
  EXPECT_EQ(names, expected);
}

TEST_F(CaseBuilder, RefusesAMeshWithAFarVertex)
{
  const auto write = [this](const char* name, float x)
  {
    core::TriangleMesh mesh;
    mesh.vertices = {{x, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    mesh.triangles = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
    imaging::writeMesh(m_folder / name, mesh);
  };
  auto value = presenters::buildCase("ear", m_sources, {});
  for (const float far : {5000.0F, -44000.0F, 3e38F})
  {
    write("incus.stl", far);
    presenters::PartSources more;
    more.meshes = {{"", m_folder / "incus.stl"}};
    try
    {
      presenters::addParts(value, more, {});
      FAIL() << far;
    }
    catch (const core::InvalidParameter& error)
    {
      EXPECT_NE(std::string(error.what()).find("mm beyond the CT"), std::string::npos);
      EXPECT_NE(std::string(error.what()).find("incus.stl"), std::string::npos);
    }
    EXPECT_TRUE(value.meshes.empty());
  }
  // A vertex without a triangle is not part of the surface.
  std::ofstream(m_folder / "incus.obj", std::ios::app) << "v 0 0 90000\n";
  presenters::PartSources more;
  more.meshes = {{"", m_folder / "incus.obj"}};
  presenters::addParts(value, more, {});
  EXPECT_EQ(value.meshes[0].mesh.get()->vertices.size(), 4U);
}
