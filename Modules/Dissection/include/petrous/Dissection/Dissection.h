#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "petrous/Dissection/History.h"
#include "petrous/Dissection/Stroke.h"
#include "petrous/Dissection/SweptSphereCut.h"

namespace petrous::dissection
{

/// What was drilled: the strokes with their undo history, and, once loaded, the cut mask of the
/// applied ones. The only place of both.
///
/// Value semantics: a copy is a fork that shares the bricks. Not thread-safe.
class Dissection
{
public:
  using Strokes = std::vector<std::shared_ptr<const Stroke>>;

  Dissection() = default; ///< no strokes, not loaded

  /// Saved strokes, at the state of `history`; not loaded. Throws InvalidParameter if the history
  /// is that of other strokes.
  Dissection(Strokes strokes, const History& history);

  explicit Dissection(const core::GridGeometry& geometry); ///< no strokes, loaded

  /// Saved strokes, loaded. Throws as the constructor above, and as `load`.
  Dissection(const core::GridGeometry& geometry, Strokes strokes, const History& history);

  /// Makes the mask, unless it is there: reads the voxels of the applied strokes, and of no others.
  /// Throws what reading them throws, and InvalidParameter if a stroke is damaged, or does not fit
  /// the grid or the stroke before it; nothing has changed then.
  void load(const core::GridGeometry& geometry);
  bool loaded() const noexcept { return m_mask.shared != nullptr; }
  void unload() noexcept; ///< drops the mask, and what is open of a stroke

  /// Of the applied strokes, and of the open one; only if loaded.
  const volume::CutMask& mask() const noexcept { return *m_mask.shared; }
  volume::CutMask& mask() noexcept ///< for takeDirty
  {
    return *m_mask.shared;
  }

  /// The same for a field or a picture, which sees what is cut later, also after an assignment to
  /// this object, and not what is cut in a copy. nullptr if not loaded.
  std::shared_ptr<const volume::CutMask> sharedMask() const noexcept { return m_mask.shared; }

  /// All strokes in order of creation, and the tree that they form.
  const Strokes& strokes() const noexcept { return m_strokes; }
  const History& history() const noexcept { return m_history; }
  std::size_t applied() const { return m_history.applied(); } ///< strokes applied to the mask

  /// Increases whenever strokes or history change.
  std::uint64_t changes() const noexcept { return m_changes; }

  /// Undoes or redoes strokes along the current branch; returns how many: fewer if there are no
  /// more, none while a stroke is open. Throws as `follow`.
  std::size_t undo(std::size_t count = 1);
  std::size_t redo(std::size_t count = 1);

  /// Switches to the state of `next`, which must have the strokes of this history: undo and redo of
  /// any depth, or another branch. Reads the voxels of strokes that are redone, also if not loaded:
  /// a damaged one is not applied. Throws what reading them throws, and InvalidParameter during a
  /// stroke or if one is damaged; nothing has changed then.
  void follow(const History& next);

  /// Follows a fork that was drilled on since: takes over its state and its new strokes. Strokes
  /// that both have stay as they are here: they may have been stored since.
  void catchUp(Dissection ahead);

  /// States where the voxels of a stroke are stored, and how to read them; they stay the same.
  void setStored(std::size_t stroke, const std::string& object, core::Lazy<Stroke::Voxels> packed);

  /// See History::remove.
  std::vector<std::size_t> removeBranch(const std::string& name);

  /// Opens a stroke. Throws InvalidParameter if one is already open, or if not loaded.
  void beginStroke(const StrokeInfo& info);
  bool strokeOpen() const noexcept { return m_open; }

  /// Cuts within the open stroke; returns true if a voxel changed.
  bool cut(const SweptSphere& burr, const ProtectedTissue& keep = {});

  /// The mask as it was when the open stroke began.
  const volume::CutMask& maskBeforeStroke() const noexcept { return m_before ? *m_before : mask(); }

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
  // A copy has a mask of its own; an assignment changes the mask that others share.
  struct Mask
  {
    Mask() = default;
    explicit Mask(volume::CutMask mask)
      : shared(std::make_shared<volume::CutMask>(std::move(mask)))
    {
    }
    Mask(const Mask& other);
    Mask(Mask&& other) noexcept = default;
    Mask& operator=(const Mask& other);
    Mask& operator=(Mask&& other) noexcept;
    ~Mask() = default;

    std::shared_ptr<volume::CutMask> shared;
  };

  void change(std::vector<BrickDelta> deltas);
  std::size_t step(std::size_t count, bool back);

  Mask m_mask;
  std::optional<volume::CutMask> m_before; ///< while a stroke is open
  Strokes m_strokes;
  History m_history;
  std::uint64_t m_changes = 0;
  bool m_open = false;
  StrokeInfo m_info;
  std::map<std::size_t, volume::CutMask::BrickVersion> m_touched; ///< brick -> version before
};

} // namespace petrous::dissection
