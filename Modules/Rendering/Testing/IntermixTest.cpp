#include <algorithm>

#include "PictureComparison.h"
#include "PictureScenes.h"
#include "petrous/Rendering/ScenePicture.h"

using namespace petrous;
using namespace petrous::rendering;
using namespace petrous::rendering::synthetic;

namespace
{

// Max. percentage of pixels whose colour may differ by more than two levels where polygons are
// drawn: their silhouettes differ where vertices are snapped to the rasterizer's grid, and a sphere
// of 48 x 32 facets is up to 0.5 % of its radius inside the true one.
constexpr double kOthers = 1.5;

struct Colors
{
  double rms = 0.0;    // of pixels whose channels all differ by at most 12 levels, 1/255
  double others = 0.0; // %
};

Colors compareColors(const Picture& picture, const ReferencePicture& truth)
{
  Colors result;
  double squares = 0.0;
  std::size_t near = 0;
  const std::size_t pixels = truth.depth.millimetres.size();
  for (std::size_t p = 0; p < pixels; ++p)
  {
    double worst = 0.0;
    double sum = 0.0;
    for (std::size_t c = 3 * p; c < 3 * p + 3; ++c)
    {
      const double difference = picture.rgb[c] - 255.0 * static_cast<double>(truth.rgb[c]);
      worst = std::max(worst, std::abs(difference));
      sum += difference * difference;
    }
    if (worst > 12.0)
      continue;
    ++near;
    squares += sum;
  }
  result.rms = std::sqrt(squares / (3.0 * static_cast<double>(std::max<std::size_t>(near, 1))));
  result.others = 100.0 * static_cast<double>(pixels - near) / static_cast<double>(pixels);
  return result;
}

void expectTheSame(const SceneContents& contents, const core::CameraPose& pose)
{
  const Shot shot = shoot(contents, pose);
  const ReferencePicture truth = truthOf(contents, pose);
  const Colors colors = compareColors(shot.picture, truth);
  EXPECT_LE(colors.rms, 1.5);
  EXPECT_LE(colors.others, kOthers);
  // Where the tissue's first hit is in front of a polygon, it is the same as without the polygon.
  const Agreement agreement = compare(shot, truth, contents.ct->geometry().minSpacing());
  EXPECT_LE(agreement.median, 0.05);
  EXPECT_LE(agreement.others, kOthers);
}

MeshContents square(const std::string& name, const Vector& middle, const Vector& u, const Vector& v)
{
  core::TriangleMesh mesh;
  for (const double a : {-1.0, 1.0})
    for (const double b : {-1.0, 1.0})
      mesh.vertices.push_back((middle + a * u + b * v).cast<float>());
  mesh.triangles = {{0, 1, 2}, {1, 3, 2}};
  MeshContents contents{name, std::make_shared<core::TriangleMesh>(mesh), {}};
  contents.look.color = {0.1F, 0.6F, 0.3F};
  return contents;
}

ToolPose tool(const Vector& center, const Vector& axis, double radius = 2.0)
{
  ToolPose pose;
  pose.center = center;
  pose.axisToHand = axis;
  pose.radius = radius;
  return pose;
}

} // namespace

TEST(Intermix, ShowsAMeshBeforeAndBehindTheBone)
{
  SceneContents contents = hollowBall(oblique());
  // A sheet across the ball: half of it in front of the bone, half hidden.
  contents.meshes = {square("sheet", {0.0, -4.0, 0.0}, {14.0, 0.0, 0.0}, {0.0, 0.0, 14.0}),
                     square("behind", {0.0, 12.0, 0.0}, {9.0, 0.0, 0.0}, {0.0, 0.0, 9.0})};
  expectTheSame(contents, slanting());
  core::CameraPose parallel = slanting();
  parallel.parallelScale = 14.0;
  expectTheSame(contents, parallel);
}

TEST(Intermix, ShowsAMeshInsideTranslucentBone)
{
  SceneContents contents = translucentBall();
  contents.meshes = {square("sheet", {0.0, 1.0, 0.0}, {5.0, 0.0, 1.0}, {0.0, 1.0, 5.0})};
  expectTheSame(contents, slanting());
}

TEST(Intermix, ShowsTheToolInACavityAndItsShaftBeforeTheBone)
{
  for (const float surfaceOpacity : {1.0F, 0.35F})
  {
    SceneContents contents = cutBall(surfaceOpacity);
    contents.tool = tool({2.0, -8.0, 3.0}, Vector(0.4, -1.0, 0.6));
    expectTheSame(contents, slanting());
  }
}

TEST(Intermix, ShowsAnInstrumentAsItIsHeldInTheCavityAndBeforeTheBone)
{
  SceneContents contents = cutBall();
  contents.tool = tool({2.0, -8.0, 3.0}, Vector(0.4, -1.0, 0.6));
  contents.tool->instrument = boxMesh({-1.0, -2.0, 0.0}, {1.0, 2.0, 30.0});
  contents.tool->rotation =
      Eigen::Quaterniond::FromTwoVectors(Vector::UnitZ(), contents.tool->axisToHand) *
      Eigen::AngleAxisd(0.7, Vector::UnitZ());
  expectTheSame(contents, slanting());
}

TEST(Intermix, ShowsAToolAtEveryPlaceOfACutCavity)
{
  // Rays end at the tool at the borders of the cut's bricks, wherever the tool is.
  SceneContents contents = cutBall();
  for (double depth = -13.0; depth < -4.0; depth += 2.1)
  {
    contents.tool = tool({2.0, depth, 3.0}, Vector(0.4, -1.0, 0.6), 1.5);
    const Shot shot = shoot(contents, slanting());
    const ReferencePicture truth = truthOf(contents, slanting());
    const Colors colors = compareColors(shot.picture, truth);
    EXPECT_LE(colors.others, kOthers) << depth;
    int wrong = 0; // tissue where there should be none
    for (std::size_t p = 0; p < truth.depth.millimetres.size(); ++p)
      wrong += std::isnan(truth.depth.millimetres[p]) && !std::isnan(shot.depth.millimetres[p]);
    EXPECT_LE(wrong, 6) << depth;
  }
}

TEST(Intermix, EndsRaysAtTheToolWithinLabelsAndASecondImage)
{
  SceneContents contents = fullScene();
  contents.tool = tool({2.0, -6.0, 3.0}, Vector(0.4, -1.0, 0.6), 1.5);
  expectTheSame(contents, slanting());
}

// VTK draws meshes and tool.
TEST(Intermix, ExposesMeshesAndToolAsTheBone)
{
  SceneContents contents = cutBall();
  contents.tool = tool({2.0, -8.0, 3.0}, Vector(0.4, -1.0, 0.6));
  contents.meshes = {square("sheet", {0.0, -4.0, 0.0}, {14.0, 0.0, 0.0}, {0.0, 0.0, 14.0})};
  contents.meshes[0].look.color = {0.9F, 0.8F, 0.3F};
  const Picture plain = draw(contents, slanting());
  for (const double exposure : {-1.0, 0.0, 1.0})
  {
    contents.light.exposure = exposure;
    contents.light.toneCurve = true;
    expectTheSame(contents, slanting());
  }
  contents.light.toneCurve = false;
  expectTheSame(contents, slanting());
  contents.light.exposure = 0.0;
  EXPECT_EQ(countDifferentPixels(draw(contents, slanting()), plain), 0U);
}

TEST(Intermix, HighlightsOfMeshesAndToolAreThoseOfTheReference)
{
  SceneContents contents = hollowBall();
  contents.meshes = {square("sheet", {0.0, -16.0, 0.0}, {14.0, 0.0, 0.0}, {0.0, 0.0, 14.0})};
  contents.tool = tool({0.0, -25.0, 0.0}, Vector::UnitX());
  core::CameraPose pose = from({0.0, -40.0, 0.0}, {0.0, 0.0, 0.0}, 30.0);
  for (const bool isParallel : {false, true})
  {
    if (isParallel)
      pose.parallelScale = 8.0;
    const Picture picture = draw(contents, pose);
    const ReferencePicture truth = truthOf(contents, pose);
    EXPECT_LE(compareColors(picture, truth).others, kOthers) << isParallel;
    const std::size_t middle = static_cast<std::size_t>(kHeight / 2 * kWidth + kWidth / 2);
    for (std::size_t c = 0; c < 3; ++c)
    {
      const double wanted = 255.0 * static_cast<double>(truth.rgb[3 * middle + c]);
      EXPECT_NEAR(int{picture.rgb[3 * middle + c]}, wanted, 4.0) << isParallel << " " << c;
    }
    EXPECT_GT(truth.rgb[3 * middle + 2], 0.55F); // of a burr of 0.35, below its highlight
  }
}

// Each pixel is that of the opaque mesh or that without it.
TEST(Intermix, ExposesAMeshBehindAScreenDoor)
{
  SceneContents contents = cutBall();
  contents.meshes = {square("sheet", {0.0, -4.0, 0.0}, {14.0, 0.0, 0.0}, {0.0, 0.0, 14.0})};
  contents.light.exposure = 1.0;
  contents.light.toneCurve = true;
  const Picture opaque = draw(contents, slanting());
  contents.meshes[0].look.opacity = 0.5F;
  const Picture half = draw(contents, slanting());
  contents.meshes[0].look.shown = false;
  const Picture without = draw(contents, slanting());
  const auto same = [](const Picture& a, const Picture& b, int column, int row)
  { return std::equal(a.pixel(column, row), a.pixel(column, row) + 3, b.pixel(column, row)); };
  int closed = 0;
  int open = 0;
  int neither = 0;
  for (int row = 0; row < kHeight; ++row)
    for (int column = 0; column < kWidth; ++column)
    {
      const bool isClosed = same(half, opaque, column, row);
      const bool isOpen = same(half, without, column, row);
      closed += isClosed && !isOpen;
      open += isOpen && !isClosed;
      neither += !isOpen && !isClosed;
    }
  EXPECT_GT(closed, 1000);
  EXPECT_NEAR(open, closed, 0.02 * closed);
  EXPECT_EQ(neither, 0);
}

TEST(Intermix, HidesAToolInsideOpaqueBone)
{
  SceneContents contents = hollowBall();
  const Picture without = draw(contents, slanting());
  contents.tool = tool({3.0, -11.0, 2.0}, {0.3, -1.0, 0.5});
  EXPECT_GT(countDifferentPixels(draw(contents, slanting()), without), 100U);
  contents.tool = tool({0.0, 0.0, 0.0}, {-0.5, 0.8, -0.35}, 1.0); // away from the camera
  const Picture hidden = draw(contents, slanting());
  for (int row = 60; row < 90; ++row)
    for (int column = 85; column < 115; ++column)
      for (int c = 0; c < 3; ++c)
        ASSERT_EQ(hidden.pixel(column, row)[c], without.pixel(column, row)[c]);
}

// The silhouette and the depth of a burr do not depend on how it is shaded.
TEST(Intermix, ABurrsFinishKeepsTheBallThatIsFelt)
{
  SceneContents contents = hollowBall();
  const core::CameraPose pose = from({0.0, -60.0, 0.0}, {0.0, -20.0, 0.0}, 8.0);
  contents.tool = tool({0.0, -20.0, 0.0}, Vector(0.4, 0.2, 1.0), 3.0);
  const Picture smooth = shoot(contents, pose, {}, 96, 96).picture;
  for (const BurrFinish finish : {BurrFinish::Fluted, BurrFinish::Gritted})
  {
    contents.tool->finish = finish;
    contents.tool->turn = 0.0;
    const Picture shaded = shoot(contents, pose, {}, 96, 96).picture;
    contents.tool->turn = 0.3;
    const Picture turned = shoot(contents, pose, {}, 96, 96).picture;
    EXPECT_GT(countDifferentPixels(shaded, smooth), 200U);
    EXPECT_GT(countDifferentPixels(shaded, turned), 200U);
    SceneContents without = contents;
    without.tool.reset();
    const Picture empty = shoot(without, pose, {}, 96, 96).picture;
    const auto covered = [&empty](const Picture& picture)
    { return countDifferentPixels(picture, empty); };
    EXPECT_NEAR(static_cast<double>(covered(shaded)), static_cast<double>(covered(smooth)),
                0.01 * static_cast<double>(covered(smooth)));
  }
}
