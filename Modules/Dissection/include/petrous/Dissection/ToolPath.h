#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <istream>
#include <string>
#include <vector>

#include "petrous/Core/RigidTransform.h"

namespace petrous::dissection
{

/// Tool pose over time: origin at the burr's centre, +z along the shaft towards the handpiece.
struct ToolSample
{
  double time = 0.0;         ///< s
  core::RigidTransform pose; ///< X_PT, patient LPS mm
  bool drill = false;        ///< holds until the next sample
};

/// A recorded or authored tool path, at increasing times.
class ToolPath
{
public:
  /// CSV with the header t_s,x_mm,y_mm,z_mm,qw,qx,qy,qz,drill (columns in any order). Throws
  /// InvalidParameter "NAME, line N: ..." if a column is missing, a number is not finite, a
  /// quaternion is zero, time does not increase or drill is neither 0 nor 1.
  static ToolPath read(std::istream& csv, const std::string& name);

  const std::vector<ToolSample>& samples() const noexcept { return m_samples; }

  /// Calls `tick` every 1/rate s from the first sample to the last one, both included, and at each
  /// sample where the drill switches on or off; the position is interpolated linearly, the rotation
  /// by slerp. Throws InvalidParameter for a rate that is not above 0 Hz and for a path of more
  /// than 1e8 ticks.
  void play(double rate, const std::function<void(const ToolSample&)>& tick) const;

private:
  std::vector<ToolSample> m_samples;
};

} // namespace petrous::dissection
