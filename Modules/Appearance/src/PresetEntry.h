#pragma once

#include <nlohmann/json_fwd.hpp>

#include "petrous/Appearance/StructureAppearance.h"

namespace petrous::appearance
{

/// An entry of a catalogue of presets is what a manifest has, but for flags and source image, with
/// the preset's name as "name" and whose values it has as "values_of" (OwnPresets). Throws
/// InvalidParameter naming the preset, nlohmann::json::exception for a missing name.
StructureAppearance presetFrom(nlohmann::json entry);
nlohmann::json presetJson(const StructureAppearance& preset);

} // namespace petrous::appearance
