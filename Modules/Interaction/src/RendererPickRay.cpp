#include "petrous/Interaction/RendererPickRay.h"

#include <algorithm>
#include <cmath>

#include <vtkCamera.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>

#include "petrous/Rendering/PixelRays.h"
#include "petrous/Rendering/StereoPicture.h"

namespace petrous::interaction
{

namespace
{
constexpr double kDegree = 3.14159265358979323846 / 180.0;
}

core::CameraPose cameraOf(vtkRenderer& renderer)
{
  vtkCamera* camera = renderer.GetActiveCamera();
  const double aspect = renderer.GetTiledAspectRatio();
  core::CameraPose pose;
  camera->GetPosition(pose.position.data());
  camera->GetFocalPoint(pose.focalPoint.data());
  camera->GetViewUp(pose.viewUp.data());
  pose.viewAngle = camera->GetViewAngle();
  if (camera->GetUseHorizontalViewAngle())
    pose.viewAngle = 2.0 / kDegree * std::atan(std::tan(0.5 * pose.viewAngle * kDegree) / aspect);
  if (camera->GetParallelProjection())
    pose.parallelScale = camera->GetParallelScale();
  pose.lensShift = camera->GetWindowCenter()[0] * aspect;
  return pose;
}

PickRay pickRayThrough(vtkRenderer& renderer, double x, double y,
                       const rendering::StereoPicture* stereo)
{
  core::CameraPose camera = cameraOf(renderer);
  const int* size = renderer.GetSize();
  const int* corner = renderer.GetOrigin();
  int width = size[0];
  int height = size[1];
  double column = x - corner[0];
  double row = y - corner[1];
  if (stereo && stereo->mode() == rendering::StereoMode::SideBySide && renderer.GetRenderWindow())
  {
    // The renderer draws one eye at a time, at the lower left; the window shows both.
    const int* whole = renderer.GetRenderWindow()->GetSize();
    const int half = whole[0] / 2;
    const bool right = x >= half;
    const auto eyes =
        rendering::eyesOf(camera, rendering::fittedStereoGeometry(camera, stereo->rig()));
    camera = right ? eyes.right : eyes.left;
    width = whole[0] - half;
    height = whole[1];
    column = x - (right ? half : 0);
    row = y;
  }
  height = std::max(height, 1);
  const rendering::PixelRay ray =
      rendering::PixelRays(camera, std::max(width, 1), height).through(column, height - 1.0 - row);
  return {ray.origin, ray.direction};
}

PickRay centralRay(vtkRenderer& renderer)
{
  const rendering::PixelRay ray = rendering::PixelRays(cameraOf(renderer), 1, 1).through(0.0, 0.0);
  return {ray.origin, ray.direction};
}

} // namespace petrous::interaction
