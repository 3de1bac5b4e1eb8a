#include "petrous/Scene/Manifest.h"

#include <nlohmann/json.hpp>

#include "petrous/Dissection/BurrName.h"

namespace petrous::scene
{

namespace
{

using nlohmann::json;

json vectorOut(const Eigen::Vector3d& v)
{
  return {v[0], v[1], v[2]};
}

Eigen::Vector3d vectorIn(const json& j)
{
  const auto v = j.get<std::array<double, 3>>();
  return {v[0], v[1], v[2]};
}

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
  return {j.at("dims").get<core::Index3>(), vectorIn(j.at("spacing_mm")),
          vectorIn(j.at("origin_mm")), direction};
}

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

json imageOut(const ImagePart& image)
{
  return {{"name", image.name},     {"object", image.object}, {"grid", gridOut(image.geometry)},
          {"min", image.range.min}, {"max", image.range.max}, {"notes", image.notes}};
}

ImagePart imageIn(const json& j)
{
  ImagePart image;
  image.name = j.at("name").get<std::string>();
  image.object = j.at("object").get<std::string>();
  image.geometry = gridIn(j.at("grid"));
  image.range = {j.at("min").get<double>(), j.at("max").get<double>()};
  image.notes = j.at("notes").get<std::vector<std::string>>();
  return image;
}

json lookOut(const appearance::StructureLook& look)
{
  json j{{"preset", look.preset},     {"color", look.color},
         {"opacity", look.opacity},   {"flags", appearance::flagsOf(look)},
         {"solid", look.solid},       {"shininess", look.shininess},
         {"priority", look.priority}, {"tissue", look.tissue}};
  if (look.transfer)
  {
    j["transfer"] = json::parse(look.transfer->toJson());
    j["transfer"]["relative"] = look.relative;
  }
  if (!look.sourceImage.empty())
    j["source_image"] = look.sourceImage;
  if (look.stiffness > 0.0)
    j["stiffness_n_per_mm"] = look.stiffness;
  return j;
}

// What came after the first manifests may be missing; such a look is as it was before.
appearance::StructureLook lookIn(const json& j, const appearance::StructurePresets& presets)
{
  appearance::StructureLook look;
  look.preset = j.at("preset").get<std::string>();
  look.color = j.at("color").get<std::array<float, 3>>();
  look.opacity = j.at("opacity").get<float>();
  look.solid = j.at("solid").get<bool>();
  appearance::setFlags(look, j.at("flags").get<std::string>());
  look.shininess = j.value("shininess", look.shininess);
  look.priority =
      j.contains("priority") ? j.at("priority").get<int>() : presets.lookFor(look.preset).priority;
  look.tissue = j.contains("tissue") ? j.at("tissue").get<std::string>()
                                     : presets.lookFor(look.preset).tissue;
  look.sourceImage = j.value("source_image", std::string());
  appearance::setStiffness(look, j.value("stiffness_n_per_mm", 0.0));
  if (j.contains("transfer"))
  {
    json transfer = j.at("transfer");
    look.relative = transfer.value("relative", false);
    transfer.erase("relative");
    look.transfer = appearance::TransferFunction::fromJson(transfer.dump());
  }
  return look;
}

json cameraOut(const core::CameraPose& camera)
{
  json j{{"position_mm", vectorOut(camera.position)},
         {"focal_point_mm", vectorOut(camera.focalPoint)},
         {"view_up", vectorOut(camera.viewUp)}};
  if (camera.parallelScale)
    j["parallel_scale_mm"] = *camera.parallelScale;
  else
    j["view_angle_deg"] = camera.viewAngle;
  return j;
}

core::CameraPose cameraIn(const json& j)
{
  core::CameraPose camera;
  camera.position = vectorIn(j.at("position_mm"));
  camera.focalPoint = vectorIn(j.at("focal_point_mm"));
  camera.viewUp = vectorIn(j.at("view_up"));
  if (j.contains("parallel_scale_mm"))
    camera.parallelScale = j.at("parallel_scale_mm").get<double>();
  else
    camera.viewAngle = j.at("view_angle_deg").get<double>();
  return camera;
}

json strokeOut(const StrokePart& stroke)
{
  json structures = json::array();
  for (const auto& touched : stroke.info.structures)
    structures.push_back({{"name", touched.name}, {"removed_mm3", touched.volume}});
  const dissection::Burr& burr = stroke.info.burr;
  json j{{"object", stroke.object},
         {"bytes", stroke.bytes},
         {"started_at", stroke.info.startedAt},
         {"duration_s", stroke.info.duration},
         {"burr", dissection::nameOf(burr.kind)},
         {"diameter_mm", burr.diameter},
         {"rpm", burr.rpm},
         {"removed_mm3", stroke.info.removed},
         {"structures", structures}};
  if (stroke.info.camera)
    j["camera"] = cameraOut(*stroke.info.camera);
  return j;
}

StrokePart strokeIn(const json& j)
{
  StrokePart stroke;
  stroke.object = j.at("object").get<std::string>();
  stroke.bytes = j.at("bytes").get<std::size_t>();
  stroke.info.startedAt = j.at("started_at").get<std::string>();
  stroke.info.duration = j.at("duration_s").get<double>();
  stroke.info.burr.kind = dissection::parseBurrKind(j.at("burr").get<std::string>())
                              .value_or(dissection::Burr::Kind::Cutting);
  stroke.info.burr.diameter = j.at("diameter_mm").get<double>();
  stroke.info.burr.rpm = j.at("rpm").get<double>();
  stroke.info.removed = j.at("removed_mm3").get<double>();
  for (const json& touched : j.at("structures"))
    stroke.info.structures.push_back(
        {touched.at("name").get<std::string>(), touched.at("removed_mm3").get<double>()});
  if (j.contains("camera"))
    stroke.info.camera = cameraIn(j.at("camera"));
  return stroke;
}

json labelsOut(const LabelPart& part)
{
  json structures = json::array();
  for (const StructurePart& s : part.structures)
    structures.push_back({{"name", s.name},
                          {"index", s.index},
                          {"voxels", s.voxels},
                          {"volume_mm3", s.volume},
                          {"look", lookOut(s.look)}});
  return {{"object", part.object}, {"structures", structures}};
}

LabelPart labelsIn(const json& j, const appearance::StructurePresets& presets)
{
  LabelPart part;
  part.object = j.at("object").get<std::string>();
  for (const json& s : j.at("structures"))
    part.structures.push_back({s.at("name").get<std::string>(), s.at("index").get<std::uint16_t>(),
                               s.at("voxels").get<std::uint64_t>(),
                               s.at("volume_mm3").get<double>(), lookIn(s.at("look"), presets)});
  return part;
}

Case caseIn(const json& j)
{
  const auto presets = appearance::StructurePresets::builtIn();
  Case value;
  value.name = j.at("name").get<std::string>();
  value.revision = j.at("revision").get<std::uint64_t>();
  value.iso = j.at("iso_hu").get<double>();
  value.denseBone = j.value("dense_bone_hu", value.denseBone);
  value.ct = imageIn(j.at("ct"));
  if (j.contains("bone"))
    value.boneLook = lookIn(j.at("bone"), presets);
  for (const json& m : j.at("mr"))
  {
    ImagePart mr = imageIn(m);
    mr.registered = m.at("registered").get<bool>();
    mr.mrFromCt = poseIn(m.at("mr_from_ct"));
    value.mr.push_back(std::move(mr));
  }
  for (const json& part : j.at("labels"))
    value.labels.push_back(labelsIn(part, presets));
  for (const json& m : j.at("meshes"))
  {
    MeshPart mesh;
    mesh.name = m.at("name").get<std::string>();
    mesh.object = m.at("object").get<std::string>();
    mesh.triangles = m.at("triangles").get<std::size_t>();
    mesh.notes = m.at("notes").get<std::vector<std::string>>();
    mesh.look = lookIn(m.at("look"), presets);
    value.meshes.push_back(std::move(mesh));
  }
  if (j.contains("camera"))
    value.camera = cameraIn(j.at("camera"));
  for (const json& stroke : j.at("dissection").at("strokes"))
    value.strokes.push_back(strokeIn(stroke));
  value.applied = j.at("dissection").at("applied").get<std::size_t>();
  if (value.applied > value.strokes.size())
    throw core::InvalidParameter("more strokes applied than there are");
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
  json j{{"petrous_case", kManifestFormat},  {"name", value.name},
         {"revision", value.revision},       {"iso_hu", value.iso},
         {"dense_bone_hu", value.denseBone}, {"ct", imageOut(value.ct)},
         {"bone", lookOut(value.boneLook)},  {"mr", json::array()},
         {"labels", json::array()},          {"meshes", json::array()}};
  for (const ImagePart& image : value.mr)
  {
    json mr = imageOut(image);
    mr["registered"] = image.registered;
    mr["mr_from_ct"] = poseOut(image.mrFromCt);
    j["mr"].push_back(std::move(mr));
  }
  for (const LabelPart& part : value.labels)
    j["labels"].push_back(labelsOut(part));
  for (const MeshPart& mesh : value.meshes)
    j["meshes"].push_back({{"name", mesh.name},
                           {"object", mesh.object},
                           {"triangles", mesh.triangles},
                           {"notes", mesh.notes},
                           {"look", lookOut(mesh.look)}});
  if (value.camera)
    j["camera"] = cameraOut(*value.camera);
  json strokes = json::array();
  for (const StrokePart& stroke : value.strokes)
    strokes.push_back(strokeOut(stroke));
  j["dissection"] = {{"applied", value.applied}, {"strokes", std::move(strokes)}};
  return j.dump(1) + "\n";
}

Case fromManifest(std::string_view text, const std::string& source)
{
  using Reason = ManifestError::Reason;
  try
  {
    const json j = json::parse(text);
    const int format = j.at("petrous_case").get<int>();
    if (format > kManifestFormat)
      throw ManifestError(Reason::NewerFormat,
                          source + ": written by format " + std::to_string(format) +
                              "; this program reads up to " + std::to_string(kManifestFormat));
    return caseIn(j);
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

} // namespace petrous::scene
