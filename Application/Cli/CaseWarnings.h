#pragma once

#include <string>

#include "Context.h"
#include "petrous/Scene/Placement.h"

namespace petrous::cli
{

/// ", drawn on the MR 'T2'", ", nowhere on the CT: it was drawn on ..."; empty if it is in the CT's
/// patient space.
std::string placeText(const scene::Placement& placement);

/// Warns of parts that cannot be placed on the CT and are therefore ignored.
void warnMissingPlaces(const Context& context, const scene::Case& value);

} // namespace petrous::cli
