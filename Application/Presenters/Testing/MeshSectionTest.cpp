#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include <Eigen/Geometry>

#include "petrous/Presenters/MeshSection.h"
#include "petrous/Presenters/SlicePresenter.h"

using namespace petrous;
using namespace petrous::presenters;
using Eigen::Vector3d;
using Eigen::Vector3f;

namespace
{

constexpr double kPi = 3.14159265358979323846;

// A ball as `rings` by 2 `rings` quadrilaterals, outwards counter-clockwise.
core::TriangleMesh ball(const Vector3d& center, double radius, int rings)
{
  core::TriangleMesh mesh;
  const int around = 2 * rings;
  const auto at = [&](int ring, int n)
  {
    const double polar = kPi * ring / rings;
    const double turn = 2.0 * kPi * n / around;
    return Vector3f((center + radius * Vector3d(std::sin(polar) * std::cos(turn),
                                                std::sin(polar) * std::sin(turn), std::cos(polar)))
                        .cast<float>());
  };
  mesh.vertices = {at(0, 0), at(rings, 0)};
  for (int ring = 1; ring < rings; ++ring)
    for (int n = 0; n < around; ++n)
      mesh.vertices.push_back(at(ring, n));
  const auto index = [&](int ring, int n) -> std::uint32_t
  {
    return ring == 0       ? 0U
           : ring == rings ? 1U
                           : static_cast<std::uint32_t>(2 + (ring - 1) * around + n % around);
  };
  for (int ring = 0; ring < rings; ++ring)
    for (int n = 0; n < around; ++n)
    {
      if (ring + 1 < rings)
        mesh.triangles.push_back({index(ring, n), index(ring + 1, n), index(ring + 1, n + 1)});
      if (ring > 0)
        mesh.triangles.push_back({index(ring, n), index(ring + 1, n + 1), index(ring, n + 1)});
    }
  return mesh;
}

// Without shared vertices, as STL has them.
core::TriangleMesh apart(const core::TriangleMesh& mesh)
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

core::TriangleMesh together(core::TriangleMesh a, const core::TriangleMesh& b)
{
  const auto first = static_cast<std::uint32_t>(a.vertices.size());
  a.vertices.insert(a.vertices.end(), b.vertices.begin(), b.vertices.end());
  for (const auto& t : b.triangles)
    a.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
  return a;
}

core::TriangleMesh turnedInsideOut(core::TriangleMesh mesh)
{
  for (auto& triangle : mesh.triangles)
    std::swap(triangle[1], triangle[2]);
  return mesh;
}

// Pixels^2, by the shoelace formula; its sign tells the direction of the contours.
double areaOf(const MeshSection& section)
{
  double twice = 0.0;
  for (const ContourSegment& segment : section.segments)
    twice += static_cast<double>(segment.a[0]) * static_cast<double>(segment.b[1]) -
             static_cast<double>(segment.b[0]) * static_cast<double>(segment.a[1]);
  return 0.5 * twice;
}

SliceAxes turned()
{
  const Eigen::Matrix3d turn =
      Eigen::AngleAxisd(0.7, Vector3d(1, -2, 0.5).normalized()).toRotationMatrix();
  return {turn.col(0), turn.col(1), turn.col(2)};
}

SlicePixels white(int edge)
{
  SlicePixels pixels;
  pixels.width = pixels.height = edge;
  pixels.rgb.assign(static_cast<std::size_t>(3 * edge * edge), 255);
  return pixels;
}

int tinted(const SlicePixels& pixels)
{
  int count = 0;
  for (int row = 0; row < pixels.height; ++row)
    for (int column = 0; column < pixels.width; ++column)
      count += pixels.at(column, row)[1] < 255;
  return count;
}

constexpr std::array<float, 3> kRed{255.0F, 0.0F, 0.0F};

scene::Case meshCase(const core::TriangleMesh& mesh)
{
  const core::GridGeometry grid({60, 60, 60}, Vector3d::Ones(), Vector3d::Zero());
  scene::Case value;
  value.ct.geometry = grid;
  value.ct.volume = std::make_shared<const volume::IntensityVolume>(
      std::make_shared<const volume::Volume<float>>(volume::Volume<float>(grid, 1000.0F)));
  value.dissection = dissection::Dissection(grid);
  scene::MeshPart part;
  part.name = "sinus";
  part.mesh = std::make_shared<const core::TriangleMesh>(mesh);
  part.look.color = {1.0F, 0.0F, 0.0F};
  value.meshes.push_back(part);
  return value;
}

const GreyWindow kWhite{1.0, -1000.0};

} // namespace

// [Archimedes] a ball of radius R is cut at a distance d in a disc of radius sqrt(R^2 - d^2).
TEST(MeshSection, OfABallIsADiscInEveryPlane)
{
  const Vector3d center(-36.3, 3.1, 7.7);
  const core::TriangleMesh mesh = ball(center, 10.0, 200);
  for (const SliceAxes& axes : {axesOf(SliceOrientation::Axial), axesOf(SliceOrientation::Coronal),
                                axesOf(SliceOrientation::Sagittal), turned()})
    for (const double distance : {0.0, 6.0, -8.0})
    {
      const SliceGeometry slice(SliceOrientation::Axial, axes, center + distance * axes.next, 0.1,
                                300, 300);
      const MeshSection section = sectionOf(mesh, slice);
      EXPECT_TRUE(section.isClosed) << distance;
      EXPECT_TRUE(section.facesAlike) << distance;
      const double expected = kPi * (100.0 - distance * distance) * 100.0; // pixels^2
      EXPECT_NEAR(std::abs(areaOf(section)), expected, 0.002 * expected) << distance;
      const double radius = std::sqrt(100.0 - distance * distance) / 0.1;
      for (const ContourSegment& segment : section.segments)
        ASSERT_NEAR((segment.a - Eigen::Vector2f(149.5F, 149.5F)).norm(), radius, 0.1) << distance;
    }
  const SliceGeometry beside(SliceOrientation::Axial, center + Vector3d(0, 0, 10.5), 0.1, 300, 300);
  EXPECT_TRUE(sectionOf(mesh, beside).segments.empty());
}

TEST(MeshSection, IsClosedWhereVerticesLieOnThePlaneAndWhereTrianglesShareNone)
{
  const core::TriangleMesh mesh = ball({0, 0, 0}, 10.0, 20); // a ring of vertices at z = 0
  const SliceGeometry slice(SliceOrientation::Axial, {0, 0, 0}, 0.1, 300, 300);
  EXPECT_TRUE(sectionOf(mesh, slice).isClosed);
  const SliceGeometry turnedSlice(SliceOrientation::Axial, turned(), {0.3, 0.2, 0.1}, 0.1, 300,
                                  300);
  const MeshSection soup = sectionOf(apart(mesh), turnedSlice);
  EXPECT_TRUE(soup.isClosed);
  EXPECT_NEAR(areaOf(soup), areaOf(sectionOf(mesh, turnedSlice)), 1e-2);
}

TEST(MeshSection, FillsClosedContoursAloneAndOutlinesAll)
{
  core::TriangleMesh mesh = ball({0, 0, 0}, 10.0, 100);
  const SliceGeometry slice(SliceOrientation::Axial, {0, 0, 0.05}, 0.1, 300, 300);
  SlicePixels pixels = white(300);
  sectionOf(mesh, slice).paint(kRed, pixels);
  EXPECT_GT(tinted(pixels), 0.995 * kPi * 1e4);
  EXPECT_LT(tinted(pixels), kPi * 101.5 * 101.5) << "half of the line lies outside";
  EXPECT_NEAR(pixels.at(149, 149)[1], 255 * 0.7, 1.0);
  EXPECT_EQ(pixels.at(149, 149)[0], 255);
  int darkest = 255;
  for (int column = 45; column < 55; ++column)
    darkest = std::min<int>(darkest, pixels.at(column, 149)[1]);
  EXPECT_LT(darkest, 100) << "the outline";
  EXPECT_EQ(pixels.at(40, 149)[1], 255);

  // Half of the ball, open towards +x.
  mesh.triangles.erase(std::remove_if(mesh.triangles.begin(), mesh.triangles.end(),
                                      [&](const auto& t)
                                      { return mesh.vertices[t[0]].x() > 1.0F; }),
                       mesh.triangles.end());
  const MeshSection open = sectionOf(mesh, slice);
  EXPECT_FALSE(open.isClosed);
  pixels = white(300);
  open.paint(kRed, pixels);
  EXPECT_EQ(pixels.at(149, 149)[1], 255);
  EXPECT_GT(tinted(pixels), 300); // about half of 2 pi 100 pixels
  EXPECT_LT(tinted(pixels), 1200);
}

// As to hand and drill: shells that overlap are united, one that faces inwards is a cavity.
TEST(MeshSection, FillsByTheWindingNumber)
{
  const SliceGeometry slice(SliceOrientation::Axial, {0, 0, 0.05}, 0.1, 400, 400);
  const auto middleOf = [&](const core::TriangleMesh& mesh)
  {
    SlicePixels pixels = white(400);
    sectionOf(mesh, slice).paint(kRed, pixels);
    return static_cast<int>(pixels.at(199, 199)[1]);
  };
  const core::TriangleMesh outer = ball({0, 0, 0}, 10.0, 40);
  const core::TriangleMesh inner = ball({0, 0, 0}, 4.0, 30);
  EXPECT_LT(middleOf(together(outer, ball({5, 0, 0}, 9.0, 40))), 200);
  EXPECT_EQ(middleOf(together(outer, turnedInsideOut(inner))), 255);
  EXPECT_LT(middleOf(turnedInsideOut(outer)), 200);
}

TEST(MeshSection, StaysWithinThePicture)
{
  const core::TriangleMesh mesh = ball({0, 0, 0}, 10.0, 40);
  for (const Vector3d& center :
       {Vector3d(9, 0, 0.05), Vector3d(0, -9, 0.05), Vector3d(0, 0, 0.05), Vector3d(40, 40, 0.05)})
  {
    const SliceGeometry slice(SliceOrientation::Axial, center, 0.1, 50, 50);
    SlicePixels pixels = white(50);
    sectionOf(mesh, slice).paint(kRed, pixels);
    // All inside the ball, at its border, or beside it.
    const bool isAll = center.head<2>().norm() < 1.0;
    const bool isNone = center.head<2>().norm() > 20.0;
    EXPECT_EQ(tinted(pixels) == 2500, isAll);
    EXPECT_EQ(tinted(pixels) == 0, isNone);
  }
}

TEST(SlicePresenter, DrawsTheSectionOfAShownMesh)
{
  scene::Case value = meshCase(ball({30, 30, 30}, 10.0, 60));
  const SliceGeometry slice(SliceOrientation::Coronal, {29.5, 30.3, 29.5}, 1.0, 60, 60);
  const SlicePresenter before(value);
  const SlicePixels pixels = before.draw(slice, kWhite);
  EXPECT_NEAR(pixels.at(30, 30)[1], 255 * 0.7, 1.0);
  EXPECT_EQ(pixels.at(5, 5)[1], 255);
  const Slab slab{8.0, Projection::Maximum};
  EXPECT_EQ(before.draw(slice, kWhite, nullptr, slab).rgb, pixels.rgb)
      << "the structures of a slab are those of the slice";

  value.meshes[0].look.color = {0.0F, 1.0F, 0.0F};
  EXPECT_FALSE(SlicePresenter(value).drawsAs(before));
  value.meshes[0].look.shown = false;
  EXPECT_FALSE(SlicePresenter(value).drawsAs(before));
  EXPECT_EQ(SlicePresenter(value).draw(slice, kWhite).at(30, 30)[1], 255);
}

TEST(SlicePresenter, MarksWhatIsDrilledOfAMesh)
{
  scene::Case value = meshCase(ball({30, 30, 30}, 10.0, 60));
  value.dissection.beginStroke({});
  value.dissection.cut({{30, 30, 30}, {30, 30, 30}, 4.0});
  value.dissection.endStroke();
  const SliceGeometry slice(SliceOrientation::Axial, {29.5, 29.5, 30.3}, 1.0, 60, 60);
  const SlicePixels pixels = SlicePresenter(value).draw(slice, kWhite);
  EXPECT_LT(pixels.at(30, 30)[1], 130) << "cut away";
  EXPECT_NEAR(pixels.at(30, 37)[1], 255 * 0.7, 1.0) << "left";
}
