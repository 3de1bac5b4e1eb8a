#pragma once

#include <functional>

#include "MutualInformation.h"

namespace petrous::registration
{

struct BfgsOptions
{
  int evaluations = 60;      ///< of the metric with its gradient, at most
  double gradient = 1e-6;    ///< nats a mm: flatter is the top
  double change = 1e-8;      ///< share of the metric that two steps on end must win
  double firstStep = 1.0;    ///< mm, root mean square of the samples
  double maxStep = 10.0; ///< mm
  bool turns = true;         ///< false: translations alone
};

struct Optimum
{
  core::RigidTransform pose; ///< the best seen
  double information = 0.0;  ///< nats, there
  double overlap = 0.0;
  int evaluations = 0;
};

/// Told of each evaluation; what it throws ends the ascent and reaches the caller.
using EvaluationListener = std::function<void(const core::RigidTransform& pose, double information)>;

/// Climbs to the nearest maximum of the metric: BFGS (Nocedal and Wright 2006, 6.1) with steps
/// shortened until they gain. (Of the two in ITK's libraries one writes to the console, the other
/// cannot run in two threads.)
Optimum maximize(const MutualInformation& metric, const core::RigidTransform& start,
              const BfgsOptions& options, const EvaluationListener& listener = {});

} // namespace petrous::registration
