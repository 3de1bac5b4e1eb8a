#include "petrous/Presenters/CameraPaths.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "ShapeCase.h"
#include "petrous/Core/Error.h"

using namespace petrous;
using namespace petrous::presenters;
using Eigen::Vector3d;

TEST(Turntable, GoesOnceAroundTheFocalPointInEqualSteps)
{
  core::CameraPose camera;
  camera.focalPoint = {3.0, -2.0, 5.0};
  camera.position = camera.focalPoint + Vector3d(0.0, -50.0, 10.0);
  camera.viewUp = {0.0, 0.0, 2.0};
  const auto cameras = turntable(camera, 8);
  ASSERT_EQ(cameras.size(), 8U);
  EXPECT_LT((cameras[0].position - camera.position).norm(), 1e-12);
  // After a quarter the camera that looked at the face (from -y) is on the patient's right (-x).
  EXPECT_LT((cameras[2].position - (camera.focalPoint + Vector3d(-50.0, 0.0, 10.0))).norm(), 1e-9);
  for (std::size_t n = 0; n < cameras.size(); ++n)
  {
    const Vector3d a = cameras[n].position - camera.focalPoint;
    const Vector3d b = cameras[(n + 1) % 8].position - camera.focalPoint;
    EXPECT_NEAR(a.head<2>().dot(b.head<2>()) / (50.0 * 50.0), std::sqrt(0.5), 1e-12);
    EXPECT_NEAR(a.z(), 10.0, 1e-12);
    EXPECT_EQ(cameras[n].viewUp, camera.viewUp);
  }
  EXPECT_THROW(turntable(camera, 1), core::InvalidParameter);
  EXPECT_THROW(turntable(camera, kMaxFrames + 1), core::InvalidParameter);
}

TEST(Flight, GoesEvenlyAlongALineAndLooksAhead)
{
  // A corner, and a point twice.
  const std::vector<Vector3d> line{
      {0.0, 0.0, 0.0}, {10.0, 0.0, 0.0}, {10.0, 0.0, 0.0}, {10.0, 20.0, 0.0}};
  const auto cameras = flight(line, 31);
  ASSERT_EQ(cameras.size(), 31U);
  for (int n = 0; n <= 30; ++n)
  {
    const Vector3d expected = n <= 10 ? Vector3d(n, 0.0, 0.0) : Vector3d(10.0, n - 10.0, 0.0);
    EXPECT_LT((cameras[static_cast<std::size_t>(n)].position - expected).norm(), 1e-9) << n;
  }
  for (const core::CameraPose& camera : cameras)
  {
    const Vector3d ahead = (camera.focalPoint - camera.position).normalized();
    EXPECT_NEAR(camera.viewUp.norm(), 1.0, 1e-12);
    EXPECT_NEAR(camera.viewUp.dot(ahead), 0.0, 1e-12);
    EXPECT_NEAR(camera.viewUp.z(), 1.0, 1e-9) << "in a horizontal line superior stays up";
  }
  EXPECT_NEAR((cameras[0].focalPoint - cameras[0].position).normalized().x(), 1.0, 1e-12);
  EXPECT_NEAR((cameras[30].focalPoint - cameras[30].position).normalized().y(), 1.0, 1e-12);
  EXPECT_THROW(flight({{1.0, 1.0, 1.0}, {1.0, 1.0, 1.0}}, 10), core::InvalidParameter);
}

namespace
{

namespace shapes = presenters::testing;

const core::GridGeometry kGrid({80, 24, 24}, Vector3d::Constant(0.5), {0.0, 0.0, 0.0});
const Vector3d kFrom(3.0, 6.0, 6.0);
const Vector3d kTo(33.0, 6.0, 6.0);
constexpr double kAhead = 3.0; // mm, of CameraPaths.h

// Bone with a canal of air of 30 mm, closed at both ends, and structures of another label map.
scene::Case canalCase(const std::vector<shapes::Shape>& others = {})
{
  const shapes::Inside canal = shapes::cylinder(kFrom, kTo, 2.0);
  scene::Case value = shapes::shapeCase(kGrid, {{"canal", canal}},
                                        [canal](const Vector3d& at) { return !canal(at); });
  if (!others.empty())
    value.labels.push_back(shapes::shapeCase(kGrid, others).labels.front());
  return value;
}

// A closed box.
scene::MeshPart boxPart(const std::string& name, const Vector3d& low, const Vector3d& high)
{
  core::TriangleMesh mesh;
  for (int n = 0; n < 8; ++n)
    mesh.vertices.emplace_back(
        Vector3d(n & 1 ? high.x() : low.x(), n & 2 ? high.y() : low.y(), n & 4 ? high.z() : low.z())
            .cast<float>());
  mesh.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                    {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  scene::MeshPart part;
  part.name = name;
  part.mesh = std::make_shared<const core::TriangleMesh>(std::move(mesh));
  return part;
}

double lowest(const Flight& flight)
{
  double least = 1e9;
  for (const core::CameraPose& camera : flight.cameras)
    least = std::min(least, camera.position.x());
  return least;
}

double highest(const Flight& flight)
{
  double most = -1e9;
  for (const core::CameraPose& camera : flight.cameras)
    most = std::max(most, camera.position.x());
  return most;
}

} // namespace

TEST(Flight, FollowsACanalWhichItHidesAndStopsBeforeItsEnd)
{
  scene::Case value = canalCase();
  const Flight flight = flightAlong(value, "canal", 20);
  ASSERT_EQ(flight.cameras.size(), 20U);
  EXPECT_FALSE(scene::findStructure(value, "canal")->look.shown);
  EXPECT_TRUE(flight.hidden.empty());
  for (const core::CameraPose& camera : flight.cameras)
    for (const Vector3d& at : {camera.position, camera.focalPoint})
    {
      // Within a voxel of the axis, and as far from the walls at the ends as it must be.
      EXPECT_LT((at - Vector3d(at.x(), 6.0, 6.0)).norm(), 0.5);
      EXPECT_GT(at.x(), kFrom.x() + kFlightClearance - 0.25);
      EXPECT_LT(at.x(), kTo.x() - kFlightClearance + 0.25);
    }
  // All of it but what is kept ahead.
  EXPECT_NEAR(highest(flight) - lowest(flight), 30.0 - kAhead - 2.0 * kFlightClearance, 1.0);
  EXPECT_NEAR(flight.flown, highest(flight) - lowest(flight), 0.05);
  EXPECT_THROW(flightAlong(value, "nothing", 20), core::InvalidParameter);
}

TEST(Flight, HidesWhatItWouldCrossAndStopsBeforeWhatClosesAnEnd)
{
  scene::Case value =
      canalCase({{"plug", shapes::ball({18.0, 6.0, 6.0}, 1.5)},
                 {"drum", shapes::cylinder({31.5, 6.0, 6.0}, {32.5, 6.0, 6.0}, 2.0)},
                 {"aside", shapes::ball({13.0, 4.5, 6.0}, 0.6)}});
  const Flight flight = flightAlong(value, "canal", 20);
  EXPECT_EQ(flight.hidden, std::vector<std::string>{"plug"});
  EXPECT_FALSE(scene::findStructure(value, "plug")->look.shown);
  EXPECT_TRUE(scene::findStructure(value, "drum")->look.shown);
  EXPECT_TRUE(scene::findStructure(value, "aside")->look.shown);
  for (const core::CameraPose& camera : flight.cameras)
  {
    EXPECT_LT(camera.position.x(), 31.5 - kFlightClearance + 0.25);
    EXPECT_LT(camera.focalPoint.x(), 31.5 - kFlightClearance + 0.25);
  }
}

TEST(Flight, TakesTheLongerSideOfAWallOfBone)
{
  scene::Case value = canalCase();
  const auto ct = std::make_shared<volume::Volume<std::int16_t>>(kGrid);
  const shapes::Inside canal = shapes::cylinder(kFrom, kTo, 2.0);
  for (int k = 0; k < kGrid.dims()[2]; ++k)
    for (int j = 0; j < kGrid.dims()[1]; ++j)
      for (int i = 0; i < kGrid.dims()[0]; ++i)
      {
        const Vector3d at = kGrid.patientFromVoxel({1.0 * i, 1.0 * j, 1.0 * k});
        const bool isWall = std::abs(at.x() - 13.0) < 1.1;
        ct->at(i, j, k) = static_cast<std::int16_t>(canal(at) && !isWall ? -1000 : 1000);
      }
  value.ct.volume = std::make_shared<const volume::IntensityVolume>(
      std::shared_ptr<const volume::Volume<std::int16_t>>(ct));
  const Flight flight = flightAlong(value, "canal", 20);
  EXPECT_GT(lowest(flight), 14.0);
  EXPECT_NEAR(flight.flown, 33.0 - 14.0 - kAhead - 2.0 * kFlightClearance, 1.5);
}

TEST(Flight, IsRefusedWhereThereIsNoWay)
{
  // A structure in solid bone.
  scene::Case value = shapes::shapeCase(kGrid, {{"canal", shapes::cylinder(kFrom, kTo, 2.0)}});
  EXPECT_THROW(flightAlong(value, "canal", 20), core::InvalidParameter);
}

TEST(Flight, LeavesOutWhatShowsNothing)
{
  // A nerve, half of it in a canal of bone that ends at x = 18, the rest in the open.
  const shapes::Inside nerve = shapes::cylinder(kFrom, kTo, 1.5);
  scene::Case value =
      shapes::shapeCase(kGrid, {{"nerve", nerve}},
                        [nerve](const Vector3d& at) { return at.x() < 18.0 && !nerve(at); });
  const Flight flight = flightAlong(value, "nerve", 20);
  ASSERT_EQ(flight.cameras.size(), 20U);
  // From either end, the way in the open behind the canal's mouth is left out where the camera
  // looks away from it, and flown where it looks into it.
  const bool looksAway = flight.cameras.back().position.x() > flight.cameras.front().position.x();
  if (looksAway)
    EXPECT_LT(highest(flight), 18.5);
  else
    EXPECT_LT(lowest(flight), 8.0);
}

// The meshes that stay are still met when one was hidden: without the tube, the nerve's way in the
// open shows nothing.
TEST(Flight, MeetsTheMeshesThatStayWhenOneIsHidden)
{
  const shapes::Inside nerve = shapes::cylinder(kFrom, kTo, 1.5);
  const auto flown = [&](const std::vector<scene::MeshPart>& meshes)
  {
    scene::Case value =
        shapes::shapeCase(kGrid, {{"nerve", nerve}},
                          [nerve](const Vector3d& at) { return at.x() < 18.0 && !nerve(at); });
    value.meshes = meshes;
    return flightAlong(value, "nerve", 20);
  };
  const scene::MeshPart plug = boxPart("plug", {10.0, 5.0, 5.0}, {11.0, 7.0, 7.0});
  std::vector<scene::MeshPart> tube; // of four walls, around what lies in the open
  for (int n = 0; n < 4; ++n)
  {
    Vector3d low(19.0, 2.0, 2.0);
    Vector3d high(35.0, 10.0, 10.0);
    (n % 2 ? low : high)[1 + n / 2] = n % 2 ? 9.0 : 3.0;
    tube.push_back(boxPart("wall " + std::to_string(n), low, high));
  }
  const Flight open = flown({plug});
  EXPECT_EQ(open.hidden, std::vector<std::string>{"plug"});
  std::vector<scene::MeshPart> all = tube;
  all.push_back(plug);
  const Flight within = flown(all);
  EXPECT_EQ(within.hidden, std::vector<std::string>{"plug"});
  EXPECT_GT(within.flown, open.flown + 1.0) << open.flown;
  // As it is where there never was one.
  EXPECT_NEAR(within.flown, flown(tube).flown, 0.05);
}

TEST(Flight, TellsHowFarItIsAndIsCancelledOnItsWay)
{
  std::mutex lock; // images are read in other threads
  std::vector<double> onWay;
  const std::vector<shapes::Shape> plug{{"plug", shapes::ball({18.0, 6.0, 6.0}, 1.5)}};
  scene::Case value = canalCase(plug);
  flightAlong(value, "canal", 20,
              core::Progress(
                  [&](double fraction, const std::string&)
                  {
                    const std::lock_guard guard(lock);
                    if (fraction > 0.6 && fraction < 0.8)
                      onWay.push_back(fraction);
                  }));
  EXPECT_TRUE(std::is_sorted(onWay.begin(), onWay.end()));
  EXPECT_GT(onWay.size(), 100U) << "a sample every 0.1 mm of 30";

  const auto token = std::make_shared<core::CancelToken>();
  std::atomic<int> after{0};
  scene::Case other = canalCase(plug);
  EXPECT_THROW(flightAlong(other, "canal", 20,
                           core::Progress(
                               [&](double fraction, const std::string&)
                               {
                                 after += token->isCancelled() ? 1 : 0;
                                 if (fraction > 0.65)
                                   token->cancel();
                               },
                               token)),
               core::CancelledError);
  EXPECT_TRUE(token->isCancelled());
  EXPECT_LE(after.load(), 1);
  EXPECT_TRUE(scene::findStructure(other, "plug")->look.shown) << "it was not that far";
}
