#include "petrous/Rendering/PrintPicture.h"

#include <cstdlib>

#include "PictureComparison.h"
#include "PictureScenes.h"
#include "petrous/Core/Error.h"

using namespace petrous;
using namespace petrous::rendering;
using namespace petrous::rendering::synthetic;

namespace
{

struct Difference
{
  std::size_t pixels = 0; ///< by more than a level in a channel: of rounding there is one
  int largest = 0;
};

Difference differenceOf(const Picture& a, const Picture& b)
{
  Difference difference;
  for (std::size_t n = 0; n < a.rgb.size(); n += 3)
  {
    int largest = 0;
    for (std::size_t c = 0; c < 3; ++c)
      largest = std::max(largest, std::abs(int(a.rgb[n + c]) - int(b.rgb[n + c])));
    difference.pixels += largest > 1 ? 1 : 0;
    difference.largest = std::max(difference.largest, largest);
  }
  return difference;
}

} // namespace

// 200 x 150 is no multiple of the tiles, and 64 x 64 has 12 of them, with structures and a lens
// that is shifted already.
TEST(TiledPicture, IsThePictureThatIsDrawnAtOnce)
{
  constexpr int kColumns = 200, kRows = 150;
  for (const bool parallel : {false, true})
  {
    core::CameraPose pose = slanting();
    pose.lensShift = 0.1;
    if (parallel)
      pose.parallelScale = 13.0;
    ScenePicture scene;
    scene.setContents(fullScene());
    scene.setCamera(pose);
    OffscreenView view(kColumns, kRows);
    const Picture whole = view.render(scene);
    const Picture tiled = renderTiled(scene, pose, kColumns, kRows, {}, 64);
    ASSERT_EQ(tiled.width, kColumns);
    ASSERT_EQ(tiled.height, kRows);
    ASSERT_EQ(tiled.rgb.size(), whole.rgb.size());
    const Difference difference = differenceOf(whole, tiled);
    EXPECT_LE(difference.pixels, std::size_t(kColumns * kRows / 500)) << difference.largest;
    // And afterwards the scene is as it was.
    EXPECT_LE(differenceOf(whole, view.render(scene)).pixels, 0U);
    EXPECT_NEAR(scene.camera().viewAngle, pose.viewAngle, 1e-9);
  }
}

TEST(TiledPicture, CanBeCancelledBetweenTiles)
{
  ScenePicture scene;
  scene.setContents(fullScene());
  const auto token = std::make_shared<core::CancelToken>();
  int tiles = 0;
  const core::Progress progress(
      [&](double, const std::string&)
      {
        if (++tiles == 2)
          token->cancel();
      },
      token);
  EXPECT_THROW(renderTiled(scene, slanting(), 200, 150, progress, 64), core::CancelledError);
  EXPECT_LE(tiles, 3);
  EXPECT_THROW(renderTiled(scene, slanting(), 20000, 150), core::InvalidParameter);
}
