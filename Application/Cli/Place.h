#pragma once

#include <string>

#include "petrous/Scene/Case.h"

namespace petrous::cli
{

/// A patient point given on the command line.
struct Place
{
  Eigen::Vector3d point; ///< patient LPS mm
  std::string words;     ///< the structure's name; empty for coordinates
};

/// "x,y,z" in patient LPS mm, or the name of a structure or a mesh: its centroid on the CT. Throws
/// UsageError naming `option` if it is neither, InvalidParameter if it cannot be placed on the CT.
Place parsePlace(const std::string& text, const scene::Case& value, const std::string& option);

} // namespace petrous::cli
