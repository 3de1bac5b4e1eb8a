#include "petrous/Presenters/ApproachComparison.h"

#include <algorithm>
#include <optional>
#include <utility>

#include <tbb/parallel_for.h>

#include "petrous/Dissection/RemovedVolume.h"
#include "petrous/Presenters/DissectionDistances.h"
#include "petrous/Presenters/StructureSurfaces.h"
#include "petrous/Rendering/SurfaceExtraction.h"
#include "petrous/Scene/Branches.h"
#include "petrous/Scene/CaseField.h"
#include "petrous/Scene/ExposedSurfaces.h"

namespace petrous::presenters
{

namespace
{

using volume::CutMask;

constexpr std::uint16_t kHalf = 32768;

// What is left after both.
CutMask minimumOf(const CutMask& a, const CutMask& b)
{
  CutMask least(a.geometry());
  for (std::size_t n = 0; n < a.brickCount(); ++n)
  {
    const CutMask::BrickVersion& one = a.brick(n);
    const CutMask::BrickVersion& other = b.brick(n);
    if (!one || !other || one == other)
    {
      if (one || other)
        least.setBrick(n, one ? one : other);
      continue;
    }
    auto brick = std::make_shared<CutMask::Brick>();
    std::transform(one->begin(), one->end(), other->begin(), brick->begin(),
                   [](std::uint16_t x, std::uint16_t y) { return std::min(x, y); });
    least.setBrick(n, std::move(brick));
  }
  return least;
}

double volumeOf(const volume::TissueField& tissue, const CutMask& mask)
{
  const CutMask untouched(mask.geometry());
  return dissection::measureRemoved(tissue, untouched, mask, mask.cutBricks(), {}).total;
}

// Positive where this difference is, zero at its surface.
float levelOf(Difference difference, double first, double second, double tissue)
{
  const double a = 0.5 - first; // removed by it: positive
  const double b = 0.5 - second;
  const double level = difference == Difference::OnlyFirst    ? std::min(a, -b)
                       : difference == Difference::OnlySecond ? std::min(-a, b)
                                                              : std::min(a, b);
  return static_cast<float>(std::min(level, std::clamp(tissue, -0.5, 0.5)));
}

std::shared_ptr<const core::TriangleMesh> surfaceOf(const ApproachComparison& comparison,
                                                    Difference difference,
                                                    const core::IndexBox& box,
                                                    const core::Progress& progress)
{
  const CutMask& first = *comparison.sides[0].mask;
  const CutMask& second = *comparison.sides[1].mask;
  const core::GridGeometry grid = first.geometry().cropped(box);
  auto levels = std::make_shared<volume::Volume<float>>(grid);
  const core::Index3& dims = grid.dims();
  const auto fraction = [](std::uint16_t left) { return left / double(CutMask::kUntouched); };
  tbb::parallel_for(
      0, dims[2],
      [&](int k)
      {
        for (int j = 0; j < dims[1]; ++j)
          for (int i = 0; i < dims[0]; ++i)
          {
            const core::Index3 v{i + box.lower[0], j + box.lower[1], k + box.lower[2]};
            const double a = fraction(first.at(v[0], v[1], v[2]));
            const double b = fraction(second.at(v[0], v[1], v[2]));
            levels->at(i, j, k) = a == 1.0 && b == 1.0
                                      ? -0.5F
                                      : levelOf(difference, a, b,
                                                comparison.tissue->uncut(grid.patientFromVoxel(
                                                    {double(i), double(j), double(k)})));
          }
      });
  progress.check("comparing approaches");
  const volume::TissueField field(
      std::make_shared<const volume::IntensityVolume>(
          std::shared_ptr<const volume::Volume<float>>(std::move(levels))),
      {}, nullptr, {0.0, 1.0});
  auto surface = rendering::extractSurface(field, grid.fullBox(), progress);
  if (surface.triangles.empty())
    return nullptr;
  return std::make_shared<const core::TriangleMesh>(std::move(surface));
}

ComparedApproach sideOf(const scene::Case& value, const std::string& branch)
{
  dissection::History there = value.dissection.history();
  there.goTo(branch); // throws, listing the branches
  const auto summary = scene::summaryOf(value, there.position());
  const dissection::Dissection work = scene::dissectionAt(value, there.position());
  ComparedApproach side;
  side.name = branch;
  side.strokes = summary.strokes;
  side.drilling = summary.duration;
  for (const auto& touched : summary.structures)
    side.injured[touched.name] = touched.volume;
  side.mask = std::make_shared<const CutMask>(work.mask());
  return side;
}

void measureDistances(const scene::Case& value, ApproachComparison& comparison,
                      const core::Progress& progress)
{
  std::array<std::optional<RemovedTissue>, 2> removed;
  for (std::size_t side = 0; side < 2; ++side)
    removed[side].emplace(*comparison.tissue, *comparison.sides[side].mask, progress);
  if (removed[0]->empty() && removed[1]->empty())
    return;
  StructureSurfaces surfaces(value);
  for (std::size_t n = 0; n < surfaces.count(); ++n)
  {
    progress.report(static_cast<double>(n) / static_cast<double>(surfaces.count()),
                    "measuring distances");
    comparison.uncertainties[surfaces.name(n)] = wallUncertainty(value, surfaces.uncertainty(n));
    for (std::size_t side = 0; side < 2; ++side)
      if (const auto nearest = removed[side]->nearest(surfaces, n, progress))
        comparison.sides[side].distances[surfaces.name(n)] = nearest->distance;
  }
}

} // namespace

Difference ApproachComparison::at(const core::Index3& voxel) const
{
  const auto gone = [&voxel](const CutMask& mask)
  { return mask.at(voxel[0], voxel[1], voxel[2]) < kHalf; };
  const bool first = gone(*sides[0].mask);
  const bool second = gone(*sides[1].mask);
  if (!first && !second)
    return Difference::None;
  const core::GridGeometry& grid = either->geometry();
  if (!(tissue->uncut(
            grid.patientFromVoxel({double(voxel[0]), double(voxel[1]), double(voxel[2])})) > 0.0))
    return Difference::None;
  return !second ? Difference::OnlyFirst : first ? Difference::Both : Difference::OnlySecond;
}

ApproachComparison compareApproaches(const scene::Case& value, const std::string& first,
                                     const std::string& second, const core::Progress& progress)
{
  ApproachComparison comparison;
  comparison.sides = {sideOf(value, first), sideOf(value, second)};
  auto& [a, b] = comparison.sides;
  const dissection::History& history = value.dissection.history();
  comparison.commonStrokes =
      a.strokes -
      history.path(history.find(first)->position, history.find(second)->position).undone.size();
  comparison.tissue = std::make_shared<const volume::TissueField>(
      scene::tissueField(value, progress.part(0.0, 0.2)));
  const auto exposed =
      scene::exposedSurfaces(value, {a.mask.get(), b.mask.get()}, progress.part(0.2, 0.4));
  for (std::size_t side = 0; side < 2; ++side)
    for (const auto& surface : exposed[side])
      comparison.sides[side].exposed[surface.name] = surface.area;

  comparison.either = std::make_shared<const CutMask>(minimumOf(*a.mask, *b.mask));
  a.removed = volumeOf(*comparison.tissue, *a.mask);
  b.removed = volumeOf(*comparison.tissue, *b.mask);
  const double either = volumeOf(*comparison.tissue, *comparison.either);
  a.only = std::max(either - b.removed, 0.0);
  b.only = std::max(either - a.removed, 0.0);
  comparison.both = std::max(a.removed + b.removed - either, 0.0);
  measureDistances(value, comparison, progress.part(0.4, 0.9));

  if (const auto bricks = comparison.either->cutBricks(); !bricks.empty())
  {
    const core::IndexBox box = comparison.either->boxOf(bricks);
    for (const Difference difference :
         {Difference::OnlyFirst, Difference::OnlySecond, Difference::Both})
      comparison.surfaces[static_cast<std::size_t>(difference) - 1] =
          surfaceOf(comparison, difference, box, progress.part(0.9, 1.0));
  }
  return comparison;
}

void showDifference(rendering::SceneContents& contents, const ApproachComparison& comparison)
{
  contents.mask = comparison.either;
  for (std::size_t n = 0; n < comparison.surfaces.size(); ++n)
  {
    if (!comparison.surfaces[n])
      continue;
    rendering::MeshContents mesh;
    mesh.name = "difference " + std::to_string(n + 1);
    mesh.mesh = comparison.surfaces[n];
    mesh.look.color = kDifferenceColors[n];
    contents.meshes.push_back(std::move(mesh));
  }
}

std::shared_ptr<const DraftLayer>
differenceLayer(const std::shared_ptr<const ApproachComparison>& comparison)
{
  if (!comparison)
    return nullptr;
  std::vector<std::array<float, 3>> colors(1);
  for (std::array<float, 3> color : kDifferenceColors)
  {
    for (float& channel : color)
      channel *= 255.0F;
    colors.push_back(color);
  }
  return std::make_shared<const DraftLayer>(
      DraftLayer{comparison->either->geometry(),
                 [comparison](const core::Index3& voxel)
                 { return static_cast<std::uint16_t>(comparison->at(voxel)); },
                 std::move(colors), 0});
}

} // namespace petrous::presenters
