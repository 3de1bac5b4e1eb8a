#include <gtest/gtest.h>

#include <filesystem>
#include <map>
#include <random>

#include <Eigen/Geometry>

#include "petrous/Presenters/RegistrationSession.h"
#include "petrous/Scene/ApplyRegistration.h"
#include "petrous/Scene/CaseField.h"

using namespace petrous;
using namespace petrous::presenters;
using Eigen::Vector3d;
using Way = RegistrationSession::Way;

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
    model.prepareNow();
    model.events.mrMoved = [this] { ++moved; };
    session.caseChanged();
  }
  ~RegistrationSessionTest() override { std::filesystem::remove_all(folder); }

  const scene::ImagePart& t2() const { return model.value().mr[0]; }

  static RegistrationOutcome result(scene::Registration::Verdict verdict)
  {
    RegistrationOutcome done;
    done.mrFromCt = {Eigen::Quaterniond::Identity(), {1, 2, 3}};
    done.how.verdict = verdict;
    done.how.metric = 0.7;
    done.how.error = scene::RegistrationError{{0, 0, 0}, "incus", 0.1, 0.3, 0.4};
    done.how.text = "because";
    return done;
  }

  // A structure in the middle of its grid, drawn on that MR.
  static scene::LabelPart drawnOn(const scene::ImagePart& mr, const std::string& name)
  {
    auto voxels = std::make_shared<volume::Volume<std::uint16_t>>(mr.geometry);
    voxels->at(3, 3, 3) = 1;
    volume::LabelMap map;
    map.voxels = voxels;
    scene::LabelPart part;
    scene::StructurePart structure;
    structure.name = name;
    structure.index = 1;
    structure.look.solid = structure.look.touchable = true;
    part.structures = {structure};
    part.drawnOn = mr.name;
    part.labels = std::make_shared<const volume::LabelMap>(std::move(map));
    return part;
  }

  /// Of the hand: what comes after it is a step of its own.
  void rest() { model.edits().close(); }

  // Applies the outcome as the window does.
  bool lay(RegistrationSession::Way way)
  {
    return session.take(registerMr(model.value(), session.request(way)));
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
  EXPECT_EQ(session.stateText(), "not registered");
  EXPECT_FALSE(session.canUndo());
}

TEST_F(RegistrationSessionTest, HandMovesAreOfTheCaseAtOnceAndCanBeUndone)
{
  session.shift({1, 0, 0});
  rest();
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
  EXPECT_NE(session.stateText().find("A. Surgeon"), std::string::npos);
  session.shift({0, 0.1, 0});
  EXPECT_EQ(scene::validSignOff(t2()), nullptr);
  EXPECT_EQ(model.undoText(), "move of T2");
  EXPECT_EQ(session.stateText().find("A. Surgeon"), std::string::npos);
  session.undo();
  EXPECT_LT((t2().mrFromCt * Vector3d(1, 0, 0)).norm(), 1e-12) << "as it was signed, no further";
  EXPECT_EQ(scene::validSignOff(t2()), nullptr);
}

TEST_F(RegistrationSessionTest, FitsTheLandmarksThatWerePickedAndTellsWhatIsLeft)
{
  const core::RigidTransform truth{
      Eigen::Quaterniond(Eigen::AngleAxisd(0.2, Vector3d(1, 2, 3).normalized())), {0.2, -0.3, 0.1}};
  session.shift({0.3, 0, 0}); // points are picked on an MR at an arbitrary pose
  for (const Vector3d& ct : {Vector3d(3, 0, 0), Vector3d(0, 3, 0), Vector3d(0, 0, 3)})
  {
    model.setCrosshair(ct);
    session.addLandmark();
    EXPECT_TRUE(session.landmarks().waitsForMr());
    // The crosshair moves to where that point of the MR appears now.
    const Vector3d seen = t2().mrFromCt.inverse() * (truth * ct);
    model.setCrosshair(seen);
    ASSERT_LT((model.crosshair() - seen).norm(), 1e-9) << "the test needs it within the CT";
    session.addLandmark();
  }
  EXPECT_EQ(session.landmarks().pairs(), 3U);
  EXPECT_TRUE(lay(Way::Landmarks));
  EXPECT_LT((t2().mrFromCt.matrix() - truth.matrix()).norm(), 1e-9);
  EXPECT_EQ(t2().registration->method, scene::Registration::Method::Landmarks);
  EXPECT_LT(*session.landmarks().residual(1, t2().mrFromCt), 1e-9);
  EXPECT_NE(t2().registration->text.find("3 landmarks agree"), std::string::npos);
  EXPECT_EQ(session.movedByHand().shift, 0.0);
  const RegistrationRequest refine = session.request(Way::Refine);
  EXPECT_EQ(refine.from, RegistrationRequest::From::Given);
  EXPECT_TRUE(refine.given.matrix() == t2().mrFromCt.matrix());
  EXPECT_FALSE(refine.lookAround);
  ASSERT_TRUE(refine.givenBy);
  EXPECT_EQ(refine.givenBy->method, scene::Registration::Method::Landmarks);
}

TEST_F(RegistrationSessionTest, TwoLandmarksTellNoPlaceAndChangeNothing)
{
  model.setCrosshair({1, 0, 0});
  session.addLandmark();
  session.addLandmark();
  EXPECT_THROW(lay(Way::Landmarks), core::InvalidParameter);
  EXPECT_FALSE(t2().registered);
  EXPECT_FALSE(session.canUndo());
}

TEST_F(RegistrationSessionTest, TakesAResultWithItsErrorButNotAFailedOne)
{
  RegistrationOutcome failed = result(scene::Registration::Verdict::Doubtful);
  failed.failed = true;
  EXPECT_FALSE(session.take(failed));
  EXPECT_FALSE(t2().registered);
  EXPECT_TRUE(session.take(result(scene::Registration::Verdict::Doubtful)));
  ASSERT_TRUE(t2().registration && t2().registration->error);
  EXPECT_EQ(t2().registration->verdict, scene::Registration::Verdict::Doubtful);
  EXPECT_EQ(t2().registration->error->p95, 0.3);
  EXPECT_TRUE(session.lies(result({}).mrFromCt));
  EXPECT_EQ(session.movedByHand().shift, 0.0);
  session.unregister();
  EXPECT_FALSE(t2().registered);
  session.undo();
  EXPECT_TRUE(t2().registered);
  EXPECT_EQ(t2().registration->text, "because");
}

TEST_F(RegistrationSessionTest, OtherPartsOfTheCaseLeaveItAsItIs)
{
  session.choose("DWI");
  session.shift({1, 0, 0});
  session.addLandmark();
  volume::LabelMap map;
  auto voxels = std::make_shared<volume::Volume<std::uint16_t>>(model.value().ct.geometry);
  voxels->at(3, 3, 3) = 1;
  map.voxels = voxels;
  map.segments = {{"sinus", 1, {}, 1}};
  model.addStructure(std::move(map), {});
  EXPECT_TRUE(session.partsChanged());
  EXPECT_EQ(session.mr(), "DWI");
  EXPECT_EQ(session.landmarks().rows().size(), 1U);
  EXPECT_TRUE(session.canUndo());
  const scene::Case before = model.value();
  scene::Case with = before;
  with.mr.push_back(image("T1"));
  model.takeParts(before, std::move(with));
  EXPECT_TRUE(session.partsChanged());
  EXPECT_EQ(session.mr(), "DWI");
  EXPECT_EQ(session.mrNames(), (std::vector<std::string>{"T2", "DWI", "T1"}));
  EXPECT_FALSE(session.canUndo()) << "only after the addition, in the order of all changes";
  model.removePart("T2");
  EXPECT_TRUE(session.partsChanged());
  EXPECT_EQ(session.mr(), "DWI");
  EXPECT_EQ(session.landmarks().rows().size(), 1U);
  EXPECT_FALSE(session.canUndo());
  model.renamePart("DWI", "b1000");
  EXPECT_TRUE(session.partsChanged());
  EXPECT_EQ(session.mr(), "b1000");
  EXPECT_EQ(session.landmarks().rows().size(), 1U);
  model.removePart("b1000");
  EXPECT_FALSE(session.partsChanged());
  EXPECT_EQ(session.mr(), "T1");
  EXPECT_TRUE(session.landmarks().rows().empty());
}

TEST_F(RegistrationSessionTest, AnotherMrKeepsItsOwnPlace)
{
  session.shift({1, 0, 0});
  session.choose("DWI");
  EXPECT_EQ(session.stateText(), "not registered");
  session.shift({0, 2, 0});
  session.undo();
  EXPECT_FALSE(model.value().mr[1].registered);
  EXPECT_TRUE(t2().registered);
}

TEST_F(RegistrationSessionTest, PrefersTheLastMrThatIsNotRegistered)
{
  EXPECT_FALSE(session.preferUnregistered()) << "the present one is not registered either";
  EXPECT_EQ(session.mr(), "T2");
  session.shift({1, 0, 0});
  ASSERT_TRUE(t2().registered);
  model.setCrosshair({0, 0, 0});
  session.addLandmark();
  EXPECT_FALSE(session.preferUnregistered()) << "its points would be lost";
  EXPECT_EQ(session.mr(), "T2");
  session.landmarks().clear();
  EXPECT_TRUE(session.preferUnregistered());
  EXPECT_EQ(session.mr(), "DWI");
  session.shift({0, 1, 0});
  EXPECT_FALSE(session.preferUnregistered()) << "all are registered";
  EXPECT_EQ(session.mr(), "DWI");
  session.choose("T2");
  session.unregister();
  session.choose("DWI");
  EXPECT_TRUE(session.preferUnregistered());
  EXPECT_EQ(session.mr(), "T2");
}

TEST_F(RegistrationSessionTest, AsksForWhatTheAimSays)
{
  using From = RegistrationRequest::From;
  RegistrationRequest request = session.request(Way::Register);
  EXPECT_EQ(request.mr, "T2");
  EXPECT_EQ(request.from, From::Header);
  EXPECT_FALSE(request.at) << "the middle ear, which registerMr looks for";
  EXPECT_TRUE(request.atStructure.empty());
  EXPECT_FALSE(request.region);
  EXPECT_TRUE(request.onto.empty());

  model.setCrosshair({1, 2, -1});
  RegistrationAim aim;
  aim.start = RegistrationAim::Start::Centres;
  aim.place = RegistrationAim::Place::Crosshair;
  aim.box = 3.0;
  session.setAim(aim);
  request = session.request(Way::Register);
  EXPECT_EQ(request.from, From::Centres);
  ASSERT_TRUE(request.at);
  EXPECT_EQ(request.at->point, Vector3d(1, 2, -1));
  EXPECT_EQ(request.at->words, "(1.0, 2.0, -1.0)");
  ASSERT_TRUE(request.region);
  EXPECT_EQ(request.region->min(), Vector3d(-0.5, 0.5, -2.5));
  EXPECT_EQ(request.region->max(), Vector3d(2.5, 3.5, 0.5));

  session.shift({1, 0, 0});
  aim.start = RegistrationAim::Start::Present;
  session.setAim(aim);
  request = session.request(Way::Register);
  EXPECT_EQ(request.from, From::Given);
  EXPECT_TRUE(request.lookAround);
  EXPECT_TRUE(request.given.matrix() == t2().mrFromCt.matrix());
  EXPECT_FALSE(session.request(Way::Refine).lookAround);
}

TEST_F(RegistrationSessionTest, SaysThatTheMiddleEarIsNotKnown)
{
  model.changeMr([](scene::Case& value) { value.labels = {drawnOn(value.mr[0], "incus")}; });
  EXPECT_NE(session.placeNote().find("put the crosshair in the middle ear"), std::string::npos)
      << "its MR is not registered: " << session.placeNote();
  RegistrationAim aim;
  aim.place = RegistrationAim::Place::Crosshair;
  session.setAim(aim);
  EXPECT_EQ(session.placeNote(), "");
  session.setAim({});
  EXPECT_NE(session.placeNote(), "");
  session.take(result(scene::Registration::Verdict::Good));
  EXPECT_EQ(session.placeNote(), "");
}

TEST_F(RegistrationSessionTest, TellsPlacesOfAlikeNamesApart)
{
  session.take(result(scene::Registration::Verdict::Good));
  model.changeMr(
      [](scene::Case& value)
      {
        value.labels = {drawnOn(value.ct, "cochlea"), drawnOn(value.mr[0], "cochlea 2"),
                        drawnOn(value.ct, "canal 3")};
        value.labels[0].drawnOn = value.labels[2].drawnOn = "";
        value.labels[0].structures[0].volume = 74.0;
        value.labels[1].structures[0].volume = 80.0;
        core::TriangleMesh triangle;
        triangle.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
        triangle.triangles = {{0, 1, 2}};
        scene::MeshPart mesh;
        mesh.mesh = std::make_shared<const core::TriangleMesh>(triangle);
        mesh.name = "cochlea";
        value.meshes = {mesh};
        mesh.name = "cochlea_3";
        value.meshes.push_back(mesh);
      });
  const auto places = session.placeChoices();
  ASSERT_EQ(places.size(), 4U) << "a structure and its mesh are one place";
  std::map<std::string, PlaceChoice> byName;
  for (const PlaceChoice& place : places)
    byName[place.name] = place;
  EXPECT_TRUE(byName.at("cochlea").isAlike && byName.at("cochlea 2").isAlike);
  EXPECT_FALSE(byName.at("canal 3").isAlike) << "there is no other canal";
  EXPECT_FALSE(byName.at("cochlea").isMesh);
  EXPECT_TRUE(byName.at("cochlea_3").isMesh && byName.at("cochlea_3").isAlike);
  EXPECT_EQ(byName.at("cochlea").drawnOn, "");
  EXPECT_EQ(byName.at("cochlea 2").drawnOn, "T2");
  EXPECT_EQ(byName.at("cochlea").volume, 74.0);
  EXPECT_EQ(byName.at("cochlea 2").volume, 80.0);
}

TEST_F(RegistrationSessionTest, OffersForTheAimOnlyWhatCanBe)
{
  model.changeMr([](scene::Case& value) { value.labels = {drawnOn(value.mr[0], "tumour")}; });
  RegistrationAim aim;
  aim.onto = "DWI";
  aim.place = RegistrationAim::Place::Structure;
  aim.structure = "tumour";
  session.setAim(aim);
  EXPECT_TRUE(session.ontoNames().empty()) << "DWI is not registered";
  EXPECT_TRUE(session.aim().onto.empty());
  EXPECT_TRUE(session.placeNames().empty()) << "drawn on an MR that is not registered";
  EXPECT_EQ(session.aim().place, RegistrationAim::Place::MiddleEar);

  session.take(result(scene::Registration::Verdict::Good));
  EXPECT_EQ(session.placeNames(), std::vector<std::string>{"tumour"});
  session.setAim(aim);
  EXPECT_EQ(session.request(Way::Register).atStructure, "tumour");
  session.choose("DWI");
  EXPECT_EQ(session.ontoNames(), std::vector<std::string>{"T2"});
  aim.onto = "T2";
  session.setAim(aim);
  EXPECT_EQ(session.request(Way::Refine).onto, "T2");
  RegistrationOutcome chained = result(scene::Registration::Verdict::Good);
  chained.how.through = "T2";
  session.take(chained);
  session.choose("T2");
  EXPECT_TRUE(session.ontoNames().empty()) << "DWI came through T2";
}

TEST_F(RegistrationSessionTest, UndoTakesAlongWhatCameThroughTheMrAndLeavesOtherSignaturesAlone)
{
  session.take(result(scene::Registration::Verdict::Good));
  session.choose("DWI");
  RegistrationOutcome chained = result(scene::Registration::Verdict::Good);
  chained.how.through = "T2";
  session.take(chained);
  const core::RigidTransform first = model.value().mr[1].mrFromCt;
  session.choose("T2");
  session.shift({2, 0, 0});
  const core::RigidTransform along = model.value().mr[1].mrFromCt;
  EXPECT_NEAR((along.translation() - first.translation()).norm(), 2.0, 1e-9);
  EXPECT_FALSE(model.value().mr[1].registration->error);
  session.undo();
  EXPECT_TRUE(model.value().mr[1].mrFromCt.matrix() == first.matrix());
  ASSERT_TRUE(model.value().mr[1].registration->error) << "it lies as it was judged";
  EXPECT_EQ(model.value().mr[1].registration->through, "T2");
  session.redo();
  EXPECT_TRUE(model.value().mr[1].mrFromCt.matrix() == along.matrix());
  EXPECT_FALSE(model.value().mr[1].registration->error);

  session.undo();
  session.choose("DWI");
  session.signOff("A. Surgeon", "2026-01-31T10:00:00Z");
  session.choose("T2");
  session.unregister();
  EXPECT_FALSE(model.value().mr[1].registered);
  session.undo();
  EXPECT_TRUE(model.value().mr[1].registered);
  EXPECT_EQ(scene::validSignOff(model.value().mr[1]), nullptr) << "it moved meanwhile";
}

TEST_F(RegistrationSessionTest, ASignatureOfAnMrThatUndoDoesNotMoveStays)
{
  session.choose("DWI");
  session.shift({0, 1, 0});
  session.choose("T2");
  session.shift({1, 0, 0});
  session.choose("DWI");
  session.signOff("A. Surgeon", "2026-01-31T10:00:00Z");
  session.undo(); // T2's move
  EXPECT_FALSE(t2().registered);
  ASSERT_NE(scene::validSignOff(model.value().mr[1]), nullptr);
}

TEST_F(RegistrationSessionTest, TheModelKnowsWhetherAStepMovesAnMr)
{
  EXPECT_FALSE(model.undoMovesMr() || model.redoMovesMr());
  session.shift({1, 0, 0});
  EXPECT_TRUE(model.undoMovesMr());
  EXPECT_FALSE(model.redoMovesMr());
  model.setIso(model.value().iso + 10.0);
  EXPECT_FALSE(model.undoMovesMr()) << "the threshold comes first";
  model.undo();
  EXPECT_TRUE(model.undoMovesMr());
  EXPECT_FALSE(model.redoMovesMr());
  model.undo();
  EXPECT_FALSE(model.undoMovesMr());
  EXPECT_TRUE(model.redoMovesMr());
}

// The image that was registered is not there any more, neither under its own name nor under that to
// which another one was registered.
TEST_F(RegistrationSessionTest, AResultOfBeforeTheAxesWereCorrectedIsNotTaken)
{
  RegistrationRequest request;
  request.mr = "T2";
  request.from = RegistrationRequest::From::Given;
  request.asIs = true;
  const RegistrationOutcome stated = registerMr(model.value(), request);
  EXPECT_FALSE(model.undoMovesMr());
  model.correctAxes("T2", core::AxesCorrection::parse("LPI"));
  EXPECT_TRUE(model.undoMovesMr()) << "not during a run either";
  EXPECT_FALSE(model.canUndoMr()) << "no step of its registration";
  ASSERT_TRUE(session.partsChanged());
  EXPECT_THROW(session.take(stated), core::Error);
  EXPECT_FALSE(t2().registered);
  const RegistrationOutcome corrected = registerMr(model.value(), request);
  EXPECT_TRUE(session.take(corrected));
  EXPECT_TRUE(t2().registered);
  request.mr = "DWI";
  request.onto = "T2";
  const RegistrationOutcome chained = registerMr(model.value(), request);
  model.undo(); // the result
  model.undo();
  EXPECT_TRUE(model.redoMovesMr());
  EXPECT_TRUE(t2().provenance.axes.isIdentity());
  EXPECT_TRUE(session.partsChanged());
  EXPECT_THROW(session.take(corrected), core::Error);
  EXPECT_TRUE(session.take(stated));
  session.choose("DWI");
  EXPECT_THROW(session.take(chained), core::Error);
  EXPECT_FALSE(model.value().mr[1].registered);
  request.onto.clear();
  EXPECT_TRUE(session.take(registerMr(model.value(), request)));
}

// RAS turns by half a turn about the axis of the head through the image's centre, here the origin:
// x, y, z comes to -x, -y, z. What was marked of the image lies there.
TEST_F(RegistrationSessionTest, LandmarksStayOnTheVoxelsOfTheirImageWhoseAxesAreCorrected)
{
  session.shift({1, 0, 0});
  rest();
  model.setCrosshair({1, 2, 3});
  session.addLandmark();
  session.addLandmark();
  const Vector3d marked = session.landmarks().rows().at(0).mr.value();
  session.addLandmark(); // still without its point of the MR
  model.correctAxes("T2", core::AxesCorrection::parse("RAS"));
  ASSERT_TRUE(session.partsChanged());
  ASSERT_EQ(session.landmarks().rows().size(), 2U);
  EXPECT_EQ(session.landmarks().rows()[0].ct, Vector3d(1, 2, 3));
  EXPECT_LT((session.landmarks().rows()[0].mr.value() - Vector3d(-marked[0], -marked[1], marked[2]))
                .norm(),
            1e-9);
  EXPECT_GT(marked.head<2>().norm(), 1.0);
  EXPECT_TRUE(session.landmarks().waitsForMr());
  EXPECT_EQ(session.movedByHand().shift, 0.0);
  model.undo();
  ASSERT_TRUE(session.partsChanged());
  EXPECT_LT((session.landmarks().rows()[0].mr.value() - marked).norm(), 1e-9);
  model.correctAxes("DWI", core::AxesCorrection::parse("RAS"));
  ASSERT_TRUE(session.partsChanged());
  EXPECT_LT((session.landmarks().rows()[0].mr.value() - marked).norm(), 1e-9) << "another image";
}

TEST_F(RegistrationSessionTest, StructuresFollowUndoAndTheirVoxelsForTouchAreMadeAnew)
{
  model.changeMr(
      [](scene::Case& value)
      {
        value.labels = {drawnOn(value.mr[0], "tumour")};
        scene::MeshPart mesh;
        mesh.name = "ball";
        mesh.drawnOn = "T2";
        core::TriangleMesh body; // a tetrahedron of 3 mm
        body.vertices = {{0, 0, 0}, {3, 0, 0}, {0, 3, 0}, {0, 0, 3}};
        body.triangles = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
        mesh.mesh = std::make_shared<const core::TriangleMesh>(std::move(body));
        mesh.look.solid = mesh.look.touchable = true;
        value.meshes = {mesh};
      });
  const auto middle = [this](const std::string& name)
  { return placeOf(model.value(), name).point; };
  const auto solid = [this]
  {
    const auto all = scene::meshSolids(model.value(), [](const auto&) { return true; });
    return all.empty() ? Vector3d(1e9, 0, 0) : all.front().occupancy->geometry().center();
  };
  session.shift({1, 0, 0});
  rest();
  const Vector3d tumour = middle("tumour");
  const Vector3d ball = solid();
  session.shift({0, -2, 0});
  EXPECT_LT((middle("tumour") - tumour - Vector3d(0, -2, 0)).norm(), 1e-6);
  EXPECT_LT((solid() - ball - Vector3d(0, -2, 0)).norm(), 1.0);
  EXPECT_GT((solid() - ball).norm(), 1.0);
  session.undo();
  EXPECT_LT((middle("tumour") - tumour).norm(), 1e-6);
  EXPECT_LT((solid() - ball).norm(), 1e-6);
  session.undo();
  EXPECT_ANY_THROW(middle("tumour"));
  EXPECT_GT(solid()[0], 1e8) << "nowhere on the CT";
}

TEST_F(RegistrationSessionTest, EachWayIsOneStepOfTheWindowsUndo)
{
  session.take(result(scene::Registration::Verdict::Good));
  const core::RigidTransform fitted = t2().mrFromCt;
  EXPECT_EQ(model.undoText(), "registration of T2");
  {
    const EditHistory::Hold hold(model.edits()); // as quick as a key that repeats
    for (int n = 0; n < 5; ++n)
      session.shift({0.1, 0, 0});
    session.turn(Vector3d::UnitZ(), 0.1);
  }
  EXPECT_EQ(model.undoText(), "move of T2");
  const core::RigidTransform byHand = t2().mrFromCt;
  session.keep({Eigen::Quaterniond::Identity(), {3, 0, 0}});
  EXPECT_EQ(model.undoText(), "registration of T2");
  session.unregister();
  EXPECT_EQ(model.undoText(), "removal of the registration of T2");

  model.undo();
  EXPECT_EQ(t2().mrFromCt.translation(), Vector3d(3, 0, 0));
  EXPECT_EQ(t2().registration->text, "stopped before its end");
  model.undo();
  EXPECT_TRUE(t2().mrFromCt.matrix() == byHand.matrix());
  model.undo();
  EXPECT_TRUE(t2().mrFromCt.matrix() == fitted.matrix()) << "all moves at once";
  ASSERT_TRUE(t2().registration && t2().registration->error);
  EXPECT_EQ(t2().registration->error->p95, 0.3);
  EXPECT_EQ(session.movedByHand().shift, 0.0);
  model.undo();
  EXPECT_FALSE(t2().registered);
  EXPECT_EQ(session.movedByHand().shift, 0.0) << "nothing was moved by hand";
  EXPECT_FALSE(model.canUndo());
  for (int n = 0; n < 3; ++n)
    model.redo();
  EXPECT_EQ(t2().mrFromCt.translation(), Vector3d(3, 0, 0));
  EXPECT_EQ(model.redoText(), "removal of the registration of T2");
}

TEST_F(RegistrationSessionTest, AnMrThatWasAddedAndRegisteredGoesInTwoSteps)
{
  const scene::Case before = model.value();
  scene::Case with = before;
  with.mr.push_back(image("T1"));
  model.takeParts(before, std::move(with));
  session.partsChanged();
  session.choose("T1");
  session.take(result(scene::Registration::Verdict::Good));
  model.undo();
  ASSERT_TRUE(scene::findMr(model.value(), "T1")) << "the registration was the last thing done";
  EXPECT_FALSE(scene::findMr(model.value(), "T1")->registered);
  model.undo();
  EXPECT_FALSE(scene::findMr(model.value(), "T1"));
  model.redo();
  model.redo();
  EXPECT_TRUE(scene::findMr(model.value(), "T1")->registered);
}

TEST_F(RegistrationSessionTest, ItsUndoTakesTheSameStepFromAmongOthers)
{
  session.take(result(scene::Registration::Verdict::Good));
  model.setSide(scene::Side::Left);
  session.undo();
  EXPECT_FALSE(t2().registered);
  EXPECT_EQ(model.value().description.side, scene::Side::Left) << "others stay";
  EXPECT_EQ(model.undoText(), "side");
  EXPECT_EQ(model.redoText(), "registration of T2");
  EXPECT_EQ(session.redoText(), "registration of T2");
  model.redo();
  EXPECT_TRUE(t2().registered);
  EXPECT_EQ(session.undoText(), "registration of T2");
  EXPECT_FALSE(session.canRedo());
  model.undo();
  EXPECT_FALSE(session.canUndo()) << "there is one history";
  session.redo();
  EXPECT_TRUE(t2().registered);
}

// Places go by the names of MRs.
TEST_F(RegistrationSessionTest, AnotherMrThatGotTheNameIsNotMovedByUndo)
{
  session.take(result(scene::Registration::Verdict::Good));
  model.renamePart("T2", "T2 old");
  model.renamePart("DWI", "T2");
  session.choose("T2");
  EXPECT_FALSE(session.canUndo());
  session.undo();
  EXPECT_TRUE(t2().registered);
  for (int n = 0; n < 3; ++n)
    model.undo();
  EXPECT_EQ(t2().name, "T2");
  EXPECT_FALSE(t2().registered);
}
