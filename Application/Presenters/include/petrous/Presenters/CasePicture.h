#pragma once

#include "petrous/Rendering/SceneContents.h"
#include "petrous/Rendering/StandardViews.h"
#include "petrous/Scene/Case.h"

namespace petrous::presenters
{

/// What a picture of the case shows. Loads the CT, and label maps and meshes only where something
/// of them is shown. The mask is shared with the case's dissection where that is loaded and
/// something was cut.
rendering::SceneContents sceneContents(const scene::Case& value);

/// A standard view that frames the case's bone (TissueExtent.h), drilled or not. Loads the CT.
core::CameraPose standardCamera(const scene::Case& value, rendering::StandardView view);

/// The case's last view, else the lateral one. Loads the CT for the latter.
core::CameraPose currentCamera(const scene::Case& value);

} // namespace petrous::presenters
