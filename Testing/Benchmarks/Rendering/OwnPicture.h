#pragma once

#include <memory>

#include "petrous/Core/CameraPose.h"
#include "petrous/Rendering/Picture.h"
#include "petrous/Rendering/RenderQuality.h"
#include "petrous/Rendering/SceneContents.h"

class vtkRenderer;

namespace petrous::rendering
{

/// The scene's volume as our mapper draws it, alone in a renderer, with every knob in reach.
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
  void setCounting(bool counting); ///< of fetches and samples, in the frames that follow
  void maskChanged(std::shared_ptr<const volume::CutMask> mask, const core::IndexBox& box);

  const RenderStatistics& statistics() const; ///< of the last frame
  DepthImage depth() const;                   ///< of the last frame, in the window that drew it

private:
  class Implementation;
  std::unique_ptr<Implementation> m_implementation;
};

} // namespace petrous::rendering
