#include <fstream>
#include <iterator>
#include <limits>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "petrous/Scene/Manifest.h"

namespace petrous::scene
{
namespace
{

using nlohmann::json;
using volume::BurnedInText;
using volume::SliceRange;

constexpr int kSlices = 420;

Case imagesAndLabels()
{
  Case value;
  value.name = "ear";
  value.ct.name = "ct";
  value.ct.geometry =
      core::GridGeometry({8, 8, kSlices}, Eigen::Vector3d::Ones(), Eigen::Vector3d::Zero());
  ImagePart mr = value.ct;
  mr.name = "T2";
  value.mr = {mr};
  LabelPart part;
  part.structures.emplace_back();
  part.structures.back().name = "incus";
  part.structures.back().index = 1;
  value.labels = {part};
  return value;
}

std::vector<SliceRange> everyTenth(int count)
{
  std::vector<SliceRange> ranges;
  for (int n = 0; n < count; ++n)
    ranges.push_back({10 * n + 5, 10 * n + 5});
  return ranges;
}

Case again(const Case& value)
{
  return fromManifest(toManifest(value), "ear.json");
}

// As programs wrote it that kept no provenance.
Case withoutRecord(const Case& value)
{
  json j = json::parse(toManifest(value));
  j["ct"].erase("provenance");
  j["mr"][0].erase("provenance");
  j["labels"][0].erase("provenance");
  return fromManifest(j.dump(), "ear.json");
}

volume::ImageProvenance noted(const std::vector<std::string>& notes)
{
  Case value = imagesAndLabels();
  value.ct.notes = notes;
  return withoutRecord(value).ct.provenance;
}

TEST(Provenance, OfFortyGapsIsKeptSliceBySlice)
{
  Case value = imagesAndLabels();
  value.ct.provenance.interpolated = everyTenth(40);
  value.mr[0].provenance.interpolated = {{0, 2}, {4, 4}, {kSlices - 1, kSlices - 1}};
  const Case back = again(value);
  EXPECT_EQ(back.ct.provenance.interpolated, everyTenth(40));
  EXPECT_EQ(back.mr[0].provenance.interpolated, value.mr[0].provenance.interpolated);
  EXPECT_EQ(toManifest(back), toManifest(value));
}

TEST(Provenance, IsKeptInAllItsParts)
{
  Case value = imagesAndLabels();
  volume::ImageProvenance& ct = value.ct.provenance;
  ct.interpolatedBeyond = 2;
  ct.tilt = 18.5;
  ct.shift = 1.0 / 3.0;
  ct.assumedRas = false;
  ct.pixels = {BurnedInText::Stated, true, 12.5};
  ct.areEarsMasked = ct.isFaceMasked = true;
  value.mr[0].provenance.assumedRas = true;
  value.mr[0].provenance.pixels.burnedIn = BurnedInText::Suspected;
  value.mr[0].provenance.isCropped = true;
  value.labels[0].provenance = {true, true};
  const Case back = again(value);
  EXPECT_EQ(back.ct.provenance.interpolatedBeyond, 2);
  EXPECT_EQ(back.ct.provenance.tilt, 18.5);
  EXPECT_EQ(back.ct.provenance.shift, 1.0 / 3.0);
  EXPECT_EQ(back.ct.provenance.assumedRas, false);
  EXPECT_EQ(back.ct.provenance.pixels.burnedIn, BurnedInText::Stated);
  EXPECT_TRUE(back.ct.provenance.pixels.isLossy);
  EXPECT_EQ(back.ct.provenance.pixels.lossyRatio, 12.5);
  EXPECT_TRUE(back.ct.provenance.isFaceMasked);
  EXPECT_TRUE(back.ct.provenance.areEarsMasked);
  EXPECT_FALSE(back.ct.provenance.isCropped);
  EXPECT_EQ(back.mr[0].provenance.assumedRas, true);
  EXPECT_EQ(back.mr[0].provenance.pixels.burnedIn, BurnedInText::Suspected);
  EXPECT_FALSE(back.mr[0].provenance.pixels.isLossy);
  EXPECT_TRUE(back.mr[0].provenance.isCropped);
  EXPECT_FALSE(back.mr[0].provenance.isFaceMasked);
  EXPECT_EQ(back.labels[0].provenance.assumedRas, true);
  EXPECT_TRUE(back.labels[0].provenance.isFrameAssumed);
  EXPECT_EQ(toManifest(back), toManifest(value));
}

// Older programs open it, and mark what the notes tell them.
TEST(Provenance, NeedsNoNewFormat)
{
  Case value = imagesAndLabels();
  const auto formatOf = [](const Case& one)
  { return json::parse(toManifest(one)).at("petrous_case").get<int>(); };
  const int format = formatOf(value);
  value.ct.provenance.interpolated = everyTenth(40);
  value.labels[0].provenance.isFrameAssumed = true;
  EXPECT_EQ(formatOf(value), format);
}

TEST(Provenance, CountsAndNotTheNotes)
{
  Case value = imagesAndLabels();
  value.ct.notes = {"Repaired: slices 3, 7 to 9 of 420 were interpolated between neighbours",
                    "Compressed with loss, in 1 of 420 slices"};
  value.labels[0].notes = {"its frame of reference could not be compared with the CT's"};
  const Case back = again(value);
  EXPECT_TRUE(back.ct.provenance.interpolated.empty());
  EXPECT_FALSE(back.ct.provenance.pixels.isLossy);
  EXPECT_FALSE(back.labels[0].provenance.isFrameAssumed);
  EXPECT_EQ(back.ct.notes, value.ct.notes);
}

// The sentences are those of programs before the record.
TEST(Provenance, OfAnOlderCaseIsReadFromItsNotes)
{
  const auto many = noted({"Slices lie up to 0.02 mm off.",
                           "Repaired: slices 3, 7 to 9 of 420 were interpolated between "
                           "neighbours, up to 0.50 mm from what was measured; small structures may "
                           "be absent there."});
  EXPECT_EQ(many.interpolated, (std::vector<SliceRange>{{2, 2}, {6, 8}}));
  EXPECT_EQ(noted({"Repaired: slice 8 of 420 is missing from the files and was interpolated "
                   "between neighbours, up to 0.50 mm from what was measured; small structures may "
                   "be absent there."})
                .interpolated,
            (std::vector<SliceRange>{{7, 7}}));
  // Of more than 24 gaps older programs named the first and the last: none of those between may
  // pass for measured.
  EXPECT_EQ(noted({"Repaired: slices 6 to 396 of 420 are missing and were interpolated between "
                   "neighbours, up to 1.00 mm from what was measured; small structures may be "
                   "absent there."})
                .interpolated,
            (std::vector<SliceRange>{{5, 395}}));
  const auto tilt =
      noted({"Repaired: the gantry's tilt of 18.5 degrees was undone by shifting each "
             "slice to where its position puts it, the last by 12.3 mm against the "
             "first."});
  EXPECT_EQ(tilt.tilt, 18.5);
  EXPECT_EQ(tilt.shift, 12.3);
  const auto aside = noted({"Repaired: slices were shifted sideways to where their positions put "
                            "them, by up to 3.00 mm against the first."});
  EXPECT_EQ(aside.tilt, 0.0);
  EXPECT_EQ(aside.shift, 3.0);
  const auto pixels =
      noted({"The header states text in the pixels (Burned In Annotation), in 1 of 420 slices: it "
             "may name the patient; look at the image before it is handed on.",
             "Compressed with loss, to 1/12.5 of the size, in 3 of 420 slices: values are not "
             "those measured, and thin walls may be blurred; the archive may have the series "
             "without loss."})
          .pixels;
  EXPECT_EQ(pixels.burnedIn, BurnedInText::Stated);
  EXPECT_TRUE(pixels.isLossy);
  EXPECT_EQ(pixels.lossyRatio, 12.5);
  EXPECT_EQ(
      noted({"Text may be in the pixels, as of a screenshot or a converted image, in 1 of 420 "
             "slices: it may name the patient; look at the image before it is handed on."})
          .pixels.burnedIn,
      BurnedInText::Suspected);
  EXPECT_EQ(noted({"does not say which side of the patient is left; its axes were taken as LPS, as "
                   "asked"})
                .assumedRas,
            false);
  const auto mask =
      noted({"the face is masked to a plane 50 mm behind the tip of the nose, 5 mm or "
             "more below its skin (median 31 mm), with the auricles; cropped to a "
             "region"});
  EXPECT_TRUE(mask.isFaceMasked && mask.areEarsMasked && mask.isCropped);
  const auto none = noted({"The header states slices 0.3 mm apart.", "Repaired: each slice's own "
                                                                     "rescale was applied."});
  EXPECT_TRUE(none.interpolated.empty());
  EXPECT_FALSE(none.assumedRas || none.pixels.isLossy || none.isFaceMasked || none.isCropped);
}

// Forty gaps of a case on somebody's disk, of which only the first and last slice are known.
TEST(Provenance, OfAStoredOlderCaseMarksNoSliceTooFew)
{
  const std::string file = PETROUS_STORED "format-3-repaired.json";
  std::ifstream stream(file);
  const std::string text(std::istreambuf_iterator<char>(stream), {});
  ASSERT_EQ(text.find("provenance"), std::string::npos);
  const Case opened = fromManifest(text, file);
  for (const Case& value : {opened, again(opened)})
  {
    EXPECT_EQ(value.ct.geometry.dims()[2], 450);
    EXPECT_EQ(value.ct.provenance.interpolated, (std::vector<SliceRange>{{5, 395}}));
    EXPECT_EQ(value.ct.notes, opened.ct.notes);
    EXPECT_EQ(value.ct.provenance.tilt, 0.0);
    EXPECT_FALSE(value.ct.provenance.pixels.isLossy || value.ct.provenance.assumedRas);
    EXPECT_FALSE(value.labels.at(0).provenance.isFrameAssumed);
  }
  const json saved = json::parse(toManifest(opened));
  EXPECT_EQ(saved.at("petrous_case"), 3) << "older programs still open it";
}

TEST(Provenance, OfOlderLabelsIsReadFromTheirNotes)
{
  Case value = imagesAndLabels();
  value.labels[0].notes = {"does not say which side of the patient is left; its axes were taken as "
                           "RAS, as its grid is then that of an image of the case",
                           "its frame of reference could not be compared with the CT's, as it "
                           "states none; look whether it lies where it belongs"};
  const Case back = withoutRecord(value);
  EXPECT_EQ(back.labels[0].provenance.assumedRas, true);
  EXPECT_TRUE(back.labels[0].provenance.isFrameAssumed);
  const Case saved = again(back);
  EXPECT_EQ(saved.labels[0].provenance.assumedRas, true);
  EXPECT_TRUE(saved.labels[0].provenance.isFrameAssumed);
}

TEST(Provenance, TakesNoSliceFromANoteOfAnotherGridOrOneThatIsBent)
{
  for (const char* note :
       {"Repaired: slices 3 of 61 were interpolated between neighbours",
        "Repaired: slices 0 of 420 were interpolated between neighbours",
        "Repaired: slices 9 to 3 of 420 were interpolated between neighbours",
        "Repaired: slices 3 to 421 of 420 were interpolated between neighbours",
        "Repaired: slices 99999999999999999999 of 420 were interpolated between neighbours",
        "Repaired: slices 3 of", "Repaired: slices  of 420 were interpolated between neighbours"})
    EXPECT_TRUE(noted({note}).interpolated.empty()) << note;
  EXPECT_FALSE(noted({"Compressed with loss, to 1/-3 of the size"}).pixels.lossyRatio);
}

// Programs before format 10 would drop it, and lay what comes later on the grid of the file.
TEST(Provenance, OfCorrectedAxesIsKeptAndIsOfFormat10)
{
  const Case none = imagesAndLabels();
  const auto formatOf = [](const Case& value)
  { return json::parse(toManifest(value)).at("petrous_case").get<int>(); };
  EXPECT_LT(formatOf(none), 10);
  EXPECT_TRUE(again(none).ct.provenance.axes.isIdentity());
  Case value = none;
  value.ct.provenance.axes = core::AxesCorrection::parse("RPS");
  EXPECT_EQ(formatOf(value), 10);
  EXPECT_EQ(again(value).ct.provenance.axes.letters(), "RPS");
  value = none;
  value.mr[0].provenance.axes = core::AxesCorrection::parse("SLA");
  EXPECT_EQ(formatOf(value), 10);
  EXPECT_EQ(again(value).mr[0].provenance.axes.letters(), "SLA");
  value = none;
  value.labels[0].provenance.axes = core::AxesCorrection::parse("LAI");
  EXPECT_EQ(formatOf(value), 10);
  const Case back = again(value);
  EXPECT_EQ(back.labels[0].provenance.axes.letters(), "LAI");
  EXPECT_TRUE(back.ct.provenance.axes.isIdentity());
  EXPECT_EQ(toManifest(back), toManifest(value));
}

// Programs before format 10 would drop it, and add labels that were drawn on the unrepaired slices
// without a question, apart by the gap.
TEST(Provenance, OfSlicesInterpolatedBeyondARegionIsOfFormat10)
{
  const auto formatOf = [](const Case& value)
  { return json::parse(toManifest(value)).at("petrous_case").get<int>(); };
  Case value = imagesAndLabels();
  value.ct.provenance.interpolated = {{4, 4}};
  EXPECT_EQ(formatOf(value), 3) << "within it";
  value.ct.provenance.interpolatedBeyond = 1;
  EXPECT_EQ(formatOf(value), 10);
  value.ct.provenance.interpolatedBeyond = 0;
  value.mr[0].provenance.interpolatedBeyond = 3;
  EXPECT_EQ(formatOf(value), 10);
  EXPECT_EQ(again(value).mr[0].provenance.interpolatedBeyond, 3);
}

TEST(Provenance, ThatCannotBeIsRefused)
{
  const json good = json::parse(toManifest(imagesAndLabels()));
  const auto refused = [&good](const char* pointer, const json& bad)
  {
    json j = good;
    j[json::json_pointer(std::string(pointer))] = bad;
    EXPECT_THROW(fromManifest(j.dump(), "m.json"), ManifestError) << pointer << " " << bad;
  };
  for (const json& slices :
       {json{{0, 1}}, json{{3, 2}}, json{{1, 421}}, json{{5, 6}, {6, 7}}, json{{5, 6}, {7, 7}},
        json{{9, 9}, {2, 2}}, json{{1}}, json{{1, 2, 3}}, json{{"a", "b"}}, json(7)})
    refused("/ct/provenance/interpolated_slices", slices);
  refused("/ct/provenance/tilt_deg", nullptr);
  refused("/ct/provenance/assumed_axes", "left");
  refused("/ct/provenance/corrected_axes", "LLS");
  refused("/ct/provenance/corrected_axes", 7);
  refused("/labels/0/provenance/corrected_axes", "none");
  refused("/ct/provenance/burned_in_text", "maybe");
  for (const json& count : {json(-1), json(1.5), json(4294967296), json(4294967297),
                            json(std::numeric_limits<int>::max()), json(100001), json("1")})
    refused("/ct/provenance/interpolated_slices_beyond", count);
  refused("/ct/provenance/lossy_ratio", 0.0);
  refused("/ct/provenance/masked", {"nose"});
  refused("/ct/provenance", json::array());
  refused("/mr/0/provenance", "none");
  refused("/labels/0/provenance/assumed_axes", 1);
  refused("/labels/0/provenance", json::array());
  Case value = imagesAndLabels();
  value.ct.provenance.shift = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(toManifest(value), core::InvalidParameter);
}

} // namespace
} // namespace petrous::scene
