#include "petrous/Scene/Manifest.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>

#include <Eigen/Eigenvalues>
#include <nlohmann/json.hpp>

#include "DissectionJson.h"
#include "NotedProvenance.h"
#include "petrous/Appearance/StructureProperties.h"
#include "petrous/Dissection/BurrName.h"
#include "petrous/Scene/Registration.h"
#include "petrous/Scene/VideoNotes.h"

namespace petrous::scene
{

// The registration of an MR in a manifest. `...In` throws json::exception or InvalidParameter.

nlohmann::json poseOut(const core::RigidTransform& x);
core::RigidTransform poseIn(const nlohmann::json& j);

namespace
{

template <std::size_t count>
std::array<int, count> integersIn(const nlohmann::json& j)
{
  std::array<int, count> all{};
  for (std::size_t n = 0; n < count; ++n)
    all[n] = integerIn<int>(j.at(n));
  return all;
}

std::vector<std::string> plainTextsIn(const nlohmann::json& j)
{
  std::vector<std::string> texts;
  for (const nlohmann::json& one : j.get<std::vector<nlohmann::json>>())
    texts.push_back(plainIn(one));
  return texts;
}

std::string plainAt(const nlohmann::json& j, const char* key)
{
  return j.contains(key) ? plainIn(j.at(key)) : std::string();
}

} // namespace

nlohmann::json registrationOut(const Registration& registration);
Registration registrationIn(const nlohmann::json& j);

using nlohmann::json;

json poseOut(const core::RigidTransform& x)
{
  const auto& q = x.rotation();
  return {{"quaternion_wxyz", {q.w(), q.x(), q.y(), q.z()}},
          {"translation_mm", vectorOut(x.translation())}};
}

core::RigidTransform poseIn(const json& j)
{
  const auto q = j.at("quaternion_wxyz").get<std::array<double, 4>>();
  return {Eigen::Quaterniond(q[0], q[1], q[2], q[3]), vectorIn(j.at("translation_mm"))};
}

namespace
{

// The upper triangle, row by row.
json spreadOut(const core::RigidSpread& spread)
{
  json moments = json::array();
  for (Eigen::Index row = 0; row < 6; ++row)
    for (Eigen::Index column = row; column < 6; ++column)
      moments.push_back(spread.moments(row, column));
  return {{"about_mm", vectorOut(spread.about)}, {"moments_mm_rad", std::move(moments)}};
}

core::RigidSpread spreadIn(const json& j)
{
  const auto moments = j.at("moments_mm_rad").get<std::array<double, 21>>();
  core::RigidSpread spread;
  spread.about = vectorIn(j.at("about_mm"));
  std::size_t n = 0;
  for (Eigen::Index row = 0; row < 6; ++row)
    for (Eigen::Index column = row; column < 6; ++column)
      spread.moments(row, column) = spread.moments(column, row) = moments[n++];
  const auto& m = spread.moments;
  const bool isValid =
      (m.diagonal().array() >= 0.0).all() &&
      Eigen::SelfAdjointEigenSolver<core::RigidSpread::Moments>(m).eigenvalues().minCoeff() >=
          -1e-9 * m.trace();
  if (!isValid)
    throw core::InvalidParameter("registration: moments that no error has");
  return spread;
}

json errorOut(const RegistrationError& error)
{
  json j{{"point_mm", vectorOut(error.point)},
         {"place", error.place},
         {"median_mm", error.median},
         {"p95_mm", error.p95},
         {"max_mm", error.max}};
  if (error.spread)
    j["spread"] = spreadOut(*error.spread);
  return j;
}

RegistrationError errorIn(const json& j)
{
  RegistrationError error;
  error.point = vectorIn(j.at("point_mm"));
  error.place = plainIn(j.at("place"));
  error.median = j.at("median_mm").get<double>();
  error.p95 = j.at("p95_mm").get<double>();
  error.max = j.at("max_mm").get<double>();
  if (!(error.median >= 0.0 && error.p95 >= 0.0 && error.max >= 0.0))
    throw core::InvalidParameter("registration: an error below 0 mm");
  if (j.contains("spread"))
    error.spread = spreadIn(j.at("spread"));
  return error;
}

json signOffOut(const SignOff& signOff)
{
  return {{"who", signOff.who}, {"when", signOff.when}, {"mr_from_ct", poseOut(signOff.transform)}};
}

SignOff signOffIn(const json& j)
{
  return {plainIn(j.at("who")), plainIn(j.at("when")), poseIn(j.at("mr_from_ct"))};
}

} // namespace

json registrationOut(const Registration& registration)
{
  json j{{"method", nameOf(registration.method)},
         {"refined", registration.refined},
         {"verdict", nameOf(registration.verdict)},
         {"text", registration.text}};
  if (registration.isFromFile)
    j["from_file"] = true;
  if (registration.metric)
    j["metric_nats"] = *registration.metric;
  if (registration.error)
    j["error"] = errorOut(*registration.error);
  if (!registration.through.empty())
    j["through"] = registration.through;
  if (registration.signOff)
    j["signed_off"] = signOffOut(*registration.signOff);
  return j;
}

Registration registrationIn(const json& j)
{
  Registration registration;
  registration.method = methodFromName(j.at("method").get<std::string>());
  registration.isFromFile = j.value("from_file", false);
  registration.refined = j.at("refined").get<bool>();
  registration.verdict = verdictFromName(j.at("verdict").get<std::string>());
  registration.text = plainIn(j.at("text"));
  if (j.contains("metric_nats"))
    registration.metric = j.at("metric_nats").get<double>();
  if (j.contains("error"))
    registration.error = errorIn(j.at("error"));
  registration.through = plainAt(j, "through");
  if (j.contains("signed_off"))
    registration.signOff = signOffIn(j.at("signed_off"));
  return registration;
}

namespace
{

using nlohmann::json;

constexpr int kFirstFormatWithBranches = 2;
constexpr int kFormatWithoutCodes = 3;
constexpr int kFormatWithoutDescription = 4;
constexpr int kFormatWithoutAttachments = 5;
constexpr int kFormatWithoutMeasurements = 6; // and without saved views
constexpr int kFormatWithoutVideoNotes = 7;
constexpr int kFormatWithoutInstrument = 8;
constexpr int kFormatWithCamerasOfBranches =
    9; // and nothing else of their views, nor corrected axes
constexpr const char* kPlanes[] = {"axial", "coronal", "sagittal"};
constexpr const char* kFrame = "frame_of_reference_salted_sha256";
constexpr const char* kPatient = "patient_salted_sha256";
constexpr const char* kSalt = "salt_id";       // absent: of a salt that has none, or no hashes
constexpr const char* kMadeFrom = "made_from"; // absent: from no MR, or by older programs
constexpr const char* kTubes = "traced_tubes"; // absent: none, or by older programs
constexpr const char* kModality = "modality";  // "CT" or "MR"; absent: not known
constexpr const char* kUnsaltedFrame = "frame_of_reference_sha256"; // written by older programs

json gridOut(const core::GridGeometry& grid)
{
  json direction = json::array();
  for (int r = 0; r < 3; ++r)
    for (int c = 0; c < 3; ++c)
      direction.push_back(grid.direction()(r, c));
  return {{"dims", grid.dims()},
          {"spacing_mm", vectorOut(grid.spacing())},
          {"origin_mm", vectorOut(grid.origin())},
          {"direction", direction}};
}

core::GridGeometry gridIn(const json& j)
{
  const auto d = j.at("direction").get<std::array<double, 9>>();
  Eigen::Matrix3d direction;
  direction << d[0], d[1], d[2], d[3], d[4], d[5], d[6], d[7], d[8];
  return {integersIn<3>(j.at("dims")), vectorIn(j.at("spacing_mm")), vectorIn(j.at("origin_mm")),
          direction};
}

using Hash = std::string PatientHash::*;
constexpr std::pair<const char*, Hash> kPatientHashes[] = {{"id", &PatientHash::id},
                                                           {"issuer", &PatientHash::issuer},
                                                           {"name", &PatientHash::name},
                                                           {"birth_date", &PatientHash::birthDate}};

constexpr const char* kNameParts = "name_parts";

constexpr const char* kProvenance = "provenance"; // absent: older programs, whose notes say it
constexpr const char* kAssumedAxes = "assumed_axes";
constexpr const char* kCorrectedAxes = "corrected_axes"; // absent: as the file states them
constexpr const char* kBurnedIn[] = {"none", "suspected", "stated"};
using Flag = bool volume::ImageProvenance::*;
constexpr std::pair<const char*, Flag> kMasked[] = {
    {"face", &volume::ImageProvenance::isFaceMasked},
    {"auricles", &volume::ImageProvenance::areEarsMasked},
    {"outside", &volume::ImageProvenance::isCropped}};

void putAssumedAxes(json& j, const std::optional<bool>& assumedRas)
{
  if (assumedRas)
    j[kAssumedAxes] = *assumedRas ? "RAS" : "LPS";
}

std::optional<bool> assumedRasIn(const json& j)
{
  if (!j.contains(kAssumedAxes))
    return std::nullopt;
  const auto axes = j.at(kAssumedAxes).get<std::string>();
  if (axes != "RAS" && axes != "LPS")
    throw core::InvalidParameter("provenance: assumed axes must be RAS or LPS");
  return axes == "RAS";
}

void putCorrectedAxes(json& j, const core::AxesCorrection& axes)
{
  if (!axes.isIdentity())
    j[kCorrectedAxes] = axes.letters();
}

core::AxesCorrection correctedAxesIn(const json& j)
{
  return j.contains(kCorrectedAxes)
             ? core::AxesCorrection::parse(j.at(kCorrectedAxes).get<std::string>())
             : core::AxesCorrection();
}

// Slices are numbered from 1, as where a user sees them.
json provenanceOut(const volume::ImageProvenance& provenance)
{
  json j = json::object();
  for (const volume::SliceRange& range : provenance.interpolated)
    j["interpolated_slices"].push_back({range.first + 1, range.last + 1});
  if (provenance.interpolatedBeyond > 0)
    j["interpolated_slices_beyond"] = provenance.interpolatedBeyond;
  if (provenance.tilt != 0.0)
    j["tilt_deg"] = provenance.tilt;
  if (provenance.shift != 0.0)
    j["shift_mm"] = provenance.shift;
  putAssumedAxes(j, provenance.assumedRas);
  putCorrectedAxes(j, provenance.axes);
  if (provenance.pixels.burnedIn != volume::BurnedInText::None)
    j["burned_in_text"] = kBurnedIn[static_cast<std::size_t>(provenance.pixels.burnedIn)];
  if (provenance.pixels.isLossy)
    j["lossy"] = true;
  if (provenance.pixels.lossyRatio)
    j["lossy_ratio"] = *provenance.pixels.lossyRatio;
  for (const auto& [name, flag] : kMasked)
    if (provenance.*flag)
      j["masked"].push_back(name);
  return j;
}

volume::ImageProvenance provenanceIn(const json& j, int slices)
{
  volume::ImageProvenance provenance;
  if (j.contains("interpolated_slices"))
    for (const json& range : j.at("interpolated_slices").get_ref<const json::array_t&>())
    {
      const auto [first, last] = integersIn<2>(range);
      const int after = provenance.interpolated.empty() ? 0 : provenance.interpolated.back().last;
      if (range.size() != 2 || first < 1 || last < first || last > slices ||
          (!provenance.interpolated.empty() && first - 1 <= after + 1))
        throw core::InvalidParameter("provenance: interpolated slices must be ranges of the "
                                     "image's slices, from 1, in order and apart");
      provenance.interpolated.push_back({first - 1, last - 1});
    }
  if (j.contains("interpolated_slices_beyond"))
    provenance.interpolatedBeyond = integerIn<int>(j.at("interpolated_slices_beyond"));
  constexpr int kMostSlices = 100000; // of any series; its sum with those of the image stays an int
  if (provenance.interpolatedBeyond < 0 || provenance.interpolatedBeyond > kMostSlices)
    throw core::InvalidParameter("provenance: interpolated slices beyond the image must be 0 to " +
                                 std::to_string(kMostSlices));
  provenance.tilt = j.value("tilt_deg", 0.0);
  provenance.shift = j.value("shift_mm", 0.0);
  provenance.assumedRas = assumedRasIn(j);
  provenance.axes = correctedAxesIn(j);
  const auto burnedIn = j.value("burned_in_text", std::string(kBurnedIn[0]));
  const auto* found = std::find(std::begin(kBurnedIn), std::end(kBurnedIn), burnedIn);
  if (found == std::end(kBurnedIn))
    throw core::InvalidParameter("provenance: burned-in text must be none, suspected or stated");
  provenance.pixels.burnedIn =
      static_cast<volume::BurnedInText>(std::distance(std::begin(kBurnedIn), found));
  provenance.pixels.isLossy = j.value("lossy", false);
  if (j.contains("lossy_ratio"))
    provenance.pixels.lossyRatio = j.at("lossy_ratio").get<double>();
  if (provenance.pixels.lossyRatio && !(*provenance.pixels.lossyRatio > 0.0))
    throw core::InvalidParameter("provenance: a ratio of compression must be above 0");
  if (j.contains("masked"))
    for (const json& one : j.at("masked").get_ref<const json::array_t&>())
    {
      const auto name = one.get<std::string>();
      const auto* flag = std::find_if(std::begin(kMasked), std::end(kMasked),
                                      [&name](const auto& known) { return known.first == name; });
      if (flag == std::end(kMasked))
        throw core::InvalidParameter("provenance: masked must be face, auricles or outside");
      provenance.*(flag->second) = true;
    }
  return provenance;
}

json imageOut(const ImagePart& image)
{
  json j{{"name", image.name},     {"object", image.object}, {"grid", gridOut(image.geometry)},
         {"min", image.range.min}, {"max", image.range.max}, {"notes", image.notes}};
  if (!image.frameOfReference.empty())
    j[image.isFrameSalted ? kFrame : kUnsaltedFrame] = image.frameOfReference;
  if (image.isFrameSalted && !image.patient.empty()) // never without the salt
    for (const auto& [key, hash] : kPatientHashes)
      if (!(image.patient.*hash).empty())
        j[kPatient][key] = image.patient.*hash;
  if (image.isFrameSalted && !image.patient.nameParts.empty())
    j[kPatient][kNameParts] = image.patient.nameParts;
  if (hasSaltedIdentity(image) && !image.saltId.empty())
    j[kSalt] = image.saltId;
  j[kProvenance] = provenanceOut(image.provenance);
  if (image.modality != Modality::Unknown)
    j[kModality] = image.modality == Modality::Mr ? "MR" : "CT";
  return j;
}

ImagePart imageIn(const json& j)
{
  ImagePart image;
  image.name = j.at("name").get<std::string>();
  image.object = j.at("object").get<std::string>();
  image.geometry = gridIn(j.at("grid"));
  image.range = {j.at("min").get<double>(), j.at("max").get<double>()};
  image.notes = plainTextsIn(j.at("notes"));
  const int slices = image.geometry.dims()[2];
  image.provenance = j.contains(kProvenance) ? provenanceIn(j.at(kProvenance), slices)
                                             : provenanceFromNotes(image.notes, slices);
  image.isFrameSalted = !j.contains(kUnsaltedFrame);
  image.frameOfReference = j.value(image.isFrameSalted ? kFrame : kUnsaltedFrame, std::string());
  if (j.contains(kPatient))
    for (const auto& [key, hash] : kPatientHashes)
      image.patient.*hash = j.at(kPatient).value(key, std::string());
  if (j.contains(kPatient))
    image.patient.nameParts = j.at(kPatient).value(kNameParts, std::vector<std::string>());
  if (hasSaltedIdentity(image))
    image.saltId = j.value(kSalt, std::string());
  const std::string modality = j.value(kModality, std::string());
  image.modality = modality == "MR"   ? Modality::Mr
                   : modality == "CT" ? Modality::Ct
                                      : Modality::Unknown;
  return image;
}

appearance::StructureAppearance lookIn(const json& j, const appearance::StructurePresets& presets)
{
  return appearance::appearanceFrom(j, presets.lookFor(j.at("preset").get<std::string>()));
}

using Concept = volume::CodedConcept volume::SegmentCodes::*;
constexpr std::pair<const char*, Concept> kConcepts[] = {
    {"category", &volume::SegmentCodes::category},
    {"type", &volume::SegmentCodes::type},
    {"type_modifier", &volume::SegmentCodes::typeModifier},
    {"region", &volume::SegmentCodes::region},
    {"region_modifier", &volume::SegmentCodes::regionModifier}};
constexpr const char* kAlgorithms[] = {"", "manual", "semiautomatic", "automatic"};

json codesOut(const volume::SegmentCodes& codes)
{
  json j = json::object();
  for (const auto& [key, concept] : kConcepts)
    if (const volume::CodedConcept& code = codes.*concept; !code.empty())
      j[key] = {{"value", code.value}, {"scheme", code.scheme}, {"meaning", code.meaning}};
  if (codes.algorithm != volume::SegmentCodes::Algorithm::Unknown)
    j["algorithm"] = kAlgorithms[static_cast<std::size_t>(codes.algorithm)];
  if (!codes.algorithmName.empty())
    j["algorithm_name"] = codes.algorithmName;
  return j;
}

volume::SegmentCodes codesIn(const json& j)
{
  volume::SegmentCodes codes;
  for (const auto& [key, concept] : kConcepts)
    if (j.contains(key))
    {
      const json& code = j.at(key);
      codes.*concept = {plainIn(code.at("value")), plainIn(code.at("scheme")),
                        plainIn(code.at("meaning"))};
    }
  const auto algorithm = j.value("algorithm", std::string());
  const auto* found = std::find(std::begin(kAlgorithms), std::end(kAlgorithms), algorithm);
  if (found == std::end(kAlgorithms))
    throw core::InvalidParameter("a structure's algorithm is none of manual, semiautomatic and "
                                 "automatic");
  codes.algorithm =
      static_cast<volume::SegmentCodes::Algorithm>(std::distance(std::begin(kAlgorithms), found));
  codes.algorithmName = plainAt(j, "algorithm_name");
  return codes;
}

json readingsOut(const MrReadings& readings)
{
  json all = json::array();
  for (const MrReading& one : readings)
  {
    all.push_back({{"mr", one.mr}, {"mr_from_ct", poseOut(one.mrFromCt)}});
    if (one.isGone)
      all.back()["gone"] = true;
  }
  return all;
}

MrReadings readingsIn(const json& j)
{
  MrReadings readings;
  if (j.contains(kMadeFrom))
    for (const json& one : j.at(kMadeFrom).get_ref<const json::array_t&>())
      readings.push_back(
          {plainIn(one.at("mr")), poseIn(one.at("mr_from_ct")), one.value("gone", false)});
  return readings;
}

json tubesOut(const TracedTubes& tubes)
{
  return {{"length_mm", tubes.length},
          {"unresolved_mm", tubes.unresolved},
          {"bridging_voxels", tubes.bridging}};
}

TracedTubes tubesIn(const json& j)
{
  if (!j.contains(kTubes))
    return {};
  const json& from = j.at(kTubes);
  const TracedTubes tubes{from.at("length_mm").get<double>(),
                          from.at("unresolved_mm").get<double>(),
                          integerIn<std::uint64_t>(from.at("bridging_voxels"))};
  if (!(tubes.unresolved >= 0.0 && tubes.length >= tubes.unresolved))
    throw core::InvalidParameter("of a structure's tubes more than their length is unresolved, or "
                                 "less than nothing");
  return tubes;
}

json labelsOut(const LabelPart& part)
{
  json structures = json::array();
  for (const StructurePart& s : part.structures)
  {
    structures.push_back({{"name", s.name},
                          {"index", s.index},
                          {"voxels", s.voxels},
                          {"volume_mm3", s.volume},
                          {"look", appearance::appearanceJson(s.look)}});
    if (!s.codes.empty())
      structures.back()["codes"] = codesOut(s.codes);
    if (!s.readings.empty())
      structures.back()[kMadeFrom] = readingsOut(s.readings);
    if (!(s.tubes == TracedTubes()))
      structures.back()[kTubes] = tubesOut(s.tubes);
  }
  json j{{"object", part.object}, {"structures", structures}};
  if (part.drawnOn)
    j["drawn_on"] = *part.drawnOn;
  if (!part.notes.empty())
    j["notes"] = part.notes;
  json& provenance = j[kProvenance] = json::object();
  putAssumedAxes(provenance, part.provenance.assumedRas);
  putCorrectedAxes(provenance, part.provenance.axes);
  if (part.provenance.isFrameAssumed)
    provenance["frame_assumed"] = true;
  return j;
}

LabelPart labelsIn(const json& j, const appearance::StructurePresets& presets)
{
  LabelPart part;
  part.object = j.at("object").get<std::string>();
  if (j.contains("drawn_on"))
    part.drawnOn = j.at("drawn_on").get<std::string>();
  if (j.contains("notes"))
    part.notes = plainTextsIn(j.at("notes"));
  if (j.contains(kProvenance))
    part.provenance = {assumedRasIn(j.at(kProvenance)),
                       j.at(kProvenance).value("frame_assumed", false),
                       correctedAxesIn(j.at(kProvenance))};
  else
    part.provenance = labelProvenanceFromNotes(part.notes);
  for (const json& s : j.at("structures"))
    part.structures.push_back(
        {s.at("name").get<std::string>(), integerIn<std::uint16_t>(s.at("index")),
         integerIn<std::uint64_t>(s.at("voxels")), s.at("volume_mm3").get<double>(),
         lookIn(s.at("look"), presets),
         s.contains("codes") ? codesIn(s.at("codes")) : volume::SegmentCodes(), readingsIn(s),
         tubesIn(s)});
  return part;
}

json meshOut(const MeshPart& mesh)
{
  json j{{"name", mesh.name},
         {"object", mesh.object},
         {"triangles", mesh.triangles},
         {"notes", mesh.notes},
         {"look", appearance::appearanceJson(mesh.look)}};
  if (!mesh.drawnOn.empty())
    j["drawn_on"] = mesh.drawnOn;
  return j;
}

json descriptionOut(const Description& description)
{
  json j = json::object();
  const auto add = [&j](const char* key, const std::string& text)
  {
    if (!text.empty())
      j[key] = text;
  };
  add("note", description.note);
  add("diagnosis", description.diagnosis);
  add("procedure", description.procedure);
  add("planned_on", description.date);
  if (!description.tags.empty())
    j["tags"] = description.tags;
  if (description.side != Side::Unknown)
    j["side"] = nameOf(description.side);
  return j;
}

Description descriptionIn(const json& j)
{
  Description description;
  description.note = j.value("note", std::string());
  description.tags = j.value("tags", std::vector<std::string>());
  description.diagnosis = j.value("diagnosis", std::string());
  description.procedure = j.value("procedure", std::string());
  description.side = sideFromName(j.value("side", std::string(nameOf(Side::Unknown))));
  description.date = j.value("planned_on", std::string());
  checkDescription(description);
  return description;
}

json slicesOut(const ViewState::Slices& slices)
{
  json j{{"crosshair_mm", vectorOut(slices.crosshair)},
         {"window_width", slices.width},
         {"window_level", slices.level}};
  if (slices.planes)
    for (std::size_t n = 0; n < slices.planes->size(); ++n)
      j["planes"][kPlanes[n]] = {{"zoom", (*slices.planes)[n].zoom},
                                 {"offset_mm", vectorOut((*slices.planes)[n].offset)}};
  if (slices.overlay)
    j["overlay"] = {{"mr", slices.overlay->mr},
                    {"mode", slices.overlay->mode},
                    {"opacity", slices.overlay->opacity}};
  if (slices.turned)
  {
    json& turned = j["turned"];
    turned["kind"] = slices.turned->kind;
    for (std::size_t n = 0; n < slices.turned->planes.size(); ++n)
      turned[kPlanes[n]] = {{"right", vectorOut(slices.turned->planes[n].right)},
                            {"down", vectorOut(slices.turned->planes[n].down)}};
  }
  if (slices.slab)
    j["slab"] = {{"thickness_mm", slices.slab->thickness}, {"projection", slices.slab->projection}};
  return j;
}

ViewState::Slices slicesIn(const json& j)
{
  ViewState::Slices slices;
  slices.crosshair = vectorIn(j.at("crosshair_mm"));
  slices.width = j.at("window_width").get<double>();
  slices.level = j.at("window_level").get<double>();
  if (j.contains("planes"))
  {
    slices.planes.emplace();
    for (std::size_t n = 0; n < slices.planes->size(); ++n)
    {
      const json& plane = j.at("planes").at(kPlanes[n]);
      (*slices.planes)[n] = {plane.at("zoom").get<double>(), vectorIn(plane.at("offset_mm"))};
    }
  }
  if (j.contains("overlay"))
  {
    const json& overlay = j.at("overlay");
    slices.overlay = {plainIn(overlay.at("mr")), overlay.at("mode").get<std::string>(),
                      overlay.at("opacity").get<double>()};
  }
  if (j.contains("turned"))
  {
    const json& turned = j.at("turned");
    slices.turned.emplace();
    slices.turned->kind = turned.at("kind").get<std::string>();
    for (std::size_t n = 0; n < slices.turned->planes.size(); ++n)
      slices.turned->planes[n] = {vectorIn(turned.at(kPlanes[n]).at("right")),
                                  vectorIn(turned.at(kPlanes[n]).at("down"))};
  }
  if (j.contains("slab"))
    slices.slab = {j.at("slab").at("thickness_mm").get<double>(),
                   j.at("slab").at("projection").get<std::string>()};
  return slices;
}

json clippingOut(const ViewState::Clipping& clipping)
{
  json j = json::object();
  for (const ViewState::Clipping::Plane& plane : clipping.planes)
    j["planes"].push_back(
        {{"point_mm", vectorOut(plane.point)}, {"normal", vectorOut(plane.normal)}});
  if (clipping.crop)
    j["crop"] = {{"lower", clipping.crop->lower}, {"upper", clipping.crop->upper}};
  return j;
}

ViewState::Clipping clippingIn(const json& j)
{
  ViewState::Clipping clipping;
  if (!j.is_object())
    throw core::InvalidParameter("clipping is no object");
  if (j.contains("planes"))
    for (const json& plane : j.at("planes"))
      clipping.planes.push_back({vectorIn(plane.at("point_mm")), vectorIn(plane.at("normal"))});
  if (j.contains("crop"))
  {
    clipping.crop.emplace();
    clipping.crop->lower = integersIn<3>(j.at("crop").at("lower"));
    clipping.crop->upper = integersIn<3>(j.at("crop").at("upper"));
  }
  return clipping;
}

json stereoOut(const ViewState::Stereo& stereo)
{
  json j{{"mode", stereo.mode}};
  if (stereo.eyeSeparation)
    j["eye_separation_mm"] = *stereo.eyeSeparation;
  if (stereo.convergence)
    j["convergence_mm"] = *stereo.convergence;
  return j;
}

ViewState::Stereo stereoIn(const json& j)
{
  ViewState::Stereo stereo;
  stereo.mode = j.at("mode").get<std::string>();
  if (j.contains("eye_separation_mm"))
    stereo.eyeSeparation = j.at("eye_separation_mm").get<double>();
  if (j.contains("convergence_mm"))
    stereo.convergence = j.at("convergence_mm").get<double>();
  return stereo;
}

json toolOut(const ViewState::Tool& tool)
{
  json j{{"burr", dissection::nameOf(tool.burr.kind)},
         {"diameter_mm", tool.burr.diameter},
         {"rpm", tool.burr.rpm},
         {"thrust_n", tool.thrust},
         {"by_wheel", tool.byWheel}};
  if (!tool.burr.name.empty())
    j["burr_name"] = tool.burr.name;
  return j;
}

ViewState::Tool toolIn(const json& j)
{
  const auto kind = dissection::parseBurrKind(j.at("burr").get<std::string>());
  if (!kind)
    throw core::InvalidParameter("view: a burr must be cutting or diamond");
  ViewState::Tool tool;
  tool.burr.kind = *kind;
  tool.burr.diameter = j.at("diameter_mm").get<double>();
  tool.burr.rpm = j.at("rpm").get<double>();
  dissection::setName(tool.burr, j.value("burr_name", std::string()));
  tool.thrust = j.at("thrust_n").get<double>();
  tool.byWheel = j.at("by_wheel").get<bool>();
  return tool;
}

json handpieceOut(const ViewState::Handpiece& hand)
{
  json j{{"turn_deg", hand.turn}, {"tilt_deg", hand.tilt}};
  if (hand.isLeft)
    j["left_hand"] = true;
  return j;
}

ViewState::Handpiece handpieceIn(const json& j)
{
  return {j.at("turn_deg").get<double>(), j.at("tilt_deg").get<double>(),
          j.value("left_hand", false)};
}

json instrumentOut(const ViewState::Instrument& instrument)
{
  json j{{"object", instrument.object}, {"axis", instrument.axis}};
  if (!instrument.name.empty())
    j["name"] = instrument.name;
  return j;
}

ViewState::Instrument instrumentIn(const json& j)
{
  ViewState::Instrument instrument;
  instrument.object = j.at("object").get<std::string>();
  instrument.axis = j.at("axis").get<std::string>();
  instrument.name = j.value("name", std::string());
  return instrument;
}

ViewState::Light lightIn(const json& j)
{
  ViewState::Light light;
  light.falloff = j.at("falloff_mm").get<double>();
  light.wetness = j.at("wetness").get<double>();
  light.shadows = j.value("shadows", false);
  light.exposure = j.value("exposure_ev", 0.0);
  light.toneCurve = j.value("tone_curve", false);
  light.edges = j.value("edges", 0.0);
  light.grain = j.value("grain", 0.0);
  light.exitSurfaces = j.value("exit_surfaces", false);
  return light;
}

json savedOut(const ViewState::Saved& saved)
{
  json j = json::object();
  if (saved.camera)
    j["camera"] = cameraOut(*saved.camera);
  if (saved.slices)
    j["slices"] = slicesOut(*saved.slices);
  if (saved.clipping)
    j["clipping"] = clippingOut(*saved.clipping);
  return j;
}

ViewState::Saved savedIn(const json& j)
{
  ViewState::Saved saved;
  if (j.contains("camera"))
    saved.camera = cameraIn(j.at("camera"));
  if (j.contains("slices"))
    saved.slices = slicesIn(j.at("slices"));
  if (j.contains("clipping"))
    saved.clipping = clippingIn(j.at("clipping"));
  return saved;
}

// The view of a branch as programs before format 10 left it, which is written as they did.
bool isCameraAlone(const ViewState::Saved& saved)
{
  return !saved.slices && !saved.clipping;
}

json branchViewOut(const ViewState::Saved& saved)
{
  return isCameraAlone(saved) ? cameraOut(saved.camera.value()) : savedOut(saved);
}

ViewState::Saved branchViewIn(const json& j)
{
  if (j.contains("slices") || j.contains("clipping"))
    return savedIn(j);
  return {cameraIn(j), std::nullopt, std::nullopt};
}

bool isOfABranch(const Case& value, const std::pair<const std::string, ViewState::Saved>& view)
{
  return value.dissection.history().find(view.first) &&
         (view.second.camera || !isCameraAlone(view.second));
}

json viewOut(const Case& value)
{
  const ViewState& view = value.view;
  checkView(view);
  json j = json::object();
  for (const auto& branch : view.branches)
    if (isOfABranch(value, branch))
      j["branches"][branch.first] = branchViewOut(branch.second);
  if (view.slices)
    j["slices"] = slicesOut(*view.slices);
  if (view.light)
  {
    j["light"] = {{"falloff_mm", view.light->falloff}, {"wetness", view.light->wetness}};
    if (view.light->shadows)
      j["light"]["shadows"] = true;
    if (view.light->exposure != 0.0)
      j["light"]["exposure_ev"] = view.light->exposure;
    if (view.light->toneCurve)
      j["light"]["tone_curve"] = true;
    if (view.light->edges != 0.0)
      j["light"]["edges"] = view.light->edges;
    if (view.light->grain != 0.0)
      j["light"]["grain"] = view.light->grain;
    if (view.light->exitSurfaces)
      j["light"]["exit_surfaces"] = true;
  }
  if (view.stereo)
    j["stereo"] = stereoOut(*view.stereo);
  if (!view.clipping.empty())
    j["clipping"] = clippingOut(view.clipping);
  if (view.tool)
    j["tool"] = toolOut(*view.tool);
  if (view.handpiece)
    j["handpiece"] = handpieceOut(*view.handpiece);
  if (view.instrument)
    j["instrument"] = instrumentOut(*view.instrument);
  for (const auto& [name, saved] : view.saved)
    j["saved"][name] = savedOut(saved);
  return j;
}

ViewState viewIn(const json& j)
{
  ViewState view;
  if (j.contains("branches"))
    for (const auto& [name, one] : j.at("branches").items())
      view.branches[name] = branchViewIn(one);
  if (j.contains("slices"))
    view.slices = slicesIn(j.at("slices"));
  if (j.contains("light"))
    view.light = lightIn(j.at("light"));
  if (j.contains("stereo"))
    view.stereo = stereoIn(j.at("stereo"));
  if (j.contains("clipping"))
    view.clipping = clippingIn(j.at("clipping"));
  if (j.contains("tool"))
    view.tool = toolIn(j.at("tool"));
  if (j.contains("handpiece"))
    view.handpiece = handpieceIn(j.at("handpiece"));
  else if (j.contains("tool") && j.at("tool").contains("handpiece")) // where it was kept at first
    view.handpiece = handpieceIn(j.at("tool").at("handpiece"));
  if (j.contains("instrument"))
    view.instrument = instrumentIn(j.at("instrument"));
  if (j.contains("saved"))
    for (const auto& [name, one] : j.at("saved").items())
      view.saved[name] = savedIn(one);
  checkView(view);
  return view;
}

// Whether programs before format 6 would lose a part of it.
bool needsFormat6(const Case& value)
{
  const ViewState& view = value.view;
  return !value.attachments.empty() || view.light || view.stereo || view.tool ||
         !view.clipping.empty() || (view.slices && (view.slices->planes || view.slices->overlay));
}

// Likewise before format 7.
bool needsFormat7(const Case& value)
{
  const ViewState& view = value.view;
  return !value.measurements.empty() || !view.saved.empty() ||
         (view.slices && (view.slices->turned || view.slices->slab));
}

// Likewise before format 8.
bool needsFormat8(const Case& value)
{
  return std::any_of(value.attachments.begin(), value.attachments.end(),
                     [](const Attachment& one) { return one.video && !one.video->empty(); });
}

// Likewise before format 9; its garbage collection would remove the instrument's surface, too.
bool needsFormat9(const Case& value)
{
  return value.view.instrument.has_value();
}

// Likewise before format 10, which read the views of branches as cameras, and nothing else as one,
// and would have dropped a correction of axes, and laid what comes later on the grid that the file
// states; and dropped how many slices were interpolated beyond a region, and laid labels of the
// unrepaired stack without a question.
bool needsFormat10(const Case& value)
{
  const auto& branches = value.view.branches;
  const auto& saved = value.view.saved;
  const auto isCorrected = [](const auto& part) { return !part.provenance.axes.isIdentity(); };
  const auto isOfRepaired = [](const ImagePart& image)
  { return image.provenance.interpolatedBeyond > 0; };
  return std::any_of(branches.begin(), branches.end(),
                     [&value](const auto& one)
                     { return isOfABranch(value, one) && !isCameraAlone(one.second); }) ||
         std::any_of(saved.begin(), saved.end(),
                     [](const auto& one) { return one.second.clipping.has_value(); }) ||
         isCorrected(value.ct) || isOfRepaired(value.ct) ||
         std::any_of(value.mr.begin(), value.mr.end(), isCorrected) ||
         std::any_of(value.mr.begin(), value.mr.end(), isOfRepaired) ||
         std::any_of(value.labels.begin(), value.labels.end(), isCorrected);
}

json stillOut(const VideoNotes::Still& still)
{
  json j{{"time_ns", still.time},
         {"size", still.size},
         {"opacity", still.opacity},
         {"landmarks", json::array()}};
  for (const VideoNotes::Landmark& one : still.landmarks)
    j["landmarks"].push_back(
        {{"patient_mm", vectorOut(one.patient)}, {"still_px", {one.still.x(), one.still.y()}}});
  if (still.viewAngle)
    j["view_angle_deg"] = *still.viewAngle;
  if (still.camera)
    j["camera"] = cameraOut(*still.camera);
  return j;
}

VideoNotes::Still stillIn(const json& j)
{
  VideoNotes::Still still;
  still.time = integerIn<std::int64_t>(j.at("time_ns"));
  still.size = integersIn<2>(j.at("size"));
  still.opacity = j.at("opacity").get<double>();
  for (const json& one : j.at("landmarks").get_ref<const json::array_t&>())
  {
    const auto at = one.at("still_px").get<std::array<double, 2>>();
    still.landmarks.push_back({vectorIn(one.at("patient_mm")), {at[0], at[1]}});
  }
  if (j.contains("view_angle_deg"))
    still.viewAngle = j.at("view_angle_deg").get<double>();
  if (j.contains("camera"))
    still.camera = cameraIn(j.at("camera"));
  return still;
}

json videoOut(const VideoNotes& notes)
{
  json j = json::object();
  for (const VideoNotes::Bookmark& one : notes.bookmarks)
  {
    j["bookmarks"].push_back({{"name", one.name}, {"time_ns", one.time}});
    if (!one.stroke.empty())
      j["bookmarks"].back()["stroke"] = one.stroke;
  }
  for (const VideoNotes::Still& one : notes.stills)
    j["stills"].push_back(stillOut(one));
  return j;
}

std::shared_ptr<const VideoNotes> videoIn(const json& j)
{
  VideoNotes notes;
  j.get_ref<const json::object_t&>(); // throws of what is none
  if (j.contains("bookmarks"))
    for (const json& one : j.at("bookmarks").get_ref<const json::array_t&>())
      notes.bookmarks.push_back({one.at("name").get<std::string>(),
                                 integerIn<std::int64_t>(one.at("time_ns")),
                                 one.value("stroke", std::string())});
  if (j.contains("stills"))
    for (const json& one : j.at("stills").get_ref<const json::array_t&>())
      notes.stills.push_back(stillIn(one));
  sortVideoNotes(notes);
  return std::make_shared<const VideoNotes>(std::move(notes)); // checked with its attachment
}

json attachmentOut(const Attachment& attachment)
{
  json j{{"kind", nameOf(attachment.kind)}, {"name", attachment.name}, {"bytes", attachment.bytes}};
  const auto add = [&j](const char* key, const std::string& text)
  {
    if (!text.empty())
      j[key] = text;
  };
  add("date", attachment.date);
  add("note", attachment.note);
  add("stroke", attachment.stroke);
  add("object", attachment.object);
  add("link", attachment.link);
  if (!attachment.link.empty())
    j["sha256"] = attachment.sha256;
  if (attachment.video && !attachment.video->empty())
    j["video"] = videoOut(*attachment.video);
  return j;
}

Attachment attachmentIn(const json& j)
{
  Attachment attachment;
  attachment.kind = attachmentKindFrom(j.at("kind").get<std::string>());
  attachment.name = j.at("name").get<std::string>();
  attachment.bytes = integerIn<std::uint64_t>(j.at("bytes"));
  attachment.date = j.value("date", std::string());
  attachment.note = j.value("note", std::string());
  attachment.stroke = j.value("stroke", std::string());
  attachment.object = j.value("object", std::string());
  attachment.link = j.value("link", std::string());
  attachment.sha256 = j.value("sha256", std::string());
  if (j.contains("video"))
    attachment.video = videoIn(j.at("video"));
  if (attachment.object.empty() && attachment.link.empty())
    throw core::InvalidParameter("attachment: one has neither an object nor a link");
  return attachment;
}

json measurementOut(const Measurement& measurement)
{
  json j{
      {"kind", nameOf(measurement.kind)}, {"name", measurement.name}, {"points_mm", json::array()}};
  for (const Eigen::Vector3d& point : measurement.points)
    j["points_mm"].push_back(vectorOut(point));
  if (!measurement.shown)
    j["shown"] = false;
  if (!measurement.structure.empty())
    j["structure"] = measurement.structure;
  if (measurement.structureGone)
    j["structure_gone"] = true;
  if (!measurement.image.empty())
    j["image"] = measurement.image;
  if (!measurement.images.empty())
    j["images"] = measurement.images;
  if (!measurement.readings.empty())
    j[kMadeFrom] = readingsOut(measurement.readings);
  return j;
}

Measurement measurementIn(const json& j)
{
  Measurement measurement;
  measurement.kind = measurementKindFrom(j.at("kind").get<std::string>());
  measurement.name = j.at("name").get<std::string>();
  for (const json& point : j.at("points_mm").get_ref<const json::array_t&>())
    measurement.points.push_back(vectorIn(point));
  measurement.shown = j.value("shown", true);
  measurement.structure = j.value("structure", std::string());
  measurement.structureGone = j.value("structure_gone", false);
  measurement.image = j.value("image", std::string());
  measurement.images = j.value("images", std::vector<std::string>());
  measurement.readings = readingsIn(j);
  return measurement;
}

bool isFinite(const json& j)
{
  if (j.is_structured())
    return std::all_of(j.begin(), j.end(), [](const json& part) { return isFinite(part); });
  return !j.is_number_float() || std::isfinite(j.get<double>());
}

/// JSON cannot represent non-finite numbers: they would be written as null, and the case could not
/// be read again.
void requireFinite(const json& j, const std::string& where)
{
  if (isFinite(j))
    return;
  if (!j.is_structured())
    throw core::InvalidParameter("case: " + where + " is not a finite number");
  for (const auto& [key, part] : j.items())
    requireFinite(part, where.empty() ? key : where + "." + key);
}

Case caseIn(const json& j)
{
  const auto presets = appearance::StructurePresets::builtIn();
  Case value;
  value.name = j.at("name").get<std::string>();
  value.id = j.value("id", std::string());
  value.revision = integerIn<std::uint64_t>(j.at("revision"));
  value.iso = j.at("iso_hu").get<double>();
  value.denseBone = j.value("dense_bone_hu", value.denseBone);
  if (j.contains("soft_tissue_values"))
    value.softTissueValues = {j.at("soft_tissue_values").at("foot").get<double>(),
                              j.at("soft_tissue_values").at("peak").get<double>()};
  value.ct = imageIn(j.at("ct"));
  value.ct.name = plainIn(j.at("ct").at("name")); // no part's, which are checked
  if (j.contains("bone"))
    value.boneLook = lookIn(j.at("bone"), presets);
  if (j.contains("soft_tissue"))
  {
    value.softTissue = lookIn(j.at("soft_tissue"), presets);
    appearance::makeUntouchable(value.softTissue);
  }
  for (const json& m : j.at("mr"))
  {
    ImagePart mr = imageIn(m);
    mr.registered = m.at("registered").get<bool>();
    mr.mrFromCt = poseIn(m.at("mr_from_ct"));
    if (m.contains("registration"))
      mr.registration = registrationIn(m.at("registration"));
    value.mr.push_back(std::move(mr));
  }
  for (const json& part : j.at("labels"))
    value.labels.push_back(labelsIn(part, presets));
  for (const json& m : j.at("meshes"))
  {
    MeshPart mesh;
    mesh.name = m.at("name").get<std::string>();
    mesh.object = m.at("object").get<std::string>();
    mesh.triangles = integerIn<std::size_t>(m.at("triangles"));
    mesh.notes = plainTextsIn(m.at("notes"));
    mesh.look = lookIn(m.at("look"), presets);
    mesh.drawnOn = m.value("drawn_on", std::string());
    value.meshes.push_back(std::move(mesh));
  }
  if (j.contains("camera"))
    value.camera = cameraIn(j.at("camera"));
  if (j.contains("view"))
    value.view = viewIn(j.at("view"));
  if (j.contains("description"))
    value.description = descriptionIn(j.at("description"));
  if (j.contains("attachments"))
    for (const json& attachment : j.at("attachments"))
      value.attachments.push_back(attachmentIn(attachment));
  checkAttachments(value.attachments);
  if (j.contains("measurements"))
    for (const json& measurement : j.at("measurements").get_ref<const json::array_t&>())
      value.measurements.push_back(measurementIn(measurement));
  checkMeasurements(value.measurements);
  for (Measurement& one : value.measurements)
    if (!one.structure.empty() && !kindOfPart(value, one.structure))
      one.structureGone = true;
  const json& drilled = j.at("dissection");
  dissection::Dissection::Strokes strokes;
  for (const json& stroke : drilled.at("strokes"))
    strokes.push_back(std::make_shared<const dissection::Stroke>(strokeIn(stroke)));
  const auto history =
      integerIn<int>(j.at("petrous_case")) < kFirstFormatWithBranches
          ? dissection::History::line(strokes.size(), integerIn<std::size_t>(drilled.at("applied")))
          : historyIn(drilled.at("history"));
  value.dissection = dissection::Dissection(std::move(strokes), history);
  checkCaseName(value.name);
  return value;
}

} // namespace

ManifestError::ManifestError(Reason r, const std::string& message)
  : Error(core::Fault::BadInput, message)
  , reason(r)
{
}

std::string toManifest(const Case& value)
{
  const bool hasCodes =
      std::any_of(value.labels.begin(), value.labels.end(),
                  [](const LabelPart& part)
                  {
                    return std::any_of(part.structures.begin(), part.structures.end(),
                                       [](const auto& s) { return !s.codes.empty(); });
                  });
  checkDescription(value.description);
  checkAttachments(value.attachments);
  checkMeasurements(value.measurements);
  const bool isDescribed = !value.description.empty();
  json j{{"petrous_case", needsFormat10(value)  ? kManifestFormat
                          : needsFormat9(value) ? kFormatWithCamerasOfBranches
                          : needsFormat8(value) ? kFormatWithoutInstrument
                          : needsFormat7(value) ? kFormatWithoutVideoNotes
                          : needsFormat6(value) ? kFormatWithoutMeasurements
                          : isDescribed         ? kFormatWithoutAttachments
                          : hasCodes            ? kFormatWithoutDescription
                                                : kFormatWithoutCodes},
         {"name", value.name},
         {"revision", value.revision},
         {"iso_hu", value.iso},
         {"dense_bone_hu", value.denseBone},
         {"ct", imageOut(value.ct)},
         {"bone", appearance::appearanceJson(value.boneLook)},
         {"mr", json::array()},
         {"labels", json::array()},
         {"meshes", json::array()}};
  for (const ImagePart& image : value.mr)
  {
    json mr = imageOut(image);
    mr["registered"] = image.registered;
    mr["mr_from_ct"] = poseOut(image.mrFromCt);
    if (image.registration)
      mr["registration"] = registrationOut(*image.registration);
    j["mr"].push_back(std::move(mr));
  }
  for (const LabelPart& part : value.labels)
    j["labels"].push_back(labelsOut(part));
  for (const MeshPart& mesh : value.meshes)
    j["meshes"].push_back(meshOut(mesh));
  if (!(value.softTissue == appearance::softTissueLook()))
    j["soft_tissue"] = appearance::appearanceJson(value.softTissue);
  if (value.softTissueValues)
    j["soft_tissue_values"] = {{"foot", value.softTissueValues->foot},
                               {"peak", value.softTissueValues->peak}};
  if (!value.id.empty())
    j["id"] = value.id;
  if (value.camera)
    j["camera"] = cameraOut(*value.camera);
  if (json view = viewOut(value); !view.empty())
    j["view"] = std::move(view);
  if (isDescribed)
    j["description"] = descriptionOut(value.description);
  for (const Attachment& attachment : value.attachments)
    j["attachments"].push_back(attachmentOut(attachment));
  for (const Measurement& measurement : value.measurements)
    j["measurements"].push_back(measurementOut(measurement));
  json strokes = json::array();
  for (const auto& stroke : value.dissection.strokes())
    strokes.push_back(strokeOut(*stroke));
  j["dissection"] = {{"history", historyOut(value.dissection.history())},
                     {"strokes", std::move(strokes)}};
  requireFinite(j, "");
  return j.dump(1) + "\n";
}

namespace
{

// `read` of the parsed text, its failures as ManifestError.
template <class Read>
auto readManifest(std::string_view text, const std::string& source,
                  const json::parser_callback_t& wanted, const Read& read)
{
  using Reason = ManifestError::Reason;
  try
  {
    const json j = json::parse(text, wanted);
    const auto format = integerIn<std::int64_t>(j.at("petrous_case"));
    if (format > kManifestFormat)
      throw ManifestError(Reason::NewerFormat,
                          source + ": written by format " + std::to_string(format) +
                              "; this program reads up to " + std::to_string(kManifestFormat) +
                              ". A newer version of Petrous wrote it; open it with that one, here "
                              "it is left alone");
    return read(j);
  }
  catch (const json::exception&)
  {
    throw ManifestError(Reason::Damaged,
                        source + ": not a whole case manifest; restore it from a copy");
  }
  catch (const core::InvalidParameter& error)
  {
    throw ManifestError(Reason::Damaged, source + ": " + error.what());
  }
}

} // namespace

Case fromManifest(std::string_view text, const std::string& source)
{
  return readManifest(text, source, nullptr, [](const json& j) { return caseIn(j); });
}

Description descriptionFromManifest(std::string_view text, const std::string& source)
{
  const auto wanted = [](int depth, json::parse_event_t event, json& parsed)
  {
    return event != json::parse_event_t::key || depth != 1 || parsed == "description" ||
           parsed == "petrous_case";
  };
  return readManifest(text, source, wanted,
                      [](const json& j) {
                        return j.contains("description") ? descriptionIn(j.at("description"))
                                                         : Description();
                      });
}

} // namespace petrous::scene
