#pragma once

#include <string>

#include "petrous/Scene/Case.h"

namespace petrous::cli
{

/// A point of the patient as the command line names it.
struct Place
{
  Eigen::Vector3d point; ///< patient LPS mm
  std::string words;     ///< the structure's name; empty for a point in numbers
};

/// "x,y,z" in patient LPS mm, or the name of a structure or a mesh: its centre of gravity on the
/// CT. UsageError naming `option` for what is neither, InvalidParameter for what has no place on
/// the CT.
Place parsePlace(const std::string& text, const scene::Case& value, const std::string& option);

} // namespace petrous::cli
