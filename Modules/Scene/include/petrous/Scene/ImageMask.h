#pragma once

#include <optional>
#include <string>
#include <vector>

#include "petrous/Core/Progress.h"
#include "petrous/Scene/Case.h"
#include "petrous/Volume/FaceMask.h"

namespace petrous::scene
{

/// What is taken out of a case's images before they leave.
struct ImageMask
{
  bool face = false;
  bool ears = false; ///< with the face, the auricles
  /// All outside of this box becomes air; LPS mm of the CT. The grid stays, and with it the place
  /// of strokes and structures.
  std::optional<core::PatientBox> region;

  bool any() const noexcept { return face || region.has_value(); }
};

/// Never masked: structures and meshes with this much around them, and what was drilled in any
/// approach, mm.
constexpr double kKeptAround = 5.0;

/// Of one image.
struct MaskedImagePart
{
  std::string name; ///< of an MR; empty: the primary image
  volume::FaceFinding::Kind face = volume::FaceFinding::Kind::None; ///< as it was found
  std::size_t voxels = 0;
  std::size_t changed = 0;
  std::size_t kept = 0; ///< voxels that stay because of structures or drilling
};

struct ImageMaskReport
{
  std::vector<MaskedImagePart> images;
  std::vector<std::string> notes; ///< one sentence each, for the user
};

/// Puts masked images in place of the CT and of the MRs, without a name in the object store; all
/// else of the case stays, to the bit. An image in which no face is found stays as it is, which is
/// noted. Loads the images, and strokes of other approaches.
///
/// Throws Error (Refused) naming the structures where a part of the face's skin would stay because
/// of them, where there is a head whose face cannot be told, or where auricles are asked for that
/// an earlier mask left; InvalidParameter for a region that has no voxel of the CT, or if an MR
/// that is not registered would have to be cropped; CancelledError, and what reading voxels throws.
/// The case is then as it was.
ImageMaskReport maskImages(Case& value, const ImageMask& mask, const core::Progress& progress = {});

/// An image that shows a face, a part of one or perhaps one.
struct ImageWithFace
{
  std::string text;  ///< "the CT", "MR 'T2'"
  std::string mr;    ///< its name; empty: the primary image
  std::string fault; ///< why maskImages refuses to mask its face; empty: it can be masked
};

/// Those of the case's images, whatever their notes say. Reads their voxels, and strokes of other
/// approaches. Throws CancelledError, and what reading voxels throws.
std::vector<ImageWithFace> imagesWithFace(const Case& value, const core::Progress& progress = {});

} // namespace petrous::scene
