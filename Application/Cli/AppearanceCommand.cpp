#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>

#include "CaseJson.h"
#include "CaseWarnings.h"
#include "Commands.h"
#include "Context.h"
#include "Numbers.h"
#include "PartNamed.h"
#include "petrous/Appearance/AppearanceMaterial.h"
#include "petrous/Appearance/OwnPresets.h"
#include "petrous/Appearance/SoftTissues.h"
#include "petrous/Appearance/StructurePresets.h"
#include "petrous/Appearance/StructureProperties.h"
#include "petrous/Core/InputFile.h"
#include "petrous/Core/NumberText.h"
#include "petrous/Core/OutputFile.h"
#include "petrous/Dissection/Catalogues.h"
#include "petrous/Presenters/AppearanceEditor.h"
#include "petrous/Presenters/Background.h"
#include "petrous/Presenters/IntensityDisplay.h"
#include "petrous/Presenters/SceneAssembly.h"
#include "petrous/Scene/Case.h"
#include "petrous/Volume/IntensityScale.h"

namespace petrous::cli
{

namespace
{

using appearance::StructureAppearance;
using appearance::StructureProperty;

using appearance::StructureAppearance;

// What of the case is called soft tissue, as an option takes it.
std::string softTissueName(const scene::Case& value)
{
  constexpr const char* kPlain = "soft-tissue";
  return scene::meansSoftTissue(value, kPlain) ? kPlain : scene::kSoftTissue;
}

/// The control points in the intensities of an image.
std::string valuesOf(const StructureAppearance& look, const volume::IntensityScale& scale)
{
  if (!look.transfer)
    return "one colour";
  const auto transfer = look.relative ? onScale(*look.transfer, scale) : *look.transfer;
  const auto& points = transfer.points();
  const std::string from = fixed(points.front().value, 0);
  return (look.relative ? "" : "own values, ") +
         (points.size() == 1 ? "1 point at " + from
                             : std::to_string(points.size()) + " points from " + from + " to " +
                                   fixed(points.back().value, 0));
}

std::string hex(const std::array<float, 3>& color)
{
  char text[8];
  const auto byte = [&color](std::size_t c)
  { return static_cast<unsigned>(std::lround(color[c] * 255.0F)) & 0xFFU; };
  std::snprintf(text, sizeof(text), "#%02x%02x%02x", byte(0), byte(1), byte(2));
  return text;
}

// Each property that has a phrase, unless it is off, and the transfer function.
std::string describe(const StructureAppearance& look, const volume::IntensityScale& scale)
{
  std::string text = look.solid ? "" : ", a lumen, not felt";
  for (const appearance::StructureProperty& property : appearance::kStructureProperties)
    if (std::holds_alternative<appearance::StructureProperty::Transfer>(property.member))
      text += ", " + valuesOf(look, scale);
    else if (property.phrase && !appearance::isOff(look, property))
    {
      const std::string unit = property.range.unit;
      text += std::string(", ") + property.phrase + toString(look, property) +
              (unit.empty() ? "" : " " + unit);
    }
  return text;
}

// Prints each part of a case with its appearance and flags, or as JSON. dropped: flags that were
// cleared because a list of flags did not name them, by part.
void listAppearance(const Context& context, const scene::Case& value, nlohmann::json dropped)
{
  const bool isMr = value.ct.modality == scene::Modality::Mr;
  const auto entry = [&context, isMr](const std::string& name, const std::string& kind,
                                      const StructureAppearance& look,
                                      const volume::IntensityScale& scale)
  {
    nlohmann::json j = lookJson(look);
    j["name"] = name;
    j["kind"] = kind;
    const bool isSurface = isMr && name == "ct";
    context.print("  " + name + " (" + (isSurface ? "the MR's tissue" : kind) +
                  "): " + (isSurface ? "" : look.preset + " ") + hex(look.color) + ", " +
                  appearance::flagsOf(look) + describe(look, scale));
    return j;
  };
  presenters::IntensityDisplay display = presenters::displayOf(value);
  display.decimals = std::max(display.decimals, 1);
  context.print("surface at " + display.text(value.iso) +
                (isMr ? ", bright tissue at " : ", dense bone at ") +
                display.text(value.denseBone) +
                (display.hounsfield ? "" : " (not in Hounsfield units)"));
  const volume::IntensityScale scale = value.intensityScale();
  nlohmann::json bone = entry("ct", "bone", value.boneLook, scale);
  nlohmann::json softTissue = entry(softTissueName(value), "soft tissue", value.softTissue,
                                    presenters::softTissueScale(value));
  const std::string missing = presenters::softTissueMissing(value);
  softTissue["not_drawn"] = missing.empty() ? nlohmann::json() : nlohmann::json(missing);
  if (const std::string estimate = presenters::softTissueEstimate(value); !estimate.empty())
    context.print("    " + estimate);
  softTissue["estimate"] = softTissueValuesJson(value);
  nlohmann::json parts = nlohmann::json::array();
  for (const auto& part : value.labels)
    for (const auto& structure : part.structures)
      parts.push_back(entry(structure.name, "structure", structure.look, scale));
  for (const auto& mesh : value.meshes)
    parts.push_back(entry(mesh.name, "mesh", mesh.look, scale));
  context.printJson({{"case", value.name},
                     {"iso_hu", value.iso},
                     {"dense_bone_hu", value.denseBone},
                     {"hounsfield", display.hounsfield},
                     {"bone", std::move(bone)},
                     {"soft_tissue", std::move(softTissue)},
                     {"parts", std::move(parts)},
                     {"flags_dropped", std::move(dropped)}});
}

// As above, for the catalogue of presets and those of the library.
void listPresets(const Context& context)
{
  nlohmann::json presets = nlohmann::json::array();
  const auto list = [&](const std::vector<StructureAppearance>& looks, bool isOwn)
  {
    for (const StructureAppearance& look : looks)
    {
      nlohmann::json j = lookJson(look);
      j.erase("preset");
      j.erase("flags");
      j.erase("source");
      j["name"] = look.preset;
      j["own"] = isOwn;
      j["values_of"] =
          look.sourceImage.empty() ? nlohmann::json() : nlohmann::json(look.sourceImage);
      presets.push_back(std::move(j));
      context.print("  " + look.preset + ": " + hex(look.color) + describe(look, {}) +
                    (isOwn ? " (of this library)" : ""));
    }
  };
  list(appearance::StructurePresets::builtIn().all(), false);
  list(appearance::OwnPresets(context.openLibrary().folder()).all(), true);
  context.printJson({{"presets", std::move(presets)}});
}

struct Options
{
  std::string name, iso;
  std::vector<std::string> set, flags, fit;
  std::vector<std::string> savedPresets, deletedPresets, savedFunctions;
  std::map<std::string, std::vector<std::string>> values; ///< by the option of their property
  bool list = false;
  bool presets = false;

  bool changes() const
  {
    return !iso.empty() || !set.empty() || !flags.empty() || !fit.empty() ||
           std::any_of(values.begin(), values.end(),
                       [](const auto& option) { return !option.second.empty(); });
  }
  bool writes() const { return !savedPresets.empty() || !savedFunctions.empty(); }
};

// "PART=MM|none"
std::string typeName(const StructureProperty& property)
{
  return std::string("PART=") + property.option.value +
         (property.off ? "|" + std::string(property.off) : "");
}

/// Everything of one name in the case: a structure, a mesh, both, bone, or soft tissue.
struct Part
{
  std::string name;
  std::vector<StructureAppearance*> looks;
  bool bone = false;
  bool softTissue = false;
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
  if (scene::meansSoftTissue(value, name))
  {
    part.softTissue = true;
    part.looks = {&value.softTissue};
    return part;
  }
  part.name = partNamed(value, name);
  if (auto* structure = scene::findStructure(value, part.name))
    part.looks.push_back(&structure->look);
  part.meshOnly = part.looks.empty();
  if (auto* mesh = scene::findMesh(value, part.name))
    part.looks.push_back(&mesh->look);
  return part.looks.empty() ? std::nullopt : std::optional(part);
}

std::string lookedAtParts(const scene::Case& value)
{
  std::string there = std::string("ct, ") + softTissueName(value);
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
    const volume::IntensityHistogram histogram(*value.ct.volume.get());
    const bool isMr = value.ct.modality == scene::Modality::Mr;
    // A box in Hounsfield units need not show them.
    const auto scale = presenters::calibratedScale(value).calibrated ? volume::IntensityScale()
                       : isMr ? volume::suggestMrScale(histogram)
                              : volume::suggestScale(histogram);
    context.refuseDamaged();
    value.iso = scale.iso;
    value.softTissueValues = scale.soft;
    if (!scale.calibrated || presenters::calibratedScale(value).calibrated)
      value.denseBone = scale.dense; // else the file did not call its values Hounsfield units
    if (isMr)
      context.warn("the image is an MR; tissue is taken to begin at " + fixed(scale.iso, 1) +
                   ", and bone is as dark as air");
    else if (!scale.calibrated)
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

// `sources`: of --source. The image that the part is given besides is the one that counts.
void setPreset(const library::Library& library, scene::Case& value, const std::string& assignment,
               const std::vector<std::string>& sources)
{
  const auto [part, name] = split(value, assignment, "--set PART=PRESET");
  const auto preset =
      presenters::presetFor(value, part.name, appearance::OwnPresets(library.folder()), name);
  if (!preset.sourceImage.empty() && !part.meshOnly)
    for (const std::string& source : sources)
      if (const auto [reader, image] = split(value, source, "--source PART=MR|ct");
          reader.looks == part.looks && (image == "ct" || scene::findMr(value, image)))
        part.looks.front()->sourceImage = image == "ct" ? std::string() : image;
  const StructureAppearance set = presenters::withPreset(value, part.name, preset);
  if (part.softTissue)
  {
    value.softTissue = set;
    return;
  }
  for (StructureAppearance* look : part.looks)
  {
    appearance::applyPreset(*look, preset);
    if (set.color != look->color)
      appearance::setColor(*look, set.color);
  }
}

void fit(const Context& context, scene::Case& value, const std::string& name)
{
  const auto part = findPart(value, name);
  if (!part)
    throw core::InvalidParameter("case '" + value.name + "' has no structure or mesh '" + name +
                                 "'; it has " + lookedAtParts(value));
  *part->looks.front() = presenters::fitted(value, part->name, context.progress());
}

void savePreset(const library::Library& library, scene::Case& value, const std::string& assignment)
{
  const auto [part, name] = split(value, assignment, "--save-preset PART=NAME");
  appearance::OwnPresets(library.folder())
      .save(*part.looks.front(), name, value.ct.modality == scene::Modality::Mr);
}

void saveFunction(scene::Case& value, const std::string& assignment)
{
  const auto [part, path] = split(value, assignment, "--save-tf PART=F.json");
  if (part.meshOnly)
    throw core::InvalidParameter("'" + part.name + "' is a mesh and has no transfer function");
  const StructureAppearance& look = *part.looks.front();
  if (part.softTissue && (!look.transfer || (look.relative && !look.sourceImage.empty())))
    throw core::InvalidParameter("soft tissue has no transfer function");
  const volume::IntensityScale scale =
      part.softTissue ? presenters::softTissueScale(value) : value.intensityScale();
  core::writeFile(path, appearance::materialOf(look, scale).transfer.toJson() + "\n");
}

// Sets a property of `part` from the text of its option.
void setNumber(const Context&, scene::Case&, const StructureProperty& property, const Part& part,
               const std::string& text)
{
  double number = 0.0;
  if (!property.off || text != property.off)
  {
    number = parseNumbers(text, 1, property.option.name).front();
    if (!property.range.contains(number))
      throw UsageError(property.option.name +
                       (": " + property.range.refusal(number, property.off)));
  }
  for (StructureAppearance* look : part.looks)
    appearance::setNumber(*look, property, number);
}

void setTransfer(const Context&, scene::Case&, const StructureProperty& property, const Part& part,
                 const std::string& path)
{
  if (part.meshOnly)
    throw core::InvalidParameter("'" + part.name +
                                 "' is a mesh and has no intensities; use --color and --opacity");
  std::optional<appearance::TransferFunction> transfer;
  if (path != property.off)
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

std::array<float, 3> parseColor(const StructureProperty& property, const std::string& text)
{
  std::array<float, 3> color{};
  if (!text.empty() && text.front() == '#')
  {
    const auto given = presenters::parseHexColor(text);
    if (!given)
      throw UsageError("--color: '" + text + "' is not #rrggbb");
    std::transform(given->begin(), given->end(), color.begin(),
                   [](double value) { return static_cast<float>(value); });
    return color;
  }
  const auto numbers = parseNumbers(text, 3, "--color PART=r,g,b");
  for (std::size_t c = 0; c < 3; ++c)
  {
    if (!property.range.contains(numbers[c]))
      throw UsageError("--color: red, green and blue " + property.range.refusal(numbers[c]) +
                       "; or give #rrggbb");
    color[c] = static_cast<float>(numbers[c]);
  }
  return color;
}

void setColors(const Context&, scene::Case&, const StructureProperty& property, const Part& part,
               const std::string& text)
{
  const auto color = parseColor(property, text);
  for (StructureAppearance* look : part.looks)
    appearance::setColor(*look, color);
}

void setSource(const Context& context, scene::Case& value, const StructureProperty& property,
               const Part& part, const std::string& name)
{
  if (part.meshOnly)
    throw core::InvalidParameter("'" + part.name + "' is a mesh and reads no image");
  StructureAppearance& look = *part.looks.front();
  const scene::ImagePart* mr = scene::findMr(value, name);
  if (name == property.off && part.softTissue)
    appearance::readPrimaryImage(look);
  else if (name == property.off)
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
  else if (part.softTissue)
    look = presenters::softTissueReading(value, name);
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

// Of a part that is marked touchable or yields.
void warnIfNotFelt(const Context& context, const Part& part)
{
  if (const StructureAppearance& look = *part.looks.front(); !(look.solid && look.touchable))
    context.warn("'" + part.name + "' is not felt" +
                 (look.solid ? ": its flag 'touchable' is off" : ": it is a lumen"));
}

// Says which flags a list without signs dropped, and adds them to `dropped`, an object by part.
void printDropped(const Context& context, const Part& part, const std::string& flags,
                  const StructureAppearance& before, nlohmann::json& dropped)
{
  if (flags == "none")
    return;
  const StructureAppearance& now = *part.looks.front();
  std::string names, kept;
  nlohmann::json list = nlohmann::json::array();
  for (const StructureProperty& property : appearance::kStructureProperties)
    if (property.storage == StructureProperty::Storage::InFlags)
      if (const auto flag = std::get<StructureProperty::Flag>(property.member);
          before.*flag && !(now.*flag))
      {
        names += (names.empty() ? "" : ", ") + std::string(property.key);
        kept += std::string(kept.empty() ? "" : ",") + "+" + property.key;
        list.push_back(property.key);
      }
  if (names.empty())
    return;
  context.print("'" + part.name + "' is no longer " + names + ": --flags " + part.name + "=" +
                flags + " sets exactly these flags (--flags " + part.name + "=" + kept +
                " sets it again)");
  dropped[part.name] = std::move(list);
}

void setPartFlags(const Context& context, scene::Case& value, const std::string& assignment,
                  nlohmann::json& dropped)
{
  const auto [part, flags] = split(value, assignment, "--flags PART=shown,touchable,drillable");
  const StructureAppearance before = *part.looks.front();
  for (StructureAppearance* look : part.looks)
    appearance::changeFlags(*look, flags);
  if (part.softTissue && (value.softTissue.touchable || value.softTissue.drillable))
  {
    appearance::makeUntouchable(value.softTissue);
    context.warn("soft tissue is air to hand and drill; of its flags only 'shown' can be changed");
  }
  if (part.looks.front()->touchable)
    warnIfNotFelt(context, part);
  if (part.bone && !(value.boneLook.touchable && value.boneLook.drillable))
  {
    value.boneLook.touchable = value.boneLook.drillable = true;
    context.warn("bone stays touchable and drillable; of its flags only 'shown' can be changed");
  }
  if (flags.find_first_of("+-") == std::string::npos)
    printDropped(context, part, flags, before, dropped);
}

void setStiffness(const Context& context, scene::Case& value, const StructureProperty& property,
                  const Part& part, const std::string& text)
{
  const appearance::SoftTissue* tissue = appearance::findSoftTissue(text);
  if (!tissue && text != property.off && text.find_first_of("0123456789") == text.npos)
  {
    std::vector<std::string> names;
    for (const appearance::SoftTissue& one : appearance::softTissues())
      names.push_back(one.name);
    throw UsageError(property.option.name + (": '" + text) +
                     "' is neither a number nor a soft tissue; there are " +
                     CLI::detail::join(names, ", "));
  }
  setNumber(context, value, property, part, tissue ? core::plainText(tissue->stiffness) : text);
  if (tissue)
    context.warn("'" + part.name + "' yields with " + core::plainText(tissue->stiffness) +
                 " N/mm (" + core::plainText(tissue->lowest) + " to " +
                 core::plainText(tissue->highest) + " N/mm; " + tissue->certainty +
                 "): " + tissue->status);
  if (part.looks.front()->stiffness > 0.0)
    warnIfNotFelt(context, part);
}

// Sets the tissue that the drill meets.
void setTissue(const Context& context, scene::Case&, const StructureProperty& property,
               const Part& part, const std::string& text)
{
  const std::string tissue = text == property.off ? std::string() : text;
  if (!tissue.empty())
    dissection::Catalogues::in(context.openLibrary().folder())
        .materials.material(tissue); // throws for unknown materials
  for (StructureAppearance* look : part.looks)
    look->tissue = tissue;
  if (!tissue.empty() && !part.looks.front()->solid)
    context.warn("'" + part.name + "' is a lumen: the drill meets nothing in it");
}

// Sets a property of the part that an assignment names.
void setProperty(const Context& context, scene::Case& value, const StructureProperty& property,
                 const std::string& assignment)
{
  // Those that are more than a number within its range.
  static const std::map<std::string, decltype(&setNumber)> kOwn{{"--tf", &setTransfer},
                                                                {"--color", &setColors},
                                                                {"--source", &setSource},
                                                                {"--stiffness", &setStiffness},
                                                                {"--tissue", &setTissue}};
  const std::string option = property.option.name;
  const auto [part, text] = split(value, assignment, option + " " + typeName(property));
  if (part.bone && property.option.notOfBone)
    throw core::InvalidParameter(property.option.notOfBone);
  if (part.softTissue && property.option.notOfBone)
    throw core::InvalidParameter("soft tissue is air to hand and drill; only structures and meshes "
                                 "have " +
                                 std::string(property.option.name));
  const auto own = kOwn.find(option);
  (own != kOwn.end() ? own->second : &setNumber)(context, value, property, part, text);
}

void run(const Context& context, const Options& options)
{
  if (options.presets || !options.deletedPresets.empty())
  {
    if (options.changes() || options.writes() || options.list || !options.name.empty())
      throw UsageError("appearance: --presets and --delete-preset stand alone");
    for (const std::string& name : options.deletedPresets)
      appearance::OwnPresets(context.openLibrary().folder()).remove(name);
    return listPresets(context);
  }
  if (options.name.empty())
    throw UsageError("appearance: CASE is required");
  if (!options.changes() && !options.writes() && !options.list)
  {
    std::string names = "--iso, --set, --flags, --fit, --save-preset, --save-tf, ";
    for (const auto& [option, assignments] : options.values)
      names += option + ", ";
    throw UsageError("appearance: nothing to do; give " + names + "--list or --presets");
  }
  library::Library library = context.openLibrary();
  scene::Case value = library.open(options.name);
  if (!options.iso.empty())
    setIso(context, value, options.iso);
  // A preset first, then deviations from it.
  for (const std::string& assignment : options.set)
    setPreset(library, value, assignment, options.values.at("--source"));
  nlohmann::json dropped = nlohmann::json::object();
  for (const std::string& assignment : options.flags)
    setPartFlags(context, value, assignment, dropped);
  // Soft tissue gets a function with another image: one that is given replaces it.
  for (const StructureProperty& property : appearance::kStructureProperties)
    if (property.member == StructureProperty::Member(&StructureAppearance::sourceImage))
      for (const std::string& assignment : options.values.at(property.option.name))
        if (split(value, assignment, property.option.name).first.softTissue)
          setProperty(context, value, property, assignment);
  for (const StructureProperty& property : appearance::kStructureProperties)
    if (property.option.name)
      for (const std::string& assignment : options.values.at(property.option.name))
        setProperty(context, value, property, assignment);
  for (const std::string& part : options.fit)
    fit(context, value, part);
  if (value.softTissue.shown)
    warnOfSoftTissue(context, value);
  warnOfMrs(context, value);
  for (const std::string& assignment : options.savedPresets)
    appearance::OwnPresets::checkName(split(value, assignment, "--save-preset PART=NAME").second);
  std::vector<std::string> files;
  for (const std::string& assignment : options.savedFunctions)
    files.push_back(split(value, assignment, "--save-tf PART=F.json").second);
  context.refuseOverwriting(files);
  context.refuseDamaged();
  if (options.changes())
    library.save(value);
  for (const std::string& assignment : options.savedPresets)
    savePreset(library, value, assignment);
  for (const std::string& assignment : options.savedFunctions)
    saveFunction(value, assignment);
  listAppearance(context, value, std::move(dropped));
}

} // namespace

void addAppearanceCommand(CLI::App& app, Context& context)
{
  auto options = std::make_shared<Options>();
  CLI::App* command = context.addCommand(
      app, "appearance", "Bone threshold; appearance, touch and material of structures",
      [options, &context] { run(context, *options); });
  const auto perPart = [command](const std::string& option, std::vector<std::string>& values,
                                 const std::string& text, const std::string& type)
  { command->add_option(option, values, text)->allow_extra_args(false)->type_name(type); };
  command->add_option("CASE", options->name);
  command
      ->add_option("--iso", options->iso,
                   "Surface of bone, in the CT's unit (300 HU); auto: from the histogram")
      ->type_name("NUMBER|auto");
  perPart("--set", options->set, "Apply a preset (--presets)", "PART=PRESET");
  perPart("--flags", options->flags,
          "Set exactly these flags; 'none' clears all; with signs (PART=+touchable,-drillable) the "
          "others stay",
          "PART=shown,touchable,drillable");
  for (const StructureProperty& property : appearance::kStructureProperties)
    if (property.option.name)
      perPart(property.option.name, options->values[property.option.name], property.option.text,
              typeName(property));
  perPart("--fit", options->fit,
          "Stretch the transfer function over the values of the part in the image that it reads",
          "PART");
  perPart("--save-preset", options->savedPresets, "Save the appearance as a preset of the library",
          "PART=NAME");
  perPart("--delete-preset", options->deletedPresets, "Delete a preset of the library", "NAME");
  perPart("--save-tf", options->savedFunctions, "Write the transfer function, as --tf reads it",
          "PART=F.json");
  command->add_flag("--list", options->list,
                    "List all parts; PART 'ct' is bone, 'soft-tissue' what is neither bone nor a "
                    "structure");
  command->add_flag("--presets", options->presets,
                    "List the presets of the catalogue and of the library");
}

} // namespace petrous::cli
