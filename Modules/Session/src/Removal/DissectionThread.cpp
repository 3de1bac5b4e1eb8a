#include "petrous/Session/DissectionThread.h"

#include <chrono>
#include <utility>

namespace petrous::session
{

namespace
{

constexpr std::size_t kBatch = 64; // records processed together
constexpr std::chrono::milliseconds kPoll(1);

} // namespace

DissectionThread::DissectionThread(SpscRing<TickRecord>& records, DissectionLoop& loop, Hooks hooks,
                                   bool cuts)
  : m_records(records)
  , m_loop(loop)
  , m_hooks(std::move(hooks))
  , m_cuts(cuts)
  , m_batch(kBatch)
  , m_thread([this] { run(); })
{
}

DissectionThread::~DissectionThread()
{
  stop();
}

void DissectionThread::stop()
{
  {
    const std::lock_guard<std::mutex> lock(m_mutex);
    m_stop = true;
  }
  m_wake.notify_one();
  if (m_thread.joinable())
    m_thread.join();
}

void DissectionThread::undo()
{
  {
    const std::lock_guard<std::mutex> lock(m_mutex);
    m_asked.push_back(true);
  }
  m_wake.notify_one();
}

void DissectionThread::redo()
{
  {
    const std::lock_guard<std::mutex> lock(m_mutex);
    m_asked.push_back(false);
  }
  m_wake.notify_one();
}

std::string DissectionThread::takeFailure()
{
  const std::lock_guard<std::mutex> lock(m_mutex);
  return std::exchange(m_failure, {});
}

// Keeps the first failure.
template <typename Work>
bool DissectionThread::attempt(const char* what, Work work)
{
  try
  {
    work();
    return true;
  }
  catch (const std::exception& error)
  {
    const std::lock_guard<std::mutex> lock(m_mutex);
    if (m_failure.empty())
      m_failure = std::string(what) + " failed: " + error.what();
  }
  return false;
}

// For work without which drilling cannot continue.
template <typename Work>
void DissectionThread::need(const char* what, Work work)
{
  if (attempt(what, std::move(work)) || m_failed.exchange(true))
    return;
  attempt("Closing the stroke", [this] { m_loop.endStroke(); });
}

void DissectionThread::pass()
{
  if (m_hooks.after)
    need("Passing on what was cut", [this] { m_hooks.after(); });
}

void DissectionThread::drain()
{
  while (const std::size_t count = m_records.pop(m_batch.data(), m_batch.size()))
  {
    const auto record = [&]
    {
      for (std::size_t n = 0; n < count; ++n)
        m_hooks.tick(m_batch[n]);
    };
    if (m_hooks.tick && !attempt("Recording", record))
      m_hooks.tick = {};
    if (m_cuts && !m_failed)
      need("Cutting", [&] { m_loop.step(m_batch.data(), count); });
    pass();
  }
}

void DissectionThread::obey()
{
  std::vector<bool> asked;
  {
    const std::lock_guard<std::mutex> lock(m_mutex);
    asked.swap(m_asked);
  }
  if (asked.empty())
    return;
  for (const bool undo : asked)
    need(undo ? "Undo" : "Redo", [&] { undo ? m_loop.undo() : m_loop.redo(); });
  // A tick that starts from now on uses the new state.
  const std::chrono::duration<double> now = std::chrono::steady_clock::now().time_since_epoch();
  m_loop.ignoreUntil(now.count());
  pass();
}

void DissectionThread::run()
{
  for (;;)
  {
    bool stop = false;
    {
      std::unique_lock<std::mutex> lock(m_mutex);
      m_wake.wait_for(lock, kPoll, [this] { return m_stop || !m_asked.empty(); });
      stop = m_stop;
    }
    drain();
    obey();
    if (stop)
      break;
  }
  need("Closing the stroke", [this] { m_loop.endStroke(); });
  pass();
}

} // namespace petrous::session
