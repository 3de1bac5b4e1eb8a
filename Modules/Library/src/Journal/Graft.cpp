#include "Graft.h"

#include <algorithm>
#include <utility>

namespace petrous::library
{

namespace
{

using dissection::History;

bool samePlace(const History::Branch& a, const History::Branch& b)
{
  return a.tip == b.tip && a.position == b.position;
}

History::Branch* findIn(std::vector<History::Branch>& branches, const std::string& name)
{
  const auto found = std::find_if(branches.begin(), branches.end(),
                                  [&name](const History::Branch& one) { return one.name == name; });
  return found == branches.end() ? nullptr : &*found;
}

std::string freeName(std::vector<History::Branch>& branches, const std::string& name)
{
  int number = 1;
  while (findIn(branches, name + "~" + std::to_string(number)))
    ++number;
  return name + "~" + std::to_string(number);
}

} // namespace

bool sameHistory(const History& a, const History& b)
{
  if (a.size() != b.size() || a.branch().name != b.branch().name)
    return false;
  for (std::size_t n = 0; n < a.size(); ++n)
    if (a.parent(n) != b.parent(n))
      return false;
  return std::equal(
      a.branches().begin(), a.branches().end(), b.branches().begin(), b.branches().end(),
      [](const History::Branch& one, const History::Branch& other) {
        return one.name == other.name && samePlace(one, other) && one.setAside == other.setAside;
      });
}

bool goesOnFrom(const scene::Case& value, const SavedState& base)
{
  const auto& strokes = value.dissection.strokes();
  return value.ct.object == base.ct && strokes.size() >= base.strokes.size() &&
         std::equal(base.strokes.begin(), base.strokes.end(), strokes.begin(),
                    [](const std::string& object, const auto& stroke)
                    { return object == stroke->object; });
}

scene::Case graft(const scene::Case& now, const SavedState& base,
                  const dissection::Dissection& drilled)
{
  const History& theirHistory = now.dissection.history();
  const std::size_t before = base.strokes.size();
  const std::size_t shift = now.dissection.strokes().size() - before;
  const auto moved = [before, shift](std::size_t state)
  { return state == History::kStart || state < before ? state : state + shift; };

  std::vector<std::size_t> parents;
  for (std::size_t n = 0; n < theirHistory.size(); ++n)
    parents.push_back(theirHistory.parent(n));
  for (std::size_t n = before; n < drilled.history().size(); ++n)
    parents.push_back(moved(drilled.history().parent(n)));

  std::vector<History::Branch> branches = theirHistory.branches();
  std::string present;
  for (const History::Branch& branch : drilled.history().branches())
  {
    History::Branch mine{branch.name, moved(branch.tip), moved(branch.position), branch.setAside};
    const History::Branch* old = base.history.find(branch.name);
    History::Branch* theirs = findIn(branches, branch.name);
    if (!theirs)
      branches.push_back(mine);
    else if (old && samePlace(*old, *theirs))
      *theirs = mine;
    else if (!old || !samePlace(*old, branch))
    {
      mine.name = freeName(branches, branch.name);
      mine.setAside = true;
      branches.push_back(mine);
    }
    if (&branch == &drilled.history().branch())
      present = mine.name;
  }
  const auto at = static_cast<std::size_t>(findIn(branches, present) - branches.data());

  dissection::Dissection::Strokes strokes = now.dissection.strokes();
  strokes.insert(strokes.end(), drilled.strokes().begin() + static_cast<std::ptrdiff_t>(before),
                 drilled.strokes().end());
  scene::Case result = now;
  result.dissection = dissection::Dissection(now.ct.geometry, std::move(strokes),
                                             History(std::move(parents), std::move(branches), at));
  return result;
}

} // namespace petrous::library
