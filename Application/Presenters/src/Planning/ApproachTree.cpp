#include "petrous/Presenters/ApproachTree.h"

#include <algorithm>
#include <map>
#include <memory>
#include <utility>

#include "petrous/Rendering/OffscreenView.h"
#include "petrous/Rendering/ScenePicture.h"
#include "petrous/Scene/Branches.h"

namespace petrous::presenters
{

namespace
{

using dissection::History;
using Kind = ApproachNode::Kind;

struct Fork
{
  std::size_t after = History::kStart;
  ApproachNode node;
};

// The approaches that fork after a state, in their order, go below its row.
void place(std::vector<ApproachNode>& rows, const std::vector<Fork>& forks)
{
  for (ApproachNode& row : rows)
  {
    if (row.kind == Kind::Stroke)
      for (const Fork& fork : forks)
        if (fork.after == row.state)
          row.children.push_back(fork.node);
    place(row.children, forks);
  }
}

} // namespace

std::vector<ApproachNode> approachTree(const History& history)
{
  const std::vector<std::size_t> present = history.lineTo(history.position());
  std::vector<bool> isApplied(history.size(), false), isOwned(history.size(), false);
  for (const std::size_t stroke : present)
    isApplied[stroke] = true;

  std::vector<Fork> forks;
  for (const History::Branch& branch : history.branches())
  {
    const std::vector<std::size_t> line = history.lineTo(branch.tip);
    const auto first = std::find_if(line.begin(), line.end(),
                                    [&isOwned](std::size_t stroke) { return !isOwned[stroke]; });
    Fork fork;
    fork.after = first == line.begin() ? History::kStart : *(first - 1);
    fork.node.approach = branch.name;
    fork.node.state = branch.position;
    fork.node.applied = &branch == &history.branch();
    if (fork.after == History::kStart)
      fork.node.children.push_back(
          {Kind::Start, branch.name, History::kStart, fork.node.applied, {}});
    for (auto stroke = first; stroke != line.end(); ++stroke)
    {
      isOwned[*stroke] = true;
      fork.node.children.push_back({Kind::Stroke, branch.name, *stroke, isApplied[*stroke], {}});
    }
    forks.push_back(std::move(fork));
  }
  std::vector<ApproachNode> rows;
  for (const Fork& fork : forks)
    if (fork.after == History::kStart)
      rows.push_back(fork.node);
  place(rows, forks);
  return rows;
}

void drawStates(const scene::Case& value, rendering::SceneContents contents,
                const core::CameraPose& camera, const std::vector<std::size_t>& states, int width,
                int height, const StateDrawn& drawn, const core::Progress& progress)
{
  rendering::ScenePicture picture;
  rendering::OffscreenView view(width, height);
  for (const std::size_t state : states)
  {
    progress.check("drawing strokes");
    const dissection::Dissection work = scene::dissectionAt(value, state);
    contents.mask = std::make_shared<const volume::CutMask>(work.mask());
    picture.setContents(contents);
    const auto& strokes = value.dissection.strokes();
    picture.setCamera(state < strokes.size() ? strokes[state]->info.camera.value_or(camera)
                                             : camera);
    drawn(state, view.render(picture));
  }
}

} // namespace petrous::presenters
