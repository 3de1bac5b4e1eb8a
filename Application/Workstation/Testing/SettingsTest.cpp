#include "DeviceTest.h"

#include <algorithm>

#include <QAction>
#include <QCheckBox>
#include <QDockWidget>
#include <QDoubleSpinBox>
#include <QSlider>
#include <QSpinBox>

#include "Bind.h"
#include "SliceColumn.h"
#include "WindowSettings.h"
#include "petrous/Presenters/CatalogueEditor.h"

using namespace petrous;
using namespace petrous::workstation;

namespace
{

class Settings : public DeviceTest
{
protected:
  template <class Widget>
  Widget& widget(const char* name)
  {
    return *window().findChild<Widget*>(name);
  }
};

} // namespace

TEST_F(Settings, HandAndPictureComeBackInTheNextWindow)
{
  saveBall("ball");
  bench.play(kPlugCap);
  openWindow();
  EXPECT_EQ(widget<QDoubleSpinBox>("thrust").value(), 1.0);
  widget<QDoubleSpinBox>("thrust").setValue(2.5);
  widget<QDoubleSpinBox>("lightFalloff").setValue(120.0);
  widget<QSlider>("wetness").setValue(40);
  widget<QSlider>("edges").setValue(70);
  widget<QSlider>("grain").setValue(30);
  widget<QAbstractButton>("shadows").click();
  widget<QDoubleSpinBox>("exposure").setValue(-1.5);
  widget<QAbstractButton>("toneCurve").click();
  widget<QAbstractButton>("exitSurfaces").click();
  widget<QComboBox>("background")
      .setCurrentIndex(widget<QComboBox>("background").findText("White"));
  widget<QDoubleSpinBox>("eyeSeparation").setValue(22.0);
  auto& stereo = widget<QComboBox>("stereoMode");
  stereo.setCurrentIndex(stereo.findText("Anaglyph (red-cyan)"));
  choose("SpaceMouse Compact");
  ASSERT_TRUE(waitFor([this] { return widget<QDoubleSpinBox>("deviceScale").isVisible(); }));
  EXPECT_EQ(widget<QDoubleSpinBox>("deviceScale").value(), 0.25);
  widget<QDoubleSpinBox>("deviceScale").setValue(0.4);
  closeWindow();

  openWindow();
  EXPECT_EQ(widget<QDoubleSpinBox>("thrust").value(), 2.5);
  // The saved case has no light of its own and is lit as `petrous render` draws it; the user's is
  // for new cases.
  EXPECT_EQ(widget<QDoubleSpinBox>("lightFalloff").value(), 0.0);
  EXPECT_EQ(widget<QSlider>("wetness").value(), 0);
  EXPECT_EQ(widget<QSlider>("edges").value(), 0);
  EXPECT_EQ(widget<QSlider>("grain").value(), 0);
  EXPECT_FALSE(widget<QAbstractButton>("shadows").isChecked());
  EXPECT_EQ(widget<QDoubleSpinBox>("exposure").value(), 0.0);
  EXPECT_FALSE(widget<QAbstractButton>("toneCurve").isChecked());
  EXPECT_FALSE(widget<QAbstractButton>("exitSurfaces").isChecked());
  presenters::ViewSettings kept;
  WindowSettings(QString::fromStdString((folder() / "settings.conf").string()))
      .restore(kept, false);
  EXPECT_EQ(kept.light().falloff, 120.0);
  EXPECT_NEAR(kept.light().wetness, 0.4, 1e-9);
  EXPECT_NEAR(kept.light().edges, 0.7, 1e-9);
  EXPECT_NEAR(kept.light().grain, 0.3, 1e-9);
  EXPECT_TRUE(kept.light().shadows);
  EXPECT_EQ(kept.light().exposure, -1.5);
  EXPECT_TRUE(kept.light().toneCurve);
  EXPECT_TRUE(kept.light().exitSurfaces);
  EXPECT_EQ(widget<QComboBox>("background").currentText(), "White");
  EXPECT_EQ(view().display().background(), (rendering::BackgroundColor{1.0, 1.0, 1.0}));
  EXPECT_EQ(widget<QDoubleSpinBox>("eyeSeparation").value(), 22.0);
  EXPECT_EQ(widget<QDoubleSpinBox>("convergence").value(), 0.0);
  EXPECT_EQ(widget<QComboBox>("stereoMode").currentText(), "Anaglyph (red-cyan)");
  EXPECT_EQ(view().display().stereo(), rendering::StereoMode::Anaglyph);
  EXPECT_EQ(choice().currentText(), "Mouse");
  choose("SpaceMouse Compact");
  ASSERT_TRUE(waitFor([this] { return widget<QDoubleSpinBox>("deviceScale").isVisible(); }));
  EXPECT_EQ(widget<QDoubleSpinBox>("deviceScale").value(), 0.4);
}

TEST_F(Settings, PanelsComeBackAsTheyWereLeft)
{
  saveBall("ball");
  openWindow();
  QTest::keyClick(&window(), Qt::Key_F7);
  QTest::keyClick(&window(), Qt::Key_F8); // raised
  QTest::keyClick(&window(), Qt::Key_F8); // hidden
  EXPECT_FALSE(widget<QDockWidget>("nearbyDock").isHidden());
  EXPECT_TRUE(widget<QDockWidget>("pictureDock").isHidden());
  closeWindow();
  openWindow();
  EXPECT_TRUE(widget<QDockWidget>("nearbyDock").isVisible());
  EXPECT_TRUE(widget<QDockWidget>("pictureDock").isHidden());
  EXPECT_TRUE(widget<QDockWidget>("structuresDock").isVisible());
  EXPECT_TRUE(widget<QDockWidget>("registrationDock").isHidden());
}

TEST_F(Settings, PanelsStayWhenACaseIsClosedAndAreKeptWithoutQuitting)
{
  saveBall("ball");
  saveBall("another");
  openWindow("ball");
  const auto inFront = [this](const char* name)
  { return !widget<QDockWidget>(name).visibleRegion().isEmpty(); };
  QTest::keyClick(&window(), Qt::Key_F7);
  QTest::keyClick(&window(), Qt::Key_F10);
  ASSERT_TRUE(waitFor([&] { return inFront("appearanceDock") && !inFront("structuresDock"); }));
  action("Close the case")->trigger();
  ASSERT_TRUE(waitFor([this] { return !window().model().hasCase() && !window().busy(); }));
  window().begin("another");
  ASSERT_TRUE(waitFor([this] { return window().model().hasCase() && !window().busy(); }));
  EXPECT_TRUE(waitFor([&] { return inFront("appearanceDock") && inFront("nearbyDock"); }));
  EXPECT_FALSE(inFront("structuresDock"));
  // What a program that is killed leaves: the file.
  const QString file = QString::fromStdString((folder() / "settings.conf").string());
  EXPECT_TRUE(waitFor(
      [&]
      {
        const auto front = WindowSettings(file).panelsInFront();
        const auto has = [&](const char* name)
        {
          return std::any_of(front.begin(), front.end(),
                             [&](const auto& one) {
                               return one.first == name &&
                                      one.second == widget<QDockWidget>(name).size();
                             });
        };
        return front.size() == 2 && has("appearanceDock") && has("nearbyDock");
      }));
  EXPECT_TRUE(WindowSettings(file).panelShown("appearanceDock", false));
  closeWindow();
  openWindow("ball");
  EXPECT_TRUE(waitFor([&] { return inFront("appearanceDock") && inFront("nearbyDock"); }));
  EXPECT_FALSE(inFront("structuresDock"));
}

TEST_F(Settings, TheBurrComesBackInTheNextWindowAndTheSlicesWithTheirCase)
{
  saveBall("ball");
  openWindow();
  auto& kind = widget<QComboBox>("burrKind");
  EXPECT_EQ(kind.currentText(), "Cutting");
  kind.setCurrentIndex(kind.findText("Diamond"));
  widget<QDoubleSpinBox>("burrDiameter").setValue(3.0);
  widget<QSpinBox>("spindleSpeed").setValue(45);
  auto& model = const_cast<presenters::WorkstationModel&>(window().model());
  const Eigen::Vector3d there = kBallCenter + Eigen::Vector3d(3.25, -2.0, 5.0);
  model.setCrosshair(there);
  action("Soft tissue window")->trigger();
  QTest::keyClick(&window(), Qt::Key_S, Qt::ControlModifier);
  EXPECT_TRUE(settled());
  closeWindow();

  openWindow();
  EXPECT_EQ(widget<QComboBox>("burrKind").currentText(), "Diamond");
  EXPECT_EQ(widget<QDoubleSpinBox>("burrDiameter").value(), 3.0);
  EXPECT_EQ(widget<QSpinBox>("spindleSpeed").value(), 45);
  EXPECT_LT((window().model().crosshair() - there).norm(), 1e-9);
  EXPECT_EQ(widget<SliceColumn>("slices").shown().width, 400.0);
  EXPECT_EQ(widget<SliceColumn>("slices").shown().level, 40.0);
  saveBall("another"); // begins in its middle, with the window for bone
  const_cast<presenters::WorkstationModel&>(window().model()).open("another");
  EXPECT_LT((window().model().crosshair() - kBallCenter).norm(), 1e-9);
  EXPECT_EQ(widget<SliceColumn>("slices").shown().width, 4000.0);
}

// The catalogue comes with the library of the case, after the window.
TEST_F(Settings, ABurrOfTheLibraryComesBackInItsDiameterAndOutlivesALibraryWithoutIt)
{
  saveBall("ball");
  const std::filesystem::path library = folder() / "library";
  const std::filesystem::path burrs = library / "burrs.json";
  {
    presenters::CatalogueEditor editor(library);
    const std::size_t row = editor.addBurr(1);
    auto fine = editor.burrs()[row];
    fine.name = "fine";
    fine.diameters = {0.5, 0.8};
    editor.setBurr(row, fine);
    editor.save();
  }
  openWindow("ball");
  auto& kind = widget<QComboBox>("burrKind");
  kind.setCurrentIndex(kind.findText("fine"));
  widget<QDoubleSpinBox>("burrDiameter").setValue(0.5);
  closeWindow();

  openWindow("ball");
  EXPECT_EQ(widget<QComboBox>("burrKind").currentText(), "fine");
  EXPECT_EQ(widget<QDoubleSpinBox>("burrDiameter").value(), 0.5);
  closeWindow();

  std::filesystem::rename(burrs, folder() / "burrs.json");
  openWindow("ball");
  EXPECT_EQ(widget<QComboBox>("burrKind").currentText(), "Diamond");
  widget<QSpinBox>("spindleSpeed").setValue(45); // of whatever burr
  closeWindow();

  std::filesystem::rename(folder() / "burrs.json", burrs);
  openWindow("ball");
  EXPECT_EQ(widget<QComboBox>("burrKind").currentText(), "fine");
  EXPECT_EQ(widget<QDoubleSpinBox>("burrDiameter").value(), 0.5);
  EXPECT_EQ(widget<QSpinBox>("spindleSpeed").value(), 45);
}

TEST_F(Settings, WhatNobodyUnderstandsIsTheUsual)
{
  const QString file = QString::fromStdString((folder() / "odd.conf").string());
  std::ofstream(file.toStdString())
      << "[light]\nfalloff_mm=nan\nwetness=lots\nexposure_ev=inf\nbackground=pink\n[stereo]\n"
         "mode=holographic\neye_separation_mm=-5\n[hand]\nthrust_n=x\n"
         "[burr]\ndiameter_mm=4\nrpm=60000\nkind=laser\n";
  WindowSettings settings(file);
  presenters::ViewSettings view;
  settings.restore(view, true);
  EXPECT_EQ(view.light().falloff, 0.0);
  EXPECT_EQ(view.light().wetness, 0.0);
  EXPECT_EQ(view.light().exposure, 0.0);
  EXPECT_EQ(view.background(), rendering::kDefaultBackground);
  EXPECT_EQ(view.stereo(), rendering::StereoMode::None);
  EXPECT_EQ(view.rig().eyeSeparation, 0.0); // clamped to its limits, as a user's value is
  EXPECT_FALSE(settings.thrust());
  EXPECT_FALSE(settings.burr());
  openWindow();
}

TEST_F(Settings, ABurrIsKeptByItsNameAndAnEarlierFilesByItsKind)
{
  const QString file = QString::fromStdString((folder() / "burr.conf").string());
  std::ofstream(file.toStdString()) << "[burr]\ndiameter_mm=3\nrpm=60000\nkind=diamond\n";
  WindowSettings settings(file);
  ASSERT_TRUE(settings.burr());
  EXPECT_EQ(settings.burr()->kind, dissection::Burr::Kind::Diamond);
  EXPECT_TRUE(settings.burr()->name.empty());
  dissection::Burr own = *settings.burr();
  own.name = "coarse-diamond";
  settings.keepBurr(own);
  EXPECT_EQ(settings.burr()->name, "coarse-diamond");
  EXPECT_EQ(settings.burr()->kind, dissection::Burr::Kind::Diamond);
  own.name.clear();
  settings.keepBurr(own);
  EXPECT_TRUE(settings.burr()->name.empty());
}

TEST_F(Settings, AModeThatTheDriverHasNotIsNotTaken)
{
  WindowSettings settings(QString::fromStdString((folder() / "quad.conf").string()));
  presenters::ViewSettings view;
  view.setStereo(rendering::StereoMode::QuadBuffer);
  settings.keep(view);
  presenters::ViewSettings with;
  settings.restore(with, true);
  EXPECT_EQ(with.stereo(), rendering::StereoMode::QuadBuffer);
  presenters::ViewSettings without;
  settings.restore(without, false);
  EXPECT_EQ(without.stereo(), rendering::StereoMode::None);
  openWindow();
}

TEST(Bindings, ShowWhatWasTakenAndSetNothingByShowing)
{
  Bindings bound;
  double value = 3.0;
  int sets = 0;
  const std::unique_ptr<QDoubleSpinBox> box(
      numberBox("box", "how far", {0.0, 10.0, " mm", 2, 0.5}));
  bound.add(
      box.get(), [&] { return value; },
      [&](double entered)
      {
        value = std::min(entered, 5.0);
        ++sets;
      });
  bound.refresh();
  EXPECT_EQ(box->text(), "3.00 mm");
  box->setValue(8.0);
  EXPECT_EQ(value, 5.0);
  EXPECT_EQ(box->value(), 5.0) << "what was taken";
  EXPECT_EQ(sets, 1);
  value = 4.0;
  bound.refresh();
  EXPECT_EQ(box->value(), 4.0);
  bound.quietly([&] { box->setRange(6.0, 10.0); });
  EXPECT_EQ(value, 4.0);
  EXPECT_EQ(sets, 1);
}

TEST(Bindings, MakeOneChangeOfASliderThatMoves)
{
  Bindings bound;
  int value = 10, sets = 0;
  const std::unique_ptr<QSlider> slider(percentSlider("slider", {}));
  bound.add(
      slider.get(), [&] { return value; },
      [&](int entered)
      {
        value = entered;
        ++sets;
      },
      Bindings::kSettle);
  bound.refresh();
  EXPECT_EQ(slider->value(), 10);
  for (const int at : {20, 30, 40})
    slider->setValue(at);
  EXPECT_EQ(sets, 0);
  bound.refresh(); // something else changed
  EXPECT_EQ(slider->value(), 40) << "not set yet, not taken back";
  EXPECT_TRUE(QTest::qWaitFor([&] { return sets > 0; }, 60000));
  EXPECT_EQ(value, 40);
  EXPECT_EQ(sets, 1);
  slider->setValue(50);
  bound.drop();
  bound.refresh();
  EXPECT_EQ(slider->value(), 40);
}

TEST(Bindings, CoupleChoicesAndSwitches)
{
  Bindings bound;
  int row = 1;
  bool on = true;
  const std::unique_ptr<QComboBox> choice(choiceBox("choice", {}));
  choice->addItems({"none", "some", "all"});
  QAction action;
  QCheckBox check;
  action.setCheckable(true);
  bound.add(
      choice.get(), [&] { return row; }, [&](int chosen) { row = chosen; });
  bound.add(
      &action, [&] { return on; }, [&](bool checked) { on = checked && row > 0; });
  bound.add(
      &check, [&] { return on; }, [&](bool checked) { on = checked; });
  bound.refresh();
  EXPECT_EQ(choice->currentText(), "some");
  EXPECT_TRUE(action.isChecked());
  check.click();
  EXPECT_FALSE(on);
  EXPECT_FALSE(action.isChecked()) << "it shows the same value";
  choice->setCurrentIndex(0);
  EXPECT_EQ(row, 0);
  action.trigger();
  EXPECT_FALSE(action.isChecked()) << "refused";
}
