#pragma once

#include "petrous/Core/Progress.h"
#include "petrous/Volume/CutMask.h"
#include "petrous/Volume/TissueField.h"

namespace petrous::dissection
{

/// How far in front of a surface tissue covers it, mm.
constexpr double kCover = 0.5;

/// Area of a structure's surface that the drilling has laid open, mm^2: where it had tissue within
/// kCover before it and now has none there, or is cut itself. What lay open before, as in an air
/// cell, does not count.
///
/// tissue  asked for f before any mask
/// mask    on its grid
/// share   of the structure; the surface is its 1/2 level (SmoothedUnion.h)
/// Throws CancelledError.
double exposedArea(const volume::TissueField& tissue, const volume::CutMask& mask,
                   const volume::Volume<float>& share, const core::Progress& progress = {});

} // namespace petrous::dissection
