#include "petrous/Volume/MeshDecimation.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "petrous/Core/Error.h"

using namespace petrous;
using namespace petrous::volume;
using Eigen::Vector3d;

namespace
{

constexpr double kPi = 3.14159265358979323846;
const Vector3d kAway(80.0, -120.0, 1100.0); // mm, as far from the origin as a head in a scanner

void add(core::TriangleMesh& mesh, const core::TriangleMesh& other, bool inwards = false)
{
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  mesh.vertices.insert(mesh.vertices.end(), other.vertices.begin(), other.vertices.end());
  for (auto triangle : other.triangles)
  {
    if (inwards)
      std::swap(triangle[1], triangle[2]);
    mesh.triangles.push_back({triangle[0] + first, triangle[1] + first, triangle[2] + first});
  }
}

/// The surface of a box, each face of `parts`[a] times `parts`[b] squares, every vertex moved.
core::TriangleMesh boxSurface(const std::array<int, 3>& parts,
                              const std::function<Vector3d(const Vector3d&)>& moved)
{
  core::TriangleMesh mesh;
  std::map<std::array<int, 3>, std::uint32_t> known;
  const auto vertex = [&](const std::array<int, 3>& at)
  {
    const auto [place, isNew] = known.try_emplace(at, mesh.vertices.size());
    if (isNew)
      mesh.vertices.push_back(
          moved(Vector3d(2.0 * at[0] / parts[0] - 1.0, 2.0 * at[1] / parts[1] - 1.0,
                         2.0 * at[2] / parts[2] - 1.0))
              .cast<float>());
    return place->second;
  };
  for (std::size_t axis = 0; axis < 3; ++axis)
    for (const bool isUpper : {false, true})
    {
      const std::size_t u = (axis + 1) % 3;
      const std::size_t v = (axis + 2) % 3;
      for (int i = 0; i < parts[u]; ++i)
        for (int j = 0; j < parts[v]; ++j)
        {
          const auto at = [&](int di, int dj)
          {
            std::array<int, 3> index{};
            index[axis] = isUpper ? parts[axis] : 0;
            index[u] = i + di;
            index[v] = j + dj;
            return vertex(index);
          };
          std::array<std::array<std::uint32_t, 3>, 2> pair{
              {{at(0, 0), at(1, 0), at(1, 1)}, {at(0, 0), at(1, 1), at(0, 1)}}};
          for (auto& triangle : pair)
          {
            if (!isUpper)
              std::swap(triangle[1], triangle[2]);
            mesh.triangles.push_back(triangle);
          }
        }
    }
  return mesh;
}

core::TriangleMesh sphere(double radius, const Vector3d& center = kAway, int parts = 40)
{
  return boxSurface({parts, parts, parts},
                    [&](const Vector3d& p) { return Vector3d(center + radius * p.normalized()); });
}

core::TriangleMesh torus(double large, double small)
{
  constexpr int kAlong = 160;
  constexpr int kAround = 60;
  core::TriangleMesh mesh;
  for (int i = 0; i < kAlong; ++i)
    for (int j = 0; j < kAround; ++j)
    {
      const double u = 2.0 * kPi * i / kAlong;
      const double v = 2.0 * kPi * j / kAround;
      const double off = large + small * std::cos(v);
      mesh.vertices.push_back(
          (kAway + Vector3d(off * std::cos(u), off * std::sin(u), small * std::sin(v)))
              .cast<float>());
      const auto at = [&](int a, int b)
      { return static_cast<std::uint32_t>((i + a) % kAlong * kAround + (j + b) % kAround); };
      mesh.triangles.push_back({at(0, 0), at(1, 0), at(1, 1)});
      mesh.triangles.push_back({at(0, 0), at(1, 1), at(0, 1)});
    }
  return mesh;
}

/// V - E + F of a closed mesh: 2 for a sphere, 0 for a torus, the sum for several.
long eulerCharacteristic(const core::TriangleMesh& mesh)
{
  return static_cast<long>(mesh.vertices.size()) - static_cast<long>(mesh.triangles.size()) / 2;
}

/// The largest distance of a mesh's points from the surface, on a lattice in each triangle.
double largest(const core::TriangleMesh& mesh, const std::function<double(const Vector3d&)>& off)
{
  constexpr int kParts = 8;
  double worst = 0.0;
  for (const auto& t : mesh.triangles)
    for (int i = 0; i <= kParts; ++i)
      for (int j = 0; i + j <= kParts; ++j)
      {
        const Vector3d a = mesh.vertices[t[0]].cast<double>();
        const Vector3d b = mesh.vertices[t[1]].cast<double>();
        const Vector3d c = mesh.vertices[t[2]].cast<double>();
        worst = std::max(worst, std::abs(off(a + (b - a) * i / kParts + (c - a) * j / kParts)));
      }
  return worst;
}

void expectSound(const core::TriangleMesh& whole, const DecimatedMesh& fewer, std::size_t asked)
{
  EXPECT_TRUE(fewer.mesh.isClosed()) << asked;
  EXPECT_LE(fewer.mesh.triangles.size(), asked);
  EXPECT_GE(fewer.mesh.triangles.size() + 1, asked);
  EXPECT_TRUE(fewer.limit.empty()) << fewer.limit;
  EXPECT_EQ(eulerCharacteristic(fewer.mesh), eulerCharacteristic(whole)) << asked;
  EXPECT_NEAR(fewer.mesh.signedVolume(), whole.signedVolume(),
              1e-4 * std::abs(whole.signedVolume()))
      << asked;
  EXPECT_EQ(fewer.selfIntersections, 0U) << asked;
}

// A triangle with corners on a sphere of radius R has its center at L^2 / (6 R) below it, L the
// edge of an equilateral triangle: of N, L^2 = 16 pi R^2 / (sqrt(3) N). Where the volume is kept,
// corners and centers are on either side; triangles are not all alike, hence twice that.
double sagitta(double radius, std::size_t triangles)
{
  return 16.0 * kPi * radius / (6.0 * std::sqrt(3.0) * static_cast<double>(triangles));
}

} // namespace

TEST(MeshDecimation, KeepsASpheresVolumeAndSaysHowFarItLies)
{
  constexpr double kRadius = 9.0;
  const core::TriangleMesh whole = sphere(kRadius);
  double before = 0.0;
  for (const std::size_t asked : {4001U, 1000U, 200U, 60U})
  {
    const DecimatedMesh fewer = decimated(whole, asked);
    expectSound(whole, fewer, asked);
    const auto off = [&](const Vector3d& p) { return (p - kAway).norm() - kRadius; };
    const double truth = largest(fewer.mesh, off);
    EXPECT_LT(truth, 2.0 * sagitta(kRadius, asked)) << asked;
    // The whole mesh is off the sphere by its own sagitta; samples are a fine edge apart.
    const double own = 2.0 * sagitta(kRadius, whole.triangles.size());
    EXPECT_NEAR(fewer.toGiven, truth, own + 0.1 * truth) << asked;
    EXPECT_LE(fewer.fromGiven, truth + own) << asked;
    EXPECT_GT(fewer.mean, 0.1 * truth) << asked;
    EXPECT_LT(fewer.mean, 0.5 * truth) << asked;
    EXPECT_EQ(fewer.hausdorff(), std::max(fewer.fromGiven, fewer.toGiven));
    EXPECT_GT(fewer.hausdorff(), before);
    before = fewer.hausdorff();
  }
}

TEST(MeshDecimation, KeepsTheHoleOfATorus)
{
  const core::TriangleMesh whole = torus(8.0, 2.5);
  ASSERT_EQ(eulerCharacteristic(whole), 0);
  for (const std::size_t asked : {2000U, 300U, 100U})
  {
    const DecimatedMesh fewer = decimated(whole, asked);
    expectSound(whole, fewer, asked);
    const auto off = [](const Vector3d& p)
    {
      const Vector3d x = p - kAway;
      return std::hypot(std::hypot(x.x(), x.y()) - 8.0, x.z()) - 2.5;
    };
    EXPECT_LT(largest(fewer.mesh, off), asked > 1000 ? 0.06 : asked > 200 ? 0.4 : 1.2) << asked;
  }
}

// A torus has 14 triangles or more [Moebius 1861].
TEST(MeshDecimation, KeepsMoreTrianglesRatherThanTheTopology)
{
  const core::TriangleMesh whole = torus(8.0, 2.5);
  const DecimatedMesh fewer = decimated(whole, 4);
  EXPECT_GE(fewer.mesh.triangles.size(), 14U);
  EXPECT_LE(fewer.mesh.triangles.size(), 100U);
  EXPECT_FALSE(fewer.limit.empty());
  EXPECT_TRUE(fewer.mesh.isClosed());
  EXPECT_EQ(eulerCharacteristic(fewer.mesh), 0);
  EXPECT_NEAR(fewer.mesh.signedVolume(), whole.signedVolume(), 1e-4 * whole.signedVolume());
}

TEST(MeshDecimation, KeepsTheCavityOfAHollowSphere)
{
  const core::TriangleMesh outer = sphere(9.0);
  const core::TriangleMesh inner = sphere(7.5);
  core::TriangleMesh whole = outer;
  add(whole, inner, true);
  ASSERT_EQ(eulerCharacteristic(whole), 4);
  const DecimatedMesh fewer = decimated(whole, 1000);
  expectSound(whole, fewer, 1000);
  EXPECT_EQ(fewer.pieces, 2U);
  // Each of the two keeps its own volume.
  core::TriangleMesh shell{fewer.mesh.vertices, {}};
  for (const auto& t : fewer.mesh.triangles)
    if ((fewer.mesh.vertices[t[0]].cast<double>() - kAway).norm() > 8.25)
      shell.triangles.push_back(t);
  EXPECT_TRUE(shell.isClosed());
  EXPECT_NEAR(shell.signedVolume(), outer.signedVolume(), 1e-4 * outer.signedVolume());
}

TEST(MeshDecimation, KeepsAThinPlateFromCollapsing)
{
  // 40 x 30 x 0.4 mm of squares of 0.5 mm, bent by 3 mm.
  const core::TriangleMesh whole = boxSurface(
      {80, 60, 1}, [](const Vector3d& p)
      { return Vector3d(20.0 * p.x(), 15.0 * p.y(), 0.2 * p.z() + 3.0 * p.x() * p.x()); });
  for (const std::size_t asked : {4000U, 1000U, 300U})
  {
    const DecimatedMesh fewer = decimated(whole, asked);
    expectSound(whole, fewer, asked);
    EXPECT_LT(fewer.hausdorff(), asked > 500 ? 0.05 : 0.2) << asked;
  }
  // A flat one needs no more than its 12 triangles, and loses nothing.
  const core::TriangleMesh flat =
      boxSurface({80, 60, 1}, [](const Vector3d& p)
                 { return Vector3d(20.0 * p.x(), 15.0 * p.y(), 0.2 * p.z()); });
  const DecimatedMesh few = decimated(flat, 100);
  expectSound(flat, few, 100);
  EXPECT_LT(few.hausdorff(), 0.01);
}

TEST(MeshDecimation, SeparatesSurfacesThatTouchAtAVertex)
{
  // Two spheres, the uppermost vertex of one of which is the lowest of the other.
  const core::TriangleMesh lower = sphere(5.0, Vector3d::Zero(), 20);
  const core::TriangleMesh upper = sphere(5.0, Vector3d(0, 0, 10.0), 20);
  core::TriangleMesh whole = lower;
  add(whole, upper);
  const auto vertexAt = [&](std::size_t first, std::size_t last)
  {
    std::size_t best = first;
    for (std::size_t v = first; v < last; ++v)
      if ((whole.vertices[v] - Eigen::Vector3f(0, 0, 5)).norm() <
          (whole.vertices[best] - Eigen::Vector3f(0, 0, 5)).norm())
        best = v;
    return static_cast<std::uint32_t>(best);
  };
  const std::uint32_t kept = vertexAt(0, lower.vertices.size());
  const std::uint32_t merged = vertexAt(lower.vertices.size(), whole.vertices.size());
  for (auto& t : whole.triangles)
    std::replace(t.begin(), t.end(), merged, kept);
  ASSERT_TRUE(whole.isClosed());
  const DecimatedMesh fewer = decimated(whole, 800);
  EXPECT_EQ(fewer.pieces, 2U);
  EXPECT_TRUE(fewer.mesh.isClosed());
  EXPECT_EQ(fewer.mesh.triangles.size(), 800U);
  EXPECT_EQ(eulerCharacteristic(fewer.mesh), 4);
  EXPECT_NEAR(fewer.mesh.signedVolume(), whole.signedVolume(), 1e-4 * whole.signedVolume());
  EXPECT_LT(fewer.hausdorff(), 2.0 * sagitta(5.0, 400));
}

TEST(MeshDecimation, CountsTrianglesThatPassThroughEachOther)
{
  // Spheres that overlap do so along a circle: before and after.
  core::TriangleMesh whole = sphere(5.0, Vector3d::Zero(), 20);
  add(whole, sphere(5.0, Vector3d(6.0, 0.1, 0.2), 20));
  const DecimatedMesh fewer = decimated(whole, 1000);
  EXPECT_GE(fewer.selfIntersections, 20U);
  EXPECT_LE(fewer.selfIntersections, 400U);
}

TEST(MeshDecimation, IsTheSameEveryTime)
{
  const core::TriangleMesh whole = torus(8.0, 2.5);
  const DecimatedMesh once = decimated(whole, 500);
  const DecimatedMesh again = decimated(whole, 500);
  EXPECT_EQ(once.mesh.vertices, again.mesh.vertices);
  EXPECT_EQ(once.mesh.triangles, again.mesh.triangles);
  EXPECT_EQ(once.mean, again.mean);
}

TEST(MeshDecimation, RefusesWhatIsNotClosedAndTooFewTriangles)
{
  const core::TriangleMesh whole = sphere(5.0, kAway, 8);
  const DecimatedMesh same = decimated(whole, whole.triangles.size());
  EXPECT_EQ(same.mesh.triangles, whole.triangles);
  EXPECT_EQ(same.hausdorff(), 0.0);
  EXPECT_THROW(decimated(whole, 3), core::InvalidParameter);
  EXPECT_THROW(decimated(core::TriangleMesh{}, 100), core::InvalidParameter);
  core::TriangleMesh open = whole;
  open.triangles.pop_back();
  EXPECT_THROW(decimated(open, 100), core::InvalidParameter);
  core::TriangleMesh turned = whole;
  std::swap(turned.triangles[0][0], turned.triangles[0][1]);
  EXPECT_THROW(decimated(turned, 100), core::InvalidParameter);
  core::TriangleMesh doubled = whole; // every edge has four triangles
  doubled.triangles.insert(doubled.triangles.end(), whole.triangles.begin(), whole.triangles.end());
  EXPECT_THROW(decimated(doubled, 100), core::InvalidParameter);
  core::TriangleMesh folded = whole; // an edge of no length
  folded.triangles.push_back({0, 0, 1});
  EXPECT_THROW(decimated(folded, 100), core::InvalidParameter);
  // Every piece needs its 4 triangles.
  core::TriangleMesh many;
  for (int n = 0; n < 20; ++n)
    add(many, sphere(1.0, Vector3d(5.0 * n, 0, 0), 2));
  EXPECT_EQ(decimated(many, 80).mesh.triangles.size(), 80U);
  try
  {
    decimated(many, 79);
    ADD_FAILURE() << "was accepted";
  }
  catch (const core::InvalidParameter& error)
  {
    EXPECT_NE(std::string(error.what()).find("20 pieces"), std::string::npos) << error.what();
  }
}

TEST(MeshDecimation, StopsWhenCancelled)
{
  auto token = std::make_shared<core::CancelToken>();
  token->cancel();
  EXPECT_THROW(decimated(sphere(5.0), 100, core::Progress({}, token)), core::CancelledError);
}
