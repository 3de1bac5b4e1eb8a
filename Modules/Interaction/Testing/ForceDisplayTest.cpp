#include "petrous/Interaction/ForceDisplay.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <gtest/gtest.h>
#include <vtkProp.h>
#include <vtkPropCollection.h>
#include <vtkRenderer.h>

#include "Pixels.h"
#include "Tissue.h"
#include "petrous/Core/Error.h"
#include "petrous/Rendering/OffscreenView.h"

using namespace petrous;
using namespace petrous::interaction;
using namespace petrous::interaction::testing;
using Eigen::Vector2d;
using Eigen::Vector3d;
using rendering::Picture;

namespace
{

constexpr int kWidth = 320;
constexpr int kHeight = 240;
constexpr double kPixels = 4.0; // per mm

session::TickRecord recordOf(const Vector3d& force, const Vector3d& tool = Vector3d::Zero())
{
  session::TickRecord record;
  record.proxy = session::PoseValues::of({tool, Eigen::Quaterniond::Identity()});
  record.wrench = session::WrenchValues::of({force, Vector3d::Zero()});
  return record;
}

/// Parallel projection from above: right is x, up is y.
class Scene
{
public:
  explicit Scene(const rendering::SceneContents& contents = {})
    : m_view(kWidth, kHeight)
  {
    core::CameraPose camera;
    camera.position = {0.0, 0.0, 200.0};
    camera.focalPoint = {0.0, 0.0, 0.0};
    camera.viewUp = {0.0, 1.0, 0.0};
    camera.parallelScale = 0.5 * kHeight / kPixels;
    m_picture.setContents(contents);
    m_picture.setCamera(camera);
    empty = m_view.render(m_picture);
    display.addTo(m_picture.renderer());
    display.setBarShown(false);
  }

  Picture drawRecord(const session::TickRecord& record)
  {
    display.update(record);
    return m_view.render(m_picture);
  }
  Picture draw(const Vector3d& force, const Vector3d& tool = Vector3d::Zero())
  {
    return drawRecord(recordOf(force, tool));
  }

  vtkRenderer& renderer() { return *m_picture.renderer(); }

  ForceDisplay display;
  Picture empty;

private:
  rendering::ScenePicture m_picture;
  rendering::OffscreenView m_view;
};

// The pixel at an offset from the lower left corner.
const std::uint8_t* at(const Picture& picture, int x, int y)
{
  return picture.pixel(x, picture.height - 1 - y);
}

// Height of the filled part of the bar, pixels.
int filled(const Picture& picture)
{
  const std::uint8_t* foot = at(picture, 21, 16);
  int count = 0;
  while (std::equal(foot, foot + 3, at(picture, 21, 16 + count)))
    ++count;
  return count;
}

} // namespace

TEST(ForceDisplay, DrawsTheForceFromTheToolInItsDirectionAndLength)
{
  Scene scene;
  const Vector3d tool(4.0, -3.0, 10.0);
  for (const Vector3d& force :
       {Vector3d(2.0, 0.0, 0.0), Vector3d(0.0, -1.0, 0.0), Vector3d(-1.2, 0.9, 0.0),
        Vector3d(0.8, 0.6, 1.5), Vector3d(0.5, 1.2, -2.0)})
  {
    const auto pixels = difference(scene.draw(force, tool), scene.empty);
    ASSERT_GT(pixels.size(), 15U);
    const Vector2d start = kPixels * tool.head<2>();
    const Vector2d seen = kPixels * 3.0 * force.head<2>(); // 3 mm/N
    const Reach arrow = reach(pixels, start, seen);
    // The cone's apex is thinner than a pixel; its base and the shaft's are tilted towards the
    // viewer.
    const double lean = kPixels * 0.4 * std::abs(force.z()) / force.norm();
    EXPECT_NEAR(arrow.most, seen.norm(), 2.5) << force.transpose();
    EXPECT_NEAR(arrow.least, -lean, 1.0) << force.transpose();
    EXPECT_LT(arrow.aside, kPixels * 1.4 * 0.8 + 1.0) << force.transpose();
  }
}

TEST(ForceDisplay, IsAtMostFifteenMillimetresLong)
{
  Scene scene;
  const auto pixels = difference(scene.draw({80.0, 0.0, 0.0}), scene.empty);
  EXPECT_NEAR(reach(pixels, {0.0, 0.0}, {1.0, 0.0}).most, kPixels * 15.0, 2.5);
}

TEST(ForceDisplay, SetsTheLengthOfANewton)
{
  Scene scene;
  ForceLook look;
  look.millimetresPerNewton = 4.0;
  look.fullScale = 3.0;
  scene.display.setLook(look);
  const auto length = [&](double force)
  {
    return reach(difference(scene.draw({force, 0.0, 0.0}), scene.empty), {0.0, 0.0}, {1.0, 0.0})
        .most;
  };
  EXPECT_NEAR(length(1.0), kPixels * 4.0, 2.5);
  EXPECT_NEAR(length(2.5), kPixels * 10.0, 2.5);
  EXPECT_NEAR(length(50.0), kPixels * 12.0, 2.5); // no longer than at full scale
}

TEST(ForceDisplay, HidesAForceBelowAFiftiethOfANewton)
{
  Scene scene;
  EXPECT_TRUE(difference(scene.draw({0.019, 0.0, 0.0}), scene.empty).empty());
  scene.display.setLook(
      []
      {
        ForceLook look;
        look.millimetresPerNewton = 500.0;
        return look;
      }());
  EXPECT_FALSE(difference(scene.draw({0.021, 0.0, 0.0}), scene.empty).empty());
  EXPECT_TRUE(difference(scene.draw({0.0, 0.0, 0.0}), scene.empty).empty());
}

// Else a picture at rest would begin anew with each record.
TEST(ForceDisplay, ATremorThatCannotBeSeenChangesNoProp)
{
  Scene scene;
  const auto changed = [&scene]
  {
    vtkMTimeType latest = 0;
    vtkPropCollection* props = scene.renderer().GetViewProps();
    vtkCollectionSimpleIterator at;
    props->InitTraversal(at);
    while (vtkProp* prop = props->GetNextProp(at))
      latest = std::max(latest, prop->GetRedrawMTime());
    return latest;
  };
  scene.draw({1.5, 0.0, 0.0}, {1.0, 0.0, 0.0});
  const vtkMTimeType before = changed();
  scene.display.update(recordOf({1.502, 0.001, 0.0}, {1.001, 0.0, 0.002}));
  EXPECT_EQ(changed(), before);
  scene.display.update(recordOf({1.6, 0.0, 0.0}, {1.0, 0.0, 0.0}));
  EXPECT_GT(changed(), before);
}

TEST(ForceDisplay, ShowsNoForceThatIsNotGiven)
{
  Scene scene;
  session::TickRecord record = recordOf({2.0, 0.0, 0.0});
  record.fault = static_cast<std::uint8_t>(session::ServoFault::Device);
  EXPECT_TRUE(difference(scene.drawRecord(record), scene.empty).empty());
  EXPECT_EQ(scene.display.force(), 0.0);
  record = recordOf({2.0, 0.0, 0.0});
  record.input.parameters.pause = 1;
  EXPECT_TRUE(difference(scene.drawRecord(record), scene.empty).empty());
  record = recordOf({std::numeric_limits<double>::quiet_NaN(), 0.0, 0.0});
  EXPECT_TRUE(difference(scene.drawRecord(record), scene.empty).empty());
  scene.draw({0.0, 3.0, 4.0});
  EXPECT_EQ(scene.display.force(), 5.0);
}

TEST(ForceDisplay, IsSeenOverTissueAndTool)
{
  const Vector3d force(2.0, 0.0, 0.0);
  const auto places = [&force](Scene& scene, double z) {
    return difference(scene.draw(force, {-3.0, 0.0, z}), scene.empty);
  };
  Scene alone;
  const auto seen = places(alone, 4.0);
  ASSERT_GT(seen.size(), 50U);

  rendering::SceneContents tissue;
  tissue.ct = block()->ct();
  Scene covered(tissue);
  EXPECT_EQ(places(covered, 4.0), seen);
  EXPECT_EQ(places(covered, -5.0), seen); // inside the block

  // The handpiece is between it and the camera.
  rendering::SceneContents held;
  held.tool = rendering::ToolPose{{-3.0, 0.0, 4.0}, {0.0, 0.0, 1.0}, 2.0, false};
  Scene hidden(held);
  EXPECT_EQ(places(hidden, 4.0), seen);
}

TEST(ForceDisplay, ColoursByMagnitude)
{
  Scene scene;
  ForceLook look;
  look.millimetresPerNewton = 50.0;
  look.thickness = 3.0;
  scene.display.setLook(look);
  const auto color = [&](double force)
  {
    const Picture picture = scene.draw({force, 0.0, 0.0});
    const std::uint8_t* pixel = picture.pixel(kWidth / 2 + 2, kHeight / 2);
    return Eigen::Vector3i(pixel[0], pixel[1], pixel[2]);
  };
  const Eigen::Vector3i light = color(0.3);
  const Eigen::Vector3i usual = color(2.0);
  const Eigen::Vector3i strong = color(5.0);
  EXPECT_GT(light[2], light[0]); // blue, amber, red, increasingly dark
  EXPECT_GT(usual[1], usual[2] + 40);
  EXPECT_GT(strong[0], strong[1] + 80);
  EXPECT_GT(light.sum(), usual.sum());
  EXPECT_GT(usual.sum(), strong.sum());
  EXPECT_EQ(color(9.0), strong);
}

TEST(ForceDisplay, FillsTheBarInProportion)
{
  Scene scene;
  scene.display.setArrowShown(false);
  scene.display.setBarShown(true);
  for (const double force : {0.5, 1.0, 2.0, 4.0, 5.0, 20.0})
    EXPECT_NEAR(filled(scene.draw({0.0, force, 0.0})), 120.0 * std::min(force, 5.0) / 5.0, 1.0)
        << force;
  ForceLook look;
  look.fullScale = 2.0;
  scene.display.setLook(look);
  EXPECT_NEAR(filled(scene.draw({0.0, 1.0, 0.0})), 60.0, 1.0);
}

TEST(ForceDisplay, MarksOneNewton)
{
  Scene scene;
  scene.display.setArrowShown(false);
  scene.display.setBarShown(true);
  ForceLook look;
  look.fullScale = 4.0;
  scene.display.setLook(look);
  const Picture picture = scene.draw({0.0, 0.0, 0.0});
  int marked = 0;
  int row = 0;
  for (int y = 10; y < 140; ++y)
    if (at(picture, 31, y)[0] > 150)
    {
      ++marked;
      row = y;
    }
  EXPECT_GE(marked, 1);
  EXPECT_LE(marked, 2);
  EXPECT_NEAR(row, 16 + 30, 1.0);
}

TEST(ForceDisplay, WritesTheForceInTenthsOfANewton)
{
  Scene scene;
  scene.display.setArrowShown(false);
  scene.display.setBarShown(true);
  const auto words = [&](double force)
  {
    std::vector<Vector2d> pixels;
    for (const Vector2d& pixel : difference(scene.draw({0.0, force, 0.0}), scene.empty))
      if (pixel.y() + 0.5 * kHeight > 16.0 + 120.0 + 2.0) // above the bar
        pixels.push_back(pixel);
    return pixels;
  };
  const auto eight = words(0.80);
  EXPECT_GT(eight.size(), 30U);
  EXPECT_EQ(words(0.84), eight);
  EXPECT_NE(words(0.90), eight);
  EXPECT_NE(words(8.00), eight);
  scene.display.setBarShown(false);
  EXPECT_TRUE(words(0.80).empty());
}

// On bone the number, nearly white, has a dark plate.
TEST(ForceDisplay, ReadsOnAWhiteGround)
{
  Scene scene;
  scene.display.setArrowShown(false);
  scene.display.setBarShown(true);
  scene.renderer().SetBackground(1.0, 1.0, 1.0);
  scene.renderer().GradientBackgroundOff();
  const Picture picture = scene.draw({0.0, 0.8, 0.0});
  ASSERT_GT(at(picture, kWidth / 2, 20)[0], 240);
  int dark = 0, light = 0;
  for (int y = 16 + 120 + 2; y < 16 + 120 + 24; ++y)
    for (int x = 16; x < 60; ++x)
    {
      const int red = at(picture, x, y)[0];
      dark += red < 150;
      light += red > 190 && red < 240;
    }
  EXPECT_GT(dark, 100);
  EXPECT_GT(light, 5);
  // Relative luminance [WCAG 2.1] of greys; 4.5 is its least contrast of a text.
  const auto luminance = [](int grey) { return std::pow((grey / 255.0 + 0.055) / 1.055, 2.4); };
  const auto contrast = [&](int a, int b)
  { return (luminance(std::max(a, b)) + 0.05) / (luminance(std::min(a, b)) + 0.05); };
  int letters = 0, plate = 255;
  for (int y = 16 + 120 + 8; y < 16 + 120 + 18; ++y)
    for (int x = 17; x < 40; ++x)
    {
      const int red = at(picture, x, y)[0];
      letters = std::max(letters, red < 240 ? red : 0);
      plate = std::min(plate, red);
    }
  EXPECT_GT(contrast(letters, plate), 4.5);
  const int row = 16 + 24; // of the mark of 1 N
  const int mark = std::max(at(picture, 31, row)[0], at(picture, 31, row - 1)[0]);
  EXPECT_GT(contrast(mark, at(picture, 31, row + 6)[0]), 4.5);
}

TEST(ForceDisplay, RefusesBadLooks)
{
  const auto refused = [](auto ForceLook::*value, double bad)
  {
    ForceLook look;
    look.*value = bad;
    EXPECT_THROW(ForceDisplay{look}, core::InvalidParameter);
  };
  refused(&ForceLook::millimetresPerNewton, 0.0);
  refused(&ForceLook::fullScale, std::numeric_limits<double>::quiet_NaN());
  refused(&ForceLook::least, -1.0);
  refused(&ForceLook::thickness, 0.0);
  refused(&ForceLook::pixels, 0.0);
}

// The force of a tissue's rim on a tool moved over it is not a pressing force.
TEST(ForceDisplay, AHoveringToolHasNoForce)
{
  using Parameters = session::ServoParameters;
  ForceDisplay display;
  session::TickRecord record = recordOf({0.0, 0.0, 1.2});
  record.input.parameters.constantThrust = Parameters::kPointer | Parameters::kPressed;
  display.update(record);
  EXPECT_EQ(display.force(), 1.2);
  record.input.parameters.constantThrust = Parameters::kPointer;
  display.update(record);
  EXPECT_EQ(display.force(), 0.0);
}
