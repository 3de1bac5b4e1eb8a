#include <gtest/gtest.h>

#include "CutBall.h"
#include "SolidChecks.h"
#include "SurfaceSamples.h"

using namespace petrous;
using namespace petrous::haptics;
using namespace petrous::haptics::testing;
using Eigen::Matrix3d;
using Eigen::Vector3d;

namespace
{

using Solid = volume::TissueField::SolidUnion;

// A smoothed union as from makeSmoothedUnion: 1/2 + d / (2 sqrt(3)), d in its voxels.
Solid unionOn(const core::GridGeometry& grid, const SignedDistance& structure)
{
  auto occupancy = std::make_shared<volume::Volume<float>>(grid);
  const core::Index3& n = grid.dims();
  for (int k = 0; k < n[2]; ++k)
    for (int j = 0; j < n[1]; ++j)
      for (int i = 0; i < n[0]; ++i)
      {
        const double d = structure(grid.patientFromVoxel({double(i), double(j), double(k)}));
        occupancy->at(i, j, k) = static_cast<float>(
            std::clamp(0.5 + d / (2.0 * std::sqrt(3.0) * grid.minSpacing()), 0.0, 1.0));
      }
  return occupancy;
}

double air(const Vector3d&)
{
  return -2.0;
}

core::GridGeometry turnedBox(const Vector3d& half, double h, const Matrix3d& turn)
{
  const core::GridGeometry box = boxOf(half, h, Vector3d::Zero());
  return {box.dims(), box.spacing(), turn * box.origin(), turn};
}

} // namespace

// Features between the voxels of the CT are felt as well.
TEST(SolidUnion, ShaftDoesNotSinkIntoAThinStructureOnAFinerGrid)
{
  const double h = 0.4;
  const double fine = 0.1;
  const BurrShape shape;
  const Matrix3d oblique =
      Eigen::AngleAxisd(0.4, Vector3d(0.2, 1.0, 0.5).normalized()).toRotationMatrix();
  const SignedDistance wire = [](const Vector3d& p)
  { return 0.25 - std::hypot(p.x() - 0.2, p.z() + 0.5); };
  const std::pair<const char*, SignedDistance> structures[] = {
      {"plate of 0.1 mm", plateOnEdge(fine)},
      {"plate of 0.2 mm", plateOnEdge(2.0 * fine)},
      {"wire of 0.5 mm", wire}};
  const auto ct = scanOn(boxOf({2.0, 2.0, 4.0}, h, {0.31, 0.13, 0.47}), air);
  for (const Matrix3d& turn : {Matrix3d(Matrix3d::Identity()), oblique})
    for (const auto& [name, structure] : structures)
    {
      SCOPED_TRACE(::testing::Message() << name << (turn.isIdentity() ? "" : ", turned grid"));
      const core::GridGeometry grid = turnedBox({1.5, 1.5, 2.0}, fine, turn);
      const Scene scene = sceneOf(ct, {unionOn(grid, structure)});
      const Dragged result = drag(scene, shape, 1.2, 10.2, 4.0, &grid);
      EXPECT_LE(result.deepest, kMax);
      EXPECT_LE(result.reported, kMax);
      EXPECT_GT(result.stretch, 1.0) << "the structure must hold it";
    }
}

// Coarser than the CT, like a structure segmented on MR.
TEST(SolidUnion, ShaftDoesNotSinkIntoAStructureOnACoarserGrid)
{
  const Matrix3d turn =
      Eigen::AngleAxisd(0.4, Vector3d(0.2, 1.0, 0.5).normalized()).toRotationMatrix();
  const core::GridGeometry grid = turnedBox({2.5, 2.5, 4.0}, 0.8, turn);
  const auto ct = scanOn(boxOf({2.0, 2.0, 4.0}, 0.2, {0.31, 0.13, 0.47}), air);
  const Scene scene = sceneOf(ct, {unionOn(grid, plateOnEdge(1.0))});
  const Dragged result = drag(scene, {}, 1.2, 10.2, 4.0);
  EXPECT_LE(result.deepest, kMax);
  EXPECT_LE(result.reported, kMax);
  EXPECT_GT(result.stretch, 1.0) << "the structure must hold it";
}

// Ground truth: volume::TissueField, in which each operand is interpolated separately.
TEST(SolidUnion, SamplesLieOnTheSurface)
{
  const double h = 0.3;
  const core::GridGeometry box = boxOf({3.0, 3.0, 3.0}, h, {0.31, 0.13, 0.47});
  const core::Index3 cropped{12, 11, 13};
  const core::GridGeometry inside(cropped, box.spacing(), box.patientFromVoxel({4.0, 4.0, 4.0}));
  const Matrix3d turn =
      Eigen::AngleAxisd(0.4, Vector3d(0.2, 1.0, 0.5).normalized()).toRotationMatrix();
  const SignedDistance bone = plane({0.1, -0.2, 1.0});
  const SignedDistance below = plane({-0.1, 0.1, 1.0}, -0.1);
  const SignedDistance nerve = [](const Vector3d& p)
  { return std::min(0.6 - std::hypot(p.y() + 0.2, p.z() + 0.1), 1.0 - std::abs(p.x())); };
  const std::pair<const char*, std::vector<Solid>> unions[] = {
      {"bone alone", {}},
      {"structures on the CT's grid", {unionOn(box, below), unionOn(inside, nerve)}},
      {"structures on grids of their own",
       {unionOn(turnedBox({2.0, 2.0, 2.0}, 0.11, turn), nerve),
        unionOn(turnedBox({3.5, 3.5, 3.5}, 0.7, turn), below)}}};
  for (const auto& [name, solids] : unions)
  {
    SCOPED_TRACE(name);
    Scene scene = sceneOf(scanOn(box, bone), solids);
    cutBall(scene, {0.4, 0.3, 0.6}, 1.0);
    cutBall(scene, {2.9, 0.1, -0.7}, 0.9); // through the scan's face
    const Vector3d last(box.dims()[0] - 1, box.dims()[1] - 1, box.dims()[2] - 1);
    ToolSolid tool;
    tool.burrRadius = 1.0;
    SurfaceSamples samples(*scene.field, tool);
    const volume::MaskState& state = *scene.published->acquire();
    std::size_t count = 0;
    for (const Vector3d& at : {Vector3d(0.0, 0.0, 0.0), Vector3d(0.7, 0.6, -0.2),
                               Vector3d(2.7, 0.0, 0.0), Vector3d(-1.0, -0.5, 0.2)})
    {
      const Pose pose = poseAt(at);
      samples.look(state);
      samples.forget();
      for (int tick = 0; tick < 100; ++tick)
      {
        samples.look(state);
        samples.find(pose, 0.0, 0.0, h);
      }
      for (std::size_t n = 0; n < samples.within(SolidParts::kBall, h); ++n, ++count)
      {
        const Vector3d& place = samples.place(SolidParts::kBall, n);
        const Vector3d voxel = box.voxelFromPatient(place);
        const double border =
            0.25 * std::min(voxel.minCoeff(), (last - voxel).minCoeff()); // of the scan
        // On the face of the scan f is discontinuous.
        const Vector3d nearer = voxel.cwiseMax(1e-4).cwiseMin(last - Vector3d::Constant(1e-4));
        const double f = scene.tissue->value(box.patientFromVoxel(nearer));
        EXPECT_NEAR(std::min(f, border), 0.0, 2e-3) << voxel.transpose();
      }
    }
    scene.published->release();
    EXPECT_GT(count, 200u);
  }
}

// Only the surface nearest to the tool determines the height at which it rests.
TEST(SolidUnion, RestsOnBoneAsIfNoStructureLayBelow)
{
  const double h = 0.3;
  const core::GridGeometry box = boxOf({3.0, 3.0, 3.0}, h, {0.31, 0.13, 0.47});
  const auto ct = scanOn(box, plane({0.0, 0.0, 1.0}, 0.03));
  for (const double below : {0.05, 0.1, 0.2})
  {
    SCOPED_TRACE(below);
    const Scene scene = sceneOf(ct, {unionOn(box, plane({0.0, 0.0, 1.0}, 0.03 - below))});
    const BurrShape shape;
    ConstrainedProxy proxy(scene.field, sharedShell(shape, h));
    proxy.place(poseAt({0.0, 0.0, shape.radius + 0.5}));
    const ProxyTick* tick = nullptr;
    for (int t = 0; t < 200; ++t)
      tick = &proxy.step(poseAt({0.0, 0.0, shape.radius + 0.5 - 0.01 * t}));
    EXPECT_NEAR(tick->pose.position.z(), shape.radius + 0.03, 0.005);
  }
}

// Truth: another search that knows nothing yet. Bone, structures on the CT's grid and on another,
// cuts and undone cuts.
TEST(SolidUnion, SamplesKeptFromEarlierSearchesAreThoseOfANewOne)
{
  const double h = 0.3;
  const double within = 0.3; // mm
  const Matrix3d turn =
      Eigen::AngleAxisd(0.4, Vector3d(0.2, 1.0, 0.5).normalized()).toRotationMatrix();
  const SignedDistance ball = [](const Vector3d& p)
  { return 1.2 - (p - Vector3d(1.5, 0.5, -0.5)).norm(); };
  const auto ct = scanOn(
      boxOf({5.0, 5.0, 3.0}, h, {0.31, 0.13, 0.47}), [](const Vector3d& p)
      { return std::min(0.3 + 0.4 * std::sin(4.1 * p.x()) * std::cos(3.7 * p.y()), -p.z()); });
  Scene scene = sceneOf(ct, {unionOn(turnedBox({2.0, 2.0, 2.0}, 0.21, turn), ball),
                             unionOn(ct->geometry(), [&](const Vector3d& p)
                                     { return ball(p + Vector3d(3.0, 0.0, 0.0)); })});
  BurrShape shape;
  shape.shaftLength = 6.0;
  const ToolSolid solid = makeBurrShell(shape, h).solid;
  std::mt19937 random(7);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  const auto anywhere = [&] { return Vector3d(uniform(random), uniform(random), uniform(random)); };
  // All samples near the pose, sorted.
  const auto samplesAt = [&](SurfaceSamples& samples, const Pose& pose)
  {
    for (int tick = 0; tick < 200; ++tick)
    {
      samples.look(*scene.published->acquire());
      if (samples.find(pose, within, 0.0, 0.0) >= 1.0)
        break;
    }
    std::vector<std::array<double, 4>> places;
    for (std::size_t part = 0; part < SolidParts::kParts; ++part)
      for (std::size_t n = 0; n < samples.within(part, within); ++n)
      {
        const Vector3d& p = samples.place(part, n);
        if (samples.parts().distance(part, pose.rotation.conjugate() * (p - pose.position)) <=
            within)
          places.push_back({double(part), p.x(), p.y(), p.z()});
      }
    scene.published->release();
    std::sort(places.begin(), places.end());
    return places;
  };
  SurfaceSamples kept(*scene.field, solid);
  Pose pose{Vector3d(0.0, 0.0, 1.5), Eigen::Quaterniond::Identity()};
  Vector3d cut = Vector3d::Zero();
  std::size_t found = 0;
  for (int step = 0; step < 120; ++step)
  {
    SCOPED_TRACE(step);
    pose.position += 0.4 * anywhere();
    pose.position =
        pose.position.cwiseMax(Vector3d(-3.0, -3.0, -2.0)).cwiseMin(Vector3d(3.0, 3.0, 2.0));
    pose.rotation = (pose.rotation * rotationFrom(Vector3d(0.1 * anywhere()))).normalized();
    if (step % 3 == 0)
      cutBall(scene, cut = pose.position + 0.5 * anywhere(), 1.0);
    else if (step % 20 == 10)
      cutBall(scene, cut, 1.0, true);
    kept.moved(pose);
    SurfaceSamples fresh(*scene.field, solid);
    // Under another mask state the kept ones represent more tissue until the search has ended.
    const auto expected = samplesAt(fresh, pose);
    std::vector<std::array<double, 4>> actual;
    for (int tick = 0; tick < 200 && actual != expected; ++tick)
      actual = samplesAt(kept, pose);
    EXPECT_EQ(actual, expected);
    found += expected.size();
  }
  EXPECT_GT(found, 10000u);
}
