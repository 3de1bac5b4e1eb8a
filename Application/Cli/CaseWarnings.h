#pragma once

#include <string>

#include "Context.h"
#include "petrous/Presenters/LeftOut.h"
#include "petrous/Scene/Placement.h"

namespace petrous::cli
{

/// ", drawn on the MR 'T2'", ", nowhere on the CT: it was drawn on ..."; empty if it is in the CT's
/// patient space.
std::string placeText(const scene::Case& value, const scene::Placement& placement);

/// ", made from the MR 'T2'", and why its error is not known if the MR lies elsewhere since; empty
/// if it was made from none.
std::string madeText(const scene::Case& value, const scene::MrReadings& readings);

/// Warns of structures made from an MR that lies elsewhere since (scene::outdatedReading).
void warnOutdated(const Context& context, const scene::Case& value);

/// Warns of parts that cannot be placed on the CT and are therefore ignored.
void warnMissingPlaces(const Context& context, const scene::Case& value);

/// If soft tissue would not be drawn, why.
void warnOfSoftTissue(const Context& context, const scene::Case& value);

/// Warns of MRs that bone or structures read and that are not drawn, since others are.
void warnOfMrs(const Context& context, const scene::Case& value);

/// Warns of an ear that the case does not have by its side or by the place of its images;
/// Unknown: none is meant.
void warnOfEar(const Context& context, const scene::Case& value, scene::Side ear);
/// The same of a standard view by its name; of the lateral one if the ear is not known
/// (guessedEar).
void warnOfView(const Context& context, const scene::Case& value, const std::string& view);
/// The same of the view that presenters::currentCamera takes.
void warnOfCurrentView(const Context& context, const scene::Case& value);

/// The same parts: an array of "structure" and "text".
nlohmann::json missingPlacesJson(const scene::Case& value);

/// The option --without-damaged.
void addWithoutDamaged(CLI::App& command, bool& chosen);

/// Checks all structures of the case, also those that the command would not read. Leaves out those
/// that are missing or damaged, with a warning each, if that was chosen; otherwise throws
/// StructureError.
presenters::LeftOut leaveOutDamaged(const Context& context, const library::Library& library,
                                    scene::Case& value, bool chosen);

/// What was left out: an array, an entry for each object.
nlohmann::json leftOutJson(const scene::Case& value, const presenters::LeftOut& leftOut);

} // namespace petrous::cli
