#include <algorithm>
#include <utility>

#include "Tell.h"
#include "petrous/Presenters/WorkstationModel.h"

// What of the model has to do with the library.
namespace petrous::presenters
{

void WorkstationModel::listen()
{
  m_library.onNotice([this](const std::string& words) { tell(events.noticed, words); });
}

// From when the case is as it was saved, or goes on from there.
void WorkstationModel::keepJournal(const library::SavedState& saved)
{
  m_saved = saved;
  try
  {
    if (!m_journal)
      m_journal = std::make_shared<JournalThread>();
    if (m_journal->begun())
      m_journal->saved(saved);
    else
      m_journal->begin(m_library, saved);
  }
  catch (const std::exception& error)
  {
    tell(events.noticed, std::string(error.what()));
  }
}

void WorkstationModel::open(const std::string& name)
{
  stopTouch();
  if (m_case && m_case->name == name)
    m_journal.reset(); // or it would look as if another program drilled in it
  try
  {
    auto next = std::make_unique<scene::Case>(m_library.open(name));
    m_library.loadDissection(*next);
    next->ct.volume.get(); // a missing object is told now
    show(std::move(next), false);
  }
  catch (...)
  {
    if (m_case && !m_journal && m_saved)
    {
      keepJournal(*m_saved);
      m_journal->follow(*m_case->dissection);
    }
    throw;
  }
  keepJournal(*m_case);
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
  m_case->id = saved.id;
  m_case->revision = saved.revision;
  m_case->ct.object = saved.ct.object;
  for (std::size_t n = 0; n < std::min(m_case->mr.size(), saved.mr.size()); ++n)
    m_case->mr[n].object = saved.mr[n].object;
  for (std::size_t n = 0; n < std::min(m_case->labels.size(), saved.labels.size()); ++n)
    m_case->labels[n].object = saved.labels[n].object;
  for (std::size_t n = 0; n < std::min(m_case->meshes.size(), saved.meshes.size()); ++n)
    m_case->meshes[n].object = saved.meshes[n].object;
  keepJournal(saved); // what was drilled since then goes there at once
  tell(events.stateChanged);
}

void WorkstationModel::notStored()
{
  m_beingStored = false;
  setUnsaved(true);
}

void WorkstationModel::save()
{
  if (!m_case)
    return;
  m_library.save(*m_case);
  keepJournal(*m_case);
  setUnsaved(false);
}

void WorkstationModel::saveAs(const std::string& name)
{
  scene::Case next = *m_case;
  next.name = name;
  next.revision = 0;
  m_library.save(next);
  *m_case = std::move(next);
  keepJournal(*m_case);
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
  listen();
  m_saved = *m_case;
  try
  {
    if (!m_journal)
      m_journal = std::make_shared<JournalThread>();
    m_journal->begin(m_library, *m_saved); // a tool that is held goes on telling it
  }
  catch (const std::exception& error)
  {
    tell(events.noticed, std::string(error.what()));
  }
  setUnsaved(false);
}

} // namespace petrous::presenters
