#pragma once

#include <filesystem>

#include "petrous/Core/BenchmarkReport.h"
#include "petrous/Core/Progress.h"

namespace petrous::imaging
{

/// Import of structures: RT structure sets, and a DICOM segmentation of 400 frames (quick: 40).
///
/// Error: how far the volume of a structure's voxels lies from what its polygons enclose by the
/// shoelace formula, times the distance of their planes; of structures of 50 voxels and more, in
/// percent. Of the segmentation: the worst of its segments against what was written.
/// `peak_label_grids` is the peak memory in units of the label grid. Medians of 5 (quick: 3) after
/// a warm-up.
///
/// The peers run as processes of their own where they are installed: plastimatch on structure sets,
/// pydicom and numpy on the segmentation (its time is without the interpreter's start).
///
/// workFolder  temporary location of the files (60 MB)
/// data        folder with published structure sets, each beside its images; empty: only those
///             written here
core::BenchmarkReport runStructuresBenchmark(const std::filesystem::path& workFolder,
                                             const std::filesystem::path& data, bool quick,
                                             const core::Progress& progress);

} // namespace petrous::imaging
