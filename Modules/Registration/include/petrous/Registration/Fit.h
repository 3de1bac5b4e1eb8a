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

/// Initial pose of a fit. The coarse search covers the neighbourhood of this pose, and also that of
/// the poses that align the centres of the two images.
enum class Start
{
  Header,  ///< both images in one patient space, as in their files
  Centres, ///< centres of what each image shows, axes parallel
  Given    ///< FitOptions::given: landmarks, a manual alignment, an earlier fit
};

/// Computational effort of a fit. The defaults are based on measurements (`petrous bench
/// registration`).
struct Schedule
{
  std::size_t searchSamples = 4000; ///< samples of the coarse search
  std::size_t samples = 40'000;     ///< points of the finest level; the others take fewer
  int bins = 64;                    ///< of the joint histogram, along each axis
  int evaluations = 40;             ///< maximum per level, of the metric with its gradient
  int polish = 8;                   ///< restarts near the optimum; the fit is their mean
  int levels = 0;                   ///< of the pyramid, finest last; 0: as many as the images allow
};

struct FitOptions
{
  Start start = Start::Header;
  core::RigidTransform given; ///< X_MC for Start::Given
  /// Only CT within counts (CT patient space). None: all content.
  std::optional<core::PatientBox> region;
  /// Searches for the global optimum up to 40 mm and 40 degrees from the start (and beyond, less
  /// reliably).
  bool search = true;
  std::uint32_t seed = 1; ///< equal seeds give bit-identical results, for any number of threads
  Schedule schedule;
};

/// One evaluation of the metric during the optimization, for a plot.
struct MetricSample
{
  int evaluation = 0;  ///< counted from the start of the fit
  int level = 0;       ///< 0: coarsest
  double metric = 0.0; ///< nats; not comparable between levels
};

/// Called on the calling thread, with the best pose of the current level: the last good state in
/// case of cancellation.
using MetricListener =
    std::function<void(const MetricSample& sample, const core::RigidTransform& best)>;

struct Fit
{
  core::RigidTransform mrFromCt; ///< X_MC: CT patient points to MR patient points, LPS mm
  double metric = 0.0;           ///< mutual information at the finest level, nats
  double overlap = 0.0;          ///< fraction of fixed-image samples inside the moving image
  int iterations = 0;            ///< evaluations with gradient, as reported to MetricListener
  double seconds = 0.0;          ///< wall time
};

/// Rigid (6 parameters) registration of an MR to a CT by mutual information: coarse search, then
/// quasi-Newton optimization through a resolution pyramid.
///
/// The image with the smaller field of view is the fixed image, since each of its points should be
/// found in the other; with a region the CT is the fixed image.
///
/// Throws InvalidParameter with a message if there is nothing to register (an image that is
/// constant, only NaN, or a single slice, a region outside the CT), CancelledError.
Fit fitRigid(const volume::IntensityVolume& ct, const volume::IntensityVolume& mr,
             const FitOptions& options = {}, const core::Progress& progress = {},
             const MetricListener& listener = {});

} // namespace petrous::registration
