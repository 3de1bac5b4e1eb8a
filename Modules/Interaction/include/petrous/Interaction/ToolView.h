#pragma once

#include <optional>

#include <vtkNew.h>

#include "petrous/Rendering/SceneContents.h"
#include "petrous/Session/TickRecord.h"

class vtkActor;
class vtkLineSource;
class vtkRenderer;

namespace petrous::interaction
{

/// The displayed tool: the proxy, which tissue stops, not the device pose. If the two are more than
/// `kLag` apart, a thin line connects the proxy to the device's position.
class ToolView
{
public:
  static constexpr double kLag = 1.0; ///< mm

  /// burrRadius  mm, > 0; throws InvalidParameter
  explicit ToolView(double burrRadius,
                    rendering::BurrFinish finish = rendering::BurrFinish::Smooth);
  ~ToolView();

  void addTo(vtkRenderer* renderer) const; ///< the line
  void removeFrom(vtkRenderer* renderer) const;

  /// For ScenePicture::setTool; nullopt until the servo has had a valid reading and placed the
  /// tool. A burr that drills has turned elsewhere each time: it is too fast for any picture.
  std::optional<rendering::ToolPose> update(const session::TickRecord& record);

  double lag() const noexcept { return m_lag; } ///< mm, of the last record

private:
  double m_burrRadius = 2.0;
  rendering::BurrFinish m_finish;
  double m_turn = 0.0; // rad
  double m_lag = 0.0;
  bool m_placed = false;
  vtkNew<vtkLineSource> m_line;
  vtkNew<vtkActor> m_actor;
};

/// Whether the handpiece would stand between `eye` (patient LPS mm) and the burr, or the
/// kFieldRadius around it.
bool hidesField(const rendering::ToolPose& tool, const Eigen::Vector3d& eye);
constexpr double kFieldRadius = 5.0; ///< mm

} // namespace petrous::interaction
