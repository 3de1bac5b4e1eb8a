#include "BackgroundWork.h"

#include <algorithm>
#include <utility>

#include <QCoreApplication>
#include <QEventLoop>
#include <QList>
#include <QProgressDialog>

#include "Application.h"
#include "Theme.h"
#include "WindowTexts.h"
#include "petrous/Core/Error.h"

namespace petrous::workstation
{

BackgroundWork::BackgroundWork()
  : QObject(QCoreApplication::instance())
  , m_clock(presenters::steadySeconds)
{
  constexpr int kAgain = 1000; // ms
  m_again.setInterval(kAgain);
  connect(&m_again, &QTimer::timeout, this, &BackgroundWork::refresh);
}

BackgroundWork::~BackgroundWork()
{
  drop();
}

void BackgroundWork::start(Work work)
{
  drop();
  m_token = std::make_shared<core::CancelToken>();
  m_latest = std::make_shared<Latest>();
  m_timeLeft.restart();
  m_left.clear();
  m_again.start();
  m_thread = std::thread([this, work = std::move(work), latest = m_latest]
                         { guarded([&] { run(work, latest); }); });
  m_busy = true; // what it posts is handled later
}

void BackgroundWork::replace(Work work)
{
  if (!m_busy)
    return start(std::move(work));
  abandon();
  m_next = std::move(work);
}

void BackgroundWork::abandon()
{
  cancel();
  m_isAbandoned = m_busy;
  m_next = {};
}

void BackgroundWork::cancel()
{
  m_again.stop();
  if (m_token)
    m_token->cancel();
}

void BackgroundWork::drop()
{
  cancel();
  wait();
}

void BackgroundWork::dropInLoop()
{
  abandon();
  handleEventsUntil([this] { return !m_busy; });
  drop();
}

QString BackgroundWork::step() const
{
  if (!m_busy || !m_latest)
    return {};
  std::unique_lock<std::mutex> lock(m_latest->mutex);
  const std::string text = m_latest->text;
  lock.unlock();
  return text.empty() ? QString() : phrase(text);
}

void BackgroundWork::wait()
{
  if (m_thread.joinable())
    m_thread.join();
  ++m_number; // pending results are ignored
  m_again.stop();
  m_busy = m_isAbandoned = false;
  m_next = {};
}

// m_number changes in the window's thread only after the worker thread ended.
void BackgroundWork::post(Reply what)
{
  QMetaObject::invokeMethod(
      this,
      [this, number = m_number, what = std::move(what)]
      {
        if (number == m_number && !m_isAbandoned)
          what();
      },
      Qt::QueuedConnection);
}

void BackgroundWork::end(Reply what)
{
  QMetaObject::invokeMethod(
      this,
      [this, number = m_number, what = std::move(what)]() mutable
      {
        if (number != m_number)
          return;
        m_busy = false;
        m_again.stop();
        if (!std::exchange(m_isAbandoned, false))
          return what();
        what = {}; // with what it holds, before the next one begins
        if (Work next = std::exchange(m_next, {}))
          start(std::move(next));
      },
      Qt::QueuedConnection);
}

// The receiver may be slower than the task.
void BackgroundWork::notify(const std::shared_ptr<Latest>& latest, double fraction,
                            const std::string& text)
{
  {
    const std::lock_guard<std::mutex> lock(latest->mutex);
    latest->fraction = fraction;
    latest->text = text;
    if (std::exchange(latest->onItsWay, true))
      return;
  }
  post(
      [this, latest]
      {
        std::unique_lock<std::mutex> lock(latest->mutex);
        latest->onItsWay = false;
        m_reached = latest->fraction;
        m_step = phrase(latest->text);
        lock.unlock();
        m_timeLeft.report(m_reached, m_clock());
        m_left = timeLeft();
        emit progressed(m_reached, m_step, m_left);
      });
}

QString BackgroundWork::timeLeft()
{
  return phrase(presenters::timeLeftText(m_timeLeft.shown(m_clock())));
}

void BackgroundWork::refresh()
{
  const QString left = timeLeft();
  if (left != std::exchange(m_left, left))
    emit progressed(m_reached, m_step, m_left);
}

void BackgroundWork::run(const Work& work, const std::shared_ptr<Latest>& latest)
{
  try
  {
    const core::Progress progress([this, latest](double fraction, const std::string& text)
                                  { notify(latest, fraction, text); },
                                  m_token);
    end(work(progress));
  }
  catch (const core::Error& error)
  {
    if (error.fault() == core::Fault::Cancelled)
      end([this] { emit cancelled(); });
    else
      end([this, why = toString(error)] { emit failed(why); });
  }
  catch (const std::exception& error)
  {
    end([this, why = toString(error)] { emit failed(why); });
  }
  catch (...)
  {
    end([this] { emit failed(tr("An unexpected fault.")); });
  }
}

void handleEventsUntil(const std::function<bool()>& done)
{
  constexpr int kAgain = 10; // ms
  if (done())
    return;
  QEventLoop loop;
  QTimer again;
  QObject::connect(&again, &QTimer::timeout, &loop,
                   [&]
                   {
                     if (done())
                       loop.quit();
                   });
  again.start(kAgain);
  loop.exec(QEventLoop::ExcludeUserInputEvents);
}

namespace
{

QList<BackgroundWork*> allWork()
{
  return QCoreApplication::instance()->findChildren<BackgroundWork*>(QString(),
                                                                     Qt::FindDirectChildrenOnly);
}

} // namespace

FinishingNote::FinishingNote(QWidget& window)
  : m_window(window)
{
  constexpr int kAfter = 250; // ms
  QObject::connect(&m_timer, &QTimer::timeout, &m_timer, [this] { refresh(); });
  m_timer.start(kAfter);
}

FinishingNote::~FinishingNote() = default;

void FinishingNote::refresh()
{
  const QList<BackgroundWork*> all = allWork();
  const auto running =
      std::find_if(all.begin(), all.end(), [](const BackgroundWork* work) { return work->busy(); });
  if (running == all.end())
    return;
  if (!m_dialog)
  {
    m_dialog = std::make_unique<QProgressDialog>(QString(), QString(), 0, 0, &m_window);
    m_dialog->setObjectName("finishing");
    m_dialog->setWindowTitle(m_window.windowTitle());
    m_dialog->setWindowModality(Qt::WindowModal);
    m_dialog->setCancelButton(nullptr);
    m_dialog->setMinimumWidth(420);
  }
  const QString step = (*running)->step();
  m_dialog->setLabelText(QObject::tr("Finishing: %1")
                             .arg(step.isEmpty() ? QObject::tr("work in the background") : step));
  m_dialog->show();
}

void finishAll(QWidget& window)
{
  const FinishingNote note(window);
  handleEventsUntil(
      []
      {
        bool isDone = true;
        const QList<BackgroundWork*> all = allWork();
        for (BackgroundWork* work : all)
          if (work->busy())
          {
            isDone = false;
            if (!work->isCompleting())
              work->abandon();
          }
        return isDone;
      });
}

} // namespace petrous::workstation
