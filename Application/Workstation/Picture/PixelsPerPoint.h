#pragma once

#include <vtkRenderWindow.h>
#include <vtkRenderer.h>

namespace petrous::workstation
{

/// Of the screen that the renderer draws on: 2 at a scale of 200 %. VTK scales letters by itself,
/// and nothing else.
inline double pixelsPerPoint(vtkRenderer& renderer)
{
  constexpr double kPointsPerInch = 72.0;
  vtkRenderWindow* window = renderer.GetRenderWindow();
  return window ? window->GetDPI() / kPointsPerInch : 1.0;
}

} // namespace petrous::workstation
