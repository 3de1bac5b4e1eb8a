#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <set>

#include <Eigen/Geometry>

#include "ByteSource.h"
#include "DicomElements.h"
#include "DicomHeader.h"
#include "DicomItem.h"
#include "FileHelpers.h"
#include "LabelNames.h"
#include "MemoryCheck.h"
#include "SegmentationReader.h"
#include "petrous/Imaging/FileFormats.h"
#include "petrous/Imaging/StructureSet.h"

namespace petrous::imaging
{

namespace
{

using Reason = FileError::Reason;

constexpr std::uint64_t kLargest = std::uint64_t{1} << 30; // bytes
constexpr std::size_t kMostRois = 65535;
constexpr double kFarthest = 1e4; // mm, of a point; scanners put the patient within 2 m
constexpr std::uint64_t kMaxVoxels = std::uint64_t{1} << 31; // of all layers
constexpr double kPlanar = 0.1;     // slices, by which a contour may leave its plane
constexpr double kSamePlane = 0.02; // slices, between contours of one plane at least
constexpr double kThinVoxels = 4.0; // volume from which on a shape is judged
constexpr double kGap = 1.5;        // of the usual distance of planes: a part of its own
constexpr double kFewSlices = 5.0;  // a stated thickness beyond is another image's
constexpr int kLines = 32;          // in a row of voxels
constexpr const char* kTask = "reading contours";
constexpr std::size_t kChecked = 65536; // points between two checks
constexpr const char* kFewer = "export fewer structures at a time";

/// A data set of a structure set, which has no pixels.
std::string dataSet(const std::filesystem::path& path, DicomItem::Encoding& encoding,
                    PatientKey& patient, const core::Progress& progress)
{
  ByteSource source(path);
  const DicomElements elements(source);
  if (elements.state() != DicomElements::State::Complete || elements.pixels().tag != 0 ||
      elements.dataStart() > source.size())
    fail(Reason::Unreadable, path, "is cut short or damaged; copy or export it again");
  const std::uint64_t size = source.size() - elements.dataStart();
  if (size > kLargest)
    fail(Reason::Unsupported, path,
         "holds more than 1 GB of contours; export fewer structures at a time");
  requireMemory(path, size, kFewer);
  std::string bytes(static_cast<std::size_t>(size), '\0');
  constexpr std::size_t kPart = std::size_t{16} << 20;
  for (std::size_t at = 0; at < bytes.size(); at += kPart)
  {
    progress.check(kTask);
    if (!source.read(elements.dataStart() + at, bytes.data() + at,
                     std::min(kPart, bytes.size() - at)))
      fail(Reason::Unreadable, path, "cannot be read to its end; copy it again");
  }
  encoding = {elements.isExplicit(), elements.isBigEndian()};
  patient = patientOf(elements);
  return bytes;
}

/// The points of a contour.
std::vector<Eigen::Vector3d> readPoints(const DicomItem& contour, const std::filesystem::path& path,
                                        const core::Progress& progress)
{
  progress.check(kTask);
  std::vector<Eigen::Vector3d> points;
  const std::vector<double> values = contour.numbers(0x30060050);
  if (values.empty() || values.size() % 3 != 0)
    fail(Reason::Unreadable, path,
         "has a contour whose points are not numbers, three a point; export it again");
  if (!contour.text(0x30060046).empty() &&
      contour.number(0x30060046) != static_cast<double>(values.size() / 3))
    fail(Reason::Unreadable, path,
         "has a contour of " + std::to_string(values.size() / 3) +
             " points that states another number of them (Number of Contour Points): points are "
             "missing or too many; export it again");
  for (std::size_t n = 0; n < values.size(); n += 3)
  {
    if (n % (3 * kChecked) == 0)
      progress.check(kTask);
    const Eigen::Vector3d p(values[n], values[n + 1], values[n + 2]);
    if (!(p.cwiseAbs().maxCoeff() <= kFarthest)) // NaN too
      fail(Reason::Unreadable, path,
           "has a contour with a point more than 10 m from the origin; contours are in mm within "
           "the patient: look for a coordinate without its decimal point, and export it again");
    if (points.empty() || p != points.back())
      points.push_back(p);
  }
  while (points.size() > 1 && points.back() == points.front())
    points.pop_back();
  return points;
}

/// Puts a contour into the central plane of its slab, by Contour Offset Vector (PS3.3-2019
/// C.8.8.6.2: "the set of points offset from Contour Data"; retired in 2020).
void applyOffset(const DicomItem& contour, const std::filesystem::path& path,
                 StructureSet::Roi& roi, std::vector<Eigen::Vector3d>& points)
{
  constexpr double kAside = 0.05; // mm, or of a distance: by which it may miss the normal
  if (contour.text(0x30060045).empty())
    return;
  const std::vector<double> values = contour.numbers(0x30060045);
  if (values.size() != 3)
    fail(
        Reason::Unreadable, path,
        "has a contour whose offset (Contour Offset Vector) is not three numbers; export it again");
  const Eigen::Vector3d offset(values[0], values[1], values[2]);
  const double length = offset.norm();
  if (!(length > 0.0))
    return;
  if (!(contour.number(0x30060044).value_or(0.0) > 0.0))
  {
    ++roi.ignoredOffsets;
    return;
  }
  if (length > kFarthest || std::any_of(points.begin(), points.end(),
                                        [&](const Eigen::Vector3d& p)
                                        {
                                          const Eigen::Vector3d side = p - points.front();
                                          return std::abs(side.dot(offset)) / length >
                                                 kAside * (1.0 + side.norm());
                                        }))
    fail(Reason::Unreadable, path,
         "has a contour that is to be moved within its plane (Contour Offset Vector), where DICOM "
         "lets it be moved across only; export it again, without an offset");
  for (Eigen::Vector3d& p : points)
    p += offset;
  ++roi.movedContours;
  roi.movedBy = std::max(roi.movedBy, length);
}

/// Of Contour Slab Thickness.
void noteThickness(const DicomItem& contour, StructureSet::Roi& roi)
{
  const double thickness = contour.number(0x30060044).value_or(0.0);
  if (roi.contours.size() == 1)
    roi.slabThickness = thickness > 0.0 ? thickness : 0.0;
  else if (std::abs(thickness - roi.slabThickness) > kPlanar * thickness)
    roi.slabThickness = std::numeric_limits<double>::quiet_NaN();
}

/// Axes of the grid: contours lie in planes across `normal`.
struct Axes
{
  std::size_t normal = 2, first = 0, second = 1;
};

Axes axesAcross(std::size_t normal)
{
  return {normal, normal == 0 ? std::size_t{1} : std::size_t{0},
          normal == 2 ? std::size_t{1} : std::size_t{2}};
}

/// The contours of a plane, in voxel coordinates of the two axes in it.
struct Plane
{
  double at = 0.0;    ///< voxel coordinate along the normal
  double lower = 0.0; ///< of its slab
  double upper = 0.0;
  std::vector<std::vector<Eigen::Vector2d>> contours;
};

struct Placed
{
  Axes axes;
  std::vector<Plane> planes; ///< ascending
  double step = 1.0;         ///< slices, between neighbouring planes
  double usual = 1.0;        ///< slices, between most of them; of one: a slice
  double stated = 0.0;       ///< slices, by the file, and then `step` if it is so; 0: not stated
  bool isAsStated = false;
  std::size_t twice = 0; ///< contours that are another one of their plane again
};

using Contour = std::vector<Eigen::Vector2d>; ///< voxel coordinates

/// Says of points whether they lie within `reach` of a contour's line. Points that follow each
/// other lie on sides that do: each search begins at the side found before.
class NearLine
{
public:
  NearLine(const Contour& contour, double reach)
    : m_contour(contour)
    , m_reach(reach)
  {
  }

  bool operator()(const Eigen::Vector2d& p)
  {
    const std::size_t sides = m_contour.size();
    for (std::size_t step = 0; step < sides; ++step) // 0, 1, -1, 2, -2 ...
    {
      const std::size_t aside = (step + 1) / 2;
      const std::size_t n = (m_found + (step % 2 == 1 ? aside : sides - aside)) % sides;
      const Eigen::Vector2d& from = m_contour[n];
      const Eigen::Vector2d along = m_contour[(n + 1) % sides] - from;
      const double length = along.squaredNorm();
      const double t = length > 0.0 ? std::clamp((p - from).dot(along) / length, 0.0, 1.0) : 0.0;
      if ((p - from - t * along).squaredNorm() <= m_reach * m_reach)
      {
        m_found = n;
        return true;
      }
    }
    return false;
  }

private:
  const Contour& m_contour;
  double m_reach = 0.0; // voxels
  std::size_t m_found = 0;
};

/// Whether each point of a contour, and the middle of each side, lies within `reach` of another
/// contour's line.
bool liesOn(const Contour& contour, const Contour& other, double reach)
{
  NearLine isNear(other, reach);
  for (std::size_t n = 0; n < contour.size(); ++n)
    if (!isNear(contour[n]) || !isNear(0.5 * (contour[n] + contour[(n + 1) % contour.size()])))
      return false;
  return true;
}

Eigen::AlignedBox2d boundsOf(const Contour& contour)
{
  Eigen::AlignedBox2d bounds;
  for (const Eigen::Vector2d& p : contour)
    bounds.extend(p);
  return bounds;
}

/// Whether two contours are one, wherever it begins and whichever way it turns: a ring between
/// them would be thinner than a twentieth of a voxel.
bool areOne(const Contour& a, const Eigen::AlignedBox2d& boundsOfA, const Contour& b,
            const Eigen::AlignedBox2d& boundsOfB)
{
  constexpr double kReach = 0.05; // voxels
  return (boundsOfA.min() - boundsOfB.min()).cwiseAbs().maxCoeff() <= kReach &&
         (boundsOfA.max() - boundsOfB.max()).cwiseAbs().maxCoeff() <= kReach &&
         liesOn(a, b, kReach) && liesOn(b, a, kReach);
}

/// How far contours of one plane may lie apart along the normal, slices: writers and origins differ
/// in decimals. Their distances stand out: those between planes are many times larger.
double planeWidth(const std::vector<double>& sorted)
{
  constexpr double kLarger = 4.0;
  std::vector<double> steps;
  for (std::size_t n = 1; n < sorted.size(); ++n)
    steps.push_back(sorted[n] - sorted[n - 1]);
  std::sort(steps.begin(), steps.end());
  const auto isFlat = [&sorted](double width) // no plane grows thick by contours in a row
  {
    double from = sorted.front();
    for (std::size_t n = 1; n < sorted.size(); ++n)
    {
      from = sorted[n] - sorted[n - 1] > width ? sorted[n] : from;
      if (sorted[n] - from > kPlanar)
        return false;
    }
    return true;
  };
  for (std::size_t n = steps.size(); n-- > 1;)
    if (const double width = steps[n - 1];
        width > kSamePlane && width <= kPlanar && steps[n] >= kLarger * width && isFlat(width))
      return width;
  return kSamePlane;
}

/// Takes what the file states of how far apart the planes of a structure are, or of how thick its
/// one slab is, where it can be so: the step is then also that of the ends.
///
/// steps  of neighbouring planes, slices
void followStated(const StructureSet::Roi& roi, double spacing, const std::vector<double>& steps,
                  Placed& placed)
{
  const auto take = [&placed](double stated, bool isSo)
  {
    if (placed.isAsStated || !(stated > 0.0)) // NaN too
      return;
    placed.stated = stated;
    placed.isAsStated = isSo;
    placed.step = isSo ? stated : placed.step;
  };
  const double planes = roi.planeSpacing / spacing;
  if (steps.empty())
  {
    const auto canBe = [](double slices)
    { return slices >= 1.0 / kFewSlices && slices <= kFewSlices; };
    const double slab = roi.slabThickness / spacing;
    take(planes, canBe(planes));
    take(slab, canBe(slab));
    return;
  }
  // A section without a contour on one of these planes has none there (PS3.3 C.8.8.6.4). But some
  // are neighbours or nearly so: contours that were drawn or resampled elsewhere may state the
  // slices of an image of before.
  const auto isWhole = [planes](double step)
  {
    const double count = std::round(step / planes);
    return count >= 1.0 && std::abs(step / planes - count) <= kPlanar;
  };
  take(planes,
       planes > kSamePlane && std::all_of(steps.begin(), steps.end(), isWhole) &&
           std::round(*std::min_element(steps.begin(), steps.end()) / planes) <= kFewSlices);
}

/// The contours of a structure as slabs on the grid; nullopt if they lie across none of its axes.
std::optional<Placed> place(const StructureSet::Roi& roi, const core::GridGeometry& grid,
                            const core::Progress& progress = {})
{
  std::vector<std::vector<Eigen::Vector3d>> contours;
  for (const auto& contour : roi.contours)
  {
    progress.check(kTask);
    contours.emplace_back();
    for (const Eigen::Vector3d& p : contour)
      contours.back().push_back(grid.voxelFromPatient(p));
  }
  for (const std::size_t normal : {std::size_t{2}, std::size_t{1}, std::size_t{0}})
  {
    const auto axis = static_cast<int>(normal);
    Placed placed;
    placed.axes = axesAcross(normal);
    std::vector<std::pair<double, const std::vector<Eigen::Vector3d>*>> planes;
    bool isAcross = true;
    for (const auto& contour : contours)
    {
      progress.check(kTask);
      double lowest = contour.front()[axis];
      double highest = lowest;
      double sum = 0.0;
      for (const Eigen::Vector3d& p : contour)
      {
        lowest = std::min(lowest, p[axis]);
        highest = std::max(highest, p[axis]);
        sum += p[axis];
      }
      isAcross = isAcross && highest - lowest <= kPlanar;
      planes.emplace_back(sum / static_cast<double>(contour.size()), &contour);
    }
    if (!isAcross)
      continue;
    std::sort(planes.begin(), planes.end(),
              [](const auto& a, const auto& b) { return a.first < b.first; });
    std::vector<double> ats;
    for (const auto& [at, contour] : planes)
      ats.push_back(at);
    const double width = planeWidth(ats);
    std::vector<Eigen::AlignedBox2d> bounds; // of the plane's contours
    for (std::size_t n = 0; n < planes.size(); ++n)
    {
      progress.check(kTask);
      const auto& [at, contour] = planes[n];
      // Within kSamePlane of the first, or of the one before where they are many times closer than
      // planes.
      const bool isNew = n == 0 || (width > kSamePlane ? at - planes[n - 1].first > width
                                                       : at > placed.planes.back().at + width);
      if (isNew)
      {
        placed.planes.push_back({at, 0.0, 0.0, {}});
        bounds.clear();
      }
      Contour flat;
      for (const Eigen::Vector3d& p : *contour)
        flat.emplace_back(p[static_cast<int>(placed.axes.first)],
                          p[static_cast<int>(placed.axes.second)]);
      std::vector<Contour>& ofPlane = placed.planes.back().contours;
      const Eigen::AlignedBox2d own = boundsOf(flat);
      std::size_t other = 0;
      while (other < ofPlane.size() && !areOne(flat, own, ofPlane[other], bounds[other]))
        ++other;
      if (other < ofPlane.size())
      {
        ++placed.twice; // by the odd-even rule it would take away what it surrounds
        continue;
      }
      bounds.push_back(own);
      ofPlane.push_back(std::move(flat));
    }
    std::vector<double> steps;
    for (std::size_t n = 1; n < placed.planes.size(); ++n)
      steps.push_back(placed.planes[n].at - placed.planes[n - 1].at);
    if (!steps.empty())
    {
      std::nth_element(steps.begin(), steps.begin() + static_cast<std::ptrdiff_t>(steps.size() / 2),
                       steps.end());
      placed.step = placed.usual = steps[steps.size() / 2];
    }
    followStated(roi, grid.spacing()[axis], steps, placed);
    for (std::size_t n = 0; n < placed.planes.size(); ++n)
    {
      Plane& plane = placed.planes[n];
      const auto half = [&](std::size_t other) // towards a neighbour
      {
        const double gap = std::abs(placed.planes[other].at - plane.at);
        return gap <= kGap * placed.step ? 0.5 * gap : 0.5 * placed.step;
      };
      plane.lower = plane.at - (n > 0 ? half(n - 1) : 0.5 * placed.step);
      plane.upper = plane.at + (n + 1 < placed.planes.size() ? half(n + 1) : 0.5 * placed.step);
    }
    return placed;
  }
  return std::nullopt;
}

/// Calls span(row, x0, x1, share) for the parts of lines that lie within the contours of a plane,
/// in voxel coordinates; `share`: of a row's height for which a line stands.
template <class Span>
void forEachSpan(const Plane& plane, const core::Progress& progress, const Span& span)
{
  double lowest = plane.contours.front().front()[1];
  double highest = lowest;
  for (const auto& contour : plane.contours)
    for (const Eigen::Vector2d& p : contour)
    {
      lowest = std::min(lowest, p[1]);
      highest = std::max(highest, p[1]);
    }
  // Line n lies at (n + 1/2) / kLines - 1/2; row j holds lines j kLines to (j + 1) kLines - 1.
  const auto lineAbove = [](double y)
  { return static_cast<std::int64_t>(std::ceil((y + 0.5) * kLines - 0.5)); };
  const std::int64_t end = lineAbove(highest);
  constexpr std::int64_t kLinesAtOnce = 1 << 15; // bounds the memory, whatever the contours' extent
  std::vector<std::vector<double>> crossings;
  for (std::int64_t begin = lineAbove(lowest); begin < end; begin += kLinesAtOnce)
  {
    const std::int64_t blockEnd = std::min(end, begin + kLinesAtOnce);
    crossings.assign(static_cast<std::size_t>(blockEnd - begin), {});
    for (const auto& contour : plane.contours)
      for (std::size_t n = 0; n < contour.size(); ++n)
      {
        if (n % kChecked == 0)
          progress.check(kTask);
        Eigen::Vector2d a = contour[n];
        Eigen::Vector2d b = contour[(n + 1) % contour.size()];
        if (a[1] > b[1])
          std::swap(a, b);
        // half-open: a point on a line counts once
        const std::int64_t last = std::min(lineAbove(b[1]), blockEnd);
        for (std::int64_t line = std::max(lineAbove(a[1]), begin); line < last; ++line)
        {
          const double y = (static_cast<double>(line) + 0.5) / kLines - 0.5;
          const double t = (y - a[1]) / (b[1] - a[1]);
          crossings[static_cast<std::size_t>(line - begin)].push_back(a[0] + t * (b[0] - a[0]));
        }
      }
    for (std::size_t n = 0; n < crossings.size(); ++n)
    {
      auto& at = crossings[n];
      std::sort(at.begin(), at.end());
      const std::int64_t line = begin + static_cast<std::int64_t>(n);
      const std::int64_t row = line >= 0 ? line / kLines : -((-line + kLines - 1) / kLines);
      for (std::size_t c = 0; c + 1 < at.size(); c += 2)
        if (at[c + 1] > at[c])
          span(row, at[c], at[c + 1], 1.0 / kLines);
    }
  }
}

/// Whether outlines of the plane cross: by the odd-even rule what both surround is then outside.
/// Where one lies within the other, or beside it, lines leave the contours in the reverse order of
/// entering them.
bool hasCrossing(const Plane& plane)
{
  constexpr double kTouch = 0.05; // voxels, by which outlines that touch may overlap
  constexpr std::size_t kMostLines = 256;
  constexpr std::size_t kMostCrossings = std::size_t{1} << 22; // bounds the memory
  if (plane.contours.size() < 2)
    return false;
  double lowest = plane.contours.front().front()[1];
  double highest = lowest;
  std::size_t points = 0;
  for (const auto& contour : plane.contours)
  {
    points += contour.size();
    for (const Eigen::Vector2d& p : contour)
    {
      lowest = std::min(lowest, p[1]);
      highest = std::max(highest, p[1]);
    }
  }
  const std::size_t lines = std::min(kMostLines, kMostCrossings / points);
  if (lines == 0 || !(highest > lowest))
    return false;
  const double apart = (highest - lowest) / static_cast<double>(lines);
  std::vector<std::vector<std::pair<double, std::size_t>>> crossings(lines); // x and contour
  for (std::size_t c = 0; c < plane.contours.size(); ++c)
    for (std::size_t n = 0; n < plane.contours[c].size(); ++n)
    {
      Eigen::Vector2d a = plane.contours[c][n];
      Eigen::Vector2d b = plane.contours[c][(n + 1) % plane.contours[c].size()];
      if (a[1] > b[1])
        std::swap(a, b);
      const auto lineAbove = [&](double y)
      {
        return static_cast<std::size_t>(
            std::clamp(std::ceil((y - lowest) / apart - 0.5), 0.0, static_cast<double>(lines)));
      };
      for (std::size_t line = lineAbove(a[1]); line < lineAbove(b[1]); ++line)
      {
        const double y = lowest + (static_cast<double>(line) + 0.5) * apart;
        crossings[line].emplace_back(a[0] + (y - a[1]) / (b[1] - a[1]) * (b[0] - a[0]), c);
      }
    }
  std::vector<std::pair<double, std::size_t>> open;
  for (auto& line : crossings)
  {
    std::sort(line.begin(), line.end());
    open.clear();
    for (const auto& [x, contour] : line)
    {
      const auto own = std::find_if(open.begin(), open.end(),
                                    [id = contour](const auto& o) { return o.second == id; });
      if (own == open.end())
      {
        open.emplace_back(x, contour);
        continue;
      }
      if (own + 1 != open.end() && x - (own + 1)->first > kTouch)
        return true;
      open.erase(own);
    }
  }
  return false;
}

double areaOf(const Plane& plane, const core::Progress& progress) // voxels
{
  double area = 0.0;
  forEachSpan(plane, progress,
              [&area](std::int64_t, double x0, double x1, double share)
              { area += (x1 - x0) * share; });
  return area;
}

/// Whether most of a contour's length lies within `reach` of another one's line.
bool followsLine(const Contour& contour, const Contour& other, double reach)
{
  constexpr std::size_t kMostPoints = 400; // looked at
  double length = 0.0;
  for (std::size_t n = 0; n < contour.size(); ++n)
    length += (contour[(n + 1) % contour.size()] - contour[n]).norm();
  NearLine isNear(other, reach);
  const double step = length / kMostPoints;
  double next = 0.5 * step; // along the contour
  double begin = 0.0;       // of the side
  std::size_t near = 0;
  std::size_t all = 0;
  for (std::size_t n = 0; n < contour.size(); ++n)
  {
    const Eigen::Vector2d side = contour[(n + 1) % contour.size()] - contour[n];
    const double end = begin + side.norm();
    for (; next < end; next += step)
    {
      ++all;
      near += isNear(contour[n] + (next - begin) / (end - begin) * side) ? 1 : 0;
    }
    begin = end;
  }
  return 2 * near > all;
}

/// Whether contours of the plane lie within each other so closely that next to nothing is left
/// between them, as where one was drawn twice; or most of one along another, as where the second
/// was then edited.
bool isEmptied(const Plane& plane, const core::Progress& progress)
{
  constexpr double kThin = 0.25; // voxels, the mean width of what is left
  if (plane.contours.size() < 2)
    return false;
  double length = 0.0;
  double enclosed = 0.0; // by each contour alone
  for (const auto& contour : plane.contours)
  {
    double twice = 0.0;
    for (std::size_t n = 0; n < contour.size(); ++n)
    {
      const Eigen::Vector2d a = contour[n] - contour[0];
      const Eigen::Vector2d b = contour[(n + 1) % contour.size()] - contour[0];
      length += (b - a).norm();
      twice += a[0] * b[1] - a[1] * b[0];
    }
    enclosed += 0.5 * std::abs(twice);
  }
  if (enclosed < 2.0)
    return false;
  const double area = areaOf(plane, progress);
  if (area >= 0.5 * enclosed)
    return false;
  if (2.0 * area < kThin * length)
    return true;
  constexpr std::size_t kMostContours = 16; // bounds the time
  const std::size_t count = std::min(plane.contours.size(), kMostContours);
  for (std::size_t a = 0; a < count; ++a)
    for (std::size_t b = 0; b < count; ++b)
    {
      progress.check(kTask);
      if (a != b && followsLine(plane.contours[a], plane.contours[b], kThin))
        return true;
    }
  return false;
}

double volumeOf(const Placed& placed, const core::Progress& progress = {}) // voxels
{
  double volume = 0.0;
  for (const Plane& plane : placed.planes)
    volume += areaOf(plane, progress) * (plane.upper - plane.lower);
  return volume;
}

/// The box of the voxels that a structure's slabs touch, within the grid.
core::IndexBox boxOf(const Placed& placed, const core::GridGeometry& grid)
{
  std::array<double, 3> lower;
  std::array<double, 3> upper;
  lower.fill(1e30);
  upper.fill(-1e30);
  const auto include = [&](std::size_t axis, double value)
  {
    lower[axis] = std::min(lower[axis], value);
    upper[axis] = std::max(upper[axis], value);
  };
  for (const Plane& plane : placed.planes)
  {
    include(placed.axes.normal, plane.lower);
    include(placed.axes.normal, plane.upper);
    for (const auto& contour : plane.contours)
      for (const Eigen::Vector2d& p : contour)
      {
        include(placed.axes.first, p[0]);
        include(placed.axes.second, p[1]);
      }
  }
  core::IndexBox box;
  for (std::size_t a = 0; a < 3; ++a)
  {
    const double most = grid.dims()[a];
    box.lower[a] = static_cast<int>(std::clamp(std::floor(lower[a] + 0.5), 0.0, most));
    box.upper[a] = static_cast<int>(std::clamp(std::floor(upper[a] + 0.5) + 1.0, 0.0, most));
  }
  return box.intersected(grid.fullBox());
}

/// Shares of the voxels of a box, in 1/kWhole.
struct Shares
{
  static constexpr double kWhole = 65535.0;

  core::IndexBox box;
  std::vector<std::uint16_t> values; ///< first axis fastest
  double sum = 0.0;                  ///< of the shares, voxels

  std::size_t placeOf(const core::Index3& at) const
  {
    const core::Index3 size = box.size();
    return static_cast<std::size_t>(at[0] - box.lower[0]) +
           static_cast<std::size_t>(size[0]) *
               (static_cast<std::size_t>(at[1] - box.lower[1]) +
                static_cast<std::size_t>(size[1]) * static_cast<std::size_t>(at[2] - box.lower[2]));
  }
};

/// Adds slabs to slices of the box one after the other, so that only one is kept in full precision.
Shares sharesOf(const Placed& placed, const core::GridGeometry& grid,
                const core::Progress& progress)
{
  Shares shares;
  shares.box = boxOf(placed, grid);
  if (shares.box.empty())
    return shares;
  shares.values.assign(shares.box.count(), 0);
  const std::size_t normal = placed.axes.normal;
  const std::size_t first = placed.axes.first;
  const std::size_t second = placed.axes.second;
  const core::IndexBox& box = shares.box;
  const int width = box.size()[first];
  const auto height = static_cast<std::size_t>(box.size()[second]);
  std::vector<double> slice(static_cast<std::size_t>(width) * height);
  std::size_t from = 0; // the first plane whose slab may reach the slice
  for (int k = box.lower[normal]; k < box.upper[normal]; ++k)
  {
    progress.check(kTask);
    std::fill(slice.begin(), slice.end(), 0.0);
    while (from < placed.planes.size() && placed.planes[from].upper <= k - 0.5)
      ++from;
    for (std::size_t n = from; n < placed.planes.size() && placed.planes[n].lower < k + 0.5; ++n)
    {
      const Plane& plane = placed.planes[n];
      const double part = std::min(plane.upper, k + 0.5) - std::max(plane.lower, k - 0.5);
      if (part <= 0.0)
        continue;
      forEachSpan(plane, progress,
                  [&](std::int64_t row, double x0, double x1, double share)
                  {
                    if (row < box.lower[second] || row >= box.upper[second])
                      return;
                    double* line =
                        slice.data() + static_cast<std::size_t>(row - box.lower[second]) *
                                           static_cast<std::size_t>(width);
                    const double left = std::max(x0, box.lower[first] - 0.5);
                    const double right = std::min(x1, box.upper[first] - 0.5);
                    if (right <= left)
                      return;
                    const int begin = static_cast<int>(std::floor(left + 0.5));
                    const int end =
                        std::min(static_cast<int>(std::floor(right + 0.5)), box.upper[first] - 1);
                    for (int i = begin; i <= end; ++i)
                      line[i - box.lower[first]] +=
                          share * part * (std::min(right, i + 0.5) - std::max(left, i - 0.5));
                  });
    }
    for (std::size_t n = 0; n < slice.size(); ++n)
    {
      if (slice[n] <= 0.0)
        continue;
      shares.sum += slice[n];
      core::Index3 at;
      at[normal] = k;
      at[first] = box.lower[first] + static_cast<int>(n % static_cast<std::size_t>(width));
      at[second] = box.lower[second] + static_cast<int>(n / static_cast<std::size_t>(width));
      // Never 0 where there is something.
      shares.values[shares.placeOf(at)] = static_cast<std::uint16_t>(
          std::clamp(std::round(slice[n] * Shares::kWhole), 1.0, Shares::kWhole));
    }
  }
  return shares;
}

/// Which voxels of the box are the structure's.
std::vector<char> chosen(const Shares& shares)
{
  std::vector<std::size_t> counts(65536, 0);
  for (const std::uint16_t share : shares.values)
    ++counts[share];
  auto wanted = static_cast<std::size_t>(std::llround(shares.sum));
  std::size_t level = 65535;
  std::size_t above = 0; // voxels of a larger share
  while (level > 0 && above + counts[level] <= wanted)
    above += counts[level--];
  // Shares that differ by no more than their error: along the lines they are exact, across them
  // counted in lines, and else all that is taken would lie on the same sides. Not whole voxels.
  constexpr std::size_t kError = 65536 / kLines;
  const bool isExact = level == 0 || level == 65535; // all are taken, or whole voxels are divided
  const std::size_t lowest = isExact ? level : level > kError ? level - kError : 1;
  const std::size_t highest = isExact ? level : std::min(level + kError, std::size_t{65534});
  std::size_t ties = 0;
  for (std::size_t n = lowest; level > 0 && n <= highest; ++n)
  {
    ties += counts[n];
    above -= n > level ? counts[n] : 0;
  }
  // Of those a part, evenly spread: in order, a sheet thinner than a voxel would be whole in its
  // first slices and missing in the others.
  const std::size_t rest = level == 0 ? 0 : wanted - above;
  std::size_t tie = 0;
  std::vector<char> in(shares.values.size(), 0);
  for (std::size_t n = 0; n < in.size(); ++n)
    if (shares.values[n] > highest)
      in[n] = 1;
    else if (level > 0 && shares.values[n] >= lowest)
    {
      in[n] = (tie + 1) * rest / ties > tie * rest / ties ? 1 : 0;
      ++tie;
    }
  return in;
}

/// How much of a chosen voxel lies within the structure, on average: near 1 for a body of many
/// voxels, and the thickness in voxels for a sheet thinner than one.
double meanShare(const Shares& shares, const std::vector<char>& in)
{
  double sum = 0.0;
  std::size_t count = 0;
  for (std::size_t n = 0; n < in.size(); ++n)
    if (in[n] != 0)
    {
      sum += shares.values[n] / Shares::kWhole;
      ++count;
    }
  return count == 0 ? 1.0 : sum / static_cast<double>(count);
}

/// Keeps a voxel for each contour of which none is in; returns their number.
std::size_t keepSmall(const Placed& placed, const Shares& shares, std::vector<char>& in)
{
  std::size_t kept = 0;
  const auto [normal, first, second] = placed.axes;
  for (const Plane& plane : placed.planes)
    for (const auto& contour : plane.contours)
    {
      Eigen::Vector2d lower = contour.front();
      Eigen::Vector2d upper = lower;
      for (const Eigen::Vector2d& p : contour)
      {
        lower = lower.cwiseMin(p);
        upper = upper.cwiseMax(p);
      }
      core::IndexBox near;
      near.lower[normal] = static_cast<int>(std::floor(plane.lower + 0.5));
      near.upper[normal] = static_cast<int>(std::ceil(plane.upper + 0.5));
      near.lower[first] = static_cast<int>(std::floor(lower[0] + 0.5));
      near.upper[first] = static_cast<int>(std::floor(upper[0] + 0.5)) + 1;
      near.lower[second] = static_cast<int>(std::floor(lower[1] + 0.5));
      near.upper[second] = static_cast<int>(std::floor(upper[1] + 0.5)) + 1;
      near = near.intersected(shares.box);
      constexpr std::size_t kSmall = 4096; // voxels; a larger contour has some
      if (near.empty() || near.count() > kSmall)
        continue;
      std::size_t best = 0;
      std::uint16_t most = 0;
      bool has = false;
      for (int k = near.lower[2]; k < near.upper[2]; ++k)
        for (int j = near.lower[1]; j < near.upper[1]; ++j)
          for (int i = near.lower[0]; i < near.upper[0]; ++i)
          {
            const std::size_t at = shares.placeOf({i, j, k});
            has = has || in[at] != 0;
            if (shares.values[at] > most)
            {
              most = shares.values[at];
              best = at;
            }
          }
      if (has || most == 0)
        continue;
      in[best] = 1;
      ++kept;
    }
  return kept;
}

/// What the file states of slabs beside their contours, where that moved them or is not followed.
void noteGeometry(const StructureSet::Roi& roi, const std::string& name, const Placed& placed,
                  const core::GridGeometry& grid, std::vector<std::string>& notes)
{
  if (roi.movedContours > 0)
    notes.push_back("'" + name + "': " + std::to_string(roi.movedContours) +
                    (roi.movedContours == 1 ? " contour was" : " contours were") + " moved by " +
                    roughText(roi.movedBy) +
                    " mm, as the file states (Contour Offset Vector); programs that ignore this "
                    "show the structure elsewhere");
  if (roi.ignoredOffsets > 0)
    notes.push_back("'" + name + "': " + std::to_string(roi.ignoredOffsets) +
                    (roi.ignoredOffsets == 1 ? " contour has" : " contours have") +
                    " an offset (Contour Offset Vector) without a slab to which it would apply; "
                    "nothing was moved");
  const double slice = grid.spacing()[static_cast<int>(placed.axes.normal)];
  const double apart = placed.step * slice;
  const double usual = placed.usual * slice;
  const double stated = placed.stated * slice;
  const bool isOne = placed.planes.size() == 1;
  if (isOne && placed.stated > 0.0 && !placed.isAsStated)
  {
    notes.push_back("'" + name + "': the file states that its one plane stands for " +
                    roughText(stated) + " mm, which cannot be so on slices of " + roughText(slice) +
                    " mm; it stands for one slice; check its volume");
    return;
  }
  if (isOne && placed.isAsStated && std::abs(stated - slice) > kPlanar * slice)
    notes.push_back("'" + name + "': its one plane stands for " + roughText(stated) +
                    " mm, as the file states, and not for one slice of " + roughText(slice) +
                    " mm; check its volume");
  else if (!isOne && placed.stated > 0.0 && !placed.isAsStated)
    notes.push_back("'" + name + "': the file states planes " + roughText(stated) +
                    " mm apart (Spacing Between Slices), but its contours lie otherwise; each "
                    "stands for " +
                    roughText(usual) + " mm, as far as they lie apart; check its volume");
  else if (!isOne && placed.isAsStated && std::abs(stated - usual) > kPlanar * usual)
    notes.push_back("'" + name + "': its contours lie " + roughText(usual) +
                    " mm apart, but the file states planes " + roughText(stated) +
                    " mm apart (Spacing Between Slices); at the ends and beside gaps each stands "
                    "for " +
                    roughText(stated) + " mm; check its volume");
  if (std::isnan(roi.slabThickness))
    notes.push_back("'" + name +
                    "': its contours state slabs of several thicknesses (Contour Slab Thickness); "
                    "each stands for " +
                    roughText(apart) + (isOne ? " mm" : " mm, as far as they lie apart") +
                    "; check its volume");
  else if (roi.slabThickness > 0.0 && std::abs(roi.slabThickness - apart) > kPlanar * apart)
    notes.push_back("'" + name + "': its contours state slabs of " + roughText(roi.slabThickness) +
                    " mm (Contour Slab Thickness); each stands for " + roughText(apart) +
                    (isOne ? " mm" : " mm, as far as they lie apart") + "; check its volume");
}

} // namespace

bool isStructureSetClass(const std::string& sopClass)
{
  return sopClass == "1.2.840.10008.5.1.4.1.1.481.3";
}

bool isStructureSet(const std::filesystem::path& path)
{
  const FileFormat* format = recognisedFormat(path);
  return (!format || format->reads == kDicom) && isStructureSetClass(sopClassOf(path));
}

StructureSet readStructureSet(const std::filesystem::path& path, const core::Progress& progress)
{
  DicomItem::Encoding encoding;
  StructureSet set;
  const std::string bytes = dataSet(path, encoding, set.patient, progress);
  const DicomItem data(bytes, encoding);
  const auto checkDamage = [&path](const DicomItem& item)
  {
    if (item.isDamaged())
      fail(Reason::Unreadable, path, "is cut short or damaged; copy or export it again");
  };
  checkDamage(data);
  const std::string characters = data.text(0x00080005);
  std::map<int, std::size_t> places; // by ROI Number
  const auto numberOf = [&](const DicomItem& item, Tag tag)
  {
    const auto value = item.number(tag);
    return value && *value == std::floor(*value) && std::abs(*value) < 1e9
               ? std::optional<int>(static_cast<int>(*value))
               : std::nullopt;
  };
  for (const DicomItem& item : data.items(0x30060020))
  {
    checkDamage(item);
    const auto number = numberOf(item, 0x30060022);
    if (!number || !places.emplace(*number, set.rois.size()).second)
      fail(Reason::Unreadable, path,
           "describes a structure without a number, or two of one number; export it again");
    StructureSet::Roi roi;
    roi.name = toUtf8(item.text(0x30060026), characters);
    if (roi.name.empty())
      roi.name = "label " + std::to_string(*number);
    roi.codes.algorithm = algorithmFrom(item.text(0x30060036));
    const std::string frame = item.text(0x30060024);
    if (set.frameOfReferenceUid.empty())
      set.frameOfReferenceUid = frame;
    else if (!frame.empty() && frame != set.frameOfReferenceUid)
      fail(Reason::Unsupported, path,
           "holds structures of several frames of reference; export those of each image in a file "
           "of their own");
    set.rois.push_back(std::move(roi));
    if (set.rois.size() > kMostRois)
      fail(Reason::Unsupported, path, "holds more than 65535 structures; export fewer at a time");
  }
  for (const DicomItem& item : data.items(0x30060080))
    if (const auto number = numberOf(item, 0x30060084); number && places.count(*number) > 0)
    {
      const DicomItem code = item.item(0x30060086); // RT ROI Identification Code
      StructureSet::Roi& roi = set.rois[places.at(*number)];
      roi.codes.type = codedConcept(code, characters);
      roi.meaning = toUtf8(code.text(0x00080104), characters);
      if (roi.meaning.empty())
        roi.meaning = toUtf8(item.text(0x300600a4), characters);
    }
  progress.report(0.5, kTask);
  std::set<std::size_t> drawn; // places
  for (const DicomItem& item : data.items(0x30060039))
  {
    checkDamage(item);
    const auto number = numberOf(item, 0x30060084);
    const auto found = number ? places.find(*number) : places.end();
    if (found == places.end())
      fail(Reason::Unreadable, path,
           "has contours of a structure that it does not describe; export it again");
    StructureSet::Roi& roi = set.rois[found->second];
    const std::vector<double> color = item.numbers(0x3006002a);
    if (color.size() == 3)
      for (std::size_t c = 0; c < 3; ++c)
        roi.color[c] = static_cast<float>(std::clamp(color[c] / 255.0, 0.0, 1.0));
    roi.planeSpacing = item.item(0x3006004a).number(0x00180088).value_or(0.0);
    const std::vector<DicomItem> contours = item.items(0x30060040);
    if (!contours.empty() && !drawn.insert(found->second).second) // would cut holes into the first
      fail(Reason::Unreadable, path,
           "describes the contours of one structure twice (ROI Contour Sequence), which may be two "
           "structures; export it again");
    for (const DicomItem& contour : contours)
    {
      checkDamage(contour);
      const std::string type = contour.text(0x30060042);
      if (type != "CLOSED_PLANAR" && type != "CLOSEDPLANAR_XOR")
      {
        ++roi.otherContours;
        continue;
      }
      std::vector<Eigen::Vector3d> points = readPoints(contour, path, progress);
      if (points.size() < 3)
      {
        ++roi.otherContours;
        continue;
      }
      applyOffset(contour, path, roi, points);
      roi.contours.push_back(std::move(points));
      noteThickness(contour, roi);
    }
  }
  return set;
}

double contourVolume(const StructureSet::Roi& roi, const core::GridGeometry& grid)
{
  const auto placed = roi.contours.empty() ? std::nullopt : place(roi, grid);
  return placed ? volumeOf(*placed) * grid.voxelVolume() : 0.0;
}

namespace
{

/// From the nearest point of the image to a point of the patient, LPS mm; 0 within the image.
Eigen::Vector3d beyond(const core::GridGeometry& grid, const Eigen::Vector3d& patient)
{
  const auto& dims = grid.dims();
  const Eigen::Vector3d last = Eigen::Vector3d(dims[0], dims[1], dims[2]).array() - 0.5;
  const Eigen::Vector3d voxel = grid.voxelFromPatient(patient);
  const Eigen::Vector3d nearest = voxel.cwiseMax(Eigen::Vector3d::Constant(-0.5)).cwiseMin(last);
  return voxel == nearest ? Eigen::Vector3d::Zero().eval()
                          : (patient - grid.patientFromVoxel(nearest)).eval();
}

/// Of a direction, LPS.
const char* sideOf(const Eigen::Vector3d& direction)
{
  Eigen::Index axis = 0;
  direction.cwiseAbs().maxCoeff(&axis);
  const bool isPositive = direction[axis] > 0.0;
  return axis == 0   ? (isPositive ? "left of it" : "right of it")
         : axis == 1 ? (isPositive ? "posterior to it" : "anterior to it")
                     : (isPositive ? "superior to it" : "inferior to it");
}

/// The shortest way from the image to a contour (beyond).
Eigen::Vector3d nearestContour(const StructureSet& set, const core::GridGeometry& grid)
{
  std::optional<Eigen::Vector3d> shortest;
  for (const StructureSet::Roi& roi : set.rois)
    for (const auto& contour : roi.contours)
      for (const Eigen::Vector3d& point : contour)
        if (const Eigen::Vector3d way = beyond(grid, point);
            !shortest || way.squaredNorm() < shortest->squaredNorm())
          shortest = way;
  return shortest.value_or(Eigen::Vector3d::Zero());
}

} // namespace

LoadedLabels labelsOf(const StructureSet& set, const core::GridGeometry& grid,
                      const std::filesystem::path& path, const core::Progress& progress,
                      std::uint64_t memory)
{
  LoadedLabels loaded;
  loaded.frameOfReferenceUid = set.frameOfReferenceUid;
  loaded.patient = set.patient;
  std::vector<std::shared_ptr<volume::Volume<std::uint16_t>>> layers;
  std::vector<std::vector<volume::Segment>> names;
  const auto addLayer = [&]
  {
    // What is left is after the layers before.
    const std::uint64_t count = memory == 0 ? 1 : layers.size() + 1;
    requireMemory(path, count * grid.voxelCount() * sizeof(std::uint16_t), kFewer, memory);
    layers.push_back(volume::makeZeroVolume<std::uint16_t>(grid));
    names.emplace_back();
  };
  std::vector<std::string> oblique;
  std::vector<std::string> coarse; // drawn on every second slice or fewer
  std::vector<std::string> crossed;
  std::size_t others = 0;
  std::size_t drawn = 0;
  bool hasVoxels = false;
  UniqueNames unique;
  for (const StructureSet::Roi& roi : set.rois)
    unique.reserve(roi.name);
  for (std::size_t n = 0; n < set.rois.size(); ++n)
  {
    const StructureSet::Roi& roi = set.rois[n];
    const std::string name = unique.take(roi.name, loaded.notes);
    const core::Progress part =
        progress.part(static_cast<double>(n) / static_cast<double>(set.rois.size()),
                      static_cast<double>(n + 1) / static_cast<double>(set.rois.size()));
    part.report(0.0, kTask);
    const auto label = static_cast<std::uint16_t>(n + 1);
    volume::Segment segment{name, label, roi.color, 0};
    if (!roi.meaning.empty())
      loaded.meanings[name] = roi.meaning;
    if (!roi.codes.empty())
      loaded.codes[name] = roi.codes;
    others += roi.otherContours;
    std::size_t layer = 0;
    if (!roi.contours.empty())
    {
      ++drawn;
      const auto placed = place(roi, grid, part);
      if (!placed)
      {
        oblique.push_back("'" + name + "'");
        loaded.unread.push_back({name, label, false});
        continue;
      }
      if (placed->step > kGap && placed->planes.size() > 1)
        coarse.push_back("'" + name + "'");
      noteGeometry(roi, name, *placed, grid, loaded.notes);
      if (placed->twice > 0)
        loaded.notes.push_back("'" + name + "': " + std::to_string(placed->twice) +
                               (placed->twice == 1 ? " contour that is" : " contours that are") +
                               " there twice in one plane " +
                               (placed->twice == 1 ? "was" : "were") + " taken once");
      if (std::any_of(placed->planes.begin(), placed->planes.end(),
                      [&part](const Plane& plane)
                      {
                        part.check(kTask);
                        return hasCrossing(plane);
                      }))
        crossed.push_back("'" + name + "'");
      if (const auto emptied =
              std::count_if(placed->planes.begin(), placed->planes.end(),
                            [&part](const Plane& plane) { return isEmptied(plane, part); });
          emptied > 0)
        loaded.notes.push_back("'" + name +
                               "' has contours that lie closely within each other in " +
                               std::to_string(emptied) + (emptied == 1 ? " plane" : " planes") +
                               ", where next to nothing is left between them (were they drawn "
                               "twice?)");
      requireMemory(path, boxOf(*placed, grid).count() * (sizeof(std::uint16_t) + sizeof(char)),
                    kFewer, memory);
      const Shares shares = sharesOf(*placed, grid, part);
      constexpr double kNoted = 0.01; // of the volume
      const double whole = volumeOf(*placed, part);
      loaded.fileVolumes[name] = whole * grid.voxelVolume();
      if (shares.sum < (1.0 - kNoted) * whole)
        loaded.notes.push_back(
            "'" + name + "': " + std::to_string(std::lround(100.0 * (1.0 - shares.sum / whole))) +
            " % of it lies outside this image and became no voxels");
      if (!shares.box.empty())
      {
        std::vector<char> in = chosen(shares);
        if (const std::size_t kept = keepSmall(*placed, shares, in); kept > 0)
          loaded.notes.push_back("'" + name + "' has " + std::to_string(kept) +
                                 (kept == 1 ? " contour" : " contours") +
                                 " smaller than a voxel, which became one voxel each");
        constexpr double kThin = 0.7;
        if (const double inside = meanShare(shares, in);
            shares.sum >= kThinVoxels && inside < kThin)
        {
          constexpr double kRight = 0.1; // of the volume
          const auto became = static_cast<double>(std::count(in.begin(), in.end(), char{1}));
          const double times = became / shares.sum;
          const std::string within = std::to_string(std::lround(100.0 * inside));
          loaded.notes.push_back(
              "'" + name + "' is thinner than the voxels: those that it became lie on average " +
              within + " % within its contours" +
              (std::abs(times - 1.0) <= kRight
                   ? " and are scattered; its volume is right, its shape is not"
                   : ", and their volume is " + core::fixedText(times, 2) +
                         " times that of the contours; neither it nor their shape is that of the "
                         "structure"));
        }
        const auto forEach = [&](const auto& visit)
        {
          std::size_t at = 0;
          for (int k = shares.box.lower[2]; k < shares.box.upper[2]; ++k)
            for (int j = shares.box.lower[1]; j < shares.box.upper[1]; ++j)
              for (int i = shares.box.lower[0]; i < shares.box.upper[0]; ++i, ++at)
                if (in[at] != 0 && !visit(i, j, k))
                  return false;
          return true;
        };
        while (layer < layers.size() &&
               !forEach([&](int i, int j, int k) { return layers[layer]->at(i, j, k) == 0; }))
          ++layer;
        if (layer == layers.size())
        {
          if ((layer + 1) * grid.voxelCount() > kMaxVoxels)
            fail(Reason::Unsupported, path,
                 "its structures overlap in more layers than are read; export fewer of them at a "
                 "time");
          addLayer();
        }
        forEach(
            [&](int i, int j, int k)
            {
              layers[layer]->at(i, j, k) = label;
              hasVoxels = true;
              return true;
            });
      }
    }
    if (layers.empty())
      addLayer();
    names[layer].push_back(std::move(segment));
  }
  const auto list = [](const std::vector<std::string>& texts)
  {
    std::string all;
    for (const std::string& text : texts)
      all += (all.empty() ? "" : ", ") + text;
    return all;
  };
  if (drawn == 0)
    fail(Reason::Unsupported, path,
         "has no closed contour in any structure; export it again with what was drawn");
  if (oblique.size() == drawn)
    fail(Reason::Unsupported, path,
         "was drawn on planes oblique to this image's slices; resample the image or the contours "
         "where they were drawn, or export the structures as a segmentation");
  if (const Eigen::Vector3d way =
          hasVoxels ? Eigen::Vector3d(0.0, 0.0, 0.0) : nearestContour(set, grid);
      way.norm() > 0.0)
    fail(Reason::Unsupported, path,
         "lies wholly outside this image, its nearest contour " + core::fixedText(way.norm(), 1) +
             " mm " + sideOf(way) +
             "; take the image on which it was drawn, or export it again with the contours of this "
             "one");
  if (!oblique.empty())
    loaded.notes.push_back(list(oblique) + " left out: drawn on planes oblique to this image's "
                                           "slices");
  if (!coarse.empty())
    loaded.notes.push_back(list(coarse) + ": drawn on some of the slices only; each contour stands "
                                          "for the slices half-way to the next");
  if (!crossed.empty())
    loaded.notes.push_back(list(crossed) +
                           ": contours of one plane cross each other; what two of them surround is "
                           "outside, as within an inner contour");
  if (others > 0)
    loaded.notes.push_back(
        std::to_string(others) +
        (others == 1 ? " point or open contour encloses" : " points and open contours enclose") +
        " nothing and became no voxels");
  for (std::size_t layer = 0; layer < layers.size(); ++layer)
    loaded.maps.push_back(volume::makeLabelMap(std::move(layers[layer]), std::move(names[layer])));
  progress.report(1.0, kTask);
  return loaded;
}

} // namespace petrous::imaging
