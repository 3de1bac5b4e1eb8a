#pragma once

#include <string>
#include <vector>

#include "petrous/Core/RigidTransform.h"
#include "petrous/Registration/Landmarks.h"

namespace petrous::cli
{

/// Landmark pairs, CSV ct_x,ct_y,ct_z,mr_x,mr_y,mr_z in patient LPS mm, that determine a rigid
/// transform. Throws InvalidParameter naming file and line.
std::vector<registration::LandmarkPair> readLandmarks(const std::string& path);

/// X_MC from a file: 16 numbers, row-major, or JSON with them under "transform" (as in the output
/// of `petrous register --json`). Throws InvalidParameter naming the file.
core::RigidTransform readTransform(const std::string& path);

} // namespace petrous::cli
