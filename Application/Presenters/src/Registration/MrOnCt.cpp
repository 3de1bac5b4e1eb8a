#include "petrous/Presenters/MrOnCt.h"

#include <algorithm>
#include <atomic>
#include <type_traits>
#include <utility>

#include <tbb/parallel_for.h>

#include "petrous/Core/NumberText.h"
#include "petrous/Volume/Rounded.h"

namespace petrous::presenters
{

namespace
{

template <class T>
volume::Volume<T> resampled(const volume::IntensityVolume& mr, const core::GridGeometry& ct,
                            const core::RigidTransform& mrFromCt, const core::Progress& progress)
{
  volume::Volume<T> result(ct);
  const T outside = volume::rounded<T>(mr.padding() ? *mr.padding() : mr.range().min);
  const core::GridGeometry& grid = mr.geometry();
  const Eigen::Vector3d last(grid.dims()[0] - 1.0, grid.dims()[1] - 1.0, grid.dims()[2] - 1.0);
  constexpr double kRounding = 1e-6; // voxels; so that a grid on the CT's keeps its border
  const core::Index3& n = ct.dims();
  std::atomic<int> done{0};
  tbb::parallel_for(
      0, n[2],
      [&](int k)
      {
        progress.report(static_cast<double>(done.fetch_add(1)) / n[2], "resampling the MR");
        for (int j = 0; j < n[1]; ++j)
          for (int i = 0; i < n[0]; ++i)
          {
            const Eigen::Vector3d patient = ct.patientFromVoxel(Eigen::Vector3d(i, j, k));
            const Eigen::Vector3d at = grid.voxelFromPatient(mrFromCt * patient);
            const bool isInside =
                at.minCoeff() >= -kRounding && (last - at).minCoeff() >= -kRounding;
            result.at(i, j, k) =
                isInside ? volume::rounded<T>(mr.sample(at.cwiseMax(0.0).cwiseMin(last))) : outside;
          }
      });
  return result;
}

struct DoubtWords
{
  const char* name;
  const char* reason;
};

DoubtWords wordsOf(segmentation::TubeDoubt doubt)
{
  using segmentation::TubeDoubt;
  switch (doubt)
  {
  case TubeDoubt::Faint:
    return {"faint", "it does not stand out from the noise"};
  case TubeDoubt::Thin:
    return {"thin", "it is narrower than two voxels"};
  case TubeDoubt::Wide:
    return {"wide", "what is seen is wider than the structure can be"};
  case TubeDoubt::Foreign:
    return {"foreign", "the path runs through air or bone, not through a nerve"};
  case TubeDoubt::Uneven:
    return {"uneven", "the path leads through something of another intensity"};
  case TubeDoubt::Open:
    return {"open", "a quarter of its circumference or more has no wall, as at an edge"};
  case TubeDoubt::Stray:
    return {"stray", "the path is a long detour between two points; set another one between them"};
  case TubeDoubt::Fragment:
    return {"fragment", "what is seen is too short a piece of it"};
  case TubeDoubt::None:
    break;
  }
  return {"none", ""};
}

} // namespace

std::shared_ptr<const volume::IntensityVolume> mrOnCt(const volume::IntensityVolume& mr,
                                                      const core::GridGeometry& ct,
                                                      const core::RigidTransform& mrFromCt,
                                                      const core::Progress& progress)
{
  return mr.visit(
      [&](const auto& voxels)
      {
        using T = typename std::decay_t<decltype(voxels)>::Value;
        return std::make_shared<const volume::IntensityVolume>(
            std::make_shared<const volume::Volume<T>>(resampled<T>(mr, ct, mrFromCt, progress)),
            mr.padding());
      });
}

segmentation::Tube traceOnCt(const volume::IntensityVolume& image,
                             const core::RigidTransform& imageFromCt,
                             const std::vector<Eigen::Vector3d>& points,
                             const segmentation::TubeOptions& options,
                             const core::Progress& progress)
{
  std::vector<Eigen::Vector3d> own = points;
  for (Eigen::Vector3d& point : own)
    point = imageFromCt * point;
  segmentation::Tube tube = segmentation::traceTube(image, own, options, progress);
  const core::RigidTransform ctFromImage = imageFromCt.inverse();
  for (Eigen::Vector3d& point : tube.line)
    point = ctFromImage * point;
  for (auto& leg : tube.legs)
    for (Eigen::Vector3d& point : leg)
      point = ctFromImage * point;
  tube.points = points; // to the bit
  return tube;
}

std::string likelyOrderText(const std::vector<Eigen::Vector3d>& points)
{
  std::string text;
  for (const std::size_t n : segmentation::likelyOrder(points))
    text += (text.empty() ? "" : ", ") + std::to_string(n + 1);
  return text;
}

scene::TracedTubes tracedTubes(const segmentation::Tube& tube, const segmentation::TubeLabel& label)
{
  return {tube.length, std::max(tube.length - tube.resolvedLength, 0.0), label.bridging};
}

const char* nameOf(segmentation::TubeDoubt doubt)
{
  return wordsOf(doubt).name;
}

std::vector<std::string> unresolvedTexts(const segmentation::Tube& tube,
                                         const segmentation::TubeOptions& options)
{
  constexpr double kShort = 0.5; // mm; about as far as its cross-sections are averaged along it
  std::vector<std::string> texts;
  for (const segmentation::TubeStretch& stretch : segmentation::unresolvedStretches(tube))
    if (stretch.to - stretch.from >= kShort)
      texts.push_back("Not resolved from " + core::fixedText(stretch.from, 1) + " to " +
                      core::fixedText(stretch.to, 1) + " mm: " + wordsOf(stretch.doubt).reason +
                      ".");
  if (segmentation::hasUsualRadius(tube, options))
    texts.push_back("Its radius of " + core::fixedText(tube.radius, 1) +
                    " mm is the usual one of its name, and nothing that the image shows.");
  return texts;
}

std::string bridgingText(const segmentation::TubeLabel& label)
{
  if (label.bridging == 0)
    return {};
  return "where it is thinner than the voxels it is drawn one voxel wide, so that it has no gap: " +
         std::to_string(label.bridging) + " of its " +
         std::to_string(label.map.segments.front().voxels) +
         " voxels, which its volume counts whole";
}

} // namespace petrous::presenters
