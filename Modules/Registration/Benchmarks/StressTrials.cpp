#include "StressTrials.h"

#include <cmath>
#include <limits>

#include <Eigen/Geometry>

#include "CounterNoise.h"

namespace petrous::registration
{

namespace
{

using Image = std::shared_ptr<const volume::IntensityVolume>;

constexpr double kDegree = 3.14159265358979323846 / 180.0;
constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

// The n-th draw of a kind: a body, an ear of it, and a seed.
struct Draw
{
  const std::vector<SimulationBody>* bodies;
  std::size_t n = 0;

  const SimulationBody& body() const { return (*bodies)[n % bodies->size()]; }
  std::size_t ear() const { return n / bodies->size() % body().ears.size(); }
  Vector3d earAt() const { return body().ears[ear()]; }
  std::uint64_t seed() const { return 1000 + 37 * n; }
  CounterNoise noise() const { return CounterNoise(seed()); }
  PairRecipe recipe() const { return usualRecipe(body(), ear(), seed()); }
  RegistrationPair usual() const { return simulatePair(body(), ear(), recipe()); }
  Vector3d size() const
  {
    const auto bounds = body().ct->geometry().patientBounds();
    return bounds[1] - bounds[0];
  }
};

class List
{
public:
  List(const std::vector<SimulationBody>& bodies, bool quick)
    : m_bodies(&bodies)
    , m_quick(quick)
  {
  }

  using Make = RegistrationPair (*)(const Draw&);

  void add(const std::string& kind, std::size_t count, const Make& make, bool mustBeGood = false)
  {
    for (std::size_t n = 0; n < (m_quick ? 1 : count); ++n)
    {
      const Draw draw{m_bodies, n};
      trials.push_back({kind, draw.body().name + ", " + std::to_string(n + 1),
                        [draw, make] { return make(draw); }, mustBeGood});
    }
  }

  std::vector<StressTrial> trials;

private:
  const std::vector<SimulationBody>* m_bodies;
  bool m_quick;
};

RegistrationPair withMr(RegistrationPair pair, Image mr)
{
  pair.mr = std::move(mr);
  return pair;
}

RegistrationPair withoutTruth(RegistrationPair pair)
{
  pair.truth = nullptr;
  return pair;
}

// CT of one slab of the body and MR of another, along z.
RegistrationPair slabs(const Draw& draw, double ctLow, double ctHigh, double mrLow, double mrHigh)
{
  const auto bounds = draw.body().ct->geometry().patientBounds();
  const Vector3d size = bounds[1] - bounds[0];
  PairRecipe recipe = draw.recipe();
  recipe.ctExtent = size;
  (*recipe.ctExtent)[2] = (ctHigh - ctLow) * size[2];
  recipe.ctCenter = 0.5 * (bounds[0] + bounds[1]);
  recipe.ctCenter[2] = bounds[0][2] + 0.5 * (ctLow + ctHigh) * size[2];
  MrAcquisition& a = recipe.acquisition;
  a.axes.setIdentity();
  a.spacing[2] = std::min(a.spacing[2], 0.1 * size[2]);
  a.extent[2] = (mrHigh - mrLow) * size[2];
  a.center[2] = bounds[0][2] + 0.5 * (mrLow + mrHigh) * size[2];
  RegistrationPair pair = simulatePair(draw.body(), draw.ear(), recipe);
  // A target that both or at least the CT shows.
  pair.targets = {recipe.ctCenter};
  return pair;
}

// Moves the MR's header so that the middles of both volumes coincide.
RegistrationPair centred(const RegistrationPair& pair)
{
  return displaced(pair, {Eigen::Quaterniond::Identity(),
                          pair.ct->geometry().center() - pair.mr->geometry().center()});
}

RegistrationPair turned(const Draw& draw, double degrees)
{
  const RegistrationPair pair = draw.usual();
  const Vector3d axis =
      (draw.n & 1 ? -1.0 : 1.0) * Vector3d::Unit(static_cast<int>(draw.n / 2 % 3));
  const Eigen::Quaterniond turn(Eigen::AngleAxisd(degrees * kDegree, axis));
  const Vector3d center = pair.mr->geometry().center();
  return displaced(pair, {turn, center - turn * center});
}

Image noiseLike(const volume::IntensityVolume& image, std::uint64_t seed, double low, double high)
{
  const CounterNoise noise(seed);
  const core::GridGeometry& grid = image.geometry();
  return changed(image,
                 [&](int i, int j, int k, float) {
                   return static_cast<float>(noise.uniform(grid.linearIndex(i, j, k), low, high));
                 });
}

// Random balls: an image with shapes, of nothing that the CT shows.
Image ballsLike(const volume::IntensityVolume& image, std::uint64_t seed)
{
  const CounterNoise noise(seed);
  const core::GridGeometry& grid = image.geometry();
  const auto bounds = grid.patientBounds();
  struct Ball
  {
    Vector3d center;
    double radius;
    float value;
  };
  std::vector<Ball> balls;
  for (std::uint64_t b = 0; b < 40; ++b)
  {
    Ball ball{bounds[0], noise.uniform(10 * b, 0.03, 0.16) * (bounds[1] - bounds[0]).norm(),
              static_cast<float>(noise.uniform(10 * b + 1, 0.0, 1000.0))};
    for (Eigen::Index axis = 0; axis < 3; ++axis)
      ball.center[axis] = noise.uniform(10 * b + 2 + static_cast<std::uint64_t>(axis),
                                        bounds[0][axis], bounds[1][axis]);
    balls.push_back(ball);
  }
  return changed(image,
                 [&](int i, int j, int k, float)
                 {
                   const Vector3d p = grid.patientFromVoxel(Vector3d(i, j, k));
                   float value = 20.0F;
                   for (const Ball& ball : balls)
                     if ((p - ball.center).squaredNorm() < ball.radius * ball.radius)
                       value = ball.value;
                   return value + static_cast<float>(
                                      noise.uniform(100000 + grid.linearIndex(i, j, k), 0.0, 30.0));
                 });
}

// A share of the MR's voxels, scattered, becomes `value`.
RegistrationPair scattered(const Draw& draw, double share, float value)
{
  const RegistrationPair pair = draw.usual();
  const CounterNoise noise(draw.seed() + 5);
  const core::GridGeometry& grid = pair.mr->geometry();
  return withMr(
      pair, changed(*pair.mr, [&](int i, int j, int k, float before)
                    { return noise.uniform(grid.linearIndex(i, j, k)) < share ? value : before; }));
}

// An MR of so many slices across z, y or x.
RegistrationPair fewSlices(const Draw& draw, int slices)
{
  PairRecipe recipe = draw.recipe();
  MrAcquisition& a = recipe.acquisition;
  const std::array<Eigen::Matrix3d, 3> planes{
      Eigen::Matrix3d::Identity(),
      Eigen::AngleAxisd(90.0 * kDegree, Vector3d::UnitX()).toRotationMatrix(),
      Eigen::AngleAxisd(90.0 * kDegree, Vector3d::UnitY()).toRotationMatrix()};
  a.axes = planes[draw.n % 3];
  a.center = draw.earAt();
  a.spacing[2] = 3.0;
  a.extent[2] = 3.0 * slices;
  return simulatePair(draw.body(), draw.ear(), recipe);
}

void addImages(List& list)
{
  list.add("constant MR", 6,
           [](const Draw& d)
           {
             const auto pair = d.usual();
             return withoutTruth(
                 withMr(pair, changed(*pair.mr, [](int, int, int, float) { return 100.0F; })));
           });
  list.add("constant MR but for one voxel", 4,
           [](const Draw& d)
           {
             const auto pair = d.usual();
             return withoutTruth(
                 withMr(pair, changed(*pair.mr, [](int i, int j, int k, float)
                                      { return i + j + k == 9 && i == 3 ? 9.F : 1.F; })));
           });
  list.add("constant CT", 4,
           [](const Draw& d)
           {
             auto pair = d.usual();
             pair.ct = changed(*pair.ct, [](int, int, int, float) { return 0.0F; });
             return withoutTruth(pair);
           });
  list.add("MR of one slice", 10, [](const Draw& d) { return fewSlices(d, 1); });
  list.add("MR of two slices", 5, [](const Draw& d) { return fewSlices(d, 2); });
  list.add("MR of three slices", 5, [](const Draw& d) { return fewSlices(d, 3); });
  list.add("NaN in 5 % of the MR", 6, [](const Draw& d) { return scattered(d, 0.05, kNan); });
  list.add("NaN in 70 % of the MR", 6, [](const Draw& d) { return scattered(d, 0.7, kNan); });
  list.add("NaN in all of the MR", 4,
           [](const Draw& d) { return withoutTruth(scattered(d, 2.0, kNan)); });
  list.add("infinite values in 2 % of the MR", 4,
           [](const Draw& d)
           { return scattered(d, 0.02, std::numeric_limits<float>::infinity()); });
  list.add("NaN in half of the MR, one side", 6,
           [](const Draw& d)
           {
             const auto pair = d.usual();
             const int half = pair.mr->geometry().dims()[d.n % 3] / 2;
             const std::size_t axis = d.n % 3;
             return withMr(pair,
                           changed(*pair.mr,
                                   [&](int i, int j, int k, float before) {
                                     return core::Index3{i, j, k}[axis] < half ? kNan : before;
                                   }));
           });
  list.add("NaN in 20 % of the CT", 4,
           [](const Draw& d)
           {
             auto pair = d.usual();
             const CounterNoise noise(d.seed());
             const auto& grid = pair.ct->geometry();
             pair.ct = changed(
                 *pair.ct, [&](int i, int j, int k, float before)
                 { return noise.uniform(grid.linearIndex(i, j, k)) < 0.2 ? kNan : before; });
             return pair;
           });
  list.add("noise for an MR", 8,
           [](const Draw& d)
           {
             const auto pair = d.usual();
             return withoutTruth(withMr(pair, noiseLike(*pair.mr, d.seed(), 0.0, 1000.0)));
           });
  list.add("noise for a CT", 4,
           [](const Draw& d)
           {
             auto pair = d.usual();
             pair.ct = noiseLike(*pair.ct, d.seed(), -1000.0, 2000.0);
             return withoutTruth(pair);
           });
  list.add("balls for an MR", 8,
           [](const Draw& d)
           {
             const auto pair = d.usual();
             return withoutTruth(withMr(pair, ballsLike(*pair.mr, d.seed())));
           });
  list.add("MR as noisy as it is bright", 8,
           [](const Draw& d)
           {
             PairRecipe recipe = d.recipe();
             recipe.acquisition.noise = 0.5 + 0.15 * static_cast<double>(d.n);
             return simulatePair(d.body(), d.ear(), recipe);
           });
}

void addGeometry(List& list)
{
  list.add("headers 250 to 400 mm apart", 10,
           [](const Draw& d)
           {
             return displaced(d.usual(), randomMotion(d.earAt(), d.noise().uniform(9, 250.0, 400.0),
                                                      5.0, d.seed()));
           });
  list.add("other slabs of the head, headers right", 6,
           [](const Draw& d) { return slabs(d, 0.0, 0.4, 0.6, 1.0); });
  list.add("other slabs of the head, headers centred", 8,
           [](const Draw& d) { return centred(slabs(d, 0.0, 0.4, 0.6, 1.0)); });
  list.add("slabs that overlap by a tenth", 12,
           [](const Draw& d) { return slabs(d, 0.0, 0.5, 0.45, 1.0); });
  list.add("MR of 20 mm about the ear", 8,
           [](const Draw& d)
           {
             PairRecipe recipe = d.recipe();
             recipe.acquisition.extent = Vector3d::Constant(20.0);
             recipe.acquisition.center = d.earAt();
             return simulatePair(d.body(), d.ear(), recipe);
           });
  list.add("voxels mirrored against the header", 12,
           [](const Draw& d)
           {
             const auto pair = d.usual();
             return withoutTruth(
                 withMr(pair, flipped(*pair.mr, static_cast<int>(d.n / 2 % 3), false)));
           });
  list.add(
      "left-handed header, as it should be", 10,
      [](const Draw& d)
      {
        const auto pair = d.usual();
        return withMr(pair, flipped(*pair.mr, static_cast<int>(d.n / 2 % 3), true));
      },
      true);
  list.add("start 60 degrees off", 6, [](const Draw& d) { return turned(d, 60.0); });
  list.add("start 90 degrees off", 12, [](const Draw& d) { return turned(d, 90.0); });
  list.add("start 180 degrees off", 6, [](const Draw& d) { return turned(d, 180.0); });
  list.add("MR distorted by up to 8 mm", 8,
           [](const Draw& d)
           {
             PairRecipe recipe = d.recipe();
             recipe.acquisition.distortion = 5.0 + 0.4 * static_cast<double>(d.n);
             return simulatePair(d.body(), d.ear(), recipe);
           });
  list.add("MR whose header states voxels 10 to 30 % too large", 8,
           [](const Draw& d)
           {
             const auto pair = d.usual();
             const double factor = 1.1 + 0.03 * static_cast<double>(d.n);
             const core::GridGeometry& grid = pair.mr->geometry();
             const core::GridGeometry wrong(grid.dims(), factor * grid.spacing(), grid.origin(),
                                            grid.direction());
             RegistrationPair result = withMr(pair, relaid(*pair.mr, wrong));
             result.truth = [grid, wrong, truth = pair.truth](const Vector3d& p)
             { return wrong.patientFromVoxel(grid.voxelFromPatient(truth(p))); };
             return result;
           });
  list.add("MR of slices 10 to 15 mm thick", 6,
           [](const Draw& d)
           {
             PairRecipe recipe = d.recipe();
             recipe.acquisition.spacing[2] = 10.0 + static_cast<double>(d.n);
             return simulatePair(d.body(), d.ear(), recipe);
           });
  list.add(
      "nothing wrong", 16, [](const Draw& d) { return d.usual(); }, true);
}

// A box of a head about one ear.
PairRecipe earRecipe(const Draw& draw, std::size_t ctEar, std::size_t mrEar)
{
  const SimulationBody& body = draw.body();
  const Vector3d box = draw.size().cwiseMin(Vector3d(70.0, 80.0, 60.0));
  PairRecipe recipe = draw.recipe();
  recipe.ctExtent = box;
  recipe.ctCenter = body.ears[ctEar % body.ears.size()];
  recipe.acquisition.extent = box;
  recipe.acquisition.center = body.ears[mrEar % body.ears.size()];
  recipe.acquisition.spacing[2] = std::min(recipe.acquisition.spacing[2], 2.0);
  return recipe;
}

void addSides(List& list, bool both)
{
  if (both)
  {
    list.add("left ear's CT, right ear's MR, headers right", 6,
             [](const Draw& d)
             { return withoutTruth(simulatePair(d.body(), 0, earRecipe(d, d.n, d.n + 1))); });
    list.add("left ear's CT, right ear's MR, headers centred", 8,
             [](const Draw& d) {
               return withoutTruth(centred(simulatePair(d.body(), 0, earRecipe(d, d.n, d.n + 1))));
             });
  }
  list.add("MR of the other side: mirrored anatomy about the ear", 10,
           [](const Draw& d)
           {
             const auto pair = simulatePair(d.body(), d.ear(), earRecipe(d, d.ear(), d.ear()));
             return withoutTruth(centred(withMr(pair, flipped(*pair.mr, 0, false))));
           });
}

} // namespace

std::vector<StressTrial> stressTrials(const std::vector<SimulationBody>& bodies,
                                      const std::vector<RegistrationPair>& others, bool quick)
{
  List list(bodies, quick);
  addImages(list);
  addGeometry(list);
  // Of those that have both ears.
  const auto twoEared = std::make_shared<std::vector<SimulationBody>>();
  for (const SimulationBody& body : bodies)
    if (body.ears.size() > 1)
      twoEared->push_back(body);
  addSides(list, false);
  if (!twoEared->empty())
  {
    List sides(*twoEared, quick);
    addSides(sides, true);
    for (StressTrial& trial : sides.trials)
    {
      trial.make = [twoEared, make = trial.make] { return make(); }; // keeps the bodies
      list.trials.push_back(std::move(trial));
    }
  }
  // One person's CT, another one's MR.
  std::vector<RegistrationPair> people;
  for (const SimulationBody& body : bodies)
    people.push_back({body.name, body.ct, nullptr, nullptr, body.ears});
  const std::size_t rounds = quick ? 1 : 6;
  for (std::size_t a = 0; a < bodies.size() + others.size(); ++a)
    for (std::size_t b = 0; b < bodies.size() + others.size(); ++b)
    {
      const bool simulated = b < bodies.size();
      if (a == b || (!simulated && a >= bodies.size()))
        continue;
      for (std::size_t n = 0; n < (simulated ? rounds : 1); ++n)
      {
        const RegistrationPair ct = a < bodies.size() ? people[a] : others[a - bodies.size()];
        const auto make = [=, &bodies]
        {
          RegistrationPair pair = ct;
          pair.truth = nullptr;
          pair.targets.resize(1);
          pair.mr = simulated ? simulatePair(bodies[b], 0, usualRecipe(bodies[b], 0, 500 + n)).mr
                              : others[b - bodies.size()].mr;
          return n % 2 == 0 ? pair : centred(pair);
        };
        const std::string mrName = simulated ? bodies[b].name : others[b - bodies.size()].name;
        list.trials.push_back(
            {"another patient's MR",
             "CT of " + ct.name + ", MR of " + mrName + ", " + std::to_string(n + 1), make, false});
      }
    }
  return std::move(list.trials);
}

} // namespace petrous::registration
