#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

namespace petrous::core
{

/// One measurement: how long it took, and how wrong its result was.
struct BenchmarkPoint
{
  std::map<std::string, std::string> setting; ///< name -> value with its unit in the name
  std::string scene;                          ///< what was worked on, e.g. "phantom 512^3"
  bool isDefault = false;                     ///< the setting that the product uses
  double seconds = 0.0;                       ///< median wall time of the operation
  double error = 0.0;                         ///< in errorUnit, against the stated truth
  std::string errorUnit;
  std::string peer;   ///< the other program or rule measured in the same run; empty for ours
  std::string series; ///< the parameter that is varied; its points are joined in the plot. What
                      ///< else tells the series from others follows after a comma.
  std::map<std::string, double> extra; ///< further figures, unit in the name
};

/// The outcome of one `petrous bench NAME`.
struct BenchmarkReport
{
  std::string name;
  std::string title;
  std::vector<BenchmarkPoint> points;
  std::map<std::string, std::string> machine = {}; ///< beside the processor, e.g. the GPU
};

} // namespace petrous::core
