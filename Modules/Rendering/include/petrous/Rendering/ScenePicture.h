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

/// What a window shows of a larger picture; pixels.
struct PictureTile
{
  int width = 0; ///< of the whole picture
  int height = 0;
  int left = 0; ///< of the window in it; the window may reach beyond it
  int top = 0;
  double right = 0.0; ///< by which all rays are shifted, fractions of a pixel
  double down = 0.0;
  int sample = -1; ///< of kPixelSamples, of a picture that is the mean of several; -1: of one
};

/// The scene as props in a VTK renderer, used by both the window and the command line.
///
/// CT, structures, cut mask and second image are drawn by vtkPetrousVolumeMapper from the same
/// tissue field that the haptics use, so cut walls are seen where they are felt; meshes and tool
/// are polygons in the same picture. Main thread only; draws when the renderer's window is
/// rendered.
class ScenePicture
{
public:
  ScenePicture();
  ~ScenePicture();
  ScenePicture(const ScenePicture&) = delete;
  ScenePicture& operator=(const ScenePicture&) = delete;

  /// Adds the props, the background and the light to a renderer and removes them from the previous
  /// one; the camera is carried over. Null detaches; call it while the renderer's context still
  /// exists.
  void attach(vtkRenderer* renderer);
  vtkRenderer* renderer() const; ///< null if detached, or if the renderer has been destroyed

  /// Replaces the contents; unchanged parts are kept, and so is the camera. Throws RenderingError
  /// BadContents if the contents are inconsistent.
  void setContents(const SceneContents& contents);

  /// The mask changed inside a box of CT voxels (CutMask::boxOf); only that box is updated. Null:
  /// nothing is cut any more.
  void maskChanged(std::shared_ptr<const volume::CutMask> mask, const core::IndexBox& box);

  /// With a tool in the scene, the mask's GPU resources are prepared for the first cut.
  void setTool(const std::optional<ToolPose>& tool);

  void setCamera(const core::CameraPose& pose);
  core::CameraPose camera() const;

  /// Until called without a tile, the window shows that part of the picture of `setCamera`, as it
  /// would be were the window as large as the picture; `camera` and `pick` are not to be used. See
  /// TiledPicture.h.
  void setTile(const std::optional<PictureTile>& tile);

  /// While interactive, pictures are coarsened to reach the target rate (default 30 Hz; throws
  /// InvalidParameter outside 1 to 240); the next frame after it has full quality. The machine's
  /// speed is estimated from previous frames, interactive or not.
  void setInteractive(bool interactive);
  void setInteractionRate(double hz);

  /// For a window that stays responsive; off at first. A frame shows the picture at rest (full
  /// quality, equal to the bit to one drawn in one go) only if `refine` has drawn it, and else a
  /// coarse one. It stays as long as scene, camera and size do, whatever is drawn over it and
  /// whether `setInteractive` or not.
  ///
  /// While interactive, the surroundings of a tool (tool::kField) are drawn with at least
  /// InteractionQuality::kFoveaScale of the resolution and the rest coarser, where a frame of one
  /// resolution would be coarser there.
  ///
  /// The distance field of an instrument's shadow, which takes up to some seconds, is made in the
  /// background; until then the instrument throws none (RenderStatistics::pendingShadow), also in
  /// the picture at rest.
  void setProgressive(bool progressive);

  /// Draws the picture at rest of the last frame for about `milliseconds`; what was drawn counts
  /// until the scene changes. With more than one of up to kPixelSamples `samples` the picture then
  /// becomes the mean of 4, 8 and 16 rays a pixel, of the volume: polygons keep their edges. Makes
  /// the window's context current.
  Refinement refine(double milliseconds, int samples = 1);

  /// Of the last frame: rays a pixel of the picture at rest; 0 while it is a coarse one.
  int restSamples() const;
  /// Of the last frame, relative to the picture's edge: at which rays were cast, and near the tool.
  double drawnScale() const;
  double foveaScale() const;

  void setQuality(const RenderQuality& quality); ///< throws InvalidParameter
  const RenderQuality& quality() const;

  /// Counts texture fetches and samples of subsequent frames, which slows them down.
  void setCounting(bool counting);
  const RenderStatistics& statistics() const; ///< of the last frame

  /// GPU time of the latest frame for which it is known. On a GPU that is one or two frames before
  /// the last, since the timer does not wait. 0: none yet.
  double frameMilliseconds() const;

  /// Throws the error of the last frame (RenderingError), once.
  void throwLastError();

  /// Depth of the last frame: distance to the first surface of the volume along each pixel's ray,
  /// mm, top row first; polygons end a ray. Makes the window's context current.
  DepthImage depth() const;

  /// First surface of the volume at a pixel of the last frame (column and row from the top left of
  /// the renderer's viewport), patient LPS mm; nullopt if there is none.
  std::optional<Eigen::Vector3d> pick(double column, double row) const;

  /// Memory held for the picture, in bytes: ct.*, mask.*, labels.*, meshes.*.
  std::map<std::string, std::size_t> resources() const;

private:
  class Implementation;
  std::unique_ptr<Implementation> m_implementation;
};

} // namespace petrous::rendering
