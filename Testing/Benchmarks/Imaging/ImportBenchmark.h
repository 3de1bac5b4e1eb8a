#pragma once

#include <filesystem>

#include "petrous/Core/BenchmarkReport.h"
#include "petrous/Core/Progress.h"

namespace petrous::imaging
{

/// Import of a DICOM series (headers, checks, voxels) against ITK's series reader on the same files
/// in the same run, alternating; medians of 5 (quick: 3) after a warm-up.
///
/// Error: largest voxel difference from what was written, HU. Further figures: largest difference
/// of a grid corner (mm), voxel difference from ITK, time of the header scan, and peak
/// memory beyond the volume itself (MB; 0 in `extra` is a measured 0).
///
/// Then 64 slices (quick: 8 small ones) in each lossless transfer syntax, likewise.
///
/// Then the scan of 5,000 small files in 10 series (quick: 500 in one) against gdcm::Scanner on one
/// thread, which reads ten values of each; a second scan takes the headers from the cache. Error:
/// largest distance of a grid's corner (gdcm: of a slice) from where it was written, mm.
///
/// workFolder  temporary location of the series (quick: 64 slices of 256 x 256, 8 MB; otherwise 512
///             of 512 x 512, 268 MB), and then of the 5,000 files (45 MB)
core::BenchmarkReport runImportBenchmark(const std::filesystem::path& workFolder, bool quick,
                                         const core::Progress& progress);

} // namespace petrous::imaging
