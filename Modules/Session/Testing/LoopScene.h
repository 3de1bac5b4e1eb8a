#pragma once

#include "ProportionalRemovalModel.h"
#include "Session.h"
#include "petrous/Session/DissectionLoop.h"

namespace petrous::session::testing
{

inline core::GridGeometry gridOfTheBlock()
{
  return {{61, 61, 61}, Eigen::Vector3d::Constant(0.3), Eigen::Vector3d(-9.0, -9.0, -15.0)};
}

/// A plane of bone at z = 0 that can be cut: servo, loop and mask.
struct LoopScene
{
  core::GridGeometry grid = gridOfTheBlock();
  dissection::Dissection work{grid};
  std::shared_ptr<volume::PublishedMask> mask =
      std::make_shared<volume::PublishedMask>(work.mask());
  ProportionalRemovalModel removalModel{2.0};
  Session session;

  LoopScene() { session.proxy.mask = mask; }

  std::vector<std::uint16_t> voxels() const
  {
    const auto dense = work.mask().dense();
    return {dense.data(), dense.data() + dense.size()};
  }
};

} // namespace petrous::session::testing
