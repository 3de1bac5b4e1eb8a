#pragma once

#include <string>

#include "Context.h"
#include "petrous/Scene/Placement.h"

namespace petrous::cli
{

/// ", drawn on the MR 'T2'", ", nowhere on the CT: it was drawn on ..."; empty for what lies in the
/// CT's patient space.
std::string placeText(const scene::Placement& placement);

/// Tells what of the case has no place on the CT and so takes no part in what is done.
void warnMissingPlaces(const Context& context, const scene::Case& value);

} // namespace petrous::cli
