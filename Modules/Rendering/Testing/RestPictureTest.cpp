#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <random>

#include <vtkActor2D.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper2D.h>
#include <vtkProperty2D.h>
#include <vtkRenderer.h>

#include "PictureComparison.h"
#include "PictureScenes.h"
#include "petrous/Rendering/PixelSamples.h"
#include "petrous/Rendering/PrintPicture.h"
#include "petrous/Rendering/StereoPicture.h"

using namespace petrous;
using namespace petrous::rendering;
using namespace petrous::rendering::synthetic;

namespace
{

constexpr double kOnePart = 0.0; // ms: a cell at a time

/// Draws on until another frame shows a better picture, or nothing remains; counts the parts.
int refineOnce(ScenePicture& scene, int samples = 1)
{
  int parts = 0;
  for (Refinement next = Refinement::More; next == Refinement::More; ++parts)
    next = scene.refine(kOnePart, samples);
  return parts;
}

SceneContents withTool(SceneContents contents)
{
  ToolPose tool;
  tool.center = {2.0, -6.0, 3.0};
  tool.axisToHand = Vector(0.4, -1.0, 0.6).normalized();
  tool.radius = 1.5;
  contents.tool = tool;
  return contents;
}

/// Mean of each 4 x 4 pixels of the reference's picture, 0 to 255.
std::vector<double> supersampled(const SceneContents& contents, const core::CameraPose& pose,
                                 int width, int height)
{
  const ReferencePicture large = truthOf(contents, pose, 4 * width, 4 * height);
  std::vector<double> mean(static_cast<std::size_t>(3 * width * height), 0.0);
  for (int row = 0; row < 4 * height; ++row)
    for (int column = 0; column < 4 * width; ++column)
      for (int c = 0; c < 3; ++c)
        mean[static_cast<std::size_t>(3 * (row / 4 * width + column / 4) + c)] +=
            255.0 / 16.0 *
            static_cast<double>(
                large.rgb[static_cast<std::size_t>(3 * (row * 4 * width + column) + c)]);
  return mean;
}

/// The window as one of the samples of a picture; `aside`: lit as that.
Shot shootSample(OffscreenView& view, ScenePicture& scene, int sample, bool aside)
{
  const auto [right, down] = pixelSample(sample);
  scene.setTile(PictureTile{kWidth, kHeight, 0, 0, right, down, aside ? sample : -1});
  Shot shot = shoot(view, scene);
  scene.setTile(std::nullopt);
  return shot;
}

/// Mean of all samples, 0 to 255.
std::vector<double> meanOfSamples(const SceneContents& contents, bool aside)
{
  ScenePicture scene;
  scene.setContents(contents);
  scene.setCamera(slanting(100.0));
  OffscreenView view(kWidth, kHeight);
  std::vector<double> mean(std::size_t{3} * kWidth * kHeight, 0.0);
  for (int n = 0; n < kPixelSamples; ++n)
  {
    const Shot shot = shootSample(view, scene, n, aside);
    for (std::size_t c = 0; c < mean.size(); ++c)
      mean[c] += shot.picture.rgb[c] / double{kPixelSamples};
  }
  return mean;
}

/// A ball of bone in soft tissue, of one colour, on voxels of 1 mm; `border`: standard deviation of
/// the Gaussian that blurs it, mm; `noise`: that of the voxels, HU. 0: a slope so gentle that its
/// normals are those of the ball.
SceneContents coarseBall(double border, double noise = 0.0)
{
  constexpr double kRadius = 18.0;
  std::mt19937 random(1);
  const auto value = [&](const Vector& p)
  {
    const double depth = kRadius - p.norm();
    if (!(border > 0.0))
      return kIso + 40.0 * depth;
    constexpr double kLargest = 4294967295.0;
    const double uniform = std::sqrt(12.0) * (static_cast<double>(random()) / kLargest - 0.5);
    return 790.0 + 750.0 * std::erf(depth / (std::sqrt(2.0) * border)) + noise * uniform;
  };
  SceneContents contents = boneScene(image(cube(44, 1.0, oblique()), value));
  contents.materials = {{appearance::TransferFunction::constant({0.8F, 0.8F, 0.8F}, 0.5F),
                         appearance::IntensitySource::Ct, 1.0F}};
  return contents;
}

double rms(const Picture& picture, const std::vector<double>& truth)
{
  double squares = 0.0;
  for (std::size_t n = 0; n < truth.size(); ++n)
    squares += std::pow(picture.rgb[n] - truth[n], 2);
  return std::sqrt(squares / static_cast<double>(truth.size()));
}

} // namespace

TEST(RestPicture, InPartsIsToTheBitThePictureDrawnInOneGo)
{
  for (const SceneContents& contents : {withTool(fullScene()), hollowBall()})
  {
    ScenePicture scene;
    scene.setContents(contents);
    scene.setCamera(slanting());
    OffscreenView view(kWidth, kHeight);
    const Shot whole = shoot(view, scene);
    scene.setProgressive(true);
    const Picture first = view.render(scene);
    // Coarse at first, unless the machine is known to be fast enough.
    EXPECT_TRUE(scene.drawnScale() >= 1.0 || countDifferentPixels(first, whole.picture) > 0U);
    EXPECT_EQ(scene.restSamples(), 0);
    EXPECT_GT(refineOnce(scene), 3);
    const Shot parts = shoot(view, scene);
    EXPECT_EQ(scene.restSamples(), 1);
    EXPECT_EQ(scene.drawnScale(), 1.0);
    EXPECT_EQ(countDifferentPixels(parts.picture, whole.picture), 0U);
    ASSERT_EQ(parts.depth.millimetres.size(), whole.depth.millimetres.size());
    for (std::size_t p = 0; p < whole.depth.millimetres.size(); ++p)
      ASSERT_TRUE(
          parts.depth.millimetres[p] == whole.depth.millimetres[p] ||
          (std::isnan(parts.depth.millimetres[p]) && std::isnan(whole.depth.millimetres[p])));
    EXPECT_EQ(scene.refine(1000.0), Refinement::Done);
    scene.setProgressive(false);
    EXPECT_EQ(countDifferentPixels(view.render(scene), whole.picture), 0U);
  }
}

TEST(RestPicture, OfBothEyesIsThatDrawnInOneGo)
{
  ScenePicture scene;
  scene.setContents(hollowBall());
  scene.setCamera(slanting());
  OffscreenView view(kWidth, kHeight);
  view.render(scene);
  StereoPicture stereo(scene);
  stereo.show(StereoMode::SideBySide, {});
  const Picture whole = view.render(scene);
  scene.setProgressive(true);
  view.render(scene);
  refineOnce(scene);
  EXPECT_EQ(countDifferentPixels(view.render(scene), whole), 0U);
  EXPECT_EQ(scene.refine(kOnePart), Refinement::Done);
}

TEST(RestPicture, IsGivenUpWhenTheSceneChanges)
{
  SceneContents contents = cutBall();
  ScenePicture scene;
  scene.setContents(contents);
  scene.setCamera(slanting());
  scene.setProgressive(true);
  OffscreenView view(kWidth, kHeight);
  view.render(scene);
  ASSERT_EQ(scene.refine(kOnePart), Refinement::More);
  scene.setCamera(slanting(50.0));
  view.render(scene);
  refineOnce(scene);
  EXPECT_EQ(countDifferentPixels(view.render(scene), draw(contents, slanting(50.0))), 0U);

  // Half of it, then more of the bone is cut.
  scene.setCamera(slanting());
  view.render(scene);
  ASSERT_EQ(scene.refine(kOnePart), Refinement::More);
  const core::GridGeometry& grid = contents.ct->geometry();
  const auto edited =
      cut(grid, [](const Vector& p)
          { return std::min(cavity(p), (p - Vector(0.0, -10.0, 0.0)).norm() - 4.0); });
  scene.maskChanged(edited, grid.fullBox());
  EXPECT_EQ(scene.refine(kOnePart), Refinement::Done) << "of what is no longer there";
  view.render(scene);
  EXPECT_EQ(scene.restSamples(), 0);
  refineOnce(scene);
  contents.mask = edited;
  EXPECT_EQ(countDifferentPixels(view.render(scene), draw(contents, slanting())), 0U);
}

TEST(RestPicture, StaysWhateverIsDrawnOverIt)
{
  ScenePicture scene;
  scene.setContents(withTool(cutBall()));
  scene.setCamera(slanting());
  scene.setProgressive(true);
  OffscreenView view(kWidth, kHeight);
  view.render(scene);
  refineOnce(scene);
  const Picture fine = view.render(scene);
  ASSERT_EQ(scene.restSamples(), 1);
  vtkNew<vtkActor2D> overlay;
  vtkNew<vtkPolyDataMapper2D> mapper;
  mapper->SetInputData(vtkNew<vtkPolyData>());
  overlay->SetMapper(mapper);
  scene.renderer()->AddViewProp(overlay);
  for (const bool moves : {false, true})
  {
    scene.setInteractive(moves);
    overlay->GetProperty()->SetLineWidth(moves ? 3.0F : 2.0F);
    EXPECT_EQ(countDifferentPixels(view.render(scene), fine), 0U);
    EXPECT_EQ(scene.restSamples(), 1);
    EXPECT_EQ(scene.refine(kOnePart), Refinement::Done);
  }
  scene.setCamera(slanting(61.0));
  EXPECT_GT(countDifferentPixels(view.render(scene), fine), 0U);
  EXPECT_EQ(scene.restSamples(), 0);
  scene.renderer()->RemoveViewProp(overlay);
}

TEST(RestPicture, ConvergesToTheSupersampledReference)
{
  constexpr int kColumns = 100, kRows = 75;
  for (const bool parallel : {false, true})
  {
    const SceneContents contents = translucentBall();
    core::CameraPose pose = slanting();
    if (parallel)
      pose.parallelScale = 14.0;
    const std::vector<double> truth = supersampled(contents, pose, kColumns, kRows);
    ScenePicture scene;
    scene.setContents(contents);
    scene.setCamera(pose);
    scene.setProgressive(true);
    OffscreenView view(kColumns, kRows);
    view.render(scene);
    std::vector<double> errors;
    Picture picture;
    for (const int samples : {1, 4, 8, 16})
    {
      refineOnce(scene, kPixelSamples);
      picture = view.render(scene);
      EXPECT_EQ(scene.restSamples(), samples);
      errors.push_back(rms(picture, truth));
    }
    EXPECT_EQ(scene.refine(kOnePart, kPixelSamples), Refinement::Done);
    EXPECT_LT(errors[1], 0.6 * errors[0]);
    EXPECT_LT(errors[3], 0.45) << "of 255; rounding to 8 bits alone gives 0.29";
    EXPECT_LT(errors[3], 0.6 * errors[0]) << errors[0];

    scene.setProgressive(false);
    const Picture offscreen = renderTiled(scene, pose, kColumns, kRows, {}, 64, kPixelSamples);
    EXPECT_LT(rms(offscreen, truth), 0.45);
  }
}

// Figures are printed, not asserted. PETROUS_PICTURE=1920x1080: of a window as large.
TEST(RestPicture, GoesOnFromFramesThatKeepTheFieldFine)
{
  int width = 96, height = 72;
  const char* size = std::getenv("PETROUS_PICTURE");
  ASSERT_TRUE(!size || std::sscanf(size, "%dx%d", &width, &height) == 2);
  using Clock = std::chrono::steady_clock;
  const auto since = [](Clock::time_point start)
  { return std::chrono::duration<double, std::milli>(Clock::now() - start).count(); };
  for (const SceneContents& contents : {withTool(cutBall()), withTool(fullScene())})
  {
    ScenePicture scene;
    scene.setContents(contents);
    scene.setProgressive(true);
    scene.setInteractive(true);
    OffscreenView view(width, height);
    double slowest = 0.0, sum = 0.0;
    constexpr int kWarm = 20, kFrames = 20;
    for (int n = 0; n < kWarm + kFrames; ++n)
    {
      core::CameraPose pose = slanting(55.0);
      pose.position += 0.05 * n * Vector(1.0, 0.0, 0.0);
      scene.setCamera(pose);
      view.render(scene);
      EXPECT_EQ(scene.restSamples(), 0);
      EXPECT_GE(scene.foveaScale(), scene.drawnScale());
      if (n < kWarm)
        continue;
      slowest = std::max(slowest, scene.frameMilliseconds());
      sum += scene.frameMilliseconds();
    }
    EXPECT_TRUE(scene.foveaScale() == scene.drawnScale() ||
                scene.foveaScale() >= InteractionQuality::kFoveaScale);
    const double rest = scene.drawnScale(), field = scene.foveaScale();
    scene.setInteractive(false);
    int parts = 0;
    double longest = 0.0, whole = 0.0;
    for (Refinement next = Refinement::More; next == Refinement::More; ++parts)
    {
      const auto start = Clock::now();
      next = scene.refine(30.0);
      longest = std::max(longest, since(start));
      whole += since(start);
    }
    view.render(scene);
    EXPECT_EQ(scene.restSamples(), 1);
    std::printf("%d x %d, %s: a frame with a tool %.1f ms (slowest %.1f) at %.0f %%, around the "
                "burr %.0f %%; at rest %.0f ms in %d parts, longest %.1f ms\n",
                width, height, view.glRenderer().c_str(), sum / kFrames, slowest, 100.0 * rest,
                100.0 * field, whole, parts, longest);
  }
}

// Also where it is cut, and where the CT samples its borders so well that nothing is to change.
TEST(RestPicture, IsOfSamplesThatAreLitAsTheReferenceLightsThem)
{
  for (const SceneContents& contents :
       {coarseBall(0.6), cutBall(), hollowBall(oblique(), 0.8), translucentBall()})
  {
    ScenePicture scene;
    scene.setContents(contents);
    scene.setCamera(slanting());
    OffscreenView view(kWidth, kHeight);
    for (const int sample : {0, 1, 6, 15})
    {
      ReferenceRayCaster::Quality quality;
      quality.sample = sample;
      const ReferencePicture truth =
          ReferenceRayCaster(contents, quality).render(slanting(), kWidth, kHeight);
      expectAgreement(compare(shootSample(view, scene, sample, true), truth,
                              contents.ct->geometry().minSpacing()));
    }
  }
}

TEST(RestPicture, OfSamplesShowsTheSameSurfaceInAnotherShade)
{
  for (const auto& [spacing, isCoarse] : {std::pair{0.3, false}, {0.8, true}})
  {
    ScenePicture scene;
    scene.setContents(hollowBall(oblique(), spacing));
    scene.setCamera(slanting());
    OffscreenView view(kWidth, kHeight);
    const Shot aside = shootSample(view, scene, 5, true);
    const Shot plain = shootSample(view, scene, 5, false);
    EXPECT_EQ(countDifferentPixels(aside.picture, plain.picture) > 0U, isCoarse) << spacing;
    for (std::size_t p = 0; p < plain.depth.millimetres.size(); ++p)
      ASSERT_TRUE(
          aside.depth.millimetres[p] == plain.depth.millimetres[p] ||
          (std::isnan(aside.depth.millimetres[p]) && std::isnan(plain.depth.millimetres[p])));
  }
}

// Truth: a ball whose normals are exact. What differs but for a constant is of the voxels.
TEST(RestPicture, OfSamplesShowsLessOfTheVoxelsInTheShadeOfACoarseCt)
{
  const std::vector<double> truth = meanOfSamples(coarseBall(0.0), false);
  const auto pattern = [&truth](const std::vector<double>& mean)
  {
    double sum = 0.0, squares = 0.0;
    int count = 0;
    for (int row = kHeight / 3; row < 2 * kHeight / 3; ++row)
      for (int column = 3 * kWidth / 8; column < 5 * kWidth / 8; ++column, ++count)
      {
        const auto c = static_cast<std::size_t>(3 * (row * kWidth + column));
        sum += mean[c] - truth[c];
        squares += std::pow(mean[c] - truth[c], 2);
      }
    return std::sqrt(squares / count - std::pow(sum / count, 2));
  };
  const SceneContents noisy = coarseBall(0.7, 80.0);
  const double before = pattern(meanOfSamples(noisy, false));
  EXPECT_GT(before, 2.0) << "of 255: else there is nothing to mend";
  EXPECT_LT(pattern(meanOfSamples(noisy, true)), 0.8 * before) << before;
  EXPECT_LT(pattern(meanOfSamples(coarseBall(0.5), true)), 1.5) << "without noise";
}

TEST(PixelSamples, AreLitFromTheCornersOfTetrahedra)
{
  for (int first = 0; first < kPixelSamples; first += 4)
    for (int n = first; n < first + 4; ++n)
      for (int m = first; m < n; ++m)
      {
        const auto a = sampleCorner(n), b = sampleCorner(m);
        EXPECT_EQ(a[0] * b[0] + a[1] * b[1] + a[2] * b[2], -1.0) << n << ' ' << m;
      }
}

TEST(PixelSamples, AreSpreadEvenlyAboutTheCentre)
{
  unsigned columns = 0, rows = 0;
  double right = 0.0, down = 0.0;
  for (int n = 0; n < kPixelSamples; ++n)
  {
    const auto [x, y] = pixelSample(n);
    columns |= 1U << std::lround((x + 0.5) * kPixelSamples - 0.5);
    rows |= 1U << std::lround((y + 0.5) * kPixelSamples - 0.5);
    right += x;
    down += y;
    if (n % 2 == 1)
    {
      EXPECT_NEAR(right, 0.0, 1e-12) << n;
      EXPECT_NEAR(down, 0.0, 1e-12) << n;
    }
    for (int m = 0; m < n; ++m)
      EXPECT_GT(std::hypot(x - pixelSample(m)[0], y - pixelSample(m)[1]), 0.15);
  }
  EXPECT_EQ(columns, 0xFFFFU) << "each sixteenth of a pixel's width once";
  EXPECT_EQ(rows, 0xFFFFU);
}
