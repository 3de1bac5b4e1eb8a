#pragma once

#include <string>

#include "petrous/Core/Progress.h"
#include "petrous/Scene/StructureOccupancy.h"

namespace petrous::presenters
{

/// The structure or mesh of that name; of a mesh the voxels are made, and kept with the case.
/// Throws InvalidParameter "WHAT: ..." that lists those that there are, or says why it has no place
/// on the CT.
scene::StructureOccupancy namedOccupancy(const scene::Case& value, const std::string& structure,
                                         const std::string& what,
                                         const core::Progress& progress = {});

} // namespace petrous::presenters
