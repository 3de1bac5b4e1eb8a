#include <algorithm>
#include <utility>

#include "CaseJson.h"
#include "CaseWarnings.h"
#include "Commands.h"
#include "MaskOptions.h"
#include "Numbers.h"
#include "PartNamed.h"
#include "petrous/Imaging/FileFormats.h"
#include "petrous/Presenters/CaseExport.h"

namespace petrous::cli
{

namespace
{

struct Options : presenters::ExportOptions
{
  std::string caseName;
  bool withoutDamaged = false;
  MaskOptions masking;
};

void printSummary(const Context& context, const scene::Case& value, const Options& options,
                  const presenters::ExportSummary& done, const presenters::LeftOut& leftOut,
                  const std::vector<std::string>& notes)
{
  nlohmann::json json{{"case", value.name}, {"what", options.what}, {"out", options.out}};
  const auto give = [&json](const char* key, const auto& number)
  {
    if (number)
      json[key] = *number;
  };
  give("instances", done.instances);
  give("segments", done.segments);
  give("layers", done.layers);
  give("names", done.names);
  give("triangles", done.triangles);
  give("volume_mm3", done.volume);
  give("voxels_mm3", done.voxelsVolume);
  for (const auto& one : done.resampled)
    json["resampled"].push_back(
        {{"name", one.name}, {"own_mm3", one.own}, {"written_mm3", one.written}});
  if (done.triangles)
  {
    json["closed"] = done.closed;
    json["decimation"] = "none";
  }
  if (done.decimation)
    json["decimation"] = {
        {"triangles_before", done.decimation->trianglesBefore},
        {"triangles_asked", done.decimation->trianglesAsked},
        {"hausdorff_mm", std::max(done.decimation->fromFull, done.decimation->toFull)},
        {"from_full_mm", done.decimation->fromFull},
        {"to_full_mm", done.decimation->toFull},
        {"mean_mm", done.decimation->mean},
        {"self_intersections", done.decimation->selfIntersections}};
  json["coordinates"] = presenters::coordinatesOf(options);
  context.print(options.out + ": " + options.what + " of '" + value.name + "'" + done.words + "; " +
                presenters::coordinatesOf(options));
  json["left_out"] = leftOutJson(value, leftOut);
  if (done.patient)
  {
    json["patient_id"] = done.patient->id;
    json["patient_name"] = done.patient->name;
  }
  json["notes"] = notes;
  context.printJson(json);
}

void exportCase(const Context& context, Options options)
{
  try
  {
    options.mask = options.masking.mask();
    context.refuseOverwriting(presenters::exportedFiles(options)); // before anything is computed
    const library::Library library = context.openLibrary();
    scene::Case value = library.open(options.caseName);
    if (!options.part.empty())
      options.part = partNamed(value, options.part);
    presenters::LeftOut leftOut;
    // Labels that are written are read, and thus checked; the surface is that of all structures.
    if (options.what == "surface" || (options.what == "labels" && options.withoutDamaged))
      leftOut = leaveOutDamaged(context, library, value, options.withoutDamaged);
    std::vector<std::string> notes;
    const auto done = presenters::exportCase(
        library, value, options, leftOut,
        [&](const std::string& line)
        {
          notes.push_back(line);
          context.warn(line);
        },
        context.progress());
    printSummary(context, value, options, done, leftOut, notes);
  }
  catch (const presenters::ExportChoiceError& error)
  {
    throw UsageError(error.what());
  }
}

} // namespace

void addExportCommand(CLI::App& app, Context& context)
{
  auto options = std::make_shared<Options>();
  CLI::App* command = context.addCommand(app, "export", "Voxels or a surface for other programs",
                                         [options, &context] { exportCase(context, *options); });
  command->add_option("CASE", options->caseName)->required();
  command
      ->add_option("--what", options->what, "ct, mr, labels, mask, dissected, surface or structure")
      ->check(oneOf({"ct", "mr", "labels", "mask", "dissected", "surface", "structure"}))
      ->required();
  command
      ->add_option(
          "--out", options->out,
          "Voxels: " + imaging::orText(imaging::writtenEndings(imaging::kImage)) + "; labels: " +
              imaging::orText(imaging::writtenEndings(presenters::exportContent("labels"))) +
              "; surface, structure: " + imaging::orText(imaging::writtenEndings(imaging::kMesh)) +
              "; LPS (DICOM, ITK), mm, NIfTI RAS. FOLDER/: ct, mr or dissected as a DICOM series")
      ->type_name("F")
      ->required();
  auto* part = command->add_option("--part", options->part, "One MR or structure of several")
                   ->type_name("NAME");
  command->add_option("NAME", options->part, "As --part: 'export ear --what structure NAME'")
      ->excludes(part);
  command->add_flag("--on-ct", options->onCt,
                    "An MR, or labels of several lattices, resampled on the CT's grid");
  command
      ->add_option("--triangles", options->triangles,
                   "A surface of at most about N triangles; how far it lies off is printed")
      ->type_name("N")
      ->check(CLI::Range(std::size_t{4}, std::size_t{1} << 32));
  addMaskOptions(*command, options->masking);
  addWithoutDamaged(*command, options->withoutDamaged);
}

} // namespace petrous::cli
