#pragma once

#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "petrous/Core/Progress.h"
#include "petrous/Scene/Case.h"
#include "petrous/Volume/FaceMask.h"

namespace petrous::scene
{

/// What findFace found in images, without the auricles: by the name in the object store, which
/// stands for the voxels, and whether they are those of an MR, whose skin is told otherwise.
using FaceFindings =
    std::map<std::pair<std::string, bool>, std::shared_ptr<const volume::FaceFinding>>;

/// What is taken out of a case's images before they leave.
struct ImageMask
{
  bool face = false;
  bool ears = false; ///< with the face, the auricles
  /// All outside of this box becomes air; LPS mm of the CT. The grid stays, and with it the place
  /// of strokes and structures.
  std::optional<core::PatientBox> region;
  /// Those that leave: MRs by their names, the primary image by an empty one; none: all.
  std::optional<std::set<std::string>> images;
  /// Of imagesWithFace, so that faces are not looked for twice; nullptr: nothing was found yet.
  std::shared_ptr<const FaceFindings> found;

  bool takes(const std::string& mr) const { return !images || images->count(mr) > 0; }
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

/// Puts masked images in place of the CT and of the MRs that `mask.images` has, without a name in
/// the object store; all else of the case stays, to the bit. An image in which no face is found
/// stays as it is, which is noted. Loads the images, and strokes of other approaches.
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
/// approaches. `found`: takes what was found, also that there is no face; nullptr: not wanted.
/// Throws CancelledError, and what reading voxels throws.
std::vector<ImageWithFace> imagesWithFace(const Case& value, const core::Progress& progress = {},
                                          FaceFindings* found = nullptr);

} // namespace petrous::scene
