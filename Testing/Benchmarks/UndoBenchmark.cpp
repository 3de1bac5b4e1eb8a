#include "UndoBenchmark.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <memory>

#include "OwnPicture.h"
#include "RendererBenchmarkScenes.h"
#include "TimedView.h"
#include "petrous/Dissection/Dissection.h"
#include "petrous/Rendering/Picture.h"

namespace petrous::cli
{

namespace
{

using Clock = std::chrono::steady_clock;

// In voxels, from sizes at 0.15 mm.
constexpr double kRadius = 2.0 / 0.15;
constexpr double kLength = 15.0 / 0.15;

double secondsSince(Clock::time_point start)
{
  return std::chrono::duration<double>(Clock::now() - start).count();
}

double medianOf(std::vector<double> values)
{
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

// Along the floor of the cavity, half embedded in it.
void drill(dissection::Dissection& work, const BenchmarkPatient& patient, double length)
{
  const double h = patient.ct->geometry().minSpacing();
  constexpr int steps = 30;
  const auto at = [&](int step) -> Eigen::Vector3d
  {
    const double way = length * h * (static_cast<double>(step) / steps - 0.5);
    return patient.entry - 6.0 * patient.lateral +
           Eigen::Vector3d(0.3 * std::sin(way), way, 0.2 * way);
  };
  work.beginStroke({});
  for (int step = 0; step < steps; ++step)
    work.cut({at(step), at(step + 1), kRadius * h});
  work.endStroke();
}

// Times of undo or redo steps.
struct Steps
{
  std::vector<double> mask, upload, frame, all; // s
};

} // namespace

std::vector<core::BenchmarkPoint> undoWithRedraw(bool quick, const core::Progress& progress)
{
  const int width = quick ? 160 : 640, height = quick ? 120 : 480;
  const int rounds = quick ? 3 : 11;
  const BenchmarkPatient patient = phantomPatient(quick ? 96 : 512, progress.part(0.0, 0.7));
  // The cavity is the first stroke; the second one is undone.
  dissection::Dissection work(patient.ct->geometry());
  for (std::size_t n = 0; n < patient.mask->brickCount(); ++n)
    if (const auto& brick = patient.mask->brick(n))
      work.mask().setBrick(n, brick);
  drill(work, patient, quick ? 20.0 : kLength);
  const auto shown = std::make_shared<volume::CutMask>(std::as_const(work).mask());
  auto contents = contentsOf(patient, BenchmarkLook::Translucent);
  contents.mask = shown;
  const auto camera = cameraOf(patient, BenchmarkView::Near);
  rendering::TimedView view(width, height);
  rendering::OwnPicture own(contents, camera);
  view.show(own);
  view.frame();
  work.mask().takeDirty();

  Steps undo, redo;
  double bricks = 0.0;
  for (int round = 0; round < rounds; ++round)
    for (Steps* steps : {&undo, &redo})
    {
      progress.report(0.7 + 0.3 * round / rounds, "undo and redraw");
      const auto start = Clock::now();
      steps == &undo ? work.undo() : work.redo();
      steps->mask.push_back(secondsSince(start));
      const auto changed = work.mask().takeDirty();
      for (const std::size_t brick : changed)
        shown->setBrick(brick, std::as_const(work).mask().brick(brick));
      shown->takeDirty();
      own.maskChanged(shown, shown->boxOf(changed));
      const double frame = view.frame(false);
      const double upload = 1e-3 * own.statistics().editMilliseconds;
      steps->all.push_back(secondsSince(start));
      steps->upload.push_back(upload);
      steps->frame.push_back(frame - upload);
      bricks = static_cast<double>(changed.size());
    }
  view.frame();
  const rendering::Picture stepped = view.picture();
  rendering::OwnPicture anew(contents, camera);
  view.show(anew);
  view.frame();
  const auto different =
      static_cast<double>(rendering::countDifferentPixels(stepped, view.picture()));

  std::vector<core::BenchmarkPoint> points;
  for (const Steps* steps : {&undo, &redo})
  {
    core::BenchmarkPoint point;
    point.scene = std::string(steps == &undo ? "undo" : "redo") +
                  " of such a stroke and its redraw, " + patient.name;
    point.setting["strokes"] = "1, redrawn";
    point.setting["gl_renderer"] = view.glRenderer();
    point.setting["picture"] = std::to_string(width) + "x" + std::to_string(height);
    point.seconds = medianOf(steps->all);
    point.error = different;
    point.errorUnit = "pixels that differ from a picture made anew";
    point.extra["mask_ms"] = 1e3 * medianOf(steps->mask);
    point.extra["upload_ms"] = 1e3 * medianOf(steps->upload);
    point.extra["frame_ms"] = 1e3 * medianOf(steps->frame);
    point.extra["slowest_ms"] = 1e3 * *std::max_element(steps->all.begin(), steps->all.end());
    point.extra["bricks"] = bricks;
    points.push_back(std::move(point));
  }
  return points;
}

} // namespace petrous::cli
