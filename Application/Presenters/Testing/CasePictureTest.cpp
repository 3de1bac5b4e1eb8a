#include <array>
#include <cstdlib>

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
