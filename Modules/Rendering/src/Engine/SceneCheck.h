#pragma once

#include "petrous/Rendering/SceneContents.h"

/// What both engines ask of a scene. All throw RenderingError BadContents in words.
namespace petrous::rendering
{

/// That its parts do not contradict each other. Looks at no voxel.
void checkContents(const SceneContents& contents);

/// That each index of the labels has its material. Looks at all of their voxels.
void checkMaterials(const SceneContents& contents);

/// That the shader takes so many clipping planes.
void checkPlaneCount(const SceneContents& contents);

} // namespace petrous::rendering
