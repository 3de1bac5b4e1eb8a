#include "CaseWarnings.h"

#include "petrous/Presenters/CasePicture.h"
#include "petrous/Presenters/CaseStamp.h"
#include "petrous/Presenters/IntensityDisplay.h"
#include "petrous/Presenters/SceneAssembly.h"

namespace petrous::cli
{

std::string placeText(const scene::Case& value, const scene::Placement& placement)
{
  if (!placement.missing.empty())
    return std::string(", nowhere on the ") + presenters::primaryName(value) + ": " +
           placement.missing;
  return placement.drawnOn.empty() ? "" : ", drawn on the MR '" + placement.drawnOn + "'";
}

std::string madeText(const scene::Case& value, const scene::MrReadings& readings)
{
  if (readings.empty())
    return {};
  const std::string outdated = scene::outdatedReading(value, readings);
  return ", made from the MR " + scene::namesOf(readings) + (outdated.empty() ? "" : "; ") +
         outdated;
}

void warnOfEar(const Context& context, const scene::Case& value, scene::Side ear)
{
  if (const std::string doubt = presenters::earDoubt(value, ear); !doubt.empty())
    context.warn(doubt);
}

void warnOfView(const Context& context, const scene::Case& value, const std::string& view)
{
  if (view == "lateral")
    if (const auto guessed = presenters::guessedEar(value))
      context.warn(std::string("the case does not tell which ear it is: the lateral view is from "
                               "the patient's ") +
                   (guessed == scene::Side::Left ? "left" : "right") +
                   "; state the side with 'petrous describe CASE --side left' or right");
  warnOfEar(context, value,
            view == "surgical-left"    ? scene::Side::Left
            : view == "surgical-right" ? scene::Side::Right
                                       : scene::Side::Unknown);
}

void warnOfCurrentView(const Context& context, const scene::Case& value)
{
  if (!value.camera)
    warnOfView(context, value, "lateral");
}

namespace
{

// Of each part that has no place on the primary image: its name, and why.
std::vector<std::pair<std::string, std::string>> missingPlaces(const scene::Case& value)
{
  std::vector<std::pair<std::string, std::string>> missing;
  const auto remark = [&missing](const std::string& name, const scene::Placement& placement)
  {
    if (!placement.missing.empty())
      missing.emplace_back(name, placement.missing);
  };
  for (const scene::LabelPart& part : value.labels)
  {
    const scene::Placement placement = scene::placementOf(value, part);
    for (const scene::StructurePart& structure : part.structures)
      remark(structure.name, placement);
  }
  for (const scene::MeshPart& mesh : value.meshes)
    remark(mesh.name, scene::placementOf(value, mesh));
  return missing;
}

} // namespace

void warnMissingPlaces(const Context& context, const scene::Case& value)
{
  const std::string primary = presenters::primaryName(value);
  for (const auto& [name, why] : missingPlaces(value))
    context.warn("'" + name + "' is left out, as it is nowhere on the " + primary + ": " + why);
}

void warnOutdated(const Context& context, const scene::Case& value)
{
  for (const scene::LabelPart& part : value.labels)
    for (const scene::StructurePart& structure : part.structures)
      if (const std::string why = scene::outdatedReading(value, structure.readings); !why.empty())
        context.warn("'" + structure.name + "' stays where it was made: " + why);
}

void warnOfSoftTissue(const Context& context, const scene::Case& value)
{
  if (const std::string why = presenters::softTissueMissing(value); !why.empty())
    context.warn("soft tissue is not drawn: " + why);
  else if (!value.softTissueValues)
    if (const std::string estimate = presenters::softTissueEstimate(value); !estimate.empty())
      context.warn("soft tissue: " + estimate);
}

void warnOfMrs(const Context& context, const scene::Case& value)
{
  for (const scene::ImagePart& mr : value.mr)
    if (const std::string why = presenters::mrMissing(value, mr.name); !why.empty())
      context.warn(why);
}

nlohmann::json missingPlacesJson(const scene::Case& value)
{
  nlohmann::json all = nlohmann::json::array();
  for (const auto& [name, why] : missingPlaces(value))
    all.push_back({{"structure", name}, {"text", why}});
  return all;
}

void addWithoutDamaged(CLI::App& command, bool& chosen)
{
  command.add_flag(kWithoutDamaged, chosen,
                   "Go on without structures that are missing or damaged: they are neither shown "
                   "nor felt nor spared");
}

presenters::LeftOut leaveOutDamaged(const Context& context, const library::Library& library,
                                    scene::Case& value, bool chosen)
{
  if (!chosen)
  {
    library.checkStructures(value, context.progress());
    return {};
  }
  const presenters::LeftOut leftOut = presenters::leaveOutDamaged(value, context.progress());
  for (const std::string& why : leftOut.sentences())
    context.warn("left out, neither shown nor felt nor spared: " + why);
  return leftOut;
}

nlohmann::json leftOutJson(const scene::Case& value, const presenters::LeftOut& leftOut)
{
  nlohmann::json all = nlohmann::json::array();
  for (const auto& part : leftOut.labels)
  {
    nlohmann::json names = nlohmann::json::array();
    for (const scene::StructurePart& structure : value.labels[part.index].structures)
      names.push_back(structure.name);
    all.push_back({{"structures", std::move(names)},
                   {"object", value.labels[part.index].object},
                   {"text", part.why}});
  }
  for (const auto& part : leftOut.meshes)
    all.push_back({{"structures", {value.meshes[part.index].name}},
                   {"object", value.meshes[part.index].object},
                   {"text", part.why}});
  return all;
}

} // namespace petrous::cli
