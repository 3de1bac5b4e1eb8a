#include "petrous/Dissection/Dissection.h"

#include <algorithm>
#include <utility>

#include "petrous/Dissection/RemovedVolume.h"
#include "petrous/Dissection/StrokeCodec.h"

namespace petrous::dissection
{

namespace
{

std::shared_ptr<const Stroke::Voxels> voxelsOf(const Stroke& stroke)
{
  auto voxels = stroke.packed.get();
  if (!voxels)
    throw core::InvalidParameter("stroke: only its metadata are known");
  return voxels;
}

} // namespace

Dissection::Mask::Mask(const Mask& other)
  : shared(other.shared ? std::make_shared<volume::CutMask>(*other.shared) : nullptr)
{
}

Dissection::Mask& Dissection::Mask::operator=(const Mask& other)
{
  if (shared && other.shared)
    *shared = *other.shared;
  else
    shared = Mask(other).shared;
  return *this;
}

Dissection::Mask& Dissection::Mask::operator=(Mask&& other) noexcept
{
  if (shared && other.shared)
    *shared = std::move(*other.shared);
  else
    shared = std::move(other.shared);
  return *this;
}

Dissection::Dissection(Strokes strokes, const History& history)
  : m_strokes(std::move(strokes))
  , m_history(history)
{
  if (m_history.size() != m_strokes.size())
    throw core::InvalidParameter("the history is that of other strokes");
}

Dissection::Dissection(const core::GridGeometry& geometry)
  : m_mask(volume::CutMask(geometry))
{
}

Dissection::Dissection(const core::GridGeometry& geometry, Strokes strokes, const History& history)
  : Dissection(std::move(strokes), history)
{
  load(geometry);
}

void Dissection::load(const core::GridGeometry& geometry)
{
  if (loaded())
    return;
  volume::CutMask mask(geometry);
  BrickDraft draft(mask);
  for (const std::size_t stroke : m_history.lineTo(m_history.position()))
    applyDeltas(*voxelsOf(*m_strokes[stroke]), Step::Redo, draft);
  for (BrickDelta& delta : draft.take())
    mask.setBrick(delta.brick, std::move(delta.after));
  mask.takeDirty();
  m_mask = Mask(std::move(mask));
}

void Dissection::unload() noexcept
{
  m_mask.shared.reset();
  m_before.reset();
  m_touched.clear();
  m_open = false;
}

void Dissection::change(std::vector<BrickDelta> deltas)
{
  for (BrickDelta& delta : deltas)
    mask().setBrick(delta.brick, std::move(delta.after));
}

void Dissection::follow(const History& next)
{
  if (m_open)
    throw core::InvalidParameter("dissection: a stroke is open");
  if (next.size() != m_strokes.size())
    throw core::InvalidParameter("dissection: the history is that of other strokes");
  const History::Path path = next.path(m_history.position(), next.position());
  History history = next;
  if (loaded())
  {
    BrickDraft draft(mask());
    for (const std::size_t stroke : path.undone)
      applyDeltas(*voxelsOf(*m_strokes[stroke]), Step::Undo, draft);
    for (const std::size_t stroke : path.redone)
      applyDeltas(*voxelsOf(*m_strokes[stroke]), Step::Redo, draft);
    change(draft.take());
  }
  else
    for (const std::size_t stroke : path.redone)
      m_strokes[stroke]->packed.get();
  m_history = std::move(history);
  ++m_changes;
}

std::size_t Dissection::step(std::size_t count, bool back)
{
  if (m_open)
    return 0;
  History next = m_history;
  std::size_t steps = 0;
  while (steps < count && (back ? next.undo() : next.redo()))
    ++steps;
  if (steps > 0)
    follow(next);
  return steps;
}

std::size_t Dissection::undo(std::size_t count)
{
  return step(count, true);
}

std::size_t Dissection::redo(std::size_t count)
{
  return step(count, false);
}

void Dissection::catchUp(Dissection ahead)
{
  if (ahead.m_strokes.size() < m_strokes.size())
    throw core::InvalidParameter("dissection: the history is that of other strokes");
  std::copy(m_strokes.begin(), m_strokes.end(), ahead.m_strokes.begin());
  *this = std::move(ahead);
}

void Dissection::setStored(std::size_t stroke, const std::string& object,
                           core::Lazy<Stroke::Voxels> packed)
{
  auto stored = std::make_shared<Stroke>(*m_strokes.at(stroke));
  stored->object = object;
  stored->packed = std::move(packed);
  m_strokes[stroke] = std::move(stored);
}

std::vector<std::size_t> Dissection::removeBranch(const std::string& name)
{
  const std::vector<std::size_t> kept = m_history.remove(name);
  Strokes strokes;
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
  if (!loaded())
    throw core::InvalidParameter("dissection: is not loaded");
  m_before = mask();
  m_open = true;
  m_info = info;
  m_touched.clear();
}

bool Dissection::cut(const SweptSphere& burr, const ProtectedTissue& keep)
{
  if (!m_open)
    throw core::InvalidParameter("dissection: no stroke is open");
  const auto changed = dissection::cut(mask(), burr, keep);
  for (const std::size_t brick : changed)
    m_touched.emplace(brick, m_before->brick(brick));
  return !changed.empty();
}

void Dissection::cutAgain(const std::vector<std::uint8_t>& packed)
{
  if (!m_open)
    throw core::InvalidParameter("dissection: no stroke is open");
  BrickDraft draft(mask());
  applyDeltas(packed, Step::Redo, draft);
  auto deltas = draft.take();
  for (const BrickDelta& delta : deltas)
    m_touched.emplace(delta.brick, m_before->brick(delta.brick));
  change(std::move(deltas));
}

std::vector<std::size_t> Dissection::openBricks() const
{
  return m_open ? changedBricks(*m_before, mask()) : std::vector<std::size_t>();
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
      deltas.push_back({brick, before, mask().brick(brick)});
    stroke = std::make_shared<Stroke>(m_info, encodeDeltas(deltas));
    m_strokes.push_back(stroke);
    m_history.add();
    ++m_changes;
  }
  m_open = false;
  m_touched.clear();
  m_before.reset();
  return stroke;
}

void Dissection::append(std::shared_ptr<const Stroke> stroke)
{
  if (m_open)
    throw core::InvalidParameter("dissection: a stroke is open");
  BrickDraft draft(mask());
  applyDeltas(*voxelsOf(*stroke), Step::Redo, draft);
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
    const auto packed = stroke->packed.peek();
    bytes += sizeof(Stroke) + (packed ? packed->capacity() : 0) +
             stroke->info.startedAt.capacity() +
             stroke->info.structures.capacity() * sizeof(TouchedStructure);
    for (const TouchedStructure& touched : stroke->info.structures)
      bytes += touched.name.capacity();
  }
  for (const auto& [brick, before] : m_touched)
    bytes += before ? sizeof(volume::CutMask::Brick) : 0;
  return bytes;
}

} // namespace petrous::dissection
