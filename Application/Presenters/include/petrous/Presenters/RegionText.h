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
/// Throws InvalidParameter if that lies outside the image.
std::string seedText(const volume::IntensityVolume& image, const Eigen::Vector3d& seed,
                     const std::string& unit);

/// What makes a region that was grown from seeds doubtful, a sentence each.
///
/// iso  intensity at which bone begins, of an image in Hounsfield units; none: another image
std::vector<std::string> regionTexts(const segmentation::Mask& region,
                                     const volume::ValueRange& range, const std::string& unit,
                                     const std::optional<double>& iso);

/// Keeps such sentences about the structure called `name` as notes of its part.
void addDoubts(scene::LabelPart& part, const std::string& name,
               const std::vector<std::string>& doubts);

} // namespace petrous::presenters
