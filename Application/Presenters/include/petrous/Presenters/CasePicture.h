#pragma once

#include "petrous/Rendering/SceneContents.h"
#include "petrous/Scene/Case.h"

namespace petrous::presenters
{

/// What a picture of the case shows. Loads the CT, and label maps and meshes only where something
/// of them is shown. The mask is shared with the case's dissection where that is loaded and
/// something was cut.
rendering::SceneContents sceneContents(const scene::Case& value);

} // namespace petrous::presenters
