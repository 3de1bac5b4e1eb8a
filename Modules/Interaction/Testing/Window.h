#pragma once

#include <cmath>

#include <vtkCamera.h>
#include <vtkNew.h>
#include <vtkRenderer.h>

#include "petrous/Rendering/EglRenderWindow.h"

namespace petrous::interaction::testing
{

/// A window without a display, looking at the origin from 200 mm above: right is x, up is y.
struct Window
{
  static constexpr int kWidth = 240;
  static constexpr int kHeight = 160;

  Window()
  {
    window->SetSize(kWidth, kHeight);
    window->AddRenderer(renderer);
    vtkCamera* camera = renderer->GetActiveCamera();
    camera->SetPosition(0.0, 0.0, 200.0);
    camera->SetFocalPoint(0.0, 0.0, 0.0);
    camera->SetViewUp(0.0, 1.0, 0.0);
    camera->SetViewAngle(30.0);
    camera->SetClippingRange(50.0, 400.0);
    window->Render();
  }

  /// Pixel size in the plane z = 0, mm.
  static double pixel() { return 2.0 * 200.0 * std::tan(std::acos(-1.0) / 12.0) / kHeight; }

  vtkNew<vtkPetrousEGLRenderWindow> window;
  vtkNew<vtkRenderer> renderer;
};

} // namespace petrous::interaction::testing
