#include "petrous/Scene/Branches.h"

#include <map>
#include <utility>

namespace petrous::scene
{

void follow(Case& value, dissection::History next)
{
  if (value.dissection)
    value.dissection->follow(next);
  value.history = std::move(next);
}

void startBranch(Case& value, const std::string& name, std::optional<std::size_t> after)
{
  checkBranchName(name);
  dissection::History next = value.history;
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
  next.start(name, state);
  follow(value, std::move(next));
}

void goToBranch(Case& value, const std::string& name)
{
  dissection::History next = value.history;
  next.goTo(name);
  follow(value, std::move(next));
}

void renameBranch(Case& value, const std::string& from, const std::string& to)
{
  checkBranchName(to);
  dissection::History next = value.history;
  next.rename(from, to);
  follow(value, std::move(next));
}

std::size_t removeBranch(Case& value, const std::string& name)
{
  const std::vector<std::size_t> kept =
      value.dissection ? value.dissection->removeBranch(name) : value.history.remove(name);
  if (value.dissection)
    value.history = value.dissection->history();
  const std::size_t before = value.strokes.size();
  std::vector<StrokePart> strokes;
  for (const std::size_t stroke : kept)
    strokes.push_back(std::move(value.strokes[stroke]));
  value.strokes = std::move(strokes);
  return before - kept.size();
}

StateSummary summaryOf(const Case& value, std::size_t state)
{
  StateSummary summary;
  std::map<std::string, double> structures;
  for (const std::size_t stroke : value.history.lineTo(state))
  {
    const dissection::StrokeInfo& info = value.strokes[stroke].info;
    ++summary.strokes;
    summary.removed += info.removed;
    for (const auto& touched : info.structures)
      structures[touched.name] += touched.volume;
  }
  for (const auto& [name, volume] : structures)
    summary.structures.push_back({name, volume});
  return summary;
}

} // namespace petrous::scene
