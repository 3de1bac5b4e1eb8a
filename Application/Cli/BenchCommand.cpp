#include <ctime>
#include <fstream>
#include <thread>

#include <unistd.h>

#include "BenchPlot.h"
#include "Commands.h"
#include "CutBenchmark.h"
#include "ImportBenchmark.h"
#include "Numbers.h"
#include "SaveBenchmark.h"

namespace petrous::cli
{

namespace
{

struct Benchmark
{
  const char* name;
  core::BenchmarkReport (*run)(const std::filesystem::path& work, bool quick,
                               const core::Progress&);
};

constexpr Benchmark kBenchmarks[] = {{"import", &imaging::runImportBenchmark},
                                     {"cut", &dissection::runCutBenchmark},
                                     {"save", &library::runSaveBenchmark}};

std::string processorName()
{
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);)
    if (line.rfind("model name", 0) == 0)
      return line.substr(line.find(':') + 2);
  return "unknown";
}

// Volumes of a benchmark, removed when it ends.
struct WorkFolder
{
  std::filesystem::path path;
  explicit WorkFolder(const std::filesystem::path& out)
    : path(out / (".work-" + std::to_string(::getpid())))
  {
    std::filesystem::create_directories(path);
  }
  ~WorkFolder()
  {
    std::error_code ignored;
    std::filesystem::remove_all(path, ignored);
  }
};

nlohmann::json reportJson(const core::BenchmarkReport& report)
{
  nlohmann::json points = nlohmann::json::array();
  for (const auto& point : report.points)
  {
    nlohmann::json setting{{"scene", point.scene}, {"default", point.isDefault}};
    for (const auto& [name, value] : point.setting)
      setting[name] = value;
    points.push_back(
        {{"setting", std::move(setting)},
         {"seconds", point.seconds},
         {"error", point.error},
         {"error_unit", point.errorUnit},
         {"peer", point.peer.empty() ? nlohmann::json(nullptr) : nlohmann::json(point.peer)},
         {"extra", point.extra}});
  }
  return {{"name", report.name},
          {"title", report.title},
          {"machine",
           {{"processor", processorName()}, {"threads", std::thread::hardware_concurrency()}}},
          {"points", std::move(points)}};
}

void bench(const Context& context, const std::string& name, const std::string& out, bool quick)
{
  std::string names;
  bool any = false;
  for (const Benchmark& benchmark : kBenchmarks)
  {
    names += (names.empty() ? "" : ", ") + std::string(benchmark.name);
    any = any || name == "all" || name == benchmark.name;
  }
  if (!any)
    throw UsageError("bench: '" + name + "' is unknown; there are: " + names + ", all");
  std::error_code error;
  std::filesystem::create_directories(out, error);
  if (error)
    throw core::Error(core::Fault::Refused, out + ": the folder cannot be made; choose another");
  nlohmann::json all = nlohmann::json::array();
  for (const Benchmark& benchmark : kBenchmarks)
  {
    if (name != "all" && name != benchmark.name)
      continue;
    const WorkFolder work(out);
    const auto report = benchmark.run(work.path, quick, context.progress());
    const auto json = reportJson(report);
    const std::filesystem::path base = std::filesystem::path(out) / report.name;
    writeTextFile(base.string() + ".json", json.dump(1) + "\n");
    writeTextFile(base.string() + ".svg", plotSvg(report));
    all.push_back(json);
    context.say(report.title);
    for (const auto& point : report.points)
    {
      std::string line =
          "  " + (point.peer.empty() ? std::string("petrous") : point.peer) + "  " + point.scene;
      for (const auto& [key, value] : point.setting)
        line += "  " + key + " " + value;
      char figures[96];
      std::snprintf(figures, sizeof figures, "  %.3f ms  error %.3g %s", 1e3 * point.seconds,
                    point.error, point.errorUnit.c_str());
      line += figures;
      for (const auto& [key, value] : point.extra)
        line += "  " + key + " " + fixed(value, 3);
      context.say(line + (point.isDefault ? "  (default)" : ""));
    }
  }
  context.give(name == "all" ? nlohmann::json{{"benchmarks", all}} : all.front());
}

} // namespace

void addBenchCommand(CLI::App& app, Context& context)
{
  struct Options
  {
    std::string name, out;
    bool quick = false;
  };
  auto options = std::make_shared<Options>();
  CLI::App* command = context.addCommand(
      app, "bench", "Benchmarks: run time against error, as JSON and SVG",
      [options, &context] { bench(context, options->name, options->out, options->quick); });
  command->add_option("NAME", options->name, "import, cut, save or all")->required();
  command->add_option("--out", options->out, "Folder for NAME.json and NAME.svg")
      ->type_name("DIR")
      ->required();
  command->add_flag("--quick", options->quick, "Smaller volumes, fewer repeats");
}

} // namespace petrous::cli
