#pragma once

#include <vector>

#include "petrous/Library/Journal.h"
#include "petrous/Scene/Case.h"

namespace petrous::library
{

bool sameHistory(const dissection::History& a, const dissection::History& b);

/// Whether a case has the CT of an earlier state and its strokes, before all others.
bool goesOnFrom(const scene::Case& value, const SavedState& base);

/// Three-way merge of two continuations of `base`: `now`, saved by another program, and `drilled`,
/// with the voxels of its new strokes. New strokes keep their parent stroke. Branches changed on
/// one side only are taken from that side; if both changed a branch, the drilled one gets a name of
/// its own ("main~1"). The current branch is the drilled one.
///
/// `now` must continue `base` and have its dissection loaded, as has the result. Throws
/// InvalidParameter if the strokes do not fit.
scene::Case graft(const scene::Case& now, const SavedState& base,
                  const dissection::Dissection& drilled);

} // namespace petrous::library
