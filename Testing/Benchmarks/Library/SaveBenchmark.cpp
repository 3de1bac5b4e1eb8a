#include "SaveBenchmark.h"

#include <algorithm>
#include <chrono>

#include "MaskComparison.h"
#include "petrous/Imaging/NrrdFile.h"
#include "petrous/Library/Library.h"

namespace petrous::library
{

namespace
{

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

double median(std::vector<double> values)
{
  std::nth_element(values.begin(), values.begin() + values.size() / 2, values.end());
  return values[values.size() / 2];
}

std::uintmax_t bytesBelow(const fs::path& folder)
{
  std::uintmax_t sum = 0;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    if (entry.is_regular_file())
      sum += entry.file_size();
  return sum;
}

} // namespace

core::BenchmarkReport runSaveBenchmark(const fs::path& work, bool quick,
                                       const core::Progress& progress)
{
  const int n = quick ? 128 : 512;
  const int strokes = quick ? 5 : 15;
  const std::string scene = std::to_string(n) + "^3 of 0.15 mm, strokes of 10 mm with a 4 mm burr";
  const core::GridGeometry grid({n, n, n}, Eigen::Vector3d::Constant(0.15),
                                Eigen::Vector3d::Zero());
  scene::Case value;
  value.name = "bench";
  value.ct.name = "ct";
  value.ct.geometry = grid;
  value.ct.volume = std::make_shared<const volume::IntensityVolume>(
      std::make_shared<const volume::Volume<std::int16_t>>(grid, std::int16_t{1500}));
  value.ct.range = value.ct.volume.get()->range();
  Library library(work / "library");
  library.save(value);
  library.loadDissection(value);

  std::vector<double> seconds, written;
  for (int s = 0; s < strokes; ++s)
  {
    progress.report(static_cast<double>(s) / strokes, "saving strokes");
    value.dissection.beginStroke({});
    const double edge = 0.15 * (n - 1);
    const Eigen::Vector3d start(0.2 * edge, edge * (s + 1.0) / (strokes + 1.0), 0.5 * edge);
    for (int step = 0; step < 100; ++step)
    {
      const Eigen::Vector3d way(0.1, 0.0, 0.0);
      value.dissection.cut({start + step * way, start + (step + 1) * way, 2.0});
    }
    value.dissection.endStroke();
    const auto before = bytesBelow(work / "library");
    const auto from = Clock::now();
    library.save(value);
    seconds.push_back(std::chrono::duration<double>(Clock::now() - from).count());
    written.push_back(static_cast<double>(bytesBelow(work / "library") - before) +
                      static_cast<double>(fs::file_size(work / "library/cases/bench.json")));
  }

  const auto from = Clock::now();
  imaging::writeRawNrrd(work / "whole.nrrd", value.dissection.mask().dense());
  const double wholeSeconds = std::chrono::duration<double>(Clock::now() - from).count();

  scene::Case again = library.open("bench");
  library.loadDissection(again);
  core::BenchmarkPoint ours;
  ours.scene = scene;
  ours.isDefault = true;
  ours.seconds = median(seconds);
  ours.error = static_cast<double>(
      volume::differentVoxels(value.dissection.mask(), again.dissection.mask()));
  ours.errorUnit = "voxels that differ after reopening";
  ours.extra["slowest_ms"] = 1e3 * *std::max_element(seconds.begin(), seconds.end());
  ours.extra["written_kb"] = median(written) / 1e3;
  core::BenchmarkPoint whole;
  whole.scene = scene;
  whole.seconds = wholeSeconds;
  whole.errorUnit = ours.errorUnit;
  whole.peer = "mask written whole";
  whole.extra["written_kb"] = static_cast<double>(fs::file_size(work / "whole.nrrd")) / 1e3;
  return {"save", "Saving a case after a stroke", {ours, whole}};
}

} // namespace petrous::library
