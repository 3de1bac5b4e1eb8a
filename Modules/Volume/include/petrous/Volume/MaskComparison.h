#pragma once

#include <cstddef>

#include "petrous/Volume/CutMask.h"

namespace petrous::volume
{

/// Voxels of two masks on one grid that differ.
std::size_t differentVoxels(const CutMask& a, const CutMask& b);

} // namespace petrous::volume
