#include <gtest/gtest.h>

#include "petrous/Core/Error.h"
#include "petrous/Core/TriangleMesh.h"

using namespace petrous::core;

namespace
{

TriangleMesh tetrahedron(float offset)
{
  TriangleMesh mesh;
  for (const auto& v : {Eigen::Vector3f(0, 0, 0), Eigen::Vector3f(1, 0, 0),
                        Eigen::Vector3f(0, 1, 0), Eigen::Vector3f(0, 0, 1)})
    mesh.vertices.emplace_back(v + Eigen::Vector3f::Constant(offset));
  mesh.triangles = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
  return mesh;
}

} // namespace

TEST(TriangleMesh, MeasuresItsVolumeWhereverItLies)
{
  EXPECT_NEAR(tetrahedron(0).signedVolume(), 1.0 / 6.0, 1e-9);
  EXPECT_NEAR(tetrahedron(1024).signedVolume(), 1.0 / 6.0, 1e-6);
}

TEST(TriangleMesh, VolumeIsNegativeInsideOut)
{
  TriangleMesh mesh = tetrahedron(0);
  for (auto& t : mesh.triangles)
    std::swap(t[0], t[1]);
  EXPECT_NEAR(mesh.signedVolume(), -1.0 / 6.0, 1e-9);
  EXPECT_TRUE(mesh.isClosed());
}

TEST(TriangleMesh, KnowsWhetherItIsClosed)
{
  TriangleMesh mesh = tetrahedron(0);
  EXPECT_TRUE(mesh.isClosed());
  mesh.triangles.pop_back();
  EXPECT_FALSE(mesh.isClosed());
  mesh = tetrahedron(0);
  std::swap(mesh.triangles[0][0], mesh.triangles[0][1]);
  EXPECT_FALSE(mesh.isClosed()) << "one triangle faces the other way";
  EXPECT_FALSE(TriangleMesh{}.isClosed());
}

TEST(TriangleMesh, RefusesAVertexThatIsNotThere)
{
  TriangleMesh mesh = tetrahedron(0);
  EXPECT_NO_THROW(mesh.validate());
  mesh.triangles[0][0] = 4;
  EXPECT_THROW(mesh.validate(), InvalidParameter);
}
