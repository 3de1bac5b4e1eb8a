#include <cmath>

#include "AppearanceList.h"
#include "Commands.h"
#include "Numbers.h"
#include "petrous/Appearance/DistinctColors.h"
#include "petrous/Appearance/StructurePresets.h"
#include "petrous/Core/InputFile.h"
#include "petrous/Dissection/MaterialCatalogue.h"
#include "petrous/Presenters/IntensityDisplay.h"
#include "petrous/Volume/IntensityScale.h"

namespace petrous::cli
{

namespace
{

using appearance::StructureAppearance;

struct Options
{
  std::string name, iso;
  std::vector<std::string> set, tf, color, opacity, source, flags, stiffness, warn, tissue;
  bool list = false;
  bool presets = false;

  bool changes() const
  {
    return !iso.empty() || !set.empty() || !tf.empty() || !color.empty() || !opacity.empty() ||
           !source.empty() || !flags.empty() || !stiffness.empty() || !warn.empty() ||
           !tissue.empty();
  }
};

/// Everything of one name in the case: a structure, a mesh, both, or bone.
struct Part
{
  std::string name;
  std::vector<StructureAppearance*> looks;
  bool bone = false;
  bool meshOnly = false;
};

std::optional<Part> findPart(scene::Case& value, const std::string& name)
{
  Part part;
  part.name = name;
  if (scene::meansBone(value, name))
  {
    part.bone = true;
    part.looks = {&value.boneLook};
    return part;
  }
  if (auto* structure = scene::findStructure(value, name))
    part.looks.push_back(&structure->look);
  part.meshOnly = part.looks.empty();
  if (auto* mesh = scene::findMesh(value, name))
    part.looks.push_back(&mesh->look);
  return part.looks.empty() ? std::nullopt : std::optional(part);
}

std::string lookedAtParts(const scene::Case& value)
{
  std::string there = "ct";
  for (const auto& labels : value.labels)
    for (const auto& structure : labels.structures)
      there += ", " + structure.name;
  for (const auto& mesh : value.meshes)
    if (!scene::findStructure(value, mesh.name))
      there += ", " + mesh.name;
  return there;
}

/// Splits "PART=VALUE". A name may contain '=', so the first split whose left side names a part is
/// used.
std::pair<Part, std::string> split(scene::Case& value, const std::string& assignment,
                                   const std::string& usage)
{
  const auto first = assignment.find('=');
  if (first == std::string::npos || first == 0)
    throw UsageError(usage + ": there is no PART= in '" + assignment + "'");
  for (auto at = first; at != std::string::npos; at = assignment.find('=', at + 1))
    if (auto part = findPart(value, assignment.substr(0, at)))
      return {std::move(*part), assignment.substr(at + 1)};
  throw core::InvalidParameter("case '" + value.name + "' has no structure or mesh '" +
                               assignment.substr(0, first) + "'; it has " + lookedAtParts(value));
}

void setIso(const Context& context, scene::Case& value, const std::string& text)
{
  if (text == "auto")
  {
    const auto scale = volume::suggestScale(volume::IntensityHistogram(*value.ct.volume.get()));
    context.refuseDamaged();
    value.iso = scale.iso;
    value.denseBone = scale.dense;
    if (!scale.calibrated)
      context.warn("the image is not in Hounsfield units; bone is taken to begin at " +
                   fixed(scale.iso, 1) + " and to be dense at " + fixed(scale.dense, 1));
    return;
  }
  const double iso = parseNumbers(text, 1, "--iso").front();
  const presenters::IntensityDisplay display = presenters::displayOf(value);
  const double least = std::min(-32767.0, value.ct.range.min);
  const double most = std::max(32767.0, value.ct.range.max);
  if (iso < least || iso > most)
    throw UsageError("--iso: must lie within " + display.number(least) + " to " +
                     display.text(most) + ", or be 'auto'");
  value.iso = iso;
}

// Colours of all other parts.
std::vector<std::array<float, 3>> otherColors(const scene::Case& value, const std::string& part)
{
  std::vector<std::array<float, 3>> colors;
  for (const auto& labels : value.labels)
    for (const auto& structure : labels.structures)
      if (structure.name != part)
        colors.push_back(structure.look.color);
  for (const auto& mesh : value.meshes)
    if (mesh.name != part)
      colors.push_back(mesh.look.color);
  return colors;
}

void setPreset(scene::Case& value, const std::string& assignment)
{
  const auto [part, name] = split(value, assignment, "--set PART=PRESET");
  const StructureAppearance preset = appearance::StructurePresets::builtIn().preset(name);
  if (part.bone && !preset.solid)
    throw core::InvalidParameter("preset '" + preset.preset +
                                 "' is that of a lumen and cannot be the look of bone");
  for (StructureAppearance* look : part.looks)
    appearance::applyPreset(*look, preset);
  // An unknown structure gets a distinct colour, as when it was added to the case.
  if (preset.preset == appearance::StructurePresets::builtIn().lookFor({}).preset)
  {
    const auto color = appearance::distinctColor(otherColors(value, part.name));
    for (StructureAppearance* look : part.looks)
      appearance::setColor(*look, color);
  }
}

void setTransfer(scene::Case& value, const std::string& assignment)
{
  const auto [part, path] = split(value, assignment, "--tf PART=F.json");
  if (part.meshOnly)
    throw core::InvalidParameter("'" + part.name +
                                 "' is a mesh and has no intensities; use --color and --opacity");
  std::optional<appearance::TransferFunction> transfer;
  if (path != "none")
    try
    {
      transfer = appearance::TransferFunction::fromJson(core::readFile(path, kLargestJson));
    }
    catch (const core::InvalidParameter& error)
    {
      const std::string what = error.what();
      throw core::InvalidParameter(what.find(path) == std::string::npos ? path + ": " + what
                                                                        : what);
    }
  for (StructureAppearance* look : part.looks)
  {
    look->transfer = transfer;
    look->relative = false;
  }
}

std::array<float, 3> parseColor(const std::string& text)
{
  std::array<float, 3> color{};
  if (!text.empty() && text.front() == '#')
  {
    if (text.size() != 7 || text.find_first_not_of("0123456789abcdefABCDEF", 1) != text.npos)
      throw UsageError("--color: '" + text + "' is not #rrggbb");
    for (std::size_t c = 0; c < 3; ++c)
      color[c] = static_cast<float>(std::stoi(text.substr(1 + 2 * c, 2), nullptr, 16)) / 255.0F;
    return color;
  }
  const auto numbers = parseNumbers(text, 3, "--color PART=r,g,b");
  for (std::size_t c = 0; c < 3; ++c)
  {
    if (numbers[c] < 0.0 || numbers[c] > 1.0)
      throw UsageError("--color: red, green and blue go from 0 to 1; or give #rrggbb");
    color[c] = static_cast<float>(numbers[c]);
  }
  return color;
}

void setColors(scene::Case& value, const std::string& assignment)
{
  const auto [part, text] = split(value, assignment, "--color PART=r,g,b");
  const auto color = parseColor(text);
  for (StructureAppearance* look : part.looks)
    appearance::setColor(*look, color);
}

void setOpacity(scene::Case& value, const std::string& assignment)
{
  const auto [part, text] = split(value, assignment, "--opacity PART=0..1");
  const double opacity = parseNumbers(text, 1, "--opacity").front();
  if (opacity < 0.0 || opacity > 1.0)
    throw UsageError("--opacity: goes from 0 to 1, not " + text);
  for (StructureAppearance* look : part.looks)
    look->opacity = static_cast<float>(opacity);
}

void setSource(const Context& context, scene::Case& value, const std::string& assignment)
{
  const auto [part, name] = split(value, assignment, "--source PART=ct|MRNAME");
  if (part.meshOnly)
    throw core::InvalidParameter("'" + part.name + "' is a mesh and reads no image");
  StructureAppearance& look = *part.looks.front();
  const scene::ImagePart* mr = scene::findMr(value, name);
  if (name == "ct")
    look.sourceImage.clear();
  else if (!mr)
  {
    std::string there;
    for (const auto& image : value.mr)
      there += ", " + image.name;
    throw core::InvalidParameter("case '" + value.name + "' has no MR '" + name +
                                 "'; a part can read ct" + there);
  }
  else if (!look.solid)
    throw core::InvalidParameter("'" + part.name +
                                 "' is a lumen: it tints the bone around it and reads the CT");
  else
  {
    look.sourceImage = name;
    if (!mr->registered)
      context.warn("'" + name + "' is not registered with the CT; until it is, '" + part.name +
                   "' is drawn in one colour");
    if (!look.transfer || look.relative)
      context.warn("presets are made for CT; '" + part.name +
                   "' is drawn in one colour until --tf gives it values of '" + name + "'");
  }
}

void setPartFlags(const Context& context, scene::Case& value, const std::string& assignment)
{
  const auto [part, flags] = split(value, assignment, "--flags PART=shown,touchable,drillable");
  for (StructureAppearance* look : part.looks)
    appearance::setFlags(*look, flags);
  if (!part.bone || (value.boneLook.touchable && value.boneLook.drillable))
    return;
  value.boneLook.touchable = value.boneLook.drillable = true;
  context.warn("bone stays touchable and drillable; of its flags only 'shown' can be changed");
}

void setStiffness(const Context& context, scene::Case& value, const std::string& assignment)
{
  const auto [part, text] = split(value, assignment, "--stiffness PART=N_PER_MM|rigid");
  if (part.bone)
    throw core::InvalidParameter("bone is rigid; only structures and meshes can yield");
  const double stiffness = text == "rigid" ? 0.0 : parseNumbers(text, 1, "--stiffness").front();
  if (text != "rigid" && (stiffness < appearance::kSoftest || stiffness > appearance::kStiffest))
    throw UsageError("--stiffness: goes from 0.001 to 100 N/mm, or is 'rigid', not " + text);
  for (StructureAppearance* look : part.looks)
    appearance::setStiffness(*look, stiffness);
  if (const auto& look = *part.looks.front(); stiffness > 0.0 && !(look.solid && look.touchable))
    context.warn("'" + part.name + "' is not felt" +
                 (look.solid ? ": its flag 'touchable' is off" : ": it is a lumen"));
}

void setWarning(scene::Case& value, const std::string& assignment)
{
  const auto [part, text] = split(value, assignment, "--warn PART=MM|none");
  if (part.bone)
    throw core::InvalidParameter("bone is what is drilled; only structures and meshes are warned "
                                 "of");
  const double distance = text == "none" ? 0.0 : parseNumbers(text, 1, "--warn").front();
  if (!(distance >= 0.0 && distance <= appearance::kFarthestWarning))
    throw UsageError("--warn: goes from 0 to 50 mm, or is 'none', not " + text);
  for (StructureAppearance* look : part.looks)
    appearance::setWarning(*look, distance);
}

// Sets the tissue that the drill meets.
void setTissue(const Context& context, scene::Case& value, const std::string& assignment)
{
  const auto [part, text] = split(value, assignment, "--tissue PART=MATERIAL|bone");
  if (part.bone)
    throw core::InvalidParameter("bone is what its density says; only structures and meshes have a "
                                 "tissue of their own");
  const std::string tissue = text == "bone" ? std::string() : text;
  if (!tissue.empty())
    dissection::MaterialCatalogue::builtIn().material(tissue); // throws for unknown materials
  for (StructureAppearance* look : part.looks)
    look->tissue = tissue;
  if (!tissue.empty() && !part.looks.front()->solid)
    context.warn("'" + part.name + "' is a lumen: the drill meets nothing in it");
}

void run(const Context& context, const Options& options)
{
  if (options.presets)
  {
    if (options.changes() || options.list)
      throw UsageError("appearance: --presets stands alone");
    return listPresets(context);
  }
  if (options.name.empty())
    throw UsageError("appearance: CASE is required");
  if (!options.changes() && !options.list)
    throw UsageError("appearance: nothing to do; give --iso, --set, --tf, --color, --opacity, "
                     "--source, --flags, --stiffness, --warn, --tissue, --list or --presets");
  library::Library library = context.openLibrary();
  scene::Case value = library.open(options.name);
  if (!options.iso.empty())
    setIso(context, value, options.iso);
  // A preset first, then deviations from it.
  for (const std::string& assignment : options.set)
    setPreset(value, assignment);
  for (const std::string& assignment : options.tf)
    setTransfer(value, assignment);
  for (const std::string& assignment : options.color)
    setColors(value, assignment);
  for (const std::string& assignment : options.opacity)
    setOpacity(value, assignment);
  for (const std::string& assignment : options.source)
    setSource(context, value, assignment);
  for (const std::string& assignment : options.flags)
    setPartFlags(context, value, assignment);
  for (const std::string& assignment : options.stiffness)
    setStiffness(context, value, assignment);
  for (const std::string& assignment : options.warn)
    setWarning(value, assignment);
  for (const std::string& assignment : options.tissue)
    setTissue(context, value, assignment);
  context.refuseDamaged();
  if (options.changes())
    library.save(value);
  listAppearance(context, value);
}

} // namespace

void addAppearanceCommand(CLI::App& app, Context& context)
{
  auto options = std::make_shared<Options>();
  CLI::App* command = context.addCommand(
      app, "appearance", "Surface threshold, and what a structure is to eye, hand and drill",
      [options, &context] { run(context, *options); });
  const auto perPart = [command](const std::string& option, std::vector<std::string>& values,
                                 const std::string& text, const std::string& type)
  { command->add_option(option, values, text)->allow_extra_args(false)->type_name(type); };
  command->add_option("CASE", options->name);
  command
      ->add_option("--iso", options->iso,
                   "Surface of bone, in the CT's unit (300 HU); auto: from the histogram")
      ->type_name("NUMBER|auto");
  perPart("--set", options->set, "A look of the catalogue (--presets)", "PART=PRESET");
  perPart("--tf", options->tf, "Transfer function; 'none' for one colour", "PART=F.json");
  perPart("--color", options->color, "Colour, 0 to 1 each, or #rrggbb", "PART=r,g,b");
  perPart("--opacity", options->opacity, "Opacity of the surface", "PART=0..1");
  perPart("--source", options->source, "The image whose intensities are read", "PART=ct|MRNAME");
  perPart("--flags", options->flags, "The flags that hold; 'none' for none of them",
          "PART=shown,touchable,drillable");
  perPart("--stiffness", options->stiffness, "How a structure yields: newtons a millimetre deep",
          "PART=N_PER_MM|rigid");
  perPart("--warn", options->warn, "How near a burr may come before it is warned of",
          "PART=MM|none");
  perPart("--tissue", options->tissue, "What the drill meets in it; 'bone': bone by its density",
          "PART=MATERIAL|bone");
  command->add_flag("--list", options->list, "List what there is; PART 'ct' is bone");
  command->add_flag("--presets", options->presets, "List the looks of the catalogue");
}

} // namespace petrous::cli
