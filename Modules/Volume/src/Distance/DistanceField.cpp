#include "petrous/Volume/DistanceField.h"

#include <algorithm>

#include <tbb/parallel_for.h>

#include "ClosestPoints.h"
#include "DistanceGrid.h"
#include "OccupancySurface.h"

namespace petrous::volume
{

std::shared_ptr<const Volume<float>> makeDistanceField(const Volume<float>& occupancy, double reach,
                                                       const core::Progress& progress,
                                                       std::size_t maxVoxels)
{
  if (!(reach > 0.0))
    throw core::InvalidParameter("distance field: the reach must be above 0 mm");
  const core::GridGeometry& from = occupancy.geometry();
  const core::IndexBox box = insideBox(occupancy);
  if (box.empty())
    return nullptr;
  // The surface may be up to one voxel beyond the inside voxels.
  const DistanceGrid grid = gridFor(from, box, reach + from.spacing().maxCoeff(), maxVoxels);
  const OccupancySurface surface(occupancy);
  const ClosestPoints closest(surface.points(progress.part(0.0, 0.2)), grid.dims, grid.origin,
                              grid.edge, progress.part(0.2, 0.8));
  auto field = std::make_shared<Volume<float>>(geometryOf(grid, from));
  const double most = reach + 2.0 * grid.edge; // maximum needed by interpolation up to the reach
  const auto distanceAt = [&](const Eigen::Vector3d& position, std::size_t node)
  {
    if (!closest.any())
      return most; // the structure fills its grid
    const Eigen::Vector3f& point = closest.point(node);
    const double near = (position - point.cast<double>()).norm();
    return near > most ? most : surface.refined(position, point);
  };
  tbb::parallel_for(0, grid.dims[2],
                    [&](int k)
                    {
                      for (int j = 0; j < grid.dims[1]; ++j)
                        for (int i = 0; i < grid.dims[0]; ++i)
                        {
                          const Eigen::Vector3d position =
                              grid.origin + grid.edge * Eigen::Vector3d(i, j, k);
                          const std::size_t node = field->geometry().linearIndex(i, j, k);
                          const double distance = distanceAt(position, node);
                          // The structure ends where the occupancy does, or the image.
                          const Eigen::Vector3d voxel = position.cwiseQuotient(from.spacing());
                          const bool inside =
                              from.hullContains(voxel) && surface.at(position).value > 0.0;
                          field->data()[node] = static_cast<float>(inside ? -distance : distance);
                        }
                    });
  progress.report(1.0, "measuring structures");
  return field;
}

} // namespace petrous::volume
