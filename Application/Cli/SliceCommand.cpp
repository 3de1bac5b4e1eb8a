#include <algorithm>
#include <chrono>
#include <cmath>
#include <string>
#include <tuple>
#include <vector>

#include "CaseJson.h"
#include "CaseWarnings.h"
#include "Commands.h"
#include "Context.h"
#include "Numbers.h"
#include "PartNamed.h"
#include "petrous/Core/NumberText.h"
#include "petrous/Presenters/CaseRegistration.h"
#include "petrous/Presenters/IntensityDisplay.h"
#include "petrous/Presenters/LabelledPicture.h"
#include "petrous/Presenters/ProvenanceText.h"
#include "petrous/Presenters/SlicePlanes.h"
#include "petrous/Presenters/SlicePresenter.h"
#include "petrous/Rendering/Picture.h"
#include "petrous/Scene/ApplyRegistration.h"
#include "petrous/Scene/Case.h"

namespace petrous::cli
{

namespace
{

using presenters::OverlayMode;
using presenters::SliceGeometry;
using presenters::SliceOrientation;

/// A patient point given on the command line.
struct Place
{
  Eigen::Vector3d point; ///< patient LPS mm
  std::string words;     ///< the structure's name; empty for coordinates
};

bool isPart(const scene::Case& value, const std::string& name)
{
  return scene::findStructure(value, name) ||
         std::any_of(value.meshes.begin(), value.meshes.end(),
                     [&name](const scene::MeshPart& mesh) { return mesh.name == name; });
}

// "x,y,z" in patient LPS mm, or the name of a structure or a mesh: its centroid on the CT. Throws
// UsageError naming `option` if it is neither, InvalidParameter if it cannot be placed on the CT.
Place parsePlace(const std::string& text, const scene::Case& value, const std::string& option)
{
  if (const std::string part = partNamed(value, text); isPart(value, part))
    return {presenters::placeOf(value, part).point, part};
  if (std::count(text.begin(), text.end(), ',') != 2)
    throw UsageError(option + ": x,y,z in mm or the name of a structure of the case, not '" + text +
                     "'");
  const auto n = parseNumbers(text, 3, option + " x,y,z");
  return {{n[0], n[1], n[2]}, {}};
}

struct SliceOptions
{
  std::string caseName, out, plane, normal, side, at, size = "800x800", overlay, mode, window,
                                                      projection;
  std::optional<double> slab;
  std::optional<double> fieldOfView;
  std::optional<double> opacity;
  bool noStructures = false;
  bool plain = false;
  bool withoutDamaged = false;
};

// A plane with the name under which it is drawn.
struct WantedPlane
{
  SliceOrientation orientation;
  presenters::SliceAxes axes;
  std::string name;
  bool isStandard = false;
};

WantedPlane planeOf(const SliceOptions& options, const scene::Case& value)
{
  const std::string& word = options.plane;
  if (word == "oblique" && options.normal.empty())
    throw UsageError("--plane oblique needs its --normal x,y,z, in patient LPS");
  if (word != "oblique" && !options.normal.empty())
    throw UsageError("--normal x,y,z goes with --plane oblique");
  const bool isPetrous = word == "poeschl" || word == "stenver";
  if (!isPetrous && !options.side.empty())
    throw UsageError("--side goes with --plane poeschl or stenver");
  if (word == "oblique")
  {
    const auto n = parseNumbers(options.normal, 3, "--normal x,y,z");
    const Eigen::Vector3d normal(n[0], n[1], n[2]);
    if (!(normal.norm() > 0.0))
      throw UsageError("--normal x,y,z: the normal must be longer than 0");
    const presenters::ObliquePlane plane = presenters::planeWithNormal(normal);
    return {plane.orientation, plane.axes, "Oblique"};
  }
  const SliceOrientation slice = word == "axial" ? SliceOrientation::Axial
                                 : word == "coronal" || word == "stenver"
                                     ? SliceOrientation::Coronal
                                     : SliceOrientation::Sagittal;
  if (!isPetrous)
    return {slice, presenters::axesOf(slice), presenters::nameOf(slice), true};
  const auto ear = options.side.empty()
                       ? presenters::earOf(value)
                       : std::optional<scene::Side>(scene::sideFromName(options.side));
  if (!ear)
    throw UsageError("--plane " + word +
                     ": the case does not tell which ear it is; say --side left or right");
  const scene::Side side = *ear;
  const auto planes = presenters::SlicePlanes::petrous(side);
  return {slice, planes.axes(slice),
          planes.name(slice) + (side == scene::Side::Left ? ", left ear" : ", right ear")};
}

presenters::Slab slabOf(const SliceOptions& options, const scene::ViewState::Slices* saved)
{
  presenters::Slab slab;
  if (saved && saved->slab)
    slab = {saved->slab->thickness, presenters::parseProjection(saved->slab->projection)
                                        .value_or(presenters::Projection::Maximum)};
  if (options.slab)
    slab.thickness = *options.slab;
  if (options.projection.empty())
    return slab;
  if (!(slab.thickness > 0.0))
    throw UsageError("--projection goes with --slab MM");
  slab.projection = *presenters::parseProjection(options.projection);
  return slab;
}

OverlayMode parseMode(const std::string& word)
{
  return word == "edges"     ? OverlayMode::Edges
         : word == "checker" ? OverlayMode::Checker
                             : OverlayMode::Blend;
}

std::optional<presenters::GreyWindow> parseWindow(const std::string& text)
{
  if (text.empty())
    return std::nullopt;
  const auto n = parseNumbers(text, 2, "--window WIDTH,LEVEL");
  if (!(n[0] > 0.0))
    throw UsageError("--window WIDTH,LEVEL: the width must be above 0");
  return presenters::GreyWindow{n[0], n[1]};
}

// Generous: as far as the intensities of any CT, and of this one.
void checkWindow(const presenters::GreyWindow& window, const volume::ValueRange& range,
                 const presenters::IntensityDisplay& display)
{
  const double lower = std::min(-32768.0, range.min);
  const double upper = std::max(65535.0, range.max);
  if (window.width > upper - lower)
    throw UsageError("--window WIDTH,LEVEL: the width must be above 0, up to " +
                     display.text(upper - lower));
  if (window.level < lower || window.level > upper)
    throw UsageError("--window WIDTH,LEVEL: the level must lie within " + display.number(lower) +
                     " to " + display.text(upper));
}

// `saved`: the slices as the case was saved with, or nullptr.
SliceGeometry sliceOf(const SliceOptions& options, const WantedPlane& plane,
                      const scene::Case& value, const scene::ViewState::Slices* saved, int width,
                      int height)
{
  const core::GridGeometry& grid = value.ct.geometry;
  const Eigen::Vector3d at = !options.at.empty() ? parsePlace(options.at, value, "--at").point
                             : saved             ? saved->crosshair
                                                 : grid.center();
  const auto whole = [&]
  { return SliceGeometry::fitting(plane.orientation, plane.axes, grid, at, width, height); };
  // The saved zoom is of the planes that were shown, which may have been others.
  if (!options.fieldOfView && options.at.empty() && saved && saved->planes && plane.isStandard &&
      !saved->turned)
  {
    const auto& shown = (*saved->planes)[static_cast<std::size_t>(plane.orientation)];
    return presenters::zoomed(whole(), shown.zoom, shown.offset);
  }
  if (!options.fieldOfView)
    return whole();
  return {plane.orientation, plane.axes, at, *options.fieldOfView / width, width, height};
}

// Whether any pixel of the slice is within the CT's voxels.
bool meets(const SliceGeometry& slice, const core::GridGeometry& grid)
{
  const Eigen::Array3d last(grid.dims()[0] - 1, grid.dims()[1] - 1, grid.dims()[2] - 1);
  for (int y = 0; y < slice.height(); ++y)
    for (int x = 0; x < slice.width(); ++x)
    {
      const Eigen::Array3d voxel = grid.voxelFromPatient(slice.patientFromPixel(x, y)).array();
      if ((voxel >= -0.5).all() && (voxel <= last + 0.5).all())
        return true;
    }
  return false;
}

// "covers x -60 to 60, y -40 to 80, z 0 to 75 mm": the CT's bounding box, patient LPS.
std::string coverageOf(const core::GridGeometry& grid)
{
  const core::PatientBox box = grid.patientBounds();
  std::string text = "covers";
  for (int axis = 0; axis < 3; ++axis)
    text += std::string(axis == 0 ? " " : ", ") + "xyz"[axis] + " " + fixed(box.min()[axis], 1) +
            " to " + fixed(box.max()[axis], 1);
  return text + " mm";
}

std::optional<presenters::SliceOverlay> overlayOf(const SliceOptions& options,
                                                  const scene::ImagePart* mr)
{
  if (!mr)
    return std::nullopt;
  presenters::SliceOverlay overlay = presenters::overlayOf(*mr);
  overlay.mode = parseMode(options.mode);
  overlay.opacity = options.opacity.value_or(0.5);
  return overlay;
}

const scene::ImagePart* findOverlay(const SliceOptions& options, const scene::Case& value)
{
  if (options.overlay.empty())
    return nullptr;
  const scene::ImagePart* mr = scene::findMr(value, options.overlay);
  if (mr)
    return mr;
  std::string names;
  for (const auto& image : value.mr)
    names += " '" + image.name + "'";
  throw UsageError("--overlay: no MR '" + options.overlay + "' in the case" +
                   (names.empty() ? "; it has none" : "; it has" + names));
}

nlohmann::json overlayJson(const scene::ImagePart& mr, const presenters::SliceOverlay& overlay)
{
  return {{"mr", mr.name},
          {"registered", mr.registered},
          {"mode", nameOf(overlay.mode)},
          {"opacity", overlay.mode == OverlayMode::Blend ? nlohmann::json(overlay.opacity)
                                                         : nlohmann::json(nullptr)},
          {"window", {{"width", overlay.window.width}, {"level", overlay.window.level}}},
          {"text", scene::registrationToString(mr)}};
}

// What of the saved overlay is not given by options.
void takeOverlay(SliceOptions& options, const scene::Case& value,
                 const scene::ViewState::Slices* saved)
{
  if (!saved || !saved->overlay || !options.overlay.empty() ||
      !scene::findMr(value, saved->overlay->mr))
    return;
  options.overlay = saved->overlay->mr;
  if (options.mode.empty())
    options.mode = saved->overlay->mode;
  options.opacity = options.opacity.value_or(saved->overlay->opacity);
}

std::string projectionWord(presenters::Projection projection)
{
  return projection == presenters::Projection::Maximum   ? "MIP"
         : projection == presenters::Projection::Minimum ? "MinIP"
                                                         : "Mean";
}

nlohmann::json slabJson(const presenters::Slab& slab)
{
  if (!(slab.thickness > 0.0))
    return nullptr;
  return {{"thickness_mm", slab.thickness}, {"projection", nameOf(slab.projection)}};
}

void slice(const Context& context, SliceOptions options)
{
  const auto [width, height] = parseSize(options.size);
  const auto wanted = parseWindow(options.window);
  context.refuseOverwriting({options.out});
  const library::Library library = context.openLibrary();
  scene::Case value = library.open(options.caseName);
  const scene::ViewState::Slices* saved =
      options.plain || !value.view.slices ? nullptr : &*value.view.slices;
  takeOverlay(options, value, saved);
  const scene::ImagePart* mr = findOverlay(options, value);
  const presenters::IntensityDisplay display = presenters::displayOf(value);
  const presenters::GreyWindow window = wanted  ? *wanted
                                        : saved ? presenters::GreyWindow{saved->width, saved->level}
                                                : display.bone;
  checkWindow(window, value.ct.range, display);
  const WantedPlane plane = planeOf(options, value);
  if (!options.side.empty())
    warnOfEar(context, value, scene::sideFromName(options.side));
  const presenters::Slab slab = slabOf(options, saved);
  const SliceGeometry geometry = sliceOf(options, plane, value, saved, width, height);
  if (!meets(geometry, value.ct.geometry))
    throw UsageError("--at: the slice does not meet the CT, which " +
                     coverageOf(value.ct.geometry) + " (patient LPS)");
  presenters::LeftOut leftOut;
  if (!options.noStructures)
    leftOut = leaveOutDamaged(context, library, value, options.withoutDamaged);
  if (value.applied() > 0)
    library.loadDissection(value);
  nlohmann::json missing = leftOutJson(value, leftOut);
  if (options.noStructures)
  {
    value.labels.clear();
    value.meshes.clear();
  }
  const auto overlay = overlayOf(options, mr);
  const presenters::SlicePresenter presenter(value);

  const auto start = std::chrono::steady_clock::now();
  auto pixels = presenter.draw(geometry, window, overlay ? &*overlay : nullptr, slab);
  const double elapsed =
      std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();

  std::vector<std::string> lines{plane.name};
  if (slab.thickness > 0.0)
    lines.push_back(projectionWord(slab.projection) + " " + core::plainText(slab.thickness) +
                    " mm");
  if (mr)
    lines.push_back("MR " + mr->name + (mr->registered ? "" : ": not registered"));
  const auto addInterpolated = [&](const std::string& name, const scene::ImagePart& image)
  {
    const std::string guessed = presenters::interpolatedText(image);
    if (guessed.empty())
      return;
    lines.push_back(name + ": " + guessed);
    context.warn(lines.back() + "; small structures may be absent there");
  };
  const bool isGuess = presenters::showsInterpolated(value.ct, geometry, slab.thickness);
  if (isGuess)
    lines.push_back(slab.thickness > 0.0 ? "slab with an interpolated slice"
                                         : "interpolated slice: not measured here");
  addInterpolated(presenters::primaryName(value), value.ct);
  if (mr)
    addInterpolated(mr->name, *mr);
  context.refuseDamaged();
  rendering::writePng(options.out, presenters::labelledSlice(std::move(pixels), geometry, lines));
  if (mr && !mr->registered)
    context.warn("MR '" + mr->name +
                 "' is not registered with the CT; it is shown where its own file puts it");
  context.print(options.out + ": " + options.plane + ", " + options.size + ", " +
                fixed(geometry.mmPerPixel(), 3) + " mm a pixel, " + fixed(elapsed, 1) + " ms");
  context.printJson({{"case", value.name},
                     {"out", options.out},
                     {"plane", options.plane},
                     {"size", {width, height}},
                     {"center_mm", vectorJson(geometry.center())},
                     {"right", vectorJson(geometry.axes().right)},
                     {"down", vectorJson(geometry.axes().down)},
                     {"normal", vectorJson(geometry.axes().next)},
                     {"slab", slabJson(slab)},
                     {"interpolated", isGuess},
                     {"mm_per_pixel", geometry.mmPerPixel()},
                     {"milliseconds", elapsed},
                     {"window", {{"width", window.width}, {"level", window.level}}},
                     {"hounsfield", display.hounsfield},
                     {"overlay", mr ? overlayJson(*mr, *overlay) : nlohmann::json(nullptr)},
                     {"left_out", std::move(missing)},
                     {"resources", residentResources(value)}});
}

} // namespace

void addSliceCommand(CLI::App& app, Context& context)
{
  auto options = std::make_shared<SliceOptions>();
  CLI::App* command = context.addCommand(
      app, "slice", "Render a slice of a case to a PNG file, optionally with an MR over the CT",
      [options, &context] { slice(context, *options); });
  command->add_option("CASE", options->caseName)->required();
  command->add_option("--out", options->out, "Picture to write")
      ->type_name("F.png")
      ->check(endsIn({".png"}))
      ->required();
  command
      ->add_option(
          "--plane", options->plane,
          "axial, coronal, sagittal, poeschl, stenver (45 degrees about the patient's long "
          "axis, across and along the petrous bone) or oblique")
      ->check(oneOf({"axial", "coronal", "sagittal", "poeschl", "stenver", "oblique"}))
      ->required();
  command->add_option("--normal", options->normal, "Of an oblique plane, patient LPS")
      ->type_name("x,y,z");
  command
      ->add_option("--side", options->side,
                   "Ear of poeschl and stenver: left or right (the case's side, else the CT's)")
      ->check(oneOf({"left", "right"}));
  command
      ->add_option("--slab", options->slab,
                   "Thickness of the layer that is projected; 0: the slice itself (as saved)")
      ->type_name("MM")
      ->check(within({0.0, 1000.0, "mm"}));
  command
      ->add_option("--projection", options->projection,
                   "Of a slab: mip (brightest), minip (darkest) or mean (as saved, else mip)")
      ->check(oneOf({"mip", "minip", "mean"}));
  command
      ->add_option(
          "--at", options->at,
          "Point in the slice, patient LPS mm, or a structure's centroid (as saved, else the CT's "
          "centre)")
      ->type_name("x,y,z|LABEL");
  command->add_option("--size", options->size, "Pixels (800x800)")->type_name("WxH");
  command
      ->add_option("--field-of-view", options->fieldOfView,
                   "Width of the picture, centred on --at (as saved, else the whole slice)")
      ->type_name("MM")
      ->check(within({0.0, 10000.0, "mm", true}));
  command
      ->add_option("--window", options->window,
                   "Window width and level of the CT, in its unit (as saved, else bone: 4000,700 "
                   "HU)")
      ->type_name("WIDTH,LEVEL");
  command
      ->add_option("--overlay", options->overlay, "MR of the case to overlay on the CT (as saved)")
      ->type_name("MR");
  command
      ->add_option("--mode", options->mode,
                   "blend, edges (the CT's contours over the MR) or checker (blend)")
      ->check(oneOf({"blend", "edges", "checker"}));
  command
      ->add_option("--opacity", options->opacity,
                   "Opacity of the MR in a blend: 0 CT only, 1 MR only (0.5)")
      ->check(within({0.0, 1.0}));
  command->add_flag("--no-structures", options->noStructures, "Show CT and MR only");
  command->add_flag("--plain", options->plain,
                    "Not as the case was saved: the CT alone, the whole slice through its centre, "
                    "in a bone window, where options do not say otherwise");
  addWithoutDamaged(*command, options->withoutDamaged);
}

} // namespace petrous::cli
