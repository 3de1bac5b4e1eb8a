#pragma once

#include <cstdint>
#include <functional>
#include <limits>

#include "petrous/Dissection/Dissection.h"
#include "petrous/Session/MaskEdit.h"
#include "petrous/Session/RemovalModel.h"
#include "petrous/Session/SpindleMeter.h"
#include "petrous/Volume/PublishedMask.h"

namespace petrous::session
{

/// Applies a servo tick to the tissue: drill bites, strokes, undo. The only writer of the mask and
/// of its published states. Not thread-safe.
///
/// Alternating with the servo (tick, step, tick, step ...) the same records give the same mask; in
/// a separate thread it may lag and combine bites at nearly the same position.
///
/// If a cut throws (out of memory), mask and stroke are left unchanged.
class DissectionLoop
{
public:
  using Begin = std::function<dissection::StrokeInfo()>; ///< known properties of a new stroke
  using Edited = std::function<void(const MaskEdit&)>;   ///< after each edit: for a recording

  struct Hooks
  {
    Begin begin;
    std::function<void(dissection::Dissection&)> close; ///< closes the open stroke; empty:
                                                        ///< Dissection::endStroke
    std::function<void(const std::vector<std::size_t>&)> changed; ///< bricks, after publishing
    Edited edited;
  };

  /// All must outlive this; `mask` must have been published from dissection.mask().
  DissectionLoop(dissection::Dissection& dissection, volume::PublishedMask& mask,
                 RemovalModel& removalModel, dissection::ProtectedTissue keep = {},
                 Hooks hooks = {});

  /// Processes one tick; true if tissue was removed.
  bool step(const TickRecord& record);

  /// Processes `count` ticks, oldest first: while the tool hardly moves (`kTogether`), only the
  /// last step is made, with the accumulated work (RemovalModel).
  bool step(const TickRecord* records, std::size_t count);
  static constexpr double kTogether = 0.05; ///< mm

  /// Replaces a step if the drill is on and no force is rendered: removes all that `burr` sweeps.
  bool sweep(const TickRecord& record, const dissection::SweptSphere& burr);

  /// Closes the open stroke.
  void endStroke();

  /// Undoes or redoes one stroke, after closing an open one; false if there is none. A drill that
  /// is on stays without effect until it was off.
  bool undo();
  bool redo();

  /// Repeats a recorded edit. False if the resulting state differs from the recorded one: its
  /// number, or after a redo the mask, if the recording knows it.
  bool apply(const MaskEdit& edit);

  /// Number of the current mask state.
  std::uint64_t state() const noexcept { return m_mask.number(); }

  /// Disables drilling for ticks up to this time (TickRecord::time): with threads, some made before
  /// an undo arrive after it and would cut what was just restored.
  void ignoreUntil(double time) noexcept { m_ignoreUntil = time; }

  const dissection::Dissection& dissection() const noexcept { return m_dissection; }
  std::uint64_t cuts() const noexcept { return m_cuts; } ///< bites that removed tissue

private:
  double secondsOf(const TickRecord& record);
  bool follow(const TickRecord& record);
  bool cut(const dissection::SweptSphere& burr);
  void drilled(const TickRecord& record, double seconds);
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
  SpindleMeter m_spindle;  // of the open stroke
  bool m_on = false;       // the drill, in the last tick
  bool m_untilOff = false; // it has been on since before undo or redo
  double m_ignoreUntil = -std::numeric_limits<double>::infinity();
  std::uint64_t m_cuts = 0;
};

} // namespace petrous::session
