#pragma once

#include <map>
#include <memory>
#include <vector>

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

  const volume::CutMask& mask() const noexcept { return m_mask; }
  volume::CutMask& mask() noexcept ///< for takeDirty
  {
    return m_mask;
  }

  /// All strokes; the first `applied()` of them are in the mask, the rest can be redone.
  const std::vector<std::shared_ptr<const Stroke>>& strokes() const noexcept { return m_strokes; }
  std::size_t applied() const noexcept { return m_applied; }

  /// One stroke back or forth; false when there is none. Not during a stroke.
  bool undo();
  bool redo();

  /// Opens a stroke; the strokes that were undone are given up once it cuts. Throws
  /// InvalidParameter when one is open already.
  void beginStroke(const StrokeInfo& info);
  bool strokeOpen() const noexcept { return m_open; }

  /// Cuts within the open stroke; true when a voxel changed.
  bool cut(const SweptSphere& burr, const ProtectedTissue& keep = {});

  /// The mask as it was when the open stroke began.
  const volume::CutMask& maskBeforeStroke() const noexcept { return m_before; }

  /// Bricks that the open stroke has changed so far, sorted.
  std::vector<std::size_t> openBricks() const;

  /// Information of the open stroke, to be completed before it ends.
  StrokeInfo& openInfo() noexcept { return m_info; }

  /// Closes the stroke; null (and no entry) when it changed nothing.
  std::shared_ptr<const Stroke> endStroke();

  /// Appends a stroke read from disk, which must start from the present mask, and applies it.
  /// Only while nothing is undone.
  void append(std::shared_ptr<const Stroke> stroke);

  /// Memory that the strokes' brick versions hold, each shared version counted once, bytes.
  std::size_t historyBytes() const;

private:
  volume::CutMask m_mask;
  volume::CutMask m_before;
  std::vector<std::shared_ptr<const Stroke>> m_strokes;
  std::size_t m_applied = 0;
  bool m_open = false;
  StrokeInfo m_info;
  std::map<std::size_t, volume::CutMask::BrickVersion> m_touched; ///< brick -> version before
};

} // namespace petrous::dissection
