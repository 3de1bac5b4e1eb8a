#pragma once

#include <memory>
#include <string>
#include <vector>

#include "petrous/Core/Progress.h"
#include "petrous/Core/RigidTransform.h"
#include "petrous/Scene/Case.h"
#include "petrous/Segmentation/TubeTrace.h"
#include "petrous/Volume/IntensityVolume.h"

namespace petrous::presenters
{

/// The MR on the CT's grid, trilinear, in its own voxel type; beyond the MR its padding, or else
/// its smallest value. `mrFromCt` maps CT patient points to those of the MR, LPS mm. In parallel.
/// Throws CancelledError.
std::shared_ptr<const volume::IntensityVolume> mrOnCt(const volume::IntensityVolume& mr,
                                                      const core::GridGeometry& ct,
                                                      const core::RigidTransform& mrFromCt,
                                                      const core::Progress& progress = {});

/// A tube traced in an image of its own space through points of the CT (patient LPS, mm), in the
/// CT's space; `tube.points` are those given. Traced on the image's own grid: radii, noise and what
/// is resolved depend on it. Throws as segmentation::traceTube.
segmentation::Tube traceOnCt(const volume::IntensityVolume& image,
                             const core::RigidTransform& imageFromCt,
                             const std::vector<Eigen::Vector3d>& points,
                             const segmentation::TubeOptions& options,
                             const core::Progress& progress = {});

/// The numbers of the points, from 1, in segmentation::likelyOrder: "1, 3, 2, 4". Empty if their
/// own order is as likely.
std::string likelyOrderText(const std::vector<Eigen::Vector3d>& points);

/// How much of a tube's label is a guess.
scene::TracedTubes tracedTubes(const segmentation::Tube& tube,
                               const segmentation::TubeLabel& label);

/// Where the image does not resolve a tube, and why, a sentence for each stretch of half a
/// millimetre and more; millimetres along the line from the first point. And that its radius is
/// the usual one, if so. `options`: with which it was traced.
std::vector<std::string> unresolvedTexts(const segmentation::Tube& tube,
                                         const segmentation::TubeOptions& options);

/// Why, as JSON says it: "faint", "thin".
const char* nameOf(segmentation::TubeDoubt doubt);

/// That the voxels are too wide for a tube along part of it; empty if they are not.
std::string bridgingText(const segmentation::TubeLabel& label);

} // namespace petrous::presenters
