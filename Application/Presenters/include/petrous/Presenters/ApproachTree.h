#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "petrous/Core/Progress.h"
#include "petrous/Dissection/History.h"
#include "petrous/Rendering/Picture.h"
#include "petrous/Rendering/SceneContents.h"
#include "petrous/Scene/Case.h"

namespace petrous::presenters
{

/// A row of the tree of strokes: an approach (branch), the untouched bone, or a stroke.
struct ApproachNode
{
  enum class Kind
  {
    Approach, ///< its strokes are its children; `state` is that in which it was left
    Start,    ///< first child of an approach that begins with the untouched bone
    Stroke    ///< approaches that fork after it are its children
  };
  Kind kind = Kind::Approach;
  std::string approach; ///< to which it belongs
  std::size_t state = dissection::History::kStart;
  bool applied = false; ///< on the way to the present state
  std::vector<ApproachNode> children;
};

/// All approaches that begin with the untouched bone; the others are where they fork. A stroke that
/// several lead through belongs to the first of them.
std::vector<ApproachNode> approachTree(const dissection::History& history);

/// Pictures of states of a dissection, each as the surgeon saw it when the stroke was drilled, else
/// from `camera`. `drawn` is called with each. Draws off-screen, on any thread. `contents` is the
/// scene of the case, whatever its state. Throws RenderingError, CancelledError, and as
/// scene::dissectionAt.
using StateDrawn = std::function<void(std::size_t state, const rendering::Picture& picture)>;
void drawStates(const scene::Case& value, rendering::SceneContents contents,
                const core::CameraPose& camera, const std::vector<std::size_t>& states, int width,
                int height, const StateDrawn& drawn, const core::Progress& progress = {});

} // namespace petrous::presenters
