#include <cmath>

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "petrous/Interaction/PointerToolController.h"
#include "petrous/Presenters/HandpiecePresets.h"
#include "petrous/Rendering/StandardViews.h"

using namespace petrous;
using namespace petrous::presenters;
using Eigen::Vector3d;
using scene::Side;

namespace
{

const double kDegree = std::acos(-1.0) / 180.0;
const double kHalf = std::sqrt(0.5);

core::CameraPose surgicalView(Side ear)
{
  const core::GridGeometry grid({11, 11, 11}, Vector3d::Ones(), Vector3d(20.0, 30.0, -40.0));
  return rendering::standardCamera(ear == Side::Left ? rendering::StandardView::SurgicalLeft
                                                     : rendering::StandardView::SurgicalRight,
                                   grid);
}

} // namespace

TEST(HandpiecePresets, TransmastoidIsTheUsualHandpieceInSurgicalPosition)
{
  for (const Side ear : {Side::Right, Side::Left})
    for (const bool isLeft : {false, true})
    {
      const auto hand = handpieceAlong(shaftOf(SurgicalApproach::Transmastoid, ear, isLeft),
                                       surgicalView(ear), isLeft);
      ASSERT_TRUE(hand);
      EXPECT_NEAR(hand->tilt, 20.0, 1e-6);
      EXPECT_NEAR(hand->turn, isLeft ? -140.0 : -40.0, 1e-6) << "from below";
    }
}

TEST(HandpiecePresets, LeansFromTheAxisOfTheApproachByTheUsualTilt)
{
  const double s = std::sin(15.0 * kDegree);
  const double c = std::cos(15.0 * kDegree);
  const std::pair<SurgicalApproach, Vector3d> axes[] = {
      {SurgicalApproach::Transmastoid, {-1.0, 0.0, 0.0}},
      {SurgicalApproach::PosteriorTympanotomy, {-std::sqrt(0.75), 0.5, 0.0}},
      {SurgicalApproach::Translabyrinthine, {-c, s, 0.0}},
      {SurgicalApproach::Retrosigmoid, {-kHalf, kHalf, 0.0}},
      {SurgicalApproach::MiddleFossa, {-kHalf, 0.0, kHalf}}};
  for (const auto& [approach, axis] : axes)
  {
    const Vector3d right = shaftOf(approach, Side::Right, false);
    EXPECT_NEAR(right.norm(), 1.0, 1e-12);
    EXPECT_NEAR(right.dot(axis), std::cos(20.0 * kDegree), 1e-12) << nameOf(approach);
    // The mirror image of an ear and a hand is the other ear in the other hand.
    const Vector3d left = shaftOf(approach, Side::Left, true);
    EXPECT_LT((left - Vector3d(-right.x(), right.y(), right.z())).norm(), 1e-12)
        << nameOf(approach);
  }
}

// The surgeon sits behind the ear of a patient whose face lies away, at a right ear with the vertex
// on the left; at the middle fossa at the vertex, with the occiput of a head that is turned to the
// left on the right.
TEST(HandpiecePresets, ComesFromTheSideOfTheSurgeonsHand)
{
  for (const SurgicalApproach approach : kSurgicalApproaches)
  {
    const Vector3d right = shaftOf(approach, Side::Right, false);
    const Vector3d left = shaftOf(approach, Side::Right, true);
    if (approach == SurgicalApproach::MiddleFossa)
    {
      EXPECT_GT(right.y(), 0.1);
      EXPECT_LT(left.y(), -0.1);
      EXPECT_GT(std::min(right.z(), left.z()), 0.7) << "from above";
    }
    else
    {
      EXPECT_LT(right.z(), -0.1) << nameOf(approach);
      EXPECT_GT(left.z(), 0.1) << nameOf(approach);
      EXPECT_GT(std::min(right.y(), left.y()), 0.1) << nameOf(approach) << ": from behind";
    }
  }
}

TEST(HandpiecePresets, APointersToolLiesAlongThemInAnyViewThatSeesTheHand)
{
  core::CameraPose camera;
  camera.focalPoint = {12.0, -7.0, 30.0};
  camera.viewUp = {0.3, -1.0, 0.2};
  int seen = 0;
  for (const Vector3d& from : {Vector3d(-1.0, 0.0, 0.0), Vector3d(-0.6, 0.7, 0.4),
                               Vector3d(-0.2, 0.3, 0.9), Vector3d(1.0, 0.1, 0.0)})
    for (const SurgicalApproach approach : kSurgicalApproaches)
    {
      camera.position = camera.focalPoint + 100.0 * from;
      const Vector3d shaft = shaftOf(approach, Side::Right, false);
      const auto hand = handpieceAlong(shaft, camera, false);
      const double angle = std::acos(shaft.dot(from.normalized())) / kDegree;
      ASSERT_EQ(hand.has_value(), angle <= 80.0) << angle;
      if (!hand)
        continue;
      ++seen;
      interaction::AimSettings settings;
      settings.turn = hand->turn;
      settings.tilt = hand->tilt;
      interaction::PointerToolController pointer(
          [](const interaction::PickRay&) { return std::optional<double>(); }, settings);
      pointer.setCamera(camera);
      pointer.point({camera.position, -from.normalized()});
      ASSERT_TRUE(pointer.wanted());
      EXPECT_LT((pointer.wanted()->rotation * Vector3d::UnitZ() - shaft).norm(), 1e-9)
          << nameOf(approach);
    }
  EXPECT_GT(seen, 10);
}

TEST(HandpiecePresets, AreFoundByTheirNames)
{
  for (const SurgicalApproach approach : kSurgicalApproaches)
    EXPECT_EQ(parseSurgicalApproach(nameOf(approach)), approach);
  EXPECT_FALSE(parseSurgicalApproach("usual"));
}
