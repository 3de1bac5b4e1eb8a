#pragma once

#include "petrous/Haptics/ProxyTick.h"

namespace petrous::haptics
{

/// The tool that tissue holds back, tied to the hand by a spring. One thread; nothing here
/// allocates, locks or throws.
class Proxy
{
public:
  virtual ~Proxy() = default;

  /// Where the tool is, X_PT, patient LPS mm.
  virtual const Pose& pose() const noexcept = 0;

  /// Puts the tool where it is told. Inside tissue it stays without contact until it is free.
  virtual void place(const Pose& pose) noexcept = 0;

  /// The same where no tissue is; false, and it stays where it is, where there is some.
  virtual bool placeFree(const Pose& pose) noexcept = 0;

  /// One tick towards `goal`, which must be finite; otherwise the tool stays and the wrench is
  /// zero. The result holds until the next call.
  virtual const ProxyTick& step(const Pose& goal) noexcept = 0;
};

} // namespace petrous::haptics
