#include "HistoryBenchmark.h"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "MaskComparison.h"
#include "petrous/Dissection/Dissection.h"

namespace petrous::dissection
{

namespace
{

using Clock = std::chrono::steady_clock;
using Eigen::Vector3d;

constexpr double kVoxel = 0.15;    // mm
constexpr double kLength = 15.0;   // mm, of a stroke
constexpr double kRadius = 2.0;    // mm
constexpr std::size_t kTimed = 21; // undos per number of strokes

double secondsOf(const std::function<void()>& work)
{
  const auto start = Clock::now();
  work();
  return std::chrono::duration<double>(Clock::now() - start).count();
}

double median(std::vector<double> values)
{
  std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2),
                   values.end());
  return values[values.size() / 2];
}

// Strokes side by side, `across` mm apart, in layers `down` mm apart, slightly curved.
struct Field
{
  const char* scene;
  double across, down;
  std::size_t most; // strokes with a separate position
  bool isDefault;

  Vector3d start(std::size_t stroke, double edge) const
  {
    const auto fitting = [](double length, double step)
    { return static_cast<std::size_t>(length / step); };
    const std::size_t columns = fitting(edge - kLength - 8.0, kLength + 5.0) + 1;
    const std::size_t rows = fitting(edge - 8.0, across);
    const std::size_t row = stroke % rows, layer = stroke / rows % fitting(edge - 8.0, down);
    const std::size_t column = stroke / rows / fitting(edge - 8.0, down) % columns;
    return {4.0 + (kLength + 5.0) * static_cast<double>(column) + 0.037 * static_cast<double>(row),
            4.0 + across * static_cast<double>(row),
            edge - 4.0 - down * static_cast<double>(layer) - 0.011 * static_cast<double>(row)};
  }
};

constexpr Field kFields[] = {
    {"strokes of 15 mm with a 4 mm burr, each into the last one's side", 0.8, 0.8, 1000, true},
    {"the same, each in bone that is whole", 4.7, 4.7, 300, false}};

void drill(Dissection& work, const Vector3d& start)
{
  constexpr int steps = 30;
  const auto at = [&start](int step)
  {
    const double way = kLength * step / steps;
    return Vector3d(start + Vector3d(way, 0.02 * way, 0.3 * std::sin(0.5 * way)));
  };
  work.beginStroke({});
  for (int step = 0; step < steps; ++step)
    work.cut({at(step), at(step + 1), kRadius});
}

std::size_t packedBytes(const Dissection& work)
{
  std::size_t sum = 0;
  for (const auto& stroke : work.strokes())
    sum += stroke->bytes;
  return sum;
}

// Undo and redo of the latest strokes, and the number of voxels that then differ.
core::BenchmarkPoint measure(Dissection& work, const Field& field, double drillOff)
{
  const volume::CutMask before = std::as_const(work).mask();
  const std::size_t count = work.strokes().size();
  const std::size_t timed = std::min(count, kTimed);
  std::vector<double> undo, redo;
  for (std::size_t n = 0; n < timed; ++n)
    undo.push_back(secondsOf([&work] { work.undo(); }));
  for (std::size_t n = 0; n < timed; ++n)
    redo.push_back(secondsOf([&work] { work.redo(); }));
  core::BenchmarkPoint point;
  point.scene = field.scene;
  point.setting["strokes"] = std::to_string(count);
  point.seconds = median(undo);
  point.error = static_cast<double>(volume::differentVoxels(before, work.mask()));
  point.errorUnit = "voxels that differ after undo and redo";
  point.extra["slowest_undo_ms"] = 1e3 * *std::max_element(undo.begin(), undo.end());
  point.extra["redo_ms"] = 1e3 * median(redo);
  point.extra["drill_off_ms"] = 1e3 * drillOff;
  point.extra["memory_mb"] = static_cast<double>(work.historyBytes()) / 1e6;
  point.extra["disk_mb"] = static_cast<double>(packedBytes(work)) / 1e6;
  point.extra["kb_a_stroke"] =
      static_cast<double>(packedBytes(work)) / 1e3 / static_cast<double>(count);
  return point;
}

} // namespace

core::BenchmarkReport runHistoryBenchmark(bool quick, const core::Progress& progress)
{
  const int n = quick ? 256 : 512;
  std::vector<std::size_t> counts{1, 3, 10, 30, 100, 300, 1000};
  if (quick)
    counts = {1, 10, 30};
  const core::GridGeometry grid({n, n, n}, Vector3d::Constant(kVoxel), Vector3d::Zero());
  core::BenchmarkReport report{
      "history", "Undo of a stroke, mask of " + std::to_string(n) + "^3 voxels of 0.15 mm", {}};

  // The peer copies back the mask as it was. One copy is used for all.
  const volume::Volume<std::uint16_t> copy(grid, volume::CutMask::kUntouched);
  volume::Volume<std::uint16_t> whole(grid, std::uint16_t{0});
  std::vector<double> copying;
  for (int round = 0; round < 5; ++round)
    copying.push_back(
        secondsOf([&] { std::copy(copy.data(), copy.data() + copy.size(), whole.data()); }));

  for (const Field& field : kFields)
  {
    Dissection work(grid);
    double drillOff = 0.0;
    for (const std::size_t count : counts)
    {
      if (count > field.most)
        break;
      while (work.strokes().size() < count)
      {
        progress.report(static_cast<double>(work.strokes().size()) /
                            static_cast<double>(counts.back()),
                        "drilling");
        drill(work, field.start(work.strokes().size(), kVoxel * (n - 1)));
        drillOff = std::max(drillOff, secondsOf([&work] { work.endStroke(); }));
      }
      report.points.push_back(measure(work, field, drillOff));
      report.points.back().isDefault = field.isDefault && count == counts.back();
      if (!field.isDefault)
        continue;
      core::BenchmarkPoint peer;
      peer.peer = "a copy of the mask for each stroke";
      peer.scene = field.scene;
      peer.setting["strokes"] = std::to_string(count);
      peer.seconds = median(copying);
      peer.errorUnit = report.points.back().errorUnit;
      peer.extra["memory_mb"] = static_cast<double>(copy.size() * 2 * count) / 1e6;
      peer.extra["disk_mb"] = peer.extra["memory_mb"];
      report.points.push_back(peer);
    }
    // Undo all, then redo all.
    const volume::CutMask drilled = std::as_const(work).mask();
    History start = work.history();
    while (start.undo())
    {
    }
    const History end = work.history();
    core::BenchmarkPoint all;
    all.scene = field.scene;
    all.setting["strokes"] = std::to_string(work.strokes().size()) + " at once";
    all.errorUnit = report.points.back().errorUnit;
    all.seconds = secondsOf([&] { work.follow(start); });
    all.error = std::as_const(work).mask().untouched() ? 0.0 : 1e9;
    all.extra["redo_ms"] = 1e3 * secondsOf([&] { work.follow(end); });
    all.error += static_cast<double>(volume::differentVoxels(drilled, work.mask()));
    report.points.push_back(all);
  }
  return report;
}

} // namespace petrous::dissection
