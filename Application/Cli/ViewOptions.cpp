#include "ViewOptions.h"

#include <array>
#include <cmath>

#include "CaseJson.h"
#include "Context.h"
#include "Numbers.h"
#include "petrous/Core/InputFile.h"
#include "petrous/Presenters/Background.h"

namespace petrous::cli
{

namespace
{

constexpr double kFarthest = 1e7; // mm: beyond any patient, and squares stay finite

Eigen::Vector3d vectorFrom(const nlohmann::json& object, const char* key)
{
  const auto v = object.at(key).get<std::array<double, 3>>();
  return {v[0], v[1], v[2]};
}

bool isWithin(double value, double lower, double upper)
{
  return value >= lower && value <= upper; // false for NaN
}

void check(const std::string& path, const core::CameraPose& camera)
{
  const auto refuse = [&path](const std::string& what)
  { throw core::InvalidParameter(path + ": " + what); };
  for (const Eigen::Vector3d* vector : {&camera.position, &camera.focalPoint, &camera.viewUp})
    if (!vector->allFinite() || vector->cwiseAbs().maxCoeff() > kFarthest)
      refuse("a coordinate is not a number or beyond 10 km; position_mm and focal_point_mm are in "
             "patient LPS mm");
  const Eigen::Vector3d view = camera.focalPoint - camera.position;
  if (view.norm() < 1e-9)
    refuse("position_mm and focal_point_mm must differ: the camera looks from one to the other");
  if (view.cross(camera.viewUp).norm() <= 1e-9 * view.norm() * camera.viewUp.norm())
    refuse("view_up must not be zero nor lie along the direction of view");
  if (camera.parallelScale && !isWithin(*camera.parallelScale, 1e-3, 1e6))
    refuse("parallel_scale_mm must lie within 0.001 to 1000000 mm (half the picture's height)");
  if (!camera.parallelScale && !isWithin(camera.viewAngle, 0.1, 170.0))
    refuse("view_angle_deg must lie within 0.1 to 170 degrees");
}

} // namespace

core::CameraPose readCamera(const std::string& path)
{
  const std::string text = core::readFile(path, kLargestJson);
  core::CameraPose camera;
  try
  {
    const auto json = nlohmann::json::parse(text);
    camera.position = vectorFrom(json, "position_mm");
    camera.focalPoint = vectorFrom(json, "focal_point_mm");
    camera.viewUp = vectorFrom(json, "view_up");
    if (json.contains("parallel_scale_mm"))
      camera.parallelScale = json.at("parallel_scale_mm").get<double>();
    else
      camera.viewAngle = json.at("view_angle_deg").get<double>();
  }
  catch (const nlohmann::json::exception&) // also for NaN and Infinity, which JSON lacks
  {
    throw core::InvalidParameter(
        path + ": not a camera; expected {\"position_mm\":[x,y,z],\"focal_point_mm\":[x,y,z],"
               "\"view_up\":[x,y,z],\"view_angle_deg\":30} (or \"parallel_scale_mm\") with finite "
               "numbers");
  }
  check(path, camera);
  return camera;
}

nlohmann::json cameraJson(const core::CameraPose& camera)
{
  nlohmann::json json{{"position_mm", vectorJson(camera.position)},
                      {"focal_point_mm", vectorJson(camera.focalPoint)},
                      {"view_up", vectorJson(camera.viewUp)}};
  if (camera.parallelScale)
    json["parallel_scale_mm"] = *camera.parallelScale;
  else
    json["view_angle_deg"] = camera.viewAngle;
  return json;
}

std::vector<scene::ViewState::Clipping::Plane> parsePlanes(const std::vector<std::string>& texts)
{
  constexpr std::size_t kMax = scene::ViewState::kMaxClippingPlanes;
  if (texts.size() > kMax)
    throw UsageError("--clip: at most " + std::to_string(kMax) + " planes, not " +
                     std::to_string(texts.size()));
  std::vector<scene::ViewState::Clipping::Plane> planes;
  for (const std::string& text : texts)
  {
    const auto n = parseNumbers(text, 6, "--clip x,y,z,nx,ny,nz");
    const Eigen::Vector3d normal(n[3], n[4], n[5]);
    const double length = normal.stableNorm();
    if (!(length > 1e-12) || !std::isfinite(length))
      throw UsageError("--clip x,y,z,nx,ny,nz: the normal must not be zero; it points to the side "
                       "that is kept");
    planes.push_back({{n[0], n[1], n[2]}, normal / length});
  }
  return planes;
}

std::optional<core::IndexBox> parseCrop(const std::string& crop, const std::string& roi,
                                        const core::GridGeometry& grid)
{
  core::IndexBox box;
  if (!crop.empty() && !roi.empty())
    throw UsageError("give --crop or --roi, not both");
  if (!crop.empty())
  {
    const char* name = "--crop i0,i1,j0,j1,k0,k1";
    const auto n = parseNumbers(crop, 6, name);
    for (std::size_t a = 0; a < 3; ++a)
    {
      box.lower[a] = toInt(n[2 * a], name);
      box.upper[a] = toInt(n[2 * a + 1], name);
      if (box.lower[a] < box.upper[a])
        ++box.upper[a];
      else
        throw UsageError(std::string(name) + ": first and last voxel; each first number must be "
                                             "the smaller one");
    }
  }
  else if (!roi.empty())
  {
    const core::PatientBox region = parseBox(roi, "--roi");
    box = grid.boxCovering(region.min(), region.max());
  }
  else
    return std::nullopt;
  const core::IndexBox inside = box.intersected(grid.fullBox());
  if (inside.empty())
    throw UsageError(std::string(crop.empty() ? "--roi" : "--crop") +
                     ": the box does not overlap the CT");
  return inside;
}

scene::ViewState::Light LightOptions::over(scene::ViewState::Light light) const
{
  light.falloff = falloff.value_or(light.falloff);
  light.wetness = wetness.value_or(light.wetness);
  light.shadows = shadows.value_or(light.shadows);
  light.exposure = exposure.value_or(light.exposure);
  light.toneCurve = toneCurve.value_or(light.toneCurve);
  light.edges = edges.value_or(light.edges);
  light.grain = grain.value_or(light.grain);
  light.exitSurfaces = exitSurfaces.value_or(light.exitSurfaces);
  return light;
}

namespace
{

// What a switch may be given after '='. The parser by itself lets an exception of the library's
// number parser through.
CLI::Validator truth()
{
  return {[](std::string& text)
          {
            for (const char* known : {"true", "false", "on", "off", "yes", "no", "1", "0"})
              if (text == known)
                return std::string();
            return "true or false, not '" + text + "'";
          },
          ""};
}

} // namespace

void addLightOptions(CLI::App& command, LightOptions& options, const std::string& defaultText)
{
  constexpr double kMaxExposure = scene::ViewState::Light::kMaxExposure;
  const auto addFlag =
      [&](const std::string& name, std::optional<bool>& value, const std::string& help)
  {
    command
        .add_flag_function(
            "--" + name + ",!--no-" + name, [&value](std::int64_t times) { value = times > 0; },
            help + defaultText)
        ->check(truth());
  };
  const auto addShare = [&](const char* name, std::optional<double>& value, const std::string& help)
  {
    command.add_option(std::string("--") + name, value, help + defaultText)
        ->check(within({0.0, 1.0}));
  };
  command
      .add_option("--light-falloff", options.falloff,
                  "Distance at which the light has half its intensity, with the focal point as "
                  "bright as without; 0: no falloff" +
                      defaultText)
      ->type_name("MM")
      ->check(within({0.0, 10000.0, "mm"}));
  addShare("wetness", options.wetness,
           "A film of water on tissue, thin highlights in place of its gloss, 0 to 1");
  addFlag("shadows", options.shadows,
          "Darken cavities, and throw the soft shadow of a lamp above the view axis");
  command
      .add_option("--exposure", options.exposure,
                  "Brightness in stops, -4 to 4: one more doubles the luminance" + defaultText)
      ->type_name("EV")
      ->check(within({-kMaxExposure, kMaxExposure, "EV"}));
  addFlag("tone-curve", options.toneCurve,
          "Roll highlights off above 80 % instead of clipping them");
  addShare("edges", options.edges,
           "More opacity of translucent surfaces that are seen from the side, 0 to 1");
  addShare("grain", options.grain,
           "Contrast of a fine grain on cut bone, which the CT does not have, 0 to 1");
  addFlag("exit-surfaces", options.exitSurfaces,
          "Shade translucent tissue also where a line of sight leaves it");
}

void addBackgroundOption(CLI::App& command, rendering::BackgroundColor& color)
{
  std::string choices;
  for (const presenters::NamedBackground& one : presenters::kBackgrounds)
    choices += (choices.empty() ? "" : ", ") + std::string(one.name);
  choices += " or #rrggbb";
  command
      .add_option_function<std::string>(
          "--background",
          [&color](const std::string& text) { color = *presenters::parseBackground(text); },
          "Background of the 3D picture: " + choices + " (" + presenters::backgroundText(color) +
              ")")
      ->type_name("COLOR")
      ->check(CLI::Validator(
          [choices](std::string& text) {
            return presenters::parseBackground(text) ? std::string()
                                                     : choices + ", not '" + text + "'";
          },
          ""));
}

} // namespace petrous::cli
