#include "petrous/Presenters/WorkstationModel.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace petrous::presenters
{

namespace
{
template <class Event, class... Arguments>
void tell(const Event& event, const Arguments&... arguments)
{
  if (event)
    event(arguments...);
}
} // namespace

WorkstationModel::WorkstationModel(library::Library library)
  : m_library(std::move(library))
{
}

std::optional<std::string> WorkstationModel::latestCase() const
{
  std::optional<library::CaseSummary> latest;
  for (const auto& summary : m_library.list())
    if (!summary.damaged && (!latest || summary.modified > latest->modified))
      latest = summary;
  return latest ? std::optional(latest->name) : std::nullopt;
}

void WorkstationModel::open(const std::string& name)
{
  auto next = std::make_unique<scene::Case>(m_library.open(name));
  m_library.loadDissection(*next);
  next->ct.volume.get(); // a missing object is told now
  show(std::move(next), false);
}

void WorkstationModel::adopt(scene::Case value)
{
  auto next = std::make_unique<scene::Case>(std::move(value));
  m_library.loadDissection(*next);
  m_beingStored = true;
  show(std::move(next), false);
}

void WorkstationModel::stored(const scene::Case& saved)
{
  m_beingStored = false;
  if (!m_case || m_case->name != saved.name)
    return;
  m_case->revision = saved.revision;
  m_case->ct.object = saved.ct.object;
  for (std::size_t n = 0; n < std::min(m_case->mr.size(), saved.mr.size()); ++n)
    m_case->mr[n].object = saved.mr[n].object;
  for (std::size_t n = 0; n < std::min(m_case->labels.size(), saved.labels.size()); ++n)
    m_case->labels[n].object = saved.labels[n].object;
  for (std::size_t n = 0; n < std::min(m_case->meshes.size(), saved.meshes.size()); ++n)
    m_case->meshes[n].object = saved.meshes[n].object;
  tell(events.stateChanged);
}

void WorkstationModel::notStored()
{
  m_beingStored = false;
  setUnsaved(true);
}

void WorkstationModel::show(std::unique_ptr<scene::Case> next, bool unsaved)
{
  m_drill.reset();
  m_session.reset();
  m_assembly = {}; // what it keeps is of the case before
  m_case = std::move(next);
  m_unsaved = unsaved;
  m_crosshair = m_case->ct.geometry.center();
  tell(events.caseChanged);
  tell(events.stateChanged);
}

void WorkstationModel::setUnsaved(bool unsaved)
{
  m_unsaved = unsaved;
  tell(events.stateChanged);
}

void WorkstationModel::setCamera(const core::CameraPose& camera)
{
  if (m_case)
    m_case->camera = camera;
}

void WorkstationModel::save()
{
  if (!m_case)
    return;
  m_library.save(*m_case);
  setUnsaved(false);
}

void WorkstationModel::saveAs(const std::string& name)
{
  scene::Case next = *m_case;
  next.name = name;
  next.revision = 0;
  m_library.save(next);
  *m_case = std::move(next);
  setUnsaved(false);
}

void WorkstationModel::saveElsewhere(const std::filesystem::path& folder, const std::string& name)
{
  library::Library elsewhere(folder);
  scene::Case next = *m_case;
  next.name = name;
  next.revision = 0;
  next.ct.object.clear();
  for (auto& mr : next.mr)
    mr.object.clear();
  for (auto& part : next.labels)
    part.object.clear();
  for (auto& mesh : next.meshes)
    mesh.object.clear();
  for (auto& stroke : next.strokes)
    stroke.object.clear();
  elsewhere.save(next);
  *m_case = std::move(next);
  m_library = std::move(elsewhere);
  setUnsaved(false);
}

bool WorkstationModel::canUndo() const noexcept
{
  return m_case && !m_drill && m_case->applied > 0;
}

bool WorkstationModel::canRedo() const noexcept
{
  return m_case && !m_drill && m_case->applied < m_case->strokes.size();
}

void WorkstationModel::undo()
{
  if (!canUndo() || scene::undo(*m_case, 1) == 0)
    return;
  tellMask();
  setUnsaved(true);
}

void WorkstationModel::redo()
{
  if (!canRedo() || scene::redo(*m_case, 1) == 0)
    return;
  tellMask();
  setUnsaved(true);
}

void WorkstationModel::setIso(double hounsfield)
{
  if (!m_case || m_drill || m_case->iso == hounsfield)
    return;
  m_case->iso = hounsfield;
  m_session.reset();
  tell(events.appearanceChanged);
  setUnsaved(true);
}

void WorkstationModel::setLook(const std::string& structure, const appearance::StructureLook& look)
{
  if (!m_case || m_drill)
    return;
  auto* found = scene::findStructure(*m_case, structure);
  auto* mesh = found ? nullptr : scene::findMesh(*m_case, structure);
  if (!found && !mesh)
    return;
  appearance::StructureLook& present = found ? found->look : mesh->look;
  if (present.touchable != look.touchable || present.drillable != look.drillable)
    m_session.reset();
  present = look;
  tell(events.appearanceChanged);
  setUnsaved(true);
}

void WorkstationModel::setBoneLook(const appearance::StructureLook& look)
{
  if (!m_case || m_drill)
    return;
  m_case->boneLook = look;
  tell(events.appearanceChanged);
  setUnsaved(true);
}

void WorkstationModel::setCrosshair(const Eigen::Vector3d& patient)
{
  if (!m_case)
    return;
  const auto& grid = m_case->ct.geometry;
  Eigen::Vector3d voxel = grid.voxelFromPatient(patient);
  for (Eigen::Index a = 0; a < 3; ++a)
    voxel[a] = std::clamp(voxel[a], 0.0, grid.dims()[static_cast<std::size_t>(a)] - 1.0);
  m_crosshair = grid.patientFromVoxel(voxel);
  tell(events.crosshairMoved);
}

std::optional<double> WorkstationModel::hounsfieldAt(const Eigen::Vector3d& patient) const
{
  if (!m_case)
    return std::nullopt;
  const Eigen::Vector3d voxel = m_case->ct.geometry.voxelFromPatient(patient);
  if (!m_case->ct.geometry.hullContains(voxel))
    return std::nullopt;
  return m_case->ct.volume.get()->sample(voxel);
}

std::string WorkstationModel::structureAt(const Eigen::Vector3d& patient) const
{
  if (!m_case)
    return {};
  for (const auto& part : m_case->labels)
  {
    const auto labels = part.labels.peek();
    if (!labels)
      continue;
    const auto& voxels = *labels->voxels;
    const Eigen::Vector3d voxel = voxels.geometry().voxelFromPatient(patient);
    const core::Index3 nearest{static_cast<int>(std::floor(voxel[0] + 0.5)),
                               static_cast<int>(std::floor(voxel[1] + 0.5)),
                               static_cast<int>(std::floor(voxel[2] + 0.5))};
    if (!voxels.geometry().fullBox().contains(nearest))
      continue;
    const std::uint16_t index = voxels.at(nearest[0], nearest[1], nearest[2]);
    for (const auto& structure : part.structures)
      if (structure.index == index)
        return structure.name;
  }
  for (const auto& mesh : m_case->meshes)
    if (const auto solid = mesh.touch.resident(); solid && volume::isInside(*solid, patient))
      return mesh.name;
  return {};
}

DrillSession& WorkstationModel::session()
{
  if (!m_session)
    m_session.emplace(*m_case);
  return *m_session;
}

std::optional<Eigen::Vector3d> WorkstationModel::surfaceAt(const SightLine& line)
{
  if (!m_case)
    return std::nullopt;
  const auto hit = firstTissue(session().field(), line);
  return hit ? std::optional<Eigen::Vector3d>(line.origin + *hit * line.direction) : std::nullopt;
}

std::optional<Eigen::Vector3d> WorkstationModel::burrAt(const SightLine& line, double radius)
{
  if (!m_case)
    return std::nullopt;
  const auto rest = burrRest(session().field(), line, radius);
  return rest ? std::optional<Eigen::Vector3d>(line.origin + *rest * line.direction) : std::nullopt;
}

void WorkstationModel::beginStroke(const SightLine& line, const dissection::Burr& burr, double feed,
                                   double seconds, const core::CameraPose& camera)
{
  if (!m_case || m_drill)
    return;
  m_drill.emplace(session(), burr, feed);
  m_drill->begin(line, seconds, camera);
  tellMask();
}

std::optional<Eigen::Vector3d> WorkstationModel::drill(const SightLine& line, double seconds)
{
  if (!m_drill)
    return std::nullopt;
  if (m_drill->moveTo(line, seconds))
    tellMask();
  return m_drill->center();
}

std::shared_ptr<const dissection::Stroke> WorkstationModel::endStroke()
{
  if (!m_drill)
    return nullptr;
  auto stroke = m_drill->end();
  m_drill.reset();
  tellMask();
  if (stroke)
    m_unsaved = true;
  tell(events.stateChanged);
  return stroke;
}

void WorkstationModel::tellMask()
{
  auto& mask = m_case->dissection->mask();
  const auto dirty = mask.takeDirty();
  if (!dirty.empty())
    tell(events.maskChanged, mask.boxOf(dirty));
}

} // namespace petrous::presenters
