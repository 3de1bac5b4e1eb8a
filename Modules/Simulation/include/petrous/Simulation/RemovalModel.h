#pragma once

#include <optional>

#include "petrous/Dissection/SweptSphereCut.h"
#include "petrous/Simulation/TickRecord.h"

namespace petrous::simulation
{

/// How far a drill that is pressed goes into the tissue. One thread.
class RemovalModel
{
public:
  virtual ~RemovalModel() = default;

  /// The drill is on and the burr pressed, for `seconds` of a tick.
  virtual void press(const TickRecord& record, double seconds) = 0;

  /// What the burr takes now; asked again, once that is cut from `mask`, until it is nothing.
  virtual std::optional<dissection::SweptSphere> bite(const volume::CutMask& mask) = 0;

  /// The drill is off, or the burr touches nothing any more.
  virtual void release() = 0;
};

/// Takes nothing: for a loop that only does again what was recorded.
class NoRemovalModel : public RemovalModel
{
public:
  void press(const TickRecord&, double) override {}
  std::optional<dissection::SweptSphere> bite(const volume::CutMask&) override { return {}; }
  void release() override {}
};

} // namespace petrous::simulation
