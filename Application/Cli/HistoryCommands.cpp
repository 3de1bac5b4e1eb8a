#include <cstdio>
#include <limits>
#include <map>
#include <optional>

#include "CaseJson.h"
#include "CaseWarnings.h"
#include "Commands.h"
#include "Numbers.h"
#include "ViewOptions.h"
#include "petrous/Dissection/BurrName.h"
#include "petrous/Dissection/StrokeNumber.h"
#include "petrous/Presenters/ApproachComparison.h"
#include "petrous/Presenters/CasePicture.h"
#include "petrous/Rendering/OffscreenView.h"
#include "petrous/Scene/Branches.h"

namespace petrous::cli
{

namespace
{

using Branch = dissection::History::Branch;

void addStep(CLI::App& app, Context& context, const std::string& name, const std::string& text,
             std::size_t (dissection::Dissection::*step)(std::size_t))
{
  struct Options
  {
    std::string caseName;
    int count = 1;
  };
  auto options = std::make_shared<Options>();
  CLI::App* command = context.addCommand(
      app, name, text,
      [options, step, name, &context]
      {
        library::Library library = context.openLibrary();
        scene::Case value = library.open(options->caseName);
        const std::size_t steps =
            (value.dissection.*step)(static_cast<std::size_t>(options->count));
        if (steps == 0)
          context.warn("nothing to " + name + " in case '" + value.name + "'");
        else
          library.save(value);
        const std::size_t ahead = value.dissection.history().ahead();
        context.print(std::to_string(steps) + " " + (steps == 1 ? "stroke" : "strokes") + "; " +
                      std::to_string(value.applied()) + " done, " + std::to_string(ahead) +
                      " to redo, " + fixed(value.removedVolume(), 1) + " mm3 removed");
        context.printJson({{"case", value.name},
                           {"branch", value.dissection.history().branch().name},
                           {"steps", steps},
                           {"strokes", value.dissection.strokes().size()},
                           {"undo", value.applied()},
                           {"redo", ahead},
                           {"removed_mm3", value.removedVolume()}});
      });
  command->add_option("CASE", options->caseName)->required();
  command->add_option("N", options->count, "Number of strokes (1)")
      ->transform(wholeNumber(1, std::numeric_limits<int>::max()));
}

void printStroke(const Context& context, const scene::Case& value, std::size_t n, const char* state)
{
  const auto& info = value.dissection.strokes()[n]->info;
  std::string line = std::to_string(dissection::strokeNumber(n)) + state +
                     (info.startedAt.empty() ? "" : info.startedAt + "  ") +
                     fixed(info.burr.diameter, 1) + " mm " + dissection::nameOf(info.burr) + ", " +
                     fixed(info.duration, 1) + " s, " + fixed(info.removed, 2) + " mm3";
  if (info.speed)
    line += "; by pedal " + fixed(info.speed->mean, 0) + " rpm on average, at most " +
            fixed(info.speed->max, 0);
  for (const auto& touched : info.structures)
    line += "; " + touched.name + " " + fixed(touched.volume, 2) + " mm3";
  context.print(line + (info.recovered ? "; recovered" : ""));
}

void printHistory(const Context& context, const scene::Case& value)
{
  const dissection::History& history = value.dissection.history();
  if (value.dissection.strokes().empty())
    return context.print("no strokes yet");
  context.print("branch " + history.branch().name + ":");
  const auto line = history.lineTo(history.branch().tip);
  for (std::size_t n = 0; n < line.size(); ++n)
    printStroke(context, value, line[n], n < value.applied() ? "  done    " : "  undone  ");
  for (const auto& branch : history.branches())
  {
    if (&branch == &history.branch())
      continue;
    const auto own = history.path(history.branch().tip, branch.tip).redone;
    context.print("branch " + branch.name + ": " +
                  (own.empty() ? "no strokes of its own"
                               : "after stroke " + std::to_string(dissection::strokeNumber(
                                                       history.parent(own[0])))));
    for (const std::size_t n : own)
      printStroke(context, value, n, "          ");
  }
}

struct BranchOptions
{
  std::string caseName, name, newName, out, camera;
  std::vector<std::string> compared;
  std::size_t after = 0;
  bool list = false, remove = false, withoutDamaged = false;
  const CLI::App* command = nullptr;

  bool given(const char* option) const { return command->count(option) > 0; }
};

std::string strokesInWords(std::size_t count)
{
  return std::to_string(count) + (count == 1 ? " stroke" : " strokes");
}

std::string toString(const scene::Case& value, const Branch& branch)
{
  const auto summary = scene::summaryOf(value, branch.position);
  const std::size_t ahead = value.dissection.history().lineTo(branch.tip).size() - summary.strokes;
  return branch.name + ": " + strokesInWords(summary.strokes) + ", " + fixed(summary.removed, 1) +
         " mm3 removed" + (ahead > 0 ? ", " + std::to_string(ahead) + " to redo" : "") +
         (branch.setAside ? " (set aside by drilling after an undo)" : "");
}

nlohmann::json allJson(const scene::Case& value)
{
  nlohmann::json branches = nlohmann::json::array();
  for (const Branch& branch : value.dissection.history().branches())
    branches.push_back(branchJson(value, branch));
  return {{"case", value.name},
          {"branch", value.dissection.history().branch().name},
          {"strokes", value.dissection.strokes().size()},
          {"undo", value.applied()},
          {"redo", value.dissection.history().ahead()},
          {"removed_mm3", value.removedVolume()},
          {"branches", std::move(branches)}};
}

const Branch& branchOf(const scene::Case& value, const std::string& name)
{
  if (const Branch* branch = value.dissection.history().find(name))
    return *branch;
  dissection::History history = value.dissection.history();
  history.goTo(name); // throws, listing the branches
  return value.dissection.history().branch();
}

void printRow(const Context& context, const std::string& what, const std::string& a,
              const std::string& b)
{
  char row[256];
  std::snprintf(row, sizeof row, "%-28s %20s %20s", what.c_str(), a.c_str(), b.c_str());
  context.print(row);
}

std::string distanceText(const presenters::ComparedApproach& approach, const std::string& structure,
                         const std::optional<double>& uncertainty)
{
  const auto found = approach.distances.find(structure);
  if (found == approach.distances.end())
    return "-";
  return (found->second > 0.0 ? fixed(found->second, 2) : "reached") + " +- " +
         (uncertainty ? fixed(*uncertainty, 2) : "unknown");
}

// A row for each name of either side, 0 if one lacks it.
void printRows(const Context& context, const std::string& before, const std::string& after,
               const std::map<std::string, double>& a, const std::map<std::string, double>& b,
               int digits)
{
  std::map<std::string, std::pair<double, double>> rows;
  for (const auto& [name, number] : a)
    rows[name].first = number;
  for (const auto& [name, number] : b)
    rows[name].second = number;
  for (const auto& [name, numbers] : rows)
    printRow(context, before + name + after, fixed(numbers.first, digits),
             fixed(numbers.second, digits));
}

// Bone and structures, what one of the approaches removed in the colours of the difference.
void drawDifference(const Context& context, const scene::Case& value, const BranchOptions& options,
                    const presenters::ApproachComparison& comparison)
{
  rendering::SceneContents contents = presenters::sceneContents(value, context.progress());
  presenters::showDifference(contents, comparison);
  rendering::ScenePicture picture;
  picture.setContents(contents);
  if (!options.given("--camera"))
    warnOfView(context, value, "lateral");
  picture.setCamera(options.given("--camera")
                        ? readCamera(options.camera)
                        : presenters::standardCamera(value, rendering::StandardView::Lateral));
  constexpr int kWidth = 1024, kHeight = 768; // pixels
  rendering::OffscreenView view(kWidth, kHeight);
  const rendering::Picture drawn = view.render(picture);
  context.refuseDamaged();
  rendering::writePng(options.out, drawn);
}

void compare(const Context& context, const scene::Case& value, const BranchOptions& options,
             const presenters::LeftOut& leftOut)
{
  const Branch& a = branchOf(value, options.compared[0]);
  const Branch& b = branchOf(value, options.compared[1]);
  const auto comparison = presenters::compareApproaches(value, a.name, b.name, context.progress());
  const auto& [ofA, ofB] = comparison.sides;
  if (options.given("--out"))
    drawDifference(context, value, options, comparison);
  printRow(context, "", a.name, b.name);
  printRow(context, "strokes (" + std::to_string(comparison.commonStrokes) + " in common)",
           std::to_string(ofA.strokes), std::to_string(ofB.strokes));
  printRow(context, "drilling, s", fixed(ofA.drilling, 1), fixed(ofB.drilling, 1));
  printRow(context, "removed, mm3", fixed(ofA.removed, 2), fixed(ofB.removed, 2));
  printRow(context, "  only there, mm3", fixed(ofA.only, 2), fixed(ofB.only, 2));
  printRow(context, "  in both, mm3", fixed(comparison.both, 2), fixed(comparison.both, 2));
  printRows(context, "  of ", ", mm3", ofA.injured, ofB.injured, 2);
  printRows(context, "exposed ", ", mm2", ofA.exposed, ofB.exposed, 1);
  for (const auto& [name, uncertainty] : comparison.uncertainties)
    printRow(context, "to " + name + ", mm", distanceText(ofA, name, uncertainty),
             distanceText(ofB, name, uncertainty));
  nlohmann::json uncertainties = nlohmann::json::object();
  for (const auto& [name, uncertainty] : comparison.uncertainties)
    uncertainties[name] = uncertainty ? nlohmann::json(*uncertainty) : nlohmann::json();
  nlohmann::json sides = {branchJson(value, a), branchJson(value, b)};
  for (std::size_t side = 0; side < 2; ++side)
  {
    const presenters::ComparedApproach& of = comparison.sides[side];
    sides[side]["drilling_s"] = of.drilling;
    sides[side]["tissue_mm3"] = of.removed;
    sides[side]["only_mm3"] = of.only;
    sides[side]["exposed_mm2"] = nlohmann::json(of.exposed);
    sides[side]["distance_mm"] = nlohmann::json(of.distances);
  }
  context.printJson({{"case", value.name},
                     {"common_strokes", comparison.commonStrokes},
                     {"both_mm3", comparison.both},
                     {"uncertainty_mm", std::move(uncertainties)},
                     {"compare", std::move(sides)},
                     {"out", options.given("--out") ? nlohmann::json(options.out) : nullptr},
                     {"left_out", leftOutJson(value, leftOut)},
                     {"without_place", missingPlacesJson(value)}});
}

void list(const Context& context, const scene::Case& value)
{
  for (const Branch& branch : value.dissection.history().branches())
    context.print((&branch == &value.dissection.history().branch() ? "* " : "  ") +
                  toString(value, branch));
  context.printJson(allJson(value));
}

// Makes the change; returns its description.
std::string change(scene::Case& value, const BranchOptions& options)
{
  const std::string& name = options.name;
  if (options.given("--rename"))
  {
    scene::renameBranch(value, name, options.newName);
    return "'" + name + "' is now '" + options.newName + "'";
  }
  if (options.remove)
    return "branch '" + name + "' deleted, and " +
           strokesInWords(scene::removeBranch(value, name)) + " that only it led to";
  const bool there = value.dissection.history().find(name) != nullptr;
  if (there && options.given("--from"))
    throw core::InvalidParameter("branch '" + name + "' is there already; --from is for a new one");
  if (there)
    scene::goToBranch(value, name);
  else if (options.given("--from"))
    scene::startBranch(value, name, options.after);
  else
    scene::startBranch(value, name);
  return std::string(there ? "on branch " : "new branch ") +
         toString(value, value.dissection.history().branch());
}

void branch(const Context& context, const BranchOptions& options)
{
  const int ways = static_cast<int>(options.list) + static_cast<int>(options.remove) +
                   static_cast<int>(options.given("--rename")) +
                   static_cast<int>(options.given("--from")) +
                   static_cast<int>(options.given("--compare"));
  const bool named = options.given("NAME");
  if (ways > 1)
    throw UsageError("branch: give one of --list, --compare, --from, --rename, --delete");
  if (named == (options.list || options.given("--compare")))
    throw UsageError(named ? "branch: --list and --compare take no NAME"
                           : "branch: give the NAME of a branch, or --list");
  if (options.withoutDamaged && !options.given("--compare"))
    throw UsageError(std::string("branch: ") + kWithoutDamaged + " is for --compare");
  if (options.given("--out") && !options.given("--compare"))
    throw UsageError("branch: --out is for --compare");
  if (options.given("--camera") && !options.given("--out"))
    throw UsageError("branch: --camera is for --out");
  if (options.given("--out"))
    context.refuseOverwriting({options.out}, {options.camera});
  library::Library library = context.openLibrary();
  scene::Case value = library.open(options.caseName);
  if (options.list)
    return list(context, value);
  if (options.given("--compare"))
  {
    library.loadDissection(value);
    const auto leftOut = leaveOutDamaged(context, library, value, options.withoutDamaged);
    warnMissingPlaces(context, value);
    warnOutdated(context, value);
    return compare(context, value, options, leftOut);
  }
  const std::string done = change(value, options);
  library.save(value);
  context.print(done);
  context.printJson(allJson(value));
}

void addBranchCommand(CLI::App& app, Context& context)
{
  auto options = std::make_shared<BranchOptions>();
  CLI::App* command = context.addCommand(
      app, "branch", "Branches of the history: switch, create from any earlier state, compare",
      [options, &context] { branch(context, *options); });
  options->command = command;
  command->add_option("CASE", options->caseName)->required();
  command->add_option("NAME", options->name,
                      "Switch to this branch, or create it at the current state");
  command->add_flag("--list", options->list, "List the branches of the case");
  command
      ->add_option("--from", options->after,
                   "Create the branch after the first N strokes of the current one")
      ->type_name("N")
      ->transform(wholeNumber(0, std::numeric_limits<int>::max()));
  command
      ->add_option("--compare", options->compared,
                   "Compare two branches: what they removed, exposed and came near to")
      ->expected(2)
      ->type_name("A B");
  command
      ->add_option("--out", options->out,
                   "With --compare: a picture of the difference; orange: removed by A only, blue: "
                   "by B only, grey: by both")
      ->type_name("PNG");
  command->add_option("--camera", options->camera, "Of that picture, a JSON file as for render")
      ->type_name("JSON");
  command->add_option("--rename", options->newName, "Rename branch NAME");
  command->add_flag("--delete", options->remove,
                    "Delete branch NAME and the strokes that only it leads to");
  addWithoutDamaged(*command, options->withoutDamaged);
}

} // namespace

void addHistoryCommands(CLI::App& app, Context& context)
{
  addStep(app, context, "undo", "Undo the last strokes", &dissection::Dissection::undo);
  addStep(app, context, "redo", "Redo undone strokes", &dissection::Dissection::redo);
  auto name = std::make_shared<std::string>();
  context
      .addCommand(app, "history", "List the strokes of a case",
                  [name, &context]
                  {
                    const scene::Case value = context.openLibrary().open(*name);
                    printHistory(context, value);
                    nlohmann::json branches = nlohmann::json::array();
                    for (const auto& branch : value.dissection.history().branches())
                      branches.push_back(branchJson(value, branch));
                    context.printJson({{"case", value.name},
                                       {"branch", value.dissection.history().branch().name},
                                       {"branches", std::move(branches)},
                                       {"strokes", strokesJson(value)},
                                       {"undo", value.applied()},
                                       {"redo", value.dissection.history().ahead()}});
                  })
      ->add_option("CASE", *name)
      ->required();
  addBranchCommand(app, context);
}

} // namespace petrous::cli
