#pragma once

#include <string>

#include "petrous/Scene/Case.h"

namespace petrous::scene
{

/// Removes the MR of this name, also where a structure or a mesh of an older case has it, too, as
/// removePart does where none has. Throws InvalidParameter if there is none, Error (Refused) if
/// structures or meshes were drawn on it.
void removeMr(Case& value, const std::string& name);

} // namespace petrous::scene
