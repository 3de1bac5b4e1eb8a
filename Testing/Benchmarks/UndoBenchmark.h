#pragma once

#include <vector>

#include "petrous/Core/BenchmarkReport.h"
#include "petrous/Core/Progress.h"

namespace petrous::cli
{

/// Undo and redo of a 15 mm stroke with a 4 mm burr on the phantom, including the redraw: mask
/// update, upload of the changes, and a frame near the cavity. 512^3 voxels of 0.15 mm; quick: 96^3
/// voxels, and as many voxels of the stroke as fit.
///
/// Throws rendering::RenderingError if no picture can be drawn, and CancelledError.
std::vector<core::BenchmarkPoint> undoWithRedraw(bool quick, const core::Progress& progress);

} // namespace petrous::cli
