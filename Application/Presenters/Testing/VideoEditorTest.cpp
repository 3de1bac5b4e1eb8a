#include "petrous/Presenters/VideoEditor.h"

#include <filesystem>
#include <fstream>

#include <gtest/gtest.h>
#include <unistd.h>

#include "ShapeCase.h"
#include "petrous/Library/Attachments.h"
#include "petrous/Scene/Branches.h"

namespace petrous::presenters
{
namespace
{

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr std::array<int, 2> kStill{1280, 720};
constexpr std::int64_t kSecond = 1'000'000'000;

// A case of three strokes with a video.
class Videos : public ::testing::Test
{
protected:
  Videos()
    : m_folder(std::filesystem::temp_directory_path() /
               ("petrous-videos-" + std::to_string(::getpid())))
    , m_model(library::Library(m_folder))
    , m_editor(m_model)
  {
    m_model.events.attachmentsChanged = [this] { m_editor.refresh(); };
    const core::GridGeometry grid({32, 24, 24}, Vector3d::Constant(0.5), Vector3d::Zero());
    scene::Case value = testing::shapeCase(grid, {});
    value.dissection = dissection::Dissection(grid);
    for (int n = 0; n < 3; ++n)
    {
      const Vector3d at(2.0 + 2 * n, 4, 4);
      value.dissection.beginStroke({});
      value.dissection.cut({at, at + Vector3d(0, 1, 0), 1.0});
      value.dissection.endStroke();
    }
    m_model.adopt(std::move(value));
    std::filesystem::create_directories(m_folder);
    std::ofstream(m_folder / "film", std::ios::binary)
        << std::string("\0\0\0\x18", 4) << "ftypmp42 of the theatre";
    m_model.attach(library::attachmentOf(m_folder / "film", {"film.mp4", {}, {}, false}));
    m_model.save();
    m_editor.refresh();
    m_editor.choose("film.mp4");
  }
  ~Videos() override
  {
    m_model.events = {};
    std::filesystem::remove_all(m_folder);
  }

  // A landmark as the camera sees it.
  void addPair(const core::CameraPose& camera, const Vector3d& patient,
               const Vector2d& miss = Vector2d::Zero())
  {
    m_editor.markStill(*seenAt(camera, kStill, patient) + miss);
    m_editor.addPair(patient);
  }

  std::filesystem::path m_folder;
  WorkstationModel m_model;
  VideoEditor m_editor;
};

const std::vector<Vector3d> kPoints{{1, 2, 3},  {12, 3, 8},  {5, 10, 1}, {9, 7, 11},
                                    {3, 9, 10}, {14, 11, 5}, {8, 1, 4}};

core::CameraPose microscope()
{
  core::CameraPose camera;
  camera.focalPoint = {8, 6, 6};
  camera.position = {-60, -20, 30};
  camera.viewUp = {0.1, 0.2, 1.0};
  camera.viewAngle = 14.0;
  return camera;
}

TEST_F(Videos, AreThoseOfTheCase)
{
  EXPECT_EQ(m_editor.videos(), std::vector<std::string>{"film.mp4"});
  EXPECT_TRUE(std::filesystem::exists(m_editor.file()));
  EXPECT_THROW(m_editor.choose("other.mp4"), core::InvalidParameter);
  EXPECT_THROW(m_editor.addBookmark(), core::InvalidParameter) << "no frame is seen";
  m_model.removeAttachment("film.mp4");
  EXPECT_TRUE(m_editor.video().empty());
  EXPECT_TRUE(m_editor.videos().empty());
}

TEST_F(Videos, BookmarksAreTiedToStrokesAndBack)
{
  scene::Case now = m_model.value();
  m_editor.showFrame(kStill, 4 * kSecond);
  EXPECT_EQ(m_editor.addBookmark(), "bookmark 1");
  EXPECT_EQ(m_editor.strokeOf(0), 3U);
  m_model.goToState("main", 0); // after the first stroke
  m_editor.showFrame(kStill, kSecond);
  EXPECT_EQ(m_editor.addBookmark("antrum"), "antrum");
  ASSERT_EQ(m_editor.notes().bookmarks.size(), 2U);
  EXPECT_EQ(m_editor.notes().bookmarks[0].name, "antrum") << "by time";
  EXPECT_EQ(m_editor.strokeOf(0), 1U);
  ASSERT_TRUE(m_editor.stateOf(1));
  EXPECT_EQ(m_editor.stateOf(1)->branch, "main");
  EXPECT_EQ(m_editor.stateOf(1)->stroke, 2U);
  EXPECT_EQ(m_editor.bookmarkHere(), 0U);
  m_model.goToState("main", 2);
  EXPECT_EQ(m_editor.bookmarkHere(), 1U);
  m_model.goToState("main", 1);
  EXPECT_FALSE(m_editor.bookmarkHere());

  // A stroke of another approach.
  m_model.startBranch("other");
  EXPECT_EQ(m_editor.stateOf(1)->branch, "main");
  EXPECT_EQ(m_editor.stateOf(0)->branch, "other") << "both have it; here it is";

  m_editor.tieBookmark(1);
  EXPECT_EQ(m_editor.strokeOf(1), 0U);
  EXPECT_FALSE(m_editor.stateOf(1));
  m_editor.tieBookmark(1);
  EXPECT_EQ(m_editor.strokeOf(1), 2U);
}

TEST_F(Videos, BookmarksAreChangedUndoneAndKept)
{
  m_editor.showFrame(kStill, kSecond);
  m_editor.addBookmark("antrum");
  m_editor.showFrame(kStill, 3 * kSecond);
  m_editor.addBookmark("incus");
  m_editor.renameBookmark(0, "aditus");
  m_editor.showFrame(kStill, 2 * kSecond);
  m_editor.moveBookmark(0);
  EXPECT_EQ(m_editor.notes().bookmarks[0].time, 2 * kSecond);
  EXPECT_THROW(m_editor.renameBookmark(1, "ADITUS"), core::InvalidParameter);
  EXPECT_THROW(m_editor.removeBookmark(2), core::InvalidParameter);
  m_editor.setLoop(1, 0);
  EXPECT_EQ(m_editor.loop(), (std::array<std::int64_t, 2>{2 * kSecond, 3 * kSecond}));
  m_editor.setLoop(1, 1);
  EXPECT_FALSE(m_editor.loop());
  m_model.save();
  scene::Case back = m_model.library().open(m_model.value().name);
  ASSERT_TRUE(back.attachments[0].video);
  EXPECT_TRUE(*back.attachments[0].video == m_editor.notes());

  m_editor.removeBookmark(0);
  EXPECT_EQ(m_editor.notes().bookmarks.size(), 1U);
  EXPECT_EQ(m_model.undoText(), "removal of bookmark 'aditus'");
  for (int n = 0; n < 5; ++n)
    m_model.undo();
  EXPECT_TRUE(m_editor.notes().empty());
  for (int n = 0; n < 4; ++n)
    m_model.redo();
  EXPECT_EQ(m_editor.notes().bookmarks[0].name, "aditus");
  EXPECT_EQ(m_editor.notes().bookmarks[0].time, 2 * kSecond);
}

TEST_F(Videos, AStillHasACameraOnceThereAreEnoughLandmarks)
{
  m_editor.showFrame(kStill, kSecond);
  EXPECT_THROW(m_editor.addPair({1, 2, 3}), core::InvalidParameter);
  m_editor.setViewAngle(14.0);
  ASSERT_TRUE(m_editor.still());
  for (std::size_t n = 0; n < 4; ++n)
  {
    EXPECT_FALSE(m_editor.still()->camera);
    addPair(microscope(), kPoints[n]);
  }
  ASSERT_TRUE(m_editor.still()->camera);
  ASSERT_TRUE(m_editor.fit());
  EXPECT_LT((m_editor.still()->camera->position - microscope().position).norm(), 0.01);
  for (std::size_t n = 4; n < 7; ++n)
    addPair(microscope(), kPoints[n], n == 5 ? Vector2d(70, 40) : Vector2d::Zero());
  EXPECT_EQ(m_editor.fit()->bad, std::vector<std::size_t>{5});
  m_editor.removePair(5);
  EXPECT_TRUE(m_editor.fit()->bad.empty());
  const scene::VideoNotes whole = m_editor.notes();

  // One step a landmark; its camera comes and goes with it.
  m_model.undo();
  EXPECT_EQ(m_editor.fit()->bad, std::vector<std::size_t>{5});
  m_model.redo();
  EXPECT_TRUE(m_editor.notes() == whole);
  m_editor.showFrame(kStill, 2 * kSecond);
  EXPECT_FALSE(m_editor.still());
  EXPECT_FALSE(m_editor.fit());
  m_editor.showFrame(kStill, kSecond);
  EXPECT_TRUE(m_editor.fit());
  m_editor.setOpacity(0.25);
  EXPECT_EQ(m_editor.still()->opacity, 0.25);
  m_editor.setViewAngle(std::nullopt);
  EXPECT_TRUE(m_editor.still()->camera) << "six landmarks give the angle, too";
  EXPECT_NEAR(m_editor.still()->camera->viewAngle, 14.0, 0.1);
  m_editor.removeStill();
  EXPECT_FALSE(m_editor.still());
  m_model.undo();
  EXPECT_TRUE(m_editor.fit());
}

TEST_F(Videos, TakesNoPointOfThePatientTwiceInAStill)
{
  m_editor.showFrame(kStill, kSecond);
  addPair(microscope(), kPoints[0]);
  EXPECT_THROW(addPair(microscope(), kPoints[0], {50.0, 20.0}), core::InvalidParameter);
  EXPECT_EQ(m_editor.still()->landmarks.size(), 1U);
  EXPECT_TRUE(m_editor.mark()) << "for when the crosshair is moved";
  m_editor.showFrame(kStill, 2 * kSecond);
  addPair(microscope(), kPoints[0]); // which another still shows, too
  EXPECT_EQ(m_editor.still()->landmarks.size(), 1U);
}

TEST_F(Videos, SaysWhyThereIsNoCamera)
{
  m_editor.showFrame(kStill, kSecond);
  m_editor.setViewAngle(14.0);
  for (const double x : {1.0, 4.0, 7.0, 12.0})
    addPair(microscope(), {x, 5, 5}); // on a line
  EXPECT_FALSE(m_editor.fit());
  EXPECT_NE(m_editor.problem().find("on one line"), std::string::npos) << m_editor.problem();
  EXPECT_FALSE(m_editor.still()->camera);
}

TEST_F(Videos, SeekTheirCameraInTheBackground)
{
  VideoEditor::Work work;
  int dropped = 0;
  int found = 0;
  m_editor.cameraFound = [&found] { ++found; };
  m_editor.inBackground = [&](VideoEditor::Work wanted)
  {
    dropped += wanted ? 0 : 1;
    work = std::move(wanted);
  };
  m_editor.showFrame(kStill, kSecond);
  m_editor.setViewAngle(14.0);
  for (std::size_t n = 0; n < 4; ++n)
    addPair(microscope(), kPoints[n]);
  ASSERT_TRUE(work);
  EXPECT_TRUE(m_editor.isFitting());
  const auto apply = work({});
  addPair(microscope(), kPoints[4]); // meanwhile
  EXPECT_EQ(dropped, 1);
  apply(); // of what is no more
  EXPECT_TRUE(m_editor.isFitting());
  EXPECT_FALSE(m_editor.still()->camera);
  EXPECT_EQ(found, 0);
  work({})();
  EXPECT_EQ(found, 1);
  EXPECT_FALSE(m_editor.isFitting());
  EXPECT_TRUE(m_editor.still()->camera);
}

} // namespace
} // namespace petrous::presenters
