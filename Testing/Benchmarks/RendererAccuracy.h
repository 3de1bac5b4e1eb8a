#pragma once

#include <string>
#include <vector>

#include "PictureError.h"
#include "TimedView.h"
#include "petrous/Core/BenchmarkReport.h"
#include "petrous/Core/CameraPose.h"
#include "petrous/Core/Progress.h"
#include "petrous/Rendering/RenderQuality.h"
#include "petrous/Rendering/SceneContents.h"

namespace petrous::cli
{

struct PictureSize
{
  int width = 0;
  int height = 0;
};

std::string shown(const PictureSize& size); ///< "640x480"

/// A scene's reference picture, and the error of the renderer against it.
class SceneTruth
{
public:
  SceneTruth(const rendering::SceneContents& contents, const core::CameraPose& camera,
             const PictureSize& size, const core::Progress& progress);

  rendering::PictureError errorOf(const rendering::RenderQuality& quality) const;

  /// Stores the error at a quality in a point: error, unit and further figures.
  void enter(const rendering::RenderQuality& quality, core::BenchmarkPoint& point) const;

private:
  rendering::SceneContents m_contents;
  core::CameraPose m_camera;
  PictureSize m_size;
  std::vector<float> m_rgb;
  rendering::DepthImage m_depth;
};

/// Time (in `view`) and error, varying one setting of RenderQuality at a time. frames: minimum
/// number for each median.
std::vector<core::BenchmarkPoint> sweepQuality(const rendering::SceneContents& contents,
                                               const core::CameraPose& camera,
                                               const SceneTruth& truth, const std::string& scene,
                                               rendering::TimedView& view, int frames,
                                               const core::Progress& progress);

/// First hits on an oblique plane and on a ball, against their equations.
std::vector<core::BenchmarkPoint> shapeDepths(const PictureSize& size);

} // namespace petrous::cli
