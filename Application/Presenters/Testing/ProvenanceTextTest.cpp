#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <unistd.h>

#include "petrous/Imaging/DicomWriter.h"
#include "petrous/Library/Archive.h"
#include "petrous/Presenters/CaseBuilder.h"
#include "petrous/Presenters/CaseDicom.h"
#include "petrous/Presenters/CaseExport.h"
#include "petrous/Presenters/ProvenanceText.h"
#include "petrous/Scene/Manifest.h"

using namespace petrous;
using namespace petrous::presenters;
using Eigen::Vector3d;
using volume::SliceRange;

namespace
{

constexpr int kSlices = 450;
constexpr int kGaps = 40; // more than a note names one by one

class Provenance : public ::testing::Test
{
protected:
  void SetUp() override
  {
    m_folder = std::filesystem::temp_directory_path() /
               ("petrous-provenance-" + std::to_string(::getpid()));
    std::filesystem::create_directories(m_folder);
  }
  void TearDown() override { std::filesystem::remove_all(m_folder); }

  /// A CT series of `slices` without those whose number, from 0, is in `gone`.
  std::filesystem::path writeSeries(int slices, const std::vector<int>& gone,
                                    const imaging::PixelFaults& faults = {}) const
  {
    auto voxels = std::make_shared<volume::Volume<std::int16_t>>(
        core::GridGeometry({8, 8, slices}, Vector3d(0.5, 0.5, 0.6), Vector3d(-2, -2, 10)));
    for (std::size_t v = 0; v < voxels->size(); ++v)
      voxels->data()[v] = static_cast<std::int16_t>(v % 64 < 32 ? -1000 : v % 1900);
    imaging::SeriesDescription series;
    series.studyUid = "1.2.3";
    series.seriesUid = "1.2.3.4";
    series.frameOfReferenceUid = "1.2.3.9";
    series.faults = faults;
    const std::filesystem::path folder = m_folder / "ct";
    imaging::writeDicomSeries(
        folder,
        volume::IntensityVolume(std::shared_ptr<const volume::Volume<std::int16_t>>(voxels)),
        series);
    for (const int slice : gone)
      std::filesystem::remove(fileOf(folder, slice));
    return folder;
  }

  static std::filesystem::path fileOf(const std::filesystem::path& folder, int slice)
  {
    const std::string number = std::to_string(slice + 1);
    return folder / ("slice-" + std::string(4 - number.size(), '0') + number + ".dcm");
  }

  scene::Case withGaps() const
  {
    std::vector<int> gone;
    for (int n = 0; n < kGaps; ++n)
      gone.push_back(10 * n + 5);
    CaseSources sources;
    sources.ct = writeSeries(kSlices, gone);
    sources.repair = true;
    return buildCase("ear", sources, {});
  }

  static std::vector<SliceRange> gaps()
  {
    std::vector<SliceRange> ranges;
    for (int n = 0; n < kGaps; ++n)
      ranges.push_back({10 * n + 5, 10 * n + 5});
    return ranges;
  }

  std::filesystem::path m_folder;
};

std::string contentOf(const std::filesystem::path& file)
{
  std::ifstream stream(file, std::ios::binary);
  return std::string(std::istreambuf_iterator<char>(stream), {});
}

} // namespace

TEST_F(Provenance, OfFortyGapsIsKnownSliceBySliceThroughLibraryAndArchive)
{
  scene::Case value = withGaps();
  ASSERT_EQ(value.ct.geometry.dims()[2], kSlices);
  EXPECT_EQ(value.ct.provenance.interpolated, gaps());
  library::Library home(m_folder / "home");
  home.save(value);
  EXPECT_EQ(home.open("ear").ct.provenance.interpolated, gaps());
  library::archiveCase(home, "ear", m_folder / "ear.petrous");
  library::Library away(m_folder / "away");
  library::restoreCase(away, m_folder / "ear.petrous");
  EXPECT_EQ(away.open("ear").ct.provenance.interpolated, gaps());
}

// Its notes are what programs read that keep no record, and this one of a case that they saved.
TEST_F(Provenance, OfFortyGapsIsNotLessWhereOnlyTheNotesTellIt)
{
  auto manifest = nlohmann::json::parse(scene::toManifest(withGaps()));
  manifest["ct"].erase("provenance");
  const scene::Case older = scene::fromManifest(manifest.dump(), "ear.json");
  for (const SliceRange& gap : gaps())
    EXPECT_TRUE(volume::contains(older.ct.provenance.interpolated, gap.first)) << gap.first;
  EXPECT_FALSE(volume::contains(older.ct.provenance.interpolated, 4));
  EXPECT_FALSE(volume::contains(older.ct.provenance.interpolated, 396));
}

TEST_F(Provenance, OfAReadSeriesIsWhatItsNotesSayToo)
{
  for (const auto& [faults, gone] :
       {std::pair{imaging::PixelFaults{imaging::BurnedInText::Stated, true, 12.5},
                  std::vector<int>{7}},
        {imaging::PixelFaults{imaging::BurnedInText::None, true, std::nullopt},
         std::vector<int>{3, 20}}})
  {
    CaseSources sources;
    sources.ct = writeSeries(40, gone, faults);
    sources.repair = true;
    const scene::Case value = buildCase("ear", sources, {});
    auto manifest = nlohmann::json::parse(scene::toManifest(value));
    manifest["ct"].erase("provenance");
    const scene::Case older = scene::fromManifest(manifest.dump(), "ear.json");
    for (const volume::ImageProvenance& one : {value.ct.provenance, older.ct.provenance})
    {
      ASSERT_EQ(one.interpolated.size(), gone.size());
      for (std::size_t n = 0; n < gone.size(); ++n)
        EXPECT_EQ(one.interpolated[n], (SliceRange{gone[n], gone[n]}));
      EXPECT_EQ(one.pixels.burnedIn, faults.burnedIn);
      EXPECT_TRUE(one.pixels.isLossy);
      EXPECT_EQ(one.pixels.lossyRatio, faults.lossyRatio);
    }
  }
}

TEST_F(Provenance, IsWrittenIntoEachFileOfAnExportedSlice)
{
  scene::Case value = withGaps();
  ExportOptions options;
  options.what = "ct";
  options.out = (m_folder / "out").string() + "/";
  std::string warnings;
  const library::Library library(m_folder / "none");
  exportCase(library, value, options, {},
             [&warnings](const std::string& line) { warnings += line + '\n'; }, {});
  for (int slice = 0; slice < kSlices; ++slice)
  {
    const std::string file = contentOf(fileOf(m_folder / "out", slice));
    ASSERT_FALSE(file.empty()) << slice;
    EXPECT_EQ(file.find("This slice was interpolated") != std::string::npos,
              volume::contains(gaps(), slice))
        << slice;
    EXPECT_NE(file.find("Repaired: slices 6, 16, 26, 36, 46, "), std::string::npos) << slice;
    EXPECT_NE(file.find("386, 396 of 450 interpolated between neighbours"), std::string::npos);
  }
  EXPECT_NE(warnings.find("386, 396 interpolated between neighbours"), std::string::npos)
      << warnings;
  // A case that is built of them knows it, of a region too, and its notes say so.
  CaseSources sources;
  sources.ct = m_folder / "out";
  scene::Case again = buildCase("again", sources, {});
  EXPECT_EQ(again.ct.provenance.interpolated, gaps());
  const auto isNoted = [&again](const std::string& text)
  {
    return std::any_of(again.ct.notes.begin(), again.ct.notes.end(),
                       [&text](const std::string& note)
                       { return note.find(text) != std::string::npos; });
  };
  EXPECT_TRUE(isNoted("slices 6 to 396 of 450 were interpolated"));
  const core::GridGeometry& grid = value.ct.geometry;
  core::PatientBox box(grid.patientFromVoxel({1, 1, 12}));
  box.extend(grid.patientFromVoxel({6, 6, 40}));
  sources.roi = box;
  again = buildCase("again", sources, {});
  EXPECT_EQ(again.ct.provenance.interpolated,
            (std::vector<SliceRange>{{3, 3}, {13, 13}, {23, 23}}));
  EXPECT_TRUE(isNoted("slices 4, 14, 24 of 29 were interpolated"));
  // Two slices get lost: repair guesses these, and keeps the mark of the others.
  sources.roi.reset();
  sources.repair = true;
  std::filesystem::remove(fileOf(m_folder / "out", 5));
  std::filesystem::remove(fileOf(m_folder / "out", 200));
  again = buildCase("again", sources, {});
  std::vector<SliceRange> all = gaps();
  all.insert(all.begin() + 20, SliceRange{200, 200});
  EXPECT_EQ(again.ct.provenance.interpolated, all);
  EXPECT_TRUE(isNoted("slices 6, 201 of 450 are missing and were interpolated"));
}

TEST_F(Provenance, FitsADerivationHoweverManySlicesWereInterpolated)
{
  scene::ImagePart image;
  image.geometry = core::GridGeometry({4, 4, 9000}, Vector3d::Ones(), Vector3d::Zero());
  for (int n = 0; n < 800; ++n)
    image.provenance.interpolated.push_back({1000 + 10 * n, 1001 + 10 * n});
  image.provenance.tilt = 12.0;
  image.provenance.shift = 20.0;
  for (const bool onCt : {false, true})
  {
    const std::string text = derivationText(image, onCt);
    EXPECT_LE(text.size(), 900U);
    EXPECT_GT(text.size(), 300U) << "as many as fit";
    EXPECT_NE(text.find("1001-1002, 1011-1012"), std::string::npos) << text;
    EXPECT_NE(text.find(" others of 9000 interpolated"), std::string::npos) << text;
    EXPECT_NE(text.find("tilt of 12.0 degrees"), std::string::npos) << text;
  }
  image.provenance = {};
  EXPECT_EQ(derivationText(image, false), "");
  EXPECT_EQ(derivationText(image, true), "");
  image.provenance.isFaceMasked = true;
  EXPECT_EQ(derivationText(image, false), "face masked");
}

TEST_F(Provenance, NamesFourRangesInAPictureAndCountsTheOthers)
{
  scene::Case value;
  value.ct.geometry = core::GridGeometry({4, 4, kSlices}, Vector3d::Ones(), Vector3d::Zero());
  EXPECT_TRUE(interpolatedTexts(value).empty());
  value.ct.provenance.interpolated = gaps();
  scene::ImagePart mr = value.ct;
  mr.name = "T2";
  mr.provenance.interpolated = {{2, 2}, {6, 8}};
  value.mr = {mr};
  EXPECT_EQ(interpolatedTexts(value),
            (std::vector<std::string>{"CT: slices 6, 16, 26, 36 and 36 others interpolated",
                                      "T2: slices 3, 7-9 interpolated"}));
  EXPECT_EQ(provenanceTexts(value.mr[0]),
            (std::vector<std::string>{"slices 3, 7-9 of 450 interpolated between neighbours"}));
  value.mr[0].provenance.interpolated = {{4, 4}};
  EXPECT_EQ(interpolatedText(value.mr[0]), "slice 5 interpolated");
}

TEST_F(Provenance, MarksThePictureOfEachInterpolatedSliceAndSlabsThatHoldOne)
{
  scene::ImagePart image;
  image.geometry =
      core::GridGeometry({40, 40, kSlices}, Vector3d(0.5, 0.5, 0.6), Vector3d(1, 2, 3));
  image.provenance.interpolated = gaps();
  const auto shows = [&](SliceOrientation orientation, double slice, double thickness = 0.0)
  {
    const Vector3d at = image.geometry.patientFromVoxel(Vector3d(20, 20, slice));
    return showsInterpolated(image, SliceGeometry(orientation, at, 0.5, 100, 100), thickness);
  };
  for (int slice = 0; slice < kSlices; ++slice)
    EXPECT_EQ(shows(SliceOrientation::Axial, slice), volume::contains(gaps(), slice)) << slice;
  EXPECT_TRUE(shows(SliceOrientation::Axial, 5.4));
  EXPECT_FALSE(shows(SliceOrientation::Axial, 5.6));
  EXPECT_FALSE(shows(SliceOrientation::Coronal, 5.0)) << "across the slices";
  EXPECT_TRUE(shows(SliceOrientation::Axial, 8.0, 2.0 * 0.6 * 3.0));
  EXPECT_FALSE(shows(SliceOrientation::Axial, 8.0, 2.0 * 0.6 * 2.0));
}

TEST_F(Provenance, SaysWhichSidesAreAssumed)
{
  scene::Case value;
  EXPECT_TRUE(assumedSideTexts(value).empty());
  value.ct.provenance.assumedRas = true;
  scene::LabelPart part;
  part.structures.emplace_back();
  part.structures.back().name = "incus";
  part.provenance.assumedRas = false;
  value.labels = {part};
  const auto lines = assumedSideTexts(value);
  ASSERT_EQ(lines.size(), 2U);
  EXPECT_EQ(lines[0].find("CT: left and right taken as RAS axes"), 0U) << lines[0];
  EXPECT_EQ(lines[1].find("incus: left and right taken as LPS axes"), 0U) << lines[1];
  EXPECT_EQ(guessedNote(value.labels[0]).find("'incus': left and right taken as LPS axes"), 0U);
  EXPECT_NE(guessedNote(value.ct).find("left and right taken as RAS axes"), std::string::npos);
  EXPECT_NE(derivationText(value.ct, false).find("taken as RAS axes"), std::string::npos);
  value.labels[0].provenance = {};
  EXPECT_EQ(guessedNote(value.labels[0]), "");
}
