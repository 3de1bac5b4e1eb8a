#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "petrous/Segmentation/Mask.h"
#include "petrous/Segmentation/RegionDoubts.h"
#include "petrous/Volume/IntensityHistogram.h"
#include "petrous/Volume/IntensityVolume.h"

namespace petrous::segmentation
{

// Operations on masks. All throw CancelledError, and InvalidParameter in one sentence that says
// what would be right, also where images and masks do not share a grid. Distances are between voxel
// centres, in mm, exact on anisotropic grids.

/// Voxels with lower <= intensity <= upper, without padding and NaN.
Mask threshold(const volume::IntensityVolume& image, const volume::ValueRange& range,
               const core::Progress& progress = {});

/// Of these, the voxels connected by faces with one of the seeds (patient, LPS mm). Throws if a
/// seed lies outside the image or its voxel outside the range; `unit` is that of intensities in the
/// message, such as " HU".
Mask connectedThreshold(const volume::IntensityVolume& image, const volume::ValueRange& range,
                        const std::vector<Eigen::Vector3d>& seeds,
                        const core::Progress& progress = {}, const std::string& unit = {});

/// The range of intensities around a seed: mean +- `deviations` standard deviations of its 5^3
/// neighbourhood, of which only the seed's class counts where it has two (ownVoxels), refined in
/// the region that they connect (three rounds). `surroundings`: surroundingsOf this seed.
volume::ValueRange rangeAround(const volume::IntensityVolume& image, const Eigen::Vector3d& seed,
                               const std::optional<SeedSurroundings>& surroundings,
                               double deviations = 2.5, const core::Progress& progress = {});

/// Thresholds that separate the histogram in `classes` (2 to 4) classes with the largest variance
/// between them [Otsu 1979, doi 10.1109/TSMC.1979.4310076]; ascending, classes - 1 of them.
std::vector<double> otsuThresholds(const volume::IntensityHistogram& histogram, int classes);

/// A range to begin with: on CT what is denser than `iso`, on other images the brightest of three
/// Otsu classes (the cholesteatoma on a diffusion-weighted image).
volume::ValueRange proposedRange(const volume::IntensityHistogram& histogram,
                                 std::optional<double> iso);

/// The brightest region of an image: a cholesteatoma on a diffusion-weighted MR.
struct ProposedRegion
{
  Eigen::Vector3d seed;     ///< centre of its brightest voxel, patient, LPS mm
  volume::ValueRange range; ///< connectedThreshold with it gives the region
};
/// Begins where the mean within 1.5 mm is the largest, two voxels or more from the image's faces,
/// and reaches to half of the step down to the darkest of three Otsu classes, where a blurred edge
/// stays in its place; to half of the step to the brightest class where that would take in more
/// than 20 cm^3 and the seed is an outlier of that class. None where the image has no region
/// brighter than its surroundings.
std::optional<ProposedRegion> proposedRegion(const volume::IntensityVolume& image,
                                             const core::Progress& progress = {});

/// How many parts the mask has, connected by faces, and the voxels of the largest.
struct Islands
{
  std::size_t count = 0;
  std::uint64_t largest = 0;
};
Islands islandsOf(const Mask& mask, const core::Progress& progress = {});
Mask largestIsland(const Mask& mask, const core::Progress& progress = {});
/// Without islands smaller than `volume` mm^3.
Mask withoutSmallIslands(const Mask& mask, double volume, const core::Progress& progress = {});
/// The islands that hold one of the points (patient, LPS mm).
Mask islandsAt(const Mask& mask, const std::vector<Eigen::Vector3d>& points,
               const core::Progress& progress = {});
/// Cavities that are connected with nothing outside become part of it.
Mask filled(const Mask& mask, const core::Progress& progress = {});

/// distance > 0: all voxels within that distance of one of the mask's. distance < 0: the mask's
/// voxels farther than that from all others; the grid's border counts as inside.
Mask margin(const Mask& mask, double distance, const core::Progress& progress = {});

/// Gaussian of standard deviation `sigma` mm, and the level at which the number of voxels is the
/// same; structures thinner than about two sigma lose their ends.
Mask smoothed(const Mask& mask, double sigma, const core::Progress& progress = {});
/// The same for the outline and the cavities: with its cavities filled the mask keeps its volume,
/// so that cavities that close do not make it smaller. A cavity closes unless somewhere in it the
/// Gaussian of all cavities is one half or more; those that stay keep their volume too.
Mask smoothedOutline(const Mask& mask, double sigma, const core::Progress& progress = {});

enum class Combination
{
  Union,
  Intersection,
  Difference ///< a without b
};
Mask combined(const Mask& a, const Mask& b, Combination how);

/// Slices across `axis` (0 to 2, of the grid) that are empty between two that are not become
/// sections in between: signed distances interpolated linearly [Raya and Udupa 1990,
/// doi 10.1109/42.52980]. Throws if no slice is to be filled.
Mask filledBetweenSlices(const Mask& mask, int axis, const core::Progress& progress = {});

/// Every voxel of `box` becomes part of the seeds that reach it by the path of least cost: the
/// total change of intensity, in 1/255 of the range in the box, and 2 a millimetre, over steps to
/// the 26 neighbours, so that anisotropic voxels do not favour their long side, nor diagonals
/// themselves; `inside` and `outside` are voxels drawn in what is to be segmented and beside it
/// [grow-cut as shortest paths: Zhu et al. 2014, doi 10.1117/12.2043742]. Empty box: the seeds'
/// with a quarter of its size on each side. Throws without seeds of both kinds, and above
/// kMostGrowVoxels.
constexpr std::size_t kMostGrowVoxels = 64'000'000;
Mask grownFromSeeds(const volume::IntensityVolume& image, const Mask& inside, const Mask& outside,
                    const core::IndexBox& box = {}, const core::Progress& progress = {});

/// What a brush touches: voxels whose centre lies within `radius` of the segment from `from` to
/// `to`.
struct Brush
{
  Eigen::Vector3d from; ///< patient, LPS mm
  Eigen::Vector3d to;
  double radius = 1.0; ///< mm, > 0
  /// Only voxels of the slice through `from` with this patient-space normal: those whose centre is
  /// nearer to the plane than half the grid's step along it. nullopt: a ball.
  std::optional<Eigen::Vector3d> normal;
  /// Only voxels with an intensity in this range; needs `image`.
  std::optional<volume::ValueRange> range;
  const volume::IntensityVolume* image = nullptr;
};

/// Paints (value true) or erases, within a step. Returns the box of the voxels that changed.
core::IndexBox paint(EditableMask& mask, const Brush& brush, bool value);

} // namespace petrous::segmentation
