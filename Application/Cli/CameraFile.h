#pragma once

#include <string>

#include <nlohmann/json.hpp>

#include "petrous/Core/CameraPose.h"

namespace petrous::cli
{

/// A camera in patient LPS mm: {"position_mm":[3],"focal_point_mm":[3],"view_up":[3]} with
/// "view_angle_deg" (vertical; 0.1 to 170) or "parallel_scale_mm" (half the height; 0.001 to 1e6).
/// Throws InvalidParameter naming the file and the expected content: missing file, other content,
/// non-finite numbers, degenerate camera.
core::CameraPose readCamera(const std::string& path);

/// The format that `readCamera` reads.
nlohmann::json cameraJson(const core::CameraPose& camera);

} // namespace petrous::cli
