#pragma once

#include <optional>
#include <string>
#include <vector>

#include <CLI/App.hpp>
#include <nlohmann/json.hpp>

#include "petrous/Rendering/SceneContents.h"
#include "petrous/Scene/Case.h"

namespace petrous::cli
{

/// A camera in patient LPS mm: {"position_mm":[3],"focal_point_mm":[3],"view_up":[3]} with
/// "view_angle_deg" (vertical; 0.1 to 170) or "parallel_scale_mm" (half the height; 0.001 to 1e6).
/// Throws InvalidParameter naming the file and the expected content: missing file, other content,
/// non-finite numbers, degenerate camera.
core::CameraPose readCamera(const std::string& path);

/// The format that `readCamera` reads.
nlohmann::json cameraJson(const core::CameraPose& camera);

/// "x,y,z,nx,ny,nz" each, patient LPS mm. Throws UsageError.
std::vector<scene::ViewState::Clipping::Plane> parsePlanes(const std::vector<std::string>& texts);

/// Voxels of --crop, first and last, or the ones of a box --roi in patient LPS mm; neither:
/// nullopt. Throws UsageError, also if both are given.
std::optional<core::IndexBox> parseCrop(const std::string& crop, const std::string& roi,
                                        const core::GridGeometry& grid);

/// The lamp, of `render` and `view`; nullopt: not given.
struct LightOptions
{
  std::optional<double> falloff, wetness, exposure, edges, grain;
  std::optional<bool> shadows, toneCurve, exitSurfaces;

  bool any() const
  {
    return falloff || wetness || exposure || edges || grain || shadows || toneCurve || exitSurfaces;
  }
  /// What was given, in place of that of `light`.
  scene::ViewState::Light over(scene::ViewState::Light light) const;
};

/// `defaultText` ends the help of each, e.g. " (as saved)". The options must outlive the command.
void addLightOptions(CLI::App& command, LightOptions& options, const std::string& defaultText = {});

/// --background NAME|#rrggbb of pictures; `color` stays as it is where it is not given.
void addBackgroundOption(CLI::App& command, rendering::BackgroundColor& color);

} // namespace petrous::cli
