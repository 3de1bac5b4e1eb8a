#pragma once

#include <filesystem>
#include <vector>

#include <Eigen/Core>

namespace petrous::cli
{

/// Patient points, LPS mm, from a CSV file with columns x_mm, y_mm and z_mm. Throws
/// InvalidParameter naming file and line.
std::vector<Eigen::Vector3d> readPoints(const std::filesystem::path& path);

} // namespace petrous::cli
