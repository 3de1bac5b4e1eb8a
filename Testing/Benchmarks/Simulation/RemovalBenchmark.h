#pragma once

#include "petrous/Core/BenchmarkReport.h"
#include "petrous/Core/Progress.h"

namespace petrous::simulation
{

/// Bone removed by the laws, the burr pressed on a block with constant thrust through servo, tool
/// and loop; times are the processor's, of dissection steps that take something:
///
/// - removed + owed + forfeited against the law, over ticks, voxels, thrusts, elevations, both laws
/// - the same and the time of a step over burrs and voxels, the burr led to and fro
/// - the same beside the voxel-deleting rule of the volumetric_drilling simulator
/// - the surface of a groove against the balls that made it
core::BenchmarkReport runRemovalBenchmark(bool quick, const core::Progress& progress);

} // namespace petrous::simulation
