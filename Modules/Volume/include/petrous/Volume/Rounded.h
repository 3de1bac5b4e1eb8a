#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <type_traits>

namespace petrous::volume
{

/// A value as a voxel of type T: of whole numbers the nearest, halves away from zero, and the
/// nearest end of the type's range beyond it.
template <class T>
T rounded(double value)
{
  if constexpr (std::is_integral_v<T>)
    return static_cast<T>(std::lround(std::clamp(value, double{std::numeric_limits<T>::min()},
                                                 double{std::numeric_limits<T>::max()})));
  else
    return static_cast<T>(value);
}

} // namespace petrous::volume
