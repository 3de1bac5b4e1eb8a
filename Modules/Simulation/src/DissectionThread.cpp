#include "petrous/Simulation/DissectionThread.h"

#include <chrono>
#include <utility>

namespace petrous::simulation
{

namespace
{

constexpr std::size_t kBatch = 64; // records looked at together
constexpr std::chrono::milliseconds kPoll(1);

} // namespace

DissectionThread::DissectionThread(SpscRing<TickRecord>& records, DissectionLoop& loop, Sink sink)
  : m_records(records)
  , m_loop(loop)
  , m_sink(std::move(sink))
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

// The session goes on whatever fails here; the first failure is kept for whoever asks.
template <typename Work>
void DissectionThread::attempt(const char* what, Work work)
{
  try
  {
    work();
  }
  catch (const std::exception& error)
  {
    const std::lock_guard<std::mutex> lock(m_mutex);
    if (m_failure.empty())
      m_failure = std::string(what) + " failed: " + error.what();
  }
}

void DissectionThread::drain()
{
  while (const std::size_t count = m_records.pop(m_batch.data(), m_batch.size()))
  {
    if (m_sink)
    {
      bool done = false;
      attempt("Recording",
              [&]
              {
                for (std::size_t n = 0; n < count; ++n)
                  m_sink(m_batch[n]);
                done = true;
              });
      if (!done)
        m_sink = {};
    }
    attempt("Cutting", [&] { m_loop.step(m_batch.data(), count); });
  }
}

void DissectionThread::obey()
{
  std::vector<bool> asked;
  {
    const std::lock_guard<std::mutex> lock(m_mutex);
    asked.swap(m_asked);
  }
  for (const bool undo : asked)
    attempt(undo ? "Undo" : "Redo", [&] { undo ? m_loop.undo() : m_loop.redo(); });
  // A tick that begins from now on sees the new state.
  const std::chrono::duration<double> now = std::chrono::steady_clock::now().time_since_epoch();
  if (!asked.empty())
    m_loop.ignoreUntil(now.count());
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
  attempt("Closing the stroke", [this] { m_loop.endStroke(); });
}

} // namespace petrous::simulation
