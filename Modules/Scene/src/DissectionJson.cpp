#include "DissectionJson.h"

#include "PlaceRange.h"
#include "petrous/Dissection/BurrName.h"
#include "petrous/Scene/Branches.h"
#include "petrous/Scene/HistoryText.h"
#include "petrous/Scene/Manifest.h"
#include "petrous/Scene/PlainText.h"

namespace petrous::scene
{

using dissection::History;
using nlohmann::json;

namespace
{

// kStart + 1 is 0.
std::size_t numberOf(std::size_t state)
{
  return state + 1;
}

std::size_t stateOf(const json& number)
{
  if (!number.is_number_unsigned())
    throw core::InvalidParameter("history: a stroke's number is invalid");
  return number.get<std::size_t>() - 1;
}

void requireOfCamera(bool holds, const std::string& what)
{
  if (!holds)
    throw core::InvalidParameter("camera: " + what);
}

template <class Parse>
auto parsed(std::string_view text, Parse parse)
{
  try
  {
    return parse(json::parse(text));
  }
  catch (const json::exception&)
  {
    throw core::InvalidParameter("history: not the text that was written");
  }
}

} // namespace

std::string plainIn(const json& j)
{
  auto text = j.get<std::string>();
  return hasInvisible(text) ? withoutInvisible(text) : text;
}

json vectorOut(const Eigen::Vector3d& v)
{
  return {v[0], v[1], v[2]};
}

Eigen::Vector3d vectorIn(const json& j)
{
  const auto v = j.get<std::array<double, 3>>();
  return {v[0], v[1], v[2]};
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
  for (const auto& [key, place] : {std::pair("position_mm", &core::CameraPose::position),
                                   std::pair("focal_point_mm", &core::CameraPose::focalPoint)})
  {
    camera.*place = vectorIn(j.at(key));
    requireOfCamera(isPlace(camera.*place), std::string(key) + " must lie within 10 km");
  }
  camera.viewUp = vectorIn(j.at("view_up"));
  const double up = camera.viewUp.norm();
  requireOfCamera(up > 0.0 && up <= kFarthestPlace, "view_up must be a direction");
  if (j.contains("parallel_scale_mm"))
  {
    camera.parallelScale = j.at("parallel_scale_mm").get<double>();
    requireOfCamera(*camera.parallelScale > 0.0 && *camera.parallelScale <= kFarthestPlace,
                    "parallel_scale_mm must be above 0 mm, to 10 km");
  }
  else
  {
    camera.viewAngle = j.at("view_angle_deg").get<double>();
    requireOfCamera(camera.viewAngle > 0.0 && camera.viewAngle < 180.0,
                    "view_angle_deg must lie between 0 and 180 degrees");
  }
  return camera;
}

json strokeOut(const dissection::Stroke& stroke)
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
  if (!burr.name.empty())
    j["burr_name"] = burr.name;
  if (stroke.info.speed)
  {
    j["rpm_mean"] = stroke.info.speed->mean;
    j["rpm_max"] = stroke.info.speed->max;
  }
  if (stroke.info.camera)
    j["camera"] = cameraOut(*stroke.info.camera);
  if (stroke.info.recovered)
    j["recovered"] = true;
  return j;
}

dissection::Stroke strokeIn(const json& j)
{
  dissection::Stroke stroke;
  stroke.object = j.at("object").get<std::string>();
  stroke.bytes = integerIn<std::size_t>(j.at("bytes"));
  stroke.info.startedAt = plainIn(j.at("started_at"));
  stroke.info.duration = j.at("duration_s").get<double>();
  stroke.info.burr.kind = dissection::parseBurrKind(j.at("burr").get<std::string>())
                              .value_or(dissection::Burr::Kind::Cutting);
  dissection::setName(stroke.info.burr, j.value("burr_name", std::string()));
  stroke.info.burr.diameter = j.at("diameter_mm").get<double>();
  stroke.info.burr.rpm = j.at("rpm").get<double>();
  if (j.contains("rpm_mean"))
    stroke.info.speed = {j.at("rpm_mean").get<double>(), j.at("rpm_max").get<double>()};
  stroke.info.removed = j.at("removed_mm3").get<double>();
  for (const json& touched : j.at("structures"))
    stroke.info.structures.push_back(
        {plainIn(touched.at("name")), touched.at("removed_mm3").get<double>()});
  if (j.contains("camera"))
    stroke.info.camera = cameraIn(j.at("camera"));
  stroke.info.recovered = j.value("recovered", false);
  return stroke;
}

json historyOut(const History& history)
{
  json parents = json::array();
  for (std::size_t n = 0; n < history.size(); ++n)
    parents.push_back(numberOf(history.parent(n)));
  json branches = json::array();
  for (const History::Branch& branch : history.branches())
  {
    branches.push_back({{"name", branch.name},
                        {"tip", numberOf(branch.tip)},
                        {"position", numberOf(branch.position)}});
    if (branch.setAside)
      branches.back()["set_aside"] = true;
  }
  return {{"branch", history.branch().name},
          {"branches", std::move(branches)},
          {"parents", std::move(parents)}};
}

History historyIn(const json& j)
{
  std::vector<std::size_t> parents;
  for (const json& parent : j.at("parents"))
    parents.push_back(stateOf(parent));
  std::vector<History::Branch> branches;
  const auto name = j.at("branch").get<std::string>();
  std::size_t present = History::kStart;
  for (const json& b : j.at("branches"))
  {
    History::Branch branch{b.at("name").get<std::string>(), stateOf(b.at("tip")),
                           stateOf(b.at("position")), b.value("set_aside", false)};
    checkBranchName(branch.name);
    if (branch.name == name)
      present = branches.size();
    branches.push_back(std::move(branch));
  }
  return {std::move(parents), std::move(branches), present};
}

std::string toText(const dissection::Stroke& stroke)
{
  return strokeOut(stroke).dump();
}

std::string toText(const History& history)
{
  return historyOut(history).dump();
}

dissection::Stroke strokeFromText(std::string_view text)
{
  return parsed(text, strokeIn);
}

History historyFromText(std::string_view text)
{
  return parsed(text, historyIn);
}

} // namespace petrous::scene
