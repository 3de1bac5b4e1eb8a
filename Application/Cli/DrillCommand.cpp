#include <algorithm>
#include <limits>
#include <optional>

#include "CaseWarnings.h"
#include "Commands.h"
#include "DrillReport.h"
#include "Numbers.h"
#include "ToolOptions.h"
#include "petrous/Core/InputFile.h"
#include "petrous/Core/NumberText.h"
#include "petrous/Dissection/BurrName.h"
#include "petrous/Dissection/ToolPath.h"
#include "petrous/Library/Journal.h"
#include "petrous/Presenters/CaseBuilder.h"
#include "petrous/Presenters/CasePicture.h"
#include "petrous/Presenters/InstrumentFile.h"
#include "petrous/Presenters/RecordingPlayer.h"
#include "petrous/Session/PathDrill.h"

namespace petrous::cli
{

namespace
{

struct Options
{
  std::string caseName, path, burr = "cutting";
  double diameter = 4.0;
  double rpm = 60000.0;
  double rate = 1000.0;
  std::string mode = "6dof", log, record, replay, materials, burrs;
  ToolOptions tool;
  bool isCaseTool = false; // the instrument that the case keeps
  std::optional<double> thrust;
  bool withoutDamaged = false;
  const CLI::App* command = nullptr;

  bool given(const char* name) const { return command->count(name) > 0; }
};

// All but which burr of the catalogue it is.
session::PathDrill::Options toolFrom(const Options& options)
{
  session::PathDrill::Options result;
  result.tool.burr.diameter = options.diameter;
  result.tool.burr.rpm = options.rpm;
  result.tool.mode = options.mode == "3dof" ? session::TouchTool::Mode::ThreeDof
                                            : session::TouchTool::Mode::SixDof;
  result.thrust = options.thrust;
  result.tool.coupling = session::couplingFor(result.tool.mode, result.thrust);
  return result;
}

void checkTool(const Options& options, const session::RecordingSetup& recorded)
{
  // Checks only options given explicitly.
  const auto refuse = [&](const std::string& asked)
  {
    throw core::InvalidParameter(options.replay + ": was recorded with a " + toString(recorded) +
                                 ", not with " + asked);
  };
  const session::PathDrill::Options tool = toolFrom(options);
  const bool three = tool.tool.mode == session::TouchTool::Mode::ThreeDof;
  if (options.given("--burr") && options.burr != nameOf(recorded.burr))
    refuse("--burr " + options.burr);
  if (options.given("--diameter") && tool.tool.burr.diameter != recorded.burr.diameter)
    refuse("--diameter " + fixed(options.diameter, 2));
  if (options.given("--rpm") && tool.tool.burr.rpm != recorded.burr.rpm)
    refuse("--rpm " + fixed(options.rpm, 0) + " (it turned at " + fixed(recorded.burr.rpm, 0) +
           ")");
  if (options.given("--mode") && three != (recorded.degrees == 3))
    refuse("--mode " + options.mode);
}

// Files given by an option override those of the library.
dissection::Catalogues cataloguesFrom(const Options& options, const std::filesystem::path& folder)
{
  if (options.materials.empty() && options.burrs.empty())
    return dissection::Catalogues::in(folder);
  return dissection::Catalogues::read(options.materials, options.burrs);
}

presenters::LeftOut openCase(const Context& context, library::Library& library,
                             const Options& options, scene::Case& value,
                             const core::Progress& progress)
{
  library.refuseWhereDrilled(options.caseName); // before minutes of reading
  value = library.open(options.caseName);
  library.loadDissection(value);
  value.ct.volume.get();
  library.checkVoxels(value, progress);
  auto leftOut = leaveOutDamaged(context, library, value, options.withoutDamaged);
  warnMissingPlaces(context, value);
  warnOutdated(context, value);
  return leftOut;
}

void save(const Context& context, library::Library& library, scene::Case& value,
          const DrillReport& report, const library::SavedState& opened, library::Journal& journal,
          const presenters::LeftOut& leftOut, const core::Progress& progress)
{
  leftOut.putBack(value);
  if (!report.changed())
    return context.warn("nothing was removed; the case is unchanged");
  try
  {
    const std::string words = library.saveDrilled(value, opened, progress.part(0.9, 1.0));
    if (!words.empty())
      context.warn(words);
  }
  catch (const core::CancelledError&)
  {
    throw;
  }
  catch (const core::Error& error)
  {
    journal.leave();
    throw core::Error(error.fault(), std::string(error.what()) +
                                         "; what was drilled is kept in the case's journal and "
                                         "comes back when the case is opened next");
  }
  catch (...) // such as out of memory
  {
    journal.leave();
    throw;
  }
}

double armAt(const session::PathDrill& session, const session::TickRecord& record)
{
  return record.drill ? session.removal().arm()
                      : session::BurrRemovalModel::armOf(session.radius(), record.elevation, 0.0);
}

nlohmann::json instrumentJson(const session::Instrument& instrument)
{
  const auto bounds = instrument.surface->bounds();
  return {{"file", instrument.name},
          {"points", instrument.shell->points.size()},
          {"tip_sampling_error_mm", instrument.shell->burrSpacing},
          {"sampling_error_mm", instrument.shell->spacing},
          {"length_mm", static_cast<double>(bounds[1].z() - bounds[0].z())}};
}

void printBalance(const Context& context, session::PathDrill& session, nlohmann::json& answer)
{
  const session::RemovalBalance balance = session.removal().balance();
  context.print("the laws predict " + fixed(balance.predicted, 2) +
                " mm3: " + fixed(balance.removed, 2) + " removed, " + fixed(balance.owed, 2) +
                " owed, " + fixed(balance.forfeited, 2) + " forfeited");
  answer["predicted_mm3"] = balance.predicted;
  answer["owed_mm3"] = balance.owed;
  answer["forfeited_mm3"] = balance.forfeited;
  answer["swept_mm3"] = session.swept();
}

// What is drilled survives a kill; a command that ends otherwise leaves no journal.
std::unique_ptr<library::Journal> journalOf(const library::Library& library,
                                            const scene::Case& value, session::TouchScene& touch)
{
  const auto measured = [&touch](const dissection::Dissection& work)
  {
    dissection::StrokeInfo info = work.openInfo();
    auto removed = touch.drill().measure(work);
    info.removed = removed.total;
    info.structures = std::move(removed.structures);
    return info;
  };
  auto journal = std::make_unique<library::Journal>(library, value, measured);
  journal->claim();
  return journal;
}

void play(const Context& context, const Options& options)
{
  session::PathDrill::Options tool = toolFrom(options);
  std::ifstream file = core::openInput(options.path, kLargestInput);
  const auto path = dissection::ToolPath::read(file, options.path);
  const core::Progress progress = context.progress();
  const auto takeUp =
      [&](presenters::InstrumentSurface surface, const std::string& axis, const std::string& name)
  {
    presenters::LoadedInstrument loaded =
        presenters::makeInstrument(std::move(surface), axis, progress);
    for (const std::string& note : loaded.notes)
      context.warn(name + ": " + note);
    tool.tool.instrument = std::move(loaded.instrument);
  };
  if (!options.tool.file.empty())
  {
    auto [surface, axis] = options.tool.read(progress.part(0.0, 0.5));
    takeUp(std::move(surface), axis, options.tool.file);
  }
  const auto& instrument = tool.tool.instrument;

  library::Library library = context.openLibrary();
  tool.catalogues = cataloguesFrom(options, library.folder());
  setModel(tool.tool.burr, burrNamed(options.burr, tool.catalogues.burrs));
  scene::Case value;
  const auto leftOut = openCase(context, library, options, value, progress);
  if (options.isCaseTool)
  {
    if (!value.view.instrument)
      throw core::InvalidParameter("case '" + value.name +
                                   "' keeps no instrument; give one with --tool, or keep one with "
                                   "'petrous view --instrument'");
    try
    {
      takeUp(presenters::surfaceOf(*value.view.instrument), value.view.instrument->axis,
             "the instrument of case '" + value.name + "'");
    }
    catch (const library::StructureError& error) // --without-damaged is no way round
    {
      throw library::LibraryError(error.reason, error.what());
    }
  }
  const library::SavedState opened = value;
  warnOfCurrentView(context, value); // which each stroke keeps
  tool.camera = presenters::currentCamera(value);
  tool.recording = options.record;
  session::TouchScene touch(value, progress, 0, true);
  const auto journal = journalOf(library, value, touch);
  session::PathDrill session(value, touch, tool);
  const presenters::MeasuredTool measured =
      instrument ? presenters::MeasuredTool(*instrument->shell)
                 : presenters::MeasuredTool(0.5 * tool.tool.burr.diameter);
  DrillReport report(value, touch, measured, options.log, context.json());

  std::size_t ticks = 0;
  const double start = path.samples().front().time;
  const double length = std::max(path.samples().back().time - start, 1e-9);
  path.play(
      options.rate,
      [&](const dissection::ToolSample& tick)
      {
        const bool isFirst = ticks == 0;
        if (ticks++ % 256 == 0)
          progress.report(0.9 * (tick.time - start) / length, instrument ? "feeling" : "drilling");
        const session::TickRecord& record =
            report.feel([&]() -> const session::TickRecord& { return session.feel(tick); });
        if (isFirst && record.status == static_cast<std::uint8_t>(haptics::ProxyStatus::Inside))
          context.warn(instrument ? "the path begins in tissue: nothing is felt until the tool is "
                                    "out of it"
                                  : "the path begins in tissue: nothing is felt until the tool is "
                                    "out of it, and the drill takes what the burr sweeps");
        session.cut(tick);
        journal->follow(value.dissection);
        const session::RemovalBalance balance = session.removal().balance();
        const double arm = instrument            ? std::numeric_limits<double>::quiet_NaN()
                           : record.thrust > 0.0 ? armAt(session, record)
                                                 : 0.0;
        // Of what is swept each tick is measured for the log alone.
        const double swept = options.log.empty() ? 0.0 : session.swept();
        report.add(record, TickRemoval{arm, balance.removed + swept, balance.predicted});
      });
  session.end();
  journal->follow(value.dissection);
  report.close();
  if (!instrument)
    save(context, library, value, report, opened, *journal, leftOut, progress);

  report.print(context);
  nlohmann::json answer = report.json();
  answer["left_out"] = leftOutJson(value, leftOut);
  if (instrument)
  {
    context.print("felt with " + presenters::toString(*instrument));
    answer["instrument"] = instrumentJson(*instrument);
  }
  else
    printBalance(context, session, answer);
  if (const session::RecordingWriter* recording = session.recording())
  {
    context.print("recorded in " + options.record + ": " + std::to_string(recording->bytes()) +
                  " bytes");
    answer["recording"] = {
        {"file", options.record}, {"ticks", recording->ticks()}, {"bytes", recording->bytes()}};
  }
  context.printJson(answer);
}

void replay(const Context& context, const Options& options)
{
  core::InputFile(options.replay); // throws, naming a missing file
  session::RecordingReader reader(options.replay);
  checkTool(options, reader.setup());

  library::Library library = context.openLibrary();
  scene::Case value;
  const core::Progress progress = context.progress();
  const auto leftOut = openCase(context, library, options, value, progress);
  const library::SavedState opened = value;
  warnOfCurrentView(context, value);
  const auto camera = presenters::currentCamera(value);
  session::TouchScene touch(value, progress, reader.setup().scene.firstState, true);
  const auto journal = journalOf(library, value, touch);
  presenters::RecordingPlayer session(value, touch, reader, options.replay, camera);
  DrillReport report(value, touch, presenters::MeasuredTool(0.5 * reader.setup().burr.diameter),
                     options.log, context.json());

  std::size_t ticks = 0;
  while (session.next())
  {
    if (ticks++ % 256 == 0)
      progress.report(0.5, "playing the recording");
    const session::TickRecord& record =
        report.feel([&]() -> const session::TickRecord& { return session.feel(); });
    session.follow();
    journal->follow(value.dissection);
    report.add(record);
  }
  report.close();
  const session::RecordingReplay::Outcome& outcome = session.outcome();
  if (!outcome.warning.empty())
    context.warn(outcome.warning);
  if (outcome.equal())
    save(context, library, value, report, opened, *journal, leftOut, progress);

  report.print(context);
  nlohmann::json answer = report.json();
  answer["left_out"] = leftOutJson(value, leftOut);
  nlohmann::json first = nullptr;
  if (outcome.firstDifferent)
    first = *outcome.firstDifferent;
  answer["replay"] = {{"file", options.replay},         {"tool", toString(reader.setup())},
                      {"session", reader.setup().note}, {"equal", outcome.equal()},
                      {"complete", reader.complete()},  {"different_ticks", outcome.different},
                      {"first_different_tick", first},  {"difference", outcome.difference}};
  context.printJson(answer);
  if (!outcome.equal())
    throw core::Error(
        core::Fault::Internal,
        options.replay + ": the replay is not the recording (" + std::to_string(outcome.different) +
            " of " + std::to_string(outcome.ticks) + " ticks differ" +
            (outcome.firstDifferent ? ", first tick " + std::to_string(*outcome.firstDifferent)
                                    : std::string()) +
            "): " + outcome.difference + "; the case is as it was");
  context.print("the replay is the recording, bit for bit");
}

} // namespace

void addDrillCommand(CLI::App& app, Context& context)
{
  auto options = std::make_shared<Options>();
  CLI::App* command = context.addCommand(
      app, "drill",
      "Play a tool path or a recording with haptics and removal, and save what was drilled",
      [options, &context]
      {
        if (options->path.empty() == options->replay.empty())
          throw UsageError("drill: give either --path or --replay");
        context.refuseOverwriting({options->log, options->record},
                                  {options->path, options->replay, options->materials,
                                   options->burrs, options->tool.file});
        options->replay.empty() ? play(context, *options) : replay(context, *options);
      });
  options->command = command;
  command->add_option("CASE", options->caseName)->required();
  command
      ->add_option("--path", options->path,
                   "CSV: t_s,x_mm,y_mm,z_mm,qw,qx,qy,qz,drill; patient LPS")
      ->type_name("F.csv");
  CLI::Option* replayed =
      command
          ->add_option(
              "--replay", options->replay,
              "Instead of a path: play a recording again on its case, including removal, and "
              "compare every tick bit for bit")
          ->type_name("F.ticks");
  CLI::Option* instrument =
      addToolOptions(*command, "--tool",
                     "Instead of a burr: an instrument, a closed mesh of 1 to 300 mm (OBJ, STL, "
                     "PLY, VTP), its tip at the origin; it is felt and removes nothing",
                     options->tool)
          ->excludes(replayed);
  command
      ->add_option(
          "--burr", options->burr,
          "A burr's name in the catalogue (materials): cutting, diamond, one of other rake "
          "or grit, or of your own (cutting)")
      ->check(offers(builtInBurrs()))
      ->excludes(instrument);
  command->add_option("--diameter", options->diameter, "Diameter of the burr, mm (4)")
      ->check(within({0.1, 20.0, "mm"}))
      ->excludes(instrument);
  command->add_option("--rpm", options->rpm, "Spindle speed, revolutions per minute (60000)")
      ->check(within({0.0, 200000.0}))
      ->excludes(instrument);
  command->add_option("--tick-hz", options->rate, "Servo rate in simulated time, Hz (1000)")
      ->check(within({1.0, 100000.0}))
      ->excludes(replayed);
  command
      ->add_option("--mode", options->mode,
                   "6dof: burr, shaft and handpiece; 3dof: the burr alone (6dof)")
      ->check(oneOf({"6dof", "3dof"}))
      ->excludes(instrument);
  command
      ->add_option(
          "--thrust", options->thrust,
          "Constant-thrust mode: press the tool onto the surface with this force; the path "
          "gives position and orientation")
      ->type_name("N")
      ->check(within({0.0, 20.0, "N", true}))
      ->excludes(replayed);
  command
      ->add_option("--materials", options->materials,
                   "Material catalogue (materials.json in the library, else built in)")
      ->type_name("F.json")
      ->excludes(replayed)
      ->excludes(instrument);
  command
      ->add_option("--burrs", options->burrs,
                   "Burr catalogue (burrs.json in the library, else built in)")
      ->type_name("F.json")
      ->excludes(replayed)
      ->excludes(instrument);
  command
      ->add_option("--record", options->record, "Record every tick and every removal, for --replay")
      ->type_name("F.ticks")
      ->excludes(replayed)
      ->excludes(instrument);
  command
      ->add_option("--log", options->log,
                   "CSV with one row per tick: device, tool, force, contact, removed volume")
      ->type_name("F.csv");
  addWithoutDamaged(*command, options->withoutDamaged);
  CLI::Option* ofCase =
      command
          ->add_flag("--case-tool", options->isCaseTool,
                     "Instead of a burr: the instrument that the case keeps, as with --tool")
          ->excludes(instrument)
          ->excludes(replayed);
  for (const char* other : {"--burr", "--diameter", "--rpm", "--mode", "--materials", "--burrs",
                            "--record"}) // as with --tool
    ofCase->excludes(command->get_option(other));
}

} // namespace petrous::cli
