#include "JointHistogram.h"

#include <algorithm>
#include <cmath>

namespace petrous::registration
{

JointHistogram::JointHistogram(const std::vector<std::vector<float>>& parts, int rows, int columns)
  : both(static_cast<std::size_t>(rows) * columns, 0.0)
  , ofFixed(static_cast<std::size_t>(rows), 0.0)
  , ofMoving(static_cast<std::size_t>(columns), 0.0)
{
  for (const auto& part : parts)
    for (std::size_t n = 0; n < both.size(); ++n)
      both[n] += part[n];
  for (std::size_t f = 0; f < ofFixed.size(); ++f)
    for (std::size_t m = 0; m < ofMoving.size(); ++m)
    {
      const double p = both[f * ofMoving.size() + m];
      ofFixed[f] += p;
      ofMoving[m] += p;
    }
  for (const double p : ofFixed)
    total += p;
  if (total <= 0.0)
    return;
  for (auto* list : {&both, &ofFixed, &ofMoving})
    for (double& p : *list)
      p /= total;
}

double JointHistogram::information() const
{
  double sum = 0.0;
  for (std::size_t f = 0; f < ofFixed.size(); ++f)
    for (std::size_t m = 0; m < ofMoving.size(); ++m)
      if (const double p = both[f * ofMoving.size() + m]; p > 0.0)
        sum += p * std::log(p / (ofFixed[f] * ofMoving[m]));
  return std::max(0.0, sum);
}

std::vector<float> JointHistogram::gradientWeights() const
{
  std::vector<float> table(both.size(), 0.0f);
  for (std::size_t f = 0; f < ofFixed.size(); ++f)
    for (std::size_t m = 0; m < ofMoving.size(); ++m)
      if (const double p = both[f * ofMoving.size() + m]; p > 0.0)
        table[f * ofMoving.size() + m] = static_cast<float>(std::log(p / ofMoving[m]));
  return table;
}

} // namespace petrous::registration
