#include <algorithm>

#include "CaseJson.h"
#include "Commands.h"
#include "Numbers.h"
#include "petrous/Core/InputFile.h"
#include "petrous/Presenters/CasePicture.h"
#include "petrous/Presenters/CaseStamp.h"

namespace petrous::cli
{

namespace
{

using scene::Description;

struct Options
{
  std::string caseName, noteFile, side;
  std::optional<std::string> note, diagnosis, procedure, date;
  std::vector<std::string> tags, removedTags, cleared;
  bool thumbnail = false;

  bool changes() const
  {
    return note || !noteFile.empty() || diagnosis || procedure || date || !side.empty() ||
           !tags.empty() || !removedTags.empty() || !cleared.empty();
  }
};

std::string trimmed(const std::string& text)
{
  const std::size_t first = text.find_first_not_of(" \t\n");
  return first == text.npos ? std::string()
                            : text.substr(first, text.find_last_not_of(" \t\n") + 1 - first);
}

// Line ends of other systems become \n; a byte order mark is no text.
std::string plainText(std::string text)
{
  if (text.rfind("\xef\xbb\xbf", 0) == 0)
    text.erase(0, 3);
  std::string plain;
  for (std::size_t n = 0; n < text.size(); ++n)
    if (text[n] != '\r')
      plain += text[n];
    else if (n + 1 == text.size() || text[n + 1] != '\n')
      plain += '\n';
  return plain;
}

auto findTag(Description& description, const std::string& tag)
{
  return std::find_if(description.tags.begin(), description.tags.end(),
                      [wanted = scene::lowerCase(tag)](const std::string& one)
                      { return scene::lowerCase(one) == wanted; });
}

void clear(Description& description, const std::string& field)
{
  const Description none;
  if (field == "note")
    description.note = none.note;
  else if (field == "tags")
    description.tags = none.tags;
  else if (field == "diagnosis")
    description.diagnosis = none.diagnosis;
  else if (field == "procedure")
    description.procedure = none.procedure;
  else if (field == "side")
    description.side = none.side;
  else
    description.date = none.date;
}

void change(Description& description, const Options& options)
{
  for (const std::string& field : options.cleared)
    clear(description, field);
  if (options.note)
    description.note = plainText(*options.note);
  if (!options.noteFile.empty())
    try
    {
      description.note =
          plainText(core::readFile(options.noteFile, 2 * Description::kLongestNote + 3));
      scene::checkDescription(description);
    }
    catch (const core::InvalidParameter& error)
    {
      throw core::InvalidParameter(options.noteFile + ": " + error.what());
    }
  if (options.diagnosis)
    description.diagnosis = trimmed(*options.diagnosis);
  if (options.procedure)
    description.procedure = trimmed(*options.procedure);
  if (!options.side.empty())
    description.side = scene::sideFromName(options.side);
  if (options.date)
    description.date = *options.date;
  for (const std::string& tag : options.removedTags)
  {
    const auto found = findTag(description, trimmed(tag));
    if (found == description.tags.end())
    {
      std::string there;
      for (const std::string& one : description.tags)
        there += (there.empty() ? "; it has " : ", ") + one;
      throw core::InvalidParameter("case '" + options.caseName + "' has no tag '" + tag + "'" +
                                   there);
    }
    description.tags.erase(found);
  }
  for (const std::string& tag : options.tags)
    if (findTag(description, trimmed(tag)) == description.tags.end())
      description.tags.push_back(trimmed(tag));
}

void run(const Context& context, const Options& options)
{
  if (options.note && !options.noteFile.empty())
    throw UsageError("describe: give --note or --note-file, not both");
  if (options.date && !scene::isDate(*options.date))
    throw UsageError("--date: give a day as YYYY-MM-DD, not '" + *options.date + "'");
  library::Library library = context.openLibrary();
  scene::Case value = library.open(options.caseName);
  const Description before = value.description;
  change(value.description, options);
  scene::checkDescription(value.description);
  const bool isChanged = value.description != before;
  if (isChanged)
    library.save(value);
  if (options.thumbnail && !presenters::storeThumbnail(library, value, context.progress()))
    context.warn("no thumbnail was made: it would show neither bone nor a structure");

  if (const std::string doubt = presenters::sideDoubt(value);
      !options.side.empty() && !doubt.empty())
    context.warn(doubt);
  const bool hasThumbnail = !library.thumbnail(value.name).empty();
  const std::string line = descriptionLine(value.description);
  context.print("case '" + value.name + "'" + (isChanged ? " is described anew" : ""));
  if (!line.empty())
    context.print("  " + line);
  if (!value.description.note.empty())
    context.print(indented(value.description.note));
  if (value.description.empty())
    context.print("  not described yet; see 'petrous describe --help'");
  if (hasThumbnail)
    context.print(options.thumbnail ? "  its thumbnail is made" : "  it has a thumbnail");
  context.printJson({{"case", value.name},
                     {"description", descriptionJson(value.description)},
                     {"changed", isChanged},
                     {"thumbnail", hasThumbnail}});
}

} // namespace

void addDescribeCommand(CLI::App& app, Context& context)
{
  auto options = std::make_shared<Options>();
  CLI::App* command = context.addCommand(
      app, "describe", "Show or change the description of a case: note, tags, diagnosis, side",
      [options, &context] { run(context, *options); });
  command->add_option("CASE", options->caseName, "Name of the case")->required();
  command
      ->add_option("--note", options->note,
                   "Free text instead of the present note; travels with archives: name nobody")
      ->type_name("TEXT");
  command->add_option("--note-file", options->noteFile, "The same, from a text file (UTF-8)")
      ->type_name("FILE");
  command->add_option("--tag", options->tags, "Add a tag (may be repeated)")
      ->allow_extra_args(false)
      ->type_name("TAG");
  command->add_option("--remove-tag", options->removedTags, "Remove a tag (may be repeated)")
      ->allow_extra_args(false)
      ->type_name("TAG");
  command->add_option("--diagnosis", options->diagnosis, "A line")->type_name("TEXT");
  command->add_option("--procedure", options->procedure, "A line")->type_name("TEXT");
  command->add_option("--side", options->side, "Of the operation: left, right, both or unknown")
      ->check(oneOf({"left", "right", "both", "unknown"}));
  command
      ->add_option("--date", options->date,
                   "Of the planned operation; archives leave it out (--keep-identity)")
      ->type_name("YYYY-MM-DD");
  command
      ->add_option("--clear", options->cleared,
                   "Take out, before anything else: note, tags, diagnosis, procedure, side, date")
      ->allow_extra_args(false)
      ->delimiter(',')
      ->check(oneOf({"note", "tags", "diagnosis", "procedure", "side", "date"}));
  command->add_flag("--thumbnail", options->thumbnail,
                    "Draw the small picture by which lists show the case, from its last view: bone "
                    "and structures");
}

} // namespace petrous::cli
