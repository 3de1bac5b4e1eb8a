#pragma once

#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <utility>

#include <QObject>
#include <QTimer>

#include "petrous/Core/Progress.h"
#include "petrous/Presenters/TimeLeft.h"

class QProgressDialog;
class QWidget;

namespace petrous::workstation
{

/// Runs one task at a time in a separate thread. Its results are handled in the window's thread, in
/// order. A child of the application, which thus knows all of them (finishAll).
class BackgroundWork : public QObject
{
  Q_OBJECT
public:
  using Reply = std::function<void()>;                      ///< runs in the window's thread
  using Work = std::function<Reply(const core::Progress&)>; ///< runs in the worker thread

  BackgroundWork();
  ~BackgroundWork() override; ///< cancels and waits

  bool busy() const noexcept { return m_busy; }

  /// Cancels a running task and waits for it, ignoring its results. A task ends with exactly one
  /// of: the reply that it returned, `failed` or `cancelled`.
  void start(Work work);
  /// As `start`, without waiting: a running task is cancelled, its results are ignored, and this
  /// one begins when it has ended.
  void replace(Work work);
  void abandon(); ///< likewise without another one
  void cancel();  ///< requests cancellation
  void drop();    ///< cancels and waits; its results are ignored
  /// As `drop`, but the window goes on: events are handled meanwhile, except the user's.
  void dropInLoop();
  void wait();           ///< waits; its results are ignored; no other one begins
  void post(Reply what); ///< from the worker thread, while the task runs

  /// Its tasks must not be cancelled when the program ends.
  void setCompleting(bool on) noexcept { m_isCompleting = on; }
  bool isCompleting() const noexcept { return m_isCompleting; }

  QString step() const; ///< of a running task: what it reported last; may be empty

  /// Seconds, from any origin, for the time that is left; of a clock that is not this computer's.
  void setClock(std::function<double()> clock) { m_clock = std::move(clock); }

signals:
  /// Only the latest of several. `left`: "about 20 s left", in the window's language; empty while
  /// it is not known (presenters::TimeLeft). Again where it changed without another report.
  void progressed(double fraction, const QString& text, const QString& left);
  void failed(const QString& why);
  void cancelled();

private:
  struct Latest // progress
  {
    std::mutex mutex;
    double fraction = 0.0;
    std::string text;
    bool onItsWay = false;
  };
  void notify(const std::shared_ptr<Latest>& latest, double fraction, const std::string& text);
  void run(const Work& work, const std::shared_ptr<Latest>& latest);
  void end(Reply what);
  QString timeLeft();
  void refresh();

  std::shared_ptr<core::CancelToken> m_token;
  std::shared_ptr<Latest> m_latest; // of the running task
  std::thread m_thread;
  bool m_busy = false;
  bool m_isAbandoned = false;
  bool m_isCompleting = false;
  Work m_next; // when the abandoned one has ended
  std::function<double()> m_clock;
  presenters::TimeLeft m_timeLeft;
  QTimer m_again;         // while the task runs
  double m_reached = 0.0; // as emitted last
  QString m_step, m_left;
  unsigned m_number = 0; // of the task whose results are handled
};

/// Handles events, except the user's, until `done`, which is called again and again.
void handleEventsUntil(const std::function<bool()>& done);

/// Says in a dialog over the window (object name "finishing") which task is waited for, where that
/// takes long. Events must be handled meanwhile.
class FinishingNote
{
public:
  explicit FinishingNote(QWidget& window);
  ~FinishingNote();

private:
  void refresh();

  QWidget& m_window;
  QTimer m_timer;
  std::unique_ptr<QProgressDialog> m_dialog;
};

/// Before the program ends: cancels all tasks but those that are completing, and waits as
/// BackgroundWork::dropInLoop, with a FinishingNote, until none runs.
void finishAll(QWidget& window);

} // namespace petrous::workstation
