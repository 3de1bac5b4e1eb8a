#include <cmath>

#include <vtkRenderer.h>
#include <vtkVolume.h>
#include <vtkVolumeCollection.h>

#include "PictureComparison.h"
#include "PictureScenes.h"
#include "petrous/Rendering/VolumeMapper.h"

using namespace petrous;
using namespace petrous::rendering;
using namespace petrous::rendering::synthetic;

namespace
{

vtkPetrousVolumeMapper& mapperOf(const ScenePicture& scene)
{
  vtkVolumeCollection* volumes = scene.renderer()->GetVolumes();
  volumes->InitTraversal();
  return *vtkPetrousVolumeMapper::SafeDownCast(volumes->GetNextVolume()->GetMapper());
}

} // namespace

// With a burr and its handpiece across the border, in front of the bone, in it and behind it.
TEST(Fovea, IsThePictureAtFullResolutionAndFadesIntoTheCoarseOne)
{
  constexpr double kInner = 0.75; // of the radius, up to which it is shown alone
  for (const bool parallel : {false, true})
  {
    SceneContents contents = cutBall();
    ToolPose tool;
    tool.center = {2.0, -8.0, 3.0};
    tool.axisToHand = Vector(0.4, -1.0, 0.6).normalized();
    contents.tool = tool;
    core::CameraPose pose = slanting();
    if (parallel)
      pose.parallelScale = 14.0;
    ScenePicture scene;
    scene.setContents(contents);
    scene.setCamera(pose);
    OffscreenView view(kWidth, kHeight);
    const Picture fine = view.render(scene);
    const auto picked = [&](int column, int row) { return scene.pick(column, row); };
    std::vector<std::optional<Eigen::Vector3d>> places;
    for (int row = 0; row < kHeight; row += 5)
      for (int column = 0; column < kWidth; column += 5)
        places.push_back(picked(column, row));

    RenderQuality quality;
    quality.imageScale = 0.2;
    quality.step = 1.0;
    scene.setQuality(quality);
    const Picture coarse = view.render(scene);
    vtkPetrousVolumeMapper::Fovea fovea;
    fovea.center = tool.center;
    fovea.radius = 6.0;
    mapperOf(scene).SetFovea(fovea);
    const Picture both = view.render(scene);

    // The burr's centre and 6 mm beside it on the screen, by the reference's camera.
    const PixelRays rays(pose, kWidth, kHeight);
    const auto pixelOf = [&](const Vector& point)
    {
      std::array<int, 2> best{};
      double nearest = 1e9;
      for (int row = 0; row < kHeight; ++row)
        for (int column = 0; column < kWidth; ++column)
        {
          const PixelRay ray = rays.through(column, row);
          const double away = (point - ray.origin).cross(ray.direction).norm();
          if (away < nearest)
          {
            nearest = away;
            best = {column, row};
          }
        }
      return best;
    };
    const auto middle = pixelOf(tool.center);
    const Vector up = pose.viewUp;
    const Vector ahead = (pose.focalPoint - pose.position).normalized();
    const Vector right = ahead.cross(up).normalized();
    const auto edge = pixelOf(tool.center + 6.0 * right);
    const double radius = std::hypot(edge[0] - middle[0], edge[1] - middle[1]);
    ASSERT_GT(radius, 15.0);
    int inside = 0, between = 0, outside = 0, changed = 0;
    std::size_t place = 0;
    for (int row = 0; row < kHeight; ++row)
      for (int column = 0; column < kWidth; ++column)
      {
        const double away = std::hypot(column - middle[0], row - middle[1]);
        for (int c = 0; c < 3; ++c)
        {
          const int a = fine.pixel(column, row)[c];
          const int b = coarse.pixel(column, row)[c];
          const int shown = both.pixel(column, row)[c];
          changed += a != b;
          if (away < kInner * radius - 2.0)
            inside += shown != a;
          else if (away > radius + 2.0)
            outside += shown != b;
          else
            between += shown < std::min(a, b) - 1 || shown > std::max(a, b) + 1;
        }
        if (row % 5 == 0 && column % 5 == 0)
        {
          const bool isSame = places[place] == picked(column, row);
          EXPECT_TRUE(isSame || away >= radius - 2.0) << column << " " << row;
          ++place;
        }
      }
    EXPECT_GT(changed, 1000);
    EXPECT_EQ(inside, 0);
    EXPECT_EQ(outside, 0);
    EXPECT_EQ(between, 0) << "no seam";

    mapperOf(scene).SetFovea(std::nullopt);
    EXPECT_EQ(countDifferentPixels(view.render(scene), coarse), 0U);
  }
}

// Part of it beside the picture, behind the camera, and of a lower resolution.
TEST(Fovea, MayLieAnywhere)
{
  ScenePicture scene;
  scene.setContents(cutBall());
  scene.setCamera(slanting());
  RenderQuality quality;
  quality.imageScale = 0.2;
  scene.setQuality(quality);
  OffscreenView view(kWidth, kHeight);
  const Picture coarse = view.render(scene);
  vtkPetrousVolumeMapper::Fovea fovea;
  fovea.radius = 6.0;
  fovea.quality.imageScale = 0.6;
  for (const Vector& center :
       {Vector(60.0, 48.0, 0.0), Vector(2.0 * slanting().position), slanting().position})
  {
    fovea.center = center;
    mapperOf(scene).SetFovea(fovea);
    EXPECT_EQ(countDifferentPixels(view.render(scene), coarse), 0U) << center.transpose();
  }
  fovea.center = {9.0, 0.0, 9.0};
  mapperOf(scene).SetFovea(fovea);
  EXPECT_GT(countDifferentPixels(view.render(scene), coarse), 100U);
}
