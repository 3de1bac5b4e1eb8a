#include "PhantomCells.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <utility>
#include <vector>

#include "petrous/Core/SplitMix64.h"

namespace petrous::phantom::shapes
{
namespace
{

constexpr double kBin = 1.5;      // mm, edge of a lookup bin
constexpr std::size_t kNear = 24; // seeds relevant in a bin
constexpr double kRounding = 0.7; // mm, of the cells' edges
constexpr double kPore = 0.4;     // mm, radius
constexpr int kDarts = 60000;

struct Cells
{
  std::vector<Point> seeds;
  std::uint64_t seed = 0;
  Box box;
  std::array<int, 3> bins{};
  std::vector<std::vector<std::uint32_t>> near;

  std::size_t bin(const Point& p) const
  {
    std::size_t index = 0;
    for (int axis = 2; axis >= 0; --axis)
    {
      const auto a = static_cast<std::size_t>(axis);
      const int b =
          std::clamp(static_cast<int>((p[axis] - box.min()[axis]) / kBin), 0, bins[a] - 1);
      index = index * static_cast<std::size_t>(bins[a]) + static_cast<std::size_t>(b);
    }
    return index;
  }

  std::uint64_t pair(std::uint32_t a, std::uint32_t b) const
  {
    return core::splitMix64(seed ^ (static_cast<std::uint64_t>(std::min(a, b)) << 32) ^
                            std::max(a, b));
  }

  double distance(const Point& p) const
  {
    const std::vector<std::uint32_t>& candidates = near[bin(p)];
    std::uint32_t own = candidates.front();
    double nearest = std::numeric_limits<double>::max();
    for (const std::uint32_t c : candidates)
    {
      const double d = (seeds[c] - p).squaredNorm();
      if (d < nearest)
      {
        nearest = d;
        own = c;
      }
    }
    double room = 4.0; // to the nearest septum, rounded where septa meet
    double pore = 4.0;
    for (const std::uint32_t c : candidates)
    {
      if (c == own)
        continue;
      const Eigen::Vector3d across = seeds[c] - seeds[own];
      const double length = across.norm();
      const double along = (p - seeds[own]).dot(across) / length;
      const double wall = 0.5 * length - along;
      if (wall > room + kRounding + 0.4)
        continue;
      const std::uint64_t bits = pair(own, c);
      const double half = 0.15 + 0.2 * static_cast<double>(bits & 0xFFFF) / 65536.0;
      room = smoothMin(room, wall - half, kRounding);
      if ((bits >> 20) % 3 == 0 && along > 0.0)
        pore = std::min(
            pore, std::sqrt(std::max((p - seeds[own]).squaredNorm() - along * along, 0.0)) - kPore);
    }
    return std::min(-room, pore);
  }
};

} // namespace

Shape honeycomb(const Shape& region, const std::function<double(const Point&)>& sizeAt,
                std::uint64_t seed)
{
  auto cells = std::make_shared<Cells>();
  cells->seed = core::splitMix64(seed ^ 0xCE115ULL);
  cells->box = region.box;
  const Eigen::Vector3d extent = region.box.sizes();

  // Poisson-disk sampling by dart throwing: a seed is kept if far enough from all before it
  std::vector<double> sizes;
  for (std::uint64_t dart = 0; dart < kDarts; ++dart)
  {
    const Eigen::Vector3d u(uniform(cells->seed, 3 * dart), uniform(cells->seed, 3 * dart + 1),
                            uniform(cells->seed, 3 * dart + 2));
    const Point p = region.box.min() + u.cwiseProduct(extent);
    const double size = sizeAt(p);
    bool free = true;
    for (std::size_t i = 0; i < sizes.size() && free; ++i)
      free = (cells->seeds[i] - p).squaredNorm() > 0.25 * (size + sizes[i]) * (size + sizes[i]);
    if (!free || region(p) > 0.3)
      continue;
    cells->seeds.push_back(p);
    sizes.push_back(size);
  }

  for (std::size_t a = 0; a < 3; ++a)
    cells->bins[a] =
        std::max(1, static_cast<int>(std::ceil(extent[static_cast<Eigen::Index>(a)] / kBin)));
  for (int k = 0; k < cells->bins[2]; ++k)
    for (int j = 0; j < cells->bins[1]; ++j)
      for (int i = 0; i < cells->bins[0]; ++i)
      {
        const Point middle = cells->box.min() + kBin * Eigen::Vector3d(i + 0.5, j + 0.5, k + 0.5);
        std::vector<std::pair<double, std::uint32_t>> order;
        for (std::size_t s = 0; s < cells->seeds.size(); ++s)
          order.emplace_back((cells->seeds[s] - middle).squaredNorm(),
                             static_cast<std::uint32_t>(s));
        const std::size_t count = std::min(kNear, order.size());
        std::partial_sort(order.begin(), order.begin() + static_cast<std::ptrdiff_t>(count),
                          order.end());
        std::vector<std::uint32_t> list;
        for (std::size_t s = 0; s < count; ++s)
          list.push_back(order[s].second);
        cells->near.push_back(std::move(list));
      }

  return {[cells](const Point& p) { return cells->distance(p); }, region.box};
}

} // namespace petrous::phantom::shapes
