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
#include "petrous/Appearance/OwnPresets.h"
#include "petrous/Core/CameraPose.h"
#include "petrous/Core/InputFile.h"
#include "petrous/Core/OutputFile.h"
#include "petrous/Presenters/AppearanceEditor.h"
#include "petrous/Presenters/Background.h"
#include "petrous/Presenters/BoneThickness.h"
#include "petrous/Presenters/CameraPaths.h"
#include "petrous/Presenters/CasePicture.h"
#include "petrous/Presenters/FilmFile.h"
#include "petrous/Presenters/LabelledPicture.h"
#include "petrous/Presenters/LeavingImages.h"
#include "petrous/Presenters/ProvenanceText.h"
#include "petrous/Presenters/SceneAssembly.h"
#include "petrous/Rendering/OffscreenView.h"
#include "petrous/Rendering/PixelSamples.h"
#include "petrous/Rendering/PrintPicture.h"
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
  LightOptions light;
  scene::ViewState::Light savedLight;
  rendering::BackgroundColor background = rendering::kDefaultBackground;
  std::string softTissue; ///< a preset, "true" or "false"; empty: as saved
  std::optional<double> widthMillimetres, dotsPerInch;
  std::string along;
  int turntable = 0, frames = 0; ///< 0: not given
  int samples = 1;
  double framesPerSecond = 25.0;
  bool plain = false;
  bool isSavedRig = false; ///< the eyes are as the case was saved with
  bool withoutDamaged = false, maskFace = false;

  bool isPrint() const { return widthMillimetres || dotsPerInch; }
  bool isFilm() const { return turntable > 0 || !along.empty(); }
};

/// Size, camera and stereo mode of a picture.
struct Shot
{
  int width = 0;
  int height = 0;
  core::CameraPose camera;
  rendering::StereoMode stereo = rendering::StereoMode::None;
  std::vector<core::CameraPose> eyes; ///< one, or left and right
  int samples = 1;                    ///< rays a pixel
};

// What does not go together with pictures for print and with films.
void checkKind(const RenderOptions& options)
{
  if (options.isPrint() && options.isFilm())
    throw UsageError("render: --width-mm and --dpi are for one picture, not for a film");
  if (options.turntable > 0 && !options.along.empty())
    throw UsageError("render: give --turntable or --along, not both");
  if (options.frames > 0 && options.along.empty())
    throw UsageError("--frames goes with --along; of a turntable give --turntable N");
  if (!options.isFilm() && presenters::isVideo(options.out))
    throw UsageError("--out: a video goes with --turntable or --along, not one picture");
  if (options.samples > 1 && (options.isFilm() || options.engine != "gpu"))
    throw UsageError("--samples is for one picture of the engine gpu");
  if (!options.isPrint() && !options.isFilm())
    return;
  const char* what = options.isFilm() ? "a film" : "a picture for print";
  if (options.engine != "gpu" || !options.depth.empty() ||
      (!options.stereo.empty() && options.stereo != "none"))
    throw UsageError(std::string("render: ") + what +
                     " takes no --engine reference, --depth or --stereo");
}

// Everything that needs no case. Throws UsageError for invalid values.
Shot parseShot(const RenderOptions& options)
{
  Shot shot;
  std::tie(shot.width, shot.height) = parseSize(options.size);
  checkKind(options);
  shot.samples = options.samples;
  if (options.widthMillimetres)
  {
    rendering::PrintSize size;
    size.widthMillimetres = *options.widthMillimetres;
    size.dotsPerInch = options.dotsPerInch.value_or(size.dotsPerInch);
    size.heightToWidth = static_cast<double>(shot.height) / shot.width;
    size.validate();
    shot.width = size.width();
    shot.height = size.height();
  }
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
  options.savedLight = view.light.value_or(options.savedLight);
  if (options.isPrint() || options.isFilm())
    options.stereo = "none";
  shot.stereo = *rendering::parseStereoMode(options.stereo);
  if (shot.stereo == rendering::StereoMode::SideBySide && shot.width % 2 != 0)
    throw UsageError("--size: side by side needs an even width, not " + std::to_string(shot.width));
}

// The options' planes and box; without those, the case's.
scene::ViewState::Clipping clippingOf(const RenderOptions& options, const scene::Case& value)
{
  if (!options.clip.empty() || !options.crop.empty() || !options.roi.empty())
    return {parsePlanes(options.clip), parseCrop(options.crop, options.roi, value.ct.geometry)};
  return options.plain ? scene::ViewState::Clipping() : value.view.clipping;
}

// Soft tissue as the option has it, in place of the case's.
void takeSoftTissue(const RenderOptions& options, const library::Library& library,
                    scene::Case& value)
{
  if (options.softTissue.empty())
    return;
  if (options.softTissue != "true" && options.softTissue != "false")
    value.softTissue = presenters::withPreset(
        value, scene::kSoftTissue,
        presenters::presetFor(value, scene::kSoftTissue, appearance::OwnPresets(library.folder()),
                              options.softTissue));
  value.softTissue.shown = options.softTissue != "false";
}

// The case's scene, with the options' lamp.
rendering::SceneContents renderContents(const RenderOptions& options, const scene::Case& value)
{
  presenters::SceneAssembly assembly;
  assembly.showThickness(options.thickness);
  rendering::SceneContents contents = assembly.contents(value);
  presenters::illuminate(contents, options.light.over(options.savedLight));
  presenters::clip(contents, value.view.clipping, value.ct.geometry);
  contents.background = options.background;
  return contents;
}

void addRenderOptions(CLI::App& command, RenderOptions& options)
{
  command.add_option("CASE", options.caseName)->required();
  command.add_option("--out", options.out, "Picture to write")
      ->type_name("F.png")
      ->check(endsIn({".png", ".mp4"}))
      ->required();
  command
      .add_option("--width-mm", options.widthMillimetres,
                  "Width on paper, in place of --size, which gives the shape; with scale bar and "
                  "side")
      ->type_name("MM")
      ->check(within({1.0, 5000.0, "mm"}));
  command
      .add_option("--dpi", options.dotsPerInch,
                  "Dots per inch on paper, which the file states; with scale bar and side (300)")
      ->type_name("N")
      ->check(within({10.0, 2400.0}));
  command
      .add_option("--turntable", options.turntable,
                  "A film of N frames once around the patient: F-0001.png, ..., or a video F.mp4, "
                  "which needs ffmpeg")
      ->type_name("N")
      ->transform(wholeNumber(2, presenters::kMaxFrames));
  command
      .add_option("--along", options.along,
                  "A film of a flight along the centre line of a canal or nerve, which is not "
                  "drawn")
      ->type_name("STRUCTURE");
  command.add_option("--frames", options.frames, "Frames of the flight (250)")
      ->type_name("N")
      ->transform(wholeNumber(2, presenters::kMaxFrames));
  command.add_option("--fps", options.framesPerSecond, "Frames per second of a video (25)")
      ->type_name("N")
      ->check(within({1.0, 120.0}));
  command.add_option("--size", options.size, "Pixels (800x600)")->type_name("WxH");
  command
      .add_option("--samples", options.samples,
                  "Rays a pixel, 1 to 16: more smooth the edges and take as much longer (1)")
      ->type_name("N")
      ->transform(wholeNumber(1, rendering::kPixelSamples));
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
  addLightOptions(command, options.light, " (as saved)");
  addBackgroundOption(command, options.background);
  command.add_flag("--soft-tissue,!--no-soft-tissue", options.softTissue,
                   "Draw what is neither bone nor a structure (as saved); --soft-tissue=PRESET: by "
                   "this preset (soft-tissue, skin; others are made for structures)");
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
      ->check(endsIn({".npy"}));
  addWithoutDamaged(command, options.withoutDamaged);
}

std::size_t framesOf(const RenderOptions& options)
{
  constexpr int kOfFlight = 250;
  const int frames = options.turntable > 0 ? options.turntable
                     : options.frames > 0  ? options.frames
                                           : kOfFlight;
  return static_cast<std::size_t>(frames);
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

constexpr int kTile = 1024; // pixels

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
                 bool wantReport, const core::Progress& progress)
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
  if (shot.samples > 1) // in a window of their own; the scene comes back with the next frame
  {
    rendering::ScenePicture smooth;
    smooth.setContents(contents);
    for (std::size_t n = 0; n < shot.eyes.size(); ++n)
      pictures[n] = rendering::renderTiled(smooth, shot.eyes[n], width, height, progress, kTile,
                                           shot.samples);
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

void warnIfBuried(const Context& context, const Shot& shot,
                  const rendering::SceneContents& contents)
{
  if (presenters::isBuried(shot.camera, contents))
    context.warn(
        "the camera is inside tissue, so only the colour of that is seen: move it back, or "
        "cut the tissue away");
}

Result draw(const Context& context, const RenderOptions& options, const Shot& shot,
            const rendering::SceneContents& contents)
{
  warnIfBuried(context, shot, contents);
  const bool wantDepth = !options.depth.empty();
  if (options.engine == "reference")
    return drawReference(contents, shot, wantDepth, context.progress());
  try
  {
    return drawOnGpu(contents, shot, wantDepth, context.json(), context.progress());
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

// In tiles, with scale bar and side.
Result drawForPrint(const Context& context, const RenderOptions& options, const Shot& shot,
                    const scene::Case& value)
{
  Result result;
  rendering::ScenePicture picture;
  const rendering::SceneContents contents = renderContents(options, value);
  warnIfBuried(context, shot, contents);
  picture.setContents(contents);
  const auto start = std::chrono::steady_clock::now();
  result.picture = rendering::renderTiled(picture, shot.camera, shot.width, shot.height,
                                          context.progress(), kTile, shot.samples);
  const double elapsed =
      std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
  const double magnified = std::max(shot.height / 600.0, 1.0);
  const presenters::Backdrop backdrop = presenters::backdropOf(options.background);
  presenters::addLines(result.picture, presenters::pictureLines(value), magnified, backdrop);
  presenters::addEdgeLetters(result.picture, shot.camera, magnified, backdrop);
  presenters::addScaleBar(result.picture, rendering::millimetresPerPixel(shot.camera, shot.height),
                          shot.camera.parallelScale ? "" : "in the focal plane", magnified,
                          backdrop);
  const rendering::RenderStatistics statistics = picture.statistics();
  result.resources = picture.resources();
  result.report = {{"milliseconds", elapsed},      {"first_frame_milliseconds", elapsed},
                   {"gl_renderer", nullptr},       {"variant", statistics.variant},
                   {"fetches_per_pixel", nullptr}, {"samples_per_pixel", nullptr},
                   {"notes", statistics.notes}};
  return result;
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

std::vector<std::string> outputsOf(const RenderOptions& options)
{
  if (!options.isFilm())
    return {options.out, options.depth};
  std::vector<std::string> files;
  for (const auto& file : presenters::filmFiles(options.out, framesOf(options)))
    files.push_back(file.string());
  return files;
}

void warnInterpolated(const Context& context, const scene::Case& value)
{
  for (const std::string& line : presenters::interpolatedTexts(value))
    context.warn(line + "; small structures may be absent there");
}

nlohmann::json flightJson(const RenderOptions& options, const presenters::Flight& flight)
{
  if (options.along.empty())
    return nullptr;
  return {{"along", options.along},
          {"length_mm", flight.length},
          {"flown_mm", flight.flown},
          {"hidden", flight.hidden},
          {"soft_tissue_hidden", flight.softTissueHidden}};
}

void writeFilm(const Context& context, const RenderOptions& options, const Shot& shot,
               scene::Case value, const presenters::LeftOut& leftOut)
{
  constexpr double kLine = 0.05; // of the work, to find the centre line
  const core::Progress progress = context.progress();
  const int frames = static_cast<int>(framesOf(options));
  presenters::Flight flight;
  if (options.along.empty())
    flight.cameras = presenters::turntable(shot.camera, frames);
  else
    flight = presenters::flightAlong(value, options.along, frames, progress.part(0.0, kLine));
  presenters::FilmOptions film;
  film.width = shot.width;
  film.height = shot.height;
  film.framesPerSecond = options.framesPerSecond;
  film.lines = presenters::pictureLines(value);
  film.thickness = options.thickness;
  const rendering::SceneContents contents = renderContents(options, value);
  context.refuseDamaged(); // the images are read
  const std::size_t removed =
      presenters::writeFilm(options.out, contents, flight.cameras, film, progress.part(kLine, 1.0));
  warnInterpolated(context, value);
  for (const std::string& name : flight.hidden)
    context.warn("'" + core::printable(name) + "' is not drawn: it lies in the way");
  if (flight.softTissueHidden)
    context.warn("soft tissue is not drawn: it lies in the way");
  if (removed > 0)
    context.warn(std::to_string(removed) +
                 " frames of an earlier, longer film of this name were removed");
  const auto beyond = presenters::framesBeyond(options.out, static_cast<std::size_t>(frames));
  if (!beyond.empty())
    context.warn(
        core::printable(beyond.front()) +
        (beyond.size() == 1 ? "" : " and " + std::to_string(beyond.size() - 1) + " behind it") +
        ": not known to be of an earlier film, so it stays; a player may take it for a "
        "frame of this one");
  nlohmann::json path = nlohmann::json::array();
  for (const core::CameraPose& camera : flight.cameras)
    path.push_back(cameraJson(camera));
  context.print(options.out + ": " + std::to_string(frames) + " frames, " +
                std::to_string(shot.width) + "x" + std::to_string(shot.height));
  context.printJson({{"case", value.name},
                     {"size", {shot.width, shot.height}},
                     {"frames", frames},
                     {"cameras", std::move(path)},
                     {"flight", flightJson(options, flight)},
                     {"files", outputsOf(options)},
                     {"removed_frames", removed},
                     {"frames_beyond", beyond.size()},
                     {"thickness", thicknessJson(options)},
                     {"left_out", leftOutJson(value, leftOut)},
                     {"out", options.out}});
}

void render(const Context& context, RenderOptions options)
{
  Shot shot = parseShot(options);
  const std::vector<std::string> outputs = outputsOf(options);
  context.refuseOverwriting(outputs.size() > 2 ? std::vector{outputs.front(), outputs.back()}
                                               : outputs, // of a film's files the names differ
                            {options.camera});
  if (const std::string refusal =
          presenters::isVideo(options.out) ? presenters::videoRefusal() : std::string();
      !refusal.empty())
    throw core::InvalidParameter(options.out + ": " + refusal);
  const library::Library library = context.openLibrary();
  scene::Case value = library.open(options.caseName);
  takeView(options, shot, value.view);
  shot.camera = chooseCamera(options, value);
  takeSoftTissue(options, library, value);
  value.view.clipping = clippingOf(options, value); // what is drawn is what the picture says
  if (!options.view.empty())
    warnOfView(context, value, options.view);
  else if (options.camera.empty() && options.along.empty()) // a flight has cameras of its own
    warnOfCurrentView(context, value);
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
  warnOutdated(context, value);
  if (value.softTissue.shown)
    warnOfSoftTissue(context, value);
  warnOfMrs(context, value);
  if (options.maskFace)
  {
    scene::ImageMask mask;
    mask.face = true;
    for (const std::string& note :
         presenters::maskLeavingImages(library, value, mask, context.progress()))
      context.warn(note);
  }

  if (options.isFilm())
    return writeFilm(context, options, shot, std::move(value), leftOut);
  Result result = options.isPrint() ? drawForPrint(context, options, shot, value)
                                    : draw(context, options, shot, renderContents(options, value));
  if (!options.thickness.empty())
    rendering::drawThicknessLegend(result.picture, options.thickness,
                                   presenters::kFarthestThickness);
  if (!options.isPrint()) // that has them beneath the side
    presenters::addLines(result.picture, presenters::pictureNotes(value), 1.0,
                         presenters::backdropOf(options.background));
  warnInterpolated(context, value);
  context.refuseDamaged();
  if (options.isPrint())
  {
    const auto png = rendering::pngOf(result.picture, options.dotsPerInch.value_or(300.0));
    core::writeFile(options.out, {reinterpret_cast<const char*>(png.data()), png.size()});
  }
  else
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
                        {"samples", shot.samples},
                        {"camera", cameraJson(shot.camera)},
                        {"stereo", std::move(stereo)},
                        {"background", presenters::backgroundText(options.background)},
                        {"thickness", thicknessJson(options)},
                        {"out", options.out},
                        {"left_out", leftOutJson(value, leftOut)},
                        {"mr", presenters::drawnMrs(value)},
                        {"resources", result.resources}});
  if (!options.thickness.empty())
    context.print("bone is coloured by its thickness over '" + options.thickness +
                  "': blue 0 mm, red 2.5 mm, yellow 5 mm, thicker in its own colour");
  if (options.isPrint())
    result.report["print"] = {
        {"dpi", options.dotsPerInch.value_or(300.0)},
        {"width_mm", shot.width * 25.4 / options.dotsPerInch.value_or(300.0)},
        {"mm_per_pixel", rendering::millimetresPerPixel(shot.camera, shot.height)}};
  context.print(options.out + ": " + std::to_string(shot.width) + "x" +
                std::to_string(shot.height) + ", " +
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
