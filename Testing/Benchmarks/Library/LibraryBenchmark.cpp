#include "LibraryBenchmark.h"

#include <algorithm>
#include <chrono>
#include <cstring>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "ChildProcess.h"
#include "petrous/Core/OutputFile.h"
#include "petrous/Core/SplitMix64.h"
#include "petrous/Library/Archive.h"
#include "petrous/Library/Library.h"

namespace petrous::library
{

namespace
{

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;
using registration::processorSeconds;
using registration::runProcess;

double median(std::vector<double> values)
{
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

std::shared_ptr<const volume::Volume<std::int16_t>> layeredBall(int edge)
{
  auto image = std::make_shared<volume::Volume<std::int16_t>>(core::GridGeometry(
      {edge, edge, edge}, Eigen::Vector3d::Constant(0.3), Eigen::Vector3d::Zero()));
  std::uint64_t state = 5;
  const double half = 0.5 * (edge - 1);
  for (int k = 0; k < edge; ++k)
    for (int j = 0; j < edge; ++j)
      for (int i = 0; i < edge; ++i)
      {
        const double r = Eigen::Vector3d(i - half, j - half, k - half).norm() / half;
        const double tissue = r > 0.9 ? -1000.0 : r > 0.85 ? 60.0 : r > 0.7 ? 1100.0 : 35.0;
        double noise = -6.0; // of twelve uniform numbers: nearly normal
        for (int n = 0; n < 3; ++n)
        {
          const std::uint64_t bits = core::splitMix64(state++);
          for (int part = 0; part < 4; ++part)
            noise += static_cast<double>(bits >> 16 * part & 0xffff) / 65536.0;
        }
        image->at(i, j, k) = static_cast<std::int16_t>(std::lround(tissue + 15.0 * noise));
      }
  return image;
}

double differentVoxels(const scene::Case& a, const scene::Case& b)
{
  using Voxels = std::shared_ptr<const volume::Volume<std::int16_t>>;
  const auto& one = *std::get<Voxels>(a.ct.volume.get()->voxels());
  const auto& other = *std::get<Voxels>(b.ct.volume.get()->voxels());
  double different = 0.0;
  for (std::size_t n = 0; n < one.size(); ++n)
    different += one.data()[n] != other.data()[n] ? 1.0 : 0.0;
  return different;
}

struct Timed
{
  double seconds = 0.0;
  double processor = 0.0; ///< user and system time of all threads
};

class Rounds
{
public:
  explicit Rounds(int count)
    : m_count(count)
  {
  }

  Timed own(const std::function<void()>& work) const
  {
    std::vector<double> seconds, processor;
    for (int n = 0; n < m_count; ++n)
    {
      const double before = processorSeconds();
      const Clock::time_point start = Clock::now();
      work();
      seconds.push_back(std::chrono::duration<double>(Clock::now() - start).count());
      processor.push_back(processorSeconds() - before);
    }
    return {median(seconds), median(processor)};
  }

  /// Zero seconds: it is not installed, or failed.
  Timed process(const std::vector<std::string>& words, const fs::path& output) const
  {
    std::vector<double> seconds, processor;
    for (int n = 0; n < m_count; ++n)
    {
      const auto times = runProcess(words, output);
      if (times.status != 0)
        return {};
      seconds.push_back(times.seconds);
      processor.push_back(times.processorSeconds);
    }
    return {median(seconds), median(processor)};
  }

private:
  int m_count;
};

core::BenchmarkPoint pointOf(const std::string& scene, const std::string& peer, const Timed& timed,
                             double inputMb)
{
  core::BenchmarkPoint point;
  point.scene = scene;
  point.peer = peer;
  point.seconds = timed.seconds;
  point.extra["mb_per_second"] = inputMb / timed.seconds;
  if (timed.processor > 0.0)
    point.extra["mb_per_core_second"] = inputMb / timed.processor;
  return point;
}

double megabytes(const fs::path& file)
{
  return static_cast<double>(fs::file_size(file)) / 1e6;
}

} // namespace

core::BenchmarkReport runLibraryBenchmark(const fs::path& work, bool quick,
                                          const core::Progress& progress)
{
  const int edge = quick ? 128 : 512;
  const std::size_t cases = quick ? 300 : 10000;
  const Rounds rounds(quick ? 1 : 3);
  core::BenchmarkReport report{"library", "Archive, restore, verify and lists of a library", {}};
  const std::string image = "CT of " + std::to_string(edge) + "^3";

  Library library(work / "library");
  scene::Case value;
  value.name = "ear";
  value.ct.name = "ct";
  const auto voxels = layeredBall(edge);
  value.ct.geometry = voxels->geometry();
  value.ct.volume = std::make_shared<const volume::IntensityVolume>(voxels);
  value.ct.range = value.ct.volume.get()->range();
  library.save(value);
  const scene::Case saved = library.open("ear");
  const fs::path object = work / "library/objects" / saved.ct.object;
  const double inputMb = megabytes(object);

  // Archive ---------------------------------------------------------------------------------------
  const fs::path archive = work / "ear.petrous";
  const std::string archiving = "archive, " + image;
  const std::string mixed = "by samples";
  for (const std::optional<int> level : {std::optional<int>(), {1}, {2}, {3}, {4}, {6}, {9}, {12}})
  {
    progress.report(0.05 * level.value_or(0), "archiving");
    ArchiveOptions options;
    options.level = level;
    core::BenchmarkPoint point = pointOf(
        archiving, "", rounds.own([&] { archiveCase(library, "ear", archive, options); }), inputMb);
    point.setting["level"] = level ? std::to_string(*level) : mixed;
    point.isDefault = !level;
    point.extra["mb"] = megabytes(archive);
    Library other(work / "other");
    restoreCase(other, archive);
    point.error = differentVoxels(saved, other.open("ear"));
    point.errorUnit = "voxels that differ";
    report.points.push_back(std::move(point));
    fs::remove_all(work / "other");
  }
  const fs::path packed = work / "packed";
  const struct
  {
    const char* name;
    const char* level;
    std::vector<std::string> words;
    std::vector<std::string> back;
  } kPeers[] = {
      {"gzip", "6", {"gzip", "-6", "-c", object.string()}, {"gzip", "-dc", packed.string()}},
      {"zip", "6", {"zip", "-6", "-q", "-", object.string()}, {"unzip", "-p", packed.string()}},
      {"tar --zstd",
       "3",
       {"tar", "--zstd", "-cf", "-", object.string()},
       {"tar", "--zstd", "-xOf", packed.string()}}};
  std::vector<core::BenchmarkPoint> restored;
  for (const auto& peer : kPeers)
  {
    progress.report(0.7, "peers");
    const Timed there = rounds.process(peer.words, packed);
    if (there.seconds == 0.0)
    {
      report.machine[peer.name] = "not installed, or it failed";
      continue;
    }
    core::BenchmarkPoint point = pointOf(archiving, peer.name, there, inputMb);
    point.setting["level"] = peer.level;
    point.errorUnit = "voxels that differ";
    point.extra["mb"] = megabytes(packed);
    report.points.push_back(std::move(point));
    core::BenchmarkPoint back =
        pointOf("restore, " + image, peer.name, rounds.process(peer.back, work / "back"), inputMb);
    back.setting["level"] = peer.level;
    back.errorUnit = "voxels that differ";
    restored.push_back(std::move(back));
  }

  // Restore ---------------------------------------------------------------------------------------
  archiveCase(library, "ear", archive);
  double different = 0.0;
  core::BenchmarkPoint restore = pointOf("restore, " + image, "",
                                         rounds.own(
                                             [&]
                                             {
                                               fs::remove_all(work / "other");
                                               Library other(work / "other");
                                               restoreCase(other, archive);
                                             }),
                                         inputMb);
  different = differentVoxels(saved, Library(work / "other").open("ear"));
  restore.setting["level"] = mixed;
  restore.isDefault = true;
  restore.error = different;
  restore.errorUnit = "voxels that differ";
  report.points.push_back(std::move(restore));
  report.points.insert(report.points.end(), restored.begin(), restored.end());

  // Verify ----------------------------------------------------------------------------------------
  progress.report(0.8, "verifying");
  std::size_t damaged = 0;
  core::BenchmarkPoint verify =
      pointOf("verify, " + image, "",
              rounds.own([&] { damaged = library.verify().damaged.size(); }), inputMb);
  verify.isDefault = true;
  verify.error = static_cast<double>(damaged);
  verify.errorUnit = "objects found damaged";
  report.points.push_back(verify);
  const Timed sums = rounds.process({"sha256sum", object.string()}, work / "sums");
  if (sums.seconds > 0.0)
  {
    core::BenchmarkPoint point = pointOf("verify, " + image, "sha256sum", sums, inputMb);
    point.errorUnit = verify.errorUnit;
    report.points.push_back(std::move(point));
  }

  // Lists -----------------------------------------------------------------------------------------
  Library many(work / "many");
  scene::Case one;
  one.name = "case 0";
  one.ct.name = "ct";
  const auto small = layeredBall(16);
  one.ct.geometry = small->geometry();
  one.ct.volume = std::make_shared<const volume::IntensityVolume>(small);
  one.ct.range = one.ct.volume.get()->range();
  many.save(one);
  for (std::size_t n = 1; n < cases; ++n)
    fs::copy_file(work / "many/cases/case 0.json",
                  work / "many/cases" / ("case " + std::to_string(n) + ".json"));
  progress.report(0.9, "listing");
  many.repair(); // fills the index, which a copied manifest is not in
  std::size_t found = 0;
  const std::string scene = std::to_string(cases) + " cases";
  const auto addList =
      [&](const char* what, const std::function<std::size_t()>& count, std::size_t wanted)
  {
    core::BenchmarkPoint point;
    point.scene = what + (", " + scene);
    point.isDefault = true;
    point.seconds = rounds.own([&] { found = count(); }).seconds;
    point.error =
        static_cast<double>(std::max(found, wanted)) - static_cast<double>(std::min(found, wanted));
    point.errorUnit = "cases missing or too many";
    report.points.push_back(std::move(point));
  };
  addList(
      "list", [&] { return many.list().size(); }, cases);
  addList(
      "search", [&] { return many.search(std::to_string(cases - 1)).size(); }, 1);
  return report;
}

} // namespace petrous::library
