#pragma once

#include "petrous/Rendering/SceneContents.h"
#include "petrous/Volume/TissueField.h"

namespace petrous::rendering
{

/// Tissue field f of what a scene draws, patient LPS mm: the CT's surface unless it is hidden, the
/// structures, less what is cut. Clipping is left out (ClippedRegion.h). The scene must have a CT.
volume::TissueField sceneField(const SceneContents& contents);
volume::TissueField boneField(const SceneContents& contents);      ///< of the CT's surface alone
volume::TissueField structureField(const SceneContents& contents); ///< of the structures alone

} // namespace petrous::rendering
