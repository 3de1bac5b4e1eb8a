#include "CaseJobs.h"

#include <utility>

#include <QAbstractButton>
#include <QMessageBox>
#include <QPushButton>
#include <QScopedValueRollback>

#include "Application.h"

namespace petrous::workstation
{

CaseJobs::CaseJobs(QWidget& window)
  : QObject(&window)
  , m_window(window)
{
  constexpr int kLook = 50; // ms
  m_look.setInterval(kLook);
  connect(&m_look, &QTimer::timeout, this, &CaseJobs::lookAgain);
}

void CaseJobs::add(Job job)
{
  m_jobs.push_back(std::move(job));
}

QStringList CaseJobs::running() const
{
  QStringList all;
  for (const Job& job : m_jobs)
    if (const QString what = job.running(); !what.isEmpty())
      all += what;
  return all;
}

bool CaseJobs::mayLeave(const std::function<void()>& again, const QString& what)
{
  stay();
  const QStringList jobs = running();
  if (jobs.isEmpty())
    return true;
  if (m_isAsking)
    return false;
  const QScopedValueRollback<bool> asking(m_isAsking, true);
  QMessageBox box(QMessageBox::Question, tr("Still running"),
                  tr("Still running: %1").arg(jobs.join(", ")), QMessageBox::NoButton, &m_window);
  box.setObjectName("askJobs");
  box.setInformativeText(tr("What is stopped now is lost, and the case stays as it was before."));
  QPushButton* wait = again ? box.addButton(tr("&Wait for it"), QMessageBox::AcceptRole) : nullptr;
  if (wait)
    wait->setToolTip(tr("Goes on with this as soon as it is done; you can work meanwhile"));
  QPushButton* stop = box.addButton(tr("&Stop it"), QMessageBox::DestructiveRole);
  stop->setToolTip(tr("Without its result"));
  QPushButton* stay = box.addButton(tr("&Go on working"), QMessageBox::RejectRole);
  stay->setToolTip(tr("It goes on running, and the case stays open"));
  box.setDefaultButton(wait ? wait : stay);
  box.setEscapeButton(stay);
  box.exec();
  const QAbstractButton* chosen = box.clickedButton();
  if (chosen == stop)
  {
    for (const Job& job : m_jobs)
      if (!job.running().isEmpty())
        job.stop();
    return true;
  }
  if (!wait || chosen != wait)
    return false;
  if (running().isEmpty()) // it ended meanwhile
    return true;
  leaveLater(again, what);
  return false;
}

void CaseJobs::leaveLater(const std::function<void()>& again, const QString& what)
{
  m_again = again;
  m_what = what;
  m_look.start();
  tell(running());
}

void CaseJobs::stay()
{
  m_look.stop();
  m_again = {};
  tell({});
}

void CaseJobs::tell(const QStringList& jobs)
{
  if (jobs != std::exchange(m_told, jobs))
    emit waits(jobs, m_what);
}

void CaseJobs::lookAgain()
{
  const QStringList jobs = running();
  if (!jobs.isEmpty())
    tell(jobs);
  if (isDialogOpen() || !jobs.isEmpty())
    return;
  const auto again = m_again;
  stay();
  if (again)
    again();
}

} // namespace petrous::workstation
