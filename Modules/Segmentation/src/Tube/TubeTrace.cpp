#include "petrous/Segmentation/TubeTrace.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include <Eigen/Geometry>
#include <tbb/parallel_for.h>

#include "TubePath.h"
#include "TubeRefinement.h"
#include "petrous/Appearance/StructurePresets.h"
#include "petrous/Core/Error.h"

namespace petrous::segmentation
{
namespace
{

using core::InvalidParameter;
using Eigen::Vector3d;

std::string pointText(std::size_t index)
{
  return "tube: point " + std::to_string(index + 1);
}

void checkOptions(const TubeOptions& options)
{
  if (options.radius && !TubeOptions::kRadii.contains(*options.radius))
    throw InvalidParameter("tube: the radius " + TubeOptions::kRadii.refusal(*options.radius));
  if (options.usual && !TubeOptions::kRadii.contains(*options.usual))
    throw InvalidParameter("tube: the usual radius " + TubeOptions::kRadii.refusal(*options.usual));
  if (!TubeOptions::kRadii.contains(options.widest))
    throw InvalidParameter("tube: the largest radius " +
                           TubeOptions::kRadii.refusal(options.widest));
  if (options.blur && !TubeOptions::kBlurs.contains(*options.blur))
    throw InvalidParameter("tube: the blur " + TubeOptions::kBlurs.refusal(*options.blur));
  if (!TubeOptions::kReaches.contains(options.reach))
    throw InvalidParameter("tube: the reach " + TubeOptions::kReaches.refusal(options.reach));
  if (!TubeOptions::kContrasts.contains(options.resolvedContrast))
    throw InvalidParameter("tube: the contrast from which a structure counts as resolved " +
                           TubeOptions::kContrasts.refusal(options.resolvedContrast));
}

void checkPoints(const core::GridGeometry& geometry, const std::vector<Vector3d>& points)
{
  if (points.size() < 2 || points.size() > TubeOptions::kMostPoints)
    throw InvalidParameter("tube: " + std::to_string(points.size()) +
                           (points.size() == 1 ? " point is" : " points are") +
                           " given; it needs 2 to " + std::to_string(TubeOptions::kMostPoints) +
                           ", typically 4 to 6 along the structure");
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    if (!points[i].allFinite())
      throw InvalidParameter(pointText(i) + " is not a position; three finite numbers are needed");
    if (!geometry.hullContains(geometry.voxelFromPatient(points[i])))
      throw InvalidParameter(pointText(i) + " lies outside of the image; set it inside");
    if (i == 0)
      continue;
    const double leg = (points[i] - points[i - 1]).norm();
    if (leg < 0.01)
      throw InvalidParameter(pointText(i) + " is where point " + std::to_string(i) +
                             " is; move or remove one of them");
    if (leg > TubeOptions::kLongestLeg)
      throw InvalidParameter(pointText(i) + " is " + core::fixedText(leg, 1) + " mm from point " +
                             std::to_string(i) + "; neighbouring points may be " +
                             core::fixedText(TubeOptions::kLongestLeg, 0) +
                             " mm apart: add points between them");
  }
}

/// The voxels that any leg, and the cross-sections along it, may ask for.
core::IndexBox boxAround(const core::GridGeometry& geometry, const std::vector<Vector3d>& points,
                         double radius)
{
  Vector3d lower = Vector3d::Constant(std::numeric_limits<double>::max());
  Vector3d upper = -lower;
  for (std::size_t i = 0; i + 1 < points.size(); ++i)
  {
    // Not just on voxels for round numbers: rounding would make the box depend on their order.
    const double reach = legReach((points[i + 1] - points[i]).norm(), radius) + 2.0 * radius +
                         2.013 * geometry.spacing().maxCoeff();
    for (const Vector3d& p : {points[i], points[i + 1]})
    {
      lower = lower.cwiseMin((p.array() - reach).matrix());
      upper = upper.cwiseMax((p.array() + reach).matrix());
    }
  }
  return geometry.boxCovering(lower, upper);
}

struct Foot
{
  std::size_t segment = 0;
  double fraction = 0.0; ///< along the segment
  Vector3d position = Vector3d::Zero();
  double distance = std::numeric_limits<double>::max();
};

/// The nearest position of the line, from a vertex on.
Foot nearestOn(const std::vector<Vector3d>& line, const Vector3d& point, std::size_t from = 0)
{
  Foot best;
  for (std::size_t i = from; i + 1 < line.size(); ++i)
  {
    const Vector3d run = line[i + 1] - line[i];
    const double length2 = run.squaredNorm();
    const double t = length2 > 0.0 ? std::clamp((point - line[i]).dot(run) / length2, 0.0, 1.0) : 0;
    const Vector3d p = line[i] + t * run;
    const double distance = (point - p).norm();
    if (distance < best.distance)
      best = {i, t, p, distance};
  }
  return best;
}

/// The part of the line between the feet of the first and the last point.
void trimEnds(CentreLine& line, const Vector3d& first, const Vector3d& last)
{
  const auto trimFront = [&](const Vector3d& point)
  {
    const Foot foot = nearestOn(line.vertices, point);
    const std::size_t i = foot.segment;
    if (line.vertices.size() - i < 3) // nothing would be left
      return;
    const auto cut = [&](auto& values)
    { values.erase(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(i)); };
    cut(line.vertices);
    forEachNumber(line, cut);
    line.vertices.front() = foot.position;
  };
  const auto reverse = [&]
  {
    std::reverse(line.vertices.begin(), line.vertices.end());
    forEachNumber(line,
                  [](std::vector<double>& values) { std::reverse(values.begin(), values.end()); });
  };
  trimFront(first);
  reverse();
  trimFront(last);
  reverse();
}

/// Cubic interpolation between the vertices, `pieces` to a segment (Catmull-Rom; both ends
/// linear); numbers along the line linearly.
void densify(CentreLine& line, std::size_t pieces)
{
  if (pieces < 2)
    return;
  std::vector<Vector3d> dense;
  const std::vector<Vector3d>& v = line.vertices;
  const std::size_t n = v.size();
  for (std::size_t i = 0; i + 1 < n; ++i)
  {
    const Vector3d before = i > 0 ? v[i - 1] : Vector3d(2.0 * v[i] - v[i + 1]);
    const Vector3d after = i + 2 < n ? v[i + 2] : Vector3d(2.0 * v[i + 1] - v[i]);
    const Vector3d start = 0.5 * (v[i + 1] - before);
    const Vector3d end = 0.5 * (after - v[i]);
    for (std::size_t p = 0; p < pieces; ++p)
    {
      const double t = static_cast<double>(p) / static_cast<double>(pieces);
      const double t2 = t * t;
      const double t3 = t2 * t;
      dense.emplace_back((2 * t3 - 3 * t2 + 1) * v[i] + (t3 - 2 * t2 + t) * start +
                         (3 * t2 - 2 * t3) * v[i + 1] + (t3 - t2) * end);
    }
  }
  dense.push_back(v.back());
  line.vertices = std::move(dense); // v, too
  const auto mix = [n, pieces](std::vector<double>& values)
  {
    std::vector<double> between;
    for (std::size_t i = 0; i + 1 < n; ++i)
      for (std::size_t p = 0; p < pieces; ++p)
      {
        const double t = static_cast<double>(p) / static_cast<double>(pieces);
        between.push_back((1.0 - t) * values[i] + t * values[i + 1]);
      }
    between.push_back(values.back());
    values = std::move(between);
  };
  forEachNumber(line, mix);
}

/// The width of a voxel across the line, mm: the largest over the directions across it.
double voxelAcross(const core::GridGeometry& geometry, const Vector3d& tangent)
{
  const Vector3d t = (geometry.direction().transpose() * tangent).cwiseAbs();
  double widest = 0.0;
  for (int a = 0; a < 3; ++a)
    widest = std::max(widest, geometry.spacing()[a] * std::sqrt(std::max(1.0 - t[a] * t[a], 0.0)));
  return widest;
}

} // namespace

namespace
{

/// How far each point lies from the line, and the vertex there.
void placePoints(Tube& tube)
{
  const std::size_t n = tube.line.size();
  std::size_t from = 0;
  for (std::size_t p = 0; p < tube.points.size(); ++p)
  {
    const Foot foot = nearestOn(tube.line, tube.points[p], std::min(from, n - 2));
    std::size_t vertex = foot.segment + (foot.fraction > 0.5 ? 1 : 0);
    if (p == 0 || p + 1 == tube.points.size())
      vertex = p == 0 ? 0 : n - 1;
    tube.pointDistances.push_back(foot.distance);
    tube.pointVertices.push_back(std::max(vertex, from));
    from = tube.pointVertices.back();
  }
}

/// Between neighbouring points: whether the line is so long a detour that the points do not guide
/// it. Beyond a half circle's length a point between them is missing, or it follows something else;
/// points that lie close together may be off by `slack` mm.
std::vector<std::uint8_t> straysOf(const Tube& tube, const std::vector<double>& lengths,
                                   double slack)
{
  constexpr double kDetour = 0.55; // of the straight line; of a half circle 0.57
  std::vector<std::uint8_t> strays(tube.line.size(), 0);
  for (std::size_t p = 1; p < tube.points.size(); ++p)
  {
    const std::size_t from = tube.pointVertices[p - 1];
    const std::size_t to = tube.pointVertices[p];
    const double chord = (tube.points[p] - tube.points[p - 1]).norm();
    if (lengths[to] - lengths[from] - chord > std::max(kDetour * chord, slack))
      std::fill(strays.begin() + static_cast<std::ptrdiff_t>(from),
                strays.begin() + static_cast<std::ptrdiff_t>(to) + 1, std::uint8_t{1});
  }
  return strays;
}

appearance::NerveKind nerveOf(std::string_view name)
{
  static const auto presets = appearance::StructurePresets::builtIn();
  return presets.nerveOf(std::string(name));
}

/// Half of the segments on either side of a vertex, mm.
double shareOf(const std::vector<double>& lengths, std::size_t vertex)
{
  return 0.5 *
         (lengths[std::min(vertex + 1, lengths.size() - 1)] - lengths[vertex > 0 ? vertex - 1 : 0]);
}

/// What is resolved between doubtful stretches over less than the diameter is no tube by itself.
void dropFragments(Tube& tube, const std::vector<double>& lengths)
{
  const std::size_t n = tube.doubts.size();
  for (std::size_t i = 0; i < n;)
  {
    std::size_t end = i;
    while (end < n && (tube.doubts[end] == TubeDoubt::None) == (tube.doubts[i] == TubeDoubt::None))
      ++end;
    if (tube.doubts[i] == TubeDoubt::None && i > 0 && end < n &&
        lengths[end - 1] - lengths[i] < 2.0 * tube.radii[i])
      std::fill(tube.doubts.begin() + static_cast<std::ptrdiff_t>(i),
                tube.doubts.begin() + static_cast<std::ptrdiff_t>(end), TubeDoubt::Fragment);
    i = end;
  }
}

/// Where the image does not resolve the tube, its half-maximum width says nothing of the radius,
/// and less the blur may leave none: there the radius of what is resolved on either side goes on,
/// linearly. If nothing is resolved, they are the usual one, or none is below `least`.
void bridgeUnresolved(Tube& tube, const std::vector<double>& lengths, double least,
                      const std::optional<double>& usual)
{
  const std::size_t n = tube.radii.size();
  std::size_t before = n; // the last resolved vertex; n: none yet
  for (std::size_t i = 0; i < n; ++i)
  {
    if (tube.resolved[i] == 0)
      continue;
    const std::size_t from = before == n ? 0 : before + 1;
    for (std::size_t k = from; k < i; ++k)
    {
      const double t =
          before == n ? 1.0 : (lengths[k] - lengths[before]) / (lengths[i] - lengths[before]);
      tube.radii[k] =
          before == n ? tube.radii[i] : (1.0 - t) * tube.radii[before] + t * tube.radii[i];
    }
    before = i;
  }
  if (before == n && usual)
    return std::fill(tube.radii.begin(), tube.radii.end(), *usual);
  for (std::size_t k = before == n ? 0 : before + 1; k < n; ++k)
    tube.radii[k] = before == n ? std::max(tube.radii[k], least) : tube.radii[before];
}

} // namespace

std::vector<std::size_t> likelyOrder(const std::vector<Vector3d>& points)
{
  constexpr std::size_t kMost = 12;
  constexpr double kShorter = 0.75;
  const std::size_t count = points.size();
  if (count < 3 || count > kMost)
    return {};
  double own = 0.0;
  for (std::size_t n = 1; n < count; ++n)
    own += (points[n] - points[n - 1]).norm();
  // The shortest path through each set of points that ends in each of them [Held and Karp 1962,
  // doi 10.1137/0110015].
  const std::size_t sets = std::size_t{1} << count;
  std::vector<double> length(sets * count, std::numeric_limits<double>::infinity());
  std::vector<std::size_t> before(sets * count, count);
  for (std::size_t n = 0; n < count; ++n)
    length[(std::size_t{1} << n) * count + n] = 0.0;
  for (std::size_t set = 1; set < sets; ++set)
    for (std::size_t last = 0; last < count; ++last)
      for (std::size_t next = 0; next < count; ++next)
      {
        const std::size_t wider = set | std::size_t{1} << next;
        const double sum = length[set * count + last] + (points[next] - points[last]).norm();
        if (wider != set && sum < length[wider * count + next])
        {
          length[wider * count + next] = sum;
          before[wider * count + next] = last;
        }
      }
  const double* ends = &length[(sets - 1) * count];
  std::size_t last = static_cast<std::size_t>(std::min_element(ends, ends + count) - ends);
  if (!(ends[last] < kShorter * own))
    return {};
  std::vector<std::size_t> order;
  for (std::size_t set = sets - 1; last < count;)
  {
    order.push_back(last);
    const std::size_t previous = before[set * count + last];
    set &= ~(std::size_t{1} << last);
    last = previous;
  }
  if (order.front() > order.back())
    std::reverse(order.begin(), order.end());
  return order;
}

Tube traceTube(const volume::IntensityVolume& image, const std::vector<Vector3d>& points,
               const TubeOptions& options, const core::Progress& progress, const Tube* before)
{
  const core::GridGeometry& geometry = image.geometry();
  checkOptions(options);
  checkPoints(geometry, points);
  progress.report(0.0, "trace tube");

  const TubeImage local(image,
                        boxAround(geometry, points, options.radius.value_or(options.widest)));
  progress.report(0.1, "trace tube");
  const TubeModel model = estimateModel(local, points, options, progress);
  const std::vector<SnappedPoint> snapped = snapPoints(local, points, model, options);
  progress.report(0.3, "trace tube");

  Tube tube;
  tube.points = points;
  tube.model = model;
  tube.noise = local.noise();
  tube.blur = options.blur.value_or(0.7 * geometry.spacing().mean());
  tube.legs.resize(points.size() - 1);
  tbb::parallel_for(
      std::size_t{0}, tube.legs.size(),
      [&](std::size_t leg)
      {
        if (before && before->model == model)
          for (std::size_t i = 0; i < before->legs.size(); ++i)
            if (before->points[i] == points[leg] && before->points[i + 1] == points[leg + 1])
            {
              tube.legs[leg] = before->legs[i];
              return;
            }
        tube.legs[leg] =
            findLeg(local, snapped[leg].position, snapped[leg + 1].position, model, progress);
      });
  progress.report(0.6, "trace tube");

  std::vector<Vector3d> path;
  std::vector<Vector3d> held;
  for (const auto& leg : tube.legs)
    path.insert(path.end(), leg.begin() + (path.empty() ? 0 : 1), leg.end());
  for (const SnappedPoint& point : snapped)
  {
    tube.heldAtPoint.push_back(point.held ? 1 : 0);
    if (point.held)
      held.push_back(point.position);
  }
  // trilinear interpolation blurs as well: h^2 / 6 on average
  const double voxel = geometry.spacing().mean();
  const double sigma = std::sqrt(tube.blur * tube.blur + voxel * voxel / 6.0);
  CentreLine line =
      refineLine(local, path, model, halfMaximumRadius(model.radius, sigma), tube.blur,
                 options.radius.has_value(), held, progress.part(0.6, 0.95));
  trimEnds(line, points.front(), points.back());

  double widestStep = 0.0;
  for (std::size_t i = 0; i + 1 < line.vertices.size(); ++i)
    widestStep = std::max(widestStep, (line.vertices[i + 1] - line.vertices[i]).norm());
  densify(line, static_cast<std::size_t>(std::ceil(widestStep / (0.45 * geometry.minSpacing()))));

  tube.line = std::move(line.vertices);
  tube.radii = radiiFromHalfMaximum(line.halfRadius, sigma);
  constexpr double kAtLimit = 0.97; // of the largest radius: what is seen there is something else
  const double limit =
      options.radius ? std::numeric_limits<double>::infinity() : kAtLimit * options.widest;
  if (options.radius)
    std::fill(tube.radii.begin(), tube.radii.end(), *options.radius);
  const std::size_t n = tube.line.size();
  const std::vector<double> lengths = arcLengths(tube.line);
  tube.length = lengths.back();
  placePoints(tube);
  const std::vector<std::uint8_t> strays = straysOf(tube, lengths, options.reach);
  const double lumen = medianOf(line.lumen);
  const double contrast = medianOf(line.contrast);
  for (std::size_t i = 0; i < n; ++i)
  {
    constexpr double kMost = 1e6; // of images without noise
    // Of the contrast, at the lowest quarter of the wall. A nerve's canal may be open to a cavity,
    // or its wall thinner than the voxels; an edge has none over half of the circumference.
    constexpr double kClosed = 0.3;
    tube.contrast.push_back(
        std::min(tube.noise > 0.0 ? line.contrast[i] / tube.noise : kMost, kMost));
    const Vector3d tangent =
        (tube.line[std::min(i + 1, n - 1)] - tube.line[i > 0 ? i - 1 : 0]).normalized();
    TubeDoubt doubt = TubeDoubt::None;
    if (!(model.contrast > 0.0) || tube.contrast[i] < options.resolvedContrast)
      doubt = TubeDoubt::Faint;
    else if (tube.radii[i] < voxelAcross(geometry, tangent))
      doubt = TubeDoubt::Thin;
    else if (tube.radii[i] >= limit)
      doubt = TubeDoubt::Wide;
    else if (options.lumen &&
             (line.lumen[i] < options.lumen->min || line.lumen[i] > options.lumen->max))
      doubt = TubeDoubt::Foreign;
    else if (std::abs(line.lumen[i] - lumen) * options.resolvedContrast > contrast)
      doubt = TubeDoubt::Uneven;
    else if (line.closure[i] < kClosed)
      doubt = TubeDoubt::Open;
    else if (strays[i] != 0)
      doubt = TubeDoubt::Stray;
    tube.doubts.push_back(doubt);
  }
  dropFragments(tube, lengths);
  const auto resolvedLength = [&]
  {
    double length = 0.0;
    for (std::size_t i = 0; i < n; ++i)
      if (tube.doubts[i] == TubeDoubt::None)
        length += shareOf(lengths, i);
    return length;
  };
  tube.resolvedLength = resolvedLength();
  // Of a tube that is mostly too thin or too faint to be seen, what stands out here and there is as
  // well something else beside it: a cell, a marrow space.
  constexpr double kMostly = 0.5;
  if (tube.resolvedLength < kMostly * tube.length)
  {
    std::replace(tube.doubts.begin(), tube.doubts.end(), TubeDoubt::None, TubeDoubt::Fragment);
    tube.resolvedLength = 0.0;
  }
  for (const TubeDoubt doubt : tube.doubts)
    tube.resolved.push_back(doubt == TubeDoubt::None ? 1 : 0);
  if (!options.radius)
  {
    for (double& radius : tube.radii)
      radius = std::min(radius, options.widest);
    bridgeUnresolved(tube, lengths, 0.5 * geometry.minSpacing(), options.usual);
  }
  std::vector<double> ordered = tube.radii;
  std::sort(ordered.begin(), ordered.end());
  tube.radius = ordered[ordered.size() / 2];
  tube.smallestRadius = ordered.front();
  tube.largestRadius = ordered.back();

  for (std::size_t p = 0; p < points.size(); ++p)
    tube.outsideAtPoint.push_back(
        tube.pointDistances[p] >
                std::max(tube.radii[tube.pointVertices[p]], geometry.spacing().maxCoeff())
            ? 1
            : 0);
  progress.report(1.0, "trace tube");
  return tube;
}

bool hasUsualRadius(const Tube& tube, const TubeOptions& options)
{
  return !options.radius && options.usual && tube.resolvedLength == 0.0;
}

std::vector<TubeStretch> unresolvedStretches(const Tube& tube)
{
  std::vector<TubeStretch> stretches;
  const std::vector<double> lengths = arcLengths(tube.line);
  const std::size_t n = tube.doubts.size();
  for (std::size_t i = 0; i < n;)
  {
    if (tube.doubts[i] == TubeDoubt::None)
    {
      ++i;
      continue;
    }
    std::array<double, static_cast<std::size_t>(TubeDoubt::Fragment) + 1> along{};
    TubeStretch stretch{0.5 * (lengths[i] + lengths[i > 0 ? i - 1 : 0]), 0.0, TubeDoubt::None};
    for (; i < n && tube.doubts[i] != TubeDoubt::None; ++i)
      along[static_cast<std::size_t>(tube.doubts[i])] += shareOf(lengths, i);
    stretch.to = 0.5 * (lengths[i - 1] + lengths[std::min(i, n - 1)]);
    stretch.doubt =
        static_cast<TubeDoubt>(std::max_element(along.begin(), along.end()) - along.begin());
    stretches.push_back(stretch);
  }
  return stretches;
}

std::optional<volume::ValueRange> lumenFor(std::string_view name)
{
  if (nerveOf(name) != appearance::NerveKind::None)
    return volume::ValueRange{-500.0, 700.0}; // soft tissue 40, air -1000, cortical bone 1400 HU
  return std::nullopt;
}

double widestFor(std::string_view name)
{
  const appearance::NerveKind nerve = nerveOf(name);
  return nerve == appearance::NerveKind::ChordaTympani ? 0.5
         : nerve == appearance::NerveKind::Facial      ? 1.3
                                                       : TubeOptions{}.widest;
}

std::optional<double> usualFor(std::string_view name)
{
  const appearance::NerveKind nerve = nerveOf(name);
  return nerve == appearance::NerveKind::ChordaTympani ? std::optional(0.2)
         : nerve == appearance::NerveKind::Facial      ? std::optional(0.6)
                                                       : std::nullopt;
}

TubeOptions tubeOptionsFor(std::string_view name, const std::optional<double>& radius,
                           bool isHounsfieldCt)
{
  TubeOptions options;
  options.radius = radius;
  options.widest = widestFor(name);
  options.usual = usualFor(name);
  if (isHounsfieldCt)
    options.lumen = lumenFor(name);
  return options;
}

std::size_t insertionIndex(const Tube& tube, const Vector3d& point)
{
  constexpr double kHardlyLonger = 0.3; // of the distance from the nearer end: turns up to 45 deg
  constexpr double kClose = 0.5;        // likewise
  constexpr double kNearer = 2.0 / 3.0;
  const std::vector<Vector3d>& points = tube.points;
  if (points.size() < 2)
    return points.size();
  const double fromFirst = (point - points.front()).norm();
  const double fromLast = (point - points.back()).norm();
  const double fromEnd = std::min(fromFirst, fromLast);
  if (tube.line.size() >= 2)
  {
    const Foot foot = nearestOn(tube.line, point);
    const bool isBefore = foot.segment == 0 && foot.fraction <= 0.0;
    const bool isAfter = foot.segment == tube.line.size() - 2 && foot.fraction >= 1.0;
    if (!isBefore && !isAfter && foot.distance <= std::min(TubeOptions{}.reach, kClose * fromEnd))
    {
      std::size_t index = 1;
      while (index + 1 < points.size() && tube.pointVertices[index] <= foot.segment)
        ++index;
      return index;
    }
  }
  std::size_t best = 0;
  double least = kHardlyLonger * fromEnd;
  for (std::size_t n = 1; n < points.size(); ++n)
  {
    const double longer = (point - points[n - 1]).norm() + (points[n] - point).norm() -
                          (points[n] - points[n - 1]).norm();
    if (longer < least)
    {
      least = longer;
      best = n;
    }
  }
  if (best > 0)
    return best;
  return fromFirst < kNearer * fromLast ? 0 : points.size();
}

} // namespace petrous::segmentation
