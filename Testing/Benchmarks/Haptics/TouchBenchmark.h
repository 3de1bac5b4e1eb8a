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

/// Tissue that the caller made ready, and where to touch it.
struct TouchScene
{
  struct Start
  {
    Eigen::Vector3d position{0.0, 0.0, 0.0}; ///< of the burr's centre, free of tissue, patient mm
    Eigen::Vector3d toward{0.0, 0.0, -1.0};  ///< unit, the way to the tissue; the shaft is opposite
  };

  std::string name;
  std::shared_ptr<const HapticField> field;
  std::vector<Start> starts;
};

/// Error and time of the proxy's tick, each in the same run as a peer where there is one:
/// height, ripple and force angle on surfaces that are known exactly, over the voxel size;
/// crossings of thin plates by a hand that moves at random; error against time over each
/// parameter; and the times of a burr of 2000 points that slides over analytic bone and over the
/// `scans`. Times are the thread's own processor time; the wall's stand beside them.
core::BenchmarkReport runTouchBenchmark(bool quick, const core::Progress& progress,
                                        const std::vector<TouchScene>& scans = {});

} // namespace petrous::haptics
