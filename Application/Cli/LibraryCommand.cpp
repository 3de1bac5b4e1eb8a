#include <algorithm>

#include "CaseJson.h"
#include "Commands.h"
#include "Numbers.h"
#include "Program.h"
#include "petrous/Core/InputFile.h"
#include "petrous/Library/DefaultFolder.h"
#include "petrous/Library/DerivedCache.h"
#include "petrous/Library/NewerVersion.h"
#include "petrous/Network/NodeList.h"
#include "petrous/Scene/PlainText.h"

namespace petrous::cli
{

namespace
{

struct Options
{
  std::string action;
  std::vector<std::string> names;
  library::CaseFilter filter;
  std::string side;
  bool acceptsChanged = false;
};

// Why the library has nothing, where its folder is not there: one that was named, and not the usual
// one, which the first case makes. Else empty.
std::string missingFolder(const library::Library& library)
{
  return std::filesystem::is_directory(library.folder()) ||
                 library.folder() == library::defaultFolder()
             ? std::string()
             : library.folder().string() +
                   ": there is no such folder; is the path right, and its disk mounted?";
}

// To be looked at or changed as a whole.
void requireFolder(const library::Library& library)
{
  if (const std::string why = missingFolder(library); !why.empty())
    throw library::LibraryError(library::LibraryError::Reason::NotFound, why);
}

void printCases(const Context& context, const library::Library& library,
                const std::vector<library::CaseSummary>& summaries)
{
  nlohmann::json cases = nlohmann::json::array();
  for (const auto& summary : summaries)
  {
    if (context.json()) // ten thousand objects take longer than the search
    {
      cases.push_back({{"name", summary.name},
                       {"modified", summary.modified},
                       {"dims", summary.dims},
                       {"structures", summary.structures},
                       {"strokes", summary.strokes},
                       {"removed_mm3", summary.removed},
                       {"damaged", summary.damaged},
                       {"has_note", summary.hasNote},
                       {"thumbnail", summary.hasThumbnail}});
      nlohmann::json description = descriptionJson(summary.description);
      description.erase("note");
      cases.back().update(description);
      if (summary.damaged && library::isOfNewerVersion(library.folder(), summary.name))
        cases.back().update({{"damaged", false}, {"newer", true}});
    }
    const std::string line = descriptionLine(summary.description);
    context.print(scene::withVisible(summary.name) + "  " + summary.modified + "  " +
                  (summary.damaged && library::isOfNewerVersion(library.folder(), summary.name)
                       ? "written by a newer version of Petrous"
                   : summary.damaged ? "damaged: its manifest cannot be read"
                                     : std::to_string(summary.structures) + " structures, " +
                                           std::to_string(summary.strokes) + " strokes, " +
                                           fixed(summary.removed, 1) + " mm3 removed") +
                  (line.empty() ? "" : "  " + line));
  }
  if (const std::string why = missingFolder(library); !why.empty())
    context.print("no case in " + why);
  else if (summaries.empty())
    context.print("no case in " + library.folder().string());
  context.printJson({{"library", library.folder().string()}, {"cases", std::move(cases)}});
}

void find(const Context& context, const library::Library& library, const Options& options)
{
  library::CaseFilter filter = options.filter;
  for (const auto& [option, date] : {std::pair{"--from", filter.from}, {"--to", filter.to}})
    if (!date.empty() && !scene::isDate(date))
      throw UsageError(std::string(option) + ": give a day as YYYY-MM-DD, not '" + date + "'");
  if (!filter.to.empty() && filter.from > filter.to)
    throw UsageError("--from is later than --to");
  if (!options.side.empty())
    filter.side = scene::sideFromName(options.side);
  if (!options.names.empty())
    filter.text = options.names[0];
  if (filter.inNotes && filter.text.empty())
    throw UsageError("--notes: give the text to be found in them, 'petrous library search TEXT "
                     "--notes'");
  printCases(context, library, library.search(filter));
}

void verify(const Context& context, const library::Library& library)
{
  requireFolder(library);
  const library::Inspection found = library.verify(context.progress());
  const std::size_t count = found.damaged.size();
  nlohmann::json damaged = nlohmann::json::array();
  for (const auto& one : found.damaged)
  {
    damaged.push_back({{"object", one.object},
                       {"cases", one.cases},
                       {"deleted_cases", one.deletedCases},
                       {"text", one.text}});
    context.print(one.text);
  }
  nlohmann::json newer = nlohmann::json::array();
  for (const auto& one : library::casesOfNewerVersion(library.folder()))
  {
    newer.push_back({{"case", one.name}, {"deleted", one.isDeleted}, {"text", one.text}});
    context.print(one.text);
  }
  context.print(std::to_string(found.cases) + " cases, " + std::to_string(found.objects) +
                " objects, " + std::to_string(found.damaged.size()) + " damaged" +
                (newer.empty() ? std::string()
                               : ", " + std::to_string(newer.size()) +
                                     " written by a newer version, and not read"));
  context.printJson({{"cases", found.cases},
                     {"objects", found.objects},
                     {"damaged", damaged},
                     {"newer", std::move(newer)}});
  if (!found.damaged.empty())
    throw library::LibraryError(library::LibraryError::Reason::Damaged,
                                library.folder().string() + ": " + std::to_string(count) +
                                    (count == 1 ? " file is damaged or missing; restore it"
                                                : " files are damaged or missing; restore them") +
                                    " from a copy of the library, or import the data again");
}

void collect(const Context& context, library::Library& library)
{
  requireFolder(library);
  const library::Collected removed = library.collectGarbage(context.progress());
  if (removed.cases > 0)
    context.print(std::to_string(removed.cases) +
                  (removed.cases == 1 ? " deleted case" : " deleted cases") + " removed for good");
  context.print(std::to_string(removed.objects) + " unreferenced objects removed, " +
                std::to_string(removed.bytes) + " bytes");
  library::DerivedCache derived(library::derivedFolder(library.folder()));
  const std::uintmax_t freed = derived.prune(0);
  context.print("derived data removed: " + fixed(1e-6 * static_cast<double>(freed), 1) + " MB");
  context.printJson({{"cases", removed.cases},
                     {"removed", removed.objects},
                     {"bytes", removed.bytes},
                     {"derived_bytes", freed}});
}

void repair(const Context& context, library::Library& library, bool acceptsChanged)
{
  requireFolder(library);
  const library::Repaired found = library.repair(context.progress(), acceptsChanged);
  for (const auto* lines : {&found.lost, &found.done})
    for (const std::string& line : *lines)
      context.print(line);
  context.printJson({{"done", found.done}, {"lost", found.lost}});
  if (!found.lost.empty())
    throw library::LibraryError(library::LibraryError::Reason::Damaged,
                                library.folder().string() + ": " +
                                    std::to_string(found.lost.size()) +
                                    (found.lost.size() == 1 ? " file that a case needs is lost"
                                                            : " files that cases need are lost") +
                                    " and cannot be repaired; restore from a copy of the library, "
                                    "or import the data again");
}

// Also where the folder that was chosen before is not there.
void chooseFolder(const Context& context, const std::vector<std::string>& names)
{
  const bool isChosen = !names.empty();
  if (isChosen)
    library::chooseDefaultFolder(names[0]); // empty: back to the usual one
  const std::filesystem::path folder =
      isChosen ? library::defaultFolder() : context.openLibrary().folder();
  context.print(folder.string() +
                (isChosen ? ": is the library from now on, for window and command; nothing was "
                            "moved, and --library and PETROUS_LIBRARY still go first"
                          : ""));
  context.printJson({{"library", folder.string()}});
}

void run(const Context& context, const Options& options)
{
  const std::string& action = options.action;
  if (action == "folder")
  {
    if (options.names.size() > 1)
      throw UsageError("library folder: give 'petrous library folder [DIR]'");
    return chooseFolder(context, options.names);
  }
  const auto isEmpty = [](const std::string& name)
  { return name.find_first_not_of(" \t") == std::string::npos; };
  if (std::any_of(options.names.begin(), options.names.end(), isEmpty))
    throw UsageError("library " + action + ": the value is empty; give one, or leave it out");
  const auto names = [&](std::size_t count, const std::string& form)
  {
    if (options.names.size() != count)
      throw UsageError("library " + action + ": give 'petrous library " + form + "'");
  };
  library::Library library = context.openLibrary();
  const library::CaseFilter& filter = options.filter;
  const bool isFiltered = filter.inNotes || !filter.tags.empty() || !filter.diagnosis.empty() ||
                          !filter.procedure.empty() || !options.side.empty() ||
                          !filter.from.empty() || !filter.to.empty();
  if (isFiltered && action != "list" && action != "search")
    throw UsageError("library " + action +
                     ": --notes, --tag, --diagnosis, --procedure, --side, "
                     "--from and --to go with list and search");
  if (options.acceptsChanged && action != "repair")
    throw UsageError("library " + action + ": --accept-changed goes with repair");
  if (action == "list")
  {
    names(0, "list");
    find(context, library, options);
  }
  else if (action == "search")
  {
    if (!isFiltered || !options.names.empty())
      names(1, "search TEXT");
    find(context, library, options);
  }
  else if (action == "verify")
  {
    names(0, "verify");
    verify(context, library);
  }
  else if (action == "gc")
  {
    names(0, "gc");
    collect(context, library);
  }
  else if (action == "repair")
  {
    names(0, "repair");
    repair(context, library, options.acceptsChanged);
  }
  else if (action == "rename")
  {
    names(2, "rename A B");
    library.rename(options.names[0], options.names[1]);
    context.print("case '" + options.names[0] + "' is now '" + options.names[1] + "'");
    if (!network::NodeList(library.folder()).nodes().empty())
      context.print("a node to which it was sent keeps it as it was; sent again, it is another "
                    "patient and study there");
    context.printJson({{"case", options.names[1]}, {"was", options.names[0]}});
  }
  else if (action == "copy")
  {
    names(2, "copy A B");
    for (const std::string& words : library.lost(library.open(options.names[0])))
      context.warn(words);
    library.copy(options.names[0], options.names[1], context.progress());
    context.print("case '" + options.names[1] + "' is a copy of '" + options.names[0] + "'");
    context.printJson({{"case", options.names[1]}, {"from", options.names[0]}});
  }
  else if (action == "delete")
  {
    names(1, "delete NAME");
    library.remove(options.names[0]);
    context.print("case '" + options.names[0] +
                  "' is deleted; 'petrous library undelete' brings it back, until 'petrous library "
                  "gc' frees what no other case needs");
    context.printJson({{"case", options.names[0]}, {"deleted", true}});
  }
  else if (action == "undelete")
  {
    names(1, "undelete NAME");
    library.undelete(options.names[0]);
    context.print("case '" + options.names[0] + "' is back");
    context.printJson({{"case", options.names[0]}, {"deleted", false}});
  }
  else if (action == "deleted")
  {
    names(0, "deleted");
    nlohmann::json cases = nlohmann::json::array();
    for (const auto& one : library.deleted())
    {
      cases.push_back({{"name", one.name}, {"deleted", one.deleted}});
      context.print(scene::withVisible(one.name) + "  deleted " + one.deleted);
    }
    if (const std::string why = missingFolder(library); !why.empty())
      context.print("no deleted case in " + why);
    else if (cases.empty())
      context.print("no deleted case in " + library.folder().string() + " can be brought back");
    context.printJson({{"library", library.folder().string()}, {"cases", std::move(cases)}});
  }
  else
    throw UsageError("library: '" + action +
                     "' is unknown; there are list, search TEXT, verify, gc, repair, rename A B, "
                     "copy A B, delete NAME, deleted, undelete NAME and folder [DIR]");
}

} // namespace

void addLibraryCommand(CLI::App& app, Context& context)
{
  auto options = std::make_shared<Options>();
  CLI::App* command =
      context.addCommand(app, "library", "List, check and manage the cases of the library",
                         [options, &context] { run(context, *options); });
  command
      ->add_option("ACTION", options->action,
                   "list, search TEXT, verify, gc, repair, rename A B, copy A B, delete NAME, "
                   "deleted, undelete NAME, folder [DIR] (the one in use, or another one from now "
                   "on)")
      ->check(offers({"list", "search", "verify", "gc", "repair", "rename", "copy", "delete",
                      "deleted", "undelete", "folder"}))
      ->required();
  command->add_option("NAMES", options->names, "Arguments of the action")
      ->check(CLI::Validator([](std::string&) { return std::string(); }, "", kMayBeEmpty));
  command->add_flag("--notes", options->filter.inNotes,
                    "Search: TEXT in the notes too (slower: they are not in the index)");
  command->add_flag("--accept-changed", options->acceptsChanged,
                    "Repair: keep cases whose file was changed outside of Petrous, or is damaged, "
                    "as it is, and save them anew");
  command
      ->add_option("--tag", options->filter.tags,
                   "List, search: cases with this tag (and each more)")
      ->allow_extra_args(false)
      ->type_name("TAG");
  command
      ->add_option("--diagnosis", options->filter.diagnosis,
                   "List, search: cases with these words in the diagnosis")
      ->type_name("TEXT");
  command
      ->add_option("--procedure", options->filter.procedure,
                   "List, search: cases with these words in the procedure")
      ->type_name("TEXT");
  command->add_option("--side", options->side, "List, search: left, right, both or unknown")
      ->check(oneOf({"left", "right", "both", "unknown"}));
  command
      ->add_option("--from", options->filter.from,
                   "List, search: cases planned for this day or later")
      ->type_name("YYYY-MM-DD");
  command
      ->add_option("--to", options->filter.to,
                   "List, search: cases planned for this day or earlier")
      ->type_name("YYYY-MM-DD");
}

} // namespace petrous::cli
