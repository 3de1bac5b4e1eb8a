#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "petrous/Dissection/History.h"
#include "petrous/Dissection/Stroke.h"
#include "petrous/Dissection/SweptSphereCut.h"

namespace petrous::dissection
{

/// The cut mask with its strokes and their undo history.
///
/// Value semantics: a copy is a fork that shares the bricks. Not thread-safe.
class Dissection
{
public:
  explicit Dissection(const core::GridGeometry& geometry);

  /// Restores saved strokes, at the state of `history`. Throws InvalidParameter if an applied
  /// stroke is damaged, or does not fit the grid or the stroke before it.
  Dissection(const core::GridGeometry& geometry, std::vector<std::shared_ptr<const Stroke>> strokes,
             const History& history);

  const volume::CutMask& mask() const noexcept { return m_mask; }
  volume::CutMask& mask() noexcept ///< for takeDirty
  {
    return m_mask;
  }

  /// All strokes in order of creation, and the tree that they form.
  const std::vector<std::shared_ptr<const Stroke>>& strokes() const noexcept { return m_strokes; }
  const History& history() const noexcept { return m_history; }
  std::size_t applied() const { return m_history.applied(); } ///< strokes applied to the mask

  /// Increases whenever strokes or history change.
  std::uint64_t changes() const noexcept { return m_changes; }

  /// Undoes or redoes one stroke along the current branch; false if there is none, or while a
  /// stroke is open.
  bool undo();
  bool redo();

  /// Switches to the state of `next`, which must have the strokes of this history: undo and redo of
  /// any depth, or another branch. Throws InvalidParameter, without changing anything, during a
  /// stroke or if a stroke loaded from disk is damaged.
  void follow(const History& next);

  /// See History::remove.
  std::vector<std::size_t> removeBranch(const std::string& name);

  /// Opens a stroke. Throws InvalidParameter if one is already open.
  void beginStroke(const StrokeInfo& info);
  bool strokeOpen() const noexcept { return m_open; }

  /// Cuts within the open stroke; returns true if a voxel changed.
  bool cut(const SweptSphere& burr, const ProtectedTissue& keep = {});

  /// The mask as it was when the open stroke began.
  const volume::CutMask& maskBeforeStroke() const noexcept { return m_before; }

  /// Bricks changed so far by the open stroke, sorted; also valid in a copy whose mask follows the
  /// stroke by whole bricks.
  std::vector<std::size_t> openBricks() const;

  /// Information of the open stroke, to be completed before it ends.
  StrokeInfo& openInfo() noexcept { return m_info; }
  const StrokeInfo& openInfo() const noexcept { return m_info; }

  /// Reapplies encoded deltas within the open stroke; see applyDeltas.
  void cutAgain(const std::vector<std::uint8_t>& packed);

  /// Closes the stroke and adds it to the history; nullptr, and no entry, if it changed nothing.
  std::shared_ptr<const Stroke> endStroke();

  /// Adds a stroke that starts from the current state and applies it. Throws as `follow` does.
  void append(std::shared_ptr<const Stroke> stroke);

  /// Memory held by strokes, bytes: encoded strokes, and the original bricks of the open one.
  std::size_t historyBytes() const;

private:
  void change(std::vector<BrickDelta> deltas);

  volume::CutMask m_mask;
  volume::CutMask m_before;
  std::vector<std::shared_ptr<const Stroke>> m_strokes;
  History m_history;
  std::uint64_t m_changes = 0;
  bool m_open = false;
  StrokeInfo m_info;
  std::map<std::size_t, volume::CutMask::BrickVersion> m_touched; ///< brick -> version before
};

} // namespace petrous::dissection
