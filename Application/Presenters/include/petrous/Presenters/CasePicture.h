#pragma once

#include "petrous/Core/Progress.h"
#include "petrous/Rendering/SceneContents.h"
#include "petrous/Rendering/StandardViews.h"
#include "petrous/Scene/Case.h"

namespace petrous::presenters
{

/// The scene of a case for a single rendering (for repeated rendering see SceneAssembly.h).
rendering::SceneContents sceneContents(const scene::Case& value,
                                       const core::Progress& progress = {});

/// A standard view that frames the case's bone (TissueExtent.h), drilled or not. Loads the CT.
core::CameraPose standardCamera(const scene::Case& value, rendering::StandardView view);

/// The case's last view, else the lateral one. Loads the CT for the latter.
core::CameraPose currentCamera(const scene::Case& value);

} // namespace petrous::presenters
