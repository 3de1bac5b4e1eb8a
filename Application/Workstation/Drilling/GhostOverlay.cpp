#include "GhostOverlay.h"

#include <vtkRenderer.h>

namespace petrous::workstation
{

GhostOverlay::GhostOverlay(vtkRenderer& renderer)
  : m_renderer(&renderer)
{
  m_tool.addTo(m_renderer);
}

GhostOverlay::~GhostOverlay()
{
  m_tool.removeFrom(m_renderer);
}

} // namespace petrous::workstation
