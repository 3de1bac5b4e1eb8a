#pragma once

#include "petrous/Imaging/SeriesGeometry.h"
#include "petrous/Scene/ImagePart.h"

namespace petrous::presenters
{

/// What is known of an image of a case; of an older case as its notes say it. Of very many
/// interpolated slices these name only the first and last; then all between are returned.
scene::ImageFacts factsOf(const scene::ImagePart& image);

/// As its reader states them, and as its writer wants them.
void take(scene::ImageFacts& facts, const imaging::PixelFaults& pixels);
imaging::PixelFaults pixelFaultsOf(const scene::ImageFacts& facts);

} // namespace petrous::presenters
