#include <chrono>
#include <fstream>
#include <sstream>

#include "CaseJson.h"
#include "Commands.h"
#include "Numbers.h"
#include "petrous/Presenters/CasePicture.h"
#include "petrous/Rendering/OffscreenView.h"
#include "petrous/Rendering/ReferenceRayCaster.h"

namespace petrous::cli
{

namespace
{

struct Options
{
  std::string caseName, out, size = "800x600", view, camera, stereo = "none", engine = "gpu", depth;
};

std::pair<int, int> parseSize(const std::string& text)
{
  int width = 0;
  int height = 0;
  char rest = 0;
  if (std::sscanf(text.c_str(), "%dx%d%c", &width, &height, &rest) != 2 || width < 8 ||
      height < 8 || width > 8192 || height > 8192)
    throw UsageError("--size: WIDTHxHEIGHT with 8 to 8192 pixels each, not '" + text + "'");
  return {width, height};
}

Eigen::Vector3d vectorFrom(const nlohmann::json& json, const char* key)
{
  const auto v = json.at(key).get<std::array<double, 3>>();
  return {v[0], v[1], v[2]};
}

core::CameraPose readCamera(const std::string& path)
{
  std::ifstream file = openForReading(path);
  core::CameraPose camera;
  try
  {
    const auto json = nlohmann::json::parse(file);
    camera.position = vectorFrom(json, "position_mm");
    camera.focalPoint = vectorFrom(json, "focal_point_mm");
    camera.viewUp = vectorFrom(json, "view_up");
    if (json.contains("parallel_scale_mm"))
      camera.parallelScale = json.at("parallel_scale_mm").get<double>();
    else
      camera.viewAngle = json.at("view_angle_deg").get<double>();
  }
  catch (const nlohmann::json::exception&)
  {
    throw core::InvalidParameter(
        path + ": no camera; it must be {\"position_mm\":[x,y,z],\"focal_point_mm\":[x,y,z],"
               "\"view_up\":[x,y,z],\"view_angle_deg\":30} (or \"parallel_scale_mm\")");
  }
  const Eigen::Vector3d view = camera.focalPoint - camera.position;
  const bool angleOk = camera.parallelScale
                           ? *camera.parallelScale > 0.0 && std::isfinite(*camera.parallelScale)
                           : camera.viewAngle > 0.1 && camera.viewAngle < 170.0;
  if (!view.allFinite() || !camera.viewUp.allFinite() || view.norm() < 1e-9 ||
      view.cross(camera.viewUp).norm() < 1e-9 * view.norm() || !angleOk)
    throw core::InvalidParameter(path + ": the camera must look somewhere, view_up must not lie "
                                        "along that direction, and the angle must lie within 0.1 "
                                        "to 170 degrees (or the scale above 0 mm)");
  return camera;
}

core::CameraPose chooseCamera(const Options& options, const scene::Case& value)
{
  if (!options.view.empty() && !options.camera.empty())
    throw UsageError("render: give --view or --camera, not both");
  if (!options.camera.empty())
    return readCamera(options.camera);
  if (options.view.empty())
    return presenters::currentCamera(value);
  const auto view = rendering::parseView(options.view);
  if (!view)
    throw UsageError(
        "--view: lateral, left, right, superior, inferior, anterior or posterior, not '" +
        options.view + "'");
  return presenters::standardCamera(value, *view);
}

void render(const Context& context, const Options& options)
{
  const auto [width, height] = parseSize(options.size);
  if (options.stereo != "none")
    notBuiltYet("--stereo " + options.stereo);
  if (options.engine != "gpu" && options.engine != "reference")
    throw UsageError("--engine: gpu or reference, not '" + options.engine + "'");
  const library::Library library = context.openLibrary();
  scene::Case value = library.open(options.caseName);
  const core::CameraPose camera = chooseCamera(options, value);
  library.loadDissection(value);
  const core::Progress progress = context.progress();

  nlohmann::json result{{"case", value.name},
                        {"size", {width, height}},
                        {"engine", options.engine},
                        {"out", options.out}};
  std::map<std::string, std::size_t> resources;
  const rendering::SceneContents contents = presenters::sceneContents(value);
  if (options.engine == "gpu")
  {
    rendering::ScenePicture picture;
    picture.setContents(contents);
    picture.setCamera(camera);
    rendering::OffscreenView view(width, height);
    rendering::writePng(options.out, view.render(picture));
    resources = picture.resources();
    result["milliseconds"] = view.milliseconds();
    result["first_frame_milliseconds"] = view.firstFrameMilliseconds();
    result["gl_renderer"] = view.glRenderer();
  }
  if (options.engine == "reference" || !options.depth.empty())
  {
    const rendering::ReferenceRayCaster caster(contents);
    const auto start = std::chrono::steady_clock::now();
    const auto truth = caster.render(camera, width, height, progress);
    const std::chrono::duration<double, std::milli> elapsed =
        std::chrono::steady_clock::now() - start;
    if (options.engine == "reference")
    {
      rendering::writePng(options.out, truth.picture);
      result["milliseconds"] = result["first_frame_milliseconds"] = elapsed.count();
      result["gl_renderer"] = nullptr;
    }
    if (!options.depth.empty())
      rendering::writeNpy(options.depth, truth.depth);
  }
  for (const auto& [name, bytes] : residentResources(value))
    resources.emplace(name, bytes);
  result["resources"] = resources;
  context.say(options.out + ": " + options.size + ", " +
              fixed(result["milliseconds"].get<double>(), 0) + " ms");
  context.give(result);
}

} // namespace

void addRenderCommand(CLI::App& app, Context& context)
{
  auto options = std::make_shared<Options>();
  CLI::App* command = context.addCommand(app, "render", "Draw a case into a PNG, without a display",
                                         [options, &context] { render(context, *options); });
  command->add_option("CASE", options->caseName)->required();
  command->add_option("--out", options->out, "Picture to write")->type_name("F.png")->required();
  command->add_option("--size", options->size, "Pixels (800x600)")->type_name("WxH");
  command->add_option("--view", options->view,
                      "lateral, left, right, superior, inferior, anterior or posterior");
  command->add_option("--camera", options->camera, "Camera in patient LPS mm")->type_name("F.json");
  command->add_option("--engine", options->engine,
                      "gpu, or reference: double precision on the CPU, slow (gpu)");
  command->add_option("--depth", options->depth, "Also write the distance to the first surface, mm")
      ->type_name("F.npy");
  // In the contract, not built yet: refused when asked for, not offered.
  command->add_option("--stereo", options->stereo)->group("");
}

} // namespace petrous::cli
