#include "BackgroundWork.h"

#include <utility>

#include "ImportJob.h"
#include "Theme.h"
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
  m_busy = true;
  m_thread = std::thread([this, work = std::move(work)] { run(work); });
}

void BackgroundWork::cancel()
{
  if (m_token)
    m_token->cancel();
}

void BackgroundWork::drop()
{
  cancel();
  if (m_thread.joinable())
    m_thread.join();
  ++m_number; // what is still on its way is of no interest
  m_busy = false;
}

// m_number changes on the window's thread only after the work's thread ended.
void BackgroundWork::post(Reply what)
{
  QMetaObject::invokeMethod(
      this,
      [this, number = m_number, what = std::move(what)]
      {
        if (number == m_number)
          what();
      },
      Qt::QueuedConnection);
}

void BackgroundWork::end(Reply what)
{
  post(
      [this, what = std::move(what)]
      {
        m_busy = false;
        what();
      });
}

void BackgroundWork::run(const Work& work)
{
  try
  {
    const core::Progress progress([this](double fraction, const std::string& text)
                                  { post([=] { emit progressed(fraction, words(text)); }); },
                                  m_token);
    end(work(progress));
  }
  catch (const core::Error& error)
  {
    if (error.fault() == core::Fault::Cancelled)
      end([this] { emit cancelled(); });
    else
      end([this, why = inWords(error)] { emit failed(why); });
  }
  catch (const std::exception& error)
  {
    end([this, why = inWords(error)] { emit failed(why); });
  }
}

} // namespace petrous::workstation
