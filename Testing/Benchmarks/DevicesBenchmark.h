#pragma once

#include "petrous/Core/BenchmarkReport.h"
#include "petrous/Core/Progress.h"

namespace petrous::cli
{

/// Stability of the coupling over stiffness (0.25 to 10 N/mm) and delay (0 to 8 ms), for handles
/// such as those of the devices that have a server, and for mass and damper alone; with and without
/// the passivity guard, and with 0, 1 and 5 % of the ticks missed, the 5 % also
/// three at once. A hand presses 30 times on a wall (haptics::press).
///
/// One point per device, guard, missed ticks and delay, with the energy that comes out (mJ, worst
/// cycle) and the force's range at rest (N, peak to peak) at each stiffness; the largest stable
/// stiffness of those; what the product would set (what the device's server describes, and what
/// `petrous device-test` measures and keeps), with margins; and the bound of passivity. Without
/// guard and missed ticks, of mass and damper alone, also the border itself.
///
/// quick: two devices, few stiffnesses and delays, and 1 s of rest. Throws CancelledError.
core::BenchmarkReport runDevicesBenchmark(bool quick, const core::Progress& progress);

} // namespace petrous::cli
