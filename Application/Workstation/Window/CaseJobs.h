#pragma once

#include <functional>
#include <vector>

#include <QObject>
#include <QString>
#include <QStringList>
#include <QTimer>

class QWidget;

namespace petrous::workstation
{

/// The jobs in the background whose results are to change a case, and are lost when they are
/// stopped: the one place that knows them (filled by MainWindow). The draft of a structure is none:
/// it asks for itself (SegmentController::mayLeave).
class CaseJobs : public QObject
{
  Q_OBJECT
public:
  struct Job
  {
    std::function<QString()> running; ///< what runs, as it is told to the user; empty: nothing
    std::function<void()> stop;       ///< and ignores what it has by then
  };
  /// `window`: parent of the question.
  explicit CaseJobs(QWidget& window);

  void add(Job job);
  QStringList running() const;

  /// Before the case is left. Asks (object name "askJobs") while a job runs; false: the user stays,
  /// or waits: then `again`, which is to leave anew, is called as soon as no job runs and no dialog
  /// is open, unless this was called again by then. Null: waiting is not offered. `what`: becomes
  /// of the case then, for the user.
  bool mayLeave(const std::function<void()>& again, const QString& what = {});
  void stay(); ///< waits no more: the jobs go on, and the case is not left

signals:
  /// For these jobs, after which the case is left, and what becomes of it; empty: for none any
  /// more.
  void waits(const QStringList& jobs, const QString& what);

private:
  void lookAgain();
  void leaveLater(const std::function<void()>& again, const QString& what);
  void tell(const QStringList& jobs);

  QWidget& m_window;
  std::vector<Job> m_jobs;
  std::function<void()> m_again;
  QString m_what;     ///< becomes of the case then
  QStringList m_told; ///< what is waited for
  QTimer m_look;
  bool m_isAsking = false;
};

} // namespace petrous::workstation
