#pragma once

#include <vtkSmartPointer.h>

#include "petrous/Rendering/ToolProps.h"

namespace petrous::workstation
{

/// A recorded tool beside one's own. Removed from the renderer on destruction.
class GhostOverlay
{
public:
  explicit GhostOverlay(vtkRenderer& renderer);
  ~GhostOverlay();
  GhostOverlay(const GhostOverlay&) = delete;
  GhostOverlay& operator=(const GhostOverlay&) = delete;

  void set(const rendering::ToolPose& tool) { m_tool.setPose(tool); }

private:
  vtkSmartPointer<vtkRenderer> m_renderer;
  rendering::ToolProps m_tool{rendering::ToolProps::Look::Ghost};
};

} // namespace petrous::workstation
