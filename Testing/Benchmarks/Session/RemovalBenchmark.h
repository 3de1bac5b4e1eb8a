#pragma once

#include "petrous/Core/BenchmarkReport.h"
#include "petrous/Core/Progress.h"

namespace petrous::session
{

/// Bone removal by the removal laws, with the burr pressed on a block with constant thrust through
/// servo, tool and loop; times are CPU times of dissection steps that remove something:
///
/// - removed + owed + forfeited against the law, over ticks, voxels, thrusts, elevations, both laws
/// - the same and the step time over burrs and voxels, with the burr moved to and fro
/// - the same compared with voxel deletion as in the volumetric_drilling simulator
/// - the surface of a groove against the balls that made it
core::BenchmarkReport runRemovalBenchmark(bool quick, const core::Progress& progress);

} // namespace petrous::session
