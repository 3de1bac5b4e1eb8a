#include "GuiTest.h"

#include <memory>

#include <QComboBox>
#include <QDoubleSpinBox>
#include <QLabel>
#include <QSlider>

#include "SurgeonWindow.h"
#include "petrous/Rendering/Stereo.h"

using namespace petrous;
using namespace petrous::workstation;
using rendering::StereoMode;

namespace
{

class PictureView : public GuiTest
{
protected:
  void SetUp() override
  {
    saveBall("ball");
    openWindow();
  }

  template <class Widget>
  Widget& control(const char* name)
  {
    return *window().findChild<Widget*>(name);
  }

  void chooseStereo(StereoMode mode)
  {
    auto& box = control<QComboBox>("stereoMode");
    box.setCurrentIndex(box.findData(static_cast<int>(mode)));
  }

  QAction* stereoAction(StereoMode mode)
  {
    const QStringList texts{"Off", "Side by side", "Line-interleaved", "Anaglyph", "Quad buffer"};
    for (QAction* action : window().findChildren<QAction*>())
      if (texts.contains(QString(action->text()).remove('&')) && action->data().isValid() &&
          action->data().toInt() == static_cast<int>(mode) && action->isCheckable())
        return action;
    return nullptr;
  }

  static SurgeonWindow* surgeonWindow()
  {
    for (QWidget* widget : QApplication::topLevelWidgets())
      if (auto* found = qobject_cast<SurgeonWindow*>(widget))
        return found;
    return nullptr;
  }

  static ThreeDView& surgeonView() { return *surgeonWindow()->findChild<ThreeDView*>(); }
};

// Mean red of the bright part: the ball.
double brightness(const QImage& image)
{
  double sum = 0.0;
  int count = 0;
  const int background = qRed(image.pixel(0, 0));
  for (int y = 0; y < image.height(); ++y)
    for (int x = 0; x < image.width(); ++x)
      if (const int red = qRed(image.pixel(x, y)); red > background + 6)
      {
        sum += red;
        ++count;
      }
  return sum / std::max(count, 1);
}

QImage half(const QImage& image, bool right)
{
  const int width = image.width() / 2;
  return image.copy(right ? image.width() - width : 0, 0, width, image.height());
}

} // namespace

TEST_F(PictureView, SideBySideShowsEachEyeAWholePicture)
{
  for (int n = 0; n < 6; ++n)
    QTest::keyClick(&view(), Qt::Key_Minus);
  const QImage plain = picture();
  chooseStereo(StereoMode::SideBySide);
  const QImage both = picture();
  ASSERT_EQ(both.size(), plain.size());
  const int whole = pixelsUnlikeTheCorner(plain);
  // The ball is as large for each eye as in mono, and round; only the letters differ.
  EXPECT_NEAR(pixelsUnlikeTheCorner(half(both, false)), whole, 0.05 * whole);
  EXPECT_NEAR(pixelsUnlikeTheCorner(half(both, true)), whole, 0.05 * whole);
  EXPECT_GT(differentPixels(half(both, false), half(both, true)), whole / 20);
  chooseStereo(StereoMode::None);
  EXPECT_EQ(differentPixels(picture(), plain), 0);
}

TEST_F(PictureView, InterleavingTakesRowsByTurns)
{
  chooseStereo(StereoMode::SideBySide);
  control<QDoubleSpinBox>("eyeSeparation").setValue(20.0);
  chooseStereo(StereoMode::Interleaved);
  const QImage image = picture();
  // The ball's left edge alternates between rows, by the disparity.
  const auto edge = [&image](int y)
  {
    int x = 0;
    while (x < image.width() && std::abs(qRed(image.pixel(x, y)) - qRed(image.pixel(0, 0))) < 7)
      ++x;
    return x;
  };
  const int middle = image.height() / 2;
  EXPECT_LE(std::abs(edge(middle) - edge(middle + 2)), 1);
  EXPECT_GE(std::abs(edge(middle) - edge(middle + 1)), 2);
}

TEST_F(PictureView, AnaglyphColoursTheEdges)
{
  control<QDoubleSpinBox>("eyeSeparation").setValue(20.0);
  chooseStereo(StereoMode::Anaglyph);
  const QImage image = picture();
  const QRgb background = image.pixel(0, 0);
  int red = 0; // seen by the left eye only
  int cyan = 0;
  for (int x = 0; x < image.width(); ++x)
  {
    const QRgb pixel = image.pixel(x, image.height() / 2);
    const bool left = std::abs(qRed(pixel) - qRed(background)) > 8;
    const bool right = std::abs(qBlue(pixel) - qBlue(background)) > 8;
    red += left && !right;
    cyan += right && !left;
  }
  EXPECT_GT(red, 0);
  EXPECT_GT(cyan, 0);
}

TEST_F(PictureView, MenuAndPanelShowTheSameStereo)
{
  chooseStereo(StereoMode::Anaglyph);
  ASSERT_TRUE(stereoAction(StereoMode::Anaglyph));
  EXPECT_TRUE(stereoAction(StereoMode::Anaglyph)->isChecked());
  stereoAction(StereoMode::SideBySide)->trigger();
  EXPECT_EQ(control<QComboBox>("stereoMode").currentData().toInt(),
            static_cast<int>(StereoMode::SideBySide));
  // No driver here supports quad-buffered stereo, so it is not offered.
  EXPECT_EQ(control<QComboBox>("stereoMode").findData(static_cast<int>(StereoMode::QuadBuffer)),
            -1);
}

TEST_F(PictureView, APointerSideBySideLooksThroughTheEyeOfItsHalf)
{
  chooseStereo(StereoMode::SideBySide);
  const QPoint middle = view().rect().center();
  for (const int column : {view().width() / 4, view().width() * 3 / 4})
  {
    QTest::mouseClick(&view(), Qt::LeftButton, Qt::NoModifier, {column, middle.y()});
    const Eigen::Vector3d offset = window().model().crosshair() - kBallCenter;
    EXPECT_NEAR(offset.norm(), kBallRadius, 0.1);
    EXPECT_LT(offset.x(), -11.0); // the centre of either picture is the centre of the ball
  }
}

TEST_F(PictureView, TheLampFallsOffAndAWetSurfaceGlitters)
{
  const double plain = brightness(picture());
  control<QDoubleSpinBox>("lightFalloff").setValue(50.0);
  // As bright as before at the focal point, the ball's centre; all that is seen is nearer.
  EXPECT_GT(brightness(picture()), 1.05 * plain);
  control<QDoubleSpinBox>("lightFalloff").setValue(0.0);
  control<QSlider>("wetness").setValue(100);
  const QImage wet = picture();
  const QRgb middle = wet.pixel(wet.rect().center());
  control<QSlider>("wetness").setValue(0);
  const QImage dry = picture();
  EXPECT_GT(qBlue(middle), qBlue(dry.pixel(dry.rect().center())));
  EXPECT_NEAR(brightness(dry), plain, 0.5);
}

TEST_F(PictureView, TheBoneSliderLetsTheStructureShine)
{
  const QImage opaque = picture();
  control<QSlider>("boneOpacity").setValue(5);
  ASSERT_TRUE(waitFor([this] { return window().model().value().boneLook.opacity < 0.06F; }));
  const QImage clear = picture();
  // The nerve in the middle is green, bone is beside it.
  const QRgb middle = clear.pixel(clear.rect().center());
  EXPECT_GT(qGreen(middle), qRed(middle) + 20);
  const QRgb before = opaque.pixel(opaque.rect().center());
  EXPECT_LE(qGreen(before), qRed(before));
  closeWindow();
  EXPECT_NEAR(library().open("ball").boneLook.opacity, 0.05F, 1e-6F);
}

TEST_F(PictureView, TellsHowFastItIs)
{
  picture();
  const auto says = [this](const QString& text)
  {
    for (const QLabel* label : window().findChildren<QLabel*>())
      if (label->text().contains(text) && label->isVisible())
        return true;
    return false;
  };
  EXPECT_TRUE(says(" Hz") || says(" s"));
}

TEST_F(PictureView, TheSurgeonsWindowShowsTheSceneAndEscapeClosesIt)
{
  chooseStereo(StereoMode::SideBySide);
  QTest::keyClick(&window(), Qt::Key_F11);
  ASSERT_TRUE(surgeonWindow());
  ASSERT_TRUE(QTest::qWaitForWindowExposed(surgeonWindow()));
  picture();
  EXPECT_EQ(view().display().stereo(), StereoMode::None); // mono, for bystanders
  EXPECT_EQ(surgeonView().display().stereo(), StereoMode::SideBySide);
  const QImage shown = surgeonView().grabFramebuffer();
  EXPECT_GT(pixelsUnlikeTheCorner(half(shown, true)), shown.width() * shown.height() / 50);

  // Changes in one window show in the other.
  QTest::keyClick(&window(), Qt::Key_2);
  EXPECT_LT((surgeonView().picture().camera().position - view().picture().camera().position).norm(),
            1e-9);
  QTest::keyClick(&surgeonView(), Qt::Key_Left);
  EXPECT_LT((surgeonView().picture().camera().position - view().picture().camera().position).norm(),
            1e-9);

  QTest::keyClick(surgeonWindow(), Qt::Key_Escape);
  EXPECT_TRUE(waitFor([] { return surgeonWindow() == nullptr; }));
  EXPECT_FALSE(action("Surgeon's window")->isChecked());
  EXPECT_EQ(view().display().stereo(), StereoMode::SideBySide);
}

TEST_F(PictureView, TheSurgeonDrillsInTheirOwnWindow)
{
  action("Surgeon's window")->trigger();
  ASSERT_TRUE(surgeonWindow());
  ASSERT_TRUE(QTest::qWaitForWindowExposed(surgeonWindow()));
  surgeonWindow()->resize(500, 400); // small: software-rendered here
  action("Drill")->trigger();
  QTest::qWait(100);
  ThreeDView& surgeon = surgeonView();
  EXPECT_EQ(surgeon.cursor().shape(), Qt::CrossCursor);
  const QPoint middle = surgeon.rect().center();
  QTest::mouseMove(&surgeon, middle);
  // A busy machine removes less in the same time.
  const auto removed = [this] { return window().model().value().removedVolume(); };
  for (int n = 0; n < 20 && removed() <= 0.1; ++n)
  {
    QTest::mousePress(&surgeon, Qt::LeftButton, Qt::NoModifier, middle);
    QTest::qWait(600);
    QTest::mouseRelease(&surgeon, Qt::LeftButton, Qt::NoModifier, middle);
    EXPECT_TRUE(strokeEnds());
  }
  ASSERT_GE(window().model().value().dissection.strokes().size(), 1u);
  EXPECT_GT(removed(), 0.1);
  closeWindow();
  EXPECT_TRUE(waitFor([] { return surgeonWindow() == nullptr; }));
}

TEST_F(PictureView, NothingIsDrilledInTheSurgeonsWindowWhileADialogAsks)
{
  action("Surgeon's window")->trigger();
  ASSERT_TRUE(surgeonWindow());
  ASSERT_TRUE(QTest::qWaitForWindowExposed(surgeonWindow()));
  surgeonWindow()->resize(500, 400); // small: software-rendered here
  QMessageBox box(&window());
  box.open(); // of the main window alone, as Qt has it
  ASSERT_TRUE(QTest::qWaitForWindowExposed(&box));
  EXPECT_TRUE(waitFor([] { return !surgeonWindow()->isEnabled(); }));
  EXPECT_FALSE(surgeonView().isEnabled());
  QTest::keyClick(surgeonWindow(), Qt::Key_D);
  EXPECT_FALSE(action("Drill")->isChecked());
  QTest::mousePress(&surgeonView(), Qt::LeftButton, Qt::NoModifier, surgeonView().rect().center());
  EXPECT_FALSE(view().tool().GetDrilling());
  QTest::mouseRelease(&surgeonView(), Qt::LeftButton, Qt::NoModifier,
                      surgeonView().rect().center());
  box.accept();
  EXPECT_TRUE(waitFor([] { return surgeonWindow()->isEnabled(); }));
  EXPECT_EQ(surgeonWindow()->focusWidget(), &surgeonView());
  surgeonWindow()->close();
  EXPECT_TRUE(waitFor([] { return surgeonWindow() == nullptr; }));
}

TEST_F(PictureView, AFailingPictureSavesTheCaseFirst)
{
  action("Drill")->trigger();
  const auto look = window().model().value().boneLook;
  control<QSlider>("boneOpacity").setValue(50);
  ASSERT_TRUE(waitFor([this] { return window().model().unsaved(); }));
  QString words;
  bool saved = false;
  onMessage(
      [&](QMessageBox& box)
      {
        words = box.text() + box.informativeText();
        saved = library().open("ball").boneLook.opacity < look.opacity;
        box.accept();
      });
  emit view().display().failed("the graphics driver was reset and lost the picture");
  EXPECT_TRUE(saved);
  EXPECT_TRUE(words.contains("lost the picture")) << words.toStdString();
  EXPECT_TRUE(words.contains("The case is saved")) << words.toStdString();
  EXPECT_FALSE(window().model().unsaved());
}

// Every frame asks the driver. Here it answers at the test's word: none can be made to lose what it
// holds.
TEST_F(PictureView, AResetOfTheDriverIsNoticedByTheNextFrame)
{
  struct Driver
  {
    int asked = 0;
    bool lost = false;
  };
  const auto driver = std::make_shared<Driver>();
  view().display().setSamples(1);
  view().display().setLossQuery(
      [driver]
      {
        ++driver->asked;
        return driver->lost;
      });
  view().display().redraw();
  ASSERT_TRUE(waitFor([&] { return driver->asked > 0; }));
  const QImage before = steady([this] { return picture(); });
  int messages = 0;
  QString words;
  onMessage(
      [&](QMessageBox& box)
      {
        ++messages;
        words = box.text() + box.informativeText();
        driver->lost = false; // it is back
        box.accept();
      });
  driver->lost = true;
  view().display().redraw();
  EXPECT_TRUE(waitFor([&] { return messages > 0; }));
  EXPECT_TRUE(words.contains("lost the picture")) << words.toStdString();
  EXPECT_TRUE(words.contains("The case is saved")) << words.toStdString();
  const int then = driver->asked;
  view().display().redraw();
  EXPECT_TRUE(waitFor([&] { return driver->asked > then; }));
  EXPECT_EQ(steady([this] { return picture(); }), before);
  EXPECT_EQ(messages, 1);
  view().display().setLossQuery({});
}

TEST_F(PictureView, TheWindowMayBeResizedWhileTheDrillIsOn)
{
  action("Drill")->trigger();
  const QPoint middle = view().rect().center();
  QTest::mouseMove(&view(), middle);
  QTest::mousePress(&view(), Qt::LeftButton, Qt::NoModifier, middle);
  EXPECT_TRUE(cuts());
  for (const QSize& size : {QSize(900, 600), QSize(1300, 800), QSize(1000, 640)})
  {
    window().resize(size);
    QTest::qWait(150);
    EXPECT_TRUE(view().tool().GetDrilling());
  }
  QTest::mouseRelease(&view(), Qt::LeftButton, Qt::NoModifier, view().rect().center());
  EXPECT_TRUE(strokeEnds());
  ASSERT_EQ(window().model().value().dissection.strokes().size(), 1u);
  const QImage image = picture();
  EXPECT_GT(pixelsUnlikeTheCorner(image), image.width() * image.height() / 20);
}
