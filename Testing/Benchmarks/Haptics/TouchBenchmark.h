#pragma once

#include <memory>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "petrous/Core/BenchmarkReport.h"
#include "petrous/Core/Progress.h"
#include "petrous/Haptics/HapticField.h"

namespace petrous::haptics
{

/// Tissue prepared by the caller, and where to touch it.
struct TouchScene
{
  struct Start
  {
    Eigen::Vector3d position{0.0, 0.0, 0.0}; ///< of the burr's centre, in free space, patient mm
    Eigen::Vector3d toward{0.0, 0.0, -1.0};  ///< unit, towards the tissue, opposite to the shaft
  };

  std::string name;
  std::shared_ptr<const HapticField> field;
  std::vector<Start> starts;
};

/// Error and time of the proxy's tick, each in the same run as a peer if there is one: height,
/// ripple and force angle on analytic surfaces, over the voxel size; crossings of thin plates by a
/// randomly moving device; error over time for each parameter; and tick times of a burr of 2000
/// points sliding over analytic bone and over the `scans`. Times are thread CPU time; wall times
/// are given as well.
core::BenchmarkReport runTouchBenchmark(bool quick, const core::Progress& progress,
                                        const std::vector<TouchScene>& scans = {});

} // namespace petrous::haptics
