#include "petrous/Presenters/JournalThread.h"

#include <chrono>
#include <utility>

namespace petrous::presenters
{

namespace
{
constexpr std::chrono::seconds kAgain(1);
} // namespace

JournalThread::JournalThread()
  : m_thread([this] { run(); })
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

void JournalThread::begin(const library::Library& library, const library::SavedState& saved)
{
  auto journal = std::make_unique<library::Journal>(library, saved,
                                                    [this](const dissection::Dissection& work)
                                                    {
                                                      dissection::StrokeInfo info = work.openInfo();
                                                      if (!m_measure)
                                                        return info;
                                                      auto removed = m_measure(work);
                                                      info.removed = removed.total;
                                                      info.structures =
                                                          std::move(removed.structures);
                                                      return info;
                                                    });
  {
    const std::lock_guard<std::mutex> lock(m_mutex);
    m_tasks.begin.swap(journal);
    m_tasks.beginStrokes = saved.strokes.size();
    m_tasks.saved.reset(); // was meant for the previous journal
    m_begun = true;
  }
  m_wake.notify_one();
}

bool JournalThread::begun() const
{
  const std::lock_guard<std::mutex> lock(m_mutex);
  return m_begun;
}

void JournalThread::follow(const dissection::Dissection& work, const Measure& measure)
{
  std::optional<Work> next(Work{work, measure});
  {
    const std::lock_guard<std::mutex> lock(m_mutex);
    m_tasks.work.swap(next);
  }
  m_wake.notify_one();
}

void JournalThread::saved(const library::SavedState& now)
{
  {
    const std::lock_guard<std::mutex> lock(m_mutex);
    m_tasks.saved = now;
  }
  m_wake.notify_one();
}

std::string JournalThread::takeFailure()
{
  const std::lock_guard<std::mutex> lock(m_mutex);
  return std::exchange(m_failure, {});
}

// Removes from the tasks what was written.
void JournalThread::write(Tasks& tasks)
{
  if (tasks.work)
  {
    m_latest = std::exchange(tasks.work, std::nullopt);
    m_measure = m_latest->measure;
    tasks.news = true;
  }
  if (tasks.begin)
  {
    if (m_latest && m_latest->dissection.strokes().size() >= tasks.beginStrokes)
      tasks.begin->follow(m_latest->dissection);
    m_journal = std::move(tasks.begin);
  }
  else if (tasks.news && m_journal)
    m_journal->follow(m_latest->dissection);
  tasks.news = false;
  if (tasks.saved && m_journal)
    m_journal->saved(*tasks.saved);
  tasks.saved.reset();
}

void JournalThread::run()
{
  Tasks tasks;
  bool notified = false;
  for (;;)
  {
    bool stop = false;
    {
      std::unique_lock<std::mutex> lock(m_mutex);
      if (!tasks.empty()) // could not be written
        m_wake.wait_for(lock, kAgain, [this] { return m_stop; });
      else
        m_wake.wait(lock, [this] { return m_stop || !m_tasks.empty(); });
      if (m_tasks.begin)
      {
        tasks.begin = std::move(m_tasks.begin);
        tasks.beginStrokes = m_tasks.beginStrokes;
        tasks.saved.reset();
      }
      if (m_tasks.work)
        tasks.work = std::exchange(m_tasks.work, std::nullopt);
      if (m_tasks.saved)
        tasks.saved = std::exchange(m_tasks.saved, std::nullopt);
      stop = m_stop;
    }
    std::string why;
    try
    {
      write(tasks);
    }
    catch (const std::exception& error)
    {
      why = error.what();
    }
    if (!why.empty() && !notified)
    {
      const std::lock_guard<std::mutex> lock(m_mutex);
      m_failure = why;
    }
    notified = !why.empty();
    if (stop)
      break;
  }
}

} // namespace petrous::presenters
