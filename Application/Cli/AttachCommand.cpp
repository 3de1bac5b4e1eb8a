#include <algorithm>

#include "Commands.h"
#include "Numbers.h"
#include "petrous/Library/Attachments.h"
#include "petrous/Presenters/IdentityText.h"

namespace petrous::cli
{

namespace
{

struct AttachCommandOptions
{
  std::string caseName, file, name, note, date;
  bool link = false;
  std::optional<std::uint64_t> stroke;
};

struct AttachmentsOptions
{
  std::string caseName, remove;
  std::vector<std::string> extract; // name and file
};

nlohmann::json attachmentJson(const library::Library& library, const scene::Case& value,
                              const scene::Attachment& one)
{
  const std::size_t stroke = scene::strokeOf(value, one);
  const std::string problem = library::attachmentProblem(library, one);
  const auto orNull = [](const std::string& text)
  { return text.empty() ? nlohmann::json(nullptr) : nlohmann::json(text); };
  return {{"name", one.name},
          {"kind", nameOf(one.kind)},
          {"date", orNull(one.date)},
          {"note", one.note},
          {"stroke", stroke == 0 ? nlohmann::json(nullptr) : nlohmann::json(stroke)},
          {"bytes", one.bytes},
          {"link", orNull(one.link)},
          {"sha256", one.link.empty() ? one.object.substr(0, 64) : one.sha256},
          {"state", problem.empty() ? "ok" : problem}};
}

std::string attachmentLine(const library::Library& library, const scene::Case& value,
                           const scene::Attachment& one)
{
  std::string line = "  " + one.name + ": " + nameOf(one.kind) + ", " +
                     fixed(1e-6 * static_cast<double>(one.bytes), 1) + " MB";
  if (!one.date.empty())
    line += ", " + one.date;
  if (const std::size_t stroke = scene::strokeOf(value, one); stroke > 0)
    line += ", stroke " + std::to_string(stroke);
  if (!one.link.empty())
    line += ", linked: " + one.link;
  if (const std::string problem = library::attachmentProblem(library, one); !problem.empty())
    line += "; its file is " + problem;
  return line;
}

void attach(const Context& context, const AttachCommandOptions& options)
{
  library::Library library = context.openLibrary();
  scene::Case value = library.open(options.caseName);
  if (!options.date.empty() && !scene::isDate(options.date))
    throw UsageError("--date: give a day as YYYY-MM-DD, not '" + options.date + "'");
  scene::Attachment attachment = library::attachmentOf(
      options.file, {options.name, options.note, options.date, options.link}, context.progress());
  if (options.stroke)
  {
    const auto& strokes = value.dissection.strokes();
    if (*options.stroke > strokes.size())
      throw core::InvalidParameter("case '" + value.name + "' has " +
                                   std::to_string(strokes.size()) + " strokes, not " +
                                   std::to_string(*options.stroke));
    attachment.stroke = strokes[*options.stroke - 1]->object;
  }
  const std::string name = library::attach(value, std::move(attachment));
  if (options.name.empty())
    context.warn("named '" + name +
                 "' and not as its file, whose name may be a patient's; --name "
                 "gives another name");
  library.save(value, context.progress());
  const scene::Attachment& one = scene::findAttachment(value, name);
  if (presenters::IdentityText(value, library).mayIdentifyPath(one.link))
    context.warn(
        "the path of the file, which the case keeps, may name the patient: it stays in this "
        "library, but 'attachments' shows it; link a file of another name if it must not");
  if (one.kind == scene::Attachment::Kind::Video)
    context.warn("a video may show or name the patient; archives and send leave it here unless "
                 "asked (--with-videos), and its metadata is not removed");
  if (one.kind == scene::Attachment::Kind::Document)
    context.warn("a PDF may name the patient, also in its metadata, which is not removed; archives "
                 "and send leave it here unless asked (--with-documents)");
  context.print("case '" + value.name + "' has a new attachment:");
  context.print(attachmentLine(library, value, one));
  context.printJson({{"case", value.name}, {"attachment", attachmentJson(library, value, one)}});
}

void attachments(const Context& context, const AttachmentsOptions& options)
{
  if (!options.extract.empty() && !options.remove.empty())
    throw UsageError("attachments: give --extract or --remove, not both");
  library::Library library = context.openLibrary();
  if (!options.extract.empty())
    context.refuseOverwriting({options.extract.back()});
  scene::Case value = library.open(options.caseName);
  if (!options.extract.empty())
  {
    const scene::Attachment& one = scene::findAttachment(value, options.extract.front());
    library::extractAttachment(library, value, one, options.extract.back(), context.progress());
    context.print("'" + one.name + "' is in " + options.extract.back());
    return context.printJson({{"case", value.name},
                              {"out", options.extract.back()},
                              {"attachment", attachmentJson(library, value, one)}});
  }
  if (!options.remove.empty())
  {
    const scene::Attachment& one = scene::findAttachment(value, options.remove);
    const std::string name = one.name;
    value.attachments.erase(value.attachments.begin() + (&one - value.attachments.data()));
    library.save(value, context.progress());
    context.print("'" + name + "' is taken out of case '" + value.name +
                  "'; 'petrous library gc' frees its room");
    return context.printJson({{"case", value.name}, {"removed", name}});
  }
  nlohmann::json all = nlohmann::json::array();
  context.print(
      "case '" + value.name + "'" +
      (value.attachments.empty() ? " has no attachments; see 'petrous attach --help'" : ""));
  for (const scene::Attachment& one : value.attachments)
  {
    context.print(attachmentLine(library, value, one));
    for (std::size_t from = 0; from < one.note.size();)
    {
      const std::size_t to = std::min(one.note.find('\n', from), one.note.size());
      context.print("    " + one.note.substr(from, to - from));
      from = to + 1;
    }
    all.push_back(attachmentJson(library, value, one));
  }
  context.printJson({{"case", value.name}, {"attachments", std::move(all)}});
}

} // namespace

void addAttachCommands(CLI::App& app, Context& context)
{
  auto in = std::make_shared<AttachCommandOptions>();
  CLI::App* command = context.addCommand(
      app, "attach", "Add a file to a case: recording of the tool, PNG, PDF or video",
      [in, &context] { attach(context, *in); });
  command->add_option("CASE", in->caseName, "Name of the case")->required();
  command->add_option("FILE", in->file, "The file; of a PNG the picture without its metadata")
      ->required();
  command->add_flag("--link", in->link,
                    "Keep path, size and SHA-256 only; the file stays where it is");
  command
      ->add_option("--name", in->name,
                   "In the case (else by its kind: document.pdf); travels with archives")
      ->type_name("NAME");
  command->add_option("--note", in->note, "Free text; travels with archives: name nobody")
      ->type_name("TEXT");
  command->add_option("--date", in->date, "Of the file (today); archives leave it out")
      ->type_name("YYYY-MM-DD");
  command->add_option("--stroke", in->stroke, "The stroke to which it belongs, see history")
      ->type_name("N")
      ->transform(wholeNumber(1, 1000000000));

  auto list = std::make_shared<AttachmentsOptions>();
  command = context.addCommand(app, "attachments", "List, extract or remove a case's attachments",
                               [list, &context] { attachments(context, *list); });
  command->add_option("CASE", list->caseName, "Name of the case")->required();
  command->add_option("--extract", list->extract, "Write an attachment to a file")
      ->type_name("NAME OUT")
      ->expected(2);
  command->add_option("--remove", list->remove, "Take an attachment out")->type_name("NAME");
}

} // namespace petrous::cli
