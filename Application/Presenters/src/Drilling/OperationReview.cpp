#include <algorithm>
#include <map>
#include <utility>

#include "petrous/Core/Error.h"
#include "petrous/Presenters/SessionReview.h"

namespace petrous::presenters
{

namespace
{

void add(SessionMetrics& whole, double& forceSeconds, const SessionMetrics& part)
{
  whole.duration += part.duration;
  whole.drilling += part.drilling;
  whole.path += part.path;
  whole.drillingPath += part.drillingPath;
  whole.drillStarts += part.drillStarts;
  whole.maxForce = std::max(whole.maxForce, part.maxForce);
  whole.maxThrust = std::max(whole.maxThrust, part.maxThrust);
  forceSeconds += part.meanForce * part.drilling;
  whole.meanForce = whole.drilling > 0.0 ? forceSeconds / whole.drilling : 0.0;
}

// Parts without a speed of the pedal turned as set.
std::optional<dissection::SpindleSpeed> speedOf(const std::vector<OperationReview::Part>& parts)
{
  dissection::SpindleSpeed speed;
  double turns = 0.0; // 60 of them
  double drilling = 0.0;
  bool byPedal = false;
  for (const auto& [name, begin, part] : parts)
  {
    if (part.metrics.drilling <= 0.0)
      continue;
    const auto own = part.speed.value_or(dissection::SpindleSpeed{part.burr.rpm, part.burr.rpm});
    byPedal = byPedal || part.speed.has_value();
    drilling += part.metrics.drilling;
    turns += own.mean * part.metrics.drilling;
    speed.max = std::max(speed.max, own.max);
  }
  if (!byPedal)
    return std::nullopt;
  speed.mean = turns / drilling;
  return speed;
}

using Structures = std::map<std::string, SessionReview::Structure>;

// The strokes that stay, as a stack: undo takes the last one.
std::vector<const dissection::StrokeInfo*>
strokesOf(const std::vector<OperationReview::Part>& parts)
{
  std::vector<const dissection::StrokeInfo*> strokes;
  const std::size_t older = parts.front().review.applied;
  for (const auto& [name, begin, part] : parts)
  {
    const std::size_t there = part.applied - std::min(part.applied, older); // some may be undone
    strokes.resize(std::min(strokes.size(), there));
    strokes.resize(strokes.size() - std::min(strokes.size(), part.undone));
    for (const dissection::StrokeInfo& stroke : part.made)
      strokes.push_back(&stroke);
  }
  return strokes;
}

void addVolumes(OperationReview& whole, Structures& structures)
{
  for (const auto& [name, begin, part] : whole.parts)
    if (whole.whyUnmeasured.empty() && !part.removed)
      whole.whyUnmeasured = part.whyUnmeasured;
  if (!whole.whyUnmeasured.empty())
    return;
  whole.removed = 0.0;
  for (auto& [name, one] : structures)
    one.removed = 0.0;
  const auto strokes = strokesOf(whole.parts);
  whole.strokes = strokes.size();
  for (const dissection::StrokeInfo* stroke : strokes)
  {
    *whole.removed += stroke->removed;
    for (const auto& one : stroke->structures)
      if (const auto at = structures.find(one.name); at != structures.end())
        *at->second.removed += one.volume;
  }
}

} // namespace

OperationReview togetherOf(std::vector<OperationReview::Part> parts)
{
  OperationReview whole;
  whole.parts = std::move(parts);
  if (whole.parts.empty())
    throw core::InvalidParameter("there is no recording to be read");
  if (whole.parts.size() == 1)
  {
    static_cast<SessionReview&>(whole) = whole.parts.front().review;
    return whole;
  }
  whole.tool = whole.parts.front().review.tool;
  whole.burr = whole.parts.front().review.burr;
  double forceSeconds = 0.0;
  Structures structures;
  for (const auto& [name, begin, part] : whole.parts)
  {
    add(whole.metrics, forceSeconds, part.metrics);
    for (RecordedTool tool : part.course)
    {
      tool.time += begin;
      whole.course.push_back(tool);
    }
    for (const SessionReview::Structure& one : part.structures)
    {
      auto& all = structures[one.name];
      all.name = one.name;
      if (one.nearest)
        all.nearest = std::min(all.nearest.value_or(*one.nearest), *one.nearest);
    }
    if (whole.warning.empty())
      whole.warning = part.warning;
  }
  whole.speed = speedOf(whole.parts);
  addVolumes(whole, structures);
  for (auto& [name, one] : structures)
    whole.structures.push_back(std::move(one));
  return whole;
}

const OperationReview::Part& partAt(const OperationReview& review, double time)
{
  const auto after = std::upper_bound(review.parts.begin() + 1, review.parts.end(), time,
                                      [](double at, const auto& part) { return at < part.begin; });
  return *(after - 1);
}

} // namespace petrous::presenters
