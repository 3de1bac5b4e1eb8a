#include "petrous/Presenters/DissectionDistances.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "petrous/Presenters/NearbyStructures.h"
#include "petrous/Presenters/StructureSurfaces.h"

namespace petrous::presenters
{

std::vector<Eigen::Vector3d> cavityWall(const volume::CutMask& mask)
{
  constexpr double kHalf = 0.5 * volume::CutMask::kUntouched;
  const core::Index3 dims = mask.geometry().dims();
  std::vector<Eigen::Vector3d> wall;
  const auto cross = [&](const core::Index3& a, std::size_t axis, double here)
  {
    core::Index3 b = a;
    ++b[axis];
    if (b[axis] >= dims[axis])
      return;
    const double there = mask.at(b[0], b[1], b[2]);
    if ((here < kHalf) == (there < kHalf))
      return;
    Eigen::Vector3d voxel(a[0], a[1], a[2]);
    voxel[static_cast<Eigen::Index>(axis)] += (kHalf - here) / (there - here);
    wall.push_back(mask.geometry().patientFromVoxel(voxel));
  };
  // An edge to the next brick is that of the voxel before it, whose own brick may be untouched.
  const auto visit = [&](const core::Index3& a)
  {
    const double here = mask.at(a[0], a[1], a[2]);
    for (std::size_t axis = 0; axis < 3; ++axis)
      cross(a, axis, here);
  };
  for (std::size_t n = 0; n < mask.brickCount(); ++n)
  {
    if (!mask.brick(n))
      continue;
    const core::IndexBox box = mask.brickBox(n);
    for (int k = box.lower[2]; k < box.upper[2]; ++k)
      for (int j = box.lower[1]; j < box.upper[1]; ++j)
        for (int i = box.lower[0]; i < box.upper[0]; ++i)
        {
          visit({i, j, k});
          const core::Index3 here{i, j, k};
          for (std::size_t axis = 0; axis < 3; ++axis)
          {
            core::Index3 before = here;
            if (here[axis] != box.lower[axis] || --before[axis] < 0)
              continue;
            if (!mask.brick(mask.brickIndex({before[0] / volume::CutMask::kBrickEdge,
                                             before[1] / volume::CutMask::kBrickEdge,
                                             before[2] / volume::CutMask::kBrickEdge})))
              cross(before, axis, volume::CutMask::kUntouched);
          }
        }
  }
  return wall;
}

std::vector<DissectionDistance> dissectionDistances(const scene::Case& value,
                                                    const core::Progress& progress)
{
  if (!value.dissection.loaded())
    throw core::InvalidParameter("distances: the dissection of case '" + value.name +
                                 "' is not loaded");
  const std::vector<Eigen::Vector3d> wall = cavityWall(value.dissection.mask());
  std::vector<DissectionDistance> distances;
  if (wall.empty())
    return distances;
  const auto injured = injuredVolumes(value);
  StructureSurfaces surfaces(value);
  const double ofWall = 0.5 * value.ct.geometry.spacing().maxCoeff();
  for (std::size_t n = 0; n < surfaces.count(); ++n)
  {
    progress.report(static_cast<double>(n) / static_cast<double>(surfaces.count()),
                    "measuring distances");
    surfaces.measure(
        n, progress.part(static_cast<double>(n) / static_cast<double>(surfaces.count()),
                         static_cast<double>(n + 1) / static_cast<double>(surfaces.count())));
    double best = StructureSurfaces::kFar;
    Eigen::Vector3d place = wall.front();
    for (std::size_t p = 0; p < wall.size() && best > 0.0; ++p)
    {
      if (p % 4096 == 0)
        progress.check("measuring distances");
      const double there = surfaces.distance(n, wall[p], best);
      if (there < best)
      {
        best = there;
        place = wall[p];
      }
    }
    if (best >= StructureSurfaces::kFar)
      continue;
    const SurfaceUncertainty& surface = surfaces.uncertainty(n);
    DissectionDistance one;
    one.name = surfaces.name(n);
    one.distance = {"distance of the dissection", std::max(best, 0.0), "mm", std::nullopt,
                    toString(surface)};
    if (!surface.incomplete())
      one.distance.uncertainty = std::hypot(surface.millimetres(), ofWall);
    if (const auto found = injured.find(one.name); found != injured.end())
      one.injured = found->second;
    one.place = place;
    distances.push_back(std::move(one));
  }
  std::stable_sort(distances.begin(), distances.end(),
                   [](const DissectionDistance& a, const DissectionDistance& b)
                   { return *a.distance.value < *b.distance.value; });
  return distances;
}

} // namespace petrous::presenters
