#include "petrous/Rendering/StereoPicture.h"

#include <gtest/gtest.h>
#include <vtkNew.h>
#include <vtkRenderer.h>

#include "PictureComparison.h"
#include "WindowPicture.h"
#include "petrous/Rendering/EglRenderWindow.h"
#include "petrous/Rendering/GraphicsReport.h"

using namespace petrous;
using namespace petrous::rendering;
using namespace petrous::rendering::synthetic;

namespace
{

SceneContents ballWithTool()
{
  SceneContents contents;
  contents.ct = synthetic::ball(synthetic::cube(48, 0.5), 9.0);
  contents.tool = ToolPose{{2.0, -8.0, 4.0}, {0.3, -0.9, 0.3}, 2.0, false};
  return contents;
}

// A window as in the application: one renderer, one picture.
class StereoWindow
{
public:
  explicit StereoWindow(int width = kWidth, int height = kHeight)
  {
    m_window->SetSize(width, height);
    m_window->SetMultiSamples(0);
    m_window->AddRenderer(m_renderer);
    m_window->Initialize();
    picture.attach(m_renderer);
    picture.setContents(ballWithTool());
    picture.setCamera(slanting());
    stereo = std::make_unique<StereoPicture>(picture);
  }
  ~StereoWindow()
  {
    m_window->MakeCurrent();
    stereo.reset();
    picture.attach(nullptr);
  }

  Picture render()
  {
    m_window->Render();
    picture.throwLastError();
    Picture result = readWindow(m_window);
    m_window->ReleaseCurrent();
    return result;
  }

  vtkRenderWindow& window() { return *m_window; }

  ScenePicture picture;
  std::unique_ptr<StereoPicture> stereo;

private:
  vtkNew<vtkPetrousEGLRenderWindow> m_window;
  vtkNew<vtkRenderer> m_renderer;
};

// Each eye drawn separately, composed on the CPU.
Picture expected(StereoMode mode, const StereoRig& rig, int width = kWidth, int height = kHeight)
{
  const EyePair eyes = eyesOf(slanting(), stereoGeometry(slanting(), rig));
  const auto [eyeWidth, eyeHeight] = eyeSize(mode, width, height);
  const auto draw = [&, w = eyeWidth, h = eyeHeight](const core::CameraPose& pose)
  { return shoot(ballWithTool(), pose, {}, w, h).picture; };
  return composeStereo(draw(eyes.left), draw(eyes.right), mode);
}

// Rounding may differ by one level.
int pixelsApart(const Picture& a, const Picture& b)
{
  EXPECT_EQ(a.rgb.size(), b.rgb.size());
  int count = 0;
  for (std::size_t i = 0; i + 2 < std::min(a.rgb.size(), b.rgb.size()); i += 3)
    count += std::abs(a.rgb[i] - b.rgb[i]) > 2 || std::abs(a.rgb[i + 1] - b.rgb[i + 1]) > 2 ||
             std::abs(a.rgb[i + 2] - b.rgb[i + 2]) > 2;
  return count;
}

constexpr int kFew = kWidth * kHeight / 1000; // polygon edges depend on rounding

void expectMode(StereoMode mode)
{
  const StereoRig rig{6.0, 55.0};
  StereoWindow shown;
  shown.stereo->show(mode, rig);
  shown.render();
  const Picture picture = shown.render();
  EXPECT_LE(pixelsApart(picture, expected(mode, rig)), kFew);
  EXPECT_LT((shown.picture.camera().position - slanting().position).norm(), 1e-12);
}

} // namespace

TEST(StereoPicture, DrawsSideBySideAsEachEyeAlone)
{
  expectMode(StereoMode::SideBySide);
}

TEST(StereoPicture, InterleavesAsComposedOnTheProcessor)
{
  expectMode(StereoMode::Interleaved);
}

TEST(StereoPicture, MakesAnAnaglyphAsComposedOnTheProcessor)
{
  expectMode(StereoMode::Anaglyph);
}

TEST(StereoPicture, RowsFollowTheScreenNotTheWindow)
{
  const StereoRig rig{6.0, 55.0};
  StereoWindow shown;
  shown.stereo->show(StereoMode::Interleaved, rig);
  const Picture even = shown.render();
  shown.stereo->setFirstRow(1);
  const Picture odd = shown.render();
  const EyePair eyes = eyesOf(slanting(), stereoGeometry(slanting(), rig));
  const Picture swapped =
      composeStereo(shoot(ballWithTool(), eyes.right).picture,
                    shoot(ballWithTool(), eyes.left).picture, StereoMode::Interleaved);
  EXPECT_LE(pixelsApart(odd, swapped), kFew);
  EXPECT_GT(pixelsApart(odd, even), 10 * kFew);
}

TEST(StereoPicture, GoesBackToOnePicture)
{
  StereoWindow shown;
  const Picture plain = shown.render();
  shown.stereo->show(StereoMode::SideBySide, {});
  shown.render();
  shown.stereo->show(StereoMode::Anaglyph, {});
  shown.render();
  shown.stereo->show(StereoMode::None, {});
  EXPECT_EQ(countDifferentPixels(shown.render(), plain), 0u);
}

TEST(StereoPicture, FollowsWhatChangesInTheScene)
{
  StereoWindow shown;
  shown.stereo->show(StereoMode::SideBySide, {});
  shown.render();
  shown.picture.setTool(std::nullopt);
  SceneContents without = ballWithTool();
  without.tool.reset();
  const EyePair eyes = eyesOf(slanting(), stereoGeometry(slanting(), {}));
  const auto eye = [&](const core::CameraPose& pose)
  { return shoot(without, pose, {}, kWidth / 2, kHeight).picture; };
  EXPECT_LE(pixelsApart(shown.render(),
                        composeStereo(eye(eyes.left), eye(eyes.right), StereoMode::SideBySide)),
            kFew);
}

TEST(StereoPicture, AnOddWidthKeepsBothEyesWhole)
{
  StereoWindow shown(kWidth + 1, kHeight);
  shown.stereo->show(StereoMode::SideBySide, {6.0, 55.0});
  const Picture picture = shown.render();
  const Picture truth = expected(StereoMode::SideBySide, {6.0, 55.0}, kWidth + 2, kHeight);
  int apart = 0;
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth / 2; ++x) // columns of the left eye except the last
      apart += std::abs(picture.pixel(x, y)[0] - truth.pixel(x, y)[0]) > 2;
  EXPECT_LE(apart, kFew);
}

// Drivers with stereo buffers are rare; VTK draws its monoscopic picture by the same two passes.
TEST(StereoPicture, PlacesTheEyesOfAQuadBuffer)
{
  const StereoRig rig{6.0, 55.0};
  const EyePair eyes = eyesOf(slanting(), stereoGeometry(slanting(), rig));
  StereoWindow shown;
  shown.stereo->show(StereoMode::QuadBuffer, rig);
  shown.window().SetStereoTypeToLeft();
  shown.window().StereoRenderOn();
  EXPECT_LE(pixelsApart(shown.render(), shoot(ballWithTool(), eyes.left).picture), kFew);
  shown.window().SetStereoTypeToRight();
  EXPECT_LE(pixelsApart(shown.render(), shoot(ballWithTool(), eyes.right).picture), kFew);
}

TEST(GraphicsReport, EveryVariantCompilesHere)
{
  const GraphicsReport report = reportGraphics();
  EXPECT_FALSE(report.renderer.empty());
  EXPECT_GE(report.largestTexture3d, 256); // minimum required by OpenGL 3.2
  ASSERT_EQ(report.variants.size(), 11u);
  for (const auto& variant : report.variants)
    EXPECT_TRUE(variant.compiles) << variant.error;
  EXPECT_EQ(report.variants.front().features, (std::vector<std::string>{"ct", "bone"}));
  EXPECT_EQ(report.variants.back().features,
            (std::vector<std::string>{"ct", "bone", "labels", "borders", "nested", "mask", "second",
                                      "third", "interior", "clipping", "thickness"}));
}
