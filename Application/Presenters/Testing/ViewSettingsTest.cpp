#include "petrous/Presenters/ViewSettings.h"

#include <limits>

#include <gtest/gtest.h>

using petrous::presenters::ViewSettings;
using petrous::rendering::StereoMode;

TEST(ViewSettings, TellsOnlyWhatChanged)
{
  ViewSettings settings;
  int lights = 0;
  int stereos = 0;
  settings.events.lightChanged = [&lights] { ++lights; };
  settings.events.stereoChanged = [&stereos] { ++stereos; };
  settings.setWetness(0.5);
  settings.setWetness(0.5);
  settings.setFalloff(0.0); // unchanged
  EXPECT_EQ(lights, 1);
  settings.setStereo(StereoMode::Anaglyph);
  settings.setStereo(StereoMode::Anaglyph);
  settings.setEyeSeparation(24.0);
  settings.setEyeSeparation(std::nullopt);
  EXPECT_EQ(stereos, 3);
}

TEST(ViewSettings, ExposureAndToneCurveComeBackFromASavedView)
{
  ViewSettings settings;
  int lights = 0;
  settings.events.lightChanged = [&lights] { ++lights; };
  settings.setExposure(1.0 / 3.0);
  settings.setToneCurve(true);
  settings.setToneCurve(true);
  settings.setEdges(0.25);
  settings.setGrain(0.125);
  settings.setExitSurfaces(true);
  EXPECT_EQ(lights, 5);
  petrous::scene::ViewState view;
  view.light = settings.lightState();
  ViewSettings other, copy;
  other.take(view, false);
  copy.take(other);
  EXPECT_EQ(copy.light().exposure, 1.0 / 3.0);
  EXPECT_TRUE(copy.light().toneCurve);
  EXPECT_EQ(copy.light().edges, 0.25);
  EXPECT_EQ(copy.light().grain, 0.125);
  EXPECT_TRUE(copy.light().exitSurfaces);
  view.light.emplace(); // as saved before there was any
  copy.take(view, false);
  EXPECT_EQ(copy.light().exposure, 0.0);
  EXPECT_FALSE(copy.light().toneCurve);
  EXPECT_EQ(copy.light().edges, 0.0);
  EXPECT_EQ(copy.light().grain, 0.0);
  EXPECT_FALSE(copy.light().exitSurfaces);
}

// It is the user's: a case that is shown neither has nor changes it.
TEST(ViewSettings, TheBackgroundIsNotOfASavedView)
{
  using petrous::rendering::BackgroundColor;
  ViewSettings settings;
  int backgrounds = 0;
  settings.events.backgroundChanged = [&backgrounds] { ++backgrounds; };
  EXPECT_EQ(settings.background(), petrous::rendering::kDefaultBackground);
  settings.setBackground({1.0, 1.0, 1.0});
  settings.setBackground({1.0, 1.0, 1.0});
  EXPECT_EQ(backgrounds, 1);
  petrous::scene::ViewState view;
  view.light.emplace();
  settings.take(view, false);
  EXPECT_EQ(settings.background(), (BackgroundColor{1.0, 1.0, 1.0}));
  ViewSettings copy;
  copy.take(settings);
  EXPECT_EQ(copy.background(), (BackgroundColor{1.0, 1.0, 1.0}));
  settings.setBackground({-1.0, 0.5, 7.0});
  EXPECT_EQ(settings.background(), (BackgroundColor{0.0, 0.5, 1.0}));
}

TEST(ViewSettings, HoldsValuesWithinTheirLimits)
{
  ViewSettings settings;
  settings.setWetness(7.0);
  EXPECT_EQ(settings.light().wetness, 1.0);
  settings.setEdges(-1.0);
  EXPECT_EQ(settings.light().edges, 0.0);
  settings.setGrain(3.0);
  EXPECT_EQ(settings.light().grain, 1.0);
  settings.setFalloff(std::numeric_limits<double>::quiet_NaN());
  EXPECT_EQ(settings.light().falloff, 0.0);
  settings.setExposure(-7.0);
  EXPECT_EQ(settings.light().exposure, -4.0);
  settings.setExposure(std::numeric_limits<double>::quiet_NaN());
  EXPECT_EQ(settings.light().exposure, 0.0);
  settings.setEyeSeparation(1e6);
  EXPECT_EQ(settings.rig().eyeSeparation, 200.0);
  settings.setConvergence(0.0);
  EXPECT_EQ(settings.rig().convergence, 1.0);
}

TEST(ViewSettings, NamesWhatChangedOfTheLight)
{
  using petrous::presenters::lightEdit;
  const petrous::scene::ViewState::Light before{};
  auto after = before;
  after.exposure = 1.0;
  EXPECT_EQ(lightEdit(before, after).what, "exposure");
  EXPECT_TRUE(lightEdit(before, after).isContinuous);
  after = before;
  after.grain = 0.5;
  EXPECT_EQ(lightEdit(before, after).what, "grain");
  EXPECT_TRUE(lightEdit(before, after).isContinuous);
  after = before;
  after.shadows = !before.shadows;
  EXPECT_EQ(lightEdit(before, after).what, "shadows");
  EXPECT_FALSE(lightEdit(before, after).isContinuous) << "each click is a step";
  after.wetness = 0.5;
  EXPECT_EQ(lightEdit(before, after).what, "light");
  EXPECT_FALSE(lightEdit(before, after).isContinuous);
}
