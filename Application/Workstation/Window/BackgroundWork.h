#pragma once

#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <thread>

#include <QObject>

#include "petrous/Core/Progress.h"

namespace petrous::workstation
{

/// Runs one task at a time in a separate thread. Its results are handled in the window's thread, in
/// order.
class BackgroundWork : public QObject
{
  Q_OBJECT
public:
  using Reply = std::function<void()>;                      ///< runs in the window's thread
  using Work = std::function<Reply(const core::Progress&)>; ///< runs in the worker thread

  explicit BackgroundWork(QObject* parent = nullptr);
  ~BackgroundWork() override; ///< cancels and waits

  bool busy() const noexcept { return m_busy; }

  /// Cancels a running task and waits for it, ignoring its results. A task ends with exactly one
  /// of: the reply that it returned, `failed` or `cancelled`.
  void start(Work work);
  /// As `start`, without waiting: a running task is cancelled, its results are ignored, and this
  /// one begins when it has ended.
  void replace(Work work);
  void abandon();        ///< likewise without another one
  void cancel();         ///< requests cancellation
  void drop();           ///< cancels and waits; its results are ignored
  void wait();           ///< waits; its results are ignored; no other one begins
  void post(Reply what); ///< from the worker thread, while the task runs

signals:
  void progressed(double fraction, const QString& text); ///< only the latest of several
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
  void run(const Work& work);
  void end(Reply what);

  std::shared_ptr<core::CancelToken> m_token;
  std::thread m_thread;
  bool m_busy = false;
  bool m_isAbandoned = false;
  Work m_next;           // when the abandoned one has ended
  unsigned m_number = 0; // of the task whose results are handled
};

} // namespace petrous::workstation
