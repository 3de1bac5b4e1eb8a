#include "petrous/Dissection/History.h"

#include <algorithm>
#include <utility>

#include "petrous/Core/Error.h"
#include "petrous/Dissection/StrokeNumber.h"

namespace petrous::dissection
{

History::History()
  : m_branches{{kMain}}
{
}

History::History(std::vector<std::size_t> parents, std::vector<Branch> branches,
                 std::size_t present)
{
  for (std::size_t n = 0; n < parents.size(); ++n)
  {
    if (parents[n] != kStart && parents[n] >= n)
      throw core::InvalidParameter("history: stroke " + std::to_string(strokeNumber(n)) +
                                   " follows one that was made after it");
    append(parents[n]);
  }
  if (present >= branches.size())
    throw core::InvalidParameter("history: the present branch does not exist");
  for (Branch& branch : branches)
  {
    for (const std::size_t state : {branch.tip, branch.position})
      if (state != kStart && state >= size())
        throw core::InvalidParameter("history: branch '" + branch.name +
                                     "' ends with a stroke that is not there");
    if (!leads(branch.tip, branch.position))
      throw core::InvalidParameter("history: the state of branch '" + branch.name +
                                   "' is not on it");
    checkFree(branch.name);
    m_branches.push_back(std::move(branch));
  }
  m_present = present;
}

History History::line(std::size_t strokes, std::size_t applied)
{
  if (applied > strokes)
    throw core::InvalidParameter("history: more strokes are done than there are");
  std::vector<std::size_t> parents(strokes);
  for (std::size_t n = 0; n < strokes; ++n)
    parents[n] = n - 1; // kStart for the first
  return {std::move(parents), {{kMain, strokes - 1, applied - 1, false}}, 0};
}

void History::append(std::size_t parent)
{
  m_parents.push_back(parent);
  m_depths.push_back(depth(parent) + 1);
}

bool History::leads(std::size_t tip, std::size_t state) const
{
  while (depth(tip) > depth(state))
    tip = m_parents[tip];
  return tip == state;
}

const History::Branch* History::find(const std::string& name) const noexcept
{
  const auto found = std::find_if(m_branches.begin(), m_branches.end(),
                                  [&name](const Branch& branch) { return branch.name == name; });
  return found == m_branches.end() ? nullptr : &*found;
}

std::size_t History::indexOf(const std::string& name) const
{
  if (const Branch* branch = find(name))
    return static_cast<std::size_t>(branch - m_branches.data());
  std::string there;
  for (const Branch& branch : m_branches)
    there += (there.empty() ? "" : ", ") + branch.name;
  throw core::InvalidParameter("no branch '" + name + "'; there are: " + there);
}

void History::checkFree(const std::string& name) const
{
  if (name.empty())
    throw core::InvalidParameter("branch: give it a name");
  if (find(name))
    throw core::InvalidParameter("branch '" + name + "' is there already; choose another name");
}

std::size_t History::next() const
{
  std::size_t state = branch().tip;
  if (state == position())
    return kStart;
  while (m_parents[state] != position())
    state = m_parents[state];
  return state;
}

std::vector<std::size_t> History::lineTo(std::size_t state) const
{
  std::vector<std::size_t> line(depth(state));
  for (auto at = line.rbegin(); at != line.rend(); ++at)
  {
    *at = state;
    state = m_parents[state];
  }
  return line;
}

History::Path History::path(std::size_t from, std::size_t to) const
{
  Path path;
  while (from != to)
  {
    if (depth(from) >= depth(to))
    {
      path.undone.push_back(from);
      from = m_parents[from];
    }
    else
    {
      path.redone.push_back(to);
      to = m_parents[to];
    }
  }
  std::reverse(path.redone.begin(), path.redone.end());
  return path;
}

bool History::undo() noexcept
{
  if (position() == kStart)
    return false;
  m_branches[m_present].position = m_parents[position()];
  return true;
}

bool History::redo()
{
  const std::size_t stroke = next();
  if (stroke == kStart)
    return false;
  m_branches[m_present].position = stroke;
  return true;
}

std::size_t History::add()
{
  const std::size_t stroke = size();
  const std::size_t undone = branch().tip;
  const auto leadsThere = [this, undone](const Branch& other)
  { return &other != &branch() && leads(other.tip, undone); };
  if (undone != position() && std::none_of(m_branches.begin(), m_branches.end(), leadsThere))
  {
    int number = 1;
    while (find(branch().name + "~" + std::to_string(number)))
      ++number;
    m_branches.push_back({branch().name + "~" + std::to_string(number), undone, undone, true});
  }
  append(position());
  m_branches[m_present].tip = stroke;
  m_branches[m_present].position = stroke;
  return stroke;
}

void History::start(const std::string& name, std::size_t state)
{
  checkFree(name);
  if (state != kStart && state >= size())
    throw core::InvalidParameter("branch '" + name + "': there are only " + std::to_string(size()) +
                                 " strokes");
  m_branches.push_back({name, state, state, false});
  m_present = m_branches.size() - 1;
}

void History::goTo(const std::string& name)
{
  m_present = indexOf(name);
}

void History::rename(const std::string& from, const std::string& to)
{
  Branch& branch = m_branches[indexOf(from)];
  if (from != to)
    checkFree(to);
  branch.name = to;
  branch.setAside = false;
}

std::vector<std::size_t> History::remove(const std::string& name)
{
  const std::size_t gone = indexOf(name);
  if (gone == m_present)
    throw core::InvalidParameter("branch '" + name +
                                 "' is the present one; go to another branch first");
  m_branches.erase(m_branches.begin() + static_cast<std::ptrdiff_t>(gone));
  m_present -= gone < m_present;

  std::vector<bool> stays(size(), false);
  for (const Branch& branch : m_branches)
    for (std::size_t state = branch.tip; state != kStart && !stays[state]; state = m_parents[state])
      stays[state] = true;
  std::vector<std::size_t> kept;
  std::vector<std::size_t> renumbered(size(), kStart);
  for (std::size_t n = 0; n < size(); ++n)
    if (stays[n])
    {
      renumbered[n] = kept.size();
      kept.push_back(n);
    }
  const auto moved = [&renumbered](std::size_t state)
  { return state == kStart ? kStart : renumbered[state]; };
  const std::vector<std::size_t> parents = std::exchange(m_parents, {});
  m_depths.clear();
  for (const std::size_t stroke : kept)
    append(moved(parents[stroke]));
  for (Branch& branch : m_branches)
  {
    branch.tip = moved(branch.tip);
    branch.position = moved(branch.position);
  }
  return kept;
}

} // namespace petrous::dissection
