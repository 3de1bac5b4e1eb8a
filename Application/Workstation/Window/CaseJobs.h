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
  /// is open, unless this was called again by then. Null: waiting is not offered.
  bool mayLeave(const std::function<void()>& again);

private:
  void lookAgain();

  QWidget& m_window;
  std::vector<Job> m_jobs;
  std::function<void()> m_again;
  QTimer m_look;
  bool m_isAsking = false;
};

} // namespace petrous::workstation
