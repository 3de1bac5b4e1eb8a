#include <cmath>
#include <cstdlib>

#include <gtest/gtest.h>

#include "MeshCaps.h"
#include "PictureComparison.h"
#include "PictureScenes.h"

using namespace petrous;
using namespace petrous::rendering;
using namespace petrous::rendering::synthetic;

namespace
{

constexpr double kPi = 3.14159265358979323846;
constexpr double kRadius = 5.0;
const Vector kMiddle(1.0, -2.0, 0.5);

ClippingPlane planeAt(double off, const Vector& normal, const Vector& from = kMiddle)
{
  return {from + off * normal.normalized(), normal.normalized()};
}

double areaOf(const core::TriangleMesh& mesh)
{
  double area = 0.0;
  for (const auto& [a, b, c] : mesh.triangles)
    area += 0.5 * static_cast<double>((mesh.vertices[b] - mesh.vertices[a])
                                          .cross(mesh.vertices[c] - mesh.vertices[a])
                                          .norm());
  return area;
}

double capVolume(double radius, double height)
{
  return kPi * height * height / 3.0 * (3.0 * radius - height);
}

core::TriangleMesh kept(const core::TriangleMesh& mesh, const std::vector<ClippingPlane>& planes,
                        bool facesAlike = true)
{
  ShadedMesh surface = keptBy(
      {mesh, std::vector<Eigen::Vector3f>(mesh.vertices.size(), Eigen::Vector3f::UnitZ())}, planes);
  append(surface, capsOf(mesh, planes, facesAlike));
  return surface.mesh;
}

// Every triangle with vertices of its own, as in STL.
core::TriangleMesh soupOf(const core::TriangleMesh& mesh)
{
  core::TriangleMesh soup;
  for (const auto& triangle : mesh.triangles)
  {
    const auto first = static_cast<std::uint32_t>(soup.vertices.size());
    for (const std::uint32_t vertex : triangle)
      soup.vertices.push_back(mesh.vertices[vertex]);
    soup.triangles.push_back({first, first + 1, first + 2});
  }
  return soup;
}

core::TriangleMesh turnedOver(core::TriangleMesh mesh)
{
  for (auto& triangle : mesh.triangles)
    std::swap(triangle[0], triangle[1]);
  return mesh;
}

core::TriangleMesh both(core::TriangleMesh first, const core::TriangleMesh& second)
{
  ShadedMesh sum{std::move(first), {}};
  append(sum, {second, {}});
  return sum.mesh;
}

} // namespace

TEST(MeshCaps, CloseWhatAPlaneLeavesOfABall)
{
  const core::TriangleMesh ball = *ballMesh(kMiddle, kRadius, 96);
  for (const Vector& normal :
       {Vector(0.0, 0.0, 1.0), Vector(1.0, 2.0, -0.5), Vector(0.0, -1.0, 0.0)})
    for (const double off : {-3.0, 0.0, 2.0})
      for (const core::TriangleMesh& mesh : {ball, soupOf(ball)})
      {
        const std::vector<ClippingPlane> planes{planeAt(off, normal)};
        const ShadedMesh cap = capsOf(mesh, planes, true);
        const double area = kPi * (kRadius * kRadius - off * off);
        EXPECT_NEAR(areaOf(cap.mesh), area, 0.003 * area);
        for (std::size_t v = 0; v < cap.mesh.vertices.size(); ++v)
        {
          const Vector at = cap.mesh.vertices[v].cast<double>();
          EXPECT_NEAR((at - planes[0].point).dot(planes[0].normal), 0.0, 1e-5);
          EXPECT_NEAR(cap.normals[v].cast<double>().dot(planes[0].normal), -1.0, 1e-6);
        }
        const double volume = capVolume(kRadius, kRadius - off);
        EXPECT_NEAR(kept(mesh, planes).signedVolume(), volume, 0.003 * volume);
      }
}

// Each cap ends at the other planes.
TEST(MeshCaps, OfABoxAreTheSidesOfWhatIsLeft)
{
  const core::TriangleMesh ball = *ballMesh(kMiddle, kRadius, 96);
  std::vector<ClippingPlane> planes;
  for (int axis = 0; axis < 3; ++axis)
    for (const double sign : {-1.0, 1.0})
      planes.push_back(planeAt(-2.0, sign * Vector::Unit(axis)));
  const core::TriangleMesh cube = kept(ball, planes);
  EXPECT_NEAR(cube.signedVolume(), 64.0, 1e-3) << "all of the ball's surface is outside";
  EXPECT_NEAR(areaOf(cube), 96.0, 1e-3);
  planes.push_back(planes.front()); // of the box and of a clipping plane
  EXPECT_NEAR(areaOf(capsOf(ball, planes, true).mesh), 112.0, 1e-3);
}

TEST(MeshCaps, LeaveCavitiesOpenAndUniteShells)
{
  const core::TriangleMesh outer = *ballMesh(kMiddle, kRadius, 96);
  const core::TriangleMesh inner = *ballMesh(kMiddle + Vector(0.5, 0.3, 0.0), 2.0, 96);
  const std::vector<ClippingPlane> planes{planeAt(0.0, {0.0, 0.0, 1.0})};
  const double disc = kPi * kRadius * kRadius;
  const double hole = kPi * 4.0;
  const auto areaIn = [&](const core::TriangleMesh& mesh, bool facesAlike)
  { return areaOf(capsOf(mesh, planes, facesAlike).mesh); };
  EXPECT_NEAR(areaIn(both(outer, turnedOver(inner)), true), disc - hole, 0.003 * disc);
  EXPECT_NEAR(areaIn(both(outer, inner), true), disc, 0.003 * disc);
  EXPECT_NEAR(areaIn(both(outer, inner), false), disc - hole, 0.003 * disc);
  // Two balls that overlap: discs of 5 mm, 6 mm apart.
  const core::TriangleMesh beside = *ballMesh(kMiddle + Vector(6.0, 0.0, 0.0), kRadius, 96);
  const double lens = 2.0 * 25.0 * std::acos(0.6) - 3.0 * std::sqrt(100.0 - 36.0);
  EXPECT_NEAR(areaIn(both(outer, beside), true), 2.0 * disc - lens, 0.005 * disc);
}

namespace
{

// From above, 0.1 mm a pixel.
core::CameraPose above()
{
  core::CameraPose pose = from(kMiddle + Vector(0.0, 0.0, 60.0), kMiddle);
  pose.viewUp = {0.0, 1.0, 0.0};
  pose.parallelScale = 0.05 * kHeight;
  return pose;
}

SceneContents meshScene(float opacity = 1.0F)
{
  // A small block of bone far below: the picture is of the mesh.
  SceneContents contents =
      boneScene(ct<std::int16_t>(cube(64, 0.5), [](const Vector& p) { return -13.0 - p.z(); }));
  MeshContents mesh;
  mesh.name = "sinus";
  mesh.mesh = ballMesh(kMiddle, kRadius, 96);
  mesh.look.color = {0.1F, 0.15F, 0.9F};
  mesh.look.opacity = opacity;
  contents.meshes = {mesh};
  contents.section = SectionWindow();
  return contents;
}

int countOf(const Picture& picture, const std::array<int, 3>& color)
{
  int count = 0;
  for (int row = 0; row < picture.height; ++row)
    for (int column = 0; column < picture.width; ++column)
    {
      const std::uint8_t* pixel = picture.pixel(column, row);
      bool same = true;
      for (std::size_t c = 0; c < 3; ++c)
        same = same && std::abs(int{pixel[c]} - color[c]) <= 1;
      count += same ? 1 : 0;
    }
  return count;
}

constexpr std::array<int, 3> kPlain{26, 38, 230};

// Colours as the reference draws them but along edges of polygons.
void expectTheReference(const SceneContents& contents, const core::CameraPose& pose)
{
  const Picture picture = draw(contents, pose);
  const ReferencePicture truth = truthOf(contents, pose);
  int others = 0;
  for (std::size_t n = 0; n < truth.rgb.size(); n += 3)
  {
    double worst = 0.0;
    for (std::size_t c = n; c < n + 3; ++c)
      worst = std::max(worst, std::abs(picture.rgb[c] - 255.0 * static_cast<double>(truth.rgb[c])));
    others += worst > 8.0 ? 1 : 0;
  }
  EXPECT_LE(others, 0.015 * kWidth * kHeight);
}

} // namespace

TEST(ClippedMesh, ShowsACapOfItsColourAndNothingBeyond)
{
  for (const double off : {3.0, 0.0})
  {
    SceneContents contents = meshScene();
    contents.clipping = {planeAt(off, {0.0, 0.0, -1.0})}; // keeps what is below -off
    const Picture picture = draw(contents, above());
    const double cap = 100.0 * kPi * (kRadius * kRadius - off * off); // pixels
    EXPECT_NEAR(countOf(picture, kPlain), cap, 0.015 * cap) << "seen from above, not lit";
    expectTheReference(contents, above());
    expectTheReference(contents, slanting());
  }
  // From the side, half of it is gone.
  SceneContents contents = meshScene();
  core::CameraPose side = from(kMiddle + Vector(0.0, -60.0, 0.0), kMiddle);
  side.viewUp = {0.0, 0.0, 1.0};
  side.parallelScale = 0.05 * kHeight;
  const int whole = countBlue(draw(contents, side));
  contents.clipping = {planeAt(0.0, {0.0, 0.0, -1.0})};
  const Picture half = draw(contents, side);
  EXPECT_NEAR(countBlue(half), 0.5 * whole, 0.01 * whole);
  for (int row = 0; row < kHeight / 2 - 1; ++row)
    for (int column = 0; column < kWidth; ++column)
      ASSERT_FALSE(isBlue(half.pixel(column, row))) << column << " " << row;
  contents.clipping.clear();
  EXPECT_EQ(countBlue(draw(contents, side)), whole);
}

TEST(ClippedMesh, FollowsPlanesThatMove)
{
  ScenePicture scene;
  scene.setCamera(slanting());
  OffscreenView view(kWidth, kHeight);
  SceneContents contents = meshScene();
  scene.setContents(contents);
  const Picture whole = view.render(scene);
  const std::size_t bytes = scene.resources().at("meshes.sinus");
  for (const double off : {0.0, -2.0, 9.0})
  {
    contents.clipping = {planeAt(off, {0.0, 1.0, 1.0})};
    scene.setContents(contents);
    const Picture picture = view.render(scene);
    EXPECT_EQ(picture.rgb, draw(contents, slanting()).rgb) << off;
    EXPECT_EQ(countBlue(picture) == 0, off > kRadius) << off;
  }
  contents.clipping.clear();
  scene.setContents(contents);
  EXPECT_EQ(view.render(scene).rgb, whole.rgb);
  EXPECT_EQ(scene.resources().at("meshes.sinus"), bytes);
}

// Far in front of the CT, which alone was left in the frame before.
TEST(ClippedMesh, IsWholeInTheFirstFrameWithoutACut)
{
  ScenePicture scene;
  scene.setCamera(above());
  OffscreenView view(kWidth, kHeight);
  SceneContents contents = meshScene();
  contents.meshes[0].mesh = ballMesh(kMiddle + Vector(0.0, 0.0, 40.0), kRadius, 96);
  contents.clipping = {planeAt(-20.0, {0.0, 0.0, -1.0})};
  scene.setContents(contents);
  EXPECT_EQ(countBlue(view.render(scene)), 0);
  contents.clipping.clear();
  scene.setContents(contents);
  const Picture whole = view.render(scene);
  EXPECT_GT(countBlue(whole), 0);
  EXPECT_EQ(whole.rgb, draw(contents, above()).rgb);
}

TEST(ClippedMesh, IsCutByTheCropBox)
{
  SceneContents contents = meshScene();
  const core::GridGeometry& grid = contents.ct->geometry();
  core::IndexBox box = grid.fullBox();
  for (std::size_t a = 0; a < 2; ++a)
  {
    const double middle = grid.voxelFromPatient(kMiddle)[static_cast<Eigen::Index>(a)];
    box.lower[a] = static_cast<int>(std::ceil(middle - 4.0));
    box.upper[a] = box.lower[a] + 9; // 4 mm
  }
  contents.crop = box;
  EXPECT_NEAR(countBlue(draw(contents, above())), 1600, 90) << "a square of 4 mm";
  expectTheReference(contents, slanting());
  // Up to the image, a box cuts nothing.
  contents.crop = grid.fullBox();
  contents.meshes[0].mesh = ballMesh(kMiddle + Vector(0.0, 0.0, 18.0), kRadius, 96);
  const double disc = 100.0 * kPi * kRadius * kRadius;
  EXPECT_NEAR(countBlue(draw(contents, above())), disc, 0.05 * disc) << "but for its dark rim";
}

TEST(ClippedMesh, KeepsTheShareOfATranslucentOne)
{
  SceneContents contents = meshScene(0.5F);
  contents.clipping = {planeAt(0.0, {0.0, 0.0, -1.0})};
  const double cap = 100.0 * kPi * kRadius * kRadius;
  EXPECT_NEAR(countOf(draw(contents, above()), kPlain), 0.5 * cap, 0.015 * cap) << "screen door";
}

TEST(ClippedMesh, IsLitWithoutASection)
{
  SceneContents contents = meshScene();
  contents.section = std::nullopt;
  contents.clipping = {planeAt(0.0, {0.0, 1.0, -1.0})};
  expectTheReference(contents, above());
  contents.light.setShadows(true);
  contents.section = SectionWindow();
  contents.light.exposure = 1.0;
  contents.clipping = {planeAt(0.0, {0.0, 0.0, -1.0})};
  const double cap = 100.0 * kPi * kRadius * kRadius;
  EXPECT_NEAR(countOf(draw(contents, above()), kPlain), cap, 0.015 * cap)
      << "neither light nor exposure change a section";
}

TEST(ClippedMesh, ShowsItsInsideWhereItIsOpen)
{
  SceneContents contents = meshScene();
  core::TriangleMesh open = *contents.meshes[0].mesh;
  open.triangles.pop_back(); // at its lower pole
  contents.meshes[0].mesh = std::make_shared<const core::TriangleMesh>(open);
  contents.clipping = {planeAt(0.0, {0.0, 0.0, -1.0})};
  const Picture picture = draw(contents, above());
  const double disc = 100.0 * kPi * kRadius * kRadius;
  EXPECT_NEAR(countBlue(picture), disc, 0.05 * disc) << "the inside of its wall";
  EXPECT_LT(countOf(picture, kPlain), 0.1 * disc) << "lit";
  expectTheReference(contents, above());
}

// In bone, at the same plane: the mesh's cap hides the bone's section.
TEST(ClippedMesh, HidesTheSectionOfTheBoneAroundIt)
{
  SceneContents contents = meshScene();
  contents.ct = ct<std::int16_t>(cube(64, 0.5), [](const Vector& p) { return 14.0 - p.norm(); });
  contents.clipping = {planeAt(0.0, {0.3, -0.2, -1.0})};
  const Vector eye = kMiddle - 400.0 * contents.clipping[0].normal;
  core::CameraPose pose = from(eye, kMiddle, 2.0);
  pose.viewUp = {0.0, 1.0, 0.0};
  for (const bool isParallel : {false, true})
  {
    if (isParallel)
      pose.parallelScale = 7.0;
    const double scale = kHeight / (2.0 * (isParallel ? 7.0 : 400.0 * std::tan(kPi / 180.0)));
    const double cap = kPi * kRadius * kRadius * scale * scale;
    EXPECT_NEAR(countOf(draw(contents, pose), kPlain), cap, 0.015 * cap);
  }
}

TEST(ClippedMesh, ShowsADrilledOneAsTheDrillLeftIt)
{
  SceneContents contents = meshScene();
  contents.meshes[0].drilled = true;
  constexpr double kBurr = 2.0;
  contents.mask =
      cut(contents.ct->geometry(), [](const Vector& p) { return (p - kMiddle).norm() - kBurr; });
  contents.clipping = {planeAt(0.0, {0.0, 0.0, -1.0})};
  const double ring = 100.0 * kPi * (kRadius * kRadius - kBurr * kBurr);
  EXPECT_NEAR(countOf(draw(contents, above()), kPlain), ring, 0.02 * ring);
  expectTheReference(contents, slanting());
}

// It is not the plane's business.
TEST(ClippedMesh, LeavesTheToolWhole)
{
  SceneContents contents = meshScene();
  contents.meshes.clear();
  ToolPose pose;
  pose.center = kMiddle;
  contents.tool = pose;
  contents.clipping = {planeAt(60.0, {0.0, 1.0, 0.0})};
  contents.ct = nullptr;
  SceneContents unclipped = contents;
  unclipped.clipping.clear();
  EXPECT_EQ(draw(contents, slanting()).rgb, draw(unclipped, slanting()).rgb);
}
