#pragma once

#include <memory>
#include <string>

#include "SurfaceActor.h"
#include "petrous/Rendering/SceneContents.h"

namespace petrous::rendering
{

/// The surface min(smoothed occupancy - 0.5, mask - 0.5) = 0 of one structure, as polygons in
/// patient LPS.
class StructureSurface
{
public:
  StructureSurface(const StructureContents& structure, int pattern);

  vtkActor* prop() const { return m_actor.prop(); }
  bool shows(const StructureContents& structure) const; ///< the same voxels
  void setLook(const appearance::StructureLook& look, const LightSettings& light);

  /// Makes the surface again where the structure meets `box` of the mask's grid. A structure that
  /// is not shown is made when it is next shown.
  void maskChanged(const std::shared_ptr<const volume::CutMask>& mask, const core::IndexBox& box);

  std::size_t bytes() const; ///< occupancy and triangles held

private:
  void update();

  std::shared_ptr<const volume::LabelMap> m_labels;
  std::uint16_t m_index;
  bool m_shown = false;
  bool m_stale = true;
  std::shared_ptr<const volume::CutMask> m_mask;
  std::shared_ptr<const volume::Volume<float>> m_occupancy; ///< made when first shown
  std::size_t m_surfaceBytes = 0;
  SurfaceActor m_actor;
};

} // namespace petrous::rendering
