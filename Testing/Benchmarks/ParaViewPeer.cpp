#include "ParaViewPeer.h"

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <limits>
#include <optional>
#include <utility>

#include <nlohmann/json.hpp>

#include "ChildProcess.h"
#include "OwnPicture.h"
#include "PeerPicture.h"
#include "PeerRegistration.h"
#include "Program.h"
#include "RendererBenchmarkScenes.h"
#include "TimedView.h"

namespace petrous::cli
{

namespace
{

using rendering::Picture;
using rendering::SceneContents;

// Of a run of the script: each sample's light is all that comes through the volume, as far as our
// lamp's shadow reaches, or none of it is.
struct ShadowRun
{
  const char* name;
  double blending;
  double reach; // of the volume's diagonal
};
constexpr ShadowRun kShadowRuns[] = {{"composite, shaded", 0.0, 0.0}, {"volume shadows", 1.0, 1.0}};

nlohmann::json listOf(const Eigen::Vector3d& vector)
{
  return {vector.x(), vector.y(), vector.z()};
}

nlohmann::json sceneJson(const SceneContents& contents, const core::CameraPose& camera,
                         const ParaViewOptions& options)
{
  const core::GridGeometry& grid = contents.ct->geometry();
  nlohmann::json pose = nlohmann::json::array();
  for (int row = 0; row < 3; ++row)
  {
    for (int column = 0; column < 3; ++column)
      pose.push_back(grid.direction()(row, column));
    pose.push_back(grid.origin()[row]);
  }
  for (const double last : {0.0, 0.0, 0.0, 1.0})
    pose.push_back(last);
  nlohmann::json transfer = nlohmann::json::array();
  for (const auto& point : rendering::peerTable(contents.materials.front(), contents.iso))
    transfer.push_back(
        {point.value, point.color[0], point.color[1], point.color[2], point.opacity});
  nlohmann::json runs = nlohmann::json::array();
  for (const ShadowRun& run : kShadowRuns)
    runs.push_back({{"name", run.name}, {"blending", run.blending}, {"reach", run.reach}});
  return {{"volume", (options.work / "ct.mhd").string()},
          {"pose", std::move(pose)},
          {"picture", {options.picture.width, options.picture.height}},
          {"camera",
           {{"position", listOf(camera.position)},
            {"focal_point", listOf(camera.focalPoint)},
            {"view_up", listOf(camera.viewUp)},
            {"view_angle", camera.viewAngle}}},
          {"step", rendering::PeerPicture::kStep * grid.minSpacing()},
          {"transfer", std::move(transfer)},
          {"light",
           {{"ambient", contents.light.ambient},
            {"specular", contents.light.specular},
            {"shininess", contents.light.shininess},
            {"lamp", {0.0, rendering::lampTilt(), 1.0}}}},
          {"background", contents.background},
          {"frames", options.frames},
          {"seconds", options.seconds},
          {"runs", std::move(runs)}};
}

// As the script writes them: P6, 8 bits, no comment.
std::optional<Picture> readPpm(const std::filesystem::path& file)
{
  std::ifstream in(file, std::ios::binary);
  in.imbue(std::locale::classic());
  std::string magic;
  Picture picture;
  int most = 0;
  in >> magic >> picture.width >> picture.height >> most;
  in.get();
  if (!in || magic != "P6" || most != 255 || picture.width < 1 || picture.height < 1)
    return std::nullopt;
  picture.rgb.resize(3 * static_cast<std::size_t>(picture.width) *
                     static_cast<std::size_t>(picture.height));
  in.read(reinterpret_cast<char*>(picture.rgb.data()),
          static_cast<std::streamsize>(picture.rgb.size()));
  return in ? std::optional(std::move(picture)) : std::nullopt;
}

double differenceOf(const Picture& a, const Picture& b)
{
  if (a.rgb.size() != b.rgb.size())
    return std::numeric_limits<double>::quiet_NaN();
  double squares = 0.0;
  for (std::size_t n = 0; n < a.rgb.size(); ++n)
    squares += std::pow(int{a.rgb[n]} - int{b.rgb[n]}, 2);
  return std::sqrt(squares / static_cast<double>(a.rgb.size()));
}

// The script's result; null if it did not run.
nlohmann::json runScript(const SceneContents& contents, const core::CameraPose& camera,
                         const ParaViewOptions& options)
{
  std::filesystem::create_directories(options.work);
  registration::writeMetaImage(options.work / "ct.mhd", *contents.ct);
  const auto scene = options.work / "scene.json";
  const auto result = options.work / "result.json";
  std::ofstream(scene) << sceneJson(contents, camera, options).dump();
  const auto beside = programBeside("petrous-paraview-peer", ".");
  std::vector<std::string> words;
  if (!std::getenv("DISPLAY"))
    words = {"xvfb-run", "-a"};
  words.push_back(options.pvpython.empty() ? "pvpython" : options.pvpython.string());
  words.push_back(beside.empty() ? "petrous-paraview-peer" : beside.string());
  words.push_back(scene.string());
  words.push_back(result.string());
  if (registration::runProcess(words).status != 0)
    return nullptr;
  std::ifstream in(result);
  return nlohmann::json::parse(in, nullptr, false);
}

} // namespace

std::vector<core::BenchmarkPoint> paraViewPoints(const BenchmarkPatient& patient,
                                                 const ParaViewOptions& options,
                                                 std::map<std::string, std::string>& notes,
                                                 const core::Progress& progress)
{
  SceneContents contents = contentsOf(patient, BenchmarkLook::CtAlone);
  contents.light.setShadows(true);
  const core::CameraPose camera = cameraOf(patient, BenchmarkView::Near);
  const std::string name = patient.name + ", near, " + nameOf(BenchmarkLook::CtAlone);
  progress.report(0.0, name + ": ParaView");
  const nlohmann::json result = runScript(contents, camera, options);
  if (!result.is_object())
  {
    notes["paraview"] = "no peer: pvpython (ParaView 5.11 or later) was not found or failed; "
                        "--paraview PATH names it, and it needs a display or xvfb-run";
    return {};
  }
  notes["paraview"] = "VTK " + result.value("vtk", "?") + ", " + result.value("gl_renderer", "?");
  progress.report(0.8, name);
  std::vector<core::BenchmarkPoint> points;
  rendering::TimedView view(options.picture.width, options.picture.height);
  for (std::size_t n = 0; n < result.at("runs").size(); ++n)
  {
    const nlohmann::json& run = result.at("runs")[n];
    contents.light.shadows = kShadowRuns[n].blending > 0.0;
    rendering::OwnPicture own(contents, camera);
    view.show(own);
    const auto timing = view.time(options.frames);
    core::BenchmarkPoint ours;
    ours.scene = name + (contents.light.shadows ? ", shadows" : "") + ", beside ParaView";
    ours.isDefault = true;
    ours.seconds = timing.median;
    ours.error = std::numeric_limits<double>::quiet_NaN();
    ours.errorUnit = "none: other optics than the peer's";
    ours.setting["picture"] = shown(options.picture);
    ours.extra["first_frame_ms"] = 1e3 * timing.first;
    ours.extra["frames"] = timing.frames;
    core::BenchmarkPoint theirs = ours;
    theirs.isDefault = false;
    theirs.peer = "ParaView, " + run.at("name").get<std::string>();
    theirs.seconds = run.at("median");
    theirs.setting["step_voxels"] = "0.5";
    theirs.extra = {{"first_frame_ms", 1e3 * run.at("first").get<double>()},
                    {"frames", run.at("frames")},
                    {"times_ours", theirs.seconds / ours.seconds}};
    if (const auto picture = readPpm(run.at("picture").get<std::string>()))
      theirs.extra["difference_rms"] = differenceOf(*picture, view.picture());
    points.push_back(std::move(ours));
    points.push_back(std::move(theirs));
  }
  return points;
}

} // namespace petrous::cli
