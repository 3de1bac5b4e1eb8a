#include "petrous/Rendering/OffscreenView.h"

#include <cstdlib>
#include <iostream>
#include <map>
#include <string>

#include <gtest/gtest.h>

#include "PictureScenes.h"
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

// All that the card held for the picture went with the context: CT, mask, labels, MR, what stops
// the light, the instrument's field, meshes.
TEST(OffscreenView, APictureOutlivesItsContextAndIsDrawnAgainAsItWas)
{
  SceneContents contents = synthetic::fullScene();
  contents.light.setShadows(true);
  MeshContents mesh;
  mesh.name = "plate";
  mesh.mesh = synthetic::boxMesh({-8.0, -8.0, -6.0}, {8.0, -7.0, 6.0});
  mesh.drilled = true;
  contents.meshes = {mesh};
  ToolPose tool;
  tool.center = {2.0, -7.0, 3.0};
  tool.axisToHand = -Eigen::Vector3d::UnitY();
  tool.instrument = synthetic::boxMesh({-1.0, -1.5, 0.0}, {1.0, 1.5, 30.0});
  tool.rotation = Eigen::Quaterniond::FromTwoVectors(Eigen::Vector3d::UnitZ(), tool.axisToHand);
  contents.tool = tool;
  ScenePicture scene;
  scene.setContents(contents);
  const core::CameraPose pose = synthetic::from({20.0, -40.0, 15.0}, {0.0, -3.0, 0.0}, 26.0);
  scene.setCamera(pose);
  Picture before;
  std::map<std::string, std::size_t> held;
  {
    OffscreenView lost(96, 72);
    before = lost.render(scene);
    held = scene.resources();
  }
  EXPECT_EQ(scene.renderer(), nullptr) << "it went with its window";
  for (const char* name : {"ct.texture", "mask.texture", "labels.texture", "mr.texture",
                           "light.opacities", "light.instrument"})
    EXPECT_GT(held[name], 0U) << name;
  held.erase("light.instrument"); // counted from the next frame on
  for (int n = 0; n < 2; ++n)     // the second as well
  {
    OffscreenView next(96, 72);
    EXPECT_EQ(countDifferentPixels(next.render(scene), before), 0U) << n;
    auto holds = scene.resources();
    holds.erase("light.instrument");
    EXPECT_EQ(holds, held) << n;
  }
  // An edit made while there was no context is in the next one.
  const auto more = synthetic::cut(contents.ct->geometry(), [](const Eigen::Vector3d& p)
                                   { return (p - Eigen::Vector3d(0.0, -8.0, 0.0)).norm() - 5.0; });
  scene.maskChanged(more, contents.ct->geometry().fullBox());
  OffscreenView next(96, 72);
  const Picture after = next.render(scene);
  EXPECT_GT(countDifferentPixels(after, before), 50U);
  ScenePicture anew;
  contents.mask = more;
  anew.setContents(contents);
  anew.setCamera(pose);
  OffscreenView fresh(96, 72);
  EXPECT_EQ(countDifferentPixels(fresh.render(anew), after), 0U);
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
