#include "PhantomAnatomy.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "PhantomCells.h"

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
