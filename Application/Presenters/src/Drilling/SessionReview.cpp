#include "petrous/Presenters/SessionReview.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "petrous/Presenters/RecordingPlayer.h"
#include "petrous/Presenters/StructureDistances.h"
#include "petrous/Scene/Branches.h"
#include "petrous/Session/DissectionLoop.h"
#include "petrous/Session/RecordingReader.h"
#include "petrous/Session/TouchScene.h"

namespace petrous::presenters
{

namespace
{

using dissection::History;
using Volumes = std::map<std::string, double>;

double forceOf(const double (&values)[3])
{
  return Eigen::Map<const Eigen::Vector3d>(values).norm();
}

// The states that have as many strokes as were applied then; the present branch's first.
std::vector<std::size_t> statesOf(const History& history, std::uint64_t applied)
{
  std::vector<std::size_t> states;
  const auto add = [&](std::size_t tip)
  {
    const auto line = history.lineTo(tip);
    if (line.size() < applied)
      return;
    const std::size_t state =
        applied == 0 ? History::kStart : line[static_cast<std::size_t>(applied) - 1];
    if (std::find(states.begin(), states.end(), state) == states.end())
      states.push_back(state);
  };
  add(history.branch().tip);
  for (const History::Branch& branch : history.branches())
    add(branch.tip);
  return states;
}

// Brings the case to the state in which the recording began, if it has that; else to the first that
// has as many strokes. The masks tell, without a scene of each state.
void goToBegin(scene::Case& value, const session::RecordedScene& then,
               const core::Progress& progress)
{
  std::vector<std::size_t> states = statesOf(value.dissection.history(), then.applied);
  if (states.empty())
    states.push_back(value.dissection.history().position());
  std::optional<dissection::Dissection> first;
  for (const std::size_t state : states)
  {
    progress.check("comparing the case with the recording");
    dissection::Dissection there = scene::dissectionAt(value, state);
    if (session::fingerprintOf(there.mask()) == then.mask)
    {
      value.dissection = std::move(there);
      return;
    }
    if (!first)
      first = std::move(there);
  }
  value.dissection = std::move(*first);
}

// A touchable copy of the case in the state in which the recording began, if there is one.
class State
{
public:
  State(scene::Case& value, const session::RecordingSetup& setup, const std::string& name,
        const core::Progress& progress)
  {
    value.iso = setup.scene.iso;
    goToBegin(value, setup.scene, progress.part(0.0, 0.3));
    m_scene.emplace(value, progress.part(0.3, 1.0), setup.scene.firstState, true);
    const session::RecordedScene now = m_scene->fingerprint();
    m_misfit = misfitOf(value, now, setup.scene);
    if (now.ct != setup.scene.ct)
      throw core::InvalidParameter(name + ": " + m_misfit);
  }

  session::TouchScene& scene() { return *m_scene; }
  const std::string& misfit() const { return m_misfit; }

private:
  std::optional<session::TouchScene> m_scene;
  std::string m_misfit;
};

// What a recorded redo finds to redo: at the recording's begin the case has strokes ahead, which
// are on its tree, but not on the line to that state. Of those, only strokes before `before` were
// there, and the mask after the redo tells which it was. Says why it is not known.
std::string prepareRedo(scene::Case& value, const session::MaskEdit& redo, std::size_t before)
{
  const History& history = value.dissection.history();
  if (value.dissection.strokeOpen() || history.next() != History::kStart)
    return {};
  if (redo.redone() == 0)
    return "redoes an older stroke, and does not tell which";
  std::vector<std::size_t> parents;
  for (std::size_t n = 0; n < history.size(); ++n)
    parents.push_back(history.parent(n));
  for (std::size_t n = 0; n < before; ++n)
    if (parents[n] == history.position() &&
        session::fingerprintOf(scene::dissectionAt(value, n).mask()) == redo.redone())
    {
      value.dissection.follow(
          {std::move(parents), {{History::kMain, n, history.position(), false}}, 0});
      return {};
    }
  return "redoes an older stroke that this case does not have";
}

// Of the strokes from `before` on that are applied; and how many of those applied at the beginning
// are not.
void addRemoved(const dissection::Dissection& work, std::size_t before,
                const std::vector<std::size_t>& atBegin, SessionReview& review, Volumes& structures)
{
  review.removed = 0.0;
  const auto line = work.history().lineTo(work.history().position());
  for (const std::size_t n : atBegin)
    review.undone += std::find(line.begin(), line.end(), n) == line.end();
  for (const std::size_t n : line)
  {
    if (n < before)
      continue;
    const dissection::Stroke& stroke = *work.strokes()[n];
    ++review.strokes;
    *review.removed += stroke.info.removed;
    review.made.push_back(stroke.info);
    for (const auto& one : stroke.info.structures)
      structures[one.name] += one.volume;
  }
}

} // namespace

bool RecordedCourse::add(const session::TickRecord& record)
{
  const bool wasOn = m_isOn;
  m_isOn = record.drill != 0 || (wasOn && session::isInterruption(record));
  if (!session::hasToolPose(record))
    return false;
  const haptics::Pose pose = record.proxy.pose();
  RecordedTool tool;
  tool.center = pose.position;
  tool.axisToHand = pose.rotation * Eigen::Vector3d::UnitZ();
  tool.drilling = record.drill != 0;
  tool.force = forceOf(record.wrench.force);
  tool.thrust = record.thrust;
  tool.spindle = tool.drilling ? record.input.spindle() : 0.0;
  const bool isFirst = !m_placed;
  if (isFirst)
  {
    m_start = record.time();
    m_step = m_drillStep = tool.center;
    m_placed = true;
  }
  tool.time = std::max(record.time() - m_start, m_last.time); // the clock may run backward

  // What is between two ticks that far apart nobody knows (DissectionLoop counts no more, either).
  constexpr double kLongest = 0.01; // s
  const double seconds = isFirst ? 0.0 : std::min(tool.time - m_last.time, kLongest);
  m_metrics.duration = tool.time;
  if (m_last.drilling && !isFirst)
  {
    m_metrics.drilling += seconds;
    m_forceSeconds += seconds * m_last.force;
    m_spindle.add(m_lastInput, seconds);
  }
  const bool isStart = tool.drilling && (isFirst || !m_last.drilling);
  m_metrics.drillStarts += tool.drilling && !wasOn;
  if (const double way = (tool.center - m_step).norm(); way >= kStep)
  {
    m_metrics.path += way;
    m_step = tool.center;
  }
  if (!tool.drilling || isStart)
    m_drillStep = tool.center;
  else if (const double way = (tool.center - m_drillStep).norm(); way >= kStep)
  {
    m_metrics.drillingPath += way;
    m_drillStep = tool.center;
  }
  m_metrics.maxForce = std::max(m_metrics.maxForce, tool.force);
  m_metrics.maxThrust = std::max(m_metrics.maxThrust, tool.thrust);

  constexpr double kTolerance = 1e-6; // s
  if (isFirst || tool.drilling != m_last.drilling ||
      tool.time - m_tools.back().time >= 1.0 / kRate - kTolerance)
    m_tools.push_back(tool);
  m_last = tool;
  m_lastInput = record.input;
  return true;
}

SessionMetrics RecordedCourse::metrics() const
{
  SessionMetrics result = m_metrics;
  if (result.drilling > 0.0)
    result.meanForce = m_forceSeconds / result.drilling;
  return result;
}

std::optional<RecordedTool> toolAt(const std::vector<RecordedTool>& course, double time)
{
  if (course.empty())
    return std::nullopt;
  const auto after =
      std::upper_bound(course.begin(), course.end(), time,
                       [](double at, const RecordedTool& tool) { return at < tool.time; });
  if (after == course.begin())
    return course.front();
  if (after == course.end())
    return course.back();
  const RecordedTool& a = *(after - 1);
  const RecordedTool& b = *after;
  const double share = (time - a.time) / (b.time - a.time);
  RecordedTool tool = a;
  tool.time = time;
  tool.center += share * (b.center - a.center);
  const Eigen::Vector3d axis = a.axisToHand + share * (b.axisToHand - a.axisToHand);
  if (axis.norm() > 0.0)
    tool.axisToHand = axis.normalized();
  tool.force += share * (b.force - a.force);
  tool.thrust += share * (b.thrust - a.thrust);
  if (tool.drilling && b.drilling)
    tool.spindle += share * (b.spindle - a.spindle);
  return tool;
}

namespace
{

// Leaves the case as it is after the recording, if the volumes are known.
SessionReview reviewOn(const std::filesystem::path& file, scene::Case& value,
                       const core::Progress& progress)
{
  const std::string name = file.filename().string();
  session::RecordingReader reader(file);
  const session::RecordingSetup setup = reader.setup();
  toolOf(setup); // throws where this program has no such tool
  SessionReview review;
  review.burr = setup.burr;
  review.tool = toString(setup);
  review.applied = static_cast<std::size_t>(setup.scene.applied);

  State state(value, setup, name, progress.part(0.0, 0.5));
  session::NoRemovalModel recorded; // cuts are repeated as they were
  std::optional<session::DissectionLoop> loop;
  if (state.misfit().empty())
    loop.emplace(value.dissection, *state.scene().mask(), recorded,
                 state.scene().drill().protectedTissue(),
                 state.scene().hooksOf(setup.burr, [] { return std::nullopt; }));
  const std::size_t before = value.dissection.strokes().size();
  const auto atBegin = value.dissection.history().lineTo(value.dissection.history().position());
  review.whyUnmeasured = state.misfit();

  StructureDistances distances(value, MeasuredTool(0.5 * setup.burr.diameter));
  RecordedCourse course;
  session::RecordingBlock block;
  while (reader.next(block))
  {
    progress.check("playing the recording");
    for (const session::TickRecord& record : block.ticks)
      if (course.add(record))
        distances.add(record.proxy.pose());
    for (const session::MaskEdit& edit : block.edits)
    {
      if (!loop)
        break;
      if (edit.kind == session::MaskEdit::Kind::Redo)
        review.whyUnmeasured = prepareRedo(value, edit, before);
      if (review.whyUnmeasured.empty() && !loop->apply(edit))
        review.whyUnmeasured = "cuts another dissection here than where it was made";
      if (!review.whyUnmeasured.empty())
        loop.reset();
    }
  }
  review.warning = reader.warning();
  review.metrics = course.metrics();
  review.course = course.tools();
  review.speed = course.speed(setup.burr.rpm);

  Volumes removed;
  if (loop)
  {
    loop->endStroke();
    addRemoved(value.dissection, before, atBegin, review, removed);
  }
  progress.check("measuring the structures");
  std::map<std::string, SessionReview::Structure> structures;
  if (!review.course.empty())
    for (const auto& [structure, distance] : distances.smallest())
      structures[structure].nearest = distance;
  for (const auto& [structure, volume] : removed)
    structures[structure];
  for (auto& [structure, one] : structures)
  {
    one.name = structure;
    if (loop)
      one.removed = removed.count(structure) > 0 ? removed.at(structure) : 0.0;
    review.structures.push_back(one);
  }
  return review;
}

} // namespace

SessionReview reviewRecording(const std::filesystem::path& file, scene::Case value,
                              const core::Progress& progress)
{
  return reviewOn(file, value, progress);
}

OperationReview reviewOperation(const std::vector<std::filesystem::path>& files,
                                const scene::Case& value, const core::Progress& progress)
{
  std::vector<OperationReview::Part> parts;
  std::optional<scene::Case> after; // the part before, where the case itself lacks its strokes
  double begin = 0.0;
  for (std::size_t n = 0; n < files.size(); ++n)
  {
    const double share = 1.0 / static_cast<double>(files.size());
    const double done = share * static_cast<double>(n);
    const core::Progress own = progress.part(done, done + share);
    OperationReview::Part part;
    part.name = files[n].filename().string();
    part.begin = begin;
    scene::Case there = value;
    part.review = reviewOn(files[n], there, own);
    if (!part.review.removed && after)
    {
      there = std::move(*after);
      SessionReview goesOn = reviewOn(files[n], there, own);
      if (goesOn.removed)
        part.review = std::move(goesOn);
    }
    after.reset();
    if (part.review.removed)
      after = std::move(there);
    begin += part.review.metrics.duration;
    parts.push_back(std::move(part));
  }
  return togetherOf(std::move(parts));
}

} // namespace petrous::presenters
