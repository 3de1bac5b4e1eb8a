#pragma once

#include <optional>
#include <string>
#include <vector>

#include "Context.h"
#include "petrous/Rendering/SceneContents.h"
#include "petrous/Rendering/Stereo.h"
#include "petrous/Scene/Case.h"

namespace petrous::cli
{

/// The options of `petrous render`.
struct RenderOptions
{
  std::string caseName, out, size = "800x600", view, camera, stereo = "none", engine = "gpu", depth;
  std::string thickness;
  std::string crop, roi;
  std::vector<std::string> clip;
  std::optional<double> eyeSeparation, convergence;
  double falloff = 0.0;
  double wetness = 0.0;
  bool withoutDamaged = false;
};

/// Size, camera and stereo mode of a picture.
struct Shot
{
  int width = 0;
  int height = 0;
  core::CameraPose camera;
  rendering::StereoMode stereo = rendering::StereoMode::None;
  std::vector<core::CameraPose> eyes; ///< one, or left and right
};

void addRenderOptions(CLI::App& command, RenderOptions& options);

/// Everything that needs no case: size and stereo mode. Throws UsageError for invalid values.
Shot parseShot(const RenderOptions& options);

/// The case's scene, with the options' lamp, planes and box.
rendering::SceneContents renderContents(const RenderOptions& options, const scene::Case& value);

} // namespace petrous::cli
