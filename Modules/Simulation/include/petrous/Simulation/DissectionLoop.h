#pragma once

#include <cstdint>
#include <functional>
#include <limits>

#include "petrous/Dissection/Dissection.h"
#include "petrous/Simulation/RemovalModel.h"
#include "petrous/Simulation/MaskEdit.h"
#include "petrous/Volume/PublishedMask.h"

namespace petrous::simulation
{

/// What follows a servo tick in the tissue: the drill's bite, strokes, undo. The only writer of the
/// mask and of its published states. One thread.
///
/// Alternating with the servo (tick, step, tick, step ...) the same records give the same mask; in
/// a thread of its own it may lag, and takes bites at nearly one place together.
///
/// When a cut throws (no memory), mask and stroke are as they were before it.
class DissectionLoop
{
public:
  using Begin = std::function<dissection::StrokeInfo()>; ///< what is known of a new stroke
  using Edited = std::function<void(const MaskEdit&)>;   ///< once done: for a recording

  struct Hooks
  {
    Begin begin;
    std::function<void(dissection::Dissection&)> close; ///< closes the open stroke; empty:
                                                        ///< Dissection::endStroke
    std::function<bool(bool back)> turn; ///< one stroke back (true) or forth, false when there is
                                         ///< none; empty: Dissection::undo, redo
    std::function<void(const std::vector<std::size_t>&)> changed; ///< bricks, once published
    Edited edited;
  };

  /// All must outlive this; `mask` must have been published from dissection.mask().
  DissectionLoop(dissection::Dissection& dissection, volume::PublishedMask& mask, RemovalModel& removalModel,
                 dissection::ProtectedTissue keep = {}, Hooks hooks = {});

  /// What follows one tick; true when tissue was taken.
  bool step(const TickRecord& record);

  /// What follows `count` ticks, oldest first: where the tool hardly moved (`kTogether`) between
  /// bites only the last is made, which goes on from the others (RemovalModel).
  bool step(const TickRecord* records, std::size_t count);
  static constexpr double kTogether = 0.05; ///< mm

  /// Instead of a step where no force leads and the drill is on: all that `burr` sweeps is taken.
  bool sweep(const TickRecord& record, const dissection::SweptSphere& burr);

  /// Closes the stroke that is open.
  void endStroke();

  /// One stroke back or forth, the open one closed first; false when there is none.
  bool undo();
  bool redo();

  /// Does again what was recorded. False when it does not lead to the state that it led to then.
  bool apply(const MaskEdit& edit);

  /// Number of the mask's present state.
  std::uint64_t state() const noexcept { return m_mask.number(); }

  /// Ticks up to this time (TickRecord::time) drill no more: in threads some that were made before
  /// an undo come after it, and would cut what has just come back.
  void ignoreUntil(double time) noexcept { m_ignoreUntil = time; }

  const dissection::Dissection& dissection() const noexcept { return m_dissection; }
  std::uint64_t cuts() const noexcept { return m_cuts; } ///< bites that took tissue

private:
  double secondsOf(const TickRecord& record);
  bool follow(const TickRecord& record);
  bool cut(const dissection::SweptSphere& burr);
  void open();
  bool turn(bool back);
  void publish(bool raised);
  void putBack();
  void notify(MaskEdit edit) const;

  dissection::Dissection& m_dissection;
  volume::PublishedMask& m_mask;
  RemovalModel& m_removalModel;
  dissection::ProtectedTissue m_keep;
  Hooks m_hooks;
  double m_time = 0.0;
  bool m_hasTime = false;
  double m_ignoreUntil = -std::numeric_limits<double>::infinity();
  std::uint64_t m_cuts = 0;
};

} // namespace petrous::simulation
