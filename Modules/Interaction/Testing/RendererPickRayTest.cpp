#include "petrous/Interaction/RendererPickRay.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "Window.h"
#include "petrous/Rendering/StereoPicture.h"

using namespace petrous::interaction;
using Eigen::Vector3d;
using petrous::interaction::testing::Window;

namespace
{

// By VTK's own display-to-world transform; a pixel's centre is half a pixel from its corner.
Vector3d worldAt(vtkRenderer* renderer, double x, double y, double depth)
{
  renderer->SetDisplayPoint(x + 0.5, y + 0.5, depth);
  renderer->DisplayToWorld();
  const double* p = renderer->GetWorldPoint();
  return Vector3d(p[0], p[1], p[2]) / p[3];
}

void expectVtksLines(Window& window)
{
  vtkRenderer* renderer = window.renderer;
  const int* corner = renderer->GetOrigin();
  const int* size = renderer->GetSize();
  for (const double across : {0.0, 0.31, 1.0})
    for (const double up : {0.0, 0.77, 1.0})
    {
      const double x = corner[0] + std::floor(across * (size[0] - 1));
      const double y = corner[1] + std::floor(up * (size[1] - 1));
      const Vector3d near = worldAt(renderer, x, y, 0.1);
      const Vector3d far = worldAt(renderer, x, y, 0.9);
      const PickRay line = pickRayThrough(*renderer, x, y);
      EXPECT_NEAR(line.direction.norm(), 1.0, 1e-12);
      EXPECT_GT(line.direction.dot(far - near), 0.0);
      for (const Vector3d& point : {near, far})
        EXPECT_LT((point - line.origin).cross(line.direction).norm(), 1e-6) << x << " " << y;
    }
}

} // namespace

TEST(RendererPickRay, LooksThroughPixelsAsVtkDoes)
{
  Window window;
  expectVtksLines(window);
  window.renderer->GetActiveCamera()->SetPosition(80.0, -120.0, 95.0);
  window.renderer->GetActiveCamera()->SetViewAngle(55.0);
  expectVtksLines(window);
}

TEST(RendererPickRay, LooksThroughPixelsOfAParallelCamera)
{
  Window window;
  window.renderer->GetActiveCamera()->SetParallelProjection(1);
  window.renderer->GetActiveCamera()->SetParallelScale(37.0);
  expectVtksLines(window);
  const PickRay line = pickRayThrough(*window.renderer, 10.0, 20.0);
  EXPECT_LT((line.direction - Vector3d(0.0, 0.0, -1.0)).norm(), 1e-12);
  EXPECT_NEAR(line.origin.z(), 200.0, 1e-12);
}

TEST(RendererPickRay, KnowsAShiftedLensAndAHorizontalAngle)
{
  Window window;
  window.renderer->GetActiveCamera()->SetWindowCenter(0.2, 0.0);
  expectVtksLines(window);
  window.renderer->GetActiveCamera()->SetWindowCenter(0.0, 0.0);
  window.renderer->GetActiveCamera()->SetUseHorizontalViewAngle(1);
  expectVtksLines(window);
}

TEST(RendererPickRay, CountsFromTheRenderersCorner)
{
  Window window;
  window.renderer->SetViewport(0.5, 0.25, 1.0, 1.0);
  window.window->Render();
  expectVtksLines(window);
}

// The rays of the two eyes' pictures of the same point in the convergence plane, which has no
// parallax, meet in it.
TEST(RendererPickRay, LooksThroughTheEyeOfItsHalfSideBySide)
{
  Window window;
  petrous::rendering::ScenePicture picture;
  picture.setContents({});
  picture.attach(window.renderer);
  picture.setCamera({{0.0, 0.0, 200.0}, {0.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, 30.0, {}, 0.0});
  petrous::rendering::StereoPicture stereo(picture);
  stereo.show(petrous::rendering::StereoMode::SideBySide, {20.0, 200.0});
  window.window->Render();
  const auto half = [&](int x, int y)
  {
    const PickRay line = pickRayThrough(*window.renderer, x, y, &stereo);
    const Vector3d target((x % 120 - 59.5) * Window::pixel(), (y - 79.5) * Window::pixel(), 0.0);
    EXPECT_LT((target - line.origin).cross(line.direction).norm(), 1e-9) << x;
    EXPECT_NEAR(line.origin.x(), x < 120 ? -10.0 : 10.0, 1e-12);
  };
  for (const int x : {0, 60, 119, 120, 180, 239})
    half(x, 50);
  const PickRay middle = centralRay(*window.renderer);
  EXPECT_LT((middle.direction - Vector3d(0.0, 0.0, -1.0)).norm(), 1e-12);
  EXPECT_LT((middle.origin - Vector3d(0.0, 0.0, 200.0)).norm(), 1e-12);
  stereo.show(petrous::rendering::StereoMode::None, {});
  picture.attach(nullptr);
}
