#include <algorithm>
#include <utility>

#include "Notify.h"
#include "petrous/Library/Attachments.h"
#include "petrous/Library/FrameSalt.h"
#include "petrous/Presenters/CaseBuilder.h"
#include "petrous/Presenters/WorkstationModel.h"
#include "petrous/Scene/Placement.h"

// WorkstationModel: loading from and saving to the library.
namespace petrous::presenters
{

void WorkstationModel::listen()
{
  m_library.onNotice([this](const std::string& words) { notify(events.noticed, words); });
}

// Call when the case is as saved, or continues from there.
void WorkstationModel::keepJournal(const library::SavedState& saved, bool another)
{
  m_saved = saved;
  markOpen(saved);
  try
  {
    if (!m_journal)
      m_journal = std::make_shared<JournalThread>();
    if (m_journal->begun() && !another)
      m_journal->saved(saved);
    else
      m_journal->begin(m_library, saved);
  }
  catch (const std::exception& error)
  {
    notify(events.noticed, std::string(error.what()));
  }
}

void WorkstationModel::markOpen(const library::SavedState& saved)
{
  if (m_mark && m_mark->id() == saved.id)
    return;
  m_mark.reset();
  if (const std::string openersText =
          library::toString(library::openersOf(m_library.folder(), saved.id));
      !openersText.empty())
    notify(events.noticed, "case '" + saved.name + "' is open in another window of Petrous, too (" +
                               openersText +
                               "): look at it as you like, but what is changed in both can be "
                               "saved in one of them only");
  m_mark = std::make_unique<library::OpenMark>(m_library.folder(), saved.id);
}

ReadCase ReadCase::from(const library::Library& library, const std::string& name,
                        const core::Progress& progress)
{
  ReadCase result;
  library::Library own = library; // with a listener of its own
  own.onNotice([&result](const std::string& words) { result.notices.push_back(words); });
  progress.report(0.0, "opening " + name);
  result.value = std::make_unique<scene::Case>(own.open(name));
  progress.report(0.3, "reading what was drilled");
  const std::size_t applied = result.value->applied();
  result.strokes = own.loadSoundDissection(*result.value);
  result.undone = applied - result.value->applied();
  progress.report(0.8, "reading the CT");
  try
  {
    result.value->ct.volume.get(); // reports a missing object now
  }
  catch (const core::CancelledError&)
  {
    throw;
  }
  catch (const core::Error&)
  {
    if (!own.standInForCt(*result.value, progress))
      throw;
  }
  // Of an older case the grid tells on which image labels were drawn: whoever asks in the window's
  // thread must not wait for it.
  std::vector<const scene::LabelPart*> unplaced;
  for (const scene::LabelPart& part : result.value->labels)
    if (!part.drawnOn && !result.value->mr.empty() && part.labels)
      unplaced.push_back(&part);
  scene::readLabels(unplaced);
  progress.check("opening " + name);
  return result;
}

void WorkstationModel::open(const std::string& name)
{
  beginOpen(name);
  try
  {
    opened(ReadCase::from(m_library, name));
  }
  catch (...)
  {
    notOpened();
    throw;
  }
  prepareNow();
}

void WorkstationModel::beginLeave()
{
  stopTouch();
  m_leaving = true;
}

void WorkstationModel::beginOpen(const std::string& name)
{
  beginLeave();
  if (m_case && m_case->name == name)
    m_journal.reset(); // otherwise it would look as if another program drilled in it
}

void WorkstationModel::opened(ReadCase next)
{
  show(std::move(next.value), false);
  m_damagedStrokes = std::move(next.strokes);
  m_undoneForDamage = next.undone;
  keepJournal(*m_case);
  for (const std::string& words : next.notices)
    notify(events.noticed, words);
}

void WorkstationModel::notOpened()
{
  m_leaving = false;
  if (!m_case || m_journal || !m_saved)
    return;
  keepJournal(*m_saved);
  if (m_journal)
    m_journal->follow(m_case->dissection);
}

void WorkstationModel::adopt(scene::Case value)
{
  auto next = std::make_unique<scene::Case>(std::move(value));
  m_library.loadDissection(*next);
  show(std::move(next), true);
  setUnsaved(true);
}

namespace
{
bool sameLabels(const scene::LabelPart& a, const scene::LabelPart& b)
{
  return a.labels.peek() == b.labels.peek() &&
         std::equal(a.structures.begin(), a.structures.end(), b.structures.begin(),
                    b.structures.end(),
                    [](const auto& x, const auto& y) { return x.name == y.name; });
}
} // namespace

void WorkstationModel::close()
{
  if (!m_case)
    return;
  forgetTissue();
  record({});
  m_journal.reset();
  m_nearby.reset();
  m_assembly = {};
  m_case.reset();
  m_saved.reset();
  m_mark.reset();
  m_unsaved = m_leaving = false;
  m_loaded = m_drawable = m_feelable = m_checked = true;
  m_leftOut.clear();
  m_removed.clear();
  m_edits.clear();
  m_damagedStrokes.clear();
  m_undoneForDamage = 0;
  ++m_parts;
  ++m_shown;
  notify(events.caseClosed);
  notify(events.stateChanged);
  notify(events.preparationWanted);
}

namespace
{

// One that is lost is not in the way of the case.
bool isReadable(const scene::ViewState::Instrument& instrument)
{
  try
  {
    return instrument.mesh.get() != nullptr;
  }
  catch (const core::Error&)
  {
    return false;
  }
}

} // namespace

void StoreTask::run(const core::Progress& progress)
{
  library::Library own = library; // with a listener of its own
  own.onNotice([this](const std::string& words) { notices.push_back(words); });
  if (source)
  {
    // Mapped voxels would be stored there under the hash of their current content.
    const auto map = [](const scene::ImagePart& image) { image.volume.get(); };
    map(value.ct);
    std::for_each(value.mr.begin(), value.mr.end(), map);
    source->checkVoxels(value, progress.part(0.0, 0.2));
    const auto asNew = [](auto& part) { part.object.clear(); };
    asNew(value.ct);
    std::for_each(value.mr.begin(), value.mr.end(), asNew);
    std::for_each(value.labels.begin(), value.labels.end(), asNew);
    std::for_each(value.meshes.begin(), value.meshes.end(), asNew);
    if (auto& instrument = value.view.instrument; instrument && isReadable(*instrument))
      asNew(*instrument);
    for (std::size_t n = 0; n < value.dissection.strokes().size(); ++n)
      value.dissection.setStored(n, "", value.dissection.strokes()[n]->packed);
    for (std::string& note : library::forgetForeignIdentity(value))
      notices.push_back(std::move(note));
    for (scene::Attachment& one : value.attachments)
      if (!one.object.empty() && library::attachmentProblem(*source, one).empty())
        one.source = source->folder() / "objects" / one.object;
  }
  own.save(value, source ? progress.part(0.2, 1.0) : progress);
}

StoreTask WorkstationModel::beginStore()
{
  StoreTask task{m_library, *m_case, m_case->name, m_changes, std::nullopt};
  task.value.dissection.unload(); // only the strokes are stored
  for (const LeftOut& parts : m_leftOut)
    parts.putBack(task.value);
  m_beingStored = true;
  m_partsMoved = false;
  return task;
}

StoreTask WorkstationModel::beginStoreAs(const std::string& name)
{
  StoreTask task = beginStore();
  task.value.name = name;
  task.value.revision = 0;
  return task;
}

StoreTask WorkstationModel::beginStoreElsewhere(const std::filesystem::path& folder,
                                                const std::string& name)
{
  StoreTask task = beginStoreAs(name);
  task.source = std::exchange(task.library, library::Library(folder));
  return task;
}

void WorkstationModel::stored(const StoreTask& done)
{
  m_beingStored = false;
  if (!m_case || m_case->name != done.from)
    return;
  const scene::Case& saved = done.value;
  const auto takeObjects = [](auto& parts, const auto& from)
  {
    for (std::size_t n = 0; n < std::min(parts.size(), from.size()); ++n)
      parts[n].object = from[n].object;
  };
  // Salted by the save: a salted and an unsalted hash cannot be compared.
  const auto takeFrame = [](scene::ImagePart& image, const scene::ImagePart& from)
  {
    image.frameOfReference = from.frameOfReference;
    image.patient = from.patient;
    image.isFrameSalted = from.isFrameSalted;
    image.saltId = from.saltId;
  };
  if (done.source) // what was removed before is in the other library
  {
    m_removed.clear();
    m_edits.clear();
  }
  if (m_partsMoved && done.source)
  {
    const auto storeAnew = [](auto& parts)
    {
      for (auto& part : parts)
        part.object.clear();
    };
    storeAnew(m_case->mr);
    storeAnew(m_case->labels);
    storeAnew(m_case->meshes);
  }
  m_case->id = saved.id;
  m_case->revision = saved.revision;
  m_case->ct.object = saved.ct.object;
  takeFrame(m_case->ct, saved.ct);
  for (scene::ImagePart& mr : m_case->mr)
    if (const scene::ImagePart* same = scene::findMr(saved, mr.name))
      takeFrame(mr, *same);
  // Structures may have been added, replaced or removed meanwhile.
  for (scene::LabelPart& part : m_case->labels)
    for (const scene::LabelPart& from : saved.labels)
      if (sameLabels(part, from))
        part.object = from.object;
  if (!m_partsMoved) // else the next save finds what is stored by its content
  {
    takeObjects(m_case->mr, saved.mr);
    takeObjects(m_case->meshes, saved.meshes);
  }
  if (auto& instrument = m_case->view.instrument;
      instrument && saved.view.instrument &&
      instrument->mesh.peek() == saved.view.instrument->mesh.peek())
    instrument->object = saved.view.instrument->object;
  for (scene::Attachment& one : m_case->attachments)
    for (const scene::Attachment& from : saved.attachments)
      if (one.name == from.name && one.object.empty() && one.content == from.content &&
          one.source == from.source)
      {
        one.object = from.object;
        one.bytes = from.bytes;
        one.content.reset();
        one.source.clear();
      }
  const auto& strokes = saved.dissection.strokes();
  for (std::size_t n = 0; n < std::min(m_case->dissection.strokes().size(), strokes.size()); ++n)
    m_case->dissection.setStored(n, strokes[n]->object, strokes[n]->packed);
  // Under another name alone it may be the same, which another program has renamed.
  const bool other = done.source || !m_saved || m_saved->id != saved.id;
  m_case->name = saved.name;
  if (done.source)
  {
    m_library = done.library;
    listen();
  }
  m_case->derived =
      m_leftOut.empty() && !m_library.isStandIn(m_case->ct) ? m_library.derived() : nullptr;
  m_unsaved = m_changes != done.changes;
  keepJournal(saved, other); // what was drilled since then is written at once
  notify(events.stateChanged);
  for (const std::string& words : done.notices)
    notify(events.noticed, words);
}

void WorkstationModel::notStored()
{
  m_beingStored = false;
  setUnsaved(true);
}

void WorkstationModel::storeNow(StoreTask task)
{
  try
  {
    task.run();
  }
  catch (...)
  {
    notStored();
    throw;
  }
  stored(task);
}

void WorkstationModel::save()
{
  if (m_case)
    storeNow(beginStore());
}

void WorkstationModel::saveAs(const std::string& name)
{
  storeNow(beginStoreAs(name));
}

void WorkstationModel::saveElsewhere(const std::filesystem::path& folder, const std::string& name)
{
  storeNow(beginStoreElsewhere(folder, name));
}

} // namespace petrous::presenters
