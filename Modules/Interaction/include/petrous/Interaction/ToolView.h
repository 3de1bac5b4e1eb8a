#pragma once

#include <optional>

#include <vtkNew.h>

#include "petrous/Rendering/SceneContents.h"
#include "petrous/Simulation/TickRecord.h"

class vtkActor;
class vtkLineSource;
class vtkRenderer;

namespace petrous::interaction
{

/// The tool as it is shown: the proxy, which tissue holds back, not the hand. Where the hand is
/// more than `kLag` away from it a thin line leads to where it would have the tool.
class ToolView
{
public:
  static constexpr double kLag = 1.0; ///< mm

  /// burrRadius  mm, > 0; throws InvalidParameter
  explicit ToolView(double burrRadius);
  ~ToolView();

  void addTo(vtkRenderer* renderer) const; ///< the line
  void removeFrom(vtkRenderer* renderer) const;
  void setBurrRadius(double burrRadius); ///< throws InvalidParameter

  /// For ScenePicture::setTool; nothing until the servo had a sound reading and placed the tool.
  std::optional<rendering::ToolPose> update(const simulation::TickRecord& record);

  double lag() const noexcept { return m_lag; } ///< mm, of the last record

private:
  double m_burrRadius = 2.0;
  double m_lag = 0.0;
  bool m_placed = false;
  vtkNew<vtkLineSource> m_line;
  vtkNew<vtkActor> m_actor;
};

} // namespace petrous::interaction
