#include <cmath>
#include <functional>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "petrous/Volume/MeshMeasure.h"
#include "petrous/Volume/MeshSolid.h"
#include "petrous/Volume/Sampling.h"

using namespace petrous;
using Eigen::Vector3d;
using volume::MeshSolidLimits;

namespace
{

constexpr double kPi = 3.14159265358979323846;
constexpr double kSpacing = 0.4; // mm, of a clinical CT

// A surface over a grid of (u, v) in [0, 1), closed in v; closed in u too, or by a fan at each end.
core::TriangleMesh sweep(int nu, int nv, bool closedInU,
                         const std::function<Vector3d(double, double)>& point)
{
  core::TriangleMesh mesh;
  const int rings = nu;
  const double last = closedInU ? nu : nu - 1.0;
  for (int i = 0; i < rings; ++i)
    for (int j = 0; j < nv; ++j)
      mesh.vertices.push_back(point(i / last, 1.0 * j / nv).cast<float>());
  const auto at = [&](int i, int j)
  { return static_cast<std::uint32_t>((i % rings) * nv + (j % nv)); };
  for (int i = 0; i < (closedInU ? rings : rings - 1); ++i)
    for (int j = 0; j < nv; ++j)
    {
      mesh.triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      mesh.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  if (!closedInU)
    for (const int ring : {0, rings - 1})
    {
      Eigen::Vector3f middle = Eigen::Vector3f::Zero();
      for (int j = 0; j < nv; ++j)
        middle += mesh.vertices[at(ring, j)] / static_cast<float>(nv);
      const auto hub = static_cast<std::uint32_t>(mesh.vertices.size());
      mesh.vertices.push_back(middle);
      for (int j = 0; j < nv; ++j)
        mesh.triangles.push_back(ring == 0 ? std::array{hub, at(ring, j), at(ring, j + 1)}
                                           : std::array{hub, at(ring, j + 1), at(ring, j)});
    }
  return mesh;
}

core::TriangleMesh turned(core::TriangleMesh mesh)
{
  for (auto& triangle : mesh.triangles)
    std::swap(triangle[1], triangle[2]);
  return mesh;
}

core::TriangleMesh joined(core::TriangleMesh a, const core::TriangleMesh& b)
{
  const auto offset = static_cast<std::uint32_t>(a.vertices.size());
  a.vertices.insert(a.vertices.end(), b.vertices.begin(), b.vertices.end());
  for (const auto& t : b.triangles)
    a.triangles.push_back({t[0] + offset, t[1] + offset, t[2] + offset});
  return a;
}

core::TriangleMesh sphere(const Vector3d& center, double radius, int n = 64)
{
  const auto mesh =
      sweep(n, 2 * n, false,
            [&](double u, double v)
            {
              // The rings at the ends are tiny, not points.
              const double polar = kPi * (0.001 + 0.998 * u);
              const double turn = 2.0 * kPi * v;
              return Vector3d(center + radius * Vector3d(std::sin(polar) * std::cos(turn),
                                                         std::sin(polar) * std::sin(turn),
                                                         std::cos(polar)));
            });
  return mesh.signedVolume() > 0.0 ? mesh : turned(mesh);
}

core::TriangleMesh box(const Vector3d& lower, const Vector3d& upper)
{
  core::TriangleMesh mesh;
  for (int n = 0; n < 8; ++n)
    mesh.vertices.emplace_back(((n & 1) ? upper : lower)[0], ((n & 2) ? upper : lower)[1],
                               ((n & 4) ? upper : lower)[2]);
  mesh.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                    {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
  return mesh;
}

// A tube of radius r along an oblique axis.
const Vector3d kAxis = Vector3d(0.9, 0.37, 0.24).normalized();
core::TriangleMesh tube(double radius, double length)
{
  const Vector3d side = kAxis.unitOrthogonal();
  const Vector3d other = kAxis.cross(side);
  const auto mesh =
      sweep(60, 96, false,
            [&](double u, double v)
            {
              const double turn = 2.0 * kPi * v;
              return Vector3d(kAxis * (length * u) +
                              radius * (std::cos(turn) * side + std::sin(turn) * other));
            });
  return mesh.signedVolume() > 0.0 ? mesh : turned(mesh);
}

double valueAt(const volume::Volume<float>& occupancy, const Vector3d& patient)
{
  const Vector3d voxel = occupancy.geometry().voxelFromPatient(patient);
  return occupancy.geometry().hullContains(voxel) ? volume::sampleTrilinear(occupancy, voxel) : 0.0;
}

// Where the occupancy falls below 0.5 along the direction, mm from `from`; negative if it does not
// start inside.
double crossing(const volume::Volume<float>& occupancy, const Vector3d& from,
                const Vector3d& direction, double reach)
{
  if (!(valueAt(occupancy, from) > 0.5))
    return -1.0;
  double inside = 0.0;
  double outside = reach;
  for (double t = 0.0; t < reach; t += 0.005)
    if (valueAt(occupancy, from + t * direction) <= 0.5)
    {
      outside = t;
      break;
    }
    else
      inside = t;
  for (int round = 0; round < 30; ++round)
  {
    const double middle = 0.5 * (inside + outside);
    (valueAt(occupancy, from + middle * direction) > 0.5 ? inside : outside) = middle;
  }
  return 0.5 * (inside + outside);
}

Vector3d spread(int n, int count) // nearly even directions
{
  const double z = 1.0 - 2.0 * (n + 0.5) / count;
  const double turn = n * kPi * (3.0 - std::sqrt(5.0));
  const double r = std::sqrt(1.0 - z * z);
  return {r * std::cos(turn), r * std::sin(turn), z};
}

double volumeOf(const volume::Volume<float>& occupancy)
{
  double sum = 0.0;
  constexpr int fine = 3;
  const auto& dims = occupancy.geometry().dims();
  for (int k = 0; k < fine * (dims[2] - 1); ++k)
    for (int j = 0; j < fine * (dims[1] - 1); ++j)
      for (int i = 0; i < fine * (dims[0] - 1); ++i)
        sum += volume::sampleTrilinear(occupancy, Vector3d(i + 0.5, j + 0.5, k + 0.5) / fine) > 0.5;
  return sum * occupancy.geometry().voxelVolume() / (fine * fine * fine);
}

volume::MeshSolidPlan planned(const core::TriangleMesh& mesh)
{
  MeshSolidLimits limits;
  limits.spacing = kSpacing;
  return volume::planMeshSolid(mesh, limits);
}

std::shared_ptr<const volume::Volume<float>> solidOf(const core::TriangleMesh& mesh)
{
  return volume::solidOf(mesh, planned(mesh));
}

} // namespace

TEST(MeshSolid, HasASpheresSurfaceWithinATwentiethOfAVoxel)
{
  for (const double radius : {0.5, 1.3, 4.0})
  {
    const Vector3d center(3.21, -7.13, 40.02);
    const auto occupancy = solidOf(sphere(center, radius));
    ASSERT_TRUE(occupancy);
    for (int n = 0; n < 500; ++n)
      EXPECT_NEAR(crossing(*occupancy, center, spread(n, 500), radius + 1.0), radius,
                  0.05 * kSpacing)
          << "radius " << radius;
  }
}

TEST(MeshSolid, KeepsATubeWholeThatIsThinnerThanAVoxel)
{
  constexpr double radius = 0.15;
  constexpr double length = 12.0;
  const auto mesh = tube(radius, length);
  EXPECT_NEAR(planned(mesh).thickness, 2.0 * radius, 0.01);
  const auto occupancy = solidOf(mesh);
  ASSERT_TRUE(occupancy);
  const Vector3d side = kAxis.unitOrthogonal();
  const Vector3d other = kAxis.cross(side);
  for (double along = 0.3; along < length - 0.3; along += 0.037)
    for (int n = 0; n < 8; ++n)
    {
      const double turn = 0.1 + n * kPi / 4.0 + along;
      const Vector3d out = std::cos(turn) * side + std::sin(turn) * other;
      EXPECT_NEAR(crossing(*occupancy, along * kAxis, out, 0.4), radius, 0.05 * kSpacing);
    }
}

TEST(MeshSolid, IsTheDistanceItselfNearAPlane)
{
  // A rotated cuboid: far from its edges its faces are planes.
  const Eigen::Matrix3d turn =
      (Eigen::AngleAxisd(0.6, Vector3d(1, 2, 3).normalized())).toRotationMatrix();
  auto mesh = box(Vector3d::Constant(-4.0), Vector3d::Constant(4.0));
  for (auto& vertex : mesh.vertices)
    vertex = (turn * vertex.cast<double>()).cast<float>();
  const auto occupancy = solidOf(mesh);
  ASSERT_TRUE(occupancy);
  const double edge = occupancy->geometry().minSpacing();
  EXPECT_LE(edge, kSpacing);
  for (double y = -1.0; y < 1.0; y += 0.31)
    for (double z = -1.0; z < 1.0; z += 0.29)
    {
      const Vector3d surface = turn * Vector3d(4.0, y, z);
      EXPECT_NEAR(valueAt(*occupancy, surface), 0.5, 1e-5);
      const Vector3d slope =
          volume::sampleGradient(*occupancy, occupancy->geometry().voxelFromPatient(surface), 1.0);
      EXPECT_NEAR((slope + turn.col(0) / (6.0 * edge)).norm(), 0.0, 1e-4);
    }
}

TEST(MeshSolid, HasTheVolumeOfATorus)
{
  constexpr double ring = 2.0;
  constexpr double radius = 0.5;
  auto mesh = sweep(160, 64, true,
                    [](double u, double v)
                    {
                      const double a = 2.0 * kPi * u;
                      const double b = 2.0 * kPi * v;
                      const double r = ring + radius * std::cos(b);
                      return Vector3d(r * std::cos(a), r * std::sin(a), radius * std::sin(b));
                    });
  const double truth = 2.0 * kPi * kPi * ring * radius * radius;
  for (const auto& either : {mesh, turned(mesh)}) // either orientation
  {
    const auto occupancy = solidOf(either);
    ASSERT_TRUE(occupancy);
    EXPECT_NEAR(volumeOf(*occupancy) / truth, 1.0, 0.05); // a surface 0.012 mm too deep
    EXPECT_LT(valueAt(*occupancy, Vector3d::Zero()), 0.5) << "the hole";
  }
}

TEST(MeshSolid, TakesTheInnerOfNestedShellsForACavityWhenItFacesTheOtherWay)
{
  const Vector3d center(0.1, 0.2, 0.3);
  const auto outer = sphere(center, 3.0, 48);
  const auto inner = sphere(center, 1.5, 48);
  const auto hollow = solidOf(joined(outer, turned(inner)));
  const auto filled = solidOf(joined(outer, inner));
  ASSERT_TRUE(hollow && filled);
  EXPECT_LT(valueAt(*hollow, center), 0.01);
  for (int n = 0; n < 50; ++n)
  {
    const Vector3d out = spread(n, 50);
    EXPECT_GT(valueAt(*hollow, center + 2.2 * out), 0.6);
    EXPECT_LT(valueAt(*hollow, center + 1.3 * out), 0.5);
    EXPECT_GT(valueAt(*filled, center + 1.5 * out), 0.9) << "a wall inside is no surface";
    EXPECT_LT(valueAt(*filled, center + 3.1 * out), 0.5);
  }
}

TEST(MeshSolid, UnitesShellsThatTouchOrOverlap)
{
  const auto left = box({0, 0, 0}, {3, 2, 2});
  for (const double start : {3.0, 2.4})
  {
    const auto mesh = joined(left, box({start, 0, 0}, {6, 2, 2}));
    const auto occupancy = solidOf(mesh);
    ASSERT_TRUE(occupancy) << planned(mesh).refusal;
    for (double x = 0.7; x < 5.4; x += 0.013)
      EXPECT_GT(valueAt(*occupancy, {x, 1.0, 1.0}), 0.75) << "x = " << x << ", from " << start;
    EXPECT_NEAR(crossing(*occupancy, {2.9, 1.0, 1.0}, {0, 0, 1}, 2.0), 1.0, 0.02);
  }
  // Two boxes that share only an edge: four triangles meet there.
  auto corner = joined(left, box({3, 2, 0}, {6, 4, 2}));
  const auto occupancy = solidOf(corner);
  ASSERT_TRUE(occupancy) << planned(corner).refusal;
  EXPECT_GT(valueAt(*occupancy, {1.5, 1.0, 1.0}), 0.9);
  EXPECT_GT(valueAt(*occupancy, {4.5, 3.0, 1.0}), 0.9);
  EXPECT_LT(valueAt(*occupancy, {4.5, 1.0, 1.0}), 0.1);
}

TEST(MeshSolid, DoesNotCareWhichWaySingleTrianglesFace)
{
  auto mesh = sphere({0, 0, 0}, 2.0, 32);
  for (std::size_t t = 0; t < mesh.triangles.size(); t += 3)
    std::swap(mesh.triangles[t][0], mesh.triangles[t][1]);
  const auto occupancy = solidOf(mesh);
  const auto straight = solidOf(sphere({0, 0, 0}, 2.0, 32));
  ASSERT_TRUE(occupancy && straight);
  ASSERT_EQ(occupancy->size(), straight->size());
  for (std::size_t n = 0; n < occupancy->size(); ++n)
    ASSERT_NEAR(occupancy->data()[n], straight->data()[n], 1e-5);
}

TEST(MeshSolid, CountsCornersAtOnePlaceAsOne)
{
  const auto shared = sphere({0, 0, 0}, 2.0, 16);
  core::TriangleMesh loose; // three vertices of its own for each triangle
  for (const auto& t : shared.triangles)
  {
    const auto n = static_cast<std::uint32_t>(loose.vertices.size());
    for (const std::uint32_t index : t)
      loose.vertices.push_back(shared.vertices[index]);
    loose.triangles.push_back({n, n + 1, n + 2});
  }
  EXPECT_FALSE(loose.isClosed());
  EXPECT_TRUE(planned(loose)) << planned(loose).refusal;
}

TEST(MeshSolid, MeasuresItsVolumeOrItsOpenEdges)
{
  const auto measured = volume::measure(box({1, 1, 1}, {4, 5, 6}));
  EXPECT_EQ(measured.openEdges, 0U);
  EXPECT_NEAR(measured.volume.value(), 60.0, 1e-6);
  auto turned = box({1, 1, 1}, {4, 5, 6});
  for (auto& t : turned.triangles) // all inwards
    std::swap(t[0], t[1]);
  EXPECT_NEAR(volume::measure(turned).volume.value(), 60.0, 1e-6);
  for (std::size_t t = 0; t < turned.triangles.size(); t += 3) // and some outwards
    std::swap(turned.triangles[t][0], turned.triangles[t][1]);
  EXPECT_NEAR(volume::measure(turned).volume.value(), 60.0, 1e-3);
  turned.triangles.pop_back();
  EXPECT_EQ(volume::measure(turned).openEdges, 3U);
  EXPECT_FALSE(volume::measure(turned).volume);
}

TEST(MeshSolid, MeasuresPartsWhicheverWayTheyAreWound)
{
  const auto small = box({0, 0, 0}, {1, 2, 3}); // 6 mm^3
  const auto large = box({5, 0, 0}, {8, 4, 2}); // 24 mm^3
  const auto mesh = joined(turned(small), large);
  const auto measured = volume::measure(mesh);
  EXPECT_NEAR(measured.volume.value(), 30.0, 1e-5);
  EXPECT_EQ(measured.parts, 2U);
  EXPECT_EQ(measured.reversedParts, 1U);
  EXPECT_FALSE(measured.isOverlapping);
  const auto straight = volume::oriented(mesh);
  EXPECT_NEAR(straight.signedVolume(), 30.0, 1e-5);
  EXPECT_EQ(volume::measure(straight).reversedParts, 0U);
  // Inside out as a whole: nothing differs from the rest.
  const auto inwards = turned(joined(small, large));
  EXPECT_EQ(volume::measure(inwards).reversedParts, 0U);
  EXPECT_NEAR(volume::oriented(inwards).signedVolume(), 30.0, 1e-5);
}

TEST(MeshSolid, KeepsADegenerateTriangleWhenOriented)
{
  auto mesh = turned(box({0, 0, 0}, {1, 2, 3}));
  // Vertex 0 twice, and a triangle of no area between both.
  const auto copy = static_cast<std::uint32_t>(mesh.vertices.size());
  const Eigen::Vector3f corner = mesh.vertices[0];
  mesh.vertices.push_back(corner);
  const auto other = mesh.triangles[0][0] == 0 ? mesh.triangles[0][1] : mesh.triangles[0][0];
  for (std::uint32_t& vertex : mesh.triangles[0])
    vertex = vertex == 0 ? copy : vertex;
  mesh.triangles.push_back({0, copy, other});
  const auto straight = volume::oriented(mesh);
  EXPECT_EQ(straight.triangles.size(), mesh.triangles.size());
  EXPECT_NEAR(straight.signedVolume(), 6.0, 1e-5);
}

TEST(MeshSolid, MeasuresNestedPartsAsTheyAreFelt)
{
  const auto outer = box({0, 0, 0}, {4, 4, 4});
  const auto inner = box({1, 1, 1}, {3, 3, 3});
  const auto hollow = volume::measure(joined(outer, turned(inner)));
  EXPECT_NEAR(hollow.volume.value(), 64.0 - 8.0, 1e-5);
  EXPECT_EQ(hollow.cavities, 1U);
  EXPECT_EQ(hollow.reversedParts, 0U);
  const auto filled = volume::measure(joined(outer, inner));
  EXPECT_NEAR(filled.volume.value(), 64.0, 1e-5);
  EXPECT_EQ(filled.innerParts, 1U);
  // The other way round as a whole, and with something in the cavity.
  const auto core = box({1.5, 1.5, 1.5}, {2.5, 2.5, 2.5});
  const auto inwards = joined(turned(joined(outer, core)), inner);
  EXPECT_NEAR(volume::measure(inwards).volume.value(), 64.0 - 8.0 + 1.0, 1e-5);
  EXPECT_NEAR(volume::oriented(inwards).signedVolume(), 64.0 - 8.0 + 1.0, 1e-5);
}

TEST(MeshSolid, CountsATriangleThatIsThereTwiceOnce)
{
  const auto once = box({1, 1, 1}, {4, 5, 6});
  for (const bool isOpposite : {false, true})
  {
    const auto twice = joined(once, isOpposite ? turned(once) : once);
    const auto measured = volume::measure(twice);
    EXPECT_NEAR(measured.volume.value(), 60.0, 1e-5) << isOpposite;
    EXPECT_EQ(measured.doubled, 12U);
    EXPECT_EQ(volume::oriented(twice).triangles.size(), 12U);
    EXPECT_NEAR(volume::oriented(twice).signedVolume(), 60.0, 1e-5);
    EXPECT_TRUE(planned(twice)) << planned(twice).refusal;
  }
  auto stray = once;
  stray.triangles.push_back(stray.triangles.front());
  EXPECT_EQ(volume::measure(stray).openEdges, 0U);
  EXPECT_EQ(volume::measure(stray).doubled, 1U);
  // The wall between two boxes that touch is no doubled surface.
  const auto touching =
      volume::measure(joined(box({0, 0, 0}, {2, 2, 2}), box({2, 0, 0}, {4, 2, 2})));
  EXPECT_EQ(touching.doubled, 0U);
  EXPECT_EQ(touching.openEdges, 0U);
  EXPECT_NEAR(touching.volume.value(), 16.0, 0.016);
  EXPECT_FALSE(touching.isOverlapping);
}

TEST(MeshSolid, MeasuresTheUnionOfPartsThatOverlap)
{
  const auto boxes = volume::measure(joined(box({0, 0, 0}, {3, 2, 2}), box({2, 1, 1}, {5, 4, 4})));
  EXPECT_NEAR(boxes.volume.value(), 12.0 + 27.0 - 1.0, 0.04);
  EXPECT_TRUE(boxes.isOverlapping);
  EXPECT_FALSE(boxes.isOverlapHollow);
  // Bars that cross, of which neither has a corner in the other.
  const auto bars =
      volume::measure(joined(box({-5, 0, 0}, {5, 1, 1}), box({0, -5, 0.2}, {1, 5, 1.4})));
  EXPECT_NEAR(bars.volume.value(), 10.0 + 12.0 - 0.8, 0.06);
  EXPECT_TRUE(bars.isOverlapping);
  // Two balls of radius r, their centers r apart, have a lens of 5/12 pi r^3 in common.
  const double r = 2.0;
  const auto one = sphere({0, 0, 0}, r, 48);
  const auto other = sphere({0.6 * r, 0.8 * r, 0.0}, r, 48);
  const double ball = one.signedVolume();
  const auto balls = volume::measure(joined(one, other));
  EXPECT_NEAR(balls.volume.value(), 2.0 * ball - 5.0 / 12.0 * kPi * r * r * r, 0.003 * ball);
  EXPECT_TRUE(balls.isOverlapping);
  // Wound opposite ways, what both enclose is not inside (MeshInside.h).
  const auto hollow = volume::measure(joined(one, turned(other)));
  EXPECT_NEAR(hollow.volume.value(), 2.0 * ball - 5.0 / 6.0 * kPi * r * r * r, 0.006 * ball);
  EXPECT_TRUE(hollow.isOverlapHollow);
}

TEST(MeshSolid, RefusesWhatHasNoInsideAndSaysWhy)
{
  auto open = sphere({0, 0, 0}, 2.0, 16);
  open.triangles.pop_back();
  EXPECT_NE(planned(open).refusal.find("not closed: its surface ends at 3 edges"),
            std::string::npos)
      << planned(open).refusal;
  EXPECT_THROW(volume::solidOf(open, planned(open)), core::InvalidParameter);

  core::TriangleMesh sheet; // front and back of one triangle
  sheet.vertices = {{0, 0, 0}, {5, 0, 0}, {0, 5, 0}};
  sheet.triangles = {{0, 1, 2}, {0, 2, 1}};
  EXPECT_NE(planned(sheet).refusal.find("encloses nothing"), std::string::npos);
  EXPECT_FALSE(planned(core::TriangleMesh{}));

  MeshSolidLimits limits;
  limits.spacing = kSpacing;
  limits.region = {Vector3d(10, 10, 10), Vector3d(20, 20, 20)};
  EXPECT_NE(volume::planMeshSolid(sphere({0, 0, 0}, 2.0, 16), limits).refusal.find("outside"),
            std::string::npos);
  limits.spacing = 0.0;
  EXPECT_THROW(volume::planMeshSolid(open, limits), core::InvalidParameter);
}

TEST(MeshSolid, StaysWithinItsMemoryOrSaysThatItCannot)
{
  const auto mesh = tube(0.15, 30.0);
  MeshSolidLimits limits;
  limits.spacing = kSpacing;
  const auto free = volume::planMeshSolid(mesh, limits);
  ASSERT_TRUE(free);
  EXPECT_LE(free.grid.minSpacing(), 0.1001);
  limits.maxBytes = free.grid.voxelCount() * sizeof(float) / 2;
  const auto tight = volume::planMeshSolid(mesh, limits);
  ASSERT_TRUE(tight) << tight.refusal;
  EXPECT_LE(tight.grid.voxelCount() * sizeof(float), limits.maxBytes);
  EXPECT_LE(tight.grid.minSpacing(), 0.15);
  limits.maxBytes /= 4;
  const auto refused = volume::planMeshSolid(mesh, limits);
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.refusal.find("0.3 mm thick"), std::string::npos) << refused.refusal;
  EXPECT_NE(refused.refusal.find("MB"), std::string::npos) << refused.refusal;
}

TEST(MeshSolid, IsMadeOnlyInTheRegion)
{
  const auto mesh = sphere({0, 0, 0}, 10.0, 64);
  MeshSolidLimits limits;
  limits.spacing = kSpacing;
  limits.region = {Vector3d(8, -1, -1), Vector3d(12, 1, 1)};
  const auto plan = volume::planMeshSolid(mesh, limits);
  ASSERT_TRUE(plan);
  EXPECT_LT(plan.grid.voxelCount(), 5000u);
  const auto occupancy = volume::solidOf(mesh, plan);
  EXPECT_NEAR(crossing(*occupancy, {8.0, 0.0, 0.0}, {1, 0, 0}, 4.0), 10.0 - 8.0, 0.05 * kSpacing);
}

// A vertex 5 m away took minutes: its spike was subdivided into triangles of half a voxel.
TEST(MeshSolid, RefusesWhatReachesFarBeyondTheRegion)
{
  MeshSolidLimits limits;
  limits.spacing = kSpacing;
  limits.region = core::PatientBox{Vector3d(-20, -20, -20), Vector3d(20, 20, 20)};
  for (const float far : {600.0F, 5000.0F, 44000.0F, 1e30F, -3e38F})
  {
    auto mesh = sphere({0, 0, 0}, 8.0);
    mesh.vertices[100][1] = far;
    const auto plan = volume::planMeshSolid(mesh, limits);
    EXPECT_NE(plan.refusal.find("mm beyond the CT"), std::string::npos) << far << plan.refusal;
  }
  EXPECT_EQ(volume::reachBeyond(sphere({0, 0, 0}, 8.0), *limits.region), 0.0);
  EXPECT_NEAR(volume::reachBeyond(sphere({30, 0, 0}, 8.0), *limits.region), 18.0, 0.1);
  EXPECT_EQ(volume::maxReach(*limits.region), 500.0);
  EXPECT_NEAR(volume::maxReach({Vector3d::Zero(), Vector3d(300, 400, 0)}), 500.0, 1e-9);
  EXPECT_NEAR(volume::maxReach({Vector3d::Zero(), Vector3d(600, 800, 0)}), 1000.0, 1e-9);
}

// Parts outside the region are cut off there, without effect inside it.
TEST(MeshSolid, IsTheSameInTheRegionWhereTheMeshGoesFarBeyond)
{
  MeshSolidLimits limits;
  limits.spacing = kSpacing;
  limits.region = core::PatientBox{Vector3d(-10, -10, -10), Vector3d(10, 10, 10)};
  const auto beam = box({-400.0, -3.1, -2.3}, {400.0, 4.2, 5.4});
  const auto plan = volume::planMeshSolid(beam, limits);
  ASSERT_TRUE(plan) << plan.refusal;
  const auto occupancy = volume::solidOf(beam, plan);
  for (const double x : {-9.7, 0.0, 9.7})
  {
    EXPECT_NEAR(crossing(*occupancy, {x, 0.0, 0.0}, Vector3d::UnitY(), 8.0), 4.2, 0.02);
    EXPECT_NEAR(crossing(*occupancy, {x, 0.0, 0.0}, -Vector3d::UnitZ(), 8.0), 2.3, 0.02);
  }
}

TEST(MeshSolid, GuardsAllOfATubeThatFitsBetweenVoxels)
{
  constexpr double length = 12.0;
  const auto occupancy = solidOf(tube(0.15, length));
  const core::GridGeometry ct({40, 30, 30}, Vector3d::Constant(kSpacing), {-1.0, -2.0, -2.0});
  const auto guard = volume::protectionMaskOf(*occupancy, ct);
  ASSERT_TRUE(guard);
  double plain = 1.0;
  for (double along = 0.1; along < length - 0.1; along += 0.01)
  {
    const Vector3d p = along * kAxis;
    EXPECT_GE(valueAt(*guard, p), 0.5);
    const Vector3d voxel = ct.voxelFromPatient(p);
    const volume::TrilinearCell cell(voxel, ct.dims());
    plain = std::min(
        plain, cell.interpolate(
                   [&](int i, int j, int k) {
                     return valueAt(*occupancy, ct.patientFromVoxel({1.0 * i, 1.0 * j, 1.0 * k}));
                   }));
  }
  EXPECT_LT(plain, 0.5) << "voxels alone do not hold it";
  // Tissue farther away than a voxel diagonal remains drillable.
  const Vector3d out = kAxis.unitOrthogonal();
  for (double along = 0.5; along < length - 0.5; along += 0.1)
    EXPECT_LT(valueAt(*guard, along * kAxis + 0.9 * out), 0.5);
  const auto& dims = guard->geometry().dims();
  float steepest = 0.0F;
  for (int k = 0; k + 1 < dims[2]; ++k)
    for (int j = 0; j + 1 < dims[1]; ++j)
      for (int i = 0; i + 1 < dims[0]; ++i)
        for (const float other :
             {guard->at(i + 1, j, k), guard->at(i, j + 1, k), guard->at(i, j, k + 1)})
          steepest = std::max(steepest, std::abs(other - guard->at(i, j, k)));
  EXPECT_LE(steepest, 0.5F + 1e-6F);
  EXPECT_EQ(volume::protectionMaskOf(*occupancy,
                                     core::GridGeometry({4, 4, 4}, Vector3d::Ones(), {90, 90, 90})),
            nullptr);
}

TEST(MeshSolid, StopsWhenAskedTo)
{
  const auto token = std::make_shared<core::CancelToken>();
  token->cancel();
  const core::Progress progress({}, token);
  const auto mesh = sphere({0, 0, 0}, 2.0, 16);
  MeshSolidLimits limits;
  limits.spacing = kSpacing;
  EXPECT_THROW(volume::planMeshSolid(mesh, limits, progress), core::CancelledError);
  EXPECT_THROW(volume::solidOf(mesh, planned(mesh), progress), core::CancelledError);
}
