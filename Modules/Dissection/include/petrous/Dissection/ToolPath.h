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

/// A pose of the tool in time: origin at the burr's centre, +z along the shaft to the hand.
struct ToolSample
{
  double time = 0.0;         ///< s
  core::RigidTransform pose; ///< X_PT, patient LPS mm
  bool drill = false;        ///< holds until the next sample
};

/// A recorded or written path of the tool, at rising times.
class ToolPath
{
public:
  /// CSV with the header t_s,x_mm,y_mm,z_mm,qw,qx,qy,qz,drill (columns in any order).
  /// Throws InvalidParameter "NAME, line N: ..." when a column is missing, a number is not finite,
  /// a quaternion is zero, time does not rise or drill is neither 0 nor 1.
  static ToolPath read(std::istream& csv, const std::string& name);

  const std::vector<ToolSample>& samples() const noexcept { return m_samples; }

  /// Calls `tick` at every 1/rate s from the first sample to the last one, both included, and at
  /// each sample where the drill goes on or off; the position is interpolated linearly, the
  /// rotation on the shortest arc. Throws InvalidParameter for a rate that is not above 0 Hz and
  /// for a path of more than 1e8 ticks.
  void play(double rate, const std::function<void(const ToolSample&)>& tick) const;

private:
  std::vector<ToolSample> m_samples;
};

} // namespace petrous::dissection
