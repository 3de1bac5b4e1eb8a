#pragma once

#include <string>

#include "petrous/Core/Error.h"
#include "petrous/Haptics/ProxyTick.h"

namespace petrous::haptics
{

/// Common checks of all proxies' parameters. `tool` begins the message: "constrained proxy". Throws
/// InvalidParameter naming the first value out of range.
class ParameterCheck
{
public:
  constexpr explicit ParameterCheck(const char* tool)
    : m_tool(tool)
  {
  }

  void require(bool good, const char* words) const
  {
    if (!good)
      throw core::InvalidParameter(std::string(m_tool) + ": " + words);
  }

  const ProxyParameters& operator()(const ProxyParameters& p) const
  {
    require(p.stiffness > 0.0 && p.stiffness <= 100.0,
            "the stiffness must lie within 0 to 100 N/mm");
    require(p.nearGap > 0.0 && p.nearGap <= 2.0, "the near gap must lie within 0 to 2 voxels");
    require(p.sweepStep > 0.0 && p.sweepStep <= 1.0,
            "the sweep's step must lie within 0 to 1 voxel");
    require(p.bisections >= 1 && p.bisections <= 30, "bisections must lie within 1 to 30");
    require(p.rounds >= 1 && p.rounds <= 20, "rounds must lie within 1 to 20");
    require(p.deadband >= 0.0 && p.deadband <= 0.1, "the deadband must lie within 0 to 0.1 mm");
    require(p.samples >= 100 && p.samples <= 1000000, "samples must lie within 100 to 1000000");
    return p;
  }

  template <class Field>
  const Field& field(const Field& field) const
  {
    require(field != nullptr, "no field given");
    return field;
  }

private:
  const char* m_tool;
};

} // namespace petrous::haptics
