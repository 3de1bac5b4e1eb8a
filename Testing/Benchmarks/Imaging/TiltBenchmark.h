#pragma once

#include <filesystem>

#include "petrous/Core/BenchmarkReport.h"
#include "petrous/Core/Progress.h"

namespace petrous::imaging
{

/// Import, with repair, of a phantom of 27 balls scanned with the gantry tilted by -30 to 30
/// degrees, and where the balls' centres are found then.
///
/// Error: largest distance of a centre (weighted by density) from where the ball is, in voxels of
/// the repaired grid. `mean_voxels` is the mean of the 27. The peers are the same slices by ITK's
/// series reader, which takes them to be straight above one another, and by dcm2niix, where it is
/// installed.
///
/// workFolder  temporary location of the series (quick: 4 MB; otherwise 10 MB)
core::BenchmarkReport runTiltBenchmark(const std::filesystem::path& workFolder, bool quick,
                                       const core::Progress& progress);

} // namespace petrous::imaging
