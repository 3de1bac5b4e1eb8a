#include "GuiTest.h"

#include <cstdlib>

#include <QLabel>
#include <QPushButton>

#include "Banner.h"
#include "CaseStamps.h"
#include "SliceColumn.h"
#include "SliceView.h"
#include "petrous/Library/Attachments.h"

using namespace petrous;
using namespace petrous::workstation;

namespace
{

class Stamps : public GuiTest
{
protected:
  void saveSide(const std::string& name, scene::Side side)
  {
    scene::Case value = ballCase(name);
    value.description.side = side;
    library().save(value);
  }
  Banner& question() { return *window().findChild<Banner*>("sideBanner"); }
  void answer(const char* button) { question().findChild<QPushButton*>(button)->click(); }
  QLabel& stampOn(QWidget& view) { return *view.findChild<QLabel*>("caseStamp"); }
  void open(const std::string& name)
  {
    window().begin(QString::fromStdString(name));
    ASSERT_TRUE(waitFor([&] { return window().model().value().name == name; }));
    ASSERT_TRUE(settled());
  }
  scene::Side side() { return window().model().value().description.side; }
};

} // namespace

TEST_F(Stamps, EveryViewSaysWhoseCaseItIsAndWhichSide)
{
  scene::Case value = ballCase("ear 7");
  value.description.side = scene::Side::Left;
  value.description.date = "2026-03-31";
  library().save(value);
  openWindow("ear 7");
  EXPECT_EQ(stampOn(view()).text(), QString::fromUtf8("ear 7 · left · planned 2026-03-31"));
  EXPECT_FALSE(stampOn(view()).visibleRegion().isEmpty());
  for (SliceView* slice : window().findChild<SliceColumn*>()->views())
  {
    QLabel& stamp = stampOn(*slice);
    EXPECT_EQ(stamp.text(), QString::fromUtf8("ear 7 · left"));
    EXPECT_FALSE(stamp.visibleRegion().isEmpty());
    EXPECT_TRUE(slice->rect().contains(stamp.geometry()));
  }
  action("Close the case")->trigger();
  ASSERT_TRUE(waitFor([this] { return !window().model().hasCase(); }));
  EXPECT_TRUE(stampOn(view()).text().isEmpty());
}

// While a tool is in use the views keep their place, and a banner that comes lies over them.
TEST_F(Stamps, ABannerThatComesInDrillModeCoversNeitherStampNorLetters)
{
  saveSide("ear 7", scene::Side::Left);
  openWindow("ear 7");
  QTest::keyClick(&view(), Qt::Key_D);
  ASSERT_TRUE(view().tool().GetDrillMode());
  ASSERT_FALSE(question().isVisible());
  const int before = stampOn(view()).y();
  question().setText("one\ntwo\nthree");
  question().show();
  const auto bottom = [this] { return question().mapToGlobal(QPoint(0, question().height())).y(); };
  const auto isFree = [&](const QWidget& widget)
  { return widget.mapToGlobal(QPoint(0, 0)).y() >= bottom(); };
  ASSERT_TRUE(waitFor([&] { return stampOn(view()).y() > before; }));
  EXPECT_GT(bottom(), view().mapToGlobal(QPoint(0, 0)).y()) << "it does lie over the view";
  EXPECT_TRUE(isFree(stampOn(view())));
  const auto letters = view().findChildren<QLabel*>("direction");
  EXPECT_EQ(letters.size(), 4);
  for (const QLabel* letter : letters)
    EXPECT_TRUE(isFree(*letter)) << letter->text().toStdString();

  view().tool().DrillModeOff(); // then the views make room
  EXPECT_TRUE(waitFor([&] { return stampOn(view()).y() == before && isFree(stampOn(view())); }));
}

// The upper part of a slice that is covered has no letters; they are below.
TEST_F(Stamps, LettersOfASliceGiveWayToWhatCoversIt)
{
  saveSide("ear 7", scene::Side::Left);
  openWindow("ear 7");
  SliceView& slice = *window().findChild<SliceColumn*>()->views()[0];
  constexpr int kCovered = 40;
  const auto bright = [&slice](int from, int to) // pixels of the letters' colour
  {
    const QImage shown = slice.grab().toImage();
    int count = 0;
    for (int y = from; y < to; ++y)
      for (int x = shown.width() / 2 - 10; x < shown.width() / 2 + 10; ++x)
      {
        const QColor color = shown.pixelColor(x, y);
        const auto isNear = [](int a, int b) { return std::abs(a - b) < 12; };
        count +=
            isNear(color.red(), 0xf2) && isNear(color.green(), 0xf5) && isNear(color.blue(), 0xf8)
                ? 1
                : 0;
      }
    return count;
  };
  EXPECT_GT(bright(0, kCovered), 0);
  slice.setCovered(kCovered);
  EXPECT_EQ(bright(0, kCovered), 0);
  EXPECT_GT(bright(kCovered, 2 * kCovered), 0);
}

TEST_F(Stamps, LieAboveTheScaleBarOfTheSlicesAlsoBelowAMessage)
{
  constexpr int kBar = 8 + 28; // px, from the lower edge, as SliceView reserves them for it
  saveSide("ball", scene::Side::Unknown);
  openWindow("ball");
  auto* question = window().findChild<Banner*>("sideBanner");
  ASSERT_TRUE(question);
  for (const bool asks : {true, false, true})
  {
    question->setVisible(asks);
    for (SliceView* slice : window().findChild<SliceColumn*>()->views())
      EXPECT_TRUE(
          waitFor([&] { return stampOn(*slice).geometry().bottom() < slice->height() - kBar; }))
          << slice->objectName().toStdString() << ' ' << asks;
  }
}

TEST_F(Stamps, ALongNameIsElidedInTheSlicesAndTheSideIsNot)
{
  const std::string name = "the ninth temporal bone of the course for residents in the autumn";
  saveSide(name, scene::Side::Both);
  openWindow(QString::fromStdString(name));
  for (SliceView* slice : window().findChild<SliceColumn*>()->views())
  {
    QLabel& stamp = stampOn(*slice);
    EXPECT_TRUE(stamp.text().endsWith(QString::fromUtf8(" · both"))) << stamp.text().toStdString();
    EXPECT_TRUE(slice->rect().contains(stamp.geometry()));
  }
}

// Not a left ear under the word "right".
TEST_F(Stamps, TheViewTurnsToTheSideThatIsAnswered)
{
  saveSide("ball", scene::Side::Unknown);
  openWindow("ball");
  const auto from = [this]
  {
    const core::CameraPose camera = view().picture().camera();
    return (camera.position - camera.focalPoint).normalized().x();
  };
  action("Left")->trigger();
  ASSERT_GT(from(), 0.9);
  answer("sideRight");
  EXPECT_LT(from(), -0.5);
  action("Anterior")->trigger();
  const double front = from();
  action("Side: left")->trigger();
  EXPECT_EQ(from(), front) << "both sides are seen";
}

TEST_F(Stamps, TheSideIsAskedForOnceAndKept)
{
  saveSide("ball", scene::Side::Unknown);
  openWindow("ball");
  ASSERT_TRUE(question().isVisible());
  EXPECT_TRUE(stampOn(view()).text().contains("side not stated"));
  answer("sideLeft");
  EXPECT_TRUE(question().isVisible()) << "all of the image lies on the right";
  EXPECT_EQ(side(), scene::Side::Left);
  answer("sideLeft"); // it is
  EXPECT_FALSE(question().isVisible());
  EXPECT_EQ(stampOn(view()).text(), QString::fromUtf8("ball · left"));
  ASSERT_TRUE(settled());
  EXPECT_EQ(library().open("ball").description.side, scene::Side::Left);
  EXPECT_TRUE(action("Side: left")->isChecked());

  QTest::keyClick(&window(), Qt::Key_Z, Qt::ControlModifier);
  EXPECT_EQ(side(), scene::Side::Unknown);
  EXPECT_TRUE(question().isVisible()) << "it is asked for again";
  EXPECT_TRUE(action("Side: not stated")->isChecked());
  action("Side: both")->trigger();
  EXPECT_EQ(stampOn(view()).text(), QString::fromUtf8("ball · both"));
  ASSERT_TRUE(settled());
  closeWindow();
  openWindow("ball");
  EXPECT_FALSE(question().isVisible());
  EXPECT_EQ(side(), scene::Side::Both);
}

TEST_F(Stamps, TheQuestionCanBePutOffUntilTheNextStart)
{
  saveSide("ball", scene::Side::Unknown);
  saveSide("other", scene::Side::Right);
  openWindow("ball");
  ASSERT_TRUE(question().isVisible());
  answer("sideLater");
  EXPECT_FALSE(question().isVisible());
  EXPECT_EQ(side(), scene::Side::Unknown);
  open("other");
  EXPECT_FALSE(question().isVisible()) << "it knows its side";
  open("ball");
  EXPECT_FALSE(question().isVisible());
  closeWindow();
  openWindow("ball");
  EXPECT_TRUE(question().isVisible());
}

TEST_F(Stamps, AScreenshotOfACaseThatMayBearThePatientsNameHasTheSideAlone)
{
  saveSide("Mrs Smith", scene::Side::Right);
  openWindow("Mrs Smith");
  QImage wanted = picture();
  drawStamp(wanted, "right");
  window().findChild<QPushButton*>("attachScreenshot")->click();
  ASSERT_TRUE(waitFor([this] { return window().model().value().attachments.size() == 1; }));
  ASSERT_TRUE(settled());
  const auto out = folder() / "picture.png";
  const scene::Case saved = library().open("Mrs Smith");
  library::extractAttachment(library(), saved, saved.attachments.front(), out);
  const QImage kept(QString::fromStdString(out.string()));
  EXPECT_EQ(differentPixels(kept.convertToFormat(QImage::Format_RGB32), wanted, 0), 0);
}

TEST_F(Stamps, SideBySideBothHalvesHaveIt)
{
  QImage image(400, 100, QImage::Format_RGB32);
  image.fill(Qt::darkGray);
  QImage half = image.copy(0, 0, 200, 100);
  drawStamp(half, "right");
  drawStamp(image, "right", true);
  EXPECT_GT(pixelsUnlikeTheCorner(half), 50);
  EXPECT_EQ(differentPixels(image.copy(0, 0, 200, 100), half, 0), 0);
  EXPECT_LT(differentPixels(image.copy(200, 0, 200, 100), half, 3), 5);
}
