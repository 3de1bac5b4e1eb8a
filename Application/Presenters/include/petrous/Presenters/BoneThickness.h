#pragma once

#include <memory>
#include <string>

#include "petrous/Core/Progress.h"
#include "petrous/Scene/Case.h"
#include "petrous/Volume/Volume.h"

namespace petrous::presenters
{

constexpr double kFarthestThickness = 5.0; ///< mm; thicker bone keeps its own colour

/// How far the places round a structure or mesh are from its surface, for a picture that colours
/// bone by it (rendering::ThicknessOverlay); about a second. Loads the labels, or the mesh, whose
/// voxels are made and kept. Throws InvalidParameter naming the structures that there are, and
/// CancelledError.
std::shared_ptr<const volume::Volume<float>> boneThickness(const scene::Case& value,
                                                           const std::string& structure,
                                                           const core::Progress& progress = {});

} // namespace petrous::presenters
