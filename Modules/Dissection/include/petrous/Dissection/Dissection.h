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

/// The mask with the strokes that led to it, and those undone that can come back.
///
/// A value: a copy is a fork that shares the voxels. Not thread-safe.
class Dissection
{
public:
  explicit Dissection(const core::GridGeometry& geometry);

  /// What was saved, at the state of `history`. Throws InvalidParameter when a stroke that is done
  /// is damaged, or does not fit the grid or the one before.
  Dissection(const core::GridGeometry& geometry, std::vector<std::shared_ptr<const Stroke>> strokes,
             const History& history);

  const volume::CutMask& mask() const noexcept { return m_mask; }
  volume::CutMask& mask() noexcept ///< for takeDirty
  {
    return m_mask;
  }

  /// All strokes in the order in which they were made, and how they follow each other.
  const std::vector<std::shared_ptr<const Stroke>>& strokes() const noexcept { return m_strokes; }
  const History& history() const noexcept { return m_history; }
  std::size_t applied() const { return m_history.applied(); } ///< strokes that are in the mask

  /// Grows whenever strokes or history change.
  std::uint64_t changes() const noexcept { return m_changes; }

  /// One stroke back or forth along the present branch; false when there is none. Not during a
  /// stroke.
  bool undo();
  bool redo();

  /// Goes to the state of `next`, which must have the strokes of this history: undo and redo of any
  /// depth, or another branch. Throws InvalidParameter, and nothing has changed, during a stroke or
  /// where a stroke that came from disk is damaged.
  void follow(const History& next);

  /// See History::remove.
  std::vector<std::size_t> removeBranch(const std::string& name);

  /// Opens a stroke. Throws InvalidParameter when one is open already.
  void beginStroke(const StrokeInfo& info);
  bool strokeOpen() const noexcept { return m_open; }

  /// Cuts within the open stroke; true when a voxel changed.
  bool cut(const SweptSphere& burr, const ProtectedTissue& keep = {});

  /// The mask as it was when the open stroke began.
  const volume::CutMask& maskBeforeStroke() const noexcept { return m_before; }

  /// Bricks that the open stroke has changed so far, sorted; also in a copy whose mask follows the
  /// stroke by whole bricks.
  std::vector<std::size_t> openBricks() const;

  /// Information of the open stroke, to be completed before it ends.
  StrokeInfo& openInfo() noexcept { return m_info; }
  const StrokeInfo& openInfo() const noexcept { return m_info; }

  /// Takes once more what was taken of voxels elsewhere, within the open stroke; see applyDeltas.
  void cutAgain(const std::vector<std::uint8_t>& packed);

  /// Closes the stroke and adds it to the history; null (and no entry) when it changed nothing.
  std::shared_ptr<const Stroke> endStroke();

  /// Adds a stroke that starts from the present state and applies it. Throws as `follow` does.
  void append(std::shared_ptr<const Stroke> stroke);

  /// Memory that the strokes hold, bytes: packed ones, and of an open one its bricks as they were.
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
