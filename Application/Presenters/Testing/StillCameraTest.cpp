#include "petrous/Presenters/StillCamera.h"

#include <cmath>
#include <random>
#include <sstream>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "petrous/Core/Error.h"
#include "petrous/Phantom/Phantom.h"
#include "petrous/Presenters/CasePicture.h"
#include "petrous/Rendering/OffscreenView.h"
#include "petrous/Rendering/PixelRays.h"

namespace petrous::presenters
{
namespace
{

using Eigen::Vector2d;
using Eigen::Vector3d;
using Still = scene::VideoNotes::Still;

constexpr double kDegree = 3.14159265358979323846 / 180.0;
constexpr std::array<int, 2> kSize{640, 480};

core::CameraPose cameraAt(const Vector3d& middle, const Vector3d& from, double distance,
                          double angle)
{
  core::CameraPose camera;
  camera.focalPoint = middle;
  camera.position = middle + distance * from.normalized();
  camera.viewUp = {0.1, -0.3, 1.0};
  camera.viewAngle = angle;
  return camera;
}

double turnBetween(const core::CameraPose& a, const core::CameraPose& b)
{
  const auto axes = [](const core::CameraPose& c)
  {
    Eigen::Matrix3d m;
    m.col(2) = (c.focalPoint - c.position).normalized();
    m.col(0) = m.col(2).cross(c.viewUp).normalized();
    m.col(1) = m.col(2).cross(m.col(0));
    return m;
  };
  return Eigen::AngleAxisd(axes(a).transpose() * axes(b)).angle() / kDegree;
}

// The phantom's ear in CT, 45 mm across.
const scene::Case& ear()
{
  static const scene::Case kEar = []
  {
    scene::Case value;
    const Vector3d spacing = Vector3d::Constant(0.75);
    value.ct.geometry =
        core::GridGeometry({60, 60, 60}, spacing, phantom::Phantom::center() - 30.0 * spacing);
    phantom::ScanSettings settings;
    settings.noise = 0.0;
    value.ct.volume = std::make_shared<const volume::IntensityVolume>(
        std::make_shared<const volume::Volume<std::int16_t>>(
            phantom::samplePhantom(phantom::Phantom(), value.ct.geometry, settings)));
    value.ct.range = {-1000.0, 3000.0};
    return value;
  }();
  return kEar;
}

// A still of the phantom, drawn by the renderer: where each pixel's ray meets the bone.
struct DrawnStill
{
  std::array<int, 2> size{0, 0};
  std::vector<std::pair<Vector2d, Vector3d>> seen;
};

DrawnStill drawn(const core::CameraPose& camera, const std::array<int, 2>& size)
{
  rendering::ScenePicture picture;
  picture.setContents(sceneContents(ear()));
  picture.setCamera(camera);
  rendering::OffscreenView view(size[0], size[1]);
  view.render(picture);
  const rendering::DepthImage depth = picture.depth();
  const rendering::PixelRays rays(camera, size[0], size[1]);
  DrawnStill still;
  still.size = size;
  for (int row = 0; row < size[1]; row += 3)
    for (int column = 0; column < size[0]; column += 3)
      if (const double away = static_cast<double>(depth.at(column, row)); std::isfinite(away))
      {
        const rendering::PixelRay ray = rays.through(column, row);
        still.seen.emplace_back(Vector2d(column + 0.5, row + 0.5),
                                ray.origin + away * ray.direction);
      }
  return still;
}

Still exact(const core::CameraPose& camera, int count, unsigned seed)
{
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> aside(-12.0, 12.0), deep(-8.0, 8.0);
  Still still;
  still.size = {1920, 1080};
  const Vector3d into = (camera.focalPoint - camera.position).normalized();
  for (int n = 0; n < count; ++n)
  {
    const Vector3d p = camera.focalPoint + Vector3d(aside(random), aside(random), aside(random)) +
                       deep(random) * into;
    still.landmarks.push_back({p, *seenAt(camera, still.size, p)});
  }
  return still;
}

TEST(StillCamera, SeesAPointWhereOpticsPutsIt)
{
  core::CameraPose camera;
  camera.position = {0.0, -100.0, 0.0};
  camera.focalPoint = {0.0, 0.0, 0.0};
  camera.viewUp = {0.0, 0.0, 1.0};
  camera.viewAngle = 90.0;
  // right of the picture: into x up = y x z = x
  const auto at = seenAt(camera, {400, 200}, {50.0, 0.0, 25.0});
  ASSERT_TRUE(at);
  EXPECT_NEAR(at->x(), 200.0 + 50.0, 1e-9); // 100 pixels half the height, 45 degrees
  EXPECT_NEAR(at->y(), 100.0 - 25.0, 1e-9);
  EXPECT_FALSE(seenAt(camera, {400, 200}, {0.0, -101.0, 0.0}));
}

// Stills of the phantom from known cameras, landmarks picked with an error of a pixel: the camera
// is found within 0.5 degrees, and what it sees lies where it is seen within 0.3 mm.
TEST(StillCamera, IsFoundOfRenderedStills)
{
  const std::array<int, 2> size{1280, 720};
  constexpr int kLandmarks = 12;
  constexpr int kRounds = 8;
  std::mt19937 random(17);
  std::normal_distribution<double> click(0.0, 1.0);
  const Vector3d sides[] = {{-1.0, 0.2, 0.3}, {-0.7, -0.5, 0.6}};
  for (const double angle : {12.0, 25.0})
    for (const Vector3d& side : sides)
    {
      // The ear fills the still.
      const double distance = 0.5 * 42.0 / std::tan(0.5 * angle * kDegree);
      const core::CameraPose truth = cameraAt(phantom::Phantom::center(), side, distance, angle);
      const DrawnStill seen = drawn(truth, size);
      ASSERT_GT(seen.seen.size(), 5000U);
      double turns = 0.0, misses = 0.0, stated = 0.0;
      for (int round = 0; round < kRounds; ++round)
      {
        Still still;
        still.size = size;
        still.viewAngle = angle;
        for (int n = 0; n < kLandmarks; ++n)
        {
          const auto& [pixel, patient] = seen.seen[random() % seen.seen.size()];
          still.landmarks.push_back({patient, pixel + Vector2d(click(random), click(random))});
        }
        const StillFit fit = fitStill(still);
        EXPECT_TRUE(fit.bad.empty());
        EXPECT_FALSE(fit.pose.ambiguous);
        turns += std::pow(turnBetween(fit.pose.camera, truth), 2);
        stated += std::pow(fit.pose.rotationSigma, 2);
        double squares = 0.0;
        for (const auto& [pixel, patient] : seen.seen)
        {
          const double depth = (patient - truth.position).norm();
          const double mm = 2.0 * depth * std::tan(0.5 * angle * kDegree) / size[1]; // of a pixel
          squares += std::pow(mm * (*seenAt(fit.pose.camera, size, patient) - pixel).norm(), 2);
        }
        misses += squares / static_cast<double>(seen.seen.size());
      }
      const double turn = std::sqrt(turns / kRounds);
      const double miss = std::sqrt(misses / kRounds);
      const std::string of = std::to_string(static_cast<int>(angle)) +
                             (side.y() > 0.0 ? "_from_front" : "_from_behind");
      RecordProperty("degrees_" + of, std::to_string(turn));
      RecordProperty("mm_" + of, std::to_string(miss));
      EXPECT_LT(turn, 0.5) << angle << " degrees, side " << side.transpose();
      EXPECT_LT(miss, 0.3) << angle << " mm, side " << side.transpose();
      EXPECT_NEAR(turn / std::sqrt(stated / kRounds), 1.0, 0.5);
    }
}

TEST(StillCamera, NamesTheLandmarksThatDoNotFit)
{
  const core::CameraPose camera = cameraAt({-40.0, 5.0, 3.0}, {-0.8, 0.35, 0.45}, 110.0, 25.0);
  for (const bool given : {true, false})
  {
    Still still = exact(camera, 9, 3);
    if (given)
      still.viewAngle = 25.0;
    EXPECT_TRUE(fitStill(still).bad.empty());
    still.landmarks[4].still += Vector2d(60.0, -35.0);
    const StillFit one = fitStill(still);
    EXPECT_EQ(one.bad, (std::vector<std::size_t>{4})) << given;
    EXPECT_FALSE(one.isPoor);
    if (given)
    {
      std::swap(still.landmarks[4].still, still.landmarks[7].still); // and two mistaken
      std::vector<std::size_t> bad = fitStill(still).bad;
      std::sort(bad.begin(), bad.end());
      EXPECT_EQ(bad, (std::vector<std::size_t>{4, 7}));
    }
  }
  Still few = exact(camera, 6, 4); // which one cannot be told
  few.landmarks[2].still += Vector2d(80.0, 50.0);
  try
  {
    const StillFit fit = fitStill(few);
    EXPECT_TRUE(fit.bad.empty());
    EXPECT_TRUE(fit.isPoor);
  }
  catch (const core::InvalidParameter&)
  {
    // or no camera at all
  }
}

// As many are left then as determine a camera, and fit whichever was left out.
TEST(StillCamera, BlamesNoLandmarkWhereNoneIsLeftToContradict)
{
  const core::CameraPose camera = cameraAt({-40.0, 5.0, 3.0}, {-0.8, 0.35, 0.45}, 110.0, 25.0);
  for (unsigned seed = 1; seed <= 20; ++seed)
    for (const bool given : {true, false})
    {
      Still still = exact(camera, given ? 6 : 7, seed);
      if (given)
        still.viewAngle = 25.0;
      still.landmarks[2].still += Vector2d(80.0, 50.0);
      if (given)
        still.landmarks[4].still += Vector2d(-70.0, 40.0);
      try
      {
        const StillFit fit = fitStill(still);
        EXPECT_TRUE(fit.isPoor) << seed;
        EXPECT_TRUE(fit.bad.empty()) << seed;
      }
      catch (const core::InvalidParameter&)
      {
        // or no camera at all
      }
    }
}

TEST(StillCamera, ReadsPairs)
{
  std::istringstream csv("u_px;v_px;x_mm;y_mm;z_mm;who\n1.5;2;-3;4;5e1;a\n6;7;8;9;10;b\n");
  const auto pairs = landmarksFromCsv(csv, "pairs.csv");
  ASSERT_EQ(pairs.size(), 2U);
  EXPECT_EQ(pairs[0].patient, Vector3d(-3.0, 4.0, 50.0));
  EXPECT_EQ(pairs[0].still, Vector2d(1.5, 2.0));
  std::istringstream without("u_px,v_px,x_mm,y_mm\n1,2,3,4\n");
  EXPECT_THROW(landmarksFromCsv(without, "pairs.csv"), core::InvalidParameter);
}

TEST(StillCamera, LaysTheStillOverThePictureAtItsHeight)
{
  video::Frame still;
  still.width = 4;
  still.height = 2;
  auto pixels = std::make_shared<std::vector<std::uint8_t>>(24);
  for (std::size_t n = 0; n < 8; ++n)
    (*pixels)[3 * n] = n % 4 < 2 ? 200 : 100; // red, left and right half
  still.pixels = pixels;
  rendering::Picture picture{20, 8, std::vector<std::uint8_t>(480, 40)};
  const rendering::Picture half = overlaid(picture, still, 0.5);
  EXPECT_EQ(half.pixel(1, 4)[0], 40); // the still is 16 wide there: columns 2 to 17
  EXPECT_EQ(half.pixel(18, 4)[0], 40);
  EXPECT_EQ(half.pixel(2, 0)[0], 120);
  EXPECT_EQ(half.pixel(2, 0)[1], 20);
  EXPECT_EQ(half.pixel(17, 7)[0], 70);
  EXPECT_EQ(overlaid(picture, still, 0.0).rgb, picture.rgb);
  EXPECT_EQ(overlaid(picture, still, 1.0).pixel(3, 3)[0], 200);
}

TEST(StillCamera, WritesTimes)
{
  EXPECT_EQ(timeText(0), "00:00.000");
  EXPECT_EQ(timeText(62'480'999'999), "01:02.480");
  EXPECT_EQ(timeText(3'662'480'000'000), "1:01:02.480");
}

} // namespace
} // namespace petrous::presenters
