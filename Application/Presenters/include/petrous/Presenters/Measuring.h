#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "petrous/Core/Progress.h"
#include "petrous/Scene/Case.h"

namespace petrous::presenters
{

/// A measured value with its unit.
struct Quantity
{
  std::string name;            ///< what of it: "distance", "volume", "length of the centre line"
  std::optional<double> value; ///< none: it cannot be stated; `remark` says why
  std::string unit;            ///< "mm", "mm²", "mm³", "°"
  /// Half-width, in the unit; none: unknown. From the voxels of the image: each point and each
  /// surface may lie half a voxel off, independently; and from the error of a registration, where
  /// images are compared by it. It says nothing of how well somebody aimed or drew.
  std::optional<double> uncertainty;
  std::string remark; ///< what goes with it, a phrase; may be empty
};

/// "12.34 mm ± 0.35", "12.34 mm, uncertainty unknown"; without a value "unknown". Decimals as the
/// uncertainty deserves, never "-0.0".
std::string toString(const Quantity& quantity);

/// What a measurement is, the main value first: of a mark its coordinates, of a thickness that
/// along the normal and the shortest. Reads no voxels.
std::vector<Quantity> quantitiesOf(const scene::Case& value, const scene::Measurement& measurement);

/// In one line, for lists and labels: "12.34 mm ± 0.35".
std::string summaryOf(const scene::Case& value, const scene::Measurement& measurement);

/// Half-width of a value of these points, by linear propagation: each may lie half a voxel of its
/// image off along each of that one's axes. Points of several images lie besides as far off each
/// other as the registrations are in error (p95), and the half-width is at least that of the worst
/// image alone. One point of an MR has the length of the displacement there, in any direction;
/// several shift and turn together by the registration's spread, or shift alone where there is
/// none. None where the value depends on them in no linear way, as a distance of 0, or where an
/// image or the error of its registration is not known.
std::optional<double> propagated(const scene::Case& value, const scene::Measurement& measurement);

/// Volumes of the structures and of what was drilled. Reads no voxels.
std::vector<std::pair<std::string, Quantity>> volumesOf(const scene::Case& value);

/// Volume, extents along the principal axes of inertia (longest first; the widths of a canal are
/// the second and third), and of a tube the length of its centre line and its diameters across it
/// (StructureShape.h). Throws InvalidParameter listing the structures.
std::vector<Quantity> dimensionsOf(const scene::Case& value, const std::string& structure,
                                   const core::Progress& progress = {});

/// The centre line of a structure as a measurement, whole or between the places nearest to two
/// points. Throws InvalidParameter, also where it is no tube.
scene::Measurement alongStructure(const scene::Case& value, const std::string& structure,
                                  const std::vector<Eigen::Vector3d>& between = {},
                                  const core::Progress& progress = {});

/// The shortest distance between two things of a case: structures, meshes or marks, by name.
struct Between
{
  Quantity distance;
  Eigen::Vector3d from, to;          ///< patient LPS mm
  std::array<std::string, 2> images; ///< the MR on which each was set or drawn; empty: the CT
};
/// Throws InvalidParameter for a name that is neither.
Between distanceBetween(const scene::Case& value, const std::string& a, const std::string& b,
                        const core::Progress& progress = {});

/// A row of a table of measurements: name, kind, quantity, value, unit, uncertainty, remark.
std::vector<std::string> rowOf(const std::string& name, const std::string& kind,
                               const Quantity& quantity);
extern const std::vector<std::string> kMeasurementColumns;

/// All measurements, the volumes of structures, and what was drilled, as CSV with a header. Text
/// that a spreadsheet would take for a formula is preceded by an apostrophe.
std::string measurementsCsv(const scene::Case& value);
/// Whether that has a row besides the header.
bool hasMeasurementRows(const scene::Case& value);

} // namespace petrous::presenters
