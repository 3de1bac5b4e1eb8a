#include "petrous/Scene/Branches.h"

#include <algorithm>
#include <map>
#include <utility>

#include "petrous/Scene/FreeName.h"

namespace petrous::scene
{

namespace
{

using dissection::History;

std::vector<std::size_t> parentsOf(const History& history)
{
  std::vector<std::size_t> parents(history.size());
  for (std::size_t n = 0; n < parents.size(); ++n)
    parents[n] = history.parent(n);
  return parents;
}

std::size_t placeOf(const History& history, const std::string& name)
{
  const History::Branch* branch = history.find(name);
  if (!branch)
    History(history).goTo(name); // throws, listing the branches
  return static_cast<std::size_t>(branch - history.branches().data());
}

// On the branch `name`, at `state`.
History at(const History& history, const std::string& name, std::size_t state)
{
  const std::size_t place = placeOf(history, name);
  std::vector<History::Branch> branches = history.branches();
  branches[place].position = state;
  return {parentsOf(history), std::move(branches), place};
}

void follow(Case& value, const History& next)
{
  const std::string left = value.dissection.history().branch().name;
  value.dissection.follow(next);
  const std::string& name = next.branch().name;
  if (name == left)
    return;
  value.view.branches[left] = presentView(value);
  ViewState::Saved view;
  if (const auto own = value.view.branches.extract(name); !own.empty())
    view = own.mapped();
  const std::vector<std::size_t> line = next.lineTo(next.position());
  if (!view.camera && !line.empty())
    view.camera = value.dissection.strokes()[line.back()]->info.camera;
  showSaved(value, view);
}

} // namespace

void startBranch(Case& value, const std::string& name, std::optional<std::size_t> after)
{
  checkBranchName(name);
  History next = value.dissection.history();
  std::size_t state = next.position();
  if (after)
  {
    const std::vector<std::size_t> line = next.lineTo(next.branch().tip);
    if (*after > line.size())
      throw core::InvalidParameter("branch '" + next.branch().name + "' has " +
                                   std::to_string(line.size()) + " strokes, not " +
                                   std::to_string(*after));
    state = *after == 0 ? dissection::History::kStart : line[*after - 1];
  }
  const std::string left = next.branch().name;
  next.start(name, state);
  value.dissection.follow(next);
  value.view.branches[left] = presentView(value);
}

void goToBranch(Case& value, const std::string& name)
{
  History next = value.dissection.history();
  next.goTo(name);
  follow(value, next);
}

void goToState(Case& value, const std::string& branch, std::size_t state)
{
  follow(value, at(value.dissection.history(), branch, state));
}

void renameBranch(Case& value, const std::string& from, const std::string& to)
{
  checkBranchName(to);
  History next = value.dissection.history();
  next.rename(from, to);
  value.dissection.follow(next);
  if (auto view = value.view.branches.extract(from); !view.empty())
  {
    view.key() = to;
    value.view.branches.insert(std::move(view));
  }
}

std::size_t removeBranch(Case& value, const std::string& name)
{
  const std::size_t before = value.dissection.strokes().size();
  const std::size_t removed = before - value.dissection.removeBranch(name).size();
  value.view.branches.erase(name);
  return removed;
}

dissection::Dissection dissectionAt(const Case& value, std::size_t state)
{
  dissection::Dissection work = value.dissection;
  work.follow({parentsOf(work.history()), {{History::kMain, state, state, false}}, 0});
  return work;
}

TakenBranch takeBranch(Case& value, const std::string& name)
{
  const History& history = value.dissection.history();
  const std::size_t place = placeOf(history, name);
  std::size_t present = placeOf(history, history.branch().name);
  if (place == present)
    throw core::InvalidParameter("branch '" + name +
                                 "' is the present one; go to another branch first");
  TakenBranch taken{history.branches()[place], place, {}};
  std::vector<History::Branch> branches = history.branches();
  branches.erase(branches.begin() + static_cast<std::ptrdiff_t>(place));
  present -= place < present;
  value.dissection.follow({parentsOf(history), std::move(branches), present});
  if (const auto view = value.view.branches.extract(name); !view.empty())
    taken.view = view.mapped();
  return taken;
}

std::string putBranch(Case& value, TakenBranch taken)
{
  const History& history = value.dissection.history();
  std::size_t present = placeOf(history, history.branch().name);
  std::vector<History::Branch> branches = history.branches();
  taken.branch.name =
      freeName(taken.branch.name, [&](const std::string& name) { return history.find(name); });
  const std::size_t place = std::min(taken.index, branches.size());
  branches.insert(branches.begin() + static_cast<std::ptrdiff_t>(place), taken.branch);
  present += place <= present;
  value.dissection.follow({parentsOf(history), std::move(branches), present});
  if (taken.view)
    value.view.branches[taken.branch.name] = *taken.view;
  return taken.branch.name;
}

StateSummary summaryOf(const Case& value, std::size_t state)
{
  StateSummary summary;
  std::map<std::string, double> structures;
  for (const std::size_t stroke : value.dissection.history().lineTo(state))
  {
    const dissection::StrokeInfo& info = value.dissection.strokes()[stroke]->info;
    ++summary.strokes;
    summary.removed += info.removed;
    summary.duration += info.duration;
    for (const auto& touched : info.structures)
      structures[touched.name] += touched.volume;
  }
  for (const auto& [name, volume] : structures)
    summary.structures.push_back({name, volume});
  return summary;
}

} // namespace petrous::scene
