#include "petrous/Rendering/OffscreenView.h"

#include <cstdlib>
#include <iostream>

#include <gtest/gtest.h>

#include "SyntheticScenes.h"
#include "petrous/Rendering/RenderingError.h"
#include "petrous/Rendering/StandardViews.h"

using namespace petrous;
using namespace petrous::rendering;

namespace
{
SceneContents ballScene()
{
  SceneContents contents;
  contents.ct = synthetic::ball(synthetic::cube(40, 0.5), 7.0);
  return contents;
}
} // namespace

TEST(OffscreenView, DrawsWithoutADisplay)
{
  ::unsetenv("DISPLAY");
  ::unsetenv("WAYLAND_DISPLAY");
  OffscreenView view(64, 48);
  EXPECT_FALSE(view.glRenderer().empty());
  ScenePicture scene;
  scene.setContents(ballScene());
  scene.setCamera(standardCamera(StandardView::Anterior, ballScene().ct->geometry()));
  const Picture picture = view.render(scene);
  EXPECT_EQ(picture.width, 64);
  EXPECT_EQ(picture.height, 48);
  EXPECT_GT(int{picture.pixel(32, 24)[0]}, 150);
  EXPECT_LT(int{picture.pixel(0, 0)[0]}, 40);
  EXPECT_GT(view.firstFrameMilliseconds(), 0.0);
}

TEST(OffscreenView, GivesTheSamePixelsInANewContext)
{
  const SceneContents contents = ballScene();
  const auto draw = [&]
  {
    ScenePicture scene;
    scene.setContents(contents);
    scene.setCamera(standardCamera(StandardView::Left, contents.ct->geometry()));
    OffscreenView view(160, 120);
    return view.render(scene);
  };
  EXPECT_EQ(countDifferentPixels(draw(), draw()), 0U);
}

TEST(OffscreenView, TwoViewsCanLiveAtOnce)
{
  const SceneContents contents = ballScene();
  OffscreenView first(80, 60);
  OffscreenView second(80, 60);
  ScenePicture one;
  ScenePicture other;
  one.setContents(contents);
  other.setContents(contents);
  const auto pose = standardCamera(StandardView::Superior, contents.ct->geometry());
  one.setCamera(pose);
  other.setCamera(pose);
  const Picture a = first.render(one);
  const Picture b = second.render(other);
  EXPECT_EQ(countDifferentPixels(a, b), 0U);
  EXPECT_EQ(countDifferentPixels(a, first.render(one)), 0U);
}

TEST(OffscreenView, ASceneCanEndBeforeItsView)
{
  OffscreenView view(80, 60);
  {
    ScenePicture scene;
    scene.setContents(ballScene());
    view.render(scene);
  }
  ScenePicture next;
  next.setContents(ballScene());
  next.setCamera(standardCamera(StandardView::Left, ballScene().ct->geometry()));
  EXPECT_GT(int{view.render(next).pixel(40, 30)[0]}, 150);
}

TEST(OffscreenView, RefusesImpossibleSizes)
{
  EXPECT_THROW(OffscreenView(0, 10), RenderingError);
  EXPECT_THROW(OffscreenView(10, -1), RenderingError);
  EXPECT_THROW(OffscreenView(100000, 10), RenderingError);
}

TEST(OffscreenViewDeathTest, SaysWhatToInstallWhereNoDriverIs)
{
  testing::FLAGS_gtest_death_test_style = "threadsafe"; // new process: EGL loads drivers only once
  const auto drawWithoutDriver = []
  {
    ::setenv("__EGL_VENDOR_LIBRARY_FILENAMES", "/nonexistent/none.json", 1);
    try
    {
      OffscreenView view(8, 8);
    }
    catch (const RenderingError& error)
    {
      std::cerr << error.what() << std::endl;
      std::_Exit(error.reason == RenderingError::Reason::NoOpenGL ? 7 : 8);
    }
    std::_Exit(9);
  };
  EXPECT_EXIT(drawWithoutDriver(), testing::ExitedWithCode(7), "apt install libegl1");
}
