#pragma once

#include <vector>

#include "petrous/Library/Journal.h"
#include "petrous/Scene/Case.h"

namespace petrous::library
{

bool sameHistory(const dissection::History& a, const dissection::History& b);

/// Whether a case has the CT and, before all others, the strokes of an earlier state.
bool goesOnFrom(const scene::Case& value, const SavedState& base);

/// What was drilled since `base`.
struct Drilled
{
  std::vector<scene::StrokePart> strokes; ///< new ones, with their voxels
  dissection::History history;            ///< of those of `base` and these
};

/// Three-way merge of two lines of work since `base`: `now`, which another program saved, and what
/// was drilled. New strokes keep the stroke that they follow. Branches that only one side changed
/// are that side's; where both did, the drilled one gets a name of its own ("main~1"). The present
/// branch is the drilled one.
///
/// `now` goes on from `base` and has its dissection loaded, and so has the result. Throws
/// InvalidParameter where the strokes do not fit.
scene::Case graft(const scene::Case& now, const SavedState& base, const Drilled& drilled);

} // namespace petrous::library
