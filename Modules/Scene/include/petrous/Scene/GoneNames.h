#pragma once

#include <string>

#include "petrous/Scene/Case.h"

namespace petrous::scene
{

/// Takes out of a copy that leaves the house what still names parts that the case does not have, or
/// that have another name by now: nobody sees these names any more, and one may be a patient's.
///
/// A note, or the reason for a registration's verdict, that quotes ('NAME') what is no part of the
/// case is dropped as a whole; the place of a registration's error becomes kUnnamedPlace; and
/// forgetGoneReferences. A measurement forgets the structure that is gone, and the name of the MR,
/// not that it was set on one. Strokes keep the names of the structures that they touched.
void forgetGoneNames(Case& value);

/// Forgets an MR that the case does not have: over the slices, through which a registration went,
/// or whose intensities a structure shows.
void forgetGoneReferences(Case& value);

constexpr const char* kUnnamedPlace = "the middle of a structure";

/// Whether all that a text quotes are parts of the case.
bool quotesOnlyParts(const Case& value, const std::string& text);

} // namespace petrous::scene
