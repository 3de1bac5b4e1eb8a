#include "petrous/Volume/MeshTree.h"

#include <random>

#include <gtest/gtest.h>

#include "petrous/Core/Error.h"

namespace petrous::volume
{
namespace
{

// 500 triangles of some 4 mm, anywhere in a cube of 20 mm.
core::TriangleMesh scattered(std::mt19937& random)
{
  std::uniform_real_distribution<float> position(-10.0F, 10.0F);
  core::TriangleMesh mesh;
  for (std::uint32_t i = 0; i < 500; ++i)
  {
    const Eigen::Vector3f at(position(random), position(random), position(random));
    for (int corner = 0; corner < 3; ++corner)
      mesh.vertices.push_back(
          at + 0.2F * Eigen::Vector3f(position(random), position(random), position(random)));
    mesh.triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
  }
  return mesh;
}

} // namespace

TEST(MeshTree, FindsTheTriangleThatATestOfEachFinds)
{
  std::mt19937 random(7);
  const core::TriangleMesh mesh = scattered(random);
  std::uniform_real_distribution<double> position(-10.0, 10.0);
  const MeshTree tree(mesh);
  int hits = 0;
  for (int i = 0; i < 500; ++i)
  {
    const Eigen::Vector3d origin(position(random), position(random), 30.0);
    const Eigen::Vector3d to(position(random), position(random), -30.0);
    const Eigen::Vector3d direction = (to - origin).normalized();
    const double start = i % 2 == 0 ? 0.0 : 30.0;
    double nearest = 1e9;
    std::size_t which = 0;
    Eigen::Vector3d weights;
    for (std::uint32_t t = 0; t < 500; ++t)
    {
      // Solves origin + s direction = a + u (b - a) + v (c - a).
      const Eigen::Vector3d a = mesh.vertices[3 * t].cast<double>();
      Eigen::Matrix3d system;
      system << mesh.vertices[3 * t + 1].cast<double>() - a,
          mesh.vertices[3 * t + 2].cast<double>() - a, -direction;
      const Eigen::Vector3d uvs = system.fullPivLu().solve(origin - a);
      if (uvs[0] >= 0.0 && uvs[1] >= 0.0 && uvs[0] + uvs[1] <= 1.0 && uvs[2] > start &&
          uvs[2] < nearest)
      {
        nearest = uvs[2];
        which = t;
        weights = uvs;
      }
    }
    const auto hit = tree.firstAlong(origin, direction, start);
    ASSERT_EQ(hit.has_value(), nearest < 1e9);
    if (!hit)
      continue;
    EXPECT_NEAR(hit->distance, nearest, 1e-7);
    EXPECT_EQ(hit->triangle, which);
    EXPECT_NEAR(hit->u, weights[0], 1e-7);
    EXPECT_NEAR(hit->v, weights[1], 1e-7);
    ++hits;
  }
  EXPECT_GT(hits, 200);
}

// Truth: the distance is least over a fine lattice of each triangle's points, to the lattice's
// step; and no point of a triangle is nearer.
TEST(MeshTree, DistanceIsThatOfTheNearestPoint)
{
  std::mt19937 random(11);
  const core::TriangleMesh mesh = scattered(random);
  const MeshTree tree(mesh);
  std::uniform_real_distribution<double> position(-14.0, 14.0);
  constexpr int kParts = 40;
  for (int i = 0; i < 40; ++i)
  {
    const Eigen::Vector3d point(position(random), position(random), position(random));
    double nearest = 1e9;
    double step = 0.0; // mm, the lattice's largest
    for (const Triangle& t : tree.triangles())
      for (int u = 0; u <= kParts; ++u)
        for (int v = 0; u + v <= kParts; ++v)
        {
          const Eigen::Vector3d at = t[0] + (t[1] - t[0]) * u / kParts + (t[2] - t[0]) * v / kParts;
          if ((at - point).norm() >= nearest)
            continue;
          nearest = (at - point).norm();
          step = ((t[1] - t[0]).norm() + (t[2] - t[0]).norm()) / kParts;
        }
    const double found = tree.distance(point, 100.0);
    EXPECT_LE(found, nearest + 1e-12);
    EXPECT_GE(found, nearest - step);
    EXPECT_EQ(tree.distance(point, 0.5 * found), 0.5 * found) << "the limit, if none is nearer";
  }
}

// Two triangles with a common edge, and rays through points of it as rounded: with slack all hit.
TEST(MeshTree, NoRayPassesBetweenTwoTrianglesWithSlack)
{
  std::mt19937 random(3);
  std::uniform_real_distribution<float> position(-10.0F, 10.0F);
  int passed = 0;
  for (int i = 0; i < 2000; ++i)
  {
    core::TriangleMesh mesh;
    for (int n = 0; n < 2; ++n)
      mesh.vertices.emplace_back(position(random), position(random), position(random));
    mesh.vertices.emplace_back(30.0F, position(random), position(random));
    mesh.vertices.emplace_back(-30.0F, position(random), position(random));
    mesh.triangles = {{0, 1, 2}, {1, 0, 3}};
    const MeshTree tree(mesh);
    const double w = 0.1 + 0.04 * std::abs(position(random));
    const Eigen::Vector3d on =
        (1.0 - w) * mesh.vertices[0].cast<double>() + w * mesh.vertices[1].cast<double>();
    const Eigen::Vector3d origin(position(random), 40.0, position(random));
    const Eigen::Vector3d direction = (on - origin).normalized();
    EXPECT_TRUE(tree.firstAlong(origin, direction, 0.0, 1e-9).has_value());
    passed += tree.firstAlong(origin, direction, 0.0).has_value() ? 0 : 1;
  }
  EXPECT_GT(passed, 0) << "else the slack is of no use";
}

TEST(MeshTree, RefusesAMeshWithVerticesThatAreNotThere)
{
  core::TriangleMesh mesh;
  mesh.vertices.resize(3);
  mesh.triangles = {{0, 1, 3}};
  EXPECT_THROW(MeshTree{mesh}, core::InvalidParameter);
  EXPECT_FALSE(MeshTree(core::TriangleMesh{}).firstAlong({0, 0, 0}, {0, 0, 1}, 0.0).has_value());
}

} // namespace petrous::volume
