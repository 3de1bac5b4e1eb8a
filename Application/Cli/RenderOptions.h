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

/// The words of `petrous render`.
struct RenderOptions
{
  std::string caseName, out, size = "800x600", view, camera, stereo = "none", engine = "gpu", depth;
  std::string thickness;
  std::string crop, roi;
  std::vector<std::string> clip;
  std::optional<double> eyeSeparation, convergence;
  double falloff = 0.0;
  double wetness = 0.0;
};

/// What a picture is taken with.
struct Shot
{
  int width = 0;
  int height = 0;
  core::CameraPose camera;
  rendering::StereoMode stereo = rendering::StereoMode::None;
  std::vector<core::CameraPose> eyes; ///< one, or left and right
};

void addRenderOptions(CLI::App& command, RenderOptions& options);

/// All that needs no case: size and way of stereo. Throws UsageError for what cannot be.
Shot parseShot(const RenderOptions& options);

/// What the case shows, under the lamp and with the planes and the box of the options.
rendering::SceneContents renderContents(const RenderOptions& options, const scene::Case& value);

} // namespace petrous::cli
