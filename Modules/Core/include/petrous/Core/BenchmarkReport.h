#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

namespace petrous::core
{

/// One measurement: run time and error of the result.
struct BenchmarkPoint
{
  std::map<std::string, std::string> setting; ///< name -> value with its unit in the name
  std::string scene;                          ///< test object, e.g. "phantom 512^3"
  bool isDefault = false;                     ///< the product's default setting
  double seconds = 0.0;                       ///< median wall time of the operation
  double error = 0.0;                         ///< in errorUnit, relative to the stated reference
  std::string errorUnit;
  std::string peer;   ///< reference program or method measured in the same run; empty for Petrous
  std::string series; ///< the varied parameter; its points are joined in the plot. Further
                      ///< distinguishing parameters follow after a comma.
  std::map<std::string, double> extra; ///< additional figures, unit in the name
};

/// Result of one `petrous bench NAME`.
struct BenchmarkReport
{
  std::string name;
  std::string title;
  std::vector<BenchmarkPoint> points;
  std::map<std::string, std::string> machine = {}; ///< in addition to the processor, e.g. the GPU
};

} // namespace petrous::core
