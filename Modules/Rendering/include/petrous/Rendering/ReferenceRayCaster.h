#pragma once

#include <memory>
#include <vector>

#include "petrous/Core/CameraPose.h"
#include "petrous/Core/Progress.h"
#include "petrous/Rendering/Picture.h"
#include "petrous/Rendering/PixelRays.h"
#include "petrous/Rendering/SceneContents.h"

namespace petrous::rendering
{

struct ReferencePicture
{
  Picture picture;
  std::vector<float> rgb; ///< the same before rounding: 0 to 1, 3 a pixel, rows from the top
  DepthImage depth;       ///< to the first surface of the tissue, however transparent it is
};

/// The truth that pictures are held against: the optical model of src/Reference/OpticalModel.h followed along
/// each pixel's ray in double precision, by constant small steps and bisection, without skipping.
/// Meshes and the tool end a ray; a translucent mesh, which the GPU draws as a screen door, is the
/// mean over its pixels. Depth is that of the tissue in front of what is opaque.
///
/// Only the CPU is used, so it also draws where OpenGL is missing.
class ReferenceRayCaster
{
public:
  struct Quality
  {
    /// Of the smallest spacing of the CT, in (0, 1]. At the default, half of it changes a picture
    /// by less than 0.1 of an 8-bit level (RMS).
    double step = 1.0 / 16.0;
  };

  /// Shares the voxels of `contents` and reads the mask as it stands when `render` is called.
  /// Throws RenderingError BadContents where the contents contradict themselves (a material that is
  /// missing, a mask on another grid), InvalidParameter for a bad step.
  explicit ReferenceRayCaster(const SceneContents& contents);
  ReferenceRayCaster(const SceneContents& contents, const Quality& quality);
  ~ReferenceRayCaster();

  /// Throws RenderingError BadSize, InvalidParameter (a bad camera), CancelledError.
  ReferencePicture render(const core::CameraPose& camera, int width, int height,
                          const core::Progress& progress = {}) const;

private:
  class Implementation;
  std::unique_ptr<Implementation> m_implementation;
};

} // namespace petrous::rendering
