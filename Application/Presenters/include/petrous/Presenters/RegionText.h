#pragma once

#include <optional>
#include <string>
#include <vector>

#include "petrous/Scene/Case.h"
#include "petrous/Segmentation/Mask.h"
#include "petrous/Segmentation/RegionDoubts.h"
#include "petrous/Volume/IntensityVolume.h"

namespace petrous::presenters
{

/// That the seed lies on a border of two tissues, and where a better one lies, in one sentence;
/// empty: it lies on none. `unit` is that of intensities, such as " HU"; seed: patient, LPS mm.
std::string seedText(const std::optional<segmentation::SeedSurroundings>& surroundings,
                     const Eigen::Vector3d& seed, const std::string& unit);

/// That a range of Hounsfield units reaches from air to bone, in one sentence; empty: it does not.
///
/// iso  intensity at which bone begins, of an image in Hounsfield units; none: another image
std::string rangeText(const volume::ValueRange& range, const std::string& unit,
                      const std::optional<double>& iso);

/// What makes a structure that was grown from seeds doubtful as it is now, a sentence each: size,
/// and faces of the image that it reaches.
std::vector<std::string> regionTexts(const segmentation::Mask& region);

/// What is noted of a structure of a part, to be kept with it when its voxels are edited.
struct StructureNotes
{
  std::vector<std::string> texts; ///< without regionTexts, which are of the voxels as they were
  bool isGrown = false;           ///< from seeds, and doubtful: the edited one is to be judged anew
};
StructureNotes notesOf(const scene::LabelPart& part, const std::string& structure);

} // namespace petrous::presenters
