#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "petrous/Scene/MrReading.h"

namespace petrous::scene
{

/// A mark or a measurement, by its points in the CT's patient space. Its value is that of the
/// points alone (valueOf), so that it stays what was measured, whatever becomes of the structures.
struct Measurement
{
  enum class Kind
  {
    Mark,     ///< a point
    Distance, ///< between two points
    Length,   ///< along a line through any number of points, such as a nerve
    Angle,    ///< at the second of three points
    Area,     ///< of a planar polygon
    Thickness ///< of a wall: from a point of its surface along the normal; the third point, if
              ///< there is one, is where the shortest straight way through it ends
  };
  static constexpr std::size_t kMax = 1000;        ///< of a case
  static constexpr std::size_t kMostPoints = 1000; ///< of one
  static constexpr std::size_t kMostCorners = 200; ///< of a polygon
  static constexpr std::size_t kLongestName = 100; ///< bytes
  static constexpr double kFarthest = 1e5;         ///< mm, of a coordinate: 100 m

  Kind kind = Kind::Mark;
  std::string name; ///< unique among the case's, whatever the case of its letters
  std::vector<Eigen::Vector3d> points; ///< patient LPS mm
  bool shown = true;
  /// Of a length: the structure whose centre line it follows. Of a thickness: what lies behind the
  /// wall. Empty: none.
  std::string structure;
  /// That structure was removed: one that has its name since is another.
  bool structureGone = false;
  std::string image; ///< the MR on which the points were set; empty: the CT
  /// That of each point, where they were set on several images (setImages); else empty.
  std::vector<std::string> images;
  /// The MRs of its points, and where they lay when these were set (setReadings). Empty where none
  /// is known, as in older cases.
  MrReadings readings = {};
};

/// The MR on which a point was set; empty: the CT.
const std::string& imageOf(const Measurement& measurement, std::size_t point);
/// One of each point.
void setImages(Measurement& measurement, std::vector<std::string> images);
/// The MRs as they lie now, after points were set on them: all, or that one. Points that were set
/// before keep what is known of theirs.
void setReadings(const Case& value, Measurement& measurement,
                 std::optional<std::size_t> point = std::nullopt);
/// outdatedReading of the points that were set on that MR; empty, too, if nothing is known of it.
std::string outdatedPoints(const Case& value, const Measurement& measurement,
                           const std::string& mr);

/// What follows a structure of this name remembers that it was removed; returns the names of these
/// measurements.
std::vector<std::string> forgetStructure(std::vector<Measurement>& measurements,
                                         const std::string& structure);
/// The structure is the case's again, for the measurements of these names.
void recallStructure(std::vector<Measurement>& measurements, const std::string& structure,
                     const std::vector<std::string>& names);

bool operator==(const Measurement& a, const Measurement& b);
inline bool operator!=(const Measurement& a, const Measurement& b)
{
  return !(a == b);
}

const char* nameOf(Measurement::Kind kind) noexcept; ///< "mark", "distance", ...
/// Throws InvalidParameter for another name.
Measurement::Kind measurementKindFrom(const std::string& name);

struct PointCount
{
  std::size_t least, most;
};
PointCount pointsOf(Measurement::Kind kind) noexcept; ///< how many a measurement has

/// Throws InvalidParameter naming the first measurement or value that is invalid, and the limit.
void checkMeasurements(const std::vector<Measurement>& measurements);

/// Throws InvalidParameter listing those that there are.
std::size_t findMeasurement(const Case& value, const std::string& name);

/// The name, or if it is taken "name 2", ...
std::string freeMeasurementName(const std::vector<Measurement>& there, const std::string& name);

/// mm, degrees or mm^2; of a thickness along the normal. None for a mark, for an angle whose points
/// coincide, and for a polygon whose edges cross, which has no area.
std::optional<double> valueOf(Measurement::Kind kind, const std::vector<Eigen::Vector3d>& points);
const char* unitOf(Measurement::Kind kind) noexcept; ///< "mm", "°", "mm²"

/// Largest distance of the points from their polygon's plane, mm.
double offPlane(const std::vector<Eigen::Vector3d>& polygon);

} // namespace petrous::scene
