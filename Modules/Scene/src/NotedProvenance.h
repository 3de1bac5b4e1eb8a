#pragma once

#include <string>
#include <vector>

#include "petrous/Scene/Case.h"

namespace petrous::scene
{

// Provenance as the notes of cases say it that were saved before it was recorded. Their sentences
// are those of programs up to November 2026, whatever is noted today.

/// Of more than 24 gaps the notes name the first and the last slice alone: all between count as
/// interpolated. Slices of another count than the grid's (`slices`) are none.
volume::ImageProvenance provenanceFromNotes(const std::vector<std::string>& notes, int slices);

LabelProvenance labelProvenanceFromNotes(const std::vector<std::string>& notes);

} // namespace petrous::scene
