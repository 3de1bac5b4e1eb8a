#include "PhantomAnatomy.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <utility>
#include <vector>

#include "PhantomShapes.h"
#include "petrous/Core/SplitMix64.h"

namespace petrous::phantom::shapes
{

/// A honeycomb of air cells with thin bony septa: the rounded cells of a Voronoi diagram.
///
/// region   where cells are allowed
/// sizeAt   distance between the seeds of neighbouring cells there, mm
/// seed     of the seed positions, of the septa's thickness (0.3 to 0.7 mm) and of the pores that
///          connect neighbours
///
/// Deterministic; the distance is to the cells' own walls only, not to the region's border.
Shape honeycomb(const Shape& region, const std::function<double(const Point&)>& sizeAt,
                std::uint64_t seed);

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

namespace petrous::phantom::anatomy
{
namespace
{

using namespace shapes;

// Intensities: CT in HU; MR as in a heavily T2-weighted sequence.
struct Tissue
{
  double ct;
  double mr;
};
constexpr Tissue kAir{-1000.0, 4.0};
constexpr Tissue kSkin{40.0, 160.0};
constexpr Tissue kFat{-80.0, 420.0};
constexpr Tissue kMuscle{55.0, 170.0};
constexpr Tissue kCortical{1750.0, 18.0};
constexpr Tissue kCancellous{1050.0, 120.0};
constexpr Tissue kCapsule{2120.0, 14.0};
constexpr Tissue kFluid{12.0, 1000.0};
constexpr Tissue kBrain{35.0, 430.0};
constexpr Tissue kNerve{50.0, 330.0};
constexpr Tissue kVein{45.0, 260.0};
constexpr Tissue kArtery{45.0, 25.0};
constexpr Tissue kOssicle{1500.0, 16.0};
constexpr Tissue kCholesteatoma{45.0, 760.0};

using Color = std::array<float, 3>;
constexpr Color kNerveColor{0.98F, 0.82F, 0.16F};
constexpr Color kVeinColor{0.22F, 0.36F, 0.78F};
constexpr Color kOssicleColor{0.96F, 0.93F, 0.84F};

} // namespace

std::vector<Layer> paint(std::uint64_t seed, bool cholesteatoma)
{
  const Skull skull = makeSkull();
  const Ear ear = makeEar(skull);
  std::vector<Layer> layers;
  const auto coat = [&](const Shape& shape, Tissue tissue) {
    layers.push_back({shape, tissue.ct, tissue.mr, {}, {}, true, 0.0, 0.0});
  };
  const auto spongy = [&](const Shape& shape)
  {
    coat(shape, kCancellous);
    layers.back().mottle = 0.16;
  };
  const auto structure = [&](const Shape& shape, Tissue tissue, const char* name, Color color,
                             double mesh, bool solid = true) {
    layers.push_back({shape, tissue.ct, tissue.mr, name, color, solid, mesh, 0.0});
  };

  coat(skull.skin, kSkin);
  coat(grown(skull.skin, -1.8), kFat);
  coat(grown(skull.skin, -3.6), kMuscle);
  coat(skull.bone, kCortical);
  // inner table, and cortex around everything adjacent to bone
  const Shape inner = without(grown(skull.bone, -1.9), grown(skull.cranial, 1.3));
  spongy(inner);
  coat(skull.condyle, kCortical);
  spongy(grown(skull.condyle, -1.2));
  coat(without(grown(ear.canal, 1.2), complement(skull.bone)), kCortical);
  coat(skull.cranial, kFluid);
  // gyri: the fluid around the brain is 0.6 to 2.8 mm deep
  coat({[cranial = skull.cranial](const Point& p)
        {
          const double gyrus = std::sin(0.62 * p.x() + 0.9 * std::sin(0.31 * p.y())) *
                                   std::sin(0.55 * p.y() + 0.8 * std::sin(0.36 * p.z())) +
                               0.5 * std::sin(0.5 * p.z() + 0.4 * p.x());
          return 0.75 * (cranial(p) + 1.7 + 0.75 * gyrus);
        },
        everywhere()},
       kBrain);

  const Shape plateau =
      disc({-48.0, 3.5, 11.5}, Eigen::Vector3d::UnitX(), Eigen::Vector3d::UnitY(), 6.5, 10.0, 3.0);
  const Shape plate{[cranial = skull.cranial](const Point& p)
                    {
                      const double d = cranial(p);
                      return std::max(d - kTegmenThickness, -d);
                    },
                    everywhere()};
  structure(common({plate, plateau}), kCortical, "tegmen", {0.80F, 0.58F, 0.58F}, 0.0);

  coat(without(common({grown(skull.sigmoid, 0.8), skull.bone}), skull.cranial), kCortical);
  structure(skull.sigmoid, kVein, "sigmoid_sinus", kVeinColor, 0.4);
  structure(without(skull.jugular, skull.sigmoid), kVein, "jugular_bulb", {0.30F, 0.42F, 0.82F},
            0.4);
  structure(skull.carotid, kArtery, "carotid_artery", {0.80F, 0.13F, 0.12F}, 0.3);

  const Shape region = remembered(cellRegion(skull, ear));
  const Shape walls = honeycomb(
      region,
      [antrum = ear.antrum](const Point& p)
      {
        return std::clamp(1.9 + 0.14 * antrum(p), 1.9, 4.4); // larger towards the periphery
      },
      seed);
  const Shape cells{[region, walls](const Point& p)
                    {
                      const double d = region(p);
                      return d > 1.5 ? d : -smoothMin(-d, -walls(p), 0.5);
                    },
                    region.box};
  coat(ear.cavity, kAir);
  structure(merge({cells, ear.antrum}), kAir, "air_cells", {0.62F, 0.80F, 0.86F}, 0.0, false);
  structure(ear.canal, kAir, "external_auditory_canal", {0.86F, 0.70F, 0.62F}, 0.3, false);
  coat(ear.annulus, kCortical);

  // the densest bone: one mass around cochlea and canals, bulging as promontory and prominence
  const Shape core = ellipsoid({-38.8, 2.0, 3.4}, {3.6, 3.8, 4.2});
  coat(common({blend({grown(ear.labyrinth, 1.2), grown(ear.cochlea, 1.5), core}, 2.0),
               complement(skull.cranial), complement(skull.carotid), complement(skull.jugular)}),
       kCapsule);
  coat(ear.windows, kAir);
  coat(without(ear.facialWall, ear.windows), kCortical);
  if (cholesteatoma)
    structure(without(ear.cholesteatoma, ear.facialWall), kCholesteatoma, "cholesteatoma",
              {0.93F, 0.89F, 0.76F}, 0.2);
  structure(ear.drum, kSkin, "tympanic_membrane", {0.90F, 0.72F, 0.70F}, 0.0);
  structure(common({ear.meatus, complement(ear.labyrinth), complement(skull.cranial)}), kFluid,
            "internal_auditory_canal", {0.55F, 0.70F, 0.85F}, 0.25);
  structure(ear.vestibule, kFluid, "vestibule", {0.62F, 0.46F, 0.84F}, 0.15);
  structure(without(ear.cochlea, ear.vestibule), kFluid, "cochlea", {0.55F, 0.40F, 0.80F}, 0.12);
  structure(without(ear.superior, ear.vestibule), kFluid, "superior_semicircular_canal",
            {0.46F, 0.42F, 0.84F}, 0.08);
  structure(without(ear.posterior, merge({ear.vestibule, ear.superior})), kFluid,
            "posterior_semicircular_canal", {0.40F, 0.34F, 0.74F}, 0.08);
  structure(without(ear.lateral, merge({ear.vestibule, ear.superior})), kFluid,
            "lateral_semicircular_canal", {0.62F, 0.36F, 0.78F}, 0.08);
  coat(without(ear.facialCanal, ear.labyrinth), kSkin);
  structure(ear.eighthNerve, kNerve, "vestibulocochlear_nerve", {0.94F, 0.74F, 0.24F}, 0.15);
  structure(ear.chorda, kNerve, "chorda_tympani", {0.99F, 0.88F, 0.40F}, 0.06);
  structure(ear.facialNerve, kNerve, "facial_nerve", kNerveColor, 0.12);
  structure(ear.malleus, kOssicle, "malleus", kOssicleColor, 0.12);
  structure(ear.incus, kOssicle, "incus", {0.93F, 0.88F, 0.76F}, 0.1);
  structure(ear.stapes, kOssicle, "stapes", {0.98F, 0.90F, 0.70F}, 0.045);
  return layers;
}

} // namespace petrous::phantom::anatomy
