#include "CaseSaver.h"

#include <utility>

#include "Application.h"
#include "Theme.h"
#include "petrous/Presenters/CaseNaming.h"

namespace petrous::workstation
{

CaseSaver::CaseSaver(presenters::WorkstationModel& model)
  : m_model(model)
{
  m_work.setCompleting(true);
  const auto fail = [this](const QString& why)
  {
    m_model.notStored();
    m_well = false;
    emit failed(why);
    ended();
  };
  connect(&m_work, &BackgroundWork::failed, this, fail);
  connect(&m_work, &BackgroundWork::cancelled, this, [fail] { fail(tr("The save was stopped.")); });
}

CaseSaver::~CaseSaver()
{
  m_next.reset();
  m_work.wait();
}

void CaseSaver::save()
{
  // A queued save takes the case as it is then: under another name or elsewhere, if requested.
  if (!m_next)
    ask([this] { return m_model.beginStore(); });
}

void CaseSaver::saveAs(const std::string& name)
{
  ask([this, name] { return m_model.beginStoreAs(name); });
}

void CaseSaver::saveElsewhere(const std::filesystem::path& folder)
{
  ask(
      [this, folder]
      {
        const library::Library elsewhere(folder);
        return m_model.beginStoreElsewhere(
            folder, presenters::freeCaseName(elsewhere, m_model.value().name));
      });
}

void CaseSaver::ask(Begin begin)
{
  if (busy())
    m_next = std::move(begin);
  else
    start(begin);
}

void CaseSaver::start(const Begin& begin)
{
  if (!m_model.hasCase())
    return;
  if (aboutToSave)
    aboutToSave();
  try
  {
    const auto task = std::make_shared<presenters::StoreTask>(begin());
    m_work.start(
        [this, task](const core::Progress& progress) -> BackgroundWork::Reply
        {
          task->run(progress);
          return [this, task]
          {
            m_model.stored(*task);
            m_well = true;
            emit saved(words(task->value.name));
            ended();
          };
        });
  }
  catch (const std::exception& error) // no thread, out of memory, no such folder
  {
    m_model.notStored();
    m_well = false;
    emit failed(toString(error));
  }
}

void CaseSaver::ended()
{
  if (const auto next = std::exchange(m_next, std::nullopt))
    start(*next);
}

void CaseSaver::stop()
{
  m_next.reset();
  m_work.cancel();
}

bool CaseSaver::flush()
{
  const auto wait = [this] { handleEventsUntil([this] { return !busy(); }); };
  wait();
  if (!m_model.hasCase() || !m_model.unsaved())
    return true;
  m_well = false; // until it succeeds
  save();
  wait();
  return m_well && !m_model.unsaved();
}

} // namespace petrous::workstation
