#include <memory>
#include <string>

#include "CaseJson.h"
#include "CaseWarnings.h"
#include "Commands.h"
#include "Numbers.h"
#include "ViewOptions.h"
#ifdef PETROUS_PDF
#include "PdfReport.h"
#endif
#include "petrous/Core/LocalTime.h"
#include "petrous/Core/OutputFile.h"
#include "petrous/Presenters/IdentityText.h"
#include "petrous/Presenters/PlanReport.h"
#include "petrous/Scene/Case.h"

namespace petrous::cli
{

namespace
{

struct Options
{
  std::string caseName, out, approach, language = "en";
  rendering::BackgroundColor background = rendering::kDefaultBackground;
  bool keepIdentity = false, withoutDate = false, withoutDamaged = false;
};

bool isPdf(const std::string& file)
{
  return scene::lowerCase(file.substr(file.size() - std::min<std::size_t>(file.size(), 4))) ==
         ".pdf";
}

bool isHtml(const std::string& file)
{
  return scene::lowerCase(file.substr(file.size() - std::min<std::size_t>(file.size(), 5))) ==
         ".html";
}

std::string pdfOf(const presenters::PlanReport& report, const core::Progress& progress)
{
#ifdef PETROUS_PDF
  return report::pdfOf(report, progress);
#else
  static_cast<void>(report);
  static_cast<void>(progress);
  throw UsageError("report: this program was built without Qt and writes .html only");
#endif
}

nlohmann::json cellJson(const presenters::ReportCell& cell)
{
  if (!cell.value)
    return cell.text;
  return {{"text", cell.text},
          {"value", *cell.value},
          {"uncertainty",
           cell.uncertainty ? nlohmann::json(*cell.uncertainty) : nlohmann::json(nullptr)}};
}

nlohmann::json sectionsJson(const presenters::PlanReport& report)
{
  nlohmann::json sections = nlohmann::json::array();
  for (const presenters::ReportSection& section : report.sections)
  {
    nlohmann::json rows = nlohmann::json::array();
    for (const auto& row : section.table.rows)
    {
      nlohmann::json cells = nlohmann::json::array();
      for (const presenters::ReportCell& cell : row)
        cells.push_back(cellJson(cell));
      rows.push_back(std::move(cells));
    }
    sections.push_back({{"id", section.id},
                        {"title", section.title},
                        {"paragraphs", section.paragraphs},
                        {"pictures", section.pictures.size()},
                        {"columns", section.table.columns},
                        {"rows", std::move(rows)}});
  }
  return sections;
}

void report(Context& context, const Options& options)
{
  if (!isPdf(options.out) && !isHtml(options.out))
    throw UsageError("--out: a report's name ends in .pdf or .html, not '" + options.out + "'");
  context.refuseOverwriting({options.out});
  const library::Library library = context.openLibrary();
  scene::Case value = library.open(options.caseName);
  library.loadDissection(value);
  const presenters::LeftOut leftOut =
      leaveOutDamaged(context, library, value, options.withoutDamaged);
  warnMissingPlaces(context, value);
  warnOutdated(context, value);
  const presenters::IdentityText identity(value, library);
  presenters::ReportOptions wanted;
  wanted.approach = options.approach;
  wanted.language = options.language == "de" ? presenters::ReportLanguage::German
                                             : presenters::ReportLanguage::English;
  wanted.keepIdentity = options.keepIdentity;
  wanted.background = options.background;
  wanted.withDate = !options.withoutDate;
  wanted.made = core::today();
  wanted.version = PETROUS_VERSION;
  wanted.mayIdentify = [&identity](const std::string& text) { return identity.mayIdentify(text); };
  wanted.mayIdentifySentence = [&identity](const std::string& text)
  { return identity.mayIdentifySentence(text); };
  wanted.isOfField = [&identity](const std::string& text) { return identity.isOfField(text); };
  const core::Progress progress = context.progress();
  const presenters::PlanReport plan =
      presenters::planReport(value, wanted, progress.part(0.0, 0.9));
  const std::string bytes =
      isPdf(options.out) ? pdfOf(plan, progress.part(0.9, 1.0)) : presenters::htmlOf(plan);
  context.refuseDamaged();
  core::writeFile(options.out, bytes);
  for (const std::string& line : plan.mayIdentify)
    context.warn("the report has " + line);
  context.print(options.out + ": plan of '" + value.name + "'");
  context.printJson({{"case", value.name},
                     {"out", options.out},
                     {"name", plan.name},
                     {"language", options.language},
                     {"bytes", bytes.size()},
                     {"may_identify", plan.mayIdentify},
                     {"sections", sectionsJson(plan)},
                     {"left_out", leftOutJson(value, leftOut)}});
}

} // namespace

void addReportCommand(CLI::App& app, Context& context)
{
  auto options = std::make_shared<Options>();
  CLI::App* command = context.addCommand(
      app, "report",
      "The plan on paper: pictures, distances with uncertainty, strokes, measurements, "
      "registration, and what was assumed at import",
      [options, &context] { report(context, *options); });
  command->add_option("CASE", options->caseName, "Name of the case")->required();
  command->add_option("--out", options->out, "Report to write, one file")
      ->type_name("F.pdf|F.html")
      ->required();
  command
      ->add_option("--approach", options->approach,
                   "Branch that is reported, by its name or its number in 'petrous branch CASE "
                   "--list', from 1 (the present one)")
      ->type_name("N");
  command->add_option("--language", options->language, "de or en (en)")->check(oneOf({"de", "en"}));
  addBackgroundOption(*command, options->background);
  command->add_flag("--keep-identity", options->keepIdentity,
                    "With names and the note as they were typed, and who signed registrations: not "
                    "to be handed on");
  command->add_flag("--without-date", options->withoutDate,
                    "Without the date of the planned operation");
  addWithoutDamaged(*command, options->withoutDamaged);
}

} // namespace petrous::cli
