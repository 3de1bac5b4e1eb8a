#pragma once

#include <exception>
#include <memory>
#include <optional>

#include <vtkVolumeMapper.h>

#include "petrous/Core/CameraPose.h"
#include "petrous/Core/GridGeometry.h"
#include "petrous/Rendering/Picture.h"
#include "petrous/Rendering/RenderQuality.h"
#include "petrous/Rendering/SceneContents.h"

namespace petrous::rendering
{
class GlUniforms;
}

/// Single-pass ray caster for CT, structures, cut mask and a second image
/// (Documentation/adr/0008-what-a-ray-sees.md), for vtkVolume in any VTK program.
///
/// Two kinds of input. With SetInputData alone the image is drawn as CT: its isosurface at IsoValue
/// with SurfaceOpacity, and inside it the colour and opacity (per ScalarOpacityUnitDistance) of the
/// vtkVolumeProperty. SetContents sets everything, in patient LPS mm; the prop's matrix, if any,
/// maps patient to world.
///
/// Supports VTK's clipping planes (world) and cropping region (sub-volume only). Opaque polygons
/// are intermixed. Scalars: int16, uint16 or float; others are rejected with an error. A mapper
/// belongs to one window. Main thread only.
class vtkPetrousVolumeMapper : public vtkVolumeMapper
{
public:
  static vtkPetrousVolumeMapper* New();
  vtkTypeMacro(vtkPetrousVolumeMapper, vtkVolumeMapper);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  vtkPetrousVolumeMapper(const vtkPetrousVolumeMapper&) = delete;
  void operator=(const vtkPetrousVolumeMapper&) = delete;

  vtkSetMacro(IsoValue, double);
  vtkGetMacro(IsoValue, double);
  vtkSetClampMacro(SurfaceOpacity, double, 0.0, 1.0);
  vtkGetMacro(SurfaceOpacity, double);

  void SetContents(const petrous::rendering::SceneContents& contents);

  /// The mask decreased or increased in a box of CT voxels; null: nothing is cut any more.
  /// Does not throw; the change is visible in the next frame (limited by a cap, see statistics).
  void MaskChanged(std::shared_ptr<const petrous::volume::CutMask> mask,
                   const petrous::core::IndexBox& box);

  /// Prepares the mask before anything is cut. Otherwise a mask in which nothing is cut costs
  /// nothing.
  void ExpectCut(bool expected);

  /// Throws InvalidParameter.
  void SetQuality(const petrous::rendering::RenderQuality& quality);
  const petrous::rendering::RenderQuality& GetQuality() const;

  /// Frames show the picture at rest once Refine has drawn it with this quality, and until then are
  /// drawn with that of SetQuality, and a new instrument throws its shadow later. Null: every
  /// frame is, and it throws it at once.
  void SetRestQuality(const std::optional<petrous::rendering::RenderQuality>& quality);

  /// Goes on with the picture of the last frame for about so long, with up to `samples` rays a
  /// pixel (ScenePicture::refine). Makes the window's context current.
  petrous::rendering::Refinement Refine(double milliseconds, int samples);
  int GetRestSamples() const; ///< rays a pixel in the last frame; 0: not of the picture at rest
  double GetRestMilliseconds() const; ///< that the first of them took

  /// A ball in patient mm; the circle around it is drawn with `imageScale` and `step` of its own.
  struct Fovea
  {
    Eigen::Vector3d center{0.0, 0.0, 0.0};
    double radius = 0.0; ///< on the screen at the centre's depth
    petrous::rendering::RenderQuality quality;
  };
  void SetFovea(const std::optional<Fovea>& fovea);

  /// The camera (world) beside which the lamp of shadows is, and at whose focal point the light's
  /// falloff changes nothing, e.g. that between both eyes; null: the one that draws.
  void SetLampCamera(const std::optional<petrous::core::CameraPose>& camera);

  /// Of kPixelSamples, which lights a frame that is one of several of a picture; -1: of none.
  void SetSample(int sample);

  /// Casts shadows, if there are any (world); null: none does. Drawn elsewhere.
  void SetShadowingTool(const std::optional<petrous::rendering::ToolPose>& tool);

  /// For polygons that lie in shadows, whose shaders contain polygonShadowsShader (RayShader.h):
  /// first PrepareShadows, before a frame's polygons, then ShadePolygons for each OpenGL program
  /// while it is in use, with the same GlUniforms (GlProgram.h) as long as it is the same.
  /// `isTool`: it draws the tool, which throws no shadow on itself. Errors are those of the frame.
  void PrepareShadows(vtkRenderer* renderer, vtkVolume* volume);
  void ShadePolygons(vtkRenderer* renderer, vtkVolume* volume,
                     petrous::rendering::GlUniforms& program, bool isTool);

  /// Counts texture fetches and samples of subsequent frames, which slows them down.
  vtkSetMacro(Counting, bool);
  vtkGetMacro(Counting, bool);
  const petrous::rendering::RenderStatistics& GetStatistics() const;

  /// Distance to the first surface in the last frame, mm along each pixel's ray, top row first.
  /// Makes the window's context current.
  petrous::rendering::DepthImage GetDepth();

  /// Depth at one pixel of the renderer's viewport, rows from the top; NaN: no hit.
  float GetDepthAt(double column, double row);

  /// The last frame's error (RenderingError, InvalidParameter), once; null: none. Render itself
  /// does not throw; it also reports a VTK error.
  std::exception_ptr TakeError();

  void Render(vtkRenderer* renderer, vtkVolume* volume) override;
  void ReleaseGraphicsResources(vtkWindow* window) override;

protected:
  vtkPetrousVolumeMapper();
  ~vtkPetrousVolumeMapper() override;

private:
  class Internals;
  void Attach(vtkRenderer* renderer);
  void UpdateContents(vtkVolume* volume);
  void DrawRays(vtkRenderer* renderer, vtkVolume* volume);
  double IsoValue = 300.0;
  double SurfaceOpacity = 1.0;
  bool Counting = false;
  std::unique_ptr<Internals> Internal;
};
