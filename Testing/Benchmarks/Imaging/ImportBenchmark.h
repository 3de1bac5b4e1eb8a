#pragma once

#include <filesystem>

#include "petrous/Core/BenchmarkReport.h"
#include "petrous/Core/Progress.h"

namespace petrous::imaging
{

/// Import of a DICOM series (headers, verdict, voxels) against ITK's series reader on the same
/// files in the same run, in turns; medians of 5 (quick: 3) after a warm-up.
///
/// Error: largest voxel difference from what was written, HU. Further figures: the largest
/// difference of a corner of the grid (mm), the voxel difference from ITK, the scan's share of
/// the time, and the peak memory above the volume itself (MB; 0 in `extra` is a real 0).
///
/// workFolder  takes the series (quick: 64 slices of 256 x 256, 8 MB; else 512 of 512 x 512,
///             268 MB), which is removed again
core::BenchmarkReport runImportBenchmark(const std::filesystem::path& workFolder, bool quick,
                                         const core::Progress& progress);

} // namespace petrous::imaging
