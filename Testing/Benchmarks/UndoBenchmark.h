#pragma once

#include <vector>

#include "petrous/Core/BenchmarkReport.h"
#include "petrous/Core/Progress.h"

namespace petrous::cli
{

/// Undo and redo of a stroke of 15 mm with a 4 mm burr on the phantom, redraw included: the mask,
/// the upload of what changed, and a frame near the cavity. Of 512^3 voxels of 0.15 mm; quick: of
/// 96^3, a stroke of as many voxels as fit.
///
/// Throws rendering::RenderingError where no picture can be drawn, and CancelledError.
std::vector<core::BenchmarkPoint> undoWithRedraw(bool quick, const core::Progress& progress);

} // namespace petrous::cli
