#include "BackgroundWork.h"

#include <utility>

#include "Application.h"
#include "Theme.h"
#include "WindowTexts.h"
#include "petrous/Core/Error.h"

namespace petrous::workstation
{

BackgroundWork::BackgroundWork(QObject* parent)
  : QObject(parent)
{
}

BackgroundWork::~BackgroundWork()
{
  drop();
}

void BackgroundWork::start(Work work)
{
  drop();
  m_token = std::make_shared<core::CancelToken>();
  m_thread = std::thread([this, work = std::move(work)] { guarded([&] { run(work); }); });
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
  if (m_token)
    m_token->cancel();
}

void BackgroundWork::drop()
{
  cancel();
  wait();
}

void BackgroundWork::wait()
{
  if (m_thread.joinable())
    m_thread.join();
  ++m_number; // pending results are ignored
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
        const double reached = latest->fraction;
        const QString step = phrase(latest->text);
        lock.unlock();
        emit progressed(reached, step);
      });
}

void BackgroundWork::run(const Work& work)
{
  try
  {
    const auto latest = std::make_shared<Latest>();
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

} // namespace petrous::workstation
