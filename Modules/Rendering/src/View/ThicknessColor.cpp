#include "petrous/Rendering/ThicknessColor.h"

#include <algorithm>
#include <cstddef>

namespace petrous::rendering
{

std::array<double, 3> thicknessColor(double share)
{
  constexpr std::size_t last = kThicknessColors.size() - 1;
  const double at = last * std::clamp(share, 0.0, 1.0);
  const std::size_t below = std::min(static_cast<std::size_t>(at), last - 1);
  std::array<double, 3> color{};
  for (std::size_t c = 0; c < 3; ++c)
    color[c] = double{kThicknessColors[below][c]} +
               (at - static_cast<double>(below)) *
                   (double{kThicknessColors[below + 1][c]} - double{kThicknessColors[below][c]});
  return color;
}

} // namespace petrous::rendering
