#pragma once

#include <filesystem>
#include <vector>

#include "petrous/Core/BenchmarkReport.h"
#include "petrous/Core/Progress.h"

namespace petrous::cli
{

/// A live session as the window has it (TouchSession at 1 kHz, real-time priority if permitted,
/// frames of 60 Hz), `seconds` long for a 4 mm burr of 2,000 points, and for a sixth of that (not
/// less than 20 s, if there are as many) with 10,000. A simulated device with tremor is held by a
/// hand that touches, drills, sweeps and lifts, at random with a fixed seed, on the largest
/// readable CT below `data` with its structures and cavity, or on the phantom (256^3 voxels, 96^3
/// when quick).
///
/// One point per number of points and quantile of the tick's wall time and of its lateness, and a
/// summary of each. A run's own memory does not grow with its length but for the strokes.
///
/// Throws core::Error if removal stops, and CancelledError.
std::vector<core::BenchmarkPoint> runLiveServo(double seconds, bool quick,
                                               const std::filesystem::path& data,
                                               const core::Progress& progress);

} // namespace petrous::cli
