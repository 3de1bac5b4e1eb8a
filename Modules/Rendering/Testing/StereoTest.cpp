#include "petrous/Rendering/Stereo.h"

#include <cmath>
#include <limits>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "petrous/Core/Error.h"
#include "petrous/Rendering/PixelRays.h"
#include "petrous/Rendering/RenderingError.h"

using namespace petrous;
using namespace petrous::rendering;

namespace
{

constexpr int kWidth = 400;
constexpr int kHeight = 300;

core::CameraPose camera()
{
  core::CameraPose pose;
  pose.position = {40.0, -170.0, 60.0};
  pose.focalPoint = {-5.0, 8.0, 12.0};
  pose.viewUp = {0.2, 0.1, 1.0};
  pose.viewAngle = 26.0;
  return pose;
}

struct Axes
{
  explicit Axes(const core::CameraPose& pose)
    : origin(pose.position)
    , forward((pose.focalPoint - pose.position).normalized())
    , right(forward.cross(pose.viewUp).normalized())
    , up(right.cross(forward))
  {
  }
  Eigen::Vector3d at(double x, double y, double depth) const
  {
    return origin + x * right + y * up + depth * forward;
  }
  Eigen::Vector3d origin, forward, right, up;
};

// Pixel of a point: the pixel whose ray passes through it, using the linearity of the rays.
Eigen::Vector2d pixelOf(const core::CameraPose& pose, const Eigen::Vector3d& point)
{
  const PixelRays rays(pose, kWidth, kHeight);
  const Axes axes(pose);
  const auto crossing = [&](double column, double row) -> Eigen::Vector2d
  {
    const PixelRay ray = rays.through(column, row);
    const double along = axes.forward.dot(point - ray.origin) / axes.forward.dot(ray.direction);
    const Eigen::Vector3d there = ray.origin + along * ray.direction - point;
    return {axes.right.dot(there), axes.up.dot(there)};
  };
  const Eigen::Vector2d zero = crossing(0.0, 0.0);
  Eigen::Matrix2d slope;
  slope.col(0) = crossing(1.0, 0.0) - zero;
  slope.col(1) = crossing(0.0, 1.0) - zero;
  return slope.colPivHouseholderQr().solve(-zero);
}

// Right minus left.
Eigen::Vector2d parallax(const EyePair& eyes, const Eigen::Vector3d& point)
{
  return pixelOf(eyes.right, point) - pixelOf(eyes.left, point);
}

Picture filled(int width, int height, std::uint8_t base)
{
  Picture picture{width, height, {}};
  for (int i = 0; i < 3 * width * height; ++i)
    picture.rgb.push_back(static_cast<std::uint8_t>(base + i));
  return picture;
}

template <class Call>
std::string refusal(const Call& call)
{
  try
  {
    call();
  }
  catch (const core::InvalidParameter& error)
  {
    return error.what();
  }
  return {};
}

} // namespace

TEST(Stereo, HasNoParallaxInThePlaneOfConvergence)
{
  const EyePair eyes = eyesOf(camera(), {18.0, 140.0});
  for (const double x : {-25.0, 0.0, 31.0})
    for (const double y : {-14.0, 22.0})
      EXPECT_LT(parallax(eyes, Axes(camera()).at(x, y, 140.0)).norm(), 1e-9);
}

TEST(Stereo, ParallaxFollowsSimilarTriangles)
{
  constexpr double separation = 18.0;
  constexpr double convergence = 140.0;
  const EyePair eyes = eyesOf(camera(), {separation, convergence});
  const double pixelsPerSlope = 0.5 * kHeight / std::tan(13.0 * 3.14159265358979323846 / 180.0);
  for (const double depth : {60.0, 110.0, 139.0, 200.0, 900.0})
  {
    // In the plane at c, the lines of sight to the point are separation (d - c) / d apart.
    const double apart = separation * (depth - convergence) / depth;
    const Eigen::Vector2d found = parallax(eyes, Axes(camera()).at(12.0, -9.0, depth));
    EXPECT_NEAR(found[0], pixelsPerSlope * apart / convergence, 1e-9);
    EXPECT_NEAR(found[1], 0.0, 1e-9);
    EXPECT_EQ(found[0] > 0.0, depth > convergence); // behind the screen: uncrossed disparity
  }
}

TEST(Stereo, EyesStandAtTheirSeparationAcrossTheView)
{
  const EyePair eyes = eyesOf(camera(), {23.0, 200.0});
  const Eigen::Vector3d across = eyes.right.position - eyes.left.position;
  EXPECT_LT((across - 23.0 * Axes(camera()).right).norm(), 1e-12);
  EXPECT_LT((0.5 * (eyes.right.position + eyes.left.position) - camera().position).norm(), 1e-12);
  EXPECT_EQ(eyes.left.viewAngle, camera().viewAngle);
}

TEST(Stereo, ParallelViewsTurnAboutThePointOfConvergence)
{
  core::CameraPose pose = camera();
  pose.parallelScale = 35.0;
  const EyePair eyes = eyesOf(pose, {20.0, 150.0});
  EXPECT_NEAR((eyes.right.position - eyes.left.position).norm(), 20.0, 1e-9);
  const Axes axes(pose);
  EXPECT_LT(parallax(eyes, axes.at(8.0, -5.0, 150.0)).norm(), 1e-9);
  const double pixelsPerMm = 0.5 * kHeight / 35.0;
  for (const double behind : {-40.0, 60.0})
  {
    const Eigen::Vector2d found = parallax(eyes, axes.at(8.0, -5.0, 150.0 + behind));
    // sin of the half angle is 10/150; both eyes see the depth at that angle.
    EXPECT_NEAR(found[0], pixelsPerMm * 2.0 * behind * 10.0 / 150.0, 1e-9);
    EXPECT_NEAR(found[1], 0.0, 1e-9);
  }
}

TEST(Stereo, ConvergesAtTheFocalPointUnderAMicroscopesAngle)
{
  const double distance = (camera().focalPoint - camera().position).norm();
  const StereoGeometry geometry = stereoGeometry(camera(), {});
  EXPECT_NEAR(geometry.convergence, distance, 1e-12);
  EXPECT_NEAR(2.0 * std::atan(0.5 * geometry.eyeSeparation / distance) * 180.0 / 3.14159265358979,
              5.5, 1e-9);
  // Stereo base of an operating microscope at its working distance.
  EXPECT_NEAR(stereoGeometry(camera(), {std::nullopt, 250.0}).eyeSeparation, 24.0, 0.1);
}

TEST(Stereo, NamesValueAndLimitsInMillimetres)
{
  EXPECT_NE(refusal(
                [] {
                  stereoGeometry(camera(), {-2.0, {}});
                })
                .find("-2 mm; 0 to 200 mm"),
            std::string::npos);
  EXPECT_NE(refusal(
                [] {
                  stereoGeometry(camera(), {{}, 0.5});
                })
                .find("0.5 mm; 1 to 10000 mm"),
            std::string::npos);
  EXPECT_NE(refusal(
                [] {
                  stereoGeometry(camera(), {60.0, 100.0});
                })
                .find("converge at 100 mm"),
            std::string::npos);
  EXPECT_FALSE(refusal(
                   [] {
                     stereoGeometry(camera(), {std::numeric_limits<double>::quiet_NaN(), {}});
                   })
                   .empty());
  EXPECT_TRUE(refusal([] { stereoGeometry(camera(), {0.0, 100.0}); }).empty());
}

TEST(Stereo, AWindowBringsTheRigIntoRange)
{
  core::CameraPose near = camera();
  near.position = near.focalPoint - 10.0 * Axes(camera()).forward;
  const StereoGeometry geometry = fittedStereoGeometry(near, {65.0, {}});
  EXPECT_NEAR(geometry.convergence, 10.0, 1e-9);
  EXPECT_NEAR(geometry.eyeSeparation, 20.0 * std::tan(15.0 * 3.14159265358979 / 180.0), 1e-9);
  EXPECT_EQ(fittedStereoGeometry(camera(), {20.0, 150.0}).eyeSeparation, 20.0);
}

TEST(Stereo, SideBySideHasSquarePixels)
{
  EXPECT_EQ(eyeSize(StereoMode::SideBySide, 1920, 1080), std::make_pair(960, 1080));
  EXPECT_EQ(eyeSize(StereoMode::Anaglyph, 801, 600), std::make_pair(801, 600));
  EXPECT_THROW(eyeSize(StereoMode::SideBySide, 801, 600), RenderingError);
}

TEST(Stereo, PutsTheLeftPictureOnTheLeft)
{
  const Picture left = filled(4, 3, 0);
  const Picture right = filled(4, 3, 100);
  const Picture both = composeStereo(left, right, StereoMode::SideBySide);
  ASSERT_EQ(both.width, 8);
  ASSERT_EQ(both.height, 3);
  for (int y = 0; y < 3; ++y)
    for (int x = 0; x < 4; ++x)
      for (int c = 0; c < 3; ++c)
      {
        EXPECT_EQ(both.pixel(x, y)[c], left.pixel(x, y)[c]);
        EXPECT_EQ(both.pixel(4 + x, y)[c], right.pixel(x, y)[c]);
      }
}

TEST(Stereo, InterleavesRowsBeginningWithTheLeft)
{
  const Picture left = filled(4, 5, 0);
  const Picture right = filled(4, 5, 100);
  const Picture both = composeStereo(left, right, StereoMode::Interleaved);
  ASSERT_EQ(both.rgb.size(), left.rgb.size());
  for (int y = 0; y < 5; ++y)
    for (int x = 0; x < 4; ++x)
      EXPECT_EQ(both.pixel(x, y)[1], (y % 2 == 0 ? left : right).pixel(x, y)[1]);
}

TEST(Stereo, AnaglyphGivesRedToTheLeftAndCyanToTheRight)
{
  const Picture left{2, 1, {255, 0, 0, 10, 200, 90}};
  const Picture right{2, 1, {1, 2, 3, 4, 5, 6}};
  const Picture both = composeStereo(left, right, StereoMode::Anaglyph);
  // 0.299 * 255 = 76.2; 0.299 * 10 + 0.587 * 200 + 0.114 * 90 = 130.65
  EXPECT_EQ(both.rgb, (std::vector<std::uint8_t>{76, 2, 3, 131, 5, 6}));
}

TEST(Stereo, RefusesPicturesOfDifferentSizes)
{
  EXPECT_THROW(composeStereo(filled(4, 3, 0), filled(3, 4, 0), StereoMode::Anaglyph),
               RenderingError);
}

TEST(Stereo, KnowsItsModesByName)
{
  EXPECT_EQ(parseStereoMode("interleaved"), StereoMode::Interleaved);
  EXPECT_EQ(parseStereoMode("none"), StereoMode::None);
  EXPECT_FALSE(parseStereoMode("3d"));
}
