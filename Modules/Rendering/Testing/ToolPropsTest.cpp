#include <cmath>

#include "PictureComparison.h"
#include "PictureScenes.h"
#include "petrous/Rendering/ToolShape.h"

using namespace petrous;
using namespace petrous::rendering;
using namespace petrous::rendering::synthetic;

// The handpiece begins 30 mm from the burr, 10 degrees from the line of sight: it covers the burr,
// and goes on to the right of it.
TEST(ToolProps, TheHandpieceFadesTowardsTheFieldThatItHides)
{
  constexpr double kAway = 300.0; // mm
  ToolPose tool;
  tool.center = {3.0, 5.0, -2.0};
  const double tilt = 10.0 * M_PI / 180.0;
  tool.axisToHand = {std::sin(tilt), -std::cos(tilt), 0.0};
  core::CameraPose pose = from(tool.center - Vector(0.0, kAway, 0.0), tool.center);
  pose.viewUp = {0.0, 0.0, 1.0};
  constexpr double kMm = 0.4; // a pixel, at the burr
  pose.viewAngle = 2.0 * std::atan(0.5 * kMm * kHeight / kAway) * 180.0 / M_PI;
  for (const bool parallel : {false, true})
  {
    if (parallel)
      pose.parallelScale = 0.5 * kMm * kHeight;
    ScenePicture scene;
    scene.setContents({});
    scene.setCamera(pose);
    OffscreenView view(kWidth, kHeight);
    view.render(scene);
    const auto drawn = [&](bool handpiece, bool fades)
    {
      ToolPose shown = tool;
      shown.handpiece = handpiece;
      scene.setTool(shown, fades);
      return view.render(scene);
    };
    const Picture whole = drawn(true, false);
    const Picture none = drawn(false, false);
    const Picture faded = drawn(true, true);
    const double field = tool.radius + tool::kField;
    std::array<int, 6> covered{}, seen{}; // by distance from the burr: thirds of the border
    for (int row = 0; row < kHeight; ++row)
      for (int column = 0; column < kWidth; ++column)
      {
        const auto same = [&](const Picture& a, const Picture& b) {
          return std::equal(a.pixel(column, row), a.pixel(column, row) + 3, b.pixel(column, row));
        };
        if (same(whole, none))
          continue;
        const double mm = kMm * std::hypot(column - 0.5 * (kWidth - 1), row - 0.5 * (kHeight - 1));
        const auto ring =
            static_cast<std::size_t>(std::clamp(3.0 * (mm / field - 1.0) + 1.0, 0.0, 4.99));
        ++covered[ring];
        seen[ring] += !same(faded, none);
        EXPECT_TRUE(same(faded, none) || same(faded, whole)) << "a screen door";
      }
    for (std::size_t ring = 0; ring < 5; ++ring)
      ASSERT_GT(covered[ring], 60) << ring;
    const auto share = [&](std::size_t ring) { return double(seen[ring]) / covered[ring]; };
    EXPECT_EQ(seen[0], 0) << "nothing before the field";
    EXPECT_NEAR(share(1), 0.11, 0.08); // means of smoothstep over its thirds
    EXPECT_NEAR(share(2), 0.5, 0.12);
    EXPECT_NEAR(share(3), 0.89, 0.08);
    EXPECT_EQ(seen[4], covered[4]);

    // Behind the burr it hides nothing.
    tool.axisToHand = -tool.axisToHand;
    EXPECT_EQ(countDifferentPixels(drawn(true, true), drawn(true, false)), 0U);
    tool.axisToHand = -tool.axisToHand;
  }
}
