#pragma once

#include "Context.h"
#include "petrous/Scene/Case.h"

namespace petrous::cli
{

/// Says each part of a case with its look and flags, and gives them as JSON.
void listAppearance(const Context& context, const scene::Case& value);

/// The same of the catalogue of looks.
void listPresets(const Context& context);

} // namespace petrous::cli
