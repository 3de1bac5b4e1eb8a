#include <algorithm>
#include <cmath>
#include <fstream>
#include <optional>
#include <set>
#include <thread>
#include <vector>

#include <unistd.h>

#include "BenchCommand.h"
#include "ChildProcess.h"
#include "CutBenchmark.h"
#include "DelaysBenchmark.h"
#include "DevicesBenchmark.h"
#include "DistanceBenchmark.h"
#include "HistoryBenchmark.h"
#include "ImportBenchmark.h"
#include "LibraryBenchmark.h"
#include "LiveServo.h"
#include "NerveBenchmark.h"
#include "NodeBenchmark.h"
#include "Numbers.h"
#include "OpenBenchmark.h"
#include "Program.h"
#include "QpBenchmark.h"
#include "RegistrationBenchmarkScenes.h"
#include "RemovalBenchmark.h"
#include "RendererBenchmark.h"
#include "SaveBenchmark.h"
#include "SegmentBenchmark.h"
#include "ServoBenchmark.h"
#include "StructuresBenchmark.h"
#include "TiltBenchmark.h"
#include "TouchBenchmark.h"
#include "TouchBenchmarkScenes.h"
#include "UndoBenchmark.h"
#include "petrous/Core/NumberText.h"
#include "petrous/Core/OutputFile.h"
#include "petrous/Rendering/RenderingError.h"

namespace petrous::cli
{

extern const char* const kCommit; // written by Packaging/cmake/WriteCommit.cmake

namespace
{

struct BenchOptions
{
  std::string name, out, data, pairs, rire, paraview;
  std::vector<std::string> parts;
  std::vector<int> edges;
  std::optional<double> seconds;
  bool quick = false;
};

constexpr char kAll[] = "all";

std::string joined(const std::vector<std::string>& names)
{
  std::string all;
  for (const std::string& name : names)
    all += (all.empty() ? "" : ", ") + name;
  return all;
}

// Those asked for; of all benchmarks, those of this one: bench refuses those of none.
std::set<std::string> partsOf(const BenchOptions& options, const std::vector<std::string>& known)
{
  std::set<std::string> parts;
  for (const std::string& part : options.parts)
    if (std::find(known.begin(), known.end(), part) != known.end())
      parts.insert(part);
    else if (options.name != kAll)
      throw UsageError("bench " + options.name + ": there is no part '" + part + "'");
  return parts;
}

struct Benchmark
{
  const char* name;
  core::BenchmarkReport (*run)(const std::filesystem::path& work, const BenchOptions&,
                               const core::Progress&);
};

constexpr Benchmark kBenchmarks[] = {
    {"import", [](const auto& work, const BenchOptions& options, const core::Progress& progress)
     { return imaging::runImportBenchmark(work, options.quick, progress); }},
    {"structures", [](const auto& work, const BenchOptions& options, const core::Progress& progress)
     { return imaging::runStructuresBenchmark(work, options.data, options.quick, progress); }},
    {"tilt", [](const auto& work, const BenchOptions& options, const core::Progress& progress)
     { return imaging::runTiltBenchmark(work, options.quick, progress); }},
    {"cut", [](const auto& work, const BenchOptions& options, const core::Progress& progress)
     { return dissection::runCutBenchmark(work, options.quick, progress); }},
    {"distance", [](const auto&, const BenchOptions& options, const core::Progress& progress)
     { return volume::runDistanceBenchmark(options.quick, progress); }},
    {"history",
     [](const auto&, const BenchOptions& options, const core::Progress& progress)
     {
       auto report = dissection::runHistoryBenchmark(options.quick, progress.part(0.0, 0.5));
       try
       {
         const auto redrawn = undoWithRedraw(options.quick, progress.part(0.5, 1.0));
         report.points.insert(report.points.end(), redrawn.begin(), redrawn.end());
       }
       catch (const rendering::RenderingError& error)
       {
         report.machine["redraw"] = error.what();
       }
       return report;
     }},
    {"save", [](const auto& work, const BenchOptions& options, const core::Progress& progress)
     { return library::runSaveBenchmark(work, options.quick, progress); }},
    {"library",
     [](const auto& work, const BenchOptions& options, const core::Progress& progress)
     {
       auto report = library::runLibraryBenchmark(work, options.quick, progress.part(0.0, 0.7));
       try
       {
         const auto opened = openToPicture(work / "open", options.quick, progress.part(0.7, 1.0));
         report.points.insert(report.points.end(), opened.begin(), opened.end());
       }
       catch (const rendering::RenderingError& error)
       {
         report.machine["first picture"] = error.what();
       }
       return report;
     }},
    {"node", [](const auto& work, const BenchOptions& options, const core::Progress& progress)
     { return network::runNodeBenchmark(work, options.quick, progress); }},
    {"qp", [](const auto&, const BenchOptions& options, const core::Progress& progress)
     { return haptics::runQpBenchmark(options.quick, progress); }},
    {"touch",
     [](const auto&, const BenchOptions& options, const core::Progress& progress)
     {
       return haptics::runTouchBenchmark(
           options.quick, progress.part(0.1, 1.0),
           touchBenchmarkScenes(options.quick, options.data, progress.part(0.0, 0.1)));
     }},
    {"servo",
     [](const auto& work, const BenchOptions& options, const core::Progress& progress)
     {
       auto report = session::runServoBenchmark(work, options.quick, progress.part(0.0, 0.1));
       const auto live = runLiveServo(options.seconds.value_or(options.quick ? 2.0 : 20.0),
                                      options.quick, options.data, progress.part(0.1, 1.0));
       report.points.insert(report.points.end(), live.begin(), live.end());
       return report;
     }},
    {"devices", [](const auto&, const BenchOptions& options, const core::Progress& progress)
     { return runDevicesBenchmark(options.quick, progress); }},
    {"delays", [](const auto& work, const BenchOptions& options, const core::Progress& progress)
     { return runDelaysBenchmark(work, options.quick, progress); }},
    {"removal", [](const auto&, const BenchOptions& options, const core::Progress& progress)
     { return session::runRemovalBenchmark(options.quick, progress); }},
    {"registration",
     [](const auto& work, const BenchOptions& options, const core::Progress& progress)
     {
       std::map<std::string, std::string> notes;
       const auto input =
           registrationScenes({options.quick, options.pairs, options.data, options.rire,
                               partsOf(options, registration::benchmarkParts()), work},
                              notes, progress.part(0.0, 0.05));
       auto report = registration::runRegistrationBenchmark(input, progress.part(0.05, 1.0));
       report.machine.insert(notes.begin(), notes.end());
       return report;
     }},
    {"nerve", [](const auto&, const BenchOptions& options, const core::Progress& progress)
     { return runNerveBenchmark(options.quick, progress); }},
    {"segment", [](const auto&, const BenchOptions& options, const core::Progress& progress)
     { return segmentation::runSegmentBenchmark(options.quick, progress); }},
    {"renderer", [](const auto& work, const BenchOptions& options, const core::Progress& progress)
     {
       return runRendererBenchmark({options.quick, options.edges, options.data,
                                    partsOf(options, rendererParts()), options.paraview,
                                    work / "paraview"},
                                   progress);
     }}};

std::string processorName()
{
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);)
    if (line.rfind("model name", 0) == 0)
      return line.substr(line.find(':') + 2);
  return "unknown";
}

// Temporary folder for benchmark volumes.
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
    if (!point.series.empty())
      setting["varied"] = point.series;
    points.push_back(
        {{"setting", std::move(setting)},
         {"seconds", point.seconds},
         {"error", std::isnan(point.error) ? nlohmann::json(nullptr) : nlohmann::json(point.error)},
         {"error_unit", point.errorUnit},
         {"peer", point.peer.empty() ? nlohmann::json(nullptr) : nlohmann::json(point.peer)},
         {"extra", point.extra}});
  }
  nlohmann::json machine{{"processor", processorName()},
                         {"threads", std::thread::hardware_concurrency()}};
  for (const auto& [name, value] : report.machine)
    machine[name] = value;
  return {{"name", report.name},
          {"title", report.title},
          {"commit", kCommit},
          {"machine", std::move(machine)},
          {"points", std::move(points)}};
}

std::string lineOf(const core::BenchmarkPoint& point)
{
  std::string line =
      "  " + (point.peer.empty() ? std::string("petrous") : point.peer) + "  " + point.scene;
  for (const auto& [key, value] : point.setting)
    line += "  " + key + " " + value;
  line += "  " + fixed(1e3 * point.seconds, 3) + " ms  error " +
          (std::isnan(point.error) ? "" : core::generalText(point.error, 3) + " ") +
          point.errorUnit;
  for (const auto& [key, value] : point.extra)
    line += "  " + key + " " + fixed(value, 3);
  return line + (point.isDefault ? "  (default)" : "");
}

// Draws the JSON files of a folder. The script needs matplotlib, which measuring does not: its
// absence is no error.
void drawPlots(const Context& context, const std::string& folder)
{
  const auto beside = programBeside("petrous-plots", ".");
  const std::string script = beside.empty() ? "petrous-plots" : beside.string();
  if (registration::runProcess({script, folder}).status != 0)
    context.warn("bench: the plots were not drawn; '" + script + " " + folder +
                 "' draws them (needs python3-matplotlib) or says what is missing");
}

std::vector<std::string> benchmarkNames()
{
  std::vector<std::string> names;
  for (const Benchmark& benchmark : kBenchmarks)
    names.emplace_back(benchmark.name);
  names.emplace_back(kAll);
  return names;
}

void bench(const Context& context, const BenchOptions& options)
{
  const std::string& name = options.name;
  const std::string& out = options.out;
  const std::vector<std::string> names = benchmarkNames();
  if (std::find(names.begin(), names.end(), name) == names.end())
    throw UsageError("bench: '" + name + "' is unknown; there are: " + joined(names));
  if (name == kAll)
    for (const std::string& part : options.parts)
    {
      const auto isOf = [&part](const std::vector<std::string>& known)
      { return std::find(known.begin(), known.end(), part) != known.end(); };
      if (!isOf(registration::benchmarkParts()) && !isOf(rendererParts()))
        throw UsageError("bench all: no benchmark has a part '" + part + "'; there are: " +
                         joined(registration::benchmarkParts()) + ", " + joined(rendererParts()));
    }
  std::error_code error;
  std::filesystem::create_directories(out, error);
  if (error)
    throw core::Error(core::Fault::Refused, out + ": the folder cannot be made; choose another");
  nlohmann::json all = nlohmann::json::array();
  for (const Benchmark& benchmark : kBenchmarks)
  {
    if (name != kAll && name != benchmark.name)
      continue;
    const WorkFolder work(out);
    const auto report = benchmark.run(work.path, options, context.progress());
    const auto json = reportJson(report);
    core::writeFile((std::filesystem::path(out) / (report.name + ".json")).string(),
                    json.dump(1) + "\n");
    all.push_back(json);
    context.print(report.title);
    for (const auto& [key, value] : report.machine)
      context.print("  " + key + ": " + value);
    for (const auto& point : report.points)
      context.print(lineOf(point));
  }
  drawPlots(context, out);
  context.printJson(name == kAll ? nlohmann::json{{"benchmarks", all}} : all.front());
}

} // namespace

void addBenchCommand(CLI::App& app, Context& context)
{
  auto options = std::make_shared<BenchOptions>();
  CLI::App* command =
      context.addCommand(app, "bench", "Benchmarks: run time against error, as JSON and SVG",
                         [options, &context] { bench(context, *options); });
  command->add_option("NAME", options->name, joined(benchmarkNames()))->required();
  command
      ->add_option("--out", options->out,
                   "Folder for NAME.json and NAME*.svg (needs python3-matplotlib)")
      ->type_name("DIR")
      ->required();
  command
      ->add_option("--data", options->data,
                   "Folder that holds a real CT, for renderer, touch, servo and registration, and "
                   "structure sets, for structures")
      ->type_name("DIR");
  command
      ->add_option("--edge", options->edges, "Voxels of the phantom's edge, for renderer (256,512)")
      ->delimiter(',')
      ->transform(wholeNumber(16, 1024));
  command
      ->add_option("--pairs", options->pairs,
                   "Folder of NAME/{fixed,moving}.nii.gz with NAME/truth.json, for registration")
      ->type_name("DIR");
  command
      ->add_option("--rire", options->rire,
                   "Folder with RIRE's patients: registration on those alone")
      ->type_name("DIR");
  command
      ->add_option("--paraview", options->paraview,
                   "pvpython of ParaView 5.11 or later, for renderer (as found in PATH)")
      ->type_name("FILE");
  command
      ->add_option("--part", options->parts,
                   "Of registration: " + joined(registration::benchmarkParts()) +
                       "; of renderer: " + joined(rendererParts()))
      ->delimiter(',');
  command
      ->add_option("--seconds", options->seconds,
                   "Length of the live session, for servo, in s (20; 2 with --quick)")
      ->check(within({0.1, 86400.0, "s"}));
  command->add_flag("--quick", options->quick, "Smaller volumes, fewer repeats");
}

} // namespace petrous::cli
