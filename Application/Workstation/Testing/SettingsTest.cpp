#include "DeviceTest.h"

#include <QDoubleSpinBox>
#include <QSlider>

#include "WindowSettings.h"

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
  EXPECT_EQ(widget<QDoubleSpinBox>("lightFalloff").value(), 120.0);
  EXPECT_EQ(widget<QSlider>("wetness").value(), 40);
  EXPECT_EQ(widget<QDoubleSpinBox>("eyeSeparation").value(), 22.0);
  EXPECT_EQ(widget<QDoubleSpinBox>("convergence").value(), 0.0);
  EXPECT_EQ(widget<QComboBox>("stereoMode").currentText(), "Anaglyph (red-cyan)");
  EXPECT_EQ(view().display().stereo(), rendering::StereoMode::Anaglyph);
  EXPECT_EQ(choice().currentText(), "Mouse");
  choose("SpaceMouse Compact");
  ASSERT_TRUE(waitFor([this] { return widget<QDoubleSpinBox>("deviceScale").isVisible(); }));
  EXPECT_EQ(widget<QDoubleSpinBox>("deviceScale").value(), 0.4);
}

TEST_F(Settings, WhatNobodyUnderstandsIsTheUsual)
{
  const QString file = QString::fromStdString((folder() / "odd.conf").string());
  std::ofstream(file.toStdString())
      << "[light]\nfalloff_mm=nan\nwetness=lots\n[stereo]\n"
         "mode=holographic\neye_separation_mm=-5\n[hand]\nthrust_n=x\n";
  WindowSettings settings(file);
  presenters::ViewSettings view;
  settings.restore(view, true);
  EXPECT_EQ(view.light().falloff, 0.0);
  EXPECT_EQ(view.light().wetness, 0.0);
  EXPECT_EQ(view.stereo(), rendering::StereoMode::None);
  EXPECT_EQ(view.rig().eyeSeparation, 0.0); // clamped to its limits, as a user's value is
  EXPECT_FALSE(settings.thrust());
  openWindow();
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
