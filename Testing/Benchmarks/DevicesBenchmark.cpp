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

using haptics::KnownHandle;
using haptics::RealDevice;
using haptics::Touching;
using haptics::TransmittedDevice;
using haptics::WallPress;

constexpr double kTick = 0.001; // s

struct Misses
{
  double share;
  int burst; // ticks at a time
};

struct Sweep
{
  std::vector<KnownHandle> handles;
  std::vector<double> stiffnesses; // N/mm
  std::vector<int> delays;         // ms
  std::vector<Misses> misses;
  int times;
  double borderRest; // s
};

Sweep sweepOf(bool quick)
{
  if (quick)
    return {{std::begin(haptics::kHandles), std::begin(haptics::kHandles) + 2},
            {0.25, 1.0, 10.0},
            {0, 8},
            {{0.0, 1}, {0.05, 3}},
            3,
            3.0};
  return {{std::begin(haptics::kHandles), std::end(haptics::kHandles)},
          {0.25, 0.35, 0.5, 0.7, 1.0, 1.4, 2.0, 2.8, 4.0, 5.6, 8.0, 10.0},
          {0, 1, 2, 3, 4, 5, 6, 7, 8},
          {{0.0, 1}, {0.01, 1}, {0.05, 1}, {0.05, 3}},
          30,
          12.0};
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
  haptics::MissedTicks misses(real);
  for (int n = 0; n < 400000 && check.stage() != devices::DeviceCheck::Stage::Done; ++n)
  {
    const haptics::DeviceReading reading = device.read(kTick * n);
    if (!misses(n))
      device.send(check.tick(reading, kTick * n));
  }
  return check.result().proposed;
}

core::BenchmarkPoint measure(const KnownHandle& handle, bool guarded, const Sweep& sweep)
{
  const auto begin = std::chrono::steady_clock::now();
  const RealDevice& real = handle.real;
  core::BenchmarkPoint point;
  point.scene = real.name;
  point.setting["guard"] = guarded ? "on" : "off";
  point.setting["delay_ms"] = std::to_string(real.delay);
  point.setting["missed_percent"] = core::generalText(100.0 * real.missed, 3);
  point.setting["missed_at_once"] = std::to_string(real.burst);
  point.isDefault = guarded && real.delay == 1 && real.missed == 0.0;
  point.error = std::numeric_limits<double>::quiet_NaN();
  WallPress how;
  how.guarded = guarded;
  how.times = sweep.times;
  double largest = 0.0;
  bool stable = true;
  for (const double stiffness : sweep.stiffnesses)
  {
    how.stiffness = stiffness;
    const Touching felt = haptics::press(real, how);
    const std::string at = "_at_" + core::generalText(stiffness, 3);
    point.extra["energy_mj" + at] = felt.energyOut;
    point.extra["cycle_n_pp" + at] = 2.0 * felt.ripple;
    if (guarded)
      point.extra["changed_n" + at] = felt.changed;
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
  if (alone && !guarded && real.missed == 0.0)
  {
    how.rest = sweep.borderRest;
    how.times = 3;
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
    KnownHandle handle;
    bool guarded;
  };
  std::vector<Row> rows;
  for (const KnownHandle& handle : sweep.handles)
    for (const bool guarded : {true, false})
      for (const Misses& misses : sweep.misses)
        for (const int delay : sweep.delays)
        {
          rows.push_back({handle, guarded});
          rows.back().handle.real.delay = delay;
          rows.back().handle.real.missed = misses.share;
          rows.back().handle.real.burst = misses.burst;
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
