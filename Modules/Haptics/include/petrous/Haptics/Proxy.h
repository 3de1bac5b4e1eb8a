#pragma once

#include "petrous/Haptics/ProxyTick.h"

namespace petrous::haptics
{

/// The simulated tool, constrained by tissue and coupled to the device pose by a spring. Not
/// thread-safe; does not allocate, lock or throw.
class Proxy
{
public:
  virtual ~Proxy() = default;

  /// Pose of the tool, X_PT, patient LPS mm.
  virtual const Pose& pose() const noexcept = 0;

  /// Places the tool at `pose`. Inside tissue it stays without contact until it is free.
  virtual void place(const Pose& pose) noexcept = 0;

  /// Likewise, but only where there is no tissue; otherwise returns false and the tool stays.
  virtual bool placeFree(const Pose& pose) noexcept = 0;

  /// One tick towards `goal`. If `goal` is not finite, the tool stays and the wrench is zero. The
  /// result is valid until the next call.
  virtual const ProxyTick& step(const Pose& goal) noexcept = 0;
};

} // namespace petrous::haptics
