#pragma once

#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

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

} // namespace petrous::cli
