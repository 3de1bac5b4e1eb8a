#pragma once

#include <filesystem>
#include <vector>

#include "petrous/Core/BenchmarkReport.h"
#include "petrous/Core/Progress.h"

namespace petrous::cli
{

/// Opening a case of 512^3 voxels (quick: 96^3), up to its first picture: the phantom with all of
/// its structures, and an MR that the picture does not show. Seconds with everything in the cache;
/// the window, which a program makes while it starts, is there already.
///
/// Error: MB of the MR that are in the cache after a first picture with an empty one, that is, what
/// was read and is not shown: at most what the system reads ahead after a header (read_ahead_kb of
/// the disk). `mb_read` is what of all objects is there then, `mb_shown` the size of those that are
/// shown; both are missing where the file system keeps its pages (tmpfs).
///
/// Peer: the CT of that case read as a whole, and drawn by VTK's GPU mapper.
///
/// Throws rendering::RenderingError if no picture can be drawn, and CancelledError.
std::vector<core::BenchmarkPoint> openToPicture(const std::filesystem::path& work, bool quick,
                                                const core::Progress& progress);

} // namespace petrous::cli
