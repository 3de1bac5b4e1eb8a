#include <chrono>
#include <cmath>
#include <limits>

#include "CameraFile.h"
#include "CaseJson.h"
#include "CaseWarnings.h"
#include "Commands.h"
#include "Numbers.h"
#include "RenderOptions.h"
#include "petrous/Presenters/BoneThickness.h"
#include "petrous/Presenters/CasePicture.h"
#include "petrous/Rendering/OffscreenView.h"
#include "petrous/Rendering/ReferenceRayCaster.h"
#include "petrous/Rendering/RenderingError.h"
#include "petrous/Rendering/ThicknessColor.h"
#include "petrous/Rendering/ThicknessLegend.h"

namespace petrous::cli
{

namespace
{

using rendering::StereoMode;

// Output of a rendering.
struct Result
{
  rendering::Picture picture;
  std::optional<rendering::DepthImage> depth; // from the central camera
  std::map<std::string, std::size_t> resources;
  nlohmann::json report;
};

core::CameraPose chooseCamera(const RenderOptions& options, const scene::Case& value)
{
  if (!options.view.empty() && !options.camera.empty())
    throw UsageError("render: give --view or --camera, not both");
  if (!options.camera.empty())
    return readCamera(options.camera);
  if (options.view.empty())
    return presenters::currentCamera(value);
  return presenters::standardCamera(value, *rendering::parseView(options.view));
}

rendering::Picture together(std::vector<rendering::Picture> pictures, StereoMode mode)
{
  return pictures.size() == 1 ? std::move(pictures.front())
                              : rendering::composeStereo(pictures[0], pictures[1], mode);
}

// No CT in the scene: no ray was cast.
rendering::DepthImage depthOf(const rendering::ScenePicture& picture, const Shot& shot)
{
  rendering::DepthImage depth = picture.depth();
  if (depth.width == shot.width && depth.height == shot.height)
    return depth;
  const std::size_t pixels =
      static_cast<std::size_t>(shot.width) * static_cast<std::size_t>(shot.height);
  return {shot.width, shot.height,
          std::vector<float>(pixels, std::numeric_limits<float>::quiet_NaN())};
}

Result drawOnGpu(const rendering::SceneContents& contents, const Shot& shot, bool wantDepth,
                 bool wantReport)
{
  Result result;
  const auto [width, height] = rendering::eyeSize(shot.stereo, shot.width, shot.height);
  rendering::ScenePicture picture;
  picture.setContents(contents);
  rendering::OffscreenView view(width, height);
  std::vector<rendering::Picture> pictures;
  double first = 0.0;
  double steady = 0.0;
  for (const core::CameraPose& eye : shot.eyes)
  {
    picture.setCamera(eye);
    pictures.push_back(view.render(picture));
    first += view.milliseconds();
  }
  result.picture = together(std::move(pictures), shot.stereo);
  if (wantReport)
  {
    for (const core::CameraPose& eye : shot.eyes)
    {
      picture.setCamera(eye);
      view.render(picture);
      steady += view.milliseconds();
    }
    picture.setCounting(true);
    view.render(picture);
    picture.setCounting(false);
  }
  result.resources = picture.resources();
  const rendering::RenderStatistics statistics = picture.statistics();
  result.report = {{"milliseconds", wantReport ? steady : first},
                   {"first_frame_milliseconds", first},
                   {"gl_renderer", view.glRenderer()},
                   {"variant", statistics.variant},
                   {"fetches_per_pixel", statistics.fetchesPerPixel},
                   {"samples_per_pixel", statistics.samplesPerPixel},
                   {"notes", statistics.notes}};
  if (wantDepth && shot.stereo == StereoMode::None)
  {
    if (wantReport)
      view.render(picture);
    result.depth = depthOf(picture, shot);
  }
  else if (wantDepth)
  {
    rendering::OffscreenView middle(shot.width, shot.height);
    picture.setCamera(shot.camera);
    middle.render(picture);
    result.depth = depthOf(picture, shot);
  }
  return result;
}

Result drawReference(const rendering::SceneContents& contents, const Shot& shot, bool wantDepth,
                     const core::Progress& progress)
{
  Result result;
  const auto [width, height] = rendering::eyeSize(shot.stereo, shot.width, shot.height);
  const rendering::ReferenceRayCaster caster(contents);
  const auto start = std::chrono::steady_clock::now();
  std::vector<rendering::Picture> pictures;
  for (const core::CameraPose& eye : shot.eyes)
  {
    rendering::ReferencePicture drawn = caster.render(eye, width, height, progress);
    pictures.push_back(std::move(drawn.picture));
    if (wantDepth && shot.stereo == StereoMode::None)
      result.depth = std::move(drawn.depth);
  }
  const double elapsed =
      std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
  result.picture = together(std::move(pictures), shot.stereo);
  if (wantDepth && !result.depth)
    result.depth = caster.render(shot.camera, shot.width, shot.height, progress).depth;
  result.report = {{"milliseconds", elapsed},         {"first_frame_milliseconds", elapsed},
                   {"gl_renderer", nullptr},          {"variant", nlohmann::json::array()},
                   {"fetches_per_pixel", nullptr},    {"samples_per_pixel", nullptr},
                   {"notes", nlohmann::json::array()}};
  return result;
}

Result draw(const Context& context, const RenderOptions& options, const Shot& shot,
            const rendering::SceneContents& contents)
{
  const bool wantDepth = !options.depth.empty();
  if (options.engine == "reference")
    return drawReference(contents, shot, wantDepth, context.progress());
  try
  {
    return drawOnGpu(contents, shot, wantDepth, context.json());
  }
  catch (const rendering::RenderingError& error)
  {
    if (error.reason != rendering::RenderingError::Reason::NoOpenGL)
      throw;
    throw rendering::RenderingError(
        error.reason,
        std::string(error.what()) + "; '--engine reference' draws on the processor alone, slowly");
  }
}

// The colour scale, for the picture's reader.
nlohmann::json thicknessJson(const RenderOptions& options)
{
  if (options.thickness.empty())
    return nullptr;
  return {{"structure", options.thickness},
          {"farthest_mm", presenters::kFarthestThickness},
          {"colors", rendering::kThicknessColors}};
}

// The options can also be at odds with each other or with the camera.
rendering::StereoGeometry stereoOf(const RenderOptions& options, const core::CameraPose& camera)
{
  try
  {
    return rendering::stereoGeometry(camera, {options.eyeSeparation, options.convergence});
  }
  catch (const core::InvalidParameter& error)
  {
    if (options.eyeSeparation || options.convergence)
      throw UsageError(error.what());
    throw;
  }
}

void render(const Context& context, const RenderOptions& options)
{
  Shot shot = parseShot(options);
  const library::Library library = context.openLibrary();
  scene::Case value = library.open(options.caseName);
  shot.camera = chooseCamera(options, value);
  nlohmann::json stereo = nullptr;
  shot.eyes = {shot.camera};
  if (shot.stereo != StereoMode::None)
  {
    const auto geometry = stereoOf(options, shot.camera);
    const rendering::EyePair eyes = rendering::eyesOf(shot.camera, geometry);
    shot.eyes = {eyes.left, eyes.right};
    stereo = {{"mode", options.stereo},
              {"eye_separation_mm", geometry.eyeSeparation},
              {"convergence_mm", geometry.convergence}};
  }
  library.loadDissection(value);
  const presenters::LeftOut leftOut =
      leaveOutDamaged(context, library, value, options.withoutDamaged);
  warnMissingPlaces(context, value);

  Result result = draw(context, options, shot, renderContents(options, value));
  if (!options.thickness.empty())
    rendering::drawThicknessLegend(result.picture, options.thickness,
                                   presenters::kFarthestThickness);
  context.refuseDamaged();
  rendering::writePng(options.out, result.picture);
  if (result.depth)
    rendering::writeNpy(options.depth, *result.depth);
  for (const auto& note : result.report.at("notes"))
    context.warn(note.get<std::string>());
  for (const auto& [name, bytes] : residentResources(value))
    result.resources.emplace(name, bytes);
  result.report.update({{"case", value.name},
                        {"size", {shot.width, shot.height}},
                        {"engine", options.engine},
                        {"camera", cameraJson(shot.camera)},
                        {"stereo", std::move(stereo)},
                        {"thickness", thicknessJson(options)},
                        {"out", options.out},
                        {"left_out", leftOutJson(value, leftOut)},
                        {"resources", result.resources}});
  if (!options.thickness.empty())
    context.print("bone is coloured by its thickness over '" + options.thickness +
                  "': blue 0 mm, red 2.5 mm, yellow 5 mm, thicker in its own colour");
  context.print(options.out + ": " + options.size + ", " +
                fixed(result.report["milliseconds"].get<double>(), 0) + " ms");
  context.printJson(result.report);
}

} // namespace

void addRenderCommand(CLI::App& app, Context& context)
{
  auto options = std::make_shared<RenderOptions>();
  CLI::App* command = context.addCommand(app, "render", "Draw a case into a PNG, without a display",
                                         [options, &context] { render(context, *options); });
  addRenderOptions(*command, *options);
}

} // namespace petrous::cli
