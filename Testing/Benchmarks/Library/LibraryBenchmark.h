#pragma once

#include <filesystem>

#include "petrous/Core/BenchmarkReport.h"
#include "petrous/Core/Progress.h"

namespace petrous::library
{

/// Archiving, restoring and verifying a case with a CT of 512^3 (quick: 128^3), and lists of 10,000
/// cases (quick: 300). The CT is a layered ball with noise of 15 HU, which compresses as a
/// scanner's does.
///
/// Error: of archive and restore the voxels that differ after restoring; of the lists the cases
/// that are missing or too many. `mb` is the size of what was written, `mb_per_core_second` the
/// input over the processor time. Medians of 3 (quick: 1); caches are warm.
///
/// Peers, as processes of their own on the very same file: gzip -6 (as in 3D Slicer's NRRD), zip
/// -6, tar --zstd; sha256sum for verify.
///
/// workFolder  temporary location of the files (2 GB)
core::BenchmarkReport runLibraryBenchmark(const std::filesystem::path& workFolder, bool quick,
                                          const core::Progress& progress);

} // namespace petrous::library
