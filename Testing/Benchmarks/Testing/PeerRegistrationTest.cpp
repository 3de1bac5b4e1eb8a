#include "PeerRegistration.h"

#include <gtest/gtest.h>

#include "petrous/Core/Error.h"

using namespace petrous;
using namespace petrous::registration;

namespace
{

std::string parameters(const std::string& six, const std::string& center)
{
  return "(Transform \"EulerTransform\")\n(NumberOfParameters 6)\n(TransformParameters " + six +
         ")\n(Spacing 1 1 1)\n(CenterOfRotationPoint " + center + ")\n(ComputeZYX \"false\")\n";
}

} // namespace

// R = Rz Rx Ry, evaluated by hand for quarter turns.
TEST(ElastixTransform, TurnsAboutYThenXThenZ)
{
  const auto xz = elastixTransform(parameters("1.5707963268 0 1.5707963268 0 0 0", "0 0 0"));
  EXPECT_LT((xz * Vector3d(0, 1, 0) - Vector3d(0, 0, 1)).norm(), 1e-9);
  EXPECT_LT((xz * Vector3d(1, 0, 0) - Vector3d(0, 1, 0)).norm(), 1e-9);
  const auto xy = elastixTransform(parameters("1.5707963268 1.5707963268 0 0 0 0", "0 0 0"));
  EXPECT_LT((xy * Vector3d(1, 0, 0) - Vector3d(0, 1, 0)).norm(), 1e-9);
}

TEST(ElastixTransform, TurnsAboutItsCentreAndThenMoves)
{
  const auto t = elastixTransform(parameters("0 0 1.5707963268 1 2 3", "10 20 30"));
  EXPECT_LT((t * Vector3d(10, 20, 30) - Vector3d(11, 22, 33)).norm(), 1e-9);
  EXPECT_LT((t * Vector3d(11, 20, 30) - Vector3d(11, 23, 33)).norm(), 1e-9);
}

TEST(ElastixTransform, RefusesAnotherKind)
{
  EXPECT_THROW(elastixTransform("(Transform \"AffineTransform\")\n(TransformParameters 1 0 0 0 1 "
                                "0)\n(CenterOfRotationPoint 0 0 0)"),
               core::Error);
  EXPECT_THROW(elastixTransform(""), core::Error);
}

TEST(RegistrationPair, MovesTheHeaderAndTheTruthAlike)
{
  auto voxels = std::make_shared<volume::Volume<float>>(
      core::GridGeometry({4, 5, 6}, {1.0, 2.0, 3.0}, {7.0, 8.0, 9.0}), 1.0F);
  voxels->at(3, 2, 1) = 5.0F;
  RegistrationPair pair;
  pair.mr = pair.ct = std::make_shared<volume::IntensityVolume>(
      std::shared_ptr<const volume::Volume<float>>(voxels));
  pair.truth = [](const Vector3d& p) { return p; };
  pair.targets = {Vector3d(1, 2, 3)};
  const auto move = randomMotion({1, 1, 1}, 15.0, 20.0, 3);
  EXPECT_NEAR((move * Vector3d(1, 1, 1) - Vector3d(1, 1, 1)).norm(), 15.0, 1e-9);
  EXPECT_NEAR(move.rotation().angularDistance(Eigen::Quaterniond::Identity()),
              20.0 * 3.14159265358979323846 / 180.0, 1e-9);
  const RegistrationPair moved = displaced(pair, move);
  const Vector3d at(3, 2, 1);
  EXPECT_EQ(moved.mr->at(3, 2, 1), 5.0);
  EXPECT_LT(
      (moved.mr->geometry().patientFromVoxel(at) - move * pair.mr->geometry().patientFromVoxel(at))
          .norm(),
      1e-9);
  const PairError error = errorOf(moved, move);
  EXPECT_LT(error.cornerMax + error.target, 1e-9);
}
