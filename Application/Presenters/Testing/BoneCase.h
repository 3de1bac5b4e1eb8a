#pragma once

#include <algorithm>
#include <memory>

#include "petrous/Scene/Case.h"

namespace petrous::presenters::testing
{

constexpr double kTop = 6.0; ///< mm, z; bone lies below

/// A 12 mm block of bone, air above kTop.
inline scene::Case block()
{
  scene::Case value;
  value.name = "block";
  value.ct.geometry =
      core::GridGeometry({40, 40, 40}, Eigen::Vector3d::Constant(0.3), Eigen::Vector3d::Zero());
  auto ct = std::make_shared<volume::Volume<std::int16_t>>(value.ct.geometry);
  for (int k = 0; k < 40; ++k)
    for (int j = 0; j < 40; ++j)
      for (int i = 0; i < 40; ++i)
        ct->at(i, j, k) = static_cast<std::int16_t>(
            std::clamp(300.0 + 3000.0 * (kTop - 0.3 * k), -1000.0, 1600.0));
  value.ct.volume = std::make_shared<const volume::IntensityVolume>(
      std::shared_ptr<const volume::Volume<std::int16_t>>(ct));
  value.dissection = dissection::Dissection(value.ct.geometry);
  return value;
}

} // namespace petrous::presenters::testing
