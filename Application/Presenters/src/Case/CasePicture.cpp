#include "petrous/Presenters/CasePicture.h"

#include "petrous/Presenters/SceneAssembly.h"
#include "petrous/Volume/TissueExtent.h"

namespace petrous::presenters
{

rendering::SceneContents sceneContents(const scene::Case& value, const core::Progress& progress)
{
  return SceneAssembly().contents(value, progress);
}

core::CameraPose standardCamera(const scene::Case& value, rendering::StandardView view)
{
  const auto extent = volume::tissueExtent(*value.ct.volume.get(), value.iso);
  return rendering::standardCamera(view, value.ct.geometry, extent.center, extent.radius);
}

core::CameraPose currentCamera(const scene::Case& value)
{
  return value.camera ? *value.camera : standardCamera(value, rendering::StandardView::Lateral);
}

} // namespace petrous::presenters
