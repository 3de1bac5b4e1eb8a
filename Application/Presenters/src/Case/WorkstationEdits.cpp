#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>

#include "LookEdits.h"
#include "Notify.h"
#include "petrous/Appearance/StructureProperties.h"
#include "petrous/Dissection/StrokeNumber.h"
#include "petrous/Presenters/CaseNaming.h"
#include "petrous/Presenters/WorkstationModel.h"

// WorkstationModel: threshold and appearances, and undo over all that changes.
namespace petrous::presenters
{

namespace
{

constexpr char kBone[] = "ct";

using appearance::StructureAppearance;
using appearance::StructureProperty;

std::string strokeText(std::size_t stroke)
{
  return "stroke " + std::to_string(dissection::strokeNumber(stroke));
}

// nullptr: there is no such part.
template <class Case>
auto* lookIn(Case& value, const std::string& part)
{
  if (part == kBone)
    return &value.boneLook;
  if (part == scene::kSoftTissue)
    return &value.softTissue;
  if (auto* structure = scene::findStructure(value, part))
    return &structure->look;
  for (auto& mesh : value.meshes)
    if (mesh.name == part)
      return &mesh.look;
  return static_cast<decltype(&value.boneLook)>(nullptr);
}

// Of the property of that name alone, or the colour with the transfer function that it tints.
bool isContinuous(const std::set<std::string>& keys)
{
  return std::all_of(keys.begin(), keys.end(),
                     [](const std::string& key)
                     {
                       for (const StructureProperty& property : appearance::kStructureProperties)
                         if (property.key == key)
                           return property.isNumber() || key == "color" || key == "transfer";
                       return false;
                     });
}

std::string nounOf(const std::set<std::string>& keys)
{
  std::set<std::string> named = keys;
  if (named.count("preset") > 0)
    named = {"preset"};
  if (named.count("color") > 0)
    named.erase("transfer");
  for (const StructureProperty& property : appearance::kStructureProperties)
    if (named.size() == 1 && *named.begin() == property.key)
      return property.noun;
  return "appearance";
}

} // namespace

LookEdit lookEdit(const std::vector<PartLook>& before, const std::vector<PartLook>& after,
                  const char* bone)
{
  std::set<std::string> keys;
  std::size_t changed = 0, shown = 0;
  std::string name;
  for (std::size_t n = 0; n < before.size(); ++n)
  {
    const StructureAppearance& from = before[n].look;
    const StructureAppearance& to = after[n].look;
    if (from == to)
      continue;
    ++changed;
    shown += to.shown;
    name = before[n].part == kBone                ? bone
           : before[n].part == scene::kSoftTissue ? "soft tissue"
                                                  : shownName(before[n].part);
    const bool isOpacity = before[n].part == kBone && from.opacity != to.opacity &&
                           from.color == to.color && from.shown == to.shown;
    if (isOpacity)
    {
      keys.insert("opacity"); // with the preset that goes with it (withOpacity)
      continue;
    }
    for (const StructureProperty& property : appearance::kStructureProperties)
      if (!appearance::isEqual(from, to, property))
        keys.insert(property.key);
  }
  if (changed != 1)
    name = std::to_string(changed) + " parts";
  if (keys == std::set<std::string>{"shown"} && (shown == 0 || shown == changed))
    return {(shown > 0 ? "show " : "hide ") + name, false};
  return {nounOf(keys) + " of " + name, isContinuous(keys)};
}

void WorkstationModel::recordEdit(EditHistory::Edit edit)
{
  m_edits.did(std::move(edit));
  notify(events.stateChanged);
}

// A stroke that is still open is closed first.
bool WorkstationModel::undoesStroke() const noexcept
{
  return m_case && (drilling() || (m_case->applied() > 0 && !m_edits.next(m_case->applied())));
}

bool WorkstationModel::redoesStroke() const noexcept
{
  if (!m_case || drilling())
    return false;
  const std::size_t ahead = m_case->dissection.history().ahead();
  return ahead > 0 && !m_edits.nextRedo(ahead);
}

bool WorkstationModel::canUndo() const noexcept
{
  return undoesStroke() || (m_case && m_edits.next(m_case->applied()));
}

bool WorkstationModel::canRedo() const noexcept
{
  return redoesStroke() ||
         (m_case && !drilling() && m_edits.nextRedo(m_case->dissection.history().ahead()));
}

std::string WorkstationModel::undoText() const
{
  if (undoesStroke())
    return strokeText(drilling() ? m_case->dissection.strokes().size() // the open one
                                 : m_case->dissection.history().position());
  return canUndo() ? m_edits.next(m_case->applied())->what : std::string();
}

std::string WorkstationModel::redoText() const
{
  if (redoesStroke())
    return strokeText(m_case->dissection.history().next());
  return canRedo() ? m_edits.nextRedo(m_case->dissection.history().ahead())->what : std::string();
}

bool WorkstationModel::undoChangesParts() const noexcept
{
  return !undoesStroke() && canUndo() && m_edits.next(m_case->applied())->changesParts;
}

bool WorkstationModel::redoChangesParts() const noexcept
{
  return !redoesStroke() && canRedo() &&
         m_edits.nextRedo(m_case->dissection.history().ahead())->changesParts;
}

// A change that cannot be taken back is no step any more either.
void WorkstationModel::stepEdit(const std::function<void()>& step)
{
  try
  {
    step();
  }
  catch (...)
  {
    notify(events.stateChanged);
    throw;
  }
  notify(events.stateChanged);
}

void WorkstationModel::undo()
{
  if (undoesStroke())
    return step(true);
  if (canUndo())
    stepEdit([this] { m_edits.undo(m_case->applied()); });
}

void WorkstationModel::redo()
{
  if (redoesStroke())
    return step(false);
  if (canRedo())
    stepEdit([this] { m_edits.redo(m_case->dissection.history().ahead()); });
}

void WorkstationModel::takeBackTried(std::uint64_t before, std::uint64_t of)
{
  const std::uint64_t tried = m_edits.last();
  if (!m_case || drilling() || tried == before || shownAs() != of)
    return;
  m_edits.takeBack(tried);
  notify(events.stateChanged);
}

void WorkstationModel::setSide(scene::Side side)
{
  if (!m_case || drilling() || m_case->description.side == side)
    return;
  const auto set = [this](scene::Side value)
  {
    m_case->description.side = value;
    setUnsaved(true);
  };
  const scene::Side before = m_case->description.side;
  set(side);
  recordEdit({"side", {}, [set, before] { set(before); }, [set, side] { set(side); }});
}

void WorkstationModel::setIso(double hounsfield)
{
  if (!m_case || drilling() || m_case->iso == hounsfield)
    return;
  const double before = m_case->iso;
  applyIso(hounsfield);
  const bool isMr = m_case->ct.modality == scene::Modality::Mr;
  recordEdit({isMr ? "surface threshold" : "bone threshold", "iso",
              [this, before] { applyIso(before); }, [this, hounsfield] { applyIso(hounsfield); }});
}

void WorkstationModel::applyIso(double hounsfield)
{
  // Structures are unaffected.
  std::optional<session::DrillSession> before;
  if (m_session || m_scene)
    before.emplace(session());
  forgetTissue();
  m_case->iso = hounsfield;
  if (before)
    m_session.emplace(*m_case, *before);
  notify(events.appearanceChanged);
  setUnsaved(true);
}

void WorkstationModel::setLook(const std::string& structure,
                               const appearance::StructureAppearance& look)
{
  if (structure != kBone)
    setLooks({{structure, look}});
}

void WorkstationModel::setBoneLook(const appearance::StructureAppearance& look)
{
  setLooks({{kBone, look}});
}

const appearance::StructureAppearance* WorkstationModel::lookOf(const std::string& part) const
{
  return m_case ? lookIn(std::as_const(*m_case), part) : nullptr;
}

void WorkstationModel::setLooks(const std::vector<PartLook>& looks, const std::string& what)
{
  if (!m_case || drilling())
    return;
  std::vector<PartLook> before, after;
  for (const PartLook& one : looks)
    if (const auto* present = lookOf(one.part); present && !(*present == one.look))
    {
      before.push_back({one.part, *present});
      after.push_back(one);
    }
  if (after.empty())
    return;
  const bool isMr = m_case->ct.modality == scene::Modality::Mr;
  const LookEdit named = lookEdit(before, after, isMr ? "tissue" : "bone");
  std::string continues;
  if (what.empty() && named.isContinuous)
  {
    continues = named.what;
    for (const PartLook& one : before)
      continues += '\n' + one.part;
  }
  applyLooks(after);
  recordEdit({what.empty() ? named.what : what, continues,
              [this, before = std::move(before)] { applyLooks(before); },
              [this, after = std::move(after)] { applyLooks(after); }});
}

// What the tool feels is others only where tissue changes: else it stays in the hand.
void WorkstationModel::applyLooks(const std::vector<PartLook>& looks)
{
  bool picture = false, tissue = false;
  std::vector<std::pair<appearance::StructureAppearance*, const PartLook*>> targets;
  for (const PartLook& one : looks)
  {
    auto* present = lookIn(*m_case, one.part);
    if (!present)
      continue;
    targets.emplace_back(present, &one);
    if (one.part == kBone || one.part == scene::kSoftTissue)
      continue;
    const appearance::StructureAppearance& look = one.look;
    const bool isOrder = present->priority != look.priority || present->solid != look.solid;
    picture = picture || isOrder || present->shown != look.shown;
    tissue = tissue || isOrder || present->touchable != look.touchable ||
             present->drillable != look.drillable || present->stiffness != look.stiffness ||
             present->tissue != look.tissue;
  }
  if (tissue)
    forgetTissue();
  m_feelable = m_feelable && !tissue;
  m_drawable = m_drawable && !picture;
  for (const auto& [present, one] : targets)
    *present = one->look;
  notify(events.appearanceChanged);
  setUnsaved(true);
  if (picture || tissue)
    notify(events.preparationWanted);
}

} // namespace petrous::presenters
