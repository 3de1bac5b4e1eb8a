#include "petrous/Scene/Branches.h"

#include <map>
#include <utility>

namespace petrous::scene
{

void startBranch(Case& value, const std::string& name, std::optional<std::size_t> after)
{
  checkBranchName(name);
  dissection::History next = value.dissection.history();
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
  if (value.camera)
    value.view.branchCameras[left] = *value.camera;
}

void goToBranch(Case& value, const std::string& name)
{
  dissection::History next = value.dissection.history();
  const std::string left = next.branch().name;
  next.goTo(name);
  value.dissection.follow(next);
  if (name == left)
    return;
  auto& cameras = value.view.branchCameras;
  if (value.camera)
    cameras[left] = *value.camera;
  const std::vector<std::size_t> line = next.lineTo(next.position());
  if (const auto own = cameras.find(name); own != cameras.end())
  {
    value.camera = own->second;
    cameras.erase(own);
  }
  else if (const auto& info = line.empty() ? dissection::StrokeInfo()
                                           : value.dissection.strokes()[line.back()]->info;
           info.camera)
    value.camera = info.camera;
}

void renameBranch(Case& value, const std::string& from, const std::string& to)
{
  checkBranchName(to);
  dissection::History next = value.dissection.history();
  next.rename(from, to);
  value.dissection.follow(next);
  if (auto camera = value.view.branchCameras.extract(from); !camera.empty())
  {
    camera.key() = to;
    value.view.branchCameras.insert(std::move(camera));
  }
}

std::size_t removeBranch(Case& value, const std::string& name)
{
  const std::size_t before = value.dissection.strokes().size();
  const std::size_t removed = before - value.dissection.removeBranch(name).size();
  value.view.branchCameras.erase(name);
  return removed;
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
    for (const auto& touched : info.structures)
      structures[touched.name] += touched.volume;
  }
  for (const auto& [name, volume] : structures)
    summary.structures.push_back({name, volume});
  return summary;
}

} // namespace petrous::scene
