#include "GuiTest.h"

#include <chrono>
#include <fstream>
#include <thread>

#include <QCheckBox>
#include <QComboBox>
#include <QDockWidget>
#include <QDoubleSpinBox>
#include <QLabel>
#include <QPushButton>
#include <QScrollArea>
#include <QScrollBar>
#include <QSlider>
#include <QTableWidget>
#include <QToolButton>
#include <QTreeWidget>

#ifdef PETROUS_GSTREAMER
#include "MadeVideo.h"
#endif
#include "VideoPicture.h"
#include "petrous/Library/Attachments.h"
#include "petrous/Presenters/StillCamera.h"
#include "petrous/Scene/VideoNotes.h"
#include "petrous/Video/VideoFile.h"

using namespace petrous;
using namespace petrous::workstation;

namespace
{

constexpr int kFrames = 25, kWide = 320, kHigh = 200;

class VideoPanels : public GuiTest
{
protected:
  static std::string stump() { return std::string("\0\0\0\x18", 4) + "ftypmp42 and no more"; }

  // A case with a video of a second, and perhaps one that is damaged.
  void openCase(const std::string& bytes = {}, bool withDamaged = false)
  {
    const auto film = folder() / "film.mkv";
    if (!bytes.empty())
      std::ofstream(film, std::ios::binary) << bytes;
#ifdef PETROUS_GSTREAMER
    else
    {
      video::made::Options options;
      options.frames = kFrames;
      options.width = kWide;
      options.height = kHigh;
      video::made::write(film, video::made::kRawMatroska, options);
    }
#endif
    saveBall("ball");
    scene::Case value = library().open("ball");
    library::attach(value, library::attachmentOf(film, {"film.mkv", {}, {}, true}));
    if (withDamaged)
    {
      std::ofstream(folder() / "damaged.mp4", std::ios::binary) << stump();
      library::attach(
          value, library::attachmentOf(folder() / "damaged.mp4", {"damaged.mp4", {}, {}, true}));
    }
    library::Library(library()).save(value);
    openWindow("ball");
    dock().show();
    dock().raise();
  }

  void choose(int row)
  {
    auto* box = window().findChild<QComboBox*>("videoChoice");
    box->setCurrentIndex(row);
    emit box->activated(row);
  }

  QDockWidget& dock()
  {
    return *window().findChild<QDockWidget*>("videoDock");
  }
  template <class T>
  T& child(const char* name)
  {
    return *window().findChild<T*>(name);
  }
  VideoPicture& video()
  {
    return child<VideoPicture>("videoPicture");
  }
  QTreeWidget& bookmarks()
  {
    return child<QTreeWidget>("bookmarks");
  }
  const scene::VideoNotes& notes()
  {
    static const scene::VideoNotes kNone;
    const auto& of = window().model().value().attachments.at(0).video;
    return of ? *of : kNone;
  }

#ifdef PETROUS_GSTREAMER
  bool shows(int number)
  {
    return waitFor(
        [&]
        {
          const QImage& frame = video().frame();
          if (frame.isNull())
            return false;
          petrous::video::Frame seen;
          seen.width = frame.width();
          seen.height = frame.height();
          seen.pixels = std::make_shared<std::vector<std::uint8_t>>(
              frame.constBits(), frame.constBits() + 3 * kWide * kHigh);
          return petrous::video::made::numberOf(seen) == number;
        },
        20000);
  }
#endif
};

} // namespace

TEST_F(VideoPanels, SayWhatAFileIsThatIsNoVideo)
{
  openCase(stump());
  if (!video::isSupported())
  {
    EXPECT_FALSE(child<QComboBox>("videoChoice").isEnabled());
    return;
  }
  for (const char* name : {"bookmarkAdd", "bookmarkMove", "bookmarkTie", "bookmarkRemove",
                           "videoLoop", "pairAdd", "pairRemove", "stillRemove"})
    EXPECT_FALSE(child<QToolButton>(name).isEnabled()) << name;
  EXPECT_FALSE(action("Play")->isEnabled());
  choose(1);
  ASSERT_TRUE(waitFor([this] { return child<QLabel>("videoFault").isVisibleTo(&dock()); }));
  EXPECT_TRUE(child<QLabel>("videoFault").text().contains("film.mkv"));
  EXPECT_EQ(child<QComboBox>("videoChoice").currentIndex(), 0);
  std::filesystem::remove(folder() / "film.mkv");
  choose(1);
  EXPECT_TRUE(child<QLabel>("videoFault").text().contains("missing"));
}

#ifdef PETROUS_GSTREAMER

TEST_F(VideoPanels, StepSeekAndSetBookmarksThatUndoTakesBack)
{
  openCase();
  choose(1);
  ASSERT_TRUE(shows(0));
  action("Step forward")->trigger();
  ASSERT_TRUE(shows(1));
  action("Step forward")->trigger();
  action("Step back")->trigger();
  ASSERT_TRUE(shows(1));
  child<QSlider>("videoPlace").setValue(410);
  ASSERT_TRUE(shows(10));
  action("Set a bookmark")->trigger();
  ASSERT_EQ(bookmarks().topLevelItemCount(), 1);
  child<QSlider>("videoPlace").setValue(800);
  ASSERT_TRUE(shows(20));
  action("Set a bookmark")->trigger();
  bookmarks().topLevelItem(1)->setText(0, "incus");
  ASSERT_TRUE(waitFor([this] { return notes().bookmarks[1].name == "incus"; }));
  ASSERT_TRUE(settled());
  EXPECT_EQ(library().open("ball").attachments[0].video->bookmarks[1].name, "incus");
  action("Previous bookmark")->trigger();
  ASSERT_TRUE(shows(10));
  emit bookmarks().itemActivated(bookmarks().topLevelItem(0), 0);
  action("Next bookmark")->trigger();
  ASSERT_TRUE(shows(20));

  bookmarks().selectAll();
  const QAction* play = action("Play");
  action("Loop")->trigger();
  ASSERT_TRUE(waitFor([play] { return play->iconText() == "Pause"; }));
  ASSERT_TRUE(shows(19));
  ASSERT_TRUE(shows(10)); // again
  action("Pause")->trigger();
  action("Loop")->trigger();

  ASSERT_TRUE(settled());
  while (!notes().empty())
    action("Undo")->trigger();
  EXPECT_EQ(bookmarks().topLevelItemCount(), 0);
  choose(0);
  EXPECT_TRUE(video().frame().isNull());
}

TEST_F(VideoPanels, TakeNothingFromTheVideoBefore)
{
  openCase({}, true);
  auto& box = child<QComboBox>("videoChoice");
  const int film = box.findText("film.mkv");
  const int damaged = box.findText("damaged.mp4");
  ASSERT_GT(damaged, 0);
  for (int round = 0; round < 4; ++round)
  {
    choose(damaged);
    if (round % 2 == 1) // its failure is on its way
      std::this_thread::sleep_for(std::chrono::milliseconds(300));
    choose(film);
    ASSERT_TRUE(shows(0));
    EXPECT_FALSE(waitFor([&] { return box.currentIndex() != film; }, 300));
    EXPECT_FALSE(child<QLabel>("videoFault").isVisibleTo(&dock()));
  }
}

TEST_F(VideoPanels, StepNoFurtherThanIsSeen)
{
  openCase();
  choose(1);
  ASSERT_TRUE(shows(0));
  for (int n = 0; n < 20; ++n) // a key that is held while nothing can be shown
    action("Step forward")->trigger();
  ASSERT_TRUE(shows(4));
  EXPECT_FALSE(waitFor([this] { return child<QSlider>("videoPlace").value() > 160; }, 300));
}

TEST_F(VideoPanels, SayThatAFileBreaksOffUntilSomethingElseIsDone)
{
  video::made::Options options;
  options.frames = kFrames;
  options.width = kWide;
  options.height = kHigh;
  options.caps = "framerate=5/1";
  options.millisecond = [](int n) { return 200 * n; };
  const auto whole = folder() / "whole.mkv";
  video::made::write(whole, video::made::kRawMatroska, options);
  std::ifstream in(whole, std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(in), {}};
  openCase(bytes.substr(0, bytes.size() / 2));
  choose(1);
  ASSERT_TRUE(shows(0));
  auto& fault = child<QLabel>("videoFault");
  EXPECT_FALSE(fault.isVisibleTo(&dock()));
  action("Play")->trigger();
  ASSERT_TRUE(waitFor([&] { return fault.isVisibleTo(&dock()); }, 20000));
  EXPECT_TRUE(fault.text().contains("00:02.")) << fault.text().toStdString();
  action("Step back")->trigger();
  action("Step back")->trigger();
  ASSERT_TRUE(shows(9) || shows(10));
  EXPECT_TRUE(fault.isVisibleTo(&dock()));
  action("Set a bookmark")->trigger();
  EXPECT_FALSE(fault.isVisibleTo(&dock()));
}

// The picture gives way to the controls.
TEST_F(VideoPanels, FitALowAndNarrowScreen)
{
  openCase();
  window().resize(1280, 720);
  choose(1);
  ASSERT_TRUE(shows(0));
  auto* scroll = child<QToolButton>("videoPlay").parentWidget()->parentWidget()->parentWidget();
  auto* area = qobject_cast<QScrollArea*>(scroll);
  ASSERT_TRUE(area);
  EXPECT_LE(area->widget()->minimumSizeHint().width(), 460);
  EXPECT_TRUE(settled());
  EXPECT_EQ(area->horizontalScrollBar()->maximum(), 0);
  for (const char* name : {"videoAttach", "videoPlay", "bookmarkAdd", "videoLoop"})
  {
    const auto& one = child<QToolButton>(name);
    const QPoint end = one.mapTo(area->viewport(), one.rect().bottomRight());
    EXPECT_LE(end.x(), area->viewport()->width()) << name;
    EXPECT_LE(end.y(), area->viewport()->height()) << name;
  }
}

TEST_F(VideoPanels, GoWithTheBoneAndTheBoneWithThem)
{
  openCase();
  drill(500, 20);
  ASSERT_TRUE(strokeEnds());
  ASSERT_TRUE(settled());
  action("Drill")->trigger();
  choose(1);
  ASSERT_TRUE(shows(0));
  child<QSlider>("videoPlace").setValue(600);
  ASSERT_TRUE(shows(15));
  action("Set a bookmark")->trigger();
  EXPECT_EQ(bookmarks().topLevelItem(0)->text(2), "1");
  ASSERT_TRUE(settled());
  child<QSlider>("videoPlace").setValue(0);
  ASSERT_TRUE(shows(0));
  const auto& history = window().model().value().dissection.history();
  const_cast<presenters::WorkstationModel&>(window().model())
      .goToState("main", dissection::History::kStart); // before the stroke
  ASSERT_EQ(history.applied(), 0U);
  bookmarks().setCurrentItem(bookmarks().topLevelItem(0));
  emit bookmarks().itemActivated(bookmarks().topLevelItem(0), 0);
  ASSERT_TRUE(shows(15));
  EXPECT_EQ(history.applied(), 1U);
  // And the other way round.
  child<QSlider>("videoPlace").setValue(0);
  ASSERT_TRUE(shows(0));
  auto& model = const_cast<presenters::WorkstationModel&>(window().model());
  model.goToState("main", dissection::History::kStart);
  model.goToState("main", 0);
  ASSERT_TRUE(shows(15));
}

TEST_F(VideoPanels, FindTheViewOfAStillAndLayItOverTheScene)
{
  openCase();
  ASSERT_TRUE(settled());
  choose(1);
  ASSERT_TRUE(shows(0));
  core::CameraPose truth;
  truth.focalPoint = kBallCenter;
  truth.position = kBallCenter + Eigen::Vector3d(-80.0, 20.0, 30.0);
  truth.viewAngle = 25.0;
  auto& angle = child<QDoubleSpinBox>("stillAngle");
  angle.setValue(25.0);
  auto& model = const_cast<presenters::WorkstationModel&>(window().model());
  EXPECT_FALSE(action("Add the landmark")->isEnabled());
  for (const Eigen::Vector3d& offset :
       {Eigen::Vector3d(-10, 0, 0), Eigen::Vector3d(-6, 7, 3), Eigen::Vector3d(-5, -6, 6),
        Eigen::Vector3d(-4, 2, -8), Eigen::Vector3d(2, 8, 4)})
  {
    const Eigen::Vector3d p = kBallCenter + offset;
    emit video().pointed(*presenters::seenAt(truth, {kWide, kHigh}, p));
    model.setCrosshair(p);
    action("Add the landmark")->trigger();
  }
  ASSERT_TRUE(waitFor([this] { return action("View from the still")->isEnabled(); }));
  EXPECT_EQ(child<QTableWidget>("stillPairs").rowCount(), 5);
  EXPECT_TRUE(child<QLabel>("stillCamera").text().contains("Uncertainty"));
  ASSERT_EQ(notes().stills.size(), 1U);
  EXPECT_LT((notes().stills[0].camera->position - truth.position).norm(), 0.2);
  ASSERT_TRUE(settled());
  EXPECT_TRUE(library().open("ball").attachments[0].video->stills[0].camera) << "saved, too";

  auto& overlay = child<QWidget>("stillOverlay");
  EXPECT_FALSE(overlay.isVisibleTo(&view()));
  action("View from the still")->trigger();
  EXPECT_TRUE(overlay.isVisibleTo(&view()));
  EXPECT_LT((view().picture().camera().position - truth.position).norm(), 0.2);
  child<QSlider>("stillOpacity").setValue(20);
  ASSERT_TRUE(waitFor([this] { return notes().stills[0].opacity == 0.2; }));
  core::CameraPose turned = view().picture().camera();
  turned.position += Eigen::Vector3d(0.0, 5.0, 0.0);
  view().setCamera(turned);
  EXPECT_FALSE(overlay.isVisibleTo(&view()));
  action("Undo")->trigger(); // opacity
  action("Undo")->trigger(); // a landmark
  EXPECT_EQ(child<QTableWidget>("stillPairs").rowCount(), 4);
}

#endif
