#pragma once

#include <memory>

#include "petrous/Scene/Case.h"

namespace petrous::scene::test
{

inline void drill(Case& value, const Eigen::Vector3d& at, double removed)
{
  value.dissection.beginStroke({});
  value.dissection.cut({at, at + Eigen::Vector3d(0, 1, 0), 1.0});
  value.dissection.openInfo().removed = removed;
  value.dissection.endStroke();
}

/// Strokes that removed 10, 11, 12 ... mm^3.
inline Case drilledCase(int strokes)
{
  Case value;
  value.name = "ear";
  value.ct.geometry =
      core::GridGeometry({32, 32, 32}, Eigen::Vector3d::Constant(0.3), Eigen::Vector3d::Zero());
  value.dissection = dissection::Dissection(value.ct.geometry);
  for (int n = 0; n < strokes; ++n)
    drill(value, {2.0 + 2 * n, 4, 4}, 10.0 + n);
  return value;
}

} // namespace petrous::scene::test
