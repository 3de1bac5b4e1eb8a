#pragma once

namespace petrous::imaging
{

/// Memory of this process in MB (1e6 bytes); 0 if the system does not tell.
double residentMb();
double peakMb(); ///< since resetPeakMemory
void resetPeakMemory();

} // namespace petrous::imaging
