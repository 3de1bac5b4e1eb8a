#include "CaseJson.h"

#include "petrous/Appearance/StructureProperties.h"
#include "petrous/Dissection/BurrName.h"
#include "petrous/Dissection/StrokeNumber.h"
#include "petrous/Presenters/IntensityDisplay.h"
#include "petrous/Presenters/NearbyStructures.h"
#include "petrous/Scene/ApplyRegistration.h"
#include "petrous/Scene/Branches.h"
#include "petrous/Scene/CaseField.h"
#include "petrous/Scene/Placement.h"

namespace petrous::cli
{

using nlohmann::json;

json vectorJson(const Eigen::Vector3d& vector)
{
  return {vector[0], vector[1], vector[2]};
}

json directionJson(const Eigen::Matrix3d& direction)
{
  json values = json::array();
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 3; ++column)
      values.push_back(direction(row, column));
  return values;
}

json gridJson(const core::GridGeometry& grid)
{
  return {{"dims", grid.dims()},
          {"spacing_mm", vectorJson(grid.spacing())},
          {"origin_mm", vectorJson(grid.origin())},
          {"direction", directionJson(grid.direction())}};
}

json softTissueValuesJson(const scene::Case& value)
{
  const auto& soft = value.softTissueValues;
  return soft ? json{{"foot", soft->foot}, {"peak", soft->peak}} : json();
}

json lookJson(const appearance::StructureAppearance& look)
{
  json j{{"flags", appearance::flagsOf(look)}};
  for (const appearance::StructureProperty& property : appearance::kStructureProperties)
  {
    if (property.storage == appearance::StructureProperty::Storage::InFlags)
      continue;
    json& value = j[property.jsonKey ? property.jsonKey : property.key];
    value = appearance::valueJson(look, property);
    if (value.is_string() && appearance::isOff(look, property))
      value = property.off;
    else if (value.is_number() && !property.range.contains(value.get<double>()))
      value = nullptr; // off, where 0 is no value
  }
  return j;
}

std::string touchRefusal(const scene::Case& value, const scene::MeshPart& mesh)
{
  try
  {
    return scene::untouchable(value, mesh);
  }
  catch (const core::Error& error) // the rest of the case can still be reported
  {
    return error.what();
  }
}

namespace
{

std::vector<MeshFacts> meshFacts(const scene::Case& value)
{
  std::vector<MeshFacts> facts;
  for (const scene::MeshPart& mesh : value.meshes)
  {
    facts.push_back({touchRefusal(value, mesh)});
    try
    {
      facts.back().measure = volume::measure(*mesh.mesh.get());
    }
    catch (const core::Error&) // the rest of the case can still be reported
    {
    }
  }
  return facts;
}

bool isErrorKnown(const scene::Case& value, const std::string& mrName)
{
  const scene::ImagePart* mr = scene::findMr(value, mrName);
  return mr && mr->registration && mr->registration->error;
}

// Whether that may be so of one of its structures.
bool isErrorKnown(const scene::Case& value, const scene::LabelPart& part)
{
  return isErrorKnown(value, scene::placementOf(value, part).drawnOn) ||
         std::any_of(part.structures.begin(), part.structures.end(),
                     [&value](const scene::StructurePart& structure)
                     {
                       return std::any_of(structure.readings.begin(), structure.readings.end(),
                                          [&value](const scene::MrReading& reading)
                                          { return isErrorKnown(value, reading.mr); });
                     });
}

std::map<std::string, presenters::RegistrationErrorHere> registrationErrors(scene::Case value)
{
  std::map<std::string, presenters::RegistrationErrorHere> errors;
  const auto meshes = std::move(value.meshes);
  const auto labels = std::move(value.labels);
  value.meshes.clear();
  for (const scene::LabelPart& part : labels)
  {
    if (!isErrorKnown(value, part))
      continue;
    value.labels = {part};
    try
    {
      for (const auto& structure : scene::structureOccupancies(value))
        if (const auto error = presenters::uncertaintyOf(value, structure).registration)
          errors[structure.name] = *error;
    }
    catch (const core::Error&) // the rest of the case can still be reported
    {
    }
  }
  for (const scene::MeshPart& mesh : meshes)
  {
    if (!isErrorKnown(value, mesh.drawnOn))
      continue;
    try
    {
      const auto onCt = scene::meshOnCt(value, mesh);
      if (!onCt || onCt->vertices.empty())
        continue;
      const auto [lower, upper] = onCt->bounds();
      const core::PatientBox box(lower.cast<double>(), upper.cast<double>());
      if (const auto error = presenters::registrationErrorIn(value, mesh.drawnOn, box))
        errors[mesh.name] = *error;
    }
    catch (const core::Error&)
    {
    }
  }
  return errors;
}

} // namespace

CaseFacts factsOf(const scene::Case& value)
{
  return {meshFacts(value), registrationErrors(value)};
}

json transformJson(const core::RigidTransform& transform)
{
  json values = json::array();
  const Eigen::Matrix4d matrix = transform.matrix();
  for (int row = 0; row < 4; ++row)
    for (int column = 0; column < 4; ++column)
      values.push_back(matrix(row, column));
  return values;
}

json signOffJson(const scene::SignOff& signOff)
{
  const auto orNull = [](const std::string& text) { return text.empty() ? json() : json(text); };
  return {{"who", orNull(signOff.who)}, {"when", orNull(signOff.when)}};
}

namespace
{

// The root mean square along each axis.
json spreadJson(const std::optional<core::RigidSpread>& spread)
{
  if (!spread)
    return {};
  const Eigen::Matrix<double, 6, 1> deviations = spread->moments.diagonal().cwiseSqrt();
  return {{"about_mm", vectorJson(spread->about)},
          {"translation_mm", vectorJson(deviations.head<3>())},
          {"rotation_deg", vectorJson(deviations.tail<3>() * (180.0 / 3.14159265358979323846))}};
}

} // namespace

json registrationJson(const scene::ImagePart& mr)
{
  if (!mr.registered || !mr.registration)
    return {};
  const scene::Registration& how = *mr.registration;
  json error, signedOff;
  if (how.error)
    error = {{"at_mm", vectorJson(how.error->point)},
             {"place", how.error->place},
             {"median", how.error->median},
             {"p95", how.error->p95},
             {"max", how.error->max},
             {"spread", spreadJson(how.error->spread)}};
  if (const scene::SignOff* signOff = scene::validSignOff(mr))
    signedOff = signOffJson(*signOff);
  return {{"method", nameOf(how.method)},
          {"refined", how.refined},
          {"through", how.through.empty() ? json() : json(how.through)},
          {"verdict", nameOf(how.verdict)},
          {"text", how.text},
          {"metric", how.metric ? json(*how.metric) : json()},
          {"error_mm", std::move(error)},
          {"signed_off", std::move(signedOff)}};
}

namespace
{

json axesJson(const std::optional<bool>& assumedRas)
{
  return assumedRas ? json(*assumedRas ? "RAS" : "LPS") : json();
}

json correctedJson(const core::AxesCorrection& axes)
{
  return axes.isIdentity() ? json() : json(axes.letters());
}

// Slices are numbered from 1, as in texts and views.
json provenanceJson(const volume::ImageProvenance& provenance)
{
  constexpr const char* kBurnedIn[] = {"none", "suspected", "stated"};
  json slices = json::array();
  for (const volume::SliceRange& range : provenance.interpolated)
    slices.push_back({range.first + 1, range.last + 1});
  json masked = json::array();
  if (provenance.isFaceMasked)
    masked.push_back("face");
  if (provenance.areEarsMasked)
    masked.push_back("auricles");
  if (provenance.isCropped)
    masked.push_back("outside");
  return {
      {"interpolated_slices", std::move(slices)},
      {"tilt_deg", provenance.tilt},
      {"shift_mm", provenance.shift},
      {"assumed_axes", axesJson(provenance.assumedRas)},
      {"corrected_axes", correctedJson(provenance.axes)},
      {"burned_in_text", kBurnedIn[static_cast<std::size_t>(provenance.pixels.burnedIn)]},
      {"lossy", provenance.pixels.isLossy},
      {"lossy_ratio", provenance.pixels.lossyRatio ? json(*provenance.pixels.lossyRatio) : json()},
      {"masked", std::move(masked)}};
}

// Only for what was drawn on an MR.
void addPlace(json& part, const scene::Placement& place)
{
  if (place.drawnOn.empty())
    return;
  part["drawn_on"] = place.drawnOn;
  part["placed"] = place.missing.empty();
  if (!place.missing.empty())
    part["placed_reason"] = place.missing;
}

// Only for what was made from an MR.
void addReadings(json& part, const scene::Case& value, const scene::MrReadings& readings)
{
  if (readings.empty())
    return;
  for (const scene::MrReading& reading : readings)
    part["made_from"].push_back({{"mr", reading.mr},
                                 {"transform", transformJson(reading.mrFromCt)},
                                 {"current", scene::isCurrent(value, reading)}});
  if (const std::string why = scene::outdatedReading(value, readings); !why.empty())
    part["registration_error_reason"] = why;
}

// Without a place it holds at the structure itself.
void addRegistrationError(json& part, const CaseFacts& facts, const std::string& name)
{
  const auto found = facts.registrationErrors.find(name);
  if (found == facts.registrationErrors.end())
    return;
  const presenters::RegistrationErrorHere& error = found->second;
  part["registration_error_mm"] = {{"p95", error.p95},
                                   {"place", error.place.empty() ? json() : json(error.place)},
                                   {"away_mm", error.away}};
}

} // namespace

json descriptionJson(const scene::Description& description)
{
  return {{"note", description.note},
          {"tags", description.tags},
          {"diagnosis", description.diagnosis},
          {"procedure", description.procedure},
          {"side", scene::nameOf(description.side)},
          {"date", description.date.empty() ? json() : json(description.date)}};
}

std::string indented(const std::string& note)
{
  std::string text = "  | ";
  const std::size_t end = note.find_last_not_of('\n') + 1;
  for (std::size_t n = 0; n < end; ++n)
    text += note[n] == '\n' ? std::string("\n  | ") : std::string(1, note[n]);
  return text;
}

std::string descriptionLine(const scene::Description& description)
{
  std::string line;
  const auto add = [&line](const std::string& text)
  {
    if (!text.empty())
      line += (line.empty() ? "" : "; ") + text;
  };
  add(description.diagnosis);
  add(description.procedure);
  if (description.side != scene::Side::Unknown)
    add(description.side == scene::Side::Both ? std::string("both sides")
                                              : std::string(scene::nameOf(description.side)));
  if (!description.date.empty())
    add("planned for " + description.date);
  std::string tags;
  for (const std::string& tag : description.tags)
    tags += (tags.empty() ? "tags " : ", ") + tag;
  add(tags);
  return line;
}

json infoJson(const scene::Case& value, const CaseFacts& facts)
{
  json ct = gridJson(value.ct.geometry);
  ct["min"] = value.ct.range.min;
  ct["max"] = value.ct.range.max;
  ct["notes"] = value.ct.notes;
  ct["provenance"] = provenanceJson(value.ct.provenance);
  json mr = json::array();
  for (const auto& image : value.mr)
  {
    json part = gridJson(image.geometry);
    part["name"] = image.name;
    part["notes"] = image.notes;
    part["provenance"] = provenanceJson(image.provenance);
    part["registered"] = image.registered;
    part["transform"] = transformJson(image.mrFromCt);
    part["registration"] = registrationJson(image);
    mr.push_back(std::move(part));
  }
  const auto injured = presenters::injuredVolumes(value);
  const auto drilled = [&injured](const std::string& name)
  {
    const auto found = injured.find(name);
    return found != injured.end() ? found->second : 0.0;
  };
  json labels = json::array();
  for (const auto& part : value.labels)
  {
    const scene::Placement place = scene::placementOf(value, part);
    for (const auto& s : part.structures)
    {
      labels.push_back({{"name", s.name},
                        {"index", s.index},
                        {"voxels", s.voxels},
                        {"volume_mm3", s.volume},
                        {"drilled_mm3", drilled(s.name)},
                        {"color", s.look.color},
                        {"preset", s.look.preset},
                        {"flags", appearance::flagsOf(s.look)},
                        {"solid", s.look.solid},
                        {"provenance",
                         {{"assumed_axes", axesJson(part.provenance.assumedRas)},
                          {"corrected_axes", correctedJson(part.provenance.axes)},
                          {"frame_assumed", part.provenance.isFrameAssumed}}}});
      if (!part.notes.empty())
        labels.back()["notes"] = part.notes;
      addPlace(labels.back(), place);
      addReadings(labels.back(), value, s.readings);
      if (!(s.tubes == scene::TracedTubes()))
        labels.back()["traced_tubes"] = {{"length_mm", s.tubes.length},
                                         {"unresolved_mm", s.tubes.unresolved},
                                         {"bridging_voxels", s.tubes.bridging}};
      addRegistrationError(labels.back(), facts, s.name);
    }
  }
  json meshes = json::array();
  for (std::size_t n = 0; n < value.meshes.size(); ++n)
  {
    const scene::MeshPart& mesh = value.meshes[n];
    const std::string& refusal = facts.meshes[n].touchRefusal;
    meshes.push_back({{"name", mesh.name},
                      {"triangles", mesh.triangles},
                      {"flags", appearance::flagsOf(mesh.look)},
                      {"solid", mesh.look.solid},
                      {"drilled_mm3", drilled(mesh.name)},
                      {"touchable", refusal.empty()}});
    if (const auto& measured = facts.meshes[n].measure)
    {
      meshes.back()["closed"] = measured->openEdges == 0;
      meshes.back()["open_edges"] = measured->openEdges;
      meshes.back()["volume_mm3"] = measured->volume ? json(*measured->volume) : json(nullptr);
    }
    if (!mesh.notes.empty())
      meshes.back()["notes"] = mesh.notes;
    addPlace(meshes.back(), scene::placementOf(value, mesh));
    addRegistrationError(meshes.back(), facts, mesh.name);
    if (!refusal.empty())
      meshes.back()["touchable_reason"] = refusal;
  }
  ct["modality"] = value.ct.modality == scene::Modality::Mr   ? json("MR")
                   : value.ct.modality == scene::Modality::Ct ? json("CT")
                                                              : json(nullptr);
  json instrument = nullptr;
  if (const auto& kept = value.view.instrument)
    instrument = {{"name", kept->name}, {"axis", kept->axis}};
  return {{"case", value.name},
          {"description", descriptionJson(value.description)},
          {"iso_hu", value.iso},
          {"dense_bone_hu", value.denseBone},
          {"hounsfield", presenters::calibratedScale(value).calibrated},
          {"bone", lookJson(value.boneLook)},
          {"soft_tissue", lookJson(value.softTissue)},
          {"soft_tissue_estimate", softTissueValuesJson(value)},
          {"ct", std::move(ct)},
          {"mr", std::move(mr)},
          {"labels", std::move(labels)},
          {"meshes", std::move(meshes)},
          {"measurements", value.measurements.size()},
          {"instrument", std::move(instrument)},
          {"dissection",
           {{"strokes", value.dissection.strokes().size()},
            {"undo", value.applied()},
            {"redo", value.dissection.history().ahead()},
            {"removed_mm3", value.removedVolume()},
            {"branch", value.dissection.history().branch().name}}},
          {"resources", residentResources(value)}};
}

json touchedJson(const std::vector<dissection::TouchedStructure>& structures)
{
  json list = json::array();
  for (const auto& touched : structures)
    list.push_back({{"label", touched.name}, {"volume_mm3", touched.volume}});
  return list;
}

json strokesJson(const scene::Case& value)
{
  const dissection::History& history = value.dissection.history();
  std::vector<bool> done(history.size(), false);
  for (const std::size_t n : history.lineTo(history.position()))
    done[n] = true;
  json strokes = json::array();
  for (std::size_t n = 0; n < history.size(); ++n)
  {
    const dissection::Stroke& stroke = *value.dissection.strokes()[n];
    const auto& burr = stroke.info.burr;
    strokes.push_back(
        {{"number", dissection::strokeNumber(n)},
         {"parent", dissection::strokeNumber(history.parent(n))},
         {"done", static_cast<bool>(done[n])},
         {"recovered", stroke.info.recovered},
         {"started_at", stroke.info.startedAt.empty() ? json() : json(stroke.info.startedAt)},
         {"duration_s", stroke.info.duration},
         {"burr", dissection::nameOf(burr.kind)},
         {"burr_name", dissection::nameOf(burr)},
         {"diameter_mm", burr.diameter},
         {"rpm", burr.rpm},
         {"removed_mm3", stroke.info.removed},
         {"structures_touched", touchedJson(stroke.info.structures)},
         {"bytes", stroke.bytes}});
    if (const auto& speed = stroke.info.speed)
    {
      strokes.back()["rpm_mean"] = speed->mean;
      strokes.back()["rpm_max"] = speed->max;
    }
  }
  return strokes;
}

json branchJson(const scene::Case& value, const dissection::History::Branch& branch)
{
  const scene::StateSummary summary = scene::summaryOf(value, branch.position);
  return {{"name", branch.name},
          {"present", &branch == &value.dissection.history().branch()},
          {"set_aside", branch.setAside},
          {"tip", branch.tip + 1},
          {"position", branch.position + 1},
          {"strokes", summary.strokes},
          {"redo", value.dissection.history().lineTo(branch.tip).size() - summary.strokes},
          {"removed_mm3", summary.removed},
          {"structures_touched", touchedJson(summary.structures)}};
}

std::map<std::string, std::size_t> residentResources(const scene::Case& value)
{
  std::map<std::string, std::size_t> resources;
  if (const auto ct = value.ct.volume.peek())
    resources["ct.voxels"] = ct->bytes();
  for (const auto& image : value.mr)
    if (const auto mr = image.volume.peek())
      resources["mr." + image.name] = mr->bytes();
  for (const auto& part : value.labels)
    if (const auto labels = part.labels.peek())
      resources["labels.voxels." + part.structures.front().name] = labels->voxels->bytes();
  for (const auto& part : value.meshes)
  {
    if (const auto mesh = part.mesh.peek())
      resources["meshes." + part.name] = mesh->vertices.size() * sizeof(Eigen::Vector3f) +
                                         mesh->triangles.size() * 3 * sizeof(std::uint32_t);
    if (const auto solid = part.touch.resident())
      resources["meshes.touch." + part.name] = solid->bytes();
  }
  if (const std::uintmax_t bytes = value.derived ? value.derived->bytes() : 0)
    resources["disk.derived"] = bytes;
  if (value.dissection.loaded())
  {
    resources["mask.bricks"] = value.dissection.mask().residentBytes();
    if (const std::size_t bytes = value.dissection.historyBytes())
      resources["history.strokes"] = bytes;
  }
  return resources;
}

void printIdentityReport(const Context& context, const presenters::IdentityReport& report)
{
  std::string text = report.text();
  if (!text.empty() && text.back() == '\n')
    text.pop_back();
  context.print(text);
  context.printJson({{"leaves", report.leaves},
                     {"stays", report.stays},
                     {"may_identify", report.warnings},
                     {"counted", report.counted}});
}

} // namespace petrous::cli
