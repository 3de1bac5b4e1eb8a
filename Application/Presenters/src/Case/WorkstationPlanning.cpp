// WorkstationModel: planning on the open case: distances to structures, bone thickness, MR
// registration, approaches.

#include <algorithm>
#include <utility>

#include "EditGroups.h"
#include "Notify.h"
#include "petrous/Presenters/BoneThickness.h"
#include "petrous/Presenters/WorkstationModel.h"
#include "petrous/Scene/Branches.h"
#include "petrous/Scene/Placement.h"
#include "petrous/Scene/ReferenceFrames.h"

namespace petrous::presenters
{

namespace
{

bool isOnPresentBranch(const dissection::History& history, std::size_t state)
{
  const std::vector<std::size_t> line = history.lineTo(history.branch().tip);
  return state == dissection::History::kStart ||
         std::find(line.begin(), line.end(), state) != line.end();
}

bool movesMr(const EditHistory::Edit& edit)
{
  return edit.group == kMrEdits || edit.group == kMrAxes;
}

} // namespace

bool WorkstationModel::measureNearby()
{
  if (!m_case || !m_loaded)
    return false;
  if (!m_nearby)
    m_nearby = std::make_unique<NearbyStructures>(*m_case);
  return m_nearby->ready();
}

ToolSurroundings WorkstationModel::surroundings(const MeasuredTool& tool, const haptics::Pose& pose,
                                                bool isWide)
{
  ToolSurroundings result;
  result.isWide = isWide;
  result.isInstrument = tool.isInstrument();
  try
  {
    if (!isWide && m_case && !canBeWarnedOf(*m_case))
      result.isMeasured = true;
    else if (measureNearby())
    {
      result.structures =
          m_nearby->around(*m_case, tool, pose, isWide ? kNear : 0.0, strokeSoFar());
      result.unmeasured = toString(m_nearby->unmeasured());
      result.isMeasured = true;
    }
  }
  catch (const std::exception& error) // out of memory, a missing file
  {
    result.fault = error.what();
  }
  return result;
}

const dissection::RemovedVolume& WorkstationModel::strokeSoFar()
{
  static const dissection::RemovedVolume kNothing;
  if (!m_case || !m_case->dissection.loaded() || !m_scene)
    return kNothing;
  return m_meter.soFar(m_case->dissection, m_scene->drill().measurer());
}

void WorkstationModel::forgetNearby()
{
  m_nearby.reset();
}

// To another branch, with its view.
void WorkstationModel::changeBranch(const std::function<void()>& change)
{
  stopTouch();
  notify(events.viewWanted);
  const scene::ViewState::Clipping before = m_case->view.clipping;
  change();
  followHistory();
  notify(events.viewChanged);
  if (!(m_case->view.clipping == before))
    notify(events.appearanceChanged);
}

// A step from the branch that was left to the present one, in the state in which it is then; one
// that was moved is back in its own state first.
void WorkstationModel::recordBranch(const std::string& left,
                                    const std::optional<MovedBranch>& moved)
{
  const std::string name = m_case->dissection.history().branch().name;
  if (name == left)
    return;
  const auto back = [this, left, name, moved]
  {
    const dissection::History& history = m_case->dissection.history();
    if (moved && history.branch().name == name && isOnPresentBranch(history, moved->before))
      scene::goToState(*m_case, name, moved->before);
    scene::goToBranch(*m_case, left);
  };
  const auto again = [this, name, moved]
  {
    if (moved)
      scene::goToState(*m_case, name, moved->to);
    else
      scene::goToBranch(*m_case, name);
  };
  recordEdit({name == dissection::History::kMain ? "change to the main approach"
                                                 : "change to approach " + name,
              {},
              [this, back] { changeBranch(back); },
              [this, again] { changeBranch(again); },
              true});
}

void WorkstationModel::goToBranch(const std::string& name)
{
  if (!m_case)
    return;
  stopTouch(); // which may move the history
  const std::string left = m_case->dissection.history().branch().name;
  changeBranch([this, &name] { scene::goToBranch(*m_case, name); });
  recordBranch(left);
}

void WorkstationModel::startBranch(const std::string& name)
{
  if (!m_case)
    return;
  stopTouch();
  const std::string left = m_case->dissection.history().branch().name;
  changeBranch([this, &name] { scene::startBranch(*m_case, name); });
  recordBranch(left);
}

void WorkstationModel::goToState(const std::string& branch, std::size_t state)
{
  if (!m_case)
    return;
  stopTouch();
  const dissection::History& history = m_case->dissection.history();
  const std::string left = history.branch().name;
  const auto go = [&] { scene::goToState(*m_case, branch, state); };
  if (left != branch)
  {
    const dissection::History::Branch* there = history.find(branch);
    const std::size_t before = there ? there->position : state;
    changeBranch(go);
    return recordBranch(left, MovedBranch{before, state});
  }
  const std::size_t before = history.position();
  go();
  const auto path = history.path(before, state);
  for (std::size_t n = 0; n < path.undone.size(); ++n)
    m_edits.strokeStepped(true);
  for (std::size_t n = 0; n < path.redone.size(); ++n)
    m_edits.strokeStepped(false);
  followHistory();
}

void WorkstationModel::nameBranch(const std::string& from, const std::string& to)
{
  stopTouch();
  scene::renameBranch(*m_case, from, to);
  followHistory();
}

void WorkstationModel::renameBranch(const std::string& from, const std::string& to)
{
  if (!m_case || from == to)
    return;
  nameBranch(from, to);
  recordEdit({"name of approach " + to,
              {},
              [this, from, to] { nameBranch(to, from); },
              [this, from, to] { nameBranch(from, to); },
              true});
}

void WorkstationModel::removeBranch(const std::string& name)
{
  if (!m_case)
    return;
  struct Removed
  {
    std::string name; // another one than at first if that was given away
    scene::TakenBranch taken;
  };
  const auto removed = std::make_shared<Removed>(Removed{name, {}});
  const auto takeOut = [this, removed]
  {
    stopTouch();
    removed->taken = scene::takeBranch(*m_case, removed->name);
    followHistory();
  };
  const auto putBack = [this, removed]
  {
    stopTouch();
    removed->name = scene::putBranch(*m_case, removed->taken);
    followHistory();
  };
  takeOut();
  recordEdit({name == dissection::History::kMain ? "deletion of the main approach"
                                                 : "deletion of approach " + name,
              {},
              putBack,
              takeOut,
              true});
}

namespace
{

// Placements of what was drawn on MRs; touch, drill and pointer depend on them.
std::vector<scene::Placement> drawnOnMrs(const scene::Case& value)
{
  std::vector<scene::Placement> placements;
  const auto add = [&placements](scene::Placement placement)
  {
    if (!placement.drawnOn.empty())
      placements.push_back(std::move(placement));
  };
  for (const scene::LabelPart& part : value.labels)
    add(scene::placementOf(value, part));
  for (const scene::MeshPart& part : value.meshes)
    add(scene::placementOf(value, part));
  return placements;
}

bool isMadeFromMr(const scene::Case& value)
{
  return std::any_of(value.labels.begin(), value.labels.end(),
                     [](const scene::LabelPart& part)
                     {
                       return std::any_of(part.structures.begin(), part.structures.end(),
                                          [](const scene::StructurePart& structure)
                                          { return !structure.readings.empty(); });
                     });
}

bool same(const std::vector<scene::Placement>& a, const std::vector<scene::Placement>& b)
{
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](const scene::Placement& one, const scene::Placement& other)
                    {
                      return one.drawnOn == other.drawnOn && one.missing == other.missing &&
                             one.mrFromCt.rotation().coeffs() ==
                                 other.mrFromCt.rotation().coeffs() &&
                             one.mrFromCt.translation() == other.mrFromCt.translation();
                    });
}

} // namespace

void WorkstationModel::showThickness(const std::string& structure)
{
  if (!m_case || structure == thicknessOver())
    return;
  showThickness(thicknessMeasurement(structure)({}));
}

std::function<MeasuredThickness(const core::Progress&)>
WorkstationModel::thicknessMeasurement(const std::string& structure) const
{
  if (!m_loaded)
    throw core::InvalidParameter("The structures are still being loaded.");
  MeasuredThickness next{m_assembly, m_parts};
  next.assembly.showThickness(structure);
  return [next = std::move(next), value = *m_case](const core::Progress& progress) mutable
  {
    next.assembly.contents(value, progress);
    return std::move(next);
  };
}

bool WorkstationModel::showThickness(const MeasuredThickness& measured)
{
  if (!m_case || measured.parts != m_parts)
    return false;
  m_assembly.takeThickness(measured.assembly);
  notify(events.appearanceChanged);
  return true;
}

void WorkstationModel::changeMr(const std::function<void(scene::Case&)>& change,
                                const std::string& what, const std::string& continues)
{
  if (!m_case || drilling())
    return;
  const auto before = drawnOnMrs(*m_case);
  const bool wasMade = isMadeFromMr(*m_case);
  const auto places = scene::mrPlaces(*m_case);
  bool tissueMoved = false;
  const auto follow = [&]
  {
    if (!before.empty() || wasMade)
      m_nearby.reset(); // its uncertainties depend on the registrations
    if (same(before, drawnOnMrs(*m_case)))
      return;
    const bool held = touching();
    forgetTissue();
    if (held)
      notify(events.toolPutAway);
    tissueMoved = true;
  };
  try
  {
    change(*m_case);
  }
  catch (...)
  {
    follow();
    throw;
  }
  follow();
  const auto lay = [this](const std::vector<scene::MrPlace>& to)
  { changeMr([&to](scene::Case& value) { scene::layAs(value, to); }); };
  if (!what.empty()) // before it is told: listeners ask what can be undone
    m_edits.did({what, continues, [lay, places] { lay(places); },
                 [lay, after = scene::mrPlaces(*m_case)] { lay(after); }, false, kMrEdits});
  else
    m_edits.close();
  notify(events.mrMoved);
  setUnsaved(true);
  if (tissueMoved) // whoever asks earlier waits for it
    notify(events.preparationWanted);
}

bool WorkstationModel::canUndoMr() const noexcept
{
  return m_case && !drilling() && m_edits.nextOf(kMrEdits);
}

bool WorkstationModel::canRedoMr() const noexcept
{
  return m_case && !drilling() && m_edits.nextRedoOf(kMrEdits);
}

std::string WorkstationModel::undoMrText() const
{
  return canUndoMr() ? m_edits.nextOf(kMrEdits)->what : std::string();
}

std::string WorkstationModel::redoMrText() const
{
  return canRedoMr() ? m_edits.nextRedoOf(kMrEdits)->what : std::string();
}

void WorkstationModel::undoMr()
{
  if (canUndoMr())
    stepEdit([this] { m_edits.undoOf(kMrEdits); });
}

void WorkstationModel::redoMr()
{
  if (canRedoMr())
    stepEdit([this] { m_edits.redoOf(kMrEdits); });
}

bool WorkstationModel::undoMovesMr() const noexcept
{
  return !undoesStroke() && canUndo() && movesMr(*m_edits.next(m_case->applied()));
}

bool WorkstationModel::redoMovesMr() const noexcept
{
  return !redoesStroke() && canRedo() &&
         movesMr(*m_edits.nextRedo(m_case->dissection.history().ahead()));
}

} // namespace petrous::presenters
