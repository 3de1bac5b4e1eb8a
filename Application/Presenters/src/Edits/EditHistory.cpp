#include "petrous/Presenters/EditHistory.h"

#include <algorithm>
#include <utility>

namespace petrous::presenters
{

EditHistory::EditHistory(std::function<Clock::time_point()> now)
  : m_now(std::move(now))
{
}

// What is only tried, while edits are held, may be taken back, and what was undone before it then
// comes back.
void EditHistory::push(Step step)
{
  if (m_held > 0 && !m_undone.empty())
  {
    m_displaced = std::move(m_undone);
    m_displacedBy = step.id;
  }
  m_undone.clear();
  m_done.push_back(std::move(step));
  trim();
}

void EditHistory::trim()
{
  if (m_held == 0 && m_done.size() > kMaxSteps)
    m_done.erase(m_done.begin(),
                 m_done.begin() + static_cast<std::ptrdiff_t>(m_done.size() - kMaxSteps));
}

std::uint64_t EditHistory::did(Edit edit)
{
  const auto now = m_now();
  const bool isSoon = m_held > 0 || now - m_latest <= kPause;
  m_latest = now;
  if (m_open && isSoon && !edit.continues.empty() && !m_done.empty() && m_done.back().edit &&
      m_done.back().edit->continues == edit.continues)
  {
    m_done.back().edit->redo = std::move(edit.redo);
    m_undone.clear();
    return m_done.back().id;
  }
  push({++m_ids, std::move(edit)});
  m_open = true;
  return m_ids;
}

void EditHistory::strokeMade()
{
  push({++m_ids, std::nullopt});
}

void EditHistory::strokeStepped(bool back)
{
  Steps& from = back ? m_done : m_undone;
  const auto stroke = std::find_if(from.rbegin(), from.rend(),
                                   [](const Step& step) { return !step.edit.has_value(); });
  if (stroke != from.rend())
    from.erase(std::next(stroke).base());
  (back ? m_undone : m_done).push_back({++m_ids, std::nullopt});
  m_open = false;
}

EditHistory::Hold::Hold(EditHistory& history)
  : m_history(&history)
  , m_generation(history.m_generation)
{
  if (history.m_held++ == 0)
    history.close();
}

EditHistory::Hold::~Hold()
{
  release();
}

void EditHistory::Hold::release()
{
  EditHistory* history = std::exchange(m_history, nullptr);
  if (history && history->m_generation == m_generation)
    history->letGo();
}

void EditHistory::letGo()
{
  if (--m_held > 0)
    return;
  close();
  m_displaced.clear();
  trim();
}

EditHistory::Steps::iterator EditHistory::find(Steps& steps, std::uint64_t id)
{
  return std::find_if(steps.begin(), steps.end(), [id](const Step& step) { return step.id == id; });
}

void EditHistory::undone(std::uint64_t step)
{
  if (const auto found = find(m_done, step); found != m_done.end())
  {
    m_undone.push_back(std::move(*found));
    m_done.erase(found);
  }
  m_open = false;
}

void EditHistory::redone(std::uint64_t step)
{
  if (const auto found = find(m_undone, step); found != m_undone.end())
  {
    m_done.push_back(std::move(*found));
    m_undone.erase(found);
  }
  m_open = false;
}

// Strokes that another branch has, or that were taken away, are passed over.
template <class AllSteps>
auto* EditHistory::nextIn(AllSteps& steps, std::size_t strokes) noexcept
{
  const auto found = std::find_if(steps.rbegin(), steps.rend(),
                                  [strokes](const Step& step) { return step.edit || strokes > 0; });
  return found == steps.rend() ? nullptr : &*found;
}

// Not beyond a change of the parts, whose names the edits hold.
template <class AllSteps>
auto* EditHistory::nextIn(AllSteps& steps, const std::string& group) noexcept
{
  const auto found =
      std::find_if(steps.rbegin(), steps.rend(),
                   [&group](const Step& step)
                   { return step.edit && (step.edit->group == group || step.edit->changesParts); });
  return found == steps.rend() || found->edit->group != group ? nullptr : &*found;
}

const EditHistory::Edit* EditHistory::next(std::size_t strokes) const noexcept
{
  const Step* step = nextIn(m_done, strokes);
  return step && step->edit ? &*step->edit : nullptr;
}

const EditHistory::Edit* EditHistory::nextRedo(std::size_t strokes) const noexcept
{
  const Step* step = nextIn(m_undone, strokes);
  return step && step->edit ? &*step->edit : nullptr;
}

const EditHistory::Edit* EditHistory::nextOf(const std::string& group) const noexcept
{
  const Step* step = nextIn(m_done, group);
  return step ? &*step->edit : nullptr;
}

const EditHistory::Edit* EditHistory::nextRedoOf(const std::string& group) const noexcept
{
  const Step* step = nextIn(m_undone, group);
  return step ? &*step->edit : nullptr;
}

bool EditHistory::step(Steps& from, Steps& to, Step* found, bool back)
{
  if (!found || !found->edit)
    return false;
  Step step = std::move(*found);
  from.erase(from.begin() + (found - from.data()));
  (back ? step.edit->undo : step.edit->redo)();
  to.push_back(std::move(step));
  return true;
}

bool EditHistory::undo(std::size_t strokes)
{
  m_open = false;
  return step(m_done, m_undone, nextIn(m_done, strokes), true);
}

bool EditHistory::redo(std::size_t strokes)
{
  m_open = false;
  return step(m_undone, m_done, nextIn(m_undone, strokes), false);
}

bool EditHistory::undoOf(const std::string& group)
{
  m_open = false;
  return step(m_done, m_undone, nextIn(m_done, group), true);
}

bool EditHistory::redoOf(const std::string& group)
{
  m_open = false;
  return step(m_undone, m_done, nextIn(m_undone, group), false);
}

void EditHistory::takeBack(std::uint64_t step)
{
  if (m_done.empty() || m_done.back().id != step || !m_done.back().edit)
    return;
  const Step last = std::move(m_done.back());
  m_done.pop_back();
  m_open = false;
  if (m_displacedBy == step && m_undone.empty())
    m_undone = std::exchange(m_displaced, {});
  last.edit->undo();
}

std::uint64_t EditHistory::last() const noexcept
{
  return m_done.empty() ? 0 : m_done.back().id;
}

void EditHistory::clear()
{
  m_done.clear();
  m_undone.clear();
  m_displaced.clear();
  m_held = 0;
  ++m_generation;
  m_open = false;
}

} // namespace petrous::presenters
