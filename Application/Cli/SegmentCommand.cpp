#include <algorithm>
#include <optional>

#include "CaseJson.h"
#include "Commands.h"
#include "Numbers.h"
#include "petrous/Core/AsciiCase.h"
#include "petrous/Presenters/CaseBuilder.h"
#include "petrous/Presenters/IntensityDisplay.h"
#include "petrous/Presenters/MrOnCt.h"
#include "petrous/Presenters/RegionText.h"
#include "petrous/Scene/FreeName.h"
#include "petrous/Segmentation/MaskOperations.h"
#include "petrous/Segmentation/TubeTrace.h"

namespace petrous::cli
{

namespace
{

struct SegmentOptions
{
  std::string caseName, name;
  std::string threshold, source = "ct", tube, radius = "auto";
  std::vector<std::string> seeds;
  double margin = 0.0, smooth = 0.0, smallest = 0.0;
  bool largest = false, fill = false, replace = false;
  const CLI::App* command = nullptr;

  bool given(const char* option) const { return command->count(option) > 0; }
};

constexpr const char* kAutomatic = "auto";

/// The image of that name, which has a place on the CT.
const scene::ImagePart& sourceOf(const scene::Case& value, const std::string& name)
{
  if (name == "ct")
    return value.ct;
  const scene::ImagePart* mr = scene::findMr(value, name);
  if (!mr)
  {
    std::string there = "ct";
    for (const auto& part : value.mr)
      there += ", " + part.name;
    throw core::InvalidParameter("no image '" + name + "' in case '" + value.name +
                                 "'; there are: " + there);
  }
  if (!mr->registered)
    throw core::InvalidParameter("MR '" + name +
                                 "' is not registered, so its place on the CT is not known; "
                                 "register it first (petrous register '" +
                                 value.name + "' --mr '" + name + "')");
  return *mr;
}

/// The result of either way, and what is said of it.
struct Made
{
  segmentation::Mask mask;
  nlohmann::json facts = nlohmann::json::object();
  std::vector<std::string> lines, warnings;
  std::vector<std::string> notes = {}; ///< of the warnings those that are kept, as sentences
  scene::TracedTubes tubes = {};
  bool isGrown = false; ///< from seeds
};

// What is kept of it is said as well, as warnings are: no capital and no full stop.
void appendNotes(Made& made)
{
  for (const std::string& note : made.notes)
    made.warnings.push_back(core::asciiLower(note.front()) + note.substr(1, note.size() - 2));
}

// The brightest region of an MR, its seed in the CT's patient space.
segmentation::ProposedRegion proposedRegion(const SegmentOptions& options, const scene::Case& value,
                                            const scene::ImagePart& source,
                                            const core::Progress& progress)
{
  if (&source == &value.ct && value.ct.modality != scene::Modality::Mr)
    throw UsageError("--seed auto: the brightest region is that of an MR; give one as --source");
  auto region = segmentation::proposedRegion(*source.volume.get(), progress);
  if (!region)
    throw core::InvalidParameter("image '" + options.source +
                                 "' has no region that is brighter than what surrounds it; give "
                                 "--seed x,y,z");
  if (&source != &value.ct)
    region->seed = source.mrFromCt.inverse() * region->seed;
  return *region;
}

Made region(const SegmentOptions& options, const scene::Case& value, const scene::ImagePart& source,
            const core::Progress& progress)
{
  const auto own = source.volume.get();
  const auto onCt =
      &source == &value.ct
          ? own
          : presenters::mrOnCt(*own, value.ct.geometry, source.mrFromCt, progress.part(0.0, 0.2));
  const volume::IntensityVolume& image = *onCt;
  const bool isHounsfield = options.source == "ct" && presenters::displayOf(value).hounsfield;
  const std::string unit = isHounsfield ? " HU" : "";
  Made made;
  const auto note = [&made](std::string text)
  {
    if (!text.empty())
      made.notes.push_back(std::move(text));
  };
  volume::ValueRange range;
  std::vector<Eigen::Vector3d> seeds;
  std::optional<segmentation::ProposedRegion> proposed;
  for (const std::string& text : options.seeds)
  {
    if (text == kAutomatic)
    {
      proposed = proposedRegion(options, value, source, progress.part(0.2, 0.3));
      seeds.push_back(proposed->seed);
      continue;
    }
    const auto seed = parseNumbers(text, 3, "--seed");
    seeds.emplace_back(seed[0], seed[1], seed[2]);
  }
  if (options.threshold != kAutomatic)
  {
    const auto limits = parseNumbers(options.threshold, 2, "--threshold");
    range = {limits[0], limits[1]};
    if (range.min > range.max)
      throw UsageError("--threshold: " + options.threshold +
                       " begins above its end; give the lower limit first");
  }
  else if (proposed)
    range = proposed->range;
  else if (!seeds.empty())
  {
    const auto surroundings = segmentation::surroundingsOf(image, seeds.front());
    range =
        segmentation::rangeAround(image, seeds.front(), surroundings, 2.5, progress.part(0.0, 0.3));
    note(presenters::seedText(surroundings, seeds.front(), unit));
  }
  else
    range = segmentation::proposedRange(volume::IntensityHistogram(image),
                                        options.source == "ct" ? std::optional(value.iso)
                                                               : std::nullopt);
  made.mask = seeds.empty() ? segmentation::threshold(image, range, progress.part(0.3, 0.6))
                            : segmentation::connectedThreshold(image, range, seeds,
                                                               progress.part(0.3, 0.6), unit);
  if (made.mask.count == 0)
  {
    const volume::ValueRange all = image.range();
    throw core::InvalidParameter("nothing lies between " + core::plainText(range.min) + " and " +
                                 core::plainText(range.max) + unit + "; the image has " +
                                 fixed(all.min, 1) + " to " + fixed(all.max, 1) + unit);
  }
  made.isGrown = !seeds.empty();
  if (made.isGrown)
    note(
        presenters::rangeText(range, unit, isHounsfield ? std::optional(value.iso) : std::nullopt));
  made.facts["threshold"] = {range.min, range.max};
  made.lines.push_back("  between " + core::plainText(range.min) + " and " +
                       core::plainText(range.max) + unit +
                       (seeds.empty() ? "" : ", connected with the seed"));
  return made;
}

Made tube(const SegmentOptions& options, const scene::Case& value, const scene::ImagePart& source,
          const core::Progress& progress)
{
  std::optional<double> given;
  if (options.radius != kAutomatic)
  {
    given = parseNumbers(options.radius, 1, "--radius")[0];
    const core::NumberRange allowed = segmentation::TubeOptions::kRadii;
    if (!allowed.contains(*given))
      throw UsageError("--radius: " + allowed.refusal(*given, kAutomatic));
  }
  const segmentation::TubeOptions tracing = segmentation::tubeOptionsFor(
      options.name, given, &source == &value.ct && presenters::displayOf(value).hounsfield);
  const segmentation::Tube tube =
      presenters::traceOnCt(*source.volume.get(), source.mrFromCt, readPoints(options.tube),
                            tracing, progress.part(0.0, 0.6));
  const segmentation::TubeLabel label = segmentation::labelTube(
      tube, value.ct.geometry, {options.name, 1, {}, 0}, 1.0, progress.part(0.6, 0.8));
  Made made;
  made.mask = segmentation::maskOf(label.map, 1);
  made.tubes = presenters::tracedTubes(tube, label);
  if (made.mask.count == 0)
    throw core::InvalidParameter("the tube lies outside of the image");
  const double farthest = *std::max_element(tube.pointDistances.begin(), tube.pointDistances.end());
  made.facts = {
      {"length_mm", tube.length},
      {"resolved_mm", tube.resolvedLength},
      {"unresolved", nlohmann::json::array()},
      {"bridging_voxels", label.bridging},
      {"radius_mm",
       {{"min", tube.smallestRadius}, {"median", tube.radius}, {"max", tube.largestRadius}}},
      {"points_to_path_mm", {{"max", farthest}, {"each", tube.pointDistances}}}};
  for (const segmentation::TubeStretch& stretch : segmentation::unresolvedStretches(tube))
    made.facts["unresolved"].push_back({{"from_mm", stretch.from},
                                        {"to_mm", stretch.to},
                                        {"why", presenters::nameOf(stretch.doubt)}});
  nlohmann::json line = nlohmann::json::array();
  for (const Eigen::Vector3d& p : tube.line)
    line.push_back({p[0], p[1], p[2]});
  made.facts["path_mm"] = std::move(line);
  made.lines.push_back("  " + fixed(tube.length, 1) + " mm long, radius " +
                       fixed(tube.smallestRadius, 2) + " to " + fixed(tube.largestRadius, 2) +
                       " mm, median " + fixed(tube.radius, 2) + " mm; the points lie up to " +
                       fixed(farthest, 2) + " mm from its path");
  if (const std::string order = presenters::likelyOrderText(tube.points); !order.empty())
    made.warnings.push_back("the points seem not to be in their order along the structure: " +
                            order + " would make a much shorter line");
  for (std::size_t n = 0; n < tube.points.size(); ++n)
    if (tube.outsideAtPoint[n] != 0)
      made.warnings.push_back("point " + std::to_string(n + 1) + " lies " +
                              fixed(tube.pointDistances[n], 2) +
                              " mm from the path, outside of the tube: move the point, or add one "
                              "beside it");
  if (label.bridging > 0)
    made.warnings.push_back(presenters::bridgingText(label));
  constexpr double kTenth = 0.1;
  if (tube.resolvedLength < tube.length * (1.0 - kTenth))
    made.warnings.push_back("the image resolves " + fixed(tube.resolvedLength, 1) + " of " +
                            fixed(tube.length, 1) + " mm; elsewhere " +
                            (segmentation::hasUsualRadius(tube, tracing)
                                 ? "its path follows the points alone"
                                 : "path and radius follow the points alone"));
  made.notes = presenters::unresolvedTexts(tube, tracing);
  return made;
}

/// Takes the structure of that name out of the case and returns it, if there was one. A mesh or an
/// MR may have the name of a structure, and removePart would take these too.
std::optional<scene::StructurePart> takeOut(scene::Case& value, const SegmentOptions& options)
{
  const bool isMesh = scene::findMesh(value, options.name) != nullptr;
  if (isMesh || scene::findMr(value, options.name))
    throw core::Error(core::Fault::Refused,
                      std::string(isMesh ? "a mesh" : "an MR") + " of case '" + value.name +
                          "' is called '" + options.name +
                          "'; give the structure another name (--replace replaces "
                          "structures only)");
  const scene::StructurePart* there = scene::findStructure(value, options.name);
  if (!there)
  {
    scene::checkNewPartName(value, {}, options.name);
    return std::nullopt;
  }
  if (!options.replace)
    throw core::Error(core::Fault::Refused, "structure '" + options.name + "' is in case '" +
                                                value.name +
                                                "' already; give another name, or --replace");
  const scene::StructurePart taken = *there;
  scene::removePart(value, options.name);
  return taken;
}

void segment(Context& context, const SegmentOptions& options)
{
  const bool isTube = options.given("--tube");
  if (isTube == options.given("--threshold"))
    throw UsageError("segment: give --threshold LO,HI or --tube FILE");
  for (const char* of : {"--seed", "--keep-largest", "--min-volume", "--fill"})
    if (isTube && options.given(of))
      throw UsageError(std::string("segment: ") + of + " goes with --threshold");
  if (!isTube && options.given("--radius"))
    throw UsageError("segment: --radius goes with --tube");

  library::Library library = context.openLibrary();
  scene::Case value = library.open(options.caseName);
  scene::checkPartName(options.name);
  const auto replaced = takeOut(value, options); // before the work
  const core::Progress progress = context.progress();
  const scene::ImagePart& source = sourceOf(value, options.source);
  const core::Progress making = progress.part(0.0, 0.7);
  Made made =
      isTube ? tube(options, value, source, making) : region(options, value, source, making);

  segmentation::Mask& mask = made.mask;
  const core::Progress shaping = progress.part(0.7, 0.9);
  if (options.largest)
    mask = segmentation::largestIsland(mask, shaping);
  if (options.smallest > 0.0)
    mask = segmentation::withoutSmallIslands(mask, options.smallest, shaping);
  if (options.fill)
    mask = segmentation::filled(mask, shaping);
  if (options.smooth > 0.0)
    mask = segmentation::smoothedOutline(mask, options.smooth, shaping);
  if (options.margin != 0.0)
    mask = segmentation::margin(mask, options.margin, shaping);
  if (mask.count == 0)
    throw core::InvalidParameter("nothing is left of structure '" + options.name +
                                 "'; use a smaller --min-volume or --margin");

  if (made.isGrown)
    for (std::string& text : presenters::regionTexts(mask))
      made.notes.push_back(std::move(text));
  appendNotes(made);

  presenters::addStructures(value, segmentation::labelMapOf(mask, {options.name, 1, {}, 0}));
  auto& notes = value.labels.back().notes;
  notes.insert(notes.end(), made.notes.begin(), made.notes.end());
  if (replaced)
    presenters::keepIdentity(*scene::findStructure(value, options.name), *replaced);
  scene::findStructure(value, options.name)->tubes = made.tubes;
  if (&source != &value.ct)
    scene::findStructure(value, options.name)->readings = {scene::readingOf(source)};
  context.refuseDamaged();
  library.save(value, progress.part(0.9, 1.0));
  const scene::StructurePart& structure = *scene::findStructure(value, options.name);

  for (const std::string& warning : made.warnings)
    context.warn(warning);
  context.print("structure '" + options.name + "': " + std::to_string(mask.count) + " voxels, " +
                fixed(mask.volume(), 1) + " mm3, " + structure.look.preset);
  for (const std::string& line : made.lines)
    context.print(line);
  if (!structure.readings.empty())
    context.print("  made from the MR " + scene::namesOf(structure.readings) +
                  ": it has the error of its registration, and stays where it is if that MR is "
                  "moved");
  nlohmann::json result = {{"case", value.name},          {"label", options.name},
                           {"index", structure.index},    {"voxels", mask.count},
                           {"volume_mm3", mask.volume()}, {"source", options.source},
                           {"warnings", made.warnings}};
  result.update(made.facts);
  context.printJson(result);
}

} // namespace

void addSegmentCommand(CLI::App& app, Context& context)
{
  auto options = std::make_shared<SegmentOptions>();
  CLI::App* command =
      context.addCommand(app, "segment", "Make a structure from the images of a case",
                         [options, &context] { segment(context, *options); });
  options->command = command;
  command->add_option("CASE", options->caseName, "Name of the case")->required();
  command->add_option("NAME", options->name, "Name of the structure")->required();
  command
      ->add_option("--threshold", options->threshold,
                   "Voxels with an intensity from LO to HI (HU on a CT); auto: around the seed, "
                   "or, without one, bone or the brightest tissue of an MR")
      ->type_name("LO,HI|auto");
  command
      ->add_option("--seed", options->seeds,
                   "Only what is connected with this patient point, LPS mm; may be repeated. auto: "
                   "the brightest region of an MR")
      ->allow_extra_args(false)
      ->type_name("x,y,z|auto");
  command->add_option("--source", options->source, "The image: ct, or a registered MR")
      ->type_name("ct|MR")
      ->capture_default_str();
  command
      ->add_option("--tube", options->tube,
                   "A nerve or vessel through points x_mm,y_mm,z_mm, from start to end")
      ->type_name("FILE.csv");
  command->add_option("--radius", options->radius, "Of the tube; auto: measured along it")
      ->type_name("MM|auto")
      ->capture_default_str();
  command->add_flag("--keep-largest", options->largest, "Only the largest connected part");
  command->add_option("--min-volume", options->smallest, "Without connected parts below this, mm3")
      ->check(within({0.0, 1e7, "mm3"}));
  command->add_flag("--fill", options->fill, "With the cavities inside");
  command
      ->add_option("--smooth", options->smooth,
                   "Standard deviation of the Gaussian that smooths the surface, mm")
      ->check(within({0.0, 20.0, "mm"}));
  command->add_option("--margin", options->margin, "Grow by this distance; negative: shrink, mm")
      ->check(within({-50.0, 50.0, "mm"}));
  command->add_flag("--replace", options->replace,
                    "Instead of the structure of that name, with its appearance");
}

} // namespace petrous::cli
