#pragma once

#include <functional>

#include "MutualInformation.h"

namespace petrous::registration
{

struct BfgsOptions
{
  int evaluations = 60;   ///< maximum, of the metric with its gradient
  double gradient = 1e-6; ///< convergence: gradient norm, nats per mm
  double change = 1e-8;   ///< convergence: relative gain over two successive steps
  double firstStep = 1.0; ///< mm, RMS displacement of the samples
  double maxStep = 10.0;  ///< mm
  bool turns = true;      ///< false: translations only
};

struct Optimum
{
  core::RigidTransform pose; ///< best pose seen
  double information = 0.0;  ///< nats, at that pose
  double overlap = 0.0;
  int evaluations = 0;
};

/// Called for each evaluation; an exception thrown by it ends the optimization and propagates.
using EvaluationListener =
    std::function<void(const core::RigidTransform& pose, double information)>;

/// Finds the nearest local maximum of the metric: BFGS (Nocedal and Wright 2006, 6.1) with a
/// backtracking line search. (Of ITK's two implementations, one writes to the console, the other
/// cannot run in two threads.)
Optimum maximize(const MutualInformation& metric, const core::RigidTransform& start,
                 const BfgsOptions& options, const EvaluationListener& listener = {});

} // namespace petrous::registration
