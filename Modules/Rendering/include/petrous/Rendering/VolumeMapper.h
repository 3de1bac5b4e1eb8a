#pragma once

#include <exception>
#include <memory>

#include <vtkVolumeMapper.h>

#include "petrous/Core/GridGeometry.h"
#include "petrous/Rendering/Picture.h"
#include "petrous/Rendering/RenderQuality.h"
#include "petrous/Rendering/SceneContents.h"

/// One-pass ray caster of CT, structures, cut and a second image (Documentation/rendering.md), for
/// vtkVolume in any VTK program.
///
/// Two ways to say what is drawn. With SetInputData alone the image is drawn as CT: its surface at
/// IsoValue with SurfaceOpacity, inside it the colours and the opacity (over
/// ScalarOpacityUnitDistance) of the vtkVolumeProperty. SetContents gives everything, in patient
/// LPS mm; the prop's matrix, if any, then moves the patient in the world.
///
/// VTK's clipping planes (world) and the cropping region (sub-volume only) are obeyed. Opaque
/// polygons are intermixed. Scalars: int16, uint16 or float; others are refused with an error.
/// The mapper belongs to one window. Main thread only.
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

  /// A box of CT voxels of the mask changed, to less or to more; null: nothing is cut any more.
  /// Throws nothing; the change shows in the next frame (under a cap, see statistics).
  void MaskChanged(std::shared_ptr<const petrous::volume::CutMask> mask,
                   const petrous::core::IndexBox& box);

  /// Makes the mask ready before anything is cut; without it, a mask in which nothing is cut costs
  /// nothing.
  void ExpectCut(bool expected);

  /// Throws InvalidParameter.
  void SetQuality(const petrous::rendering::RenderQuality& quality);
  const petrous::rendering::RenderQuality& GetQuality() const;

  /// Counts fetches and samples in the frames that follow, at the price of their time.
  vtkSetMacro(Counting, bool);
  vtkGetMacro(Counting, bool);
  const petrous::rendering::RenderStatistics& GetStatistics() const;

  /// Distance to the first surface of the last frame, mm along each pixel's ray, rows from the top.
  /// Makes the window's context current.
  petrous::rendering::DepthImage GetDepth();

  /// The same at one pixel of the renderer's part of the window, rows from the top; NaN: none.
  float GetDepthAt(double column, double row);

  /// What went wrong in the last frame (RenderingError, InvalidParameter), once; null: nothing.
  /// Render itself does not throw; it also reports a VTK error.
  std::exception_ptr TakeError();

  void Render(vtkRenderer* renderer, vtkVolume* volume) override;
  void ReleaseGraphicsResources(vtkWindow* window) override;

protected:
  vtkPetrousVolumeMapper();
  ~vtkPetrousVolumeMapper() override;

private:
  class Internals;
  void UpdateContents(vtkVolume* volume);
  void DrawRays(vtkRenderer* renderer, vtkVolume* volume);
  double IsoValue = 300.0;
  double SurfaceOpacity = 1.0;
  bool Counting = false;
  std::unique_ptr<Internals> Internal;
};
