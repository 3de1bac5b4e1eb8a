#include <algorithm>
#include <ctime>
#include <fstream>
#include <optional>

#include "CaseJson.h"
#include "Commands.h"
#include "DrillLog.h"
#include "Numbers.h"
#include "petrous/Dissection/BurrName.h"
#include "petrous/Dissection/ToolPath.h"
#include "petrous/Presenters/CasePicture.h"
#include "petrous/Presenters/PathDrill.h"

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
  std::string mode = "6dof", log;
  std::optional<double> thrust;
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

presenters::PathDrill::Options toolFrom(const Options& options)
{
  presenters::PathDrill::Options result;
  result.tool.burr = burrFrom(options);
  if (options.mode != "6dof" && options.mode != "3dof")
    throw UsageError("--mode: '6dof' or '3dof', not '" + options.mode + "'");
  result.tool.mode = options.mode == "3dof" ? presenters::TouchTool::Mode::ThreeDof
                                            : presenters::TouchTool::Mode::SixDof;
  if (options.thrust && !(*options.thrust > 0.0 && *options.thrust <= 20.0))
    throw UsageError("--thrust: must lie above 0 and within 20 N");
  result.thrust = options.thrust;
  return result;
}

// The hardest that any tick was.
struct Peaks
{
  double force = 0.0;       // N
  double torque = 0.0;      // N mm
  double penetration = 0.0; // mm

  void add(const simulation::TickRecord& record)
  {
    const haptics::Wrench wrench = record.wrench.wrench();
    force = std::max(force, wrench.linear.norm());
    torque = std::max(torque, wrench.angular.norm());
    penetration = std::max(penetration, record.penetration);
  }
};

void drill(const Context& context, const Options& options)
{
  presenters::PathDrill::Options tool = toolFrom(options);
  std::ifstream file = openForReading(options.path);
  const auto path = dissection::ToolPath::read(file, options.path);

  library::Library library = context.openLibrary();
  scene::Case value = library.open(options.caseName);
  library.loadDissection(value);
  tool.camera = presenters::currentCamera(value);
  const core::Progress progress = context.progress();
  presenters::TouchScene touch(value, progress);
  presenters::PathDrill session(value, touch, tool);
  std::optional<DrillLog> log;
  if (!options.log.empty())
    log.emplace(options.log, value, touch);

  const std::size_t before = value.applied;
  TickTimes cpu, wall;
  Peaks peaks;
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
              const simulation::TickRecord& record = session.feel(tick);
              cpu.add(threadSeconds() - cpuStart);
              wall.add(wallSeconds() - wallStart);
              session.cut(tick);
              peaks.add(record);
              if (log)
                log->add(record);
            });
  session.end();
  if (log)
    log->close();
  const std::size_t strokes = value.applied - before;
  if (strokes > 0)
    library.save(value, progress.part(0.9, 1.0));
  else
    context.remark("the path cut nothing; the case is as it was");
  if (session.ticksInside() > 0)
    context.remark("the tool stood in tissue for " + std::to_string(session.ticksInside()) +
                   " ticks: there nothing is felt, and the drill takes what the burr sweeps");

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
                {"max_penetration_mm", peaks.penetration},
                {"max_force_n", peaks.force},
                {"max_torque_nmm", peaks.torque},
                {"ticks_inside", session.ticksInside()},
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
      app, "drill",
      "Play a tool path: the tool is held by the tissue, and the drill takes what it is pressed on",
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
  command->add_option("--mode", options->mode,
                      "6dof: burr, shaft and handpiece; 3dof: the burr alone (6dof)");
  command
      ->add_option("--thrust", options->thrust,
                   "Press the tool on the surface with so many newtons; the path gives place and "
                   "heading")
      ->type_name("N");
  command
      ->add_option("--log", options->log,
                   "One row a tick: device, tool, force, contact, volume removed")
      ->type_name("F.csv");
}

} // namespace petrous::cli
