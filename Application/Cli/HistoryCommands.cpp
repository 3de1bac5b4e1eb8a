#include <limits>

#include "CaseJson.h"
#include "Commands.h"
#include "Numbers.h"
#include "petrous/Dissection/BurrName.h"

namespace petrous::cli
{

namespace
{

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
  command->add_option("N", options->count, "How many strokes (1)")
      ->transform(wholeNumber(1, std::numeric_limits<int>::max()));
}

void printStroke(const Context& context, const scene::Case& value, std::size_t n, const char* state)
{
  const auto& info = value.dissection.strokes()[n]->info;
  std::string line = std::to_string(n + 1) + state + info.startedAt + "  " +
                     fixed(info.burr.diameter, 1) + " mm " + dissection::nameOf(info.burr.kind) +
                     ", " + fixed(info.duration, 1) + " s, " + fixed(info.removed, 2) + " mm3";
  for (const auto& touched : info.structures)
    line += "; " + touched.name + " " + fixed(touched.volume, 2) + " mm3";
  context.print(line + (info.recovered ? "; recovered" : ""));
}

void printHistory(const Context& context, const scene::Case& value)
{
  const dissection::History& history = value.dissection.history();
  if (value.dissection.strokes().empty())
    return context.print("no stroke yet");
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
                  (own.empty() ? "nothing of its own"
                               : "after stroke " + std::to_string(history.parent(own[0]) + 1)));
    for (const std::size_t n : own)
      printStroke(context, value, n, "          ");
  }
}

} // namespace

void addHistoryCommands(CLI::App& app, Context& context)
{
  addStep(app, context, "undo", "Take back the last strokes", &dissection::Dissection::undo);
  addStep(app, context, "redo", "Do again what was taken back", &dissection::Dissection::redo);
  auto name = std::make_shared<std::string>();
  context
      .addCommand(app, "history", "The strokes of a case",
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
}

} // namespace petrous::cli
