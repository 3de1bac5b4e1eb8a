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

/// One long piece of work at a time on a thread of its own. What comes of it is handled on the
/// thread of the window, in the order in which it came.
class BackgroundWork : public QObject
{
  Q_OBJECT
public:
  using Reply = std::function<void()>;                      ///< runs on the window's thread
  using Work = std::function<Reply(const core::Progress&)>; ///< runs on the work's

  explicit BackgroundWork(QObject* parent = nullptr);
  ~BackgroundWork() override; ///< cancels, and waits

  bool busy() const noexcept { return m_busy; }

  /// Cancels what runs and waits for it; nothing more is heard of that. Exactly one ends the work:
  /// the reply that it gave, `failed` or `cancelled`.
  void start(Work work);
  void cancel();         ///< asks it to end
  void drop();           ///< cancels and waits; nothing more is heard of it
  void wait();           ///< waits; nothing more is heard of it
  void post(Reply what); ///< from the work's thread, while it is under way

signals:
  void progressed(double fraction, const QString& text); ///< the latest, where there were more
  void failed(const QString& why);
  void cancelled();

private:
  struct Latest // of the progress
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
  unsigned m_number = 0; // of the work that is heard
};

} // namespace petrous::workstation
