#include "SegmentBenchmark.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include <itkBinaryBallStructuringElement.h>
#include <itkBinaryDilateImageFilter.h>
#include <itkBinaryErodeImageFilter.h>
#include <itkBinaryFillholeImageFilter.h>
#include <itkBinaryThresholdImageFilter.h>
#include <itkCastImageFilter.h>
#include <itkConnectedComponentImageFilter.h>
#include <itkConnectedThresholdImageFilter.h>
#include <itkImportImageFilter.h>
#include <itkMultiThreaderBase.h>
#include <itkRelabelComponentImageFilter.h>
#include <itkSignedMaurerDistanceMapImageFilter.h>
#include <itkSmoothingRecursiveGaussianImageFilter.h>

#include "petrous/Core/SplitMix64.h"
#include "petrous/Segmentation/MaskOperations.h"

namespace petrous::segmentation
{

namespace
{

using Clock = std::chrono::steady_clock;
using Eigen::Vector3d;
using Labels = itk::Image<std::uint8_t, 3>;
using Image = itk::Image<std::int16_t, 3>;
using Distances = itk::Image<float, 3>;

constexpr double kPi = 3.14159265358979323846;
constexpr std::uint64_t kVoxelsOfNoise = 997; // of so many, one is bone that belongs to nothing

struct Ball
{
  Vector3d center; ///< mm
  double radius;   ///< mm
};
using Balls = std::vector<Ball>;

/// Signed distance from balls that do not meet, negative inside.
double distanceFrom(const Balls& balls, const Vector3d& p)
{
  double nearest = 1e30;
  for (const Ball& ball : balls)
    nearest = std::min(nearest, (p - ball.center).norm() - ball.radius);
  return nearest;
}

/// Uniform in (0, 1), from a voxel's number.
double fraction(std::uint64_t n)
{
  return (static_cast<double>(core::splitMix64(n) >> 11) + 0.5) / 9007199254740992.0;
}

/// Balls of 1000 HU with the partial volume of a flat border, in 0, with noise.
std::shared_ptr<const volume::Volume<std::int16_t>>
imageOf(const core::GridGeometry& grid, const Balls& balls, double noise, bool specks = false)
{
  auto image = std::make_shared<volume::Volume<std::int16_t>>(grid);
  const double h = std::cbrt(grid.voxelVolume());
  for (int k = 0; k < grid.dims()[2]; ++k)
    for (int j = 0; j < grid.dims()[1]; ++j)
      for (int i = 0; i < grid.dims()[0]; ++i)
      {
        const auto n = static_cast<std::uint64_t>(grid.linearIndex(i, j, k));
        const double d = distanceFrom(balls, grid.patientFromVoxel(Vector3d(i, j, k)));
        double value = 1000.0 * std::clamp(0.5 - d / h, 0.0, 1.0);
        if (specks && d > 2.0 * h && core::splitMix64(n) % kVoxelsOfNoise == 0)
          value = 1000.0;
        if (noise > 0.0) // Box and Muller
          value += noise * std::sqrt(-2.0 * std::log(fraction(2 * n))) *
                   std::cos(2.0 * kPi * fraction(2 * n + 1));
        image->at(i, j, k) = static_cast<std::int16_t>(std::lround(value));
      }
  return image;
}

struct Errors
{
  double surface = 0.0; ///< mm
  double volume = 0.0;  ///< %
};

Errors errorsOf(const std::uint8_t* voxels, const core::GridGeometry& grid, const Balls& truth)
{
  const core::Index3 dims = grid.dims();
  double distance = 0.0;
  std::uint64_t faces = 0;
  std::uint64_t count = 0;
  for (int k = 0; k < dims[2]; ++k)
    for (int j = 0; j < dims[1]; ++j)
      for (int i = 0; i < dims[0]; ++i)
      {
        const core::Index3 index{i, j, k};
        const bool isIn = voxels[grid.linearIndex(i, j, k)] != 0;
        count += isIn;
        for (std::size_t a = 0; a < 3; ++a)
        {
          core::Index3 next = index;
          if (++next[a] == dims[a] ||
              (voxels[grid.linearIndex(next[0], next[1], next[2])] != 0) == isIn)
            continue;
          ++faces;
          const Vector3d middle = 0.5 * Vector3d(i + next[0], j + next[1], k + next[2]);
          distance += std::abs(distanceFrom(truth, grid.patientFromVoxel(middle)));
        }
      }
  double wanted = 0.0;
  for (const Ball& ball : truth)
    wanted += 4.0 / 3.0 * kPi * std::pow(ball.radius, 3);
  return {distance / static_cast<double>(std::max<std::uint64_t>(faces, 1)),
          100.0 * std::abs(static_cast<double>(count) * grid.voxelVolume() - wanted) / wanted};
}

double median(std::vector<double> values)
{
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

double secondsOf(const std::function<void()>& work)
{
  const Clock::time_point start = Clock::now();
  work();
  return std::chrono::duration<double>(Clock::now() - start).count();
}

/// Shows voxels of ours to ITK; they are not copied.
template <class T>
typename itk::Image<T, 3>::Pointer shown(const volume::Volume<T>& volume)
{
  using Import = itk::ImportImageFilter<T, 3>;
  auto import = Import::New();
  typename Import::SizeType size;
  std::array<double, 3> spacing;
  std::array<double, 3> origin;
  for (unsigned a = 0; a < 3; ++a)
  {
    size[a] = static_cast<itk::SizeValueType>(volume.geometry().dims()[a]);
    spacing[a] = volume.geometry().spacing()[a];
    origin[a] = volume.geometry().origin()[a];
  }
  import->SetRegion(typename Import::RegionType(size));
  import->SetSpacing(spacing.data());
  import->SetOrigin(origin.data());
  import->SetImportPointer(const_cast<T*>(volume.data()), volume.size(), false);
  import->Update();
  return import->GetOutput();
}

template <class Filter>
typename Filter::OutputImageType::Pointer run(Filter& filter)
{
  filter.Update();
  typename Filter::OutputImageType::Pointer output = filter.GetOutput();
  output->DisconnectPipeline();
  return output;
}

template <class Input>
Labels::Pointer thresholded(const Input* image, double lower, double upper)
{
  auto filter = itk::BinaryThresholdImageFilter<Input, Labels>::New();
  filter->SetInput(image);
  filter->SetLowerThreshold(static_cast<typename Input::PixelType>(lower));
  filter->SetUpperThreshold(static_cast<typename Input::PixelType>(upper));
  filter->SetInsideValue(1);
  filter->SetOutsideValue(0);
  return run(*filter);
}

struct Peer
{
  std::string filter;
  std::function<Labels::Pointer()> work;
  std::string program = "ITK";
};

class Trials
{
public:
  Trials(bool quick, core::BenchmarkReport& report)
    : m_rounds(quick ? 3 : 5)
    , m_report(report)
  {
  }

  void measure(const std::string& scene, const core::GridGeometry& grid, const Balls& truth,
               const std::function<Mask()>& ours, const std::vector<Peer>& peers)
  {
    const unsigned cores = std::max(1U, std::thread::hardware_concurrency());
    std::vector<unsigned> threads{1};
    if (cores > 1)
      threads.push_back(cores);
    std::vector<double> own;
    std::vector<std::vector<double>> theirs(peers.size() * threads.size());
    Mask mask;
    std::vector<Labels::Pointer> images(peers.size());
    for (int round = -1; round < m_rounds; ++round) // the first warms up
    {
      const double seconds = secondsOf([&] { mask = ours(); });
      if (round >= 0)
        own.push_back(seconds);
      for (std::size_t n = 0; n < theirs.size(); ++n)
      {
        itk::MultiThreaderBase::SetGlobalDefaultNumberOfThreads(threads[n % threads.size()]);
        const std::size_t p = n / threads.size();
        const double time = secondsOf([&] { images[p] = peers[p].work(); });
        if (round >= 0)
          theirs[n].push_back(time);
      }
    }
    itk::MultiThreaderBase::SetGlobalDefaultNumberOfThreads(cores);
    add(scene, {}, median(own), errorsOf(mask.voxels->data(), grid, truth), 0.0);
    for (std::size_t p = 0; p < peers.size(); ++p)
    {
      std::size_t best = p * threads.size();
      for (std::size_t n = best; n < (p + 1) * threads.size(); ++n)
        if (median(theirs[n]) < median(theirs[best]))
          best = n;
      add(scene, peers[p], median(theirs[best]),
          errorsOf(images[p]->GetBufferPointer(), grid, truth), threads[best % threads.size()]);
    }
  }

private:
  void add(const std::string& scene, const std::optional<Peer>& peer, double seconds,
           const Errors& errors, double threads)
  {
    core::BenchmarkPoint point;
    point.scene = scene;
    point.isDefault = !peer;
    if (peer)
    {
      point.peer = peer->program;
      point.setting["filter"] = peer->filter;
      point.extra["threads"] = threads;
    }
    point.seconds = seconds;
    point.error = errors.surface;
    point.errorUnit = "mm, mean distance from the surface";
    point.extra["volume_percent"] = errors.volume;
    m_report.points.push_back(point);
  }

  int m_rounds;
  core::BenchmarkReport& m_report;
};

Balls grownBy(Balls balls, double distance)
{
  for (Ball& ball : balls)
    ball.radius += distance;
  return balls;
}

void measureOperations(bool quick, const core::Progress& progress, core::BenchmarkReport& report)
{
  Trials trials(quick, report);
  const int edge = quick ? 96 : 256;
  const std::string size = ", " + std::to_string(edge) + "^3";
  const core::GridGeometry grid({edge, edge, edge}, Vector3d(0.4, 0.4, 0.5),
                                Vector3d(-20.0, 10.0, 30.0));
  const double width = 0.4 * edge;
  const Vector3d c = grid.center();
  const Ball large{c + Vector3d(0.13, -0.21, 0.17), 0.3 * width};
  Balls balls{large};
  for (const double side : {-1.0, 1.0})
    balls.push_back({c + side * Vector3d(0.38, 0.36, 0.38) * width, 0.07 * width});
  const volume::ValueRange bone{500.0, 3000.0};

  const auto voxels = imageOf(grid, balls, 50.0);
  const volume::IntensityVolume image(voxels);
  const Image::Pointer peerImage = shown(*voxels);
  trials.measure("threshold" + size, grid, balls, [&] { return threshold(image, bone); },
                 {{"itk::BinaryThreshold",
                   [&] { return thresholded(peerImage.GetPointer(), bone.min, bone.max); }}});
  progress.report(0.1, "measure threshold");

  trials.measure("connected region" + size, grid, {large},
                 [&] { return connectedThreshold(image, bone, {large.center}); },
                 {{"itk::ConnectedThreshold", [&]
                   {
                     auto filter = itk::ConnectedThresholdImageFilter<Image, Labels>::New();
                     filter->SetInput(peerImage);
                     filter->SetLower(static_cast<std::int16_t>(bone.min));
                     filter->SetUpper(static_cast<std::int16_t>(bone.max));
                     filter->SetReplaceValue(1);
                     Image::IndexType seed;
                     Image::PointType point;
                     for (unsigned a = 0; a < 3; ++a)
                       point[a] = large.center[a];
                     peerImage->TransformPhysicalPointToIndex(point, seed);
                     filter->SetSeed(seed);
                     return run(*filter);
                   }}});
  progress.report(0.2, "measure connected regions");

  const auto speckled = imageOf(grid, balls, 50.0, true);
  const Mask many = threshold(volume::IntensityVolume(speckled), bone);
  const Labels::Pointer peerMany = shown(*many.voxels);
  const auto relabelled = [&](std::uint64_t least)
  {
    using Numbers = itk::Image<std::uint32_t, 3>;
    auto components = itk::ConnectedComponentImageFilter<Labels, Numbers>::New();
    components->SetInput(peerMany);
    auto relabel = itk::RelabelComponentImageFilter<Numbers, Numbers>::New();
    relabel->SetInput(components->GetOutput());
    relabel->SetMinimumObjectSize(least);
    relabel->Update();
    return Numbers::Pointer(relabel->GetOutput());
  };
  trials.measure(
      "largest island of " + std::to_string(many.count) + " voxels" + size, grid, {large},
      [&] { return largestIsland(many); },
      {{"itk::RelabelComponent", [&] { return thresholded(relabelled(0).GetPointer(), 1, 1); }}});
  const double least = 1.0; // mm^3
  trials.measure("without islands under 1 mm^3" + size, grid, balls,
                 [&] { return withoutSmallIslands(many, least); },
                 {{"itk::RelabelComponent", [&]
                   {
                     const auto fewest =
                         static_cast<std::uint64_t>(std::ceil(least / grid.voxelVolume()));
                     return thresholded(relabelled(fewest).GetPointer(), 1, 4e9);
                   }}});
  progress.report(0.4, "measure islands");

  // A shell, whose cavity is filled.
  auto shell = std::make_shared<volume::Volume<std::uint8_t>>(grid);
  for (int k = 0; k < edge; ++k)
    for (int j = 0; j < edge; ++j)
      for (int i = 0; i < edge; ++i)
      {
        const double d = distanceFrom({large}, grid.patientFromVoxel(Vector3d(i, j, k)));
        shell->at(i, j, k) = d <= 0.0 && d > -0.1 * width;
      }
  const Mask hollow = makeMask(shell, grid.fullBox());
  const Labels::Pointer peerHollow = shown(*shell);
  trials.measure("filled cavity" + size, grid, {large}, [&] { return filled(hollow); },
                 {{"itk::BinaryFillhole", [&]
                   {
                     auto filter = itk::BinaryFillholeImageFilter<Labels>::New();
                     filter->SetInput(peerHollow);
                     filter->SetForegroundValue(1);
                     return run(*filter);
                   }}});
  progress.report(0.5, "measure filling");

  // Slices three times as thick as their pixels.
  const core::GridGeometry thick({edge, edge, edge / 2}, Vector3d(0.3, 0.3, 0.9),
                                 Vector3d(4.0, -8.0, 0.0));
  const Ball ball{thick.center() + Vector3d(0.11, 0.07, -0.19), 0.08 * edge};
  const Mask solid = threshold(volume::IntensityVolume(imageOf(thick, {ball}, 0.0)),
                               volume::ValueRange{500, 3000});
  const Labels::Pointer peerSolid = shown(*solid.voxels);
  const auto maurer = [&](double distance)
  {
    auto filter = itk::SignedMaurerDistanceMapImageFilter<Labels, Distances>::New();
    filter->SetInput(peerSolid);
    filter->UseImageSpacingOn();
    filter->SquaredDistanceOff();
    filter->SetBackgroundValue(0);
    if (distance > 0.0)
      return thresholded(run(*filter).GetPointer(), -1e9, distance);
    filter->SetBackgroundValue(1); // distances from what is not the mask
    return thresholded(run(*filter).GetPointer(), -distance, 1e9);
  };
  const auto element = [&](double distance)
  {
    using Element = itk::BinaryBallStructuringElement<std::uint8_t, 3>;
    Element made;
    Element::SizeType radius;
    for (unsigned a = 0; a < 3; ++a)
      radius[a] = static_cast<itk::SizeValueType>(std::lround(distance / thick.spacing()[a]));
    made.SetRadius(radius);
    made.CreateStructuringElement();
    return made;
  };
  const std::string slabs = ", voxels of 0.3 x 0.3 x 0.9 mm";
  // No distance between voxel centres is 2.75 mm: rounding decides nothing.
  for (const double distance : {2.75, -2.75})
  {
    trials.measure(std::string("margin of ") + (distance > 0.0 ? "+2.75 mm" : "-2.75 mm") + slabs,
                   thick, grownBy({ball}, distance), [&] { return margin(solid, distance); },
                   {{"itk::SignedMaurerDistanceMap", [&] { return maurer(distance); }},
                    {"itk::BinaryDilate, BinaryErode",
                     [&]
                     {
                       const auto kernel = element(std::abs(distance));
                       const auto morphed = [&](auto filter)
                       {
                         filter->SetInput(peerSolid);
                         filter->SetKernel(kernel);
                         filter->SetForegroundValue(1);
                         return Labels::Pointer(run(*filter));
                       };
                       using Element = std::decay_t<decltype(kernel)>;
                       if (distance > 0.0)
                         return morphed(
                             itk::BinaryDilateImageFilter<Labels, Labels, Element>::New());
                       return morphed(itk::BinaryErodeImageFilter<Labels, Labels, Element>::New());
                     },
                     "ITK, ball as element"}});
    progress.report(distance > 0.0 ? 0.65 : 0.8, "measure margins");
  }

  // Noise of 250 HU makes the border rough.
  const Mask rough =
      largestIsland(threshold(volume::IntensityVolume(imageOf(grid, {large}, 250.0)), bone));
  const auto measureSmoothing = [&](const std::string& scene, const Mask& mask)
  {
    const Labels::Pointer peerMask = shown(*mask.voxels);
    trials.measure(scene + size, grid, {large}, [&] { return smoothedOutline(mask, 0.8); },
                   {{"itk::SmoothingRecursiveGaussian", [&]
                     {
                       auto cast = itk::CastImageFilter<Labels, Distances>::New();
                       cast->SetInput(peerMask);
                       auto filter =
                           itk::SmoothingRecursiveGaussianImageFilter<Distances, Distances>::New();
                       filter->SetInput(cast->GetOutput());
                       filter->SetSigma(0.8);
                       return thresholded(run(*filter).GetPointer(), 0.5, 1e9);
                     }}});
  };
  measureSmoothing("smoothing by 0.8 mm, cavities filled before", filled(rough));
  measureSmoothing("smoothing by 0.8 mm, 2 % of the voxels missing", rough);
  progress.report(0.9, "measure smoothing");

  const int part = quick ? 64 : 128;
  const core::GridGeometry near({part, part, part}, Vector3d::Constant(0.4), Vector3d::Zero());
  const Ball inner{near.center(), 0.25 * 0.4 * part};
  const volume::IntensityVolume noisy(imageOf(near, {inner}, 100.0));
  EditableMask inside(near);
  EditableMask outside(near);
  const auto stroke = [&](EditableMask& mask, const Vector3d& from, const Vector3d& to)
  {
    Brush brush;
    brush.from = inner.center + from * inner.radius;
    brush.to = inner.center + to * inner.radius;
    brush.radius = 0.8;
    mask.beginStep();
    paint(mask, brush, true);
    mask.endStep();
  };
  stroke(inside, {-0.5, 0.0, 0.0}, {0.5, 0.0, 0.0});
  for (const Vector3d& side : {Vector3d(1, 0, 0), Vector3d(0, 1, 0), Vector3d(0, 0, 1)})
    for (const double sign : {-1.5, 1.5})
    {
      const Vector3d along(side[1], side[2], side[0]);
      stroke(outside, sign * side - along, sign * side + along);
    }
  const Mask in = inside.snapshot();
  const Mask out = outside.snapshot();
  trials.measure("grown from strokes, noise 100 HU, " + std::to_string(part) + "^3", near, {inner},
                 [&] { return grownFromSeeds(noisy, in, out, near.fullBox()); }, {});
}

/// Of a capsule: distance of a point from the line between its ends.
double distanceFromLine(const Vector3d& p, const Vector3d& a, const Vector3d& b)
{
  const double t = std::clamp((p - a).dot(b - a) / (b - a).squaredNorm(), 0.0, 1.0);
  return (p - a - t * (b - a)).norm();
}

/// Strokes of a brush, some of which meet; each is painted in 30 moves, as by a hand.
void measurePainting(bool quick, core::BenchmarkReport& report)
{
  const int edge = quick ? 128 : 512;
  const core::GridGeometry grid({edge, edge, edge}, Vector3d::Constant(quick ? 0.6 : 0.15),
                                Vector3d::Zero());
  const double width = edge * grid.spacing()[0];
  const auto bytes = static_cast<double>(grid.voxelCount());
  const int strokes = quick ? 5 : 20;
  for (const double radius : {1.0, 2.0, 4.0, 8.0})
  {
    EditableMask mask(grid);
    std::vector<double> times;
    std::vector<double> undoTimes;
    double worst = 0.0;
    double volumeError = 0.0;
    for (int n = 0; n < strokes; ++n)
    {
      const auto at = [&](std::uint64_t part)
      { return fraction(1000 * static_cast<std::uint64_t>(n) + part); };
      const Vector3d from =
          Vector3d::Constant(0.25 * width) + 0.25 * width * Vector3d(at(1), at(2), at(3));
      const Vector3d to = from + 15.0 * Vector3d(at(4), at(5), at(6)).normalized();
      EditableMask alone(grid); // the same stroke where nothing is painted
      for (EditableMask* each : {&mask, &alone})
      {
        const double seconds = secondsOf(
            [&]
            {
              each->beginStep();
              constexpr int kMoves = 30;
              for (int move = 0; move < kMoves; ++move)
              {
                Brush brush;
                brush.from = from + (to - from) * move / kMoves;
                brush.to = from + (to - from) * (move + 1) / kMoves;
                brush.radius = radius;
                paint(*each, brush, true);
              }
              each->endStep();
            });
        if (each == &alone)
          times.push_back(seconds);
      }
      worst = std::max(worst, static_cast<double>(alone.lastStepBytes()));
      const double wanted = kPi * radius * radius * ((to - from).norm() + 4.0 / 3.0 * radius);
      const double drawn = static_cast<double>(alone.count()) * grid.voxelVolume();
      volumeError = std::max(volumeError, 100.0 * std::abs(drawn - wanted) / wanted);
      const core::IndexBox box = alone.extent();
      for (int k = box.lower[2]; k < box.upper[2]; ++k)
        for (int j = box.lower[1]; j < box.upper[1]; ++j)
          for (int i = box.lower[0]; i < box.upper[0]; ++i)
            if (alone.voxels().at(i, j, k) != 0 &&
                distanceFromLine(grid.patientFromVoxel(Vector3d(i, j, k)), from, to) >
                    radius + 1e-9)
              volumeError = 100.0; // paint where there was no brush
    }
    // All back, and again.
    const volume::Volume<std::uint8_t>& voxels = mask.voxels();
    const std::vector<std::uint8_t> drawn(voxels.data(), voxels.data() + voxels.size());
    while (mask.canUndo())
      undoTimes.push_back(secondsOf([&] { mask.undo(); }));
    auto differing = static_cast<double>(
        voxels.size() - static_cast<std::size_t>(std::count(
                            voxels.data(), voxels.data() + voxels.size(), std::uint8_t{0})));
    while (mask.canRedo())
      mask.redo();
    for (std::size_t n = 0; n < drawn.size(); ++n)
      differing += drawn[n] != voxels.data()[n];

    core::BenchmarkPoint point;
    point.scene = "paint, " + std::to_string(edge) + "^3, brush of " +
                  std::to_string(static_cast<int>(2.0 * radius)) + " mm, 15 mm long";
    point.isDefault = true;
    point.seconds = median(times);
    point.error = volumeError;
    point.errorUnit = "% of the stroke's volume";
    point.extra["undo_percent"] = 100.0 * worst / bytes;
    point.extra["undo_kb"] = worst / 1e3;
    point.extra["undo_seconds"] = median(undoTimes);
    point.extra["slowest_seconds"] = *std::max_element(times.begin(), times.end());
    point.extra["differing_voxels"] = differing;
    report.points.push_back(point);

    std::vector<std::uint8_t> copy(voxels.size());
    std::vector<double> copies;
    for (int n = 0; n < 5; ++n)
      copies.push_back(secondsOf([&] { std::memcpy(copy.data(), voxels.data(), voxels.size()); }));
    point.peer = "a copy of the mask";
    point.isDefault = false;
    point.seconds = median(copies);
    point.error = 0.0;
    point.extra = {{"undo_percent", 100.0}, {"undo_kb", bytes / 1e3}};
    report.points.push_back(point);
  }
}

} // namespace

core::BenchmarkReport runSegmentBenchmark(bool quick, const core::Progress& progress)
{
  core::BenchmarkReport report;
  report.name = "segment";
  report.title = "Structures made by hand: time of each operation, and its error";
  report.machine["ITK"] = "each filter at the faster of 1 thread and all cores; ITK 5.2 has no "
                          "grow-cut, so growing from strokes has no peer";
  measureOperations(quick, progress.part(0.0, 0.8), report);
  measurePainting(quick, report);
  return report;
}

} // namespace petrous::segmentation
