#include "petrous/Imaging/SeriesGeometry.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <memory>
#include <random>
#include <set>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "SeriesRepair.h"

namespace petrous::imaging
{
namespace
{

using Headers = std::vector<SliceHeader>;

/// A straight stack of 100 x 80 pixels of 0.4 mm: slice k at origin + k * spacing * normal.
Headers stack(int count, double spacing = 0.6,
              const Eigen::Matrix3d& axes = Eigen::Matrix3d::Identity(),
              const Eigen::Vector3d& origin = {-20.0, -16.0, 100.0})
{
  Headers slices;
  for (int k = 0; k < count; ++k)
  {
    SliceHeader slice;
    slice.file = "slice" + std::to_string(k);
    slice.position = origin + axes.col(2) * (spacing * k);
    slice.rowDirection = axes.col(0);
    slice.columnDirection = axes.col(1);
    slice.pixelSpacing = Eigen::Vector2d(0.4, 0.4);
    slice.rows = 80;
    slice.columns = 100;
    slice.instanceNumber = k + 1;
    slice.imageType = {"ORIGINAL", "PRIMARY", "AXIAL"};
    slices.push_back(slice);
  }
  return slices;
}

bool has(const SeriesGeometry& series, FindingKind kind)
{
  return std::any_of(series.findings.begin(), series.findings.end(),
                     [kind](const Finding& f) { return f.kind == kind; });
}

Finding only(const SeriesGeometry& series)
{
  EXPECT_EQ(series.findings.size(), 1U);
  EXPECT_NE(series.verdict, Verdict::Ok);
  return series.findings.empty() ? Finding{FindingKind::Unreadable, "", -1.0}
                                 : series.findings.front();
}

TEST(SeriesGeometry, AcceptsAStraightStackAndStatesItsGrid)
{
  Headers slices = stack(20);
  for (SliceHeader& slice : slices)
    slice.pixelSpacing = Eigen::Vector2d(0.5, 0.4); // DICOM order: rows first
  const SeriesGeometry series = assess(slices);
  EXPECT_EQ(series.verdict, Verdict::Ok);
  EXPECT_TRUE(series.findings.empty());
  ASSERT_TRUE(series.grid);
  EXPECT_EQ(series.grid->dims(), (core::Index3{100, 80, 20}));
  EXPECT_TRUE(series.grid->spacing().isApprox(Eigen::Vector3d(0.4, 0.5, 0.6), 1e-12));
  EXPECT_TRUE(series.grid->origin().isApprox(Eigen::Vector3d(-20.0, -16.0, 100.0), 1e-12));
  EXPECT_TRUE(series.grid->direction().isApprox(Eigen::Matrix3d::Identity(), 1e-12));
}

TEST(SeriesGeometry, DoesNotDependOnTheOrderOfTheFiles)
{
  Headers slices = stack(30);
  slices.erase(slices.begin() + 12);
  const SeriesGeometry expected = assess(slices);
  std::mt19937 random(7);
  for (int trial = 0; trial < 20; ++trial)
  {
    std::shuffle(slices.begin(), slices.end(), random);
    const SeriesGeometry series = assess(slices);
    ASSERT_EQ(series.slices.size(), expected.slices.size());
    for (std::size_t k = 0; k < series.slices.size(); ++k)
      EXPECT_EQ(series.slices[k].file, expected.slices[k].file);
    EXPECT_TRUE(core::sameGrid(*series.grid, *expected.grid));
    EXPECT_EQ(series.findings.front().text, expected.findings.front().text);
  }
}

TEST(SeriesGeometry, SortsByPositionNotByInstanceNumber)
{
  Headers slices = stack(10);
  for (int k = 0; k < 10; ++k)
    slices[static_cast<std::size_t>(k)].instanceNumber = 10 - k; // feet first
  const SeriesGeometry series = assess(slices);
  EXPECT_EQ(series.verdict, Verdict::Ok);
  EXPECT_EQ(series.slices.front().file, "slice0");
}

TEST(SeriesGeometry, PlacesEverySliceOfAnObliqueStackWhereItsFileSays)
{
  const Eigen::Matrix3d axes =
      (Eigen::AngleAxisd(0.4, Eigen::Vector3d(1, 2, 3).normalized())).toRotationMatrix();
  const SeriesGeometry series = assess(stack(15, 0.7, axes));
  ASSERT_EQ(series.verdict, Verdict::Ok);
  for (int k = 0; k < 15; ++k)
    EXPECT_LT((series.grid->patientFromVoxel({0.0, 0.0, double(k)}) -
               *series.slices[static_cast<std::size_t>(k)].position)
                  .norm(),
              1e-9);
}

TEST(SeriesGeometry, FollowsANormalThatPointsDown)
{
  Eigen::Matrix3d axes;
  axes << 1, 0, 0, 0, -1, 0, 0, 0, -1; // rows to the left, columns anterior
  const SeriesGeometry series = assess(stack(5, 2.0, axes));
  ASSERT_EQ(series.verdict, Verdict::Ok);
  EXPECT_GT(series.grid->direction().determinant(), 0.0);
  EXPECT_DOUBLE_EQ(series.grid->origin()[2], 100.0); // the highest slice is the first
  EXPECT_NEAR(series.grid->patientFromVoxel({0, 0, 4})[2], 92.0, 1e-12);
}

TEST(SeriesGeometry, AcceptsCosinesRoundedToFourDigits)
{
  const Eigen::Matrix3d exact =
      (Eigen::AngleAxisd(0.3, Eigen::Vector3d(3, 1, 1).normalized())).toRotationMatrix();
  Headers slices = stack(10, 1.0, exact);
  for (SliceHeader& slice : slices)
  {
    slice.rowDirection = (*slice.rowDirection * 1e4).array().round().matrix() / 1e4;
    slice.columnDirection = (*slice.columnDirection * 1e4).array().round().matrix() / 1e4;
  }
  EXPECT_EQ(assess(slices).verdict, Verdict::Ok);
}

TEST(SeriesGeometry, AcceptsAndNotesJitterBelowATenthOfTheSpacing)
{
  Headers slices = stack(20, 1.0);
  (*slices[7].position)[2] += 0.09;
  (*slices[9].position)[0] += 0.045;
  const SeriesGeometry series = assess(slices);
  EXPECT_EQ(series.verdict, Verdict::Ok);
  EXPECT_EQ(series.notes.size(), 2U);
}

TEST(SeriesGeometry, RefusesJitterAboveATenthOfTheSpacing)
{
  Headers slices = stack(20, 1.0);
  (*slices[7].position)[2] += 0.12;
  const Finding finding = only(assess(slices));
  EXPECT_EQ(finding.kind, FindingKind::UnevenSpacing);
  EXPECT_NEAR(finding.errorMm, 0.12, 1e-9);
}

TEST(SeriesGeometry, RefusesASlicePushedSidewaysByMoreThanATenthOfAPixel)
{
  Headers slices = stack(20, 20.0);
  (*slices[7].position)[0] += 0.06;
  EXPECT_EQ(only(assess(slices)).kind, FindingKind::UnevenSpacing);
}

TEST(SeriesGeometry, AcceptsPositionsRoundedToTheDecimalsOfTheFile)
{
  for (const double step : {0.01, 0.1})
  {
    Headers slices = stack(60, 1.0 / 3.0);
    for (SliceHeader& slice : slices)
    {
      slice.position = (*slice.position / step).array().round().matrix() * step;
      slice.positionStep = step;
    }
    const SeriesGeometry series = assess(slices);
    EXPECT_EQ(series.verdict, Verdict::Ok) << step;
    ASSERT_EQ(series.notes.size(), 1U);
    EXPECT_NE(series.notes.front().find(" mm off an even spacing"), std::string::npos);
    EXPECT_NEAR(series.grid->spacing()[2], 1.0 / 3.0, step / 59.0);
  }
}

// A writer that trims zeros has one decimal in some slices and two in others: it rounds to two.
TEST(SeriesGeometry, TakesTheFinestDecimalsOfAStackForItsRounding)
{
  Headers slices = stack(40, 0.25);
  for (std::size_t k = 0; k < slices.size(); ++k)
    slices[k].positionStep = k % 2 == 0 ? 0.1 : 0.01; // 4.5, 4.75
  EXPECT_EQ(assess(slices).verdict, Verdict::Ok);
  slices[3].positionStep = 0.0; // 4, of which nothing is known
  EXPECT_EQ(assess(slices).verdict, Verdict::Ok);
  (*slices[17].position)[2] += 0.09; // more than a third of the spacing
  EXPECT_EQ(only(assess(slices)).kind, FindingKind::UnevenSpacing);
}

TEST(SeriesGeometry, CallsRepairableWhatThePositionsSettle)
{
  const auto verdictOf = [](const std::function<void(Headers&)>& change)
  {
    Headers slices = stack(40, 1.0);
    change(slices);
    return assess(slices).verdict;
  };
  EXPECT_EQ(verdictOf([](Headers& s) { s.erase(s.begin() + 5); }), Verdict::Repairable);
  EXPECT_EQ(verdictOf([](Headers& s) { s.erase(s.begin() + 5, s.begin() + 7); }), Verdict::Refused);
  EXPECT_EQ(verdictOf([](Headers& s) { (*s[5].position)[2] += 0.3; }), Verdict::Repairable);
  EXPECT_EQ(verdictOf([](Headers& s) { s.push_back(s[4]); }), Verdict::Repairable);
  EXPECT_EQ(verdictOf([](Headers& s) { s.insert(s.end(), s.begin(), s.begin() + 20); }),
            Verdict::Refused);
  EXPECT_EQ(verdictOf([](Headers& s) { s[4].slope = 2.0; }), Verdict::Repairable);
  EXPECT_EQ(verdictOf([](Headers& s) { s[4].rows = 12; }), Verdict::Refused);
  // A damaged slice that says where it stands is as good as missing, unless it is an end.
  EXPECT_EQ(verdictOf([](Headers& s) { s[4].damage = "is cut short"; }), Verdict::Repairable);
  EXPECT_EQ(verdictOf([](Headers& s) { s[0].damage = "is cut short"; }), Verdict::Refused);
  EXPECT_EQ(verdictOf([](Headers& s) { s[39].damage = "is cut short"; }), Verdict::Refused);
  EXPECT_EQ(verdictOf([](Headers& s) { s[4].damage = s[5].damage = "is cut short"; }),
            Verdict::Refused);
  EXPECT_EQ(verdictOf(
                [](Headers& s)
                {
                  s[4].damage = "is cut short";
                  s[4].position.reset();
                }),
            Verdict::Refused);
  EXPECT_EQ(verdictOf(
                [](Headers& s)
                {
                  s[4].damage = "is cut short";
                  std::swap(s[4].rowDirection, s[4].columnDirection);
                }),
            Verdict::Refused)
      << "a slice of another stack";
}

TEST(SeriesGeometry, LeavesOutPicturesInColour)
{
  Headers slices = stack(6);
  SliceHeader page = slices.back();
  page.pixels.samplesPerPixel = 3;
  page.position.reset();
  slices.push_back(page);
  const SeriesGeometry series = assess(slices);
  EXPECT_EQ(series.verdict, Verdict::Ok);
  EXPECT_EQ(series.slices.size(), 6U);
  ASSERT_EQ(series.notes.size(), 1U);
  EXPECT_NE(series.notes.front().find("1 of 7 slices"), std::string::npos) << series.notes.front();
}

TEST(SeriesGeometry, StatesTheMillimetresOfAGantryTilt)
{
  // Tilt t about the patient's x axis; the table advances 1.25 mm in z per slice.
  const double tilt = 12.0 * M_PI / 180.0;
  Eigen::Matrix3d axes = Eigen::AngleAxisd(tilt, Eigen::Vector3d::UnitX()).toRotationMatrix();
  Headers slices = stack(41, 1.0, axes);
  for (int k = 0; k < 41; ++k)
    slices[static_cast<std::size_t>(k)].position = Eigen::Vector3d(-20, -16, 100 + 1.25 * k);
  const SeriesGeometry series = assess(slices);
  const Finding finding = only(series);
  EXPECT_EQ(finding.kind, FindingKind::GantryTilt);
  EXPECT_NEAR(finding.errorMm, 0.5 * 50.0 * std::sin(tilt), 1e-6);
  EXPECT_NEAR(series.grid->spacing()[2], 1.25 * std::cos(tilt), 1e-9);
  EXPECT_NE(finding.text.find("12.0 degrees"), std::string::npos) << finding.text;
}

TEST(SeriesGeometry, TellsATiltAlsoWhenASliceIsMissing)
{
  Headers slices = stack(30, 1.0);
  for (int k = 0; k < 30; ++k)
    (*slices[static_cast<std::size_t>(k)].position)[1] += 0.2 * k;
  slices.erase(slices.begin() + 10);
  const SeriesGeometry series = assess(slices);
  EXPECT_TRUE(has(series, FindingKind::GantryTilt));
  EXPECT_TRUE(has(series, FindingKind::MissingSlice));
  EXPECT_EQ(series.findings.size(), 2U);
}

TEST(SeriesGeometry, DoesNotTakeOneShiftedSliceForATilt)
{
  Headers slices = stack(30, 1.0);
  (*slices[29].position)[0] += 3.0;
  const Finding finding = only(assess(slices));
  EXPECT_EQ(finding.kind, FindingKind::UnevenSpacing);
  EXPECT_NEAR(finding.errorMm, 3.0, 1e-9);
}

TEST(SeriesGeometry, NamesTheMissingSlicesAndTheMillimetresAtStake)
{
  Headers slices = stack(20, 0.6);
  slices.erase(slices.begin() + 5, slices.begin() + 7);
  const SeriesGeometry series = assess(slices);
  const Finding finding = only(series);
  EXPECT_EQ(finding.kind, FindingKind::MissingSlice);
  EXPECT_NEAR(finding.errorMm, 1.2, 1e-9);
  EXPECT_NE(finding.text.find("2 slices are missing"), std::string::npos) << finding.text;
  EXPECT_NE(finding.text.find("between 102.40 and 104.20 mm"), std::string::npos) << finding.text;
  EXPECT_NEAR(series.grid->spacing()[2], 0.6, 1e-9);
}

TEST(SeriesGeometry, CallsAChangeOfPitchUneven)
{
  Headers slices = stack(20, 1.0);
  for (int k = 10; k < 20; ++k)
    (*slices[static_cast<std::size_t>(k)].position)[2] = 109.0 + 2.0 * (k - 9);
  EXPECT_EQ(only(assess(slices)).kind, FindingKind::UnevenSpacing);
  EXPECT_EQ(assess(slices).verdict, Verdict::Repairable)
      << "where slices stand is what was measured";
}

TEST(SeriesGeometry, CallsAFractionalGapUneven)
{
  Headers slices = stack(20, 1.0);
  for (int k = 10; k < 20; ++k)
    (*slices[static_cast<std::size_t>(k)].position)[2] += 0.5;
  EXPECT_EQ(only(assess(slices)).kind, FindingKind::UnevenSpacing);
}

/// A stack whose slices stand at `places`, mm.
Headers stackAt(const std::vector<double>& places)
{
  Headers slices = stack(static_cast<int>(places.size()));
  for (std::size_t k = 0; k < places.size(); ++k)
    slices[k].position = Eigen::Vector3d(-20.0, -16.0, 100.0 + places[k]);
  return slices;
}

TEST(SeriesGeometry, InterpolatesNoMoreThanOneMissingSlicesWorth)
{
  for (const double gap : {1.3, 1.5, 1.9, 2.0, 2.04, 2.1, 2.3, 2.5, 2.9, 3.0, 7.5, 30.0, 30.5})
  {
    std::vector<double> places;
    for (int k = 0; k < 40; ++k)
      places.push_back(0.5 * (k < 20 ? k : k - 1 + gap));
    const SeriesGeometry series = assess(stackAt(places));
    EXPECT_EQ(series.verdict, gap > 2.05 ? Verdict::Refused : Verdict::Repairable) << gap;
    const std::string text = only(series).text;
    EXPECT_EQ(text.find("is not interpolated") != std::string::npos, gap > 2.05) << text;
    if (gap == 30.5)
    {
      EXPECT_NE(text.find("Nothing was measured for 15.25 mm between 109.50 and 124.75 mm"),
                std::string::npos)
          << text;
    }
  }
}

TEST(SeriesGeometry, GuessesFewSlicesOnly)
{
  // `pattern`: gaps in mm, repeated
  const auto of = [](const std::vector<double>& pattern, std::size_t count)
  {
    std::vector<double> places{0.0};
    for (std::size_t k = 0; k + 1 < count; ++k)
      places.push_back(places.back() + pattern[k % pattern.size()]);
    return assess(stackAt(places));
  };
  const SeriesGeometry third = of({1, 2}, 41);
  EXPECT_EQ(third.verdict, Verdict::Refused);
  EXPECT_NE(only(third).text.find("In 20 places, 20.0 mm of 60.0 mm, a slice would have to be "
                                  "guessed; at most 4 slices are interpolated."),
            std::string::npos)
      << only(third).text;
  EXPECT_EQ(of({1, 1.7}, 41).verdict, Verdict::Refused) << "no whole gaps";
  EXPECT_EQ(of({1, 1, 1, 2, 2, 2}, 41).verdict, Verdict::Refused) << "no pitch that is set once";
  EXPECT_EQ(of({1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 2}, 41).verdict, Verdict::Repairable);
  EXPECT_EQ(of({1, 1, 1, 2, 1, 1, 1, 1}, 6).verdict, Verdict::Repairable) << "one, of few";
}

TEST(SeriesGeometry, TellsALossFromAPitchByTheInstanceNumbers)
{
  // 100 slices at 1 mm, of which 31, 33 … 69 are gone.
  Headers lost;
  for (int k = 0; k < 100; ++k)
    if (k < 31 || k > 69 || k % 2 == 0)
      lost.push_back(stack(100, 1.0)[static_cast<std::size_t>(k)]);
  const SeriesGeometry cut = assess(lost);
  EXPECT_EQ(cut.verdict, Verdict::Refused);
  EXPECT_EQ(only(cut).kind, FindingKind::MissingSlice);
  EXPECT_NE(only(cut).text.find("20 slices are missing"), std::string::npos) << only(cut).text;
  EXPECT_NE(only(cut).text.find("at most 8 slices are interpolated"), std::string::npos)
      << only(cut).text;
  // The same places, numbered on: the scanner took them so.
  Headers taken = lost;
  for (std::size_t k = 0; k < taken.size(); ++k)
    taken[k].instanceNumber = static_cast<int>(k) + 1;
  EXPECT_EQ(assess(taken).verdict, Verdict::Repairable);
  EXPECT_EQ(only(assess(taken)).kind, FindingKind::UnevenSpacing);
  // Downwards, and in steps of ten.
  for (std::size_t k = 0; k < taken.size(); ++k)
    taken[k].instanceNumber = 1000 - 10 * static_cast<int>(k);
  EXPECT_EQ(assess(taken).verdict, Verdict::Repairable);
  for (SliceHeader& slice : lost)
    slice.instanceNumber = 10 * (200 - slice.instanceNumber);
  EXPECT_EQ(assess(lost).verdict, Verdict::Refused);
  // Without numbers nobody knows; twenty of eighty are too many to guess.
  for (SliceHeader& slice : lost)
    slice.instanceNumber = 0;
  EXPECT_EQ(assess(lost).verdict, Verdict::Refused);
}

/// Of `count` slices at 1 mm, numbered from 1, those for which `isThere`.
Headers without(int count, const std::function<bool(int)>& isThere)
{
  Headers rest;
  for (const SliceHeader& slice : stack(count, 1.0))
    if (isThere(slice.instanceNumber - 1))
      rest.push_back(slice);
  return rest;
}

void numberOn(Headers& slices, int step)
{
  for (std::size_t k = 0; k < slices.size(); ++k)
    slices[k].instanceNumber = step * (static_cast<int>(k) + 1);
}

// The gaps that loss leaves are more than the others.
TEST(SeriesGeometry, TakesNoLossForTheSpacingHoweverCommon)
{
  struct Loss
  {
    const char* what;
    int count, missing;
    std::function<bool(int)> isThere;
  };
  const Loss losses[] = {
      {"middle", 166, 63, [](int k) { return k < 20 || k > 146 || k % 2 == 0; }},
      {"nearly all", 99, 46, [](int k) { return k < 7 || k % 2 == 0; }},
      {"two of three", 100, 60, [](int k) { return k < 10 || k % 3 == 0; }},
      {"first third", 90, 15, [](int k) { return k > 30 || k % 2 == 0; }},
      {"last third", 91, 15, [](int k) { return k < 60 || k % 2 == 0; }},
      {"no two fine gaps in a row", 91, 30, [](int k) { return k % 3 != 2; }},
      {"one fine gap of three", 101, 40,
       [](int k) { return k % 5 == 0 || k % 5 == 1 || k % 5 == 3; }},
  };
  for (const Loss& loss : losses)
    for (const int step : {1, 10, -1})
    {
      Headers slices = without(loss.count, loss.isThere);
      ASSERT_EQ(static_cast<int>(slices.size()), loss.count - loss.missing) << loss.what;
      for (SliceHeader& slice : slices)
        slice.instanceNumber = 2000 + step * slice.instanceNumber;
      const SeriesGeometry series = assess(slices);
      EXPECT_EQ(series.verdict, Verdict::Refused) << loss.what;
      const Finding finding = only(series);
      EXPECT_EQ(finding.kind, FindingKind::MissingSlice) << loss.what << ": " << finding.text;
      EXPECT_NEAR(finding.errorMm, loss.missing, 1e-6) << loss.what;
      EXPECT_EQ(finding.text.find(std::to_string(loss.missing) + " slices are missing"), 0U)
          << loss.what << ": " << finding.text;
    }
}

TEST(SeriesGeometry, SaysWhereALossCannotBeTold)
{
  Headers slices = without(166, [](int k) { return k < 20 || k > 146 || k % 2 == 0; });
  for (SliceHeader& slice : slices)
    slice.instanceNumber = 0;
  const SeriesGeometry none = assess(slices);
  EXPECT_EQ(none.verdict, Verdict::Refused);
  EXPECT_NE(only(none).text.find("In 63 places, 63.0 mm of 165.0 mm, a slice would have to be "
                                 "guessed; at most 10 slices are interpolated. Whether slices were "
                                 "lost there or taken farther apart cannot be told"),
            std::string::npos)
      << only(none).text;
  std::mt19937 random(3); // numbers that run nowhere
  for (SliceHeader& slice : slices)
    slice.instanceNumber = static_cast<int>(random() % 10000);
  EXPECT_EQ(assess(slices).verdict, Verdict::Refused);
  // Numbered on, the scanner took them so, as most of the stack or as a part.
  for (const int step : {1, 5, -1})
  {
    numberOn(slices, step);
    EXPECT_EQ(assess(slices).verdict, Verdict::Repairable) << step;
    EXPECT_EQ(only(assess(slices)).kind, FindingKind::UnevenSpacing);
    EXPECT_EQ(only(assess(slices)).text.find("cannot be told"), std::string::npos);
  }
  // Frames are numbered as they lie in the file; their places in the stack tell.
  for (std::size_t k = 0; k < slices.size(); ++k)
  {
    slices[k].instanceNumber = static_cast<int>(k) + 1;
    slices[k].pixels.frameCount = static_cast<int>(slices.size());
  }
  EXPECT_EQ(assess(slices).verdict, Verdict::Refused);
  EXPECT_EQ(only(assess(slices)).kind, FindingKind::UnevenSpacing);
  for (SliceHeader& slice : slices)
    slice.stackPosition = static_cast<int>(std::lround((*slice.position)[2] - 99.0));
  EXPECT_EQ(assess(slices).verdict, Verdict::Refused);
  EXPECT_EQ(only(assess(slices)).kind, FindingKind::MissingSlice);
  for (SliceHeader& slice : slices)
    slice.stackPosition = slice.instanceNumber;
  EXPECT_EQ(assess(slices).verdict, Verdict::Repairable);
}

// 2, 2, 1 mm: 1.67 mm in whole millimetres.
TEST(SeriesGeometry, TakesNoRoundingForALoss)
{
  for (const double step : {0.1, 0.01})
    for (const double ratio : {1.67, 1.75, 2.5})
    {
      Headers slices = stack(60, ratio * step);
      for (SliceHeader& slice : slices)
      {
        slice.position = (*slice.position / step).array().round().matrix() * step;
        slice.positionStep = step;
      }
      EXPECT_EQ(assess(slices).verdict, Verdict::Ok) << ratio << " x " << step;
    }
}

TEST(SeriesGeometry, WhatIsKnownOfThePixelsIsThatOfTheWorstSlice)
{
  for (const auto text : {BurnedInText::None, BurnedInText::Suspected, BurnedInText::Stated})
    for (const bool isLossy : {false, true})
      for (const double ratio : {0.0, 12.5})
      {
        Headers slices = stack(6, 1.0);
        slices[2].burnedIn = text;
        slices[4].isLossy = isLossy;
        if (isLossy && ratio > 0.0)
          slices[4].lossyRatio = ratio;
        const PixelFaults faults = pixelFaults(slices);
        EXPECT_EQ(faults.burnedIn, text);
        EXPECT_EQ(faults.isLossy, isLossy);
        EXPECT_EQ(faults.lossyRatio.value_or(0.0), isLossy ? ratio : 0.0);
        EXPECT_EQ(assess(slices).notes.size(),
                  (isLossy ? 1U : 0U) + (text == BurnedInText::None ? 0U : 1U));
      }
}

TEST(SeriesGeometry, CountsASliceThatCameTwiceOnceAmongThoseThatAllowGuessing)
{
  Headers slices = stack(29, 1.0);
  slices.erase(slices.begin() + 20);
  slices.erase(slices.begin() + 14);
  slices.erase(slices.begin() + 7);
  ASSERT_EQ(slices.size(), 26U); // three guessed of twenty-nine, two allowed
  EXPECT_EQ(assess(slices).verdict, Verdict::Refused);
  EXPECT_FALSE(assess(slices).isBridgeable);
  const Headers once = slices;
  for (const std::size_t twice : {0U, 1U, 2U, 3U}) // thirty files of as many slices
    slices.push_back(once[twice]);
  EXPECT_FALSE(assess(slices).isBridgeable);
}

TEST(SeriesGeometry, NamesADuplicateSlice)
{
  Headers slices = stack(20, 1.0);
  slices.push_back(slices[4]);
  const SeriesGeometry series = assess(slices);
  EXPECT_EQ(only(series).kind, FindingKind::DuplicateSlice);
  EXPECT_NEAR(series.findings.front().errorMm, 1.0, 1e-9);
}

TEST(SeriesGeometry, NamesTwoAcquisitionsAtTheSamePlaces)
{
  Headers slices = stack(20, 1.0);
  const Headers again = stack(20, 1.0);
  slices.insert(slices.end(), again.begin(), again.end());
  const SeriesGeometry series = assess(slices);
  EXPECT_EQ(only(series).kind, FindingKind::DuplicateSlice);
  EXPECT_NEAR(series.grid->spacing()[2], 1.0, 1e-9);
}

TEST(SeriesGeometry, CallsNoDuplicateWhatLiesBesideASlice)
{
  Headers slices = stack(20);
  Headers beside = stack(20, 0.6, Eigen::Matrix3d::Identity(), {60.0, -16.0, 100.0});
  slices.insert(slices.end(), beside.begin(), beside.end());
  const Finding finding = only(assess(slices));
  EXPECT_EQ(finding.kind, FindingKind::SideBySide);
  EXPECT_NEAR(finding.errorMm, 80.0, 1e-9);
  EXPECT_EQ(assess(slices).verdict, Verdict::Refused);
  // The same place but for the tolerance is a duplicate.
  Headers twice = stack(20);
  twice.push_back(twice[7]);
  (*twice.back().position)[0] += 0.04;
  EXPECT_EQ(only(assess(twice)).kind, FindingKind::DuplicateSlice);
  (*twice.back().position)[0] += 0.3;
  EXPECT_EQ(only(assess(twice)).kind, FindingKind::SideBySide);
}

TEST(SeriesGeometry, NeverCallsALeanOfMoreThan45DegreesATilt)
{
  Headers slices = stack(20);
  for (std::size_t k = 0; k < slices.size(); k += 2)
    (*slices[k].position)[1] += 80.0;
  const SeriesGeometry series = assess(slices);
  EXPECT_FALSE(has(series, FindingKind::GantryTilt));
  EXPECT_TRUE(has(series, FindingKind::UnevenSpacing));
}

TEST(SeriesGeometry, HasNoGridWhenAllSlicesShareOnePlace)
{
  Headers slices(4, stack(1).front());
  const SeriesGeometry series = assess(slices);
  EXPECT_EQ(only(series).kind, FindingKind::DuplicateSlice);
  EXPECT_FALSE(series.grid);
}

TEST(SeriesGeometry, SetsATurnedSliceAside)
{
  Headers slices = stack(20, 1.0);
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(0.1, Eigen::Vector3d::UnitX()).toRotationMatrix();
  slices[19].columnDirection = turn.col(1);
  const SeriesGeometry series = assess(slices);
  const Finding finding = only(series);
  EXPECT_EQ(finding.kind, FindingKind::OddOrientation);
  EXPECT_NEAR(finding.errorMm, 2.0 * std::sin(0.05) * 80 * 0.4, 1e-6);
  EXPECT_NE(finding.text.find("rows or columns by up to 5.7 degrees, their normals by up to 5.7"),
            std::string::npos)
      << finding.text;
  EXPECT_EQ(series.slices.size(), 19U);
}

TEST(SeriesGeometry, SaysHowFarASliceIsTurnedInItsPlane)
{
  Headers slices = stack(20, 1.0);
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(0.5, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  slices[19].rowDirection = turn.col(0);
  slices[19].columnDirection = turn.col(1);
  const Finding turned = only(assess(slices));
  EXPECT_EQ(turned.kind, FindingKind::OddOrientation);
  EXPECT_NE(turned.text.find("are turned against"), std::string::npos) << turned.text;
  EXPECT_NE(turned.text.find("up to 28.6 degrees, within their plane"), std::string::npos)
      << turned.text;
  slices = stack(20, 1.0);
  slices[19].rowDirection = -*slices[19].rowDirection;
  const Finding mirrored = only(assess(slices));
  EXPECT_EQ(mirrored.kind, FindingKind::OddOrientation);
  EXPECT_NE(mirrored.text.find("turned or mirrored"), std::string::npos) << mirrored.text;
  EXPECT_NE(mirrored.text.find("up to 180.0 degrees"), std::string::npos) << mirrored.text;
}

TEST(SeriesGeometry, SetsASliceOfAnotherSizeAside)
{
  Headers slices = stack(20, 1.0);
  slices[19].rows = 64;
  EXPECT_EQ(only(assess(slices)).kind, FindingKind::OddSize);
  slices = stack(20, 1.0);
  slices[19].pixelSpacing = Eigen::Vector2d(0.5, 0.5);
  const Finding finding = only(assess(slices));
  EXPECT_EQ(finding.kind, FindingKind::OddSize);
  EXPECT_NEAR(finding.errorMm, 10.0, 1e-9);
}

TEST(SeriesGeometry, NamesMixedRescale)
{
  Headers slices = stack(20, 1.0);
  slices[3].intercept = -1024.0;
  const Finding finding = only(assess(slices));
  EXPECT_EQ(finding.kind, FindingKind::MixedRescale);
  EXPECT_EQ(finding.errorMm, 0.0);
}

TEST(SeriesGeometry, RefusesMixedRescaleTypes)
{
  Headers slices = stack(50, 1.0);
  for (SliceHeader& slice : slices)
    slice.rescaleType = "OD";
  EXPECT_EQ(assess(slices).verdict, Verdict::Ok);
  slices[7].rescaleType.clear(); // states nothing
  EXPECT_EQ(assess(slices).verdict, Verdict::Ok);
  slices = stack(50, 1.0);
  for (SliceHeader& slice : slices)
    slice.rescaleType = slice.instanceNumber == 1 ? "HU" : "OD";
  const SeriesGeometry series = assess(slices);
  const Finding finding = only(series);
  EXPECT_EQ(finding.kind, FindingKind::MixedRescale);
  EXPECT_NE(finding.text.find("49 of 50"), std::string::npos) << finding.text;
  EXPECT_EQ(series.verdict, Verdict::Refused) << "no slope makes one of the other";
  // Those of one type with a rescale of their own are repaired as before.
  for (SliceHeader& slice : slices)
    slice.rescaleType = "HU";
  slices[3].intercept = -1024.0;
  EXPECT_EQ(assess(slices).verdict, Verdict::Repairable);
}

// A slice that states nothing agrees with every patient and must not make them one.
TEST(SeriesGeometry, TellsPatientsAndStudiesApartWhicheverSliceStatesNothing)
{
  const PatientKey one = patientKey("111", "", "Doe^Ann", "");
  const PatientKey other = patientKey("222", "", "Roe^Eve", "");
  for (std::size_t silent = 0; silent < 12; ++silent)
  {
    Headers slices = stack(12, 1.0);
    Headers studies = stack(12, 1.0);
    for (std::size_t k = 0; k < 12; ++k)
      if (k != silent)
      {
        slices[k].patient = k < 5 ? one : other;
        studies[k].studyUid = k < 5 ? "1.2.3" : "1.2.4";
      }
    const SeriesGeometry patients = assess(slices);
    ASSERT_FALSE(patients.findings.empty()) << silent;
    EXPECT_EQ(patients.findings.front().kind, FindingKind::MixedPatients) << silent;
    EXPECT_EQ(patients.verdict, Verdict::Refused);
    EXPECT_EQ(patients.slices.size(), silent < 5 ? 8U : 7U) << "the larger group, and the silent";
    const SeriesGeometry studied = assess(studies);
    ASSERT_FALSE(studied.findings.empty()) << silent;
    EXPECT_EQ(studied.findings.front().kind, FindingKind::MixedStudies) << silent;
  }
  // An ID of one slice and a name of another may be one patient's, but not of two.
  Headers parts = stack(12, 1.0);
  parts[3].patient = patientKey("111", "", "", "");
  parts[4].patient = patientKey("", "", "Doe^Ann", "");
  EXPECT_EQ(assess(parts).verdict, Verdict::Ok);
  parts[5].patient = other;
  EXPECT_EQ(assess(parts).findings.front().kind, FindingKind::MixedPatients);
}

// Neither that states both contradicts the one that states an issuer alone.
TEST(SeriesGeometry, ComparesIdsOfOneIssuerAcrossThoseOfOthers)
{
  Headers slices = stack(9, 1.0);
  for (std::size_t k = 0; k < 9; ++k)
    slices[k].patient = k < 3   ? patientKey("111", "here", "", "")
                        : k < 6 ? patientKey("222", "there", "", "")
                                : patientKey("333", "there", "", "");
  EXPECT_EQ(assess(slices).findings.front().kind, FindingKind::MixedPatients);
  slices.resize(6);
  EXPECT_EQ(assess(slices).verdict, Verdict::Ok) << "one patient of two hospitals, or unknown";
}

TEST(SeriesGeometry, SetsALocalizerAside)
{
  Headers slices = stack(20, 1.0);
  slices[0].imageType = {"ORIGINAL", "PRIMARY", "LOCALIZER"};
  const SeriesGeometry series = assess(slices);
  ASSERT_EQ(series.findings.size(), 1U);
  EXPECT_EQ(series.findings.front().kind, FindingKind::LocalizerMixedIn);
  EXPECT_EQ(series.verdict, Verdict::Ok);
  EXPECT_EQ(series.slices.size(), 19U);
}

TEST(SeriesGeometry, KnowsAnUndeclaredLocalizerByItsPlane)
{
  Headers slices = stack(20, 1.0);
  SliceHeader scout = slices[0];
  scout.columnDirection = Eigen::Vector3d(0, 0, -1);
  slices.push_back(scout);
  const SeriesGeometry series = assess(slices);
  ASSERT_EQ(series.findings.size(), 1U);
  EXPECT_EQ(series.findings.front().kind, FindingKind::LocalizerMixedIn);
  EXPECT_EQ(series.verdict, Verdict::Ok);
  EXPECT_EQ(series.slices.size(), 20U);
}

TEST(SeriesGeometry, StopsWhenCancelled)
{
  const auto token = std::make_shared<core::CancelToken>();
  token->cancel();
  EXPECT_THROW(assess(stack(20), core::Progress({}, token)), core::CancelledError);
}

TEST(SeriesGeometry, HasNoGridWithoutUsableNumbers)
{
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  const auto damage = [](const std::function<void(SliceHeader&)>& change)
  {
    Headers slices = stack(5);
    for (SliceHeader& slice : slices)
      change(slice);
    const SeriesGeometry series = assess(slices);
    EXPECT_FALSE(series.grid);
    return only(series).kind;
  };
  const FindingKind none = FindingKind::NoGeometry;
  EXPECT_EQ(damage([](SliceHeader& s) { s.position.reset(); }), none);
  EXPECT_EQ(damage([](SliceHeader& s) { s.rowDirection.reset(); }), none);
  EXPECT_EQ(damage([](SliceHeader& s) { s.pixelSpacing.reset(); }), none);
  EXPECT_EQ(damage([&](SliceHeader& s) { (*s.position)[1] = nan; }), none);
  EXPECT_EQ(damage([&](SliceHeader& s) { (*s.position)[1] = infinity; }), none);
  EXPECT_EQ(damage([](SliceHeader& s) { (*s.position)[1] = 1e30; }), none);
  EXPECT_EQ(damage([](SliceHeader& s) { s.pixelSpacing = Eigen::Vector2d(0.0, 0.4); }), none);
  EXPECT_EQ(damage([](SliceHeader& s) { s.pixelSpacing = Eigen::Vector2d(-1.0, 0.4); }), none);
  EXPECT_EQ(damage([](SliceHeader& s) { s.columnDirection = s.rowDirection; }), none);
  EXPECT_EQ(damage([](SliceHeader& s) { s.rowDirection = Eigen::Vector3d::Zero(); }), none);
  EXPECT_EQ(damage([](SliceHeader& s) { s.rows = 0; }), none);
}

TEST(SeriesGeometry, NamesTheFirstFilesThatHaveNoPlace)
{
  Headers slices = stack(20);
  for (const std::size_t k : {3U, 7U, 8U, 9U, 12U})
  {
    slices[k].file = "/doe/slice" + std::to_string(k);
    slices[k].position.reset();
  }
  const std::string text = assess(slices).findings.front().text;
  EXPECT_NE(text.find("in 5 of 20 slices (slice3, slice7, slice8 and 2 more), so"),
            std::string::npos)
      << text;
  EXPECT_EQ(text.find("doe"), std::string::npos) << text;
  slices = stack(20);
  slices[19].frameOfReferenceUid = "1.2.3";
  EXPECT_NE(only(assess(slices)).text.find("(slice19)"), std::string::npos);
}

TEST(SeriesGeometry, RefusesOneSliceAlone)
{
  const SeriesGeometry series = assess(stack(1));
  EXPECT_EQ(only(series).kind, FindingKind::NoGeometry);
  EXPECT_FALSE(series.grid);
}

TEST(SeriesGeometry, RefusesSlicesOfTwoFramesOfReference)
{
  Headers slices = stack(20, 1.0);
  slices[19].frameOfReferenceUid = "1.2.3";
  EXPECT_EQ(only(assess(slices)).kind, FindingKind::NoGeometry);
}

TEST(SeriesGeometry, RefusesMultiFrameColourDamageAndNonImages)
{
  Headers slices = stack(5);
  slices[0].frames = 12;
  EXPECT_TRUE(has(assess(slices), FindingKind::MultiFrame));
  slices = stack(5);
  for (SliceHeader& slice : slices)
    slice.pixels.samplesPerPixel = 3;
  EXPECT_EQ(only(assess(slices)).kind, FindingKind::NotAnImage);
  slices = stack(5);
  for (SliceHeader& slice : slices)
    slice.isImage = false;
  EXPECT_EQ(only(assess(slices)).kind, FindingKind::NotAnImage);
  slices = stack(5);
  slices[4].damage = "is cut short";
  const Finding finding = only(assess(slices));
  EXPECT_EQ(finding.kind, FindingKind::Unreadable);
  EXPECT_EQ(finding.text, "slice4 is cut short.");
}

TEST(SeriesGeometry, SurvivesAnEmptySeries)
{
  const SeriesGeometry series = assess({});
  EXPECT_NE(series.verdict, Verdict::Ok);
  EXPECT_FALSE(series.grid);
}

TEST(SeriesGeometry, GivesEveryFindingKindItsOwnName)
{
  std::set<std::string> names;
  for (int kind = 0; kind <= static_cast<int>(FindingKind::Unreadable); ++kind)
    names.insert(kindName(static_cast<FindingKind>(kind)));
  const std::set<std::string> expected{
      "gantry-tilt",        "missing-slice",      "uneven-spacing", "duplicate-slice",
      "side-by-side",       "odd-orientation",    "odd-size",       "mixed-rescale",
      "no-geometry",        "localizer-mixed-in", "multi-frame",    "not-an-image",
      "unreadable",         "modality-lut",       "mixed-patients", "mixed-studies",
      "mixed-acquisitions", "missing-end",        "missing-between"};
  EXPECT_EQ(names, expected);
}

/// The slices' values of f at the pixels' true positions.
volume::IntensityVolume imageOf(const Headers& slices,
                                const std::function<double(const Eigen::Vector3d&)>& f)
{
  const SliceHeader& first = slices.front();
  const core::GridGeometry grid({first.columns, first.rows, static_cast<int>(slices.size())},
                                {1, 1, 1}, {0, 0, 0});
  auto voxels = std::make_shared<volume::Volume<float>>(grid);
  for (std::size_t k = 0; k < slices.size(); ++k)
    for (int j = 0; j < first.rows; ++j)
      for (int i = 0; i < first.columns; ++i)
        voxels->at(i, j, static_cast<int>(k)) = static_cast<float>(
            f(*slices[k].position + *slices[k].rowDirection * ((*first.pixelSpacing)[1] * i) +
              *slices[k].columnDirection * ((*first.pixelSpacing)[0] * j)));
  return volume::IntensityVolume(std::shared_ptr<const volume::Volume<float>>(voxels));
}

volume::IntensityVolume repaired(const SeriesGeometry& geometry,
                                 const std::function<double(const Eigen::Vector3d&)>& f)
{
  const SeriesRepair repair(geometry);
  return repair.resample(imageOf(geometry.slices, f), repair.grid().fullBox(), {});
}

/// Slices tilted about the patient's `axis`, the table advancing in z.
Headers tilted(double degrees, const Eigen::Vector3d& axis)
{
  const Eigen::Matrix3d axes = Eigen::AngleAxisd(degrees * M_PI / 180.0, axis).toRotationMatrix();
  Headers slices = stack(60, 1.0, axes);
  for (std::size_t k = 0; k < slices.size(); ++k)
    slices[k].position = Eigen::Vector3d(-20, -16, 100.0 + 0.5 * static_cast<double>(k));
  return slices;
}

TEST(SeriesRepair, PutsLandmarksOfATiltedScanWithinATenthOfAVoxel)
{
  for (const Eigen::Vector3d& axis :
       {Eigen::Vector3d(1, 0, 0), Eigen::Vector3d(0, 1, 0), Eigen::Vector3d(1, 1, 0).normalized()})
    for (const double degrees : {-30.0, -18.5, -5.0, 5.0, 12.0, 30.0})
    {
      const SeriesGeometry geometry = assess(tilted(degrees, axis));
      ASSERT_EQ(geometry.verdict, Verdict::Repairable) << degrees;
      const SliceHeader& middle = geometry.slices[geometry.slices.size() / 2];
      const Eigen::Vector3d centre =
          *middle.position + 20.0 * *middle.rowDirection + 16.0 * *middle.columnDirection;
      for (const double offset : {-4.0, 0.0, 3.7})
      {
        const Eigen::Vector3d mark = centre + offset * Eigen::Vector3d(1.0, -0.8, 0.6);
        const auto image = repaired(geometry, [&mark](const Eigen::Vector3d& p)
                                    { return 1000.0 * std::exp(-(p - mark).squaredNorm() / 2.0); });
        const core::GridGeometry& grid = image.geometry();
        Eigen::Vector3d sum = Eigen::Vector3d::Zero();
        double weight = 0.0;
        for (int k = 0; k < grid.dims()[2]; ++k)
          for (int j = 0; j < grid.dims()[1]; ++j)
            for (int i = 0; i < grid.dims()[0]; ++i)
            {
              sum += image.at(i, j, k) * grid.patientFromVoxel(Eigen::Vector3d(i, j, k));
              weight += image.at(i, j, k);
            }
        EXPECT_LT((sum / weight - mark).norm(), 0.1 * grid.minSpacing()) << degrees;
      }
    }
}

TEST(SeriesRepair, FollowsALinearFunctionWhereverTheSlicesLie)
{
  const auto f = [](const Eigen::Vector3d& p)
  { return 2000.0 + 3.0 * p[0] - 2.0 * p[1] + 5.0 * p[2]; };
  Headers gap = stack(30, 1.0);
  gap.erase(gap.begin() + 7);
  Headers uneven = stack(30, 1.0);
  for (std::size_t k = 0; k < uneven.size(); ++k)
    (*uneven[k].position)[2] += 0.3 * std::sin(1.7 * static_cast<double>(k));
  Headers pushed = stack(30, 1.0);
  (*pushed[12].position)[0] += 3.0;
  Headers doubled = stack(30, 1.0);
  doubled.push_back(doubled[4]);
  for (const Headers& slices : {gap, uneven, pushed, doubled, tilted(20, {1, 0, 0})})
  {
    const SeriesGeometry geometry = assess(slices);
    ASSERT_EQ(geometry.verdict, Verdict::Repairable);
    const auto image = repaired(geometry, f);
    const core::GridGeometry& grid = image.geometry();
    const double outside = image.range().min; // at a corner, or beyond the slices
    std::size_t compared = 0;
    for (int k = 0; k < grid.dims()[2]; ++k)
      for (int j = 0; j < grid.dims()[1]; ++j)
        for (int i = 0; i < grid.dims()[0]; ++i)
          if (image.at(i, j, k) != outside)
          {
            ASSERT_NEAR(image.at(i, j, k), f(grid.patientFromVoxel(Eigen::Vector3d(i, j, k))),
                        1e-2);
            ++compared;
          }
    EXPECT_GT(compared, grid.voxelCount() / 2);
  }
}

/// A stack of 2 mm with a stretch of `fine` mm, `count` gaps of it, in the middle.
Headers withFineStretch(double fine, int count)
{
  Headers slices = stack(60 + count, 1.0);
  double z = 0.0;
  for (int k = 0; k < 60 + count; ++k)
  {
    (*slices[static_cast<std::size_t>(k)].position)[2] = z;
    z += k >= 30 && k < 30 + count ? fine : 2.0;
  }
  return slices;
}

// Every second fine slice is bright: a grid that skips some of them loses it.
TEST(SeriesRepair, KeepsAFineStretchHoweverShort)
{
  for (const auto& [fine, count] : {std::pair{0.6, 15}, {0.5, 8}, {0.25, 12}, {1.0, 3}})
  {
    const SeriesGeometry geometry = assess(withFineStretch(fine, count));
    ASSERT_EQ(geometry.verdict, Verdict::Repairable) << fine;
    const SeriesRepair repair(geometry);
    EXPECT_NEAR(repair.grid().spacing()[2], fine, 0.02 * fine);
    const auto bright = [f = fine](const Eigen::Vector3d& p)
    {
      const double k = (p[2] - 60.0) / f; // the stretch begins at 60 mm
      return k > 0.5 && k < 2.5 && std::lround(k) == 1 ? 3000.0 : 1000.0;
    };
    EXPECT_GE(repaired(geometry, bright).range().max, 1999.0) << fine << ", at least half of it";
    for (const std::string& note : repair.notes(repair.grid().fullBox()))
      EXPECT_EQ(note.find("measured slices"), std::string::npos) << note;
  }
}

// A few slices close to others set no pitch, and what the grid skips is counted.
TEST(SeriesRepair, CountsTheMeasuredSlicesThatItSkips)
{
  Headers slices = stack(40, 1.0);
  for (const std::size_t k : {10U, 20U, 30U})
  {
    slices.push_back(slices[k]);
    (*slices.back().position)[2] += 0.2;
  }
  const SeriesGeometry geometry = assess(slices);
  ASSERT_EQ(geometry.verdict, Verdict::Repairable);
  const SeriesRepair repair(geometry);
  EXPECT_NEAR(repair.grid().spacing()[2], 1.0, 1e-9);
  std::string said;
  for (const std::string& note : repair.notes(repair.grid().fullBox()))
    if (note.find("measured slices") != note.npos)
      said = note;
  EXPECT_EQ(said.find("Repaired: 3 of 43 measured slices lie between those of the volume, 1.00 mm"),
            0U)
      << said;
}

TEST(SeriesRepair, SaysWhatItGuessed)
{
  Headers slices = stack(30, 1.0);
  slices.erase(slices.begin() + 7);
  const SeriesGeometry geometry = assess(slices);
  const SeriesRepair repair(geometry);
  EXPECT_EQ(repair.grid().dims(), (core::Index3{100, 80, 30}));
  core::IndexBox box = repair.grid().fullBox();
  ASSERT_EQ(repair.notes(box).size(), 1U);
  EXPECT_NE(repair.notes(box).front().find("slice 8 of 30 is missing from the files"),
            std::string::npos)
      << repair.notes(box).front();
  using Ranges = std::vector<volume::SliceRange>;
  EXPECT_EQ(repair.provenance(box).interpolated, (Ranges{{7, 7}}));
  box.lower[2] = 3; // as the stored volume counts them
  EXPECT_EQ(repair.provenance(box).interpolated, (Ranges{{4, 4}}));
  EXPECT_EQ(repair.provenance(box).interpolatedBeyond, 0);
  EXPECT_NE(repair.notes(box).front().find("slice 5 of 27 is missing"), std::string::npos);
  box.lower[2] = 8;
  EXPECT_TRUE(repair.notes(box).empty());
  EXPECT_TRUE(repair.provenance(box).interpolated.empty());
  EXPECT_EQ(repair.provenance(box).interpolatedBeyond, 1);
  EXPECT_EQ(repair.provenance(box).shift, 0.0);
  const SeriesRepair tilt(assess(tilted(-18.5, {1, 0, 0})));
  const auto tiltNotes = tilt.notes(tilt.grid().fullBox());
  ASSERT_EQ(tiltNotes.size(), 1U);
  EXPECT_NE(tiltNotes.front().find("18.5 degrees"), std::string::npos);
  const auto undone = tilt.provenance(tilt.grid().fullBox());
  EXPECT_NEAR(undone.tilt, 18.5, 1e-6);
  const double height = tilt.grid().spacing()[2] * (tilt.grid().dims()[2] - 1);
  EXPECT_NEAR(undone.shift, height * std::tan(18.5 * M_PI / 180.0), 1e-6);
  Headers pushed = stack(30, 1.0);
  (*pushed[12].position)[0] += 3.0;
  const SeriesRepair aside(assess(pushed));
  const auto asideNotes = aside.notes(aside.grid().fullBox());
  ASSERT_EQ(asideNotes.size(), 1U);
  EXPECT_NE(asideNotes.front().find("sideways to where their positions put them, by up to 3.00 mm"),
            std::string::npos)
      << asideNotes.front();
  EXPECT_NEAR(aside.provenance(aside.grid().fullBox()).shift, 3.0, 1e-9);
  EXPECT_EQ(aside.provenance(aside.grid().fullBox()).tilt, 0.0);
}

// Slices that slide 3 mm aside and back again: the last lies where the first does, or nearer.
// Straight, a jump of 6 mm sideways, and a slope: no gantry does that.
TEST(SeriesRepair, AJumpSidewaysIsNoTilt)
{
  Headers jump = stack(40, 1.0);
  for (std::size_t k = 20; k < jump.size(); ++k)
    (*jump[k].position)[1] += 6.0 + 0.3 * static_cast<double>(k - 20);
  const SeriesGeometry geometry = assess(jump);
  ASSERT_EQ(geometry.verdict, Verdict::Repairable);
  const SeriesRepair repair(geometry);
  const core::IndexBox box = repair.grid().fullBox();
  EXPECT_NEAR(repair.provenance(box).shift, 11.7, 1e-6);
  EXPECT_EQ(repair.provenance(box).tilt, 0.0);
}

TEST(SeriesRepair, SaysHowFarTheFarthestSliceOfAVWasMoved)
{
  for (const int count : {31, 21})
  {
    Headers bent = stack(count, 1.0);
    for (int k = 0; k < count; ++k)
      (*bent[static_cast<std::size_t>(k)].position)[1] += 0.2 * std::min(k, 30 - k);
    const SeriesGeometry geometry = assess(bent);
    ASSERT_EQ(geometry.verdict, Verdict::Repairable) << count;
    const SeriesRepair repair(geometry);
    const core::IndexBox box = repair.grid().fullBox();
    EXPECT_NEAR(repair.provenance(box).shift, 3.0, 1e-6) << count;
    EXPECT_EQ(repair.provenance(box).tilt, 0.0) << count;
    std::string all;
    for (const std::string& note : repair.notes(box))
      all += note;
    EXPECT_NE(all.find("by up to 3.00 mm"), std::string::npos) << all;
    EXPECT_EQ(all.find("degrees"), std::string::npos) << all;
  }
}

} // namespace
} // namespace petrous::imaging
