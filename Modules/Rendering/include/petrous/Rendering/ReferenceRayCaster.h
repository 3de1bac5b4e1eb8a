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
  std::vector<float> rgb; ///< RGB before rounding: 0 to 1, 3 values per pixel, top row first
  DepthImage depth;       ///< to the first tissue surface, regardless of its opacity
};

/// Ground truth for rendered pictures: evaluates the optical model of src/Reference/OpticalModel.h
/// along each pixel's ray in double precision, with small constant steps and bisection and without
/// empty-space skipping. Meshes and the tool end a ray; a translucent mesh, which the GPU draws
/// with screen-door transparency, is averaged over its pixels. Depth is that of tissue in front of
/// opaque geometry.
///
/// CPU only, so it works without OpenGL.
class ReferenceRayCaster
{
public:
  struct Quality
  {
    /// In units of the smallest CT spacing, in (0, 1]. Halving the default changes a picture by
    /// less than 0.1 of an 8-bit level (RMS).
    double step = 1.0 / 16.0;
    /// Of kPixelSamples, which goes through pixelSample and is lit as that; -1: the only one,
    /// through the centre.
    int sample = -1;
  };

  /// Shares the voxels of `contents` and reads the mask as it is when `render` is called. Throws
  /// RenderingError BadContents if the contents are inconsistent (a missing material, a mask on
  /// another grid), InvalidParameter for an invalid step.
  explicit ReferenceRayCaster(const SceneContents& contents);
  ReferenceRayCaster(const SceneContents& contents, const Quality& quality);
  ~ReferenceRayCaster();

  /// Throws RenderingError BadSize, InvalidParameter (invalid camera), CancelledError.
  ReferencePicture render(const core::CameraPose& camera, int width, int height,
                          const core::Progress& progress = {}) const;

private:
  class Implementation;
  std::unique_ptr<Implementation> m_implementation;
};

} // namespace petrous::rendering
