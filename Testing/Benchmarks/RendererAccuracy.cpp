#include "RendererAccuracy.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <memory>

#include "OwnPicture.h"
#include "petrous/Core/NumberText.h"
#include "petrous/Rendering/ReferenceRayCaster.h"

namespace petrous::cli
{

namespace
{

using rendering::RenderQuality;

struct Setting
{
  const char* name;
  std::vector<double> values;
  std::function<double&(RenderQuality&)> real;
  std::function<int&(RenderQuality&)> whole;

  void set(RenderQuality& quality, double value) const
  {
    if (real)
      real(quality) = value;
    else
      whole(quality) = static_cast<int>(value);
  }
  double get(RenderQuality quality) const { return real ? real(quality) : whole(quality); }
};

std::vector<Setting> settings()
{
  return {
      {"step_voxels",
       {2.0, 1.0, 0.7, 0.5, 0.4, 0.33, 0.25, 0.125},
       [](RenderQuality& q) -> double& { return q.step; },
       {}},
      {"bisections",
       {0, 2, 4, 6, 8, 12},
       {},
       [](RenderQuality& q) -> int& { return q.bisections; }},
      {"brick_voxels", {4, 8, 16}, {}, [](RenderQuality& q) -> int& { return q.brick; }},
      {"termination",
       {0.1, 0.05, 0.02, 0.01, 0.005, 0.002},
       [](RenderQuality& q) -> double& { return q.termination; },
       {}},
      {"table_entries",
       {64, 256, 512, 1024, 4096},
       {},
       [](RenderQuality& q) -> int& { return q.tableSize; }},
      {"mask_bits", {8, 16}, {}, [](RenderQuality& q) -> int& { return q.maskBits; }},
  };
}

std::string shown(double value)
{
  return core::generalText(value);
}

// A CT of 128^3 at 0.5 mm whose value is linear in the distance to a surface.
std::shared_ptr<const volume::IntensityVolume>
shapeCt(const std::function<double(const Eigen::Vector3d&)>& depthInside)
{
  constexpr int edge = 128;
  constexpr double spacing = 0.5;
  const core::GridGeometry grid({edge, edge, edge}, Eigen::Vector3d::Constant(spacing),
                                Eigen::Vector3d::Constant(-0.5 * spacing * (edge - 1)));
  auto voxels = std::make_shared<volume::Volume<std::int16_t>>(grid);
  for (int k = 0; k < edge; ++k)
    for (int j = 0; j < edge; ++j)
      for (int i = 0; i < edge; ++i)
      {
        const double depth = depthInside(grid.patientFromVoxel(Eigen::Vector3d(i, j, k)));
        const double value = std::clamp(300.0 + 500.0 * depth / spacing, -1000.0, 3000.0);
        voxels->at(i, j, k) = static_cast<std::int16_t>(std::lround(value));
      }
  return std::make_shared<volume::IntensityVolume>(
      std::shared_ptr<const volume::Volume<std::int16_t>>(voxels));
}

core::BenchmarkPoint shapePoint(const std::string& name,
                                const std::function<double(const Eigen::Vector3d&)>& depthInside,
                                const std::function<double(const rendering::PixelRay&)>& firstHit,
                                const core::CameraPose& camera, const PictureSize& size)
{
  rendering::SceneContents contents;
  contents.ct = shapeCt(depthInside);
  contents.materials.resize(1);
  rendering::OwnPicture own(contents, camera);
  rendering::TimedView view(size.width, size.height);
  view.show(own);
  core::BenchmarkPoint point;
  point.scene = name;
  point.isDefault = true;
  point.seconds = view.time(3).median;
  const rendering::DepthImage depth = own.depth();
  const rendering::PixelRays rays(camera, size.width, size.height);
  rendering::DepthImage truth = depth;
  for (int row = 0; row < size.height; ++row)
    for (int column = 0; column < size.width; ++column)
      truth.millimetres[static_cast<std::size_t>(row) * static_cast<std::size_t>(size.width) +
                        static_cast<std::size_t>(column)] =
          static_cast<float>(firstHit(rays.through(column, row)));
  const std::vector<float> noColor(3 * depth.millimetres.size());
  const auto error = rendering::comparePictures(view.picture(), depth, noColor, truth,
                                                contents.ct->geometry().minSpacing());
  point.error = error.depthMedian;
  point.errorUnit = "voxels, median of first hits";
  point.extra["depth_p95_voxels"] = error.depthP95;
  point.extra["mismatch_percent"] = error.mismatchPercent();
  point.setting["picture"] = shown(size);
  return point;
}

} // namespace

std::string shown(const PictureSize& size)
{
  return std::to_string(size.width) + "x" + std::to_string(size.height);
}

SceneTruth::SceneTruth(const rendering::SceneContents& contents, const core::CameraPose& camera,
                       const PictureSize& size, const core::Progress& progress)
  : m_contents(contents)
  , m_camera(camera)
  , m_size(size)
{
  auto truth =
      rendering::ReferenceRayCaster(contents).render(camera, size.width, size.height, progress);
  m_rgb = std::move(truth.rgb);
  m_depth = std::move(truth.depth);
}

rendering::PictureError SceneTruth::errorOf(const RenderQuality& quality) const
{
  rendering::OwnPicture own(m_contents, m_camera);
  own.setQuality(quality);
  rendering::TimedView view(m_size.width, m_size.height);
  view.show(own);
  view.frame();
  return rendering::comparePictures(view.picture(), own.depth(), m_rgb, m_depth,
                                    m_contents.ct->geometry().minSpacing());
}

void SceneTruth::enter(const RenderQuality& quality, core::BenchmarkPoint& point) const
{
  const auto error = errorOf(quality);
  point.error = error.rms;
  point.errorUnit = "1/255, RMS of colour";
  point.extra["mismatch_percent"] = error.mismatchPercent();
  point.extra["depth_median_voxels"] = error.depthMedian;
  point.extra["depth_p95_voxels"] = error.depthP95;
  point.extra["compared_pixels"] = static_cast<double>(error.agreeing);
}

std::vector<core::BenchmarkPoint> sweepQuality(const rendering::SceneContents& contents,
                                               const core::CameraPose& camera,
                                               const SceneTruth& truth, const std::string& scene,
                                               rendering::TimedView& view, int frames,
                                               const core::Progress& progress)
{
  rendering::OwnPicture own(contents, camera);
  view.show(own);
  std::vector<core::BenchmarkPoint> points;
  std::vector<RenderQuality> qualities;
  for (const Setting& setting : settings())
    for (const double value : setting.values)
    {
      qualities.emplace_back();
      setting.set(qualities.back(), value);
      core::BenchmarkPoint point;
      point.scene = scene;
      point.series = setting.name;
      point.setting[setting.name] = shown(value);
      point.isDefault = value == setting.get(RenderQuality{});
      truth.enter(qualities.back(), point);
      points.push_back(point);
    }
  // In rounds, so that background load affects all settings alike.
  constexpr int rounds = 3;
  std::vector<std::vector<double>> seconds(points.size());
  for (int round = 0; round < rounds; ++round)
    for (std::size_t n = 0; n < points.size(); ++n)
    {
      progress.report((round + static_cast<double>(n) / static_cast<double>(points.size())) /
                          rounds,
                      scene + ": " + points[n].series);
      own.setQuality(qualities[n]);
      view.frame(); // warm-up
      for (int frame = 0; frame < std::max(frames / rounds, 1); ++frame)
        seconds[n].push_back(view.frame());
    }
  for (std::size_t n = 0; n < points.size(); ++n)
  {
    std::sort(seconds[n].begin(), seconds[n].end());
    points[n].seconds = seconds[n][seconds[n].size() / 2];
  }
  return points;
}

std::vector<core::BenchmarkPoint> shapeDepths(const PictureSize& size)
{
  core::CameraPose camera;
  camera.position = {25.0, -90.0, 18.0};
  camera.focalPoint = {0.0, 0.0, 0.0};
  camera.viewAngle = 12.0; // the picture is within the faces of the cube
  const Eigen::Vector3d normal = Eigen::Vector3d(0.25, -1.0, 0.35).normalized();
  constexpr double radius = 12.0;
  const auto plane = [&](const rendering::PixelRay& ray)
  { return -normal.dot(ray.origin) / normal.dot(ray.direction); };
  const auto ball = [&](const rendering::PixelRay& ray)
  {
    const double along = -ray.origin.dot(ray.direction);
    const double inside = radius * radius - ray.origin.squaredNorm() + along * along;
    return inside < 0.0 ? std::numeric_limits<double>::quiet_NaN() : along - std::sqrt(inside);
  };
  return {shapePoint(
              "slanting plane", [&](const Eigen::Vector3d& p) { return -normal.dot(p); }, plane,
              camera, size),
          shapePoint(
              "ball of 24 mm", [&](const Eigen::Vector3d& p) { return radius - p.norm(); }, ball,
              camera, size)};
}

} // namespace petrous::cli
