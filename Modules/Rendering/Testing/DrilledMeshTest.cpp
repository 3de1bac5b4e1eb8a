#include "DrilledMesh.h"

#include <cmath>

#include <gtest/gtest.h>

#include "PictureComparison.h"
#include "PictureScenes.h"

using namespace petrous;
using namespace petrous::rendering;
using namespace petrous::rendering::synthetic;

namespace
{

constexpr double kPi = 3.14159265358979323846;

double areaOf(const core::TriangleMesh& mesh)
{
  double area = 0.0;
  for (const auto& [a, b, c] : mesh.triangles)
    area += 0.5 * static_cast<double>((mesh.vertices[b] - mesh.vertices[a])
                                          .cross(mesh.vertices[c] - mesh.vertices[a])
                                          .norm());
  return area;
}

} // namespace

// A ball of 6 mm less a cap: what is left below a plane 2 mm off its centre.
TEST(DrilledMesh, IsWhatTheDrillLeft)
{
  constexpr double kRadius = 6.0, kOff = 2.0;
  const auto mesh = ballMesh(Vector(0.3, -0.2, 0.1), kRadius, 96);
  const Vector normal = Vector(1.0, 2.0, -0.5).normalized();
  for (const auto& direction : {Eigen::Matrix3d::Identity().eval(), obliqueMirrored()})
  {
    const core::GridGeometry grid = cube(64, 0.4, direction);
    const auto mask =
        cut(grid, [&](const Vector& p) { return kOff - (p - Vector(0.3, -0.2, 0.1)).dot(normal); });
    const auto left = DrilledMesh(mesh).surface(*mask);
    ASSERT_TRUE(left);
    const double height = kRadius - kOff; // of the cap that is gone
    const double volume = 4.0 / 3.0 * kPi * std::pow(kRadius, 3) -
                          kPi * height * height / 3.0 * (3.0 * kRadius - height);
    const double area = 4.0 * kPi * kRadius * kRadius - 2.0 * kPi * kRadius * height +
                        kPi * (kRadius * kRadius - kOff * kOff);
    EXPECT_NEAR(left->mesh.signedVolume(), volume, 0.005 * volume) << "it is closed";
    EXPECT_NEAR(areaOf(left->mesh), area, 0.005 * area);
    ASSERT_EQ(left->normals.size(), left->mesh.vertices.size());
    for (const auto& triangle : left->mesh.triangles)
      for (const std::uint32_t vertex : triangle)
      {
        const Vector at = left->mesh.vertices[vertex].cast<double>() - Vector(0.3, -0.2, 0.1);
        EXPECT_LE(at.norm(), kRadius + 0.02);
        EXPECT_LE(at.dot(normal), kOff + 0.02);
        EXPECT_NEAR(left->normals[vertex].norm(), 1.0F, 0.05F); // interpolated
      }
  }
}

// A hole in the middle of large triangles, all of whose corners stay.
TEST(DrilledMesh, IsCutWithinItsTriangles)
{
  const auto mesh = boxMesh(Vector(-6.0, -6.0, -6.0), Vector(6.0, 6.0, 6.0));
  const core::GridGeometry grid = cube(64, 0.4);
  const auto mask =
      cut(grid, [](const Vector& p) { return (p - Vector(0.0, -6.0, 0.0)).norm() - 3.0; });
  const auto left = DrilledMesh(mesh).surface(*mask);
  ASSERT_TRUE(left);
  const double gone = 0.5 * 4.0 / 3.0 * kPi * 27.0;
  EXPECT_NEAR(mesh->signedVolume() - left->mesh.signedVolume(), gone, 0.02 * gone);
  const double area = 6.0 * 144.0 - kPi * 9.0 + 2.0 * kPi * 9.0;
  EXPECT_NEAR(areaOf(left->mesh), area, 0.005 * area);
}

// The diagonals of a face pass through bricks that are cut, its sides do not: with the sides whole,
// their triangles would never have short edges alone.
TEST(DrilledMesh, IsCutWithinTrianglesWithSidesFarFromTheCut)
{
  constexpr double kHalf = 10.0, kRadius = 3.0;
  const auto mesh = boxMesh(Vector::Constant(-kHalf), Vector::Constant(kHalf));
  const core::GridGeometry grid = cube(64, 0.4);
  const Vector middle(0.0, -kHalf, 0.0);
  const auto mask = cut(grid, [&](const Vector& p) { return (p - middle).norm() - kRadius; });
  ASSERT_TRUE(
      mask->untouched(grid.boxCovering({kHalf, -kHalf, -kHalf}, Vector(kHalf, -kHalf, kHalf))));
  const auto left = DrilledMesh(mesh).surface(*mask);
  ASSERT_TRUE(left);
  const double gone = 2.0 / 3.0 * kPi * std::pow(kRadius, 3);
  EXPECT_NEAR(mesh->signedVolume() - left->mesh.signedVolume(), gone, 0.02 * gone);
  const double area = 24.0 * kHalf * kHalf + kPi * kRadius * kRadius;
  EXPECT_NEAR(areaOf(left->mesh), area, 0.005 * area);
  EXPECT_LT(left->mesh.triangles.size(), 200000U) << "short edges near the cut alone";
}

TEST(DrilledMesh, IsWholeWhereNothingWasCut)
{
  const core::GridGeometry grid = cube(64, 0.4);
  const DrilledMesh mesh(ballMesh(Vector::Zero(), 4.0));
  EXPECT_FALSE(mesh.surface(volume::CutMask(grid)));
  EXPECT_FALSE(mesh.surface(
      *cut(grid, [](const Vector& p) { return (p - Vector(9.0, 9.0, 9.0)).norm() - 2.0; })));
  core::TriangleMesh open = *ballMesh(Vector::Zero(), 4.0);
  open.triangles.pop_back();
  EXPECT_FALSE(DrilledMesh(std::make_shared<const core::TriangleMesh>(open))
                   .surface(*cut(grid, [](const Vector& p) { return p.x(); })));
  EXPECT_TRUE(mesh.surface(*cut(grid, [](const Vector& p) { return p.x(); })));
  // All of a grid elsewhere is gone.
  const core::GridGeometry elsewhere =
      cube(8, 0.4, Eigen::Matrix3d::Identity(), Vector(50.0, 0.0, 0.0));
  EXPECT_FALSE(mesh.surface(*cut(elsewhere, [](const Vector&) { return -9.0; })));
  // All of it is gone.
  const auto nothing = mesh.surface(*cut(grid, [](const Vector& p) { return p.norm() - 8.0; }));
  ASSERT_TRUE(nothing);
  EXPECT_TRUE(nothing->mesh.triangles.empty());
}

namespace
{

SceneContents drilledScene(bool drilled = true)
{
  SceneContents contents = cutBall();
  MeshContents mesh;
  mesh.name = "ossicle";
  mesh.mesh = ballMesh(Vector(1.0, -9.0, 2.0), 3.0);
  mesh.look.color = {0.1F, 0.15F, 0.9F};
  mesh.drilled = drilled;
  contents.meshes = {mesh};
  return contents;
}

} // namespace

TEST(DrilledMeshPicture, FollowsTheCutAndItsUndo)
{
  ScenePicture scene;
  scene.setCamera(slanting());
  OffscreenView view(kWidth, kHeight);
  SceneContents contents = drilledScene();
  const auto mask = contents.mask;
  contents.mask = nullptr;
  scene.setContents(contents);
  const int whole = countBlue(view.render(scene));
  scene.maskChanged(mask, mask->geometry().fullBox());
  const Picture drilled = view.render(scene);
  EXPECT_LT(countBlue(drilled), 0.9 * whole);
  EXPECT_GT(countBlue(drilled), 0);
  EXPECT_EQ(drilled.rgb, draw(drilledScene(), slanting()).rgb) << "as from the start";
  scene.maskChanged(nullptr, mask->geometry().fullBox());
  EXPECT_EQ(countBlue(view.render(scene)), whole);
  EXPECT_EQ(countBlue(draw(drilledScene(false), slanting())), whole) << "it is not felt";
  const ReferencePicture truth = truthOf(drilledScene(), slanting());
  double squares = 0.0;
  for (std::size_t n = 0; n < truth.rgb.size(); ++n)
    squares += std::pow(drilled.rgb[n] - 255.0 * static_cast<double>(truth.rgb[n]), 2);
  EXPECT_LE(std::sqrt(squares / static_cast<double>(truth.rgb.size())), 4.0); // edges of polygons
}
