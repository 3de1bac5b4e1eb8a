#include "petrous/Presenters/CasePicture.h"

#include <utility>

#include "petrous/Volume/TissueExtent.h"

namespace petrous::presenters
{

rendering::SceneContents sceneContents(const scene::Case& value)
{
  rendering::SceneContents contents;
  contents.ct = value.ct.volume.get();
  contents.iso = value.iso;
  if (value.dissection && !std::as_const(*value.dissection).mask().untouched())
    contents.mask = {value.dissection, &std::as_const(*value.dissection).mask()};
  for (const auto& part : value.labels)
    for (const auto& structure : part.structures)
      if (structure.look.shown)
        contents.structures.push_back(
            {structure.name, part.labels.get(), structure.index, structure.look});
  for (const auto& mesh : value.meshes)
    if (mesh.look.shown && !scene::findStructure(value, mesh.name))
      contents.meshes.push_back({mesh.name, mesh.mesh.get(), mesh.look});
  return contents;
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
