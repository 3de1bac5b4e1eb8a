#pragma once

#include <optional>
#include <string>
#include <vector>

#include "petrous/Presenters/SliceGeometry.h"
#include "petrous/Scene/Case.h"

namespace petrous::presenters
{

/// "slices 41-42, 60 interpolated", numbered from 1, for a picture of the image; of more than four
/// ranges the first, and how many slices there are besides. Empty: none is.
std::string interpolatedText(const scene::ImagePart& image);

/// Likewise of all images of a case, "CT: ..", a line each.
std::vector<std::string> interpolatedTexts(const scene::Case& value);

/// Whether a picture along the image's slices shows one that repair interpolated; a picture across
/// them shows bits of all. `thickness` of its slab, mm.
bool showsInterpolated(const scene::ImagePart& image, const SliceGeometry& picture,
                       double thickness = 0.0);

/// All that is known of an image's voxels, a phrase each, e.g. "slices 3, 7-9 of 60 interpolated
/// between neighbours", "gantry tilt of 18.5 degrees undone". Empty: they are what the file has.
std::vector<std::string> provenanceTexts(const scene::ImagePart& image);

/// Likewise of the place of structures.
std::vector<std::string> provenanceTexts(const scene::LabelPart& part);

/// "axes of the file corrected (RPS): what it calls left, back and head is the patient's right,
/// back and head"
std::string correctedAxesText(const core::AxesCorrection& axes);

/// That left and right are assumed, "left and right taken as RAS axes, ..", and correctedAxesText:
/// what of the two is so.
std::vector<std::string> axesTexts(const std::optional<bool>& assumedRas,
                                   const core::AxesCorrection& axes);

/// "right", "back", .. of a letter of an AxesCorrection.
const char* directionText(char letter);

/// The images and structures whose left and right are assumed, or whose axes were corrected, a line
/// each: "CT: left and right taken as RAS axes, ..".
std::vector<std::string> assumedSideTexts(const scene::Case& value);

/// Derivation Description (0008,2111) of a series that is written of an image; empty: nothing was
/// done to it. `onCt`: an MR, resampled on the CT's grid. Of very many slices not all are named:
/// imaging::writeDicomSeries marks each of them.
std::string derivationText(const scene::ImagePart& image, bool onCt);

} // namespace petrous::presenters
