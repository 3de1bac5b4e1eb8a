#pragma once

#include <optional>

#include "petrous/Dissection/SweptSphereCut.h"
#include "petrous/Session/TickRecord.h"

namespace petrous::session
{

/// Advance of a pressed drill into the tissue. Not thread-safe.
class RemovalModel
{
public:
  virtual ~RemovalModel() = default;

  /// The drill is on and the burr pressed, for a tick of `seconds`.
  virtual void press(const TickRecord& record, double seconds) = 0;

  /// The next step of removal; called again, after cutting it from `mask`, until nullopt.
  virtual std::optional<dissection::SweptSphere> nextCut(const volume::CutMask& mask) = 0;

  /// The drill is off, or the burr has lost contact.
  virtual void release() = 0;
};

/// Removes nothing: for a loop that only replays edits.
class NoRemovalModel : public RemovalModel
{
public:
  void press(const TickRecord&, double) override {}
  std::optional<dissection::SweptSphere> nextCut(const volume::CutMask&) override { return {}; }
  void release() override {}
};

} // namespace petrous::session
