#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include <Eigen/Core>

#include "petrous/Core/GridGeometry.h"
#include "petrous/Core/NumberText.h"
#include "petrous/Core/Progress.h"
#include "petrous/Volume/IntensityVolume.h"
#include "petrous/Volume/LabelMap.h"

namespace petrous::segmentation
{

/// How a tubular structure (facial nerve in its canal, chorda tympani, vessel, sinus) is traced
/// through a few points.
struct TubeOptions
{
  static constexpr core::NumberRange kRadii{0.1, 15.0, "mm"};
  static constexpr core::NumberRange kBlurs{0.0, 3.0, "mm"};
  static constexpr core::NumberRange kReaches{0.0, 5.0, "mm"};
  static constexpr core::NumberRange kContrasts{0.0, 100.0};
  static constexpr double kLongestLeg = 60.0; ///< mm between neighbouring points
  static constexpr std::size_t kMostPoints = 100;

  enum class Contrast
  {
    Automatic, ///< as most of the points' surroundings show it
    Dark,      ///< darker than its surroundings, e.g. a nerve in its bony canal on CT
    Bright
  };

  Contrast contrast = Contrast::Automatic;

  /// mm, of the whole tube. Unset: estimated at each place.
  std::optional<double> radius;

  /// The largest radius that the structure can have, mm: wider ones are not tried, and where the
  /// image shows nothing narrower, the tube is not resolved. See widestFor.
  double widest = 6.0;

  /// Radius where the image resolves nothing of the tube, mm: widths that are measured there are
  /// those of noise. Unset: these, but half a voxel at least. See usualFor.
  std::optional<double> usual;

  /// Sigma of the scan's Gaussian point spread with the voxel's own, mm. Unset: 0.7 voxels.
  std::optional<double> blur;

  /// How far the line may leave a point for the structure's axis, mm. Beyond that the point itself
  /// is on the line: the surgeon knows better than an image that shows nothing nearby.
  double reach = 1.5;

  /// Contrast, in standard deviations of the noise, from which on the structure counts as resolved,
  /// c. It does not where its lumen differs from that of the rest of the tube either:
  ///
  ///   |lumen - median lumen| > median contrast / c
  double resolvedContrast = 3.0;

  /// What the lumen of the structure can be, in the image's units; outside of it the tube is not
  /// resolved. Unset: anything. See lumenFor.
  std::optional<volume::ValueRange> lumen;
};

/// Why the image does not resolve a tube at a place.
enum class TubeDoubt : std::uint8_t
{
  None,    ///< it does
  Faint,   ///< the contrast is within the noise
  Thin,    ///< narrower than two voxels
  Wide,    ///< as wide as the structure can be at most: what is seen is something else
  Foreign, ///< the lumen is not that of the structure, e.g. air, bone
  Uneven,  ///< the lumen is not that of the rest of the tube: it leads through something else
  Open,    ///< a quarter of the circumference or more has no wall: an edge, a plate
  Stray,   ///< the way between two points is a long detour: it follows something else
  Fragment ///< resolved by itself, but hardly longer than wide, or little beside what is not
};

/// What the points' surroundings say of the tube as a whole; the minimal paths depend on it. The
/// numbers are rounded coarsely, so that moving one point seldom changes them.
struct TubeModel
{
  bool isBright = false;
  double radius = 0.0;   ///< mm
  double contrast = 0.0; ///< in the image's units, > 0; 0: nothing stands out from the noise
  double lumen = 0.0;    ///< in the image's units

  bool operator==(const TubeModel& other) const noexcept
  {
    return isBright == other.isBright && radius == other.radius && contrast == other.contrast &&
           lumen == other.lumen;
  }
};

/// A traced tube. All positions in patient LPS, mm. `line`, `radii`, `contrast` and `resolved` have
/// one entry for each vertex of the line.
struct Tube
{
  std::vector<Eigen::Vector3d> line; ///< from the first point to the last, <= half a voxel apart
  /// mm, free of the scan's blur as far as it is known; where not resolved, interpolated from where
  /// it is; where nothing is, TubeOptions::usual.
  std::vector<double> radii;
  std::vector<double> contrast; ///< surroundings against lumen, in sigma of the noise, >= 0
  /// 1: there is no doubt.
  std::vector<std::uint8_t> resolved;
  /// Of several the first. Nowhere None, unless it is None over half of the length.
  std::vector<TubeDoubt> doubts;

  std::vector<Eigen::Vector3d> points;    ///< as given
  std::vector<double> pointDistances;     ///< from each point to the line, mm
  std::vector<std::size_t> pointVertices; ///< the vertex nearest to each point, ascending
  std::vector<std::uint8_t> heldAtPoint;  ///< 1: no axis within reach, so the line was kept there
  /// 1: the point lies outside of the tube: farther from the line than the radius there, which is
  /// where the structure ends, and than a voxel, which is as near as a point can be set.
  std::vector<std::uint8_t> outsideAtPoint;

  /// The minimal path between each pair of neighbouring points, before refinement.
  std::vector<std::vector<Eigen::Vector3d>> legs;
  TubeModel model; ///< of the legs

  double radius = 0.0;         ///< median, mm; the given one where one was given
  double smallestRadius = 0.0; ///< mm
  double largestRadius = 0.0;  ///< mm
  double length = 0.0;         ///< of the line, mm
  double resolvedLength = 0.0; ///< mm
  double noise = 0.0;          ///< standard deviation around the line, in the image's units
  double blur = 0.0;           ///< mm, the one the radii were corrected for
};

/// Traces a tube through points in order (patient LPS, mm), typically four to six.
///
/// Only a neighbourhood of the points is read. Between points a minimal path is found on the
/// optimally oriented flux of the image [Law and Chung 2008, doi 10.1007/978-3-540-88693-8_27];
/// the line is then moved to the centre of its cross-sections' half-maximum borders.
///
/// before  an earlier result on the same image with the same options: where neighbouring points
///         are the same (after a point was moved, inserted or removed) its minimal path is taken.
///         The result does not depend on it.
///
/// Throws InvalidParameter: fewer than two points or too many, a point that is not finite, outside
/// of the image, equal to its neighbour or too far from it, an option outside its range, an image
/// without contrast or without valid voxels around the points. Throws CancelledError.
Tube traceTube(const volume::IntensityVolume& image, const std::vector<Eigen::Vector3d>& points,
               const TubeOptions& options = {}, const core::Progress& progress = {},
               const Tube* before = nullptr);

/// Whether the image resolves nothing of the tube, so that it has TubeOptions::usual throughout.
bool hasUsualRadius(const Tube& tube, const TubeOptions& options);

/// A part of a tube that the image does not resolve.
struct TubeStretch
{
  double from = 0.0; ///< mm along the line, from the first point
  double to = 0.0;
  TubeDoubt doubt = TubeDoubt::None; ///< along most of it
};

/// The parts of a tube that the image does not resolve, in their order.
std::vector<TubeStretch> unresolvedStretches(const Tube& tube);

/// TubeOptions::lumen for a structure of this name on a CT in Hounsfield units: of a nerve (by the
/// words of appearance::StructurePresets) half of the way from soft tissue to air and to cortical
/// bone, as partial volume and blur take a resolved lumen no farther. Of any other unset, as of
/// what is named after a nerve: recess, ridge, vein, artery, muscle, bones.
std::optional<volume::ValueRange> lumenFor(std::string_view name);

/// TubeOptions::widest for a structure of this name, mm: a chorda tympani or its canal is below 0.5
/// [normal canals are up to about 0.9 mm wide], a facial nerve in its canal below 1.3; else, and
/// of what is named after them (lumenFor), the option's default.
double widestFor(std::string_view name);

/// TubeOptions::usual for a structure of this name, mm; our choice: 0.6 of a facial nerve, 0.2 of a
/// chorda tympani. Of any other unset, also of what is named after them (lumenFor).
std::optional<double> usualFor(std::string_view name);

/// Options for a structure of this name: widestFor, usualFor and, on a CT in Hounsfield units,
/// lumenFor. `radius`: TubeOptions::radius.
TubeOptions tubeOptionsFor(std::string_view name, const std::optional<double>& radius,
                           bool isHounsfieldCt);

/// The order in which 3 to 12 points make the shortest line, first and last as near to theirs as
/// possible, if it is shorter than their own order's by more than a quarter: they were probably not
/// given in their order along the structure. Else empty.
std::vector<std::size_t> likelyOrder(const std::vector<Eigen::Vector3d>& points);

/// Where a new point belongs in the order of tube.points: 0 before the first, points.size() after
/// the last. The tube may consist of points alone; with its line, that is taken into account.
///
/// Points are given in their order along the structure unless the new one clearly lies between two
/// neighbours: close to the line, or such that the way through it is hardly longer; both compared
/// with its distance from the nearer end, so that a structure may turn back sharply. It goes before
/// the first point only if that is nearer by a third, as points are given from one end.
std::size_t insertionIndex(const Tube& tube, const Eigen::Vector3d& point);

/// A tube's voxels as the only segment of a label map.
struct TubeLabel
{
  volume::LabelMap map;
  std::uint64_t bridging = 0; ///< voxels of it that the tube covers by less than half
};

/// The tube on a grid: a voxel belongs if the tube covers at least half of it. Where the tube is so
/// thin that these voxels leave a gap along its line, those that the line crosses bridge it: from
/// one end of the line to the other, as far as the grid reaches, there is a chain of voxels that
/// share faces. `scale` widens or narrows all radii. Throws InvalidParameter if the tube has no
/// line or the index is 0.
TubeLabel labelTube(const Tube& tube, const core::GridGeometry& geometry,
                    const volume::Segment& segment, double scale = 1.0,
                    const core::Progress& progress = {});

} // namespace petrous::segmentation
