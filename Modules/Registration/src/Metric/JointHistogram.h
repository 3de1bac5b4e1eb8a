#pragma once

#include <vector>

namespace petrous::registration
{

/// How often values of the fixed image (rows) meet values of the moving one (columns), with the
/// margins; shares of the total weight.
struct JointHistogram
{
  std::vector<double> both; ///< row after row
  std::vector<double> ofFixed;
  std::vector<double> ofMoving;
  double total = 0.0; ///< weight before it was divided out

  /// The sum of parts, in their order.
  JointHistogram(const std::vector<std::vector<float>>& parts, int rows, int columns);

  double information() const; ///< nats

  /// log(p(f, m) / p(m)) of each cell, what a sample that moves there brings; 0 of empty cells.
  std::vector<float> gradientWeights() const;
};

} // namespace petrous::registration
