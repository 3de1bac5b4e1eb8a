#pragma once

#include <cstddef>

#include "petrous/Volume/CutMask.h"

namespace petrous::volume
{

/// Number of voxels that differ between two masks on one grid.
std::size_t differentVoxels(const CutMask& a, const CutMask& b);

} // namespace petrous::volume
