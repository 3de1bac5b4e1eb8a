#include <array>
#include <chrono>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

#include <Eigen/Geometry>
#include <nlohmann/json.hpp>

#include "CaseJson.h"
#include "CaseWarnings.h"
#include "Commands.h"
#include "Context.h"
#include "Numbers.h"
#include "ViewOptions.h"
#include "petrous/Core/CameraPose.h"
#include "petrous/Core/InputFile.h"
#include "petrous/Presenters/BoneThickness.h"
#include "petrous/Presenters/CasePicture.h"
#include "petrous/Presenters/LeavingImages.h"
#include "petrous/Presenters/ProvenanceText.h"
#include "petrous/Presenters/SceneAssembly.h"
#include "petrous/Rendering/OffscreenView.h"
#include "petrous/Rendering/PictureText.h"
#include "petrous/Rendering/ReferenceRayCaster.h"
#include "petrous/Rendering/RenderingError.h"
#include "petrous/Rendering/SceneContents.h"
#include "petrous/Rendering/Stereo.h"
#include "petrous/Rendering/ThicknessColor.h"
#include "petrous/Rendering/ThicknessLegend.h"
#include "petrous/Scene/Case.h"

namespace petrous::cli
{

namespace
{

using rendering::StereoMode;

/// The options of `petrous render`.
struct RenderOptions
{
  std::string caseName, out, size = "800x600", view, camera, stereo, engine = "gpu", depth;
  std::string thickness;
  std::string crop, roi;
  std::vector<std::string> clip;
  std::optional<double> eyeSeparation, convergence;
  std::optional<double> falloff, wetness;
  bool plain = false;
  bool isSavedRig = false; ///< the eyes are as the case was saved with
  bool withoutDamaged = false, maskFace = false;
};

/// Size, camera and stereo mode of a picture.
struct Shot
{
  int width = 0;
  int height = 0;
  core::CameraPose camera;
  rendering::StereoMode stereo = rendering::StereoMode::None;
  std::vector<core::CameraPose> eyes; ///< one, or left and right
};

// Everything that needs no case. Throws UsageError for invalid values.
Shot parseShot(const RenderOptions& options)
{
  Shot shot;
  std::tie(shot.width, shot.height) = parseSize(options.size);
  if (options.stereo == "none" && (options.eyeSeparation || options.convergence))
    throw UsageError("--eye-separation and --convergence need --stereo");
  parsePlanes(options.clip);
  if (!options.crop.empty() && !options.roi.empty())
    throw UsageError("render: give --crop or --roi, not both");
  return shot;
}

// What of the case's view is not given by options.
void takeView(RenderOptions& options, Shot& shot, const scene::ViewState& saved)
{
  const scene::ViewState view = options.plain ? scene::ViewState() : saved;
  const bool hasStereo = !options.stereo.empty();
  if (!hasStereo)
    options.stereo = "none";
  if (view.stereo)
  {
    if (!hasStereo && view.stereo->mode != "quad-buffer") // of screens alone
      options.stereo = view.stereo->mode;
    if (options.stereo != "none" && !options.eyeSeparation && !options.convergence)
    {
      options.isSavedRig = true;
      options.eyeSeparation = view.stereo->eyeSeparation;
      options.convergence = view.stereo->convergence;
    }
  }
  if (options.stereo == "none" && (options.eyeSeparation || options.convergence))
    throw UsageError("--eye-separation and --convergence need --stereo");
  if (view.light && !options.falloff)
    options.falloff = view.light->falloff;
  if (view.light && !options.wetness)
    options.wetness = view.light->wetness;
  shot.stereo = *rendering::parseStereoMode(options.stereo);
  if (shot.stereo == rendering::StereoMode::SideBySide && shot.width % 2 != 0)
    throw UsageError("--size: side by side needs an even width, not " + std::to_string(shot.width));
}

// The case's scene, with the options' lamp, planes and box; without those, the case's.
rendering::SceneContents renderContents(const RenderOptions& options, const scene::Case& value)
{
  presenters::SceneAssembly assembly;
  assembly.showThickness(options.thickness);
  rendering::SceneContents contents = assembly.contents(value);
  contents.light.falloff = options.falloff.value_or(0.0);
  contents.light.wetness = options.wetness.value_or(0.0);
  scene::ViewState::Clipping clipping;
  if (!options.plain)
    clipping = value.view.clipping;
  if (!options.clip.empty() || !options.crop.empty() || !options.roi.empty())
    clipping = {parsePlanes(options.clip), parseCrop(options.crop, options.roi, value.ct.geometry)};
  presenters::clip(contents, clipping, value.ct.geometry);
  return contents;
}

void addRenderOptions(CLI::App& command, RenderOptions& options)
{
  command.add_option("CASE", options.caseName)->required();
  command.add_option("--out", options.out, "Picture to write")
      ->type_name("F.png")
      ->check(endsIn(".png"))
      ->required();
  command.add_option("--size", options.size, "Pixels (800x600)")->type_name("WxH");
  command
      .add_option("--view", options.view,
                  "lateral, left, right, superior, inferior, anterior or posterior")
      ->check(oneOf({"lateral", "left", "right", "superior", "inferior", "anterior", "posterior",
                     "surgical-left", "surgical-right"}));
  command.add_option("--camera", options.camera, "Camera file, patient LPS mm")
      ->type_name("F.json");
  command
      .add_option("--stereo", options.stereo,
                  "none, side-by-side, interleaved or anaglyph (as saved)")
      ->check(oneOf({"none", "side-by-side", "interleaved", "anaglyph"}));
  command
      .add_option("--eye-separation", options.eyeSeparation,
                  "Distance between the eyes (5.5 degrees at the convergence point)")
      ->type_name("MM")
      ->check(within({0.0, rendering::StereoRig::kLargestSeparation, "mm"}));
  command
      .add_option("--convergence", options.convergence,
                  "Distance from the camera to the convergence point (the focal point)")
      ->type_name("MM")
      ->check(within({rendering::StereoRig::kNearestConvergence,
                      rendering::StereoRig::kFarthestConvergence, "mm"}));
  command
      .add_option("--light-falloff", options.falloff,
                  "Distance at which the light has half its intensity; 0: no falloff (as saved)")
      ->type_name("MM")
      ->check(within({0.0, 10000.0, "mm"}));
  command
      .add_option("--wetness", options.wetness,
                  "Specular gloss of a wet surface, 0 to 1 (as saved)")
      ->check(within({0.0, 1.0}));
  command
      .add_option("--thickness", options.thickness,
                  "Colour bone by its thickness over a structure, 0 to 5 mm")
      ->type_name("STRUCTURE");
  command
      .add_option(
          "--clip", options.clip,
          "Clipping plane through a point, patient LPS mm; the normal points to the side that "
          "is kept (up to 6 times); instead of what the case was saved with, as the next two")
      ->allow_extra_args(false)
      ->type_name("x,y,z,nx,ny,nz");
  command.add_flag("--mask-face", options.maskFace, "Draw images with air in place of the face");
  command.add_option("--crop", options.crop, "Crop to these voxels of the CT, first and last")
      ->type_name("i0,i1,j0,j1,k0,k1");
  command.add_option("--roi", options.roi, "Crop to this box, patient LPS mm")
      ->type_name("x0,x1,y0,y1,z0,z1");
  command.add_flag("--plain", options.plain,
                   "Without the light, stereo, clipping planes and box that the case was saved "
                   "with");
  command
      .add_option("--engine", options.engine,
                  "gpu, or reference: double precision on the CPU, slow (gpu)")
      ->check(oneOf({"gpu", "reference"}));
  command.add_option("--depth", options.depth, "Also write the distance to the first surface, mm")
      ->type_name("F.npy")
      ->check(endsIn(".npy"));
  addWithoutDamaged(command, options.withoutDamaged);
}

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
                   {"filter_bits", statistics.filterBits},
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
    throw rendering::RenderingError(error.reason,
                                    std::string(error.what()) +
                                        "; '--engine reference' renders on the CPU, slowly");
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
  if (options.isSavedRig) // the window fits it to each camera
    return rendering::fittedStereoGeometry(camera, {options.eyeSeparation, options.convergence});
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

void render(const Context& context, RenderOptions options)
{
  Shot shot = parseShot(options);
  context.refuseOverwriting({options.out, options.depth}, {options.camera});
  const library::Library library = context.openLibrary();
  scene::Case value = library.open(options.caseName);
  takeView(options, shot, value.view);
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
  if (options.maskFace)
  {
    scene::ImageMask mask;
    mask.face = true;
    for (const std::string& note :
         presenters::maskLeavingImages(library, value, mask, context.progress()))
      context.warn(note);
  }

  Result result = draw(context, options, shot, renderContents(options, value));
  if (!options.thickness.empty())
    rendering::drawThicknessLegend(result.picture, options.thickness,
                                   presenters::kFarthestThickness);
  constexpr int kMargin = 8; // pixels
  constexpr int kLine = 14;
  double row = kMargin;
  for (const std::string& line : presenters::interpolatedTexts(value))
  {
    rendering::writeText(result.picture, line, {double(kMargin), row, 0.0, 0.0}, kLine,
                         {255, 140, 43});
    row += 1.5 * kLine;
    context.warn(line + "; small structures may be absent there");
  }
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
  CLI::App* command =
      context.addCommand(app, "render", "Render a case to a PNG file; needs no display",
                         [options, &context] { render(context, *options); });
  addRenderOptions(*command, *options);
}

} // namespace petrous::cli
