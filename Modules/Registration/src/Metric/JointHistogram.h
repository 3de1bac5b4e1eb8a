#pragma once

#include <vector>

namespace petrous::registration
{

/// Joint histogram of fixed (rows) and moving (columns) values with its marginals, normalized by
/// the total weight.
struct JointHistogram
{
  std::vector<double> both; ///< row-major
  std::vector<double> ofFixed;
  std::vector<double> ofMoving;
  double total = 0.0; ///< weight before normalization

  /// Sums the partial histograms in their order.
  JointHistogram(const std::vector<std::vector<float>>& parts, int rows, int columns);

  double information() const; ///< nats

  /// log(p(f, m) / p(m)) of each cell, its weight in the gradient; 0 for empty cells.
  std::vector<float> gradientWeights() const;
};

} // namespace petrous::registration
