#include "petrous/Presenters/StructureList.h"

#include <algorithm>
#include <map>

#include "LookEdits.h"
#include "petrous/Presenters/CaseBuilder.h"
#include "petrous/Presenters/CaseNaming.h"
#include "petrous/Scene/Placement.h"

namespace petrous::presenters
{

namespace
{
constexpr char kBone[] = "ct";
}

StructureKind kindOf(const appearance::StructureAppearance& look)
{
  static const std::map<std::string, StructureKind> kinds{
      {"nerve", StructureKind::Nerve},        {"artery", StructureKind::Vessel},
      {"vein", StructureKind::Vessel},        {"ossicle", StructureKind::Ossicle},
      {"inner-ear", StructureKind::InnerEar}, {"dura", StructureKind::Dura}};
  if (!look.solid)
    return StructureKind::Lumen;
  const auto found = kinds.find(look.preset);
  return found == kinds.end() ? StructureKind::Other : found->second;
}

std::vector<StructureRow> structureRows(const scene::Case& value)
{
  std::vector<StructureRow> rows{
      {kBone, StructureKind::Bone, 0.0, value.boneLook, {}},
      {scene::kSoftTissue, StructureKind::SoftTissue, 0.0, value.softTissue, {}}};
  for (const auto& part : value.labels)
  {
    const std::string missing = scene::placementOf(value, part).missing;
    for (const auto& structure : part.structures)
      rows.push_back({structure.name, kindOf(structure.look), structure.volume, structure.look,
                      missing, scene::outdatedReading(value, structure.readings)});
  }
  for (const auto& mesh : value.meshes)
    if (!scene::findStructure(value, mesh.name))
      rows.push_back({mesh.name, StructureKind::Mesh, 0.0, mesh.look,
                      scene::placementOf(value, mesh).missing});
  std::stable_sort(rows.begin(), rows.end(),
                   [](const StructureRow& a, const StructureRow& b) { return a.kind < b.kind; });
  return rows;
}

void changeLooks(
    WorkstationModel& model, const std::vector<std::string>& parts,
    const std::function<void(const std::string& part, appearance::StructureAppearance&)>& change)
{
  std::vector<PartLook> looks;
  for (const std::string& part : parts)
    if (const auto* look = model.lookOf(part))
    {
      looks.push_back({part, *look});
      change(part, looks.back().look);
    }
  model.setLooks(looks);
}

OnlyThese::OnlyThese(WorkstationModel& model)
  : m_model(model)
{
}

OnlyThese::Shown OnlyThese::shown() const
{
  Shown result;
  if (m_model.hasCase())
    for (const StructureRow& row : structureRows(m_model.value()))
      result.emplace_back(row.part, row.look.shown);
  return result;
}

OnlyThese::Shown OnlyThese::alone(const std::vector<std::string>& parts) const
{
  Shown result = shown();
  for (auto& [part, isShown] : result)
  {
    const bool isOne = std::find(parts.begin(), parts.end(), part) != parts.end();
    isShown = isOne || (part == kBone && isShown);
  }
  return result;
}

bool OnlyThese::isOn(const std::vector<std::string>& parts) const
{
  return m_now && m_case == m_model.shownAs() && !parts.empty() && shown() == *m_now &&
         alone(parts) == *m_now;
}

void OnlyThese::show(const Shown& wanted, const std::string& what)
{
  std::vector<PartLook> looks;
  for (const auto& [part, isShown] : wanted)
    if (const auto* look = m_model.lookOf(part))
    {
      looks.push_back({part, *look});
      looks.back().look.shown = isShown;
    }
  m_model.setLooks(looks, what);
}

void OnlyThese::toggle(const std::vector<std::string>& parts)
{
  if (!m_model.hasCase() || parts.empty())
    return;
  if (isOn(parts))
  {
    show(m_before, "show what was shown before");
    m_now.reset();
    return;
  }
  const Shown present = shown();
  if (!m_now || m_case != m_model.shownAs() || present != *m_now)
    m_before = present; // else these are shown alone in place of others
  m_case = m_model.shownAs();
  show(alone(parts), parts.size() == 1
                         ? "only " + (parts[0] == kBone                ? "bone"
                                      : parts[0] == scene::kSoftTissue ? "soft tissue"
                                                                       : shownName(parts[0]))
                         : "only " + std::to_string(parts.size()) + " parts");
  m_now = shown();
}

void OnlyThese::renamed(const std::string& from, const std::string& to)
{
  const auto follow = [&](Shown& list)
  {
    for (auto& [part, isShown] : list)
      if (part == from)
        part = to;
  };
  follow(m_before);
  if (m_now)
    follow(*m_now);
}

} // namespace petrous::presenters
