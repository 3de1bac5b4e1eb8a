#include "RemovalBenchmark.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

#include "CutSurface.h"
#include "RemovalRun.h"
#include "petrous/Core/NumberText.h"

namespace petrous::session
{

namespace
{

using dissection::Burr;
using testing::LawScene;
using Points = std::vector<core::BenchmarkPoint>;

constexpr double kDegree = 3.14159265358979323846 / 180.0;
constexpr double kUsualVoxel = 0.15; // mm, of a cone-beam CT of the ear
constexpr double kUsualTick = 1e-3;  // s
constexpr double kUsualBurr = 4.0;   // mm
constexpr const char* kPeer = "volumetric_drilling: whole voxels";

struct Scope
{
  std::vector<double> voxels{0.1, 0.15, 0.2, 0.3, 0.4}; // mm
  std::vector<double> ticks{5e-4, 1e-3, 2e-3};          // s
  std::vector<double> thrusts{0.2, 1.0, 5.0};           // N
  std::vector<double> degrees{0.0, 20.0, 40.0, 60.0, 80.0};
  std::vector<double> burrs{1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0}; // mm
  std::vector<double> peerBurrs{1.0, 2.0, 4.0, 6.0};            // mm
  double volume = 0.4;                                          // mm^3 to be removed per run
  double least = 0.06, most = 2.5;                              // s of contact
  double groove = 1.5;                                          // s
  int centers = 200, directions = 400;

  static Scope of(bool quick)
  {
    Scope scope;
    if (quick)
    {
      scope.voxels = {0.2, 0.3};
      scope.ticks = {1e-3, 2e-3};
      scope.thrusts = {1.0};
      scope.degrees = {40.0};
      scope.burrs = {2.0, 4.0};
      scope.peerBurrs = {4.0};
      scope.volume = 0.5;
      scope.most = 0.15;
      scope.groove = 0.3;
      scope.centers = 20;
      scope.directions = 200;
    }
    return scope;
  }
};

using core::fixedText;

LawScene::Setting settingOf(Burr::Kind kind, double diameter, double thrust, double degrees,
                            double voxel, double tick)
{
  LawScene::Setting setting;
  setting.burr.kind = kind;
  setting.burr.diameter = diameter;
  setting.thrust = thrust;
  setting.elevation = degrees * kDegree;
  setting.voxel = voxel;
  setting.tick = tick;
  return setting;
}

core::BenchmarkPoint pointOf(const std::string& scene, const std::string& series,
                             const LawScene::Setting& setting, const core::TickTimes& times)
{
  core::BenchmarkPoint point;
  point.scene = scene;
  point.series = series;
  point.setting = {{"voxel_mm", fixedText(setting.voxel, 2)},
                   {"tick_ms", fixedText(1e3 * setting.tick, 1)},
                   {"burr_mm", fixedText(setting.burr.diameter, 0)}};
  point.isDefault = setting.voxel == kUsualVoxel && setting.tick == kUsualTick &&
                    setting.burr.diameter == kUsualBurr;
  times.enter(point);
  point.errorUnit = "% of what the law predicts";
  return point;
}

const char* nameOf(Burr::Kind kind)
{
  return kind == Burr::Kind::Cutting ? "cutting burr" : "diamond burr";
}

// Worst case over thrust and elevation for each tick and voxel size.
Points balances(const Scope& scope, const core::Progress& progress)
{
  Points points;
  const std::array<Burr::Kind, 2> kinds{Burr::Kind::Cutting, Burr::Kind::Diamond};
  const double all = static_cast<double>(kinds.size() * scope.ticks.size() * scope.voxels.size());
  for (const Burr::Kind kind : kinds)
  {
    const auto run = [&](double thrust, double degrees, double voxel, double tick)
    {
      const auto setting = settingOf(kind, kUsualBurr, thrust, degrees, voxel, tick);
      return runByLaw(setting,
                      std::clamp(scope.volume / lawRate(setting), scope.least, scope.most));
    };
    std::map<std::pair<double, double>, double> usual; // thrust, degrees -> mm^3
    for (const double thrust : scope.thrusts)
      for (const double degrees : scope.degrees)
        usual[{thrust, degrees}] = run(thrust, degrees, 0.2, kUsualTick).taken();
    for (const double tick : scope.ticks)
      for (const double voxel : scope.voxels)
      {
        progress.report(static_cast<double>(points.size()) / all, "removal by the laws");
        core::TickTimes times;
        double worst = 0.0, mean = 0.0, forfeited = 0.0, drift = 0.0, plainDrift = 0.0, told = 0.0;
        std::array<double, 2> at{}, driftAt{};
        for (const auto& [where, volume] : usual)
        {
          const RemovalRun result = run(where.first, where.second, voxel, tick);
          times.add(result.times);
          mean += result.error() / static_cast<double>(usual.size());
          if (std::abs(result.error()) > worst)
          {
            worst = std::abs(result.error());
            at = {where.first, where.second};
          }
          told = std::max(told, 100.0 * std::abs(result.balance() / result.predicted - 1.0));
          const double off = 100.0 * std::abs(result.taken() / volume - 1.0);
          if (where.second <= 40.0)
            plainDrift = std::max(plainDrift, off);
          if (off > drift)
          {
            drift = off;
            driftAt = {where.first, where.second};
          }
          forfeited = std::max(forfeited, 100.0 * result.forfeited / result.predicted);
        }
        LawScene::Setting setting = settingOf(kind, kUsualBurr, 0.0, 0.0, voxel, tick);
        auto point = pointOf(std::string(nameOf(kind)) + " of 4 mm, worst over thrust and angle",
                             "voxel_mm, tick " + fixedText(1e3 * tick, 1) + " ms", setting, times);
        point.error = worst;
        point.extra["mean_error_percent"] = mean;
        point.extra["worst_at_thrust_n"] = at[0];
        point.extra["worst_at_degrees"] = at[1];
        point.extra["off_from_0.2_mm_1_ms_percent"] = drift;
        point.extra["off_up_to_40_degrees_percent"] = plainDrift;
        point.extra["own_balance_error_percent"] = told;
        point.extra["off_at_thrust_n"] = driftAt[0];
        point.extra["off_at_degrees"] = driftAt[1];
        point.extra["forfeited_percent"] = forfeited;
        points.push_back(std::move(point));
      }
  }
  return points;
}

LawScene::Setting grooveOf(double diameter, double voxel)
{
  LawScene::Setting setting =
      settingOf(Burr::Kind::Cutting, diameter, 1.0, 40.0, voxel, kUsualTick);
  setting.speed = 10.0;
  return setting;
}

Points costs(const Scope& scope, const core::Progress& progress)
{
  Points points;
  const double all = static_cast<double>(scope.voxels.size() * scope.burrs.size());
  for (const double voxel : scope.voxels)
    for (const double diameter : scope.burrs)
    {
      progress.report(static_cast<double>(points.size()) / all, "the cost of a step");
      const auto setting = grooveOf(diameter, voxel);
      const RemovalRun run = runByLaw(setting, scope.groove);
      auto point = pointOf("a step that bites, 1 N, led at 10 mm/s",
                           "burr_mm, voxel " + fixedText(voxel, 2) + " mm", setting, run.times);
      point.error = std::abs(run.error());
      point.extra["removed_mm3"] = run.measured;
      point.extra["forfeited_percent"] = 100.0 * run.forfeited / run.predicted;
      points.push_back(std::move(point));
    }
  return points;
}

void besidePeer(const Scope& scope, const LawScene::Setting& setting, const std::string& series,
                Points& points)
{
  const double law = lawRate(setting);
  const double most = std::min(2.0, std::pow(0.5 * setting.burr.diameter, 3));
  const double seconds = std::clamp(most / law, scope.least, 0.5);
  for (const bool ours : {true, false})
  {
    const RemovalRun run = ours ? runByLaw(setting, seconds) : runByDeletion(setting, 0.5, most);
    auto point = pointOf("beside voxels deleted whole", series, setting, run.times);
    point.setting["thrust_n"] = fixedText(setting.thrust, 1);
    point.isDefault = point.isDefault && ours && setting.thrust == 1.0;
    point.peer = ours ? "" : kPeer;
    point.error = std::abs(run.error());
    point.extra["rate_mm3_per_s"] = (run.measured + run.owed) / run.contact;
    point.extra["law_mm3_per_s"] = run.predicted / run.contact;
    points.push_back(std::move(point));
  }
}

Points comparisons(const Scope& scope, const core::Progress& progress)
{
  Points points;
  for (const double diameter : scope.peerBurrs)
  {
    progress.check("voxels deleted whole");
    const std::string burr = ", " + fixedText(diameter, 0) + " mm burr";
    const auto setting = settingOf(Burr::Kind::Cutting, diameter, 1.0, 40.0, 0.2, kUsualTick);
    const auto vary = [&](const std::string& name, const std::vector<double>& values,
                          double LawScene::Setting::*member)
    {
      for (const double value : values)
      {
        auto varied = setting;
        varied.*member = value;
        besidePeer(scope, varied, name + burr, points);
      }
    };
    vary("voxel_mm", scope.voxels, &LawScene::Setting::voxel);
    vary("tick_ms", scope.ticks, &LawScene::Setting::tick);
    vary("thrust_n", scope.thrusts, &LawScene::Setting::thrust);
  }
  return points;
}

Points surfaces(const Scope& scope, const core::Progress& progress)
{
  Points points;
  for (const double diameter : {2.0, kUsualBurr})
    for (const double voxel : scope.voxels)
    {
      progress.check("the surface of a groove");
      const auto setting = grooveOf(diameter, voxel);
      LawScene scene(setting);
      core::TickTimes times;
      scene.follow = [&](const TickRecord& record)
      {
        core::TickTimes time;
        if (time.take([&] { return scene.loop.step(record); }))
          times.add(time);
      };
      scene.drill(std::min(scope.groove, 0.6));
      const SurfaceError error = surfaceErrorOf(scene, scope.centers, scope.directions);
      auto point = pointOf("surface of a groove against the balls that made it",
                           "voxel_mm, " + fixedText(diameter, 0) + " mm burr", setting, times);
      point.error = error.rms;
      point.errorUnit = "voxels, RMS";
      point.extra["max_voxels"] = error.most;
      point.extra["mean_voxels"] = error.mean;
      point.extra["points"] = static_cast<double>(error.points);
      point.extra["bites"] = static_cast<double>(scene.bites.size());
      points.push_back(std::move(point));
    }
  return points;
}

} // namespace

core::BenchmarkReport runRemovalBenchmark(bool quick, const core::Progress& progress)
{
  const Scope scope = Scope::of(quick);
  core::BenchmarkReport report{"removal", "Bone removed by the laws", {}};
  const auto take = [&report](const Points& points)
  { report.points.insert(report.points.end(), points.begin(), points.end()); };
  take(balances(scope, progress.part(0.0, 0.5)));
  take(costs(scope, progress.part(0.5, 0.8)));
  take(comparisons(scope, progress.part(0.8, 0.9)));
  take(surfaces(scope, progress.part(0.9, 1.0)));
  return report;
}

} // namespace petrous::session
