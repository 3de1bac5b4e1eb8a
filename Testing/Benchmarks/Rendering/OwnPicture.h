#pragma once

#include <memory>

#include "petrous/Core/CameraPose.h"
#include "petrous/Rendering/Picture.h"
#include "petrous/Rendering/RenderQuality.h"
#include "petrous/Rendering/SceneContents.h"

class vtkRenderer;

namespace petrous::rendering
{

/// The scene's volume drawn by our mapper alone in a renderer, with access to all settings.
class OwnPicture
{
public:
  OwnPicture(const SceneContents& contents, const core::CameraPose& camera);
  ~OwnPicture();
  OwnPicture(const OwnPicture&) = delete;
  OwnPicture& operator=(const OwnPicture&) = delete;

  void attach(vtkRenderer* renderer);
  void setCamera(const core::CameraPose& camera);
  void setQuality(const RenderQuality& quality);
  void setCounting(bool counting); ///< counts fetches and samples of subsequent frames
  void maskChanged(std::shared_ptr<const volume::CutMask> mask, const core::IndexBox& box);

  const RenderStatistics& statistics() const; ///< of the last frame
  DepthImage depth() const; ///< of the last frame; call in the window that drew it

private:
  class Implementation;
  std::unique_ptr<Implementation> m_implementation;
};

} // namespace petrous::rendering
