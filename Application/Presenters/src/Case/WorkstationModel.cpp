#include "petrous/Presenters/WorkstationModel.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "Notify.h"
#include "petrous/Core/InputFile.h"
#include "petrous/Library/Attachments.h"
#include "petrous/Library/LibraryFiles.h"
#include "petrous/Presenters/CasePicture.h"
#include "petrous/Presenters/Recordings.h"
#include "petrous/Scene/Placement.h"
#include "petrous/Scene/VideoNotes.h"

namespace petrous::presenters
{

WorkstationModel::WorkstationModel(library::Library library)
  : m_library(std::move(library))
{
  listen();
}

std::optional<std::string> WorkstationModel::latestCase(const std::string& lastOpened) const
{
  std::vector<library::CaseSummary> cases = m_library.list();
  cases.erase(std::remove_if(cases.begin(), cases.end(),
                             [](const auto& summary) { return summary.damaged; }),
              cases.end());
  const auto found = [&cases](const auto& isIt) -> std::optional<std::string>
  {
    const auto at = std::find_if(cases.begin(), cases.end(), isIt);
    return at == cases.end() ? std::nullopt : std::optional(at->name);
  };
  for (const std::string& killed : m_library.unrecovered())
    if (const auto name = found([&](const auto& summary) { return summary.name == killed; }))
      return name;
  if (!lastOpened.empty())
    if (const auto name = found([&](const auto& summary) { return summary.id == lastOpened; }))
      return name;
  const auto latest =
      std::max_element(cases.begin(), cases.end(),
                       [](const auto& a, const auto& b) { return a.modified < b.modified; });
  return latest == cases.end() ? std::nullopt : std::optional(latest->name);
}

void WorkstationModel::show(std::unique_ptr<scene::Case> next, bool unsaved)
{
  forgetTissue();
  record({}); // it replays on one case
  m_journal.reset();
  m_saved.reset();
  m_mark.reset();
  m_nearby.reset();
  m_assembly = {}; // its cache is of the previous case
  m_leftOut.clear();
  m_removed.clear();
  m_taken.clear();
  m_edits.clear();
  m_damagedStrokes.clear();
  m_undoneForDamage = 0;
  m_lastRecording.clear();
  m_case = std::move(next);
  ++m_shown;
  m_leaving = false;
  m_checked = unsaved; // a case just made needs no check
  m_unsaved = unsaved;
  m_journal = std::make_shared<JournalThread>();
  m_crosshair = m_case->view.slices ? clampedToCt(m_case->view.slices->crosshair)
                                    : m_case->ct.geometry.center();
  waitForParts();
  notify(events.caseChanged);
  notify(events.stateChanged);
  notify(events.preparationWanted);
}

void WorkstationModel::waitForParts()
{
  ++m_parts;
  m_loaded = m_drawable = m_feelable = m_case->labels.empty() && m_case->meshes.empty();
}

void WorkstationModel::setUnsaved(bool unsaved)
{
  m_unsaved = unsaved;
  m_changes += unsaved;
  notify(events.stateChanged);
}

scene::Case WorkstationModel::presentable() const
{
  scene::Case value = *m_case;
  if (!m_loaded)
  {
    value.labels.clear();
    value.meshes.clear();
  }
  return value;
}

rendering::SceneContents WorkstationModel::sceneContents()
{
  if (m_loaded)
    return m_assembly.contents(*m_case);
  rendering::SceneContents contents = SceneAssembly().contents(presentable());
  contents.mask = m_case->dissection.sharedMask(); // not that of the copy
  return contents;
}

std::function<PreparedCase(const core::Progress&)> WorkstationModel::preparation() const
{
  scene::Case value = *m_case;
  return [value = std::move(value), library = m_library, assembly = m_assembly, parts = m_parts,
          tissue = m_tissue, felt = m_session || m_scene](const core::Progress& progress) mutable
  {
    PreparedCase done;
    done.leftOut = leaveOutDamaged(value, progress.part(0.0, 0.3));
    done.assembly = std::move(assembly);
    try
    {
      done.assembly.contents(value, progress.part(0.3, 0.6));
    }
    catch (const core::InvalidParameter&) // too much to draw; reported by the renderer
    {
    }
    if (!felt)
      done.drill.emplace(value, progress.part(0.6, 0.95));
    try
    {
      library.checkVoxels(value, progress.part(0.95, 1.0)); // usually done by now
    }
    catch (const library::LibraryError&) // reported by WorkstationModel::damage
    {
    }
    done.parts = parts;
    done.tissue = tissue;
    return done;
  };
}

bool WorkstationModel::prepared(PreparedCase done)
{
  if (!m_case || done.parts != m_parts)
    return false;
  if (!done.leftOut.empty())
  {
    done.leftOut.takeOut(*m_case);
    m_leftOut.push_back(std::move(done.leftOut));
  }
  m_loaded = m_drawable = m_checked = true;
  done.assembly.takeThickness(m_assembly); // may have been requested meanwhile
  m_assembly = std::move(done.assembly);
  if (done.tissue == m_tissue)
    m_feelable = true;
  if (done.drill && done.tissue == m_tissue && !m_scene && !m_session)
    m_session.emplace(*m_case, *done.drill);
  notify(events.appearanceChanged);
  if (!m_feelable) // the threshold was changed meanwhile
    notify(events.preparationWanted);
  return true;
}

std::vector<std::string> WorkstationModel::damage() const
{
  return m_case ? m_library.damageFound(*m_case) : std::vector<std::string>();
}

std::vector<std::string> WorkstationModel::leftOut() const
{
  std::vector<std::string> sentences;
  for (const LeftOut& parts : m_leftOut)
    for (std::string& why : parts.sentences())
      sentences.push_back(std::move(why));
  return sentences;
}

void WorkstationModel::setCamera(const core::CameraPose& camera)
{
  if (m_case)
    m_case->camera = camera;
}

void WorkstationModel::setView(const scene::ViewState& view)
{
  if (!m_case)
    return;
  auto branches = std::move(m_case->view.branches);
  const auto instrument = m_case->view.instrument;
  m_case->view = view;
  if (instrument && view.instrument && *instrument == *view.instrument)
    m_case->view.instrument = instrument; // which may be stored already
  m_case->view.branches = std::move(branches);
}

void WorkstationModel::saveView(const std::string& name, const core::CameraPose& camera,
                                const scene::ViewState::Slices& slices)
{
  if (!m_case)
    return;
  scene::Case with;
  with.view.saved = m_case->view.saved;
  with.view.slices = slices;
  scene::saveView(with, name, camera);
  changeView(name, with.view.saved.at(name), "view");
}

void WorkstationModel::removeView(const std::string& name)
{
  if (m_case && m_case->view.saved.count(name) > 0)
    changeView(name, std::nullopt, "removal of view");
}

void WorkstationModel::changeView(const std::string& name,
                                  const std::optional<scene::ViewState::Saved>& to,
                                  const std::string& what)
{
  const auto found = m_case->view.saved.find(name);
  std::optional<scene::ViewState::Saved> before;
  if (found != m_case->view.saved.end())
    before = found->second;
  putView(name, to);
  recordEdit({what + " '" + name + "'",
              {},
              [this, name, before] { putView(name, before); },
              [this, name, to] { putView(name, to); }});
}

void WorkstationModel::putView(const std::string& name,
                               const std::optional<scene::ViewState::Saved>& saved)
{
  if (saved)
    m_case->view.saved[name] = *saved;
  else
    m_case->view.saved.erase(name);
  setUnsaved(true);
  notify(events.savedViewsChanged);
}

void WorkstationModel::setClipping(const scene::ViewState::Clipping& clipping)
{
  if (!m_case || m_case->view.clipping == clipping)
    return;
  scene::ViewState view;
  view.clipping = clipping;
  scene::checkView(view);
  m_case->view.clipping = clipping;
  notify(events.appearanceChanged);
  setUnsaved(true);
}

std::string WorkstationModel::attach(scene::Attachment attachment)
{
  if (!m_case)
    return {};
  const std::string name = library::attach(*m_case, std::move(attachment));
  setUnsaved(true);
  notify(events.attachmentsChanged);
  return name;
}

void WorkstationModel::setAttachmentNote(const std::string& name, const std::string& note)
{
  if (!m_case || scene::findAttachment(*m_case, name).note == note)
    return;
  std::vector<scene::Attachment> before = m_case->attachments;
  scene::findAttachment(*m_case, name).note = note;
  try
  {
    scene::checkAttachments(m_case->attachments);
  }
  catch (const core::InvalidParameter&)
  {
    m_case->attachments = std::move(before);
    throw;
  }
  setUnsaved(true);
  notify(events.attachmentsChanged);
}

void WorkstationModel::removeAttachment(const std::string& name)
{
  if (!m_case)
    return;
  const scene::Attachment& found = scene::findAttachment(*m_case, name);
  m_case->attachments.erase(m_case->attachments.begin() + (&found - m_case->attachments.data()));
  setUnsaved(true);
  notify(events.attachmentsChanged);
}

void WorkstationModel::setVideoNotes(const std::string& name, const scene::VideoNotes& notes,
                                     const std::string& what, const std::string& continues)
{
  if (!m_case)
    return;
  const auto before = scene::findAttachment(*m_case, name).video;
  if (before ? *before == notes : notes.empty())
    return;
  scene::checkVideoNotes(notes);
  const auto set = [this, name](const std::shared_ptr<const scene::VideoNotes>& to)
  {
    scene::findAttachment(*m_case, name).video = to;
    setUnsaved(true);
    notify(events.attachmentsChanged);
  };
  auto after = std::make_shared<scene::VideoNotes>(notes);
  scene::sortVideoNotes(*after);
  set(after);
  if (!what.empty())
    recordEdit({what, continues, [set, before] { set(before); }, [set, after] { set(after); }});
}

void WorkstationModel::setMeasurements(std::vector<scene::Measurement> measurements)
{
  if (!m_case || m_case->measurements == measurements)
    return;
  scene::checkMeasurements(measurements);
  m_case->measurements = std::move(measurements);
  setUnsaved(true);
  notify(events.measurementsChanged);
}

void WorkstationModel::step(bool back)
{
  const std::size_t stroke =
      back ? dissection::History::kStart : m_case->dissection.history().next();
  if (stroke != dissection::History::kStart)
    m_case->dissection.strokes()[stroke]->packed.get(); // a damaged one is refused here
  if (m_touch)
    return back ? m_touch->undo() : m_touch->redo();
  if ((back ? m_case->dissection.undo() : m_case->dissection.redo()) == 0)
    return;
  m_edits.strokeStepped(back);
  followHistory();
  notify(events.stepped, back);
}

// Call after the case itself moved to another state.
void WorkstationModel::followHistory()
{
  const std::vector<std::size_t> bricks = m_case->dissection.mask().takeDirty();
  if (m_scene)
    m_scene->publish(bricks);
  if (m_journal)
    m_journal->follow(m_case->dissection);
  notifyMask(bricks);
  setUnsaved(true);
}

Eigen::Vector3d WorkstationModel::clampedToCt(const Eigen::Vector3d& patient) const
{
  const auto& grid = m_case->ct.geometry;
  Eigen::Vector3d voxel = grid.voxelFromPatient(patient);
  for (Eigen::Index a = 0; a < 3; ++a)
    voxel[a] = std::clamp(voxel[a], 0.0, grid.dims()[static_cast<std::size_t>(a)] - 1.0);
  return grid.patientFromVoxel(voxel);
}

void WorkstationModel::setCrosshair(const Eigen::Vector3d& patient)
{
  if (!m_case)
    return;
  m_crosshair = clampedToCt(patient);
  notify(events.crosshairMoved);
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

namespace
{

// Of the nearest voxel; none outside the grid.
std::optional<std::uint16_t> labelAt(const volume::LabelMap& labels, const Eigen::Vector3d& patient)
{
  const auto& voxels = *labels.voxels;
  const Eigen::Vector3d voxel = voxels.geometry().voxelFromPatient(patient);
  const core::Index3 nearest{static_cast<int>(std::floor(voxel[0] + 0.5)),
                             static_cast<int>(std::floor(voxel[1] + 0.5)),
                             static_cast<int>(std::floor(voxel[2] + 0.5))};
  if (!voxels.geometry().fullBox().contains(nearest))
    return std::nullopt;
  return voxels.at(nearest[0], nearest[1], nearest[2]);
}

} // namespace

std::string WorkstationModel::structureAt(const Eigen::Vector3d& patient) const
{
  if (!m_case)
    return {};
  for (const auto& part : m_case->labels)
  {
    const auto labels = part.labels.peek() ? scene::labelsOnCt(*m_case, part) : nullptr;
    if (!labels)
      continue;
    const auto index = labelAt(*labels, patient);
    for (const auto& structure : part.structures)
      if (structure.index == index)
        return structure.name;
  }
  for (const auto& mesh : m_case->meshes)
    if (const auto solid = mesh.touch.resident(); solid && volume::isInside(*solid, patient))
      return mesh.name;
  return {};
}

session::DrillSession& WorkstationModel::session()
{
  if (m_scene)
    return m_scene->drill();
  if (!m_session)
    m_session.emplace(*m_case);
  return *m_session;
}

void WorkstationModel::forgetReader()
{
  m_reader.reset();
  ++m_tissueChanges;
}

// Drops what was derived from the case's voxels, threshold and structures.
void WorkstationModel::forgetTissue()
{
  stopTouch();
  forgetReader();
  m_scene.reset();
  m_felt.reset();
  m_session.reset();
  ++m_tissue;
}

PlaceReading WorkstationModel::readPlace(const Eigen::Vector3d& patient)
{
  if (!ready())
  {
    PlaceReading reading;
    reading.hounsfield = hounsfieldAt(patient);
    return reading;
  }
  if (!m_reader)
    m_reader = std::make_unique<PointProbe>(*m_case, session().field());
  PlaceReading reading = m_reader->at(patient);
  if (!reading.structure.empty())
    return reading;
  if (!m_nearby) // after the reader, which voxelizes the meshes
    m_nearby = std::make_unique<NearbyStructures>(*m_case);
  reading.isNearKnown = m_nearby->ready();
  if (!reading.isNearKnown)
    return reading;
  reading.near =
      m_nearby->surfaces().nearest(patient, PointProbe::kReach,
                                   [this](const std::string& name)
                                   {
                                     const auto* part = scene::findStructure(*m_case, name);
                                     const auto* mesh = scene::findMesh(*m_case, name);
                                     return part ? part->look.shown : mesh && mesh->look.shown;
                                   });
  return reading;
}

std::optional<double> WorkstationModel::tissueAlong(const interaction::PickRay& line)
{
  if (!m_case || !ready())
    return std::nullopt;
  return interaction::firstTissue(session().field(), line);
}

// The place may be a little before the surface: what is air there is not the other side.
std::optional<double> WorkstationModel::wallBehind(const Eigen::Vector3d& surface,
                                                   const Eigen::Vector3d& direction)
{
  constexpr double kStep = 0.1; // mm
  constexpr double kLead = 0.5; // mm in which the surface must come
  const volume::TissueField& field = session().field();
  double first = 0.0;
  while (first < kLead && field.value(surface + first * direction) <= 0.0)
    first += kStep;
  if (first >= kLead)
    return std::nullopt;

  struct Warned
  {
    std::shared_ptr<const volume::LabelMap> labels;
    std::vector<std::uint16_t> indices;
  };
  std::vector<Warned> warned;
  for (const auto& part : m_case->labels)
  {
    Warned these;
    for (const auto& structure : part.structures)
      if (structure.look.warning > 0.0)
        these.indices.push_back(structure.index);
    if (!these.indices.empty() && part.labels.peek())
      these.labels = scene::labelsOnCt(*m_case, part);
    if (these.labels)
      warned.push_back(std::move(these));
  }
  const auto isWarned = [&warned](const Eigen::Vector3d& at)
  {
    return std::any_of(warned.begin(), warned.end(),
                       [&at](const Warned& these)
                       {
                         const auto index = labelAt(*these.labels, at);
                         return index && std::find(these.indices.begin(), these.indices.end(),
                                                   *index) != these.indices.end();
                       });
  };
  for (int step = 0; step * kStep < kThickWall; ++step)
  {
    const Eigen::Vector3d at = surface + (first + step * kStep) * direction;
    if (field.value(at) <= 0.0 || isWarned(at))
      return step * kStep;
  }
  return kThickWall;
}

std::optional<Eigen::Vector3d> WorkstationModel::surfaceAt(const interaction::PickRay& line)
{
  if (!m_case || !ready())
    return std::nullopt;
  const rendering::RaySpan shown = shownPart(line, m_case->view.clipping, m_case->ct.geometry);
  if (!(shown.first < shown.last))
    return std::nullopt;
  const Eigen::Vector3d entry = line.at(shown.first);
  const volume::TissueField& field = session().field();
  if (shown.isCut && field.uncut(entry) <= 0.0 && drawsSoftFace(*m_case, entry))
    return entry;
  const auto hit = field.firstHit(entry, line.at(shown.last));
  return hit ? std::optional<Eigen::Vector3d>(line.at(shown.first + *hit)) : std::nullopt;
}

bool WorkstationModel::isCutAway(const interaction::PickRay& line)
{
  return tissueAlong(line) && !surfaceAt(line);
}

bool WorkstationModel::toolReady(const session::TouchTool& tool) const
{
  if (!m_case || !(m_scene || m_felt))
    return false;
  return !tool.needsBurrShell() ||
         m_shells.count({tool.burr.diameter, m_case->ct.geometry.minSpacing()}) > 0;
}

std::function<PreparedTool(const core::Progress&)>
WorkstationModel::toolPreparation(const session::TouchTool& tool)
{
  PreparedTool wanted;
  wanted.burr = tool.burr;
  wanted.voxel = m_case->ct.geometry.minSpacing();
  wanted.tissue = m_tissue;
  const bool shell =
      tool.needsBurrShell() && m_shells.count({tool.burr.diameter, wanted.voxel}) == 0;
  std::shared_ptr<const scene::Case> value;
  std::optional<volume::TissueField> field;
  if (!m_scene && !m_felt)
  {
    value = std::make_shared<const scene::Case>(*m_case);
    field = session().field();
  }
  return
      [wanted, shell, value, field, geometry = m_case->ct.geometry](const core::Progress& progress)
  {
    PreparedTool done = wanted;
    if (value)
      done.felt = session::feltTissue(*value, *field, progress.part(0.0, 0.8));
    progress.check("making the tool");
    if (shell)
      done.shell = session::shellOf(wanted.burr, geometry);
    return done;
  };
}

void WorkstationModel::toolPrepared(PreparedTool done)
{
  if (done.shell)
    m_shells[{done.burr.diameter, done.voxel}] = done.shell;
  if (done.felt && done.tissue == m_tissue && m_case && !m_scene)
    m_felt = std::move(done.felt);
}

void WorkstationModel::startTouch(haptics::Device& device,
                                  const session::TouchSession::Setup& setup)
{
  if (!m_case)
    return;
  stopTouch();
  if (m_leaving)
    throw core::InvalidParameter("Another case is being opened; then the tool can be taken up.");
  if (!ready())
    throw core::InvalidParameter("The case is still being prepared; then the tool can be taken "
                                 "up.");
  if (const auto found = damage(); !found.empty())
    throw library::LibraryError(library::LibraryError::Reason::Damaged, found.front());
  if (!m_scene)
  {
    m_reader.reset();
    m_scene = m_felt ? std::make_unique<session::TouchScene>(*m_case, session(), std::move(*m_felt))
                     : std::make_unique<session::TouchScene>(*m_case, session());
    m_felt.reset();
    m_session.reset();
  }
  if (setup.tool.needsBurrShell())
  {
    auto& shell = m_shells[{setup.tool.burr.diameter, m_case->ct.geometry.minSpacing()}];
    if (!shell)
      shell = session::shellOf(setup.tool.burr, m_case->ct.geometry);
    m_scene->giveShell(setup.tool.burr, shell);
  }
  session::TouchSession::Setup whole = setup;
  whole.catalogues = dissection::Catalogues::in(m_library.folder());
  if (m_journal)
    whole.journal = [journal = m_journal, measure = m_scene->drill().measurer()](
                        const dissection::Dissection& work) { journal->follow(work, measure); };
  const auto start = [&]
  { m_touch = std::make_unique<session::TouchSession>(*m_case, *m_scene, device, whole); };
  if (m_recording.empty() || !setup.cuts)
    return start();
  whole.recording = m_recordingBegun ? unusedName(m_recordingAs) : m_recordingAs;
  try
  {
    if (library::isOfLibrary(whole.recording, m_library.folder()) ||
        library::isOfAnyLibrary(whole.recording))
      throw session::RecordingError(
          session::RecordingError::Reason::NotWritten,
          core::printable(whole.recording) +
              ": the library keeps its own data there; name another file");
    start();
    m_recordingBegun = true;
    m_recordedTo = whole.recording;
    setRecording(whole.recording);
  }
  catch (const session::RecordingError& error) // drilling does not depend on it
  {
    whole.recording.clear();
    m_recordedTo.clear();
    start();
    setRecording({}, std::string("Nothing is recorded: ") + error.what() + ".");
  }
}

void WorkstationModel::record(const std::filesystem::path& file)
{
  m_recordingAs = file;
  m_recordingBegun = false;
  setRecording(file);
}

void WorkstationModel::setRecording(const std::filesystem::path& file, const std::string& fault)
{
  if (m_recording == file && fault.empty())
    return;
  m_recording = file;
  notify(events.recordingChanged, fault);
}

// Forwards the news to the case's observers.
session::TouchSession::News WorkstationModel::hear(session::TouchSession::News news)
{
  if (m_journal)
    news.journalFault = m_journal->takeFailure();
  notifyMask(news.bricks);
  if (!news.recordingFault.empty())
  {
    m_recordedTo.clear();
    setRecording({}, news.recordingFault);
  }
  bool changed = !news.steps.empty();
  for (const auto& stroke : news.strokes)
    if (stroke)
    {
      changed = true;
      m_edits.strokeMade();
    }
  for (const bool back : news.steps)
    m_edits.strokeStepped(back);
  m_unsaved = m_unsaved || changed;
  m_changes += changed;
  if (!news.strokes.empty() || !news.steps.empty())
    notify(events.stateChanged);
  if (!news.steps.empty())
    notify(events.stepped, static_cast<bool>(news.steps.back()));
  return news;
}

session::TouchSession::News WorkstationModel::advanceTouch()
{
  if (!m_touch)
    return {};
  const bool before = drilling();
  session::TouchSession::News news = hear(m_touch->advance());
  if (drilling() && !before)
    notify(events.stateChanged);
  return news;
}

session::TouchSession::News WorkstationModel::stopTouch()
{
  if (!m_touch)
    return {};
  session::TouchSession::News news = m_touch->stop();
  if (m_touch->failed()) // touched and rendered tissue may differ
  {
    forgetReader();
    m_touch.reset();
    m_scene.reset();
  }
  m_touch.reset();
  news = hear(std::move(news));
  if (!m_recordedTo.empty()) // whole, as no fault was heard of
  {
    m_lastRecording = std::exchange(m_recordedTo, {});
    notify(events.recordingChanged, std::string());
  }
  return news;
}

void WorkstationModel::notifyMask(const std::vector<std::size_t>& bricks)
{
  if (bricks.empty())
    return;
  forgetReader();
  notify(events.maskChanged, m_case->dissection.mask().boxOf(bricks));
}

} // namespace petrous::presenters
