#pragma once

#include <string>
#include <string_view>

#include "petrous/Core/Error.h"
#include "petrous/Scene/Case.h"

namespace petrous::scene
{

struct ManifestError : core::Error
{
  enum class Reason
  {
    Damaged,
    NewerFormat
  };
  ManifestError(Reason r, const std::string& message);
  Reason reason;
};

/// 2: branches; 3: how an MR was registered, and what was drawn on one; 4: codes of structures; 5:
/// description of the case; 6: attachments, and of the view more than the cameras of branches,
/// crosshair and grey window; 7: measurements, saved views, planes that were turned, slabs; 8:
/// bookmarks and stills of videos; 9: an instrument; 10: of the views of branches more than the
/// camera, axes of a file that were corrected, and slices that repair interpolated beyond a region.
/// Older formats can be opened; a case is written in the lowest format from 3 that holds it, which
/// older programs open; of how it is looked at, they drop what they do not know where they save
/// (record 3: exposure, tone curve, edges, grain, exit surfaces, handpiece).
constexpr int kManifestFormat = 10;

/// The case as JSON: everything but the voxels, which are referenced by object name. Equal cases
/// give the same text. Numbers round-trip exactly. Throws InvalidParameter naming the first
/// non-finite number.
std::string toManifest(const Case& value);

/// A case without voxels; the library attaches them. `source` names the manifest in errors. Throws
/// ManifestError if the text is damaged or of a newer format.
Case fromManifest(std::string_view text, const std::string& source);

/// The description alone, without the cost of the rest, which is not checked. Throws ManifestError.
Description descriptionFromManifest(std::string_view text, const std::string& source);

} // namespace petrous::scene
