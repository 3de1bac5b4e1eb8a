#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <optional>
#include <utility>

#include <gtest/gtest.h>

#include "petrous/Imaging/ImageFile.h"
#include "petrous/Presenters/CasePicture.h"
#include "petrous/Presenters/LabelledPicture.h"

using namespace petrous;
using Eigen::Vector3d;
using rendering::StandardView;

namespace
{

// A block of bone with air beside it: in patient x below `air` mm from its middle, or above.
scene::Case earAt(const Vector3d& origin, bool isAirOnTheLeft)
{
  scene::Case value;
  value.ct.geometry = core::GridGeometry({40, 20, 20}, Vector3d::Ones(), origin);
  auto ct = std::make_shared<volume::Volume<std::int16_t>>(value.ct.geometry);
  for (int k = 0; k < 20; ++k)
    for (int j = 0; j < 20; ++j)
      for (int i = 0; i < 40; ++i)
        ct->at(i, j, k) = (isAirOnTheLeft ? i < 25 : i >= 15) ? 1000 : -1000;
  value.ct.volume = std::make_shared<const volume::IntensityVolume>(
      std::shared_ptr<const volume::Volume<std::int16_t>>(ct));
  value.ct.range = {-1000.0, 1000.0};
  return value;
}

// 1: from the patient's left, -1: from the right.
int sideOf(const scene::Case& value)
{
  const core::CameraPose pose = presenters::standardCamera(value, StandardView::Lateral);
  const Vector3d eye = (pose.position - pose.focalPoint).normalized();
  EXPECT_NEAR(std::abs(eye.x()), 1.0, 1e-9);
  return eye.x() > 0.0 ? 1 : -1;
}

// Bright pixels at the middles of the left, right, top and bottom edge, and elsewhere, in a black
// picture with the letters of that camera.
std::array<int, 5> lettersOf(const core::CameraPose& camera, double magnified)
{
  const int edge = static_cast<int>(200 * magnified);
  const int margin = static_cast<int>(40 * magnified);
  rendering::Picture picture{
      edge, edge, std::vector<std::uint8_t>(3 * static_cast<std::size_t>(edge * edge), 0)};
  presenters::addEdgeLetters(picture, camera, magnified);
  std::array<int, 5> ink{};
  const auto isMiddle = [&](int place) { return std::abs(place - edge / 2) < margin; };
  for (int row = 0; row < edge; ++row)
    for (int column = 0; column < edge; ++column)
      if (*picture.pixel(column, row) > 128)
        ++ink[isMiddle(row) && column < margin           ? 0
              : isMiddle(row) && column >= edge - margin ? 1
              : isMiddle(column) && row < margin         ? 2
              : isMiddle(column) && row >= edge - margin ? 3
                                                         : 4];
  return ink;
}

} // namespace

TEST(LabelledPicture, DrawsALineFromOnePlaceToTheOther)
{
  constexpr int kWidth = 40, kHeight = 20;
  rendering::Picture picture{kWidth, kHeight, std::vector<std::uint8_t>(3 * kWidth * kHeight, 90)};
  presenters::addLine(picture, {8.0, 10.0}, {30.0, 10.0});
  for (int column = 0; column < kWidth; ++column)
  {
    EXPECT_EQ(*picture.pixel(column, 10) > 200, column >= 8 && column <= 30) << column;
    EXPECT_EQ(*picture.pixel(column, 9), column >= 7 && column <= 31 ? 0 : 90) << column;
    EXPECT_EQ(*picture.pixel(column, 7), 90) << column;
  }
  presenters::addLine(picture, {-5.0, -5.0}, {60.0, 25.0}); // as far as the picture reaches
}

TEST(CasePicture, ItsEdgesBearThePatientsDirections)
{
  core::CameraPose upright; // from in front: R and L beside, S above, I below
  core::CameraPose inverted = upright;
  inverted.viewUp = -upright.viewUp;
  const auto [left, right, top, bottom, elsewhere] = lettersOf(upright, 1.0);
  for (const int letter : {left, right, top, bottom})
    EXPECT_GT(letter, 5);
  EXPECT_EQ(elsewhere, 0);
  EXPECT_GT(top, bottom) << "an S has more ink than an I";
  EXPECT_GT(left, right) << "an R has more than an L";
  const auto turned = lettersOf(inverted, 1.0);
  EXPECT_GT(turned[3], turned[2]);
  EXPECT_GT(turned[1], turned[0]);
  EXPECT_NEAR(lettersOf(upright, 3.0)[0], 9.0 * left, 0.5 * 9.0 * left) << "as large on paper";
}

TEST(CasePicture, AnImageThatSaysWhereItLiesIsSeenFromThere)
{
  for (const bool isAirOnTheLeft : {false, true})
  {
    EXPECT_EQ(sideOf(earAt(Vector3d(20, -30, 0), isAirOnTheLeft)), 1);
    EXPECT_EQ(sideOf(earAt(Vector3d(-80, -30, 0), isAirOnTheLeft)), -1);
  }
}

// Its middle is 20 mm to the left of a corner that no scanner puts at 0.
TEST(CasePicture, AnImageWithoutAPlaceIsSeenFromWhereItOpensIntoAir)
{
  EXPECT_EQ(sideOf(earAt(Vector3d::Zero(), true)), 1);
  EXPECT_EQ(sideOf(earAt(Vector3d::Zero(), false)), -1);
  scene::Case moved = earAt(Vector3d(20, -30, 0), false);
  EXPECT_EQ(sideOf(moved), 1);
  moved.ct.provenance.assumedRas = true;
  EXPECT_EQ(sideOf(moved), -1);
}

// In window and command alike.
TEST(CasePicture, APictureSaysWhatIsNotShownAndWhatWasInterpolated)
{
  scene::Case value = earAt(Vector3d(20, -30, 0), false);
  value.description.side = scene::Side::Left;
  EXPECT_TRUE(presenters::pictureNotes(value).empty());
  EXPECT_EQ(presenters::pictureLines(value), std::vector<std::string>{"Left side"});
  value.view.clipping.planes.push_back({Vector3d::Zero(), Vector3d::UnitX()});
  value.view.clipping.crop = core::IndexBox{{0, 0, 0}, {20, 20, 20}};
  value.ct.provenance.interpolated = {{3, 4}};
  const std::vector<std::string> notes = presenters::pictureNotes(value);
  ASSERT_EQ(notes.size(), 3U);
  EXPECT_NE(notes[0].find("interpolated"), std::string::npos);
  EXPECT_EQ(notes[1], "Cut away for the view, not drilled");
  EXPECT_EQ(notes[2], "Only a part of the image is shown");
  const std::vector<std::string> lines = presenters::pictureLines(value);
  ASSERT_EQ(lines.size(), 4U);
  EXPECT_EQ(lines[0], "Left side");
  EXPECT_TRUE(std::equal(notes.begin(), notes.end(), lines.begin() + 1));

  // A box that leaves nothing out, and one beyond the image, which is none.
  value.view.clipping.planes.clear();
  value.ct.provenance.interpolated.clear();
  for (const core::IndexBox& box :
       {value.ct.geometry.fullBox(), core::IndexBox{{-5, -5, -5}, {90, 90, 90}},
        core::IndexBox{{50, 50, 50}, {60, 60, 60}}})
  {
    value.view.clipping.crop = box;
    EXPECT_TRUE(presenters::pictureNotes(value).empty()) << box.lower[0];
    rendering::SceneContents contents;
    presenters::clip(contents, value.view.clipping, value.ct.geometry);
    EXPECT_FALSE(contents.crop.has_value()) << box.lower[0];
  }
}

TEST(CasePicture, ACameraInOpaqueTissueIsBuried)
{
  const scene::Case value = earAt(Vector3d(20, -30, 0), true); // bone up to x = 44.5
  rendering::SceneContents contents;
  contents.ct = value.ct.volume.get();
  contents.materials.resize(1);
  core::CameraPose camera;
  camera.position = Vector3d(30, -20, 10);
  EXPECT_TRUE(presenters::isBuried(camera, contents));
  contents.clipping = {{Vector3d(31, 0, 0), Vector3d::UnitX()}};
  EXPECT_FALSE(presenters::isBuried(camera, contents)) << "cut away";
  contents.clipping = {{Vector3d(29, 0, 0), Vector3d::UnitX()}};
  EXPECT_TRUE(presenters::isBuried(camera, contents));
  contents.clipping.clear();
  contents.crop = core::IndexBox{{15, 0, 0}, {40, 20, 20}};
  EXPECT_FALSE(presenters::isBuried(camera, contents)) << "outside of the box";
  contents.crop.reset();
  contents.materials[0].surfaceOpacity = 0.3F;
  EXPECT_FALSE(presenters::isBuried(camera, contents)) << "seen through";
  contents.materials[0].surfaceOpacity = 1.0F;
  contents.boneShown = false;
  EXPECT_FALSE(presenters::isBuried(camera, contents));
  contents.boneShown = true;
  for (const double x : {50.0, 200.0})
  {
    camera.position.x() = x;
    EXPECT_FALSE(presenters::isBuried(camera, contents)) << "air at " << x;
  }
  contents.ct = nullptr;
  EXPECT_FALSE(presenters::isBuried(camera, contents));
}

TEST(CasePicture, TheSideOfTheCaseComesFirst)
{
  scene::Case value = earAt(Vector3d::Zero(), true);
  value.description.side = scene::Side::Right;
  EXPECT_EQ(sideOf(value), -1);
  value.description.side = scene::Side::Left;
  value.ct.geometry = earAt(Vector3d(-20, -30, 0), false).ct.geometry; // over the midline
  EXPECT_EQ(sideOf(value), 1);
  value.description.side = scene::Side::Both;
  EXPECT_EQ(sideOf(value), -1);
}

// Against points along the line, each by itself: in the hull of the box, and on the side of each
// plane that stays.
TEST(ShownPart, IsWhatLiesInTheBoxAndOnTheDrawnSideOfEveryPlane)
{
  const Eigen::Matrix3d turned =
      (Eigen::AngleAxisd(0.5, Vector3d(1.0, 2.0, 3.0).normalized())).toRotationMatrix();
  const core::GridGeometry grid({31, 41, 21}, {1.0, 0.5, 1.5}, {3.0, -7.0, 11.0}, turned);
  const Vector3d middle = grid.center();
  const Vector3d oblique = Vector3d(0.3, -0.4, 0.8).normalized();
  scene::ViewState::Clipping box;
  box.crop = core::IndexBox{{5, 10, 3}, {20, 30, 15}};
  scene::ViewState::Clipping plane;
  plane.planes.push_back({middle + 2.0 * oblique, oblique});
  scene::ViewState::Clipping both = box;
  both.planes = {{middle - 1.5 * oblique, oblique}, {middle + 4.0 * oblique, -oblique}};
  int met = 0;
  int missed = 0;
  for (const scene::ViewState::Clipping& clipping :
       {scene::ViewState::Clipping{}, box, plane, both})
    for (int n = 0; n < 60; ++n)
    {
      const double angle = 0.7 * n;
      const Vector3d from =
          middle + 60.0 * Vector3d(std::cos(angle), std::sin(angle), std::cos(1.3 * angle));
      const Vector3d to = middle + 0.15 * n * Vector3d(std::sin(3.1 * n), std::cos(1.7 * n), 1.0);
      const interaction::PickRay line{from, (to - from).normalized()};
      const core::IndexBox kept = clipping.crop.value_or(grid.fullBox());
      const auto isShown = [&](double t)
      {
        const Vector3d voxel = grid.voxelFromPatient(line.at(t));
        for (std::size_t a = 0; a < 3; ++a)
          if (voxel[static_cast<Eigen::Index>(a)] < kept.lower[a] ||
              voxel[static_cast<Eigen::Index>(a)] > kept.upper[a] - 1.0)
            return false;
        return std::all_of(clipping.planes.begin(), clipping.planes.end(),
                           [&](const auto& one)
                           { return one.normal.dot(line.at(t) - one.point) >= 0.0; });
      };
      constexpr double kStep = 0.04; // mm
      std::optional<double> first, last;
      for (double t = 0.0; t < 200.0; t += kStep)
        if (isShown(t))
        {
          first = first.value_or(t);
          last = t;
        }
      const auto part = presenters::shownPart(line, clipping, grid);
      if (!first)
      {
        ++missed;
        EXPECT_LT(part.last - part.first, kStep) << n;
        continue;
      }
      ++met;
      EXPECT_NEAR(part.first, *first, 1.01 * kStep) << n;
      EXPECT_NEAR(part.last, *last, 1.01 * kStep) << n;
    }
  EXPECT_GT(met, 60);
  EXPECT_GT(missed, 20);
}

TEST(ShownPart, IsNothingBesideAPlaneBeforeTheEyeAndInABoxWithoutThickness)
{
  const core::GridGeometry grid({11, 11, 11}, Vector3d::Ones(), Vector3d::Zero());
  const interaction::PickRay line{{5.0, 5.0, 30.0}, {0.0, 0.0, -1.0}};
  scene::ViewState::Clipping clipping;
  clipping.planes = {{{4.0, 0.0, 0.0}, Vector3d::UnitX()}}; // parallel to the line
  const auto along = presenters::shownPart(line, clipping, grid);
  EXPECT_NEAR(along.first, 20.0, 1e-6);
  EXPECT_NEAR(along.last, 30.0, 1e-6);
  clipping.planes = {{{6.0, 0.0, 0.0}, Vector3d::UnitX()}};
  const auto beside = presenters::shownPart(line, clipping, grid);
  EXPECT_LT(beside.last, beside.first);
  clipping.planes.clear();
  clipping.crop =
      core::IndexBox{{5, 0, 0}, {6, 11, 11}}; // a single layer of voxels, which it meets
  const auto flat = presenters::shownPart(line, clipping, grid);
  EXPECT_LT(flat.last, flat.first);
  // From within, looking out: from the eye on.
  clipping.crop = core::IndexBox{{0, 0, 2}, {11, 11, 11}};
  const auto out = presenters::shownPart({{5.0, 5.0, 7.0}, {0.0, 0.0, -1.0}}, clipping, grid);
  EXPECT_NEAR(out.first, 0.0, 1e-6);
  EXPECT_NEAR(out.last, 5.0, 1e-6);
}
