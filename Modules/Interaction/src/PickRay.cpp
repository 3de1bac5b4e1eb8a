#include "petrous/Interaction/PickRay.h"

#include <limits>

#include "petrous/Core/HullClip.h"

namespace petrous::interaction
{

std::optional<double> firstTissue(const volume::TissueField& field, const PickRay& line)
{
  const core::GridGeometry& grid = field.geometry();
  const Eigen::Vector3d start = grid.voxelFromPatient(line.origin);
  const Eigen::Vector3d run = grid.voxelFromPatient(line.at(1.0)) - start;
  const auto [first, last] =
      core::clipToHull(grid, start, run, 0.0, std::numeric_limits<double>::max());
  if (!(first < last))
    return std::nullopt;
  const auto hit = field.firstHit(line.at(first), line.at(last));
  if (!hit)
    return std::nullopt;
  return first + *hit;
}

} // namespace petrous::interaction
