#include "StressTrials.h"

#include <Eigen/Geometry>

#include "StressList.h"

namespace petrous::registration
{

namespace
{

using stress::Draw;
using stress::List;
using stress::withMr;
using stress::withoutTruth;

constexpr double kDegree = 3.14159265358979323846 / 180.0;

// CT of one slab of the body and MR of another, along z.
RegistrationPair slabs(const Draw& draw, double ctLow, double ctHigh, double mrLow, double mrHigh)
{
  const auto bounds = draw.body().ct->geometry().patientBounds();
  const Vector3d size = bounds.sizes();
  PairRecipe recipe = draw.recipe();
  recipe.ctExtent = size;
  (*recipe.ctExtent)[2] = (ctHigh - ctLow) * size[2];
  recipe.ctCenter = bounds.center();
  recipe.ctCenter[2] = bounds.min()[2] + 0.5 * (ctLow + ctHigh) * size[2];
  MrAcquisition& a = recipe.acquisition;
  a.axes.setIdentity();
  a.spacing[2] = std::min(a.spacing[2], 0.1 * size[2]);
  a.extent[2] = (mrHigh - mrLow) * size[2];
  a.center[2] = bounds.min()[2] + 0.5 * (mrLow + mrHigh) * size[2];
  RegistrationPair pair = simulatePair(draw.body(), draw.ear(), recipe);
  // A target in both images, or at least in the CT.
  pair.targets = {recipe.ctCenter};
  return pair;
}

// Moves the MR header so that both volumes' centres coincide.
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
  list.add("ear displaced by 2 to 6 mm within 15 to 22 mm", 24,
           [](const Draw& d)
           {
             PairRecipe recipe = d.recipe();
             const CounterNoise noise = d.noise();
             LocalShift part;
             part.center = randomMotion({0, 0, 0}, noise.uniform(20, 0.0, 5.0), 0.0, d.seed() + 1) *
                           d.earAt();
             part.radius = noise.uniform(21, 15.0, 22.0);
             part.shift = randomMotion({0, 0, 0}, noise.uniform(22, 2.0, 6.0), 0.0, d.seed() + 2) *
                          Vector3d::Zero();
             recipe.acquisition.local = part;
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

// A box of the head around one ear.
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
    return; // mirrored ones are already listed
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
  // Bodies with both ears.
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
      trial.make = [twoEared, make = trial.make] { return make(); }; // keeps the bodies alive
      list.trials.push_back(std::move(trial));
    }
  }
  // CT of one person, MR of another.
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
