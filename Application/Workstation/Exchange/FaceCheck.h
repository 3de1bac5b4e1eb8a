#pragma once

#include <string>
#include <vector>

#include "petrous/Scene/Case.h"

namespace petrous::workstation
{

/// presenters::facesToMask, with a wait cursor. Nothing for a case whose images cannot be read:
/// what is done with it says so.
std::vector<std::string> facesIn(const scene::Case& value);

} // namespace petrous::workstation
