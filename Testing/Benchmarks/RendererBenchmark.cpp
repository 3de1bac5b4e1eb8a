#include "RendererBenchmark.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <map>
#include <memory>
#include <utility>

#include <Eigen/Geometry>

#include "OwnPicture.h"
#include "ParaViewPeer.h"
#include "PeerPicture.h"
#include "RendererAccuracy.h"
#include "RendererBenchmarkScenes.h"
#include "RendererFeatures.h"
#include "TimedView.h"
#include "petrous/Dissection/SweptSphereCut.h"
#include "petrous/Rendering/ReferenceRayCaster.h"
#include "petrous/Rendering/ScenePicture.h"

namespace petrous::cli
{

namespace
{

using rendering::OwnPicture;
using rendering::Peer;
using rendering::RenderStatistics;
using rendering::TimedView;

// Time limits for further frames: of a peer, excluding its first one; of both eyes.
constexpr double kPeerSeconds = 5.0;
constexpr double kStereoSeconds = 40.0;
constexpr double kMovingSeconds = 20.0;
constexpr double kMovingRate = 30.0; // Hz, that is wanted of what moves

// Amount of measurement.
struct Extent
{
  std::vector<int> edges{256, 512};
  PictureSize picture{640, 480};
  PictureSize errorPicture{320, 240};
  PictureSize featurePicture{160, 120}; // of which errors are known: shadows take 320 rays a pixel
  PictureSize stereoPicture{1920, 1080};
  int frames = 9;
  int peerFrames = 3; // fewer if one takes seconds
  int edits = 40;
  int turns = 80; // camera steps during the motion
};

Extent extentOf(const RendererBenchmarkOptions& options)
{
  Extent extent;
  if (options.quick)
    extent = {{96}, {160, 120}, {80, 60}, {40, 30}, {320, 180}, 1, 1, 5, 4};
  if (!options.edges.empty())
    extent.edges = options.edges;
  return extent;
}

std::string sceneName(const BenchmarkPatient& patient, BenchmarkView view, BenchmarkLook look)
{
  return patient.name + ", " + nameOf(view) + ", " + nameOf(look);
}

core::BenchmarkPoint pointOf(const std::string& scene, const PictureSize& size,
                             const TimedView::Timing& timing)
{
  core::BenchmarkPoint point;
  point.scene = scene;
  point.setting["picture"] = shown(size);
  point.seconds = timing.median;
  point.error = std::numeric_limits<double>::quiet_NaN();
  point.extra["first_frame_ms"] = 1e3 * timing.first;
  point.extra["frames"] = timing.frames;
  return point;
}

// Adds the fetches at default quality in this scene, from a separate frame.
void enterCounts(TimedView& view, OwnPicture& own, double pixels, core::BenchmarkPoint& point)
{
  own.setCounting(true);
  view.frame();
  const RenderStatistics& statistics = own.statistics();
  std::string variant;
  for (const std::string& feature : statistics.variant)
    variant += (variant.empty() ? "" : " ") + feature;
  point.setting["variant"] = variant;
  point.extra["fetches_per_pixel"] = statistics.fetchesPerPixel;
  point.extra["samples_per_pixel"] = statistics.samplesPerPixel;
  point.extra["giga_fetches_per_s"] = 1e-9 * statistics.fetchesPerPixel * pixels / point.seconds;
  own.setCounting(false);
}

// The camera at a step of a swing about its focal point, which ends where it began.
core::CameraPose swung(const core::CameraPose& middle, int step, int steps)
{
  constexpr double swing = 0.5; // rad to either side
  const double angle = swing * std::sin(2.0 * std::acos(-1.0) * step / steps);
  core::CameraPose pose = middle;
  pose.position = middle.focalPoint + Eigen::AngleAxisd(angle, middle.viewUp.normalized()) *
                                          (middle.position - middle.focalPoint).eval();
  return pose;
}

// RMS of all pixels' colour against a reference of the same size, 1/255.
double rmsOf(const rendering::Picture& picture, const std::vector<float>& truth)
{
  double squares = 0.0;
  for (std::size_t n = 0; n < truth.size(); ++n)
    squares += std::pow(picture.rgb.at(n) - 255.0 * static_cast<double>(truth[n]), 2);
  return std::sqrt(squares / static_cast<double>(truth.size()));
}

class Run
{
public:
  Run(const RendererBenchmarkOptions& options, core::BenchmarkReport& report)
    : m_extent(extentOf(options))
    , m_view(m_extent.picture.width, m_extent.picture.height)
    , m_report(report)
  {
    report.machine["gl_renderer"] = m_view.glRenderer();
    report.machine["gl_version"] = m_view.glVersion();
  }

  const Extent& extent() const { return m_extent; }
  void frames(const BenchmarkPatient& patient, const core::Progress& progress);
  void sweep(const BenchmarkPatient& patient, const core::Progress& progress);
  void stereo(const BenchmarkPatient& patient);
  void edits(const BenchmarkPatient& patient, bool shadows);
  void interaction(const BenchmarkPatient& patient, const core::Progress& progress);
  void softTissue(const BenchmarkPatient& patient, bool isLit, const core::Progress& progress);
  void features(const BenchmarkPatient& patient, const core::Progress& progress);

private:
  void scene(const BenchmarkPatient& patient, BenchmarkView view, BenchmarkLook look,
             const core::Progress& progress);

  Extent m_extent;
  TimedView m_view;
  core::BenchmarkReport& m_report;
};

void Run::frames(const BenchmarkPatient& patient, const core::Progress& progress)
{
  constexpr BenchmarkLook looks[] = {BenchmarkLook::Translucent, BenchmarkLook::Opaque,
                                     BenchmarkLook::CtAlone};
  double done = 0.0;
  for (const BenchmarkView view : {BenchmarkView::Head, BenchmarkView::Near})
    for (const BenchmarkLook look : looks)
    {
      scene(patient, view, look, progress.part(done / 6.0, (done + 1.0) / 6.0));
      done += 1.0;
    }
}

void Run::scene(const BenchmarkPatient& patient, BenchmarkView view, BenchmarkLook look,
                const core::Progress& progress)
{
  const auto contents = contentsOf(patient, look);
  const auto camera = cameraOf(patient, view);
  const std::string name = sceneName(patient, view, look);
  core::BenchmarkPoint ours;
  progress.report(0.0, name);
  TimedView::Timing early;
  {
    OwnPicture own(contents, camera);
    m_view.show(own);
    early = m_view.time(m_extent.frames);
  }
  std::vector<Peer> peers{Peer::CpuFixedPoint, Peer::GpuComposite};
  if (look != BenchmarkLook::CtAlone)
    peers.push_back(Peer::GpuLabelMap);
  if (look == BenchmarkLook::Translucent)
    peers.push_back(Peer::GpuMulti);
  std::vector<core::BenchmarkPoint> theirs;
  for (const Peer peer : peers)
  {
    progress.report(0.1 + 0.1 * static_cast<double>(theirs.size()), name + ": " + nameOf(peer));
    rendering::PeerPicture picture(peer, contents, camera);
    m_view.show(picture);
    auto point = pointOf(name, m_extent.picture, m_view.time(m_extent.peerFrames, kPeerSeconds));
    point.peer = nameOf(peer);
    point.setting["step_voxels"] = "0.5";
    point.errorUnit = "none: other optics than ours";
    theirs.push_back(std::move(point));
  }
  {
    // Again after the peers: the mean of both compensates for background load in between.
    OwnPicture own(contents, camera);
    m_view.show(own);
    TimedView::Timing late = m_view.time(m_extent.frames);
    late.first = early.first;
    late.median = 0.5 * (early.median + late.median);
    late.frames += early.frames;
    ours = pointOf(name, m_extent.picture, late);
    ours.isDefault = true;
    enterCounts(m_view, own, 1.0 * m_extent.picture.width * m_extent.picture.height, ours);
  }
  for (core::BenchmarkPoint& point : theirs)
    point.extra["times_ours"] = point.seconds / ours.seconds;
  const SceneTruth truth(contents, camera, m_extent.errorPicture, progress.part(0.6, 1.0));
  truth.enter({}, ours);
  ours.setting["error_picture"] = shown(m_extent.errorPicture);
  m_report.points.push_back(std::move(ours));
  m_report.points.insert(m_report.points.end(), theirs.begin(), theirs.end());
}

void Run::sweep(const BenchmarkPatient& patient, const core::Progress& progress)
{
  const auto contents = contentsOf(patient, BenchmarkLook::Translucent);
  const auto camera = cameraOf(patient, BenchmarkView::Near);
  const std::string name = sceneName(patient, BenchmarkView::Near, BenchmarkLook::Translucent);
  const SceneTruth truth(contents, camera, m_extent.errorPicture, progress.part(0.0, 0.3));
  const auto points =
      sweepQuality(contents, camera, truth, name, m_view, m_extent.frames, progress.part(0.3, 1.0));
  m_report.points.insert(m_report.points.end(), points.begin(), points.end());
}

// Both eyes of a microscope, 24 mm apart at the working distance.
void Run::stereo(const BenchmarkPatient& patient)
{
  const auto contents = contentsOf(patient, BenchmarkLook::Translucent);
  const core::CameraPose middle = cameraOf(patient, BenchmarkView::Near);
  const Eigen::Vector3d right =
      (middle.focalPoint - middle.position).cross(middle.viewUp).normalized();
  // The working distance of 250 mm is scaled to the camera's, and so is the eye separation.
  const double apart = 24.0 * (middle.focalPoint - middle.position).norm() / 250.0;
  core::CameraPose eyes[2] = {middle, middle};
  eyes[0].position -= 0.5 * apart * right;
  eyes[1].position += 0.5 * apart * right;

  OwnPicture own(contents, middle);
  const PictureSize& size = m_extent.stereoPicture;
  TimedView view(size.width, size.height);
  view.show(own);
  TimedView::Timing timing;
  std::vector<double> seconds;
  double sum = 0.0;
  for (int n = 0;
       n < 2 || (n <= m_extent.peerFrames && sum < kStereoSeconds) || (sum < 1.0 && n < 200); ++n)
  {
    double both = 0.0;
    for (const core::CameraPose& eye : eyes)
    {
      own.setCamera(eye);
      both += view.frame(false);
    }
    if (n == 0)
      timing.first = both;
    seconds.push_back(both);
    sum += both;
  }
  if (seconds.size() > 1)
    seconds.erase(seconds.begin()); // includes the uploads
  std::sort(seconds.begin(), seconds.end());
  timing.median = seconds[seconds.size() / 2];
  timing.frames = static_cast<int>(seconds.size());
  auto point =
      pointOf(patient.name + ", stereo near, " + nameOf(BenchmarkLook::Translucent), size, timing);
  point.setting["picture"] = "2x" + shown(size);
  point.isDefault = true;
  point.errorUnit = "not measured at this size";
  enterCounts(view, own, 2.0 * size.width * size.height, point);
  point.extra["hertz"] = 1.0 / timing.median;
  m_report.points.push_back(std::move(point));
}

// With shadows, what stops the light is measured anew about each edit.
void Run::edits(const BenchmarkPatient& patient, bool shadows)
{
  auto contents = contentsOf(patient, BenchmarkLook::Translucent);
  contents.light.setShadows(shadows);
  const auto camera = cameraOf(patient, BenchmarkView::Near);
  const auto mask = std::make_shared<volume::CutMask>(*patient.mask);
  contents.mask = mask;
  OwnPicture own(contents, camera);
  m_view.show(own);
  m_view.frame();
  // In voxels, the size of a 4 mm burr at 0.3 mm.
  const double radius = 0.5 * 4.0 / 0.3 * patient.ct->geometry().minSpacing();
  std::vector<double> cutMs, undoMs;
  const auto show = [&](const std::vector<std::size_t>& bricks, std::vector<double>& milliseconds)
  {
    mask->takeDirty();
    const auto start = std::chrono::steady_clock::now();
    own.maskChanged(mask, mask->boxOf(bricks));
    const std::chrono::duration<double, std::milli> marking =
        std::chrono::steady_clock::now() - start;
    m_view.frame();
    milliseconds.push_back(marking.count() + own.statistics().editMilliseconds);
  };
  for (int n = 0; n < m_extent.edits; ++n)
  {
    // Around the floor of the cavity, where there is still bone to remove.
    const double angle = 0.7 * n;
    const Eigen::Vector3d center = patient.entry - (5.0 + 0.05 * n) * patient.lateral +
                                   4.0 * Eigen::Vector3d(0.0, std::cos(angle), std::sin(angle));
    const volume::CutMask before = *mask;
    const auto bricks = dissection::cut(*mask, {center, center, radius});
    if (bricks.empty())
      continue;
    show(bricks, cutMs);
    if (n % 2 == 0)
      continue;
    for (const std::size_t brick : bricks)
      mask->setBrick(brick, before.brick(brick));
    show(bricks, undoMs);
  }
  const rendering::Picture edited = m_view.picture();
  OwnPicture anew(contents, camera);
  m_view.show(anew);
  m_view.frame();
  for (auto* milliseconds : {&cutMs, &undoMs})
  {
    if (milliseconds->empty())
      continue;
    std::sort(milliseconds->begin(), milliseconds->end());
    core::BenchmarkPoint point;
    point.scene = patient.name + (milliseconds == &cutMs ? ", cut" : ", undo") +
                  " of a 4 mm burr at 0.3 mm voxels" + (shadows ? ", shadows" : "");
    point.isDefault = true;
    point.seconds = 1e-3 * (*milliseconds)[milliseconds->size() / 2];
    point.error = static_cast<double>(rendering::countDifferentPixels(edited, m_view.picture()));
    point.errorUnit = "pixels that differ from a picture made anew";
    point.setting["picture"] = shown(m_extent.picture);
    point.extra["slowest_ms"] = milliseconds->back();
    point.extra["edits"] = static_cast<double>(milliseconds->size());
    m_report.points.push_back(std::move(point));
  }
}

// The camera swings about its focal point, with the picture coarsened as in interactive windows.
// All frames count except the first, which is at full quality and from which the machine's speed is
// estimated.
void Run::interaction(const BenchmarkPatient& patient, const core::Progress& progress)
{
  double done = 0.0;
  for (const BenchmarkView view : {BenchmarkView::Head, BenchmarkView::Near})
    for (const BenchmarkLook look : {BenchmarkLook::Translucent, BenchmarkLook::Opaque})
    {
      const std::string name = patient.name + ", interactive " + nameOf(view) + ", " + nameOf(look);
      progress.report(done / 4.0, name);
      done += 1.0;
      const core::CameraPose middle = cameraOf(patient, view);
      rendering::ScenePicture scene;
      scene.setContents(contentsOf(patient, look));
      scene.setCamera(middle);
      m_view.show(scene);
      TimedView::Timing timing;
      timing.first = m_view.frame(false); // at full quality
      scene.setInteractive(true);
      timing.frames = m_extent.turns;
      std::vector<double> seconds;
      double scale = 1.0;
      for (int n = 0; n < timing.frames; ++n)
      {
        scene.setCamera(swung(middle, n + 1, timing.frames));
        seconds.push_back(m_view.frame(false));
        scale = std::min(scale, 1.0 * scene.depth().width / m_extent.picture.width);
      }
      std::sort(seconds.begin(), seconds.end());
      timing.median = seconds[seconds.size() / 2];
      auto point = pointOf(name, m_extent.picture, timing);
      point.isDefault = true;
      point.errorUnit = "not measured while it moves";
      point.extra["hertz"] = 1.0 / timing.median;
      point.extra["slowest_hertz"] = 1.0 / seconds.back();
      point.extra["smallest_scale"] = scale;
      m_report.points.push_back(std::move(point));
    }
}

// Soft tissue alone: at rest, and while the camera swings as in a window, each program with its own
// adjustment. The error while it moves is that of a further frame where the swing ends. In light
// without direction (not `isLit`) all programs have the same optics.
void Run::softTissue(const BenchmarkPatient& patient, bool isLit, const core::Progress& progress)
{
  const rendering::SceneContents contents = softTissueOf(patient, isLit);
  const core::CameraPose middle = cameraOf(patient, BenchmarkView::Head);
  const PictureSize& size = m_extent.picture;
  const std::string name = patient.name + ", head, soft tissue alone" + (isLit ? ", lit" : "");
  progress.report(0.0, name);
  const std::vector<float> truth =
      rendering::ReferenceRayCaster(contents)
          .render(middle, size.width, size.height, progress.part(0.0, 0.5))
          .rgb;
  TimedView view(size.width, size.height); // of its own: peers change its rate
  std::map<std::string, double> ourSeconds;
  const auto enter =
      [&](const std::string& scene, const TimedView::Timing& timing, const std::string& peer)
  {
    auto point = pointOf(scene, size, timing);
    point.peer = peer;
    point.isDefault = peer.empty();
    if (isLit && !peer.empty())
    {
      point.errorUnit = "none: other optics than ours";
    }
    else
    {
      point.error = rmsOf(view.picture(), truth);
      point.errorUnit = "1/255, RMS of colour of all pixels";
    }
    // The peers' at rest and moving over ours, which come first.
    double& ours = ourSeconds[scene];
    if (peer.empty())
      ours = timing.median;
    else
      point.extra["times_ours"] = timing.median / ours;
    m_report.points.push_back(std::move(point));
    return &m_report.points.back();
  };
  const auto moving = [&](auto& picture)
  {
    TimedView::Timing timing;
    timing.first = view.frame(false); // from which its speed is estimated
    std::vector<double> seconds;
    double sum = 0.0;
    for (int n = 0; n < m_extent.turns && (n == 0 || sum < kMovingSeconds); ++n)
    {
      picture.setCamera(swung(middle, n + 1, m_extent.turns));
      seconds.push_back(view.frame(false));
      sum += seconds.back();
    }
    std::sort(seconds.begin(), seconds.end());
    timing.median = seconds[seconds.size() / 2];
    timing.frames = static_cast<int>(seconds.size());
    picture.setCamera(middle);
    view.frame(); // read back
    return std::pair{timing, 1.0 / seconds.back()};
  };
  const auto enterMoving =
      [&](const std::pair<TimedView::Timing, double>& moved, const std::string& peer)
  {
    core::BenchmarkPoint* point = enter(name + ", moving", moved.first, peer);
    point->extra["hertz"] = 1.0 / moved.first.median;
    point->extra["slowest_hertz"] = moved.second;
    return point;
  };
  {
    OwnPicture own(contents, middle);
    view.show(own);
    core::BenchmarkPoint* point = enter(name, view.time(m_extent.frames, kMovingSeconds), {});
    enterCounts(view, own, 1.0 * size.width * size.height, *point);
  }
  {
    rendering::ScenePicture scene;
    scene.setContents(contents);
    scene.setCamera(middle);
    view.show(scene);
    view.frame(false); // at full quality, with the uploads
    scene.setInteractionRate(kMovingRate);
    scene.setInteractive(true);
    const auto moved = moving(scene);
    enterMoving(moved, {})->extra["scale"] = 1.0 * scene.depth().width / size.width;
  }
  double done = 0.5;
  for (const Peer peer : {Peer::SmartGpu, Peer::SmartCpu})
  {
    progress.report(done, name + ": " + nameOf(peer));
    done += 0.25;
    rendering::PeerPicture picture(peer, contents, middle);
    view.show(picture);
    enter(name, view.time(m_extent.peerFrames, kPeerSeconds), nameOf(peer));
    picture.setUpdateRate(kMovingRate);
    enterMoving(moving(picture), nameOf(peer));
    constexpr double kAtRest = 0.0001; // Hz, of a new window
    picture.setUpdateRate(kAtRest);
  }
}

void Run::features(const BenchmarkPatient& patient, const core::Progress& progress)
{
  const auto points = featurePoints(
      patient, {m_extent.picture, m_extent.featurePicture, m_extent.frames}, progress);
  m_report.points.insert(m_report.points.end(), points.begin(), points.end());
}

} // namespace

const std::vector<std::string>& rendererParts()
{
  static const std::vector<std::string> parts{"frames",   "interaction", "sweep",
                                              "features", "stereo",      "edits",
                                              "soft",     "paraview",    "shapes"};
  return parts;
}

core::BenchmarkReport runRendererBenchmark(const RendererBenchmarkOptions& options,
                                           const core::Progress& progress)
{
  core::BenchmarkReport report{"renderer", "Volume renderer: a frame's time against its error", {}};
  const auto wants = [&](const char* part)
  { return options.parts.empty() || options.parts.count(part) != 0; };
  Run run(options, report);
  const auto& edges = run.extent().edges;
  const double parts = static_cast<double>(edges.size()) + 1.0;
  for (std::size_t n = 0; n < edges.size(); ++n)
  {
    const auto part =
        progress.part(static_cast<double>(n) / parts, static_cast<double>(n + 1) / parts);
    const BenchmarkPatient patient = phantomPatient(edges[n], part.part(0.0, 0.1));
    if (wants("frames"))
      run.frames(patient, part.part(0.1, 0.7));
    if (n == 0)
    {
      if (wants("interaction"))
        run.interaction(patient, part.part(0.7, 0.72));
      if (wants("sweep"))
        run.sweep(patient, part.part(0.72, 0.8));
      if (wants("features"))
        run.features(patient, part.part(0.8, 0.9));
    }
    if (n + 1 == edges.size())
    {
      if (wants("stereo"))
        run.stereo(patient);
      if (wants("edits"))
        for (const bool shadows : {false, true})
          run.edits(patient, shadows);
      if (wants("soft"))
      {
        run.softTissue(patient, false, part.part(0.9, 0.925));
        run.softTissue(patient, true, part.part(0.925, 0.95));
      }
      if (wants("paraview"))
      {
        const Extent& extent = run.extent();
        const auto points = paraViewPoints(
            patient,
            {options.paraview, options.work, extent.picture, extent.peerFrames, kPeerSeconds},
            report.machine, part.part(0.95, 1.0));
        report.points.insert(report.points.end(), points.begin(), points.end());
      }
    }
  }
  const auto part = progress.part(1.0 - 1.0 / parts, 1.0);
  if (!wants("frames") && !wants("sweep"))
    report.machine["real_data"] = "left out by --part";
  else if (const auto patient = realPatient(options.data, part.part(0.0, 0.1)))
  {
    if (wants("frames"))
      run.frames(*patient, part.part(0.1, 0.8));
    if (wants("sweep"))
      run.sweep(*patient, part.part(0.8, 1.0));
  }
  else
    report.machine["real_data"] =
        options.data.empty() ? "no --data given: the phantom alone" : "no CT found below --data";
  if (wants("shapes"))
  {
    const auto shapes = shapeDepths(run.extent().errorPicture);
    report.points.insert(report.points.end(), shapes.begin(), shapes.end());
  }
  return report;
}

} // namespace petrous::cli
