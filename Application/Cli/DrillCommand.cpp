#include <algorithm>
#include <ctime>
#include <fstream>

#include "CaseJson.h"
#include "Commands.h"
#include "Numbers.h"
#include "petrous/Dissection/BurrName.h"
#include "petrous/Dissection/ToolPath.h"
#include "petrous/Presenters/CasePicture.h"
#include "petrous/Presenters/DrillSession.h"

namespace petrous::cli
{

namespace
{

struct Options
{
  std::string caseName, path, kind = "cutting";
  double diameter = 4.0;
  double rpm = 60000.0;
  double rate = 1000.0;
  std::string mode, thrust, log;
};

double threadSeconds()
{
  std::timespec time{};
  ::clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

double wallSeconds()
{
  std::timespec time{};
  ::clock_gettime(CLOCK_MONOTONIC, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

// Durations of single ticks, in microseconds.
class TickTimes
{
public:
  void add(double seconds) { m_micros.push_back(static_cast<float>(1e6 * seconds)); }
  nlohmann::json json()
  {
    std::sort(m_micros.begin(), m_micros.end());
    const auto at = [this](double share)
    {
      const auto n = static_cast<std::size_t>(share * static_cast<double>(m_micros.size() - 1));
      return m_micros.empty() ? 0.0 : double{m_micros[n]};
    };
    return {{"p50", at(0.5)}, {"p99", at(0.99)}, {"p999", at(0.999)}, {"max", at(1.0)}};
  }

private:
  std::vector<float> m_micros;
};

dissection::Burr burrFrom(const Options& options)
{
  dissection::Burr burr;
  const auto kind = dissection::parseBurrKind(options.kind);
  if (!kind)
    throw UsageError("--burr: 'cutting' or 'diamond', not '" + options.kind + "'");
  if (!(options.diameter >= 0.1 && options.diameter <= 20.0))
    throw UsageError("--diameter: must lie within 0.1 to 20 mm");
  if (!(options.rpm >= 0.0 && options.rpm <= 200000.0))
    throw UsageError("--rpm: must lie within 0 to 200000");
  if (!(options.rate >= 1.0 && options.rate <= 100000.0))
    throw UsageError("--tick-hz: must lie within 1 to 100000");
  burr.kind = *kind;
  burr.diameter = options.diameter;
  burr.rpm = options.rpm;
  return burr;
}

void drill(const Context& context, const Options& options)
{
  if (!options.mode.empty())
    notBuiltYet("--mode");
  if (!options.thrust.empty())
    notBuiltYet("--thrust");
  if (!options.log.empty())
    notBuiltYet("--log");
  const dissection::Burr burr = burrFrom(options);
  std::ifstream file = openForReading(options.path);
  const auto path = dissection::ToolPath::read(file, options.path);

  library::Library library = context.openLibrary();
  scene::Case value = library.open(options.caseName);
  library.loadDissection(value);
  presenters::DrillSession session(value);
  const auto camera = presenters::currentCamera(value);
  const core::Progress progress = context.progress();

  const std::size_t before = value.applied;
  TickTimes cpu, wall;
  std::size_t ticks = 0;
  const double start = path.samples().front().time;
  const double length = std::max(path.samples().back().time - start, 1e-9);
  path.play(options.rate,
            [&](const dissection::ToolSample& tick)
            {
              if (ticks++ % 256 == 0)
                progress.report(0.9 * (tick.time - start) / length, "drilling");
              const double cpuStart = threadSeconds();
              const double wallStart = wallSeconds();
              if (tick.drill && !session.drilling())
                session.begin(burr, presenters::utcNow(), tick.time, camera);
              // At drill-off the way since the last tick was still drilled.
              session.moveTo(tick.pose.translation(), tick.time);
              cpu.add(threadSeconds() - cpuStart);
              wall.add(wallSeconds() - wallStart);
              if (!tick.drill && session.drilling())
                session.end();
            });
  session.end();
  const std::size_t strokes = value.applied - before;
  if (strokes > 0)
    library.save(value, progress.part(0.9, 1.0));
  else
    context.remark("the path cut nothing; the case is as it was");

  double removed = 0.0;
  std::size_t undoBytes = 0;
  std::map<std::string, double> touched;
  for (std::size_t n = value.applied - strokes; n < value.applied; ++n)
  {
    removed += value.strokes[n].info.removed;
    undoBytes += value.strokes[n].bytes;
    for (const auto& structure : value.strokes[n].info.structures)
      touched[structure.name] += structure.volume;
  }
  nlohmann::json structures = nlohmann::json::array();
  for (const auto& [name, volume] : touched)
    structures.push_back({{"label", name}, {"volume_mm3", volume}});
  context.say(std::to_string(strokes) + (strokes == 1 ? " stroke, " : " strokes, ") +
              fixed(removed, 2) + " mm3 removed in " + std::to_string(ticks) + " ticks");
  for (const auto& [name, volume] : touched)
    context.say("  of '" + name + "': " + fixed(volume, 2) + " mm3");
  context.give({{"case", value.name},
                {"ticks", ticks},
                {"strokes", strokes},
                {"removed_mm3", removed},
                {"structures_touched", std::move(structures)},
                {"undo_bytes", undoBytes},
                {"tick_us", cpu.json()},
                {"tick_wall_us", wall.json()},
                {"resources", residentResources(value)}});
}

} // namespace

void addDrillCommand(CLI::App& app, Context& context)
{
  auto options = std::make_shared<Options>();
  CLI::App* command = context.addCommand(
      app, "drill", "Play a tool path: what the burr sweeps with the drill on is cut",
      [options, &context] { drill(context, *options); });
  command->add_option("CASE", options->caseName)->required();
  command
      ->add_option("--path", options->path,
                   "CSV: t_s,x_mm,y_mm,z_mm,qw,qx,qy,qz,drill; patient LPS")
      ->type_name("F.csv")
      ->required();
  command->add_option("--burr", options->kind, "cutting or diamond (cutting)");
  command->add_option("--diameter", options->diameter, "Of the burr, mm (4)");
  command->add_option("--rpm", options->rpm, "Spindle speed, turns a minute (60000)");
  command->add_option("--tick-hz", options->rate, "Ticks a second of simulated time (1000)");
  // In the contract, not built yet: refused when asked for, not offered.
  command->add_option("--mode", options->mode)->group("");
  command->add_option("--thrust", options->thrust)->group("");
  command->add_option("--log", options->log)->group("");
}

} // namespace petrous::cli
