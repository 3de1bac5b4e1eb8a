#include "NerveBenchmark.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <map>
#include <memory>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include <tbb/parallel_for.h>

#include "petrous/Core/NumberText.h"
#include "petrous/Core/SplitMix64.h"
#include "petrous/Phantom/Phantom.h"
#include "petrous/Segmentation/TubeTrace.h"
#include "petrous/Volume/IntensityVolume.h"

namespace petrous::cli
{

namespace
{

using Axis = std::vector<phantom::AxisPoint>;
using Clock = std::chrono::steady_clock;
using Eigen::Vector3d;
using Image = std::shared_ptr<const volume::Volume<std::int16_t>>;

constexpr double kPi = 3.14159265358979323846;

double lengthOf(const Axis& axis)
{
  double length = 0.0;
  for (std::size_t i = 1; i < axis.size(); ++i)
    length += (axis[i].position - axis[i - 1].position).norm();
  return length;
}

Vector3d positionAt(const Axis& axis, double along)
{
  for (std::size_t i = 1; i < axis.size(); ++i)
  {
    const double step = (axis[i].position - axis[i - 1].position).norm();
    if (along <= step)
      return axis[i - 1].position + along / step * (axis[i].position - axis[i - 1].position);
    along -= step;
  }
  return axis.back().position;
}

/// Distance from a polyline, and the nearest of its segments.
std::pair<double, std::size_t> distanceFrom(const std::vector<Vector3d>& line, const Vector3d& p)
{
  std::pair<double, std::size_t> best{std::numeric_limits<double>::max(), 0};
  for (std::size_t i = 0; i + 1 < line.size(); ++i)
  {
    const Vector3d run = line[i + 1] - line[i];
    const double t = std::clamp((p - line[i]).dot(run) / run.squaredNorm(), 0.0, 1.0);
    const double distance = (p - line[i] - t * run).norm();
    if (distance < best.first)
      best = {distance, i};
  }
  return best;
}

struct Errors
{
  double mean = 0.0;
  double largest = 0.0;
};

/// Both ways: of the line from the axis, and of the axis between the line's ends from the line.
Errors errorsOf(const std::vector<Vector3d>& line, const Axis& axis)
{
  std::vector<Vector3d> truth;
  constexpr double kStep = 0.05;
  const double length = lengthOf(axis);
  for (double s = 0.0; s < length; s += kStep)
    truth.push_back(positionAt(axis, s));
  Errors errors;
  for (const Vector3d& p : line)
  {
    const double distance = distanceFrom(truth, p).first;
    errors.mean += distance / static_cast<double>(line.size());
    errors.largest = std::max(errors.largest, distance);
  }
  const std::size_t first = distanceFrom(truth, line.front()).second;
  const std::size_t last = distanceFrom(truth, line.back()).second;
  double back = 0.0;
  for (std::size_t i = first + 1; i <= last; ++i)
  {
    const double distance = distanceFrom(line, truth[i]).first;
    back += distance / static_cast<double>(std::max<std::size_t>(last - first, 1));
    errors.largest = std::max(errors.largest, distance);
  }
  errors.mean = std::max(errors.mean, back);
  return errors;
}

/// What somebody sets along a structure: points about evenly spaced, each within `off` mm.
std::vector<Vector3d> pointsAlong(const Axis& axis, int count, double margin, double off,
                                  std::uint32_t seed)
{
  std::mt19937 random(seed);
  const auto uniform = [&] { return 2.0 * static_cast<double>(random()) / 4294967296.0 - 1.0; };
  const double length = lengthOf(axis) - 2.0 * margin;
  std::vector<Vector3d> points;
  for (int n = 0; n < count; ++n)
  {
    double along = margin + length * n / (count - 1);
    if (n > 0 && n + 1 < count)
      along += 0.2 * length / count * uniform();
    Vector3d d(2.0, 0.0, 0.0);
    while (d.norm() > 1.0)
      for (int a = 0; a < 3; ++a)
        d[a] = uniform();
    points.push_back(positionAt(axis, along) + off * d);
  }
  return points;
}

/// Catmull-Rom curve through the points.
std::vector<Vector3d> curveThrough(const std::vector<Vector3d>& points)
{
  const auto last = static_cast<int>(points.size()) - 1;
  const auto at = [&](int i) { return points[static_cast<std::size_t>(std::clamp(i, 0, last))]; };
  std::vector<Vector3d> curve;
  constexpr int kPieces = 100;
  for (int i = 0; i < last; ++i)
    for (int p = 0; p < kPieces; ++p)
    {
      const double t = static_cast<double>(p) / kPieces;
      const Vector3d w = at(i - 1), x = at(i), y = at(i + 1), z = at(i + 2);
      curve.emplace_back(0.5 * (2.0 * x + t * (y - w) + t * t * (2.0 * w - 5.0 * x + 4.0 * y - z) +
                                t * t * t * (3.0 * x - w - 3.0 * y + z)));
    }
  curve.push_back(points.back());
  return curve;
}

core::GridGeometry gridAround(const Axis& axis, double h, std::uint64_t seed)
{
  Vector3d lower = axis.front().position;
  Vector3d upper = lower;
  for (const auto& p : axis)
  {
    lower = lower.cwiseMin(p.position);
    upper = upper.cwiseMax(p.position);
  }
  constexpr double kMargin = 8.0;
  core::Index3 dims;
  for (std::size_t a = 0; a < 3; ++a)
  {
    const auto i = static_cast<Eigen::Index>(a);
    dims[a] = static_cast<int>(std::ceil((upper[i] - lower[i] + 2.0 * kMargin) / h)) + 1;
  }
  const Vector3d shift = h * Vector3d(0.31, 0.57, 0.83) * static_cast<double>(seed);
  return {dims, Vector3d::Constant(h), (lower.array() - kMargin).matrix() + shift};
}

/// A canal of 0.5 mm in bone, as the chorda's between facial nerve and tympanic cavity: an arc of
/// 12 mm that winds by 1 mm.
Axis chordaAxis()
{
  Axis axis;
  for (int i = 0; i <= 300; ++i)
  {
    const double t = i / 300.0;
    axis.push_back(
        {{8.0 * std::sin(1.2 * t), 8.0 * std::cos(1.2 * t), 9.0 * t + std::sin(4.0 * t)}, 0.25});
  }
  return axis;
}

/// Bone with marrow spaces, blurred like a scan of the phantom.
Image canalImage(const Axis& axis, double h, double noise, std::uint64_t seed)
{
  const core::GridGeometry grid = gridAround(axis, h, seed);
  std::vector<Vector3d> line;
  for (const auto& p : axis)
    line.push_back(p.position);
  auto image = std::make_shared<volume::Volume<std::int16_t>>(grid);
  const double point = std::min(0.75 * h, 0.25);
  const double sigma = std::sqrt(point * point + h * h / 6.0);
  // A thin cylinder under a Gaussian: on a polar grid of its cross-section.
  constexpr int kEntries = 200;
  const double reach = axis.front().radius + 5.0 * sigma;
  std::vector<double> profile(kEntries + 1, 0.0);
  for (int e = 0; e <= kEntries; ++e)
  {
    const double rho = reach * e / kEntries;
    constexpr int kRings = 40;
    constexpr int kTurns = 64;
    for (int r = 0; r < kRings; ++r)
      for (int a = 0; a < kTurns; ++a)
      {
        const double ring = axis.front().radius * (r + 0.5) / kRings;
        const double angle = 2.0 * kPi * a / kTurns;
        const double d2 = rho * rho + ring * ring - 2.0 * rho * ring * std::cos(angle);
        profile[static_cast<std::size_t>(e)] += std::exp(-0.5 * d2 / (sigma * sigma)) * ring *
                                                (axis.front().radius / kRings) *
                                                (2.0 * kPi / kTurns) / (2.0 * kPi * sigma * sigma);
      }
  }
  tbb::parallel_for(
      0, grid.dims()[2],
      [&](int k)
      {
        for (int j = 0; j < grid.dims()[1]; ++j)
          for (int i = 0; i < grid.dims()[0]; ++i)
          {
            const Vector3d p = grid.patientFromVoxel(Vector3d(i, j, k));
            const double rho = distanceFrom(line, p).first / reach * kEntries;
            double share = 0.0;
            if (rho < kEntries)
            {
              const auto e = static_cast<std::size_t>(rho);
              share = profile[e] + (rho - static_cast<double>(e)) * (profile[e + 1] - profile[e]);
            }
            const double marrow =
                150.0 * (std::sin(2.1 * p.x() + 0.7 * p.y()) +
                         std::sin(1.9 * p.y() + 1.3 * p.z()) * std::sin(2.3 * p.z() - 0.9 * p.x()));
            // Box and Muller, from the voxel's number
            const auto n = static_cast<std::uint64_t>(grid.linearIndex(i, j, k));
            const auto fraction = [&](std::uint64_t part)
            {
              const std::uint64_t bits =
                  core::splitMix64(seed * 0x9E3779B97F4A7C15ULL + 2 * n + part);
              return (static_cast<double>(bits >> 11) + 0.5) / 9007199254740992.0;
            };
            const double gauss =
                std::sqrt(-2.0 * std::log(fraction(0))) * std::cos(2.0 * kPi * fraction(1));
            image->at(i, j, k) = static_cast<std::int16_t>(
                std::lround((1300.0 + marrow) * (1.0 - share) + 40.0 * share + noise * gauss));
          }
      });
  return image;
}

struct Scene
{
  std::string name;
  std::string structure; ///< as `petrous segment --name`: it limits the radii
  Axis axis;
  int points;
  double margin; ///< mm, of the axis' ends that are left out
  double off;    ///< mm, of the points from the axis
  std::vector<double> noises;
  std::function<Image(double h, double noise, std::uint64_t seed)> image;
};

struct Sum
{
  int runs = 0;
  Errors errors;
  double radius = 0.0;
  double resolved = 0.0;
  std::vector<double> times;

  void add(const Errors& other, double time)
  {
    ++runs;
    errors.mean += other.mean;
    errors.largest = std::max(errors.largest, other.largest);
    times.push_back(time);
  }

  core::BenchmarkPoint point(const Scene& scene, double h, double noise, const std::string& peer)
  {
    std::nth_element(times.begin(), times.begin() + static_cast<std::ptrdiff_t>(times.size() / 2),
                     times.end());
    core::BenchmarkPoint result;
    result.scene = scene.name + ", noise " + core::generalText(noise) + " HU";
    result.setting = {{"spacing_mm", core::generalText(h)}, {"noise_hu", core::generalText(noise)}};
    result.seconds = times[times.size() / 2];
    result.error = errors.mean / runs;
    result.errorUnit = "mm, mean distance from the axis";
    result.peer = peer;
    result.extra["max_mm"] = errors.largest;
    result.extra["runs"] = runs;
    if (peer.empty())
    {
      result.extra["radius_error_mm"] = radius / runs;
      result.extra["resolved"] = resolved / runs;
    }
    return result;
  }
};

} // namespace

core::BenchmarkReport runNerveBenchmark(bool quick, const core::Progress& progress)
{
  core::BenchmarkReport report;
  report.name = "nerve";
  report.title = "A nerve traced through points set by hand: voxels of 0.15 to 0.6 mm";
  std::map<std::uint64_t, std::unique_ptr<phantom::Phantom>> phantoms;
  std::vector<Scene> scenes;
  scenes.push_back({"facial nerve of the phantom", "facial_nerve",
                    phantom::Phantom::facialCanalAxis(), 6, 0.8, 1.0,
                    quick ? std::vector<double>{50.0} : std::vector<double>{0.0, 25.0, 50.0, 100.0},
                    nullptr});
  scenes.back().image = [&](double h, double noise, std::uint64_t seed)
  {
    auto& phantom = phantoms[seed];
    if (!phantom)
      phantom = std::make_unique<phantom::Phantom>(phantom::PhantomRecipe{seed, true});
    phantom::ScanSettings settings;
    settings.noise = noise;
    settings.seed = seed;
    return std::make_shared<const volume::Volume<std::int16_t>>(
        phantom::samplePhantom(*phantom, gridAround(scenes.front().axis, h, seed), settings));
  };
  scenes.push_back({"canal of 0.5 mm", "chorda_tympani", chordaAxis(), 5, 0.5, 0.3,
                    quick ? std::vector<double>{50.0} : std::vector<double>{0.0, 50.0, 100.0},
                    [&](double h, double noise, std::uint64_t seed)
                    { return canalImage(scenes.back().axis, h, noise, seed); }});
  const std::vector<double> spacings =
      quick ? std::vector<double>{0.4, 0.6} : std::vector<double>{0.15, 0.2, 0.3, 0.4, 0.6};
  const std::uint64_t patients = quick ? 1 : 3;
  const std::uint32_t clicks = quick ? 3 : 6;
  double done = 0.0;
  for (const Scene& scene : scenes)
  {
    segmentation::TubeOptions options;
    options.widest = segmentation::widestFor(scene.structure);
    for (const double noise : scene.noises)
      for (const double h : spacings)
      {
        Sum ours;
        Sum curve;
        for (std::uint64_t seed = 1; seed <= patients; ++seed)
        {
          const volume::IntensityVolume image(scene.image(h, noise, seed));
          for (std::uint32_t n = 0; n < clicks; ++n)
          {
            progress.report(done, "trace nerves");
            const auto points = pointsAlong(scene.axis, scene.points, scene.margin, scene.off,
                                            static_cast<std::uint32_t>(1000 * seed + n));
            auto start = Clock::now();
            const auto tube = segmentation::traceTube(image, points, options);
            ours.add(errorsOf(tube.line, scene.axis),
                     std::chrono::duration<double>(Clock::now() - start).count());
            std::vector<Vector3d> truth;
            for (const auto& p : scene.axis)
              truth.push_back(p.position);
            double radius = 0.0;
            for (std::size_t i = 0; i < tube.line.size(); ++i)
              radius += std::abs(tube.radii[i] -
                                 scene.axis[distanceFrom(truth, tube.line[i]).second].radius);
            ours.radius += radius / static_cast<double>(tube.line.size());
            ours.resolved += tube.resolvedLength / tube.length;
            start = Clock::now();
            const auto through = curveThrough(points);
            curve.add(errorsOf(through, scene.axis),
                      std::chrono::duration<double>(Clock::now() - start).count());
          }
        }
        report.points.push_back(ours.point(scene, h, noise, ""));
        if (noise == 50.0)
          report.points.push_back(
              curve.point(scene, h, noise, "curve through the points, " + scene.name));
        done += 1.0 / static_cast<double>(7 * spacings.size());
      }
  }
  return report;
}

} // namespace petrous::cli
