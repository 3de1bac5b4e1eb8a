#include <algorithm>
#include <iterator>

#include "CaseJson.h"
#include "CaseWarnings.h"
#include "Commands.h"
#include "Numbers.h"
#include "ToolOptions.h"
#include "ViewOptions.h"
#include "petrous/Dissection/BurrName.h"
#include "petrous/Dissection/Catalogues.h"
#include "petrous/Presenters/CasePicture.h"
#include "petrous/Presenters/HandpiecePresets.h"
#include "petrous/Presenters/IntensityDisplay.h"
#include "petrous/Presenters/SlicePlanes.h"
#include "petrous/Rendering/Stereo.h"

namespace petrous::cli
{

namespace
{

using scene::ViewState;
using Slices = ViewState::Slices;

constexpr const char* kUsual = "usual"; // handpiece
constexpr const char* kPlanes[] = {"axial", "coronal", "sagittal"};

struct ViewCommandOptions
{
  std::string caseName, view, camera, at, window, stereo, crop, roi, overlay, mode, burr, handpiece;
  std::string show, saveAs;
  std::vector<std::string> clip, zoom, cleared, removed;
  ToolOptions instrument;
  bool leftHand = false;
  LightOptions light;
  std::optional<double> eyeSeparation, convergence, opacity, diameter, rpm, thrust;
};

void clear(scene::Case& value, const std::string& part)
{
  ViewState& view = value.view;
  if (part == "camera")
    value.camera.reset();
  else if (part == "slices")
    view.slices.reset();
  else if (part == "light")
    view.light.reset();
  else if (part == "stereo")
    view.stereo.reset();
  else if (part == "clipping")
    view.clipping = {};
  else if (part == "instrument")
    view.instrument.reset();
  else
  {
    view.tool.reset();
    view.handpiece.reset();
  }
}

const ViewState::Saved& savedView(const scene::Case& value, const std::string& name,
                                  const std::string& option)
{
  const auto found = value.view.saved.find(name);
  if (found != value.view.saved.end())
    return found->second;
  std::string names;
  for (const auto& [other, saved] : value.view.saved)
    names += (names.empty() ? " '" : ", '") + other + "'";
  throw UsageError(option + ": no saved view '" + name + "'" +
                   (names.empty() ? "; the case has none" : "; there are" + names));
}

void changeSlices(scene::Case& value, const ViewCommandOptions& options)
{
  if (options.at.empty() && options.window.empty() && options.zoom.empty() &&
      options.overlay.empty() && options.mode.empty() && !options.opacity)
    return;
  auto& saved = value.view.slices;
  if (!saved)
  {
    const presenters::GreyWindow window = presenters::displayOf(value).bone;
    saved = Slices{value.ct.geometry.center(), window.width, window.level};
  }
  if (!options.at.empty())
  {
    const auto n = parseNumbers(options.at, 3, "--at x,y,z");
    saved->crosshair = {n[0], n[1], n[2]};
    if (!value.ct.geometry.hullContains(value.ct.geometry.voxelFromPatient(saved->crosshair)))
      throw UsageError("--at: the point is not within the CT");
  }
  if (!options.window.empty())
  {
    const auto n = parseNumbers(options.window, 2, "--window WIDTH,LEVEL");
    saved->width = n[0];
    saved->level = n[1];
  }
  for (const std::string& text : options.zoom)
  {
    const std::size_t equals = text.find('=');
    const auto* const plane =
        std::find(std::begin(kPlanes), std::end(kPlanes), text.substr(0, equals));
    if (equals == text.npos || plane == std::end(kPlanes))
      throw UsageError("--zoom PLANE=FACTOR: axial, coronal or sagittal, not '" + text + "'");
    if (!saved->planes)
      saved->planes.emplace();
    (*saved->planes)[static_cast<std::size_t>(plane - std::begin(kPlanes))].zoom =
        parseNumbers(text.substr(equals + 1), 1, "--zoom PLANE=FACTOR").front();
  }
  if (!options.overlay.empty() && !scene::findMr(value, options.overlay))
    throw UsageError("--overlay: no MR '" + options.overlay + "' in the case");
  if (!options.overlay.empty())
    saved->overlay = Slices::Overlay{options.overlay, "blend"};
  if ((!options.mode.empty() || options.opacity) && !saved->overlay)
    throw UsageError("--mode and --opacity go with --overlay");
  if (!options.mode.empty())
    saved->overlay->mode = options.mode;
  if (options.opacity)
    saved->overlay->opacity = *options.opacity;
}

// As the case is looked at by then.
ViewState::Handpiece handpieceFor(const scene::Case& value, const ViewCommandOptions& options)
{
  const auto approach = presenters::parseSurgicalApproach(options.handpiece);
  const auto ear = presenters::earOf(value);
  if (!ear)
    throw UsageError("--handpiece: the case does not tell which ear it is; state it first with "
                     "'petrous describe CASE --side left' or right");
  const auto hand =
      presenters::handpieceAlong(presenters::shaftOf(approach.value(), *ear, options.leftHand),
                                 presenters::currentCamera(value), options.leftHand);
  if (!hand)
    throw UsageError("--handpiece: in this view the hand would come from behind the picture; look "
                     "at the ear first, as with --view " +
                     std::string(ear == scene::Side::Left ? "surgical-left" : "surgical-right"));
  return *hand;
}

void change(scene::Case& value, const ViewCommandOptions& options,
            const std::optional<dissection::BurrModel>& burr,
            const std::optional<ViewState::Instrument>& instrument)
{
  if (!options.view.empty() && !options.camera.empty())
    throw UsageError("view: give --view or --camera, not both");
  ViewState& view = value.view;
  for (const std::string& part : options.cleared)
    clear(value, part);
  for (const std::string& name : options.removed)
  {
    savedView(value, name, "--remove");
    view.saved.erase(name);
  }
  if (!options.show.empty())
    scene::showSaved(value, savedView(value, options.show, "--show"));
  if (!options.camera.empty())
    value.camera = readCamera(options.camera);
  if (!options.view.empty())
    value.camera = presenters::standardCamera(value, *rendering::parseView(options.view));
  changeSlices(value, options);
  if (options.light.any())
    view.light = options.light.over(view.light.value_or(ViewState::Light()));
  if (!options.stereo.empty() || options.eyeSeparation || options.convergence)
  {
    if (!view.stereo)
      view.stereo.emplace();
    if (!options.stereo.empty())
      view.stereo->mode = options.stereo;
    if (options.eyeSeparation)
      view.stereo->eyeSeparation = options.eyeSeparation;
    if (options.convergence)
      view.stereo->convergence = options.convergence;
  }
  if (!options.clip.empty())
    view.clipping.planes = parsePlanes(options.clip);
  if (const auto crop = parseCrop(options.crop, options.roi, value.ct.geometry))
    view.clipping.crop = crop;
  if (burr || options.diameter || options.rpm || options.thrust)
  {
    if (!view.tool)
      view.tool.emplace();
    if (burr)
      setModel(view.tool->burr, *burr);
    view.tool->burr.diameter = options.diameter.value_or(view.tool->burr.diameter);
    view.tool->burr.rpm = options.rpm.value_or(view.tool->burr.rpm);
    view.tool->thrust = options.thrust.value_or(view.tool->thrust);
  }
  if (options.handpiece == kUsual && options.leftHand)
    throw UsageError("--left-hand: the usual handpiece is in no hand; give an approach");
  if (options.handpiece == kUsual)
    view.handpiece.reset();
  else if (!options.handpiece.empty())
    view.handpiece = handpieceFor(value, options);
  if (instrument)
    view.instrument = instrument;
  try
  {
    if (!options.saveAs.empty())
      scene::saveView(value, options.saveAs, presenters::currentCamera(value));
    scene::checkView(view);
  }
  catch (const core::InvalidParameter& error)
  {
    throw UsageError(error.what());
  }
}

nlohmann::json slicesJson(const Slices& slices)
{
  nlohmann::json planes = nullptr;
  if (slices.planes)
    for (std::size_t n = 0; n < slices.planes->size(); ++n)
      planes[kPlanes[n]] = {{"zoom", (*slices.planes)[n].zoom},
                            {"offset_mm", vectorJson((*slices.planes)[n].offset)}};
  nlohmann::json overlay = nullptr;
  if (slices.overlay)
    overlay = {{"mr", slices.overlay->mr},
               {"mode", slices.overlay->mode},
               {"opacity", slices.overlay->opacity}};
  nlohmann::json turned = nullptr;
  if (slices.turned)
  {
    turned = {{"kind", slices.turned->kind}};
    for (std::size_t n = 0; n < slices.turned->planes.size(); ++n)
      turned[kPlanes[n]] = {{"right", vectorJson(slices.turned->planes[n].right)},
                            {"down", vectorJson(slices.turned->planes[n].down)}};
  }
  nlohmann::json slab = nullptr;
  if (slices.slab)
    slab = {{"thickness_mm", slices.slab->thickness}, {"projection", slices.slab->projection}};
  return {{"crosshair_mm", vectorJson(slices.crosshair)},
          {"turned", std::move(turned)},
          {"slab", std::move(slab)},
          {"window", {{"width", slices.width}, {"level", slices.level}}},
          {"planes", std::move(planes)},
          {"overlay", std::move(overlay)}};
}

nlohmann::json clippingJson(const ViewState::Clipping& clipping)
{
  nlohmann::json planes = nlohmann::json::array();
  for (const auto& plane : clipping.planes)
    planes.push_back({{"point_mm", vectorJson(plane.point)}, {"normal", vectorJson(plane.normal)}});
  nlohmann::json crop = nullptr;
  if (const auto& box = clipping.crop)
    crop = {box->lower[0],     box->upper[0] - 1, box->lower[1],
            box->upper[1] - 1, box->lower[2],     box->upper[2] - 1};
  return {{"planes", std::move(planes)}, {"crop", std::move(crop)}};
}

nlohmann::json savedJson(const ViewState::Saved& saved)
{
  return {{"camera", saved.camera ? cameraJson(*saved.camera) : nlohmann::json(nullptr)},
          {"slices", saved.slices ? slicesJson(*saved.slices) : nlohmann::json(nullptr)}};
}

nlohmann::json viewJson(const scene::Case& value)
{
  const auto orNull = [](const std::optional<double>& number)
  { return number ? nlohmann::json(*number) : nlohmann::json(nullptr); };
  const ViewState& view = value.view;
  nlohmann::json branches = nlohmann::json::object();
  for (const auto& [name, one] : view.branches)
  {
    branches[name] = savedJson(one);
    branches[name]["clipping"] =
        one.clipping ? clippingJson(*one.clipping) : nlohmann::json(nullptr);
  }
  nlohmann::json light = nullptr;
  if (view.light)
    light = {{"falloff_mm", view.light->falloff},   {"wetness", view.light->wetness},
             {"shadows", view.light->shadows},      {"exposure_ev", view.light->exposure},
             {"tone_curve", view.light->toneCurve}, {"edges", view.light->edges},
             {"grain", view.light->grain},          {"exit_surfaces", view.light->exitSurfaces}};
  nlohmann::json stereo = nullptr;
  if (view.stereo)
    stereo = {{"mode", view.stereo->mode},
              {"eye_separation_mm", orNull(view.stereo->eyeSeparation)},
              {"convergence_mm", orNull(view.stereo->convergence)}};
  nlohmann::json hand = nullptr;
  if (view.handpiece)
    hand = {{"turn_deg", view.handpiece->turn},
            {"tilt_deg", view.handpiece->tilt},
            {"hand", view.handpiece->isLeft ? "left" : "right"}};
  nlohmann::json tool = nullptr;
  if (view.tool)
    tool = {{"burr", dissection::nameOf(view.tool->burr.kind)},
            {"burr_name", dissection::nameOf(view.tool->burr)},
            {"diameter_mm", view.tool->burr.diameter},
            {"rpm", view.tool->burr.rpm},
            {"thrust_n", view.tool->thrust},
            {"by_wheel", view.tool->byWheel}};
  nlohmann::json instrument = nullptr;
  if (view.instrument)
    instrument = {{"name", view.instrument->name},
                  {"axis", view.instrument->axis},
                  {"object", view.instrument->object}};
  nlohmann::json saved = nlohmann::json::object();
  for (const auto& [name, one] : view.saved)
    saved[name] = savedJson(one);
  return {{"saved", std::move(saved)},
          {"camera", value.camera ? cameraJson(*value.camera) : nlohmann::json(nullptr)},
          {"branches", std::move(branches)},
          {"slices", view.slices ? slicesJson(*view.slices) : nlohmann::json(nullptr)},
          {"light", std::move(light)},
          {"stereo", std::move(stereo)},
          {"clipping", clippingJson(view.clipping)},
          {"tool", std::move(tool)},
          {"handpiece", std::move(hand)},
          {"instrument", std::move(instrument)}};
}

// By content, as one is not stored yet.
bool isSameInstrument(const ViewState::Instrument& kept, const ViewState::Instrument& read)
try
{
  const core::TriangleMesh& one = *kept.mesh.get();
  const core::TriangleMesh& other = *read.mesh.get();
  return kept.name == read.name && kept.axis == read.axis && one.vertices == other.vertices &&
         one.triangles == other.triangles;
}
catch (const library::LibraryError&)
{
  return false; // lost: it is stored again
}

void run(const Context& context, const ViewCommandOptions& options)
{
  library::Library library = context.openLibrary();
  scene::Case value = library.open(options.caseName);
  const nlohmann::json before = viewJson(value);
  std::optional<dissection::BurrModel> burr;
  if (!options.burr.empty())
    burr = burrNamed(options.burr, dissection::Catalogues::in(library.folder()).burrs);
  std::optional<ViewState::Instrument> instrument;
  if (!options.instrument.file.empty())
  {
    const auto [surface, axis] = options.instrument.read(context.progress());
    for (const std::string& note : presenters::makeInstrument(surface, axis).notes)
      context.warn(options.instrument.file + ": " + note);
    instrument = presenters::keptInstrument(surface, axis);
    if (value.view.instrument && isSameInstrument(*value.view.instrument, *instrument))
      instrument = value.view.instrument; // which is stored
  }
  change(value, options, burr, instrument);
  if (options.view.empty() && !options.saveAs.empty())
    warnOfCurrentView(context, value);
  else
    warnOfView(context, value, options.view);
  nlohmann::json now = viewJson(value);
  const bool isChanged = now != before;
  if (isChanged)
  {
    library.save(value);
    now = viewJson(value); // with the name of the instrument's object
  }
  context.print("case '" + value.name + "'" + (isChanged ? " has another view" : ""));
  for (const auto& [part, what] : now.items())
    if (!what.is_null() && !what.empty() && (part != "clipping" || !value.view.clipping.empty()))
      context.print("  " + part + ": " + what.dump());
  nlohmann::json answer = now;
  answer["case"] = value.name;
  answer["changed"] = isChanged;
  context.printJson(answer);
}

} // namespace

void addViewCommand(CLI::App& app, Context& context)
{
  auto options = std::make_shared<ViewCommandOptions>();
  CLI::App* command =
      context.addCommand(app, "view", "Show or change how a case is looked at, and its tool",
                         [options, &context] { run(context, *options); });
  command->add_option("CASE", options->caseName, "Name of the case")->required();
  command
      ->add_option(
          "--view", options->view,
          "lateral, left, right, superior, inferior, anterior, posterior, surgical-left or "
          "surgical-right (seen from the ear, the face up)")
      ->check(oneOf({"lateral", "left", "right", "superior", "inferior", "anterior", "posterior",
                     "surgical-left", "surgical-right"}));
  command->add_option("--camera", options->camera, "Camera file, patient LPS mm")
      ->type_name("F.json");
  command->add_option("--at", options->at, "Crosshair of the slices, patient LPS mm")
      ->type_name("x,y,z");
  command->add_option("--window", options->window, "Width and level of the slices' grey window")
      ->type_name("WIDTH,LEVEL");
  command->add_option("--zoom", options->zoom, "Of a slice: axial, coronal or sagittal; 1: whole")
      ->allow_extra_args(false)
      ->type_name("PLANE=FACTOR");
  command->add_option("--overlay", options->overlay, "MR over the CT in the slices")
      ->type_name("MR");
  command->add_option("--mode", options->mode, "blend, edges or checker")
      ->check(oneOf({"blend", "edges", "checker"}));
  command->add_option("--opacity", options->opacity, "Of the MR in a blend")
      ->check(within({0.0, 1.0}));
  addLightOptions(*command, options->light);
  command->add_option("--stereo", options->stereo, "none, side-by-side, interleaved or anaglyph")
      ->check(oneOf({"none", "side-by-side", "interleaved", "anaglyph"}));
  command->add_option("--eye-separation", options->eyeSeparation, "Distance between the eyes")
      ->type_name("MM")
      ->check(within({0.0, rendering::StereoRig::kLargestSeparation, "mm"}));
  command
      ->add_option("--convergence", options->convergence,
                   "Distance from the camera to the convergence point")
      ->type_name("MM")
      ->check(within({rendering::StereoRig::kNearestConvergence,
                      rendering::StereoRig::kFarthestConvergence, "mm"}));
  command
      ->add_option("--clip", options->clip,
                   "Clipping plane, patient LPS mm, instead of the present ones (up to 6 times)")
      ->allow_extra_args(false)
      ->type_name("x,y,z,nx,ny,nz");
  command->add_option("--crop", options->crop, "Show these voxels of the CT, first and last")
      ->type_name("i0,i1,j0,j1,k0,k1");
  command->add_option("--roi", options->roi, "Show this box, patient LPS mm")
      ->type_name("x0,x1,y0,y1,z0,z1");
  command
      ->add_option("--burr", options->burr,
                   "A burr's name in the library's catalogue (materials): cutting, diamond, one of "
                   "other rake or grit, or of your own")
      ->check(offers(builtInBurrs()));
  command->add_option("--diameter", options->diameter, "Of the burr")
      ->type_name("MM")
      ->check(within({0.01, 100.0, "mm"}));
  command->add_option("--rpm", options->rpm, "Of the spindle")
      ->type_name("N")
      ->check(within({0.0, 1e6}));
  command->add_option("--thrust", options->thrust, "Of a device without force")
      ->type_name("N")
      ->check(within({0.0, 100.0, "N"}));
  std::vector<std::string> hands{kUsual};
  for (const presenters::SurgicalApproach approach : presenters::kSurgicalApproaches)
    hands.emplace_back(presenters::nameOf(approach));
  CLI::Option* handpiece =
      command
          ->add_option("--handpiece", options->handpiece,
                       "How the window's handpiece is held, seen as the case is then: usual, "
                       "transmastoid, posterior-tympanotomy, translabyrinthine, retrosigmoid or "
                       "middle-fossa")
          ->check(oneOf(hands));
  command->add_flag("--left-hand", options->leftHand, "The handpiece is in the left hand")
      ->needs(handpiece);
  addToolOptions(*command, "--instrument",
                 "The instrument that the case keeps for the window, as drill --tool: its surface "
                 "is stored with the case",
                 options->instrument);
  command
      ->add_option("--show", options->show,
                   "Take camera and slices from a saved view, before other options")
      ->type_name("NAME");
  command
      ->add_option("--save-as", options->saveAs,
                   "Save camera and slices, as they are then, as a view of this name; replaces one "
                   "of the same name")
      ->type_name("NAME");
  command->add_option("--remove", options->removed, "Saved view to remove, first of all")
      ->allow_extra_args(false)
      ->type_name("NAME");
  command
      ->add_option("--clear", options->cleared,
                   "Take out, before anything else: camera, slices, light, stereo, clipping, tool, "
                   "instrument")
      ->allow_extra_args(false)
      ->delimiter(',')
      ->check(oneOf({"camera", "slices", "light", "stereo", "clipping", "tool", "instrument"}));
}

} // namespace petrous::cli
