#pragma once

#include <memory>
#include <string>

#include "petrous/Core/Progress.h"
#include "petrous/Scene/Case.h"
#include "petrous/Volume/Volume.h"

namespace petrous::presenters
{

constexpr double kFarthestThickness = 5.0; ///< mm; thicker bone keeps its own colour

/// Distance field of the surface of a structure or mesh, for rendering bone coloured by it
/// (rendering::ThicknessOverlay); about a second. Loads the labels, or the mesh, whose voxelization
/// is kept. Throws InvalidParameter listing the available structures, and CancelledError.
std::shared_ptr<const volume::Volume<float>> boneThickness(const scene::Case& value,
                                                           const std::string& structure,
                                                           const core::Progress& progress = {});

} // namespace petrous::presenters
