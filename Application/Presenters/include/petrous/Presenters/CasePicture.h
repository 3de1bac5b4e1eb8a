#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "petrous/Core/CameraPose.h"
#include "petrous/Core/Progress.h"
#include "petrous/Interaction/PickRay.h"
#include "petrous/Rendering/ClippedRegion.h"
#include "petrous/Rendering/SceneContents.h"
#include "petrous/Rendering/StandardViews.h"
#include "petrous/Scene/Case.h"

namespace petrous::library
{
class Library;
}

namespace petrous::presenters
{

/// The scene of a case for a single rendering (for repeated rendering see SceneAssembly.h).
rendering::SceneContents sceneContents(const scene::Case& value,
                                       const core::Progress& progress = {});

/// A standard view that frames the case's bone (TissueExtent.h), drilled or not. Loads the CT.
/// Lateral: from the ear's side; where that is not known (earOf) from the side to which the image's
/// coordinates lie (guessedEar), which the user is to be told.
core::CameraPose standardCamera(const scene::Case& value, rendering::StandardView view);

/// The side of the patient from which the lateral view is where nothing tells which ear it is;
/// nullopt if that is known (earOf).
std::optional<scene::Side> guessedEar(const scene::Case& value);

/// The case's last view, else the lateral one, of which the user is to be told if it is from a
/// guessed side. Loads the CT for the latter.
core::CameraPose currentCamera(const scene::Case& value);

/// Cuts away from the scene what the view does not show; a box beyond the CT's is none.
void clip(rendering::SceneContents& contents, const scene::ViewState::Clipping& clipping,
          const core::GridGeometry& grid);

/// What a view shows of the image along a line, as the renderer's rays are clipped.
rendering::RaySpan shownPart(const interaction::PickRay& line,
                             const scene::ViewState::Clipping& clipping,
                             const core::GridGeometry& grid);

/// Lights the scene as a view was saved; nullopt: by the defaults.
void illuminate(rendering::SceneContents& contents,
                const std::optional<scene::ViewState::Light>& light);

/// What a picture that is clipped so must say, or what is not shown is taken for drilled.
std::vector<std::string> clippingTexts(const scene::ViewState::Clipping& clipping,
                                       const core::GridGeometry& grid);

/// Whether a camera stands in opaque tissue that the scene draws: its picture is of one colour.
bool isBuried(const core::CameraPose& camera, const rendering::SceneContents& contents);

/// What must be known of a picture of the case: interpolated slices, and clippingTexts of its view.
std::vector<std::string> pictureNotes(const scene::Case& value);

/// What is written into a picture for print and into a film: the side, and pictureNotes.
std::vector<std::string> pictureLines(const scene::Case& value);

/// The case as its thumbnail shows it, without a face: bone and structures, in their own colours.
/// The surface is not below that of bone (less 100 HU), and the bone's transfer function is a
/// preset's, so that no skin shows; an MR as primary image is not shown at all, since it has no
/// bone; nor are structures whose names say skin or face. Loads the CT.
scene::Case thumbnailCase(scene::Case value);

/// The thumbnail of a case (library::setThumbnail), from its last view; empty if it would show
/// nothing. Drilled as far as the dissection is loaded. Draws off-screen, on any thread. Throws
/// like SceneAssembly::contents, and RenderingError.
std::vector<std::uint8_t> thumbnailOf(const scene::Case& value,
                                      const core::Progress& progress = {});

/// Draws the thumbnail of a case as it was opened from the library, drilled as it is stored, and
/// keeps it there once all that was read of the case is checked. False if it would show nothing;
/// what the library has of it stays then. Throws like thumbnailOf, and LibraryError.
bool storeThumbnail(library::Library& library, scene::Case& value, const core::Progress& progress);

} // namespace petrous::presenters
