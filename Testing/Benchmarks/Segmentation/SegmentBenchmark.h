#pragma once

#include "petrous/Core/BenchmarkReport.h"
#include "petrous/Core/Progress.h"

namespace petrous::segmentation
{

/// The operations on masks against ITK's filters on the same voxels in the same run, alternating,
/// on one thread and on all cores, of which the faster counts; medians of 5 (quick: 3) after a
/// warm-up. ITK 5.2 has no grow-cut: growing from strokes has no peer.
///
/// Truth is the balls of which the image consists. Error: mean distance (mm) of the faces between
/// voxels of the mask and others from the balls' surface; `volume_percent` is how far the mask's
/// volume lies from the balls'.
///
/// Strokes are painted at 512^3 (quick: 128^3): `undo_percent` is what a step keeps, of the mask's
/// bytes, and `differing_voxels` those that undo and redo do not bring back. The peer is a copy of
/// the mask for each stroke.
core::BenchmarkReport runSegmentBenchmark(bool quick, const core::Progress& progress);

} // namespace petrous::segmentation
