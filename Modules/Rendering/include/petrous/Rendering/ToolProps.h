#pragma once

#include <array>
#include <functional>
#include <memory>
#include <optional>

#include <vtkNew.h>
#include <vtkSmartPointer.h>

#include "petrous/Rendering/SceneContents.h"

class vtkActor;
class vtkCylinderSource;
class vtkPolyData;
class vtkRenderer;
class vtkSphereSource;

namespace petrous::rendering
{

class GlUniforms;
class PolygonShading;

/// The drill, burr, shaft and handpiece of ToolShape.h, or an instrument. A ghost is a coarse wire
/// frame without light, which hides nothing.
class ToolProps
{
public:
  enum class Look
  {
    Solid,
    Ghost
  };
  explicit ToolProps(Look look = Look::Solid);
  ~ToolProps();

  void addTo(vtkRenderer* renderer) const;
  void removeFrom(vtkRenderer* renderer) const;
  void setPose(const std::optional<ToolPose>& tool);
  /// Shadows (once they are followed), exposure and tone curve; not of a ghost.
  void setLight(const LightSettings& light);
  /// See PolygonShading (SurfaceActor.h); once, not of a ghost.
  void followShadows(const std::function<void(GlUniforms& program)>& setter) const;

private:
  void shapeBurr(const ToolPose& tool);
  void shapeInstrument(const ToolPose& tool);

  vtkNew<vtkSphereSource> m_burr;                   // smooth
  vtkSmartPointer<vtkPolyData> m_fluted, m_gritted; // of radius 1; made when first needed
  vtkNew<vtkCylinderSource> m_shaft;
  vtkNew<vtkCylinderSource> m_handpiece;
  std::shared_ptr<const core::TriangleMesh> m_instrument; // as in the last of the actors
  std::array<vtkSmartPointer<vtkActor>, 4> m_actors;
  std::array<std::unique_ptr<PolygonShading>, 4> m_shadings; // none of a ghost
  std::array<double, 3> m_idle, m_drilling;                  // colours of the burr
};

} // namespace petrous::rendering
