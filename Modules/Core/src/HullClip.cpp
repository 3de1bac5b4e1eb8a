#include "petrous/Core/HullClip.h"

#include <algorithm>
#include <cmath>

namespace petrous::core
{

std::pair<double, double> clipToHull(const GridGeometry& grid, const Eigen::Vector3d& start,
                                     const Eigen::Vector3d& run, double first, double last) noexcept
{
  for (int axis = 0; axis < 3; ++axis)
  {
    const double top = grid.dims()[static_cast<std::size_t>(axis)] - 1.0;
    if (std::abs(run[axis]) < 1e-14)
    {
      if (start[axis] < 0.0 || start[axis] > top)
        return {1.0, 0.0};
      continue;
    }
    const double a = -start[axis] / run[axis];
    const double b = (top - start[axis]) / run[axis];
    first = std::max(first, std::min(a, b));
    last = std::min(last, std::max(a, b));
  }
  return {first, last};
}

} // namespace petrous::core
