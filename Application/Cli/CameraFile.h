#pragma once

#include <string>

#include <nlohmann/json.hpp>

#include "petrous/Core/CameraPose.h"

namespace petrous::cli
{

/// A camera in patient LPS mm: {"position_mm":[3],"focal_point_mm":[3],"view_up":[3]} with
/// "view_angle_deg" (vertical; 0.1 to 170) or "parallel_scale_mm" (half the height; 0.001 to 1e6).
/// Throws InvalidParameter naming the file and what would be right: no such file, another content,
/// numbers that are not finite or point nowhere.
core::CameraPose readCamera(const std::string& path);

/// What `readCamera` reads.
nlohmann::json cameraJson(const core::CameraPose& camera);

} // namespace petrous::cli
