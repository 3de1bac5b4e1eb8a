#pragma once

#include <array>
#include <optional>

#include <vtkNew.h>
#include <vtkSmartPointer.h>

#include "petrous/Rendering/SceneContents.h"

class vtkActor;
class vtkCylinderSource;
class vtkRenderer;
class vtkSphereSource;

namespace petrous::workstation
{

/// A recorded tool beside one's own: the same burr, shaft and handpiece as a wire frame, which
/// hides neither bone nor tool. Removed from the renderer on destruction.
class GhostOverlay
{
public:
  explicit GhostOverlay(vtkRenderer& renderer);
  ~GhostOverlay();
  GhostOverlay(const GhostOverlay&) = delete;
  GhostOverlay& operator=(const GhostOverlay&) = delete;

  void set(const rendering::ToolPose& tool);

private:
  vtkSmartPointer<vtkRenderer> m_renderer;
  vtkNew<vtkSphereSource> m_burr;
  vtkNew<vtkCylinderSource> m_shaft, m_handpiece;
  std::array<vtkSmartPointer<vtkActor>, 3> m_actors;
};

} // namespace petrous::workstation
