#include "TouchSurfaces.h"

#include <cmath>
#include <functional>
#include <limits>

#include "SteppedSphere.h"
#include "SurfaceErrors.h"
#include "petrous/Core/NumberText.h"
#include "petrous/Core/TickTimes.h"
#include "petrous/Haptics/ConstrainedProxy.h"

namespace petrous::haptics
{

namespace
{

using testing::AnalyticSurface;
using testing::Scene;
using testing::SurfaceErrors;

constexpr double kRadius = 2.0; // mm, of the ball
constexpr double kHalf = 7.5;   // mm, of the scanned cube
constexpr char kPeer[] = "stepped sphere, no sweep";

std::string shown(double value)
{
  return core::generalText(value, 4);
}

Scene sceneOf(const AnalyticSurface& surface, double h)
{
  return testing::sceneOf(testing::scanOf(surface.distance, h, kHalf));
}

core::BenchmarkPoint measure(const AnalyticSurface& surface, double h, Proxy& proxy, int ticks,
                             double pace)
{
  core::TickTimes times;
  bool placed = false;
  const SurfaceErrors errors = testing::followSurface(
      surface, kRadius, ticks, pace,
      [&](const Pose& goal) -> const ProxyTick&
      {
        if (!placed)
          proxy.place(goal);
        placed = true;
        return times.take([&]() -> const ProxyTick& { return proxy.step(goal); });
      });
  core::BenchmarkPoint point;
  point.setting["voxel_mm"] = shown(h);
  times.enter(point);
  point.error = errors.distance;
  point.errorUnit = "mm from the true place, rms";
  point.extra["bias_voxels"] = errors.bias / h;
  point.extra["ripple_voxels"] = errors.ripple / h;
  point.extra["angle_mean_degrees"] = errors.meanAngle;
  point.extra["angle_max_degrees"] = errors.maxAngle;
  point.extra["ticks_in_contact"] = errors.ticks;
  return point;
}

// Slope of log error over log h by least squares.
double orderOf(const std::vector<double>& voxels, const std::vector<double>& errors)
{
  const auto n = static_cast<double>(voxels.size());
  double x = 0.0;
  double y = 0.0;
  double xx = 0.0;
  double xy = 0.0;
  for (std::size_t i = 0; i < voxels.size(); ++i)
  {
    const double logH = std::log(voxels[i]);
    const double logE = std::log(std::max(errors[i], 1e-12));
    x += logH;
    y += logE;
    xx += logH * logH;
    xy += logH * logE;
  }
  return (n * xy - x * y) / (n * xx - x * x);
}

struct Setting
{
  const char* name;
  std::vector<double> values;
  double standard;
  std::function<void(ProxyParameters&, std::size_t& points, double value)> set;
};

std::vector<Setting> settings(bool quick)
{
  const ProxyParameters standard;
  std::vector<Setting> all{
      {"shell_points",
       {200, 400, 800, 1200, 2000, 4000},
       2000,
       [](ProxyParameters&, std::size_t& points, double value)
       { points = static_cast<std::size_t>(value); }},
      {"sweep_step_voxels",
       {0.125, 0.25, 0.5, 1.0},
       standard.sweepStep,
       [](ProxyParameters& p, std::size_t&, double value) { p.sweepStep = value; }},
      {"bisections",
       {2, 4, 6, 8, 10, 13, 16},
       static_cast<double>(standard.bisections),
       [](ProxyParameters& p, std::size_t&, double value)
       { p.bisections = static_cast<int>(value); }},
      {"rounds",
       {1, 2, 3, 5, 7, 10},
       static_cast<double>(standard.rounds),
       [](ProxyParameters& p, std::size_t&, double value) { p.rounds = static_cast<int>(value); }},
      {"samples",
       {200, 600, 1200, 2400, 5000, 20000},
       static_cast<double>(standard.samples),
       [](ProxyParameters& p, std::size_t&, double value) { p.samples = static_cast<int>(value); }},
      {"near_gap_voxels",
       {0.1, 0.25, 0.5, 1.0},
       standard.nearGap,
       [](ProxyParameters& p, std::size_t&, double value) { p.nearGap = value; }}};
  if (quick)
    for (Setting& setting : all)
      setting.values = {setting.values.front(), setting.standard};
  return all;
}

} // namespace

std::vector<core::BenchmarkPoint> touchSurfaces(bool quick, const core::Progress& progress)
{
  const std::vector<double> voxels =
      quick ? std::vector<double>{0.2, 0.4} : std::vector<double>{0.1, 0.15, 0.2, 0.3, 0.4};
  const int ticks = quick ? 1000 : 6000;
  std::vector<core::BenchmarkPoint> points;
  for (const bool tilted : {false, true})
    for (const AnalyticSurface& surface : testing::analyticSurfaces(tilted))
    {
      progress.report(static_cast<double>(points.size()) /
                          (16.0 * static_cast<double>(voxels.size())),
                      "touching a " + surface.name);
      for (const bool ours : {true, false})
      {
        const std::size_t first = points.size();
        std::vector<double> heights;
        for (const double h : voxels)
        {
          const Scene scene = sceneOf(surface, h);
          std::unique_ptr<Proxy> proxy;
          const PointShell shell = testing::ballShell(kRadius, 800);
          if (ours)
            proxy = std::make_unique<ConstrainedProxy>(scene.field, shell);
          else
            proxy = std::make_unique<SteppedSphere>(scene.field, shell);
          points.push_back(measure(surface, h, *proxy, ticks, 6.0 / ticks));
          core::BenchmarkPoint& point = points.back();
          point.scene = tilted ? "known surfaces, tilted" : "known surfaces, axis-aligned";
          point.series = surface.name + ", voxel in mm";
          point.setting[point.series] = shown(h);
          point.peer = ours ? "" : kPeer;
          point.isDefault = ours && h == 0.3;
          heights.push_back(h *
                            std::hypot(point.extra["bias_voxels"], point.extra["ripple_voxels"]));
        }
        const double order = orderOf(voxels, heights);
        for (std::size_t n = first; n < points.size(); ++n)
          points[n].extra["order_of_height_in_h"] = order;
      }
    }
  return points;
}

std::vector<core::BenchmarkPoint> touchParameters(bool quick, const core::Progress& progress)
{
  const double h = 0.3;
  const int ticks = quick ? 500 : 4000;
  // About 0.1 m/s: the rows of a tick do not depend on where it ends.
  const double pace = 0.05;
  const std::vector<AnalyticSurface> surfaces = testing::analyticSurfaces(true);
  std::vector<core::BenchmarkPoint> points;
  for (const std::size_t which : {2, 3}) // ring and valley
  {
    const Scene scene = sceneOf(surfaces[which], h);
    for (const Setting& setting : settings(quick))
      for (const double value : setting.values)
      {
        progress.report(static_cast<double>(points.size()) / (quick ? 24.0 : 66.0), setting.name);
        ProxyParameters parameters;
        std::size_t count = 2000;
        setting.set(parameters, count, value);
        ConstrainedProxy proxy(scene.field, testing::ballShell(kRadius, count), parameters);
        points.push_back(measure(surfaces[which], h, proxy, ticks, pace));
        points.back().scene = surfaces[which].name + ", tilted, fast hand";
        points.back().series = setting.name;
        points.back().setting[setting.name] = shown(value);
        points.back().isDefault = value == setting.standard;
      }
  }
  return points;
}

} // namespace petrous::haptics
