#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "petrous/Core/PatientBox.h"
#include "petrous/Core/Progress.h"
#include "petrous/Core/RigidTransform.h"
#include "petrous/Volume/IntensityVolume.h"

namespace petrous::registration
{

/// From where a fit begins. The coarse search looks about this pose, and also about those that lay
/// the two images' centres on each other.
enum class Start
{
  Header,  ///< both images in one patient space, as their files say
  Centres, ///< the middle of what each image shows, axes parallel
  Given    ///< FitOptions::given: landmarks, a hand, an earlier fit
};

/// How much work a fit does. The defaults are measured (`petrous bench registration`).
struct Schedule
{
  std::size_t searchSamples = 4000; ///< points of the coarse search
  std::size_t samples = 40'000;     ///< points of the finest level; the others take fewer
  int bins = 64;                    ///< of the histogram, along each axis
  int evaluations = 40;             ///< of the metric with its gradient, at most, a level
  int polish = 8;                   ///< ascents from about the end; the fit is their mean
  int levels = 0;                   ///< of the pyramid, finest last; 0: as many as the images have
};

struct FitOptions
{
  Start start = Start::Header;
  core::RigidTransform given; ///< X_MC for Start::Given
  /// Only CT within counts (CT patient space). None: all that shows something.
  std::optional<core::PatientBox> region;
  /// Looks for the right optimum up to 40 mm and 40 degrees (and further, less surely) from the
  /// start.
  bool search = true;
  std::uint32_t seed = 1; ///< equal seeds give equal bits, whatever the number of threads
  Schedule schedule;
};

/// One evaluation of the metric on the way, for a curve.
struct MetricSample
{
  int evaluation = 0;  ///< counted from the fit's begin
  int level = 0;       ///< 0 the coarsest
  double metric = 0.0; ///< nats, at this level: levels do not compare
};

/// Called on the calling thread, with the best pose of the level that is under way: the last good
/// state where the work is cancelled.
using MetricListener =
    std::function<void(const MetricSample& sample, const core::RigidTransform& best)>;

struct Fit
{
  core::RigidTransform mrFromCt; ///< X_MC: CT patient points to MR patient points, LPS mm
  double metric = 0.0;           ///< mutual information at the finest level, nats
  double overlap = 0.0;          ///< share of the smaller image's points that fall on the other
  int iterations = 0;            ///< evaluations with gradient, as MetricListener hears of them
  double seconds = 0.0;          ///< wall time
};

/// Rigid (6 parameters) registration of an MR to a CT by mutual information: coarse search, then
/// quasi-Newton ascent through a pyramid of resolutions.
///
/// The smaller of the two fields plays the fixed image, since its every point should be found in
/// the other; with a region the CT does.
///
/// Throws InvalidParameter in words where there is nothing to register (an image of one value, of
/// NaN alone, one slice, a region outside the CT), CancelledError.
Fit fitRigid(const volume::IntensityVolume& ct, const volume::IntensityVolume& mr,
             const FitOptions& options = {}, const core::Progress& progress = {},
             const MetricListener& listener = {});

} // namespace petrous::registration
