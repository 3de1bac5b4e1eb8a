#pragma once

#include <filesystem>

#include "petrous/Core/BenchmarkReport.h"
#include "petrous/Core/Progress.h"

namespace petrous::cli
{

/// Delays between what a hand does and what it feels and hears.
///
/// "server to force": a device server in a process of its own, and a servo's thread of 1 kHz that
/// answers each pose with a force at once. From the measurement of the pose to the motors' having
/// the force that answers it, with percentiles. A server that exchanges without a pause shows what
/// the border of the processes adds; one of 1 kHz also has the waits of two clocks.
///
/// "contact to sound": a touch session that taps on the phantom; from the beginning of a tick to
/// its being heard (TouchSession::Setup::heard), then the wait for the speaker's next block, then
/// the samples until half of the change in loudness has come. The sound card's own delay comes on
/// top. With it the spectral centroid of the sound over the thickness of the wall.
///
/// quick: a second of each. Throws CancelledError, core::Error.
core::BenchmarkReport runDelaysBenchmark(const std::filesystem::path& work, bool quick,
                                         const core::Progress& progress);

} // namespace petrous::cli
