#pragma once

#include "Context.h"
#include "petrous/Scene/Case.h"

namespace petrous::cli
{

/// Prints each part of a case with its appearance and flags, or as JSON.
void listAppearance(const Context& context, const scene::Case& value);

/// As above, for the catalogue of presets.
void listPresets(const Context& context);

} // namespace petrous::cli
