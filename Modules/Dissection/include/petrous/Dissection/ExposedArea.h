#pragma once

#include "petrous/Core/Progress.h"
#include "petrous/Volume/CutMask.h"
#include "petrous/Volume/TissueField.h"

namespace petrous::dissection
{

/// Depth of tissue in front of a surface, or of the soft tissue on it, that counts as cover, mm.
constexpr double kCover = 0.5;

/// Maximum thickness of unlabelled soft tissue (mucosa, dura, the wall of a sinus whose
/// segmentation is too narrow) between a structure and the tissue that covers it, mm.
constexpr double kLayer = 2.0;

/// Area of a structure's surface exposed by drilling, mm^2. Along the outward normal, the first
/// tissue (f > 0) before the cut, bone or another structure, is the cover; it begins within kLayer.
/// A surface point is exposed if the cover, and all tissue within kCover, is now removed. A point
/// that is cut itself also counts, provided that it had such a cover.
///
/// Surface that was exposed before, as in an air cell, does not count: between the surface and a
/// cover that begins farther than kCover there must be no air (below -300 HU).
///
/// tissue     evaluated before any mask
/// mask       on the grid of the tissue
/// occupancy  of the structure; the surface is its 1/2 level (SmoothedUnion.h)
/// Throws CancelledError.
double exposedArea(const volume::TissueField& tissue, const volume::CutMask& mask,
                   const volume::Volume<float>& occupancy, const core::Progress& progress = {});

} // namespace petrous::dissection
