#include "GuiTest.h"

#include <fstream>
#include <iterator>

#include <nlohmann/json.hpp>

#include <QAbstractButton>
#include <QApplication>
#include <QColorDialog>
#include <QComboBox>
#include <QDoubleSpinBox>
#include <QLabel>
#include <QSlider>
#include <QSpinBox>

#include "DrillBar.h"
#include "SliceColumn.h"
#include "SliceView.h"

using namespace petrous;
using namespace petrous::workstation;

namespace
{

class ViewStates : public GuiTest
{
protected:
  template <class Widget>
  Widget& widget(const char* name)
  {
    return *window().findChild<Widget*>(name);
  }
  const scene::Case& value() { return window().model().value(); }

  /// The manifest, but for its revision.
  nlohmann::json manifest(const std::string& name)
  {
    std::ifstream file(folder() / "library/cases" / (name + ".json"));
    auto j = nlohmann::json::parse(std::string(std::istreambuf_iterator<char>(file), {}));
    j.erase("revision");
    j.erase("sha256"); // of all the rest
    return j;
  }

  void save()
  {
    const auto before = value().revision;
    action("Save")->trigger();
    ASSERT_TRUE(waitFor([&] { return value().revision > before && !window().busy(); }));
  }

  /// All that a view has, in numbers of which no box and no camera keeps all digits.
  scene::Case seen(const std::string& name)
  {
    scene::Case ball = ballCase(name);
    core::CameraPose camera;
    camera.position = kBallCenter + Eigen::Vector3d(100.0 / 3.0, -70.0 / 7.0, 41.0 / 9.0);
    camera.focalPoint = kBallCenter + Eigen::Vector3d::Constant(1.0 / 3.0);
    camera.viewUp = Eigen::Vector3d(0.1, 0.2, 3.0); // not of length 1, not perpendicular
    camera.viewAngle = 91.0 / 3.0;
    ball.camera = camera;
    auto& view = ball.view;
    view.slices = scene::ViewState::Slices{kBallCenter + Eigen::Vector3d::Constant(2.0 / 3.0),
                                           4000.0 / 7.0, 1.0 / 3.0};
    view.slices->planes.emplace();
    (*view.slices->planes)[1] = {10.0 / 3.0, Eigen::Vector3d(1.0 / 7.0, 0.0, -1.0 / 9.0)};
    view.light = scene::ViewState::Light{1000.0 / 7.0, 1.0 / 3.0, true, -2.0 / 3.0, true};
    view.stereo = scene::ViewState::Stereo{"anaglyph", 100.0 / 7.0, 1000.0 / 3.0};
    view.clipping.planes = {{kBallCenter, Eigen::Vector3d(0.0, 0.6, 0.8)}};
    view.clipping.crop = core::IndexBox{{0, 0, 0}, {64, 64, 50}};
    view.tool = scene::ViewState::Tool{
        {dissection::Burr::Kind::Diamond, 3.0, 70000.0 / 3.0, {}}, 7.0 / 3.0, true};
    view.handpiece = scene::ViewState::Handpiece{1000.0 / 9.0, 100.0 / 3.0};
    return ball;
  }
};

} // namespace

TEST_F(ViewStates, OpeningAndSavingChangesNoBitOfTheManifest)
{
  scene::Case ball = seen("ball");
  library().save(ball);
  saveBall("plain"); // with no view at all
  const nlohmann::json before = manifest("ball");
  const nlohmann::json plain = manifest("plain");
  openWindow("ball");
  save();
  EXPECT_EQ(manifest("ball"), before);
  closeWindow();
  openWindow("plain");
  save();
  EXPECT_EQ(manifest("plain"), plain);
}

TEST_F(ViewStates, ShowsACaseAsItWasSaved)
{
  scene::Case ball = seen("ball");
  library().save(ball);
  openWindow("ball");
  EXPECT_LT((view().picture().camera().position - ball.camera->position).norm(), 1e-9);
  EXPECT_NEAR(view().picture().camera().viewAngle, 91.0 / 3.0, 1e-9);
  EXPECT_LT((window().model().crosshair() - ball.view.slices->crosshair).norm(), 1e-9);
  const auto& coronal = widget<SliceView>("coronalView");
  EXPECT_EQ(coronal.greyWindow().width, 4000.0 / 7.0);
  EXPECT_EQ(coronal.plane().zoom, 10.0 / 3.0);
  EXPECT_EQ(coronal.plane().offset, Eigen::Vector3d(1.0 / 7.0, 0.0, -1.0 / 9.0));
  EXPECT_EQ(widget<SliceView>("axialView").plane().zoom, 1.0);
  EXPECT_NEAR(widget<QDoubleSpinBox>("lightFalloff").value(), 142.9, 0.01);
  EXPECT_EQ(widget<QSlider>("wetness").value(), 33);
  EXPECT_TRUE(widget<QAbstractButton>("shadows").isChecked());
  EXPECT_NEAR(widget<QDoubleSpinBox>("exposure").value(), -0.7, 0.01);
  EXPECT_TRUE(widget<QAbstractButton>("toneCurve").isChecked());
  EXPECT_EQ(view().display().stereo(), rendering::StereoMode::Anaglyph);
  EXPECT_NEAR(widget<QDoubleSpinBox>("eyeSeparation").value(), 14.3, 0.01);
  const dissection::Burr burr = widget<DrillBar>("drillBar").burr();
  EXPECT_EQ(burr.kind, dissection::Burr::Kind::Diamond);
  EXPECT_EQ(burr.diameter, 3.0);
  EXPECT_EQ(burr.rpm, 23000.0);
  EXPECT_NEAR(widget<DrillBar>("drillBar").thrust(), 2.3, 0.01);
  EXPECT_TRUE(widget<DrillBar>("drillBar").wheelAction()->isChecked());

  // The user's own settings are not the case's: the next case has them again.
  saveBall("plain");
  closeWindow();
  openWindow("plain");
  EXPECT_EQ(widget<QDoubleSpinBox>("lightFalloff").value(), 0.0);
  EXPECT_FALSE(widget<QAbstractButton>("shadows").isChecked());
  EXPECT_EQ(widget<QDoubleSpinBox>("exposure").value(), 0.0);
  EXPECT_FALSE(widget<QAbstractButton>("toneCurve").isChecked());
  EXPECT_EQ(widget<QDoubleSpinBox>("thrust").value(), 1.0);
  EXPECT_EQ(view().display().stereo(), rendering::StereoMode::None);
}

TEST_F(ViewStates, SavesWhatTheUserChangedAndNothingElse)
{
  scene::Case ball = seen("ball");
  library().save(ball);
  nlohmann::json expected = manifest("ball");
  openWindow("ball");
  widget<QSlider>("wetness").setValue(50);
  ASSERT_TRUE(waitFor([this] { return value().name == "ball" && !window().busy(); }));
  widget<QDoubleSpinBox>("thrust").setValue(4.0);
  save();
  nlohmann::json now = manifest("ball");
  EXPECT_EQ(now["view"]["light"]["wetness"], 0.5);
  EXPECT_EQ(now["view"]["tool"]["thrust_n"], 4.0);
  for (nlohmann::json* j : {&expected, &now})
  {
    (*j)["view"].erase("light");
    (*j)["view"].erase("tool");
  }
  EXPECT_EQ(now, expected);

  // It comes back in the next window, and is saved by that as it is.
  const nlohmann::json before = manifest("ball");
  closeWindow();
  openWindow("ball");
  EXPECT_EQ(widget<QSlider>("wetness").value(), 50);
  EXPECT_EQ(widget<QDoubleSpinBox>("thrust").value(), 4.0);
  save();
  EXPECT_EQ(manifest("ball"), before);
}

TEST_F(ViewStates, ASaveForAnotherReasonKeepsAllOfTheView)
{
  saveBall("ball");
  openWindow("ball");
  drill(800, 20);
  ASSERT_TRUE(strokeEnds());
  ASSERT_TRUE(settled());
  const scene::Case saved = library().open("ball");
  EXPECT_TRUE(saved.camera);
  ASSERT_TRUE(saved.view.slices);
  EXPECT_EQ(saved.view.slices->crosshair, window().model().crosshair());
  EXPECT_TRUE(saved.view.slices->planes);
  EXPECT_TRUE(saved.view.light);
  EXPECT_TRUE(saved.view.stereo);
  EXPECT_TRUE(saved.view.tool);
}

// As an import is, at once: the slices begin with the head, which is still being looked for.
TEST_F(ViewStates, ACaseSavedAtOnceComesBackWithTheZoomThatWasShown)
{
  scene::Case head = ballCase("head");
  head.labels.clear();
  head.ct.geometry = core::GridGeometry({64, 64, 64}, Eigen::Vector3d::Constant(2.0),
                                        kBallCenter - Eigen::Vector3d::Constant(63.0));
  auto ct = std::make_shared<volume::Volume<std::int16_t>>(head.ct.geometry, std::int16_t{-1000});
  for (int k = 0; k < 64; ++k)
    for (int j = 0; j < 64; ++j)
      for (int i = 0; i < 64; ++i)
        if ((head.ct.geometry.patientFromVoxel(Eigen::Vector3d(i, j, k)) - kBallCenter).norm() <
            kBallRadius)
          ct->at(i, j, k) = 1600;
  head.ct.volume = std::make_shared<const volume::IntensityVolume>(
      std::shared_ptr<const volume::Volume<std::int16_t>>(ct));
  library().save(head);
  saveBall("ball");
  openWindow("ball");
  ASSERT_TRUE(settled());
  auto& model = const_cast<presenters::WorkstationModel&>(window().model());
  model.open("head");
  ASSERT_TRUE(widget<SliceColumn>("slices").isFraming());
  model.setIso(400.0); // all of the view is saved
  save();
  ASSERT_TRUE(settled());
  const double zoom = widget<SliceView>("axialView").plane().zoom;
  EXPECT_GT(zoom, 3.0) << "128 mm, of which the ball has 24";
  closeWindow();
  openWindow("head");
  ASSERT_TRUE(settled());
  EXPECT_NEAR(widget<SliceView>("axialView").plane().zoom, zoom, 1e-3);
}

TEST_F(ViewStates, EachChangeOfTheLightIsAStepOfTheOneUndo)
{
  saveBall("ball");
  openWindow("ball");
  auto& exposure = widget<QDoubleSpinBox>("exposure");
  auto& falloff = widget<QDoubleSpinBox>("lightFalloff");
  auto& wetness = widget<QSlider>("wetness");
  auto& soft = widget<QAbstractButton>("softTissue");
  EXPECT_FALSE(action("Undo")->isEnabled()) << "to show a case is no step";
  falloff.setValue(250.0);
  EXPECT_FALSE(window().model().unsaved()) << "as a camera that was moved";
  soft.setChecked(true);
  exposure.setValue(1.5);
  for (const int percent : {10, 20, 40}) // a slider that moves
    wetness.setValue(percent);
  widget<QSlider>("grain").setValue(60);
  for (const char* name : {"shadows", "toneCurve", "exitSurfaces"})
    widget<QAbstractButton>(name).setChecked(true);

  const auto undo = [this](const char* what)
  {
    EXPECT_TRUE(action("Undo")->text().endsWith(what)) << action("Undo")->text().toStdString();
    action("Undo")->trigger();
  };
  undo("exit surfaces");
  EXPECT_FALSE(widget<QAbstractButton>("exitSurfaces").isChecked());
  undo("soft highlights");
  EXPECT_FALSE(widget<QAbstractButton>("toneCurve").isChecked());
  EXPECT_TRUE(widget<QAbstractButton>("shadows").isChecked());
  undo("shadows");
  EXPECT_FALSE(widget<QAbstractButton>("shadows").isChecked());
  undo("grain");
  EXPECT_EQ(widget<QSlider>("grain").value(), 0);
  EXPECT_EQ(wetness.value(), 40);
  undo("wetness");
  EXPECT_EQ(wetness.value(), 0) << "one step";
  undo("exposure");
  EXPECT_EQ(exposure.value(), 0.0);
  EXPECT_TRUE(soft.isChecked());
  undo("show soft tissue");
  EXPECT_FALSE(soft.isChecked());
  EXPECT_EQ(falloff.value(), 250.0);
  undo("light falloff");
  EXPECT_EQ(falloff.value(), 0.0);
  EXPECT_FALSE(action("Undo")->isEnabled());
  for (int n = 0; n < 4; ++n)
    action("Redo")->trigger();
  EXPECT_EQ(falloff.value(), 250.0);
  EXPECT_EQ(exposure.value(), 1.5);
  EXPECT_EQ(wetness.value(), 40);
  EXPECT_FALSE(widget<QAbstractButton>("shadows").isChecked());
}

TEST_F(ViewStates, TheBackgroundIsTheUsersAndCanBeUndone)
{
  const rendering::BackgroundColor white{1.0, 1.0, 1.0};
  saveBall("ball");
  openWindow("ball");
  auto& box = widget<QComboBox>("background");
  const auto isOnLight = [this](const char* name)
  {
    const QList<QLabel*> labels = view().findChildren<QLabel*>(name);
    return !labels.empty() &&
           std::all_of(labels.begin(), labels.end(),
                       [](const QLabel* label) { return label->property("onLight").toBool(); });
  };
  const auto isCorner = [this](const rendering::BackgroundColor& color)
  {
    const QImage shown = view().grabFramebuffer().convertToFormat(QImage::Format_RGB32);
    const QColor at = shown.pixelColor(2, shown.height() - 3); // no letter is drawn in it
    return std::abs(at.redF() - color[0]) < 0.01 && std::abs(at.blueF() - color[2]) < 0.01;
  };
  EXPECT_EQ(box.currentText(), "Dark grey");
  EXPECT_TRUE(waitFor([&] { return isCorner(rendering::kDefaultBackground); }));
  EXPECT_FALSE(isOnLight("direction"));
  box.setCurrentIndex(box.findText("White"));
  EXPECT_EQ(view().display().background(), white);
  EXPECT_FALSE(window().model().unsaved());
  EXPECT_TRUE(waitFor([&] { return isCorner(white); }));
  for (const char* name : {"direction", "caseStamp", "guessed"})
    EXPECT_TRUE(waitFor([&] { return isOnLight(name); })) << name;

  EXPECT_TRUE(action("Undo")->text().endsWith("background"));
  action("Undo")->trigger();
  EXPECT_EQ(box.currentText(), "Dark grey");
  EXPECT_TRUE(waitFor([&] { return isCorner(rendering::kDefaultBackground); }));
  EXPECT_TRUE(waitFor([&] { return !isOnLight("direction"); }));
  action("Redo")->trigger();
  EXPECT_EQ(view().display().background(), white);

  // It is not the case's: the next one has it, too.
  saveBall("plain");
  closeWindow();
  openWindow("plain");
  EXPECT_EQ(widget<QComboBox>("background").currentText(), "White");
  EXPECT_EQ(view().display().background(), white);
}

TEST_F(ViewStates, OneColourAfterAnotherIsChosenForTheBackgroundAndKeysOpenNoDialog)
{
  saveBall("ball");
  openWindow("ball");
  auto& box = widget<QComboBox>("background");
  const auto choose = [this](const QColor& color)
  {
    bool isAsked = false;
    onDialog(
        [&isAsked, color](QDialog& dialog)
        {
          auto* colors = qobject_cast<QColorDialog*>(&dialog);
          if (!colors)
            return false;
          isAsked = true;
          colors->setCurrentColor(color);
          dialog.accept();
          return true;
        });
    widget<QAbstractButton>("otherBackground").click();
    return isAsked;
  };
  const auto isShown = [this](const QColor& color)
  {
    const rendering::BackgroundColor& shown = view().display().background();
    return QColor::fromRgbF(shown[0], shown[1], shown[2]).rgb() == color.rgb();
  };
  const QColor green(0, 96, 32);
  const QColor blue(16, 32, 128);
  ASSERT_TRUE(choose(green));
  EXPECT_TRUE(isShown(green));
  EXPECT_EQ(box.currentText(), "Other colour");
  ASSERT_TRUE(choose(blue)) << "a second one";
  EXPECT_TRUE(isShown(blue));
  EXPECT_EQ(box.currentText(), "Other colour");

  // Past the last name no key goes; a dialog would not come back from here.
  QTest::keyClick(&box, Qt::Key_Up);
  EXPECT_EQ(box.currentText(), "White");
  EXPECT_TRUE(isShown(Qt::white));
  QTest::keyClick(&box, Qt::Key_Down);
  QTest::keyClick(&box, Qt::Key_End);
  EXPECT_EQ(box.currentText(), "White");
  EXPECT_TRUE(isShown(Qt::white));
  EXPECT_FALSE(QApplication::activeModalWidget());
}

// In a narrow view it lies below the letter at the top and the case's name.
TEST_F(ViewStates, ANoteCoversNeitherLettersNorTheCaseAndItsSide)
{
  saveBall("ball");
  openWindow("ball");
  const auto* note = view().findChild<QLabel*>("guessed");
  QList<QLabel*> others = view().findChildren<QLabel*>("direction");
  others += view().findChildren<QLabel*>("caseStamp");
  ASSERT_EQ(others.size(), 5);
  const int besides = 10; // px
  for (const int wide : {20, view().width() / 2, view().width()})
  {
    QString line = "Cut";
    while (note->fontMetrics().horizontalAdvance(line) < wide)
      line += " away";
    view().setNotes({line, line});
    EXPECT_FALSE(note->isHidden());
    if (wide == 20)
    {
      EXPECT_EQ(note->geometry().topLeft(), QPoint(besides, besides)) << "there is room";
    }
    for (const QLabel* other : others)
      if (!other->isHidden())
      {
        EXPECT_FALSE(note->geometry().intersects(other->geometry()))
            << wide << ": " << other->text().toStdString();
      }
  }
  view().setNotes({});
}

TEST_F(ViewStates, SaysThatTheCameraIsInsideTissue)
{
  saveBall("ball");
  openWindow("ball");
  const auto note = [this] { return view().findChild<QLabel*>("guessed"); };
  EXPECT_FALSE(note()->text().contains("inside tissue"));
  const core::CameraPose before = view().picture().camera();
  core::CameraPose buried = before;
  buried.position = value().ct.geometry.patientFromVoxel(
      0.5 * (Eigen::Vector3d(value().ct.geometry.dims()[0], value().ct.geometry.dims()[1],
                             value().ct.geometry.dims()[2]) -
             Eigen::Vector3d::Ones()));
  buried.focalPoint = buried.position + Eigen::Vector3d(5.0, 1.0, 2.0);
  view().setCamera(buried);
  EXPECT_EQ(note()->text(), "The camera is inside tissue: zoom out");
  EXPECT_TRUE(note()->isVisible());
  view().setCamera(before);
  EXPECT_FALSE(note()->isVisible());
}

TEST_F(ViewStates, CutsAwayBeforeTheCrosshairUntilAToolIsTakenUp)
{
  saveBall("ball");
  openWindow("ball");
  const QImage whole = picture();
  action("Cut away to the crosshair")->trigger();
  const QImage cut = picture();
  EXPECT_GT(differentPixels(whole, cut), 1000);
  const auto note = [this] { return view().findChild<QLabel*>("guessed"); };
  EXPECT_EQ(note()->text(), "Cut away for the view, not drilled");
  EXPECT_TRUE(note()->isVisible());
  ASSERT_EQ(value().view.clipping.planes.size(), 1U);
  EXPECT_EQ(value().view.clipping.planes.front().point, window().model().crosshair());
  EXPECT_TRUE(window().model().unsaved());
  ASSERT_TRUE(settled());
  save();
  const auto saved = library().open("ball").view.clipping;
  EXPECT_EQ(saved, value().view.clipping);
  closeWindow();
  openWindow("ball");
  EXPECT_LT(differentPixels(picture(), cut), 50);
  EXPECT_TRUE(note()->isVisible());
  // The surgeon's own window says the same.
  action("Surgeon's window")->trigger();
  const auto surgeons = []
  {
    for (QWidget* widget : QApplication::topLevelWidgets())
      if (auto* found = widget->findChild<ThreeDView*>("surgeonView"))
        return found->findChild<QLabel*>("guessed");
    return static_cast<QLabel*>(nullptr);
  };
  ASSERT_TRUE(surgeons());
  EXPECT_EQ(surgeons()->text(), "Cut away for the view, not drilled");
  EXPECT_FALSE(surgeons()->isHidden());
  QTest::keyClick(&view(), Qt::Key_D); // the tool meets all of the bone
  EXPECT_TRUE(waitFor([&] { return !note()->isVisible(); }));
  EXPECT_TRUE(surgeons()->isHidden());
  action("Drill")->trigger();
  EXPECT_TRUE(waitFor([&] { return note()->isVisible(); }));
  EXPECT_FALSE(surgeons()->isHidden());
  action("Surgeon's window")->trigger();
  EXPECT_TRUE(waitFor([&] { return !surgeons(); }));
  action("Show what was cut away")->trigger();
  EXPECT_FALSE(note()->isVisible());
  EXPECT_LT(differentPixels(picture(), whole), 50);
}
