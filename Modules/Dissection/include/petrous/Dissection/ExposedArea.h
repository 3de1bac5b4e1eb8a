#pragma once

#include "petrous/Core/Progress.h"
#include "petrous/Volume/CutMask.h"
#include "petrous/Volume/TissueField.h"

namespace petrous::dissection
{

/// How far in front of a surface, or of the soft tissue on it, tissue covers it, mm.
constexpr double kCover = 0.5;

/// The thickest soft tissue without a label (mucosa, dura, the wall of a sinus that was drawn too
/// narrow) between a structure and the tissue that covers it, mm.
constexpr double kLayer = 2.0;

/// Area of a structure's surface that the drilling has laid open, mm^2. Along its normal one meets
/// first, within kLayer, what was tissue (f > 0) before the cut: bone, or another structure. Where
/// that and all tissue within kCover is gone now, the surface is open towards the cavity. A surface
/// that is cut itself is too, where it was covered so.
///
/// What lay open before, as in an air cell, does not count: between the surface and a cover that
/// begins farther than kCover there must be no air (below -300 HU).
///
/// tissue  asked for f before any mask
/// mask    on its grid
/// occupancy   of the structure; the surface is its 1/2 level (SmoothedUnion.h)
/// Throws CancelledError.
double exposedArea(const volume::TissueField& tissue, const volume::CutMask& mask,
                   const volume::Volume<float>& occupancy, const core::Progress& progress = {});

} // namespace petrous::dissection
