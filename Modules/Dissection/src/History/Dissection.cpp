#include "petrous/Dissection/Dissection.h"

#include <utility>

#include "petrous/Dissection/StrokeCodec.h"

namespace petrous::dissection
{

namespace
{

// The strokes of `history`, at their start.
History atStart(const History& history)
{
  std::vector<std::size_t> parents(history.size());
  for (std::size_t n = 0; n < parents.size(); ++n)
    parents[n] = history.parent(n);
  return {std::move(parents), {{History::kMain}}, 0};
}

} // namespace

Dissection::Dissection(const core::GridGeometry& geometry)
  : m_mask(geometry)
  , m_before(geometry)
{
}

Dissection::Dissection(const core::GridGeometry& geometry,
                       std::vector<std::shared_ptr<const Stroke>> strokes, const History& history)
  : m_mask(geometry)
  , m_before(geometry)
  , m_strokes(std::move(strokes))
  , m_history(atStart(history))
{
  follow(history);
  m_mask.takeDirty();
}

void Dissection::change(std::vector<BrickDelta> deltas)
{
  for (BrickDelta& delta : deltas)
    m_mask.setBrick(delta.brick, std::move(delta.after));
}

void Dissection::follow(const History& next)
{
  if (m_open)
    throw core::InvalidParameter("dissection: a stroke is open");
  if (next.size() != m_strokes.size())
    throw core::InvalidParameter("dissection: the history is that of other strokes");
  const History::Path path = next.path(m_history.position(), next.position());
  BrickDraft draft(m_mask);
  for (const std::size_t stroke : path.undone)
    applyDeltas(m_strokes[stroke]->packed, Step::Undo, draft);
  for (const std::size_t stroke : path.redone)
    applyDeltas(m_strokes[stroke]->packed, Step::Redo, draft);
  History history = next;
  change(draft.take());
  m_history = std::move(history);
  ++m_changes;
}

bool Dissection::undo()
{
  History next = m_history;
  if (m_open || !next.undo())
    return false;
  follow(next);
  return true;
}

bool Dissection::redo()
{
  History next = m_history;
  if (m_open || !next.redo())
    return false;
  follow(next);
  return true;
}

std::vector<std::size_t> Dissection::removeBranch(const std::string& name)
{
  const std::vector<std::size_t> kept = m_history.remove(name);
  std::vector<std::shared_ptr<const Stroke>> strokes;
  for (const std::size_t stroke : kept)
    strokes.push_back(m_strokes[stroke]);
  m_strokes = std::move(strokes);
  ++m_changes;
  return kept;
}

void Dissection::beginStroke(const StrokeInfo& info)
{
  if (m_open)
    throw core::InvalidParameter("dissection: a stroke is open already");
  m_open = true;
  m_info = info;
  m_touched.clear();
  m_before = m_mask;
}

bool Dissection::cut(const SweptSphere& burr, const ProtectedTissue& keep)
{
  if (!m_open)
    throw core::InvalidParameter("dissection: no stroke is open");
  const auto changed = dissection::cut(m_mask, burr, keep);
  for (const std::size_t brick : changed)
    m_touched.emplace(brick, m_before.brick(brick));
  return !changed.empty();
}

void Dissection::cutAgain(const std::vector<std::uint8_t>& packed)
{
  if (!m_open)
    throw core::InvalidParameter("dissection: no stroke is open");
  BrickDraft draft(m_mask);
  applyDeltas(packed, Step::Redo, draft);
  auto deltas = draft.take();
  for (const BrickDelta& delta : deltas)
    m_touched.emplace(delta.brick, m_before.brick(delta.brick));
  change(std::move(deltas));
}

std::vector<std::size_t> Dissection::openBricks() const
{
  std::vector<std::size_t> bricks;
  if (!m_open)
    return bricks;
  for (std::size_t brick = 0; brick < m_mask.brickCount(); ++brick)
    if (m_mask.brick(brick) != m_before.brick(brick))
      bricks.push_back(brick);
  return bricks;
}

std::shared_ptr<const Stroke> Dissection::endStroke()
{
  if (!m_open)
    return nullptr;
  std::shared_ptr<Stroke> stroke;
  if (!m_touched.empty())
  {
    std::vector<BrickDelta> deltas;
    deltas.reserve(m_touched.size());
    for (const auto& [brick, before] : m_touched)
      deltas.push_back({brick, before, m_mask.brick(brick)});
    stroke = std::make_shared<Stroke>(Stroke{m_info, encodeDeltas(deltas)});
    m_strokes.push_back(stroke);
    m_history.add();
    ++m_changes;
  }
  m_open = false;
  m_touched.clear();
  m_before = volume::CutMask(m_mask.geometry()); // releases the original bricks
  return stroke;
}

void Dissection::append(std::shared_ptr<const Stroke> stroke)
{
  if (m_open)
    throw core::InvalidParameter("dissection: a stroke is open");
  BrickDraft draft(m_mask);
  applyDeltas(stroke->packed, Step::Redo, draft);
  m_strokes.push_back(std::move(stroke));
  m_history.add();
  ++m_changes;
  change(draft.take());
}

std::size_t Dissection::historyBytes() const
{
  std::size_t bytes = m_strokes.capacity() * sizeof m_strokes.front();
  for (const auto& stroke : m_strokes)
  {
    bytes += sizeof(Stroke) + stroke->packed.capacity() + stroke->info.startedAt.capacity() +
             stroke->info.structures.capacity() * sizeof(TouchedStructure);
    for (const TouchedStructure& touched : stroke->info.structures)
      bytes += touched.name.capacity();
  }
  for (const auto& [brick, before] : m_touched)
    bytes += before ? sizeof(volume::CutMask::Brick) : 0;
  return bytes;
}

} // namespace petrous::dissection
