#include "petrous/Dissection/Dissection.h"

#include <set>
#include <utility>

namespace petrous::dissection
{

Dissection::Dissection(const core::GridGeometry& geometry)
  : m_mask(geometry)
  , m_before(geometry)
{
}

bool Dissection::undo()
{
  if (m_open || m_applied == 0)
    return false;
  --m_applied;
  for (const BrickDelta& delta : m_strokes[m_applied]->deltas)
    m_mask.setBrick(delta.brick, delta.before);
  return true;
}

bool Dissection::redo()
{
  if (m_open || m_applied == m_strokes.size())
    return false;
  for (const BrickDelta& delta : m_strokes[m_applied]->deltas)
    m_mask.setBrick(delta.brick, delta.after);
  ++m_applied;
  return true;
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

std::vector<std::size_t> Dissection::openBricks() const
{
  std::vector<std::size_t> bricks;
  bricks.reserve(m_touched.size());
  for (const auto& entry : m_touched)
    bricks.push_back(entry.first);
  return bricks;
}

std::shared_ptr<const Stroke> Dissection::endStroke()
{
  if (!m_open)
    return nullptr;
  m_open = false;
  if (m_touched.empty())
    return nullptr;
  auto stroke = std::make_shared<Stroke>();
  stroke->info = m_info;
  stroke->deltas.reserve(m_touched.size());
  for (const auto& [brick, before] : m_touched)
    stroke->deltas.push_back({brick, before, m_mask.brick(brick)});
  m_touched.clear();
  m_strokes.resize(m_applied);
  m_strokes.push_back(stroke);
  m_applied = m_strokes.size();
  return stroke;
}

void Dissection::append(std::shared_ptr<const Stroke> stroke)
{
  if (m_open || m_applied != m_strokes.size())
    throw core::InvalidParameter("dissection: strokes are appended only at the end");
  for (const BrickDelta& delta : stroke->deltas)
    m_mask.setBrick(delta.brick, delta.after);
  m_strokes.push_back(std::move(stroke));
  m_applied = m_strokes.size();
}

std::size_t Dissection::historyBytes() const
{
  std::set<const volume::CutMask::Brick*> versions;
  for (const auto& stroke : m_strokes)
    for (const BrickDelta& delta : stroke->deltas)
    {
      versions.insert(delta.before.get());
      versions.insert(delta.after.get());
    }
  versions.erase(nullptr);
  return versions.size() * sizeof(volume::CutMask::Brick);
}

} // namespace petrous::dissection
