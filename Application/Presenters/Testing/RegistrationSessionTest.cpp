#include <gtest/gtest.h>

#include <filesystem>
#include <random>

#include <Eigen/Geometry>

#include "petrous/Presenters/RegistrationSession.h"
#include "petrous/Scene/LayMr.h"

using namespace petrous;
using namespace petrous::presenters;
using Eigen::Vector3d;

namespace
{

scene::ImagePart image(const std::string& name)
{
  const core::GridGeometry grid({8, 8, 8}, Vector3d::Ones(), Vector3d(-3.5, -3.5, -3.5));
  scene::ImagePart part;
  part.name = name;
  part.geometry = grid;
  part.volume = std::make_shared<const volume::IntensityVolume>(
      std::make_shared<const volume::Volume<std::int16_t>>(grid, std::int16_t{100}));
  return part;
}

class RegistrationSessionTest : public ::testing::Test
{
protected:
  RegistrationSessionTest()
    : folder(std::filesystem::temp_directory_path() /
             ("petrous-session-" + std::to_string(std::random_device{}())))
    , model(library::Library(folder))
    , session(model)
  {
    scene::Case value;
    value.name = "ear";
    value.ct = image("ct");
    value.mr = {image("T2"), image("DWI")};
    model.adopt(std::move(value));
    model.events.mrMoved = [this] { ++moved; };
    session.caseChanged();
  }
  ~RegistrationSessionTest() override { std::filesystem::remove_all(folder); }

  const scene::ImagePart& t2() const { return model.value().mr[0]; }

  static registration::Registration result(registration::Verdict verdict)
  {
    registration::Registration done;
    done.fit.mrFromCt = {Eigen::Quaterniond::Identity(), {1, 2, 3}};
    done.fit.metric = 0.7;
    done.error.median = 0.1;
    done.error.p95 = 0.3;
    done.error.max = 0.4;
    done.verdict = verdict;
    done.text = "because";
    return done;
  }

  std::filesystem::path folder;
  WorkstationModel model;
  RegistrationSession session;
  int moved = 0;
};

} // namespace

TEST_F(RegistrationSessionTest, BeginsWithTheFirstMrAndSaysThatItIsNotRegistered)
{
  EXPECT_EQ(session.mr(), "T2");
  EXPECT_EQ(session.stateInWords(), "not registered");
  EXPECT_FALSE(session.canUndo());
}

TEST_F(RegistrationSessionTest, HandMovesAreOfTheCaseAtOnceAndEachCanBeUndone)
{
  session.shift({1, 0, 0});
  session.shift({0, 0.1, 0});
  EXPECT_TRUE(t2().registered);
  EXPECT_TRUE(model.unsaved());
  EXPECT_EQ(moved, 2);
  ASSERT_TRUE(t2().registration);
  EXPECT_EQ(t2().registration->method, scene::Registration::Method::ByHand);
  EXPECT_NE(t2().registration->verdict, scene::Registration::Verdict::Good);
  EXPECT_LT((t2().mrFromCt * Vector3d(1, 0.1, 0)).norm(), 1e-12);
  EXPECT_NEAR(session.movedByHand().shift, std::hypot(1.0, 0.1), 1e-12);
  session.undo();
  EXPECT_LT((t2().mrFromCt * Vector3d(1, 0, 0)).norm(), 1e-12);
  session.undo();
  EXPECT_FALSE(t2().registered);
  EXPECT_FALSE(session.canUndo());
  session.redo();
  session.redo();
  EXPECT_LT((t2().mrFromCt * Vector3d(1, 0.1, 0)).norm(), 1e-12);
  EXPECT_FALSE(session.canRedo());
}

TEST_F(RegistrationSessionTest, TurnsAboutTheCrosshair)
{
  model.setCrosshair({2, 1, -1});
  session.turn(Vector3d::UnitY(), 1.0);
  EXPECT_LT((t2().mrFromCt * Vector3d(2, 1, -1) - Vector3d(2, 1, -1)).norm(), 1e-12);
  EXPECT_NEAR(session.movedByHand().turn, 1.0, 1e-9);
}

TEST_F(RegistrationSessionTest, ASignOffIsVoidOnceTheMrMovesAndDoesNotComeBackByUndo)
{
  EXPECT_ANY_THROW(session.signOff("A. Surgeon", "2026-01-31T10:00:00Z")); // not registered
  session.shift({1, 0, 0});
  EXPECT_ANY_THROW(session.signOff("", "2026-01-31T10:00:00Z"));
  session.signOff("A. Surgeon", "2026-01-31T10:00:00Z");
  ASSERT_NE(scene::validSignOff(t2()), nullptr);
  EXPECT_NE(session.stateInWords().find("A. Surgeon"), std::string::npos);
  session.shift({0, 0.1, 0});
  EXPECT_EQ(scene::validSignOff(t2()), nullptr);
  EXPECT_EQ(session.stateInWords().find("A. Surgeon"), std::string::npos);
  session.undo();
  EXPECT_EQ(scene::validSignOff(t2()), nullptr);
}

TEST_F(RegistrationSessionTest, FitsTheLandmarksThatWerePickedAndTellsWhatIsLeft)
{
  const core::RigidTransform truth{
      Eigen::Quaterniond(Eigen::AngleAxisd(0.2, Vector3d(1, 2, 3).normalized())), {0.2, -0.3, 0.1}};
  session.shift({0.3, 0, 0}); // points are picked over an MR that lies somewhere
  for (const Vector3d& ct : {Vector3d(3, 0, 0), Vector3d(0, 3, 0), Vector3d(0, 0, 3)})
  {
    model.setCrosshair(ct);
    session.addLandmark();
    EXPECT_TRUE(session.landmarks().waitsForMr());
    // The crosshair goes to where that point of the MR is seen now.
    const Vector3d seen = t2().mrFromCt.inverse() * (truth * ct);
    model.setCrosshair(seen);
    ASSERT_LT((model.crosshair() - seen).norm(), 1e-9) << "the test needs it within the CT";
    session.addLandmark();
  }
  EXPECT_EQ(session.landmarks().pairs(), 3U);
  session.fitLandmarks();
  EXPECT_LT((t2().mrFromCt.matrix() - truth.matrix()).norm(), 1e-9);
  EXPECT_EQ(t2().registration->method, scene::Registration::Method::Landmarks);
  EXPECT_LT(*session.landmarks().residual(1, t2().mrFromCt), 1e-9);
  EXPECT_TRUE(session.fitOptions(false).start == registration::Start::Given);
  EXPECT_TRUE(session.take(result(registration::Verdict::Good), "incus"));
  EXPECT_EQ(t2().registration->method, scene::Registration::Method::Landmarks);
  EXPECT_TRUE(t2().registration->refined);
}

TEST_F(RegistrationSessionTest, TwoLandmarksTellNoPlaceAndChangeNothing)
{
  model.setCrosshair({1, 0, 0});
  session.addLandmark();
  session.addLandmark();
  EXPECT_ANY_THROW(session.fitLandmarks());
  EXPECT_FALSE(t2().registered);
  EXPECT_FALSE(session.canUndo());
}

TEST_F(RegistrationSessionTest, TakesAResultWithItsErrorButNotAFailedOne)
{
  EXPECT_FALSE(session.take(result(registration::Verdict::Failed), "incus"));
  EXPECT_FALSE(t2().registered);
  EXPECT_TRUE(session.take(result(registration::Verdict::Doubtful), "incus"));
  ASSERT_TRUE(t2().registration && t2().registration->error);
  EXPECT_EQ(t2().registration->method, scene::Registration::Method::MutualInformation);
  EXPECT_FALSE(t2().registration->refined);
  EXPECT_EQ(t2().registration->verdict, scene::Registration::Verdict::Doubtful);
  EXPECT_EQ(t2().registration->error->p95, 0.3);
  EXPECT_EQ(t2().registration->error->place, "incus");
  EXPECT_EQ(session.movedByHand().shift, 0.0);
  session.unregister();
  EXPECT_FALSE(t2().registered);
  session.undo();
  EXPECT_TRUE(t2().registered);
  EXPECT_EQ(t2().registration->text, "because");
}

TEST_F(RegistrationSessionTest, AnotherMrKeepsItsOwnPlace)
{
  session.shift({1, 0, 0});
  session.choose("DWI");
  EXPECT_EQ(session.stateInWords(), "not registered");
  session.shift({0, 2, 0});
  session.undo();
  EXPECT_FALSE(model.value().mr[1].registered);
  EXPECT_TRUE(t2().registered);
}
