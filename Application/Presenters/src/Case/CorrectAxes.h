#pragma once

#include <string>

#include "petrous/Core/AxesCorrection.h"
#include "petrous/Core/TriangleMesh.h"
#include "petrous/Scene/Case.h"

namespace petrous::presenters
{

/// Corrects the axes of an image about the centre of its grid, after any correction that it has,
/// and notes it. The voxels are read, not copied.
void correctAxes(scene::ImagePart& image, const core::AxesCorrection& axes);

/// Of a mesh in an image's space, about the centre of that image's grid.
void correctAxes(core::TriangleMesh& mesh, const core::AxesCorrection& axes,
                 const Eigen::Vector3d& center);

/// The image on which a part was drawn: the MR of that name, or the CT if there is none.
const scene::ImagePart& imageDrawnOn(const scene::Case& value, const std::string& drawnOn);

/// Of structures or a mesh that lie in the space of an image whose axes were corrected.
std::string followedNote(const scene::ImagePart& image);

} // namespace petrous::presenters
