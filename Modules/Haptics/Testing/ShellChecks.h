#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include <gtest/gtest.h>

#include "petrous/Core/Error.h"
#include "petrous/Haptics/PointShell.h"

namespace petrous::haptics::checks
{

inline double nearest(const PointShell& shell, const Eigen::Vector3d& place)
{
  double squared = std::numeric_limits<double>::infinity();
  for (const auto& point : shell.points)
    squared = std::min(squared, (point - place).squaredNorm());
  return std::sqrt(squared);
}

inline void expectConsistent(const PointShell& shell, std::size_t budget)
{
  ASSERT_EQ(shell.points.size(), shell.normals.size());
  EXPECT_LE(shell.points.size(), budget);
  EXPECT_LE(shell.burrCount, shell.points.size());
  double reach = 0.0;
  for (std::size_t i = 0; i < shell.points.size(); ++i)
  {
    ASSERT_TRUE(shell.points[i].allFinite());
    ASSERT_NEAR(shell.normals[i].norm(), 1.0, 1e-12) << i;
    reach = std::max(reach, shell.points[i].norm());
  }
  EXPECT_DOUBLE_EQ(shell.reach, reach);
}

/// The message of the InvalidParameter thrown by `call`; empty if none is thrown.
template <typename Call>
std::string refusal(Call call)
{
  try
  {
    call();
  }
  catch (const core::InvalidParameter& error)
  {
    return error.what();
  }
  return "";
}

} // namespace petrous::haptics::checks
