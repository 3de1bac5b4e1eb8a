#include "petrous/Presenters/JournalThread.h"

#include <chrono>
#include <utility>

namespace petrous::presenters
{

namespace
{
constexpr std::chrono::seconds kAgain(1);
} // namespace

JournalThread::JournalThread(const library::Library& library, const scene::Case& value)
  : m_journal(library, value,
              [this](const dissection::Dissection& work)
              {
                dissection::StrokeInfo info = work.openInfo();
                if (!m_measure)
                  return info;
                auto removed = m_measure(work);
                info.removed = removed.total;
                info.structures = std::move(removed.structures);
                return info;
              })
  , m_thread([this] { run(); })
{
}

JournalThread::~JournalThread()
{
  {
    const std::lock_guard<std::mutex> lock(m_mutex);
    m_stop = true;
  }
  m_wake.notify_one();
  m_thread.join();
}

void JournalThread::follow(const dissection::Dissection& work, const Measure& measure)
{
  std::optional<Work> next(Work{work, measure});
  {
    const std::lock_guard<std::mutex> lock(m_mutex);
    m_work.swap(next);
  }
  m_wake.notify_one();
}

void JournalThread::saved(const scene::Case& value)
{
  std::optional<scene::Case> next(value);
  next->dissection.reset(); // goes on, in another thread
  {
    const std::lock_guard<std::mutex> lock(m_mutex);
    m_saved.swap(next);
  }
  m_wake.notify_one();
}

std::string JournalThread::takeFailure()
{
  const std::lock_guard<std::mutex> lock(m_mutex);
  return std::exchange(m_failure, {});
}

// What is written is empty then.
void JournalThread::write(std::optional<Work>& work, std::optional<scene::Case>& saved)
{
  if (work)
  {
    m_measure = work->measure;
    m_journal.follow(work->dissection);
    work.reset();
  }
  if (saved)
    m_journal.saved(*saved);
  saved.reset();
}

void JournalThread::run()
{
  std::optional<Work> work;
  std::optional<scene::Case> saved;
  bool told = false;
  for (;;)
  {
    bool stop = false;
    {
      std::unique_lock<std::mutex> lock(m_mutex);
      if (work || saved) // could not be written
        m_wake.wait_for(lock, kAgain, [this] { return m_stop; });
      else
        m_wake.wait(lock, [this] { return m_stop || m_work || m_saved; });
      if (m_work)
        work = std::exchange(m_work, std::nullopt);
      if (m_saved)
        saved = std::exchange(m_saved, std::nullopt);
      stop = m_stop;
    }
    std::string why;
    try
    {
      write(work, saved);
    }
    catch (const std::exception& error)
    {
      why = error.what();
    }
    if (!why.empty() && !told)
    {
      const std::lock_guard<std::mutex> lock(m_mutex);
      m_failure = why;
    }
    told = !why.empty();
    if (stop)
      return;
  }
}

} // namespace petrous::presenters
