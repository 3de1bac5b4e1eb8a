#include "DistanceBenchmark.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <random>
#include <vector>

#include <tbb/parallel_for.h>

#include "petrous/Volume/NearestSurface.h"
#include "petrous/Volume/SurfaceDistance.h"

namespace petrous::volume
{

namespace
{

constexpr int kStructures = 12;
constexpr double kSide = 102.0; // mm, of the CT
constexpr double kFar = 1000.0;

using Clock = std::chrono::steady_clock;

double seconds(Clock::time_point since)
{
  return std::chrono::duration<double>(Clock::now() - since).count();
}

// A ring if `tube` is smaller than `radius`; a ball of radius `tube` if `radius` is 0.
struct Shape
{
  Eigen::Vector3d center;
  double radius; // mm
  double tube;

  double distance(const Eigen::Vector3d& p) const
  {
    const Eigen::Vector3d d = p - center;
    return std::hypot(std::hypot(d.x(), d.y()) - radius, d.z()) - tube;
  }
};

std::vector<Shape> shapes()
{
  std::vector<Shape> all;
  for (int n = 0; n < kStructures; ++n)
  {
    const Eigen::Vector3d center(20.0 + 20.0 * (n % 4), 25.0 + 25.0 * (n / 4 % 3),
                                 30.0 + 13.0 * (n % 3));
    all.push_back(n % 2 == 0 ? Shape{center, 4.0 + n, 0.8 + 0.1 * n}
                             : Shape{center, 0.0, 1.0 + 0.8 * n});
  }
  return all;
}

// An occupancy that is linear across the surface, on the required voxels of the CT's grid.
std::shared_ptr<const Volume<float>> occupancyOf(const Shape& shape, double h)
{
  const double reach = shape.radius + shape.tube + 4.0 * h;
  const Eigen::Vector3d half(reach, reach, shape.tube + 4.0 * h);
  core::Index3 dims;
  Eigen::Vector3d origin;
  for (std::size_t a = 0; a < 3; ++a)
  {
    const auto axis = static_cast<Eigen::Index>(a);
    origin[axis] = h * std::floor((shape.center[axis] - half[axis]) / h);
    dims[a] = static_cast<int>(std::ceil(2.0 * half[axis] / h)) + 2;
  }
  auto occupancy = std::make_shared<Volume<float>>(
      core::GridGeometry(dims, Eigen::Vector3d::Constant(h), origin));
  tbb::parallel_for(0, dims[2],
                    [&](int k)
                    {
                      for (int j = 0; j < dims[1]; ++j)
                        for (int i = 0; i < dims[0]; ++i)
                        {
                          const double d = shape.distance(
                              occupancy->geometry().patientFromVoxel({1.0 * i, 1.0 * j, 1.0 * k}));
                          occupancy->at(i, j, k) =
                              static_cast<float>(std::clamp(0.5 - d / (6.0 * h), 0.0, 1.0));
                        }
                    });
  return occupancy;
}

struct Asked
{
  std::vector<double> times; // s, per point
  double worst = 0.0;        // mm
};

template <class Distance>
Asked ask(const std::vector<Shape>& all, int places, const Distance& distance)
{
  Asked asked;
  std::mt19937 random(1);
  std::uniform_real_distribution<double> uniform(0.0, kSide);
  std::vector<double> found(all.size());
  for (int n = 0; n < places; ++n)
  {
    const double x = uniform(random);
    const double y = uniform(random);
    const Eigen::Vector3d p(x, y, uniform(random));
    const auto start = Clock::now();
    for (std::size_t s = 0; s < all.size(); ++s)
      found[s] = distance(s, p);
    asked.times.push_back(seconds(start));
    for (std::size_t s = 0; s < all.size(); ++s)
      asked.worst = std::max(asked.worst, std::abs(found[s] - all[s].distance(p)));
  }
  std::sort(asked.times.begin(), asked.times.end());
  return asked;
}

core::BenchmarkPoint pointOf(const Asked& asked, int edge, const std::string& peer)
{
  core::BenchmarkPoint point;
  point.setting["edge_voxels"] = std::to_string(edge);
  point.scene = "12 structures in a CT of " + std::to_string(edge) + "^3";
  point.isDefault = edge == 512 && peer.empty();
  point.seconds = asked.times[asked.times.size() / 2];
  point.error = asked.worst;
  point.errorUnit = "mm, the worst of all places and structures";
  point.peer = peer;
  point.extra["p99_seconds"] = asked.times[asked.times.size() * 99 / 100];
  point.extra["max_seconds"] = asked.times.back();
  return point;
}

// A field with the structure and nothing else.
TissueField alone(const std::shared_ptr<const Volume<float>>& occupancy)
{
  auto air = std::make_shared<Volume<std::int16_t>>(occupancy->geometry(), std::int16_t{-1000});
  return {std::make_shared<IntensityVolume>(std::shared_ptr<const Volume<std::int16_t>>(air)),
          {occupancy},
          nullptr,
          {}};
}

} // namespace

core::BenchmarkReport runDistanceBenchmark(bool quick, const core::Progress& progress)
{
  core::BenchmarkReport report{"distance", "Distance from one place to twelve structures", {}};
  const std::vector<Shape> all = shapes();
  for (const int edge : quick ? std::vector<int>{256} : std::vector<int>{256, 512})
  {
    progress.check("measuring distances");
    std::vector<std::shared_ptr<const Volume<float>>> occupancies;
    for (const Shape& shape : all)
      occupancies.push_back(occupancyOf(shape, kSide / edge));
    const auto start = Clock::now();
    std::vector<SurfaceDistance> surfaces;
    for (const auto& occupancy : occupancies)
      surfaces.emplace_back(occupancy);
    const double made = seconds(start);
    const Asked ours =
        ask(all, quick ? 200 : 5000,
            [&](std::size_t s, const Eigen::Vector3d& p) { return surfaces[s].at(p, kFar); });
    report.points.push_back(pointOf(ours, edge, ""));
    double bytes = 0.0;
    for (const SurfaceDistance& surface : surfaces)
      bytes += static_cast<double>(surface.bytes());
    report.points.back().extra["made_in_seconds"] = made;
    report.points.back().extra["megabytes"] = bytes / 1e6;

    std::vector<TissueField> fields;
    for (const auto& occupancy : occupancies)
      fields.push_back(alone(occupancy));
    std::vector<NearestSurfaceSearch> searches;
    for (const TissueField& field : fields)
      searches.emplace_back(field, kFar);
    report.points.push_back(pointOf(ask(all, quick ? 10 : 100,
                                        [&](std::size_t s, const Eigen::Vector3d& p)
                                        { return searches[s].find(p)->distance; }),
                                    edge, "search on the field"));
  }
  return report;
}

} // namespace petrous::volume
