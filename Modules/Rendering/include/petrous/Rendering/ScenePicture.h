#pragma once

#include <cstddef>
#include <map>
#include <memory>
#include <optional>
#include <string>

#include "petrous/Core/CameraPose.h"
#include "petrous/Rendering/SceneContents.h"

class vtkRenderer;

namespace petrous::rendering
{

/// The scene as props in a VTK renderer: the window's and the command's picture alike.
///
/// Bone is the surface of min(c_CT, mask - 0.5), a structure that of
/// min(smoothed occupancy - 0.5, mask - 0.5): the operands of the tissue field, so cut walls lie
/// where the hand feels them. Main thread only; the renderer draws when its window is rendered.
class ScenePicture
{
public:
  ScenePicture();
  ~ScenePicture();
  ScenePicture(const ScenePicture&) = delete;
  ScenePicture& operator=(const ScenePicture&) = delete;

  /// Adds the props, the background and the light to a renderer, leaving the previous one; the
  /// camera goes along. Null detaches: to be called while the renderer's context still exists.
  void attach(vtkRenderer* renderer);
  vtkRenderer* renderer() const; ///< null where detached, or where the renderer has gone

  /// Shows other contents; what did not change is kept. The camera stays.
  /// Throws RenderingError BadContents where the contents contradict each other.
  void setContents(const SceneContents& contents);

  /// The mask changed inside a box of CT voxels (CutMask::boxOf); only that box is made again.
  /// Null: nothing is cut any more.
  void maskChanged(std::shared_ptr<const volume::CutMask> mask, const core::IndexBox& box);

  void setTool(const std::optional<ToolPose>& tool);

  void setCamera(const core::CameraPose& pose);
  core::CameraPose camera() const;

  /// Coarser while something moves, so that it stays fluent on a machine without a GPU.
  void setInteractive(bool interactive);

  /// What is held for the picture, in bytes: ct.*, mask.*, labels.*, meshes.*.
  std::map<std::string, std::size_t> resources() const;

private:
  class Implementation;
  std::unique_ptr<Implementation> m_implementation;
};

} // namespace petrous::rendering
