#pragma once

#include "petrous/Rendering/SceneContents.h"

/// Scene requirements of both engines. All functions throw RenderingError BadContents.
namespace petrous::rendering
{

/// Checks that the parts are consistent. Reads no voxels.
void checkContents(const SceneContents& contents);

/// Checks that each label index has a material. Reads all label voxels.
void checkMaterials(const SceneContents& contents);

/// Checks the shader's limit on clipping planes.
void checkPlaneCount(const SceneContents& contents);

} // namespace petrous::rendering
