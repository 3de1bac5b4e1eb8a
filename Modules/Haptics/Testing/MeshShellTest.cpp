#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <random>
#include <string>
#include <vector>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "ShellChecks.h"
#include "petrous/Haptics/PointShell.h"

using namespace petrous;
using namespace petrous::haptics::checks;
using Eigen::Vector3d;
using haptics::makeMeshShell;
using haptics::PointShell;

namespace
{

constexpr double kPi = 3.14159265358979323846;

core::TriangleMesh box(const Vector3d& size)
{
  core::TriangleMesh mesh;
  for (int corner = 0; corner < 8; ++corner)
    mesh.vertices.push_back(Vector3d((corner & 1 ? 0.5 : -0.5) * size.x(),
                                     (corner & 2 ? 0.5 : -0.5) * size.y(),
                                     (corner & 4 ? 0.5 : -0.5) * size.z())
                                .cast<float>());
  mesh.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                    {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  return mesh;
}

// An octahedron, repeatedly subdivided on the sphere.
core::TriangleMesh ball(double radius, int halvings)
{
  core::TriangleMesh mesh;
  mesh.vertices = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
  mesh.triangles = {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4},
                    {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};
  for (int n = 0; n < halvings; ++n)
  {
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
    const auto middle = [&](std::uint32_t a, std::uint32_t b)
    {
      const auto [at, isNew] =
          middles.try_emplace(std::minmax(a, b), static_cast<std::uint32_t>(mesh.vertices.size()));
      if (isNew)
        mesh.vertices.push_back((mesh.vertices[a] + mesh.vertices[b]).normalized());
      return at->second;
    };
    std::vector<std::array<std::uint32_t, 3>> finer;
    for (const auto& t : mesh.triangles)
    {
      const std::uint32_t a = middle(t[0], t[1]);
      const std::uint32_t b = middle(t[1], t[2]);
      const std::uint32_t c = middle(t[2], t[0]);
      finer.insert(finer.end(), {{t[0], a, c}, {t[1], b, a}, {t[2], c, b}, {a, b, c}});
    }
    mesh.triangles = finer;
  }
  for (auto& vertex : mesh.vertices)
    vertex *= static_cast<float>(radius);
  return mesh;
}

// Farthest of random points on the triangles from the shell: never above the true value.
double farthestSeen(const PointShell& shell, const core::TriangleMesh& mesh, int each)
{
  std::mt19937 random(3);
  std::uniform_real_distribution<double> share;
  double worst = 0.0;
  for (const auto& t : mesh.triangles)
    for (int n = 0; n < each; ++n)
    {
      const double u = std::sqrt(share(random));
      const double v = share(random);
      const Vector3d place = (1.0 - u) * mesh.vertices[t[0]].cast<double>() +
                             u * (1.0 - v) * mesh.vertices[t[1]].cast<double>() +
                             u * v * mesh.vertices[t[2]].cast<double>();
      worst = std::max(worst, nearest(shell, place));
    }
  return worst;
}

// Radius of the holes of a regular triangular lattice of that many points.
double idealSpacing(double area, std::size_t count)
{
  return std::sqrt(area / static_cast<double>(count) * 2.0 / std::sqrt(27.0));
}

} // namespace

TEST(PointShell, CoversAMeshAlmostAsEvenlyAsALattice)
{
  const core::TriangleMesh mesh = ball(5.0, 5);
  const PointShell shell = makeMeshShell(mesh, "ball", 1000);
  expectConsistent(shell, 1000);
  EXPECT_EQ(shell.points.size(), 1000u);
  EXPECT_EQ(shell.burrCount, 0u);
  for (std::size_t i = 0; i < shell.points.size(); ++i)
  {
    ASSERT_NEAR(shell.points[i].norm(), 5.0, 0.01);
    ASSERT_GT(shell.normals[i].dot(shell.points[i]), 0.99 * 5.0);
  }
  const double seen = farthestSeen(shell, mesh, 4);
  EXPECT_LE(seen, shell.spacing);
  EXPECT_GE(seen, 0.9 * shell.spacing);
  EXPECT_LT(shell.spacing, 1.45 * idealSpacing(100.0 * kPi, 1000));
}

TEST(PointShell, KeepsTheCornersAndEdgesOfAMesh)
{
  const core::TriangleMesh mesh = box({10.0, 6.0, 4.0});
  const PointShell shell = makeMeshShell(mesh, "box", 600);
  expectConsistent(shell, 600);
  for (const auto& vertex : mesh.vertices)
    EXPECT_EQ(nearest(shell, vertex.cast<double>()), 0.0);
  for (double x = -5.0; x <= 5.0; x += 0.1)
  {
    double along = 10.0; // to the points on this edge
    for (const auto& p : shell.points)
      if (std::hypot(p.y() - 3.0, p.z() - 2.0) < 1e-6)
        along = std::min(along, std::abs(p.x() - x));
    EXPECT_LE(along, shell.spacing) << "the edge at " << x;
  }
  for (std::size_t i = 0; i < shell.points.size(); ++i)
  {
    const Vector3d share = shell.points[i].cwiseQuotient(Vector3d(5.0, 3.0, 2.0)).cwiseAbs();
    ASSERT_NEAR(share.maxCoeff(), 1.0, 1e-6) << "on the surface";
    ASSERT_GT(shell.normals[i].dot(shell.points[i]), 0.0);
  }
  EXPECT_LE(farthestSeen(shell, mesh, 400), shell.spacing);
  EXPECT_LT(shell.spacing, 1.5 * idealSpacing(2.0 * (60.0 + 40.0 + 24.0), 600));
}

TEST(PointShell, BothSidesOfAThinBladeHavePoints)
{
  const PointShell shell = makeMeshShell(box({20.0, 20.0, 0.2}), "blade", 400);
  const double allowed = 1.6 * idealSpacing(800.0, 400);
  for (const double side : {-1.0, 1.0})
    for (double x = -9.75; x < 10.0; x += 0.5)
      for (double y = -9.75; y < 10.0; y += 0.5)
      {
        double distance = 20.0;
        for (std::size_t i = 0; i < shell.points.size(); ++i)
          if (side * shell.normals[i].z() > 0.0)
            distance = std::min(distance, (shell.points[i] - Vector3d(x, y, 0.1 * side)).norm());
        ASSERT_LE(distance, allowed) << x << " " << y << " side " << side;
      }
}

TEST(PointShell, AnInsideOutMeshHasOutwardNormalsToo)
{
  core::TriangleMesh mesh = ball(3.0, 3);
  for (auto& t : mesh.triangles)
    std::swap(t[0], t[1]);
  const PointShell shell = makeMeshShell(mesh, "ball", 200);
  for (std::size_t i = 0; i < shell.points.size(); ++i)
    ASSERT_GT(shell.normals[i].dot(shell.points[i]), 0.0);
}

TEST(PointShell, TheSameMeshGivesTheSamePoints)
{
  const core::TriangleMesh mesh = box({3.0, 2.0, 1.0});
  const PointShell one = makeMeshShell(mesh, "box", 300);
  const PointShell two = makeMeshShell(mesh, "box", 300);
  EXPECT_EQ(one.points, two.points);
  EXPECT_EQ(one.normals, two.normals);
}

TEST(PointShell, FlatTrianglesOfAMeshAreNoHindrance)
{
  // A vertex on an edge bisects a corner: the triangle in between has no area.
  core::TriangleMesh mesh = box({2.0, 2.0, 2.0});
  const auto extra = static_cast<std::uint32_t>(mesh.vertices.size());
  mesh.vertices.emplace_back(0.0f, -1.0f, -1.0f); // in the middle of the edge 0-1
  mesh.triangles[0] = {0, 2, extra};
  mesh.triangles.push_back({extra, 2, 1});
  mesh.triangles.push_back({0, extra, 1});
  ASSERT_TRUE(mesh.isClosed());
  const PointShell shell = makeMeshShell(mesh, "box", 300);
  expectConsistent(shell, 300);
  EXPECT_LE(farthestSeen(shell, box({2.0, 2.0, 2.0}), 100), shell.spacing);
}

TEST(PointShell, NamesWhatIsWrongWithAMesh)
{
  EXPECT_EQ(refusal([] { makeMeshShell({}, "hook.obj"); }), "hook.obj: the mesh has no triangle");
  core::TriangleMesh open = box({1, 1, 1});
  open.triangles.pop_back();
  EXPECT_NE(
      refusal([&] { makeMeshShell(open, "hook.obj"); }).find("hook.obj: the mesh is not closed"),
      std::string::npos);
  core::TriangleMesh wild = box({1, 1, 1});
  wild.triangles[3][1] = 99;
  EXPECT_NE(refusal([&] { makeMeshShell(wild, "hook.obj"); }).find("vertex 99"), std::string::npos);
  core::TriangleMesh flat = box({0, 0, 1});
  EXPECT_EQ(refusal([&] { makeMeshShell(flat, "hook.obj"); }),
            "hook.obj: no triangle of the mesh has an area");
  core::TriangleMesh broken = box({1, 1, 1});
  broken.vertices[2].y() = std::numeric_limits<float>::quiet_NaN();
  EXPECT_NE(refusal([&] { makeMeshShell(broken, "hook.obj"); }).find("not finite"),
            std::string::npos);
  EXPECT_NE(refusal(
                [] {
                  makeMeshShell(box({1, 1, 1}), "hook.obj", 10);
                })
                .find("hook.obj"),
            std::string::npos);
}
