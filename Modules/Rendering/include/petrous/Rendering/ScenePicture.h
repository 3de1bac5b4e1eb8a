#pragma once

#include <cstddef>
#include <map>
#include <memory>
#include <optional>
#include <string>

#include "petrous/Core/CameraPose.h"
#include "petrous/Rendering/Picture.h"
#include "petrous/Rendering/RenderQuality.h"
#include "petrous/Rendering/SceneContents.h"

class vtkRenderer;

namespace petrous::rendering
{

/// The scene as props in a VTK renderer: the window's and the command's picture alike.
///
/// CT, structures, cut and second image are drawn by vtkPetrousVolumeMapper from the tissue field
/// itself, so cut walls lie where the hand feels them; meshes and tool are polygons in the same
/// picture. Main thread only; the renderer draws when its window is rendered.
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

  /// With a tool in the scene its mask is made ready for the first cut.
  void setTool(const std::optional<ToolPose>& tool);

  void setCamera(const core::CameraPose& pose);
  core::CameraPose camera() const;

  /// Coarser while something moves, so that frames come at the wanted rate (30 Hz unless set, which
  /// throws InvalidParameter outside 1 to 240); fine again in the next frame after it. How fast the
  /// machine is was learnt from the frames before, at rest or not.
  void setInteractive(bool interactive);
  void setInteractionRate(double hz);

  void setQuality(const RenderQuality& quality); ///< throws InvalidParameter
  const RenderQuality& quality() const;

  /// Counts fetches and samples of the frames that follow, at the price of their time.
  void setCounting(bool counting);
  const RenderStatistics& statistics() const; ///< of the last frame

  /// What the latest frame took the graphics card whose time is known: with one, a frame or two
  /// before the last, as nobody waits for it. 0: none yet.
  double frameMilliseconds() const;

  /// Throws what went wrong in the last frame (RenderingError), once.
  void throwLastError();

  /// Of the last frame: distance to the first surface of the volume along each pixel's ray, mm,
  /// rows from the top; polygons end a ray. Makes the window's context current.
  DepthImage depth() const;

  /// The first surface of the volume at a pixel of the last frame (column and row from the top left
  /// of the renderer's part of the window), patient LPS mm; nothing where there is none.
  std::optional<Eigen::Vector3d> pick(double column, double row) const;

  /// What is held for the picture, in bytes: ct.*, mask.*, labels.*, meshes.*.
  std::map<std::string, std::size_t> resources() const;

private:
  class Implementation;
  std::unique_ptr<Implementation> m_implementation;
};

} // namespace petrous::rendering
