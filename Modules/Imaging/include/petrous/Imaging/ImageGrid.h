#pragma once

#include "petrous/Core/GridGeometry.h"

namespace petrous::imaging
{

/// The grid of an image on which labels may have been drawn.
struct ImageGrid : core::GridGeometry
{
  ImageGrid(const core::GridGeometry& grid, bool isAssumed = false)
    : core::GridGeometry(grid)
    , isSideAssumed(isAssumed)
  {
  }
  /// Its file left open which side of the patient is left (readImageFile).
  bool isSideAssumed;
};

} // namespace petrous::imaging
