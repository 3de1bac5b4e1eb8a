#pragma once

#include <cstdint>
#include <functional>

#include "PhantomShapes.h"

namespace petrous::phantom::shapes
{

/// A honeycomb of air cells with thin bony septa: the rounded cells of a Voronoi diagram.
///
/// region   where cells are allowed
/// sizeAt   distance between the seeds of neighbouring cells there, mm
/// seed     of the seed positions, of the septa's thickness (0.3 to 0.7 mm) and of the pores that
///          connect neighbours
///
/// Deterministic; the distance is to the cells' own walls only, not to the region's border.
Shape honeycomb(const Shape& region, const std::function<double(const Point&)>& sizeAt,
                std::uint64_t seed);

} // namespace petrous::phantom::shapes
