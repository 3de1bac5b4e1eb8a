#include <algorithm>

#include "CaseWarnings.h"
#include "Commands.h"
#include "Numbers.h"
#include "petrous/Core/InputFile.h"
#include "petrous/Core/OutputFile.h"
#include "petrous/Presenters/CasePicture.h"
#include "petrous/Presenters/Recordings.h"
#include "petrous/Presenters/SessionReview.h"

namespace petrous::cli
{

namespace
{

struct Options
{
  std::string caseName, out, course;
  std::vector<std::string> files;
  bool withoutDamaged = false;
};

std::vector<std::filesystem::path> filesOf(const Options& options, const library::Library& library)
{
  std::vector<std::filesystem::path> files(options.files.begin(), options.files.end());
  for (const std::string& file : options.files)
    core::InputFile{file}; // throws, naming a missing file
  if (!files.empty())
    return files;
  const auto all = presenters::inOperations(presenters::recordingsOf(library, options.caseName));
  if (all.empty())
    throw core::InvalidParameter("the library has no recording of case '" + options.caseName +
                                 "'; name the files");
  return all.front();
}

nlohmann::json numberOrNull(const std::optional<double>& value)
{
  return value ? nlohmann::json(*value) : nlohmann::json(nullptr);
}

nlohmann::json reviewJson(const presenters::SessionReview& review)
{
  const presenters::SessionMetrics& m = review.metrics;
  nlohmann::json structures = nlohmann::json::array();
  for (const auto& one : review.structures)
    structures.push_back({{"label", one.name},
                          {"nearest_mm", numberOrNull(one.nearest)},
                          {"removed_mm3", numberOrNull(one.removed)}});
  nlohmann::json answer{{"duration_s", m.duration},
                        {"drilling_s", m.drilling},
                        {"drill_starts", m.drillStarts},
                        {"path_mm", m.path},
                        {"drilling_path_mm", m.drillingPath},
                        {"mean_force_drilling_n", m.meanForce},
                        {"max_force_n", m.maxForce},
                        {"max_thrust_n", m.maxThrust},
                        {"strokes", nullptr},
                        {"removed_mm3", numberOrNull(review.removed)},
                        {"structures", std::move(structures)}};
  if (review.removed)
    answer["strokes"] = review.strokes;
  return answer;
}

std::string lineOf(const presenters::SessionReview& review)
{
  const presenters::SessionMetrics& m = review.metrics;
  return fixed(m.duration, 1) + " s (" + fixed(m.drilling, 1) + " s drilling), path " +
         fixed(m.path, 0) + " mm, force at most " + fixed(m.maxForce, 2) + " N, mean " +
         fixed(m.meanForce, 2) + " N drilling, " +
         (review.removed ? fixed(*review.removed, 2) + " mm3 removed in " +
                               std::to_string(review.strokes) + " strokes"
                         : "removed volume not known");
}

void review(const Context& context, const Options& options)
{
  library::Library library = context.openLibrary();
  const auto files = filesOf(options, library);
  const core::Progress progress = context.progress();
  scene::Case value = library.open(options.caseName);
  library.loadDissection(value);
  value.ct.volume.get();
  library.checkVoxels(value, progress);
  const auto leftOut = leaveOutDamaged(context, library, value, options.withoutDamaged);
  warnOutdated(context, value);
  const presenters::OperationReview whole = presenters::reviewOperation(files, value, progress);

  nlohmann::json parts = nlohmann::json::array();
  for (const auto& [name, begin, part] : whole.parts)
  {
    if (!part.warning.empty())
      context.warn(name + ": " + part.warning);
    if (!part.whyUnmeasured.empty())
      context.warn(name + ": what was drilled is not known here: the recording " +
                   part.whyUnmeasured);
    context.print(name + ": " + part.tool + "; " + lineOf(part));
    nlohmann::json one = reviewJson(part);
    one["file"] = name;
    one["tool"] = part.tool;
    one["begin_s"] = begin;
    parts.push_back(std::move(one));
  }
  if (whole.parts.size() > 1)
    context.print("together: " + lineOf(whole));
  for (const auto& one : whole.structures)
    context.print("    " + one.name + ": nearest " +
                  (one.nearest ? fixed(*one.nearest, 2) + " mm" : std::string("not known")) +
                  (one.removed ? ", " + fixed(*one.removed, 2) + " mm3 removed" : std::string()));
  if (!options.out.empty())
    core::writeFile(options.out, presenters::operationCsv(whole));
  if (!options.course.empty())
    core::writeFile(options.course, presenters::operationCourseCsv(whole));
  context.printJson({{"case", value.name},
                     {"parts", std::move(parts)},
                     {"total", reviewJson(whole)},
                     {"left_out", leftOutJson(value, leftOut)}});
}

} // namespace

void addReviewCommand(CLI::App& app, Context& context)
{
  auto options = std::make_shared<Options>();
  CLI::App* command = context.addCommand(
      app, "review", "Time, path, force, distances and volumes of an operation's recordings",
      [options, &context]
      {
        context.refuseOverwriting({options->out, options->course}, options->files);
        review(context, *options);
      });
  command->add_option("CASE", options->caseName)->required();
  command->add_option(
      "FILES", options->files,
      "Recordings in order (*.ticks); else those of the case's last operation in the "
      "library");
  command->add_option("--out", options->out, "CSV with a row per recording and one of the total")
      ->type_name("F.csv");
  command
      ->add_option("--course", options->course, "CSV of place and force over time, of all of them")
      ->type_name("F.csv");
  addWithoutDamaged(*command, options->withoutDamaged);
}

} // namespace petrous::cli
