#include "DevicesBenchmark.h"

#include <algorithm>
#include <chrono>
#include <limits>
#include <string>
#include <vector>

#include <tbb/parallel_for.h>

#include "WallPress.h"
#include "petrous/Core/NumberText.h"
#include "petrous/Devices/DeviceCheck.h"
#include "petrous/Presenters/DeviceLimits.h"
#include "petrous/Presenters/DeviceMapping.h"

namespace petrous::cli
{

namespace
{

using haptics::RealDevice;
using haptics::Touching;
using haptics::TransmittedDevice;
using haptics::WallPress;

constexpr double kTick = 0.001; // s

// A handle in a light grip: 0.1 kg, 3 N s/m and 0.3 N/mm are the hand's.
struct Handle
{
  RealDevice real;
  double described; // N/mm, by its server; for mass and damper alone the usual coupling
};

// Friction and resolution of the Touch are those of its data sheet, as its mass of 45 g; forces and
// stiffness are those of the servers. All others are assumed: vendors state a resolution at most.
constexpr Handle kHandles[] = {{{"mass and damper alone", 0.15, 0.003, 0.0, 0, 0.0, 0, 10.0}, 1.0},
                               {{"Touch", 0.145, 0.003, 0.26, 0, 0.055, 0, 3.3}, 0.4},
                               {{"Inverse3", 0.2, 0.004, 0.05, 0, 0.01, 0, 5.0}, 1.0},
                               {{"Falcon", 0.3, 0.005, 0.3, 0, 0.06, 0, 8.0}, 3.0},
                               {{"omega", 0.3, 0.006, 0.1, 0, 0.01, 0, 12.0}, 5.0},
                               {{"sigma", 0.4, 0.008, 0.15, 0, 0.005, 0, 20.0}, 4.0},
                               {{"lambda", 0.35, 0.006, 0.15, 0, 0.005, 0, 10.0}, 2.0}};

struct Sweep
{
  std::vector<Handle> handles;
  std::vector<double> stiffnesses; // N/mm
  std::vector<int> delays;         // ms
  std::vector<int> drops;          // every so many ticks; 0: none
  double rest;                     // s
};

Sweep sweepOf(bool quick)
{
  if (quick)
    return {
        {std::begin(kHandles), std::begin(kHandles) + 2}, {0.25, 1.0, 10.0}, {0, 8}, {0, 10}, 1.0};
  return {{std::begin(kHandles), std::end(kHandles)},
          {0.25, 0.35, 0.5, 0.7, 1.0, 1.4, 2.0, 2.8, 4.0, 5.6, 8.0, 10.0},
          {0, 1, 2, 3, 4, 5, 6, 7, 8},
          {0, 100, 10},
          4.0};
}

// What the window sets for a device of that description, as felt in the hand.
double settingOf(const RealDevice& real, double stiffness)
{
  haptics::DeviceDescription description = haptics::SimulatedDevice::usualDescription();
  description.maxForce = real.maxForce;
  description.maxStiffness = stiffness;
  session::TouchSession::Setup setup;
  presenters::DeviceMapping mapping;
  mapping.scale = presenters::usualScale(description);
  presenters::fit(setup, description, mapping, false);
  return setup.passivity->stiffness;
}

// What `petrous device-test` measures, N/mm; 0: nothing.
double tested(const RealDevice& real)
{
  TransmittedDevice device(real, [](double) { return haptics::Pose(); });
  devices::DeviceCheck::Options options;
  options.workspaceTime = 0.5;
  devices::DeviceCheck check(device.description(), options);
  for (int n = 0; n < 400000 && check.stage() != devices::DeviceCheck::Stage::Done; ++n)
  {
    const haptics::DeviceReading reading = device.read(kTick * n);
    if (real.dropEvery == 0 || n % real.dropEvery != 0)
      device.send(check.tick(reading, kTick * n));
  }
  return check.result().proposed;
}

core::BenchmarkPoint measure(const Handle& handle, bool guarded, const Sweep& sweep)
{
  const auto begin = std::chrono::steady_clock::now();
  const RealDevice& real = handle.real;
  core::BenchmarkPoint point;
  point.scene = real.name;
  point.setting["guard"] = guarded ? "on" : "off";
  point.setting["delay_ms"] = std::to_string(real.delay);
  point.setting["missed_percent"] = std::to_string(real.dropEvery == 0 ? 0 : 100 / real.dropEvery);
  point.isDefault = guarded && real.delay == 1 && real.dropEvery == 0;
  point.error = std::numeric_limits<double>::quiet_NaN();
  WallPress how;
  how.guarded = guarded;
  how.rest = sweep.rest;
  double largest = 0.0;
  bool stable = true;
  for (const double stiffness : sweep.stiffnesses)
  {
    how.stiffness = stiffness;
    const Touching felt = haptics::press(real, how);
    const std::string at = "_at_" + core::generalText(stiffness, 3);
    point.extra["energy_mj" + at] = felt.energyOut;
    point.extra["cycle_n_pp" + at] = 2.0 * felt.ripple;
    stable = stable && felt.stable();
    if (stable)
      largest = stiffness;
  }
  const double described = settingOf(real, presenters::untestedStiffness(handle.described));
  point.extra["largest_stable_n_per_mm"] = largest;
  point.extra["described_n_per_mm"] = described;
  point.extra["described_margin"] = largest / described;
  if (const double kept = presenters::boundedStiffness(tested(real), handle.described); kept > 0.0)
  {
    point.extra["tested_n_per_mm"] = settingOf(real, kept);
    point.extra["tested_margin"] = largest / point.extra["tested_n_per_mm"];
  }
  point.extra["passive_n_per_mm"] = haptics::passiveStiffness(real);
  const bool alone = real.friction == 0.0 && real.quantum == 0.0;
  if (alone && !guarded && real.dropEvery == 0)
  {
    how.rest = 3.0 * sweep.rest;
    point.extra["border_n_per_mm"] = haptics::ringingStiffness(real, how);
  }
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begin;
  point.seconds = took.count();
  return point;
}

} // namespace

core::BenchmarkReport runDevicesBenchmark(bool quick, const core::Progress& progress)
{
  core::BenchmarkReport report{"devices", "Stability of the coupling over stiffness and delay", {}};
  const Sweep sweep = sweepOf(quick);
  struct Row
  {
    Handle handle;
    bool guarded;
  };
  std::vector<Row> rows;
  for (const Handle& handle : sweep.handles)
    for (const bool guarded : {true, false})
      for (const int drop : sweep.drops)
        for (const int delay : sweep.delays)
        {
          rows.push_back({handle, guarded});
          rows.back().handle.real.delay = delay;
          rows.back().handle.real.dropEvery = drop;
        }
  report.points.resize(rows.size());
  constexpr std::size_t batch = 8;
  for (std::size_t from = 0; from < rows.size(); from += batch)
  {
    progress.report(static_cast<double>(from) / static_cast<double>(rows.size()),
                    "pressing on walls");
    progress.check("the benchmark of devices");
    tbb::parallel_for(from, std::min(rows.size(), from + batch),
                      [&](std::size_t n)
                      { report.points[n] = measure(rows[n].handle, rows[n].guarded, sweep); });
  }
  return report;
}

} // namespace petrous::cli
